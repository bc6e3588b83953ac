//! The operation `simulate`: a run under given commands, sampled, alone or in a scene.

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoError, ServoSettings};
use kinemark_sim::event::{Event, EventKind};
use kinemark_sim::event_words::Names;
use kinemark_sim::kinematics::closure::loop_gap_m;
use kinemark_sim::run::{self, End, Recorder, Row, Setup};
use kinemark_sim::scene::Scene;
use kinemark_sim::ticks::{Periods, whole_ratio};
use kinemark_sim::trace::pose_numbers;
use kinemark_sim::watch::{ContactSpan, Watch};
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

/// Keeps every `stride`-th row, and in a scene what happened.
struct Sampler<'a> {
    stride: u64,
    periods: Periods,
    t_s: Vec<f64>,
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    effort: Vec<Vec<f64>>,
    /// Poses of the scene's bodies, one list per body.
    bodies: Vec<Vec<Vec<f64>>>,
    watch: Option<Watch<'a>>,
    /// Readings of the sensors, channel by channel.
    sensors: Vec<Vec<f64>>,
}

impl Recorder for Sampler<'_> {
    fn row(&mut self, row: Row<'_>) {
        if let Some(watch) = &mut self.watch {
            watch.see(&row);
        }
        if row.tick.is_multiple_of(self.stride) {
            self.t_s.push(self.periods.time_s(row.tick));
            self.q.push(row.q.to_vec());
            self.qd.push(row.qd.to_vec());
            self.effort.push(row.effort.to_vec());
            self.sensors.push(row.sensors.to_vec());
            for (body, poses) in row
                .scene
                .iter()
                .flat_map(|scene| scene.bodies())
                .zip(&mut self.bodies)
            {
                poses.push(pose_numbers(&body.world_from_body).to_vec());
            }
        }
    }
}

/// Answers a `simulate` request.
pub(super) fn answer(scene: Option<&Scene>, mut fields: Fields<'_>) -> Result<Value, Refusal> {
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
    let commands = commands(&mut fields)?;
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
    let gravity_m_s2 = match scene {
        // a scene says it, and a second word would be one too many
        Some(scene) => scene.environment.gravity_m_s2,
        None => fields.gravity_m_s2()?,
    };
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
    let control_s = match &commands {
        Commands::Constant(_) => servo_s,
        Commands::Rows { period_s, .. } => {
            divides("command_period_s", *period_s, "servo_period_s", servo_s)?;
            *period_s
        }
    };
    let periods = Periods::new(step_s, servo_s, control_s)
        .map_err(|error| Refusal::new("bad-period", error.to_string()))?;
    let channels = robot.sensors().iter().map(|sensor| sensor.kind.channels());
    let channels: usize = channels.sum();
    let bodies = scene.map_or(0, |scene| scene.bodies.len());
    let numbers = (ticks / stride + 1).saturating_mul((3 * n + 7 * bodies + channels + 1) as u64);
    if ticks > MOST_STEPS || numbers > MOST_NUMBERS {
        return Err(Refusal::new(
            "too-large",
            format!("{ticks} steps and {numbers} numbers; at most {MOST_STEPS} and {MOST_NUMBERS}"),
        ));
    }
    let setup = Setup {
        robot,
        scene,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods,
        gravity_m_s2,
        servo,
        sensors: robot.sensors().to_vec(),
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
        bodies: vec![Vec::new(); bodies],
        watch: scene.map(|_| Watch::new(&setup)),
        sensors: Vec::new(),
    };
    let end = run::run(
        &setup,
        |seen, slot| {
            slot.copy_from_slice(
                commands.at(seen.tick / u64::from(periods.ticks_per_control.get())),
            );
            Ok::<(), Refusal>(())
        },
        &mut sampler,
    )
    .map_err(|error| Refusal::new("cannot-run", error.to_string()))?;
    match end {
        End::Finished => {}
        End::Stopped { why, .. } => return Err(why),
        End::Diverged { tick, what } => {
            return Err(Refusal::new(
                "diverged",
                format!("{what} at {} s", periods.time_s(tick)),
            ));
        }
    }
    let table = |table: &[Vec<f64>]| -> Result<Value, Refusal> {
        let rows: Result<Vec<Value>, Refusal> = table.iter().map(|row| finite(row)).collect();
        rows.map(Value::Array)
    };
    let mut answer = json!({
        "t_s": finite(&sampler.t_s)?,
        "q": table(&sampler.q)?,
        "qd": table(&sampler.qd)?,
        "effort": table(&sampler.effort)?,
    });
    if !robot.sensors().is_empty() {
        let mut start = 0;
        let mut readings = Map::new();
        for sensor in robot.sensors() {
            let channels = start..start + sensor.kind.channels();
            start = channels.end;
            let rows = sampler.sensors.iter();
            let values: Result<Vec<Value>, Refusal> = if channels.len() == 1 {
                rows.map(|row| Ok(finite(&row[channels.clone()])?[0].take()))
                    .collect()
            } else {
                rows.map(|row| finite(&row[channels.clone()])).collect()
            };
            readings.insert(sensor.name.clone(), Value::Array(values?));
        }
        answer["sensors"] = Value::Object(readings);
    }
    if let (Some(scene), Some(watch)) = (scene, sampler.watch) {
        let names = Names {
            robot,
            scene: Some(scene),
            seen_from: "",
        };
        let (events, contacts) = watch.finish();
        answer["events"] = events
            .iter()
            .map(|event| event_json(&names, event, periods.time_s(event.tick)))
            .collect();
        answer["contacts"] = contacts
            .iter()
            .map(|contact| contact_json(&names, contact, &periods))
            .collect();
        let poses = scene.bodies.iter().zip(&sampler.bodies);
        let poses: Result<Map<String, Value>, Refusal> = poses
            .map(|(body, poses)| Ok((body.name.clone(), table(poses)?)))
            .collect();
        answer["bodies"] = Value::Object(poses?);
    }
    Ok(answer)
}

