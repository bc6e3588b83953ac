//! Levels of a robustness sweep that disturb next to nothing, such as a payload in another unit: they repeat the undisturbed run.

use toml::{Table, Value};

use super::{Doubt, Rubric};
use crate::audit::typed;
use crate::lab::Lab;

/// A payload below this share of the robot's mass is hardly felt.
const LIGHT: f64 = 0.01;
/// A factor of the damping within this of 1 leaves it as it is.
const SAME_DAMPING: f64 = 0.02;
/// Noise on positions, and a shifted start, below this are nothing \[rad or m\].
const STILL: f64 = 1e-6;

/// What a level disturbs, with what that is too little for.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let lab = rubric.lab;
    let typed = typed::table(lab).unwrap_or_default();
    for task in &lab.tasks {
        let Some(table) = typed::named(&typed, "tasks", &task.name) else {
            continue;
        };
        for check in typed::tables(table, "checks") {
            let Some(("robustness", keys)) = typed::kind(check) else {
                continue;
            };
            for level in typed::tables(keys, "rungs") {
                if let Some(what) = too_little(lab.of_task(task), level) {
                    doubts.push(Doubt {
                        rule: "settings",
                        of: format!(
                            "{}/{}/{}",
                            task.name,
                            typed::name(check),
                            typed::name(level)
                        ),
                        what,
                        help: "is the number in kg, rad or m? A level that does nothing gives its points to everybody"
                            .to_owned(),
                    });
                }
            }
        }
    }
}

/// Why a level does nothing, where none of its disturbances does something.
fn too_little(lab: &Lab, level: &Table) -> Option<String> {
    let mut all = Vec::new();
    for (key, value) in level {
        let number = typed::number(value);
        match (key.as_str(), number) {
            ("name" | "share", _) => {}
            ("payload_kg", Some(payload)) => {
                let mass = lab.robot.mass_kg();
                if payload.abs() >= LIGHT * mass {
                    return None;
                }
                all.push(format!(
                    "its payload is {payload} kg, and the robot has {mass:.3} kg"
                ));
            }
            ("damping", Some(factor)) if (factor - 1.0).abs() < SAME_DAMPING => {
                all.push(format!("it multiplies the damping by {factor}"));
            }
            ("noise", _) if greatest(value) < STILL => {
                all.push("its noise is next to nothing".to_owned());
            }
            ("start_offset_rad" | "start_offset_rad_s", _) if greatest(value) < STILL => {
                all.push("it shifts the start by next to nothing".to_owned());
            }
            _ => return None,
        }
    }
    (!all.is_empty()).then(|| all.join(", and "))
}

/// The greatest number in a value; without bound where one is not typed as a number.
fn greatest(value: &Value) -> f64 {
    let of_all = |greatest: Vec<f64>| greatest.into_iter().fold(0.0, f64::max);
    match value {
        Value::Array(items) => of_all(items.iter().map(greatest).collect()),
        Value::Table(table) => of_all(table.iter().map(|(_, value)| greatest(value)).collect()),
        value => typed::number(value).map_or(f64::INFINITY, f64::abs),
    }
}
