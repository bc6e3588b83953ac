//! How arrays are written: numpy's rules for `repr` and `str`, with its default of eight digits.

use crate::dtype::Dtype;
use crate::view::View;
use std::fmt::Write as _;

const PRECISION: usize = 8;
const LINE: usize = 75;
const SUMMARY_ABOVE: usize = 1000;
const EDGE: usize = 3;

/// `repr(array)`.
#[must_use]
pub fn repr(view: &View) -> String {
    let mut extra = Vec::new();
    let summary = view.size() > SUMMARY_ABOVE;
    let body = if view.size() == 0 {
        "[]".to_owned()
    } else {
        write(view, ", ", "array(".len(), LINE - 1)
    };
    if summary || (view.size() == 0 && view.rank() != 1) {
        let dimensions: Vec<String> = view
            .shape()
            .dimensions()
            .iter()
            .map(ToString::to_string)
            .collect();
        let comma = if dimensions.len() == 1 { "," } else { "" };
        extra.push(format!("shape=({}{comma})", dimensions.join(", ")));
    }
    if view.size() == 0 {
        extra.push(format!("dtype={}", view.dtype().name()));
    }
    let mut text = format!("array({body}");
    for part in extra {
        let _ = write!(text, ", {part}");
    }
    text.push(')');
    text
}

/// `str(array)`.
#[must_use]
pub fn str(view: &View) -> String {
    if view.size() == 0 {
        return "[]".to_owned();
    }
    write(view, " ", 0, LINE)
}

/// Places along an axis that are shown; `None` stands for the dots.
fn shown(length: usize, summary: bool) -> Vec<Option<usize>> {
    if !summary || length <= 2 * EDGE {
        return (0..length).map(Some).collect();
    }
    let head = (0..EDGE).map(Some);
    let tail = (length - EDGE..length).map(Some);
    head.chain([None]).chain(tail).collect()
}

fn write(view: &View, separator: &str, prefix: usize, width: usize) -> String {
    let summary = view.size() > SUMMARY_ABOVE;
    let columns = shown(view.columns(), summary);
    let rows = shown(view.rows(), summary);
    let visible: Vec<f64> = rows
        .iter()
        .flatten()
        .flat_map(|row| {
            columns
                .iter()
                .flatten()
                .map(|column| view.at(*row, *column))
        })
        .collect();
    let format = Format::of(&visible, view.dtype());
    let indent = " ".repeat(prefix + 1);
    if view.rank() < 2 {
        return line(view, 0, &columns, &format, separator, &indent, width);
    }
    let inner = format!("{indent} ");
    let parts: Vec<String> = rows
        .iter()
        .map(|row| match row {
            Some(row) => line(view, *row, &columns, &format, separator, &inner, width - 1),
            None => "...".to_owned(),
        })
        .collect();
    let joint = format!("{}\n{indent}", separator.trim_end());
    format!("[{}]", parts.join(&joint))
}

/// One row in brackets, broken where it gets too long.
fn line(
    view: &View,
    row: usize,
    columns: &[Option<usize>],
    format: &Format,
    separator: &str,
    indent: &str,
    width: usize,
) -> String {
    let limit = width - separator.trim_end().len().max(1);
    let mut text = String::new();
    let mut line = indent.to_owned();
    for (place, column) in columns.iter().enumerate() {
        let word = match column {
            Some(column) => format.write(view.at(row, *column)),
            None => "...".to_owned(),
        };
        if line.len() + word.len() > limit && line.len() > indent.len() {
            text.push_str(line.trim_end());
            text.push('\n');
            line = indent.to_owned();
        }
        line.push_str(&word);
        if place + 1 < columns.len() {
            line.push_str(separator);
        }
    }
    text.push_str(&line);
    format!("[{}]", &text[indent.len()..])
}

/// The common form of all elements that are shown.
enum Format {
    Truth,
    Whole {
        width: usize,
    },
    Fixed {
        left: usize,
        right: usize,
    },
    Scientific {
        left: usize,
        digits: usize,
        exponent: usize,
    },
}

impl Format {
    fn of(values: &[f64], dtype: Dtype) -> Self {
        match dtype {
            Dtype::Bool => Self::Truth,
            Dtype::Int => Self::Whole {
                width: values
                    .iter()
                    .map(|value| whole(*value).len())
                    .max()
                    .unwrap_or(0),
            },
            Dtype::Float => Self::of_floats(values),
        }
    }

