//! jacobian-match: the mean relative distance of the answered Jacobians from the true ones, `‖J - J_true‖ / ‖J_true‖` in the
//! Frobenius norm. One answer that is no matrix of the right shape makes it infinite.
//!
//! Where the true Jacobian is zero, the norm of the answer itself counts. Entries are compared as they are, metres and radians
//! alike.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::trimmed;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::check::cases::Summary;
use crate::check::contract::{CheckKind, FunctionCheck};
use crate::check::finding::Finding;
use crate::check::reading::FunctionReading;
use crate::check::registry::FunctionTable;
use crate::record::quantity::with_unit;
use crate::task::jacobian;
use crate::task::model::{Band, Function};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Mean relative distance that earns all points.
    full: f64,
    /// Mean relative distance that earns none.
    zero: f64,
}

impl FunctionTable for Table {
    const NAME: &'static str = "jacobian-match";
    const TASK: &'static str = "a function task of `jacobian`";
    type Check = JacobianMatch;

    fn fits(function: &Function) -> bool {
        matches!(function, Function::Jacobian(_))
    }

    fn read(
        &self,
        at: Range<usize>,
        reading: &FunctionReading<'_>,
    ) -> Result<JacobianMatch, LabError> {
        let band = reading.report.band(self.full, self.zero, at)?;
        Ok(JacobianMatch { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct JacobianMatch {
    band: Band,
}

impl CheckKind for JacobianMatch {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, ""))
    }
}

impl FunctionCheck for JacobianMatch {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: "mean relative error of the Jacobian".to_owned(),
            band: self.band,
            unit: "",
        };
        let relative = |facts: &CaseFacts<'_>| match &facts.error {
            CaseError::Jacobian { relative, .. } => *relative,
            _ => f64::INFINITY,
        };
        let message = |facts: &CaseFacts<'_>, relative: f64| match (&facts.answer, &facts.error) {
            (Answered::Invalid(what), _) => format!("{}: {what}", facts.told()),
            (Answered::Matrix(answer), CaseError::Jacobian { truth, .. }) => format!(
                "{}: {} off{}",
                facts.told(),
                with_unit(relative, ""),
                worst_entry(facts, function, answer, truth)
            ),
            _ => format!("{}: no answer", facts.told()),
        };
        summary.mean_error(cases, relative, message).advise(
            "Compare each column with (p(q + h) - p(q - h)) / (2 h), one joint moved by a small h.",
        )
    }

    fn answer_band(&self) -> Option<Band> {
        Some(self.band)
    }
}

/// The worst column, and in it the worst entry: `: column 2 (elbow): d x / d q2 is 0.2, should be -0.8`.
fn worst_entry(
    facts: &CaseFacts<'_>,
    function: &Function,
    answer: &[Vec<f64>],
    truth: &[Vec<f64>],
) -> String {
    let Function::Jacobian(rows) = function else {
        return String::new();
    };
    let rows = *rows;
    let column = |matrix: &[Vec<f64>], joint: usize| -> Vec<Vec<f64>> {
        vec![matrix.iter().map(|row| row[joint]).collect()]
    };
    let off = |joint: &usize| jacobian::distance(&column(answer, *joint), &column(truth, *joint));
    // of equals the first
    let worst = (0..facts.robot.n())
        .rev()
        .max_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(joint) = worst else {
        return String::new();
    };
    let gap = |row: &usize| (answer[*row][joint] - truth[*row][joint]).abs();
    let worst = (0..truth.len())
        .rev()
        .max_by(|a, b| gap(a).total_cmp(&gap(b)));
    let named = worst.and_then(|row| Some((row, rows.names().nth(row)?)));
    let Some((row, name)) = named else {
        return String::new();
    };
    let joint_name = facts.robot.moving_joints().nth(joint);
    let joint_name = joint_name.map_or("?", |joint| joint.name.as_str());
    let number = joint + 1;
    // an angle about an axis is no coordinate, so there is no `d rz`
    let entry = match name.strip_prefix('r') {
        Some(axis) => format!("the turn about {axis} per q{number}"),
        None => format!("d {name} / d q{number}"),
    };
    let (got, should) = told_apart(answer[row][joint], truth[row][joint]);
    format!(": column {number} ({joint_name}): {entry} is {got}, should be {should}")
}

/// Two numbers with as few decimals as tell them apart, four at least.
fn told_apart(a: f64, b: f64) -> (String, String) {
    let written = |decimals| (trimmed(a, decimals), trimmed(b, decimals));
    (4..=12)
        .map(written)
        .find(|(a, b)| a != b)
        .unwrap_or_else(|| written(12))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_numbers_are_written_so_that_they_differ() {
        assert_eq!(told_apart(0.2, -0.8), ("0.2".to_owned(), "-0.8".to_owned()));
        assert_eq!(
            told_apart(0.250001, 0.25),
            ("0.250001".to_owned(), "0.25".to_owned())
        );
    }
}
