//! The likely cause of a divergence: a servo beyond its sampled-data limit, a feedback that overshoots more at every call or drives a
//! joint on, damping that is stiff for the physics step, or motion that is too fast for it.

use crate::control::Mode;
use crate::control::sampled_loop::{SampledLoop, sampled_loop};
use crate::run::DivergenceKind;
use crate::run::Setup;
use crate::step::stiffest_joint;
use crate::text::number::trimmed;
use crate::ticks::Periods;
use crate::trace::Trace;
use crate::watch::Names;

/// With joint rates below this an arm counts as still under control \[rad/s or m/s\].
const CALM_RATE: f64 = 10.0;
/// The feedback is blamed if this many consecutive calls reverse the command, each with a larger amplitude than the one before. The
/// number is small because a strong feedback diverges within a few calls.
const TURNS: usize = 2;
/// Commanded efforts are blamed if they drove the robot on in this share of the calls since it was last calm, of at least so many.
const DRIVEN_SHARE: f64 = 0.8;
const DRIVEN_CALLS: usize = 3;
/// The step is blamed if a joint moves by this much in the last one \[rad or m\]: Runge-Kutta is then off by 1e-4 of its speed a step.
const LONG_STEP: f64 = 0.3;

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
    /// The efforts that the controller commands drive the robot on in the direction in which it moves.
    DrivesOn {
        /// Index of the joint in `q` that gets most power.
        joint: usize,
        /// Number of calls that did so ...
        driving: usize,
        /// ... of so many since the robot was last calm.
        calls: usize,
    },
    /// Viscous damping is stiff for the step.
    StiffDamping {
        /// Index of the joint in `q` whose damping brakes it fastest.
        joint: usize,
        /// Its damping by the inertia that it feels, times the step: how often it is braked within a step, a ratio.
        per_step: f64,
    },
    /// The step is too long for the motion.
    LongStep {
        /// Index of the fastest joint in `q`.
        joint: usize,
        /// How far it moves in one step \[rad or m\].
        per_step: f64,
    },
}

impl Cause {
    /// The cause as a clause, with the names and the periods of the run.
    pub fn clause(&self, names: &Names<'_>, periods: &Periods) -> String {
        let (servo_ms, step_ms) = (
            trimmed(periods.servo_s() * 1e3, 4),
            trimmed(periods.step_s * 1e3, 4),
        );
        match self {
            Self::ServoGains(servo) => servo_clause(servo, names, &servo_ms),
            Self::ServoIntegral(servo) => format!(
                "sampled every {servo_ms} ms, its servo makes each error {} times as large from sample to sample, most of all at `{}`, and without its integral gains it would not",
                trimmed(servo.spectral_radius, 4),
                names.joint(servo.worst_joint)
            ),
            Self::Feedback { joint, calls } => format!(
                "the command of `{}` turned round at each of the last {calls} calls of `control`, further each time",
                names.joint(*joint)
            ),
            Self::DrivesOn {
                joint,
                driving,
                calls,
            } => format!(
                "the efforts of {driving} of the last {calls} calls of `control` drove the robot on in the direction in which it moved, most of all `{}`, as a feedback with the wrong sign does",
                names.joint(*joint)
            ),
            Self::StiffDamping { joint, per_step } => format!(
                "the damping of `{}` is stiff for the physics step of {step_ms} ms: damping by inertia, times the step, is {}",
                names.joint(*joint),
                trimmed(*per_step, 3)
            ),
            Self::LongStep { joint, per_step } => format!(
                "the physics step of {step_ms} ms is too long for the motion of `{}`, which moves by {} {} in a step",
                names.joint(*joint),
                trimmed(*per_step, 3),
                names.joint_unit(*joint)
            ),
        }
    }
}

fn servo_clause(servo: &SampledLoop, names: &Names<'_>, servo_ms: &str) -> String {
    let mut text = format!(
        "sampled every {servo_ms} ms, its servo makes each error {} times as large from sample to sample, most of all at `{}`",
        trimmed(servo.spectral_radius, 3),
        names.joint(servo.worst_joint)
    );
    let percent = |share: f64| format!("{} %", trimmed(100.0 * share, 2));
    let mut ways = Vec::new();
    if let Some(share) = servo.stable_share.filter(|share| *share < 1.0) {
        let joint = names.joint(servo.worst_joint);
        ways.push(format!("{} of the gains of `{joint}`", percent(share)));
    } else if let Some(share) = servo.stable_share_of_all.filter(|share| *share < 1.0) {
        ways.push(format!("{} of all its gains", percent(share)));
    }
    if let Some(period_s) = servo.stable_period_s.filter(|period| period.is_finite()) {
        ways.push(format!("a period of {} ms", trimmed(1e3 * period_s, 3)));
    }
    if !ways.is_empty() {
        text += &format!("; it is stable with at most {}", ways.join(", or "));
    }
    text
}

