//! Everything that can be wrong with a lab.

use kinemark_sim::format::RobotError;
use kinemark_sim::format::SceneError;
use kinemark_sim::text::{Located, Problem};
use miette::Diagnostic;

/// A problem in a lab's files, with its place.
pub type LabError = Located<LabProblem>;

/// Why a lab cannot be loaded.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum LoadError {
    /// There is no such lab.
    #[error("no lab is called `{name}`")]
    #[diagnostic(code(lab::unknown_lab))]
    UnknownLab {
        /// The name asked for.
        name: String,
        /// The labs there are, or the nearest.
        #[help]
        help: String,
    },
    /// A file that is there cannot be read.
    #[error("{path}: {why}")]
    #[diagnostic(code(lab::unreadable))]
    Unreadable {
        /// The path, as a person knows it.
        path: String,
        /// Why.
        why: String,
    },
    /// The lab, or the staff's part of it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Lab(#[from] LabError),
    /// Its robot.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Robot(#[from] RobotError),
    /// A scene of it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Scene(#[from] SceneError),
}

/// What is wrong with a lab file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct LabProblem {
    /// What is wrong.
    pub message: String,
    /// Its stable name.
    pub code: &'static str,
    /// What stands under the caret.
    pub label: String,
    /// Something to do.
    pub help: Option<String>,
}

impl LabProblem {
    /// A problem that another reader found in a lab's file.
    pub(crate) fn of(problem: impl Problem) -> Self {
        Self {
            code: problem.code(),
            label: problem.label(),
            help: problem.help(),
            message: problem.to_string(),
        }
    }
}

impl Problem for LabProblem {
    fn code(&self) -> &'static str {
        self.code
    }

    fn label(&self) -> String {
        self.label.clone()
    }

    fn help(&self) -> Option<String> {
        self.help.clone()
    }
}
