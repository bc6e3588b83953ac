//! From one closed configuration to another: Newton iteration at one configuration, and continuation in small steps along the tangent.

use nalgebra::{DMatrix, DVector};

use super::CLOSED;
use super::constraints::Closure;
use super::least_squares::least_squares;
use super::loop_error::LoopError;
use crate::model::robot::Robot;

/// Greatest step of an independent joint while its loop is followed \[rad or m\].
const FOLLOW_STEP: f64 = 0.05;

/// Loops are followed at most this far from their start: 100 turns \[rad or m\].
pub(super) const FURTHEST: f64 = 630.0;

/// Halvings of a step before a target is given up.
const HALVINGS: u32 = 12;

/// Newton steps for one configuration; the iteration converges quadratically or not at all.
const NEWTON_STEPS: usize = 30;

/// Steps of the search for the least gap, which is only used in messages.
const NEAREST_STEPS: usize = 200;

/// A gap below this counts as closed in this search, which converges slowly where a loop can only just be closed \[m or rad\].
const ONCE_CLOSED: f64 = 1e-8;

impl Closure {
    /// Closes all loops by the joints `free` alone, starting from `q`.
    pub(crate) fn newton(
        &mut self,
        robot: &Robot,
        free: &[usize],
        q: &mut [f64],
    ) -> Result<(), LoopError> {
        let still = vec![0.0; robot.n()];
        let mut before = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            self.update(robot, q, &still);
            let (gap_m, angle_rad) = self.errors(robot);
            let worst = gap_m.max(angle_rad);
            // converged to rounding: the next step would not help
            if worst <= CLOSED && (worst <= 1e-15 || worst >= 0.5 * before) {
                return Ok(());
            }
            before = worst;
            let step = least_squares(self.columns(free), &self.residual);
            // far off, a full step may leave for another branch
            let scale = (0.5 / step.amax()).min(1.0);
            if !scale.is_finite() && step.amax() != 0.0 {
                break;
            }
            for (&i, change) in free.iter().zip(step.iter()) {
                q[i] -= scale.min(1.0) * change;
            }
        }
        self.update(robot, q, &still);
        let (gap_m, angle_rad) = self.errors(robot);
        if gap_m <= CLOSED && angle_rad <= CLOSED {
            Ok(())
        } else {
            Err(LoopError::Open { gap_m, angle_rad })
        }
    }

    /// Closes the loops as far as the joints `free` can, from `q`; returns the remaining gap \[m\] and angle \[rad\].
    ///
    /// Source: Levenberg-Marquardt damping, increased until a step reduces the squared residual of the constraints.
    fn nearest(&mut self, robot: &Robot, free: &[usize], q: &mut [f64]) -> (f64, f64) {
        let still = vec![0.0; robot.n()];
        self.update(robot, q, &still);
        let (mut left, mut damping) = (self.residual.norm_squared(), 1e-3);
        let mut trial = q.to_vec();
        for _ in 0..NEAREST_STEPS {
            let columns = self.columns(free);
            let k = free.len();
            let normal = DMatrix::from_fn(k, k, |i, j| {
                let along = columns.column(i).dot(&columns.column(j));
                if i == j { along + damping } else { along }
            });
            let slope = DVector::from_fn(k, |i, _| columns.column(i).dot(&self.residual));
            let Some(factor) = normal.cholesky() else {
                break;
            };
            let step = factor.solve(&slope);
            trial.copy_from_slice(q);
            for (&i, change) in free.iter().zip(step.iter()) {
                trial[i] -= change;
            }
            self.update(robot, &trial, &still);
            let then = self.residual.norm_squared();
            if then < left {
                q.copy_from_slice(&trial);
                (left, damping) = (then, 0.2 * damping);
            } else {
                damping *= 5.0;
                self.update(robot, q, &still);
            }
        }
        self.errors(robot)
    }

    /// Follows the loops from the closed configuration `q` to the independent positions `target`, shape `(independent)`; `q` is then
    /// the closed configuration there.
    pub(crate) fn follow(
        &mut self,
        robot: &Robot,
        target: &[f64],
        q: &mut [f64],
    ) -> Result<(), LoopError> {
        let independent = robot.independent();
        let start: Vec<f64> = independent.iter().map(|&i| q[i]).collect();
        let far =
            start
                .iter()
                .zip(target)
                .map(|(a, b)| (b - a).abs())
                .fold(
                    0.0,
                    |far: f64, distance| if distance <= far { far } else { distance },
                );
        if far.is_nan() || far > FURTHEST {
            return Err(LoopError::TooFar { far });
        }
        let longest = 1.0 / (far / FOLLOW_STEP).ceil().max(1.0);
        // after so many halvings the path ends here: the fraction done no longer grows
        let shortest = longest / f64::from(1_u32 << HALVINGS);
        let (mut done, mut step) = (0.0_f64, longest);
        let mut trial = q.to_vec();
        while done < 1.0 {
            let next = (done + step).min(1.0);
            let tangent = self.tangent(robot, q, &start, target);
            trial.copy_from_slice(q);
            for (k, &i) in independent.iter().enumerate() {
                trial[i] = if next >= 1.0 {
                    target[k]
                } else {
                    start[k] + next * (target[k] - start[k])
                };
            }
            for (&i, slope) in robot.dependent().iter().zip(tangent.iter()) {
                trial[i] += (next - done) * slope;
            }
            let predicted = trial.clone();
            let closed = self.newton(robot, robot.dependent(), &mut trial);
            // a correction as large as the step itself has left the branch
            let corrected = (0..q.len())
                .map(|i| (trial[i] - predicted[i]).abs())
                .fold(0.0, f64::max);
            let moved = FOLLOW_STEP.max(
                (0..q.len())
                    .map(|i| (predicted[i] - q[i]).abs())
                    .fold(0.0, f64::max),
            );
            if closed.is_ok() && corrected <= 0.5 * moved {
                q.copy_from_slice(&trial);
                done = next;
                step = (2.0 * step).min(longest);
            } else {
                step *= 0.5;
                if step < shortest {
                    return Err(self.blocked(robot, target, q));
                }
            }
        }
        Ok(())
    }

    /// Why `target` was not reached, given the last closed configuration `q` on the way there.
    fn blocked(&mut self, robot: &Robot, target: &[f64], q: &[f64]) -> LoopError {
        let mut least = (f64::INFINITY, f64::INFINITY);
        // from the current dependent positions, or from those at home
        for from in [q, robot.home()] {
            let mut there = from.to_vec();
            for (&i, position) in robot.independent().iter().zip(target) {
                there[i] = *position;
            }
            let left = self.nearest(robot, robot.dependent(), &mut there);
            if left.0.max(left.1) < least.0.max(least.1) {
                least = left;
            }
        }
        let (gap_m, angle_rad) = least;
        if gap_m.max(angle_rad) <= ONCE_CLOSED {
            LoopError::Apart
        } else {
            LoopError::Open { gap_m, angle_rad }
        }
    }

    /// Rates of the dependent joints while the independent ones move from `start` to `target` in unit time.
    fn tangent(&mut self, robot: &Robot, q: &[f64], start: &[f64], target: &[f64]) -> DVector<f64> {
        let mut qd = vec![0.0; robot.n()];
        for (k, &i) in robot.independent().iter().enumerate() {
            qd[i] = target[k] - start[k];
        }
        self.update(robot, q, &vec![0.0; robot.n()]);
        let pull = &self.jacobian * DVector::from_vec(qd);
        -least_squares(self.columns(robot.dependent()), &pull)
    }
}