/// The likely cause of the divergence `what` in a run of `setup` recorded as `trace`; `None` if nothing computed here explains it.
///
/// [`sampled_loop()`] examines the servo at the start of the run and at the last configuration with low joint rates.
pub fn likely_cause(setup: &Setup<'_>, what: &DivergenceKind, trace: &Trace) -> Option<Cause> {
    if is_of_bodies(what) {
        return None;
    }
    let state = |tick: usize| (trace.q.at(tick), trace.qd.at(tick));
    let calm_at = (0..trace.len()).rev().find(|&at| is_calm(trace.qd.at(at)));
    let last_calm = calm_at.map(state);
    servo(setup, last_calm.map(|(q, _)| q))
        .or_else(|| drives_on(setup, trace, calm_at))
        .or_else(|| feedback(setup, trace))
        .or_else(|| motion(setup, state(trace.len().checked_sub(1)?), last_calm))
}

/// As [`likely_cause`], for a run whose commands do not depend on it: from the last state before it diverged, and the last with low joint
/// rates; positions and velocities of shape `(n)`.
pub fn likely_cause_without_feedback(
    setup: &Setup<'_>,
    what: &DivergenceKind,
    last: (&[f64], &[f64]),
    last_calm: Option<(&[f64], &[f64])>,
) -> Option<Cause> {
    if is_of_bodies(what) {
        return None;
    }
    servo(setup, last_calm.map(|(q, _)| q)).or_else(|| motion(setup, last, last_calm))
}

/// Whether joints with these rates count as still under control.
pub fn is_calm(qd: &[f64]) -> bool {
    qd.iter().all(|rate| rate.abs() < CALM_RATE)
}

/// Whether bodies of a scene diverged, or contact.
fn is_of_bodies(what: &DivergenceKind) -> bool {
    matches!(
        what,
        DivergenceKind::BodyRunaway { .. } | DivergenceKind::InContact { .. }
    )
}

/// A servo that is unstable at `last_calm` or at the start.
fn servo(setup: &Setup<'_>, last_calm: Option<&[f64]>) -> Option<Cause> {
    let configurations = [last_calm, Some(setup.start_q.as_slice())];
    for q in configurations.into_iter().flatten() {
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
    None
}

/// What the physics step does not resolve: motion that is too fast for it while rates are low, damping, or the motion at the end.
fn motion(
    setup: &Setup<'_>,
    last: (&[f64], &[f64]),
    last_calm: Option<(&[f64], &[f64])>,
) -> Option<Cause> {
    let step_s = setup.periods.step_s;
    let fastest = |(_, qd): (&[f64], &[f64])| {
        let moved = qd.iter().map(|rate| rate.abs() * step_s).enumerate();
        let (joint, per_step) = moved.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
        (per_step >= LONG_STEP).then_some(Cause::LongStep { joint, per_step })
    };
    let damping = |(q, _): (&[f64], &[f64])| {
        let (joint, per_step) = stiffest_joint(setup.robot, step_s, q)?;
        Some(Cause::StiffDamping { joint, per_step })
    };
    last_calm
        .and_then(fastest)
        .or_else(|| damping(last_calm.unwrap_or(last)))
        .or_else(|| fastest(last))
}

/// Commanded efforts that drive the robot on in most calls since it was last calm.
///
/// A feedback that is only too strong brakes at the moment of each call, and overshoots until the next.
fn drives_on(setup: &Setup<'_>, trace: &Trace, last_calm: Option<usize>) -> Option<Cause> {
    if setup.servo.mode != Mode::Effort {
        return None;
    }
    let stride = setup.periods.ticks_per_control.get() as usize;
    let end = trace.len().div_ceil(stride);
    let first = last_calm.map_or(0, |tick| tick.div_ceil(stride));
    // a gain that is far too high needs a few calls from calm to the end
    let first = first.min(end.saturating_sub(DRIVEN_CALLS));
    let power = |call: usize, joint: usize| {
        let tick = call * stride;
        trace.command.at(tick)[joint] * trace.qd.at(tick)[joint]
    };
    let joints = 0..setup.robot.n();
    // a call at rest drives nothing
    let moves = |call: &usize| joints.clone().any(|joint| power(*call, joint) != 0.0);
    let calls: Vec<usize> = (first..end).filter(moves).collect();
    let drives = |call: &usize| joints.clone().map(|joint| power(*call, joint)).sum::<f64>() > 0.0;
    let driving = calls.iter().filter(|call| drives(call)).count();
    if calls.len() < DRIVEN_CALLS || (driving as f64) < DRIVEN_SHARE * calls.len() as f64 {
        return None;
    }
    let sums = joints.map(|joint| {
        (
            joint,
            calls.iter().map(|call| power(*call, joint)).sum::<f64>(),
        )
    });
    let (joint, _) = sums.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    Some(Cause::DrivesOn {
        joint,
        driving,
        calls: calls.len(),
    })
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
