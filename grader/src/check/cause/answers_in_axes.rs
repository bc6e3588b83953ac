//! Answers whose numbers are right and stand in the wrong place: coordinates, rows or columns exchanged or with another sign, a matrix
//! transposed, positions that are all off by the same step.

use nalgebra::Vector3;

use super::{Answers, CauseOfAnswers};
use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::task::jacobian;
use crate::task::model::Given;
use crate::task::tcp::tcp_in;
use kinemark_sim::text::number::list;

/// Positions that are the same \[m\].
const SAME_M: f64 = 1e-4;
/// Matrices that are the same, as a share of their norm.
const SAME: f64 = 1e-4;
/// A step of all positions is no rounding \[m\].
const LEAST_STEP_M: f64 = 1e-3;

const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    positions(answers).or_else(|| matrices(answers))
}

fn positions(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let both = |facts: &&CaseFacts<'_>| match (&facts.case.given, &facts.answer) {
        (Given::Q(q), Answered::Position(p)) => Some((*p, tcp_in(facts.robot, answers.frame, q)?)),
        _ => None,
    };
    let wrong: Vec<(Vector3<f64>, Vector3<f64>)> = answers.wrong.iter().filter_map(both).collect();
    if wrong.len() < answers.wrong.len() || wrong.len() < super::LEAST_WRONG {
        return None;
    }
    let count = wrong.len();
    let all = |meant: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        wrong
            .iter()
            .all(|(answered, truth)| (meant(*answered) - truth).norm() <= SAME_M)
    };
    for (first, second) in [(0, 1), (0, 2), (1, 2)] {
        let exchanged = |mut p: Vector3<f64>| {
            p.swap_rows(first, second);
            p
        };
        if all(&exchanged) {
            let [a, b] = [AXES[first], AXES[second]];
            return Some(CauseOfAnswers {
                words: format!("all {count} wrong positions are right with {a} and {b} exchanged"),
                question: format!(
                    "Which of your formulas is for {a}, and which for {b}? Look where the axes of the lab's frame point."
                ),
            });
        }
    }
    for (axis, name) in AXES.iter().enumerate() {
        let turned = |mut p: Vector3<f64>| {
            p[axis] = -p[axis];
            p
        };
        if all(&turned) {
            return Some(CauseOfAnswers {
                words: format!(
                    "all {count} wrong positions are right with the other sign of {name}"
                ),
                question: format!("Which way does {name} point in the lab's frame?"),
            });
        }
    }
    let step = wrong[0].0 - wrong[0].1;
    let moved = |p: Vector3<f64>| p - step;
    // a step that a right answer does not have is no step of all
    (answers.right.is_empty() && step.norm() > LEAST_STEP_M && all(&moved)).then(|| {
        CauseOfAnswers {
            words: format!(
                "all {count} positions are off by the same step, {} m along x, y, z",
                list(step.as_slice())
            ),
            question:
                "From which point do you measure, and where is the origin of the lab's frame?"
                    .to_owned(),
        }
    })
}

type Matrix = Vec<Vec<f64>>;

fn matrices(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let both = |facts: &&CaseFacts<'_>| match (&facts.answer, &facts.error) {
        (Answered::Matrix(answer), CaseError::Jacobian { truth, .. }) => {
            Some((answer.clone(), truth.clone()))
        }
        _ => None,
    };
    let wrong: Vec<(Matrix, Matrix)> = answers.wrong.iter().filter_map(both).collect();
    if wrong.len() < answers.wrong.len() || wrong.len() < super::LEAST_WRONG {
        return None;
    }
    let [rows, columns] = [wrong[0].1.len(), wrong[0].1.first().map_or(0, Vec::len)];
    let all = |meant: &dyn Fn(&Matrix) -> Matrix| {
        wrong
            .iter()
            .all(|(answer, truth)| jacobian::relative_distance(&meant(answer), truth) <= SAME)
    };
    let count = wrong.len();
    let cause = |what: String, question: &str| {
        Some(CauseOfAnswers {
            words: format!("all {count} wrong matrices are right {what}"),
            question: question.to_owned(),
        })
    };
    const ORDER: &str = "Which row is for which coordinate, and which column for which joint?";
    const SIGN: &str =
        "Differentiate that coordinate once more: the derivative of a cosine is minus the sine.";
    if rows == columns && all(&|m| transposed(m)) {
        return cause("with rows and columns exchanged".to_owned(), ORDER);
    }
    for first in 0..rows {
        for second in first + 1..rows {
            let exchanged = |m: &Matrix| {
                let mut m = m.clone();
                m.swap(first, second);
                m
            };
            if all(&exchanged) {
                let [a, b] = [first + 1, second + 1];
                return cause(format!("with rows {a} and {b} exchanged"), ORDER);
            }
        }
    }
    for first in 0..columns {
        for second in first + 1..columns {
            let exchanged = |m: &Matrix| {
                let mut m = m.clone();
                m.iter_mut().for_each(|row| row.swap(first, second));
                m
            };
            if all(&exchanged) {
                let [a, b] = [first + 1, second + 1];
                return cause(format!("with columns {a} and {b} exchanged"), ORDER);
            }
        }
    }
    for row in 0..rows {
        let turned = |m: &Matrix| {
            let mut m = m.clone();
            m[row].iter_mut().for_each(|entry| *entry = -*entry);
            m
        };
        if all(&turned) {
            return cause(format!("with the other sign of row {}", row + 1), SIGN);
        }
    }
    if all(&|m| {
        m.iter()
            .map(|row| row.iter().map(|x| -x).collect())
            .collect()
    }) {
        return cause("with the other sign".to_owned(), SIGN);
    }
    None
}

fn transposed(matrix: &Matrix) -> Matrix {
    let columns = matrix.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| matrix.iter().map(|row| row[column]).collect())
        .collect()
}
