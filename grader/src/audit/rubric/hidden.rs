//! What is hidden: tasks without any of it, cases and runs that are the visible ones or each other again, ranges of no width, and the salt
//! that they are drawn by.

use kinemark_sim::text::Dimension;

use super::unused::uses_parameters;
use super::{Doubt, Rubric};
use crate::judge::drawn_in_words;
use crate::lab::staff::HiddenCases;
use crate::lab::{Lab, Staff, Task, TaskWork};
use crate::task::entry::Entry;
use crate::task::model::{Case, Given};

/// A salt of fewer characters can be tried out.
const SHORTEST_SALT: usize = 12;

/// Whether two cases give the same.
pub(super) fn is_same(a: &Case, b: &Case) -> bool {
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
                let hidden: Vec<&HiddenCases> = hidden.collect();
                if hidden.is_empty() && function.cases.iter().all(can_be_drawn) {
                    doubts.push(nothing_hidden(task, ("cases", "draws")));
                }
                doubts.extend(drawn_twice(task, &hidden));
                doubts.extend(outnumbered(task, &hidden));
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
                    } else if is_of_one_position(&draw.cases) {
                        doubts.push(Doubt {
                            rule: "hidden",
                            of: of(first),
                            what: "the joints are at the same positions in all of its cases".to_owned(),
                            help: "widen the ranges of `q_rad`: one position cannot show what is wrong at others".to_owned(),
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
            TaskWork::Motion(..) => of_runs(lab, staff, task, doubts),
        }
    }
}

/// Whether several cases have one and the same joint positions.
fn is_of_one_position(cases: &[Case]) -> bool {
    let q = |case: &Case| match &case.given {
        Given::Q(q) => Some(q.clone()),
        Given::Motion(rows) => rows.first().cloned(),
        Given::Position { .. } | Given::Values { .. } => None,
    };
    let first = cases.first().and_then(q);
    cases.len() > 1 && first.is_some() && cases.iter().all(|case| q(case) == first)
}

/// A class with more cases than this share decides alone.
const MOST_OF_A_CLASS: f64 = 0.9;

/// A class of hidden cases beside which the others do not count: who is right in it alone has nearly all points.
fn outnumbered(task: &Task, hidden: &[&HiddenCases]) -> Option<Doubt> {
    let all: usize = hidden.iter().map(|draw| draw.cases.len()).sum();
    let most = hidden.iter().max_by_key(|draw| draw.cases.len())?;
    let class = most.cases.first()?.hidden_class.as_deref()?;
    let count = most.cases.len();
    let decides = count < all && count as f64 > MOST_OF_A_CLASS * all as f64;
    decides.then(|| Doubt {
        rule: "hidden",
        of: format!("{}/{class}", task.name),
        what: format!(
            "{count} of the {all} hidden cases of the task are of this class: who is wrong in all others loses next to nothing"
        ),
        help: "draw about as many cases of each class".to_owned(),
    })
}

/// The hidden runs of a motion task.
fn of_runs(lab: &Lab, staff: &Staff, task: &Task, doubts: &mut Vec<Doubt>) {
    let mut known: Vec<&str> = Vec::new();
    // nothing else can differ in a run
    if staff.runs(&task.name).is_empty() && uses_parameters(lab, task) {
        doubts.push(nothing_hidden(task, ("runs", "runs")));
    }
    for run in staff.runs(&task.name) {
        // other numbers may change nothing of this task
        let is_visible = run
            .drawn
            .iter()
            .all(|(name, value)| is_of_lab(lab, name, value))
            || run.lab.tasks.iter().any(|other| {
                other.name == task.name && is_same_task((&run.lab, other), (lab, task))
            });
        if is_visible && !known.contains(&run.class.as_str()) {
            known.push(&run.class);
            doubts.push(Doubt {
                rule: "hidden",
                of: format!("{}/{}", task.name, run.class),
                what: format!(
                    "run {} of the class has the numbers of the visible one, or others that the task does not use: {}",
                    run.number,
                    drawn_in_words(run)
                ),
                help: "draw other numbers, of parameters that this task uses: who types in an answer should lose here"
                    .to_owned(),
            });
        }
    }
}

