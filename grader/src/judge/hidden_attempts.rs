//! Hidden runs: a motion task run again with numbers that only the course staff's salt gives, judged by the same checks, and reported
//! only by class.

use std::sync::Arc;

use kinemark_sim::text::Source;
use kinemark_sim::watch::event::{Event, EventKind};

use super::Interrupted;
use super::judged::JudgedCheck;
use super::motion_judge::MotionJudge;
use super::staff_attempts::StaffAttempts;
use crate::attempt::{Attempt, Disclosure};
use crate::lab::TaskWork;
use crate::lab::staff::HiddenRun;
use crate::record::grade::{Evidence, HiddenClass, Outcome, Stopped};
use crate::record::verdict::Verdict;
use crate::submission::handed_in::Submission;
use crate::submission::host::Host;

/// The hidden runs of one task, judged. There are none in practice mode, or if the visible run did not reach its end.
#[derive(Debug, Default)]
pub(super) struct HiddenAttempts(Vec<HiddenAttempt>);

#[derive(Debug)]
struct HiddenAttempt {
    class: String,
    /// The share of points of each check.
    scores: Vec<f64>,
    /// For each check, whether it was judged: a check that needs another one may not be, and none is of a run without an end.
    judged: Vec<bool>,
    digest: blake3::Hash,
    /// Whether the simulation is not accurate to its end.
    is_under_resolved: bool,
    stopped: Option<(Verdict, Stopped)>,
}

impl HiddenAttempt {
    /// Whether this machine or the grader failed in it, so that it decides nothing.
    fn is_undecided(&self) -> bool {
        matches!(&self.stopped, Some((verdict, _)) if !verdict.is_decided())
    }

    fn score(&self, check: usize) -> f64 {
        self.scores.get(check).copied().unwrap_or(0.0)
    }

    /// Whether the check was not judged because one that it needs earned nothing.
    fn needs_failed(&self, check: usize) -> bool {
        self.judged.contains(&true) && !self.judged.get(check).copied().unwrap_or(false)
    }
}

impl HiddenAttempts {
    /// Runs the task called `task` under `submission` in every lab of `runs`, compared with `solution` where a check asks for it.
    ///
    /// # Errors
    /// [`Interrupted`] if the host says so.
    pub(super) fn run(
        runs: &[&HiddenRun],
        task: &str,
        (submission, solution): (&Submission, &Source),
        known: Option<&StaffAttempts>,
        host: &mut dyn Host,
    ) -> Result<Self, Interrupted> {
        let mut attempts = Vec::new();
        for (number, run) in runs.iter().enumerate() {
            let known = known.map(|known| (known, number));
            attempts.extend(attempt(run, task, (submission, solution), known, host)?);
            // a worker that ran out of time or memory would do so again
            if attempts.last().is_some_and(HiddenAttempt::is_undecided) {
                break;
            }
        }
        Ok(Self(attempts))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether the points are undecided because some run decides nothing.
    pub(super) fn is_undecided(&self) -> bool {
        self.0.iter().any(HiddenAttempt::is_undecided)
    }

    /// The digest of the visible run with those of all hidden ones.
    pub(super) fn digest(&self, visible: blake3::Hash) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        hasher.update(visible.as_bytes());
        for attempt in &self.0 {
            hasher.update(attempt.digest.as_bytes());
        }
        hasher.finalize()
    }

    /// The scores of a check, summed.
    pub(super) fn sum_of_scores(&self, check: usize) -> f64 {
        self.0.iter().map(|attempt| attempt.score(check)).sum()
    }

    /// The report on a check: the classes in which it lost points, and those in which it was not judged because a check that it needs,
    /// one of those called `needed`, earned nothing.
    pub(super) fn losses(&self, check: usize, needed: &str) -> [Vec<Evidence>; 2] {
        [
            self.evidence(
                |run| run.score(check) < 1.0 && !run.needs_failed(check),
                |runs| format!("in {runs} points are lost"),
            ),
            self.evidence(
                |run| run.needs_failed(check),
                |runs| format!("not judged in {runs}, because {needed} earns nothing there"),
            )
            .into_iter()
            .map(|note| Evidence {
                is_note: true,
                ..note
            })
            .collect(),
        ]
    }

    /// One sentence per class with a run in which `lost`: the count, and never the numbers of a run.
    fn evidence(
        &self,
        lost: impl Fn(&HiddenAttempt) -> bool,
        what: impl Fn(&str) -> String,
    ) -> Vec<Evidence> {
        let classes = self.classes().into_iter();
        let evidence = classes.filter_map(|HiddenClass { class, total, .. }| {
            let of_class = self.0.iter().filter(|run| run.class == class);
            let lost = of_class.filter(|run| lost(run)).count();
            let message = what(&format!(
                "{lost} of {total} hidden runs of the class \"{class}\""
            ));
            (lost > 0).then(|| of_control(message, Some(class)))
        });
        evidence.collect()
    }

