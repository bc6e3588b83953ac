//! The error of an answer of a function task, by the kind of its case.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimension;
use nalgebra::Vector3;

use super::answers::{Answered, CaseError, CaseFacts};
use super::branches::{beyond_limit, distinct_branches};
use crate::submission::answer;
use crate::task::jacobian;
use crate::task::model::{Case, Function, Given, Rows};
use crate::task::tcp::tcp_in;
use crate::task::value::Value;

/// Measures the error of `value`, which `function` returned for `case`; `None` without an answer.
pub fn measure<'a>(
    frame: &str,
    function: &Function,
    case: &'a Case,
    robot: &'a Robot,
    value: Option<&Value>,
) -> CaseFacts<'a> {
    let answer = Reading {
        function,
        frame,
        robot,
        value,
    };
    let (answer, error) = match (&case.given, function) {
        (Given::Q(q), Function::Jacobian(rows)) => answer.jacobian(q, *rows),
        (Given::Q(q), _) => answer.position(q),
        (Given::Values { expected, .. }, _) => answer.entries(expected),
        (
            Given::Position {
                position_m,
                branches,
            },
            _,
        ) => answer.branches(*position_m, *branches),
    };
    CaseFacts {
        case,
        robot,
        answer,
        error,
    }
}

/// The return value of a function for one case.
struct Reading<'a> {
    function: &'a Function,
    frame: &'a str,
    robot: &'a Robot,
    value: Option<&'a Value>,
}

impl Reading<'_> {
    /// The answer as parsed by `read`, or a description of the invalid value.
    fn answered<T>(
        &self,
        read: impl FnOnce(&Value) -> Result<T, String>,
        answer: impl FnOnce(T) -> Answered,
    ) -> Answered {
        match self.value.map(read) {
            None => Answered::Stopped,
            Some(Ok(value)) => answer(value),
            Some(Err(what)) => {
                Answered::Invalid(format!("{} returned {what}", self.function.name()))
            }
        }
    }

    /// Position of the TCP at `q` in the lab's frame \[m\].
    fn tcp_at(&self, q: &[f64]) -> Option<Vector3<f64>> {
        tcp_in(self.robot, self.frame, q)
    }

    fn jacobian(&self, q: &[f64], rows: Rows) -> (Answered, CaseError) {
        // loading checked the number of positions of every case
        let truth = jacobian::jacobian_in(self.robot, self.frame, q, rows).unwrap_or_default();
        let shape = (truth.len(), self.robot.n());
        let answer = self.answered(
            |value| answer::matrix(value, shape.0, shape.1),
            Answered::Matrix,
        );
        let relative = match &answer {
            Answered::Matrix(matrix) => jacobian::relative_distance(matrix, &truth),
            _ => f64::INFINITY,
        };
        (answer, CaseError::Jacobian { relative, truth })
    }

    fn position(&self, q: &[f64]) -> (Answered, CaseError) {
        let answer = self.answered(answer::position, Answered::Position);
        let error_m = match (&answer, self.tcp_at(q)) {
            (Answered::Position(position), Some(truth)) => (position - truth).norm(),
            _ => f64::INFINITY,
        };
        (answer, CaseError::Position(error_m))
    }

    fn entries(&self, expected: &[(String, Dimension)]) -> (Answered, CaseError) {
        let entries = self.value.map(|value| answer::entries(value, expected));
        let relative = expected.iter().enumerate().map(|(i, (_, should))| {
            let entry = entries
                .as_ref()
                .and_then(|entries| entries[i].as_ref().ok());
            entry.map_or(f64::INFINITY, |entry| {
                relative_error(entry, as_slice(should))
            })
        });
        let error = CaseError::Entries(relative.collect());
        let answer = self.answered(
            |_| entries.into_iter().flatten().collect(),
            Answered::Entries,
        );
        (answer, error)
    }

    fn branches(&self, position_m: [f64; 3], branches: u32) -> (Answered, CaseError) {
        let most = branches.max(2) as usize;
        let answer = self.answered(
            |value| distinct_branches(value, self.robot, most),
            Answered::Branches,
        );
        if branches == 0 {
            let said_so = answer == Answered::Branches(Vec::new());
            return (answer, CaseError::Unreachable { said_so });
        }
        let target = Vector3::from(position_m);
        let mut branches_m: Vec<f64> = match &answer {
            Answered::Branches(found) => found
                .iter()
                .map(|q| {
                    // where a joint cannot be, the arm does not get
                    let reached = self
                        .tcp_at(q)
                        .filter(|_| beyond_limit(self.robot, q).is_none());
                    reached.map_or(f64::INFINITY, |p| (p - target).norm())
                })
                .collect(),
            _ => Vec::new(),
        };
        branches_m.sort_by(f64::total_cmp);
        let expected = branches;
        (
            answer,
            CaseError::Reach {
                branches_m,
                expected,
            },
        )
    }
}

/// The numbers of an entry.
pub fn as_slice(entry: &Dimension) -> &[f64] {
    match entry {
        Dimension::Number(number) => std::slice::from_ref(number),
        Dimension::List(list) => list,
    }
}

/// The relative error of an entry in the Euclidean norm; the absolute error if the expected entry is zero.
pub fn relative_error(answer: &[f64], expected: &[f64]) -> f64 {
    let norm = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(|x| x * x).sum::<f64>().sqrt();
    if answer.len() != expected.len() {
        return f64::INFINITY;
    }
    let off = norm(&mut answer.iter().zip(expected).map(|(a, e)| a - e));
    match norm(&mut expected.iter().copied()) {
        size if size > 0.0 => off / size,
        _ => off,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_relative_to_what_it_should_be_and_absolute_at_zero() {
        assert_eq!(relative_error(&[1.5], &[2.0]), 0.25);
        assert_eq!(relative_error(&[0.5], &[0.0]), 0.5);
        assert_eq!(relative_error(&[3.0, 5.0], &[3.0, 4.0]), 0.2);
        assert_eq!(relative_error(&[3.0], &[3.0, 4.0]), f64::INFINITY);
        assert!(relative_error(&[f64::NAN], &[1.0]).is_nan());
    }
}
