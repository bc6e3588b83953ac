//! Cases of a function task as checks score them: the mean of the cases' scores, or of their errors, with the cases that lose.

use super::finding::Finding;
use crate::attempt::answers::{Answered, CaseFacts};
use crate::record::grade::Evidence;
use crate::task::model::{Band, Function};

/// A case as one kind of check scores it.
pub(super) struct CaseScore {
    /// In `[0, 1]`.
    pub(super) score: f64,
    /// How far off the answer is, and that in words, where the case loses points.
    pub(super) lost: Option<(f64, String)>,
}

impl CaseScore {
    /// A value held against a band; `message` says what is wrong where points are lost.
    pub(super) fn of(value: f64, band: Band, message: impl FnOnce() -> String) -> Self {
        let score = band.score(value);
        Self {
            score,
            lost: (score < 1.0).then(|| (value, message())),
        }
    }
}

/// How answers are summed up.
pub(super) struct Summary<'a> {
    /// The function of the task.
    pub(super) function: &'a Function,
    /// What is measured, for a person.
    pub(super) quantity: String,
    /// The band of a single case.
    pub(super) band: Band,
    /// Unit of that band; empty for a ratio.
    pub(super) unit: &'static str,
}

impl Summary<'_> {
    /// The mean of the scores of those cases that `score` looks at; nothing where it looks at none.
    pub(super) fn mean_score(
        self,
        cases: &[CaseFacts<'_>],
        score: impl Fn(&CaseFacts<'_>) -> Option<CaseScore>,
    ) -> Finding {
        let mut judged = Vec::new();
        let mut failed = Vec::new();
        let mut sum = 0.0;
        for facts in cases {
            let Some(CaseScore { score, lost }) = score(facts) else {
                continue;
            };
            judged.push(facts);
            sum += score;
            failed.extend(lost.map(|(value, message)| (facts, value, message)));
        }
        let mean = if judged.is_empty() {
            0.0
        } else {
            sum / judged.len() as f64
        };
        let evidence = evidence(self.function, failed, &judged, self.band.full, self.unit);
        Finding::share(mean, self.quantity).because(evidence)
    }

    /// The mean of all errors, held against the band; `message` says what is wrong with an answer that is too far off.
    pub(super) fn mean_error(
        self,
        cases: &[CaseFacts<'_>],
        error: impl Fn(&CaseFacts<'_>) -> f64,
        message: impl Fn(&CaseFacts<'_>, f64) -> String,
    ) -> Finding {
        let mean = cases.iter().map(&error).sum::<f64>() / cases.len() as f64;
        let finding = Finding::against(self.band, mean, self.unit, self.quantity);
        let mut failed = Vec::new();
        for facts in cases.iter().filter(|_| finding.is_lost()) {
            let error = error(facts);
            // written so that NaN is among the failed
            let good = error <= self.band.full;
            if !good {
                failed.push((facts, error, message(facts, error)));
            }
        }
        let all: Vec<&CaseFacts<'_>> = cases.iter().collect();
        let evidence = evidence(self.function, failed, &all, self.band.full, self.unit);
        finding.because(evidence)
    }
}

/// What is wrong with a case that has no answer of the right shape.
pub(super) fn without_answer(facts: &CaseFacts<'_>) -> Option<String> {
    match &facts.answer {
        Answered::Invalid(what) => Some(format!("{}: {what}", facts.told())),
        Answered::Stopped => Some(format!("{}: no answer", facts.told())),
        Answered::Position(_)
        | Answered::Branches(_)
        | Answered::Matrix(_)
        | Answered::Entries(_) => None,
    }
}

/// Evidence of a case, or of a class of hidden ones.
fn of_case(
    function: &Function,
    case: &str,
    message: String,
    value: Option<f64>,
    limit: f64,
    unit: &str,
) -> Evidence {
    Evidence {
        message,
        signal: function.name().to_owned(),
        tick: None,
        time_s: None,
        run: None,
        case: Some(case.to_owned()),
        value,
        limit: Some(limit),
        unit: unit.to_owned(),
    }
}

/// At most three visible cases, then hidden classes without their numbers: what a student can act on.
fn evidence(
    function: &Function,
    mut failed: Vec<(&CaseFacts<'_>, f64, String)>,
    totals: &[&CaseFacts<'_>],
    limit: f64,
    unit: &str,
) -> Vec<Evidence> {
    // worst first; cases without a number are the worst of all
    failed.sort_by(|a, b| b.1.total_cmp(&a.1));
    let visible = failed.iter().filter(|(facts, ..)| facts.is_visible());
    let mut evidence: Vec<Evidence> = visible
        .take(3)
        .map(|(facts, value, message)| {
            let value = value.is_finite().then_some(*value);
            of_case(function, facts.told(), message.clone(), value, limit, unit)
        })
        .collect();
    let mut classes: Vec<&str> = Vec::new();
    for (facts, ..) in failed.iter().filter(|(facts, ..)| !facts.is_visible()) {
        if !classes.contains(&facts.told()) {
            classes.push(facts.told());
        }
    }
    classes.sort_unstable();
    for class in classes {
        let of_class = |facts: &CaseFacts<'_>| !facts.is_visible() && facts.told() == class;
        let lost = failed.iter().filter(|(facts, ..)| of_class(facts)).count();
        let total = totals.iter().filter(|facts| of_class(facts)).count();
        let message = format!("{lost} of {total} hidden cases of the class \"{class}\" are off");
        evidence.push(of_case(function, class, message, None, limit, unit));
    }
    evidence
}
