//! The error of an answer of a function task, by the kind of its case.

use kinemark_sim::model::robot::Robot;

use super::answers::{Answered, CaseError, CaseFacts};
use super::branches::{beyond_limit, distinct_branches};
use crate::submission::answer;
use crate::task::entry::Entry;
use crate::task::jacobian;
use crate::task::model::{Case, Compared, Function, FunctionTask, Given, Rows};
use crate::task::pose::{PoseForm, pose_in};
use crate::task::quantity::Quantity;
use crate::task::task_joints::TaskJoints;
use crate::task::value::Value;

/// Measures the error of `value`, which the function of `task` returned for `case`; `None` without an answer.
pub fn measure<'a>(
    frame: &str,
    task: &FunctionTask,
    case: &'a Case,
    robot: &'a Robot,
    value: Option<&Value>,
) -> CaseFacts<'a> {
    let joints = TaskJoints::of(robot, &task.about.ignored);
    let reading = Reading {
        task,
        frame,
        robot,
        joints: &joints,
        value,
    };
    let mut quantity = None;
    let (answer, error) = match (&case.given, &task.function) {
        (Given::Q(q), Function::Jacobian(rows)) => reading.jacobian(q, *rows),
        (Given::Q(q), Function::ForwardKinematics(form)) => reading.pose(q, *form),
        (Given::Motion(state), Function::Quantity(asked)) => {
            let truth = reading.truth(*asked, state);
            let found = reading.entries(std::slice::from_ref(&truth));
            quantity = Some(truth);
            found
        }
        (Given::Values { expected, .. }, _) => reading.entries(expected),
        (Given::Position { .. }, Function::InverseKinematics(form)) => {
            reading.branches(&case.given, *form)
        }
        // loading gives every function what it takes
        (Given::Q(_) | Given::Motion(_) | Given::Position { .. }, _) => {
            (Answered::Stopped, CaseError::Position(f64::INFINITY))
        }
    };
    CaseFacts {
        case,
        robot,
        joints,
        answer,
        error,
        quantity,
    }
}

/// The return value of a function for one case.
struct Reading<'a> {
    task: &'a FunctionTask,
    frame: &'a str,
    robot: &'a Robot,
    joints: &'a TaskJoints,
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
            Some(Err(what)) => Answered::Invalid(format!("{} returned {what}", self.task.name())),
        }
    }

    fn jacobian(&self, q: &[f64], rows: Rows) -> (Answered, CaseError) {
        // loading checked the number of positions of every case
        let truth = jacobian::jacobian_in(self.robot, self.frame, q, rows)
            .and_then(|all| self.joints.per_joint(self.robot, q, &all))
            .unwrap_or_default();
        let shape = (truth.len(), self.joints.count());
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

    fn pose(&self, q: &[f64], form: PoseForm) -> (Answered, CaseError) {
        let truth = pose_in(self.robot, self.frame, q);
        if form == PoseForm::Position {
            let answer = self.answered(answer::position, Answered::Position);
            let error_m = match (&answer, truth) {
                (Answered::Position(position), Some(truth)) => {
                    (position - truth.translation.vector).norm()
                }
                _ => f64::INFINITY,
            };
            return (answer, CaseError::Position(error_m));
        }
        let answer = self.answered(|value| answer::pose(value, form), Answered::Pose);
        let (position_m, angle_rad) = match (&answer, truth) {
            (Answered::Pose(numbers), Some(truth)) => form.off(numbers, &form.of(&truth)),
            _ => (f64::INFINITY, f64::INFINITY),
        };
        let error = CaseError::Pose {
            position_m,
            angle_rad,
        };
        (answer, error)
    }

    /// What is right for a quantity: an entry without a name. Where the engine has no answer, nothing is right.
    fn truth(&self, quantity: Quantity, state: &[Vec<f64>]) -> (String, Entry) {
        let (joints, gravity) = (self.joints, &self.task.about.gravity_m_s2);
        let numbers = quantity.at(self.robot, joints, self.frame, gravity, state);
        let count = joints.count();
        let numbers = numbers.unwrap_or_else(|| vec![f64::NAN; quantity.count(count)]);
        let entry = if quantity.is_matrix() {
            Entry::Matrix(
                numbers
                    .chunks_exact(count.max(1))
                    .map(<[f64]>::to_vec)
                    .collect(),
            )
        } else {
            Entry::List(numbers)
        };
        (String::new(), entry)
    }

    fn entries(&self, expected: &[(String, Entry)]) -> (Answered, CaseError) {
        let entries = self.value.map(|value| answer::entries(value, expected));
        let compared = &self.task.about.compared;
        let errors = expected.iter().enumerate().map(|(i, (name, should))| {
            let entry = entries
                .as_ref()
                .and_then(|entries| entries[i].as_ref().ok());
            let should = should.numbers();
            entry.map_or(f64::INFINITY, |entry| {
                entry_error(entry, &should, name, compared)
            })
        });
        let error = CaseError::Entries(errors.collect());
        let answer = self.answered(
            |_| entries.into_iter().flatten().collect(),
            Answered::Entries,
        );
        (answer, error)
    }

    fn branches(&self, given: &Given, form: PoseForm) -> (Answered, CaseError) {
        let Given::Position {
            branches,
            pose: target,
            ..
        } = given
        else {
            return (Answered::Stopped, CaseError::Unreachable { said_so: false });
        };
        let most = (*branches).max(2) as usize;
        let answer = self.answered(
            |value| distinct_branches(value, self.robot, self.joints, (most, form.is_turned())),
            Answered::Branches,
        );
        if *branches == 0 {
            let said_so = answer == Answered::Branches(Vec::new());
            return (answer, CaseError::Unreachable { said_so });
        }
        let off = |q: &Vec<f64>| {
            // where a joint cannot be, the arm does not get
            let counts = !self.task.about.within_limits || beyond_limit(self.robot, q).is_none();
            let reached = pose_in(self.robot, self.frame, q).filter(|_| counts);
            reached.map_or((f64::INFINITY, f64::INFINITY), |pose| {
                form.off(&form.of(&pose), target)
            })
        };
        let mut offs: Vec<(f64, f64)> = match &answer {
            Answered::Branches(found) => found.iter().map(off).collect(),
            _ => Vec::new(),
        };
        offs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (branches_m, angles_rad) = offs.into_iter().unzip();
        let error = CaseError::Reach {
            branches_m,
            angles_rad,
            expected: *branches,
        };
        (answer, error)
    }
}

