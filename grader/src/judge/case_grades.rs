//! The cases of a function task in the record: visible ones with their numbers, hidden ones by class.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;
use kinemark_sim::text::number::{list, lists, trimmed};

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::check::function_cases::entry_in_words;
use crate::lab::Lab;
use crate::record::grade::{CaseGrade, HiddenClass};
use crate::task::entry::Entry;
use crate::task::joint_units::JointUnits;
use crate::task::model::{About, Band, Case, Function, FunctionTask, Given};
use crate::task::pose::{PoseForm, pose_in};
use crate::task::quantity::STATE;
use crate::task::task_joints::TaskJoints;
use crate::task::tcp::tcp_in;

pub(super) fn case_grade(
    lab: &Lab,
    task: &FunctionTask,
    facts: &CaseFacts<'_>,
    band: Band,
) -> CaseGrade {
    let (robot, about) = (facts.robot, &task.about);
    let expected = match &facts.case.given {
        Given::Q(q) => match (&facts.error, &task.function) {
            (CaseError::Jacobian { truth, .. }, _) => Some(lists(truth)),
            (CaseError::Pose { .. }, Function::ForwardKinematics(form)) => {
                pose_in(robot, &lab.frame, q).map(|pose| pose_in_words(*form, &form.of(&pose)))
            }
            _ => tcp_in(robot, &lab.frame, q).map(|p| format!("{} m", list(p.as_slice()))),
        },
        // the expected angles would be the answer of the task
        Given::Position { branches, .. } => {
            (*branches == 0).then(|| "[] (out of reach)".to_owned())
        }
        Given::Motion(_) | Given::Values { .. } => Some(named_entries(facts.expected())),
    };
    let error_m = match &facts.error {
        CaseError::Position(error_m)
        | CaseError::Pose {
            position_m: error_m,
            ..
        } => Some(*error_m),
        CaseError::Reach { branches_m, .. } => branches_m.first().copied(),
        CaseError::Unreachable { .. } | CaseError::Jacobian { .. } | CaseError::Entries(_) => None,
    };
    let relative_error = match &facts.error {
        CaseError::Jacobian { relative, .. } => Some(*relative),
        CaseError::Entries(relative) => relative.iter().copied().max_by(f64::total_cmp),
        _ => None,
    };
    CaseGrade {
        name: facts.case.name.clone(),
        given: given_in_words(facts.case, robot, about),
        answer: match &facts.answer {
            Answered::Position(p) => format!("{} m", list(p.as_slice())),
            Answered::Pose(numbers) => match &task.function {
                Function::ForwardKinematics(form) => pose_in_words(*form, numbers),
                _ => list(numbers),
            },
            Answered::Branches(rows) => {
                let rows: Vec<Vec<f64>> = rows.iter().map(|q| of_task(q, robot, about)).collect();
                lists(&rows)
            }
            Answered::Matrix(rows) => lists(rows),
            Answered::Entries(answer) => {
                let names = facts.expected().iter().zip(answer);
                entries(names.map(|((name, like), numbers)| (name.as_str(), like.with(numbers))))
            }
            Answered::Invalid(what) => what.clone(),
            Answered::Stopped => "no answer".to_owned(),
        },
        expected,
        error_m: error_m.filter(|error_m| error_m.is_finite()),
        relative_error: relative_error.filter(|relative| relative.is_finite()),
        good: is_good(facts, band),
    }
}

/// The positions of the task's joints among those of all joints.
pub(super) fn of_task(q: &[f64], robot: &Robot, about: &About) -> Vec<f64> {
    let joints = TaskJoints::of(robot, &about.ignored);
    let entries = joints.entries().iter();
    entries.filter_map(|&entry| q.get(entry).copied()).collect()
}

fn pose_in_words(form: PoseForm, numbers: &[f64]) -> String {
    match form {
        PoseForm::Position => format!("{} m", list(numbers)),
        PoseForm::Full => {
            let rows: Vec<Vec<f64>> = numbers.chunks_exact(4).map(<[f64]>::to_vec).collect();
            lists(&rows)
        }
        PoseForm::Yaw | PoseForm::Axis { .. } => list(numbers),
    }
}

