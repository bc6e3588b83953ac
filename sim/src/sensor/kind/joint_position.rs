//! joint-position: position of a joint, rad or m; for a mimic joint its own.

use crate::model::robot::Body;
use crate::model::sensor::Seen;
use crate::sensor::of_joint::{JointNumber, JointTable};

pub(super) type Table = JointTable<Position>;

#[derive(Debug, Clone, Copy)]
pub(super) struct Position;

impl JointNumber for Position {
    const NAME: &'static str = "joint-position";
    const UNITS: [&'static str; 2] = ["rad", "m"];

    fn of(body: &Body, seen: &Seen<'_>) -> f64 {
        body.position(seen.q)
    }
}
