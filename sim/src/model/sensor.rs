//! The sensor as the simulator gets it: what its kind measures, and what its device does to the values.
//!
//! What a kind is stands in [`crate::sensor`], one file each; here is what a run asks of any of them.

use std::fmt;
use std::sync::Arc;

use nalgebra::Vector3;

use super::air::AirNow;
use super::contact::ContactFact;
use super::robot::{Body, Frame, JointKind, Robot};

/// A sensor of a robot; the indices of its kind are those of the robot it was read for.
#[derive(Debug, Clone)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// The word of the robot file for its kind.
    pub type_name: &'static str,
    /// What it measures.
    pub kind: Arc<dyn SensorKind>,
    /// Standard deviation of the normal noise on every channel, in the channel's unit; 0 for none.
    pub noise: f64,
    /// Values are rounded to whole multiples of this, halves away from zero; 0 for none.
    pub quantisation: f64,
    /// How much later a value arrives than it is taken \[s\]; an integer number of physics steps.
    pub delay_s: f64,
    /// Values taken each second \[Hz\]; one each physics step where it is absent.
    pub rate_hz: Option<f64>,
    /// What the noise is drawn from.
    pub seed: u64,
}

impl PartialEq for Sensor {
    /// Whether both are the same for programmers, who see every field to the last bit.
    fn eq(&self, other: &Self) -> bool {
        format!("{self:?}") == format!("{other:?}")
    }
}

/// What a sensor reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// Whether something is so: 1 or 0.
    Switch,
    /// One number.
    Number,
    /// Several numbers, each with its name.
    Parts(&'static [&'static str]),
}

impl Measured {
    /// How many numbers it is.
    pub fn channels(self) -> usize {
        match self {
            Self::Switch | Self::Number => 1,
            Self::Parts(names) => names.len(),
        }
    }
}

/// What a sensor of some kind measures, on one robot.
pub trait SensorKind: fmt::Debug + Send + Sync {
    /// What it reads.
    fn measured(&self) -> Measured {
        Measured::Number
    }

    /// The unit of the number `channel` of its reading, counted from 0; empty for a switch.
    fn unit(&self, robot: &Robot, channel: usize) -> &'static str;

    /// Its own keys in a robot file, a line each; `robot` is the one that it was read for.
    fn keys(&self, robot: &Robot) -> String;

    /// Whether it looks along rays, for which the shapes of the robot have to be prepared.
    fn looks(&self) -> bool {
        false
    }

    /// What reads it in a run of `robot` with steps of `step_s`.
    fn gauge(&self, robot: &Robot, step_s: f64) -> Box<dyn Gauge>;
}

/// One sensor at work, before its device.
pub trait Gauge: Send {
    /// Takes note of every tick, in order, whether or not a value is taken.
    fn watch(&mut self, _seen: &Seen<'_>) {}

    /// Leaves the true values in `values`, one for each channel.
    fn read(&mut self, seen: &Seen<'_>, around: &dyn Surroundings, values: &mut [f64]);

    /// Puts `values`, which have their noise and are quantised by now, back into the range that the sensor can report.
    fn bound(&self, _values: &mut [f64]) {}

    /// Takes from `effort`, shape `(n)`, what the sensor's circuit keeps from the motors.
    fn open_motor(&self, _effort: &mut [f64]) {}
}

/// What there is to measure of the robot at one tick. Vectors have shape `(n)`.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// The tick.
    pub tick: u64,
    /// The robot.
    pub robot: &'a Robot,
    /// Joint positions \[rad or m\].
    pub q: &'a [f64],
    /// Joint velocities \[rad/s or m/s\].
    pub qd: &'a [f64],
    /// Efforts applied in the last step; zeros before the first \[N m or N\].
    pub effort: &'a [f64],
    /// Mean accelerations over the last step: the change of `qd` in it by its length; zeros before the first \[rad/s²
    /// or m/s²\].
    pub qdd: &'a [f64],
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: &'a Vector3<f64>,
    /// Who pressed on whom in the last step.
    pub contacts: &'a [ContactFact],
}

/// What there is to measure around the robot at one tick.
pub trait Surroundings {
    /// How far it is from the origin of `frame` along `axis`, a unit vector in it, to the first surface \[m\]; nothing beyond
    /// `range_m`. The links that are fixed together with the frame are not seen.
    fn distance_m(&self, frame: &Frame, axis: &Vector3<f64>, range_m: f64) -> Option<f64>;

    /// The air of the last step; none before the first, or without air.
    fn air(&self) -> Option<&AirNow>;
}

/// The sensors `given`, with each of `changes` in the place of the one of its name, or at the end where there is none.
pub fn replaced(given: &[Sensor], changes: impl IntoIterator<Item = Sensor>) -> Vec<Sensor> {
    let mut sensors = given.to_vec();
    for change in changes {
        match sensors.iter_mut().find(|known| known.name == change.name) {
            Some(known) => *known = change,
            None => sensors.push(change),
        }
    }
    sensors
}

/// What joint `joint` of all joints moves; nothing for a fixed joint.
pub(crate) fn moved_by(robot: &Robot, joint: usize) -> Option<&Body> {
    let joint = &robot.joints()[joint];
    let body = robot.links()[joint.child].attachment.body?;
    (joint.kind != JointKind::Fixed).then(|| &robot.bodies()[body])
}
