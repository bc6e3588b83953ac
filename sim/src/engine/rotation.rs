//! Free rotation of a rigid body: its orientation after a time without torque, at constant angular momentum.
//!
//! The angular momentum is held exactly, and the orientation follows by a Runge-Kutta method of fourth order on the group of rotations,
//! so that the kinetic energy keeps twelve digits over a second of tumbling.
//!
//! Source: Munthe-Kaas, *Runge-Kutta methods on Lie groups* (1998), with the classical tableau and `dexp⁻¹` up to its second term.

use nalgebra::{Matrix3, Vector3};

use crate::spatial::rotation_exp;

/// Inertia tensor of a rigid body about its centre of mass, in its own axes, and its inverse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tensor {
    pub(super) kg_m2: Matrix3<f64>,
    inverse: Matrix3<f64>,
    /// Whether all directions are alike, so that the angular velocity is constant.
    is_round: bool,
}

impl Tensor {
    /// `None` if `kg_m2` has no inverse.
    pub(super) fn new(kg_m2: Matrix3<f64>) -> Option<Self> {
        let m = kg_m2[(0, 0)];
        Some(Self {
            kg_m2,
            inverse: kg_m2.try_inverse()?,
            is_round: kg_m2 == Matrix3::identity() * m,
        })
    }

    /// The inverse tensor in world axes.
    pub(super) fn inverse_in_world(&self, rotation: &Matrix3<f64>) -> Matrix3<f64> {
        rotation * self.inverse * rotation.transpose()
    }

    /// Angular momentum of the angular velocity `w`, both in world axes.
    pub(super) fn momentum(&self, rotation: &Matrix3<f64>, w: &Vector3<f64>) -> Vector3<f64> {
        rotation * (self.kg_m2 * (rotation.transpose() * w))
    }

    /// Angular velocity at the angular momentum `momentum`, both in world axes.
    pub(super) fn rate(&self, rotation: &Matrix3<f64>, momentum: &Vector3<f64>) -> Vector3<f64> {
        rotation * (self.inverse * (rotation.transpose() * momentum))
    }

    /// The orientation `time_s` after `rotation`, at the constant angular momentum `momentum` (world axes).
    pub(super) fn turned(
        &self,
        rotation: &Matrix3<f64>,
        momentum: &Vector3<f64>,
        time_s: f64,
    ) -> Matrix3<f64> {
        let first = self.rate(rotation, momentum);
        if first == Vector3::zeros() || time_s == 0.0 {
            return *rotation;
        }
        let by = if self.is_round {
            first * time_s
        } else {
            let rate = |u: &Vector3<f64>| {
                let w = self.rate(&(rotation_exp(u) * rotation), momentum);
                let turned = u.cross(&w);
                w - turned * 0.5 + u.cross(&turned) / 12.0
            };
            let second = rate(&(first * (0.5 * time_s)));
            let third = rate(&(second * (0.5 * time_s)));
            let fourth = rate(&(third * time_s));
            (first + (second + third) * 2.0 + fourth) * (time_s / 6.0)
        };
        orthonormal(&(rotation_exp(&by) * rotation))
    }
}

/// The rotation nearest to `m`, which is a rotation but for rounding (one step of Newton's iteration).
pub(super) fn orthonormal(m: &Matrix3<f64>) -> Matrix3<f64> {
    m * (Matrix3::identity() * 1.5 - m.transpose() * m * 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    const H_S: f64 = 1e-3;

    #[test]
    fn a_tumbling_body_keeps_its_energy_and_returns_a_symmetric_one_by_hand() {
        let tensor = Tensor::new(Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, 0.025))).unwrap();
        let mut rotation = rotation_exp(&Vector3::new(0.3, -0.2, 0.9));
        let momentum = tensor.momentum(&rotation, &Vector3::new(0.1, 9.0, 0.2));
        let energy =
            |rotation: &Matrix3<f64>| 0.5 * momentum.dot(&tensor.rate(rotation, &momentum));
        let before = energy(&rotation);
        for _ in 0..20_000 {
            rotation = tensor.turned(&rotation, &momentum, H_S);
        }
        assert!((energy(&rotation) / before - 1.0).abs() < 1e-11);
        assert!((rotation.transpose() * rotation - Matrix3::identity()).norm() < 1e-14);

        // a symmetric top precesses about its momentum with L / I1 and spins about its axis with (1 - I3/I1) L3 / I3
        let (across, along) = (0.02, 0.03);
        let top =
            Tensor::new(Matrix3::from_diagonal(&Vector3::new(across, across, along))).unwrap();
        let momentum = Vector3::new(0.1, 0.0, 0.2);
        let mut rotation = Matrix3::identity();
        for _ in 0..2000 {
            rotation = top.turned(&rotation, &momentum, H_S);
        }
        let precessed = rotation_exp(&(momentum * (2.0 / across)));
        let spun =
            rotation_exp(&(Vector3::z() * (2.0 * momentum.z * (1.0 / along - 1.0 / across))));
        assert!((rotation - precessed * spun).norm() < 1e-9);
    }

    #[test]
    fn what_does_not_turn_keeps_its_bits() {
        let tensor = Tensor::new(Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, 0.025))).unwrap();
        let rotation = rotation_exp(&Vector3::new(0.3, -0.2, 0.9));
        assert_eq!(tensor.turned(&rotation, &Vector3::zeros(), H_S), rotation);
        assert!(Tensor::new(Matrix3::zeros()).is_none());
    }
}
