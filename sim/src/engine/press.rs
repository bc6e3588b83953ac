//! Normal impulses of the points of one patch together: none pulls, and no point that is pressed moves into the other surface.
//!
//! The points of a face share its load in a way that velocities alone do not determine: four legs of a table on three equations. The
//! points are therefore a little soft, all alike, which selects the shares of least sum of squares: a face that lands flat is pressed
//! alike at all its corners, whatever their order. The block iteration above this one removes the softness from the velocities again.
//!
//! Source: the active set of non-negative least squares, Lawson & Hanson, *Solving Least Squares Problems* (1974), chapter 23.

/// Most points of a block.
pub(super) const MOST: usize = 8;
/// Softness of a point, as a part of the greatest diagonal entry.
pub(super) const SOFT: f64 = 1e-9;
/// Changes of the set of pressed points: far more than a face needs.
const CHANGES: usize = 4 * MOST;

/// Finds `p >= 0` with `w = matrix p + offset >= -least` and `p · w = 0`, from the feasible start `p`; `matrix` is positive definite, of
/// `p.len()` rows and columns.
pub(super) fn press(matrix: &[f64], offset: &[f64], p: &mut [f64], least: f64) {
    let m = p.len();
    if let [only] = p {
        *only = (-offset[0] / matrix[0]).max(0.0);
        return;
    }
    let at = |p: &[f64], i: usize| -> f64 {
        let row = &matrix[i * m..(i + 1) * m];
        offset[i] + row.iter().zip(p).map(|(a, p)| a * p).sum::<f64>()
    };
    let mut pressed = [false; MOST];
    for i in 0..m {
        pressed[i] = p[i] > 0.0 || at(p, i) < -least;
    }
    for _ in 0..CHANGES {
        let mut wanted = [0.0; MOST];
        solve(matrix, offset, &pressed[..m], &mut wanted[..m]);
        // as far towards the solution as no point pulls
        let mut reach = 1.0;
        let mut first = None;
        for i in 0..m {
            if pressed[i] && wanted[i] < 0.0 {
                let to_zero = p[i] / (p[i] - wanted[i]);
                if to_zero < reach || first.is_none() {
                    (reach, first) = (to_zero.min(reach), Some(i));
                }
            }
        }
        for i in 0..m {
            p[i] = if pressed[i] {
                (p[i] + reach * (wanted[i] - p[i])).max(0.0)
            } else {
                0.0
            };
        }
        if let Some(released) = first {
            pressed[released] = false;
            p[released] = 0.0;
            continue;
        }
        let mut worst = (-least, None);
        for (i, pressed) in pressed[..m].iter().enumerate() {
            let w = if *pressed { 0.0 } else { at(p, i) };
            if w < worst.0 {
                worst = (w, Some(i));
            }
        }
        match worst.1 {
            Some(i) => pressed[i] = true,
            None => return,
        }
    }
}

/// Solves the rows and columns of `pressed` for `p`, by Cholesky's factors; the others are zero.
fn solve(matrix: &[f64], offset: &[f64], pressed: &[bool], p: &mut [f64]) {
    let m = pressed.len();
    let mut factor = [[0.0; MOST]; MOST];
    for i in (0..m).filter(|i| pressed[*i]) {
        let mut rest = -offset[i];
        for j in (0..=i).filter(|j| pressed[*j]) {
            let mut sum = matrix[i * m + j];
            for k in (0..j).filter(|k| pressed[*k]) {
                sum -= factor[i][k] * factor[j][k];
            }
            if i == j {
                // the softness keeps it positive; rounding may not
                factor[i][i] = sum.max(f64::MIN_POSITIVE).sqrt();
            } else {
                factor[i][j] = sum / factor[j][j];
                rest -= factor[i][j] * p[j];
            }
        }
        p[i] = rest / factor[i][i];
    }
    for i in (0..m).rev().filter(|i| pressed[*i]) {
        let mut rest = p[i];
        for k in (i + 1..m).filter(|k| pressed[*k]) {
            rest -= factor[k][i] * p[k];
        }
        p[i] = rest / factor[i][i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Four corners of a square plate of side 2 and unit mass, with its tensor, softened.
    fn plate() -> Vec<f64> {
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let mut matrix = Vec::new();
        for (i, a) in corners.iter().enumerate() {
            for (j, b) in corners.iter().enumerate() {
                let soft = if i == j { SOFT } else { 0.0 };
                matrix.push(1.0 + 3.0 * (a[0] * b[0] + a[1] * b[1]) + soft);
            }
        }
        matrix
    }

    #[test]
    fn a_plate_that_lands_flat_is_pressed_alike_at_all_corners() {
        let mut p = [0.0; 4];
        press(&plate(), &[-1.0; 4], &mut p, 1e-14);
        for share in p {
            // the softness is a billionth, and so is not far from rounding
            assert!((share - 0.25).abs() < 1e-5, "{p:?}");
        }
        // a plate that turns about one diagonal: the two other corners leave, or come with the same speed
        let mut p = [0.0; 4];
        press(&plate(), &[-1.0, 1.0, 3.0, 1.0], &mut p, 1e-14);
        assert!(
            (p[0] - 1.0 / 7.0).abs() < 1e-7 && p[1..] == [0.0; 3],
            "{p:?}"
        );
        let mut p = [];
        press(&[], &[], &mut p, 0.0);
    }

    proptest! {
        #[test]
        fn nothing_pulls_and_nothing_sinks(
            entries in proptest::collection::vec(-1.0..1.0f64, 5 * 3),
            offset in proptest::collection::vec(-1.0..1.0f64, 5),
            start in proptest::collection::vec(0.0..1.0f64, 5),
        ) {
            // five points on three degrees of freedom
            let mut matrix = vec![0.0; 25];
            for i in 0..5 {
                for j in 0..5 {
                    matrix[i * 5 + j] = (0..3).map(|k| entries[i * 3 + k] * entries[j * 3 + k]).sum();
                }
                matrix[i * 5 + i] += 1e-3;
            }
            let mut p = start;
            press(&matrix, &offset, &mut p, 1e-12);
            for i in 0..5 {
                let w: f64 = offset[i] + (0..5).map(|j| matrix[i * 5 + j] * p[j]).sum::<f64>();
                prop_assert!(p[i] >= 0.0 && w >= -1e-9, "{p:?} {w}");
                prop_assert!(p[i] * w.abs() < 1e-8, "{p:?} {w}");
            }
        }
    }
}
