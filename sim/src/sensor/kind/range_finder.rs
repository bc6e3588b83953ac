//! range-finder: distance along a ray to the first surface, m. The ray is fixed to a frame of the robot, and sees bodies, ground and
//! all links but those fixed together with its own.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::robot::Robot;
use crate::model::sensor::{Gauge, Seen, SensorKind, Surroundings};
use crate::part::part_problem::PartError;
use crate::part::part_tables::{NumberAt, TripleAt};
use crate::part::toml_text::{quoted, triple};
use crate::part::values::Allowed;
use crate::sensor::registry::{KindTable, SensorReading};
use crate::text::Spanned;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// The frame of the robot from whose origin it looks.
    frame: Spanned<String>,
    /// Direction of the ray in the frame, of any length but zero; `[1, 0, 0]` where it is left out.
    axis: Option<TripleAt>,
    /// The greatest distance that it measures \[m\].
    range_m: NumberAt,
}

impl KindTable for Table {
    const NAME: &'static str = "range-finder";
    #[cfg(test)]
    const EXAMPLE: &'static str = "frame = 'tcp'\naxis = [1, 1, 0]\nrange_m = 'base_height'";
    type Kind = RangeFinder;

    fn read(&self, reading: &SensorReading<'_>) -> Result<RangeFinder, PartError> {
        let (frames, values) = (reading.robot.frames(), &reading.values);
        let names = frames.iter().map(|frame| frame.name.as_str());
        Ok(RangeFinder {
            frame: values.index("frame", &self.frame, names)?,
            axis: match &self.axis {
                Some(axis) => values.unit(axis, "axis of a range finder")?,
                None => Vector3::x(),
            },
            range_m: values.bounded(&self.range_m, "range_m", Allowed::Positive)?,
        })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct RangeFinder {
    /// Index among all frames; the ray starts at its origin.
    frame: usize,
    /// Direction of the ray in the frame, a unit vector.
    axis: Vector3<f64>,
    /// How far it sees, and what it reads when it sees nothing \[m\].
    range_m: f64,
}

impl SensorKind for RangeFinder {
    fn unit(&self, _: &Robot, _: usize) -> &'static str {
        "m"
    }

    fn keys(&self, robot: &Robot) -> String {
        let frame = quoted(&robot.frames()[self.frame].name);
        let (axis, range_m) = (triple(&self.axis), self.range_m);
        format!("frame = {frame}\naxis = {axis}\nrange_m = {range_m:?}\n")
    }

    fn looks(&self) -> bool {
        true
    }

    fn gauge(&self, _: &Robot, _: f64) -> Box<dyn Gauge> {
        Box::new(Eye {
            finder: *self,
            met: false,
        })
    }
}

/// A range finder at work, and whether it met anything last.
struct Eye {
    finder: RangeFinder,
    met: bool,
}

impl Gauge for Eye {
    fn read(&mut self, seen: &Seen<'_>, around: &dyn Surroundings, values: &mut [f64]) {
        let RangeFinder {
            frame,
            axis,
            range_m,
        } = &self.finder;
        let met = around.distance_m(&seen.robot.frames()[*frame], axis, *range_m);
        self.met = met.is_some();
        // noise is drawn in any case, so that it does not depend on what was seen before
        values[0] = met.unwrap_or(*range_m);
    }

    fn bound(&self, values: &mut [f64]) {
        let range_m = self.finder.range_m;
        values[0] = match self.met {
            true => values[0].max(0.0).min(range_m),
            false => range_m,
        };
    }
}
