//! Joints at their limits: of effort, of position and of speed.

use crate::control::speed_limit::SpeedLimits;
use crate::event::EventKind;
use crate::run::{Row, Setup};

#[derive(Debug, Clone)]
pub(super) struct JointWatch {
    effort_limits: Vec<f64>,
    ranges: Vec<(f64, f64)>,
    saturated: Vec<bool>,
    at_limit: Vec<bool>,
    speed_limits: SpeedLimits,
    fast: Vec<bool>,
}

impl JointWatch {
    pub(super) fn new(setup: &Setup<'_>) -> Self {
        let n = setup.robot.n();
        let range = |joint: &crate::robot::Joint| {
            (
                joint.limits.lower.unwrap_or(f64::NEG_INFINITY),
                joint.limits.upper.unwrap_or(f64::INFINITY),
            )
        };
        Self {
            effort_limits: setup.servo.gains.iter().map(|g| g.effort_limit).collect(),
            ranges: setup.robot.moving_joints().map(range).collect(),
            saturated: vec![false; n],
            at_limit: vec![false; n],
            speed_limits: SpeedLimits::new(setup.robot),
            fast: vec![false; n],
        }
    }

    pub(super) fn see(&mut self, row: &Row<'_>, tell: &mut impl FnMut(u64, EventKind)) {
        let standing = row.scene.map_or(&[][..], |scene| &scene.report().at_limit);
        for joint in 0..row.q.len() {
            let saturated = row.effort[joint].abs() >= self.effort_limits[joint];
            if saturated && !self.saturated[joint] {
                tell(row.tick, EventKind::Saturated { joint });
            }
            self.saturated[joint] = saturated;
            let (lower, upper) = self.ranges[joint];
            let at_limit =
                row.q[joint] <= lower || row.q[joint] >= upper || standing.contains(&joint);
            if at_limit && !self.at_limit[joint] {
                tell(row.tick, EventKind::LimitHit { joint });
            }
            self.at_limit[joint] = at_limit;
            let fast = row.scene.is_some() && self.speed_limits.is_reached(joint, row.qd[joint]);
            if fast && !self.fast[joint] {
                tell(row.tick, EventKind::SpeedLimitHit { joint });
            }
            self.fast[joint] = fast;
        }
    }
}
