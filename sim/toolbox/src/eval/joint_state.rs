//! The state of a robot in a request: one number per joint that moves or, for a robot with loops, per independent joint, from which
//! the others follow.

use kinemark_sim::joint_space::{
    JointAccelerations, JointEfforts, JointPositions, JointVelocities,
};
use kinemark_sim::kinematics::closure::{
    LoopError, closed_accelerations, closed_positions, closed_velocities,
};
use kinemark_sim::model::robot::Robot;

use super::number_fields::Numbers;
use super::refusal::{Code, Refusal, refuse};
use crate::joint_names::joint_names;

impl From<LoopError> for Refusal {
    fn from(error: LoopError) -> Self {
        let code = match error {
            LoopError::Open { .. } | LoopError::Apart => Code::OpenLoop,
            LoopError::TooFar { .. } => Code::OutOfRange,
            LoopError::PassiveCount { .. } | LoopError::Singular => Code::Singular,
        };
        Self::new(code, error)
    }
}

/// Numbers over all joints: those of `numbers`, or what follows from them where they are of the independent joints.
fn over_all(
    robot: &Robot,
    name: &str,
    numbers: &Numbers,
    follow: impl FnOnce(&[f64]) -> Result<Vec<f64>, LoopError>,
) -> Result<Vec<f64>, Refusal> {
    let values = numbers.as_slice();
    let (n, k) = (robot.n(), robot.independent().len());
    if values.len() == n {
        return Ok(values.to_vec());
    }
    if values.len() == k {
        return follow(values).map_err(Refusal::from);
    }
    let independent = if k < n {
        let names = joint_names(robot, robot.independent());
        format!(", {k} of them independent ({})", names.join(", "))
    } else {
        String::new()
    };
    let found = values.len();
    refuse(
        Code::WrongLength,
        format!("`{name}` has {found} numbers, the robot has {n} joints that move{independent}"),
    )
}

/// Positions of all joints; loops closed where only the independent ones are given.
pub(super) fn positions(robot: &Robot, name: &str, q: &Numbers) -> Result<JointPositions, Refusal> {
    over_all(robot, name, q, |independent| {
        closed_positions(robot, independent)
    })
    .map(JointPositions::new)
}

/// Velocities of all joints at `q`.
pub(super) fn velocities(
    robot: &Robot,
    name: &str,
    q: &JointPositions,
    qd: &Numbers,
) -> Result<JointVelocities, Refusal> {
    over_all(robot, name, qd, |independent| {
        closed_velocities(robot, q.as_slice(), independent)
    })
    .map(JointVelocities::new)
}

/// Accelerations of all joints at `(q, qd)`.
pub(super) fn accelerations(
    robot: &Robot,
    name: &str,
    (q, qd): (&JointPositions, &JointVelocities),
    qdd: &Numbers,
) -> Result<JointAccelerations, Refusal> {
    over_all(robot, name, qdd, |independent| {
        closed_accelerations(robot, q.as_slice(), qd.as_slice(), independent)
    })
    .map(JointAccelerations::new)
}

/// Efforts, or commands, of all joints: zero at dependent joints where only the independent ones are given.
pub(super) fn efforts(
    robot: &Robot,
    name: &str,
    effort: &Numbers,
) -> Result<JointEfforts, Refusal> {
    over_all(robot, name, effort, |independent| {
        Ok(zeros_elsewhere(robot, independent))
    })
    .map(JointEfforts::new)
}

/// Values of the independent joints, zeros at the dependent ones.
pub(super) fn zeros_elsewhere(robot: &Robot, independent: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; robot.n()];
    for (&i, value) in robot.independent().iter().zip(independent) {
        all[i] = *value;
    }
    all
}

/// One number per independent joint, and no others.
pub(super) fn independent<'n>(
    robot: &Robot,
    name: &str,
    numbers: &'n Numbers,
) -> Result<&'n [f64], Refusal> {
    let (values, k) = (numbers.as_slice(), robot.independent().len());
    if values.len() == k {
        return Ok(values);
    }
    let (found, names) = (
        values.len(),
        joint_names(robot, robot.independent()).join(", "),
    );
    refuse(
        Code::WrongLength,
        format!("`{name}` has {found} numbers, the robot has {k} independent joints ({names})"),
    )
}
