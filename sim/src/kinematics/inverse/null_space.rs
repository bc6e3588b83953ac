//! Secondary tasks in the null space of a first system that is within its tolerance.
//!
//! Each step is `J⁺ e + N d`, with `N = 1 - J⁺ J` of the first system and `d` the step of the secondary task; then the first system is
//! brought back within its tolerance. A step that does not improve the secondary task is halved.
//!
//! Source: Nakamura, Hanafusa & Yoshikawa, *Task-priority based redundancy control of robot manipulators* (1987), eqs. 5 and 9.

use super::Posture;
use super::adaptive::{Rules, descend};
use super::ik_step::StepScratch;
use super::system::System;
use crate::kinematics::position_range::PositionRange;

/// Singular values of the first system below this fraction of the largest count as zero in the null-space projection. It is larger than
/// for a pseudo-inverse: a direction that is nearly in the null space is usable too.
const NULL_SPACE_CUTOFF: f64 = 1e-6;

/// Least relative improvement of the secondary task's objective for the iteration to go on.
const WORTHWHILE: f64 = 1e-6;

/// An objective below this needs no further step.
const FULFILLED: f64 = 1e-22;

/// Halvings of a step before it is given up.
const HALVINGS: usize = 8;

/// Steps to bring the first system back within tolerance.
const RETURN_STEPS: usize = 10;

/// Greatest change of a joint in one step \[rad or m\].
const LARGEST_STEP: f64 = 0.3;

