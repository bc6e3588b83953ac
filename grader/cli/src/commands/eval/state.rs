//! The state of a robot in a request: one number per joint that moves or, for a robot with loops, per independent joint, from which
//! the others follow.

use kinemark_sim::joint::{JointAccelerations, JointEfforts, JointPositions, JointVelocities};
use kinemark_sim::kinematics::closure::{
    LoopError, closed_accelerations, closed_positions, closed_velocities,
};
use kinemark_sim::robot::Robot;

use super::Refusal;
use super::request::Fields;

/// Numbers of a request, for all joints that move or for the independent ones.
enum Given {
    All(Vec<f64>),
    Independent(Vec<f64>),
}

/// Names of the joints at these places of `q`.
pub(super) fn names_of(robot: &Robot, places: &[usize]) -> Vec<String> {
    let all: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    places.iter().map(|&i| all[i].to_owned()).collect()
}

/// Why loops are not closed, as an answer.
pub(super) fn loop_refusal(error: &LoopError) -> Refusal {
    let code = match error {
        LoopError::Open { .. } | LoopError::Apart => "open-loop",
        LoopError::TooFar { .. } => "out-of-range",
        LoopError::PassiveCount { .. } | LoopError::Singular => "singular",
    };
    Refusal::new(code, error.to_string())
}

impl Fields<'_> {
    fn given(&mut self, name: &'static str) -> Result<Given, Refusal> {
        let values = self.numbers(name)?;
        let (n, k) = (self.robot.n(), self.robot.independent().len());
        if values.len() == n {
            return Ok(Given::All(values));
        }
        if values.len() == k {
            return Ok(Given::Independent(values));
        }
        let independent = if k < n {
            let names = names_of(self.robot, self.robot.independent());
            format!(", {k} of them independent ({})", names.join(", "))
        } else {
            String::new()
        };
        Err(Refusal::new(
            "wrong-length",
            format!(
                "`{name}` has {} numbers, the robot has {n} joints that move{independent}",
                values.len()
            ),
        ))
    }

    /// Positions of all joints; loops closed where only the independent ones are given.
    pub(super) fn positions(&mut self, name: &'static str) -> Result<JointPositions, Refusal> {
        match self.given(name)? {
            Given::All(values) => Ok(JointPositions::new(values)),
            Given::Independent(values) => self.closed(&values).map(JointPositions::new),
        }
    }

    fn closed(&self, independent: &[f64]) -> Result<Vec<f64>, Refusal> {
        closed_positions(self.robot, independent).map_err(|error| loop_refusal(&error))
    }

    /// Velocities of all joints at `q`.
    pub(super) fn velocities(
        &mut self,
        name: &'static str,
        q: &JointPositions,
    ) -> Result<JointVelocities, Refusal> {
        match self.given(name)? {
            Given::All(values) => Ok(JointVelocities::new(values)),
            Given::Independent(values) => closed_velocities(self.robot, q.as_slice(), &values)
                .map(JointVelocities::new)
                .map_err(|error| loop_refusal(&error)),
        }
    }

    /// Accelerations of all joints at `(q, qd)`.
    pub(super) fn accelerations(
        &mut self,
        name: &'static str,
        q: &JointPositions,
        qd: &JointVelocities,
    ) -> Result<JointAccelerations, Refusal> {
        match self.given(name)? {
            Given::All(values) => Ok(JointAccelerations::new(values)),
            Given::Independent(values) => {
                closed_accelerations(self.robot, q.as_slice(), qd.as_slice(), &values)
                    .map(JointAccelerations::new)
                    .map_err(|error| loop_refusal(&error))
            }
        }
    }

    /// Efforts, or commands, of all joints: zero at dependent joints where only the independent ones are given.
    pub(super) fn efforts(&mut self, name: &'static str) -> Result<JointEfforts, Refusal> {
        match self.given(name)? {
            Given::All(values) => Ok(JointEfforts::new(values)),
            Given::Independent(values) => Ok(JointEfforts::new(self.over_all(&values))),
        }
    }

    /// Values of the independent joints at their places, zeros elsewhere.
    pub(super) fn over_all(&self, independent: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.robot.n()];
        for (&i, value) in self.robot.independent().iter().zip(independent) {
            all[i] = *value;
        }
        all
    }

    /// One number per independent joint, and no others.
    pub(super) fn independent(&mut self, name: &'static str) -> Result<Vec<f64>, Refusal> {
        let values = self.numbers(name)?;
        let k = self.robot.independent().len();
        if values.len() == k {
            return Ok(values);
        }
        let names = names_of(self.robot, self.robot.independent());
        Err(Refusal::new(
            "wrong-length",
            format!(
                "`{name}` has {} numbers, the robot has {k} independent joints ({})",
                values.len(),
                names.join(", ")
            ),
        ))
    }
}
