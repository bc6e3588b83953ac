//! One step of the joints towards a target: damped least squares inside bounds, or the pseudo-inverse.
//!
//! With `J` of few rows and any number of columns, the damped step is `Jᵀ (J Jᵀ + λ² 1)⁻¹ e`: a small symmetric system, solved by
//! LDLᵀ. A joint that the step would take beyond its bound is clamped there, and the others compensate.
//!
//! Source: Buss, *Introduction to inverse kinematics* (2009), eq. 11 and sec. 6.

use crate::kinematics::singular_values::RowJacobi;

/// Singular values below this fraction of the largest count as zero in a pseudo-inverse.
pub(super) const PSEUDO_INVERSE_CUTOFF: f64 = 1e-10;

/// Number of times a step is solved again because joints reached their bounds.
const BOUND_ROUNDS: usize = 4;

/// Scratch memory of one step; nothing is allocated once it has the size of the system.
#[derive(Debug, Clone, Default)]
pub(super) struct StepScratch {
    /// The step of each unknown \[rad or m\].
    pub(super) step: Vec<f64>,
    /// Bounds of the step of each unknown, negative and positive; used only by a bounded step.
    pub(super) down: Vec<f64>,
    pub(super) up: Vec<f64>,
    stopped: Vec<bool>,
    rest: Vec<f64>,
    normal: Vec<f64>,
    solution: Vec<f64>,
    pub(super) decomposition: RowJacobi,
}

impl StepScratch {
    pub(super) fn new(rows: usize, unknowns: usize) -> Self {
        Self {
            step: vec![0.0; unknowns],
            down: vec![f64::NEG_INFINITY; unknowns],
            up: vec![f64::INFINITY; unknowns],
            stopped: vec![false; unknowns],
            rest: vec![0.0; rows],
            normal: vec![0.0; rows * rows],
            solution: vec![0.0; rows],
            decomposition: RowJacobi::default(),
        }
    }

    /// Sets `step` to the damped step for the error `e`, with `damping` as `λ²`; inside `down` and `up` if `bounded`. Returns false if
    /// there is none: in a singular configuration without damping, or with NaN.
    pub(super) fn damped(
        &mut self,
        jacobian: &[f64],
        e: &[f64],
        damping: f64,
        bounded: bool,
    ) -> bool {
        // rows of the common targets as constants: the loops over them unroll
        match e.len() {
            3 => self.damped_rows(3, jacobian, e, damping, bounded),
            6 => self.damped_rows(6, jacobian, e, damping, bounded),
            rows => self.damped_rows(rows, jacobian, e, damping, bounded),
        }
    }

    #[inline(always)]
    fn damped_rows(
        &mut self,
        rows: usize,
        jacobian: &[f64],
        e: &[f64],
        damping: f64,
        bounded: bool,
    ) -> bool {
        let unknowns = self.step.len();
        if rows == 0 || unknowns == 0 {
            self.step.fill(0.0);
            return true;
        }
        let jacobian = &jacobian[..rows * unknowns];
        let (rest, normal, y) = (
            &mut self.rest[..rows],
            &mut self.normal[..rows * rows],
            &mut self.solution[..rows],
        );
        rest.copy_from_slice(&e[..rows]);
        self.stopped.fill(false);
        for round in 0..BOUND_ROUNDS {
            normal.fill(0.0);
            for i in 0..rows {
                normal[i * rows + i] = damping;
            }
            for (column, stopped) in jacobian.chunks_exact(rows).zip(&self.stopped) {
                if !stopped {
                    for i in 0..rows {
                        for j in 0..=i {
                            normal[i * rows + j] += column[i] * column[j];
                        }
                    }
                }
            }
            y.copy_from_slice(rest);
            if !solve_symmetric(rows, normal, y) {
                return false;
            }
            let mut met = false;
            for (k, column) in jacobian.chunks_exact(rows).enumerate() {
                if self.stopped[k] {
                    continue;
                }
                let mut step = 0.0;
                for i in 0..rows {
                    step += column[i] * y[i];
                }
                if bounded && !(self.down[k] <= step && step <= self.up[k]) {
                    step = step.max(self.down[k]).min(self.up[k]);
                    self.stopped[k] = true;
                    met = true;
                    for i in 0..rows {
                        rest[i] -= column[i] * step;
                    }
                }
                self.step[k] = step;
            }
            if !met || round + 1 == BOUND_ROUNDS {
                break;
            }
        }
        true
    }

