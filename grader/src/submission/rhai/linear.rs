//! Built-ins of linear algebra: construction, indexing and solving.

use std::any::TypeId;
use std::ops;

use rhai::{Array, Dynamic, INT, ImmutableString};

use super::budget::Meter;
use super::foreign;
use super::library::{Arguments, Library};
use super::mistake::{Fault, Problem, fault, fault_with_help};
use super::operand::{Operand, as_number, as_whole, count, matrix, number, vector};
use super::range::Range;
use super::vector::{Matrix, Vector};
use super::words::describe;

pub(super) fn register(library: &mut Library) {
    register_types(library);
    register_makers(library);
    register_products(library);
    register_indexing(library);
}

fn register_types(library: &mut Library) {
    let module = library.module_mut();
    module.set_custom_type::<Vector>("vector");
    module.set_custom_type::<Matrix>("matrix");
    module.set_iterable::<Vector>();
    module.set_iterable::<Matrix>();
}

fn register_makers(library: &mut Library) {
    for (name, value) in [("zeros", 0.0), ("ones", 1.0)] {
        library.function(name, 1, move |meter, arguments| {
            let length = count(name, arguments[0])?;
            meter.list(length)?;
            Ok(Dynamic::from(
                std::iter::repeat_n(value, length).collect::<Vector>(),
            ))
        });
        library.function(name, 2, move |meter, arguments| {
            let (rows, columns) = size(meter, name, arguments)?;
            Ok(Dynamic::from(Matrix::from_fn(rows, columns, |_, _| value)))
        });
    }
    library.function("eye", 1, |meter, arguments| {
        let n = count("eye", arguments[0])?;
        meter.list(n.saturating_mul(n))?;
        Ok(Dynamic::from(Matrix::from_fn(n, n, |i, j| {
            f64::from(u8::from(i == j))
        })))
    });
    library.function("vector", 1, |meter, arguments| {
        let vector = vector("vector", arguments[0])?;
        meter.charge(vector.len())?;
        Ok(Dynamic::from(vector))
    });
    library.function("matrix", 1, |meter, arguments| {
        let matrix = matrix("matrix", arguments[0])?;
        meter.list(matrix.rows() * matrix.columns())?;
        Ok(Dynamic::from(matrix))
    });
    library.function("diag", 1, |meter, arguments| {
        let vector = vector("diag", arguments[0])?;
        let n = vector.len();
        meter.list(n.saturating_mul(n))?;
        Ok(Dynamic::from(Matrix::from_fn(n, n, |i, j| {
            if i == j { vector.elements()[i] } else { 0.0 }
        })))
    });
    library.function("linspace", 3, |meter, arguments| {
        let (from, to) = (
            number("linspace", arguments[0])?,
            number("linspace", arguments[1])?,
        );
        let points = count("linspace", arguments[2])?;
        meter.list(points)?;
        let steps = points.saturating_sub(1).max(1) as f64;
        Ok(Dynamic::from(
            (0..points)
                .map(|i| from + (to - from) * (i as f64 / steps))
                .collect::<Vector>(),
        ))
    });
}

fn size(
    meter: &Meter,
    name: &str,
    arguments: Arguments<'_, '_>,
) -> Result<(usize, usize), Problem> {
    let (rows, columns) = (count(name, arguments[0])?, count(name, arguments[1])?);
    // a matrix without columns would still cost its rows
    meter.list(rows.saturating_mul(columns).max(rows).max(columns))?;
    Ok((rows, columns))
}

