//! The likely cause of a divergence: a servo beyond its sampled-data limit, or a feedback that overshoots more at every call.

use crate::control::sampled_loop::{SampledLoop, sampled_loop};
use crate::run::DivergenceKind;
use crate::run::Setup;
use crate::trace::Trace;

/// With joint rates below this an arm counts as still under control \[rad/s or m/s\].
const CALM_RATE: f64 = 10.0;
/// The feedback is blamed if this many consecutive calls reverse the command, each with a larger amplitude than the one before. The
/// number is small because a strong feedback diverges within a few calls.
const TURNS: usize = 2;

/// Why a run diverged, as far as it can be computed.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The servo's gains are too high for its sampling period.
    ServoGains(SampledLoop),
    /// The servo's integral gains: without them the loop would be stable.
    ServoIntegral(SampledLoop),
    /// The controller's own feedback reverses its command at every call, with a growing amplitude.
    Feedback {
        /// Index of the joint in `q` whose command reverses most.
        joint: usize,
        /// Number of consecutive calls that reversed it, up to the end of the run.
        calls: usize,
    },
}

/// The likely cause of the divergence `what` in a run of `setup` recorded as `trace`; `None` if nothing computed here explains it.
///
/// [`sampled_loop()`] examines the servo at the start of the run and at the last configuration with low joint rates.
pub fn likely_cause(setup: &Setup<'_>, what: &DivergenceKind, trace: &Trace) -> Option<Cause> {
    if matches!(
        what,
        DivergenceKind::BodyRunaway { .. } | DivergenceKind::InContact { .. }
    ) {
        return None;
    }
    let calm = |tick: &usize| trace.qd.at(*tick).iter().all(|rate| rate.abs() < CALM_RATE);
    let last_calm = (0..trace.len()).rev().find(calm);
    let configurations = [
        last_calm.map(|tick| trace.q.at(tick).to_vec()),
        Some(setup.start_q.clone()),
    ];
    for q in configurations.iter().flatten() {
        let looked_at = sampled_loop(
            setup.robot,
            &setup.servo,
            setup.periods.servo_s(),
            &setup.gravity_m_s2,
            q,
        );
        if let Some(found) = &looked_at
            && !found.is_stable()
            && found.stable_share_of_all.is_none()
        {
            let mut settings = setup.servo.clone();
            settings.gains.iter_mut().for_each(|gains| gains.ki = 0.0);
            let servo_s = setup.periods.servo_s();
            let without = sampled_loop(setup.robot, &settings, servo_s, &setup.gravity_m_s2, q);
            if without.is_some_and(|without| without.is_stable()) {
                return Some(Cause::ServoIntegral(found.clone()));
            }
        }
        // gains too low to hold an upright arm make the loop unstable too, and lowering them does not help
        if let Some(found) = looked_at
            && !found.is_stable()
            && (found.stable_share.is_some()
                || found.stable_share_of_all.is_some()
                || found.stable_period_s.is_some())
        {
            return Some(Cause::ServoGains(found));
        }
    }
    feedback(setup, trace)
}

/// A command that reverses at every call with growing amplitude, up to the end of the run.
fn feedback(setup: &Setup<'_>, trace: &Trace) -> Option<Cause> {
    let stride = setup.periods.ticks_per_control.get() as usize;
    let calls = trace.len().div_ceil(stride);
    let command = |call: usize, joint: usize| trace.command.at(call * stride)[joint];
    let turns = |joint: usize| {
        let step = |call: usize| command(call, joint) - command(call - 1, joint);
        (2..calls)
            .rev()
            .take_while(|&call| {
                step(call) * step(call - 1) < 0.0 && step(call).abs() > step(call - 1).abs()
            })
            .count()
    };
    let worst = (0..setup.robot.n()).map(|joint| (joint, turns(joint)));
    let (joint, calls) = worst.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    (calls >= TURNS).then_some(Cause::Feedback { joint, calls })
}
