//! A changed solution, graded as a submission: which checks lost points, or whether it does the same as the solution.

use kinemark_sim::text::Source;
use serde::Serialize;

use super::influence::Influence;
use super::mutation::{Mutation, mutations};
use crate::judge::grade;
use crate::lab::{Lab, Staff};
use crate::record::grade::{Grade, Outcome, TaskGrade};
use crate::record::graded::GradedRun;
use crate::record::verdict::Verdict;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;

/// The grade of a changed solution, which runs in this process.
fn graded(lab: &Lab, staff: &Staff, submission: &Source) -> Option<GradedRun> {
    // nobody can interrupt this host
    let submission = Submission::from(submission);
    grade(lab, Some(staff), &submission, &mut InProcess).ok()
}

/// What came of a change.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "fate", rename_all = "kebab-case")]
pub enum Fate {
    /// It does not compile.
    Unparsed,
    /// Every answer and every run are those of the solution, bit by bit, hidden ones and those of robustness checks too.
    Equivalent,
    /// It lost points.
    Caught {
        /// By what.
        by: Vec<Catch>,
    },
    /// It does something else, and has full marks.
    Survived,
}

/// What caught a change.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Catch {
    /// The task.
    pub task: String,
    /// The check that lost points; `null` where the program was stopped.
    pub check: Option<String>,
    /// The verdict, where the program was stopped.
    pub stopped: Option<&'static str>,
}

impl Catch {
    /// As in `fk/position`, or `fk (crashed)`.
    pub fn words(&self) -> String {
        match (&self.check, self.stopped) {
            (Some(check), _) => format!("{}/{check}", self.task),
            (None, Some(stopped)) => format!("{} ({stopped})", self.task),
            (None, None) => self.task.clone(),
        }
    }
}

/// Where changes of a solution are tried.
pub struct Bench<'a> {
    lab: &'a Lab,
    staff: Staff,
    solution: Grade,
    influence: Influence,
    mutations: Vec<Mutation>,
}

/// The solution itself loses points, so that its changes say nothing.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the solution loses points in task `{task}`")]
pub struct LosingSolution {
    /// The task.
    pub task: String,
}

impl<'a> Bench<'a> {
    /// Grades the solution, and lists its changes.
    ///
    /// # Errors
    /// [`LosingSolution`] if it has not full marks.
    pub fn new(lab: &'a Lab, staff: &Staff) -> Result<Self, LosingSolution> {
        let mut staff = staff.clone();
        // a diagnosis is no part of the points
        staff.mutants.clear();
        let graded = graded(lab, &staff, &staff.solution);
        let Some(solution) = graded.map(|run| run.grade) else {
            let task = lab.tasks.first().map(|task| task.name.clone());
            return Err(LosingSolution {
                task: task.unwrap_or_default(),
            });
        };
        let mut tasks = solution.tasks.iter();
        if let Some(lost) = tasks.find(|task| task.verdict != Verdict::Passed) {
            return Err(LosingSolution {
                task: lost.name.clone(),
            });
        }
        Ok(Self {
            lab,
            influence: Influence::new(lab, staff.solution.text()),
            mutations: mutations(&staff.solution),
            staff,
            solution,
        })
    }

    /// The changes of the solution.
    pub fn mutations(&self) -> &[Mutation] {
        &self.mutations
    }

    /// The solution.
    pub fn solution(&self) -> &Source {
        &self.staff.solution
    }

    /// The lab.
    pub fn lab(&self) -> &Lab {
        self.lab
    }

    /// Grades a change in the tasks that it can reach.
    pub fn fate(&self, mutation: &Mutation) -> Fate {
        let tasks = self.influence.tasks(&mutation.at);
        let mut part = self.lab.clone();
        part.tasks
            .retain(|task| tasks.contains(&task.name.as_str()));
        let solution = &self.staff.solution;
        let source = Source::new("mutation.rhai", mutation.program(solution.text()));
        let Some(run) = graded(&part, &self.staff, &source) else {
            return Fate::Unparsed;
        };
        let tasks = &run.grade.tasks;
        if tasks
            .iter()
            .any(|task| task.verdict == Verdict::DidNotBuild)
        {
            return Fate::Unparsed;
        }
        let by: Vec<Catch> = tasks.iter().flat_map(catches).collect();
        if !by.is_empty() {
            return Fate::Caught { by };
        }
        let of_solution = |name: &str| {
            let mut tasks = self.solution.tasks.iter();
            tasks.find(|task| task.name == name)
        };
        let is_same = |task: &TaskGrade| {
            of_solution(&task.name).is_some_and(|known| known.digests == task.digests)
        };
        if tasks.iter().all(is_same) {
            Fate::Equivalent
        } else {
            Fate::Survived
        }
    }
}

/// What caught a program in a task. The checks of a program that was stopped lose points by that alone.
fn catches(task: &TaskGrade) -> Vec<Catch> {
    let is_stopped = !matches!(task.verdict, Verdict::Passed | Verdict::Missed);
    let catch = |check: Option<&str>, stopped| Catch {
        task: task.name.clone(),
        check: check.map(str::to_owned),
        stopped,
    };
    if is_stopped {
        return vec![catch(None, Some(task.verdict.name()))];
    }
    let lost = task
        .checks
        .iter()
        .filter(|check| matches!(check.outcome, Outcome::Partial | Outcome::None));
    let mut by: Vec<Catch> = lost.map(|check| catch(Some(&check.name), None)).collect();
    if by.is_empty() && task.verdict != Verdict::Passed {
        by.push(catch(None, Some(task.verdict.name())));
    }
    by
}