fn register_products(library: &mut Library) {
    library.function("dot", 2, |meter, arguments| {
        let (a, b) = two_vectors(meter, "dot", arguments)?;
        Ok(a.dot(&b).into())
    });
    library.function("cross", 2, |meter, arguments| {
        let (a, b) = two_vectors(meter, "cross", arguments)?;
        match (a.elements(), b.elements()) {
            ([ax, ay, az], [bx, by, bz]) => Ok(Dynamic::from(Vector::new(&[
                ay * bz - az * by,
                az * bx - ax * bz,
                ax * by - ay * bx,
            ]))),
            // the z component of the cross product in the plane
            ([ax, ay], [bx, by]) => Ok((ax * by - ay * bx).into()),
            _ => Err(fault(format!(
                "`cross` takes vectors of 3, or of 2, got vectors of {}",
                a.len()
            ))),
        }
    });
    library.function("norm", 1, |meter, arguments| {
        if let Some(number) = as_number(arguments[0]) {
            return Ok(number.abs().into());
        }
        let vector = vector("norm", arguments[0])?;
        meter.charge(vector.len())?;
        Ok(vector.norm().into())
    });
    library.function("sum", 1, |meter, arguments| {
        let vector = vector("sum", arguments[0])?;
        meter.charge(vector.len())?;
        Ok(vector.elements().iter().fold(0.0, |sum, x| sum + x).into())
    });
    library.function("transpose", 1, |meter, arguments| {
        transpose(meter, arguments[0])
    });
    library.function("solve", 2, |meter, arguments| {
        let a = square(meter, "solve", arguments[0])?;
        let (right, is_vector) = match Operand::of(arguments[1]) {
            Operand::Vector(v) if v.len() == a.rows() => {
                (Matrix::from_fn(v.len(), 1, |i, _| v.elements()[i]), true)
            }
            Operand::Matrix(m) if m.rows() == a.rows() => (m, false),
            _ => {
                return Err(fault(format!(
                    "`solve` with a {n}x{n} matrix takes a vector of {n}, got {}",
                    describe(arguments[1]),
                    n = a.rows()
                )));
            }
        };
        meter.charge(a.rows() * a.rows() * right.columns())?;
        let solution = a.solve(&right).ok_or_else(singular)?;
        Ok(if is_vector {
            Dynamic::from(solution.column(0))
        } else {
            Dynamic::from(solution)
        })
    });
    for name in ["inverse", "inv"] {
        library.function(name, 1, move |meter, arguments| {
            let a = square(meter, name, arguments[0])?;
            let n = a.rows();
            meter.charge(n * n * n)?;
            let identity = Matrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)));
            a.solve(&identity).map(Dynamic::from).ok_or_else(singular)
        });
    }
    for name in ["determinant", "det"] {
        library.function(name, 1, move |meter, arguments| {
            Ok(square(meter, name, arguments[0])?.determinant().into())
        });
    }
}

fn two_vectors(
    meter: &Meter,
    name: &str,
    arguments: Arguments<'_, '_>,
) -> Result<(Vector, Vector), Problem> {
    let (a, b) = (vector(name, arguments[0])?, vector(name, arguments[1])?);
    meter.charge(a.len())?;
    if a.len() == b.len() {
        Ok((a, b))
    } else {
        Err(fault(format!(
            "`{name}` takes two vectors of the same length, got {} and {}",
            describe(arguments[0]),
            describe(arguments[1])
        )))
    }
}

/// A square matrix, charged for an elimination.
fn square(meter: &Meter, name: &str, value: &Dynamic) -> Result<Matrix, Problem> {
    let matrix = matrix(name, value)?;
    if !matrix.is_square() {
        return Err(fault_with_help(
            format!("`{name}` takes a square matrix, got {}", describe(value)),
            match matrix.rows() > matrix.columns() {
                true => {
                    "there are more equations than unknowns: leave out the rows that do not count, such as those of the turns; with a number in v for every row, solve(transpose(m) * m, transpose(m) * v) is the least-squares answer"
                }
                false => "least squares of m * x = v: solve(transpose(m) * m, transpose(m) * v)",
            },
        ));
    }
    let n = matrix.rows();
    meter.charge(n.saturating_mul(n).saturating_mul(n))?;
    Ok(matrix)
}

fn singular() -> Problem {
    fault_with_help(
        "the matrix is singular: it has no inverse",
        "a Jacobian is singular where the arm is straight or folded; elsewhere `print` the matrix: which row or column is wrong?",
    )
}

fn transpose(meter: &Meter, value: &Dynamic) -> Result<Dynamic, Problem> {
    if let Operand::Vector(vector) = Operand::of(value) {
        return Err(fault_with_help(
            format!(
                "`transpose` takes a matrix, got a vector of {}",
                vector.len()
            ),
            "leave it out: a vector is neither a row nor a column; dot(a, b) is the product of two",
        ));
    }
    let matrix = matrix("transpose", value)?;
    meter.charge(matrix.rows() * matrix.columns())?;
    Ok(Dynamic::from(matrix.transpose()))
}

