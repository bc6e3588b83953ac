//! Names in the brief, in hints and in what mutants say: what of `robot`, `target`, `sensors` and `given` they mention is there, and
//! nothing waits to be written.

use std::collections::BTreeSet;

use super::{Doubt, Rubric};
use crate::lab::{Task, TaskWork};
use crate::submission::controller::{Grant, MEASURED};
use crate::task::model::Given;
use crate::task::value::Value;

/// What a lab has not decided yet.
const TODO: &str = "TODO";
/// What `observation` has besides what is measured.
const GIVEN: [&str; 3] = ["task", "target", "sensors"];
/// What `robot` has besides its dimensions.
const OF_EVERY_ROBOT: [&str; 6] = ["name", "joints", "joint_names", "lower", "upper", "effort"];

/// Looks at every text.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let known = Known::of(rubric);
    for (place, text) in texts(rubric) {
        // code may show the marks of a starter
        let times = outside_of_code(text).map(|part| part.matches(TODO).count());
        let times: usize = times.sum();
        if times > 0 {
            doubts.push(Doubt {
                rule: "names",
                of: place.clone(),
                what: match times {
                    1 => format!("it still says {TODO}"),
                    times => format!("it still says {TODO}, {times} times"),
                },
                help: "write what is missing there: students read it".to_owned(),
            });
        }
        let mut observed = members(text, "observation");
        let is_there = |name: &&str| GIVEN.contains(name) || MEASURED.contains(name);
        if let Some(name) = observed.find(|name| !is_there(name)) {
            doubts.push(Doubt {
                rule: "names",
                of: place.clone(),
                what: format!("it mentions `observation.{name}`, which there is not"),
                help: format!(
                    "`observation` has {}",
                    [&GIVEN[..], &MEASURED].concat().join(", ")
                ),
            });
        }
        let of_list = members(text, "observation.target").next();
        if let Some(name) = of_list.filter(|_| known.has_goals_alone(rubric)) {
            doubts.push(Doubt {
                rule: "names",
                of: place.clone(),
                what: format!(
                    "it mentions `observation.target.{name}`, and the target is the list of goals"
                ),
                help: "write `observation.target[0]`, or give the task a `target` with names"
                    .to_owned(),
            });
        }
        doubts.extend(swapped_arguments(rubric, &place, text));
        for (owner, names) in known.by_owner() {
            let missing = members(text, owner).find(|name| !names.contains(*name));
            if let Some(name) = missing {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                doubts.push(Doubt {
                    rule: "names",
                    of: place.clone(),
                    what: format!("it mentions `{owner}.{name}`, which there is not"),
                    help: format!("`{owner}` has {}", names.join(", ")),
                });
            }
        }
    }
}

/// A call of a task's function whose arguments stand in another order than they are given.
fn swapped_arguments(rubric: &Rubric<'_>, place: &str, text: &str) -> Option<Doubt> {
    let code = parts(text).0;
    rubric.lab.tasks.iter().find_map(|task| {
        let TaskWork::Function(function, _) = &task.work else {
            return None;
        };
        let (name, parameters) = (function.name(), function.parameters());
        let is_other_order = |given: &Vec<&str>| {
            let mut sorted = [given.clone(), parameters.clone()];
            sorted.iter_mut().for_each(|names| names.sort_unstable());
            sorted[0] == sorted[1] && *given != parameters
        };
        let given = code.iter().find_map(|code| {
            let (_, rest) = code.split_once(&format!("{name}("))?;
            let (inside, _) = rest.split_once(')')?;
            let given: Vec<&str> = inside.split(',').map(str::trim).collect();
            is_other_order(&given).then_some(given)
        })?;
        Some(Doubt {
            rule: "names",
            of: place.to_owned(),
            what: format!(
                "it says `{name}({})`, and the function is called as `{name}({})`",
                given.join(", "),
                parameters.join(", ")
            ),
            help: "write the arguments in the order in which they are given".to_owned(),
        })
    })
}

/// The texts that students read, each with its place.
fn texts<'a>(rubric: &'a Rubric<'_>) -> impl Iterator<Item = (String, &'a str)> {
    let brief = rubric.brief.map(|brief| ("brief".to_owned(), brief));
    let of_tasks = rubric.lab.tasks.iter().flat_map(of_task);
    let says = rubric.staff.mutants.iter().flat_map(|mutant| {
        // where there are words for each task, they begin with those for the first
        let for_all = mutant.says_in.is_empty().then_some(&mutant.says);
        let words = for_all.into_iter().chain(mutant.says_in.values());
        words.map(move |words| (format!("mutant {}", mutant.name), words.as_str()))
    });
    let of_lab = [&rubric.lab.title, &rubric.lab.summary];
    let of_lab = of_lab.map(|text| ("lab".to_owned(), text.as_str()));
    let texts = brief.into_iter().chain(of_lab);
    texts.chain(of_tasks).chain(says)
}

fn of_task(task: &Task) -> impl Iterator<Item = (String, &str)> {
    let title = (task.name.clone(), task.title.as_str());
    let of_checks = task.checks().into_iter().flat_map(move |check| {
        let texts = std::iter::once(&check.title).chain(&check.hints);
        let place = format!("{}/{}", task.name, check.name);
        texts.map(move |text| (place.clone(), text.as_str()))
    });
    std::iter::once(title).chain(of_checks)
}