/// The input of a case in words, with the robot and the dimensions that are its own.
pub(super) fn given_in_words(case: &Case, robot: &Robot, about: &About) -> String {
    let unit = |q: &str| match JointUnits::of_all(robot) {
        JointUnits::Turning => q.to_owned(),
        _ => String::new(),
    };
    let given = match &case.given {
        Given::Q(q) => format!("q = {}{}", list(&of_task(q, robot, about)), unit(" rad")),
        Given::Motion(state) => {
            let values = STATE.iter().zip(state);
            let values = values.map(|((name, _), values)| format!("{name} = {}", list(values)));
            values.collect::<Vec<_>>().join(", ")
        }
        Given::Position {
            position_m, pose, ..
        } => match pose.as_slice() {
            position if position == position_m => format!("position = {} m", list(position_m)),
            pose if pose.len() == PoseForm::Full.numbers() => {
                format!("pose = {}", pose_in_words(PoseForm::Full, pose))
            }
            pose => format!("pose = {}", list(pose)),
        },
        Given::Values { given, .. } => named_entries(given),
    };
    let row = case.row.iter().map(|row| format!(", robot = {row}"));
    let changed = case.dimensions.iter().map(|(name, dimension)| {
        let value = match dimension {
            Dimension::Number(number) => trimmed(*number, 4),
            Dimension::List(numbers) => list(numbers),
            Dimension::Text(text) => text.clone(),
        };
        format!(", {name} = {value}")
    });
    given + row.chain(changed).collect::<String>().as_str()
}

pub(super) fn hidden_classes(facts: &[CaseFacts<'_>], band: Band) -> Vec<HiddenClass> {
    let mut classes: Vec<HiddenClass> = Vec::new();
    for facts in facts {
        let Some(class) = &facts.case.hidden_class else {
            continue;
        };
        let good = u32::from(is_good(facts, band));
        match classes.iter_mut().find(|known| known.class == *class) {
            Some(known) => {
                known.good += good;
                known.total += 1;
            }
            None => classes.push(HiddenClass {
                class: class.clone(),
                good,
                total: 1,
                under_resolved: 0,
            }),
        }
    }
    classes
}

/// Poses that are turned by less than this are turned alike \[rad\]: bands of angles belong to checks, and a case has one of metres.
pub(super) const SAME_ANGLE_RAD: f64 = 1e-3;

pub(super) fn is_good(facts: &CaseFacts<'_>, band: Band) -> bool {
    match &facts.error {
        CaseError::Position(error_m) => *error_m <= band.full,
        CaseError::Pose {
            position_m,
            angle_rad,
        } => *position_m <= band.full && *angle_rad <= SAME_ANGLE_RAD,
        CaseError::Reach {
            branches_m,
            angles_rad,
            ..
        } => branches_m
            .iter()
            .zip(angles_rad)
            .any(|(error_m, angle_rad)| *error_m <= band.full && *angle_rad <= SAME_ANGLE_RAD),
        CaseError::Unreachable { said_so } => *said_so,
        CaseError::Jacobian { relative, .. } => *relative <= band.full,
        CaseError::Entries(relative) => relative.iter().all(|relative| *relative <= band.full),
    }
}

/// Entries as people read them: `kp = 100, inertia = 0.1668`.
pub(super) fn named_entries(named: &[(String, Entry)]) -> String {
    entries(
        named
            .iter()
            .map(|(name, entry)| (name.as_str(), entry.clone())),
    )
}

/// The same of entries that are made for it.
pub(super) fn entries<'e>(entries: impl Iterator<Item = (&'e str, Entry)>) -> String {
    let texts: Vec<String> = entries
        .map(|(name, entry)| match name {
            "" => entry_in_words(&entry, 6),
            name => format!("{name} = {}", entry_in_words(&entry, 6)),
        })
        .collect();
    texts.join(", ")
}
