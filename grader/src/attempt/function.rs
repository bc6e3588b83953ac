//! Runs a function task: calls the submission on every case and measures each answer.

use kinemark_sim::model::robot::{Joint, Robot};

use super::answers::{Answered, Answers, CaseFacts};
use super::measure::measure;
use super::{Attempt, EndReason, Ended, Stage};
use crate::record::grade::LogEntry;
use crate::submission::answer::NOT_A_NUMBER;
use crate::submission::controller::{
    Answer, Budget, Call, Controller, Failed, Opening, RobotFacts, Said, Stop,
};
use crate::submission::host::Host;
use crate::submission::rhai::ScriptController;
use crate::task::entry::Entry;
use crate::task::model::{Case, Function, FunctionTask, Given};
use crate::task::quantity::STATE;
use crate::task::task_joints::TaskJoints;
use crate::task::value::Value;
use crate::task::workcell::Workcell;

/// After this many calls that used up their budget the submission is not called again: the reason is known, and each costs time.
const MOST_EXHAUSTED: usize = 3;

/// Calls the submission of `opening` on `cases` of `task`.
pub fn run<'a>(
    cell: Workcell<'a>,
    task: &FunctionTask,
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
        let reply = calls.reply(i, &call_of(task, robot, case));
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
        log.extend(lines.map(|printed| LogEntry {
            at: i as u64,
            text: printed.text,
            line: printed.line,
        }));
        facts.push(measure(cell.frame, task, case, robot, value.as_ref()));
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
        | Answered::Pose(_)
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
        let Failed { stop, said } = match self.call(call) {
            Ok(answer) => return Reply::Answered(answer),
            Err(failed) => *failed,
        };
        let is_open = self.controller.is_some();
        self.exhausted = match stop {
            // a failure in one case costs only that case
            Stop::Crashed(_) if is_open => self.exhausted,
            Stop::OverBudget {
                budget: Budget::OperationsPerCall | Budget::InstructionsPerCall,
                ..
            } => self.exhausted + 1,
            // a problem of the whole file, of its own statements or of this machine concerns every case
            _ => MOST_EXHAUSTED,
        };
        let stage = match is_open {
            true => Stage::Call,
            false => Stage::Reading,
        };
        self.stop
            .get_or_insert(Ended::stopped_by(stop, i as u64).in_stage(stage));
        Reply::Stopped(said)
    }

    fn call(&mut self, call: &Call) -> Result<Answer, Box<Failed>> {
        let open = match &mut self.controller {
            Some(open) => open,
            None => self.controller.insert(self.host.open(self.opening)?),
        };
        open.call(call).map_err(|stop| {
            let said = open.unanswered();
            Box::new(Failed { stop, said })
        })
    }
}

/// The answers of the submission of `opening` to cases of a function of the lab's own, computed in this process.
///
/// # Errors
/// The first [`Stop`].
pub fn answers(
    cell: Workcell<'_>,
    task: &FunctionTask,
    cases: &[Case],
    opening: &Opening,
) -> Result<Vec<Value>, Stop> {
    let mut script = ScriptController::open(opening)?;
    let mut answers = Vec::new();
    for case in cases {
        if let Given::Values { .. } = &case.given {
            let robot = case.robot.as_deref().unwrap_or(cell.robot);
            answers.push(script.call(&call_of(task, robot, case))?.value);
        }
    }
    Ok(answers)
}

