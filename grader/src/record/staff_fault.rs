//! A submission of the course staff that fails: the reference solution, or a known mistake. What it would have shown of a student's
//! work is missing, so whoever grades is told at which line.

use kinemark_sim::text::{Located, Problem};

/// A fault in the staff's own code, with its place in their file.
pub type StaffFault = Located<StaffProblem>;

/// What is wrong with a submission of the staff.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}: {message}", self.what_fails())]
pub struct StaffProblem {
    /// The submission.
    pub submission: StaffSubmission,
    /// The task in which it stops; none where it does not even start.
    pub task: Option<String>,
    /// Why.
    pub message: String,
    /// Something to do.
    pub help: Option<String>,
}

/// A submission of the staff.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StaffSubmission {
    /// The reference solution.
    Solution,
    /// The known mistake of this name.
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