fn register_indexing(library: &mut Library) {
    library.function("rows", 1, |_, arguments| {
        Ok(Dynamic::from_int(
            matrix("rows", arguments[0])?.rows() as INT
        ))
    });
    library.function("cols", 1, |_, arguments| {
        Ok(Dynamic::from_int(
            matrix("cols", arguments[0])?.columns() as INT
        ))
    });
    library.function("row", 2, |meter, arguments| {
        let matrix = matrix("row", arguments[0])?;
        meter.charge(matrix.columns())?;
        Ok(Dynamic::from(matrix.row(index(
            arguments[1],
            matrix.rows(),
            "matrix",
            "rows",
        )?)))
    });
    library.function("col", 2, |meter, arguments| {
        let matrix = matrix("col", arguments[0])?;
        meter.charge(matrix.rows())?;
        Ok(Dynamic::from(matrix.column(index(
            arguments[1],
            matrix.columns(),
            "matrix",
            "columns",
        )?)))
    });

    const GET: &str = "index$get$";
    const SET: &str = "index$set$";
    let (any, vectors, matrices) = (
        TypeId::of::<Dynamic>(),
        TypeId::of::<Vector>(),
        TypeId::of::<Matrix>(),
    );
    for kind in [TypeId::of::<INT>(), any] {
        library.internal(GET, &[vectors, kind], get_element);
        library.internal(GET, &[matrices, kind], get_row);
    }
    library.internal(GET, &[any, any], |_, arguments| {
        let owner = describe(arguments[0]);
        Err(match arguments[1].as_immutable_string_ref() {
            Ok(key) if arguments[0].is_array() => {
                let other = foreign::function(key.as_str());
                let help = "the elements of a list have numbers: the first is [0]";
                fault_with_help(
                    format!("{owner} has no `{}`", key.as_str()),
                    other.unwrap_or_else(|| help.to_owned()),
                )
            }
            _ => fault(format!("{owner} has no elements")),
        })
    });
    for kind in [TypeId::of::<f64>(), any] {
        library.internal(SET, &[vectors, TypeId::of::<INT>(), kind], set_element);
    }
    library.internal(SET, &[vectors, TypeId::of::<f64>(), any], set_element);
    for kind in [TypeId::of::<INT>(), TypeId::of::<f64>()] {
        library.internal(SET, &[matrices, kind, any], set_row);
    }
    for (place, name) in ["x", "y", "z"].into_iter().enumerate() {
        library.internal(&format!("get${name}"), &[vectors], move |_, arguments| {
            let vector = vector(name, arguments[0])?;
            vector
                .elements()
                .get(place)
                .map(|x| (*x).into())
                .ok_or_else(|| fault(format!("{} has no `{name}`", describe(arguments[0]))))
        });
    }
    for kind in [matrices, TypeId::of::<Array>()] {
        library.internal("get$T", &[kind], |meter, arguments| {
            transpose(meter, arguments[0])
        });
    }
}

fn get_element(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let Some(vector) = arguments[0].read_lock::<Vector>() else {
        return Err(fault("this is not a vector"));
    };
    if let Some(range) = range(arguments[1]) {
        let part = vector.elements().get(range.clone()).ok_or_else(|| {
            fault(format!(
                "{}..{} goes past the end of a vector of {}",
                range.start,
                range.end,
                vector.len()
            ))
        })?;
        meter.charge(part.len())?;
        return Ok(Dynamic::from(Vector::new(part)));
    }
    let index = index(arguments[1], vector.len(), "vector", "elements")?;
    Ok(vector.elements()[index].into())
}

fn set_element(_: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let value = number("an element of a vector", arguments[2])?;
    let constant = arguments[0].is_read_only();
    let index = {
        let Some(vector) = arguments[0].read_lock::<Vector>() else {
            return Err(fault("this is not a vector"));
        };
        let index = index(arguments[1], vector.len(), "vector", "elements")?;
        // the engine also writes back a value that it only read, as in `V[0].abs()`: that changes nothing
        if vector.elements()[index].to_bits() == value.to_bits() {
            return Ok(Dynamic::UNIT);
        }
        index
    };
    if constant {
        return Err(constant_fault());
    }
    if let Some(mut vector) = arguments[0].write_lock::<Vector>() {
        vector.elements_mut()[index] = value;
    }
    Ok(Dynamic::UNIT)
}

