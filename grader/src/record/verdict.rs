//! The verdicts of a task, and their order: the worst decides a grade.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The outcome of a task, worst first; of a whole grade, the worst of its tasks.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The grader failed; the student is not at fault. No points are decided.
    GraderFault,
    /// This machine's clock or memory ended the task; it says nothing about the work. No points are decided.
    HostLimit,
    /// The submission cannot be read as a program.
    DidNotBuild,
    /// The submission failed while running.
    Crashed,
    /// The submission used up a counted budget.
    OverBudget,
    /// The submission returned something of the wrong shape, or a number that is not finite.
    InvalidOutput,
    /// It ran, and at least one check lost points.
    Missed,
    /// Every check earned all its points.
    Passed,
}

impl Verdict {
    /// The name of the verdict in the grade record.
    pub fn name(self) -> &'static str {
        match self {
            Self::GraderFault => "grader-fault",
            Self::HostLimit => "host-limit",
            Self::DidNotBuild => "did-not-build",
            Self::Crashed => "crashed",
            Self::OverBudget => "over-budget",
            Self::InvalidOutput => "invalid-output",
            Self::Missed => "missed",
            Self::Passed => "passed",
        }
    }

    /// All of them, worst first.
    pub const ALL: [Self; 8] = [
        Self::GraderFault,
        Self::HostLimit,
        Self::DidNotBuild,
        Self::Crashed,
        Self::OverBudget,
        Self::InvalidOutput,
        Self::Missed,
        Self::Passed,
    ];

    /// The verdict of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|verdict| verdict.name() == name)
    }

    /// Whether points are decided: false if the grader or its machine failed.
    pub fn is_decided(self) -> bool {
        !matches!(self, Self::GraderFault | Self::HostLimit)
    }
}
