//! A scene to check, alone or with a robot in it, and what the check found.

use kinemark_sim::format::SceneFile;
use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::robot::{Joint, Robot};
use kinemark_sim::model::scene::Scene;
use kinemark_sim::scene_check::{
    Finding, Kind, Progress, SceneCheckError, Severity, Work, check_watched,
};
use kinemark_sim::spatial::Pose;
use nalgebra::{Point3, Vector3};

/// A scene to check.
#[derive(Debug)]
pub struct SceneToCheck {
    /// The task of the lab it is in.
    pub task: Option<String>,
    /// The file it was read from.
    pub file: SceneFile,
    /// The scene itself.
    pub scene: Scene,
    /// The robot in it.
    pub arm: Option<ArmInScene>,
}

/// A robot in a scene.
#[derive(Debug)]
pub struct ArmInScene {
    /// The robot.
    pub robot: Robot,
    start_q: Vec<f64>,
    /// The frame in which positions of the TCP are given.
    pub frame: String,
    world_from_frame: Pose,
    /// Positions of the TCP in that frame \[m\].
    pub via: Vec<[f64; 3]>,
    /// What such a position is called.
    pub via_name: &'static str,
    /// Whether the TCP should move in straight lines from one to the next.
    pub in_straight_lines: bool,
}

/// A scene with what the check found, the worst first.
#[derive(Debug)]
pub struct CheckedScene<'s> {
    pub(super) scene: &'s SceneToCheck,
    /// The findings.
    pub findings: Vec<Finding>,
}

impl SceneToCheck {
    /// Checks the scene, and the robot's path through it; `watch` gets to know how far it is.
    ///
    /// # Errors
    /// A scene, a start or positions that cannot be checked.
    pub fn check(
        &self,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<CheckedScene<'_>, SceneCheckError> {
        let work = self.arm.as_ref().map(ArmInScene::work);
        Ok(CheckedScene {
            scene: self,
            findings: check_watched(&self.scene, work.as_ref(), watch)?,
        })
    }

    pub(super) fn body_name(&self, index: usize) -> &str {
        &self.scene.bodies[index].name
    }

    /// The joint that has this entry of `q`.
    pub(super) fn joint(&self, entry: usize) -> Option<&Joint> {
        self.arm.as_ref()?.robot.moving_joints().nth(entry)
    }

    pub(super) fn link_name(&self, index: usize) -> &str {
        let arm = self.arm.as_ref();
        arm.map_or("?", |arm| &arm.robot.links()[index].name)
    }

    /// The line of the scene file, from one, with the body that a finding is about first.
    pub(super) fn line_of(&self, finding: &Finding) -> Option<usize> {
        let at = self.file.place_of_body(body_of(finding)?)?;
        Some(self.file.source().line_and_column(at.start).0)
    }
}

impl CheckedScene<'_> {
    /// Whether there is an error among the findings.
    pub fn has_errors(&self) -> bool {
        let mut severities = self.findings.iter().map(|finding| finding.severity);
        severities.any(|severity| severity == Severity::Error)
    }
}

impl ArmInScene {
    /// A robot that starts at `start_q` \[rad or m\]; none where it has no frame of that name.
    pub fn new(robot: Robot, start_q: Vec<f64>, frame: &str) -> Option<Self> {
        let mut poses = FramePoses::new(&robot);
        poses.update(&robot, &start_q);
        let world_from_frame = poses.world_from(robot.frame(frame)?);
        Some(Self {
            robot,
            start_q,
            frame: frame.to_owned(),
            world_from_frame,
            via: Vec::new(),
            via_name: "via point",
            in_straight_lines: true,
        })
    }

    fn work(&self) -> Work<'_> {
        let in_world = |p: &[f64; 3]| (self.world_from_frame * Point3::from(*p)).coords;
        Work {
            robot: &self.robot,
            start_q: self.start_q.clone(),
            via_in_world: self.via.iter().map(in_world).collect(),
            in_straight_lines: self.in_straight_lines,
        }
    }

    /// A position of the world in the frame in which positions are given \[m\].
    pub(super) fn in_frame(&self, p_in_world: &Vector3<f64>) -> [f64; 3] {
        let frame_from_world = |p| self.world_from_frame.inverse_transform_point(&p);
        frame_from_world((*p_in_world).into()).coords.into()
    }
}

/// The body of the scene that a finding is about first.
fn body_of(finding: &Finding) -> Option<usize> {
    match &finding.kind {
        Kind::Overlap(overlap) => overlap.parties.iter().rev().find_map(|party| match party {
            Party::Body(index) => Some(*index),
            Party::Ground | Party::Link(_) => None,
        }),
        Kind::FallsThrough { body, .. }
        | Kind::FallsOff { body, .. }
        | Kind::FallsForever { body }
        | Kind::Moves { body, .. }
        | Kind::NeverRests { body, .. } => Some(*body),
        Kind::FliesApart { body, .. } => *body,
        Kind::CannotMove { .. }
        | Kind::StartBeyondLimit { .. }
        | Kind::ViaUnreachable { .. }
        | Kind::ViaCollides { .. }
        | Kind::ViaTouches { .. }
        | Kind::LineBlocked { .. }
        | Kind::LineTouches { .. }
        | Kind::NotChecked(_) => None,
    }
}
