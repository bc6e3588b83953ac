//! Vectors and matrices as values of the language.
//!
//! Copies share their elements until one is changed, so that passing them costs the same for any size. Sums run in the order of the
//! elements, because the platform's kernels fuse and reorder and so give other bits.

use std::rc::Rc;

use nalgebra::DMatrix;

use super::copies;

/// So many elements are copied in the time of a shared copy.
const ELEMENTS_PER_COPY: usize = 8;

/// A column of numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Vector(Rc<[f64]>);

impl Clone for Vector {
    fn clone(&self) -> Self {
        copies::count_one();
        Self(Rc::clone(&self.0))
    }
}

impl Vector {
    pub(super) fn new(elements: &[f64]) -> Self {
        Self(elements.into())
    }

    pub(super) fn elements(&self) -> &[f64] {
        &self.0
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// The elements for modification; copied first if another value shares them.
    pub(super) fn elements_mut(&mut self) -> &mut [f64] {
        Rc::make_mut(&mut self.0)
    }

    pub(super) fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        self.elements().iter().map(|&x| function(x)).collect()
    }

    pub(super) fn dot(&self, other: &Self) -> f64 {
        sum_of_products(self.elements().iter(), other.elements().iter())
    }

    pub(super) fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl FromIterator<f64> for Vector {
    fn from_iter<I: IntoIterator<Item = f64>>(elements: I) -> Self {
        Self(elements.into_iter().collect())
    }
}

/// Rows and columns of numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Matrix(Rc<DMatrix<f64>>);

impl Clone for Matrix {
    fn clone(&self) -> Self {
        copies::count_one();
        Self(Rc::clone(&self.0))
    }
}

impl Matrix {
    pub(super) fn from_fn(
        rows: usize,
        columns: usize,
        element: impl FnMut(usize, usize) -> f64,
    ) -> Self {
        Self(Rc::new(DMatrix::from_fn(rows, columns, element)))
    }

    /// A matrix from rows, all of the same length.
    pub(super) fn from_rows(rows: &[Vector]) -> Option<Self> {
        let columns = rows.first()?.len();
        rows.iter()
            .all(|row| row.len() == columns)
            .then(|| Self::from_fn(rows.len(), columns, |i, j| rows[i].elements()[j]))
    }

    pub(super) fn rows(&self) -> usize {
        self.0.nrows()
    }

    pub(super) fn columns(&self) -> usize {
        self.0.ncols()
    }

    pub(super) fn is_square(&self) -> bool {
        self.rows() == self.columns()
    }

    pub(super) fn at(&self, row: usize, column: usize) -> f64 {
        self.0[(row, column)]
    }

    pub(super) fn row(&self, row: usize) -> Vector {
        self.0.row(row).iter().copied().collect()
    }

    pub(super) fn column(&self, column: usize) -> Vector {
        self.0.column(column).iter().copied().collect()
    }

    pub(super) fn set_row(&mut self, row: usize, elements: &Vector) {
        let matrix = Rc::make_mut(&mut self.0);
        for (target, source) in matrix.row_mut(row).iter_mut().zip(elements.elements()) {
            *target = *source;
        }
    }

    pub(super) fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        Self::from_fn(self.rows(), self.columns(), |i, j| function(self.at(i, j)))
    }

    /// Elements row by row.
    pub(super) fn elements(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.rows()).flat_map(move |i| (0..self.columns()).map(move |j| self.at(i, j)))
    }

    pub(super) fn transpose(&self) -> Self {
        Self(Rc::new(self.0.transpose()))
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        Self::from_fn(self.rows(), other.columns(), |i, j| {
            sum_of_products(self.0.row(i).iter(), other.0.column(j).iter())
        })
    }

    pub(super) fn times_vector(&self, vector: &Vector) -> Vector {
        (0..self.rows())
            .map(|i| sum_of_products(self.0.row(i).iter(), vector.elements().iter()))
            .collect()
    }

    /// Solves `self · X = right` for a square matrix; `None` if it is singular to working precision.
    ///
    /// Gaussian elimination with partial pivoting. A pivot below `n ε` of the largest element counts as zero.
    pub(super) fn solve(&self, right: &Self) -> Option<Self> {
        let n = self.rows();
        let (mut a, mut b) = ((*self.0).clone(), (*right.0).clone());
        let smallest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs())) * n as f64 * f64::EPSILON;
        for k in 0..n {
            let pivot = (k..n).fold(k, |p, i| {
                if a[(i, k)].abs() > a[(p, k)].abs() {
                    i
                } else {
                    p
                }
            });
            let size = a[(pivot, k)].abs();
            if !(size.is_finite() && size > smallest) {
                return None;
            }
            a.swap_rows(k, pivot);
            b.swap_rows(k, pivot);
            for i in k + 1..n {
                let factor = a[(i, k)] / a[(k, k)];
                for j in k..n {
                    a[(i, j)] -= factor * a[(k, j)];
                }
                for j in 0..b.ncols() {
                    b[(i, j)] -= factor * b[(k, j)];
                }
            }
        }
        // back substitution
        for j in 0..b.ncols() {
            for i in (0..n).rev() {
                let known: f64 = sum_of_products(
                    (i + 1..n).map(|k| a[(i, k)]).collect::<Vec<_>>().iter(),
                    (i + 1..n).map(|k| b[(k, j)]).collect::<Vec<_>>().iter(),
                );
                b[(i, j)] = (b[(i, j)] - known) / a[(i, i)];
            }
        }
        Some(Self(Rc::new(b)))
    }

    /// The determinant of a square matrix, by elimination with partial pivoting.
    pub(super) fn determinant(&self) -> f64 {
        let n = self.rows();
        let mut a = (*self.0).clone();
        let mut product = 1.0;
        for k in 0..n {
            let pivot = (k..n).fold(k, |p, i| {
                if a[(i, k)].abs() > a[(p, k)].abs() {
                    i
                } else {
                    p
                }
            });
            if a[(pivot, k)] == 0.0 {
                return 0.0;
            }
            if pivot != k {
                a.swap_rows(k, pivot);
                product = -product;
            }
            product *= a[(k, k)];
            for i in k + 1..n {
                let factor = a[(i, k)] / a[(k, k)];
                for j in k..n {
                    a[(i, j)] -= factor * a[(k, j)];
                }
            }
        }
        product
    }
}

