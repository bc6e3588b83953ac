//! Cases drawn at random from a salt: the same salt gives the same cases on every machine, another salt others.
//!
//! Numbers are keyed by salt, task, class and the case's number, so that adding a draw changes no other draw's cases.

use std::sync::Arc;

use kinemark_sim::format::RobotError;
use kinemark_sim::random::KeyedStream;
use kinemark_sim::text::Dimension;
use nalgebra::{Rotation3, Vector3};

use super::case_robot;
use super::file::{Ranges, RangesTable};
use super::model::Lab;
use crate::task::entry::Entry;
use crate::task::model::{About, Case, Given};
use crate::task::pose::{PoseForm, pose_at, pose_in};
use crate::task::task_joints::TaskJoints;

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
    /// Rows of joints, one of which each case has for its robot; the lab's robot where there are none.
    pub(super) rows: Vec<String>,
    /// What of the robot the task is about.
    pub(super) about: About,
}

/// What is drawn.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    /// Joint positions, given as they are.
    Q(Vec<[f64; 2]>),
    /// Joint positions, then velocities and accelerations as far as the quantity depends on them, given as they are.
    Motion(Vec<Vec<[f64; 2]>>),
    /// The TCP's pose at joint positions drawn: surely reachable.
    PoseOf(Vec<[f64; 2]>, u32, PoseForm),
    /// A position, whether reachable or not, turned like the lab's frame.
    Position([[f64; 2]; 3], u32, PoseForm),
    /// What a free function is given; the solution says what is expected.
    Values(Vec<(String, Ranges)>),
}

/// The next numbers and lists of numbers, by name.
fn drawn(stream: &mut KeyedStream, ranges: &[(String, Ranges)]) -> Vec<(String, Dimension)> {
    let drawn = ranges.iter();
    let drawn = drawn.map(|(name, ranges)| (name.clone(), ranges.drawn(stream)));
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
        let value = ranges.get_ref().drawn(&mut stream);
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

    /// The row of joints of the next case, if the draw has some.
    fn row(&self, stream: &mut KeyedStream) -> Option<&str> {
        let last = self.rows.len().checked_sub(1)?;
        let drawn = stream.between([0.0, self.rows.len() as f64]) as usize;
        Some(&self.rows[drawn.min(last)])
    }

    fn case(&self, salt: &str, number: u32, lab: &Lab) -> Result<Case, RobotError> {
        let names = [salt, &self.task, &self.class];
        let mut stream = KeyedStream::new(HIDDEN_CASES, &names, &number.to_le_bytes());
        let row = self.row(&mut stream);
        let dimensions = drawn(&mut stream, &self.dimensions);
        let robot = case_robot::built(&lab.robot_file, row, &dimensions, &self.about)?;
        let of_case = robot.as_ref().unwrap_or(&lab.robot);
        let joints = TaskJoints::of(of_case, &self.about.ignored);
        let mut list = |ranges: &[[f64; 2]]| -> Vec<f64> {
            ranges.iter().map(|range| stream.between(*range)).collect()
        };
        // where loops cannot be closed nothing is right: the reference solution loses the case, and `lab check` shows it
        let whole = |q: Vec<f64>| {
            let nothing = || vec![f64::NAN; of_case.n()];
            joints.positions(of_case, &q).unwrap_or_else(nothing)
        };
        let given = match &self.what {
            Drawn::Q(ranges) => Given::Q(whole(list(ranges))),
            Drawn::Motion(state) => {
                Given::Motion(state.iter().map(|ranges| list(ranges)).collect())
            }
            Drawn::PoseOf(ranges, branches, form) => {
                let q = whole(list(ranges));
                let pose = pose_in(of_case, &lab.frame, &q);
                let pose = pose
                    .unwrap_or_else(|| pose_at(Vector3::repeat(f64::NAN), Rotation3::identity()));
                Given::Position {
                    position_m: pose.translation.vector.into(),
                    branches: *branches,
                    pose: form.of(&pose),
                }
            }
            Drawn::Position(ranges, branches, form) => {
                let position_m = ranges.map(|range| stream.between(range));
                let pose = pose_at(Vector3::from(position_m), Rotation3::identity());
                Given::Position {
                    position_m,
                    branches: *branches,
                    pose: form.of(&pose),
                }
            }
            Drawn::Values(ranges) => Given::Values {
                given: drawn(&mut stream, ranges)
                    .into_iter()
                    .map(|(name, value)| (name, Entry::from(value)))
                    .collect(),
                expected: Vec::new(),
            },
        };
        Ok(Case {
            name: format!("{} {}", self.class, number + 1),
            hidden_class: Some(self.class.clone()),
            row: row.map(str::to_owned),
            dimensions,
            robot: robot.map(Arc::new),
            given,
        })
    }
}
