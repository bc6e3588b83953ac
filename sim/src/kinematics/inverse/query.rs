//! The question of inverse kinematics and its answer: goals, what was found, and what cannot be asked.

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
    /// How much its error counts beside those of other goals; 1 if in doubt.
    pub weight: f64,
}

/// The position found and what is left there.
#[derive(Debug, Clone, PartialEq)]
pub struct IkAnswer {
    /// The joint positions, shape `(n)` \[rad or m\]; entries outside the chain are those of the start.
    pub q: Vec<f64>,
    /// Whether every frame is within tolerance of its target.
    pub reached: bool,
    /// The largest distance left \[m\]; zero where no position was asked for.
    pub residual_m: f64,
    /// The largest angle left \[rad\]; zero where no orientation was asked for.
    pub residual_rad: f64,
    /// Steps made, all starts together.
    pub iterations: usize,
}

/// A question that cannot be asked. A target out of reach is none of these.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IkError {
    /// Another number of values than the robot has joints.
    #[error("{what} has {found} values, but the robot has {expected} joints that move")]
    JointCount {
        /// What has them.
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
    /// A value that is no number, or not one that makes sense.
    #[error("{what} must be {expected}")]
    Value {
        /// Which value.
        what: &'static str,
        /// What it has to be.
        expected: &'static str,
    },
    /// Nothing to reach.
    #[error("there is no target: name a frame and where it should be")]
    NoGoal,
    /// Too much to do.
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

/// Answers one question: joint positions that bring `frame` of `robot` to `target`, looked for from `q0`, shape `(n)`.
///
/// # Errors
/// [`IkError`] for a question that cannot be asked; never for a target out of reach.
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
