//! The analysis: for each value of the sweep the run, the linear theory, the measures of both, and the limits of stability.

use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::control::step_metrics::{SETTLED, StepCurve, final_value};
use kinemark_sim::model::robot::Robot;

use super::linear_theory::LinearTheory;
use super::response_run::{RunCurves, run_step};
use super::settings::{FINAL_S, ResponseError, ResponseSettings};
use super::stability_limit::{StabilityLimit, stability_limit};
use super::sweep::{Sweep, Varied};

/// Settling is to this share of the step.
const WITHIN: f64 = 0.02;

/// Why a response has no rise, overshoot and settling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoMeasure {
    /// Its numbers end before the run does.
    Diverged,
    /// It hardly moved, or not towards its command.
    HardlyMoved,
    /// In the last part it still goes further than 5 % of its step from its mean.
    Unsettled,
}

/// What is measured of a step response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The first value, just after the step.
    pub at_once: f64,
    /// The mean over the last 0.2 s; none where the response diverged.
    pub final_value: Option<f64>,
    /// The last value.
    pub last_value: f64,
    /// The value that is furthest in the direction of the step.
    pub peak: f64,
    /// The final value less the command.
    pub beyond_command: Option<f64>,
    /// Time from 10 % to 90 % of the step from start to final value \[s\].
    pub rise_s: Option<f64>,
    /// Last time at which the response is more than 2 % of its step from its final value \[s\].
    pub settling_s: Option<f64>,
    /// How far it goes beyond its final value, as a fraction of its step.
    pub overshoot: Option<f64>,
    /// Why some of these are missing.
    pub missing: Option<NoMeasure>,
}

impl Measured {
    /// The measures of `values`, which are `interval_s` apart and begin just after the step from `start` to `command`.
    pub(super) fn of(
        values: &[f64],
        interval_s: f64,
        start: f64,
        command: f64,
        final_s: f64,
    ) -> Self {
        let count = (final_s / interval_s).round().max(1.0) as usize;
        let curve = StepCurve {
            values,
            start,
            end: final_value(values, count),
        };
        let first_of_last = values.len().saturating_sub(1 + count);
        let outside = |tolerance: f64| {
            let last = curve.last_outside(tolerance);
            last.is_some_and(|at| at >= first_of_last)
        };
        let step = curve.step().abs();
        let missing = if !curve.end.is_finite() {
            Some(NoMeasure::Diverged)
        } else if !curve.has_moved(Some(command)) {
            Some(NoMeasure::HardlyMoved)
        } else if outside(SETTLED * step) {
            Some(NoMeasure::Unsettled)
        } else {
            None
        };
        let is_measured = missing.is_none();
        let rise = curve.passes([0.1, 0.9]).filter(|_| is_measured);
        let settles = is_measured && !outside(WITHIN * step);
        let (over, _) = curve.overshoot();
        let sign = if command < start { -1.0 } else { 1.0 };
        let furthest = values.iter().map(|value| sign * value);
        Self {
            at_once: values.first().copied().unwrap_or(start),
            final_value: Some(curve.end).filter(|end| end.is_finite()),
            last_value: values.last().copied().unwrap_or(start),
            peak: sign * furthest.fold(f64::NEG_INFINITY, f64::max),
            beyond_command: Some(curve.end - command).filter(|beyond| beyond.is_finite()),
            rise_s: rise.map(|[from, to]| (to - from) * interval_s),
            settling_s: settles.then(|| curve.settled_at(WITHIN * step) * interval_s),
            overshoot: is_measured.then_some(over),
            missing,
        }
    }

    /// Of a response that ended early: nothing but its first and last value and its peak.
    fn cut_short(self) -> Self {
        Self {
            final_value: None,
            beyond_command: None,
            rise_s: None,
            settling_s: None,
            overshoot: None,
            missing: Some(NoMeasure::Diverged),
            ..self
        }
    }
}

