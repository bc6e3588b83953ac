//! Starts that are on a path with the lab's own numbers, and beside it with others: a dimension, or the start itself, does not follow.

use super::{Doubt, Rubric};
use crate::lab::{Lab, Task, TaskWork};
use crate::record::quantity::with_unit;
use crate::task::model::MotionTask;
use crate::task::tcp::tcp_in;

/// An arm that starts this near to the first point of a path starts on it \[m\].
const ON_IT_M: f64 = 1e-3;
/// And one that is this far from it does not \[m\].
const BESIDE_M: f64 = 1e-2;

/// Looks at every path that begins where the arm does, in hidden runs and at the ends of what students draw.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let Rubric { lab, staff, .. } = *rubric;
    for task in &lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        let all = off_m(lab, task, motion).into_iter();
        let begun: Vec<usize> = all
            .enumerate()
            .filter_map(|(path, off_m)| (off_m < ON_IT_M).then_some(path))
            .collect();
        if begun.is_empty() {
            continue;
        }
        // the path beside which the arm starts with other numbers, and by how much
        let beside = |other: &Lab| {
            let drawn = other.tasks.iter().find(|drawn| drawn.name == task.name)?;
            let TaskWork::Motion(motion, _) = &drawn.work else {
                return None;
            };
            let off_m = off_m(other, drawn, motion);
            begun.iter().find_map(|path| {
                let off_m = off_m.get(*path).copied()?;
                (off_m > BESIDE_M).then_some((*path, off_m))
            })
        };
        let drawn = staff.runs(&task.name).into_iter();
        let mut runs = drawn.chain(staff.runs_at_ends(&task.name));
        let in_runs = runs.find_map(|run| {
            let words = format!("in class \"{}\"", run.class);
            Some((beside(&run.lab)?, words))
        });
        // the first two have every number at an end; one that cannot be loaded is found where the solution is tried in it
        let corners = lab.corners().unwrap_or_default();
        let at_corners = || {
            corners.iter().take(2).find_map(|corner| {
                let parameters = corner.variant.parameters();
                let numbers: Vec<_> = parameters
                    .map(|(name, value)| (name.to_owned(), value.clone()))
                    .collect();
                let other = lab.with_parameters(&numbers).ok()?;
                Some((beside(&other)?, format!("with {}", corner.words)))
            })
        };
        if let Some(((path, off_m), words)) = in_runs.or_else(at_corners) {
            doubts.push(Doubt {
                rule: "goals",
                of: format!("{}/start_rad", task.name),
                what: format!(
                    "with the lab's own numbers the arm starts on path `{}`, and {words} {} from its first point",
                    motion.paths[path].name,
                    with_unit(off_m, "m")
                ),
                help: "let the start, the dimensions and the path follow from the same parameters"
                    .to_owned(),
            });
        }
    }
}

/// How far the TCP is from the first point of each path at the start \[m\]; without bound where there is none.
fn off_m(lab: &Lab, task: &Task, motion: &MotionTask) -> Vec<f64> {
    let lab = lab.of_task(task);
    let start = tcp_in(&lab.robot, &lab.frame, &motion.start_q);
    let paths = motion.paths.iter();
    let off = paths.map(|path| Some((path.points_m.first()? - start?).norm()));
    off.map(|off_m| off_m.unwrap_or(f64::INFINITY)).collect()
}
