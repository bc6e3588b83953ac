//! joint-effort: effort of a joint's motor in the last step, N m or N; not for a mimic joint, which has none.

use crate::model::robot::{Body, Joint, Robot};
use crate::model::sensor::Seen;
use crate::sensor::of_joint::{JointNumber, JointTable};

pub(super) type Table = JointTable<Effort>;

#[derive(Debug, Clone, Copy)]
pub(super) struct Effort;

impl JointNumber for Effort {
    const NAME: &'static str = "joint-effort";
    const UNITS: [&'static str; 2] = ["N m", "N"];

    fn of(body: &Body, seen: &Seen<'_>) -> f64 {
        seen.effort[body.q_index]
    }

    fn lacks(joint: &Joint, robot: &Robot) -> Option<(String, String)> {
        let (name, mimic) = (&joint.name, joint.mimic?);
        let master = &robot.joints()[mimic.joint].name;
        Some((
            format!("joint `{name}` mimics `{master}` and has no motor of its own"),
            format!("name `{master}`, or the joint that it mimics in turn"),
        ))
    }
}
