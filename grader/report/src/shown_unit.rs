//! Units as pages and axes show them. Numbers are written by [`kinemark_sim::text::number`], measures of a record by
//! [`kinemark_grader::record::quantity`].

/// The unit a person reads, and what a value in `unit` is multiplied by for it: metres become millimetres where
/// `typical` is small, a ratio becomes per cent.
pub(crate) fn shown_unit(unit: &str, typical: f64) -> (&str, f64) {
    match unit {
        "m" if typical.abs() < 0.1 => ("mm", 1e3),
        "" => ("%", 100.0),
        "N m" => ("N\u{a0}m", 1.0),
        _ => (unit, 1.0),
    }
}

/// A number and its unit, kept on one line.
pub(crate) fn joined(number: &str, unit: &str) -> String {
    if unit.is_empty() {
        number.to_owned()
    } else {
        format!("{number}\u{a0}{unit}")
    }
}