/// The response with one value of the sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// The settings, with the value in them.
    pub settings: ResponseSettings,
    /// The value, where there is a sweep.
    pub value: Option<f64>,
    /// The signal before the step.
    pub start: f64,
    /// The signal that is commanded.
    pub command: f64,
    /// The run.
    pub run: RunCurves,
    /// What is measured of the run.
    pub measured: Measured,
    /// The linear theory, where there is one.
    pub theory: Option<LinearTheory>,
    /// The limits of stability, where they can be computed.
    pub stability: Option<StabilityLimit>,
}

/// All responses, and what their numbers are called.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The robot's name.
    pub robot: String,
    /// The names of its joints, in the order of `q`.
    pub joints: Vec<String>,
    /// Whether each of them is revolute.
    pub revolute: Vec<bool>,
    /// The settings without the sweep.
    pub settings: ResponseSettings,
    /// What the sweep varies.
    pub varied: Option<Varied>,
    /// One response for each value; one in all without a sweep.
    pub responses: Vec<Response>,
}

impl Analysis {
    /// The name of the joint that gets the step.
    pub fn joint(&self) -> &str {
        &self.joints[self.settings.joint]
    }

    /// The unit of the signal of a joint.
    pub fn unit(&self, joint: usize) -> &'static str {
        match (self.settings.fed, self.revolute[joint]) {
            (Fed::Position, true) => "rad",
            (Fed::Position, false) => "m",
            (Fed::Velocity, true) => "rad/s",
            (Fed::Velocity, false) => "m/s",
        }
    }

    /// The unit of the effort of the joint that gets the step.
    pub fn effort_unit(&self) -> &'static str {
        if self.revolute[self.settings.joint] {
            "N m"
        } else {
            "N"
        }
    }

    /// The value of the sweep in words; none without a sweep.
    pub fn label(&self, response: &Response) -> Option<String> {
        Some(self.varied?.with_value(response.value?))
    }
}

/// Analyses a step, or one for each value of a sweep.
///
/// # Errors
/// [`ResponseError`]: settings that do not fit the robot or each other, or a robot that cannot run.
pub fn analyse(
    robot: &Robot,
    settings: &ResponseSettings,
    sweep: Option<&Sweep>,
) -> Result<Analysis, ResponseError> {
    let responses = match sweep {
        None => vec![respond(robot, settings.clone(), None)?],
        Some(sweep) => {
            let values = sweep.values.iter();
            let each =
                values.map(|&value| respond(robot, sweep.applied(settings, value), Some(value)));
            each.collect::<Result<_, _>>()?
        }
    };
    Ok(Analysis {
        robot: robot.name().to_owned(),
        joints: robot
            .moving_joints()
            .map(|joint| joint.name.clone())
            .collect(),
        revolute: robot
            .moving_joints()
            .map(|joint| joint.kind.turns())
            .collect(),
        settings: settings.clone(),
        varied: sweep.map(|sweep| sweep.varied),
        responses,
    })
}

fn respond(
    robot: &Robot,
    settings: ResponseSettings,
    value: Option<f64>,
) -> Result<Response, ResponseError> {
    settings.check(robot)?;
    let start_q = settings.start_q(robot)?;
    let mut there = robot
        .clone()
        .with_more_friction(settings.surroundings.dry_friction);
    if let Some(drag) = settings.surroundings.drag {
        there = there.with_drag(drag);
    }
    let run = run_step(&there, &settings, &start_q)?;
    let start = match settings.fed {
        Fed::Position => start_q[settings.joint],
        Fed::Velocity => 0.0,
    };
    let command = start + settings.step;
    let measured = Measured::of(&run.values, run.step_s, start, command, FINAL_S);
    let measured = match run.divergence {
        Some(_) => measured.cut_short(),
        None => measured,
    };
    let steps = (settings.duration_s / run.step_s).round() as usize;
    let theory = LinearTheory::new(robot, &settings, &start_q, (start, steps, run.step_s));
    let stability = stability_limit(robot, &settings, &start_q)?;
    Ok(Response {
        settings,
        value,
        start,
        command,
        run,
        measured,
        theory,
        stability,
    })
}
