//! What checks of a run in a scene look at: a body's fall, two that touch, the moment of a speed, a path to be followed.

use kinemark_sim::model::contact::Party;
use kinemark_sim::watch::Names;
use kinemark_sim::watch::event::SeenSide;
use nalgebra::Vector3;

/// How a free body is to fall, and what less than that is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Index of the body in the scene.
    pub body: usize,
    /// The side it is to fall over; any where there is none.
    pub side: Option<SeenSide>,
    /// Share of the points where it toppled, or fell otherwise.
    pub toppled: f64,
    /// Share of the points where it only moved.
    pub moved: f64,
}

/// One of two that touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TouchingParty {
    /// Any link of the robot.
    Arm,
    /// A link, by its index among the robot's.
    Link(usize),
    /// A body, by its index in the scene.
    Body(usize),
    /// The ground.
    Ground,
}

impl TouchingParty {
    fn is(self, party: Party) -> bool {
        match (self, party) {
            (Self::Arm, Party::Link(_)) | (Self::Ground, Party::Ground) => true,
            (Self::Link(wanted), Party::Link(index)) | (Self::Body(wanted), Party::Body(index)) => {
                wanted == index
            }
            _ => false,
        }
    }

    /// Whether these two are the parties of a contact, in either order.
    pub fn meets(self, other: Self, [first, second]: [Party; 2]) -> bool {
        (self.is(first) && other.is(second)) || (self.is(second) && other.is(first))
    }
}

/// The moment whose speed counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpeedAt {
    /// When the arm first touches the body of this index in the scene.
    Touch(usize),
    /// Whenever it is greatest.
    Run,
}

/// A path of straight segments for the TCP.
#[derive(Debug, Clone, PartialEq)]
pub struct PathToFollow {
    /// Its name in the task.
    pub name: String,
    /// Its points in the lab's frame, at least two \[m\].
    pub points_m: Vec<Vector3<f64>>,
    /// What is cut off each end of each segment; positive, and under half of the shortest \[m\].
    pub trim_m: f64,
}

/// What ends the time of a time limit.
#[derive(Debug, Clone, PartialEq)]
pub enum Until {
    /// The body of this index in the scene fell.
    Fall(usize),
    /// The TCP was at the last point of a path.
    Path(PathToFollow),
}

/// A band of shares: more is better.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shares {
    /// The share that earns all points.
    pub full: f64,
    /// The share that earns none; at or below `full`.
    pub zero: f64,
}

impl Shares {
    /// The share of points that `value` earns, in `[0, 1]`; NaN earns nothing.
    pub fn score(&self, value: f64) -> f64 {
        if value >= self.full {
            1.0
        } else if value > self.zero {
            (value - self.zero) / (self.full - self.zero)
        } else {
            0.0
        }
    }
}

impl TouchingParty {
    /// Its name as it stands in a sentence.
    pub fn told(self, names: &Names<'_>) -> String {
        match self {
            Self::Arm => "the arm".to_owned(),
            Self::Link(index) => format!("`{}`", names.party(Party::Link(index))),
            Self::Body(index) => format!("`{}`", names.party(Party::Body(index))),
            Self::Ground => "the ground".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_rise_linearly_and_nan_earns_nothing() {
        let shares = Shares {
            full: 1.0,
            zero: 0.5,
        };
        for (value, score) in [(1.0, 1.0), (0.75, 0.5), (0.5, 0.0), (0.0, 0.0)] {
            assert_eq!(shares.score(value), score);
        }
        assert_eq!(shares.score(f64::NAN), 0.0);
        let threshold = Shares {
            full: 0.5,
            zero: 0.5,
        };
        assert_eq!((threshold.score(0.5), threshold.score(0.49)), (1.0, 0.0));
    }
}