    fn of_floats(values: &[f64]) -> Self {
        let finite: Vec<f64> = values
            .iter()
            .copied()
            .filter(|value| value.is_finite())
            .collect();
        let sizes = || {
            finite
                .iter()
                .map(|value| value.abs())
                .filter(|value| *value != 0.0)
        };
        let largest = sizes().fold(0.0, f64::max);
        let smallest = sizes().fold(f64::INFINITY, f64::min);
        let scientific =
            largest > 0.0 && (largest >= 1e8 || smallest < 1e-4 || largest / smallest > 1000.0);
        let mut format = if finite.is_empty() {
            Self::Fixed { left: 0, right: 0 }
        } else if scientific {
            let (mut left, mut digits, mut exponent) = (0, 0, 0);
            for value in &finite {
                let (mantissa, power) = scientific_parts(*value);
                let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa.as_str(), ""));
                left = left.max(whole.len());
                digits = digits.max(fraction.len());
                exponent = exponent.max(power.len());
            }
            Self::Scientific {
                left,
                digits,
                exponent,
            }
        } else {
            let (mut left, mut right) = (0, 0);
            for value in &finite {
                let text = fixed(*value);
                let (whole, fraction) = text.split_once('.').unwrap_or((text.as_str(), ""));
                left = left.max(whole.len());
                right = right.max(fraction.len());
            }
            Self::Fixed { left, right }
        };
        if finite.len() < values.len() {
            let word = if values.contains(&f64::NEG_INFINITY) {
                4
            } else {
                3
            };
            match &mut format {
                Self::Fixed { left, right } => {
                    *left = (*left).max(usize::saturating_sub(word, *right + 1))
                }
                Self::Scientific {
                    left,
                    digits,
                    exponent,
                } => {
                    // the exponent has an `e` and its sign counts among its characters
                    let after = *digits + *exponent + 1;
                    *left = (*left).max(usize::saturating_sub(word, after + 1));
                }
                Self::Truth | Self::Whole { .. } => {}
            }
        }
        format
    }

    fn write(&self, value: f64) -> String {
        match self {
            Self::Truth => if value != 0.0 { " True" } else { "False" }.to_owned(),
            Self::Whole { width } => format!("{:>width$}", whole(value)),
            Self::Fixed { left, right } => {
                if !value.is_finite() {
                    return format!("{:>width$}", special(value), width = left + right + 1);
                }
                let text = fixed(value);
                let (whole, fraction) = text.split_once('.').unwrap_or((text.as_str(), ""));
                format!("{whole:>left$}.{fraction:<right$}")
            }
            Self::Scientific {
                left,
                digits,
                exponent,
            } => {
                if !value.is_finite() {
                    return format!(
                        "{:>width$}",
                        special(value),
                        width = left + digits + exponent + 2
                    );
                }
                let (mantissa, power) = scientific_parts(value);
                let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa.as_str(), ""));
                let (sign, figures) = power.split_at(1);
                format!(
                    "{whole:>left$}.{fraction:0<digits$}e{sign}{figures:0>width$}",
                    width = exponent - 1
                )
            }
        }
    }
}

fn whole(value: f64) -> String {
    (value as i64).to_string()
}

const fn special(value: f64) -> &'static str {
    if value.is_nan() {
        "nan"
    } else if value > 0.0 {
        "inf"
    } else {
        "-inf"
    }
}

/// The shortest decimal that reads back as the value, cut to eight digits after the point; always with a point.
fn fixed(value: f64) -> String {
    let shortest = format!("{value}");
    let long = shortest
        .split_once('.')
        .is_some_and(|(_, fraction)| fraction.len() > PRECISION);
    if !long {
        return if shortest.contains('.') {
            shortest
        } else {
            format!("{shortest}.")
        };
    }
    let cut = format!("{value:.PRECISION$}");
    cut.trim_end_matches('0').to_owned()
}

/// Mantissa (with a point) and exponent (with sign and at least two digits).
fn scientific_parts(value: f64) -> (String, String) {
    let shortest = format!("{value:e}");
    let text = match shortest.split_once('e') {
        Some((mantissa, _)) if mantissa.trim_start_matches('-').len() > PRECISION + 2 => {
            format!("{value:.PRECISION$e}")
        }
        _ => shortest,
    };
    let (mantissa, power) = text.split_once('e').unwrap_or((text.as_str(), "0"));
    let mantissa = match mantissa.split_once('.') {
        Some(_) => mantissa.trim_end_matches('0').to_owned(),
        None => format!("{mantissa}."),
    };
    let power: i32 = power.parse().unwrap_or(0);
    let sign = if power < 0 { '-' } else { '+' };
    (mantissa, format!("{sign}{:02}", power.abs()))
}