    /// Sets `step` to the pseudo-inverse times the error `e`; keeps the decomposition for projections on the null space.
    pub(super) fn pseudo_inverse(&mut self, jacobian: &[f64], e: &[f64]) {
        self.step.fill(0.0);
        self.decomposition.decompose(e.len(), jacobian);
        self.decomposition
            .add_pseudo_inverse(e, PSEUDO_INVERSE_CUTOFF, &mut self.step);
    }
}

/// Solves `a x = b` in place for symmetric positive `a`, of which the lower triangle is read and overwritten: LDLᵀ without pivots.
/// False unless every pivot is positive.
#[inline(always)]
fn solve_symmetric(n: usize, a: &mut [f64], b: &mut [f64]) -> bool {
    for j in 0..n {
        let pivot = a[j * n + j];
        // NaN is not positive either
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let inverse = 1.0 / pivot;
        for i in j + 1..n {
            let l = a[i * n + j] * inverse;
            for k in j + 1..=i {
                a[i * n + k] -= l * a[k * n + j];
            }
            b[i] -= l * b[j];
        }
        // the column stays unscaled for the rows above; its own unknown is finished in the back substitution
        b[j] *= inverse;
        for i in j + 1..n {
            a[i * n + j] *= inverse;
        }
    }
    for j in (0..n).rev() {
        for i in j + 1..n {
            b[j] -= a[i * n + j] * b[i];
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symmetric_system_worked_by_hand() {
        // [[4, 2], [2, 3]] x = [8, 7] has x = [1.25, 1.5]
        let mut b = [8.0, 7.0];
        assert!(solve_symmetric(2, &mut [4.0, 0.0, 2.0, 3.0], &mut b));
        assert_eq!(b, [1.25, 1.5]);
        assert!(!solve_symmetric(
            2,
            &mut [1.0, 0.0, 1.0, 1.0],
            &mut [1.0, 1.0]
        ));
        assert!(!solve_symmetric(1, &mut [f64::NAN], &mut [1.0]));
        // three unknowns: A = L D Lᵀ with L = [[1], [2, 1], [3, 4, 1]], D = (1, 2, 3), x = (1, 1, 1)
        let mut a = [1.0, 0.0, 0.0, 2.0, 6.0, 0.0, 3.0, 14.0, 44.0];
        let mut b = [6.0, 22.0, 61.0];
        assert!(solve_symmetric(3, &mut a, &mut b));
        assert_eq!(b, [1.0; 3]);
    }

    #[test]
    fn other_joints_compensate_for_a_joint_at_its_bound() {
        // x + y = 2 with x at most 0.5
        let mut scratch = StepScratch::new(1, 2);
        scratch.up[0] = 0.5;
        assert!(scratch.damped(&[1.0, 1.0], &[2.0], 0.0, true));
        assert_eq!(scratch.step, [0.5, 1.5]);
        assert!(scratch.damped(&[1.0, 1.0], &[2.0], 0.0, false));
        assert_eq!(scratch.step, [1.0, 1.0]);
        // damping 2 halves what two joints of slope one do
        assert!(scratch.damped(&[1.0, 1.0], &[2.0], 2.0, false));
        assert_eq!(scratch.step, [0.5, 0.5]);
    }

    #[test]
    fn the_pseudo_inverse_is_the_damped_step_without_damping() {
        let jacobian = [1.0, 0.2, -0.3, 0.5, 0.1, 0.9, 0.4, 0.4, 0.4, -0.6, 0.7, 0.2];
        let e = [0.3, -0.1, 0.8];
        let mut scratch = StepScratch::new(3, 4);
        assert!(scratch.damped(&jacobian, &e, 0.0, false));
        let damped = scratch.step.clone();
        scratch.pseudo_inverse(&jacobian, &e);
        for (a, b) in damped.iter().zip(&scratch.step) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}
