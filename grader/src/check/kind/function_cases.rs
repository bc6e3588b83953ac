//! function-cases: the relative errors of the entries that a function of the lab's own answers, each scored by the band. The check's
//! score is the mean over the cases, hidden ones too, of the mean over their entries.
//!
//! The relative error of an entry is `|a - e| / |e|`, for a list in the Euclidean norm; where `e` is zero it is `|a|`. An entry that
//! is missing, of the wrong shape or not finite scores 0.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::significant;
use kinemark_sim::text::{Problem, suggest};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::measure::as_slice;
use crate::check::cases::{CaseScore, Summary};
use crate::check::contract::{CheckKind, FunctionCheck};
use crate::check::finding::Finding;
use crate::check::reading::FunctionReading;
use crate::check::registry::FunctionTable;
use crate::record::quantity::with_unit;
use crate::task::model::{Band, Function, Given};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Relative error with which an entry earns everything.
    full: f64,
    /// Relative error with which an entry earns nothing.
    zero: f64,
    /// The one entry of `expected` that counts; all of them where it is left out.
    #[schemars(with = "Option<String>")]
    entry: Option<Spanned<String>>,
}

/// An entry that no case expects.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("no case expects an entry `{entry}`")]
struct UnknownEntry {
    entry: String,
    known: Vec<String>,
}

impl Problem for UnknownEntry {
    fn code(&self) -> &'static str {
        "lab::unknown_entry"
    }

    fn label(&self) -> String {
        "not an entry of `expected`".to_owned()
    }

    fn help(&self) -> Option<String> {
        let known = self.known.iter().map(String::as_str);
        Some(suggest(&self.entry, "entries", known))
    }
}

impl FunctionTable for Table {
    const NAME: &'static str = "function-cases";
    const TASK: &'static str = "a function task of the lab's own, with `given` and `expected`";
    type Check = FunctionCases;

    fn fits(function: &Function) -> bool {
        matches!(function, Function::Free(_))
    }

    fn read(
        &self,
        at: Range<usize>,
        reading: &FunctionReading<'_>,
    ) -> Result<FunctionCases, LabError> {
        let first = reading.function.cases.first().map(|case| &case.given);
        if let (Some(entry), Some(Given::Values { expected, .. })) = (&self.entry, first) {
            let names = expected.iter().map(|(name, _)| name.clone());
            // a single answer has no name
            let known: Vec<String> = names.filter(|name| !name.is_empty()).collect();
            if !known.contains(entry.get_ref()) {
                let problem = UnknownEntry {
                    entry: entry.get_ref().clone(),
                    known,
                };
                return reading.report.refuse(entry.span(), problem);
            }
        }
        Ok(FunctionCases {
            band: reading.report.band(self.full, self.zero, at)?,
            entry: self.entry.as_ref().map(|entry| entry.get_ref().clone()),
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct FunctionCases {
    band: Band,
    entry: Option<String>,
}

impl CheckKind for FunctionCases {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, ""))
    }
}

impl FunctionCheck for FunctionCases {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: match &self.entry {
                Some(entry) => format!("cases with {entry} right"),
                None => "answers right".to_owned(),
            },
            band: self.band,
            unit: "",
        };
        summary.mean_score(cases, |facts| Some(self.score(facts))).advise(
            "Work the first case through by hand, and compare each step with what yours computes.",
        )
    }

    fn answer_band(&self) -> Option<Band> {
        Some(self.band)
    }
}

impl FunctionCases {
    /// The mean of the scores of the entries that count.
    fn score(&self, facts: &CaseFacts<'_>) -> CaseScore {
        let (CaseError::Entries(relative), Given::Values { expected, .. }) =
            (&facts.error, &facts.case.given)
        else {
            return CaseScore {
                score: 0.0,
                lost: None,
            };
        };
        let counts = |name: &str| self.entry.as_deref().is_none_or(|entry| entry == name);
        let looked_at = || {
            let pairs = relative.iter().zip(expected).enumerate();
            pairs.filter(|(_, (_, (name, _)))| counts(name))
        };
        let scores = looked_at().map(|(_, (relative, _))| self.band.score(*relative));
        let score = scores.sum::<f64>() / looked_at().count().max(1) as f64;
        let worst = looked_at()
            .rev()
            .max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
        let lost = worst.filter(|_| score < 1.0);
        let lost = lost.map(|(index, (relative, (name, should)))| {
            let message = match &facts.answer {
                Answered::Entries(answer) => {
                    let (is, should) = told_apart(&answer[index], as_slice(should));
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
            (*relative, message)
        });
        CaseScore { score, lost }
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
