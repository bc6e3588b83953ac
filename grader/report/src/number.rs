//! Numbers as people read them: few digits, a fitting unit, a true minus sign. What messages say is in
//! [`kinemark_grader::record::quantity`]; this adds what a page and the axes of a plot need.

/// Ten to a whole power.
pub(crate) fn power_of_ten(exponent: i32) -> f64 {
    libm::pow(10.0, f64::from(exponent))
}

/// The decimal exponent of a finite number that is not zero: 3 for 1234.
pub(crate) fn exponent(value: f64) -> i32 {
    libm::floor(libm::log10(value.abs())) as i32
}

/// `value` with `digits` significant digits, without trailing zeros; plain from 1e-4 to 1e6, else as `1.2e-7`.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return if value.is_nan() {
            "not a number"
        } else {
            "infinite"
        }
        .to_owned();
    }
    // printed once in scientific form, so that rounding up to the next power of ten is counted
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        trimmed(&format!("{value:.decimals$}")).to_owned()
    } else {
        format!("{}e{exponent}", trimmed(mantissa))
    };
    text.replace('-', "\u{2212}")
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_matter() {
        assert_eq!(significant(0.0123456, 4), "0.01235");
        assert_eq!(significant(99.9996, 4), "100");
        assert_eq!(significant(-2.0, 4), "\u{2212}2");
        assert_eq!(significant(1.0e300, 4), "1e300");
        assert_eq!(significant(3.2e-7, 3), "3.2e\u{2212}7");
        assert_eq!(significant(1234.0, 3), "1234");
        assert_eq!(significant(f64::NAN, 3), "not a number");
    }
}
