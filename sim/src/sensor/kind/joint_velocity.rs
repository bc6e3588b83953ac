//! joint-velocity: velocity of a joint, rad/s or m/s.

use crate::model::robot::Body;
use crate::model::sensor::Seen;
use crate::sensor::of_joint::{JointNumber, JointTable};

pub(super) type Table = JointTable<Velocity>;

#[derive(Debug, Clone, Copy)]
pub(super) struct Velocity;

impl JointNumber for Velocity {
    const NAME: &'static str = "joint-velocity";
    const UNITS: [&'static str; 2] = ["rad/s", "m/s"];

    fn of(body: &Body, seen: &Seen<'_>) -> f64 {
        body.rate(seen.qd)
    }
}
