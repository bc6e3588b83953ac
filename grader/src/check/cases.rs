//! Cases of a function task as checks score them: the mean of the cases' scores, or of their errors, with the cases that lose.

use super::finding::Finding;
use crate::attempt::answers::{Answered, CaseFacts};
use crate::record::grade::Evidence;
use crate::task::model::{Band, FunctionTask};

/// What is wrong with an answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrongAnswer {
    /// What it is a mistake in, such as a column of a matrix: evidence shows different ones first.
    pub(super) kind: String,
    /// How far off the answer is.
    pub(super) off: f64,
    /// It in words.
    pub(super) message: String,
}

impl WrongAnswer {
    /// A mistake in the whole answer to a case. An answer that is none is another one than a wrong one, and so is a wrong one for
    /// another robot.
    pub(super) fn whole(facts: &CaseFacts<'_>, off: f64, message: String) -> Self {
        let kind = match &facts.answer {
            Answered::Invalid(_) => "invalid",
            Answered::Stopped => "stopped",
            Answered::Branches(branches) if branches.is_empty() => "empty",
            _ if facts.case.dimensions.is_empty() && facts.case.row.is_none() => "wrong",
            _ => "wrong for another robot",
        };
        Self {
            kind: kind.to_owned(),
            off,
            message,
        }
    }
}

/// A case as one kind of check scores it.
pub(super) struct CaseScore {
    /// In `[0, 1]`.
    pub(super) score: f64,
    /// What is wrong with the answer, where the case loses points.
    pub(super) lost: Vec<WrongAnswer>,
}

impl CaseScore {
    /// The score of a case that loses its points by one mistake, if any: `message` says which.
    pub(super) fn of(
        facts: &CaseFacts<'_>,
        value: f64,
        band: Band,
        message: impl FnOnce() -> String,
    ) -> Self {
        let score = band.score(value);
        let lost = (score < 1.0).then(|| WrongAnswer::whole(facts, value, message()));
        Self {
            score,
            lost: lost.into_iter().collect(),
        }
    }
}

/// The scores or errors of cases, for their mean. What is shown is the mean of the visible ones: the last digits of a mean over all cases
/// would carry out a number of a hidden one.
#[derive(Default)]
struct Scores {
    /// Of every case.
    all: Vec<f64>,
    /// Of the visible ones.
    visible: Vec<f64>,
}

impl Scores {
    fn add(&mut self, facts: &CaseFacts<'_>, score: f64) {
        self.all.push(score);
        if facts.is_visible() {
            self.visible.push(score);
        }
    }

    /// The mean over all cases, which decides the points.
    fn mean(&self) -> Option<f64> {
        mean(&self.all)
    }

    /// The mean over the visible cases, if there are others: infinite or not a number where there is nothing to show.
    fn of_visible(&self) -> Option<f64> {
        let has_hidden = self.visible.len() < self.all.len();
        has_hidden.then(|| mean(&self.visible).unwrap_or(f64::NAN))
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The pieces of evidence that a person reads before the hidden classes.
const SHOWN: usize = 3;

/// The answers to all cases of a task, and the band of a check over them.
pub(crate) struct Cases<'a> {
    /// The task.
    pub(super) task: &'a FunctionTask,
    /// One entry per case, hidden ones too.
    pub(super) cases: &'a [CaseFacts<'a>],
    /// The band of a single case.
    pub(super) band: Band,
    /// Unit of that band; empty for a ratio.
    pub(super) unit: &'static str,
}

