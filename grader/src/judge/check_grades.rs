//! The grade of each check, over all attempts of a task. The record of each check is made here, once.

use super::hidden_attempts::{HiddenAttempts, of_control};
use super::judged::JudgedCheck;
use crate::check::{Check, Finding};
use crate::record::grade::{CheckGrade, Evidence, Instant, Measure, Outcome};
use crate::record::quantity::{points, whole_hundredths};

/// The grades of a task's checks: `visible` and `first_lost` have one entry per check. If `explained`, a stop or a diagnosis already
/// explains the loss, and a check's general question would look like another cause.
pub(super) fn check_grades<K: ?Sized>(
    checks: &[Check<K>],
    visible: &[JudgedCheck],
    first_lost: &[Option<Instant>],
    hidden: &HiddenAttempts,
    explained: bool,
) -> Vec<CheckGrade> {
    let judged = checks.iter().zip(visible).zip(first_lost).enumerate();
    let grades = judged.map(|(i, ((check, judged), first_lost))| {
        let mut parts = visible_parts(checks, check, judged, hidden);
        if hidden.is_undecided() {
            parts = Parts::default();
        } else if !hidden.is_empty() {
            parts = parts.averaged(checks, i, hidden);
        }
        let has_step = !explained || parts.outcome == Outcome::NotJudged;
        CheckGrade {
            name: check.name.clone(),
            title: check.title.clone(),
            outcome: parts.outcome,
            points: whole_hundredths(check.points * parts.score, check.points),
            max_points: check.points,
            measure: parts.measure,
            first_lost: *first_lost,
            evidence: parts.evidence,
            next_step: parts.next_step.filter(|_| has_step),
            has_hints: parts.has_hints && has_step,
            look_first_at: look_first_at(checks, judged),
        }
    });
    grades.collect()
}

/// The name of the check that may be why this one lost points.
fn look_first_at<K: ?Sized>(checks: &[Check<K>], judged: &JudgedCheck) -> Option<String> {
    Some(checks[judged.look_first_at?].name.clone())
}

/// The result of a check, before it becomes a record.
struct Parts {
    /// The share of the points, in `[0, 1]`.
    score: f64,
    outcome: Outcome,
    measure: Option<Measure>,
    evidence: Vec<Evidence>,
    next_step: Option<String>,
    /// Whether the lab has hints that lead on from the next step.
    has_hints: bool,
}

impl Default for Parts {
    /// The result of a check that was not judged.
    fn default() -> Self {
        Self {
            score: 0.0,
            outcome: Outcome::NotJudged,
            measure: None,
            evidence: Vec::new(),
            next_step: None,
            has_hints: false,
        }
    }
}

/// The result of a check in the visible attempt.
fn visible_parts<K: ?Sized>(
    checks: &[Check<K>],
    check: &Check<K>,
    judged: &JudgedCheck,
    hidden: &HiddenAttempts,
) -> Parts {
    let loss = judged.loss();
    let question = loss
        .filter(|finding| !finding.insists)
        .and_then(|_| check.hints.first());
    let next_step = match (loss, judged.unmet) {
        (Some(finding), _) => Some(question.unwrap_or(&finding.next_step).clone()),
        // with its points of hidden runs it would seem to earn some
        (None, Some(need)) if hidden.sum_of_scores(need) > 0.0 => Some(format!(
            "Not judged in the visible run: \"{}\" earns nothing in it.",
            checks[need].title
        )),
        (None, Some(need)) => Some(format!(
            "Not judged until \"{}\" earns points.",
            checks[need].title
        )),
        (None, None) => None,
    };
    // what leads to another check, or away from the lab's hints, does not lead to them
    let is_cause = |finding: &Finding| finding.evidence.first().is_some_and(|fact| fact.is_cause);
    let has_hints = loss.is_some_and(|finding| !finding.insists || is_cause(finding));
    let finding = judged.finding.as_ref();
    Parts {
        score: judged.score,
        outcome: judged.outcome,
        measure: finding.and_then(|finding| finding.measure.clone()),
        evidence: loss.map_or(Vec::new(), |finding| finding.evidence.clone()),
        next_step,
        has_hints: has_hints && !check.hints.is_empty(),
    }
}

const OTHER_NUMBERS: &str = "The task is run with other numbers, too. If one is typed in, take it from `robot` or `observation`; if none is, aim for wider margins: the margins of the visible run show how wide they are.";

impl Parts {
    /// The mean of the visible and the hidden attempts; `self` is the result of check `i` in the visible one.
    fn averaged<K: ?Sized>(self, checks: &[Check<K>], i: usize, hidden: &HiddenAttempts) -> Self {
        let check = &checks[i];
        let was = self.outcome;
        let score = (self.score + hidden.sum_of_scores(i)) / (hidden.count() + 1) as f64;
        let mut evidence = self.evidence;
        let [alone, together] = [self.score, score].map(|score| check.points * score);
        // a note only if the shown points differ
        if points(alone) != points(together) {
            evidence.push(mean_of(alone, check.points, hidden.count()));
        }
        let [lost, needs_failed] = hidden.losses(i, &needed(checks, check, "or"));
        let is_lost = !lost.is_empty() || !needs_failed.is_empty();
        let next_step = self.next_step.or_else(|| {
            // a loss in the visible run already has its next step
            (is_lost && was == Outcome::Full).then(|| hidden_next_step(checks, check, &lost))
        });
        evidence.extend(lost);
        evidence.extend(needs_failed);
        let outcome = match was {
            // full in every hidden run too
            Outcome::Full if !is_lost => Outcome::Full,
            _ if score > 0.0 => Outcome::Partial,
            Outcome::NotJudged => Outcome::NotJudged,
            was if !is_lost => was,
            _ => Outcome::None,
        };
        Self {
            score,
            outcome,
            measure: self.measure,
            evidence,
            next_step,
            has_hints: self.has_hints,
        }
    }
}

/// What to do where only hidden runs lost points.
fn hidden_next_step<K: ?Sized>(checks: &[Check<K>], check: &Check<K>, lost: &[Evidence]) -> String {
    if !lost.is_empty() {
        return OTHER_NUMBERS.to_owned();
    }
    format!(
        "First make {} earn points in the hidden runs.",
        needed(checks, check, "and")
    )
}

/// The titles of the checks that a check needs, with a word between.
fn needed<K: ?Sized>(checks: &[Check<K>], check: &Check<K>, between: &str) -> String {
    let titles = check.needs.iter().map(|&need| &checks[need].title);
    let titles: Vec<String> = titles.map(|title| format!("\"{title}\"")).collect();
    titles.join(&format!(" {between} "))
}

/// A note that hidden runs count as much as the visible run, whose measure is shown.
fn mean_of(alone: f64, of: f64, hidden: usize) -> Evidence {
    let runs = match hidden {
        1 => "a hidden run".to_owned(),
        several => format!("{several} hidden runs"),
    };
    let message = format!(
        "the visible run alone earns {} of {}; the points are the mean of it and {runs}",
        points(alone),
        points(of)
    );
    Evidence {
        is_note: true,
        ..of_control(message, None)
    }
}
