//! All sensors of one run, tick by tick: what the world shows them, and what they read.

use std::ops::Range;

use nalgebra::Vector3;

use super::device::Device;
use crate::engine::{EngineError, LinkShapes, Ray};
use crate::kinematics::FramePoses;
use crate::model::air::AirNow;
use crate::model::robot::{Frame, Robot};
use crate::model::sensor::{Gauge, Seen, Sensor, Surroundings};
use crate::step::hybrid::HybridStep;

/// A sensor that cannot be read at this physics step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// A delay between two steps.
    #[error(
        "sensor `{sensor}`: a delay of {delay_s} s is not an integer multiple of the physics step of {step_s} s; the nearest is {nearest_s} s"
    )]
    Delay {
        /// The sensor.
        sensor: String,
        /// Its delay \[s\].
        delay_s: f64,
        /// The physics step \[s\].
        step_s: f64,
        /// The nearest delay that fits \[s\].
        nearest_s: f64,
    },
    /// A delay with too many values under way.
    #[error(
        "sensor `{sensor}`: a delay of {delay_s} s is too long; at this physics step it is at most {most_s} s"
    )]
    LongDelay {
        /// The sensor.
        sensor: String,
        /// Its delay \[s\].
        delay_s: f64,
        /// The longest one \[s\].
        most_s: f64,
    },
    /// Values that would fall between two steps.
    #[error(
        "sensor `{sensor}`: at {rate_hz} Hz, the time between values is not an integer multiple of the physics step of {step_s} s; the nearest rate is {nearest_hz} Hz"
    )]
    Rate {
        /// The sensor.
        sensor: String,
        /// Its rate \[Hz\].
        rate_hz: f64,
        /// The physics step \[s\].
        step_s: f64,
        /// The nearest rate that fits \[Hz\].
        nearest_hz: f64,
    },
    /// A link that rays cannot meet.
    #[error(transparent)]
    Shape(#[from] EngineError),
}

/// The sensors of one run.
pub struct Sensors {
    specs: Vec<Sensor>,
    units: Vec<Unit>,
    values: Vec<f64>,
    /// Room for values that are taken, channel by channel.
    taken: Vec<f64>,
    /// Room for rays, if a sensor looks along any.
    sight: Option<Sight>,
    /// Rays that were cast since somebody asked.
    rays: u64,
}

/// One sensor at work.
struct Unit {
    gauge: Box<dyn Gauge>,
    device: Device,
    /// Whether it looks along rays.
    looks: bool,
    /// Its channels among the values.
    channels: Range<usize>,
}

/// Where the robot's own links are in the way of rays.
struct Sight {
    poses: FramePoses,
    links: LinkShapes,
}

/// What rays meet, and the air.
struct Around<'a> {
    sight: Option<&'a Sight>,
    scene: Option<&'a HybridStep>,
}

impl Surroundings for Around<'_> {
    fn distance_m(&self, frame: &Frame, axis: &Vector3<f64>, range_m: f64) -> Option<f64> {
        let Sight { poses, links } = self.sight?;
        let world_from_frame = poses.world_from(frame);
        let direction = world_from_frame.rotation * axis;
        let mut ray = Ray::new(&world_from_frame.translation.vector, &direction, range_m);
        links.meet(poses, frame.attachment.body, &mut ray);
        if let Some(scene) = self.scene {
            scene.show(&mut ray);
        }
        ray.nearest().map(|(_, distance_m)| distance_m)
    }

    fn air(&self) -> Option<&AirNow> {
        self.scene?.air_of_last_step()
    }
}

impl Sensors {
    /// The `sensors` of `robot` in a run with steps of `step_s`.
    ///
    /// # Errors
    /// A delay or a rate that is not a whole number of steps; with a sensor that looks along rays, a mesh of a link that has no
    /// convex hull.
    ///
    /// # Panics
    /// If a sensor was read for another robot that has more joints, links or frames.
    pub fn new(robot: &Robot, sensors: Vec<Sensor>, step_s: f64) -> Result<Self, SensorError> {
        let mut units: Vec<Unit> = Vec::with_capacity(sensors.len());
        let mut width = 0;
        for sensor in &sensors {
            let start = width;
            width += sensor.kind.measured().channels();
            units.push(Unit {
                gauge: sensor.kind.gauge(robot, step_s),
                device: Device::new(sensor, step_s)?,
                looks: sensor.kind.looks(),
                channels: start..width,
            });
        }
        let sight = if units.iter().any(|unit| unit.looks) {
            Some(Sight {
                poses: FramePoses::new(robot),
                links: LinkShapes::new(robot)?,
            })
        } else {
            None
        };
        Ok(Self {
            specs: sensors,
            units,
            values: vec![0.0; width],
            taken: vec![0.0; width],
            sight,
            rays: 0,
        })
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.specs.is_empty()
    }

    /// The sensors, in the order of the readings.
    pub fn specs(&self) -> &[Sensor] {
        &self.specs
    }

    /// Channels of all sensors together.
    pub fn width(&self) -> usize {
        self.values.len()
    }

    /// What sensor `i` reads, one number a channel; zeros before the first sample.
    ///
    /// # Panics
    /// If there is no such sensor.
    pub fn reading(&self, i: usize) -> &[f64] {
        &self.values[self.units[i].channels.clone()]
    }

    /// The channels of all sensors, in order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Shows the sensors what there is at a tick, and the scene as it stands, without which rays see the robot only; once for each
    /// tick, in order, before anyone reads them.
    ///
    /// # Panics
    /// If a vector does not have the shape of the robot, or the robot is not the one the sensors were made for.
    pub fn sample(&mut self, seen: &Seen<'_>, scene: Option<&HybridStep>) {
        let tick = seen.tick;
        let mut due = self.units.iter().filter(|unit| unit.device.is_due(tick));
        if let Some(sight) = &mut self.sight
            && due.any(|unit| unit.looks)
        {
            sight.poses.update(seen.robot, seen.q);
        }
        let around = Around {
            sight: self.sight.as_ref(),
            scene,
        };
        for unit in &mut self.units {
            unit.gauge.watch(seen);
            let held = &mut self.values[unit.channels.clone()];
            if unit.device.is_due(tick) {
                self.rays += u64::from(unit.looks);
                let taken = &mut self.taken[unit.channels.clone()];
                unit.gauge.read(seen, &around, taken);
                unit.device.disturb(taken);
                unit.gauge.bound(taken);
                unit.device.send(tick, taken, held);
            }
            unit.device.receive(tick, held);
        }
    }

    /// How many rays were cast since this was asked last.
    pub(crate) fn take_rays(&mut self) -> u64 {
        std::mem::take(&mut self.rays)
    }

    /// Takes from `effort`, shape `(n)`, what pushes a joint towards a limit switch that is pressed and opens its
    /// motor.
    ///
    /// # Panics
    /// If `effort` does not have the shape of the robot.
    pub fn open_motors(&self, effort: &mut [f64]) {
        for unit in &self.units {
            unit.gauge.open_motor(effort);
        }
    }
}

impl std::fmt::Debug for Sensors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Sensors")
            .field("specs", &self.specs)
            .field("values", &self.values)
            .finish_non_exhaustive()
    }
}
