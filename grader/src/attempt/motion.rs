//! Runs a motion task: the simulator under the submission's `control`.
//!
//! If a call of `control` fails, the run goes on to its end under the last command, and the submission is not called again: what it did
//! before is still there to be judged. Before the first command the arm is at rest.

use kinemark_sim::control::Mode;
use kinemark_sim::diagnosis::likely_cause;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::sensor::{Measured, Sensor};
use kinemark_sim::run;
use kinemark_sim::run::{Disturbance, End, Run, Setup};
use kinemark_sim::trace::{LogLine, PlotSignal, Trace, TraceRecorder};
use kinemark_sim::watch::event::{Event, EventKind};
use nalgebra::Matrix3;

use super::function::robot_facts;
use super::{Attempt, EndReason, Ended, Stage};
use crate::submission::answer;
use crate::submission::controller::{
    Answer, Call, Controller, Observation, Opening, Reads, RobotFacts, Said, SensorFacts, Stop,
};
use crate::submission::host::Host;
use crate::task::model::{GoalOrientation, MotionGoal, MotionTask};
use crate::task::value::Value;
use crate::task::workcell::Workcell;

/// The facts about the robot for a motion task's submission, with the task's effort limits.
pub fn facts_of(robot: &Robot, motion: &MotionTask) -> RobotFacts {
    let limits = motion.servo.gains.iter().map(|g| g.effort_limit).collect();
    robot_facts(robot, Some(limits))
}

/// The facts about the sensors for a motion task's submission.
pub fn sensors_of(motion: &MotionTask) -> Vec<SensorFacts> {
    let facts = |sensor: &Sensor| SensorFacts {
        name: sensor.name.clone(),
        reads: match sensor.kind.measured() {
            Measured::Switch => Reads::Truth,
            Measured::Number => Reads::Number,
            Measured::Parts(names) => Reads::Vector(names.len()),
        },
    };
    motion.sensors.iter().map(facts).collect()
}

/// The value of `observation.target`: the task's value; without one, the goals' positions, with their orientations where some goal has
/// one.
pub fn target_of(motion: &MotionTask) -> Value {
    if motion.has_target || motion.goals.is_empty() {
        return motion.target.clone();
    }
    let goals = motion.goals.iter();
    if goals.clone().any(|goal| goal.orientation.is_some()) {
        Value::List(goals.map(goal_value).collect())
    } else {
        let positions = goals.map(|goal| list_value(goal.position_m.as_slice()));
        Value::List(positions.collect())
    }
}

fn list_value(numbers: &[f64]) -> Value {
    Value::List(numbers.iter().copied().map(Value::Number).collect())
}

/// A goal as a map, with its rotation matrix as a list of rows, or the axis and where it points.
fn goal_value(goal: &MotionGoal) -> Value {
    let entry = |name: &str, value| (name.to_owned(), value);
    let position = entry("position", list_value(goal.position_m.as_slice()));
    // in the order of keys
    Value::Map(match goal.orientation {
        None => vec![position],
        Some(GoalOrientation::Rotation(rotation)) => {
            let rows = rotation.matrix().row_iter();
            let rows = rows.map(|row| list_value(&[row[0], row[1], row[2]]));
            vec![position, entry("rotation", Value::List(rows.collect()))]
        }
        Some(GoalOrientation::Axis { of_tcp, along }) => vec![
            entry("along", list_value(along.as_slice())),
            entry("axis", list_value(of_tcp.as_slice())),
            position,
        ],
    })
}

/// Runs `motion` under the submission of `opening`.
pub fn run(
    cell: Workcell<'_>,
    motion: &MotionTask,
    opening: &Opening,
    host: &mut dyn Host,
) -> Attempt<Trace> {
    let robot = motion.robot_of_run(cell.robot);
    let cell = Workcell {
        robot: &robot,
        ..cell
    };
    whole(Session::open(cell, motion, opening, host))
}

/// Runs `motion` under the submission of `opening` with a disturbance of the robot of `cell`. The submission knows neither the
/// disturbance nor the difference to the robot of its opening.
pub fn run_disturbed(
    cell: Workcell<'_>,
    motion: &MotionTask,
    opening: &Opening,
    host: &mut dyn Host,
    disturbance: &Disturbance<'_>,
) -> Attempt<Trace> {
    let robot = motion.robot_of_run(cell.robot);
    let cell = Workcell {
        robot: &robot,
        ..cell
    };
    whole(Session::open_with(
        cell,
        motion,
        opening,
        host,
        Some(disturbance),
    ))
}

/// Runs a session to its end.
fn whole(session: Result<Session<'_>, Box<Attempt<Trace>>>) -> Attempt<Trace> {
    match session {
        Ok(mut session) => {
            session.advance_to(u64::MAX);
            session.finish()
        }
        Err(attempt) => *attempt,
    }
}

