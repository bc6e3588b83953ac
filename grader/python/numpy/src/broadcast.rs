//! numpy's rule for shapes that differ, and the loop over two views.

use crate::dtype::Dtype;
use crate::errors;
use crate::view::{Shape, View};
use rustpython_vm::{PyResult, VirtualMachine};

/// The shape both operands are repeated to: equal dimensions, or one of them 1.
#[must_use]
pub fn common_shape(left: Shape, right: Shape) -> Option<Shape> {
    let common = |left: usize, right: usize| match (left, right) {
        (1, other) | (other, 1) => Some(other),
        (left, right) => (left == right).then_some(left),
    };
    let rows = common(left.rows(), right.rows())?;
    let columns = common(left.columns(), right.columns())?;
    Some(Shape::matrix(rows, columns).with_rank(left.rank().max(right.rank())))
}

/// Both views in their common shape.
///
/// # Errors
///
/// ValueError, with numpy's sentence, when there is none.
pub fn together(left: &View, right: &View, vm: &VirtualMachine) -> PyResult<(View, View)> {
    let refuse = || errors::no_broadcast(left.shape(), right.shape(), vm);
    let shape = common_shape(left.shape(), right.shape()).ok_or_else(refuse)?;
    shape.check_size(vm)?;
    match (left.broadcast_to(shape), right.broadcast_to(shape)) {
        (Some(left), Some(right)) => Ok((left, right)),
        _ => Err(refuse()),
    }
}

/// A new array from pairs of elements.
///
/// # Errors
///
/// ValueError when the shapes do not go together.
pub fn combine(
    left: &View,
    right: &View,
    dtype: Dtype,
    each: impl Fn(f64, f64) -> f64,
    vm: &VirtualMachine,
) -> PyResult<View> {
    if let Some(paired) = left.paired(right, dtype, &each) {
        return Ok(paired);
    }
    let (left, right) = together(left, right, vm)?;
    let shape = left.shape();
    let mut values = Vec::with_capacity(shape.size());
    let (left_step, right_step) = (left.strides().1, right.strides().1);
    for row in 0..shape.rows() {
        let mut left_place = left.position(row, 0) as isize;
        let mut right_place = right.position(row, 0) as isize;
        for _ in 0..shape.columns() {
            values.push(each(
                left.cell(left_place as usize).get(),
                right.cell(right_place as usize).get(),
            ));
            left_place += left_step;
            right_place += right_step;
        }
    }
    Ok(View::new(dtype, shape, values))
}

/// A new array from each element.
#[must_use]
pub fn map(view: &View, dtype: Dtype, each: impl Fn(f64) -> f64) -> View {
    view.mapped(dtype, each)
}
