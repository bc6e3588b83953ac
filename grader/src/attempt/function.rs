//! Runs a function task: calls the submission on every case and measures each answer.

use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::robot::{Dimension, Robot};
use nalgebra::Vector3;

use crate::check::function_cases::{as_slice, relative_error};
use crate::check::ik_branches::count_distinct;
use crate::check::{Answered, CaseError, CaseFacts};
use crate::judge::Host;
use crate::lab::jacobian;
use crate::lab::model::{Case, Function, Given, Lab};
use crate::record::grade::LogEntry;
use crate::submission::answer;
use crate::submission::controller::{
    Answer, Budget, Call, Controller, Opening, RobotFacts, Said, Stop, Value,
};
use crate::submission::rhai::ScriptController;

/// After so many calls that used up their budget the submission is not asked again: the reason is known, and each costs time.
const MOST_EXHAUSTED: usize = 3;

/// A function task as it went.
#[derive(Debug)]
pub struct CasesRun<'a> {
    /// One per case, in order.
    pub facts: Vec<CaseFacts<'a>>,
    /// The first stop, and the case it happened in.
    pub stop: Option<(usize, Stop)>,
    /// Operations used in visible cases.
    pub operations: u64,
    /// Lines printed, each with the number of its case.
    pub log: Vec<LogEntry>,
    /// BLAKE3 of all answers, in order.
    pub digest: blake3::Hash,
}

/// Calls the submission of `opening` on `cases`.
pub fn run<'a>(
    lab: &Lab,
    function: &Function,
    cases: &'a [Case],
    opening: &Opening,
    host: &mut dyn Host,
) -> CasesRun<'a> {
    let mut controller: Option<Box<dyn Controller>> = None;
    let mut stop: Option<(usize, Stop)> = None;
    let mut exhausted = 0;
    let mut hasher = blake3::Hasher::new();
    let mut operations = 0;
    let mut log = Vec::new();
    let mut facts = Vec::with_capacity(cases.len());
    for (i, case) in cases.iter().enumerate() {
        // loading has built every case's robot once; a failure here is ours
        let robot = match lab.robot_file.build(&case.dimensions) {
            Ok(robot) => robot,
            Err(error) => {
                stop.get_or_insert((i, Stop::GraderFault(error.to_string())));
                exhausted = MOST_EXHAUSTED;
                lab.robot.clone()
            }
        };
        let mut answered = None;
        let mut said = Said::default();
        if exhausted < MOST_EXHAUSTED {
            match ask(&mut controller, function, &robot, case, opening, host) {
                Ok(answer) => {
                    // a loop as long as a hidden number would count it out
                    if case.hidden_class.is_none() {
                        operations += answer.operations;
                    }
                    hash_value(&mut hasher, &answer.value);
                    said = answer.said;
                    answered = Some(answer.value);
                }
                Err(why) => {
                    hasher.update(b"stopped");
                    exhausted = match why {
                        // one case's failure costs that case
                        Stop::Crashed(_) => exhausted,
                        Stop::OverBudget {
                            budget: Budget::OperationsPerCall,
                            ..
                        } => exhausted + 1,
                        // what is wrong with the whole file, or with this machine, is so for every case
                        _ => MOST_EXHAUSTED,
                    };
                    stop.get_or_insert((i, why));
                    if let Some(controller) = &mut controller {
                        said = controller.unanswered();
                    }
                }
            }
        }
        // what is printed in a hidden case could tell its numbers
        if case.hidden_class.is_some() {
            said.log.clear();
        }
        log.extend(
            said.log
                .into_iter()
                .map(|text| LogEntry { at: i as u64, text }),
        );
        facts.push(measure(lab, function, case, robot, answered.as_ref()));
    }
    CasesRun {
        facts,
        stop,
        operations,
        log,
        digest: hasher.finalize(),
    }
}

/// What the submission of `opening` answers to cases of a free function, in this process.
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

fn ask(
    controller: &mut Option<Box<dyn Controller>>,
    function: &Function,
    robot: &Robot,
    case: &Case,
    opening: &Opening,
    host: &mut dyn Host,
) -> Result<Answer, Stop> {
    let open = match controller {
        Some(open) => open,
        None => controller.insert(host.open(opening)?),
    };
    let robot = robot_facts(robot, None);
    open.call(&match &case.given {
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
    })
}

