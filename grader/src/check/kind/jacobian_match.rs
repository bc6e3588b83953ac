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
        let mistakes = |facts: &CaseFacts<'_>, relative: f64| match (&facts.answer, &facts.error) {
            (Answered::Matrix(answer), CaseError::Jacobian { truth, .. }) => {
                let columns =
                    wrong_columns(facts, &cases.task.function, answer, truth, cases.band.full);
                columns
                    .into_iter()
                    .map(|(joint, entry)| WrongAnswer {
                        kind: joint.to_string(),
                        off: relative,
                        message: format!(
                            "{}: {} off{entry}",
                            facts.label(),
                            with_unit(relative, "")
                        ),
                    })
                    .collect()
            }
            _ => vec![WrongAnswer::whole(facts, relative, no_answer(facts))],
        };
        let quantity = "mean relative error of the Jacobian";
        cases.mean_error(quantity, relative, mistakes).advise(
            "Compare each column with (p(q + h) - p(q - h)) / (2 h), one joint moved by a small h.",
        )
    }
}

/// A column that is off: its joint, and its worst entry in words.
type WrongColumn = (usize, String);

/// The columns that are off by more than `full`, as a fraction of the norm of `truth`; the worst one in any case.
fn wrong_columns(
    facts: &CaseFacts<'_>,
    function: &Function,
    answer: &[Vec<f64>],
    truth: &[Vec<f64>],
    full: f64,
) -> Vec<WrongColumn> {
    let Function::Jacobian(rows) = function else {
        return Vec::new();
    };
    let column = |matrix: &[Vec<f64>], joint: usize| -> Vec<Vec<f64>> {
        vec![matrix.iter().map(|row| row[joint]).collect()]
    };
    let off = |joint: usize| jacobian::distance(&column(answer, joint), &column(truth, joint));
    let all = jacobian::distance(answer, truth);
    let relative = jacobian::relative_distance(answer, truth);
    let Some((worst, _)) = greatest((0..facts.joints.count()).map(off)) else {
        return Vec::new();
    };
    let shares = (0..facts.joints.count()).map(|joint| (joint, off(joint) / all));
    let mut shares: Vec<(usize, f64)> = shares.collect();
    // all columns of a case have its error, so that their order says which one is worst
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    shares
        .into_iter()
        .filter(|(joint, share)| *joint == worst || relative * share > full)
        .map(|(joint, _)| {
            let entry = worst_entry(facts, rows, answer, truth, joint);
            (joint, entry.unwrap_or_default())
        })
        .collect()
}

/// The worst entry of a column: `: column 2 (elbow): d x / d q2 is 0.2, should be -0.8`.
fn worst_entry(
    facts: &CaseFacts<'_>,
    rows: &Rows,
    answer: &[Vec<f64>],
    truth: &[Vec<f64>],
    joint: usize,
) -> Option<String> {
    let gap = |row: usize| (answer[row][joint] - truth[row][joint]).abs();
    let (row, _) = greatest((0..truth.len()).map(gap))?;
    let name = rows.names().nth(row)?;
    let joint_name = facts.joints.joints(facts.robot).nth(joint);
    let joint_name = joint_name.map_or("?", |joint| joint.name.as_str());
    let number = joint + 1;
    // an angle about an axis is no coordinate, so there is no `d rz`
    let entry = match name.strip_prefix('r') {
        Some(axis) => format!("the turn about {axis} per q{number}"),
        None => format!("d {name} / d q{number}"),
    };
    let [got, should] = [answer, truth].map(|matrix| matrix[row][joint]);
    let (got, should) = distinct_texts(|digits| (trimmed(got, digits), trimmed(should, digits)));
    Some(format!(
        ": column {number} ({joint_name}): {entry} is {got}, should be {should}"
    ))
}
