//! The exception types that are numpy's own, and the sentences that several functions share.

use crate::view::Shape;
use rustpython_vm::{
    PyResult, VirtualMachine,
    builtins::{PyBaseExceptionRef, PyTypeRef},
};
use std::cell::RefCell;

/// numpy's own exception types.
#[derive(Clone)]
pub struct Types {
    /// `numpy.linalg.LinAlgError`, a ValueError.
    pub linear_algebra: PyTypeRef,
    /// `numpy.exceptions.AxisError`, a ValueError and an IndexError.
    pub axis: PyTypeRef,
    /// `UFuncTypeError`, a TypeError.
    pub ufunc: PyTypeRef,
}

thread_local! {
    // a submission's interpreter has one thread; `except LinAlgError` needs the very type that is raised
    static TYPES: RefCell<Option<Types>> = const { RefCell::new(None) };
}

/// numpy's own exception types, made at the first call.
#[must_use]
pub fn types(vm: &VirtualMachine) -> Types {
    TYPES.with(|types| {
        types
            .borrow_mut()
            .get_or_insert_with(|| {
                let exceptions = &vm.ctx.exceptions;
                let make =
                    |module, name, bases| vm.ctx.new_exception_type(module, name, Some(bases));
                Types {
                    linear_algebra: make(
                        "numpy.linalg",
                        "LinAlgError",
                        vec![exceptions.value_error.to_owned()],
                    ),
                    axis: make(
                        "numpy.exceptions",
                        "AxisError",
                        vec![
                            exceptions.value_error.to_owned(),
                            exceptions.index_error.to_owned(),
                        ],
                    ),
                    ufunc: make(
                        "numpy",
                        "UFuncTypeError",
                        vec![exceptions.type_error.to_owned()],
                    ),
                }
            })
            .clone()
    })
}

/// A LinAlgError with this sentence.
pub fn linear_algebra(sentence: &str, vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_exception_msg(types(vm).linear_algebra, sentence.to_owned().into())
}

/// A UFuncTypeError with this sentence.
pub fn ufunc(sentence: String, vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_exception_msg(types(vm).ufunc, sentence.into())
}

/// The axis does not exist.
pub fn axis(axis: isize, rank: usize, vm: &VirtualMachine) -> PyBaseExceptionRef {
    let sentence = format!("axis {axis} is out of bounds for array of dimension {rank}");
    vm.new_exception_msg(types(vm).axis, sentence.into())
}

/// The result would have three or more dimensions.
pub fn too_many_dimensions(vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_value_error("arrays here have at most 2 dimensions")
}

/// Two shapes that do not go together.
pub fn no_broadcast(left: Shape, right: Shape, vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_value_error(format!(
        "operands could not be broadcast together with shapes {} {} ",
        left.sentence(),
        right.sentence()
    ))
}

/// The axis of an array as a row-wise index, counted from the end when negative.
///
/// # Errors
///
/// AxisError when there is no such axis.
pub fn checked_axis(index: isize, rank: usize, vm: &VirtualMachine) -> PyResult<usize> {
    let length = rank as isize;
    if index < -length || index >= length {
        return Err(axis(index, rank, vm));
    }
    Ok(index.rem_euclid(length) as usize)
}
