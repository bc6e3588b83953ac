//! Vectors over the joints that move: positions, velocities, accelerations and efforts are different types, because they have
//! the same shape and swapping them would compile.

use nalgebra::DVector;

macro_rules! joint_vector {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name(DVector<f64>);

        impl $name {
            /// Takes values in the file order of the joints that move.
            pub fn new(values: impl IntoIterator<Item = f64>) -> Self {
                let values: Vec<f64> = values.into_iter().collect();
                Self(DVector::from_vec(values))
            }

            /// `n` zeros.
            pub fn zeros(n: usize) -> Self {
                Self(DVector::zeros(n))
            }

            /// The values in joint order.
            pub fn as_slice(&self) -> &[f64] {
                self.0.as_slice()
            }

            /// The values in joint order, to be written.
            pub fn as_mut_slice(&mut self) -> &mut [f64] {
                self.0.as_mut_slice()
            }

            /// The number of joints.
            pub fn len(&self) -> usize {
                self.0.len()
            }

            /// Whether the robot has no joint that moves.
            pub fn is_empty(&self) -> bool {
                self.0.is_empty()
            }

            /// The values as a column vector, shape `(n)`.
            pub fn vector(&self) -> &DVector<f64> {
                &self.0
            }
        }

        impl From<DVector<f64>> for $name {
            fn from(values: DVector<f64>) -> Self {
                Self(values)
            }
        }
    };
}

joint_vector! {
    /// Joint positions `q`, shape `(n)`, \[rad\] or \[m\] by joint type.
    JointPositions
}
joint_vector! {
    /// Joint velocities `qd`, shape `(n)`, \[rad/s\] or \[m/s\].
    JointVelocities
}
joint_vector! {
    /// Joint accelerations `qdd`, shape `(n)`, \[rad/s²\] or \[m/s²\].
    JointAccelerations
}
joint_vector! {
    /// Joint efforts `tau`, shape `(n)`, \[N m\] or \[N\].
    JointEfforts
}