fn measure<'a>(
    lab: &Lab,
    function: &Function,
    case: &'a Case,
    robot: Robot,
    value: Option<&Value>,
) -> CaseFacts<'a> {
    let invalid = |what: String| Answered::Invalid(format!("{} returned {what}", function.name()));
    let (answer, error) = match (&case.given, function) {
        (Given::Q(q), Function::Jacobian(rows)) => {
            // a case's positions were counted when the lab was loaded
            let truth = jacobian::jacobian_in(&robot, &lab.frame, q, *rows).unwrap_or_default();
            let answer = match value.map(|value| answer::matrix(value, truth.len(), robot.n())) {
                None => Answered::Stopped,
                Some(Ok(matrix)) => Answered::Matrix(matrix),
                Some(Err(what)) => invalid(what),
            };
            let relative = match &answer {
                Answered::Matrix(matrix) => jacobian::relative_distance(matrix, &truth),
                _ => f64::INFINITY,
            };
            (answer, CaseError::Jacobian { relative, truth })
        }
        (Given::Q(q), _) => {
            let answer = match value.map(answer::position) {
                None => Answered::Stopped,
                Some(Ok(position)) => Answered::Position(position),
                Some(Err(what)) => invalid(what),
            };
            let error_m = match (&answer, tcp_in_lab(lab, &robot, q)) {
                (Answered::Position(position), Some(truth)) => (position - truth).norm(),
                _ => f64::INFINITY,
            };
            (answer, CaseError::Position(error_m))
        }
        (Given::Values { expected, .. }, _) => {
            let entries = value.map(|value| answer::entries(value, expected));
            let relative = expected.iter().enumerate().map(|(i, (_, should))| {
                let entry = entries
                    .as_ref()
                    .and_then(|entries| entries[i].as_ref().ok());
                entry.map_or(f64::INFINITY, |entry| {
                    relative_error(entry, as_slice(should))
                })
            });
            let error = CaseError::Entries(relative.collect());
            let answer = match entries.map(|entries| entries.into_iter().collect()) {
                None => Answered::Stopped,
                Some(Ok(entries)) => Answered::Entries(entries),
                Some(Err(what)) => invalid(what),
            };
            (answer, error)
        }
        (
            Given::Position {
                position_m,
                branches,
            },
            _,
        ) => {
            let most = (*branches).max(2) as usize;
            let answer = match value.map(|value| distinct_branches(value, &robot, most)) {
                None => Answered::Stopped,
                Some(Ok(branches)) => Answered::Branches(branches),
                Some(Err(what)) => invalid(what),
            };
            let error = if *branches == 0 {
                CaseError::Unreachable {
                    said_so: answer == Answered::Branches(Vec::new()),
                }
            } else {
                let target = Vector3::from(*position_m);
                let mut branches_m: Vec<f64> = match &answer {
                    Answered::Branches(found) => found
                        .iter()
                        .map(|q| {
                            let reached = tcp_in_lab(lab, &robot, q);
                            reached.map_or(f64::INFINITY, |p| (p - target).norm())
                        })
                        .collect(),
                    _ => Vec::new(),
                };
                branches_m.sort_by(f64::total_cmp);
                CaseError::Reach {
                    branches_m,
                    expected: *branches,
                }
            };
            (answer, error)
        }
    };
    CaseFacts {
        case,
        robot,
        answer,
        error,
    }
}

/// More than this is no list of branches.
const MOST_LISTED: usize = 64;

/// Branches, of which at most `most` differ by more than whole turns, so that an answer cannot be a guess at every sign.
fn distinct_branches(value: &Value, robot: &Robot, most: usize) -> Result<Vec<Vec<f64>>, String> {
    let branches = answer::branches(value, robot.n(), MOST_LISTED)?;
    match count_distinct(robot, &branches) {
        distinct if distinct > most => Err(format!(
            "{distinct} different branches where at most {most} exist: return the right ones only"
        )),
        _ => Ok(branches),
    }
}

/// Position of the TCP in the lab's frame \[m\]; `None` if `q` does not fit the robot.
pub fn tcp_in_lab(lab: &Lab, robot: &Robot, q: &[f64]) -> Option<Vector3<f64>> {
    tcp_in(robot, &lab.frame, q)
}

/// Position of the TCP in the frame `frame` \[m\]; `None` if `q` does not fit the robot, or there is no such frame.
pub fn tcp_in(robot: &Robot, frame: &str, q: &[f64]) -> Option<Vector3<f64>> {
    let q = robot.positions(q).ok()?;
    let poses = forward_kinematics(robot, &q);
    let world_from_lab = poses.world_from(robot.frame(frame)?);
    let lab_from_tcp = world_from_lab.inv_mul(&poses.world_from(robot.tcp()));
    Some(lab_from_tcp.translation.vector)
}

/// What a submission may know of `robot`; `effort_limits` are the task's, else the robot's own.
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

/// A number or a list of numbers as submissions get it.
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
        Value::Boolean(truth) => {
            hasher.update(if *truth { b"t" } else { b"f" });
        }
        // every NaN is one NaN: its bits are not the same on every platform
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
