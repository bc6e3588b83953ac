//! Runs a motion task: the simulator under the submission's `control`.

use kinemark_sim::event::{Event, EventKind};
use kinemark_sim::robot::Robot;
use kinemark_sim::run::{self, Disturbance, End, Run, Setup};
use kinemark_sim::runaway::{BlowUp, Cause, likely_cause};
use kinemark_sim::sensor::{Sensor, SensorKind};
use kinemark_sim::trace::{LogLine, PlotSignal, Trace, TraceRecorder};

use crate::attempt::function::robot_facts;
use crate::judge::Host;
use crate::lab::model::{Lab, MotionTask};
use crate::submission::answer;
use crate::submission::controller::{
    Answer, Call, Controller, Observation, Opening, Reads, RobotFacts, Said, SensorFacts, Stop,
    Value,
};

/// A motion task as it went.
#[derive(Debug)]
pub struct MotionRun {
    /// What was recorded, up to the end or to the stop.
    pub trace: Trace,
    /// Why it ended early, and at which tick.
    pub ended: Option<(u64, EarlyEnd)>,
    /// Operations used.
    pub operations: u64,
}

/// Why a run ended before its last tick.
#[derive(Debug, Clone, PartialEq)]
pub enum EarlyEnd {
    /// The submission was stopped.
    Stopped(Stop),
    /// `control` returned no command; in words.
    InvalidOutput(String),
    /// The motion was beyond all reason.
    Diverged {
        /// What was lost.
        what: BlowUp,
        /// Why, as far as it can be computed.
        cause: Option<Cause>,
    },
}

/// The robot as a motion task's submission sees it, with the task's effort limits.
pub fn facts_of(lab: &Lab, motion: &MotionTask) -> RobotFacts {
    let limits = motion.servo.gains.iter().map(|g| g.effort_limit).collect();
    robot_facts(&lab.robot, Some(limits))
}

/// The sensors as a motion task's submission knows them.
pub fn sensors_of(motion: &MotionTask) -> Vec<SensorFacts> {
    let facts = |sensor: &Sensor| SensorFacts {
        name: sensor.name.clone(),
        reads: match (&sensor.kind, sensor.kind.channels()) {
            (SensorKind::LimitSwitch(_), _) => Reads::Truth,
            (_, 1) => Reads::Number,
            (_, channels) => Reads::Vector(channels),
        },
    };
    motion.sensors.iter().map(facts).collect()
}

/// What `observation.target` holds: the goals' positions, or the task's value.
pub fn target_of(motion: &MotionTask) -> Value {
    let list = |numbers: &[f64]| Value::List(numbers.iter().copied().map(Value::Number).collect());
    if motion.goals.is_empty() {
        motion.target.clone()
    } else {
        let positions = motion
            .goals
            .iter()
            .map(|goal| list(goal.position_m.as_slice()));
        Value::List(positions.collect())
    }
}

/// Runs `motion` under the submission of `opening`.
pub fn run(lab: &Lab, motion: &MotionTask, opening: &Opening, host: &mut dyn Host) -> MotionRun {
    let mut session = match Session::open(lab, motion, opening, host) {
        Ok(session) => session,
        Err(run) => return *run,
    };
    session.advance_to(u64::MAX);
    session.finish()
}

/// Runs `motion` under the submission of `opening` with `robot` in the place of the lab's, disturbed. The submission is told of neither.
pub fn run_disturbed(
    lab: &Lab,
    motion: &MotionTask,
    opening: &Opening,
    host: &mut dyn Host,
    robot: &Robot,
    disturbance: &Disturbance<'_>,
) -> MotionRun {
    let disturbed = (robot, Some(disturbance));
    let mut session = match Session::open_with(lab, motion, opening, host, disturbed) {
        Ok(session) => session,
        Err(run) => return *run,
    };
    session.advance_to(u64::MAX);
    session.finish()
}

/// A motion task between two ticks: the simulator, the submission, and what was recorded so far.
pub struct Session<'a> {
    run: Run<'a>,
    controller: Box<dyn Controller>,
    recorder: TraceRecorder<'a>,
    told: Told,
    ended: Option<Ended>,
}

/// How a session ended.
type Ended = Result<(), (u64, EarlyEnd)>;

impl<'a> Session<'a> {
    /// Starts the submission of `opening` and stands before the first tick.
    ///
    /// # Errors
    /// The run as it went, if the submission does not start.
    pub fn open(
        lab: &'a Lab,
        motion: &'a MotionTask,
        opening: &Opening,
        host: &mut dyn Host,
    ) -> Result<Self, Box<MotionRun>> {
        Self::open_with(lab, motion, opening, host, (&lab.robot, None))
    }

