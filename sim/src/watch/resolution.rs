//! Motion that the physics step does not resolve, and servos whose period is too long for their gains.
//!
//! **The step.** The error that a step makes in each velocity is estimated by doing it again in halves, but only where motion is fast
//! for the step: where a joint turns by [`TURN`] or speeds up by [`KICK`] in it. (In a step with contact or at a joint limit there is
//! no such order, so nothing is estimated; in one that takes damping implicitly, errors of what damping brakes die out, and only fast
//! turning counts.) The errors of a joint add up over the run. Once their sum is [`SHARE`] of the joint's greatest speed so far, the
//! event is reported, once for each joint.
//!
//! Running at `φ = |q̇| h`, Runge-Kutta of order four loses `φ⁶/72` of the energy of a rotation in a step and is `φ⁵/120` behind. At
//! [`TURN`] that is 1e-8 and 8e-8: below it, a minute of 1 ms steps stays under [`SHARE`].
//!
//! **The servo.** At the start, the sampled loop of servo and robot is unstable there, and would be stable at a shorter servo period
//! ([`sampled_loop`]). Its cost grows with the third power of the joints, so robots of more than [`MOST_JOINTS`] are left out.

use super::event::{EventKind, Unresolved};
use crate::control::sampled_loop::{is_sampled_loop_stable, sampled_loop};
use crate::model::air::AirNow;
use crate::run::{Row, Setup};
use crate::step::hybrid::{HybridStep, StateFrom};
use crate::step::local_error::LocalError;

/// The servos of robots with more independent joints are not looked at.
const MOST_JOINTS: usize = 12;
/// Joints slower than this are not looked at \[rad or m a step\].
const TURN: f64 = 0.1;
/// Nor are those that speed up less \[rad or m a step, each step\].
const KICK: f64 = 1e-3;
/// The share of a joint's greatest speed that its errors may add up to.
const SHARE: f64 = 0.01;
/// Slower joints are measured by this speed \[rad or m a step\], so that a joint at rest is not measured by its noise.
const SLOWEST: f64 = 1e-3;

/// Watches a run for what its periods do not resolve; a part of [`Watch`](super::Watch), for those who need nothing else.
#[derive(Debug, Clone)]
pub struct ResolutionWatch<'a> {
    setup: Setup<'a>,
    error: LocalError,
    /// The row before; empty before the first.
    before: Before,
    joints: Vec<JointErrors>,
}

#[derive(Debug, Clone, Copy)]
struct JointErrors {
    /// The greatest speed so far \[rad or m a step\].
    greatest: f64,
    /// The sum of the errors of the speed so far \[rad or m a step\].
    errors: f64,
    is_reported: bool,
}

#[derive(Debug, Clone, Default)]
struct Before {
    q: Vec<f64>,
    qd: Vec<f64>,
    effort: Vec<f64>,
}

impl<'a> ResolutionWatch<'a> {
    /// A watch for a run of `setup`, before its first row.
    pub fn new(setup: &Setup<'a>) -> Self {
        let step_s = setup.periods.step_s;
        let still = JointErrors {
            greatest: SLOWEST,
            errors: 0.0,
            is_reported: false,
        };
        Self {
            error: LocalError::new(setup.robot, setup.gravity_m_s2, step_s),
            before: Before::default(),
            joints: vec![still; setup.robot.n()],
            setup: setup.clone(),
        }
    }

    /// Takes one tick and gives `emit` its events; ticks come in order and none is left out.
    pub fn observe(&mut self, row: &Row<'_>, emit: &mut impl FnMut(u64, EventKind)) {
        if self.setup.laws.is_some() {
            // nothing is integrated
            return;
        }
        if row.tick == 0 {
            self.look_at_servo(emit);
        } else if self.is_fast(row) && is_smooth(row.scene) {
            self.add_error(row, emit);
        }
        let before = &mut self.before;
        for (kept, new) in [
            (&mut before.q, row.q),
            (&mut before.qd, row.qd),
            (&mut before.effort, row.effort),
        ] {
            kept.clear();
            kept.extend_from_slice(new);
        }
    }

    fn look_at_servo(&self, emit: &mut impl FnMut(u64, EventKind)) {
        let setup = &self.setup;
        let servo_s = setup.periods.servo_s();
        let (robot, gravity) = (setup.robot, &setup.gravity_m_s2);
        let (servo, q) = (&setup.servo, &setup.start_q);
        let is_unstable = robot.independent().len() <= MOST_JOINTS
            && is_sampled_loop_stable(robot, servo, servo_s, gravity, q) == Some(false);
        if is_unstable
            && let Some(found) = sampled_loop(robot, servo, servo_s, gravity, q)
            && let Some(stable_s) = found.stable_period_s
        {
            let why = Unresolved::ServoPeriod { stable_s };
            let joint = found.worst_joint;
            emit(0, EventKind::UnderResolved { joint, why });
        }
    }

    /// Whether the step that ended at `row` moved a joint fast; keeps the greatest speeds.
    fn is_fast(&mut self, row: &Row<'_>) -> bool {
        let step_s = self.setup.periods.step_s;
        let mut is_fast = false;
        let rates = row.qd.iter().zip(&self.before.qd);
        for ((now, before), joint) in rates.zip(&mut self.joints) {
            let turn = before.abs() * step_s;
            joint.greatest = joint.greatest.max(turn);
            is_fast |= turn >= TURN || (now - before).abs() * step_s >= KICK;
        }
        is_fast
    }

    fn add_error(&mut self, row: &Row<'_>, emit: &mut impl FnMut(u64, EventKind)) {
        let (robot, step_s) = (self.setup.robot, self.setup.periods.step_s);
        let Before { q, qd, effort } = &self.before;
        let is_turning = qd.iter().any(|rate| rate.abs() * step_s >= TURN);
        if !is_turning && self.error.is_implicit(robot, q) {
            return;
        }
        let air: Option<AirNow> = row
            .scene
            .and_then(|scene| scene.air_of_last_step().copied());
        let pushes = self.setup.pushes.iter();
        let pushes = pushes.filter(|push| push.acts_at(row.tick - 1));
        self.error.set_forces(robot, air, pushes);
        // a joint that moves no inertia ends the run
        let Ok(errors) = self.error.velocities(robot, effort, (q, qd)) else {
            return;
        };
        for (joint, (error, kept)) in errors.zip(&mut self.joints).enumerate() {
            kept.errors += error.abs() * step_s;
            let is_resolved = kept.errors <= SHARE * kept.greatest;
            if !is_resolved && !kept.is_reported {
                kept.is_reported = true;
                let why = Unresolved::Step;
                emit(row.tick, EventKind::UnderResolved { joint, why });
            }
        }
    }
}

/// Whether the last step was smooth motion alone.
fn is_smooth(scene: Option<&HybridStep>) -> bool {
    scene.is_none_or(|scene| {
        let report = scene.report();
        report.state_from == StateFrom::Smooth && report.stops.is_empty()
    })
}
