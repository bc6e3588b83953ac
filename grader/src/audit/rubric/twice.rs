//! What is there twice and counts twice: visible cases, checks, tasks, mutants.

use toml::{Table, Value as Toml};

use super::hidden::is_same;
use super::{Doubt, Rubric};
use crate::audit::typed::{self, name, tables};
use crate::lab::TaskWork;

/// Looks for all of them.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    cases(rubric, doubts);
    mutants(rubric, doubts);
    says(rubric, doubts);
    if let Some(table) = typed::table(rubric.lab) {
        let tasks = tables(&table, "tasks");
        checks(&tasks, doubts);
        titles(&tasks, doubts);
        segments(&tasks, doubts);
        functions(&tasks, doubts);
    }
}

fn doubt(of: String, what: String, help: &str) -> Doubt {
    Doubt {
        rule: "cases",
        of,
        what,
        help: help.to_owned(),
    }
}

/// Visible cases with the same numbers.
fn cases(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    for task in &rubric.lab.tasks {
        let TaskWork::Function(function, _) = &task.work else {
            continue;
        };
        for (i, case) in function.cases.iter().enumerate() {
            let mut before = function.cases[..i].iter();
            if let Some(first) = before.find(|first| is_same(first, case)) {
                doubts.push(doubt(
                    format!("{}/{}", task.name, case.name),
                    format!(
                        "the same numbers as case \"{}\": who fails one fails both",
                        first.name
                    ),
                    "give it other numbers, or remove it",
                ));
            }
        }
    }
}

/// Two files with the same mistake.
fn mutants(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let all = &rubric.staff.mutants;
    for (i, mutant) in all.iter().enumerate() {
        let mut before = all[..i].iter();
        let text = mutant.source.text().trim();
        if let Some(first) = before
            .find(|first| first.is_named == mutant.is_named && first.source.text().trim() == text)
        {
            doubts.push(doubt(
                format!("mutant {}", mutant.name),
                format!("its file is that of mutant `{}`", first.name),
                "one entry names all tasks of a mistake: put `says` for each task into it",
            ));
        }
    }
}

/// Two mutants of one task that begin with the same sentence: one of the two was copied.
fn says(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let named = rubric.staff.mutants.iter().filter(|mutant| mutant.is_named);
    let named: Vec<_> = named.collect();
    for (i, mutant) in named.iter().enumerate() {
        let same = named[..i].iter().find(|first| {
            let mut tasks = mutant.tasks.iter();
            let says = first_sentence(&mutant.says);
            // a file that was just begun has the same TODO everywhere
            !says.starts_with("TODO")
                && says == first_sentence(&first.says)
                && mutant.says_in.is_empty()
                && first.says_in.is_empty()
                && tasks.any(|task| first.tasks.contains(task))
        });
        if let Some(first) = same {
            doubts.push(doubt(
                format!("mutant {}", mutant.name),
                format!(
                    "it says what mutant `{}` says: \"{}\"",
                    first.name,
                    first_sentence(&first.says)
                ),
                "say in each what was done, and what to do instead",
            ));
        }
    }
}

fn first_sentence(says: &str) -> &str {
    let says = says.trim();
    says.split_once(". ").map_or(says, |(first, _)| first)
}

/// Checks of one task that measure the same.
fn checks(tasks: &[&Table], doubts: &mut Vec<Doubt>) {
    for task in tasks {
        let checks = tables(task, "checks");
        for (i, check) in checks.iter().enumerate() {
            let measures = measures(check);
            let mut before = checks[..i].iter();
            let same = before.find(|first| self::measures(first) == measures);
            if let Some(first) = same.filter(|_| !measures.is_empty()) {
                doubts.push(doubt(
                    format!("{}/{}", name(task), name(check)),
                    format!(
                        "it measures what check `{}` does, in the same band",
                        name(first)
                    ),
                    "remove one of the two, or change what it measures",
                ));
            }
        }
    }
}

