//! Functions of sampled curves: differences, interpolation, areas, polynomials.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::join;
use crate::reduce;
use crate::ufunc;
use crate::view::{Shape, View};
use rustpython_vm::{PyResult, VirtualMachine};

fn done(view: View, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(view, vm))
}

/// `numpy.diff`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for a number, for a negative order and for a `prepend` or `append` of another shape.
pub fn diff(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut view = arguments.array("a", vm)?;
    let times = arguments.optional_integer("n", vm)?.unwrap_or(1);
    let axis = arguments.optional_integer("axis", vm)?.unwrap_or(-1);
    let before = arguments.optional_array("prepend", vm)?;
    let after = arguments.optional_array("append", vm)?;
    if times < 0 {
        return Err(vm.new_value_error(format!("order must be non-negative but got {times}")));
    }
    if view.rank() == 0 {
        return Err(vm.new_value_error("diff requires input that is at least one dimensional"));
    }
    let axis = errors::checked_axis(axis, view.rank(), vm)?;
    if times > 0 && (before.is_some() || after.is_some()) {
        view = join::between(before, view, after, axis, vm)?;
    }
    for _ in 0..times {
        view = reduce::lanes(&view, axis, view.dtype(), |lane| {
            let pairs = lane.windows(2);
            if view.dtype() == Dtype::Bool {
                return pairs
                    .map(|pair| f64::from(u8::from(pair[0] != pair[1])))
                    .collect();
            }
            pairs.map(|pair| pair[1] - pair[0]).collect()
        });
    }
    done(view, vm)
}

/// `numpy.ediff1d`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn ediff1d(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("ary", vm)?;
    let values: Vec<f64> = view
        .values()
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .collect();
    done(
        View::new(view.dtype(), Shape::vector(values.len()), values),
        vm,
    )
}

/// `numpy.gradient` of a vector, with a step or with the places of the samples.
///
/// # Errors
///
/// ValueError for fewer than two samples and for matrices.
pub fn gradient(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("f", vm)?;
    let spacing = arguments.optional_array("dx", vm)?;
    if view.rank() != 1 {
        return Err(vm.new_value_error("gradient() here takes a vector"));
    }
    let samples = view.values();
    let count = samples.len();
    if count < 2 {
        return Err(vm.new_value_error(
            "Shape of array too small to calculate a numerical gradient, at least (edge_order + 1) elements are required.",
        ));
    }
    let places = match spacing {
        Some(places) if places.rank() == 1 => {
            if places.size() != count {
                return Err(vm.new_value_error(
                    "when 1d, distances must match the length of the corresponding dimension",
                ));
            }
            Some(places.values())
        }
        Some(step) if step.rank() > 0 => {
            return Err(vm.new_value_error("distances must be either scalars or 1d"));
        }
        Some(step) => {
            let step = step.at(0, 0);
            return done(View::vector(even_gradient(&samples, step)), vm);
        }
        None => None,
    };
    let Some(places) = places else {
        return done(View::vector(even_gradient(&samples, 1.0)), vm);
    };
    let mut slopes = Vec::with_capacity(count);
    for place in 0..count {
        slopes.push(if place == 0 {
            (samples[1] - samples[0]) / (places[1] - places[0])
        } else if place == count - 1 {
            (samples[place] - samples[place - 1]) / (places[place] - places[place - 1])
        } else {
            let before = places[place] - places[place - 1];
            let after = places[place + 1] - places[place];
            let first = -after / (before * (before + after));
            let middle = (after - before) / (before * after);
            let last = before / (after * (before + after));
            first * samples[place - 1] + middle * samples[place] + last * samples[place + 1]
        });
    }
    done(View::vector(slopes), vm)
}

fn even_gradient(samples: &[f64], step: f64) -> Vec<f64> {
    let last = samples.len() - 1;
    let slope = |place: usize| match place {
        0 => (samples[1] - samples[0]) / step,
        place if place == last => (samples[last] - samples[last - 1]) / step,
        place => (samples[place + 1] - samples[place - 1]) / (2.0 * step),
    };
    (0..=last).map(slope).collect()
}

