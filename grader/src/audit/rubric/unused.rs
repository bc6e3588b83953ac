//! What a lab defines and nothing uses: parameters, variants of them, paths, sensors and frames.

use toml::Value;

use super::{Doubt, Rubric};
use crate::audit::typed;
use crate::lab::{Lab, Task, TaskWork};
use crate::task::value::Value as Target;

/// Whether a task has an expression that names a parameter.
pub(super) fn uses_parameters(lab: &Lab, task: &Task) -> bool {
    let table = typed::table(lab).unwrap_or_default();
    let task = typed::named(&table, "tasks", &task.name);
    let mut expressions = Vec::new();
    if let Some(motion) = task.and_then(|typed| typed.get("motion")) {
        texts(motion, &mut expressions);
    }
    let expressions = expressions.iter().filter_map(|text| text.strip_prefix('='));
    let mut named = expressions.flat_map(names);
    named.any(|name| lab.parameters.get(name).is_some())
}

/// Parameters that no expression of the lab names, and paths that no check does.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let Some(table) = typed::table(lab) else {
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

/// Sensors that a task adds, which no check names and the solution does not read.
pub(super) fn sensors(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let Some(table) = typed::table(lab) else {
        return;
    };
    let tasks = table.get("tasks").and_then(Value::as_array);
    for (task, typed) in lab.tasks.iter().zip(tasks.into_iter().flatten()) {
        let motion = typed.get("motion");
        let sensors = motion.and_then(|motion| motion.get("sensors"));
        let sensors = sensors.and_then(Value::as_array).into_iter().flatten();
        let mut named = Vec::new();
        if let Some(checks) = typed.get("checks") {
            texts(checks, &mut named);
        }
        for sensor in sensors {
            let Some(name) = sensor.get("name").and_then(Value::as_str) else {
                continue;
            };
            if named.contains(&name) || reads(rubric.staff.solution.text(), name) {
                continue;
            }
            doubts.push(Doubt {
                rule: "unused",
                of: format!("{}/{name}", task.name),
                what: "no check names this sensor, and the solution does not read it".to_owned(),
                help: "remove the sensor, or let a check such as `sensor-reads` look at it"
                    .to_owned(),
            });
        }
    }
}

/// Frames of a robot file that nothing names: neither the lab, nor the robot itself, nor the solution.
pub(super) fn frames(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let robot = lab.robot_file.source();
    // a URDF has a frame for each link
    let (Some(table), Ok(of_robot)) = (typed::table(lab), robot.text().parse::<toml::Table>())
    else {
        return;
    };
    let mut named = vec!["tcp", "lab", &lab.frame];
    table.values().for_each(|value| texts(value, &mut named));
    let hidden = rubric.staff.hidden_source.as_ref();
    let hidden = hidden.and_then(|source| source.text().parse::<toml::Table>().ok());
    if let Some(hidden) = &hidden {
        hidden.values().for_each(|value| texts(value, &mut named));
    }
    let others = of_robot.iter().filter(|(key, _)| *key != "frames");
    others.for_each(|(_, value)| texts(value, &mut named));
    let frames = of_robot.get("frames").and_then(Value::as_array);
    for frame in frames.into_iter().flatten() {
        let Some(name) = frame.get("name").and_then(Value::as_str) else {
            continue;
        };
        if named.contains(&name) || reads(rubric.staff.solution.text(), name) {
            continue;
        }
        doubts.push(Doubt {
            rule: "unused",
            of: name.to_owned(),
            what: format!(
                "neither the lab nor robot `{}` nor the solution names this frame",
                lab.robot.name()
            ),
            help: "remove the frame from the robot file, or accept it where another lab names it"
                .to_owned(),
        });
    }
}

/// Keys of targets that no submission of the course staff reads: whether they are right, nobody has tried.
pub(super) fn target_keys(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let staff = rubric.staff;
    let scripts: Vec<&str> = std::iter::once(&staff.solution)
        .chain(staff.mutants.iter().map(|mutant| &mutant.source))
        .map(|source| source.text())
        .collect();
    let mut known: Vec<String> = Vec::new();
    for task in &rubric.lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        let Target::Map(entries) = &motion.target else {
            continue;
        };
        for (name, _) in entries {
            let of = format!("target.{name}");
            if known.contains(&of) || scripts.iter().any(|script| reads(script, name)) {
                continue;
            }
            known.push(of.clone());
            doubts.push(Doubt {
                rule: "unused",
                of,
                what: format!(
                    "neither the solution nor a mutant reads this key of the target of task `{}`: nobody has tried its numbers",
                    task.name
                ),
                help: "let the solution use it, or remove it; where it is there to be ignored, accept it"
                    .to_owned(),
            });
        }
    }
}

/// Whether a script names `name` outside of its comments.
fn reads(script: &str, name: &str) -> bool {
    script.lines().any(|line| {
        let code = line.split("//").next().unwrap_or_default();
        names(code).any(|known| known == name)
    })
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

#[cfg(test)]
mod tests {
    use super::reads;

    #[test]
    fn a_comment_reads_nothing() {
        assert!(reads("if observation.sensors.at_end { 1 }", "at_end"));
        assert!(reads("let s = observation.sensors[\"at_end\"];", "at_end"));
        assert!(!reads("let x = 1; // at_end is not used", "at_end"));
        assert!(!reads("let at_end_too = 1;", "at_end"));
    }
}
