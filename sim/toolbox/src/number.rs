//! Numbers as people read them.

/// A number with four significant digits.
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
    let whole = [1.0, 10.0, 100.0, 1000.0]
        .iter()
        .filter(|power| size >= **power)
        .count();
    let decimals = 4 - whole;
    without_zeros(&format!("{value:.decimals$}")).to_owned()
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

/// A number below 1 with `digits` significant digits.
fn significant(value: f64, digits: usize) -> String {
    let mut decimals = digits;
    let mut scaled = value.abs();
    while scaled > 0.0 && scaled < 0.1 && decimals < 17 {
        scaled *= 10.0;
        decimals += 1;
    }
    trimmed(value, decimals)
}

/// A time in seconds, to the millisecond, without trailing zeros.
pub fn seconds(value_s: f64) -> String {
    format!("{} s", trimmed(value_s, 3))
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
    fn lengths_have_the_unit_that_suits_them() {
        for (value_m, text) in [
            (1.5, "1.500 m"),
            (0.1, "0.100 m"),
            (0.0123, "12.3 mm"),
            (0.000_02, "0.02 mm"),
            (1e-9, "under 0.001 mm"),
            (0.0, "0 mm"),
            (f64::INFINITY, "no distance"),
        ] {
            assert_eq!(metres(value_m), text);
        }
        assert_eq!(seconds(0.25), "0.25 s");
        assert_eq!(trimmed(-0.000_01, 2), "0");
    }
}
