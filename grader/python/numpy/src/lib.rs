//! The modules `math` and `numpy` of submissions in Python, for RustPython's virtual machine.
//!
//! Numbers have the same bits on every machine: transcendental functions are those of the crate `libm`, sums go from the first
//! element to the last, and nothing depends on the processor. [`install`] puts the modules into an interpreter.
//!
//! What differs from numpy knowingly:
//!
//! - Arrays have one or two dimensions, and hold float64, int64 or bool; at most [`view::MAX_ELEMENTS`] elements.
//! - A number out of an array is Python's own float, int or bool. So `a[0] / 0` raises ZeroDivisionError, `~flags.any()` is that of an
//!   int, an int grows instead of wrapping around, and a number has no `shape`, `dtype` or `item()`.
//! - `~` of a truth value is the other one, as of numpy's; Python's own is -2 or -1.
//! - Whole numbers are stored as floats: exact to 2**53.
//! - An array of one element goes where a float is wanted (`float(a)`, `math.sin(a)`, `b[0] = a`), as in numpy before 2.4.
//! - An array compares with text as unequal; text, None, complex numbers and objects do not go into arrays: TypeError.
//! - What numpy gives as an array without dimensions (`a[..., 0]`, `np.array(5)`, `np.squeeze([[5]])`) is a number too.
//! - `a[a > 0] = a[0]` reads all values before it writes one; numpy writes over values that it has still to read.
//! - When a call has two errors, it can be the other one that is raised.
//! - bools under `sqrt`, `//` and `**` give float64 and int64, not float16 and int8.
//! - There are no warnings, and no arguments `where=` and `order=`; `out=` works where numpy has it for a function of elements.
//! - Sums are plain, so their last bits can differ; singular vectors and eigenvectors can have the other sign.

#![expect(
    clippy::float_cmp,
    reason = "numpy's rules compare exactly: zeros, whole numbers, kinds of nan"
)]

pub mod absent;
pub mod array;
pub mod broadcast;
pub mod choose;
pub mod construct;
pub mod convert;
pub mod curves;
pub mod decompose;
pub mod dtype;
pub mod errors;
pub mod fold;
pub mod function;
pub mod index;
pub mod join;
pub mod linalg;
pub mod math;
pub mod module;
pub mod print;
pub mod product;
pub mod rearrange;
pub mod reduce;
pub mod ufunc;
pub mod view;
pub mod warnings;

pub use array::NdArray;
pub use module::{install, names};
