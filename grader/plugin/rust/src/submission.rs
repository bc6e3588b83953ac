//! The trait that a submission implements.

use crate::{Observation, Robot, Rows};

/// Ends the build where `export!` names a function that is not defined: only then is this one compiled for a type.
macro_rules! undefined {
    ($name:literal) => {
        const {
            // true of every type, and not known before there is one
            assert!(
                size_of::<Self>() == usize::MAX,
                concat!(
                    "`export!` names `",
                    $name,
                    "`, and `impl Submission` does not define it"
                )
            );
        }
    };
}

/// The functions of a submission, for a type that keeps the state of a run: define those that your lab names, and name them in
/// [`export!`](crate::export).
///
/// A run has one value of the type, made with [`Default`] before the first call; so has every case of a function task.
///
/// A function of the lab's own is a method that the type itself has, outside of this trait:
///
/// ```
/// use kinemark_plugin::{Answer, Map, Submission, export};
///
/// #[derive(Default)]
/// struct Motor;
///
/// impl Submission for Motor {}
///
/// impl Motor {
///     fn time_constant(&mut self, given: &Map, answer: &mut Answer) {
///         answer.number("seconds", given.number("inertia") / given.number("damping"));
///     }
/// }
///
/// export!(Motor: own time_constant);
/// ```
pub trait Submission: Default {
    /// Called once before the first [`control`](Self::control) of a run. It is called whether `export!` names it or not.
    fn init(&mut self, robot: &Robot, task: &str) {
        let _ = (robot, task);
    }

    /// Called every control period: writes a command for each of the `n` joints in the task's mode, \[rad or m\], \[rad/s or m/s\] or
    /// \[N m or N\]. A number that is not written is NaN, which is no valid command.
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let _ = (observation, command);
        undefined!("control");
    }

    /// Returns the position of the TCP in the lab's frame \[m\] at joint positions `q`, shape `(n)` \[rad or m\].
    fn forward_kinematics(&mut self, robot: &Robot, q: &[f64]) -> [f64; 3] {
        let _ = (robot, q);
        undefined!("forward_kinematics");
        [f64::NAN; 3]
    }

    /// Pushes the joint positions \[rad or m\] of every branch that reaches `position`, the TCP's in the lab's frame \[m\]; nothing where
    /// there is none.
    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {
        let _ = (robot, position, branches);
        undefined!("inverse_kinematics");
    }

    /// Pushes the rows of the Jacobian at joint positions `q`, shape `(n)` \[rad or m\]: the rows that the lab names, with a column per
    /// joint.
    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        let _ = (robot, q, rows);
        undefined!("jacobian");
    }
}
