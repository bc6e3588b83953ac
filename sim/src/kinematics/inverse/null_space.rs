//! Moving in the null space: a second wish is followed as far as frames that have arrived stay where they are.
//!
//! Each step is `J⁺ e + N d`, with `N = 1 - J⁺ J` of the first system and `d` the step of the wish, after which the first system is
//! brought back within its tolerance. A step that does not come nearer to the wish is halved.
//!
//! Source: Nakamura, Hanafusa & Yoshikawa, *Task-priority based redundancy control of robot manipulators* (1987), eqs. 5 and 9.

use super::Posture;
use super::adaptive::{Rules, descend};
use super::ik_step::StepRoom;
use super::system::System;
use crate::kinematics::position_range::PositionRange;

/// Singular values of the first system below this part of the largest do not hold the second back; larger than for a
/// pseudo-inverse, since a step along them would move the frames all the same.
const NULL_SPACE_CUTOFF: f64 = 1e-6;

/// The part of a wish that has to be gained for a step to be worth it.
const WORTHWHILE: f64 = 1e-6;

/// An objective that needs no further step.
const FULFILLED: f64 = 1e-22;

/// Halvings of a step before it is given up.
const HALVINGS: usize = 8;

/// Steps to bring the first system back within tolerance.
const RETURN_STEPS: usize = 10;

/// Greatest change of a joint in one step \[rad or m\].
const LARGEST_STEP: f64 = 0.3;

/// What is wanted beside the first system.
pub(super) enum Wish<'a, 'r> {
    /// Joints near given positions.
    Posture(&'a Posture),
    /// Other frames at their targets.
    System(&'a mut System<'r>, &'a mut StepRoom),
}

impl Wish<'_, '_> {
    /// What is to become small.
    fn objective(&mut self, unknowns: &[usize], q: &[f64]) -> f64 {
        match self {
            Self::Posture(posture) => {
                let off = unknowns.iter().map(|&i| posture.q[i] - q[i]);
                0.5 * off.map(|d| d * d).sum::<f64>()
            }
            Self::System(system, _) => system.place(q).objective,
        }
    }

    /// The step wanted at `q`, after the first system's own `step`; in its null space.
    fn add_step(
        &mut self,
        unknowns: &[usize],
        first: &StepRoom,
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
            Self::System(system, room) => {
                let objective = system.place(q).objective;
                if system.differentiate(q).is_err() {
                    return false;
                }
                let rows = system.rows();
                hold(&mut system.jacobian, rows, held);
                // what the first step already does for these frames is no longer asked
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
                if !room.damped(&system.jacobian, &system.error, damping, false) {
                    return false;
                }
                for (step, more) in step.iter_mut().zip(&room.step) {
                    *step += more;
                }
            }
        }
        true
    }
}

/// Goes on from `q`, where `system` is within tolerance, towards `wish`; `q` stays within tolerance and inside the limits. Returns the
/// steps taken. Nothing happens where `system` is not within tolerance.
pub(super) fn follow(
    system: &mut System<'_>,
    room: &mut StepRoom,
    rules: &Rules<'_>,
    mut wish: Wish<'_, '_>,
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
    let mut objective = wish.objective(&unknowns, q);
    while steps < rules.steps && objective > FULFILLED {
        let residual = system.place(q);
        if !residual.within(rules.tolerance_m, rules.tolerance_rad)
            || system.differentiate(q).is_err()
        {
            break;
        }
        steps += 1;
        if !step_inside(system, room, rules.limits, &mut wish, q, &mut step) {
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
            let (residual, _) = descend(system, room, &back, &mut trial, &mut spare);
            if !residual.within(rules.tolerance_m, rules.tolerance_rad) {
                continue;
            }
            let now = wish.objective(&unknowns, &trial);
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
/// whether the wish has a step.
fn step_inside(
    system: &mut System<'_>,
    room: &mut StepRoom,
    limits: Option<&[PositionRange]>,
    wish: &mut Wish<'_, '_>,
    q: &[f64],
    step: &mut [f64],
) -> bool {
    let rows = system.rows();
    let unknowns = &system.unknowns;
    // joints held at a limit take no part, in either system: found by trying, as the step decides which
    let mut held = vec![false; unknowns.len()];
    for _ in 0..=unknowns.len().min(8) {
        hold(&mut system.jacobian, rows, &held);
        room.pseudo_inverse(&system.jacobian, &system.error);
        step.copy_from_slice(&room.step);
        if !wish.add_step(unknowns, room, &held, q, step) {
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

/// Takes the joints that are held out of a stacked Jacobian.
fn hold(jacobian: &mut [f64], rows: usize, held: &[bool]) {
    for (column, held) in jacobian.chunks_exact_mut(rows).zip(held) {
        if *held {
            column.fill(0.0);
        }
    }
}
