//! The operation `simulate`: a run under a constant command, sampled.

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::kinematics::closure::loop_gap_m;
use kinemark_sim::run::{self, End, Recorder, Row, Setup};
use kinemark_sim::ticks::{Periods, whole_ratio};
use serde_json::{Map, Value, json};

use super::Refusal;
use super::operation::finite;
use super::request::Fields;
use super::state::names_of;

/// More steps than this take minutes.
const MOST_STEPS: u64 = 100_000_000;
/// More numbers than this do not belong on one line.
const MOST_NUMBERS: u64 = 2_000_000;

/// A start counts as closed below this gap; the first step takes up what is left.
const MOST_GAP_M: f64 = 1e-6;

/// Keeps every `stride`-th row.
struct Sampler {
    stride: u64,
    periods: Periods,
    t_s: Vec<f64>,
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    effort: Vec<Vec<f64>>,
}

impl Recorder for Sampler {
    fn row(&mut self, row: Row<'_>) {
        if row.tick.is_multiple_of(self.stride) {
            self.t_s.push(self.periods.time_s(row.tick));
            self.q.push(row.q.to_vec());
            self.qd.push(row.qd.to_vec());
            self.effort.push(row.effort.to_vec());
        }
    }
}

/// Answers a `simulate` request.
pub(super) fn answer(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let n = robot.n();
    let q0 = fields.positions("q0")?;
    let gap_m = loop_gap_m(robot, q0.as_slice());
    let closed = gap_m <= MOST_GAP_M;
    if !closed {
        return Err(Refusal::new(
            "open-loop",
            format!(
                "`q0` leaves a loop open by {gap_m} m, at most {MOST_GAP_M} m; give the independent joints only ({}), and the \
                 others follow",
                names_of(robot, robot.independent()).join(", ")
            ),
        ));
    }
    let start_qd = fields.velocities("qd0", &q0)?.as_slice().to_vec();
    let start_q = q0.as_slice().to_vec();
    let command = fields.efforts("command")?.as_slice().to_vec();
    let duration_s = fields.positive("duration_s")?;
    let servo_s = fields.positive("servo_period_s")?;
    let step_s = match fields.number("physics_step_s")? {
        // a faster servo needs a step at least as short
        None => servo_s.min(0.001),
        Some(step_s) if step_s > 0.0 => step_s,
        Some(step_s) => {
            return Err(Refusal::new(
                "out-of-range",
                format!("`physics_step_s` must be positive, got {step_s}"),
            ));
        }
    };
    let sample_s = fields.positive("sample_period_s")?;
    let servo = match fields.need("servo")? {
        Value::Object(servo) => servo_of(robot, servo)?,
        _ => return Err(Refusal::new("wrong-type", "`servo` must be an object")),
    };
    let gravity_m_s2 = fields.gravity_m_s2()?;
    fields.finish()?;

    let divides = |longer: &str, longer_s: f64, shorter: &str, shorter_s: f64| {
        whole_ratio(longer_s, shorter_s).ok_or_else(|| {
            Refusal::new(
                "bad-period",
                format!("`{longer}` of {longer_s} s is not a whole number of `{shorter}` of {shorter_s} s"),
            )
        })
    };
    let ticks = divides("duration_s", duration_s, "physics_step_s", step_s)?;
    let stride = divides("sample_period_s", sample_s, "physics_step_s", step_s)?;
    divides("duration_s", duration_s, "sample_period_s", sample_s)?;
    divides("servo_period_s", servo_s, "physics_step_s", step_s)?;
    let periods = Periods::new(step_s, servo_s, servo_s)
        .map_err(|error| Refusal::new("bad-period", error.to_string()))?;
    let numbers = (ticks / stride + 1).saturating_mul(3 * n as u64 + 1);
    if ticks > MOST_STEPS || numbers > MOST_NUMBERS {
        return Err(Refusal::new(
            "too-large",
            format!("{ticks} steps and {numbers} numbers; at most {MOST_STEPS} and {MOST_NUMBERS}"),
        ));
    }
    let setup = Setup {
        robot,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        // the command is constant: one call is enough
        periods: Periods {
            ticks_per_control: NonZeroU32::MAX,
            ..periods
        },
        gravity_m_s2,
        servo,
        start_q,
        start_qd,
        ticks,
    };
    let mut sampler = Sampler {
        stride,
        periods,
        t_s: Vec::new(),
        q: Vec::new(),
        qd: Vec::new(),
        effort: Vec::new(),
    };
    let end = run::run(
        &setup,
        |_, slot| {
            slot.copy_from_slice(&command);
            Ok::<(), Refusal>(())
        },
        &mut sampler,
    )
    .map_err(|error| Refusal::new("cannot-run", error.to_string()))?;
    match end {
        End::Finished => {}
        End::Stopped { why, .. } => return Err(why),
        End::Diverged { tick } => {
            return Err(Refusal::new(
                "diverged",
                format!(
                    "the state was no longer finite at {} s",
                    periods.time_s(tick)
                ),
            ));
        }
    }
    let table = |table: &[Vec<f64>]| -> Result<Value, Refusal> {
        let rows: Result<Vec<Value>, Refusal> = table.iter().map(|row| finite(row)).collect();
        rows.map(Value::Array)
    };
    Ok(json!({
        "t_s": finite(&sampler.t_s)?,
        "q": table(&sampler.q)?,
        "qd": table(&sampler.qd)?,
        "effort": table(&sampler.effort)?,
    }))
}

