//! Joint limits as hard stops without bounce: constraint efforts that hold a joint at its limit, impulses that stop a joint there.
//!
//! A joint at rest on its limit gets a one-sided constraint effort, computed once a step and held, as dry friction is. A joint that
//! reaches its limit within the step is set on it and loses its velocity into it; the impulse acts through the mass matrix, so that
//! the other joints feel it too. Both are found for all joints together by projected Gauss-Seidel. The time of the impact within the
//! step is not resolved, which leaves an error of first order in the step for each impact.
//!
//! Source: Stewart & Trinkle, *An implicit time-stepping scheme for rigid body dynamics* (1996), restricted to joint limits.

use nalgebra::{DMatrix, Vector3};

use crate::dynamics::ForwardDynamics;
use crate::dynamics::SingularMassMatrix;
use crate::kinematics::position_range::position_ranges;
use crate::model::robot::Robot;

/// Sweeps over the joints: on arms, more than enough for rounding.
const SWEEPS: usize = 40;

/// The position limits of one robot as unilateral constraints, with scratch memory.
#[derive(Debug, Clone)]
pub(crate) struct JointLimitConstraints {
    ranges: Vec<(f64, f64)>,
    dynamics: ForwardDynamics,
    accelerations: Vec<f64>,
    rates: Vec<f64>,
    efforts: Vec<f64>,
    impulses: Vec<f64>,
}

impl JointLimitConstraints {
    /// The position limits of the joints of `robot`, and of those that mimic them.
    pub(crate) fn new(robot: &Robot) -> Self {
        let zeros = vec![0.0; robot.n()];
        Self {
            ranges: position_ranges(robot)
                .iter()
                .map(|range| (range.lower, range.upper))
                .collect(),
            dynamics: ForwardDynamics::new(robot),
            accelerations: zeros.clone(),
            rates: zeros.clone(),
            efforts: zeros.clone(),
            impulses: zeros,
        }
    }

    /// The range of joint `i` at the end of a step that starts at `q`; a joint that starts outside its limits is not thrown back in.
    fn range(&self, i: usize, q: f64) -> (f64, f64) {
        let (lower, upper) = self.ranges[i];
        (lower.min(q), upper.max(q))
    }

    /// Whether a step from `q` may end at `next_q`.
    pub(crate) fn allow(&self, q: &[f64], next_q: &[f64]) -> bool {
        (0..q.len()).all(|i| {
            let (lower, upper) = self.range(i, q[i]);
            // NaN passes: the guard against divergence reports it
            !(next_q[i] < lower || upper < next_q[i])
        })
    }

    /// The impulses of the limits in the last step in which any acted, shape `(n)` \[N m s or N s\].
    pub(crate) fn impulses(&self) -> &[f64] {
        &self.impulses
    }

    /// Adds to `effort` the constraint efforts of the joints on their limits at `(q, qd)`, for a step of `dt_s`. In a step that takes
    /// damping implicitly, `added` is the inertia that it adds, shape `(n)`.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn hold(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        (dt_s, added): (f64, Option<&[f64]>),
        (q, qd): (&[f64], &[f64]),
        effort: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.efforts.fill(0.0);
        self.impulses.fill(0.0);
        let (dynamics, room) = (&mut self.dynamics, &mut self.accelerations);
        match added {
            None => dynamics.acceleration(robot, gravity_m_s2, q, qd, effort, room)?,
            Some(added) => {
                dynamics.acceleration_with(robot, gravity_m_s2, (q, qd), effort, added, room)?;
            }
        }
        let Some(inverse) = dynamics.inverse_inertia(robot, q, added) else {
            return Ok(());
        };
        let accelerated = qd.iter().zip(&self.accelerations);
        for (rate, (qd, qdd)) in self.rates.iter_mut().zip(accelerated) {
            *rate = qd + dt_s * qdd;
        }
        let at_limits = self.ranges.iter().zip(q);
        let signs: Vec<f64> = at_limits.map(|(range, q)| limit_sign(*range, *q)).collect();
        solve(inverse, dt_s, &signs, &mut self.rates, &mut self.efforts);
        for (i, constraint) in self.efforts.iter().enumerate() {
            effort[i] += constraint;
            self.impulses[i] = constraint * dt_s;
        }
        Ok(())
    }

    /// Sets joints that the engine's step from `q` took beyond their limits back on them without changing their velocities, and moves
    /// the state onto the loop-closure constraints.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn keep_inside(
        &mut self,
        robot: &Robot,
        q: &[f64],
        next_q: &mut [f64],
        next_qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        for i in 0..q.len() {
            let (lower, upper) = self.range(i, q[i]);
            if next_q[i] > upper {
                next_q[i] = upper;
            } else if next_q[i] < lower {
                next_q[i] = lower;
            }
        }
        self.dynamics.close_loops(robot, next_q, next_qd)
    }

    /// Lists the joints that are on a limit or beyond it at `q`.
    pub(crate) fn list_at_limit(&self, q: &[f64], joints: &mut Vec<usize>) {
        joints.extend((0..q.len()).filter(|&i| limit_sign(self.ranges[i], q[i]) != 0.0));
    }

    /// Sets the joints that a step from `q` took beyond their limits back on them, and removes their velocity into the limit. In a step that
    /// takes damping implicitly, `added` is the inertia that it adds, shape `(n)`: damping resists an impulse, too.
    pub(crate) fn catch(
        &mut self,
        robot: &Robot,
        q: &[f64],
        added: Option<&[f64]>,
        next_q: &mut [f64],
        next_qd: &mut [f64],
    ) {
        let n = q.len();
        let mut signs = vec![0.0; n];
        for i in 0..n {
            let (lower, upper) = self.range(i, q[i]);
            if next_q[i] >= upper {
                (next_q[i], signs[i]) = (upper, 1.0);
            } else if next_q[i] <= lower {
                (next_q[i], signs[i]) = (lower, -1.0);
            }
        }
        let Some(inverse) = self.dynamics.inverse_inertia(robot, next_q, added) else {
            return;
        };
        self.efforts.fill(0.0);
        solve(inverse, 1.0, &signs, next_qd, &mut self.efforts);
        for i in 0..n {
            self.impulses[i] += self.efforts[i];
            // removes the last rounding, so that a joint on its limit is exactly at rest
            if signs[i] * next_qd[i] > 0.0 {
                next_qd[i] = 0.0;
            }
        }
    }
}

/// 1 at or beyond the upper limit, -1 at or beyond the lower one, 0 between them.
fn limit_sign((lower, upper): (f64, f64), q: f64) -> f64 {
    if q >= upper {
        1.0
    } else if q <= lower {
        -1.0
    } else {
        0.0
    }
}

/// Finds one-sided efforts against `signs` that, held for `dt_s`, leave no joint a velocity into its limit.
fn solve(inverse: &DMatrix<f64>, dt_s: f64, signs: &[f64], rates: &mut [f64], efforts: &mut [f64]) {
    for _ in 0..SWEEPS {
        for i in 0..signs.len() {
            let per_effort = dt_s * inverse[(i, i)];
            if signs[i] == 0.0 || per_effort <= 0.0 {
                continue;
            }
            let wanted = efforts[i] - rates[i] / per_effort;
            // an upper limit only pushes down, a lower one only up
            let next = if signs[i] > 0.0 {
                wanted.min(0.0)
            } else {
                wanted.max(0.0)
            };
            let change = next - efforts[i];
            efforts[i] = next;
            for (j, rate) in rates.iter_mut().enumerate() {
                *rate += dt_s * inverse[(j, i)] * change;
            }
        }
    }
}
