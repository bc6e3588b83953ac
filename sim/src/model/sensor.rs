//! The sensor as the simulator gets it: what it measures, and what its device does to the value.

use nalgebra::Vector3;

use super::robot::{Body, JointKind, Robot};

/// A sensor of a robot; its indices are those of the robot it was resolved against.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// What it measures.
    pub kind: SensorKind,
    /// Standard deviation of the normal noise on every channel, in the channel's unit; 0 for none.
    pub noise: f64,
    /// Values are rounded to whole multiples of this, halves away from zero; 0 for none.
    pub quantisation: f64,
    /// How much later a value arrives than it is taken \[s\]; a whole number of physics steps.
    pub delay_s: f64,
    /// Values taken each second \[Hz\]; one each physics step where it is absent.
    pub rate_hz: Option<f64>,
    /// What the noise is drawn from.
    pub seed: u64,
}

/// What a sensor measures.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorKind {
    /// Position of a joint \[rad or m\].
    JointPosition {
        /// Its index among [`crate::model::robot::Robot::joints`].
        joint: usize,
    },
    /// Velocity of a joint \[rad/s or m/s\].
    JointVelocity {
        /// Its index among [`crate::model::robot::Robot::joints`].
        joint: usize,
    },
    /// Effort of a joint's motor in the last step \[N m or N\].
    JointEffort {
        /// Its index among [`crate::model::robot::Robot::joints`].
        joint: usize,
    },
    /// 1 while a joint stands at a place or beyond it, else 0.
    LimitSwitch(LimitSwitch),
    /// Distance along a ray \[m\].
    RangeFinder(RangeFinder),
    /// Sum of the normal forces on a link, their mean over the last step \[N\].
    Contact {
        /// Its index among [`crate::model::robot::Robot::links`].
        link: usize,
    },
    /// Force and moment of the parent on the child through a joint, `[force; moment]` in the child's frame about its
    /// origin, their mean over the last step \[N, N m\].
    Wrench {
        /// Its index among [`crate::model::robot::Robot::joints`].
        joint: usize,
    },
}

impl SensorKind {
    /// The word of the robot file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::JointPosition { .. } => "joint-position",
            Self::JointVelocity { .. } => "joint-velocity",
            Self::JointEffort { .. } => "joint-effort",
            Self::LimitSwitch(_) => "limit-switch",
            Self::RangeFinder(_) => "range-finder",
            Self::Contact { .. } => "contact",
            Self::Wrench { .. } => "wrench",
        }
    }

    /// How many numbers it reads: 6 for a wrench, else 1.
    pub fn channels(&self) -> usize {
        match self {
            Self::Wrench { .. } => 6,
            _ => 1,
        }
    }
}

/// The side to which a switch is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Towards lesser positions.
    Lower,
    /// Towards greater positions.
    Upper,
}

impl Side {
    /// The word of the robot file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }
}

/// A switch at a place of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitSwitch {
    /// Index of the joint among [`Robot::joints`].
    pub joint: usize,
    /// Where it starts to be pressed \[rad or m\].
    pub at: f64,
    /// To which side it goes on being pressed.
    pub side: Side,
    /// Whether it opens the motor's circuit: pressed, it leaves no effort towards its side.
    pub opens_motor: bool,
}

impl LimitSwitch {
    /// Whether a joint at `position` \[rad or m\] presses it; never for NaN.
    pub fn is_pressed(&self, position: f64) -> bool {
        match self.side {
            Side::Lower => position <= self.at,
            Side::Upper => position >= self.at,
        }
    }
}

/// A ray fixed to a frame of the robot. It sees bodies, ground and all links but those fixed together with its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RangeFinder {
    /// Index of the frame among [`Robot::frames`]; the ray starts at its origin.
    pub frame: usize,
    /// Direction of the ray in the frame, a unit vector.
    pub axis: Vector3<f64>,
    /// How far it sees, and what it reads when it sees nothing \[m\].
    pub range_m: f64,
}

/// The seed of a sensor that states none: the 64-bit FNV-1a hash of its name.
///
/// Source: Fowler, Noll & Vo, "The FNV Non-Cryptographic Hash Algorithm", RFC 9923.
pub fn default_seed(name: &str) -> u64 {
    name.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn encoder(name: &str, joint: usize) -> Sensor {
        Sensor {
            name: name.to_owned(),
            kind: SensorKind::JointPosition { joint },
            noise: 0.0,
            quantisation: 0.0,
            delay_s: 0.0,
            rate_hz: None,
            seed: default_seed(name),
        }
    }

    #[test]
    fn the_seed_of_a_name_is_its_published_hash() {
        // check values of the algorithm's own test suite
        assert_eq!(default_seed(""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(default_seed("a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(default_seed("foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_change_takes_the_place_of_its_name_or_the_end() {
        let given = [encoder("a", 0), encoder("b", 1)];
        let sensors = replaced(&given, [encoder("c", 2), encoder("a", 3)]);
        assert_eq!(sensors, [encoder("a", 3), encoder("b", 1), encoder("c", 2)]);
    }
}
