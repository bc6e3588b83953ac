//! Singular values and left singular vectors of a wide matrix with few rows, by one-sided Jacobi rotations of its rows.
//!
//! Without LAPACK, and with the same bits on every platform; small singular values have high relative accuracy.
//!
//! Source: Hestenes, *Inversion of matrices by biorthogonalization* (1958); Golub & Van Loan, *Matrix Computations* (2013),
//! sec. 8.6.3.

/// Sweeps over all pairs of rows; ten are enough for any matrix met in practice.
const SWEEPS: usize = 40;

/// The decomposition `A = V S`, with `V` orthogonal and the rows of `S` orthogonal: row `i` of `S` is the `i`-th singular value times
/// the `i`-th right singular vector. Its memory is reused.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowJacobi {
    columns: usize,
    /// `S`, row by row, not sorted.
    scaled: Vec<f64>,
    /// `V`, column by column.
    left: Vec<f64>,
    squares: Vec<f64>,
}

impl RowJacobi {
    /// Decomposes the matrix of `rows` rows that `a` holds column by column.
    pub(crate) fn decompose(&mut self, rows: usize, a: &[f64]) {
        let columns = a.len().checked_div(rows).unwrap_or(0);
        self.columns = columns;
        self.scaled.clear();
        self.scaled
            .extend((0..rows).flat_map(|i| (0..columns).map(move |j| a[j * rows + i])));
        self.left.clear();
        self.left.resize(rows * rows, 0.0);
        for i in 0..rows {
            self.left[i * rows + i] = 1.0;
        }
        for _ in 0..SWEEPS {
            let mut turned = false;
            for i in 1..rows {
                for j in 0..i {
                    turned |= self.orthogonalise(i, j, rows);
                }
            }
            if !turned {
                break;
            }
        }
        self.squares.clear();
        for i in 0..rows {
            let square = dot(self.row(i), self.row(i));
            self.squares.push(square);
        }
    }

    /// Rotates rows `i > j` in their plane until they are orthogonal; returns whether a rotation was needed.
    fn orthogonalise(&mut self, i: usize, j: usize, rows: usize) -> bool {
        let n = self.columns;
        let (head, tail) = self.scaled.split_at_mut(i * n);
        let (x, y) = (&mut head[j * n..(j + 1) * n], &mut tail[..n]);
        let (xx, yy, xy) = (dot(x, x), dot(y, y), dot(x, y));
        // NaN ends the sweeps here
        let oblique = xy.abs() > f64::EPSILON * (xx * yy).sqrt();
        if !oblique {
            return false;
        }
        let zeta = (yy - xx) / (2.0 * xy);
        let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        let sine = cosine * tangent;
        let turn = |x: &mut [f64], y: &mut [f64]| {
            for (x, y) in x.iter_mut().zip(y) {
                (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
            }
        };
        turn(x, y);
        let (head, tail) = self.left.split_at_mut(i * rows);
        turn(&mut head[j * rows..(j + 1) * rows], &mut tail[..rows]);
        true
    }

    /// Singular value times right singular vector.
    fn row(&self, i: usize) -> &[f64] {
        &self.scaled[i * self.columns..(i + 1) * self.columns]
    }

    /// The left singular vectors that go with [`RowJacobi::row`].
    fn left(&self, i: usize) -> &[f64] {
        let rows = self.squares.len();
        &self.left[i * rows..(i + 1) * rows]
    }

    /// The square below which a singular value is less than `fraction` of the largest.
    fn cutoff(&self, fraction: f64) -> f64 {
        fraction * fraction * self.squares.iter().copied().fold(0.0, f64::max)
    }

    /// Adds the pseudo-inverse times `e` to `x`; singular values up to `fraction` of the largest count as zero.
    pub(crate) fn add_pseudo_inverse(&self, e: &[f64], fraction: f64, x: &mut [f64]) {
        let cutoff = self.cutoff(fraction);
        for (i, &square) in self.squares.iter().enumerate() {
            if square > cutoff {
                let along = dot(self.left(i), e) / square;
                for (x, u) in x.iter_mut().zip(self.row(i)) {
                    *x += along * u;
                }
            }
        }
    }

    /// Projects `x` on the null space, by removing its part in the row space; singular values up to `fraction` of the largest count as
    /// zero.
    pub(crate) fn project_to_null_space(&self, fraction: f64, x: &mut [f64]) {
        let cutoff = self.cutoff(fraction);
        for (i, &square) in self.squares.iter().enumerate() {
            if square > cutoff {
                let along = dot(self.row(i), x) / square;
                for (x, u) in x.iter_mut().zip(self.row(i)) {
                    *x -= along * u;
                }
            }
        }
    }

    /// The singular values, largest first, as many as the shorter side of the matrix has entries.
    pub(crate) fn values(&self) -> Vec<f64> {
        let mut values: Vec<f64> = self.squares.iter().map(|s| s.sqrt()).collect();
        values.sort_unstable_by(|a, b| b.total_cmp(a));
        values.truncate(self.columns);
        values
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_worked_example() {
        // A = [[3, 4], [0, 5]], columns one after another: A Aᵀ has trace 50 and determinant 225, so values √45 and √5
        let mut svd = RowJacobi::default();
        svd.decompose(2, &[3.0, 0.0, 4.0, 5.0]);
        let values = svd.values();
        assert!((values[0] - 45.0_f64.sqrt()).abs() < 1e-14);
        assert!((values[1] - 5.0_f64.sqrt()).abs() < 1e-14);
        let mut x = [0.0; 2];
        svd.add_pseudo_inverse(&[7.0, 5.0], 1e-10, &mut x);
        // 3 x + 4 y = 7, 5 y = 5
        assert!(
            (x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14,
            "{x:?}"
        );
    }

    #[test]
    fn a_matrix_without_full_rank_has_its_smallest_solution() {
        // both rows the same: x + y = 2 twice, of least length at (1, 1)
        let mut svd = RowJacobi::default();
        svd.decompose(2, &[1.0, 1.0, 1.0, 1.0]);
        let mut x = [0.0; 2];
        svd.add_pseudo_inverse(&[2.0, 2.0], 1e-10, &mut x);
        assert!(
            (x[0] - 1.0).abs() < 1e-15 && (x[1] - 1.0).abs() < 1e-15,
            "{x:?}"
        );
        let mut along = [3.0, 1.0];
        svd.project_to_null_space(1e-10, &mut along);
        assert!((along[0] - 1.0).abs() < 1e-15 && (along[1] + 1.0).abs() < 1e-15);
        // taller than wide, empty, and no number at all
        svd.decompose(3, &[1.0, 2.0, 2.0]);
        assert_eq!(svd.values(), [3.0]);
        svd.decompose(3, &[]);
        assert!(svd.values().is_empty());
        svd.decompose(2, &[f64::NAN; 4]);
        assert_eq!(svd.values().len(), 2);
    }
}
