//! Doubts, and changes of the solution that nothing notices, that the course staff accept, with a reason: `accepted.toml` in their part of
//! the lab.

use kinemark_sim::text::schema::schema_of;
use kinemark_sim::text::{FileFormat, Spanned};
use schemars::{JsonSchema, Schema};
use serde::Deserialize;

use super::{Doubt, RULES};
use crate::audit::mutate::covers;
use crate::lab::Lab;
use crate::lab::load::tables;
use crate::lab::staff::own;
use crate::task::files::Files;
use crate::task::problem::{LoadError, near, problems};
use crate::task::reporter::Reporter;

problems! {
    /// What is wrong with an entry.
    enum AcceptedProblem {
        UnknownRule { rule: String, known: Vec<String> }:
            "staff::accepted", "no rule is called `{rule}`", "not a rule", near(rule, "rules", known);
        NoReason { of: String }:
            "staff::accepted", "no reason is given for `{of}`", "no words",
            "say why it is right here: whoever has the lab next year wants to know";
    }
}

/// The rule of entries that accept a change of the solution which is a mistake, and which nothing notices.
pub(in crate::audit) const MUTATION: &str = "mutation";
/// The rule of entries that accept a change of the solution after which it is as right as before.
pub(in crate::audit) const CHOICE: &str = "choice";

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FileTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The doubts that are accepted.
    #[serde(default)]
    accepted: Vec<EntryTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct EntryTable {
    /// The rule that doubts, as `lab check` names it.
    rule: Spanned<String>,
    /// What it doubts, as `lab check` names it.
    of: String,
    /// Why it is right here.
    because: Spanned<String>,
}

/// A doubt or a change of the solution that is accepted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::audit) struct Entry {
    /// The rule.
    pub rule: String,
    /// What it is about.
    pub of: String,
    /// Why it is right here.
    pub because: String,
}

impl Entry {
    /// Whether it is about a change of the solution.
    pub(super) fn is_of_mutation(&self) -> bool {
        self.rule == MUTATION || self.rule == CHOICE
    }
}

/// The doubts that are accepted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Accepted(Vec<Entry>);

impl Accepted {
    /// The JSON schema of `accepted.toml`.
    pub fn schema() -> Schema {
        schema_of::<FileTable>("Doubts about a lab of Kinemark that its course staff accept")
    }

    /// Loads `accepted.toml` of `lab`; empty where there is none.
    ///
    /// # Errors
    /// [`LoadError`] for a file that cannot be read, an unknown rule, and an entry without a reason.
    pub fn load(files: &dyn Files, lab: &Lab) -> Result<Self, LoadError> {
        let path = format!("{}/accepted.toml", lab.name);
        let Some(source) = own(files, &path)? else {
            return Ok(Self::default());
        };
        let table: FileTable = tables(&source)?;
        let report = Reporter { source: &source };
        for entry in &table.accepted {
            let rule = entry.rule.get_ref().clone();
            let known = RULES
                .iter()
                .map(|(known, ..)| *known)
                .chain([MUTATION, CHOICE]);
            if !known.clone().any(|known| known == rule) {
                let known = known.map(str::to_owned).collect();
                let problem = AcceptedProblem::UnknownRule { rule, known };
                report.refuse_at::<(), _>(&entry.rule, problem)?;
            }
            if entry.because.get_ref().trim().is_empty() {
                let of = entry.of.clone();
                report.refuse_at::<(), _>(&entry.because, AcceptedProblem::NoReason { of })?;
            }
        }
        let entries = table.accepted.into_iter().map(|entry| Entry {
            rule: entry.rule.into_inner(),
            of: entry.of,
            because: entry.because.into_inner(),
        });
        Ok(Self(entries.collect()))
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.0.iter()
    }

    /// The changes of the solution that may survive, as [`crate::audit::mutate::Mutation::of`] names them.
    pub(in crate::audit) fn mutations(&self) -> impl Iterator<Item = &str> {
        let entries = self.0.iter().filter(|entry| entry.is_of_mutation());
        entries.map(|entry| entry.of.as_str())
    }

    /// The entry that says why the change called `of` may survive, if one does: one of this change, else one of its line.
    pub(in crate::audit) fn mutation(&self, of: &str) -> Option<&Entry> {
        let entries = self.0.iter().filter(|entry| entry.is_of_mutation());
        let of_change = entries.clone().find(|entry| entry.of == of);
        of_change.or_else(|| entries.clone().find(|entry| covers(&entry.of, of)))
    }

    /// The entry that accepts `doubt`, if one does.
    pub(super) fn position(&self, doubt: &Doubt) -> Option<usize> {
        let accepts = |entry: &Entry| entry.rule == doubt.rule && entry.of == doubt.of;
        self.0.iter().position(accepts)
    }
}
