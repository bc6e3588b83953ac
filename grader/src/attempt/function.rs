//! Runs a function task: calls the submission on every case and measures each answer.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;

use super::answers::{Answered, Answers, CaseFacts};
use super::measure::measure;
use super::{Attempt, EndReason, Ended};
use crate::record::grade::LogEntry;
use crate::submission::answer::NOT_A_NUMBER;
use crate::submission::controller::{
    Answer, Budget, Call, Controller, Opening, RobotFacts, Said, Stop,
};
use crate::submission::host::Host;
use crate::submission::rhai::ScriptController;
use crate::task::model::{Case, Function, Given};
use crate::task::value::Value;
use crate::task::workcell::Workcell;

/// After this many calls that used up their budget the submission is not called again: the reason is known, and each costs time.
const MOST_EXHAUSTED: usize = 3;

/// Calls the submission of `opening` on `cases`.
pub fn run<'a>(
    cell: Workcell<'a>,
    function: &Function,
    cases: &'a [Case],
    opening: &Opening,
    host: &mut dyn Host,
) -> Attempt<Answers<'a>> {
    let mut calls = Calls {
        opening,
        host,
        controller: None,
        exhausted: 0,
        stop: None,
    };
    let mut hasher = blake3::Hasher::new();
    let mut operations = 0;
    let mut log = Vec::new();
    let mut facts = Vec::with_capacity(cases.len());
    for (i, case) in cases.iter().enumerate() {
        let is_visible = case.hidden_class.is_none();
        let robot = case.robot.as_deref().unwrap_or(cell.robot);
        let reply = calls.reply(i, &call_of(function, robot, case));
        let (value, said) = match reply {
            Reply::Answered(answer) => {
                // the operations of a loop whose length is a hidden number would reveal it
                if is_visible {
                    operations += answer.operations;
                }
                hash_value(&mut hasher, &answer.value);
                (Some(answer.value), answer.said)
            }
            Reply::Stopped(said) => {
                hasher.update(b"stopped");
                (None, said)
            }
            Reply::NotCalled => (None, Said::default()),
        };
        // output in a hidden case could reveal its numbers
        let lines = said.log.into_iter().filter(|_| is_visible);
        log.extend(lines.map(|text| LogEntry { at: i as u64, text }));
        facts.push(measure(cell.frame, function, case, robot, value.as_ref()));
    }
    Attempt {
        ended: calls.stop.or_else(|| first_invalid(&facts, &log)),
        operations,
        recorded: Answers {
            facts,
            log,
            digest: hasher.finalize(),
        },
    }
}

/// The first answer that has the wrong shape or is not finite, with the line of the log that says where it began to be no number.
fn first_invalid(facts: &[CaseFacts<'_>], log: &[LogEntry]) -> Option<Ended> {
    let mut cases = (0..).zip(facts);
    cases.find_map(|(at, facts)| match &facts.answer {
        Answered::Invalid(what) => {
            let mut of_case = log.iter().filter(|entry| entry.at == at);
            let origin = of_case.find_map(|entry| entry.text.strip_suffix(NOT_A_NUMBER));
            let what = match origin {
                Some(origin) => format!("{what}; {}", origin.trim_end_matches(": ")),
                None => what.clone(),
            };
            Some(Ended::because(EndReason::InvalidOutput(what), at))
        }
        Answered::Position(_)
        | Answered::Branches(_)
        | Answered::Matrix(_)
        | Answered::Entries(_)
        | Answered::Stopped => None,
    })
}

/// The calls of one submission on the cases of a task.
struct Calls<'o> {
    opening: &'o Opening,
    host: &'o mut dyn Host,
    controller: Option<Box<dyn Controller>>,
    /// Calls that used up their budget so far.
    exhausted: usize,
    /// The first stop.
    stop: Option<Ended>,
}

/// The result of a call.
enum Reply {
    Answered(Answer),
    Stopped(Said),
    /// Skipped, because the same failure would happen again.
    NotCalled,
}

