//! What the viewer is given of a robot that its reader moves: joints, shapes, limits and frames, and no run.
//!
//! The numbers are those of the model, unrounded, so that the viewer's kinematics are the engine's.

use kinemark_sim::model::robot::{Frame, Joint, Robot};
use kinemark_sim::spatial::Pose;
use kinemark_sim::trace::pose_numbers;
use serde::Serialize;

use super::moments::MOST_OF_A_NAME;
use super::shapes::{MeshRecord, Meshes, ShapeRecord};
use crate::visible::shortened;

/// The format and its version.
const FORMAT: &str = "kinemark-arm/1";

/// What a lab is about, which its arm shows from the start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ArmShows {
    /// The other postures that reach the same place.
    pub branches: bool,
    /// The columns of the Jacobian.
    pub jacobian: bool,
}

/// A robot that its reader moves.
#[derive(Debug, Clone, Copy)]
pub struct LiveArm<'a> {
    robot: &'a Robot,
    frame: &'a Frame,
    shows: ArmShows,
}

#[derive(Serialize)]
struct Record {
    format: &'static str,
    name: String,
    lab: FrameRecord,
    tcp: FrameRecord,
    nodes: Vec<NodeRecord>,
    meshes: Vec<MeshRecord>,
    /// Every joint, each behind that of its parent.
    joints: Vec<JointRecord>,
    /// What moves by itself, in the order of `q`.
    q: Vec<PositionRecord>,
    branches: bool,
    jacobian: bool,
}

#[derive(Serialize)]
struct FrameRecord {
    name: String,
    node: usize,
    pose: [f64; 7],
}

#[derive(Serialize)]
struct NodeRecord {
    name: String,
    shapes: Vec<ShapeRecord>,
}

#[derive(Serialize)]
struct JointRecord {
    parent: usize,
    child: usize,
    /// Of the child in the parent where the joint is at zero.
    pose: [f64; 7],
    axis: [f64; 3],
    turns: bool,
    /// Its entry in `q`, or that of the joint it mimics; none where it is fixed.
    q: Option<usize>,
    gear: f64,
    offset: f64,
}

#[derive(Serialize)]
struct PositionRecord {
    name: String,
    unit: &'static str,
    lower: Option<f64>,
    upper: Option<f64>,
}

impl<'a> LiveArm<'a> {
    /// The arm in coordinates of `frame`; none where joints cannot be moved one by one: with closed loops, or where none moves.
    pub fn of(robot: &'a Robot, frame: &str, shows: ArmShows) -> Option<Self> {
        let frame = robot.frame(frame)?;
        (robot.n() > 0 && robot.loops().is_empty()).then_some(Self {
            robot,
            frame,
            shows,
        })
    }

    /// The arm as JSON without a `<`, so that nothing in it can end the element it stands in. The same robot gives the same bytes.
    pub fn json(&self) -> String {
        let robot = self.robot;
        let mut meshes = Meshes::default();
        let nodes = robot.links().iter().map(|link| NodeRecord {
            name: shortened(&link.name, MOST_OF_A_NAME),
            shapes: meshes.shapes(&link.shapes),
        });
        let nodes = nodes.collect();
        let positions = robot.moving_joints().map(|joint| PositionRecord {
            name: shortened(&joint.name, MOST_OF_A_NAME),
            unit: if joint.kind.turns() { "rad" } else { "m" },
            lower: joint.limits.lower,
            upper: joint.limits.upper,
        });
        let record = Record {
            format: FORMAT,
            name: shortened(robot.name(), MOST_OF_A_NAME),
            lab: frame_record(robot, self.frame),
            tcp: frame_record(robot, robot.tcp()),
            nodes,
            meshes: meshes.records(),
            joints: self.joints(),
            q: positions.collect(),
            branches: self.shows.branches,
            jacobian: self.shows.jacobian,
        };
        // a record of texts and finite numbers has a JSON form
        let json = serde_json::to_string(&record).unwrap_or_default();
        json.replace('<', "\\u003c")
    }

    /// All joints from the root outwards.
    fn joints(&self) -> Vec<JointRecord> {
        let joints = self.robot.joints();
        let mut outwards = Vec::with_capacity(joints.len());
        let mut reached = vec![0];
        let mut next = 0;
        while let Some(&link) = reached.get(next) {
            for joint in joints.iter().filter(|joint| joint.parent == link) {
                outwards.push(self.joint(joint));
                reached.push(joint.child);
            }
            next += 1;
        }
        outwards
    }

    fn joint(&self, joint: &Joint) -> JointRecord {
        let all = self.robot.joints();
        let master = joint.mimic.map_or(joint, |mimic| &all[mimic.joint]);
        JointRecord {
            parent: joint.parent,
            child: joint.child,
            pose: pose_numbers(&joint.parent_from_child),
            axis: joint.axis.into(),
            turns: joint.kind.turns(),
            q: self.robot.moving_joints().position(|one| one == master),
            gear: joint.mimic.map_or(1.0, |mimic| mimic.multiplier),
            offset: joint.mimic.map_or(0.0, |mimic| mimic.offset),
        }
    }
}

/// A frame on its link.
fn frame_record(robot: &Robot, frame: &Frame) -> FrameRecord {
    let body_from_link = &robot.links()[frame.link].attachment.body_from_here;
    let link_from_frame: Pose = body_from_link.inv_mul(&frame.attachment.body_from_here);
    FrameRecord {
        name: shortened(&frame.name, MOST_OF_A_NAME),
        node: frame.link,
        pose: pose_numbers(&link_from_frame),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;
    use serde_json::Value;

    #[test]
    fn the_arm_is_what_a_reader_needs_to_move_it() {
        let run = sample::task_run();
        let shows = ArmShows {
            branches: true,
            jacobian: false,
        };
        let arm = LiveArm::of(&run.robot, "lab", shows).expect("an open chain");
        let record: Value = serde_json::from_str(&arm.json()).expect("JSON");
        assert_eq!(record["format"], FORMAT);
        assert_eq!(record["q"][1]["name"], "elbow");
        assert_eq!(record["q"][1]["unit"], "rad");
        assert_eq!(record["joints"][1]["parent"], 1);
        assert_eq!(record["joints"][1]["q"], 1);
        assert_eq!(record["tcp"]["node"], 2);
        assert_eq!(
            record["nodes"][2]["shapes"].as_array().map(Vec::len),
            Some(1)
        );
        assert_eq!(
            (&record["branches"], &record["jacobian"]),
            (&true.into(), &false.into())
        );
        assert_eq!(
            arm.json(),
            LiveArm::of(&run.robot, "lab", shows).expect("again").json()
        );
        assert!(LiveArm::of(&run.robot, "nowhere", shows).is_none());
    }
}
