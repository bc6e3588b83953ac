//! The two iterations of the textbooks, as they stand: full steps of the pseudo-inverse, or of damped least squares with one damping.
//!
//! Their faults are part of the lesson: the pseudo-inverse leaps near singular positions, and constant damping creeps. They run on
//! until the budget is used or the error is at rounding, and their answer is where they end.
//!
//! Source: Buss, *Introduction to inverse kinematics* (2009), eqs. 8 and 11, null-space term eq. 9.

use super::Posture;
use super::adaptive::Rules;
use super::ik_step::{PSEUDO_INVERSE_CUTOFF, StepRoom};
use super::system::{Residual, System};

/// Errors \[m, rad\] that another step would not make smaller.
const AT_ROUNDING: f64 = 1e-14;

/// Goes from `q` by pseudo-inverse steps (`damping` none) or steps damped by `damping` (`λ`); `q` is then where it ended, and what is
/// left there is returned with the steps taken.
pub(super) fn iterate(
    system: &mut System<'_>,
    room: &mut StepRoom,
    rules: &Rules<'_>,
    damping: Option<f64>,
    posture: Option<&Posture>,
    q: &mut [f64],
    before: &mut [f64],
) -> (Residual, usize) {
    let mut residual = system.place(q);
    let mut steps = 0;
    while steps < rules.steps {
        // a posture goes on pulling at a frame that has arrived
        if posture.is_none() && residual.within(AT_ROUNDING, AT_ROUNDING) {
            break;
        }
        if system.differentiate(q).is_err() {
            break;
        }
        let squared = damping.map_or(0.0, |damping| damping * damping);
        let damped = squared > 0.0 && room.damped(&system.jacobian, &system.error, squared, false);
        if !damped {
            room.pseudo_inverse(&system.jacobian, &system.error);
        }
        if let Some(posture) = posture {
            if damped {
                room.decomposition
                    .decompose(system.rows(), &system.jacobian);
            }
            let mut pull: Vec<f64> = system
                .unknowns
                .iter()
                .map(|&i| posture.gain * (posture.q[i] - q[i]))
                .collect();
            room.decomposition
                .project_to_null_space(PSEUDO_INVERSE_CUTOFF, &mut pull);
            for (step, pull) in room.step.iter_mut().zip(pull) {
                *step += pull;
            }
        }
        before.copy_from_slice(q);
        let moved = system.advance(&room.step, rules.limits, q);
        steps += 1;
        // a leap out of all numbers is not an answer; where it started from is
        if !moved || !q.iter().all(|x| x.is_finite()) {
            q.copy_from_slice(before);
            residual = system.place(q);
            break;
        }
        residual = system.place(q);
    }
    (residual, steps)
}
