//! The error that one smooth step makes, estimated by step doubling: the same step once more, in two halves under the same efforts.
//!
//! The difference is 15/16 of the error of a step of order four. Dry friction is decided once, for the whole step, so that what differs
//! is integration alone.
//!
//! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I* (1993), sec. II.4.

use nalgebra::Vector3;

use super::smooth::SmoothStep;
use crate::dynamics::SingularMassMatrix;
use crate::model::air::AirNow;
use crate::model::push::Push;
use crate::model::robot::Robot;

/// Whole per difference of a step and its two halves: `2⁴ / (2⁴ - 1)`.
const RICHARDSON: f64 = 16.0 / 15.0;

/// Estimates errors of steps of one robot, with scratch memory.
#[derive(Debug, Clone)]
pub(crate) struct LocalError {
    whole: SmoothStep,
    half: SmoothStep,
    /// Ends of the whole step and of the halves: positions and velocities.
    once: [Vec<f64>; 2],
    twice: [Vec<f64>; 2],
}

impl LocalError {
    /// For steps of `dt_s` of `robot` under `gravity_m_s2` (world).
    pub(crate) fn new(robot: &Robot, gravity_m_s2: Vector3<f64>, dt_s: f64) -> Self {
        let room = || [vec![0.0; robot.n()], vec![0.0; robot.n()]];
        Self {
            whole: SmoothStep::new(robot, gravity_m_s2, dt_s),
            half: SmoothStep::new(robot, gravity_m_s2, 0.5 * dt_s),
            once: room(),
            twice: room(),
        }
    }

    /// Whether a step from `q` takes damping implicitly.
    pub(crate) fn is_implicit(&mut self, robot: &Robot, q: &[f64]) -> bool {
        self.whole.damping_inertia(robot, q).is_some()
    }

    /// Sets the air and the pushes of the following steps; initially there are none.
    pub(crate) fn set_forces<'p>(
        &mut self,
        robot: &Robot,
        air: Option<AirNow>,
        pushes: impl Iterator<Item = &'p Push>,
    ) {
        self.whole.set_air(air);
        self.whole.set_pushes(robot, pushes);
    }

    /// The errors of the velocities after a step from `(q, qd)` under `effort`, with their signs, in the order of `q`
    /// \[rad/s or m/s\]; all slices have shape `(n)`.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn velocities(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        (q, qd): (&[f64], &[f64]),
    ) -> Result<impl Iterator<Item = f64> + '_, SingularMassMatrix> {
        for [end_q, end_qd] in [&mut self.once, &mut self.twice] {
            end_q.copy_from_slice(q);
            end_qd.copy_from_slice(qd);
        }
        let [end_q, end_qd] = &mut self.once;
        self.whole.advance(robot, effort, end_q, end_qd)?;
        let [end_q, end_qd] = &mut self.twice;
        for _ in 0..2 {
            self.half.advance_like(&self.whole, robot, end_q, end_qd)?;
        }
        let ends = self.once[1].iter().zip(&self.twice[1]);
        Ok(ends.map(|(once, twice)| RICHARDSON * (once - twice)))
    }
}
