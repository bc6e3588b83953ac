//! The rows of an audit: what was tried, and what is wrong with it.

use serde::Serialize;

use super::LostDraw;

/// The part of a lab that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tried {
    /// The brief.
    Brief,
    /// The starter.
    Starter,
    /// The reference solution.
    Reference,
    /// The file with what students get of the reference solution.
    Practice,
    /// The number of mutants.
    Mutants,
    /// A mutant in one task.
    Mutant,
    /// The rubric itself, by one rule.
    Rubric,
}

impl Tried {
    /// Its word in tables and records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brief => "brief",
            Self::Starter => "starter",
            Self::Reference => "reference",
            Self::Practice => "practice",
            Self::Mutants => "mutants",
            Self::Mutant => "mutant",
            Self::Rubric => "rubric",
        }
    }
}

/// The result for one part of a lab.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The part.
    pub tried: Tried,
    /// The form of the lab or the name of the mutant; empty if there is only one.
    pub name: String,
    /// The task, if the row is about one.
    pub task: Option<String>,
    /// The check that loses points, if that is the problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub check: Option<String>,
    /// Points earned, if something was graded.
    pub points: Option<f64>,
    /// Maximum points.
    pub max_points: Option<f64>,
    /// The problem; `null` if there is none.
    pub problem: Option<String>,
    /// What to do about the problem.
    pub help: Option<String>,
    /// The draws, or the students' variants, in which it shows, where several were tried.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub shows_in: Vec<String>,
    /// The hidden cases and runs in which points were lost, if that is the problem; of several draws or variants those of the first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hidden: Vec<LostDraw>,
}

/// What is wrong with a part of a lab.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Problem {
    /// In words, with numbers.
    pub(super) what: String,
    /// What to do about it.
    pub(super) help: String,
    /// What is the same where it is the same problem with other numbers: the task, and the check or how it was stopped.
    pub(super) key: String,
    /// The task.
    pub(super) task: Option<String>,
    /// The check that loses points.
    pub(super) check: Option<String>,
    /// The draws or students in which it shows.
    pub(super) shows_in: Vec<String>,
    /// The hidden cases and runs in which it shows.
    pub(super) hidden: Vec<LostDraw>,
}

impl<H: Into<String>> From<(String, H)> for Problem {
    fn from((what, help): (String, H)) -> Self {
        Self {
            what,
            help: help.into(),
            ..Self::default()
        }
    }
}

impl Row {
    /// Of what was `tried` under a name.
    pub(super) fn new(
        (tried, name): (Tried, &str),
        task: Option<&str>,
        earned: Option<(f64, f64)>,
        problem: Option<Problem>,
    ) -> Self {
        let is_wrong = problem.is_some();
        let problem = problem.unwrap_or_default();
        Self {
            tried,
            name: name.to_owned(),
            task: task.map(str::to_owned).or(problem.task),
            check: problem.check,
            points: earned.map(|earned| earned.0),
            max_points: earned.map(|earned| earned.1),
            problem: is_wrong.then_some(problem.what),
            help: is_wrong.then_some(problem.help),
            shows_in: problem.shows_in,
            hidden: problem.hidden,
        }
    }

    /// A row for each problem, or one without: the first has what was `earned`.
    pub(super) fn all(
        (tried, name): (Tried, &str),
        earned: Option<(f64, f64)>,
        problems: Vec<Problem>,
    ) -> Vec<Self> {
        if problems.is_empty() {
            return vec![Self::new((tried, name), None, earned, None)];
        }
        let rows = problems.into_iter().enumerate();
        let rows = rows.map(|(i, problem)| {
            let earned = earned.filter(|_| i == 0);
            Self::new((tried, name), None, earned, Some(problem))
        });
        rows.collect()
    }
}
