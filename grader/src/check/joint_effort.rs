//! The effort of one joint, or of the joint with the greatest, as a statistic of a run: what several kinds share.

use kinemark_sim::model::robot::Robot;

use super::facts::MotionFacts;
use crate::task::joint_units::JointUnits;
use crate::task::model::Band;

/// The joint that a check looks at, and the band of its effort.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointEffort {
    /// Index in `q`; the worst of all joints where there is none.
    pub(super) joint: Option<usize>,
    /// Effort \[N m or N\].
    pub(super) band: Band,
}

impl JointEffort {
    /// The band, with the unit of the joint's effort, or of all joints'.
    pub(super) fn band(&self, robot: &Robot) -> (Band, &'static str) {
        let units = match self.joint {
            Some(joint) => JointUnits::of(robot, joint),
            None => JointUnits::of_all(robot),
        };
        (self.band, units.effort())
    }
}

/// The efforts of a joint that were applied, tick by tick \[N m or N\].
pub(super) fn applied(facts: &MotionFacts<'_>, joint: usize) -> Vec<f64> {
    let efforts = facts.trace.effort.component(joint);
    efforts.take(facts.applied_ticks()).collect()
}
