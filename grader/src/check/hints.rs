//! The hints of a check as a lab file lists them: a question, then one step after another, the last of which is the remedy.

use std::ops::Range;

use kinemark_sim::text::Spanned;
use serde::de::IgnoredAny;

use crate::task::problem::{LabError, problems};
use crate::task::reporter::Reporter;

/// More steps than anybody unfolds: a hint that needs them should be in the brief.
const MOST_HINTS: usize = 6;

/// The key that checks had before they had `hints`.
pub(super) const EARLIER_KEY: &str = "hint";

/// The hints of a check, as typed.
#[derive(Debug, Default)]
pub(super) struct HintsTable {
    pub(super) hints: Option<Spanned<Vec<Spanned<String>>>>,
    /// The value of [`EARLIER_KEY`], which is refused.
    pub(super) earlier: Option<Spanned<IgnoredAny>>,
}

problems! {
    /// What is wrong with the hints of a check.
    enum HintsProblem {
        EarlierKey:
            "lab::hints", "`hint` is now `hints`, a list", "what `hint` had",
            "write `hints = [\"a question?\", \"what to do\"]`: a grade shows the question, `kinemark hint` the rest step by step";
        Count { check: String, count: usize }:
            "lab::hints", "check `{check}` must have 1 to {MOST_HINTS} hints, got {count}", "these hints",
            if *count == 0 { "leave `hints` out to have none" } else { "join some of them, or move some to the brief" };
        Empty { check: String, number: usize }:
            "lab::hints", "hint {number} of check `{check}` is empty", "this hint", "write it, or leave it out";
        NoQuestion { check: String }:
            "lab::hints", "the first hint of check `{check}` must end with `?`", "not a question",
            "ask what leads to the mistake: a grade shows this hint alone, and the next ones say what to do";
    }
}

impl HintsTable {
    /// The hints of the check `check`, question first; none where the lab gives none.
    pub(super) fn read(&self, report: Reporter<'_>, check: &str) -> Result<Vec<String>, LabError> {
        if let Some(earlier) = &self.earlier {
            return report.refuse_at(earlier, HintsProblem::EarlierKey);
        }
        let Some(table) = &self.hints else {
            return Ok(Vec::new());
        };
        let check = check.to_owned();
        let hints = table.get_ref();
        let count = hints.len();
        if !(1..=MOST_HINTS).contains(&count) {
            return report.refuse_at(table, HintsProblem::Count { check, count });
        }
        let is_empty = |hint: &Spanned<String>| hint.get_ref().trim().is_empty();
        if let Some(at) = hints.iter().position(is_empty) {
            let number = at + 1;
            return report.refuse_at(&hints[at], HintsProblem::Empty { check, number });
        }
        if !hints[0].get_ref().ends_with('?') {
            return report.refuse_at(&hints[0], HintsProblem::NoQuestion { check });
        }
        Ok(hints.iter().map(|hint| hint.get_ref().clone()).collect())
    }

    /// The bytes of the list behind the question; none where there is nothing behind it.
    pub(super) fn behind_question(&self) -> Option<Range<usize>> {
        let table = self.hints.as_ref()?;
        match &table.get_ref()[..] {
            // the list ends with its bracket, which stays
            [question, _, ..] => Some(question.span().end..table.span().end - 1),
            _ => None,
        }
    }
}