/// Hidden runs in which the commands of the visible run earn everything.
pub(super) fn played_back(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let tasks = rubric
        .played_back
        .into_iter()
        .flat_map(|grade| &grade.tasks);
    for task in tasks {
        let fooled = task.hidden.iter().filter(|class| class.good == class.total);
        for class in fooled {
            let of = format!("{}/{}", task.name, class.class);
            let runs = match class.total {
                1 => "its run".to_owned(),
                total => format!("all {total} of its runs"),
            };
            if doubts.iter().any(|doubt| doubt.of == of) {
                continue;
            }
            doubts.push(Doubt {
                rule: "hidden",
                of,
                what: format!(
                    "a submission that plays back the commands of the visible run has full marks in {runs}: they ask for the same motion"
                ),
                help: "draw numbers that change the motion, from wider ranges".to_owned(),
            });
        }
    }
}

/// Whether cases such as this one can be drawn: there are ranges of numbers and lists.
fn can_be_drawn(case: &Case) -> bool {
    match &case.given {
        Given::Values { given, .. } => {
            let is_matrix = |entry: &Entry| matches!(entry, Entry::Matrix(_));
            !given.is_empty() && !given.iter().any(|(_, entry)| is_matrix(entry))
        }
        _ => true,
    }
}

/// A task of which students see everything: it has no `what`, which `table` of hidden.toml gives it.
fn nothing_hidden(task: &Task, (what, table): (&str, &str)) -> Doubt {
    Doubt {
        rule: "hidden",
        of: task.name.clone(),
        what: format!(
            "it has no hidden {what}: who types in what the visible ones ask for has all points"
        ),
        help: format!("write [[{table}]] for it in hidden.toml"),
    }
}

/// Two draws that give the same cases: numbers are drawn by the name of the class.
fn drawn_twice(task: &Task, draws: &[&HiddenCases]) -> Option<Doubt> {
    let is_again = |i: usize, draw: &HiddenCases| {
        let mut before = draws[..i].iter().flat_map(|first| &first.cases);
        let first = draw.cases.first();
        first.is_some_and(|case| before.any(|known| is_same(known, case)))
    };
    let mut again = draws.iter().enumerate();
    let (_, draw) = again.find(|(i, draw)| draw.cases.len() > 1 && is_again(*i, draw))?;
    let class = draw.cases.first()?.hidden_class.as_deref()?;
    Some(Doubt {
        rule: "hidden",
        of: format!("{}/{class}", task.name),
        what: "it draws the numbers of a draw before it: who fails one fails both".to_owned(),
        help: "give it a class of its own, and other ranges".to_owned(),
    })
}

/// Whether two tasks with these names are the same in everything that is typed.
fn is_same_task((lab_of_a, a): (&Lab, &Task), (lab_of_b, b): (&Lab, &Task)) -> bool {
    let robot = |lab: &Lab, task: &Task| {
        let own = lab.of_task(task);
        let name = own.robot.name().to_owned();
        (name, own.robot_file.dimensions().clone())
    };
    format!("{:?}", a.work) == format!("{:?}", b.work) && robot(lab_of_a, a) == robot(lab_of_b, b)
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
    } else if let Some(few) = few_signs(salt) {
        doubt(format!(
            "the salt is {few}: who tries such salts first finds the hidden numbers"
        ));
    }
}

/// A salt of fewer different signs is one that somebody types without thinking.
const LEAST_SIGNS: usize = 6;

/// What is too simple about a salt: a few signs again and again, or a row of digits.
fn few_signs(salt: &str) -> Option<&'static str> {
    let signs: std::collections::BTreeSet<char> = salt.chars().collect();
    let digits: Option<Vec<u32>> = salt.chars().map(|c| c.to_digit(10)).collect();
    let counts = |digits: &Vec<u32>| {
        let mut pairs = digits.windows(2);
        pairs.all(|pair| pair[1] == (pair[0] + 1) % 10)
    };
    if signs.len() < LEAST_SIGNS {
        Some("a few signs again and again")
    } else if digits.as_ref().is_some_and(counts) {
        Some("digits in a row")
    } else {
        None
    }
}
