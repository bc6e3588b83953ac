//! Judging an attempt: every check of its task in order, whether the attempt is a visible run, a hidden one or the answers to cases.

use crate::check::Finding;
use crate::lab::model::Check;
use crate::record::grade::Outcome;

/// What a check came to in one attempt.
#[derive(Debug)]
pub(super) struct Judged {
    /// The share of its points, in `[0, 1]`; 0 where it was not judged.
    pub(super) score: f64,
    /// How much that is.
    pub(super) outcome: Outcome,
    /// What it found; none where it was not judged.
    pub(super) finding: Option<Finding>,
    /// The check it needs that earned nothing, by index, where that is why it was not judged.
    pub(super) unmet: Option<usize>,
}

impl Judged {
    fn not_judged(unmet: Option<usize>) -> Self {
        Self {
            score: 0.0,
            outcome: Outcome::NotJudged,
            finding: None,
            unmet,
        }
    }

    fn of(finding: Finding) -> Self {
        // a trace of a point would be shown as none
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

    /// What it found where points were lost.
    pub(super) fn loss(&self) -> Option<&Finding> {
        let finding = self.finding.as_ref();
        finding.filter(|_| self.outcome != Outcome::Full)
    }
}

/// Judges an attempt by its task's checks in order. A check that needs one which earned nothing is not judged, nor is any where the
/// attempt cannot be judged.
pub(super) fn judge(
    checks: &[Check],
    can_be_judged: bool,
    find: impl Fn(&Check) -> Finding,
) -> Vec<Judged> {
    let mut judged: Vec<Judged> = Vec::with_capacity(checks.len());
    for check in checks {
        let mut needs = check.needs.iter().copied();
        let unmet = needs.find(|&need| judged[need].score <= 0.0);
        judged.push(match (can_be_judged, unmet) {
            (false, _) => Judged::not_judged(None),
            (true, Some(need)) => Judged::not_judged(Some(need)),
            (true, None) => Judged::of(find(check)),
        });
    }
    judged
}

/// Whether every check earned all its points.
pub(super) fn all_full(judged: &[Judged]) -> bool {
    judged.iter().all(|check| check.outcome == Outcome::Full)
}