/// A task of lower priority than the first system.
pub(super) enum SecondaryTask<'a, 'r> {
    /// Joints near given positions.
    Posture(&'a Posture),
    /// Other frames at their targets.
    System(&'a mut System<'r>, &'a mut StepScratch),
}

impl SecondaryTask<'_, '_> {
    /// The objective to minimize.
    fn objective(&mut self, unknowns: &[usize], q: &[f64]) -> f64 {
        match self {
            Self::Posture(posture) => {
                let off = unknowns.iter().map(|&i| posture.q[i] - q[i]);
                0.5 * off.map(|d| d * d).sum::<f64>()
            }
            Self::System(system, _) => system.place(q).objective,
        }
    }

    /// Adds to the first system's `step` the step of this task at `q`, projected on the null space; false if there is none.
    fn add_step(
        &mut self,
        unknowns: &[usize],
        first: &StepScratch,
        held: &[bool],
        q: &[f64],
        step: &mut [f64],
    ) -> bool {
        let null = |x: &mut [f64]| {
            first
                .decomposition
                .project_to_null_space(NULL_SPACE_CUTOFF, x);
        };
        match self {
            Self::Posture(posture) => {
                let mut pull: Vec<f64> = unknowns
                    .iter()
                    .zip(held)
                    .map(|(&i, held)| {
                        if *held {
                            0.0
                        } else {
                            posture.gain * (posture.q[i] - q[i])
                        }
                    })
                    .collect();
                null(&mut pull);
                for (step, pull) in step.iter_mut().zip(pull) {
                    *step += pull;
                }
            }
            Self::System(system, scratch) => {
                let objective = system.place(q).objective;
                if system.differentiate(q).is_err() {
                    return false;
                }
                let rows = system.rows();
                hold(&mut system.jacobian, rows, held);
                // the first system's step already reduces part of the error
                for (column, step) in system.jacobian.chunks_exact(rows).zip(step.iter()) {
                    for (e, slope) in system.error.iter_mut().zip(column) {
                        *e -= slope * step;
                    }
                }
                let mut row = vec![0.0; unknowns.len()];
                for i in 0..rows {
                    for (x, column) in row.iter_mut().zip(system.jacobian.chunks_exact(rows)) {
                        *x = column[i];
                    }
                    null(&mut row);
                    for (x, column) in row.iter().zip(system.jacobian.chunks_exact_mut(rows)) {
                        column[i] = *x;
                    }
                }
                let damping = 0.1 * objective + 1e-9;
                if !scratch.damped(&system.jacobian, &system.error, damping, false) {
                    return false;
                }
                for (step, more) in step.iter_mut().zip(&scratch.step) {
                    *step += more;
                }
            }
        }
        true
    }
}

/// Improves `secondary` from `q`, with `system` within its tolerance and the joints inside the limits throughout. Returns the number of
/// steps. Does nothing if `system` is not within its tolerance at `q`.
pub(super) fn follow(
    system: &mut System<'_>,
    scratch: &mut StepScratch,
    rules: &Rules<'_>,
    mut secondary: SecondaryTask<'_, '_>,
    q: &mut [f64],
) -> usize {
    let unknowns = system.unknowns.clone();
    let mut trial = q.to_vec();
    let mut spare = q.to_vec();
    let mut step = vec![0.0; unknowns.len()];
    let back = Rules {
        steps: RETURN_STEPS,
        impatient: false,
        ..*rules
    };
    let mut steps = 0;
    let mut objective = secondary.objective(&unknowns, q);
    while steps < rules.steps && objective > FULFILLED {
        let residual = system.place(q);
        if !residual.within(rules.tolerance_m, rules.tolerance_rad)
            || system.differentiate(q).is_err()
        {
            break;
        }
        steps += 1;
        if !step_inside(system, scratch, rules.limits, &mut secondary, q, &mut step) {
            return steps;
        }
        let largest = step.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let mut part = (LARGEST_STEP / largest).min(1.0);
        let mut nearer = false;
        for _ in 0..HALVINGS {
            trial.copy_from_slice(q);
            let scaled: Vec<f64> = step.iter().map(|s| part * s).collect();
            part *= 0.5;
            if !system.advance(&scaled, rules.limits, &mut trial) {
                continue;
            }
            let (residual, _) = descend(system, scratch, &back, &mut trial, &mut spare);
            if !residual.within(rules.tolerance_m, rules.tolerance_rad) {
                continue;
            }
            let now = secondary.objective(&unknowns, &trial);
            if now < objective {
                nearer = now <= (1.0 - WORTHWHILE) * objective;
                objective = now;
                q.copy_from_slice(&trial);
                break;
            }
        }
        if !nearer {
            break;
        }
    }
    steps
}

/// Writes the step of both systems at `q`, where the first is differentiated, such that no joint at a limit goes beyond it. Returns
/// whether the secondary task has a step.
fn step_inside(
    system: &mut System<'_>,
    scratch: &mut StepScratch,
    limits: Option<&[PositionRange]>,
    secondary: &mut SecondaryTask<'_, '_>,
    q: &[f64],
    step: &mut [f64],
) -> bool {
    let rows = system.rows();
    let unknowns = &system.unknowns;
    // joints at a limit are locked in both systems; which ones depends on the step, so this is an iteration
    let mut held = vec![false; unknowns.len()];
    for _ in 0..=unknowns.len().min(8) {
        hold(&mut system.jacobian, rows, &held);
        scratch.pseudo_inverse(&system.jacobian, &system.error);
        step.copy_from_slice(&scratch.step);
        if !secondary.add_step(unknowns, scratch, &held, q, step) {
            return false;
        }
        let mut met = false;
        if let Some(limits) = limits {
            for (k, &i) in unknowns.iter().enumerate() {
                let outward = (q[i] <= limits[i].lower && step[k] < 0.0)
                    || (q[i] >= limits[i].upper && step[k] > 0.0);
                if outward && !held[k] {
                    held[k] = true;
                    met = true;
                }
                if held[k] {
                    step[k] = 0.0;
                }
            }
        }
        if !met {
            break;
        }
    }
    true
}

/// Sets the columns of locked joints in a stacked Jacobian to zero.
fn hold(jacobian: &mut [f64], rows: usize, held: &[bool]) {
    for (column, held) in jacobian.chunks_exact_mut(rows).zip(held) {
        if *held {
            column.fill(0.0);
        }
    }
}
