//! A query of inverse kinematics: its goals, its answer, and the errors of invalid queries.

use super::{IkSettings, IkSolver, MOST_ITERATIONS, Target};
use crate::kinematics::closure::LoopError;
use crate::model::robot::{Frame, Robot};

/// One frame and where it should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal<'f> {
    /// The frame.
    pub frame: &'f Frame,
    /// Where it should be.
    pub target: Target,
    /// Weight of its error relative to those of other goals; 1 if in doubt.
    pub weight: f64,
}

/// The configuration found and its residual.
#[derive(Debug, Clone, PartialEq)]
pub struct IkAnswer {
    /// The joint positions, shape `(n)` \[rad or m\]; entries outside the chain are those of the start.
    pub q: Vec<f64>,
    /// Whether every frame is within tolerance of its target.
    pub reached: bool,
    /// The largest remaining distance \[m\]; zero without a target position.
    pub residual_m: f64,
    /// The largest remaining angle \[rad\]; zero without a target orientation.
    pub residual_rad: f64,
    /// Number of steps, all starts together.
    pub iterations: usize,
}

/// An invalid query. An unreachable target is not an error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IkError {
    /// A list with a wrong number of values.
    #[error("{what} has {found} values, but the robot has {expected} joints that move")]
    JointCount {
        /// Name of the list.
        what: &'static str,
        /// Joints that move.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// A joint that does not exist.
    #[error("joint {index} is not one of the {count} joints that move, which count from 0")]
    NoSuchJoint {
        /// What was given.
        index: usize,
        /// Joints that move.
        count: usize,
    },
    /// A value that is not finite or out of range.
    #[error("{what} must be {expected}")]
    Value {
        /// Which value.
        what: &'static str,
        /// Its allowed range.
        expected: &'static str,
    },
    /// A query without a goal.
    #[error("there is no target: name a frame and where it should be")]
    NoGoal,
    /// More iterations than allowed.
    #[error(
        "{iterations} iterations from {starts} starts are more than {MOST_ITERATIONS} in all; ask for fewer"
    )]
    Budget {
        /// Steps from one start.
        iterations: usize,
        /// Starts.
        starts: usize,
    },
    /// The start cannot be brought onto the robot's loops.
    #[error("the start does not close the robot's loops: {0}")]
    Loops(#[from] LoopError),
}

/// Answers one query: joint positions that bring `frame` of `robot` to `target`, searched from `q0`, shape `(n)`.
///
/// # Errors
/// [`IkError`] for an invalid query; never for an unreachable target.
pub fn inverse_kinematics(
    robot: &Robot,
    frame: &Frame,
    target: Target,
    q0: &[f64],
    settings: &IkSettings,
) -> Result<IkAnswer, IkError> {
    let goal = Goal {
        frame,
        target,
        weight: 1.0,
    };
    IkSolver::new(robot, &[goal], settings.clone())?.solve(q0)
}

pub(super) fn check_positions(robot: &Robot, what: &'static str, q: &[f64]) -> Result<(), IkError> {
    if q.len() != robot.n() {
        return Err(IkError::JointCount {
            what,
            expected: robot.n(),
            found: q.len(),
        });
    }
    finite(q.iter().all(|x| x.is_finite()), what)
}

fn finite(is: bool, what: &'static str) -> Result<(), IkError> {
    is.then_some(()).ok_or(IkError::Value {
        what,
        expected: "finite",
    })
}

pub(super) fn check_goals(goals: &[Goal<'_>]) -> Result<(), IkError> {
    if goals.is_empty() {
        return Err(IkError::NoGoal);
    }
    for goal in goals {
        finite(goal.target.is_finite(), "a target")?;
        if !(goal.weight > 0.0 && goal.weight.is_finite()) {
            return Err(IkError::Value {
                what: "the weight of a goal",
                expected: "positive and finite",
            });
        }
    }
    Ok(())
}
