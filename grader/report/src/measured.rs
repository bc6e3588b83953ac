//! A measured value against its band in words, the same in the terminal, on the page and wherever else it is shown.

use kinemark_grader::record::grade::Measure;
use kinemark_grader::record::quantity::{with_unit, with_unit_unlike};

/// Value, limits and margin with their units.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Measured {
    /// The value, with enough digits to differ from where all points are earned.
    pub(super) value: String,
    /// What earns all points.
    pub(super) full: String,
    /// What earns none.
    pub(super) zero: String,
    /// How far the value is from where all points are earned, without a sign, if it is not right there.
    pub(super) margin: Option<String>,
}

impl Measured {
    /// Formats a measure.
    pub(super) fn of(measure: &Measure) -> Self {
        let unit = &measure.unit;
        let value = measure.value.map_or_else(
            || "nothing to measure".to_owned(),
            |value| with_unit_unlike(value, measure.full, unit),
        );
        let margin = measure.margin().filter(|margin| *margin != 0.0);
        Self {
            value,
            full: with_unit(measure.full, unit),
            zero: with_unit(measure.zero, unit),
            margin: margin.map(|margin| with_unit(margin.abs(), unit)),
        }
    }
}
