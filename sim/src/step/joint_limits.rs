//! Joint limits as stops without bounce: what a joint on its limit is held by, and what a joint that runs into it loses.
//!
//! A joint that rests on its stop gets a held effort, one-sided and decided once a step, as dry friction is. A joint that reaches
//! its stop within the step is set on it and loses the speed it had into it; the impulse that takes it acts through the mass
//! matrix, so that the other joints feel it too. Both are found for all joints together by projected Gauss-Seidel. The time
//! within the step at which a stop is reached is not resolved, which leaves an error of first order in the step, once an impact.
//!
//! Source: Stewart & Trinkle, *An implicit time-stepping scheme for rigid body dynamics* (1996), restricted to joint limits.

use nalgebra::{DMatrix, Vector3};

use crate::dynamics::ForwardDynamics;
use crate::dynamics::SingularMassMatrix;
use crate::kinematics::position_range::position_ranges;
use crate::model::robot::Robot;

/// Sweeps over the joints: on arms, more than enough for rounding.
const SWEEPS: usize = 40;

/// The stops of one robot, and room to work out what they do.
#[derive(Debug, Clone)]
pub(crate) struct Stops {
    ranges: Vec<(f64, f64)>,
    dynamics: ForwardDynamics,
    accelerations: Vec<f64>,
    rates: Vec<f64>,
    efforts: Vec<f64>,
    impulses: Vec<f64>,
}

impl Stops {
    /// The stops of `robot`: the position limits of its joints and of those that mimic them.
    pub(crate) fn new(robot: &Robot) -> Self {
        let room = vec![0.0; robot.n()];
        Self {
            ranges: position_ranges(robot)
                .iter()
                .map(|range| (range.lower, range.upper))
                .collect(),
            dynamics: ForwardDynamics::new(robot),
            accelerations: room.clone(),
            rates: room.clone(),
            efforts: room.clone(),
            impulses: room,
        }
    }

    /// Where joint `i` may be at the end of a step that it starts at `q`: a joint that starts outside is not thrown back in.
    fn range(&self, i: usize, q: f64) -> (f64, f64) {
        let (lower, upper) = self.ranges[i];
        (lower.min(q), upper.max(q))
    }

    /// Whether a step from `q` may end at `next_q`.
    pub(crate) fn allow(&self, q: &[f64], next_q: &[f64]) -> bool {
        (0..q.len()).all(|i| {
            let (lower, upper) = self.range(i, q[i]);
            // NaN is for others to report
            !(next_q[i] < lower || upper < next_q[i])
        })
    }

    /// The impulses of the last step that a stop acted in, shape `(n)` \[N m s or N s\].
    pub(crate) fn impulses(&self) -> &[f64] {
        &self.impulses
    }

    /// Adds to `effort` what holds the joints that rest on their stops at `(q, qd)`, decided for a step of `dt_s`.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn hold(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        dt_s: f64,
        q: &[f64],
        qd: &[f64],
        effort: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.efforts.fill(0.0);
        self.impulses.fill(0.0);
        let dynamics = &mut self.dynamics;
        dynamics.acceleration(robot, gravity_m_s2, q, qd, effort, &mut self.accelerations)?;
        let Some(inverse) = dynamics.inverse_inertia(robot, q) else {
            return Ok(());
        };
        let accelerated = qd.iter().zip(&self.accelerations);
        for (rate, (qd, qdd)) in self.rates.iter_mut().zip(accelerated) {
            *rate = qd + dt_s * qdd;
        }
        let on_stop = self.ranges.iter().zip(q);
        let signs: Vec<f64> = on_stop.map(|(range, q)| pressed(*range, *q)).collect();
        solve(&inverse, dt_s, &signs, &mut self.rates, &mut self.efforts);
        for (i, held) in self.efforts.iter().enumerate() {
            effort[i] += held;
            self.impulses[i] = held * dt_s;
        }
        Ok(())
    }

    /// Sets joints that a step of others from `q` took beyond their stops back on them, leaves their speeds, and moves the state
    /// onto the conditions of the robot's loops.
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
        joints.extend((0..q.len()).filter(|&i| pressed(self.ranges[i], q[i]) != 0.0));
    }

    /// Sets the joints that a step from `q` took beyond their stops back on them, and takes their speed into the stop.
    pub(crate) fn catch(
        &mut self,
        robot: &Robot,
        q: &[f64],
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
        let Some(inverse) = self.dynamics.inverse_inertia(robot, next_q) else {
            return;
        };
        self.efforts.fill(0.0);
        solve(&inverse, 1.0, &signs, next_qd, &mut self.efforts);
        for i in 0..n {
            self.impulses[i] += self.efforts[i];
            // the last rounding, so that a joint on its stop rests exactly
            if signs[i] * next_qd[i] > 0.0 {
                next_qd[i] = 0.0;
            }
        }
    }
}

/// 1 on the upper stop, -1 on the lower one, 0 off both.
fn pressed((lower, upper): (f64, f64), q: f64) -> f64 {
    if q >= upper {
        1.0
    } else if q <= lower {
        -1.0
    } else {
        0.0
    }
}

/// Finds one-sided efforts against `signs` that, held for `dt_s`, leave no joint a rate into its stop.
fn solve(inverse: &DMatrix<f64>, dt_s: f64, signs: &[f64], rates: &mut [f64], efforts: &mut [f64]) {
    for _ in 0..SWEEPS {
        for i in 0..signs.len() {
            let per_effort = dt_s * inverse[(i, i)];
            if signs[i] == 0.0 || per_effort <= 0.0 {
                continue;
            }
            let wanted = efforts[i] - rates[i] / per_effort;
            // an upper stop only pushes down, a lower one only up
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
