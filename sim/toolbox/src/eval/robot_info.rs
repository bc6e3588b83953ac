//! The operation `info`: the names and limits that other requests need.

use kinemark_sim::model::robot::Robot;
use serde::{Deserialize, Serialize};

use crate::joint_names::joint_names;

/// A request for a description has no fields.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Info {}

/// A robot, as other requests name its parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointInfo {
    /// The joint's name.
    pub name: String,
    /// `revolute`, `continuous` or `prismatic`.
    #[serde(rename = "type")]
    pub kind: &'static str,
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
#[derive(Debug, Clone, PartialEq, Serialize)]
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

/// Describes the robot.
pub fn info(robot: &Robot, _: &Info) -> RobotInfo {
    let joints = robot.moving_joints().map(|joint| JointInfo {
        name: joint.name.clone(),
        kind: joint.kind.name(),
        lower: joint.limits.lower,
        upper: joint.limits.upper,
        speed: joint.limits.speed,
        effort: joint.limits.effort,
    });
    let mimics = robot.joints().iter().filter_map(|joint| {
        let mimic = joint.mimic?;
        Some(MimicInfo {
            name: joint.name.clone(),
            joint: robot.joints()[mimic.joint].name.clone(),
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        })
    });
    let frames = robot.frames().iter().map(|frame| frame.name.clone());
    RobotInfo {
        name: robot.name().to_owned(),
        joints: joints.collect(),
        frames: frames.collect(),
        mass_kg: robot.mass_kg(),
        independent: joint_names(robot, robot.independent()),
        mimics: mimics.collect(),
        loops: robot.loops().len(),
        warnings: robot.warnings().to_vec(),
    }
}
