//! The checks of a scene, in their order.

use nalgebra::Vector3;

use super::finding::{Finding, Kind, Severity, Unchecked};
use super::progress::{Budgets, Progress, Stage, Watch};
use super::{settle, via};
use crate::dynamics::immovable_joint;
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
/// then the via points and the lines between them. If more than 1000 pairs of bodies overlap, the scene is not simulated. What would be
/// too much work is left out, and a finding of its own.
///
/// # Errors
/// [`SceneCheckError`] for shapes or masses the contact engine cannot use, and for a start of another shape than `(n)`, with
/// numbers that are not finite, or with loops that cannot be closed.
pub fn check(scene: &Scene, work: Option<&Work<'_>>) -> Result<Vec<Finding>, SceneCheckError> {
    check_watched(scene, work, &mut |_| {})
}

/// The same, and `watch` gets to know how far it is.
///
/// # Errors
/// As [`check`].
pub fn check_watched(
    scene: &Scene,
    work: Option<&Work<'_>>,
    watch: Watch<'_>,
) -> Result<Vec<Finding>, SceneCheckError> {
    check_within(scene, work, watch, Budgets::default())
}

/// The same, within `budgets`.
fn check_within(
    scene: &Scene,
    work: Option<&Work<'_>>,
    watch: Watch<'_>,
    budgets: Budgets,
) -> Result<Vec<Finding>, SceneCheckError> {
    let Budgets {
        overlaps: mut budget,
        settling,
        via,
    } = budgets;

    watch(Progress {
        stage: Stage::Overlaps,
        done: 0,
        of: 1,
    });
    let robot = work.map(|work| work.robot);
    let mut layout = Layout::new(scene, robot)?;
    let overlaps = layout.among_bodies(TOUCH_M, &mut budget);
    let mut findings: Vec<Finding> = overlaps.into_iter().map(overlapping).collect();
    let overlaps = findings.len();
    if let Some(work) = work {
        start_within_limits(work, &mut findings)?;
        findings.extend(cannot_move(work.robot));
        let mut poses = FramePoses::new(work.robot);
        poses.update(work.robot, &work.start_q);
        layout.place_robot(work.robot, &poses);
        let overlaps = layout.of_links(TOUCH_M, &mut budget);
        findings.extend(overlaps.into_iter().map(overlapping));
    }
    if budget.is_spent() {
        findings.push(not_checked(Unchecked::Overlaps));
    }
    if overlaps <= MOST_OVERLAPS {
        let mut layout = layout.clone();
        settle::check(scene, robot, &mut layout, &mut findings, watch, settling)?;
    } else {
        findings.push(not_checked(Unchecked::Stay));
    }
    if let Some(work) = work {
        via::check(scene, work, &mut layout, &mut findings, watch, via)?;
    }
    Ok(findings)
}

