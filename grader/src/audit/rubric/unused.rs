//! What a lab defines and nothing uses: parameters, variants of them, paths, and names of sensors that nobody reads about.

use toml::Value;

use super::{Doubt, Rubric};
use crate::lab::TaskWork;

/// Parameters that no expression of the lab names, and paths that no check does.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let Ok(table) = lab.source.text().parse::<toml::Table>() else {
        return;
    };
    let mut expressions = Vec::new();
    let mut followed = Vec::new();
    for (key, value) in &table {
        if key != "parameters" && key != "variants" {
            texts(value, &mut expressions);
        }
    }
    if let Some(tasks) = table.get("tasks").and_then(Value::as_array) {
        let of_checks = tasks.iter().filter_map(|task| task.get("checks"));
        of_checks.for_each(|value| paths(value, &mut followed));
    }
    for name in lab.parameters.names() {
        let used = expressions.iter().any(|text| {
            let expression = text.strip_prefix('=');
            expression.is_some_and(|expression| names(expression).any(|known| known == name))
        });
        if used {
            continue;
        }
        let varies = lab.variants.iter().any(|rule| rule.name == name);
        doubts.push(Doubt {
            rule: "unused",
            of: name.to_owned(),
            what: match varies {
                true => "no expression of lab.toml uses this parameter, although it differs from student to student",
                false => "no expression of lab.toml uses this parameter",
            }
            .to_owned(),
            help: format!("write `\"= {name}\"` where its number stands, or remove it"),
        });
    }
    for task in &lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        for path in &motion.paths {
            if !followed.iter().any(|name| *name == path.name) {
                doubts.push(Doubt {
                    rule: "unused",
                    of: format!("{}/{}", task.name, path.name),
                    what: "no check follows this path: it is only drawn".to_owned(),
                    help: "add a check such as `path-deviation`, or remove the path".to_owned(),
                });
            }
        }
    }
}

/// All texts in a value.
fn texts<'v>(value: &'v Value, found: &mut Vec<&'v str>) {
    match value {
        Value::String(text) => found.push(text),
        Value::Array(items) => items.iter().for_each(|item| texts(item, found)),
        Value::Table(table) => table.values().for_each(|item| texts(item, found)),
        _ => {}
    }
}

/// The paths that checks name.
fn paths<'v>(value: &'v Value, found: &mut Vec<&'v str>) {
    match value {
        Value::Array(items) => items.iter().for_each(|item| paths(item, found)),
        Value::Table(table) => table.iter().for_each(|(key, item)| match item {
            Value::String(name) if key == "path" => found.push(name),
            item => paths(item, found),
        }),
        _ => {}
    }
}

/// The names in an expression.
fn names(expression: &str) -> impl Iterator<Item = &str> {
    let words = expression.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.filter(|word| word.starts_with(|c: char| c.is_alphabetic() || c == '_'))
}
