//! One joint while all others are held: what a linear prediction of its motion needs.

use crate::dynamics::driven_mass_matrix;
use crate::joint_space::JointPositions;
use crate::kinematics::closure::independent_motions;
use crate::model::robot::Robot;

/// The inertia and the damping that one drive feels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointAlone {
    /// Inertia about the joint, or mass along it, with armature and joints that follow \[kg m² or kg\].
    pub inertia: f64,
    /// Viscous damping \[N m s/rad or N s/m\].
    pub damping: f64,
}

impl JointAlone {
    /// Joint `joint` of `q`, an independent one, at the closed configuration `q` of shape `(n)`.
    ///
    /// `None` where `joint` is dependent or moves no inertia, and where the loops are singular.
    ///
    /// # Panics
    /// If `q` does not have the shape of the robot.
    pub fn new(robot: &Robot, q: &[f64], joint: usize) -> Option<Self> {
        let entry = robot.independent().iter().position(|i| *i == joint)?;
        let mass = driven_mass_matrix(robot, &JointPositions::new(q.iter().copied())).ok()?;
        let motions = independent_motions(robot, q).ok()?;
        let along = motions.column(entry);
        let viscous = robot.bodies().iter().map(|body| {
            let rate = body.gear * along[body.q_index];
            body.damping * rate * rate
        });
        let alone = Self {
            inertia: mass[(entry, entry)],
            damping: viscous.sum(),
        };
        (alone.inertia > 0.0 && alone.inertia.is_finite()).then_some(alone)
    }
}
