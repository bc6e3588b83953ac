//! joint-effort: effort of a joint's motor in the last step, N m or N; not for a mimic joint, which has none.

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
    const NAME: &'static str = "joint-effort";
    #[cfg(test)]
    const EXAMPLE: &'static str = "joint = 'elbow'";
    type Kind = JointEffort;

    fn read(&self, reading: &SensorReading<'_>) -> Result<JointEffort, PartError> {
        let (joint, described) = reading.moving_joint(&self.joint)?;
        let Some(mimic) = described.mimic else {
            return Ok(JointEffort { joint });
        };
        let master = &reading.robot.joints()[mimic.joint].name;
        reading.refuse(
            self.joint.span(),
            format!(
                "joint `{}` mimics `{master}` and has no motor of its own",
                described.name
            ),
            format!("name `{master}`, or the joint that it mimics in turn"),
        )
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct JointEffort {
    /// Index among all joints.
    joint: usize,
}

impl SensorKind for JointEffort {
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

impl Gauge for JointEffort {
    fn read(&mut self, seen: &Seen<'_>, _: &dyn Surroundings, values: &mut [f64]) {
        let body = moved_by(seen.robot, self.joint);
        values[0] = body.map_or(0.0, |body| seen.effort[body.q_index]);
    }
}
