//! Prescribed motion: the joints follow laws, whatever acts on them, and the efforts that this takes come out.
//!
//! Independent joints have a law each; the loops take the others along. The efforts are those of inverse dynamics, less what forces on
//! links (drag, pushes, contact) contribute: `τ = M q̈ + h + D q̇ + friction - Σ Jᵀ F`, projected on the independent joints where there
//! are loops. Contact pushes on what moves and never on the laws; its forces are those of the step before, which is what a measurement
//! would show.

use std::sync::Arc;

use nalgebra::{DMatrix, Vector3};

use crate::dynamics::link_forces::LinkForces;
use crate::dynamics::rnea::Rnea;
use crate::kinematics::closure::{
    Closure, LoopError, closed_accelerations, closed_velocities, independent_motions,
};
use crate::model::robot::Robot;
use crate::trajectory::{JointLaw, Sample};

/// The motion of one robot under laws.
#[derive(Debug, Clone)]
pub struct PrescribedMotion {
    laws: Arc<[JointLaw]>,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    rnea: Rnea,
    /// Efforts of the open tree.
    tree: Vec<f64>,
    /// Efforts of the forces on links.
    pushed: Vec<f64>,
}

impl PrescribedMotion {
    /// Laws for the independent joints of `robot`, in the order of [`Robot::independent`]; it starts where they start.
    ///
    /// # Errors
    /// [`LoopError`] where the loops cannot be closed at time zero.
    ///
    /// # Panics
    /// If there is another number of laws.
    pub fn new(robot: &Robot, laws: Arc<[JointLaw]>) -> Result<Self, LoopError> {
        assert_eq!(
            laws.len(),
            robot.independent().len(),
            "a law per independent joint"
        );
        let room = || vec![0.0; robot.n()];
        let mut motion = Self {
            laws,
            q: robot.home().to_vec(),
            qd: room(),
            qdd: room(),
            rnea: Rnea::new(robot),
            tree: room(),
            pushed: room(),
        };
        motion.move_to(robot, 0.0)?;
        Ok(motion)
    }

    /// Moves to `time_s`. Loops are followed from where they were, so times come in small steps.
    ///
    /// # Errors
    /// [`LoopError`] where the loops cannot be closed, or do not determine the dependent joints.
    pub fn move_to(&mut self, robot: &Robot, time_s: f64) -> Result<(), LoopError> {
        let samples: Vec<Sample> = self.laws.iter().map(|law| law.at(time_s)).collect();
        let list = |of: fn(&Sample) -> f64| samples.iter().map(of).collect::<Vec<f64>>();
        let positions = list(|sample| sample.position);
        if robot.loops().is_empty() {
            self.q = positions;
        } else {
            Closure::new(robot).follow(robot, &positions, &mut self.q)?;
        }
        self.qd = closed_velocities(robot, &self.q, &list(|sample| sample.velocity))?;
        let accelerations = list(|sample| sample.acceleration);
        self.qdd = closed_accelerations(robot, &self.q, &self.qd, &accelerations)?;
        Ok(())
    }

    /// Positions, velocities and accelerations, shape `(n)` each.
    pub fn state(&self) -> [&[f64]; 3] {
        [&self.q, &self.qd, &self.qdd]
    }

    /// Writes the efforts that the motion takes now under `gravity_m_s2` (world) and `forces`, shape `(n)`, zero at dependent joints.
    ///
    /// # Errors
    /// [`LoopError`] where the loops do not determine the dependent joints.
    pub(super) fn efforts(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        forces: &mut LinkForces,
        effort: &mut [f64],
    ) -> Result<(), LoopError> {
        let (q, qd, qdd) = (&self.q, &self.qd, &self.qdd);
        let tree = &mut self.tree;
        self.rnea.effort(robot, gravity_m_s2, q, qd, qdd, tree);
        for body in robot.bodies() {
            let rate = body.rate(qd);
            let resists = body.damping * rate + body.joint_friction().overcome_at(rate);
            tree[body.q_index] += body.gear * resists;
        }
        if forces.act() {
            self.pushed.fill(0.0);
            forces.add_efforts(robot, q, qd, &mut self.pushed);
            for (tree, pushed) in tree.iter_mut().zip(&self.pushed) {
                *tree -= pushed;
            }
        }
        if robot.loops().is_empty() {
            effort.copy_from_slice(tree);
            return Ok(());
        }
        effort.fill(0.0);
        let motions: DMatrix<f64> = independent_motions(robot, q)?;
        for (motion, index) in motions.column_iter().zip(robot.independent()) {
            let carried = motion
                .iter()
                .zip(&*tree)
                .map(|(rate, effort)| rate * effort);
            effort[*index] = carried.sum();
        }
        Ok(())
    }
}
