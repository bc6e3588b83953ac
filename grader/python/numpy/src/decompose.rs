//! Decompositions of matrices: LU, QR, Cholesky, eigenvalues of symmetric matrices and singular values.
//!
//! All loops have a fixed order, so the same matrix gives the same bits on every machine.

use crate::view::View;

/// A matrix of floats, row by row.
#[derive(Clone, Debug)]
pub struct Matrix {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The elements, row by row.
    pub values: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            values: vec![0.0; rows * columns],
        }
    }

    /// The identity.
    #[must_use]
    pub fn identity(size: usize) -> Self {
        let mut identity = Self::zeros(size, size);
        for place in 0..size {
            identity.set(place, place, 1.0);
        }
        identity
    }

    /// The elements of a view; a vector counts as one row.
    #[must_use]
    pub fn of(view: &View) -> Self {
        Self {
            rows: view.rows(),
            columns: view.columns(),
            values: view.values(),
        }
    }

    /// The view of a new array with these elements.
    #[must_use]
    pub fn into_view(self) -> View {
        View::matrix(self.rows, self.columns, self.values)
    }

    /// An element.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.values[row * self.columns + column]
    }

    /// Sets an element.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        self.values[row * self.columns + column] = value;
    }

    /// The transpose.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut result = Self::zeros(self.columns, self.rows);
        for row in 0..self.rows {
            for column in 0..self.columns {
                result.set(column, row, self.at(row, column));
            }
        }
        result
    }

    /// The product with another matrix, whose rows match.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut result = Self::zeros(self.rows, other.columns);
        for row in 0..self.rows {
            for column in 0..other.columns {
                let mut sum = 0.0;
                for place in 0..self.columns {
                    sum += self.at(row, place) * other.at(place, column);
                }
                result.set(row, column, sum);
            }
        }
        result
    }

    /// The first columns.
    #[must_use]
    pub fn first_columns(&self, count: usize) -> Self {
        let mut result = Self::zeros(self.rows, count);
        for row in 0..self.rows {
            for column in 0..count {
                result.set(row, column, self.at(row, column));
            }
        }
        result
    }

    /// The first rows.
    #[must_use]
    pub fn first_rows(&self, count: usize) -> Self {
        Self {
            rows: count,
            columns: self.columns,
            values: self.values[..count * self.columns].to_vec(),
        }
    }

    /// Whether every element is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.values.iter().all(|value| value.is_finite())
    }

    fn swap_rows(&mut self, first: usize, second: usize) {
        for column in 0..self.columns {
            self.values.swap(
                first * self.columns + column,
                second * self.columns + column,
            );
        }
    }
}

/// A square matrix as a lower and an upper triangle in one, with the order of its rows.
#[derive(Debug)]
pub struct Triangles {
    triangles: Matrix,
    order: Vec<usize>,
    sign: f64,
    singular: bool,
}

impl Triangles {
    /// Gaussian elimination; in each column the largest element is the pivot.
    #[must_use]
    pub fn of(matrix: &Matrix) -> Self {
        let mut work = matrix.clone();
        let size = work.rows;
        let mut order: Vec<usize> = (0..size).collect();
        let mut sign = 1.0;
        let mut singular = false;
        for column in 0..size {
            let mut pivot = column;
            for row in column + 1..size {
                if work.at(row, column).abs() > work.at(pivot, column).abs() {
                    pivot = row;
                }
            }
            if work.at(pivot, column) == 0.0 {
                singular = true;
                continue;
            }
            if pivot != column {
                work.swap_rows(pivot, column);
                order.swap(pivot, column);
                sign = -sign;
            }
            let scale = 1.0 / work.at(column, column);
            for row in column + 1..size {
                let factor = work.at(row, column) * scale;
                work.set(row, column, factor);
                for place in column + 1..size {
                    let value = work.at(row, place) - factor * work.at(column, place);
                    work.set(row, place, value);
                }
            }
        }
        Self {
            triangles: work,
            order,
            sign,
            singular,
        }
    }

    /// Whether a pivot was exactly zero.
    #[must_use]
    pub const fn is_singular(&self) -> bool {
        self.singular
    }

    /// The determinant.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        (0..self.triangles.rows).fold(self.sign, |product, place| {
            product * self.triangles.at(place, place)
        })
    }

    /// The sign of the determinant and the logarithm of its size.
    #[must_use]
    pub fn sign_and_logarithm(&self) -> (f64, f64) {
        if self.singular {
            return (0.0, f64::NEG_INFINITY);
        }
        let diagonal = (0..self.triangles.rows).map(|place| self.triangles.at(place, place));
        diagonal.fold((self.sign, 0.0), |(sign, sum), value| {
            (sign * value.signum(), sum + libm::log(value.abs()))
        })
    }

    /// The solution for every column of the right-hand side.
    #[must_use]
    pub fn solve(&self, right: &Matrix) -> Matrix {
        let size = self.triangles.rows;
        let mut solution = Matrix::zeros(size, right.columns);
        for column in 0..right.columns {
            for row in 0..size {
                let mut value = right.at(self.order[row], column);
                for place in 0..row {
                    value -= self.triangles.at(row, place) * solution.at(place, column);
                }
                solution.set(row, column, value);
            }
            for row in (0..size).rev() {
                let mut value = solution.at(row, column);
                for place in row + 1..size {
                    value -= self.triangles.at(row, place) * solution.at(place, column);
                }
                solution.set(row, column, value / self.triangles.at(row, row));
            }
        }
        solution
    }
}