/// The error of an entry called `name`: of an angle the greatest turn between \[rad\], of any other the relative error.
pub fn entry_error(answer: &[f64], expected: &[f64], name: &str, compared: &Compared) -> f64 {
    if !compared.turns.iter().any(|known| known == name) {
        return relative_error(answer, expected, compared.least_size);
    }
    if answer.len() != expected.len() {
        return f64::INFINITY;
    }
    let circle = 2.0 * std::f64::consts::PI;
    let turns = answer.iter().zip(expected).map(|(a, e)| {
        let turn = (a - e).abs() % circle;
        turn.min(circle - turn)
    });
    // NaN is no maximum of anything, and must not be lost
    turns.fold(0.0, |most, turn| {
        if turn.is_nan() || turn > most {
            turn
        } else {
            most
        }
    })
}

/// The relative error of an entry in the Euclidean norm, where what is expected counts as at least `least_size`; the absolute error if
/// both are zero.
pub fn relative_error(answer: &[f64], expected: &[f64], least_size: f64) -> f64 {
    let norm = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(|x| x * x).sum::<f64>().sqrt();
    if answer.len() != expected.len() {
        return f64::INFINITY;
    }
    let off = norm(&mut answer.iter().zip(expected).map(|(a, e)| a - e));
    match norm(&mut expected.iter().copied()).max(least_size) {
        size if size > 0.0 => off / size,
        _ => off,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_relative_to_what_it_should_be_and_absolute_at_zero() {
        assert_eq!(relative_error(&[1.5], &[2.0], 0.0), 0.25);
        assert_eq!(relative_error(&[0.5], &[0.0], 0.0), 0.5);
        assert_eq!(relative_error(&[3.0, 5.0], &[3.0, 4.0], 0.0), 0.2);
        assert_eq!(relative_error(&[3.0], &[3.0, 4.0], 0.0), f64::INFINITY);
        assert!(relative_error(&[f64::NAN], &[1.0], 0.0).is_nan());
        assert_eq!(relative_error(&[0.5], &[0.25], 0.5), 0.5);
        assert_eq!(relative_error(&[1.5], &[2.0], 0.5), 0.25);
    }

    #[test]
    fn whole_turns_make_no_difference_to_an_angle() {
        use std::f64::consts::PI;
        let compared = Compared {
            turns: vec!["yaw".to_owned()],
            least_size: 0.0,
        };
        let error = |answer: &[f64], expected: &[f64], name: &str| {
            entry_error(answer, expected, name, &compared)
        };
        assert!(error(&[3.0 + 2.0 * PI], &[3.0], "yaw") < 1e-15);
        assert!((error(&[PI - 0.1, 0.0], &[-PI + 0.1, 0.0], "yaw") - 0.2).abs() < 1e-15);
        assert_eq!(error(&[0.0], &[3.0], "yaw"), 3.0);
        assert_eq!(error(&[0.0, 1.0], &[3.0], "yaw"), f64::INFINITY);
        assert!(error(&[f64::NAN, 1.0], &[3.0, 1.0], "yaw").is_nan());
        assert_eq!(error(&[6.0], &[3.0], "roll"), 1.0);
    }
}
