//! Functions that make one number of many: of the whole array, or along an axis.
//!
//! Sums go plainly from the first element to the last, so the last bits can differ from numpy's, which adds in pairs.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::{Arguments, deliver};
use crate::ufunc;
use crate::view::{Shape, View};
use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine};

/// What along which axis, as the arguments say.
struct Task {
    view: View,
    axis: Option<usize>,
    keep_dimensions: bool,
    out: Option<PyObjectRef>,
}

/// The axis that an argument names; both axes of a matrix count as none.
///
/// # Errors
///
/// AxisError when there is no such axis.
pub fn axis_of(
    object: Option<PyObjectRef>,
    rank: usize,
    vm: &VirtualMachine,
) -> PyResult<Option<usize>> {
    let Some(object) = object else {
        return Ok(None);
    };
    let named = convert::integers(&object, vm)?;
    let mut axes = Vec::with_capacity(2);
    for axis in named {
        // numpy lets a number pass for a vector here
        let axis = errors::checked_axis(axis, rank.max(1), vm)?;
        if axes.contains(&axis) {
            return Err(vm.new_value_error("duplicate value in 'axis'"));
        }
        axes.push(axis);
    }
    match axes.as_slice() {
        [axis] => Ok(Some(*axis)),
        [] => Err(vm.new_value_error("an empty tuple is not supported here as axis")),
        _ => Ok(None),
    }
}

/// Applies `each` to the lanes along the axis, or to all elements; the lanes are at least one.
///
/// # Errors
///
/// Those of `each`.
pub fn along(
    view: &View,
    axis: Option<usize>,
    keep_dimensions: bool,
    dtype: Dtype,
    mut each: impl FnMut(&[f64]) -> PyResult<f64>,
) -> PyResult<View> {
    let (count, kept) = match axis {
        Some(0) if view.rank() == 2 => (view.columns(), Shape::matrix(1, view.columns())),
        Some(_) if view.rank() == 2 => (view.rows(), Shape::matrix(view.rows(), 1)),
        _ => {
            let value = each(&view.values())?;
            let rank = if keep_dimensions { view.rank() } else { 0 };
            return Ok(View::new(dtype, Shape::NUMBER.with_rank(rank), vec![value]));
        }
    };
    let mut values = Vec::with_capacity(count);
    for place in 0..count {
        let lane = if axis == Some(0) {
            view.column(place)
        } else {
            view.row(place)
        };
        values.push(each(&lane.values())?);
    }
    let shape = if keep_dimensions {
        kept
    } else {
        Shape::vector(count)
    };
    Ok(View::new(dtype, shape, values))
}

/// Replaces every lane along the axis by what `each` makes of it; all results have one length.
#[must_use]
pub fn lanes(
    view: &View,
    axis: usize,
    dtype: Dtype,
    mut each: impl FnMut(&[f64]) -> Vec<f64>,
) -> View {
    if view.rank() < 2 {
        let values = each(&view.values());
        return View::new(dtype, Shape::vector(values.len()), values);
    }
    let by_row = if axis == 0 {
        view.transposed()
    } else {
        view.clone()
    };
    let mut length = None;
    let mut values = Vec::new();
    for row in 0..by_row.rows() {
        let lane = each(&by_row.row(row).values());
        length = Some(lane.len());
        values.extend(lane);
    }
    // without lanes, one of zeros has the length
    let length = length.unwrap_or_else(|| each(&vec![0.0; by_row.columns()]).len());
    let result = View::new(dtype, Shape::matrix(by_row.rows(), length), values);
    if axis == 0 {
        result.transposed().copied()
    } else {
        result
    }
}

