//! The two iterations of the textbooks, unchanged: full steps of the pseudo-inverse, or of damped least squares with constant damping.
//!
//! Their weaknesses are part of the lesson: the pseudo-inverse takes huge steps near singular configurations, and constant damping
//! converges slowly. They run until the budget is used or the error is at rounding, and return the last iterate.
//!
//! Source: Buss, *Introduction to inverse kinematics* (2009), eqs. 8 and 11, null-space term eq. 9.

use super::Posture;
use super::adaptive::Rules;
use super::ik_step::{PSEUDO_INVERSE_CUTOFF, StepScratch};
use super::system::{Residual, System};

/// Errors below this \[m, rad\] are rounding: another step would not reduce them.
const AT_ROUNDING: f64 = 1e-14;

/// Iterates from `q` by pseudo-inverse steps (without `damping`) or steps damped by `damping` (`λ`); `q` is then the last iterate.
/// Returns its residual and the number of steps.
pub(super) fn iterate(
    system: &mut System<'_>,
    scratch: &mut StepScratch,
    rules: &Rules<'_>,
    damping: Option<f64>,
    posture: Option<&Posture>,
    q: &mut [f64],
    before: &mut [f64],
) -> (Residual, usize) {
    let mut residual = system.place(q);
    let mut steps = 0;
    while steps < rules.steps {
        // a posture still acts when the frame is at its target
        if posture.is_none() && residual.within(AT_ROUNDING, AT_ROUNDING) {
            break;
        }
        if system.differentiate(q).is_err() {
            break;
        }
        let squared = damping.map_or(0.0, |damping| damping * damping);
        let damped =
            squared > 0.0 && scratch.damped(&system.jacobian, &system.error, squared, false);
        if !damped {
            scratch.pseudo_inverse(&system.jacobian, &system.error);
        }
        if let Some(posture) = posture {
            if damped {
                scratch
                    .decomposition
                    .decompose(system.rows(), &system.jacobian);
            }
            let mut pull: Vec<f64> = system
                .unknowns
                .iter()
                .map(|&i| posture.gain * (posture.q[i] - q[i]))
                .collect();
            scratch
                .decomposition
                .project_to_null_space(PSEUDO_INVERSE_CUTOFF, &mut pull);
            for (step, pull) in scratch.step.iter_mut().zip(pull) {
                *step += pull;
            }
        }
        before.copy_from_slice(q);
        let moved = system.advance(&scratch.step, rules.limits, q);
        steps += 1;
        // a step that overflows is undone
        if !moved || !q.iter().all(|x| x.is_finite()) {
            q.copy_from_slice(before);
            residual = system.place(q);
            break;
        }
        residual = system.place(q);
    }
    (residual, steps)
}
