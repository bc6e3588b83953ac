//! Grading a function task: its visible and hidden cases, its checks, and the known mistakes it shows.

use super::case_grades::{case_grade, hidden_classes};
use super::points::{counted, judged, not_finite_help, without_hints};
use super::{Grader, Host, InProcess, Interrupted, MOST_LOG_LINES};
use crate::attempt::function::{self as cases, CasesRun};
use crate::attempt::stopped;
use crate::check::{self, Answered, CaseFacts};
use crate::judge::diagnose;
use crate::lab::model::{Band, Case, Check, CheckKind, Function, FunctionTask, Task};
use crate::lab::staff::Mutant;
use crate::lab::staff::sound::Whose;
use crate::record::grade::{CheckGrade, Diagnosis, Digests, Outcome, Stopped, TaskGrade, TaskKind};
use crate::record::verdict::Verdict;
use crate::submission::controller::Stop;

impl Grader<'_> {
    pub(super) fn function(
        &self,
        task: &Task,
        work: &FunctionTask,
        host: &mut dyn Host,
    ) -> Result<TaskGrade, Interrupted> {
        let mut all: Vec<Case> = work.cases.clone();
        // with a staff's part that hides cases of this task
        let hiding = self
            .staff
            .filter(|staff| !staff.hidden(&task.name).is_empty());
        all.extend_from_slice(hiding.map_or(&[], |staff| staff.hidden(&task.name)));
        let opening = self.opening(task, self.submission);
        let run = cases::run(self.lab, &work.function, &all, &opening, host);
        let mut stopped_record = None;
        let mut verdict = Verdict::Passed;
        if let Some((case, stop)) = &run.stop {
            verdict = stopped::verdict(stop).ok_or(Interrupted)?;
            let mut record = stopped::record(stop, self.submission.text());
            let facts = &run.facts[*case];
            if stopped::is_of_one_call(stop) {
                record.case = Some(facts.told().to_owned());
                if !facts.is_visible() {
                    // the words of the submission could tell the numbers of a hidden case
                    record.message = "the submission failed in a hidden case".to_owned();
                    record.help = None;
                    // nor may the line that fails: a ladder of comparisons would count a number out
                    (record.line, record.column, record.source_line) = (None, None, None);
                }
            }
            stopped_record = Some(record);
        }
        let could_run = !matches!(
            run.stop,
            Some((_, Stop::Missing { .. } | Stop::DidNotBuild(_)))
        );
        let checks = judged(&task.checks, could_run && verdict.is_decided(), |check| {
            check::judge_function(check, &work.function, &run.facts)
        });
        let checks: Vec<CheckGrade> = checks.into_iter().map(|(check, _)| check).collect();
        let invalid = run.facts.iter().find_map(|facts| match &facts.answer {
            Answered::Invalid(what) if facts.is_visible() => Some((facts.told(), what.clone())),
            Answered::Invalid(_) => Some((
                facts.told(),
                "an answer of the wrong shape, or not finite, in a hidden case".to_owned(),
            )),
            Answered::Position(_)
            | Answered::Branches(_)
            | Answered::Matrix(_)
            | Answered::Entries(_)
            | Answered::Stopped => None,
        });
        let invalid = invalid.map(|(case, what)| (case.to_owned(), what));
        if let (Some((case, what)), None) = (invalid, &stopped_record) {
            verdict = verdict.min(Verdict::InvalidOutput);
            stopped_record = Some(Stopped {
                help: not_finite_help(&what),
                message: what,
                line: None,
                column: None,
                source_line: None,
                tick: None,
                time_s: None,
                case: Some(case),
            });
        }
        if checks.iter().any(|check| check.outcome != Outcome::Full) {
            verdict = verdict.min(Verdict::Missed);
        }
        let diagnoses = if verdict == Verdict::Passed || !verdict.is_decided() {
            Vec::new()
        } else {
            self.function_diagnoses(task, &work.function, &all, &run)
        };
        let explained = stopped_record.is_some() || !diagnoses.is_empty();
        let mut checks = without_hints(checks, explained);
        let points = counted(&mut checks);
        let good = good_bands(&task.checks);
        Ok(TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Function,
            verdict,
            points,
            max_points: task.max_points(),
            stopped: stopped_record,
            checks,
            diagnoses,
            cases: run
                .facts
                .iter()
                .filter(|facts| facts.is_visible())
                .map(|facts| case_grade(self.lab, facts, good))
                .collect(),
            hidden: hidden_classes(&run.facts, good),
            events: Vec::new(),
            contacts: Vec::new(),
            operations: run.operations,
            log: run.log.into_iter().take(MOST_LOG_LINES).collect(),
            digests: Digests {
                all: hiding
                    .map_or(run.digest, |staff| staff.keyed(run.digest))
                    .to_hex()
                    .to_string(),
                seconds: Vec::new(),
                rungs: Vec::new(),
            },
            divergence: None,
        })
    }

    fn function_diagnoses(
        &self,
        task: &Task,
        function: &Function,
        all: &[Case],
        student: &CasesRun<'_>,
    ) -> Vec<Diagnosis> {
        let mutants = self.mutants_of(task).map(|mutant| {
            let opening = self.opening(task, &mutant.source);
            let run = cases::run(self.lab, function, all, &opening, &mut InProcess);
            if let Some((_, stop)) = &run.stop {
                self.note_fault(Whose::Mutant(mutant), task, &mutant.source, stop);
            }
            (mutant, run.facts)
        });
        // mutants outlive the closure's borrow only if collected
        let answers: Vec<(&Mutant, Vec<CaseFacts<'_>>)> = mutants.collect();
        diagnose::function_task(
            &student.facts,
            answers.into_iter(),
            good_bands(&task.checks),
        )
    }
}

/// The band of distances, or of relative ones, by which a function task's single answers are called good or wrong.
fn good_bands(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::FkError(band)
        | CheckKind::IkReach(band)
        | CheckKind::JacobianMatch(band)
        | CheckKind::FunctionCases { band, .. } => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 1e-3,
        zero: 1e-2,
    })
}
