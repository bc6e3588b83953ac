//! What is hidden: cases and runs that are the visible ones again, ranges of no width, and the salt that they are drawn by.

use kinemark_sim::text::Dimension;

use super::{Doubt, Rubric};
use crate::lab::{Lab, Task, TaskWork};
use crate::task::model::{Case, Given};

/// A salt of fewer characters can be tried out.
const SHORTEST_SALT: usize = 12;

/// Visible cases with the same numbers.
pub(super) fn double_cases(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for task in &rubric.lab.tasks {
        let TaskWork::Function(function, _) = &task.work else {
            continue;
        };
        for (i, case) in function.cases.iter().enumerate() {
            let mut before = function.cases[..i].iter();
            if let Some(first) = before.find(|first| is_same(first, case)) {
                doubts.push(Doubt {
                    rule: "cases",
                    of: format!("{}/{}", task.name, case.name),
                    what: format!(
                        "the same numbers as case \"{}\": who fails one fails both",
                        first.name
                    ),
                    help: "give it other numbers, or remove it".to_owned(),
                });
            }
        }
    }
}

/// Whether two cases give the same.
fn is_same(a: &Case, b: &Case) -> bool {
    let same_given = match (&a.given, &b.given) {
        (Given::Q(a), Given::Q(b)) => a == b,
        (Given::Position { pose: a, .. }, Given::Position { pose: b, .. }) => a == b,
        (Given::Motion(a), Given::Motion(b)) => a == b,
        (Given::Values { given: a, .. }, Given::Values { given: b, .. }) => a == b,
        _ => false,
    };
    same_given && a.dimensions == b.dimensions && a.row == b.row
}

/// Hidden cases and runs that hide nothing.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let (lab, staff) = (rubric.lab, rubric.staff);
    for task in &lab.tasks {
        match &task.work {
            TaskWork::Function(function, _) => {
                let hidden = staff.draws.iter().filter(|draw| draw.task == task.name);
                for draw in hidden {
                    let of = |case: &Case| {
                        let class = case.hidden_class.as_deref().unwrap_or_default();
                        format!("{}/{class}", task.name)
                    };
                    let Some(first) = draw.cases.first() else {
                        continue;
                    };
                    let twice = draw.cases.iter().skip(1).find(|case| is_same(case, first));
                    let visible =
                        |case: &&Case| function.cases.iter().any(|known| is_same(known, case));
                    if twice.is_some() {
                        doubts.push(Doubt {
                            rule: "hidden",
                            of: of(first),
                            what:
                                "all of its cases have the same numbers: its ranges have no width"
                                    .to_owned(),
                            help: "widen the ranges of the draw, or let `count` be 1".to_owned(),
                        });
                    } else if draw
                        .cases
                        .iter()
                        .all(|case| has_own_dimensions(lab, task, case))
                    {
                        doubts.push(Doubt {
                            rule: "hidden",
                            of: of(first),
                            what: "the dimensions that it draws are the robot's own".to_owned(),
                            help: "draw others, or leave `dimensions` out".to_owned(),
                        });
                    } else if let Some(case) = draw.cases.iter().find(visible) {
                        doubts.push(Doubt {
                            rule: "hidden",
                            of: of(case),
                            what: "a hidden case has the numbers of a visible one".to_owned(),
                            help: "draw other numbers: who types in the visible answers should lose here".to_owned(),
                        });
                    }
                }
            }
            TaskWork::Motion(..) => {
                let mut known: Vec<&str> = Vec::new();
                for run in staff.runs(&task.name) {
                    // other numbers may change nothing of this task
                    let is_visible = run
                        .drawn
                        .iter()
                        .all(|(name, value)| is_of_lab(lab, name, value))
                        || run
                            .lab
                            .tasks
                            .iter()
                            .any(|other| other.name == task.name && is_same_task(other, task));
                    if is_visible && !known.contains(&run.class.as_str()) {
                        known.push(&run.class);
                        doubts.push(Doubt {
                            rule: "hidden",
                            of: format!("{}/{}", task.name, run.class),
                            what: "a hidden run has the numbers of the visible one".to_owned(),
                            help: "draw other numbers, of parameters that this task uses: who types in an answer should lose here"
                                .to_owned(),
                        });
                    }
                }
            }
        }
    }
}

/// Whether two tasks with these names are the same in everything that is typed.
fn is_same_task(a: &Task, b: &Task) -> bool {
    format!("{:?}", a.work) == format!("{:?}", b.work)
        && a.own
            .as_ref()
            .map(|own| own.robot_file.dimensions().clone())
            == b.own
                .as_ref()
                .map(|own| own.robot_file.dimensions().clone())
}

/// Whether a hidden case changes dimensions of the robot into those that it has.
fn has_own_dimensions(lab: &Lab, task: &Task, case: &Case) -> bool {
    let of_robot = lab.of_task(task).robot_file.dimensions();
    let mut changed = case.dimensions.iter();
    !case.dimensions.is_empty()
        && case.row.is_none()
        && changed.all(|(name, value)| of_robot.get(name) == Some(value))
}

/// Whether the visible run has this value of a parameter.
fn is_of_lab(lab: &Lab, name: &str, value: &Dimension) -> bool {
    lab.parameters.get(name) == Some(value)
}

/// A salt that somebody could know.
pub(super) fn salt(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Some(salt) = rubric.salt else {
        return;
    };
    let mut doubt = |what: String| {
        doubts.push(Doubt {
            rule: "salt",
            of: "salt".to_owned(),
            what,
            help: "write another one in hidden.toml, long and at random, and keep it to yourself"
                .to_owned(),
        });
    };
    if let Some((_, from)) = rubric.known_salts.iter().find(|(known, _)| known == salt) {
        doubt(format!("the salt is that of {from}: others know it"));
    } else if salt.chars().count() < SHORTEST_SALT {
        doubt(format!(
            "the salt is short, {} of at least {SHORTEST_SALT} characters: who tries all short ones finds the hidden numbers",
            salt.chars().count()
        ));
    }
}
