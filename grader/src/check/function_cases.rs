//! function-cases: the relative errors of the entries a free function answers, each scored by the band. The check's score is the mean
//! over the cases, hidden ones too, of the mean over their entries.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::attempt::measure::as_slice;
use crate::lab::model::{Band, Function, Given};
use crate::record::grade::Measure;
use crate::record::quantity::{significant, with_unit};

/// Judges the check; with `entry`, by that entry alone.
pub fn judge(
    cases: &[CaseFacts<'_>],
    band: Band,
    entry: Option<&str>,
    function: &Function,
) -> Finding {
    let mut sum = 0.0;
    let mut failed = Vec::new();
    for facts in cases {
        let (CaseError::Entries(relative), Given::Values { expected, .. }) =
            (&facts.error, &facts.case.given)
        else {
            continue;
        };
        let looked_at = || {
            let pairs = relative.iter().zip(expected).enumerate();
            pairs.filter(|(_, (_, (name, _)))| entry.is_none_or(|entry| entry == name))
        };
        let scores = looked_at().map(|(_, (relative, _))| band.score(*relative));
        let score = scores.sum::<f64>() / looked_at().count().max(1) as f64;
        sum += score;
        // written so that NaN is among the failed
        if score < 1.0 {
            let worst = looked_at()
                .rev()
                .max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
            let Some((index, (relative, (name, should)))) = worst else {
                continue;
            };
            let message = match &facts.answer {
                Answered::Entries(answer) => {
                    let should = as_slice(should);
                    let (is, should) = told_apart(&answer[index], should);
                    let what = match name.as_str() {
                        "" => "the answer",
                        name => name,
                    };
                    format!(
                        "{}: {what} is {is}, should be {should} ({} off)",
                        facts.told(),
                        with_unit(*relative, "")
                    )
                }
                Answered::Invalid(what) => format!("{}: {what}", facts.told()),
                _ => format!("{}: no answer", facts.told()),
            };
            failed.push((facts, *relative, message));
        }
    }
    let score = if cases.is_empty() {
        0.0
    } else {
        sum / cases.len() as f64
    };
    let all: Vec<&CaseFacts<'_>> = cases.iter().collect();
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: match entry {
                Some(entry) => format!("cases with {entry} right"),
                None => "answers right".to_owned(),
            },
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence: summarise(function, failed, &all, band.full, ""),
        next_step:
            "Work the first case through by hand, and compare each step with what yours computes."
                .to_owned(),
        curve: None,
    }
}

/// The numbers of an entry as people read them, a single one without brackets.
pub fn written(numbers: &[f64], digits: usize) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| significant(*x, digits)).collect();
    match texts.as_slice() {
        [one] => one.clone(),
        texts => format!("[{}]", texts.join(", ")),
    }
}

/// Two entries with as few digits as tell them apart, four at least.
fn told_apart(a: &[f64], b: &[f64]) -> (String, String) {
    let both = |digits| (written(a, digits), written(b, digits));
    (4..=12)
        .map(both)
        .find(|(a, b)| a != b)
        .unwrap_or_else(|| both(12))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_numbers_are_written_so_that_they_differ() {
        assert_eq!(
            told_apart(&[24.5], &[12.0]),
            ("24.5".to_owned(), "12".to_owned())
        );
        let (a, b) = told_apart(&[2.2000001], &[2.2]);
        assert_eq!((a.as_str(), b.as_str()), ("2.2000001", "2.2"));
        assert_eq!(written(&[1.0, 2.5], 4), "[1, 2.5]");
    }
}
