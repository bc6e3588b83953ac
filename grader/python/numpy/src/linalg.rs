//! The functions of `numpy.linalg`.

use crate::convert;
use crate::decompose::{self, Matrix, Singular, Triangles};
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::product;
use crate::reduce;
use crate::view::{Shape, View, check_count};
use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine, builtins::PyStr};

fn done(view: View, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(view, vm))
}

fn two_dimensional(view: &View, vm: &VirtualMachine) -> PyResult<Matrix> {
    if view.rank() < 2 {
        let sentence = format!(
            "{}-dimensional array given. Array must be at least two-dimensional",
            view.rank()
        );
        return Err(errors::linear_algebra(&sentence, vm));
    }
    Ok(Matrix::of(view))
}

fn square(view: &View, vm: &VirtualMachine) -> PyResult<Matrix> {
    let matrix = two_dimensional(view, vm)?;
    if matrix.rows != matrix.columns {
        return Err(errors::linear_algebra(
            "Last 2 dimensions of the array must be square",
            vm,
        ));
    }
    Ok(matrix)
}

fn regular(matrix: &Matrix, vm: &VirtualMachine) -> PyResult<Triangles> {
    let triangles = Triangles::of(matrix);
    if triangles.is_singular() {
        return Err(errors::linear_algebra("Singular matrix", vm));
    }
    Ok(triangles)
}

fn singular(matrix: &Matrix, vm: &VirtualMachine) -> PyResult<Singular> {
    if !matrix.is_finite() {
        return Err(errors::linear_algebra("SVD did not converge", vm));
    }
    Ok(decompose::singular(matrix))
}

/// `numpy.linalg.solve`.
///
/// # Errors
///
/// LinAlgError for a matrix that is singular or not square, ValueError for a right-hand side of another length.
pub fn solve(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    let right = arguments.array("b", vm)?;
    if right.rank() == 0 {
        return Err(vm.new_value_error(
            "solve: Input operand 1 does not have enough dimensions (has 0, gufunc core with signature (m,m),(m,n)->(m,n) requires 2)",
        ));
    }
    let tall = if right.rank() == 1 {
        right.as_column()
    } else {
        right.clone()
    };
    if tall.rows() != matrix.rows {
        let (name, signature) = if right.rank() == 1 {
            ("solve1", "(m,m),(m)->(m)")
        } else {
            ("solve", "(m,m),(m,n)->(m,n)")
        };
        return Err(vm.new_value_error(format!(
            "{name}: Input operand 1 has a mismatch in its core dimension 0, with gufunc signature {signature} (size {} is different from {})",
            tall.rows(),
            matrix.rows
        )));
    }
    let solution = regular(&matrix, vm)?.solve(&Matrix::of(&tall)).into_view();
    done(solution.reshaped(right.shape()), vm)
}

/// `numpy.linalg.inv`.
///
/// # Errors
///
/// LinAlgError for a matrix that is singular or not square.
pub fn inv(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    done(inverse(&matrix, vm)?.into_view(), vm)
}

fn inverse(matrix: &Matrix, vm: &VirtualMachine) -> PyResult<Matrix> {
    Ok(regular(matrix, vm)?.solve(&Matrix::identity(matrix.rows)))
}

/// `numpy.linalg.det`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not square.
pub fn det(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    Ok(vm
        .ctx
        .new_float(Triangles::of(&matrix).determinant())
        .into())
}

