//! Cases drawn at random from a salt: the same salt gives the same cases on every machine, another salt others.
//!
//! Numbers are keyed by salt, task, class and the case's number, so that adding a draw changes no other draw's cases.

use std::sync::Arc;

use kinemark_sim::format::RobotError;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::random::KeyedStream;
use kinemark_sim::text::Dimension;

use super::file::{Ranges, RangesTable};
use super::model::Lab;
use crate::task::model::{Case, Given};
use crate::task::tcp::tcp_in;

/// What hidden cases are drawn for; never changed, because recorded grades depend on it.
const HIDDEN_CASES: &str = "kinemark 2026 hidden cases v1";
/// As [`HIDDEN_CASES`], for hidden runs.
const HIDDEN_RUNS: &str = "kinemark 2026 hidden runs v1";

/// A draw that has been checked against its lab.
#[derive(Debug, Clone)]
pub(super) struct Draw {
    pub(super) task: String,
    pub(super) class: String,
    pub(super) count: u32,
    pub(super) what: Drawn,
    pub(super) dimensions: Vec<(String, Ranges)>,
}

/// What is drawn.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    /// Joint positions, given as they are.
    Q(Vec<[f64; 2]>),
    /// The TCP's position at joint positions drawn: surely reachable.
    PositionOf(Vec<[f64; 2]>, u32),
    /// A position, whether reachable or not.
    Position([[f64; 2]; 3], u32),
    /// What a free function is given; the solution says what is expected.
    Values(Vec<(String, Ranges)>),
}

/// The next numbers and lists of numbers, by name.
fn entries(stream: &mut KeyedStream, ranges: &[(String, Ranges)]) -> Vec<(String, Dimension)> {
    let drawn = ranges.iter().map(|(name, ranges)| {
        let value = match ranges {
            Ranges::One(range) => Dimension::Number(stream.between(*range)),
            Ranges::Each(ranges) => {
                Dimension::List(ranges.iter().map(|range| stream.between(*range)).collect())
            }
        };
        (name.clone(), value)
    });
    drawn.collect()
}

/// The parameters of hidden run `number` of a class.
pub(super) fn parameters(
    salt: &str,
    task: &str,
    class: &str,
    number: u32,
    ranges: &RangesTable,
) -> Vec<(String, Dimension)> {
    let mut stream = KeyedStream::new(HIDDEN_RUNS, &[salt, task, class], &number.to_le_bytes());
    let drawn = ranges.iter().map(|(name, ranges)| {
        let value = match ranges.get_ref() {
            Ranges::One(range) => Dimension::Number(stream.between(*range)),
            Ranges::Each(ranges) => {
                Dimension::List(ranges.iter().map(|range| stream.between(*range)).collect())
            }
        };
        (name.get_ref().clone(), value)
    });
    drawn.collect()
}

impl Draw {
    /// The cases of this draw.
    ///
    /// # Errors
    /// Dimensions that make no robot.
    pub(super) fn cases(&self, salt: &str, lab: &Lab) -> Result<Vec<Case>, RobotError> {
        (0..self.count)
            .map(|number| self.case(salt, number, lab))
            .collect()
    }

    fn case(&self, salt: &str, number: u32, lab: &Lab) -> Result<Case, RobotError> {
        let names = [salt, &self.task, &self.class];
        let mut stream = KeyedStream::new(HIDDEN_CASES, &names, &number.to_le_bytes());
        let dimensions = entries(&mut stream, &self.dimensions);
        let robot = lab.robot_file.build_changed(&dimensions)?;
        let given = match &self.what {
            Drawn::Q(ranges) => Given::Q(ranges.iter().map(|r| stream.between(*r)).collect()),
            Drawn::PositionOf(ranges, branches) => {
                let q: Vec<f64> = ranges.iter().map(|r| stream.between(*r)).collect();
                Given::Position {
                    position_m: tcp_position(lab, robot.as_ref().unwrap_or(&lab.robot), &q),
                    branches: *branches,
                }
            }
            Drawn::Position(ranges, branches) => Given::Position {
                position_m: ranges.map(|range| stream.between(range)),
                branches: *branches,
            },
            Drawn::Values(ranges) => Given::Values {
                given: entries(&mut stream, ranges),
                expected: Vec::new(),
            },
        };
        Ok(Case {
            name: format!("{} {}", self.class, number + 1),
            hidden_class: Some(self.class.clone()),
            dimensions,
            robot: robot.map(Arc::new),
            given,
        })
    }
}

/// Where the TCP is in the lab's frame; NaN if `q` does not fit the robot, which the draw's check has ruled out.
fn tcp_position(lab: &Lab, robot: &Robot, q: &[f64]) -> [f64; 3] {
    tcp_in(robot, &lab.frame, q).map_or([f64::NAN; 3], Into::into)
}