fn task(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<(View, Option<usize>)> {
    let view = arguments.array("a", vm)?;
    let axis = arguments.optional("axis", vm);
    let axis = axis_of(axis, view.rank(), vm)?;
    Ok((view, axis))
}

fn rest_of_task(
    arguments: &mut Arguments,
    (view, axis): (View, Option<usize>),
    vm: &VirtualMachine,
) -> PyResult<Task> {
    let out = arguments.optional("out", vm);
    let keep_dimensions = arguments.optional_truth("keepdims", vm)?.unwrap_or(false);
    Ok(Task {
        view,
        axis,
        keep_dimensions,
        out,
    })
}

fn plain(
    arguments: &mut Arguments,
    name: &str,
    dtype: impl FnOnce(Dtype) -> Dtype,
    each: impl FnMut(&[f64]) -> PyResult<f64>,
    vm: &VirtualMachine,
) -> PyResult {
    let start = task(arguments, vm)?;
    let task = rest_of_task(arguments, start, vm)?;
    let dtype = dtype(task.view.dtype());
    let result = along(&task.view, task.axis, task.keep_dimensions, dtype, each)?;
    deliver(name, result, task.out, vm)
}

/// As [`plain`], with an argument `dtype` after the axis.
fn with_dtype(
    arguments: &mut Arguments,
    name: &str,
    dtype: impl FnOnce(Dtype) -> Dtype,
    each: impl FnMut(&[f64]) -> PyResult<f64>,
    vm: &VirtualMachine,
) -> PyResult {
    let (view, axis) = task(arguments, vm)?;
    let asked = arguments.optional_dtype("dtype", vm)?;
    let view = match asked {
        Some(asked) if asked != view.dtype() => view.cast(asked),
        _ => view,
    };
    let task = rest_of_task(arguments, (view, axis), vm)?;
    let dtype = asked.unwrap_or_else(|| dtype(task.view.dtype()));
    let result = along(&task.view, task.axis, task.keep_dimensions, dtype, each)?;
    deliver(name, result, task.out, vm)
}

/// The sum from the first to the last.
#[must_use]
pub fn total(lane: &[f64]) -> f64 {
    lane.iter().fold(0.0, |sum, value| sum + value)
}

/// The mean of a lane; nan of none.
#[must_use]
pub fn average(lane: &[f64]) -> f64 {
    total(lane) / lane.len() as f64
}

fn counted(dtype: Dtype) -> Dtype {
    dtype.max(Dtype::Int)
}

const fn floats(_: Dtype) -> Dtype {
    Dtype::Float
}

const fn same(dtype: Dtype) -> Dtype {
    dtype
}

fn least(lane: &[f64]) -> Option<f64> {
    lane.iter().copied().reduce(|known, value| {
        if known.is_nan() || known <= value {
            known
        } else {
            value
        }
    })
}

fn greatest(lane: &[f64]) -> Option<f64> {
    lane.iter().copied().reduce(|known, value| {
        if known.is_nan() || known >= value {
            known
        } else {
            value
        }
    })
}

fn no_identity(name: &str, vm: &VirtualMachine) -> rustpython_vm::builtins::PyBaseExceptionRef {
    vm.new_value_error(format!(
        "zero-size array to reduction operation {name} which has no identity"
    ))
}

fn without_nan(lane: &[f64]) -> Vec<f64> {
    lane.iter()
        .copied()
        .filter(|value| !value.is_nan())
        .collect()
}

fn middle(lane: &[f64]) -> f64 {
    quantile_of(lane, 0.5)
}

/// The value below which the share `part` of a lane lies, linear between neighbours.
fn quantile_of(lane: &[f64], part: f64) -> f64 {
    if lane.is_empty() || lane.iter().any(|value| value.is_nan()) {
        return f64::NAN;
    }
    let mut sorted = lane.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = part * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    let share = place - below as f64;
    let gap = sorted[above] - sorted[below];
    if share >= 0.5 {
        sorted[above] - gap * (1.0 - share)
    } else {
        sorted[below] + gap * share
    }
}

fn variance_of(lane: &[f64], freedom: f64) -> f64 {
    let mean = average(lane);
    let sum = lane
        .iter()
        .fold(0.0, |sum, value| sum + (value - mean) * (value - mean));
    let count = lane.len() as f64 - freedom;
    // numpy divides by zero here rather than by a negative number
    sum / count.max(0.0)
}

/// The place of the best element: the first nan, or the first that no other beats.
fn best(
    lane: &[f64],
    name: &str,
    beats: fn(f64, f64) -> bool,
    vm: &VirtualMachine,
) -> PyResult<f64> {
    let Some(first) = lane.first() else {
        return Err(vm.new_value_error(format!("attempt to get {name} of an empty sequence")));
    };
    let (mut place, mut known) = (0, *first);
    for (at, &value) in lane.iter().enumerate() {
        if known.is_nan() {
            break;
        }
        if value.is_nan() || beats(value, known) {
            (place, known) = (at, value);
        }
    }
    Ok(place as f64)
}

/// `numpy.sum`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn sum(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    with_dtype(arguments, "add", counted, |lane| Ok(total(lane)), vm)
}

/// `numpy.prod`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn prod(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    with_dtype(
        arguments,
        "multiply",
        counted,
        |lane| Ok(lane.iter().product()),
        vm,
    )
}

