//! jacobian-match: the mean relative distance of the answered Jacobians from the true ones, `‖J - J_true‖ / ‖J_true‖` in the
//! Frobenius norm. One answer that is no matrix of the right shape makes it infinite.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::lab::jacobian;
use crate::lab::model::{Band, Function};
use crate::record::grade::Measure;
use crate::record::quantity::{trimmed, with_unit};

/// Judges the check.
pub fn judge(cases: &[CaseFacts<'_>], band: Band, function: &Function) -> Finding {
    let relative = |facts: &CaseFacts<'_>| match &facts.error {
        CaseError::Jacobian { relative, .. } => *relative,
        _ => f64::INFINITY,
    };
    let mean = cases.iter().map(relative).sum::<f64>() / cases.len() as f64;
    let score = band.score(mean);
    let mut failed = Vec::new();
    if score < 1.0 {
        for facts in cases {
            let relative = relative(facts);
            // written so that NaN is among the failed
            let good = relative <= band.full;
            if !good {
                let message = match (&facts.answer, &facts.error) {
                    (Answered::Invalid(what), _) => format!("{}: {what}", facts.told()),
                    (Answered::Matrix(answer), CaseError::Jacobian { truth, .. }) => format!(
                        "{}: {} off{}",
                        facts.told(),
                        with_unit(relative, ""),
                        worst_entry(facts, function, answer, truth)
                    ),
                    _ => format!("{}: no answer", facts.told()),
                };
                failed.push((facts, relative, message));
            }
        }
    }
    let all: Vec<&CaseFacts<'_>> = cases.iter().collect();
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "mean relative error of the Jacobian".to_owned(),
            value: mean.is_finite().then_some(mean),
            unit: String::new(),
            full: band.full,
            zero: band.zero,
        }),
        evidence: summarise(function, failed, &all, band.full, ""),
        next_step:
            "Compare each column with (p(q + h) - p(q - h)) / (2 h), one joint moved by a small h."
                .to_owned(),
        curve: None,
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
