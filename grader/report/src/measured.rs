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
    /// What the reference solution and the linear loop reach, where that is known.
    pub(super) beside: Option<String>,
}

/// The values of the reference solution and of the linear loop, in words.
fn beside(measure: &Measure) -> Option<String> {
    let named = [
        ("reference", measure.reference),
        ("linear prediction", measure.prediction),
    ];
    let values = named
        .into_iter()
        .filter_map(|(name, value)| Some(format!("{name} {}", with_unit(value?, &measure.unit))));
    let values: Vec<String> = values.collect();
    (!values.is_empty()).then(|| values.join(", "))
}

impl Measured {
    /// Formats a measure.
    pub(super) fn of(measure: &Measure) -> Self {
        let unit = &measure.unit;
        let value = measure.value.map_or_else(
            || "nothing to measure".to_owned(),
            |value| with_unit_unlike(value, measure.full, unit),
        );
        // short of 0 by the value itself would be the same number twice
        let margin = measure
            .margin()
            .filter(|margin| *margin != 0.0 && Some(-margin) != measure.value);
        Self {
            value,
            full: with_unit(measure.full, unit),
            zero: with_unit(measure.zero, unit),
            margin: margin.map(|margin| with_unit(margin.abs(), unit)),
            beside: beside(measure),
        }
    }
}