fn call_of(task: &FunctionTask, robot: &Robot, case: &Case) -> Call {
    let joints = TaskJoints::of(robot, &task.about.ignored);
    let of_task =
        |q: &[f64]| -> Vec<f64> { joints.entries().iter().map(|&entry| q[entry]).collect() };
    let robot = facts_of(robot, joints.entries(), None);
    let list = |numbers: &[f64]| Entry::List(numbers.to_vec()).value();
    let given = match (&case.given, &task.function) {
        (Given::Q(q), Function::Jacobian(_)) if task.is_usual() => {
            let q = of_task(q);
            return Call::Jacobian { robot, q };
        }
        (Given::Q(q), _) if task.is_usual() => {
            let q = of_task(q);
            return Call::ForwardKinematics { robot, q };
        }
        (Given::Position { position_m, .. }, _) if task.is_usual() => {
            let position_m = *position_m;
            return Call::InverseKinematics { robot, position_m };
        }
        (Given::Values { given, .. }, _) => {
            let given = given.iter();
            return Call::Free {
                function: task.name().to_owned(),
                robot: task.about.gives_robot.then_some(robot),
                given: given
                    .map(|(name, value)| (name.clone(), value.value()))
                    .collect(),
            };
        }
        (Given::Q(q), _) => vec![("q", list(&of_task(q)))],
        (Given::Motion(state), _) => {
            let state = STATE.iter().zip(state);
            state
                .map(|((name, _), values)| (*name, list(values)))
                .collect()
        }
        (Given::Position { pose, .. }, Function::InverseKinematics(form)) => {
            let name = task.parameters().last().copied().unwrap_or("pose");
            vec![(name, form.value(pose))]
        }
        (Given::Position { pose, .. }, _) => vec![("position", list(pose))],
    };
    let given = given.into_iter();
    Call::OfRobot {
        function: task.name().to_owned(),
        robot,
        given: given
            .map(|(name, value)| (name.to_owned(), value))
            .collect(),
    }
}

/// The facts about `robot` for a submission, of all its joints; `effort_limits` are those of the task, else those of the robot.
pub fn robot_facts(robot: &Robot, effort_limits: Option<Vec<f64>>) -> RobotFacts {
    let all: Vec<usize> = (0..robot.n()).collect();
    facts_of(robot, &all, effort_limits)
}

/// The facts about `robot` for a submission to `task`: of the joints of the task.
pub fn facts_of_task(robot: &Robot, task: &FunctionTask) -> RobotFacts {
    let joints = TaskJoints::of(robot, &task.about.ignored);
    facts_of(robot, joints.entries(), None)
}

fn facts_of(robot: &Robot, entries: &[usize], effort_limits: Option<Vec<f64>>) -> RobotFacts {
    let dimensions = robot
        .dimensions()
        .iter()
        .map(|(name, dimension)| (name.to_owned(), Entry::from(dimension.clone()).value()));
    let all: Vec<&Joint> = robot.moving_joints().collect();
    let joints = || entries.iter().map(|&entry| all[entry]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission::controller::{Budgets, Mistake};
    use crate::submission::handed_in::Program;

    /// Fails to open every submission with one stop, and counts.
    struct Refusing {
        stop: Stop,
        opened: usize,
    }

    impl Host for Refusing {
        fn open(&mut self, _: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
            self.opened += 1;
            Err(self.stop.clone().into())
        }
    }

    fn robot() -> RobotFacts {
        RobotFacts {
            name: "arm".into(),
            joint_names: vec!["a".into()],
            dimensions: Vec::new(),
            lower: vec![-1.0],
            upper: vec![1.0],
            effort: vec![1.0],
        }
    }

    /// How often a submission that cannot be opened is opened for ten cases.
    fn opened(stop: Stop) -> usize {
        let opening = Opening {
            file: "submission.py".into(),
            program: Program::Python(String::new()),
            task: "fk".into(),
            robot: robot(),
            target: Value::Nothing,
            sensors: Vec::new(),
            budgets: Budgets::default(),
            granted: None,
            function: None,
        };
        let mut host = Refusing { stop, opened: 0 };
        let mut calls = Calls {
            opening: &opening,
            host: &mut host,
            controller: None,
            exhausted: 0,
            stop: None,
        };
        let call = Call::ForwardKinematics {
            robot: robot(),
            q: vec![0.0],
        };
        for case in 0..10 {
            let reply = calls.reply(case, &call);
            assert!(!matches!(reply, Reply::Answered(_)));
        }
        let first = calls.stop.expect("there is a first stop");
        assert_eq!((first.at, first.stage), (0, Stage::Reading));
        host.opened
    }

    /// Reading a file may cost fifty times what a call may.
    #[test]
    fn a_file_whose_own_statements_fail_is_read_once() {
        let mistake = Mistake {
            message: "division by zero".into(),
            place: None,
            help: None,
            further: Vec::new(),
        };
        assert_eq!(opened(Stop::Crashed(mistake)), 1);
        let out_of_budget = Stop::OverBudget {
            budget: Budget::InstructionsToRead,
            limit: 10,
            place: None,
            function: None,
        };
        assert_eq!(opened(out_of_budget), 1);
    }
}
