//! Joints at their limits: of effort, of position and of speed. A joint that comes back within a tenth of a second never left.

use super::event::EventKind;
use crate::control::speed_limit::SpeedLimits;
use crate::run::{Row, Setup};

/// A joint that is away from a limit for longer than this arrives there anew \[s\].
const AWAY_S: f64 = 0.1;

#[derive(Debug, Clone)]
pub(super) struct JointWatch {
    away_ticks: u64,
    effort_limits: Vec<f64>,
    ranges: Vec<(f64, f64)>,
    speed_limits: SpeedLimits,
    /// By joint, the last tick at its limit of effort, of position, of speed.
    last: Vec<[Option<u64>; 3]>,
}

impl JointWatch {
    pub(super) fn new(setup: &Setup<'_>) -> Self {
        let range = |joint: &crate::model::robot::Joint| {
            (
                joint.limits.lower.unwrap_or(f64::NEG_INFINITY),
                joint.limits.upper.unwrap_or(f64::INFINITY),
            )
        };
        Self {
            away_ticks: (AWAY_S / setup.periods.step_s).round() as u64,
            effort_limits: setup.servo.gains.iter().map(|g| g.effort_limit).collect(),
            ranges: setup.robot.moving_joints().map(range).collect(),
            speed_limits: SpeedLimits::new(setup.robot),
            last: vec![[None; 3]; setup.robot.n()],
        }
    }

    pub(super) fn see(&mut self, row: &Row<'_>, tell: &mut impl FnMut(u64, EventKind)) {
        let standing = row.scene.map_or(&[][..], |scene| &scene.report().at_limit);
        for joint in 0..row.q.len() {
            let (lower, upper) = self.ranges[joint];
            let limit = self.effort_limits[joint];
            let now = [
                // a limit of zero is a joint without a drive
                limit > 0.0 && row.effort[joint].abs() >= limit,
                row.q[joint] <= lower || row.q[joint] >= upper || standing.contains(&joint),
                row.scene.is_some() && self.speed_limits.is_reached(joint, row.qd[joint]),
            ];
            let kinds = [
                EventKind::Saturated { joint },
                EventKind::LimitHit { joint },
                EventKind::SpeedLimitHit { joint },
            ];
            for ((at_limit, kind), last) in now.into_iter().zip(kinds).zip(&mut self.last[joint]) {
                if !at_limit {
                    continue;
                }
                if last.is_none_or(|last| row.tick - last > self.away_ticks) {
                    tell(row.tick, kind);
                }
                *last = Some(row.tick);
            }
        }
    }
}
