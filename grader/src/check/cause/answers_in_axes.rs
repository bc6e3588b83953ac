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
/// What a unit is taken for, by the factor between the two.
const UNITS: [(f64, &str); 4] = [
    (1e-3, "taken as millimetres"),
    (1e3, "taken as kilometres"),
    (std::f64::consts::PI / 180.0, "times π / 180"),
    (180.0 / std::f64::consts::PI, "times 180 / π"),
];
const UNIT_QUESTION: &str =
    "In which unit do you return numbers? Lengths are in metres, and angles in radians.";
/// A step of all positions is no rounding \[m\].
const LEAST_STEP_M: f64 = 1e-3;

const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn seen(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    positions(answers).or_else(|| matrices(answers))
}

fn positions(answers: &Answers<'_>) -> Option<CauseOfAnswers> {
    let both = |facts: &&CaseFacts<'_>| match &facts.case.given {
        Given::Q(q) => Some((
            facts.answer.position()?,
            tcp_in(facts.robot, answers.frame, q)?,
        )),
        _ => None,
    };
    let wrong: Vec<(Vector3<f64>, Vector3<f64>)> = answers.wrong.iter().filter_map(both).collect();
    if wrong.len() < answers.wrong.len() || wrong.len() < super::LEAST_WRONG {
        return None;
    }
    // of a pose the orientation alone may be wrong
    if wrong
        .iter()
        .any(|(answered, truth)| (answered - truth).norm() <= SAME_M)
    {
        return None;
    }
    let count = wrong.len();
    let all = |meant: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        wrong
            .iter()
            .all(|(answered, truth)| (meant(*answered) - truth).norm() <= SAME_M)
    };
    for (factor, taken) in UNITS {
        if all(&|p| p * factor) {
            return Some(CauseOfAnswers {
                words: format!("all {count} wrong positions are right {taken}"),
                question: UNIT_QUESTION.to_owned(),
            });
        }
    }
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
    // a pose may be that of another frame than the TCP, at a step from it
    let are_positions = |facts: &&CaseFacts<'_>| matches!(facts.answer, Answered::Position(_));
    // a step that a right answer does not have is no step of all
    (answers.right.is_empty() && answers.wrong.iter().all(are_positions))
        .then(|| step(answers, &wrong))
        .flatten()
}

/// All positions are off by the same step; with arms of other sizes along the same axis, by what belongs to these.
fn step(answers: &Answers<'_>, wrong: &[(Vector3<f64>, Vector3<f64>)]) -> Option<CauseOfAnswers> {
    let steps = wrong.iter().map(|(answered, truth)| answered - truth);
    let is_own = |facts: &CaseFacts<'_>| facts.case.dimensions.is_empty();
    let (own, others): (Vec<_>, Vec<_>) = steps
        .zip(&answers.wrong)
        .partition(|(_, facts)| is_own(facts));
    let (step, _) = *own.first()?;
    let axes = |v: &Vector3<f64>| -> Vec<usize> {
        (0..3).filter(|axis| v[*axis].abs() > SAME_M).collect()
    };
    let are_same = own.iter().all(|(other, _)| (other - step).norm() <= SAME_M);
    let others_too = others
        .iter()
        .all(|(other, _)| (other - step).norm() <= SAME_M);
    let along = axes(&step);
    let along_too = along.len() == 1 && others.iter().all(|(other, _)| axes(other) == along);
    if step.norm() <= LEAST_STEP_M || !are_same || !(others_too || along_too) {
        return None;
    }
    let count = wrong.len();
    let step_m = list(step.as_slice());
    Some(CauseOfAnswers {
        words: if others_too {
            format!("all {count} positions are off by the same step, {step_m} m along x, y, z")
        } else {
            let axis = AXES[along[0]];
            format!(
                "all {count} positions are off along {axis} alone, with the arm of this lab by the same step, {step_m} m along x, y, z"
            )
        },
        question: match along[..] {
            [axis] => format!(
                "Only {} is off: what adds to it, and how often?",
                AXES[axis]
            ),
            _ => "From which point do you measure, and where is the origin of the lab's frame?"
                .to_owned(),
        },
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
    let is_right = |slip: &Slip| {
        let mut wrong = wrong.iter();
        wrong.all(|(answer, truth)| {
            jacobian::relative_distance(&(slip.meant)(answer), truth) <= SAME
        })
    };
    let slip = slips(rows, columns).into_iter().find(is_right)?;
    let count = wrong.len();
    Some(CauseOfAnswers {
        words: format!("all {count} wrong matrices are right {}", slip.what),
        question: slip.question.to_owned(),
    })
}

/// What was done to a right matrix.
struct Slip {
    /// After "right".
    what: String,
    question: &'static str,
    /// The matrix that was meant.
    meant: Box<dyn Fn(&Matrix) -> Matrix>,
}

/// What may have been done to matrices of so many rows and columns.
fn slips(rows: usize, columns: usize) -> Vec<Slip> {
    const ORDER: &str = "Which row is for which coordinate, and which column for which joint?";
    const SIGN: &str = "Differentiate that coordinate once more: which of the derivatives of a sine and of a cosine has a minus?";
    let slip = |what: String, question, meant: Box<dyn Fn(&Matrix) -> Matrix>| Slip {
        what,
        question,
        meant,
    };
    let mut slips: Vec<Slip> = UNITS
        .iter()
        .map(|&(factor, taken)| {
            let meant = move |m: &Matrix| each_entry(m, |_, entry| factor * entry);
            slip(taken.to_owned(), UNIT_QUESTION, Box::new(meant))
        })
        .collect();
    if rows == columns {
        let what = "with rows and columns exchanged".to_owned();
        slips.push(slip(what, ORDER, Box::new(transposed)));
    }
    for [first, second] in pairs(rows) {
        let what = format!("with rows {} and {} exchanged", first + 1, second + 1);
        let meant = move |m: &Matrix| {
            let mut m = m.clone();
            m.swap(first, second);
            m
        };
        slips.push(slip(what, ORDER, Box::new(meant)));
    }
    for [first, second] in pairs(columns) {
        let what = format!("with columns {} and {} exchanged", first + 1, second + 1);
        let meant = move |m: &Matrix| {
            let mut m = m.clone();
            m.iter_mut().for_each(|row| row.swap(first, second));
            m
        };
        slips.push(slip(what, ORDER, Box::new(meant)));
    }
    for turned in 0..rows {
        let what = format!("with the other sign of row {}", turned + 1);
        let meant = move |m: &Matrix| {
            each_entry(m, |row, entry| if row == turned { -entry } else { entry })
        };
        slips.push(slip(what, SIGN, Box::new(meant)));
    }
    let meant = |m: &Matrix| each_entry(m, |_, entry| -entry);
    slips.push(slip(
        "with the other sign".to_owned(),
        SIGN,
        Box::new(meant),
    ));
    slips
}

fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |first| (first + 1..count).map(move |second| [first, second]))
}

/// A matrix with `make` of each entry, which is given its row, too.
fn each_entry(matrix: &Matrix, make: impl Fn(usize, f64) -> f64) -> Matrix {
    let rows = matrix.iter().enumerate();
    rows.map(|(i, row)| row.iter().map(|entry| make(i, *entry)).collect())
        .collect()
}

fn transposed(matrix: &Matrix) -> Matrix {
    let columns = matrix.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| matrix.iter().map(|row| row[column]).collect())
        .collect()
}