/// `numpy.mean`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn mean(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    with_dtype(arguments, "mean", floats, |lane| Ok(average(lane)), vm)
}

/// `numpy.min`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn min(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "minimum",
        same,
        |lane| least(lane).ok_or_else(|| no_identity("minimum", vm)),
        vm,
    )
}

/// `numpy.max`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn max(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "maximum",
        same,
        |lane| greatest(lane).ok_or_else(|| no_identity("maximum", vm)),
        vm,
    )
}

/// `numpy.ptp`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn ptp(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let start = task(arguments, vm)?;
    let task = rest_of_task(arguments, start, vm)?;
    let extreme = |of: fn(&[f64]) -> Option<f64>| {
        let each = |lane: &[f64]| of(lane).ok_or_else(|| no_identity("maximum", vm));
        along(
            &task.view,
            task.axis,
            task.keep_dimensions,
            task.view.dtype(),
            each,
        )
    };
    let (greatest, least) = (extreme(greatest)?, extreme(least)?);
    // the difference refuses bools, as numpy does
    deliver(
        "ptp",
        ufunc::SUBTRACT.apply(&greatest, &least, vm)?,
        task.out,
        vm,
    )
}

/// `numpy.any`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn any(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "logical_or",
        |_| Dtype::Bool,
        |lane| Ok(f64::from(u8::from(lane.iter().any(|value| *value != 0.0)))),
        vm,
    )
}

/// `numpy.all`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn all(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "logical_and",
        |_| Dtype::Bool,
        |lane| Ok(f64::from(u8::from(lane.iter().all(|value| *value != 0.0)))),
        vm,
    )
}

/// `numpy.argmin`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn argmin(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "argmin",
        |_| Dtype::Int,
        |lane| best(lane, "argmin", |value, known| value < known, vm),
        vm,
    )
}

/// `numpy.argmax`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn argmax(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "argmax",
        |_| Dtype::Int,
        |lane| best(lane, "argmax", |value, known| value > known, vm),
        vm,
    )
}

fn spread(
    arguments: &mut Arguments,
    name: &str,
    each: fn(&[f64], f64) -> f64,
    vm: &VirtualMachine,
) -> PyResult {
    let (view, axis) = task(arguments, vm)?;
    let _ = arguments.optional_dtype("dtype", vm)?;
    let out = arguments.optional("out", vm);
    let freedom = arguments.optional_float("ddof", vm)?.unwrap_or(0.0);
    let keep_dimensions = arguments.optional_truth("keepdims", vm)?.unwrap_or(false);
    let result = along(&view, axis, keep_dimensions, Dtype::Float, |lane| {
        Ok(each(lane, freedom))
    })?;
    deliver(name, result, out, vm)
}

/// `numpy.var`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn var(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    spread(arguments, "var", variance_of, vm)
}

/// `numpy.std`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn std(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    spread(
        arguments,
        "std",
        |lane, freedom| variance_of(lane, freedom).sqrt(),
        vm,
    )
}

/// `numpy.median`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn median(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let start = task(arguments, vm)?;
    let out = arguments.optional("out", vm);
    let _ = arguments.optional("overwrite_input", vm);
    let keep_dimensions = arguments.optional_truth("keepdims", vm)?.unwrap_or(false);
    let result = along(&start.0, start.1, keep_dimensions, Dtype::Float, |lane| {
        Ok(middle(lane))
    })?;
    deliver("median", result, out, vm)
}

fn share(arguments: &mut Arguments, whole: f64, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let parts = arguments.array("q", vm)?;
    let axis = arguments.optional("axis", vm);
    let axis = axis_of(axis, view.rank(), vm)?;
    if parts
        .values()
        .iter()
        .any(|part| !(0.0..=whole).contains(part))
    {
        let sentence = if whole == 1.0 {
            "Quantiles must be in the range [0, 1]"
        } else {
            "Percentiles must be in the range [0, 100]"
        };
        return Err(vm.new_value_error(sentence));
    }
    if parts.rank() == 0 {
        let part = parts.at(0, 0) / whole;
        let result = along(&view, axis, false, Dtype::Float, |lane| {
            Ok(quantile_of(lane, part))
        })?;
        return Ok(convert::object(result, vm));
    }
    if axis.is_some() && view.rank() == 2 {
        return Err(vm.new_value_error("several quantiles along an axis are not supported here"));
    }
    let lane = view.values();
    let values = parts
        .values()
        .iter()
        .map(|part| quantile_of(&lane, part / whole))
        .collect();
    Ok(convert::object(
        View::new(Dtype::Float, parts.shape(), values),
        vm,
    ))
}