impl Calls<'_> {
    /// Makes the call of case `i`, unless its failure is known in advance.
    fn reply(&mut self, i: usize, call: &Call) -> Reply {
        if self.exhausted >= MOST_EXHAUSTED {
            return Reply::NotCalled;
        }
        let stop = match self.call(call) {
            Ok(answer) => return Reply::Answered(answer),
            Err(stop) => stop,
        };
        self.exhausted = match stop {
            // a failure in one case costs only that case
            Stop::Crashed(_) => self.exhausted,
            Stop::OverBudget {
                budget: Budget::OperationsPerCall | Budget::InstructionsPerCall,
                ..
            } => self.exhausted + 1,
            // a problem of the whole file or of this machine concerns every case
            _ => MOST_EXHAUSTED,
        };
        self.stop.get_or_insert(Ended::stopped_by(stop, i as u64));
        let said = self.controller.as_mut().map(|open| open.unanswered());
        Reply::Stopped(said.unwrap_or_default())
    }

    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let open = match &mut self.controller {
            Some(open) => open,
            None => self.controller.insert(self.host.open(self.opening)?),
        };
        open.call(call)
    }
}

/// The answers of the submission of `opening` to cases of a free function, computed in this process.
///
/// # Errors
/// The first [`Stop`].
pub fn answers(function: &Function, cases: &[Case], opening: &Opening) -> Result<Vec<Value>, Stop> {
    let mut script = ScriptController::open(opening)?;
    let mut answers = Vec::new();
    for case in cases {
        if let Given::Values { given, .. } = &case.given {
            answers.push(script.call(&free_call(function, given))?.value);
        }
    }
    Ok(answers)
}

fn free_call(function: &Function, given: &[(String, Dimension)]) -> Call {
    Call::Free {
        function: function.name().to_owned(),
        given: given
            .iter()
            .map(|(name, value)| (name.clone(), value_of(value)))
            .collect(),
    }
}

fn call_of(function: &Function, robot: &Robot, case: &Case) -> Call {
    let robot = robot_facts(robot, None);
    match &case.given {
        Given::Q(q) if matches!(function, Function::Jacobian(_)) => Call::Jacobian {
            robot,
            q: q.clone(),
        },
        Given::Q(q) => Call::ForwardKinematics {
            robot,
            q: q.clone(),
        },
        Given::Position { position_m, .. } => Call::InverseKinematics {
            robot,
            position_m: *position_m,
        },
        Given::Values { given, .. } => free_call(function, given),
    }
}

/// The facts about `robot` for a submission; `effort_limits` are those of the task, else those of the robot.
pub fn robot_facts(robot: &Robot, effort_limits: Option<Vec<f64>>) -> RobotFacts {
    let dimensions = robot
        .dimensions()
        .iter()
        .map(|(name, dimension)| (name.to_owned(), value_of(dimension)));
    let joints = || robot.moving_joints();
    RobotFacts {
        name: robot.name().to_owned(),
        joint_names: joints().map(|joint| joint.name.clone()).collect(),
        dimensions: dimensions.collect(),
        lower: joints()
            .map(|j| j.limits.lower.unwrap_or(f64::NEG_INFINITY))
            .collect(),
        upper: joints()
            .map(|j| j.limits.upper.unwrap_or(f64::INFINITY))
            .collect(),
        effort: effort_limits.unwrap_or_else(|| {
            joints()
                .map(|j| j.limits.effort.unwrap_or(f64::INFINITY))
                .collect()
        }),
    }
}

/// A number or a list of numbers as a value for submissions.
fn value_of(dimension: &Dimension) -> Value {
    match dimension {
        Dimension::Number(number) => Value::Number(*number),
        Dimension::List(list) => Value::List(list.iter().copied().map(Value::Number).collect()),
    }
}

fn hash_value(hasher: &mut blake3::Hasher, value: &Value) {
    let text = |hasher: &mut blake3::Hasher, tag: &[u8], text: &str| {
        hasher.update(tag);
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    };
    match value {
        Value::Nothing => {
            hasher.update(b"n");
        }
        Value::Boolean(boolean) => {
            hasher.update(if *boolean { b"t" } else { b"f" });
        }
        // one bit pattern for every NaN, because its bits differ between platforms
        Value::Number(number) if number.is_nan() => {
            hasher.update(b"N");
        }
        Value::Number(number) => {
            hasher.update(b"d");
            hasher.update(&number.to_le_bytes());
        }
        Value::Text(t) => text(hasher, b"s", t),
        Value::Other(name) => text(hasher, b"o", name),
        Value::List(items) => {
            hasher.update(b"l");
            hasher.update(&(items.len() as u64).to_le_bytes());
            for item in items {
                hash_value(hasher, item);
            }
        }
        Value::Map(entries) => {
            hasher.update(b"m");
            hasher.update(&(entries.len() as u64).to_le_bytes());
            for (name, value) in entries {
                text(hasher, b"k", name);
                hash_value(hasher, value);
            }
        }
    }
}