fn servo_of(
    robot: &kinemark_sim::robot::Robot,
    table: Map<String, Value>,
) -> Result<ServoSettings, Refusal> {
    let mut fields = Fields::new(robot, table);
    let n = robot.n();
    let mode = match fields.text("mode")?.as_deref() {
        Some("position") => Mode::Position,
        Some("velocity") => Mode::Velocity,
        Some("effort") => Mode::Effort,
        other => {
            let found = other.unwrap_or("nothing");
            return Err(Refusal::new(
                "out-of-range",
                format!("`mode` is `position`, `velocity` or `effort`, got `{found}`"),
            ));
        }
    };
    let derivative = match fields.text("derivative")?.as_deref() {
        Some("error") => Derivative::Error,
        None | Some("measurement") => Derivative::Measurement,
        Some("velocity") => Derivative::Velocity,
        Some(other) => {
            return Err(Refusal::new(
                "out-of-range",
                format!("`derivative` is `error`, `measurement` or `velocity`, got `{other}`"),
            ));
        }
    };
    let zeros = || vec![0.0; n];
    let kp = fields.spread("kp")?.unwrap_or_else(zeros);
    let ki = fields.spread("ki")?.unwrap_or_else(zeros);
    let kd = fields.spread("kd")?.unwrap_or_else(zeros);
    let mut limit = |name: &'static str| {
        let limits = fields
            .spread(name)?
            .unwrap_or_else(|| vec![f64::INFINITY; n]);
        match limits.iter().find(|limit| **limit < 0.0) {
            None => Ok(limits),
            Some(bad) => Err(Refusal::new(
                "out-of-range",
                format!("`{name}` must not be negative, got {bad}"),
            )),
        }
    };
    let effort_limit = limit("effort_limit")?;
    let integral_limit = limit("integral_limit")?;
    let gravity_compensation = fields.truth("gravity_compensation")?.unwrap_or(false);
    fields.finish()?;
    let mut gains: Vec<Gains> = (0..n)
        .map(|i| Gains {
            kp: kp[i],
            ki: ki[i],
            kd: kd[i],
            effort_limit: effort_limit[i],
            integral_limit: integral_limit[i],
        })
        .collect();
    // a joint that follows from a loop has no drive
    for &i in robot.dependent() {
        gains[i] = Gains {
            kp: 0.0,
            ki: 0.0,
            kd: 0.0,
            effort_limit: 0.0,
            integral_limit: 0.0,
        };
    }
    Ok(ServoSettings {
        mode,
        derivative,
        gains,
        gravity_compensation,
    })
}
