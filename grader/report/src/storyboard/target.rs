//! Where a joint was to go, of tasks that judge its step response and so have no goal of the TCP.

use nalgebra::Point3;

use super::stage::Stage;
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::with_unit;

/// Targets that are described.
const MOST_TARGETS: usize = 2;

/// A joint and where it was to go, or how fast.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Target {
    joint: usize,
    name: String,
    /// Whether its velocity was to go there.
    of_velocity: bool,
    value: f64,
    unit: String,
}

/// The targets of the step responses that were judged, each once.
pub(super) fn targets(run: &TaskRun) -> Vec<Target> {
    let mut found: Vec<Target> = Vec::new();
    for curve in &run.curves {
        let Some(value) = curve.step.as_ref().and_then(|step| step.target) else {
            continue;
        };
        let mut joints = run.robot.moving_joints().enumerate();
        let named = joints.find(|(_, joint)| curve.title.contains(&format!("`{}`", joint.name)));
        let Some((joint, named)) = named else {
            continue;
        };
        let target = Target {
            joint,
            name: named.name.clone(),
            of_velocity: curve.title.starts_with("velocity"),
            value,
            unit: curve.unit.clone(),
        };
        if found.len() < MOST_TARGETS && !found.contains(&target) {
            found.push(target);
        }
    }
    found
}

impl Target {
    /// Where the joint is at a tick, and where it was to be.
    pub(super) fn describe(&self, run: &TaskRun, tick: usize) -> String {
        let column = if self.of_velocity {
            &run.trace.qd
        } else {
            &run.trace.q
        };
        let is = with_unit(column.at(tick)[self.joint], &self.unit);
        let target = with_unit(self.value, &self.unit);
        let verb = if self.of_velocity { "goes at" } else { "is at" };
        format!("joint {} {verb} {is}, its target is {target}", self.name)
    }

    /// From the joint to where the TCP would be, were the joint at its target and all others where they are; none of a velocity.
    pub(super) fn aim(&self, stage: &Stage<'_>, tick: Option<usize>) -> Option<[Point3<f64>; 2]> {
        (!self.of_velocity).then(|| stage.aimed(tick, self.joint, self.value))
    }
}
