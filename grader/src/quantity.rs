//! Numbers with their units, as people read them in messages.

/// A length or distance: millimetres below 10 cm, metres above.
pub fn metres(value_m: f64) -> String {
    if !value_m.is_finite() {
        "no distance".to_owned()
    } else if value_m.abs() < 0.1 {
        // 0.02 mm matters against a band of 0.1 mm, 12.34 mm does not need its hundredths
        let mm = value_m * 1000.0;
        if mm != 0.0 && mm.abs() < 1e-3 {
            "under 0.001 mm".to_owned()
        } else if mm.abs() < 1.0 {
            format!("{} mm", significant(mm, 2))
        } else {
            format!("{mm:.1} mm")
        }
    } else {
        format!("{value_m:.3} m")
    }
}

/// A time in seconds, to the millisecond, without trailing zeros.
pub fn seconds(value_s: f64) -> String {
    format!("{} s", trimmed(value_s, 3))
}

/// A value in the unit of a measure.
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "m" => metres(value),
        "s" => seconds(value),
        "" if value != 0.0 && value.abs() < 1e-6 => "under 0.0001 %".to_owned(),
        "" if value.abs() < 1e-3 => format!("{} %", significant(value * 100.0, 2)),
        "" => format!("{} %", trimmed(value * 100.0, 1)),
        unit if value != 0.0 && value.abs() < 5e-5 => format!("under 0.0001 {unit}"),
        unit => format!("{} {unit}", trimmed(value, 4)),
    }
}

/// Points: whole where whole, else two decimals without trailing zeros, cut off rather than rounded: what is not full does not look
/// full.
pub fn points(value: f64) -> String {
    // a sum of hundredths is off by its rounding
    trimmed((value * 100.0 + 1e-6).floor() / 100.0, 2)
}

/// A number with at most `decimals` decimals and no trailing zeros; never `-0`.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A number with `digits` significant digits.
pub fn significant(value: f64, digits: usize) -> String {
    let mut decimals = digits;
    let mut scaled = value.abs();
    while scaled > 0.0 && scaled < 0.1 && decimals < 17 {
        scaled *= 10.0;
        decimals += 1;
    }
    trimmed(value, decimals)
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
    fn numbers_read_as_people_write_them() {
        for (value, text) in [
            (0.0142, "14.2 mm"),
            (0.00002, "0.02 mm"),
            (1e-13, "under 0.001 mm"),
            (1.5, "1.500 m"),
            (0.0, "0 mm"),
            (f64::INFINITY, "no distance"),
        ] {
            assert_eq!(metres(value), text);
        }
        assert_eq!(seconds(2.35), "2.35 s");
        assert_eq!(with_unit(0.25, ""), "25 %");
        assert_eq!(with_unit(1e-4, ""), "0.01 %");
        assert_eq!(with_unit(3e-16, ""), "under 0.0001 %");
        assert_eq!(with_unit(0.0, ""), "0 %");
        assert_eq!(with_unit(4.3e-5, "rad"), "under 0.0001 rad");
        assert_eq!(points(3.0), "3");
        assert_eq!(trimmed(-0.00001, 3), "0");
        assert_eq!(list(&[1.0, -0.25]), "[1, -0.25]");
    }
}