/// The names that there are, in any task.
struct Known {
    robot: BTreeSet<String>,
    target: BTreeSet<String>,
    sensors: BTreeSet<String>,
    given: BTreeSet<String>,
}

impl Known {
    fn of(rubric: &Rubric<'_>) -> Self {
        let mut known = Self {
            robot: OF_EVERY_ROBOT.map(str::to_owned).into(),
            target: BTreeSet::new(),
            sensors: BTreeSet::new(),
            given: BTreeSet::new(),
        };
        known
            .robot
            .extend(Grant::ALL.iter().map(|grant| grant.name().to_owned()));
        for task in &rubric.lab.tasks {
            let lab = rubric.lab.of_task(task);
            let dimensions = lab.robot_file.dimensions().names();
            known.robot.extend(dimensions.map(str::to_owned));
            match &task.work {
                TaskWork::Function(function, _) => {
                    let hidden = rubric.staff.draws.iter().flat_map(|draw| &draw.cases);
                    let cases = function.cases.iter().chain(hidden);
                    let robots = cases.filter_map(|case| case.robot.as_deref());
                    for case in &function.cases {
                        if let Given::Values { given, .. } = &case.given {
                            let names = given.iter().map(|(name, _)| name.clone());
                            known.given.extend(names);
                        }
                    }
                    let own = robots.flat_map(|robot| robot.dimensions().names());
                    known.robot.extend(own.map(str::to_owned));
                }
                TaskWork::Motion(motion, _) => {
                    if let Value::Map(entries) = &motion.target {
                        known
                            .target
                            .extend(entries.iter().map(|(name, _)| name.clone()));
                    }
                    let sensors = motion.sensors.iter();
                    known
                        .sensors
                        .extend(sensors.map(|sensor| sensor.name.clone()));
                }
            }
        }
        known
    }

    /// Whether students are given goals alone: a list, without names.
    fn has_goals_alone(&self, rubric: &Rubric<'_>) -> bool {
        let mut tasks = rubric.lab.tasks.iter();
        self.target.is_empty() && tasks.any(|task| matches!(task.work, TaskWork::Motion(..)))
    }

    /// Those that have names: a list, or what no task has, has none.
    fn by_owner(&self) -> impl Iterator<Item = (&'static str, &BTreeSet<String>)> {
        let all = [
            ("robot", &self.robot),
            ("target", &self.target),
            ("sensors", &self.sensors),
            ("given", &self.given),
        ];
        all.into_iter().filter(|(_, names)| !names.is_empty())
    }
}

/// The code of a text: blocks between fences, and what stands between backticks in a line; with what is no code.
fn parts(text: &str) -> (Vec<&str>, Vec<&str>) {
    let (mut code, mut words) = (Vec::new(), Vec::new());
    let mut is_fenced = false;
    for line in text.lines() {
        let start = line.trim_start();
        if start.starts_with("```") || start.starts_with("~~~") {
            is_fenced = !is_fenced;
        } else if is_fenced {
            code.push(line);
        } else {
            code.extend(line.split('`').skip(1).step_by(2));
            words.extend(line.split('`').step_by(2));
        }
    }
    (code, words)
}

fn outside_of_code(text: &str) -> impl Iterator<Item = &str> {
    parts(text).1.into_iter()
}

/// The names after `owner.` in the code of a text, `` `robot.lengths[0]` ``; what is called is a method, and what ends like a file is one.
fn members<'t>(text: &'t str, owner: &'static str) -> impl Iterator<Item = &'t str> {
    const ENDINGS: [&str; 6] = ["toml", "urdf", "rhai", "py", "rs", "csv"];
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let code = parts(text).0.into_iter();
    code.flat_map(move |code| {
        code.match_indices(owner).filter_map(move |(at, _)| {
            if code[..at].ends_with(|c| is_of_name(c) || c == '-' || c == '/') {
                return None;
            }
            let rest = code[at + owner.len()..].strip_prefix('.')?;
            let end = rest.find(|c| !is_of_name(c)).unwrap_or(rest.len());
            let (name, behind) = rest.split_at(end);
            let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
                && !behind.starts_with('(')
                && !ENDINGS.contains(&name);
            is_name.then_some(name)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{TODO, members, outside_of_code};

    #[test]
    fn names_are_those_of_the_owner_and_in_code_alone() {
        let text = "A robot.arm, `robot.link[0] + my_robot.x`, `observation.target.to`.";
        assert_eq!(members(text, "robot").collect::<Vec<_>>(), ["link"]);
        assert_eq!(members(text, "target").collect::<Vec<_>>(), ["to"]);
        for text in [
            "`robot.KEY`",
            "`robot.dimensions()`",
            "`labs/robots/robot.urdf`",
            "```\nan odd ` here\n```\nrobot.arm",
        ] {
            assert_eq!(members(text, "robot").count(), 0, "{text}");
        }
        let fenced = "```rhai\nlet a = robot.arm;\n```";
        assert_eq!(members(fenced, "robot").collect::<Vec<_>>(), ["arm"]);
    }

    #[test]
    fn what_code_says_is_no_todo_of_the_text() {
        let text = "Replace `# TODO` there.\n```\n// TODO: write\n```\nTODO: the theory";
        let found: Vec<&str> = outside_of_code(text)
            .filter(|part| part.contains(TODO))
            .collect();
        assert_eq!(found, ["TODO: the theory"]);
    }
}