pub(super) fn not_checked(what: Unchecked) -> Finding {
    Finding {
        severity: Severity::Warning,
        kind: Kind::NotChecked(what),
    }
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

fn cannot_move(robot: &Robot) -> Option<Finding> {
    immovable_joint(robot).map(|singular| Finding {
        severity: Severity::Warning,
        kind: Kind::CannotMove {
            joint: singular.joint,
        },
    })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::WorkBudget;
    use crate::format::{RobotFile, SceneFile};
    use crate::text::Source;

    /// A box that falls onto another one, and an arm of one joint beside them.
    const SCENE: &str = "format = 1\nname = 's'\nenvironment = { ground = { friction = 0.4 } }\n\
        [[bodies]]\nname = 'low'\ntype = 'fixed'\norigin = { xyz_m = [3, 0, 0.05] }\n\
        shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ncontact = { friction = 0.4 }\n\
        [[bodies]]\nname = 'high'\ntype = 'free'\norigin = { xyz_m = [3, 0, 0.4] }\ninertia = { mass_kg = 1.0 }\n\
        shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ncontact = { friction = 0.4 }\n";
    const ARM: &str = "format = 1\nname = 'arm'\n[[links]]\nname = 'base'\n[[links]]\nname = 'bar'\n\
        shapes = [{ box = { size_m = [0.1, 0.1, 1.0] }, origin = { xyz_m = [0, 0, 0.5] } }]\n\
        inertia = { mass_kg = 1.0 }\n[[joints]]\nname = 'hinge'\ntype = 'revolute'\nparent = 'base'\nchild = 'bar'\n\
        origin = { xyz_m = [0, 0, 0.2] }\naxis = [0, 1, 0]\n\
        [[frames]]\nname = 'tcp'\nlink = 'bar'\norigin = { xyz_m = [0, 0, 1] }\n";

    /// The kinds of what is found in the scene with the arm, where the stages may cost so much; and how far it was, stage by stage.
    fn found(overlaps: u64, settling: u64, via: u64) -> (Vec<Kind>, Vec<Progress>) {
        let scene = SceneFile::parse(Source::new("s", SCENE)).unwrap();
        let scene = scene.build(&[]).unwrap();
        let arm = RobotFile::parse(Source::new("arm", ARM)).unwrap();
        let arm = arm.build(&[]).unwrap();
        let work = Work {
            robot: &arm,
            start_q: vec![0.0],
            via_in_world: [0.1_f64, 0.2, 0.3]
                .map(|q| Vector3::new(libm::sin(q), 0.0, 0.2 + libm::cos(q)))
                .to_vec(),
            in_straight_lines: false,
        };
        let budgets = Budgets {
            overlaps: WorkBudget::new(overlaps),
            settling: WorkBudget::new(settling),
            via: WorkBudget::new(via),
        };
        let mut seen = Vec::new();
        let findings = check_within(&scene, Some(&work), &mut |at| seen.push(at), budgets);
        let kinds = findings.unwrap().into_iter().map(|one| one.kind);
        (kinds.collect(), seen)
    }

    #[test]
    fn what_is_too_much_work_is_left_out_and_reported() {
        let most = u64::MAX;
        let (whole, seen) = found(most, most, most);
        let cut = |kinds: &[Kind]| -> Vec<Unchecked> {
            let cut = kinds.iter().filter_map(|kind| match kind {
                Kind::NotChecked(what) => Some(*what),
                _ => None,
            });
            cut.collect()
        };
        assert_eq!(cut(&whole), [], "{whole:?}");
        assert!(whole.iter().any(|kind| matches!(kind, Kind::Moves { .. })));
        let stages: Vec<Stage> = seen.iter().map(|at| at.stage).collect();
        for stage in [Stage::Overlaps, Stage::Settling, Stage::Via] {
            assert!(stages.contains(&stage), "{stages:?}");
        }
        assert!(seen.iter().all(|at| at.done <= at.of), "{seen:?}");

        assert_eq!(cut(&found(0, most, most).0), [Unchecked::Overlaps]);
        let settled = cut(&found(most, 20_000, most).0);
        let [Unchecked::StayFrom(from_s)] = settled[..] else {
            panic!("{settled:?}")
        };
        assert!(from_s > 0.0 && from_s < 1.0, "{from_s}");
        // nobody knows yet where it would end
        let (kinds, _) = found(most, 20_000, most);
        assert!(!kinds.iter().any(|kind| matches!(kind, Kind::Moves { .. })));
        assert_eq!(cut(&found(most, most, 0).0), [Unchecked::ViaFrom(0)]);
        // the same on every machine
        assert_eq!(found(most, 20_000, 1_000).0, found(most, 20_000, 1_000).0);
        // each point costs the same, and so does each line: somewhere between is the first one that is left out
        let mut seen = Vec::new();
        for thousands in 0..2_000 {
            let what = cut(&found(most, 0, thousands * 1_000).0);
            match what.get(1) {
                Some(what) if seen.last() != Some(what) => seen.push(*what),
                Some(_) => {}
                None => break,
            }
        }
        let all = [0, 1, 2].map(Unchecked::ViaFrom).into_iter();
        let all = all.chain([0, 1].map(Unchecked::LinesFrom));
        assert_eq!(seen, all.collect::<Vec<_>>());
    }
}
