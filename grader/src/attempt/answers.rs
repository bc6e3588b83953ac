//! The answers of a submission to the cases of a function task, each with how far off it is.

use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;

use crate::record::grade::LogEntry;
use crate::task::model::Case;

/// The answers to all cases of a function task.
#[derive(Debug)]
pub struct Answers<'a> {
    /// One per case, in order.
    pub facts: Vec<CaseFacts<'a>>,
    /// Lines printed in visible cases, each with the number of its case.
    pub log: Vec<LogEntry>,
    /// BLAKE3 of all answers, in order.
    pub digest: blake3::Hash,
}

/// One answer of a function task.
#[derive(Debug, Clone)]
pub struct CaseFacts<'a> {
    /// The case.
    pub case: &'a Case,
    /// The robot of the case.
    pub robot: Robot,
    /// What the submission answered.
    pub answer: Answered,
    /// How far off it is, by the kind of the case.
    pub error: CaseError,
}

impl CaseFacts<'_> {
    /// What may be reported of the case: its name, or the class of a hidden one.
    pub fn label(&self) -> &str {
        self.case.hidden_class.as_deref().unwrap_or(&self.case.name)
    }

    /// Whether its numbers may be reported.
    pub fn is_visible(&self) -> bool {
        self.case.hidden_class.is_none()
    }
}

/// What a submission answered, once its shape has been checked.
#[derive(Debug, Clone, PartialEq)]
pub enum Answered {
    /// A position \[m\].
    Position(Vector3<f64>),
    /// Joint positions of every branch \[rad or m\].
    Branches(Vec<Vec<f64>>),
    /// A matrix, row by row.
    Matrix(Vec<Vec<f64>>),
    /// The entries that were expected, in their order, a number as a list of one.
    Entries(Vec<Vec<f64>>),
    /// Something of the wrong shape or not finite; in words.
    Invalid(String),
    /// Nothing: the submission was stopped in this case, or before.
    Stopped,
}

/// How far off an answer is.
#[derive(Debug, Clone, PartialEq)]
pub enum CaseError {
    /// Distance of the position \[m\]; infinite where there is no valid answer.
    Position(f64),
    /// Of a reachable target: distance of the position of each answered branch \[m\], best first.
    Reach {
        /// Distances \[m\]; empty where there is no valid answer.
        branches_m: Vec<f64>,
        /// How many branches there are.
        expected: u32,
    },
    /// Of an unreachable target: whether the answer says so.
    Unreachable {
        /// It answered with an empty list.
        said_so: bool,
    },
    /// Of a Jacobian.
    Jacobian {
        /// Frobenius norm of its difference from the true one, as a fraction of that one's norm; infinite where there is no
        /// valid answer.
        relative: f64,
        /// The true one, row by row.
        truth: Vec<Vec<f64>>,
    },
    /// Of a free function: the relative error of each entry expected; infinite where there is no valid one.
    Entries(Vec<f64>),
}
