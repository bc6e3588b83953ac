//! Friction of one contact point, given its normal impulse: the impulse within a disk that leaves the least kinetic energy.
//!
//! At the minimum the point either sticks, or the impulse is at the edge of the disk and exactly opposes the velocity that remains,
//! whatever the effective masses along the two axes: `(W + s 1) p = -c` with `s >= 0` means `c + W p = -s p`. (To bring a solution of
//! two masses back to the disk along its own direction would make friction oppose the momentum instead.)
//!
//! Source: the trust-region subproblem, Moré & Sorensen, *Computing a trust region step* (1983), here with two unknowns.

/// Newton's iteration gains digits quadratically; this many are never needed.
const STEPS: usize = 30;
/// A step of the iteration by this part of what it looks for leaves less than rounding, and is the last.
const LAST: f64 = 1e-8;
/// A direction that answers less than this part of the other one counts as answering so much.
const IMMOVABLE: f64 = 1e-12;

/// What velocities along two axes answer to impulses along them: `W = [[a, b], [b, d]]`, symmetric and positive definite.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Response {
    /// `a`, `b` and `d`.
    pub(super) entries: [f64; 3],
    /// The same of the inverse; none where rounding decides it.
    inverse: Option<[f64; 3]>,
    /// Unit vector along the axis that answers most.
    axis: [f64; 2],
    /// What that axis answers, and the one across.
    along: [f64; 2],
    /// The inverses of both.
    per_along: [f64; 2],
}

impl Response {
    pub(super) fn new([a, b, d]: [f64; 3]) -> Self {
        let determinant = a * d - b * b;
        let inverse = (determinant > 1e-9 * a * d)
            .then(|| [d / determinant, -b / determinant, a / determinant]);
        let mean = 0.5 * (a + d);
        let half = 0.5 * (a - d);
        let apart = (half * half + b * b).sqrt();
        let most = mean + apart;
        // along the second axis nothing may be able to move
        let along = [most, (mean - apart).max(IMMOVABLE * most)];
        Self {
            entries: [a, b, d],
            inverse,
            axis: principal(half, b, apart),
            along,
            per_along: along.map(|answer| 1.0 / answer),
        }
    }

    /// What an impulse changes.
    pub(super) fn times(&self, p: [f64; 2]) -> [f64; 2] {
        times(self.entries, p)
    }

    /// The impulse `p` with `|p| <= radius` that minimises `pᵀ W p / 2 + cᵀ p`.
    ///
    /// `edge` is where the search for `s` starts, if it is above zero, and becomes what was found: from one call to the next little
    /// changes.
    pub(super) fn friction(&self, c: [f64; 2], radius: f64, edge: &mut f64) -> [f64; 2] {
        if radius <= 0.0 || self.along[0] <= 0.0 {
            return [0.0; 2];
        }
        let within = |p: [f64; 2]| p[0] * p[0] + p[1] * p[1] <= radius * radius;
        // in the axes of W: |p|² = Σ (cᵢ / (wᵢ + s))²
        let (axis, w) = (self.axis, self.along);
        let along = [
            axis[0] * c[0] + axis[1] * c[1],
            axis[0] * c[1] - axis[1] * c[0],
        ];
        let in_world = |p: [f64; 2]| {
            [
                axis[0] * p[0] - axis[1] * p[1],
                axis[1] * p[0] + axis[0] * p[1],
            ]
        };
        if let Some(inverse) = self.inverse {
            let p = times(inverse, [-c[0], -c[1]]);
            if within(p) {
                return p;
            }
        } else {
            let p = [0, 1].map(|i| -along[i] * self.per_along[i]);
            if within(p) {
                return in_world(p);
            }
        }
        let per_radius = 1.0 / radius;
        // bounds of s from |c| / (w + s) = radius; from below the iteration is monotone, and from above its first step leads below
        let whole = (along[0] * along[0] + along[1] * along[1]).sqrt() * per_radius;
        let least = (whole - w[0]).max(0.0);
        let mut s = edge.min(whole - w[1]).max(least);
        for _ in 0..STEPS {
            let per = [1.0 / (w[0] + s), 1.0 / (w[1] + s)];
            let p = [along[0] * per[0], along[1] * per[1]];
            let squares = [p[0] * p[0], p[1] * p[1]];
            let square = squares[0] + squares[1];
            let slope = squares[0] * per[0] + squares[1] * per[1];
            // the inverse norm is almost linear in s
            let change = (square.sqrt() * per_radius - 1.0) * square / slope;
            if !change.is_finite() {
                break;
            }
            s = (s + change).max(least);
            if change.abs() <= LAST * (s + w[0]) {
                break;
            }
        }
        *edge = s;
        // the direction alone: the length is known
        let p = in_world([-along[0] * (w[1] + s), -along[1] * (w[0] + s)]);
        let to_edge = radius / (p[0] * p[0] + p[1] * p[1]).sqrt();
        if to_edge.is_finite() {
            [p[0] * to_edge, p[1] * to_edge]
        } else {
            [0.0; 2]
        }
    }
}

