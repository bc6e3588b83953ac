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

/// Finds `p >= 0` with `w = matrix p + offset >= -least` and `p · w = 0`, from the feasible start `p`; `matrix` is symmetric and positive
/// definite.
pub(super) fn press<const M: usize>(
    matrix: &[[f64; M]; M],
    offset: &[f64; M],
    p: &mut [f64; M],
    least: f64,
) {
    if M == 1 {
        p[0] = (-offset[0] / matrix[0][0]).max(0.0);
        return;
    }
    let at = |p: &[f64; M], i: usize| -> f64 {
        offset[i] + matrix[i].iter().zip(p).map(|(a, p)| a * p).sum::<f64>()
    };
    let mut pressed: [bool; M] = std::array::from_fn(|i| p[i] > 0.0 || at(p, i) < -least);
    for _ in 0..CHANGES {
        let wanted = solve(matrix, offset, &pressed);
        // as far towards the solution as no point pulls
        let mut reach = 1.0;
        let mut first = None;
        for i in 0..M {
            if pressed[i] && wanted[i] < 0.0 {
                let to_zero = p[i] / (p[i] - wanted[i]);
                if to_zero < reach || first.is_none() {
                    (reach, first) = (to_zero.min(reach), Some(i));
                }
            }
        }
        for i in 0..M {
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
        for (i, pressed) in pressed.iter().enumerate() {
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

/// Solves the rows and columns of `pressed`, by Cholesky's factors; the others are zero.
fn solve<const M: usize>(
    matrix: &[[f64; M]; M],
    offset: &[f64; M],
    pressed: &[bool; M],
) -> [f64; M] {
    let mut p = [0.0; M];
    let mut factor = [[0.0; M]; M];
    // inverses of the diagonal
    let mut per = [0.0; M];
    for i in (0..M).filter(|i| pressed[*i]) {
        let mut rest = -offset[i];
        for j in (0..i).filter(|j| pressed[*j]) {
            let mut sum = matrix[i][j];
            // rows and columns that are left out are zero
            for (a, b) in factor[i][..j].iter().zip(&factor[j][..j]) {
                sum -= a * b;
            }
            factor[i][j] = sum * per[j];
            rest -= factor[i][j] * p[j];
        }
        let mut sum = matrix[i][i];
        for entry in &factor[i][..i] {
            sum -= entry * entry;
        }
        // the softness keeps it positive; rounding may not
        per[i] = 1.0 / sum.max(f64::MIN_POSITIVE).sqrt();
        p[i] = rest * per[i];
    }
    for i in (0..M).rev().filter(|i| pressed[*i]) {
        let mut rest = p[i];
        for k in i + 1..M {
            rest -= factor[k][i] * p[k];
        }
        p[i] = rest * per[i];
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Four corners of a square plate of side 2 and unit mass, with its tensor, softened.
    fn plate() -> [[f64; 4]; 4] {
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let mut matrix =
            corners.map(|a: [f64; 2]| corners.map(|b| 1.0 + 3.0 * (a[0] * b[0] + a[1] * b[1])));
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] += SOFT;
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
    }

    proptest! {
        #[test]
        fn nothing_pulls_and_nothing_sinks(
            entries in proptest::collection::vec(-1.0..1.0f64, 5 * 3),
            offset in proptest::collection::vec(-1.0..1.0f64, 5),
            start in proptest::collection::vec(0.0..1.0f64, 5),
        ) {
            // five points on three degrees of freedom
            let mut matrix = [[0.0; 5]; 5];
            for i in 0..5 {
                for j in 0..5 {
                    matrix[i][j] = (0..3).map(|k| entries[i * 3 + k] * entries[j * 3 + k]).sum();
                }
                matrix[i][i] += 1e-3;
            }
            let mut p: [f64; 5] = start.try_into().unwrap();
            let offset: [f64; 5] = offset.try_into().unwrap();
            press(&matrix, &offset, &mut p, 1e-12);
            for i in 0..5 {
                let w: f64 = offset[i] + (0..5).map(|j| matrix[i][j] * p[j]).sum::<f64>();
                prop_assert!(p[i] >= 0.0 && w >= -1e-9, "{p:?} {w}");
                prop_assert!(p[i] * w.abs() < 1e-8, "{p:?} {w}");
            }
        }
    }
}
