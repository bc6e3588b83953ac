//! Grading a function task: its visible and hidden cases, its checks, and the mutants that it matches.

use std::sync::Arc;

use super::Interrupted;
use super::case_grades::{case_grade, hidden_classes, is_good};
use super::check_grades::check_grades;
use super::diagnose::{self, Diagnosed, MutantAnswers};
use super::expected::with_expected;
use super::grader::{GradedTask, Grader, MOST_LOG_LINES, TaskScores};
use super::hidden_attempts::HiddenAttempts;
use super::judged::{JudgedCheck, all_full, judge};
use super::shown_cases::shown_cases;
use super::single_case::single_cases;
use crate::attempt::answers::{Answered, Answers, CaseFacts};
use crate::attempt::{Attempt, Disclosure, EndReason, Ended, function};
use crate::check::{self, Check, FunctionCheck, cause};
use crate::lab::Task;
use crate::lab::staff::Mutant;
use crate::record::grade::{CheckGrade, Diagnosis, Digests, Stopped, TaskGrade, TaskKind};
use crate::record::quantity::sum_of_points;
use crate::record::staff_fault::StaffSubmission;
use crate::record::verdict::Verdict;
use crate::submission::controller::Stop;
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess};
use crate::task::model::{Band, Case, FunctionTask};