/// `numpy.interp`.
///
/// # Errors
///
/// ValueError for no samples, places and samples of different number, or a period of 0.
pub fn interp(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut wanted = arguments.array("x", vm)?;
    let mut places = arguments.array("xp", vm)?.values();
    let mut samples = arguments.array("fp", vm)?.values();
    let left = arguments.optional_float("left", vm)?;
    let right = arguments.optional_float("right", vm)?;
    let period = arguments.optional_float("period", vm)?;
    // around a circle nothing is left or right of the samples
    let (left, right) = match period {
        Some(_) => (None, None),
        None => (left, right),
    };
    if places.is_empty() {
        return Err(vm.new_value_error("array of sample points is empty"));
    }
    if places.len() != samples.len() {
        return Err(vm.new_value_error("fp and xp are not of the same length."));
    }
    if let Some(period) = period {
        if period == 0.0 {
            return Err(vm.new_value_error("period must be a non-zero value"));
        }
        let period = period.abs();
        wanted = crate::broadcast::map(&wanted, Dtype::Float, |value| within(value, period));
        (places, samples) = around(&places, &samples, period);
    }
    let last = places.len() - 1;
    let each = |value: f64| {
        if value.is_nan() {
            return value;
        }
        if value < places[0] {
            return left.unwrap_or(samples[0]);
        }
        if value > places[last] {
            return right.unwrap_or(samples[last]);
        }
        let place = places
            .partition_point(|place| *place <= value)
            .saturating_sub(1);
        if place >= last || places[place] == value {
            return samples[place.min(last)];
        }
        let slope = (samples[place + 1] - samples[place]) / (places[place + 1] - places[place]);
        slope * (value - places[place]) + samples[place]
    };
    done(crate::broadcast::map(&wanted, Dtype::Float, each), vm)
}

/// `value` moved by whole periods to where `0 <= value < period`.
fn within(value: f64, period: f64) -> f64 {
    let rest = libm::fmod(value, period);
    if rest < 0.0 { rest + period } else { rest }
}

/// The samples in the order of their places within the period, with the last one before them and the first one after them.
fn around(places: &[f64], samples: &[f64], period: f64) -> (Vec<f64>, Vec<f64>) {
    let moved = places.iter().map(|place| within(*place, period));
    let mut pairs: Vec<(f64, f64)> = moved.zip(samples.iter().copied()).collect();
    pairs.sort_by(|left, right| left.0.total_cmp(&right.0));
    if let (Some(first), Some(last)) = (pairs.first().copied(), pairs.last().copied()) {
        pairs.insert(0, (last.0 - period, last.1));
        pairs.push((first.0 + period, first.1));
    }
    pairs.into_iter().unzip()
}

/// `numpy.unwrap`: jumps of more than half a period are taken out.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn unwrap(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("p", vm)?;
    let jump = arguments.optional_float("discont", vm)?;
    let axis = arguments.optional_integer("axis", vm)?.unwrap_or(-1);
    let whole_period = arguments
        .keyword("period", vm)
        .map(|object| convert::view_of(&object, vm))
        .transpose()?;
    let whole = view.dtype() != Dtype::Float
        && whole_period
            .as_ref()
            .is_some_and(|period| period.dtype() != Dtype::Float);
    if whole_period
        .as_ref()
        .is_some_and(|period| period.rank() > 0)
    {
        return Err(vm.new_value_error("unwrap() here takes a number as period"));
    }
    let period = whole_period.map_or(2.0 * std::f64::consts::PI, |period| period.at(0, 0));
    let half = period / 2.0;
    let jump = jump.unwrap_or(half).max(half);
    if view.rank() == 0 {
        return Err(vm.new_value_error("diff requires input that is at least one dimensional"));
    }
    let axis = errors::checked_axis(axis, view.rank(), vm)?;
    let dtype = if whole { Dtype::Int } else { Dtype::Float };
    let result = reduce::lanes(&view, axis, dtype, |lane| {
        let mut correction: f64 = 0.0;
        let mut before: Option<f64> = None;
        let each = lane.iter().map(|value| {
            if let Some(before) = before {
                let step: f64 = value - before;
                let mut within = ufunc::remainder(step + half, period) - half;
                if within == -half && step > 0.0 {
                    within = half;
                }
                if step.abs() >= jump {
                    correction += within - step;
                }
            }
            before = Some(*value);
            value + correction
        });
        each.collect()
    });
    done(result, vm)
}