fn times([a, b, d]: [f64; 3], p: [f64; 2]) -> [f64; 2] {
    [a * p[0] + b * p[1], b * p[0] + d * p[1]]
}

/// The unit vector along the larger eigenvalue of `[[half, b], [b, -half]]`, whose eigenvalues are `±apart`.
fn principal(half: f64, b: f64, apart: f64) -> [f64; 2] {
    if apart == 0.0 {
        return [1.0, 0.0];
    }
    let (x, y) = if half >= 0.0 {
        (apart + half, b)
    } else {
        (b, apart - half)
    };
    let norm = (x * x + y * y).sqrt();
    [x / norm, y / norm]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn friction(w: [f64; 3], c: [f64; 2], radius: f64) -> [f64; 2] {
        Response::new(w).friction(c, radius, &mut 0.0)
    }

    /// The velocity that remains.
    fn left([a, b, d]: [f64; 3], c: [f64; 2], p: [f64; 2]) -> [f64; 2] {
        [c[0] + a * p[0] + b * p[1], c[1] + b * p[0] + d * p[1]]
    }

    proptest! {
        #[test]
        fn friction_sticks_or_opposes_what_is_left(
            (x, y, z) in (0.1..3.0f64, -3.0..3.0f64, 0.1..3.0f64),
            c in [-2.0..2.0f64, -2.0..2.0f64],
            radius in 0.0..1.0f64,
            start in prop_oneof![Just(0.0), 0.0..1e-3f64, 0.0..30.0f64],
        ) {
            // positive definite by construction
            let w = [x * x + y * y, y * z, z * z];
            let mut edge = start;
            let p = Response::new(w).friction(c, radius, &mut edge);
            // wherever the search starts, and if it starts where it ended
            for other in [friction(w, c, radius), Response::new(w).friction(c, radius, &mut edge)] {
                let apart = (p[0] - other[0]).abs().max((p[1] - other[1]).abs());
                prop_assert!(apart <= 1e-13 * radius, "{p:?} {other:?}");
            }
            let v = left(w, c, p);
            let norm = (p[0] * p[0] + p[1] * p[1]).sqrt();
            prop_assert!(norm <= radius * (1.0 + 1e-12));
            let speed = (v[0] * v[0] + v[1] * v[1]).sqrt();
            let scale = (c[0] * c[0] + c[1] * c[1]).sqrt();
            if norm < radius * (1.0 - 1e-9) {
                prop_assert!(speed <= 1e-9 * scale.max(1e-3), "sticks: {v:?}");
            } else {
                // antiparallel
                let cross = p[0] * v[1] - p[1] * v[0];
                prop_assert!(cross.abs() <= 1e-7 * norm * scale, "{p:?} {v:?}");
                prop_assert!(p[0] * v[0] + p[1] * v[1] <= 1e-9 * norm * scale);
            }
        }
    }

    #[test]
    fn nine_times_the_mass_across_does_not_turn_friction() {
        // slides almost along x + y; masses 1 and 9: the momentum points elsewhere
        let w = [1.0, 0.0, 1.0 / 9.0];
        let p = friction(w, [1.0, 1.0], 0.01);
        let v = left(w, [1.0, 1.0], p);
        assert!((p[0] * v[1] - p[1] * v[0]).abs() < 1e-12);
        assert!(p[0] < 0.0 && p[1] < 0.0);
        assert_eq!(friction(w, [0.0, 0.0], 0.01), [0.0, 0.0]);
        assert_eq!(friction(w, [1.0, 1.0], 0.0), [0.0, 0.0]);
        // across, an arm in a plane cannot move at all
        assert_eq!(friction([2.0, 0.0, 0.0], [1.0, 0.0], 10.0), [-0.5, 0.0]);
        assert_eq!(friction([2.0, 0.0, 0.0], [1.0, 0.0], 0.1), [-0.1, 0.0]);
        assert_eq!(friction([0.0; 3], [1.0, 0.0], 0.1), [0.0; 2]);
        // heavy friction stops it
        let p = friction(w, [1.0, 1.0], 100.0);
        assert_eq!(left(w, [1.0, 1.0], p), [0.0, 0.0]);
    }
}
