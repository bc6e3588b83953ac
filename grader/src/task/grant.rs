//! Functions of `robot` that a task may grant to a submission.

use serde::{Deserialize, Serialize};

/// A function of `robot` that a task may grant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Grant {
    /// `robot.fk(q)`: position of the TCP in the lab's frame, shape `(3)` \[m\].
    Fk,
    /// `robot.jacobian(q)`: derivative of that by `q`, shape `(3, n)` \[m/rad or m/m\].
    Jacobian,
    /// `robot.gravity(q)`: efforts that hold the arm still at `q`, shape `(n)` \[N m or N\].
    Gravity,
    /// `robot.mass_matrix(q)`: the joint-space inertia, shape `(n, n)` \[kg m², kg m or kg\].
    MassMatrix,
}

impl Grant {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Fk, Self::Jacobian, Self::Gravity, Self::MassMatrix];

    /// Its name in labs and submissions.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fk => "fk",
            Self::Jacobian => "jacobian",
            Self::Gravity => "gravity",
            Self::MassMatrix => "mass_matrix",
        }
    }
}
