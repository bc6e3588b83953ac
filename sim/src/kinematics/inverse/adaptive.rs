//! One start of damped least squares with damping by the error: strong far from the target and for unreachable targets, vanishing at
//! the solution, where the steps become Newton's.
//!
//! Source: Sugihara, *Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method* (2011), eq. 18, without its
//! constant bias; joint limits inside the step.

use super::ik_step::StepScratch;
use super::system::{Residual, System};
use crate::kinematics::position_range::PositionRange;

/// Damping `λ²` per half square of the error.
const DAMPING_PER_OBJECTIVE: f64 = 0.1;

/// Damping at the solution: far below any relevant singular value, far above rounding.
const LEAST_DAMPING: f64 = 1e-12;

/// Greatest change of a joint in one step \[rad or m\]: beyond it, the linearization is useless.
const LARGEST_STEP: f64 = 1.0;

/// A start is given up if the objective has not fallen to this fraction ...
const PROGRESS: f64 = 0.5;
/// ... in this many steps.
const PATIENCE: usize = 5;

/// Factor of the damping after a step that increases the objective, undone by steps that reduce it; for starts that are not given up.
const CAUTION: f64 = 4.0;

/// Least factor of the damping of such starts: where a residual remains, damping by the error alone would converge too slowly.
const LEAST_CAUTION: f64 = 1e-6;

/// Above this factor the steps are too small to change anything.
const MOST_CAUTION: f64 = 1e12;

/// Further steps within the tolerance, while each still improves: quadratic convergence reduces 1e-5 to rounding in two.
const POLISH_STEPS: usize = 3;

/// An objective that further steps would not improve: errors near 1e-11.
const POLISHED: f64 = 1e-22;

/// Budget, limits and tolerances of one start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules<'a> {
    pub(super) steps: usize,
    pub(super) tolerance_m: f64,
    pub(super) tolerance_rad: f64,
    pub(super) limits: Option<&'a [PositionRange]>,
    /// Whether a start that makes no progress is given up.
    pub(super) impatient: bool,
}

/// Iterates from `q` towards the targets; `q` is then the best configuration found. Returns its residual and the number of steps.
pub(super) fn descend(
    system: &mut System<'_>,
    scratch: &mut StepScratch,
    rules: &Rules<'_>,
    q: &mut [f64],
    best: &mut [f64],
) -> (Residual, usize) {
    let mut residual = system.place(q);
    let mut least = residual;
    best.copy_from_slice(q);
    let (mut steps, mut polished) = (0, 0);
    let (mut milestone, mut since) = (residual.objective, 0);
    let mut caution = 1.0;
    let least_caution = if rules.impatient { 1.0 } else { LEAST_CAUTION };
    while steps < rules.steps {
        if residual.within(rules.tolerance_m, rules.tolerance_rad) {
            if residual.objective <= POLISHED || polished == POLISH_STEPS {
                break;
            }
            polished += 1;
        } else if rules.impatient {
            if residual.objective <= PROGRESS * milestone {
                (milestone, since) = (residual.objective, 0);
            } else if since == PATIENCE {
                break;
            }
            since += 1;
        }
        if system.differentiate(q).is_err() {
            break;
        }
        for (k, &i) in system.unknowns.iter().enumerate() {
            (scratch.down[k], scratch.up[k]) = match rules.limits {
                None => (-LARGEST_STEP, LARGEST_STEP),
                Some(limits) => (
                    (limits[i].lower - q[i]).clamp(-LARGEST_STEP, 0.0),
                    (limits[i].upper - q[i]).clamp(0.0, LARGEST_STEP),
                ),
            };
        }
        let damping = caution * (DAMPING_PER_OBJECTIVE * residual.objective + LEAST_DAMPING);
        if !scratch.damped(&system.jacobian, &system.error, damping, true) {
            break;
        }
        if !system.advance(&scratch.step, rules.limits, q) {
            break;
        }
        steps += 1;
        residual = system.place(q);
        if residual.objective < least.objective {
            least = residual;
            best.copy_from_slice(q);
            caution = (caution / CAUTION).max(least_caution);
        } else if polished > 0 || !residual.objective.is_finite() {
            break;
        } else if !rules.impatient {
            // overshot, as happens with an unreachable target: back, and on with more damping
            caution *= CAUTION;
            if caution > MOST_CAUTION {
                break;
            }
            q.copy_from_slice(best);
            residual = system.place(q);
        }
    }
    q.copy_from_slice(best);
    (least, steps)
}
