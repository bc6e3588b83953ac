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
}

impl JudgedCheck {
    fn not_judged(unmet: Option<usize>) -> Self {
        Self {
            score: 0.0,
            outcome: Outcome::NotJudged,
            finding: None,
            unmet,
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
        }
    }

    /// Its finding, if points were lost.
    pub(super) fn loss(&self) -> Option<&Finding> {
        let finding = self.finding.as_ref();
        finding.filter(|_| self.outcome != Outcome::Full)
    }
}

/// Judges an attempt by its task's checks in order. A check is not judged if it needs one that earned nothing, or if the attempt cannot
/// be judged.
pub(super) fn judge<K: ?Sized>(
    checks: &[Check<K>],
    can_be_judged: bool,
    find: impl Fn(&Check<K>) -> Finding,
) -> Vec<JudgedCheck> {
    let mut judged: Vec<JudgedCheck> = Vec::with_capacity(checks.len());
    for check in checks {
        let mut needs = check.needs.iter().copied();
        let unmet = needs.find(|&need| judged[need].score <= 0.0);
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
    judged.iter().all(|check| check.outcome == Outcome::Full)
}
