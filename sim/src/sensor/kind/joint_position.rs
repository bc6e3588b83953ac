//! joint-position: position of a joint, rad or m; for a mimic joint its own.

use serde::Deserialize;
use toml::Spanned;

use crate::model::robot::Robot;
use crate::model::sensor::{Gauge, Measured, Seen, SensorKind, Surroundings, moved_by};
use crate::part::part_problem::PartError;
use crate::part::toml_text::quoted;
use crate::sensor::registry::{KindTable, SensorReading};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    joint: Spanned<String>,
}

impl KindTable for Table {
    const NAME: &'static str = "joint-position";
    #[cfg(test)]
    const EXAMPLE: &'static str = "joint = 'elbow'";
    type Kind = JointPosition;

    fn read(&self, reading: &SensorReading<'_>) -> Result<JointPosition, PartError> {
        let (joint, _) = reading.moving_joint(&self.joint)?;
        Ok(JointPosition { joint })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct JointPosition {
    /// Index among all joints.
    joint: usize,
}

impl SensorKind for JointPosition {
    fn name(&self) -> &'static str {
        Table::NAME
    }

    fn measured(&self) -> Measured {
        Measured::Number
    }

    fn keys(&self, robot: &Robot) -> String {
        format!("joint = {}\n", quoted(&robot.joints()[self.joint].name))
    }

    fn gauge(&self, _: &Robot, _: f64) -> Box<dyn Gauge> {
        Box::new(*self)
    }
}

impl Gauge for JointPosition {
    fn read(&mut self, seen: &Seen<'_>, _: &dyn Surroundings, values: &mut [f64]) {
        values[0] = moved_by(seen.robot, self.joint).map_or(0.0, |body| body.position(seen.q));
    }
}
