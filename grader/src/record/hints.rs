//! The hints of a lab's checks, which nothing that a grade writes has: `kinemark hint` unfolds them, and released feedback lists them.

use serde::Serialize;

use super::grade::{CheckGrade, Grade, Outcome};

/// The hints of a lab, in the order of its checks.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Hints(Vec<CheckHints>);

/// The hints of a check.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CheckHints {
    /// The name of its task.
    pub task: String,
    /// Its name.
    pub check: String,
    /// Its title.
    pub title: String,
    /// A question, then one step after another; never empty.
    pub hints: Vec<String>,
}

impl FromIterator<CheckHints> for Hints {
    fn from_iter<I: IntoIterator<Item = CheckHints>>(checks: I) -> Self {
        Self(checks.into_iter().collect())
    }
}

impl Hints {
    /// The checks that have hints.
    pub fn checks(&self) -> &[CheckHints] {
        &self.0
    }

    /// The hints of a check, question first; none where it has none.
    pub fn of(&self, task: &str, check: &str) -> &[String] {
        let mut checks = self.0.iter();
        let found = checks.find(|known| known.task == task && known.check == check);
        found.map_or(&[], |found| &found.hints)
    }

    /// What released feedback says behind the next step of a check: its hints, without the question where that is the next step. None
    /// where no point was lost, or nothing judged.
    pub fn behind_next_step(&self, task: &str, check: &CheckGrade) -> &[String] {
        if !has_missed(check) {
            return &[];
        }
        match self.of(task, &check.name) {
            [question, steps @ ..] if check.next_step.as_ref() == Some(question) => steps,
            hints => hints,
        }
    }

    /// The hints of the checks that were judged and lost points in `grade`.
    pub fn of_losses(&self, grade: &Grade) -> Vec<&CheckHints> {
        let is_lost = |hints: &&CheckHints| {
            let mut tasks = grade.tasks.iter();
            let task = tasks.find(|task| task.name == hints.task);
            let mut checks = task.into_iter().flat_map(|task| &task.checks);
            checks.any(|check| check.name == hints.check && has_missed(check))
        };
        self.0.iter().filter(is_lost).collect()
    }
}

fn has_missed(check: &CheckGrade) -> bool {
    matches!(check.outcome, Outcome::Partial | Outcome::None)
}

impl CheckHints {
    /// Its name for `kinemark hint`: `pid/rise`.
    pub fn name(&self) -> String {
        name(&self.task, &self.check)
    }
}

/// The name of a check for `kinemark hint`: `pid/rise`.
pub fn name(task: &str, check: &str) -> String {
    format!("{task}/{check}")
}
