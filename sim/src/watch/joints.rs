//! Joints at their limits of effort, position and speed. A joint that returns to a limit within 0.1 s makes no new event.

use super::event::EventKind;
use crate::run::{Row, Setup};
use crate::step::drives::SpeedLimits;

/// A joint that was away from a limit for longer than this makes a new event when it returns \[s\].
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

    pub(super) fn observe(&mut self, row: &Row<'_>, emit: &mut impl FnMut(u64, EventKind)) {
        let standing = row.scene.map_or(&[][..], |scene| &scene.report().at_limit);
        for joint in 0..row.q.len() {
            let (lower, upper) = self.ranges[joint];
            let limit = self.effort_limits[joint];
            let now = [
                // an effort limit of zero means a joint without a drive
                limit > 0.0 && row.effort[joint].abs() >= limit,
                row.q[joint] <= lower || row.q[joint] >= upper || standing.contains(&joint),
                self.speed_limits.is_reached(joint, row.qd[joint]),
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
                    emit(row.tick, kind);
                }
                *last = Some(row.tick);
            }
        }
    }
}