/// A motion task between two ticks: the simulator, the submission, and what was recorded so far.
pub struct Session<'a> {
    run: Run<'a>,
    controller: Box<dyn Controller>,
    recorder: TraceRecorder<'a>,
    output: Output,
    /// The last command, or rest.
    held: Vec<f64>,
    /// The call of `control` that failed, after which the last command is held.
    cut: Option<Ended>,
    ended: Option<Result<(), Ended>>,
}

impl<'a> Session<'a> {
    /// Starts the submission of `opening`; the session is then before the first tick. The robot of `cell` moves with the friction that it
    /// has there: [`MotionTask::robot_of_run`].
    ///
    /// # Errors
    /// The run without any tick, if the submission does not start.
    pub fn open(
        cell: Workcell<'a>,
        motion: &'a MotionTask,
        opening: &Opening,
        host: &mut dyn Host,
    ) -> Result<Self, Box<Attempt<Trace>>> {
        Self::open_with(cell, motion, opening, host, None)
    }

    /// The same with a disturbance.
    fn open_with(
        cell: Workcell<'a>,
        motion: &'a MotionTask,
        opening: &Opening,
        host: &mut dyn Host,
        disturbance: Option<&Disturbance<'a>>,
    ) -> Result<Self, Box<Attempt<Trace>>> {
        let robot = cell.robot;
        let world = &robot.frames()[0];
        let setup = Setup {
            robot,
            scene: motion.scene_of_run(),
            tcp: robot.tcp(),
            seen_from: robot.frame(cell.frame).unwrap_or(world),
            periods: motion.periods,
            gravity_m_s2: motion.gravity_m_s2,
            servo: motion.servo.clone(),
            sensors: motion.sensors.clone(),
            start_q: motion.start_q.clone(),
            start_qd: motion.start_qd.clone(),
            laws: motion.laws.clone(),
            pushes: motion.pushes.clone(),
            ticks: motion.ticks,
        };
        let recorder = TraceRecorder::new(&setup);
        let mut output = Output::default();
        let opened = started(opening, host, &mut output).and_then(|controller| {
            let run = match disturbance {
                None => Run::new(setup),
                Some(disturbance) => Run::disturbed(setup, disturbance),
            };
            let run = run.map_err(|error| {
                let fault = Stop::GraderFault(error.to_string());
                Box::new(Ended::stopped_by(fault, 0))
            })?;
            Ok((controller, run))
        });
        match opened {
            Ok((controller, run)) => Ok(Self {
                run,
                controller,
                recorder,
                output,
                held: rest(motion),
                cut: None,
                ended: None,
            }),
            Err(ended) => Err(Box::new(attempt(recorder, output, Some(*ended)))),
        }
    }

    /// The next tick.
    pub fn tick(&self) -> u64 {
        self.run.tick()
    }

    /// Whether it has ended, at its last tick or early.
    pub fn is_over(&self) -> bool {
        self.ended.is_some()
    }

    /// How it ended early, or which call failed, if one did.
    pub fn ended(&self) -> Option<&Ended> {
        let ended = self.ended.as_ref().and_then(|ended| ended.as_ref().err());
        self.cut.as_ref().or(ended)
    }

    /// The signals recorded so far.
    pub fn so_far(&self) -> &Trace {
        self.recorder.so_far()
    }

    /// Advances until `tick` is the next tick, or to the end.
    pub fn advance_to(&mut self, tick: u64) {
        while self.ended.is_none() && self.run.tick() < tick {
            let mut control = |seen: &run::Observation<'_>, command: &mut [f64]| {
                if self.cut.is_some() {
                    command.copy_from_slice(&self.held);
                    return Ok(());
                }
                let call = Call::Control(Observation {
                    tick: seen.tick,
                    time_s: seen.time_s,
                    dt_s: seen.dt_s,
                    q: seen.q.to_vec(),
                    qd: seen.qd.to_vec(),
                    effort: seen.effort.to_vec(),
                    tcp_m: seen.tcp.translation.vector.into(),
                    tcp_rotation: rows(seen.tcp.rotation.matrix()),
                    sensors: seen.sensors.to_vec(),
                });
                let controller = self.controller.as_mut();
                match command_of(
                    controller,
                    &call,
                    seen.tick,
                    &mut self.output,
                    command.len(),
                ) {
                    Ok(numbers) => self.held.copy_from_slice(&numbers),
                    Err(why) if why.is_of_one_call() => {
                        let at = seen.tick;
                        self.cut = Some(Ended::because(why, at));
                    }
                    Err(why) => return Err(why),
                }
                command.copy_from_slice(&self.held);
                Ok(())
            };
            self.ended = match self.run.advance(&mut control, &mut self.recorder) {
                Ok(None) => None,
                Ok(Some(End::Finished)) => Some(Ok(())),
                Ok(Some(End::Stopped { tick, why })) => Some(Err(Ended::because(why, tick))),
                Ok(Some(End::Diverged { tick, what })) => {
                    let why = EndReason::Diverged { what, cause: None };
                    Some(Err(Ended::because(why, tick)))
                }
                Err(error) => {
                    let fault = Stop::GraderFault(error.to_string());
                    Some(Err(Ended::stopped_by(fault, 0)))
                }
            };
        }
    }

    /// Ends the session and returns its attempt.
    pub fn finish(self) -> Attempt<Trace> {
        let ended = self.cut.or(self.ended.and_then(Result::err));
        let mut attempt = attempt(self.recorder, self.output, ended);
        if let Some(Ended {
            why: EndReason::Diverged { what, cause },
            ..
        }) = &mut attempt.ended
        {
            *cause = likely_cause(self.run.setup(), what, &attempt.recorded);
        }
        attempt
    }
}