impl IntoIterator for Vector {
    type Item = f64;
    type IntoIter = Elements;

    fn into_iter(self) -> Elements {
        Elements {
            vector: self,
            next: 0,
        }
    }
}

impl IntoIterator for Matrix {
    type Item = Vector;
    type IntoIter = Rows;

    fn into_iter(self) -> Rows {
        Rows {
            matrix: self,
            next: 0,
        }
    }
}

/// An iterator over a vector without a copy of it.
#[derive(Debug)]
pub(super) struct Elements {
    vector: Vector,
    next: usize,
}

impl Iterator for Elements {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        let element = self.vector.elements().get(self.next).copied()?;
        self.next += 1;
        Some(element)
    }
}

/// An iterator over the rows of a matrix, each created when it is needed.
#[derive(Debug)]
pub(super) struct Rows {
    matrix: Matrix,
    next: usize,
}

impl Iterator for Rows {
    type Item = Vector;

    fn next(&mut self) -> Option<Vector> {
        if self.next == self.matrix.rows() {
            return None;
        }
        self.next += 1;
        copies::count(self.matrix.columns() / ELEMENTS_PER_COPY);
        Some(self.matrix.row(self.next - 1))
    }
}

fn sum_of_products<'a>(
    left: impl Iterator<Item = &'a f64>,
    right: impl Iterator<Item = &'a f64>,
) -> f64 {
    left.zip(right).fold(0.0, |sum, (a, b)| sum + a * b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn matrix(rows: &[&[f64]]) -> Matrix {
        Matrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
    }

    #[test]
    fn a_shared_vector_is_copied_before_it_changes() {
        let first = Vector::new(&[1.0, 2.0]);
        let mut second = first.clone();
        second.elements_mut()[0] = 5.0;
        assert_eq!(first.elements(), [1.0, 2.0]);
        assert_eq!(second.elements(), [5.0, 2.0]);
    }

    #[test]
    fn a_zero_on_the_diagonal_needs_a_swap_of_rows() {
        let a = matrix(&[&[0.0, 2.0], &[4.0, 0.0]]);
        let x = a.solve(&matrix(&[&[2.0], &[4.0]]));
        assert_eq!(x, Some(matrix(&[&[1.0], &[1.0]])));
        assert_eq!(a.determinant().to_bits(), (-8.0_f64).to_bits());
    }

    #[test]
    fn a_singular_matrix_has_no_solution() {
        let a = matrix(&[&[1.0, 2.0], &[2.0, 4.0]]);
        assert_eq!(a.solve(&matrix(&[&[1.0], &[1.0]])), None);
        assert_eq!(a.determinant().to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn rows_of_unequal_length_are_no_matrix() {
        let rows = [Vector::new(&[1.0]), Vector::new(&[1.0, 2.0])];
        assert_eq!(Matrix::from_rows(&rows), None);
        assert_eq!(Matrix::from_rows(&[]), None);
    }

    proptest! {
        #[test]
        fn a_matrix_times_its_solution_is_the_right_side(
            elements in proptest::collection::vec(-1.0..1.0f64, 9),
            right in proptest::collection::vec(-1.0..1.0f64, 3),
        ) {
            // 4 on the diagonal keeps the condition number small, so that 1e-12 is far above rounding
            let a = Matrix::from_fn(3, 3, |i, j| elements[3 * i + j] + if i == j { 4.0 } else { 0.0 });
            let b = Matrix::from_fn(3, 1, |i, _| right[i]);
            let x = a.solve(&b).expect("regular");
            for (got, wanted) in a.times(&x).elements().zip(b.elements()) {
                prop_assert!((got - wanted).abs() < 1e-12);
            }
        }
    }
}
