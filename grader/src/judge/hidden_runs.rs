//! Hidden runs: a motion task run again with numbers that only the staff's salt knows, judged by the same checks, and told by
//! class alone.

use kinemark_sim::source::Source;

use crate::attempt::motion::{self, EarlyEnd, MotionRun};
use crate::attempt::stopped;
use crate::check::{self, MotionFacts, stay};
use crate::judge::robustness_sweep::{self, Undecided};
use crate::judge::{Host, Interrupted, judged, opening, pose_band};
use crate::lab::model::{Check, TaskWork};
use crate::lab::staff::HiddenRun;
use crate::record::grade::{CheckGrade, Evidence, HiddenClass, Outcome, Stopped};
use crate::record::names::Names;
use crate::record::quantity::points;
use crate::record::verdict::Verdict;

/// The hidden runs of one task as they went.
#[derive(Debug, Default)]
pub(crate) struct HiddenRuns {
    runs: Vec<Seen>,
}

#[derive(Debug)]
struct Seen {
    class: String,
    /// The share of points of each check.
    scores: Vec<f64>,
    /// For each check, whether it was judged: a check that needs another one may not have been.
    judged: Vec<bool>,
    digest: blake3::Hash,
    stopped: Option<(Verdict, Stopped)>,
}

impl Seen {
    /// Whether this machine or the grader failed in it, so that nothing is known.
    fn is_undecided(&self) -> bool {
        matches!(&self.stopped, Some((verdict, _)) if !verdict.is_decided())
    }
}

impl HiddenRuns {
    /// Runs `task` under `submission` in every lab of `runs`.
    ///
    /// # Errors
    /// [`Interrupted`] if the host says so.
    pub(crate) fn run(
        runs: &[&HiddenRun],
        task: &str,
        submission: &Source,
        host: &mut dyn Host,
    ) -> Result<Self, Interrupted> {
        let mut seen = Self::default();
        for run in runs {
            seen.runs.extend(one(run, task, submission, host)?);
            // a worker that ran out of time or memory would do so again
            if seen.runs.last().is_some_and(Seen::is_undecided) {
                break;
            }
        }
        Ok(seen)
    }

    /// The digest of the visible run with those of all hidden ones.
    pub(crate) fn digest(&self, visible: blake3::Hash) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        hasher.update(visible.as_bytes());
        for run in &self.runs {
            hasher.update(run.digest.as_bytes());
        }
        hasher.finalize()
    }

    /// Makes the score of every check the mean over the visible and the hidden runs.
    pub(crate) fn count_in(&self, grades: &mut [CheckGrade], checks: &[Check]) {
        if self.runs.is_empty() {
            return;
        }
        if self.runs.iter().any(Seen::is_undecided) {
            for grade in grades {
                grade.outcome = Outcome::NotJudged;
                grade.points = 0.0;
                grade.measure = None;
                grade.evidence.clear();
                grade.next_step = None;
            }
            return;
        }
        for (i, (grade, check)) in grades.iter_mut().zip(checks).enumerate() {
            let score = |run: &Seen| run.scores.get(i).copied().unwrap_or(0.0);
            let hidden: f64 = self.runs.iter().map(score).sum();
            let visible = grade.points / grade.max_points;
            let mean = (visible + hidden) / (self.runs.len() + 1) as f64;
            // as far as it shows
            if points(grade.points) != points(grade.max_points * mean) {
                grade
                    .evidence
                    .push(self.mean_of(grade.points, grade.max_points));
            }
            grade.points = grade.max_points * mean;
            let judged = |run: &Seen| run.judged.get(i).copied().unwrap_or(false);
            let was_full = grade.outcome == Outcome::Full;
            let needs_failed = |run: &Seen| run.stopped.is_none() && !judged(run);
            let mut evidence = self.evidence(
                |run| score(run) < 1.0 && !needs_failed(run),
                "points are lost",
            );
            let all_needs = evidence.is_empty();
            evidence
                .extend(self.evidence(needs_failed, "a check that this one needs earns nothing"));
            if evidence.is_empty() {
                // it was full in every hidden run; what the visible one lost is said already
                if grade.outcome != Outcome::Full && mean > 0.0 {
                    grade.outcome = Outcome::Partial;
                }
                continue;
            }
            grade.outcome = if mean > 0.0 {
                Outcome::Partial
            } else if grade.outcome == Outcome::NotJudged {
                Outcome::NotJudged
            } else {
                Outcome::None
            };
            grade.evidence.extend(evidence);
            if grade.next_step.is_none() && was_full {
                let needed = check.needs.iter().map(|&need| checks[need].title.as_str());
                grade.next_step = Some(if all_needs {
                    let needed: Vec<&str> = needed.collect();
                    format!("First see to \"{}\" there.", needed.join("\" and \""))
                } else {
                    NEXT_STEP.to_owned()
                });
            }
        }
    }

    /// What the measure of the visible run does not say: that others count as much.
    fn mean_of(&self, visible: f64, of: f64) -> Evidence {
        let runs = match self.runs.len() {
            1 => "a hidden run".to_owned(),
            several => format!("{several} hidden runs"),
        };
        Evidence {
            message: format!(
                "the visible run alone earns {} of {}; the points are the mean of it and {runs}",
                points(visible),
                points(of)
            ),
            signal: "control".to_owned(),
            tick: None,
            time_s: None,
            run: None,
            case: None,
            value: None,
            limit: None,
            unit: String::new(),
        }
    }

    /// One sentence per class with a run in which `lost`: how many, and never which numbers.
    fn evidence(&self, lost: impl Fn(&Seen) -> bool, what: &str) -> Vec<Evidence> {
        let told = self
            .classes()
            .into_iter()
            .filter_map(|HiddenClass { class, total, .. }| {
                let of_class = self.runs.iter().filter(|run| run.class == class);
                let lost = of_class.filter(|run| lost(run)).count();
                (lost > 0).then(|| Evidence {
                    message: format!(
                        "in {lost} of {total} hidden runs of the class \"{class}\" {what}"
                    ),
                    signal: "control".to_owned(),
                    tick: None,
                    time_s: None,
                    run: None,
                    case: Some(class),
                    value: None,
                    limit: None,
                    unit: String::new(),
                })
            });
        told.collect()
    }

    /// The runs counted by class: good is one in which every check is full.
    pub(crate) fn classes(&self) -> Vec<HiddenClass> {
        let mut classes: Vec<HiddenClass> = Vec::new();
        for run in &self.runs {
            let good = u32::from(run.scores.iter().all(|score| *score >= 1.0));
            match classes.iter_mut().find(|known| known.class == run.class) {
                Some(known) => {
                    known.good += good;
                    known.total += 1;
                }
                None => classes.push(HiddenClass {
                    class: run.class.clone(),
                    good,
                    total: 1,
                }),
            }
        }
        classes
    }

    /// The worst stop of a hidden run, of equal ones the first.
    pub(crate) fn into_stopped(self) -> Option<(Verdict, Stopped)> {
        let stops = self.runs.into_iter().filter_map(|run| run.stopped);
        stops.min_by_key(|(verdict, _)| *verdict)
    }
}

