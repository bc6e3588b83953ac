//! What can happen in a run, and when.

use nalgebra::Vector3;

use crate::model::contact::Party;

/// Something that happened at a tick.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// The tick.
    pub tick: u64,
    /// What happened.
    pub kind: EventKind,
}

/// What can happen in a run.
#[derive(Debug, Clone, PartialEq)]
pub enum EventKind {
    /// A joint's effort reached its limit.
    Saturated {
        /// Index of the joint in `q`.
        joint: usize,
    },
    /// A joint reached a position limit: it rests on the limit or, in a run without a scene, left its range.
    LimitHit {
        /// Index of the joint in `q`.
        joint: usize,
    },
    /// In a scene, a joint reached its speed limit: its motor does not accelerate it further.
    SpeedLimitHit {
        /// Index of the joint in `q`.
        joint: usize,
    },
    /// The physics step, or the servo's period, is too long for the motion of a joint: see [`Watch`](super::Watch) for the bounds.
    UnderResolved {
        /// Index of the joint in `q`.
        joint: usize,
        /// What is too long.
        why: Unresolved,
    },
    /// The TCP can hardly move in some direction: see [`Watch`](super::Watch) for the bound.
    NearSingular,
    /// Two parties pressed on each other for the first time.
    Touched {
        /// Both parties, the lesser first.
        parties: [Party; 2],
    },
    /// A dynamic body left its start position.
    Moved {
        /// Index of the body in the scene.
        body: usize,
    },
    /// A dynamic body tilted by 45 degrees or more.
    Toppled {
        /// Index of the body in the scene.
        body: usize,
    },
    /// A dynamic body lost its support.
    LeftSupport {
        /// Index of the body in the scene.
        body: usize,
    },
    /// A dynamic body fell below its support.
    BodyFell {
        /// Index of the body in the scene.
        body: usize,
        /// The side over which it fell; none where it fell through or into its support.
        side: Option<Side>,
    },
    /// The simulation diverged: the run ends here.
    Diverged,
    /// The controller stopped the run.
    Stopped,
}

/// A time that is too long for what a joint does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unresolved {
    /// The physics step: its errors of the joint's speed add up to 1 % of it.
    Step,
    /// The servo's period: with these gains its loop is unstable where the run starts, and stable at a shorter period.
    ServoPeriod {
        /// The longest stable period \[s\].
        stable_s: f64,
    },
}

/// A side of the support of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// As seen from the robot's base.
    pub seen: SeenSide,
    /// Outward normal of that side, a horizontal unit vector in the world.
    pub outward: Vector3<f64>,
}

/// A side as seen from the robot's base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeenSide {
    /// Away from the robot.
    Far,
    /// Towards the robot.
    Near,
    /// To the left, looking from the robot.
    Left,
    /// To the right, looking from the robot.
    Right,
}

impl SeenSide {
    /// Its word in files and logs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Far => "far",
            Self::Near => "near",
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

impl EventKind {
    /// Its word in logs and digests.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Saturated { .. } => "saturated",
            Self::LimitHit { .. } => "limit-hit",
            Self::SpeedLimitHit { .. } => "speed-limit-hit",
            Self::UnderResolved { .. } => "under-resolved",
            Self::NearSingular => "near-singular",
            Self::Touched { .. } => "touched",
            Self::Moved { .. } => "moved",
            Self::Toppled { .. } => "toppled",
            Self::LeftSupport { .. } => "left-support",
            Self::BodyFell { .. } => "body-fell",
            Self::Diverged => "diverged",
            Self::Stopped => "stopped",
        }
    }

    /// The joint it happened to, if to one.
    pub fn joint(&self) -> Option<usize> {
        match self {
            Self::Saturated { joint }
            | Self::LimitHit { joint }
            | Self::SpeedLimitHit { joint }
            | Self::UnderResolved { joint, .. } => Some(*joint),
            _ => None,
        }
    }

    /// The body of the scene it happened to, if to one.
    pub fn body(&self) -> Option<usize> {
        match self {
            Self::Moved { body }
            | Self::Toppled { body }
            | Self::LeftSupport { body }
            | Self::BodyFell { body, .. } => Some(*body),
            _ => None,
        }
    }

    /// Feeds a digest: the event's name, then the parties and the side.
    pub(crate) fn digest_into(&self, hasher: &mut blake3::Hasher) {
        let name = self.name();
        hasher.update(&(name.len() as u64).to_le_bytes());
        hasher.update(name.as_bytes());
        let mut number = |value: u64| {
            hasher.update(&value.to_le_bytes());
        };
        match self {
            Self::Saturated { joint }
            | Self::LimitHit { joint }
            | Self::SpeedLimitHit { joint } => number(*joint as u64),
            Self::UnderResolved { joint, why } => {
                number(*joint as u64);
                match why {
                    Unresolved::Step => number(0),
                    Unresolved::ServoPeriod { stable_s } => number(stable_s.to_bits()),
                }
            }
            Self::Touched { parties } => {
                for party in parties {
                    let (kind, index) = party.numbers();
                    number(kind);
                    number(index);
                }
            }
            Self::Moved { body } | Self::Toppled { body } | Self::LeftSupport { body } => {
                number(*body as u64);
            }
            Self::BodyFell { body, side } => {
                number(*body as u64);
                match side {
                    None => number(0),
                    Some(side) => {
                        number(1 + side.seen as u64);
                        side.outward.iter().for_each(|x| number(x.to_bits()));
                    }
                }
            }
            Self::NearSingular | Self::Diverged | Self::Stopped => {}
        }
    }
}
