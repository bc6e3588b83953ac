//! Judging an attempt by every check of its task in order: a visible run, a hidden run, or the answers to cases.

use crate::check::{Check, Finding};
use crate::record::grade::Outcome;

/// The result of a check in one attempt.
#[derive(Debug)]
pub(super) struct JudgedCheck {
    /// The share of its points, in `[0, 1]`; 0 where it was not judged.
    pub(super) score: f64,
    /// The outcome that goes with the score.
    pub(super) outcome: Outcome,
    /// Its finding; `None` if it was not judged.
    pub(super) finding: Option<Finding>,
    /// Index of a needed check that earned nothing, if that is why it was not judged.
    pub(super) unmet: Option<usize>,
    /// Index of another check that may be why this one lost points.
    pub(super) look_first_at: Option<usize>,
}

impl JudgedCheck {
    fn not_judged(unmet: Option<usize>) -> Self {
        Self {
            score: 0.0,
            outcome: Outcome::NotJudged,
            finding: None,
            unmet,
            look_first_at: unmet,
        }
    }

    /// A check that is judged when the submission is handed in.
    fn at_hand_in() -> Self {
        Self {
            outcome: Outcome::AtHandIn,
            ..Self::not_judged(None)
        }
    }

    fn of(finding: Finding) -> Self {
        // a tiny fraction of a point would be shown as no point
        let score = if finding.score < 1e-6 {
            0.0
        } else {
            finding.score.clamp(0.0, 1.0)
        };
        let outcome = if score >= 1.0 {
            Outcome::Full
        } else if score > 0.0 {
            Outcome::Partial
        } else {
            Outcome::None
        };
        Self {
            score,
            outcome,
            finding: Some(finding),
            unmet: None,
            look_first_at: None,
        }
    }

    /// Its finding, if what was measured lost points.
    pub(super) fn loss(&self) -> Option<&Finding> {
        let finding = self.finding.as_ref();
        finding.filter(|finding| finding.score.is_nan() || finding.is_lost())
    }

    /// Keeps a share of its points, because the submission failed in the run.
    pub(super) fn keep(&mut self, share: f64) {
        self.score *= share;
        if self.score <= 0.0 && matches!(self.outcome, Outcome::Full | Outcome::Partial) {
            self.outcome = Outcome::None;
        } else if self.score < 1.0 && self.outcome == Outcome::Full {
            self.outcome = Outcome::Partial;
        }
    }
}

/// Judges an attempt by its task's checks in order. A check is not judged if it needs one that earned nothing, or if the attempt cannot
/// be judged; those `at_hand_in`, by index, are left open, and stand in the way of no other.
pub(super) fn judge<K: ?Sized>(
    checks: &[Check<K>],
    can_be_judged: bool,
    at_hand_in: &[usize],
    find: impl Fn(&Check<K>) -> Finding,
) -> Vec<JudgedCheck> {
    let mut judged: Vec<JudgedCheck> = Vec::with_capacity(checks.len());
    for (i, check) in checks.iter().enumerate() {
        if at_hand_in.contains(&i) {
            judged.push(JudgedCheck::at_hand_in());
            continue;
        }
        let mut needs = check.needs.iter().copied();
        let earned_none = |need: usize| judged[need].score <= 0.0 && !at_hand_in.contains(&need);
        let unmet = needs.find(|&need| earned_none(need));
        judged.push(match (can_be_judged, unmet) {
            (false, _) => JudgedCheck::not_judged(None),
            (true, Some(need)) => JudgedCheck::not_judged(Some(need)),
            (true, None) => JudgedCheck::of(find(check)),
        });
    }
    judged
}

/// Whether every check earned all its points.
pub(super) fn all_full(judged: &[JudgedCheck]) -> bool {
    let is_full = |check: &JudgedCheck| matches!(check.outcome, Outcome::Full | Outcome::AtHandIn);
    judged.iter().all(is_full)
}
