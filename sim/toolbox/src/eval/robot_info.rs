//! The operation `info`: the names and limits that other requests need.

use kinemark_sim::model::robot::Robot;
use serde::{Deserialize, Serialize};

use super::operation::{Operation, Subject};
use super::refusal::Refusal;
use crate::joint_names::joint_names;

/// What a robot is made of, as other requests name it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Info {}

/// The answer to [`Info`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotInfo {
    /// The robot's name.
    pub name: String,
    /// The joints that move, in the order of every array over joints.
    pub joints: Vec<JointInfo>,
    /// The frames that `frame` and `in` can name.
    pub frames: Vec<String>,
    /// Mass of all links, fixed ones too.
    pub mass_kg: f64,
    /// The joints that are free to choose: all without loops.
    pub independent: Vec<String>,
    /// The joints that follow another one.
    pub mimics: Vec<MimicInfo>,
    /// How many loops the robot has.
    pub loops: usize,
    /// What a reader of the robot's description should know.
    pub warnings: Vec<String>,
}

/// A joint that moves; a limit that it does not have is `None`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointInfo {
    /// The joint's name.
    pub name: String,
    /// `revolute`, `continuous` or `prismatic`.
    #[serde(rename = "type")]
    pub kind: String,
    /// Least position \[rad or m\].
    pub lower: Option<f64>,
    /// Greatest position \[rad or m\].
    pub upper: Option<f64>,
    /// Greatest speed \[rad/s or m/s\].
    pub speed: Option<f64>,
    /// Greatest effort \[N m or N\].
    pub effort: Option<f64>,
}

/// A joint whose position is `multiplier * master + offset`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MimicInfo {
    /// The name of the joint that follows.
    pub name: String,
    /// The master's name.
    pub joint: String,
    /// Ratio of the velocities.
    pub multiplier: f64,
    /// Position where the master's is zero \[rad or m\].
    pub offset: f64,
}

impl Operation for Info {
    const NAME: &'static str = "info";
    type Answer = RobotInfo;

    fn answer(self, subject: Subject<'_>) -> Result<RobotInfo, Refusal> {
        let robot = subject.robot;
        let frames = robot.frames().iter().map(|frame| frame.name.clone());
        Ok(RobotInfo {
            name: robot.name().to_owned(),
            joints: moving_joints(robot),
            frames: frames.collect(),
            mass_kg: robot.mass_kg(),
            independent: joint_names(robot, robot.independent()),
            mimics: mimics(robot),
            loops: robot.loops().len(),
            warnings: robot.warnings().to_vec(),
        })
    }
}

fn moving_joints(robot: &Robot) -> Vec<JointInfo> {
    let joints = robot.moving_joints().map(|joint| JointInfo {
        name: joint.name.clone(),
        kind: joint.kind.name().to_owned(),
        lower: joint.limits.lower,
        upper: joint.limits.upper,
        speed: joint.limits.speed,
        effort: joint.limits.effort,
    });
    joints.collect()
}

fn mimics(robot: &Robot) -> Vec<MimicInfo> {
    let mimics = robot.joints().iter().filter_map(|joint| {
        let mimic = joint.mimic?;
        Some(MimicInfo {
            name: joint.name.clone(),
            joint: robot.joints()[mimic.joint].name.clone(),
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        })
    });
    mimics.collect()
}