/// `matrix = Q R` by Householder reflections, with the signs that LAPACK gives: Q square, R of the shape of the matrix.
#[must_use]
pub fn orthogonal_and_triangle(matrix: &Matrix) -> (Matrix, Matrix) {
    let mut triangle = matrix.clone();
    let mut orthogonal = Matrix::identity(matrix.rows);
    for column in 0..matrix.columns.min(matrix.rows) {
        let below = (column + 1..matrix.rows).fold(0.0, |sum, row| {
            sum + triangle.at(row, column) * triangle.at(row, column)
        });
        if below == 0.0 {
            continue;
        }
        let head = triangle.at(column, column);
        let length = (head * head + below).sqrt();
        let target = if head >= 0.0 { -length } else { length };
        let scale = 1.0 / (head - target);
        let weight = (target - head) / target;
        let mut vector = vec![0.0; matrix.rows];
        vector[column] = 1.0;
        for (row, element) in vector.iter_mut().enumerate().skip(column + 1) {
            *element = triangle.at(row, column) * scale;
        }
        for place in column..matrix.columns {
            let sum = (column..matrix.rows)
                .fold(0.0, |sum, row| sum + vector[row] * triangle.at(row, place));
            for (row, element) in vector.iter().enumerate().skip(column) {
                let value = triangle.at(row, place) - weight * sum * element;
                triangle.set(row, place, value);
            }
        }
        triangle.set(column, column, target);
        for row in column + 1..matrix.rows {
            triangle.set(row, column, 0.0);
        }
        for row in 0..matrix.rows {
            let sum = (column..matrix.rows).fold(0.0, |sum, place| {
                sum + orthogonal.at(row, place) * vector[place]
            });
            for (place, element) in vector.iter().enumerate().skip(column) {
                let value = orthogonal.at(row, place) - weight * sum * element;
                orthogonal.set(row, place, value);
            }
        }
    }
    (orthogonal, triangle)
}

/// The lower triangle whose product with its transpose is the matrix; `None` when the matrix is not positive definite.
#[must_use]
pub fn cholesky(matrix: &Matrix) -> Option<Matrix> {
    let mut lower = Matrix::zeros(matrix.rows, matrix.rows);
    for row in 0..matrix.rows {
        for column in 0..=row {
            let sum = (0..column).fold(0.0, |sum, place| {
                sum + lower.at(row, place) * lower.at(column, place)
            });
            let rest = matrix.at(row, column) - sum;
            if row != column {
                lower.set(row, column, rest / lower.at(column, column));
            } else if rest > 0.0 {
                lower.set(row, column, rest.sqrt());
            } else {
                return None;
            }
        }
    }
    Some(lower)
}

/// Sweeps of rotations after which Jacobi's methods have converged for any matrix of floats.
const SWEEPS: usize = 60;

/// The rotation that makes two columns or axes orthogonal: cosine and sine.
fn rotation(tau: f64) -> (f64, f64) {
    let size = 1.0 / (tau.abs() + (1.0 + tau * tau).sqrt());
    let tangent = if tau >= 0.0 { size } else { -size };
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    (cosine, cosine * tangent)
}

/// Eigenvalues of a symmetric matrix in rising order, and the eigenvectors as columns; only the lower triangle is read.
#[must_use]
pub fn symmetric_eigen(matrix: &Matrix) -> (Vec<f64>, Matrix) {
    let size = matrix.rows;
    let mut work = matrix.clone();
    for row in 0..size {
        for column in row + 1..size {
            work.set(row, column, matrix.at(column, row));
        }
    }
    let mut vectors = Matrix::identity(size);
    for _ in 0..SWEEPS {
        let mut changed = false;
        for first in 0..size {
            for second in first + 1..size {
                let off = work.at(first, second);
                let scale = work.at(first, first).abs() + work.at(second, second).abs();
                if off == 0.0 || off.abs() <= f64::EPSILON * f64::EPSILON * scale {
                    continue;
                }
                changed = true;
                let tau = (work.at(second, second) - work.at(first, first)) / (2.0 * off);
                let (cosine, sine) = rotation(tau);
                for place in 0..size {
                    let (left, right) = (work.at(place, first), work.at(place, second));
                    work.set(place, first, cosine * left - sine * right);
                    work.set(place, second, sine * left + cosine * right);
                }
                for place in 0..size {
                    let (left, right) = (work.at(first, place), work.at(second, place));
                    work.set(first, place, cosine * left - sine * right);
                    work.set(second, place, sine * left + cosine * right);
                }
                work.set(first, second, 0.0);
                work.set(second, first, 0.0);
                for place in 0..size {
                    let (left, right) = (vectors.at(place, first), vectors.at(place, second));
                    vectors.set(place, first, cosine * left - sine * right);
                    vectors.set(place, second, sine * left + cosine * right);
                }
            }
        }
        if !changed {
            break;
        }
    }
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by(|left, right| work.at(*left, *left).total_cmp(&work.at(*right, *right)));
    let values = order.iter().map(|place| work.at(*place, *place)).collect();
    let mut sorted = Matrix::zeros(size, size);
    for (column, from) in order.iter().enumerate() {
        for row in 0..size {
            sorted.set(row, column, vectors.at(row, *from));
        }
    }
    (values, sorted)
}