    /// The runs counted by class; a good run is one in which every check is full.
    pub(super) fn classes(&self) -> Vec<HiddenClass> {
        let mut classes: Vec<HiddenClass> = Vec::new();
        for run in &self.0 {
            let good = u32::from(run.scores.iter().all(|score| *score >= 1.0));
            let under_resolved = u32::from(run.is_under_resolved);
            match classes.iter_mut().find(|known| known.class == run.class) {
                Some(known) => {
                    known.good += good;
                    known.total += 1;
                    known.under_resolved += under_resolved;
                }
                None => classes.push(HiddenClass {
                    class: run.class.clone(),
                    good,
                    total: 1,
                    under_resolved,
                }),
            }
        }
        classes
    }

    /// The worst stop of a hidden run; the first among equal ones.
    pub(super) fn into_stopped(self) -> Option<(Verdict, Stopped)> {
        let stops = self.0.into_iter().filter_map(|run| run.stopped);
        stops.min_by_key(|(verdict, _)| *verdict)
    }
}

/// Evidence about all calls of `control`, without a moment in the visible run.
pub(super) fn of_control(message: String, class: Option<String>) -> Evidence {
    Evidence {
        message,
        signal: "control".to_owned(),
        case: class,
        ..Evidence::default()
    }
}

/// Steps of a hidden score: finer ones could reveal a hidden number through the points.
const HIDDEN_STEPS: f64 = 20.0;

/// The score of a hidden run, rounded down to a step, so that it is full only if it was full. A score above zero does not become zero,
/// because other checks may need one that earned something.
pub(super) fn counted_score(score: f64) -> f64 {
    let steps = (score * HIDDEN_STEPS).floor();
    let least = if score > 0.0 { 1.0 } else { 0.0 };
    steps.max(least) / HIDDEN_STEPS
}

/// One run; `None` if the lab of the run does not have the task, which loading excludes.
fn attempt(
    run: &HiddenRun,
    name: &str,
    (submission, solution): (&Submission, &Source),
    known: Option<(&StaffAttempts, usize)>,
    host: &mut dyn Host,
) -> Result<Option<HiddenAttempt>, Interrupted> {
    let lab = &run.lab;
    let Some(task) = lab.tasks.iter().find(|task| task.name == name) else {
        return Ok(None);
    };
    let TaskWork::Motion(work, checks) = &task.work else {
        return Ok(None);
    };
    let mut judge = MotionJudge::new(lab, task, (work, checks), submission, None);
    let of_solution = |judge: &MotionJudge<'_>| match known {
        Some((known, number)) => {
            known.solution_run(name, Some(number), || judge.attempt_of(solution))
        }
        None => Arc::new(judge.attempt_of(solution)),
    };
    if judge.needs_reference() {
        let run = of_solution(&judge);
        judge = judge.against(solution, run);
    }
    let attempt = match known.filter(|(known, _)| known.is_solution(submission)) {
        Some(_) => Attempt::clone(&of_solution(&judge)),
        None => judge.attempt(host),
    };
    let disclosure = Disclosure::HiddenRun { class: &run.class };
    let judged = judge.judge(&attempt, disclosure, host)?;
    let was_judged = |check: &JudgedCheck| check.outcome != Outcome::NotJudged;
    Ok(Some(HiddenAttempt {
        class: run.class.clone(),
        scores: judged
            .checks
            .iter()
            .map(|check| counted_score(check.score))
            .collect(),
        judged: judged.checks.iter().map(was_judged).collect(),
        digest: attempt.recorded.digest().all,
        is_under_resolved: attempt.recorded.events.iter().any(is_under_resolved),
        stopped: judged.stopped.map(|stopped| (judged.verdict, stopped)),
    }))
}

fn is_under_resolved(event: &Event) -> bool {
    matches!(event.kind, EventKind::UnderResolved { .. })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_names_the_check_that_stands_in_the_way() {
        let attempts = HiddenAttempts(vec![HiddenAttempt {
            class: "another post".to_owned(),
            scores: vec![0.5, 0.0],
            judged: vec![true, false],
            digest: blake3::hash(b""),
            is_under_resolved: false,
            stopped: None,
        }]);
        let messages = |check: usize| {
            let losses = attempts.losses(check, "\"The hand arrives\"");
            losses.map(|of_kind| {
                of_kind
                    .into_iter()
                    .map(|fact| fact.message)
                    .collect::<Vec<_>>()
            })
        };
        let [lost, unjudged] = messages(0);
        assert_eq!(
            lost,
            ["in 1 of 1 hidden runs of the class \"another post\" points are lost"]
        );
        assert!(unjudged.is_empty());
        let [lost, unjudged] = messages(1);
        assert!(lost.is_empty());
        assert_eq!(
            unjudged,
            [
                "not judged in 1 of 1 hidden runs of the class \"another post\", because \"The hand arrives\" earns nothing there"
            ]
        );
    }

    #[test]
    fn a_hidden_score_is_cut_to_twentieths_but_never_to_nothing() {
        for (score, counted) in [
            (1.0, 1.0),
            (0.999, 0.95),
            (0.5, 0.5),
            (0.05, 0.05),
            (0.04, 0.05),
            (1e-5, 0.05),
            (0.0, 0.0),
        ] {
            assert_eq!(counted_score(score), counted, "{score}");
        }
    }
}