fn get_row(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let matrix = matrix("index", arguments[0])?;
    meter.charge(matrix.columns())?;
    let index = index(arguments[1], matrix.rows(), "matrix", "rows")?;
    Ok(Dynamic::from(matrix.row(index)))
}

fn set_row(meter: &Meter, arguments: Arguments<'_, '_>) -> Result<Dynamic, Problem> {
    let Operand::Vector(row) = Operand::of(arguments[2]) else {
        return Err(fault_with_help(
            format!(
                "a row of a matrix is a list, got {}",
                describe(arguments[2])
            ),
            "an element is m[0][1]; zeros(2) is a vector of 2, and zeros(2, 1) a matrix",
        ));
    };
    let place = std::mem::take(arguments[1]);
    let constant = arguments[0].is_read_only();
    let Some(mut matrix) = arguments[0].write_lock::<Matrix>() else {
        return Err(if constant {
            constant_fault()
        } else {
            fault("this is not a matrix")
        });
    };
    meter.charge(matrix.columns())?;
    let index = index(&place, matrix.rows(), "matrix", "rows")?;
    if row.len() != matrix.columns() {
        return Err(fault(format!(
            "a row of this matrix has {} elements, got {}",
            matrix.columns(),
            row.len()
        )));
    }
    if matrix.row(index) == row {
        return Ok(Dynamic::UNIT);
    }
    if constant {
        return Err(constant_fault());
    }
    matrix.set_row(index, &row);
    Ok(Dynamic::UNIT)
}

fn constant_fault() -> Problem {
    fault_with_help("a constant cannot change", "copy it with `let` first")
}

/// A value as an index; counting starts at 0 and never from the end.
pub(super) fn index(
    value: &Dynamic,
    length: usize,
    container: &str,
    parts: &str,
) -> Result<usize, Problem> {
    let Some(index) = as_whole(value) else {
        if let Ok(text) = value.as_immutable_string_ref() {
            let text: &ImmutableString = &text;
            return Err(Problem::Fault(Fault {
                message: format!("a {container} has no `{text}`"),
                help: match text.as_str() {
                    "T" => Some(
                        "leave it out: a vector is neither a row nor a column; dot(a, b) is the product of two"
                            .to_owned(),
                    ),
                    text => foreign::function(text),
                },
                past_the_end: None,
            }));
        }
        return Err(fault(format!(
            "an index is an integer, got {}",
            describe(value)
        )));
    };
    match usize::try_from(index) {
        Ok(index) if index < length => Ok(index),
        Ok(index) => Err(past_the_end(index, length, container, parts)),
        Err(_) => Err(fault_with_help(
            format!("index {index} is negative"),
            "counting starts at 0; the last is [len(...) - 1]",
        )),
    }
}

fn past_the_end(index: usize, length: usize, container: &str, parts: &str) -> Problem {
    let help = match length.checked_sub(1) {
        None => format!("it has no {parts} yet"),
        Some(last) => format!("counting starts at 0: the last is {last}"),
    };
    Problem::Fault(Fault {
        message: format!("index {index} is past the end of a {container} with {length} {parts}"),
        help: Some(help),
        past_the_end: Some((index, length)),
    })
}

/// A value as a range of indices.
fn range(value: &Dynamic) -> Option<ops::Range<usize>> {
    let range = Range::of(value)?;
    Some(usize::try_from(range.from).ok()?..usize::try_from(range.to).ok()?)
}

/// The error for an index of a list, which the engine indexes itself as long as the index is inside.
pub(super) fn list_index_fault(list: &Array, index: INT) -> Problem {
    match usize::try_from(index) {
        Ok(index) => past_the_end(index, list.len(), "list", "elements"),
        Err(_) => fault(format!(
            "index {index} is outside of a list of {}",
            list.len()
        )),
    }
}
