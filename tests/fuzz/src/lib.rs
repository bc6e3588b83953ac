//! What every target does with a robot or an error it gets: walk through all of it, so that whatever loads can be worked with.

pub mod labs;
mod opening;

pub use opening::opening;

use kinemark_sim::dynamics::{
    GRAVITY_M_S2, driven_efforts, energy, forward_dynamics, gravity_effort, inverse_dynamics,
    mass_matrix,
};
use kinemark_sim::joint_space::{
    JointAccelerations, JointEfforts, JointPositions, JointVelocities,
};
use kinemark_sim::kinematics::derivative::jacobian_derivative;
use kinemark_sim::kinematics::inverse::{IkSettings, Target, inverse_kinematics};
use kinemark_sim::kinematics::manipulability::{Manipulability, TWIST};
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::{Located, Problem};
use miette::{Diagnostic as _, SourceCode as _};

/// Robots with more joints are only loaded: the algorithms' time grows with the square of it.
const MOST_JOINTS: usize = 50;

/// Writes the robot, and runs every algorithm once, at rest at zero and in motion elsewhere.
pub fn exercise(robot: &Robot) {
    let n = robot.n();
    if n > MOST_JOINTS {
        return;
    }
    robot.to_toml(&mut str::to_owned);
    for size in [0.0, 0.7] {
        let values = || (0..n).map(|i| size * (i as f64 + 1.0));
        let q = JointPositions::new(values());
        let qd = JointVelocities::new(values());
        let qdd = JointAccelerations::new(values());
        let tau = JointEfforts::new(values());
        let poses = forward_kinematics(robot, &q);
        for frame in robot.frames() {
            poses.world_from(frame);
        }
        geometric_jacobian(robot, &q, robot.tcp());
        let effort = inverse_dynamics(robot, &GRAVITY_M_S2, &q, &qd, &qdd);
        assert_eq!(effort.len(), n);
        gravity_effort(robot, &GRAVITY_M_S2, &q);
        mass_matrix(robot, &q);
        energy(robot, &GRAVITY_M_S2, &q, &qd);
        // a joint without mass is an error, not a panic
        let _singular = forward_dynamics(robot, &GRAVITY_M_S2, &q, &qd, &tau);
        let jacobian = jacobian_derivative(robot, &q, &qd, robot.tcp());
        Manipulability::of(&jacobian, TWIST);
        let settings = IkSettings {
            max_iterations: 3,
            restarts: 2,
            ..IkSettings::default()
        };
        let target = Target::Position(nalgebra::Vector3::new(0.3, -0.2, 0.5));
        let q0 = q.as_slice();
        if let Ok(answer) = inverse_kinematics(robot, robot.tcp(), target, q0, &settings) {
            assert_eq!(answer.q.len(), n);
        }
        let _open = driven_efforts(
            robot,
            &GRAVITY_M_S2,
            &vec![size; robot.independent().len()],
            &vec![size; robot.independent().len()],
            &vec![size; robot.independent().len()],
        );
    }
}

/// Reads all that a person would see of an error; its place must lie in the text.
pub fn explain<P: Problem>(error: &Located<P>) {
    let (line, column) = error.line_and_column();
    assert!(line >= 1 && column >= 1);
    let text = error.source().text();
    let lines = text.split('\n').count();
    assert!(line <= lines, "line {line} of {lines}");
    for label in error.labels().into_iter().flatten() {
        let excerpt = text.read_span(label.inner(), 0, 0);
        assert!(
            excerpt.is_ok(),
            "{:?} of {} bytes",
            label.inner(),
            text.len()
        );
    }
    assert!(!error.to_string().is_empty());
    assert!(!error.problem.code().is_empty());
    error.problem.label();
    error.problem.help();
}