    /// The same with another robot of the same joints and frames, and a disturbance.
    fn open_with(
        lab: &'a Lab,
        motion: &'a MotionTask,
        opening: &Opening,
        host: &mut dyn Host,
        (robot, disturbance): (&'a Robot, Option<&Disturbance<'a>>),
    ) -> Result<Self, Box<MotionRun>> {
        let world = &robot.frames()[0];
        let setup = Setup {
            robot,
            scene: motion.scene.as_ref().map(|scene| &scene.scene),
            tcp: robot.tcp(),
            seen_from: robot.frame(&lab.frame).unwrap_or(world),
            periods: motion.periods,
            gravity_m_s2: motion.gravity_m_s2,
            servo: motion.servo.clone(),
            sensors: motion.sensors.clone(),
            start_q: motion.start_q.clone(),
            start_qd: vec![0.0; robot.n()],
            ticks: motion.ticks,
        };
        let recorder = TraceRecorder::new(&setup);
        let mut told = Told::default();
        let opened = started(opening, host, &mut told).and_then(|controller| {
            let run = match disturbance {
                None => Run::new(setup),
                Some(disturbance) => Run::disturbed(setup, disturbance),
            };
            let run = run.map_err(|error| Stop::GraderFault(error.to_string()))?;
            Ok((controller, run))
        });
        match opened {
            Ok((controller, run)) => Ok(Self {
                run,
                controller,
                recorder,
                told,
                ended: None,
            }),
            Err(stop) => Err(Box::new(motion_run(
                recorder,
                told,
                Some((0, EarlyEnd::Stopped(stop))),
            ))),
        }
    }

    /// The tick that comes next.
    pub fn tick(&self) -> u64 {
        self.run.tick()
    }

    /// Whether it has ended, at its last tick or before.
    pub fn is_over(&self) -> bool {
        self.ended.is_some()
    }

    /// What stopped the submission, if something did.
    pub fn stopped(&self) -> Option<&Stop> {
        match &self.ended {
            Some(Err((_, EarlyEnd::Stopped(stop)))) => Some(stop),
            _ => None,
        }
    }

    /// The signals recorded so far.
    pub fn so_far(&self) -> &Trace {
        self.recorder.so_far()
    }

    /// Goes on until `tick` comes next, or to the end.
    pub fn advance_to(&mut self, tick: u64) {
        while self.ended.is_none() && self.run.tick() < tick {
            let mut control = |seen: &run::Observation<'_>, command: &mut [f64]| {
                let call = Call::Control(Observation {
                    tick: seen.tick,
                    time_s: seen.time_s,
                    dt_s: seen.dt_s,
                    q: seen.q.to_vec(),
                    qd: seen.qd.to_vec(),
                    effort: seen.effort.to_vec(),
                    tcp_m: seen.tcp.translation.vector.into(),
                    sensors: seen.sensors.to_vec(),
                });
                let value = ask(self.controller.as_mut(), &call, seen.tick, &mut self.told)
                    .map_err(EarlyEnd::Stopped)?;
                let numbers = answer::command(&value, command.len())
                    .map_err(|what| EarlyEnd::InvalidOutput(format!("control returned {what}")))?;
                command.copy_from_slice(&numbers);
                Ok(())
            };
            self.ended = match self.run.advance(&mut control, &mut self.recorder) {
                Ok(None) => None,
                Ok(Some(End::Finished)) => Some(Ok(())),
                Ok(Some(End::Stopped { tick, why })) => Some(Err((tick, why))),
                Ok(Some(End::Diverged { tick, what })) => {
                    let cause = None;
                    Some(Err((tick, EarlyEnd::Diverged { what, cause })))
                }
                Err(error) => {
                    let fault = Stop::GraderFault(error.to_string());
                    Some(Err((0, EarlyEnd::Stopped(fault))))
                }
            };
        }
    }

    /// What was recorded up to here.
    pub fn finish(self) -> MotionRun {
        let ended = self.ended.and_then(Result::err);
        let mut run = motion_run(self.recorder, self.told, ended);
        if let Some((_, EarlyEnd::Diverged { what, cause })) = &mut run.ended {
            *cause = likely_cause(self.run.setup(), what, &run.trace);
        }
        run
    }
}

fn motion_run(
    recorder: TraceRecorder<'_>,
    told: Told,
    ended: Option<(u64, EarlyEnd)>,
) -> MotionRun {
    let mut trace = recorder.finish();
    trace.log = told.log;
    trace.plots = told.plots;
    if let Some((tick, why)) = &ended {
        let kind = match why {
            EarlyEnd::Diverged { .. } => EventKind::Diverged,
            EarlyEnd::Stopped(_) | EarlyEnd::InvalidOutput(_) => EventKind::Stopped,
        };
        trace.events.push(Event { tick: *tick, kind });
    }
    MotionRun {
        trace,
        ended,
        operations: told.operations,
    }
}

fn started(
    opening: &Opening,
    host: &mut dyn Host,
    told: &mut Told,
) -> Result<Box<dyn Controller>, Stop> {
    let mut controller = host.open(opening)?;
    ask(controller.as_mut(), &Call::Init, 0, told)?;
    Ok(controller)
}

/// Calls the submission and keeps what it says, answered or not.
fn ask(
    controller: &mut dyn Controller,
    call: &Call,
    tick: u64,
    told: &mut Told,
) -> Result<Value, Stop> {
    match controller.call(call) {
        Ok(Answer {
            value,
            said,
            operations,
        }) => {
            told.operations += operations;
            told.keep(tick, said);
            Ok(value)
        }
        Err(stop) => {
            told.keep(tick, controller.unanswered());
            Err(stop)
        }
    }
}

/// What a submission said in a run besides its commands.
#[derive(Debug, Default)]
struct Told {
    log: Vec<LogLine>,
    plots: Vec<PlotSignal>,
    plots_refused: bool,
    operations: u64,
}

/// Signals of a submission that are drawn: more are unreadable, and each costs a plot's time.
const MOST_PLOTS: usize = 24;

impl Told {
    fn keep(&mut self, tick: u64, said: Said) {
        let lines = said.log.into_iter().map(|text| LogLine { tick, text });
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
                        self.log.push(LogLine { tick, text });
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
