//! The checks of a scene, in their order.

use nalgebra::Vector3;

use super::finding::{Finding, Kind, Severity};
use super::{settle, via};
use crate::engine::{EngineError, Layout, Overlap};
use crate::kinematics::position_range::position_ranges;
use crate::kinematics::{FramePoses, IkError};
use crate::model::robot::Robot;
use crate::model::scene::Scene;

/// Resting on something is no overlap: contact is soft, and people round their numbers \[m\].
pub const TOUCH_M: f64 = 1e-4;

/// With more overlaps than this a scene is not let be: it would fly apart, slowly, and say nothing more.
const MOST_OVERLAPS: usize = 1000;

/// A robot in a scene, and where its TCP is to come by.
#[derive(Debug, Clone)]
pub struct Work<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// Where its joints start, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// Places of the TCP in the world, in their order \[m\].
    pub via_in_world: Vec<Vector3<f64>>,
    /// Whether the straight lines between them are meant to be gone; where not, one that is blocked is only a warning.
    pub in_straight_lines: bool,
}

/// A scene that cannot be checked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneCheckError {
    /// Robot or scene cannot have contact.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A start or a via point that cannot be asked for.
    #[error(transparent)]
    Inverse(#[from] IkError),
}

/// Checks `scene` by itself or, with `work`, with a robot in it: overlaps at the start first, then what moves by itself, then the
/// via points and the lines between them. Where more than 1000 pairs of bodies overlap, what moves by itself is not looked at.
///
/// # Errors
/// [`SceneCheckError`] for shapes or masses the contact engine cannot use, and for a start of another shape than `(n)`, with
/// numbers that are not finite, or with loops that cannot be closed.
pub fn check(scene: &Scene, work: Option<&Work<'_>>) -> Result<Vec<Finding>, SceneCheckError> {
    let robot = work.map(|work| work.robot);
    let mut layout = Layout::new(scene, robot)?;
    let overlaps = layout.among_bodies(TOUCH_M);
    let mut findings: Vec<Finding> = overlaps.into_iter().map(overlapping).collect();
    let overlaps = findings.len();
    if let Some(work) = work {
        start_within_limits(work, &mut findings)?;
        let mut poses = FramePoses::new(work.robot);
        poses.update(work.robot, &work.start_q);
        layout.place_robot(work.robot, &poses);
        findings.extend(layout.of_links(TOUCH_M).into_iter().map(overlapping));
    }
    if overlaps <= MOST_OVERLAPS {
        settle::check(scene, robot, &mut layout.clone(), &mut findings)?;
    }
    if let Some(work) = work {
        via::check(scene, work, &mut layout, &mut findings)?;
    }
    Ok(findings)
}

fn overlapping(overlap: Overlap) -> Finding {
    Finding {
        // the run does not notice where neither gives way
        severity: if overlap.pushes {
            Severity::Error
        } else {
            Severity::Warning
        },
        kind: Kind::Overlap(overlap),
    }
}

fn start_within_limits(work: &Work<'_>, findings: &mut Vec<Finding>) -> Result<(), IkError> {
    let (expected, found) = (work.robot.n(), work.start_q.len());
    if expected != found {
        return Err(IkError::JointCount {
            what: "the start",
            expected,
            found,
        });
    }
    if !work.start_q.iter().all(|q| q.is_finite()) {
        return Err(IkError::Value {
            what: "the start",
            expected: "finite",
        });
    }
    let ranges = position_ranges(work.robot);
    for (joint, (range, &position)) in ranges.iter().zip(&work.start_q).enumerate() {
        if !range.contains(position) {
            findings.push(Finding {
                severity: Severity::Error,
                kind: Kind::StartBeyondLimit {
                    joint,
                    position,
                    limit: range.clamp(position),
                },
            });
        }
    }
    Ok(())
}