/// `matrix = U diag(singular) V^T`, the singular values falling.
#[derive(Debug)]
pub struct Singular {
    /// The left vectors as columns, as many as there are singular values.
    pub left: Matrix,
    /// The singular values.
    pub values: Vec<f64>,
    /// The right vectors as columns, as many as there are singular values.
    pub right: Matrix,
}

/// The singular values and vectors, by rotations between the columns (Hestenes).
#[must_use]
pub fn singular(matrix: &Matrix) -> Singular {
    if matrix.rows < matrix.columns {
        let Singular {
            left,
            values,
            right,
        } = singular(&matrix.transposed());
        return Singular {
            left: right,
            values,
            right: left,
        };
    }
    let (rows, columns) = (matrix.rows, matrix.columns);
    let mut work = matrix.clone();
    let mut right = Matrix::identity(columns);
    let dot = |work: &Matrix, first: usize, second: usize| {
        (0..rows).fold(0.0, |sum, row| {
            sum + work.at(row, first) * work.at(row, second)
        })
    };
    for _ in 0..SWEEPS {
        let mut changed = false;
        for first in 0..columns {
            for second in first + 1..columns {
                let alpha = dot(&work, first, first);
                let beta = dot(&work, second, second);
                let gamma = dot(&work, first, second);
                if gamma == 0.0 || gamma.abs() <= 1e-16 * (alpha * beta).sqrt() {
                    continue;
                }
                changed = true;
                let (cosine, sine) = rotation((beta - alpha) / (2.0 * gamma));
                for turned in [&mut work, &mut right] {
                    for row in 0..turned.rows {
                        let (one, other) = (turned.at(row, first), turned.at(row, second));
                        turned.set(row, first, cosine * one - sine * other);
                        turned.set(row, second, sine * one + cosine * other);
                    }
                }
            }
        }
        if !changed {
            break;
        }
    }
    let lengths: Vec<f64> = (0..columns)
        .map(|column| dot(&work, column, column).sqrt())
        .collect();
    let mut order: Vec<usize> = (0..columns).collect();
    order.sort_by(|left, right| lengths[*right].total_cmp(&lengths[*left]));
    let largest = order.first().map_or(0.0, |place| lengths[*place]);
    let mut left = Matrix::zeros(rows, columns);
    let mut turned = Matrix::zeros(columns, columns);
    let mut values = Vec::with_capacity(columns);
    for (column, from) in order.into_iter().enumerate() {
        let length = lengths[from];
        values.push(length);
        for row in 0..columns {
            turned.set(row, column, right.at(row, from));
        }
        if length > largest * 1e-300 && length > 0.0 {
            for row in 0..rows {
                left.set(row, column, work.at(row, from) / length);
            }
        }
        // what is left of a column that has no length of its own is no direction: take one at a right angle to the others
        if length <= largest * f64::EPSILON {
            complete(&mut left, column);
        }
    }
    Singular {
        left,
        values,
        right: turned,
    }
}

/// Sets a column to a unit vector at a right angle to all columns before it.
fn complete(matrix: &mut Matrix, column: usize) {
    for axis in 0..matrix.rows {
        let mut candidate = vec![0.0; matrix.rows];
        candidate[axis] = 1.0;
        // twice, because one subtraction loses digits
        for _ in 0..2 {
            for before in 0..column {
                let share = (0..matrix.rows).fold(0.0, |sum, row| {
                    sum + candidate[row] * matrix.at(row, before)
                });
                for (row, element) in candidate.iter_mut().enumerate() {
                    *element -= share * matrix.at(row, before);
                }
            }
        }
        let length = candidate
            .iter()
            .fold(0.0, |sum, value| sum + value * value)
            .sqrt();
        if length > 0.5 / (matrix.rows as f64).sqrt() {
            for (row, element) in candidate.iter().enumerate() {
                matrix.set(row, column, element / length);
            }
            return;
        }
    }
}

/// The columns, and further ones at right angles to them, until the matrix is square.
#[must_use]
pub fn completed(matrix: &Matrix) -> Matrix {
    let mut square = Matrix::zeros(matrix.rows, matrix.rows);
    for column in 0..matrix.rows {
        if column < matrix.columns {
            for row in 0..matrix.rows {
                square.set(row, column, matrix.at(row, column));
            }
        } else {
            complete(&mut square, column);
        }
    }
    square
}
