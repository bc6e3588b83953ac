//! Measures with their units, and points, formatted for messages.

use kinemark_sim::text::number::{metres, seconds, short, significant, trimmed};

/// Larger numbers are shown as being above this one.
const BEYOND: f64 = 1e9;

/// The end of the words for what a function's check measured, where hidden cases decide the points and the value is not theirs.
pub const OF_VISIBLE_CASES: &str = ", visible cases";

/// A value in the unit of a measure.
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "m" if !value.is_finite() => metres(value),
        _ if value.is_nan() => "no number".to_owned(),
        _ if value >= BEYOND => beyond("over ", unit),
        _ if value <= -BEYOND => beyond("below -", unit),
        "m" => metres(value),
        "s" => seconds(value),
        "" if value != 0.0 && value.abs() < 1e-6 => "under 0.0001 %".to_owned(),
        "" if value.abs() < 1e-3 => format!("{} %", significant(value * 100.0, 2)),
        "" => format!("{} %", trimmed(value * 100.0, 1)),
        unit if value != 0.0 && value.abs() < 5e-5 => format!("under 0.0001 {unit}"),
        unit => format!("{} {unit}", trimmed(value, 4)),
    }
}

/// An end of a band, formatted like [`with_unit`], but as small as it is: "up to under 0.0001 rad" would say nothing.
pub fn end_of_band(value: f64, unit: &str) -> String {
    let words = with_unit(value, unit);
    if !words.starts_with("under ") {
        return words;
    }
    match unit {
        "m" => format!("{} mm", short(value * 1000.0)),
        "" => format!("{} %", short(value * 100.0)),
        unit => format!("{} {unit}", short(value)),
    }
}

fn beyond(which: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { "%" } else { unit };
    format!("{which}{BEYOND} {unit}")
}

/// A value in the unit of a measure, formatted like [`with_unit`], but with enough digits to differ from `limit` unless it is equal to
/// it.
pub fn with_unit_unlike(value: f64, limit: f64, unit: &str) -> String {
    let short = with_unit(value, unit);
    if value.total_cmp(&limit).is_eq() || short != with_unit(limit, unit) {
        return short;
    }
    let (scale, shown) = match unit {
        "m" if limit.abs() < 0.1 => (1000.0, "mm"),
        "" => (100.0, "%"),
        unit => (1.0, unit),
    };
    let written = |value: f64, decimals| trimmed(value * scale, decimals);
    let apart = (2..=15).find(|decimals| written(value, *decimals) != written(limit, *decimals));
    match apart {
        Some(decimals) => format!("{} {shown}", written(value, decimals)),
        None => short,
    }
}

/// Points with at most two decimals and no trailing zeros, rounded down, so that points that are not full do not look full.
pub fn points(value: f64) -> String {
    // a sum of hundredths has a rounding error
    trimmed((value * 100.0 + 1e-6).floor() / 100.0, 2)
}

/// Points of `of` for a record: all of them, or an integer number of hundredths, rounded down as by [`points`], but at least one if
/// anything was earned.
pub fn whole_hundredths(value: f64, of: f64) -> f64 {
    let cut = (value * 100.0 + 1e-6).floor() / 100.0;
    match value {
        all if all >= of => of,
        some if some > 0.0 && cut <= 0.0 => of.min(0.01),
        _ => cut.max(0.0),
    }
}

/// The sum of points, without the rounding error of binary addition.
pub fn sum_of_points(points: impl Iterator<Item = f64>) -> f64 {
    (points.sum::<f64>() * 1e9).round() / 1e9
}

/// The difference `b - a` of points, both as shown.
pub fn difference_of_points(a: f64, b: f64) -> f64 {
    let shown = |value: f64| (value * 100.0 + 1e-6).floor();
    (shown(b) - shown(a)) / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_miss_does_not_read_like_a_hit() {
        assert_eq!(with_unit_unlike(2.000_000_4, 2.0, "s"), "2.0000004 s");
        assert_eq!(with_unit_unlike(2.0, 2.0, "s"), "2 s");
        assert_eq!(with_unit_unlike(2.1, 2.0, "s"), "2.1 s");
        assert_eq!(with_unit_unlike(0.008_002, 0.008, "m"), "8.002 mm");
        assert_eq!(with_unit_unlike(0.9999, 1.0, ""), "99.99 %");
        assert_eq!(with_unit_unlike(0.0501, 0.05, "m"), "50.1 mm");
    }

    #[test]
    fn the_points_reported_add_up() {
        assert_eq!(whole_hundredths(1.4888, 2.0), 1.48);
        assert_eq!(whole_hundredths(0.9999, 1.0), 0.99);
        assert_eq!(whole_hundredths(0.29, 1.0), 0.29);
        assert_eq!(whole_hundredths(0.333, 0.333), 0.333);
        assert_eq!(whole_hundredths(0.0004, 1.0), 0.01);
        assert_eq!(whole_hundredths(0.0, 1.0), 0.0);
        let parts = [1.48, 5.0, 4.0, 2.23, 3.0, 1.0];
        assert_eq!(sum_of_points(parts.into_iter()), 16.71);
        assert_eq!(difference_of_points(24.0, 23.996), -0.01);
        assert_eq!(difference_of_points(30.0, 23.669), -6.34);
    }

    #[test]
    fn numbers_read_as_people_write_them() {
        assert_eq!(with_unit(0.25, ""), "25 %");
        assert_eq!(with_unit(1e-4, ""), "0.01 %");
        assert_eq!(with_unit(3e-16, ""), "under 0.0001 %");
        assert_eq!(with_unit(0.0, ""), "0 %");
        assert_eq!(with_unit(4.3e-5, "rad"), "under 0.0001 rad");
        assert_eq!(end_of_band(4.3e-5, "rad"), "4.3e-5 rad");
        assert_eq!(end_of_band(1e-7, "m"), "1e-4 mm");
        assert_eq!(end_of_band(1e-7, ""), "1e-5 %");
        assert_eq!(end_of_band(0.02, "rad"), with_unit(0.02, "rad"));
        assert_eq!(with_unit(1e300, "m"), "over 1000000000 m");
        assert_eq!(with_unit(f64::NEG_INFINITY, "N m"), "below -1000000000 N m");
        assert_eq!(points(3.0), "3");
    }
}