impl Grader<'_> {
    pub(super) fn function(
        &self,
        task: &Task,
        work: &FunctionTask,
        checks: &[Check<dyn FunctionCheck>],
        host: &mut dyn Host,
    ) -> Result<GradedTask, Interrupted> {
        let (cases, fault) = self.cases(task, work);
        let opening = self.opening(task, self.submission);
        let cell = self.lab.workcell();
        let mut attempt = function::run(cell, work, &cases, &opening, host);
        if let Some(fault) = fault {
            attempt.ended = Some(Ended::stopped_by(Stop::GraderFault(fault), 0));
        }
        let (mut verdict, stopped) = self.ended(&attempt)?;
        let facts = &attempt.recorded.facts;
        let can_be_judged = verdict.is_decided() && !is_without_function(attempt.ended.as_ref());
        let mut judged = judge(checks, can_be_judged, &[], |check| {
            check.kind.judge(work, facts)
        });
        if !all_full(&judged) {
            verdict = verdict.min(Verdict::Missed);
        }
        let band = check::answer_band(checks);
        let diagnosed = (verdict != Verdict::Passed && verdict.is_decided())
            .then(|| self.function_diagnoses(task, (work, band), &cases, &attempt));
        let (diagnoses, rulings) = Diagnosed::parts(diagnosed);
        let diagnoses = self.in_words_of(task, diagnoses);
        if diagnoses.is_empty() {
            self.name_cause(work, facts, band, &mut judged);
        }
        // a stop explains the cases that it stopped, and no wrong answer to another one
        let is_wrong = |facts: &CaseFacts<'_>| {
            let is_answer = !matches!(facts.answer, Answered::Invalid(_) | Answered::Stopped);
            facts.is_visible() && is_answer && !is_good(facts, band)
        };
        let by_stop = stopped.is_some() && !facts.iter().any(is_wrong);
        let explained = by_stop || !diagnoses.is_empty();
        let scores = TaskScores {
            checks: judged.iter().map(|check| check.score).collect(),
            cases: if self.judges_each_case {
                single_cases(self.lab, checks, work, facts)
            } else {
                Vec::new()
            },
            rulings,
        };
        let checks = function_checks(checks, &judged, explained);
        let cases = shown_cases((&task.name, &self.lab.frame), work, facts, band);
        let outcome = (verdict, stopped);
        Ok(GradedTask {
            grade: self.function_grade((task, work, band), outcome, checks, diagnoses, attempt),
            run: None,
            cases: Some(cases),
            scores,
        })
    }

    /// All cases of a task, hidden ones with their expected answers; with a fault, if the reference solution does not give them,
    /// the visible ones alone.
    fn cases(&self, task: &Task, work: &FunctionTask) -> (Vec<Case>, Option<String>) {
        let mut all = work.cases.clone();
        let Some(staff) = self.staff else {
            return (all, None);
        };
        let draws = staff.draws_of(&task.name);
        let hidden = draws.map(|draw| with_expected(self.lab, task, &draw.cases, &staff.solution));
        match hidden.collect::<Result<Vec<_>, _>>() {
            Ok(hidden) => {
                all.extend(hidden.into_iter().flatten());
                (all, None)
            }
            Err(why) => (all, Some(why)),
        }
    }

    /// The verdict that follows from the end of an attempt alone.
    fn ended(
        &self,
        attempt: &Attempt<Answers<'_>>,
    ) -> Result<(Verdict, Option<Stopped>), Interrupted> {
        let Some(ended) = &attempt.ended else {
            return Ok((Verdict::Passed, None));
        };
        let case = &attempt.recorded.facts[ended.at as usize].case;
        let disclosure = match &case.hidden_class {
            Some(class) => Disclosure::HiddenCase { class },
            None => Disclosure::Case { name: &case.name },
        };
        let verdict = ended.verdict().ok_or(Interrupted)?;
        let record = ended.record(self.submission.text(), disclosure);
        Ok((verdict, Some(record)))
    }

    fn function_grade(
        &self,
        (task, work, band): (&Task, &FunctionTask, Band),
        (verdict, stopped): (Verdict, Option<Stopped>),
        checks: Vec<CheckGrade>,
        diagnoses: Vec<Diagnosis>,
        attempt: Attempt<Answers<'_>>,
    ) -> TaskGrade {
        let Answers { facts, log, digest } = attempt.recorded;
        let has_hidden = facts.iter().any(|facts| !facts.is_visible());
        let digest = match self.staff.filter(|_| has_hidden) {
            Some(staff) => staff.keyed(digest),
            None => digest,
        };
        let visible = facts.iter().filter(|facts| facts.is_visible());
        TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Function,
            verdict,
            points: sum_of_points(checks.iter().map(|check| check.points)),
            max_points: task.max_points(),
            points_at_hand_in: 0.0,
            stopped,
            checks,
            diagnoses,
            cases: visible
                .map(|facts| case_grade(self.lab, work, facts, band))
                .collect(),
            hidden: hidden_classes(&facts, band),
            events: Vec::new(),
            contacts: Vec::new(),
            operations: attempt.operations,
            log: log.into_iter().take(MOST_LOG_LINES).collect(),
            digests: Digests {
                all: digest.to_hex().to_string(),
                seconds: Vec::new(),
                rungs: Vec::new(),
            },
            divergence: None,
            figures: None,
        }
    }

    /// Says what all answers together show at the first check that lost points.
    fn name_cause(
        &self,
        work: &FunctionTask,
        facts: &[CaseFacts<'_>],
        band: Band,
        judged: &mut [JudgedCheck],
    ) {
        let mut lost = judged.iter_mut().filter(|check| check.loss().is_some());
        let Some(finding) = lost.next().and_then(|check| check.finding.as_mut()) else {
            return;
        };
        let cause = cause::of_answers(&self.lab.frame, facts, |facts| is_good(facts, band));
        if let Some(cause) = cause {
            cause.explains(work, finding);
        }
    }

    fn function_diagnoses(
        &self,
        task: &Task,
        (work, band): (&FunctionTask, Band),
        cases: &[Case],
        student: &Attempt<Answers<'_>>,
    ) -> Diagnosed {
        let mutants = self.mutants_of(task).map(|mutant| {
            let answers = self.mutant_answers(task, (work, band), cases, mutant);
            (mutant, answers)
        });
        diagnose::function_task(&student.recorded.facts, mutants, band)
    }

    /// The answers of a mutant to all cases of a task.
    fn mutant_answers(
        &self,
        task: &Task,
        (work, band): (&FunctionTask, Band),
        cases: &[Case],
        mutant: &Mutant,
    ) -> Arc<MutantAnswers> {
        let make = || {
            let opening = self.opening(task, &Submission::from(&mutant.source));
            let cell = self.lab.workcell();
            let run = function::run(cell, work, cases, &opening, &mut InProcess);
            let whose = StaffSubmission::Mutant(mutant.name.clone());
            self.note_stop(whose, task, &mutant.source, run.ended.as_ref());
            MutantAnswers::of(&run.recorded.facts, band)
        };
        match self.known {
            Some(known) => known.mutant_answers((&task.name, &mutant.name), make),
            None => Arc::new(make()),
        }
    }

    /// Makes the answers of a mutant, which are then known.
    pub(super) fn prepare_answers(
        &self,
        task: &Task,
        work: &FunctionTask,
        checks: &[Check<dyn FunctionCheck>],
        mutant: &Mutant,
    ) {
        let (cases, _) = self.cases(task, work);
        let band = check::answer_band(checks);
        self.mutant_answers(task, (work, band), &cases, mutant);
    }
}

/// Whether the submission does not compile or lacks the function.
fn is_without_function(ended: Option<&Ended>) -> bool {
    matches!(
        ended.map(|ended| &ended.why),
        Some(EndReason::Stopped(
            Stop::Missing { .. } | Stop::DidNotBuild(_)
        ))
    )
}

/// The grades of a function task's checks: the judged cases include the hidden ones, and there is no first moment of loss.
fn function_checks(
    checks: &[Check<dyn FunctionCheck>],
    judged: &[JudgedCheck],
    explained: bool,
) -> Vec<CheckGrade> {
    let first_lost = vec![None; judged.len()];
    let hidden = HiddenAttempts::default();
    check_grades(checks, judged, &first_lost, &hidden, explained)
}