/// `numpy.quantile`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn quantile(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    share(arguments, 1.0, vm)
}

/// `numpy.percentile`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn percentile(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    share(arguments, 100.0, vm)
}

/// `numpy.count_nonzero`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn count_nonzero(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (view, axis) = task(arguments, vm)?;
    let keep_dimensions = arguments.keyword("keepdims", vm).is_some();
    let each = |lane: &[f64]| Ok(lane.iter().filter(|value| **value != 0.0).count() as f64);
    Ok(convert::object(
        along(&view, axis, keep_dimensions, Dtype::Int, each)?,
        vm,
    ))
}

/// `numpy.nansum`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn nansum(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    with_dtype(
        arguments,
        "add",
        counted,
        |lane| Ok(total(&without_nan(lane))),
        vm,
    )
}

/// `numpy.nanmean`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn nanmean(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    with_dtype(
        arguments,
        "mean",
        floats,
        |lane| Ok(average(&without_nan(lane))),
        vm,
    )
}

/// `numpy.nanmin`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn nanmin(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "fmin",
        same,
        |lane| {
            if lane.is_empty() {
                Err(no_identity("fmin", vm))
            } else {
                Ok(least(&without_nan(lane)).unwrap_or(f64::NAN))
            }
        },
        vm,
    )
}

/// `numpy.nanmax`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn nanmax(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "fmax",
        same,
        |lane| {
            if lane.is_empty() {
                Err(no_identity("fmax", vm))
            } else {
                Ok(greatest(&without_nan(lane)).unwrap_or(f64::NAN))
            }
        },
        vm,
    )
}

/// `numpy.nanstd`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn nanstd(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    spread(
        arguments,
        "std",
        |lane, freedom| variance_of(&without_nan(lane), freedom).sqrt(),
        vm,
    )
}

/// `numpy.nanmedian`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn nanmedian(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    plain(
        arguments,
        "median",
        floats,
        |lane| Ok(middle(&without_nan(lane))),
        vm,
    )
}

fn running(
    arguments: &mut Arguments,
    name: &str,
    each: fn(f64, f64) -> f64,
    vm: &VirtualMachine,
) -> PyResult {
    let (view, axis) = task(arguments, vm)?;
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or_else(|| counted(view.dtype()));
    let out = arguments.optional("out", vm);
    let view = if axis.is_none() {
        view.reshaped(Shape::vector(view.size()))
    } else {
        view
    };
    let result = lanes(&view, axis.unwrap_or(0), dtype, |lane| {
        let mut known = None;
        lane.iter()
            .map(|value| {
                let next = known.map_or(*value, |known| each(known, *value));
                known = Some(next);
                next
            })
            .collect()
    });
    deliver(name, result, out, vm)
}

/// `numpy.cumsum`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn cumsum(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    running(arguments, "add", |known, value| known + value, vm)
}

/// `numpy.cumprod`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for what holds no numbers.
pub fn cumprod(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    running(arguments, "multiply", |known, value| known * value, vm)
}

/// `numpy.average`, with weights.
///
/// # Errors
///
/// AxisError for an axis that is not there, ZeroDivisionError for weights that sum to zero.
pub fn weighted(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (view, axis) = task(arguments, vm)?;
    let Some(weights) = arguments.optional_array("weights", vm)? else {
        let result = along(&view, axis, false, Dtype::Float, |lane| Ok(average(lane)))?;
        return Ok(convert::object(result, vm));
    };
    let spread = if weights.rank() == 1 && view.rank() == 2 && axis == Some(0) {
        weights.as_column()
    } else {
        weights
    };
    let Some(weights) = spread.broadcast_to(view.shape()) else {
        return Err(vm.new_value_error(
            "Shape of weights must be consistent with shape of a along specified axis.",
        ));
    };
    let products = ufunc::MULTIPLY.apply(&view, &weights, vm)?;
    let sums = along(&products, axis, false, Dtype::Float, |lane| Ok(total(lane)))?;
    let scale = along(&weights, axis, false, Dtype::Float, |lane| {
        match total(lane) {
            0.0 => Err(vm.new_zero_division_error("Weights sum to zero, can't be normalized")),
            sum => Ok(sum),
        }
    })?;
    Ok(convert::object(ufunc::DIVIDE.apply(&sums, &scale, vm)?, vm))
}
