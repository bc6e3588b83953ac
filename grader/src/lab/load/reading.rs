//! Reading a lab's texts: a file as a source, its TOML as tables with finite numbers, and problems at their place in it.

use std::ops::Range;

use kinemark_sim::text::{FormatProblem, Source, format_of, suggest};
use serde::de::DeserializeOwned;
use toml::Spanned;

use crate::lab::parameters::refused;
use crate::task::problem::{LabError, problems};
use crate::task::reporter::Reporter;

problems! {
    /// What is wrong with a text of a lab before its tables are looked at.
    enum TextProblem {
        NotFinite:
            "lab::not_finite", "a lab's numbers are finite", "not a finite number", "leave a limit out to have none";
        Json { refusal: String, help: String }:
            "lab::practice", "{refusal}", "here", help;
        Format { problem: FormatProblem }:
            "lab::unknown_format", "{problem}", problem.label(), problem.help();
    }
}

/// Reads TOML into its tables.
pub(crate) fn tables<T: DeserializeOwned>(source: &Source) -> Result<T, LabError> {
    refuse_unreadable(source)?;
    toml::from_str(source.text()).map_err(|error| refused(source, &error))
}

/// Refuses a text in another format, and `nan` and `inf`, which no number of a lab may be.
pub(in crate::lab) fn refuse_unreadable(source: &Source) -> Result<(), LabError> {
    let report = Reporter { source };
    if let Err((problem, at)) = format_of(source) {
        return report.refuse(at, TextProblem::Format { problem });
    }
    match not_finite(source.text()) {
        None => Ok(()),
        Some(at) => report.refuse(at, TextProblem::NotFinite),
    }
}

/// Where the first `nan` or `inf` of a TOML text stands; a text that is no TOML has none, and its reader says why.
fn not_finite(text: &str) -> Option<Range<usize>> {
    use toml::de::{DeTable, DeValue};
    fn within(value: &Spanned<DeValue<'_>>) -> Option<Range<usize>> {
        match value.get_ref() {
            DeValue::Float(number) => {
                let word = number.as_str().trim_start_matches(['+', '-']);
                let parsed = word.replace('_', "").parse::<f64>();
                (!parsed.is_ok_and(f64::is_finite)).then(|| value.span())
            }
            DeValue::Array(items) => items.iter().find_map(within),
            DeValue::Table(table) => table.values().find_map(within),
            _ => None,
        }
    }
    DeTable::parse(text)
        .ok()?
        .get_ref()
        .values()
        .find_map(within)
}

impl Reporter<'_> {
    /// What the JSON reader refused, at its place.
    pub(in crate::lab) fn json<T>(&self, error: &serde_json::Error) -> Result<T, LabError> {
        let refusal = error.to_string();
        let message = refusal.split(" at line ").next().unwrap_or(&refusal);
        let text = self.source.text();
        let lines = text.split_inclusive('\n');
        let before = lines
            .take(error.line().saturating_sub(1))
            .map(str::len)
            .sum::<usize>();
        // the reader counts bytes, and has read the one that it refuses
        let at = (before + error.column().saturating_sub(1)).min(text.len());
        let mut quoted = message.split('`').skip(1).step_by(2);
        let help = if message.starts_with("unknown field") {
            let name = quoted.next().unwrap_or_default();
            suggest(name, "keys", quoted)
        } else {
            "`kinemark lab fill LAB` writes this file anew".to_owned()
        };
        let refusal = match message.starts_with("EOF while") {
            true => "the file ends in the middle".to_owned(),
            false => message.replace("unknown field", "unknown key"),
        };
        let at = at..(at + 1).min(text.len());
        self.refuse(at, TextProblem::Json { refusal, help })
    }
}