const NEXT_STEP: &str = "The task is run with other numbers, too. If one is typed in, take it from `robot` or `observation`; if none is, aim for wider margins: what the visible run has to spare tells how wide they are.";

/// Steps in which a hidden score is told: finer ones could carry a hidden number out in the points.
const HIDDEN_STEPS: f64 = 20.0;

/// A score as it counts in a hidden run: cut off to whole steps, so that it is full only where it was full, but for one above zero not
/// to zero: what a check needs has earned something or it has not, and the points must say the same.
fn told_score(score: f64) -> f64 {
    let steps = (score * HIDDEN_STEPS).floor();
    let least = if score > 0.0 { 1.0 } else { 0.0 };
    steps.max(least) / HIDDEN_STEPS
}

/// A stop without a place: which line fails can tell a hidden number.
fn nowhere(message: &str) -> Stopped {
    Stopped {
        message: message.to_owned(),
        help: None,
        line: None,
        column: None,
        source_line: None,
        tick: None,
        time_s: None,
        case: None,
    }
}

/// One run; `None` if the lab of the run has not the task, which loading has ruled out.
fn one(
    run: &HiddenRun,
    name: &str,
    submission: &Source,
    host: &mut dyn Host,
) -> Result<Option<Seen>, Interrupted> {
    let lab = &run.lab;
    let Some(task) = lab.tasks.iter().find(|task| task.name == name) else {
        return Ok(None);
    };
    let TaskWork::Motion(work) = &task.work else {
        return Ok(None);
    };
    let opening = opening(lab, task, submission);
    let MotionRun { trace, ended, .. } = motion::run(lab, work, &opening, host);
    let mut stopped = match &ended {
        None => None,
        Some((_, EarlyEnd::Stopped(stop))) => {
            let verdict = stopped::verdict(stop).ok_or(Interrupted)?;
            let mut record = stopped::record(stop, submission.text());
            if stopped::is_of_one_call(stop) {
                // the words of the submission could tell the numbers of a hidden run
                record = Stopped {
                    case: Some(run.class.clone()),
                    ..nowhere("the submission failed in a hidden run")
                };
            }
            Some((verdict, record))
        }
        Some((_, why)) => {
            let (verdict, message) = match why {
                EarlyEnd::Diverged { .. } => (
                    Verdict::Missed,
                    "the motion of a hidden run went beyond all bounds",
                ),
                _ => (
                    Verdict::InvalidOutput,
                    "no command, or one that is not finite, in a hidden run",
                ),
            };
            let record = Stopped {
                case: Some(run.class.clone()),
                ..nowhere(message)
            };
            Some((verdict, record))
        }
    };
    let band = pose_band(&task.checks);
    let mut facts = MotionFacts {
        robot: &lab.robot,
        names: Names {
            robot: &lab.robot,
            scene: work.scene.as_ref().map(|scene| &scene.scene),
            seen_from: &lab.frame,
        },
        motion: work,
        trace: &trace,
        stays: stay::best_stays(&trace, &work.goals, band),
        pose_band: band,
        reference: None,
        climbs: Vec::new(),
    };
    if ended.is_none() {
        match robustness_sweep::climbs(lab, task, work, &opening, &facts, host) {
            Ok(climbs) => facts.climbs = climbs,
            Err(Undecided(stop)) => {
                let verdict = stopped::verdict(&stop).ok_or(Interrupted)?;
                stopped = Some((verdict, stopped::record(&stop, submission.text())));
            }
        }
    }
    let judged = judged(&task.checks, stopped.is_none(), |check| {
        check::judge_motion(check, &facts)
    });
    let scores = judged
        .iter()
        .map(|(check, _)| told_score(check.points / check.max_points));
    let judged_ones = judged
        .iter()
        .map(|(check, _)| check.outcome != Outcome::NotJudged);
    Ok(Some(Seen {
        class: run.class.clone(),
        scores: scores.collect(),
        judged: judged_ones.collect(),
        digest: trace.digest().all,
        stopped,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hidden_score_is_cut_to_twentieths_but_never_to_nothing() {
        for (score, told) in [
            (1.0, 1.0),
            (0.999, 0.95),
            (0.5, 0.5),
            (0.05, 0.05),
            (0.04, 0.05),
            (1e-5, 0.05),
            (0.0, 0.0),
        ] {
            assert_eq!(told_score(score), told, "{score}");
        }
    }
}
