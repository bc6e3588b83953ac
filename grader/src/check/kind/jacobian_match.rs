//! jacobian-match: the mean relative distance of the answered Jacobians from the true ones, `‖J - J_true‖ / ‖J_true‖` in the
//! Frobenius norm. One answer that is no matrix of the right shape makes it infinite.
//!
//! Where the true Jacobian is zero, the norm of the answer itself counts. Entries are compared as they are, metres and radians
//! alike.

use crate::check::prelude::*;
use crate::task::jacobian;

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
    const FUNCTION: Option<&'static str> = Some("jacobian");
    type Check = InBand<JacobianMatch>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full, self.zero], "", JacobianMatch)
    }
}

/// The mean relative distance from the true Jacobians.
#[derive(Debug)]
pub(crate) struct JacobianMatch;

impl AnswerMeasure for JacobianMatch {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let relative = |facts: &CaseFacts<'_>| match &facts.error {
            CaseError::Jacobian { relative, .. } => *relative,
            _ => f64::INFINITY,
        };
        let message = |facts: &CaseFacts<'_>, relative: f64| match (&facts.answer, &facts.error) {
            (Answered::Matrix(answer), CaseError::Jacobian { truth, .. }) => format!(
                "{}: {} off{}",
                facts.label(),
                with_unit(relative, ""),
                worst_entry(facts, cases.function, answer, truth)
            ),
            _ => no_answer(facts),
        };
        let quantity = "mean relative error of the Jacobian";
        cases.mean_error(quantity, relative, message).advise(
            "Compare each column with (p(q + h) - p(q - h)) / (2 h), one joint moved by a small h.",
        )
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
    let column = |matrix: &[Vec<f64>], joint: usize| -> Vec<Vec<f64>> {
        vec![matrix.iter().map(|row| row[joint]).collect()]
    };
    let off = |joint: usize| jacobian::distance(&column(answer, joint), &column(truth, joint));
    let Some((joint, _)) = greatest((0..facts.robot.n()).map(off)) else {
        return String::new();
    };
    let gap = |row: usize| (answer[row][joint] - truth[row][joint]).abs();
    let worst = greatest((0..truth.len()).map(gap));
    let named = worst.and_then(|(row, _)| Some((row, rows.names().nth(row)?)));
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
    let [got, should] = [answer, truth].map(|matrix| matrix[row][joint]);
    let (got, should) = distinct_texts(|digits| (trimmed(got, digits), trimmed(should, digits)));
    format!(": column {number} ({joint_name}): {entry} is {got}, should be {should}")
}
