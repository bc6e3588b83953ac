//! Numbers as people read them, in messages, tables and pictures.

/// Ten to a whole power.
pub fn power_of_ten(exponent: i32) -> f64 {
    libm::pow(10.0, f64::from(exponent))
}

/// The decimal exponent of a finite number that is not zero: 3 for 1234.
pub fn exponent(value: f64) -> i32 {
    libm::floor(libm::log10(value.abs())) as i32
}

/// A number with four significant digits: plain from 1e-3 to 1e6, else as `1.2e-7`.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if !(1e-3..1e6).contains(&size) {
        let text = format!("{value:.3e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", without_zeros(mantissa));
    }
    // digits before the point take from those after it
    let powers = [1.0, 10.0, 100.0, 1000.0].iter();
    let whole = powers.filter(|power| size >= **power).count();
    let decimals = 4 - whole;
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// A number in a picture, with `digits` significant digits and a true minus sign: plain from 1e-4 to 1e6, else as `1.2e−7`.
pub fn typeset(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.is_nan() {
        return "not a number".to_owned();
    }
    if value.is_infinite() {
        return "infinite".to_owned();
    }
    // printed once in scientific form, so that rounding up to the next power of ten is counted
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        without_zeros(&format!("{value:.decimals$}")).to_owned()
    } else {
        format!("{}e{exponent}", without_zeros(mantissa))
    };
    text.replace('-', "\u{2212}")
}

/// A number with at most `decimals` decimals and no trailing zeros; never `-0`.
pub fn trimmed(value: f64, decimals: usize) -> String {
    match without_zeros(&format!("{value:.decimals$}")) {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

fn without_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// A number below 1 with `digits` significant digits, one above with `digits` decimals.
pub fn significant(value: f64, digits: usize) -> String {
    let mut decimals = digits;
    let mut scaled = value.abs();
    while scaled > 0.0 && scaled < 0.1 && decimals < 17 {
        scaled *= 10.0;
        decimals += 1;
    }
    trimmed(value, decimals)
}

/// A length or distance: millimetres below 10 cm, metres above.
pub fn metres(value_m: f64) -> String {
    if !value_m.is_finite() {
        return "no distance".to_owned();
    }
    if value_m.abs() >= 0.1 {
        return format!("{value_m:.3} m");
    }
    // 0.02 mm matters against a band of 0.1 mm, 12.34 mm does not need its hundredths
    let mm = value_m * 1000.0;
    if mm != 0.0 && mm.abs() < 1e-3 {
        "under 0.001 mm".to_owned()
    } else if mm.abs() < 1.0 {
        format!("{} mm", significant(mm, 2))
    } else {
        format!("{mm:.1} mm")
    }
}

/// A time in seconds, to the millisecond, without trailing zeros.
pub fn seconds(value_s: f64) -> String {
    format!("{} s", trimmed(value_s, 3))
}

/// A list of numbers such as `[1, 0.5]`, each with four decimals at most.
pub fn list(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|value| trimmed(*value, 4)).collect();
    format!("[{}]", texts.join(", "))
}

/// A list of lists, as [`list`] writes each.
pub fn lists(rows: &[Vec<f64>]) -> String {
    let texts: Vec<String> = rows.iter().map(|row| list(row)).collect();
    format!("[{}]", texts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_lose_nothing_that_matters() {
        for (value, text) in [
            (0.0, "0"),
            (-2.0, "-2"),
            (0.5, "0.5"),
            (1.234_56, "1.235"),
            (12.345_6, "12.35"),
            (1234.56, "1235"),
            (99.999_9, "100"),
            (0.012_345, "0.0123"),
            (0.000_012_345, "1.234e-5"),
            (12_345_678.0, "1.235e7"),
            (-1e-9, "-1e-9"),
        ] {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn pictures_have_the_digits_that_matter() {
        assert_eq!(typeset(0.0123456, 4), "0.01235");
        assert_eq!(typeset(99.9996, 4), "100");
        assert_eq!(typeset(-2.0, 4), "\u{2212}2");
        assert_eq!(typeset(1.0e300, 4), "1e300");
        assert_eq!(typeset(3.2e-7, 3), "3.2e\u{2212}7");
        assert_eq!(typeset(1234.0, 3), "1234");
        assert_eq!(typeset(f64::NAN, 3), "not a number");
    }

    #[test]
    fn lengths_have_the_unit_that_suits_them() {
        for (value_m, text) in [
            (1.5, "1.500 m"),
            (0.1, "0.100 m"),
            (0.0142, "14.2 mm"),
            (0.000_02, "0.02 mm"),
            (1e-9, "under 0.001 mm"),
            (0.0, "0 mm"),
            (f64::INFINITY, "no distance"),
        ] {
            assert_eq!(metres(value_m), text);
        }
        assert_eq!(seconds(2.35), "2.35 s");
        assert_eq!(trimmed(-0.000_01, 3), "0");
        assert_eq!(list(&[1.0, -0.25]), "[1, -0.25]");
    }
}