impl Cases<'_> {
    /// The mean of the scores of those cases that `score` looks at; nothing where it looks at none.
    pub(super) fn mean_score(
        &self,
        quantity: impl Into<String>,
        score: impl Fn(&CaseFacts<'_>) -> Option<CaseScore>,
    ) -> Finding {
        let mut judged = Vec::new();
        let mut failed = Vec::new();
        let mut scores = Scores::default();
        for facts in self.cases {
            let Some(CaseScore { score, lost }) = score(facts) else {
                continue;
            };
            judged.push(facts);
            scores.add(facts, score);
            if !lost.is_empty() {
                failed.push((facts, lost));
            }
        }
        Finding::share(scores.mean().unwrap_or_default(), quantity)
            .shown_as(scores.of_visible())
            .because(self.evidence(failed, &judged))
    }

    /// The mean of all errors, held against the band; `mistakes` says what is wrong with an answer that is too far off.
    pub(super) fn mean_error(
        &self,
        quantity: &str,
        error: impl Fn(&CaseFacts<'_>) -> f64,
        mistakes: impl Fn(&CaseFacts<'_>, f64) -> Vec<WrongAnswer>,
    ) -> Finding {
        let cases = self.cases;
        let mut errors = Scores::default();
        cases
            .iter()
            .for_each(|facts| errors.add(facts, error(facts)));
        let mean = errors.mean().unwrap_or(f64::NAN);
        let finding =
            Finding::against(self.band, mean, self.unit, quantity).shown_as(errors.of_visible());
        let mut failed = Vec::new();
        for facts in cases.iter().filter(|_| finding.is_lost()) {
            let error = error(facts);
            // written so that NaN is among the failed
            let good = error <= self.band.full;
            if !good {
                failed.push((facts, mistakes(facts, error)));
            }
        }
        let all: Vec<&CaseFacts<'_>> = cases.iter().collect();
        finding.because(self.evidence(failed, &all))
    }

    /// At most three visible mistakes, then hidden classes without their numbers: what a student can act on.
    fn evidence(
        &self,
        failed: Vec<(&CaseFacts<'_>, Vec<WrongAnswer>)>,
        totals: &[&CaseFacts<'_>],
    ) -> Vec<Evidence> {
        let shown = different_first(&failed);
        let mut evidence: Vec<Evidence> = shown
            .into_iter()
            .map(|(facts, mistake)| {
                let value = mistake.off.is_finite().then_some(mistake.off);
                self.of_case(facts.label(), mistake.message.clone(), value)
            })
            .collect();
        let hidden = failed.iter().filter(|(facts, _)| !facts.is_visible());
        let mut classes: Vec<&str> = hidden.map(|(facts, _)| facts.label()).collect();
        classes.sort_unstable();
        classes.dedup();
        for class in classes {
            let of_class = |facts: &CaseFacts<'_>| !facts.is_visible() && facts.label() == class;
            let lost = failed.iter().filter(|(facts, _)| of_class(facts)).count();
            let total = totals.iter().filter(|facts| of_class(facts)).count();
            let message =
                format!("{lost} of {total} hidden cases of the class \"{class}\" are off");
            evidence.push(self.of_case(class, message, None));
        }
        evidence
    }

    /// Evidence of a case, or of a class of hidden ones.
    fn of_case(&self, case: &str, message: String, value: Option<f64>) -> Evidence {
        Evidence {
            message,
            signal: self.task.name().to_owned(),
            case: Some(case.to_owned()),
            value,
            limit: Some(self.band.full),
            unit: self.unit.to_owned(),
            ..Evidence::default()
        }
    }
}

/// The mistakes to show of visible cases: the worst of each kind, the worst kinds first; then, if there are few kinds, the worst of the
/// others.
fn different_first<'f, 'a>(
    failed: &'f [(&'a CaseFacts<'a>, Vec<WrongAnswer>)],
) -> Vec<(&'a CaseFacts<'a>, &'f WrongAnswer)> {
    let visible = failed.iter().filter(|(facts, _)| facts.is_visible());
    let mut all: Vec<(&CaseFacts<'_>, &WrongAnswer)> = visible
        .flat_map(|(facts, mistakes)| mistakes.iter().map(|mistake| (*facts, mistake)))
        .collect();
    // those without a number are the worst of all
    all.sort_by(|a, b| b.1.off.total_cmp(&a.1.off));
    let mut kinds: Vec<&str> = Vec::new();
    let (mut shown, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|(_, mistake)| {
        let is_new = !kinds.contains(&mistake.kind.as_str());
        if is_new {
            kinds.push(&mistake.kind);
        }
        is_new
    });
    shown.extend(others);
    shown.truncate(SHOWN);
    shown
}

/// What is wrong with a case that has no answer of the right shape.
pub(super) fn without_answer(facts: &CaseFacts<'_>) -> Option<String> {
    match &facts.answer {
        Answered::Invalid(what) => Some(format!("{}: {what}", facts.label())),
        Answered::Stopped => Some(format!("{}: no answer", facts.label())),
        Answered::Position(_)
        | Answered::Pose(_)
        | Answered::Branches(_)
        | Answered::Matrix(_)
        | Answered::Entries(_) => None,
    }
}

/// What is wrong with a case that has no answer that could be compared.
pub(super) fn no_answer(facts: &CaseFacts<'_>) -> String {
    without_answer(facts).unwrap_or_else(|| format!("{}: no answer", facts.label()))
}

/// Two numbers, or lists of them, with as few digits as make them differ, four at least; `write` has the number of digits.
pub(super) fn distinct_texts(write: impl Fn(usize) -> (String, String)) -> (String, String) {
    let mut texts = (4..=12).map(&write);
    texts.find(|(a, b)| a != b).unwrap_or_else(|| write(12))
}

#[cfg(test)]
mod tests {
    use super::distinct_texts;
    use crate::check::function_cases::written;
    use kinemark_sim::text::number::trimmed;

    #[test]
    fn near_numbers_are_written_so_that_they_differ() {
        let of = |a: f64, b: f64| distinct_texts(|digits| (trimmed(a, digits), trimmed(b, digits)));
        assert_eq!(of(0.2, -0.8), ("0.2".to_owned(), "-0.8".to_owned()));
        assert_eq!(
            of(0.250001, 0.25),
            ("0.250001".to_owned(), "0.25".to_owned())
        );
        let of = |a: f64, b: f64| distinct_texts(|n| (written(&[a], n), written(&[b], n)));
        assert_eq!(of(24.5, 12.0), ("24.5".to_owned(), "12".to_owned()));
        assert_eq!(
            of(2.2000001, 2.2),
            ("2.2000001".to_owned(), "2.2".to_owned())
        );
        assert_eq!(written(&[1.0, 2.5], 4), "[1, 2.5]");
    }
}