/// Checks of one task with the same title: the table of points has two rows that nobody can tell apart.
fn titles(tasks: &[&Table], doubts: &mut Vec<Doubt>) {
    let title = |check: &Table| {
        check
            .get("title")
            .and_then(Toml::as_str)
            .map(str::to_lowercase)
    };
    for task in tasks {
        let checks = tables(task, "checks");
        for (i, check) in checks.iter().enumerate() {
            // a file that was just begun has the same TODO everywhere
            let own = title(check).filter(|title| !title.starts_with("todo"));
            let mut before = checks[..i].iter();
            if let Some(first) = before.find(|first| own.is_some() && title(first) == own) {
                doubts.push(doubt(
                    format!("{}/{}", name(task), name(check)),
                    format!("it has the title of check `{}`", name(first)),
                    "say in each title what it measures",
                ));
            }
        }
    }
}

/// Two checks of one kind that follow the same segment of a path, another segment of which none follows.
fn segments(tasks: &[&Table], doubts: &mut Vec<Doubt>) {
    for task in tasks {
        let checks = tables(task, "checks");
        let followed: Vec<(&str, &str, i64)> = checks
            .iter()
            .filter_map(|check| {
                let (kind, keys) = typed::kind(check)?;
                let path = keys.get("path")?.as_str()?;
                Some((kind, path, keys.get("segment")?.as_integer()?))
            })
            .collect();
        for (i, one) in followed.iter().enumerate() {
            let alike = |other: &&(&str, &str, i64)| other.0 == one.0 && other.1 == one.1;
            let is_again = followed[..i].contains(one);
            let others = followed.iter().filter(alike).all(|other| other.2 == one.2);
            let count = task
                .get("motion")
                .and_then(|motion| motion.get("paths")?.get(one.1)?.get("points_m")?.as_array())
                .map_or(0, Vec::len);
            if is_again && others && count > 2 {
                doubts.push(doubt(
                    format!("{}/{}", name(task), one.1),
                    format!(
                        "two checks `{}` follow segment {} of the path, and none another of its {}",
                        one.0,
                        one.2,
                        count - 1
                    ),
                    "let each of them follow its own segment",
                ));
            }
        }
    }
}

/// What a check measures: its table of its kind.
fn measures(check: &Table) -> Vec<(&String, &Toml)> {
    check.iter().filter(|(_, value)| value.is_table()).collect()
}

/// Tasks that call the same function with the same cases.
fn functions(tasks: &[&Table], doubts: &mut Vec<Doubt>) {
    for (i, task) in tasks.iter().enumerate() {
        let Some(function) = task.get("function") else {
            continue;
        };
        let mut before = tasks[..i].iter();
        let is_same = |first: &&&Table| {
            let mut keys = ["robot", "dimensions"].into_iter();
            first.get("function") == Some(function)
                && keys.all(|key| first.get(key) == task.get(key))
        };
        if let Some(first) = before.find(is_same) {
            doubts.push(doubt(
                name(task).to_owned(),
                format!(
                    "it calls the function of task `{}` with the same cases",
                    name(first)
                ),
                "one function earns its points once: remove one of the two",
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_that_is_followed_twice_while_another_is_not_is_found() {
        let task = |first: u32, second: u32| {
            let check = |segment: u32| {
                format!(
                    "[[checks]]\nname = \"c\"\npath-end = {{ path = \"line\", segment = {segment} }}\n"
                )
            };
            let path = "motion.paths.line.points_m = [[1, 0], [1, 1], [2, 1]]\n";
            let text = format!("name = \"t\"\n{path}{}{}", check(first), check(second));
            text.parse::<Table>().expect("TOML")
        };
        for (segments, count) in [([1, 1], 1), ([1, 2], 0)] {
            let task = task(segments[0], segments[1]);
            let mut doubts = Vec::new();
            super::segments(&[&task], &mut doubts);
            assert_eq!(doubts.len(), count, "{segments:?}: {doubts:?}");
        }
    }
}
