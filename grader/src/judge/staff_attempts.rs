//! Attempts of the course staff's own submissions, each made once, however many grades need it: whoever needs one first makes it.
//!
//! A single grade makes what it needs and keeps nothing. Who grades many submissions in one lab, such as a lab's audit, keeps these.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use kinemark_sim::text::Source;
use kinemark_sim::trace::Trace;

use super::diagnose::{MutantAnswers, MutantRun};
use crate::attempt::Attempt;
use crate::lab::{Lab, Staff, TaskWork};
use crate::submission::handed_in::Submission;

/// A value that is made once.
type Once<T> = OnceLock<Arc<T>>;

/// Attempts in one form of a lab, with the hidden runs of one salt.
#[derive(Debug)]
pub(crate) struct StaffAttempts {
    solution: Source,
    /// The solution's run of each motion task, visible, and hidden by its number from zero.
    solution_runs: BTreeMap<(String, Option<usize>), Once<Attempt<Trace>>>,
    /// The visible run of each mutant in each of its motion tasks.
    mutant_runs: BTreeMap<(String, String), Once<MutantRun>>,
    /// The answers of each mutant in each of its function tasks.
    mutant_answers: BTreeMap<(String, String), Once<MutantAnswers>>,
}

impl StaffAttempts {
    /// None yet, of the submissions of `staff` in `lab`.
    pub(crate) fn new(lab: &Lab, staff: &Staff) -> Self {
        let mut known = Self {
            solution: staff.solution.clone(),
            solution_runs: BTreeMap::new(),
            mutant_runs: BTreeMap::new(),
            mutant_answers: BTreeMap::new(),
        };
        for task in &lab.tasks {
            let is_of_task = |names: &[String]| names.contains(&task.name);
            let mutants = staff.mutants.iter();
            let mutants = mutants.filter(|mutant| is_of_task(&mutant.tasks));
            let keys = mutants.map(|mutant| (task.name.clone(), mutant.name.clone()));
            match &task.work {
                TaskWork::Function(..) => {
                    let places = keys.map(|key| (key, OnceLock::new()));
                    known.mutant_answers.extend(places);
                }
                TaskWork::Motion(..) => {
                    let places = keys.map(|key| (key, OnceLock::new()));
                    known.mutant_runs.extend(places);
                    let hidden = 0..staff.runs(&task.name).len();
                    for run in std::iter::once(None).chain(hidden.map(Some)) {
                        let key = (task.name.clone(), run);
                        known.solution_runs.insert(key, OnceLock::new());
                    }
                }
            }
        }
        known
    }

    /// Whether a submission is the reference solution itself.
    pub(super) fn is_solution(&self, submission: &Submission) -> bool {
        submission.name() == self.solution.name() && submission.text() == self.solution.text()
    }

    /// The solution's run of `task`: the visible one, or the hidden one with this number.
    pub(super) fn solution_run(
        &self,
        task: &str,
        hidden: Option<usize>,
        make: impl FnOnce() -> Attempt<Trace>,
    ) -> Arc<Attempt<Trace>> {
        once(self.solution_runs.get(&(task.to_owned(), hidden)), make)
    }

    /// The visible run of `mutant` in `task`.
    pub(super) fn mutant_run(
        &self,
        (task, mutant): (&str, &str),
        make: impl FnOnce() -> MutantRun,
    ) -> Arc<MutantRun> {
        once(
            self.mutant_runs.get(&(task.to_owned(), mutant.to_owned())),
            make,
        )
    }

    /// The answers of `mutant` in `task`.
    pub(super) fn mutant_answers(
        &self,
        (task, mutant): (&str, &str),
        make: impl FnOnce() -> MutantAnswers,
    ) -> Arc<MutantAnswers> {
        let key = (task.to_owned(), mutant.to_owned());
        once(self.mutant_answers.get(&key), make)
    }
}

/// What is at `place`, made if it is not there yet.
fn once<T>(place: Option<&Once<T>>, make: impl FnOnce() -> T) -> Arc<T> {
    match place {
        Some(place) => place.get_or_init(|| Arc::new(make())).clone(),
        None => Arc::new(make()),
    }
}
