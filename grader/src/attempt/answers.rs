//! The answers of a submission to the cases of a function task, each with its error.

use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;

use crate::record::grade::LogEntry;
use crate::task::entry::Entry;
use crate::task::model::{Case, Given};
use crate::task::task_joints::TaskJoints;

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
    pub robot: &'a Robot,
    /// The joints of the task.
    pub joints: TaskJoints,
    /// The submission's answer.
    pub answer: Answered,
    /// Its error, by the kind of the case.
    pub error: CaseError,
    /// What a quantity is, as an entry without a name; else nothing: then the case itself says what is expected.
    pub quantity: Option<(String, Entry)>,
}

impl CaseFacts<'_> {
    /// The public name of the case: its name, or the class of a hidden one.
    pub fn label(&self) -> &str {
        self.case.hidden_class.as_deref().unwrap_or(&self.case.name)
    }

    /// The entries that are expected, in their order; none where the function answers something else.
    pub fn expected(&self) -> &[(String, Entry)] {
        match (&self.quantity, &self.case.given) {
            (Some(quantity), _) => std::slice::from_ref(quantity),
            (None, Given::Values { expected, .. }) => expected,
            (None, _) => &[],
        }
    }

    /// Whether its numbers may be reported.
    pub fn is_visible(&self) -> bool {
        self.case.hidden_class.is_none()
    }
}

/// An answer of a submission after a check of its shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Answered {
    /// A position \[m\].
    Position(Vector3<f64>),
    /// A pose in the form that the task asks for, its numbers; those of a matrix row by row.
    Pose(Vec<f64>),
    /// Positions of all joints of the robot for every branch, shape `(n)` each \[rad or m\].
    Branches(Vec<Vec<f64>>),
    /// A matrix, row by row.
    Matrix(Vec<Vec<f64>>),
    /// The expected entries, in their order; a number is a list of one, a matrix one of its numbers row by row.
    Entries(Vec<Vec<f64>>),
    /// A description of a value of the wrong shape, or not finite.
    Invalid(String),
    /// None, because the submission was stopped in this case or before.
    Stopped,
}

impl Answered {
    /// The position that was answered, alone or in a pose \[m\].
    pub fn position(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Position(p) => Some(*p),
            // a matrix of 4 x 4
            Self::Pose(numbers) if numbers.len() == 16 => {
                Some(Vector3::new(numbers[3], numbers[7], numbers[11]))
            }
            Self::Pose(numbers) => numbers.first_chunk().map(|p: &[f64; 3]| (*p).into()),
            _ => None,
        }
    }
}

/// The error of an answer.
#[derive(Debug, Clone, PartialEq)]
pub enum CaseError {
    /// Distance of the position \[m\]; infinite without a valid answer.
    Position(f64),
    /// Of a pose.
    Pose {
        /// Distance of the position \[m\]; infinite without a valid answer.
        position_m: f64,
        /// The angle between \[rad\]; infinite without a valid answer.
        angle_rad: f64,
    },
    /// For a reachable target: the error of each answered branch, the nearest first.
    Reach {
        /// Distances \[m\]; empty without a valid answer.
        branches_m: Vec<f64>,
        /// How each is turned away from the target \[rad\]; zero where positions alone count.
        angles_rad: Vec<f64>,
        /// The number of branches that exist.
        expected: u32,
    },
    /// For an unreachable target: whether the answer says so.
    Unreachable {
        /// Whether the answer is an empty list.
        said_so: bool,
    },
    /// For a Jacobian.
    Jacobian {
        /// Frobenius norm of its difference from the true Jacobian, as a fraction of the norm of the true one; infinite without a valid
        /// answer.
        relative: f64,
        /// The true Jacobian, row by row.
        truth: Vec<Vec<f64>>,
    },
    /// For a quantity or a function of the lab's own: the error of each expected entry, relative unless it is an angle; infinite without
    /// a valid one.
    Entries(Vec<f64>),
}
