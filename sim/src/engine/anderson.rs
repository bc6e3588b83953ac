//! Anderson's acceleration of an iteration: the values of the next sweep, extrapolated from the last two.
//!
//! Sweeps over coupled contacts converge like a geometric series: an arm that pushes a can along a shelf needs 25 of them. What two
//! of them changed shows the ratio of the series and so where it ends. The values there are a better start of the next sweep, and nothing
//! more: what a sweep does and when the last one is done is as before.
//!
//! Source: Anderson, *Iterative procedures for nonlinear integral equations* (1965), with one earlier iterate; Walker & Ni, *Anderson
//! acceleration for fixed-point iterations* (2011).

/// Extrapolates no farther than this many times the last change.
const FARTHEST: f64 = 50.0;

/// An iteration over values `x`, with the `v` that follow from them linearly. Several `x` may have the same `v`, so its changes decide.
#[derive(Debug, Clone, Default)]
pub(super) struct Anderson {
    /// `v` before the next sweep.
    start: Vec<f64>,
    /// Whether there was a sweep before the next one; if so, its result and what it changed.
    has_last: bool,
    last_x: Vec<f64>,
    last_v: Vec<f64>,
    last_change: Vec<f64>,
    change: Vec<f64>,
    next_x: Vec<f64>,
}

impl Anderson {
    /// Starts an iteration at `v`.
    pub(super) fn start(&mut self, v: &[f64]) {
        self.has_last = false;
        self.start.clear();
        self.start.extend_from_slice(v);
    }

    /// Takes the result `x` of a sweep, and `v` with it, and moves both on to where they tend, if `allows` that `x`. Returns whether they
    /// were moved.
    pub(super) fn next(
        &mut self,
        x: &mut [f64],
        v: &mut [f64],
        allows: impl Fn(&[f64]) -> bool,
    ) -> bool {
        self.change.clear();
        let changes = v.iter().zip(&self.start).map(|(v, start)| v - start);
        self.change.extend(changes);
        let mut moved = false;
        if self.has_last
            && let Some(factor) = self.factor()
        {
            self.next_x.clear();
            let beyond = x.iter().zip(&self.last_x);
            self.next_x
                .extend(beyond.map(|(now, last)| now + factor * (now - last)));
            moved = allows(&self.next_x);
            if moved {
                self.last_x.copy_from_slice(x);
                x.copy_from_slice(&self.next_x);
                for (now, last) in v.iter_mut().zip(&mut self.last_v) {
                    let before = std::mem::replace(last, *now);
                    *now += factor * (*now - before);
                }
            }
        }
        if !moved {
            for (kept, list) in [(&mut self.last_x, &*x), (&mut self.last_v, &*v)] {
                kept.clear();
                kept.extend_from_slice(list);
            }
        }
        self.start.copy_from_slice(v);
        std::mem::swap(&mut self.change, &mut self.last_change);
        self.has_last = true;
        moved
    }

    /// How far beyond the last result the iteration tends, in units of the way from the one before; `None` if changes do not get smaller.
    fn factor(&self) -> Option<f64> {
        let (mut along, mut across, mut now, mut before) = (0.0, 0.0, 0.0, 0.0);
        for (change, last) in self.change.iter().zip(&self.last_change) {
            along -= change * (change - last);
            across += (change - last) * (change - last);
            now += change * change;
            before += last * last;
        }
        let factor = along / across;
        (now < before && factor.abs() <= FARTHEST).then_some(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sweeps of Gauss-Seidel over `matrix x = 1`, each step of which is noted in `v = matrix x`, until nothing changes by more than 1e-12.
    fn sweeps(matrix: [[f64; 3]; 3], accelerates: bool) -> (usize, [f64; 3]) {
        let mut x = [0.0; 3];
        let mut v = [0.0; 3];
        let mut anderson = Anderson::default();
        anderson.start(&v);
        for sweep in 1.. {
            let mut most = 0.0_f64;
            for i in 0..3 {
                let change = (1.0 - v[i]) / matrix[i][i];
                x[i] += change;
                for j in 0..3 {
                    v[j] += matrix[j][i] * change;
                }
                most = most.max(change.abs());
            }
            if most < 1e-12 {
                return (sweep, x);
            }
            if accelerates {
                anderson.next(&mut x, &mut v, |_| true);
            }
        }
        unreachable!()
    }

    #[test]
    fn a_slow_iteration_ends_at_the_same_values_much_sooner() {
        let coupled = [[2.0, 1.6, 0.3], [1.6, 2.0, 0.1], [0.3, 0.1, 1.0]];
        let (plain, expected) = sweeps(coupled, false);
        let (accelerated, found) = sweeps(coupled, true);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
        assert!(3 * accelerated < plain, "{accelerated} {plain}");
    }

    #[test]
    fn what_is_not_allowed_or_gets_no_better_stays() {
        let mut anderson = Anderson::default();
        anderson.start(&[0.0]);
        let mut next = |x: f64, allows: bool| {
            let (mut x, mut v) = ([x], [2.0 * x]);
            let moved = anderson.next(&mut x, &mut v, |_| allows);
            assert_eq!(v, [2.0 * x[0]]);
            (moved, x[0])
        };
        // 1, then half of that: the series ends at 2
        assert_eq!(next(1.0, true), (false, 1.0));
        assert_eq!(next(1.5, false), (false, 1.5));
        assert_eq!(next(1.75, true), (true, 2.0));
        // the sweep from there changes more than the one before
        assert_eq!(next(3.0, true), (false, 3.0));
    }
}