/// `numpy.trapezoid`.
///
/// # Errors
///
/// ValueError for places and samples of different number.
pub fn trapezoid(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("y", vm)?;
    let places = arguments.optional_array("x", vm)?;
    let step = arguments.optional_float("dx", vm)?.unwrap_or(1.0);
    let axis = arguments.optional_integer("axis", vm)?.unwrap_or(-1);
    let axis = errors::checked_axis(axis, view.rank(), vm)?;
    let places = places.map(|places| places.values());
    let result = reduce::along(&view, Some(axis), false, Dtype::Float, |lane| {
        if let Some(places) = &places
            && places.len() != lane.len()
        {
            return Err(vm.new_value_error(format!(
                "operands could not be broadcast together with shapes ({},) ({},) ",
                places.len().saturating_sub(1),
                lane.len().saturating_sub(1)
            )));
        }
        let width = |place: usize| {
            places
                .as_ref()
                .map_or(step, |places| places[place + 1] - places[place])
        };
        let pairs = lane.windows(2).enumerate();
        Ok(pairs.fold(0.0, |area, (place, pair)| {
            area + width(place) * (pair[0] + pair[1]) / 2.0
        }))
    })?;
    done(result, vm)
}

/// `numpy.convolve`.
///
/// # Errors
///
/// ValueError for empty vectors and unknown modes.
pub fn convolve(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("v", vm)?;
    let mode = match arguments.optional("mode", vm) {
        Some(mode) => mode.str(vm)?.to_string_lossy().into_owned(),
        None => "full".to_owned(),
    };
    let dtype = left.dtype().max(right.dtype()).max(Dtype::Int);
    let (mut long, mut short) = (left.values(), right.values());
    if short.len() > long.len() {
        std::mem::swap(&mut long, &mut short);
    }
    if short.is_empty() {
        return Err(vm.new_value_error("a cannot be empty"));
    }
    let full = Shape::vector(long.len() + short.len() - 1);
    full.check_size(vm)?;
    let mut values = vec![0.0; full.size()];
    for (at, value) in long.iter().enumerate() {
        for (by, weight) in short.iter().enumerate() {
            values[at + by] += value * weight;
        }
    }
    let (skip, keep) = match mode.as_str() {
        "full" => (0, values.len()),
        "same" => ((short.len() - 1) / 2, long.len()),
        "valid" => (short.len() - 1, long.len() - short.len() + 1),
        _ => {
            return Err(vm.new_value_error(format!(
                "mode '{mode}' is not one of 'valid', 'same', or 'full'"
            )));
        }
    };
    let values: Vec<f64> = values.into_iter().skip(skip).take(keep).collect();
    done(View::new(dtype, Shape::vector(values.len()), values), vm)
}

/// `numpy.polyval`: the highest power comes first.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn polyval(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let coefficients = arguments.array("p", vm)?;
    let at = arguments.array("x", vm)?;
    let values = coefficients.values();
    let dtype = coefficients.dtype().max(at.dtype()).max(Dtype::Int);
    let each = |place: f64| {
        values
            .iter()
            .fold(0.0, |sum, coefficient| sum * place + coefficient)
    };
    done(crate::broadcast::map(&at, dtype, each), vm)
}

/// `numpy.vander`: the powers of each element.
///
/// # Errors
///
/// ValueError for what is no vector.
pub fn vander(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("x", vm)?;
    let count = arguments.optional_integer("N", vm)?;
    let increasing = arguments.optional_truth("increasing", vm)?.unwrap_or(false);
    if view.rank() != 1 {
        return Err(vm.new_value_error("x must be a one-dimensional array or sequence."));
    }
    let columns = count.map_or(view.size(), |count| count.max(0) as usize);
    let shape = Shape::matrix(view.size(), columns);
    shape.check_size(vm)?;
    let mut values = Vec::with_capacity(shape.size());
    for value in view.values() {
        let powers = (0..columns).scan(1.0, |power, _| {
            let this = *power;
            *power *= value;
            Some(this)
        });
        let mut row: Vec<f64> = powers.collect();
        if !increasing {
            row.reverse();
        }
        values.extend(row);
    }
    done(View::new(view.dtype().max(Dtype::Int), shape, values), vm)
}

/// `numpy.searchsorted`.
///
/// # Errors
///
/// ValueError for a side that is neither left nor right.
pub fn searchsorted(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let sorted = arguments.array("a", vm)?.values();
    let wanted = arguments.array("v", vm)?;
    let side = match arguments.optional("side", vm) {
        Some(side) => side.str(vm)?.to_string_lossy().into_owned(),
        None => "left".to_owned(),
    };
    let after = match side.as_str() {
        "left" => false,
        "right" => true,
        _ => {
            return Err(vm.new_value_error(format!(
                "search side must be one of 'left' or 'right' (got '{side}')"
            )));
        }
    };
    let each = |value: f64| {
        let before = |known: &f64| {
            *known < value || (after && *known == value) || (value.is_nan() && !known.is_nan())
        };
        sorted.partition_point(before) as f64
    };
    done(crate::broadcast::map(&wanted, Dtype::Int, each), vm)
}
