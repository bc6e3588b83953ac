//! Runs a motion task: the simulator under the submission's `control`.

use kinemark_sim::run::{self, End, Setup};
use kinemark_sim::trace::{Event, EventKind, LogLine, PlotSignal, Trace, TraceRecorder};

use crate::answer;
use crate::cases::robot_facts;
use crate::controller::{
    Answer, Call, Controller, Observation, Opening, RobotFacts, Said, Stop, Value,
};
use crate::grading::Host;
use crate::lab::model::{Lab, MotionTask};

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
    /// The arm's state was no longer finite.
    Diverged,
}

/// The robot as a motion task's submission sees it, with the task's effort limits.
pub fn facts_of(lab: &Lab, motion: &MotionTask) -> RobotFacts {
    let limits = motion.servo.gains.iter().map(|g| g.effort_limit).collect();
    robot_facts(&lab.robot, Some(limits))
}

/// What `observation.target` holds: the goals' positions, or the task's numbers.
pub fn target_of(motion: &MotionTask) -> Value {
    let list = |numbers: &[f64]| Value::List(numbers.iter().copied().map(Value::Number).collect());
    if motion.goals.is_empty() {
        list(&motion.target)
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
    let robot = &lab.robot;
    let world = &robot.frames()[0];
    let setup = Setup {
        robot,
        tcp: robot.tcp(),
        seen_from: robot.frame(&lab.frame).unwrap_or(world),
        periods: motion.periods,
        gravity_m_s2: motion.gravity_m_s2,
        servo: motion.servo.clone(),
        start_q: motion.start_q.clone(),
        start_qd: vec![0.0; robot.n()],
        ticks: motion.ticks,
    };
    let mut recorder = TraceRecorder::new(&setup);
    let mut told = Told::default();
    let ended = match started(opening, host, &mut told) {
        Err(stop) => Some((0, EarlyEnd::Stopped(stop))),
        Ok(mut controller) => {
            let control = |seen: &run::Observation<'_>, command: &mut [f64]| {
                let call = Call::Control(Observation {
                    tick: seen.tick,
                    time_s: seen.time_s,
                    dt_s: seen.dt_s,
                    q: seen.q.to_vec(),
                    qd: seen.qd.to_vec(),
                    effort: seen.effort.to_vec(),
                    tcp_m: seen.tcp.translation.vector.into(),
                });
                let value = ask(controller.as_mut(), &call, seen.tick, &mut told)
                    .map_err(EarlyEnd::Stopped)?;
                let numbers = answer::command(&value, command.len())
                    .map_err(|what| EarlyEnd::InvalidOutput(format!("control returned {what}")))?;
                command.copy_from_slice(&numbers);
                Ok(())
            };
            match run::run(&setup, control, &mut recorder) {
                Ok(End::Finished) => None,
                Ok(End::Stopped { tick, why }) => Some((tick, why)),
                Ok(End::Diverged { tick }) => Some((tick, EarlyEnd::Diverged)),
                Err(error) => {
                    let fault = Stop::GraderFault(error.to_string());
                    Some((0, EarlyEnd::Stopped(fault)))
                }
            }
        }
    };
    let mut trace = recorder.finish();
    trace.log = told.log;
    trace.plots = told.plots;
    if let Some((tick, why)) = &ended {
        let kind = match why {
            EarlyEnd::Diverged => EventKind::Diverged,
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
#[derive(Default)]
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