/// The rows of a rotation matrix.
fn rows(rotation: &Matrix3<f64>) -> [[f64; 3]; 3] {
    rotation.transpose().into()
}

/// The command of an arm at rest.
fn rest(motion: &MotionTask) -> Vec<f64> {
    match motion.servo.mode {
        Mode::Position => motion.start_q.clone(),
        Mode::Velocity | Mode::Effort | Mode::Prescribed => vec![0.0; motion.start_q.len()],
    }
}

/// The command that a call of `control` returns: `count` finite numbers.
fn command_of(
    controller: &mut dyn Controller,
    call: &Call,
    tick: u64,
    output: &mut Output,
    count: usize,
) -> Result<Vec<f64>, EndReason> {
    let value = ask(controller, call, tick, output).map_err(EndReason::Stopped)?;
    answer::command(&value, count)
        .map_err(|what| EndReason::InvalidOutput(format!("control returned {what}")))
}

fn attempt(recorder: TraceRecorder<'_>, output: Output, ended: Option<Ended>) -> Attempt<Trace> {
    let mut trace = recorder.finish();
    trace.log = output.log;
    trace.plots = output.plots;
    if let Some(ended) = &ended {
        let kind = match ended.why {
            EndReason::Diverged { .. } => EventKind::Diverged,
            EndReason::Stopped(_) | EndReason::InvalidOutput(_) => EventKind::Stopped,
        };
        let tick = ended.at;
        trace.events.push(Event { tick, kind });
    }
    Attempt {
        recorded: trace,
        ended,
        operations: output.operations,
    }
}

fn started(
    opening: &Opening,
    host: &mut dyn Host,
    output: &mut Output,
) -> Result<Box<dyn Controller>, Box<Ended>> {
    let ended = |stage| move |stop| Box::new(Ended::stopped_by(stop, 0).in_stage(stage));
    let mut controller = host.open(opening).map_err(|failed| {
        output.keep(0, failed.said);
        ended(Stage::Reading)(failed.stop)
    })?;
    ask(controller.as_mut(), &Call::Init, 0, output).map_err(ended(Stage::Init))?;
    Ok(controller)
}

/// Calls the submission and keeps its output, even if the call fails.
fn ask(
    controller: &mut dyn Controller,
    call: &Call,
    tick: u64,
    output: &mut Output,
) -> Result<Value, Stop> {
    match controller.call(call) {
        Ok(Answer {
            value,
            said,
            operations,
        }) => {
            output.operations += operations;
            output.keep(tick, said);
            Ok(value)
        }
        Err(stop) => {
            output.keep(tick, controller.unanswered());
            Err(stop)
        }
    }
}

/// The printed lines and plotted signals of a submission in a run.
#[derive(Debug, Default)]
struct Output {
    log: Vec<LogLine>,
    plots: Vec<PlotSignal>,
    plots_refused: bool,
    operations: u64,
}

/// Most plotted signals of a submission: more are unreadable, and each costs the time of a plot.
const MOST_PLOTS: usize = 24;

impl Output {
    fn keep(&mut self, tick: u64, said: Said) {
        let lines = said.log.into_iter().map(|printed| LogLine {
            tick,
            text: printed.text,
            line: printed.line,
        });
        self.log.extend(lines);
        for (name, value) in said.plots {
            match self.plots.iter().position(|plot| plot.name == name) {
                Some(known) => self.plots[known].samples.push((tick, value)),
                None if self.plots.len() >= MOST_PLOTS => {
                    if !self.plots_refused {
                        self.plots_refused = true;
                        let text = format!(
                            "more than {MOST_PLOTS} names in `plot`: `{name}` and later ones are not kept"
                        );
                        self.log.push(LogLine {
                            tick,
                            text,
                            line: None,
                        });
                    }
                }
                None => self.plots.push(PlotSignal {
                    name,
                    samples: vec![(tick, value)],
                }),
            }
        }
    }
}