/// `numpy.linalg.slogdet`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not square.
pub fn slogdet(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    let (sign, logarithm) = Triangles::of(&matrix).sign_and_logarithm();
    let parts = vec![
        vm.ctx.new_float(sign).into(),
        vm.ctx.new_float(logarithm).into(),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `U diag(1 / s) V^T` transposed: the pseudo-inverse, small singular values left out; and how many stay.
fn pseudo_inverse(parts: &Singular, cut: f64) -> (Matrix, usize) {
    let largest = parts.values.first().copied().unwrap_or(0.0);
    let kept = parts
        .values
        .iter()
        .filter(|value| **value > cut * largest)
        .count();
    let mut scaled = parts.right.clone();
    for column in 0..scaled.columns {
        let scale = if column < kept {
            1.0 / parts.values[column]
        } else {
            0.0
        };
        for row in 0..scaled.rows {
            let value = scaled.at(row, column) * scale;
            scaled.set(row, column, value);
        }
    }
    (scaled.times(&parts.left.transposed()), kept)
}

/// `numpy.linalg.pinv`.
///
/// # Errors
///
/// LinAlgError for what is no matrix, or not finite.
pub fn pinv(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = two_dimensional(&arguments.array("a", vm)?, vm)?;
    let cut = match arguments.optional_float("rcond", vm)? {
        Some(cut) => cut,
        None => arguments
            .keyword("rtol", vm)
            .map(|object| convert::float(&object, vm))
            .transpose()?
            .unwrap_or(1e-15),
    };
    done(
        pseudo_inverse(&singular(&matrix, vm)?, cut).0.into_view(),
        vm,
    )
}

/// `numpy.linalg.lstsq`.
///
/// # Errors
///
/// LinAlgError for what is no matrix, or for lengths that do not match.
pub fn lstsq(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = two_dimensional(&arguments.array("a", vm)?, vm)?;
    let right = arguments.array("b", vm)?;
    // below zero it stands for the precision of floats, which is what it is without
    let cut = arguments.optional_float("rcond", vm)?;
    let cut = cut.filter(|cut| *cut >= 0.0);
    let tall = if right.rank() < 2 {
        right.as_column()
    } else {
        right.clone()
    };
    if tall.rows() != matrix.rows {
        return Err(errors::linear_algebra("Incompatible dimensions", vm));
    }
    let parts = singular(&matrix, vm)?;
    let longest = matrix.rows.max(matrix.columns);
    let (inverse, rank) = pseudo_inverse(&parts, cut.unwrap_or(f64::EPSILON * longest as f64));
    let known = Matrix::of(&tall);
    let solution = inverse.times(&known);
    let residuals = if rank == matrix.columns && matrix.rows > matrix.columns {
        let found = matrix.times(&solution);
        (0..known.columns)
            .map(|column| {
                (0..known.rows).fold(0.0, |sum, row| {
                    let error = known.at(row, column) - found.at(row, column);
                    sum + error * error
                })
            })
            .collect()
    } else {
        Vec::new()
    };
    let solution = if right.rank() < 2 {
        View::vector(solution.values)
    } else {
        solution.into_view()
    };
    let parts = vec![
        convert::object(solution, vm),
        convert::object(View::vector(residuals), vm),
        vm.ctx.new_int(rank).into(),
        convert::object(View::vector(parts.values), vm),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `numpy.linalg.svd`.
///
/// # Errors
///
/// LinAlgError for what is no matrix, or not finite.
pub fn svd(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = two_dimensional(&arguments.array("a", vm)?, vm)?;
    let full = arguments
        .optional_truth("full_matrices", vm)?
        .unwrap_or(true);
    let vectors = arguments.optional_truth("compute_uv", vm)?.unwrap_or(true);
    let Singular {
        left,
        values,
        right,
    } = singular(&matrix, vm)?;
    let values = convert::object(View::vector(values), vm);
    if !vectors {
        return Ok(values);
    }
    let (left, right) = if full {
        check_count(left.rows.saturating_mul(left.rows), vm)?;
        check_count(right.rows.saturating_mul(right.rows), vm)?;
        (decompose::completed(&left), decompose::completed(&right))
    } else {
        (left, right)
    };
    let parts = vec![
        convert::object(left.into_view(), vm),
        values,
        convert::object(right.transposed().into_view(), vm),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `numpy.linalg.qr`.
///
/// # Errors
///
/// LinAlgError for what is no matrix, ValueError for an unknown mode.
pub fn qr(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = two_dimensional(&arguments.array("a", vm)?, vm)?;
    let mode = match arguments.optional("mode", vm) {
        Some(mode) => mode.str(vm)?.to_string_lossy().into_owned(),
        None => "reduced".to_owned(),
    };
    check_count(matrix.rows.saturating_mul(matrix.rows), vm)?;
    let (orthogonal, triangle) = decompose::orthogonal_and_triangle(&matrix);
    let shorter = matrix.rows.min(matrix.columns);
    let (orthogonal, triangle) = match mode.as_str() {
        "complete" => (orthogonal, triangle),
        "reduced" => (
            orthogonal.first_columns(shorter),
            triangle.first_rows(shorter),
        ),
        "r" => return done(triangle.first_rows(shorter).into_view(), vm),
        _ => return Err(vm.new_value_error(format!("Unrecognized mode '{mode}'"))),
    };
    let parts = vec![
        convert::object(orthogonal.into_view(), vm),
        convert::object(triangle.into_view(), vm),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `numpy.linalg.cholesky`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not square or not positive definite.
pub fn cholesky(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    match decompose::cholesky(&matrix) {
        Some(lower) => done(lower.into_view(), vm),
        None => Err(errors::linear_algebra(
            "Matrix is not positive definite",
            vm,
        )),
    }
}

fn symmetric(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<(Vec<f64>, Matrix)> {
    let matrix = square(&arguments.array("a", vm)?, vm)?;
    let upper = match arguments.optional("UPLO", vm) {
        Some(which) => which.str(vm)?.to_string_lossy().eq_ignore_ascii_case("u"),
        None => false,
    };
    if !matrix.is_finite() {
        return Err(errors::linear_algebra("Eigenvalues did not converge", vm));
    }
    Ok(decompose::symmetric_eigen(&if upper {
        matrix.transposed()
    } else {
        matrix
    }))
}

/// `numpy.linalg.eigh`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not square or not finite.
pub fn eigh(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (values, vectors) = symmetric(arguments, vm)?;
    let parts = vec![
        convert::object(View::vector(values), vm),
        convert::object(vectors.into_view(), vm),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `numpy.linalg.eigvalsh`.
///
/// # Errors
///
/// As [`eigh`].
pub fn eigvalsh(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (values, _) = symmetric(arguments, vm)?;
    done(View::vector(values), vm)
}

/// Which norm.
enum Order {
    Default,
    Number(f64),
    Word(String),
}

impl Order {
    fn read(object: Option<PyObjectRef>, vm: &VirtualMachine) -> PyResult<Self> {
        let Some(object) = object else {
            return Ok(Self::Default);
        };
        if object.downcast_ref::<PyStr>().is_some() {
            return Ok(Self::Word(object.str(vm)?.to_string_lossy().into_owned()));
        }
        convert::float(&object, vm).map(Self::Number)
    }
}

fn length(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |sum, value| sum + value * value)
        .sqrt()
}

fn vector_norm(lane: &[f64], order: &Order, vm: &VirtualMachine) -> PyResult<f64> {
    let sizes = || lane.iter().map(|value| value.abs());
    let larger = |left: f64, right: f64| {
        if left.is_nan() || left >= right {
            left
        } else {
            right
        }
    };
    let smaller = |left: f64, right: f64| {
        if left.is_nan() || left <= right {
            left
        } else {
            right
        }
    };
    Ok(match order {
        Order::Default => length(lane),
        Order::Word(word) => {
            return Err(vm.new_value_error(format!("Invalid norm order '{word}' for vectors")));
        }
        Order::Number(f64::INFINITY) => {
            sizes().reduce(larger).ok_or_else(|| empty("maximum", vm))?
        }
        Order::Number(f64::NEG_INFINITY) => sizes()
            .reduce(smaller)
            .ok_or_else(|| empty("minimum", vm))?,
        Order::Number(0.0) => lane.iter().filter(|value| **value != 0.0).count() as f64,
        Order::Number(1.0) => sizes().fold(0.0, |sum, value| sum + value),
        Order::Number(2.0) => length(lane),
        Order::Number(order) => {
            let sum = sizes().fold(0.0, |sum, value| sum + libm::pow(value, *order));
            libm::pow(sum, 1.0 / order)
        }
    })
}

fn empty(name: &str, vm: &VirtualMachine) -> rustpython_vm::builtins::PyBaseExceptionRef {
    vm.new_value_error(format!(
        "zero-size array to reduction operation {name} which has no identity"
    ))
}

fn matrix_norm(matrix: &Matrix, order: &Order, vm: &VirtualMachine) -> PyResult<f64> {
    let sums = |matrix: &Matrix| {
        (0..matrix.rows)
            .map(|row| {
                (0..matrix.columns).fold(0.0, |sum, column| sum + matrix.at(row, column).abs())
            })
            .collect::<Vec<f64>>()
    };
    let largest = |sums: Vec<f64>| {
        sums.into_iter()
            .reduce(f64::max)
            .ok_or_else(|| empty("maximum", vm))
    };
    let smallest = |sums: Vec<f64>| {
        sums.into_iter()
            .reduce(f64::min)
            .ok_or_else(|| empty("minimum", vm))
    };
    let spectrum = || Ok(singular(matrix, vm)?.values);
    match order {
        Order::Default => Ok(length(&matrix.values)),
        Order::Word(word) if word == "fro" => Ok(length(&matrix.values)),
        Order::Word(word) if word == "nuc" => Ok(reduce::total(&spectrum()?)),
        Order::Number(f64::INFINITY) => largest(sums(matrix)),
        Order::Number(f64::NEG_INFINITY) => smallest(sums(matrix)),
        Order::Number(1.0) => largest(sums(&matrix.transposed())),
        Order::Number(-1.0) => smallest(sums(&matrix.transposed())),
        Order::Number(2.0) => largest(spectrum()?),
        Order::Number(-2.0) => smallest(spectrum()?),
        Order::Number(_) | Order::Word(_) => {
            Err(vm.new_value_error("Invalid norm order for matrices."))
        }
    }
}

/// `numpy.linalg.norm`.
///
/// # Errors
///
/// ValueError for an order that does not go with the shape, AxisError for an axis that is not there.
pub fn norm(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("x", vm)?;
    let order = Order::read(arguments.optional("ord", vm), vm)?;
    let axis = arguments.optional("axis", vm);
    let keep_dimensions = arguments.optional_truth("keepdims", vm)?.unwrap_or(false);
    let flat = axis.is_none() && matches!(order, Order::Default);
    let single = match &axis {
        Some(axis) => convert::integers(axis, vm)?.len() == 1,
        None => view.rank() < 2,
    };
    let axis = reduce::axis_of(axis, view.rank(), vm)?;
    let result = if flat || single {
        reduce::along(&view, axis, keep_dimensions, Dtype::Float, |lane| {
            vector_norm(lane, &order, vm)
        })?
    } else if view.rank() == 2 {
        let value = matrix_norm(&Matrix::of(&view), &order, vm)?;
        let shape = if keep_dimensions {
            Shape::matrix(1, 1)
        } else {
            Shape::NUMBER
        };
        View::new(Dtype::Float, shape, vec![value])
    } else {
        return Err(vm.new_value_error("Improper number of dimensions to norm."));
    };
    done(result, vm)
}

/// `numpy.linalg.cond`.
///
/// # Errors
///
/// LinAlgError for what is no matrix.
pub fn cond(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let matrix = two_dimensional(&arguments.array("x", vm)?, vm)?;
    let order = Order::read(arguments.optional("p", vm), vm)?;
    let value = match order {
        Order::Default | Order::Number(2.0) => {
            let values = singular(&matrix, vm)?.values;
            let least = values.last().copied().unwrap_or(0.0);
            values.first().map_or(f64::NAN, |largest| largest / least)
        }
        order => {
            if matrix.rows != matrix.columns {
                return Err(errors::linear_algebra(
                    "Last 2 dimensions of the array must be square",
                    vm,
                ));
            }
            match inverse(&matrix, vm) {
                Ok(inverse) => {
                    matrix_norm(&matrix, &order, vm)? * matrix_norm(&inverse, &order, vm)?
                }
                Err(_) => f64::INFINITY,
            }
        }
    };
    Ok(vm.ctx.new_float(value).into())
}

/// `numpy.linalg.matrix_rank`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not finite.
pub fn matrix_rank(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("A", vm)?;
    let tolerance = arguments.optional_float("tol", vm)?;
    if view.rank() < 2 {
        let rank = i32::from(view.values().iter().any(|value| *value != 0.0));
        return Ok(vm.ctx.new_int(rank).into());
    }
    let values = singular(&Matrix::of(&view), vm)?.values;
    let largest = values.first().copied().unwrap_or(0.0);
    let longest = view.rows().max(view.columns()) as f64;
    let cut = tolerance.unwrap_or(largest * longest * f64::EPSILON);
    let rank = values.iter().filter(|value| **value > cut).count();
    Ok(vm.ctx.new_int(rank).into())
}

/// `numpy.linalg.matrix_power`.
///
/// # Errors
///
/// LinAlgError for a matrix that is not square, or singular with a negative exponent; TypeError for an exponent that is no int.
pub fn matrix_power(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let matrix = square(&view, vm)?;
    let exponent = arguments.required("n", vm)?;
    let exponent = convert::integer(&exponent, vm)
        .map_err(|_| vm.new_type_error("exponent must be an integer"))?;
    let (mut factor, dtype) = if exponent < 0 {
        (inverse(&matrix, vm)?.into_view(), Dtype::Float)
    } else {
        (view.copied(), view.dtype())
    };
    let mut result = View::new(dtype, view.shape(), Matrix::identity(matrix.rows).values);
    let mut left = exponent.unsigned_abs();
    while left > 0 {
        if left & 1 == 1 {
            result = product::multiplied(&result, &factor, vm)?;
        }
        left >>= 1;
        if left > 0 {
            factor = product::multiplied(&factor, &factor, vm)?;
        }
    }
    done(result, vm)
}
