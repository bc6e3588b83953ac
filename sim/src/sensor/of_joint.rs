//! What the kinds share that read one number of a joint that moves.

use std::fmt;
use std::marker::PhantomData;

use schemars::JsonSchema;
use serde::Deserialize;

use super::registry::{KindTable, SensorReading};
use crate::model::robot::{Body, Joint, Robot};
use crate::model::sensor::{Gauge, Seen, SensorKind, Surroundings, moved_by};
use crate::part::part_problem::PartError;
use crate::part::toml_text::quoted;
use crate::text::Spanned;

/// One number of a joint that moves.
pub(super) trait JointNumber: fmt::Debug + Clone + Copy + Send + Sync + 'static {
    /// The word of `type`.
    const NAME: &'static str;
    /// Its unit for a joint that turns, and for one that slides.
    const UNITS: [&'static str; 2];

    /// The number, of the joint that moves `body`.
    fn of(body: &Body, seen: &Seen<'_>) -> f64;

    /// Why `joint` has no such number, and what to do, if it has none.
    fn lacks(joint: &Joint, robot: &Robot) -> Option<(String, String)> {
        let _ = (joint, robot);
        None
    }
}

/// The keys of a sensor of `N`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct JointTable<N> {
    /// The joint that it measures.
    joint: Spanned<String>,
    #[serde(skip)]
    number: PhantomData<N>,
}

impl<N: JointNumber> KindTable for JointTable<N> {
    const NAME: &'static str = N::NAME;
    #[cfg(test)]
    const EXAMPLE: &'static str = "joint = 'elbow'";
    type Kind = OfJoint<N>;

    fn read(&self, reading: &SensorReading<'_>) -> Result<OfJoint<N>, PartError> {
        let (index, joint) = reading.moving_joint(&self.joint)?;
        match N::lacks(joint, reading.robot) {
            Some((message, help)) => reading.refuse(self.joint.span(), message, help),
            None => Ok(OfJoint {
                joint: index,
                number: PhantomData,
            }),
        }
    }
}

/// A number of the joint of this index among all joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct OfJoint<N> {
    joint: usize,
    number: PhantomData<N>,
}

impl<N: JointNumber> SensorKind for OfJoint<N> {
    fn unit(&self, robot: &Robot, _: usize) -> &'static str {
        let [turning, sliding] = N::UNITS;
        if robot.joints()[self.joint].kind.turns() {
            turning
        } else {
            sliding
        }
    }

    fn keys(&self, robot: &Robot) -> String {
        format!("joint = {}\n", quoted(&robot.joints()[self.joint].name))
    }

    fn gauge(&self, _: &Robot, _: f64) -> Box<dyn Gauge> {
        Box::new(*self)
    }
}

impl<N: JointNumber> Gauge for OfJoint<N> {
    fn read(&mut self, seen: &Seen<'_>, _: &dyn Surroundings, values: &mut [f64]) {
        values[0] = moved_by(seen.robot, self.joint).map_or(0.0, |body| N::of(body, seen));
    }
}
