//! Bands that are thinner than what the simulation is accurate to: with half the physics step the reference solution reaches another
//! value.

use super::{Doubt, Rubric};
use crate::lab::TaskWork;
use crate::record::grade::{CheckGrade, Grade, Measure};
use crate::record::quantity::{with_unit, with_unit_unlike};

/// A value that moves by more than this share of the band's width is not accurate enough for it.
const SHARE: f64 = 0.05;

/// Checks of motion tasks whose value depends on the physics step.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let (Some(own), Some(finer)) = (rubric.reference, rubric.finer) else {
        return;
    };
    for task in &rubric.lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        let [own, finer] = [own, finer].map(|grade| measures(grade, &task.name));
        for (check, measure) in own {
            let mut same = finer.iter().filter(|(known, _)| known.name == check.name);
            let Some((_, finer)) = same.next() else {
                continue;
            };
            let (Some(value), Some(other)) = (measure.value, finer.value) else {
                continue;
            };
            let width = (measure.zero - measure.full).abs();
            let moved = (value - other).abs();
            if moved > SHARE * width {
                let unit = &measure.unit;
                let half_ms = 500.0 * motion.periods.step_s;
                doubts.push(Doubt {
                    rule: "accuracy",
                    of: format!("{}/{}", task.name, check.name),
                    what: format!(
                        "with half the physics step, {half_ms} ms, the reference solution reaches {} instead of {}: that is {} of the \
                         band's width, {}",
                        with_unit_unlike(other, value, unit),
                        with_unit_unlike(value, other, unit),
                        with_unit(moved / width, ""),
                        with_unit(width, unit),
                    ),
                    help: format!(
                        "widen the band, or write `physics_step_ms = {half_ms}` in [tasks.motion]"
                    ),
                });
            }
        }
    }
}

/// The checks of a task with what was measured in them.
fn measures<'g>(grade: &'g Grade, task: &str) -> Vec<(&'g CheckGrade, &'g Measure)> {
    let tasks = grade.tasks.iter().filter(|known| known.name == task);
    let checks = tasks.flat_map(|task| &task.checks);
    checks
        .filter_map(|check| Some((check, check.measure.as_ref()?)))
        .collect()
}
