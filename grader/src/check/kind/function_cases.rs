//! function-cases: the relative errors of the entries that a function answers, each scored by the band: a function of the lab's own, or
//! a quantity of the robot such as `torque`. The check's score is the mean over the cases, hidden ones too, of the mean over their
//! entries.
//!
//! The relative error of an entry is `|a - e| / |e|`, for a list or a matrix in the Euclidean norm of all its numbers; where `e` is zero
//! it is `|a|`. With `least_size` in the task, `|e|` counts as that much where it is less. The error of an angle, one of `turns`, is
//! the turn between the two in radians, and whole turns make no difference. An entry that is missing, of the wrong shape or not finite
//! scores 0.

use kinemark_sim::text::number::significant;

use crate::check::prelude::*;
use crate::task::entry::Entry;
use crate::task::model::Given;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Relative error with which an entry earns everything.
    full: f64,
    /// Relative error with which an entry earns nothing.
    zero: f64,
    /// The one entry of `expected` that counts; all of them where it is left out.
    entry: Option<At<String>>,
}

problems! {
    /// An entry that no case expects.
    enum EntryProblem {
        Unknown { entry: String, known: Vec<String> }:
            "lab::unknown_entry", "no case expects an entry `{entry}`", "not an entry of `expected`",
            near(entry, "entries", known);
        Unnamed { function: String }:
            "lab::unknown_entry", "the answer of `{function}` has no entries with names", "no entry of it",
            "leave `entry` out: all numbers of the answer count";
    }
}

impl FunctionTable for Table {
    const NAME: &'static str = "function-cases";
    const FUNCTION: Option<&'static str> = None;
    type Check = InBand<FunctionCases>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        let first = reading.cases.first().map(|case| &case.given);
        if let (Some(typed), Some(Given::Values { expected, .. })) = (&self.entry, first) {
            let names = expected.iter().map(|(name, _)| name.clone());
            // a single answer has no name
            let known: Vec<String> = names.filter(|name| !name.is_empty()).collect();
            let entry = typed.get_ref().clone();
            if !known.contains(&entry) {
                return reading.refuse_at(typed, EntryProblem::Unknown { entry, known });
            }
        }
        let is_of_robot = !matches!(first, Some(Given::Values { .. }) | None);
        if let Some(typed) = self.entry.as_ref().filter(|_| is_of_robot) {
            let function = reading.of.name().to_owned();
            return reading.refuse_at(typed, EntryProblem::Unnamed { function });
        }
        let entry = self.entry.as_ref().map(|entry| entry.get_ref().clone());
        reading.in_band([self.full, self.zero], "", FunctionCases { entry })
    }
}

/// The relative errors of entries.
#[derive(Debug)]
pub(crate) struct FunctionCases {
    /// The one that counts; all of them where there is none.
    entry: Option<String>,
}

impl AnswerMeasure for FunctionCases {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let quantity = match &self.entry {
            Some(entry) => format!("mean score of {entry}"),
            None => "mean score of the answers".to_owned(),
        };
        let score = |facts: &CaseFacts<'_>| Some(self.score(facts, cases.band));
        cases.mean_score(quantity, score).advise(
            "Work the first case through by hand, and compare each step with what yours computes.",
        )
    }
}

impl FunctionCases {
    /// The mean of the scores of the entries that count.
    fn score(&self, facts: &CaseFacts<'_>, band: Band) -> CaseScore {
        let expected = facts.expected();
        let CaseError::Entries(relative) = &facts.error else {
            return CaseScore {
                score: 0.0,
                lost: Vec::new(),
            };
        };
        let counts = |name: &str| self.entry.as_deref().is_none_or(|entry| entry == name);
        let counted: Vec<usize> = (0..relative.len().min(expected.len()))
            .filter(|index| counts(&expected[*index].0))
            .collect();
        let scores = counted.iter().map(|index| band.score(relative[*index]));
        let score = scores.sum::<f64>() / counted.len().max(1) as f64;
        let wrong = counted
            .iter()
            .copied()
            .filter(|index| band.score(relative[*index]) < 1.0);
        let mistake = |index: usize| {
            let (name, should) = &expected[index];
            let relative = relative[index];
            let message = match &facts.answer {
                Answered::Entries(answer) => {
                    let (is, should) = distinct_texts(|digits| {
                        let is = should.with(&answer[index]);
                        (entry_in_words(&is, digits), entry_in_words(should, digits))
                    });
                    let what = match name.as_str() {
                        "" => "the answer",
                        name => name,
                    };
                    // of 0 there is no part
                    let numbers = expected[index].1.numbers();
                    let off = match numbers.iter().all(|value| *value == 0.0) {
                        true => trimmed(relative, 4),
                        false => with_unit(relative, ""),
                    };
                    let case = facts.label();
                    format!("{case}: {what} is {is}, should be {should} ({off} off)")
                }
                // one sentence for all entries
                _ => return WrongAnswer::whole(facts, relative, no_answer(facts)),
            };
            WrongAnswer {
                kind: name.clone(),
                off: relative,
                message,
            }
        };
        let mut lost: Vec<WrongAnswer> = wrong.map(mistake).collect();
        lost.dedup_by(|a, b| a.message == b.message);
        CaseScore { score, lost }
    }
}

/// An entry as people read it.
pub(crate) fn entry_in_words(entry: &Entry, digits: usize) -> String {
    match entry {
        Entry::Number(number) => significant(*number, digits),
        Entry::List(numbers) => written(numbers, digits),
        Entry::Matrix(rows) => {
            let rows: Vec<String> = rows.iter().map(|row| written(row, digits)).collect();
            format!("[{}]", rows.join(", "))
        }
    }
}

/// Numbers as people read them, a single one without brackets.
pub(crate) fn written(numbers: &[f64], digits: usize) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| significant(*x, digits)).collect();
    match texts.as_slice() {
        [one] => one.clone(),
        texts => format!("[{}]", texts.join(", ")),
    }
}
