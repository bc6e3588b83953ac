//! The checks of a scene, in their order.

use nalgebra::Vector3;

use super::finding::{Finding, Kind, Severity};
use super::{settle, via};
use crate::engine::{EngineError, Layout, Overlap};
use crate::kinematics::position_range::position_ranges;
use crate::kinematics::{FramePoses, IkError};
use crate::model::robot::Robot;
use crate::model::scene::Scene;

/// A smaller depth does not count as an overlap: contact is soft, and numbers in files are rounded \[m\].
pub const TOUCH_M: f64 = 1e-4;

/// A scene with more overlaps than this is not simulated: it would fly apart slowly and give no more findings.
const MOST_OVERLAPS: usize = 1000;

/// A robot in a scene, and the via points of its TCP.
#[derive(Debug, Clone)]
pub struct Work<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// Where its joints start, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// Via points of the TCP in the world, in their order \[m\].
    pub via_in_world: Vec<Vector3<f64>>,
    /// Whether the TCP is meant to follow the straight lines between them; if not, a blocked line is only a warning.
    pub in_straight_lines: bool,
}

/// A scene that cannot be checked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneCheckError {
    /// Robot or scene cannot have contact.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A start or a via point that is invalid.
    #[error(transparent)]
    Inverse(#[from] IkError),
}

/// Checks `scene` by itself or, with `work`, with a robot in it: first overlaps at the start, then bodies that do not stay at rest,
/// then the via points and the lines between them. If more than 1000 pairs of bodies overlap, the scene is not simulated.
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
        // a run shows nothing where neither of the two can move
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
