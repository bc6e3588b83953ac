//! Rank and least squares by column-pivoted QR, for constraints that may be redundant.

use nalgebra::{DMatrix, DVector};

/// Pivots below this fraction of the largest count as zero.
pub(super) const RANK_TOLERANCE: f64 = 1e-9;

pub(super) fn rank(matrix: &DMatrix<f64>) -> usize {
    rank_within(matrix, RANK_TOLERANCE)
}

pub(super) fn rank_within(matrix: &DMatrix<f64>, tolerance: f64) -> usize {
    if matrix.ncols() == 0 || matrix.nrows() == 0 {
        return 0;
    }
    let r = matrix.clone().col_piv_qr().r();
    let strongest = r[(0, 0)].abs();
    (0..r.nrows().min(r.ncols()))
        .filter(|&i| r[(i, i)].abs() > tolerance * strongest.max(f64::MIN_POSITIVE))
        .count()
}

/// A least-squares solution `x` of `a x = b` with nearly the smallest norm; directions with a zero pivot stay zero.
pub(super) fn least_squares(a: DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let (rows, columns) = a.shape();
    let qr = a.col_piv_qr();
    let r = qr.r();
    let mut rotated = b.clone();
    qr.q_tr_mul(&mut rotated);
    let strongest = if r.is_empty() { 0.0 } else { r[(0, 0)].abs() };
    let rank = (0..rows.min(columns))
        .take_while(|&i| r[(i, i)].abs() > RANK_TOLERANCE * strongest)
        .count();
    let mut x = DVector::zeros(columns);
    for i in (0..rank).rev() {
        let mut sum = rotated[i];
        for j in i + 1..rank {
            sum -= r[(i, j)] * x[j];
        }
        x[i] = sum / r[(i, i)];
    }
    qr.p().inv_permute_rows(&mut x);
    x
}