/// What the servos are told.
enum Commands {
    /// One command for the whole run.
    Constant(Vec<f64>),
    /// A row for each period, the last one for the rest of the run.
    Rows { rows: Vec<Vec<f64>>, period_s: f64 },
}

impl Commands {
    /// The command of a period, from zero.
    fn at(&self, period: u64) -> &[f64] {
        match self {
            Self::Constant(command) => command,
            Self::Rows { rows, .. } => {
                let last = rows.len() - 1;
                &rows[usize::try_from(period).map_or(last, |period| period.min(last))]
            }
        }
    }
}

fn commands(fields: &mut Fields<'_>) -> Result<Commands, Refusal> {
    if !fields.has("commands") {
        let command = fields.efforts("command")?.as_slice().to_vec();
        return Ok(Commands::Constant(command));
    }
    if fields.has("command") {
        return Err(Refusal::new(
            "unknown-field",
            "either `command` or `commands`, not both",
        ));
    }
    let period_s = fields.positive("command_period_s")?;
    let n = fields.robot.n();
    let rows = fields.lists("commands")?;
    if rows.is_empty() {
        return Err(Refusal::new("wrong-length", "`commands` has no row"));
    }
    if let Some(row) = rows.iter().find(|row| row.len() != n) {
        return Err(Refusal::new(
            "wrong-length",
            format!(
                "a row of `commands` has {} numbers, expected {n}",
                row.len()
            ),
        ));
    }
    Ok(Commands::Rows { rows, period_s })
}

fn event_json(names: &Names<'_>, event: &Event, t_s: f64) -> Value {
    let mut told = json!({
        "t_s": t_s,
        "event": event.kind.name(),
        "message": names.event(&event.kind),
    });
    if let Some(joint) = event.kind.joint() {
        told["joint"] = names.joint(joint).into();
    }
    if let Some(body) = event.kind.body() {
        told["body"] = names.body(body).into();
    }
    match event.kind {
        EventKind::Touched { parties } => {
            told["parties"] = json!(parties.map(|party| names.party(party)));
        }
        EventKind::BodyFell {
            side: Some(side), ..
        } => {
            told["side"] = side.seen.name().into();
            told["outward"] = json!([side.outward.x, side.outward.y, side.outward.z]);
        }
        _ => {}
    }
    told
}

fn contact_json(names: &Names<'_>, contact: &ContactSpan, periods: &Periods) -> Value {
    let p = contact.p_first_in_world;
    json!({
        "parties": contact.parties.map(|party| names.party(party)),
        "from_s": periods.time_s(contact.first_tick),
        "until_s": periods.time_s(contact.last_tick),
        "peak_force_n": contact.peak_force_n,
        "peak_s": periods.time_s(contact.peak_tick),
        "impulse_n_s": contact.impulse_n_s,
        "depth_m": contact.depth_m,
        "first_point_m": [p.x, p.y, p.z],
    })
}

fn servo_of(
    robot: &kinemark_sim::robot::Robot,
    table: Map<String, Value>,
) -> Result<ServoSettings, Refusal> {
    let mut fields = Fields::new(robot, table);
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
    let mut gains = GainLists::none(robot.n());
    for (name, list) in [
        ("kp", &mut gains.kp),
        ("ki", &mut gains.ki),
        ("kd", &mut gains.kd),
        ("effort_limit", &mut gains.effort_limit),
        ("integral_limit", &mut gains.integral_limit),
    ] {
        if let Some(given) = fields.spread(name)? {
            *list = given;
        }
    }
    let gravity_compensation = fields.truth("gravity_compensation")?.unwrap_or(false);
    fields.finish()?;
    ServoSettings::new(robot, mode, derivative, &gains, gravity_compensation).map_err(|error| {
        let code = match error {
            ServoError::Gain { .. } | ServoError::Limit { .. } => "out-of-range",
            ServoError::Count { .. } => "wrong-length",
            ServoError::VelocityOfVelocity => "cannot-run",
        };
        Refusal::new(code, error.to_string())
    })
}
