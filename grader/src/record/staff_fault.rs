//! A failure of the course staff's own code: the reference solution or a mutant. Its part of the feedback is missing, so the person who
//! grades gets its position.

use kinemark_sim::text::{Located, Problem};

/// A failure of the course staff's own code, with its position in their file.
pub type StaffFault = Located<StaffProblem>;

/// Why a submission of the course staff failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}: {message}", self.what_fails())]
pub struct StaffProblem {
    /// The submission.
    pub submission: StaffSubmission,
    /// The task in which it stops; `None` if it does not compile.
    pub task: Option<String>,
    /// The reason.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

/// A submission of the course staff.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StaffSubmission {
    /// The reference solution.
    Solution,
    /// The mutant of this name.
    Mutant(String),
}

impl StaffProblem {
    fn what_fails(&self) -> String {
        let submission = match &self.submission {
            StaffSubmission::Solution => "the reference solution".to_owned(),
            StaffSubmission::Mutant(name) => format!("mutant `{name}`"),
        };
        match &self.task {
            Some(task) => format!("{submission} stops in task `{task}`"),
            None => format!("{submission} does not compile"),
        }
    }
}

impl Problem for StaffProblem {
    fn code(&self) -> &'static str {
        match self.submission {
            StaffSubmission::Solution => "staff::solution",
            StaffSubmission::Mutant(_) => "staff::mutant",
        }
    }

    fn label(&self) -> String {
        "here".to_owned()
    }

    fn help(&self) -> Option<String> {
        self.help.clone()
    }
}
