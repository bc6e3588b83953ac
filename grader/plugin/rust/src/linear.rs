//! Vectors and matrices as arrays, calculated as scripts calculate: sums run in the order of the elements.

use core::array::from_fn;

use crate::math::sqrt;

/// The numbers as an array: `let q: [f64; 2] = array(observation.q());`.
///
/// # Panics
/// If there are not `N` numbers.
#[track_caller]
pub fn array<const N: usize>(numbers: &[f64]) -> [f64; N] {
    match numbers.try_into() {
        Ok(array) => array,
        Err(_) => panic!("an array of {N} is made from {} numbers", numbers.len()),
    }
}

/// The scalar product.
pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

/// The length of a vector.
pub fn norm<const N: usize>(a: [f64; N]) -> f64 {
    sqrt(dot(a, a))
}

/// `x` for which the matrix `a`, given as rows, times `x` is `b`; `None` if `a` is singular to working precision.
///
/// Gaussian elimination with partial pivoting. A pivot below `n ε` of the largest element counts as zero.
pub fn solve<const N: usize>(a: [[f64; N]; N], b: [f64; N]) -> Option<[f64; N]> {
    let (mut a, mut b) = (a, b);
    let largest = a.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let smallest = largest * N as f64 * f64::EPSILON;
    for k in 0..N {
        let pivot = (k..N).fold(k, |p, i| if a[i][k].abs() > a[p][k].abs() { i } else { p });
        let size = a[pivot][k].abs();
        if !(size.is_finite() && size > smallest) {
            return None;
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..N {
            let factor = a[i][k] / a[k][k];
            let row = a[k];
            for (element, above) in a[i].iter_mut().zip(row).skip(k) {
                *element -= factor * above;
            }
            b[i] -= factor * b[k];
        }
    }
    // back substitution
    for i in (0..N).rev() {
        let known = (i + 1..N).fold(0.0, |sum, k| sum + a[i][k] * b[k]);
        b[i] = (b[i] - known) / a[i][i];
    }
    Some(b)
}

/// The product of a matrix, given as rows, and a vector.
pub fn times<const N: usize, const M: usize>(a: [[f64; N]; M], x: [f64; N]) -> [f64; M] {
    from_fn(|i| dot(a[i], x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::tests::panicked;

    #[test]
    fn a_zero_on_the_diagonal_needs_a_swap_of_rows() {
        assert_eq!(
            solve([[0.0, 2.0], [4.0, 0.0]], [2.0, 4.0]),
            Some([1.0, 1.0])
        );
    }

    #[test]
    fn a_singular_matrix_has_no_solution() {
        assert_eq!(solve([[1.0, 2.0], [2.0, 4.0]], [1.0, 1.0]), None);
        assert_eq!(solve([[f64::NAN]], [1.0]), None);
    }

    #[test]
    fn a_matrix_times_its_solution_is_the_right_side() {
        let a = [[2.0, -1.0, 0.5], [8.0, 3.0, -2.0], [0.0, 7.0, 1.0]];
        let x = solve(a, [1.0, -2.0, 3.0]).expect("regular");
        for (got, wanted) in times(a, x).into_iter().zip([1.0, -2.0, 3.0]) {
            assert!((got - wanted).abs() < 1e-14, "{got} {wanted}");
        }
    }

    #[test]
    fn products_and_lengths_by_hand() {
        assert_eq!(
            dot([1.0, 2.0, 3.0], [4.0, -5.0, 6.0]).to_bits(),
            12.0_f64.to_bits()
        );
        assert_eq!(norm([3.0, 4.0]).to_bits(), 5.0_f64.to_bits());
        assert_eq!(
            times([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]], [1.0, 10.0]).map(f64::to_bits),
            [21.0, 43.0, 65.0].map(f64::to_bits)
        );
        assert_eq!(
            panicked(|| _ = array::<3>(&[0.0])),
            "an array of 3 is made from 1 numbers"
        );
    }
}
