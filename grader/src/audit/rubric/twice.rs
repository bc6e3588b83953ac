//! What is there twice and counts twice: visible cases, checks, tasks, mutants.

use toml::{Table, Value as Toml};

use super::hidden::is_same;
use super::typed::{self, name, tables};
use super::{Doubt, Rubric};
use crate::lab::TaskWork;

/// Looks for all of them.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    cases(rubric, doubts);
    mutants(rubric, doubts);
    if let Some(table) = typed::table(rubric.lab) {
        let tasks = tables(&table, "tasks");
        checks(&tasks, doubts);
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
