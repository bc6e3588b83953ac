//! Values over a band as a small picture: bars where values lie, above what earns all points, a part, and none.

use kinemark_grader::record::quantity::with_unit;
use maud::{Markup, html};

use super::shown::picture_title;
use crate::statistics::{Band, CheckValues};

/// The picture goes from half a band before what earns all points to half a band beyond what earns none.
const FROM: f64 = -0.5;
const TO: f64 = 1.5;
/// Bars in it.
const BARS: usize = 40;
const WIDTH: f64 = 220.0;
/// Height of the highest bar.
const HIGH: f64 = 30.0;

/// The picture with its scale in words; nothing where the band has no width, or nothing was measured.
pub(super) fn strip(values: &CheckValues) -> Markup {
    if values.positions.is_empty() {
        return html! { span class="quiet" { "–" } };
    }
    let bars = bars(values);
    let most = bars.iter().copied().max().unwrap_or(1).max(1) as f64;
    let width = WIDTH / BARS as f64;
    let number = |x: f64| format!("{x:.1}");
    let x = |at: f64| WIDTH * (at - FROM) / (TO - FROM);
    html! {
        svg class="strip" viewBox="0 0 220 38" role="img" {
            (picture_title(&words(values)))
            @for (i, bar) in bars.iter().enumerate() {
                @if *bar > 0 {
                    @let height = (HIGH * *bar as f64 / most).max(1.5);
                    rect class=(zone(i)) x=(number(i as f64 * width + 0.5)) y=(number(HIGH - height)) width=(number(width - 1.0)) height=(number(height)) {}
                }
            }
            @for (class, from, to) in [("full", FROM, 0.0), ("partial", 0.0, 1.0), ("none", 1.0, TO)] {
                rect class={ (class) " zone" } x=(number(x(from))) y="32" width=(number(x(to) - x(from))) height="5" {}
            }
        }
        small { (scale(values)) }
    }
}

/// What a bar's values earn.
fn zone(bar: usize) -> &'static str {
    let at = FROM + (TO - FROM) * (bar as f64 + 0.5) / BARS as f64;
    match at {
        at if at < 0.0 => "full",
        at if at < 1.0 => "partial",
        _ => "none",
    }
}

/// How many values each bar has. Values beyond the picture are in its outermost bars, values on an edge where they earn more.
fn bars(values: &CheckValues) -> Vec<usize> {
    let mut bars = vec![0; BARS];
    let scale = BARS as f64 / (TO - FROM);
    for position in &values.positions {
        let at = (drawn(*position, values.band).clamp(FROM, TO) - FROM) * scale;
        // on an edge it belongs to the bar before
        let bar = (at - 1e-9).ceil().max(1.0) as usize - 1;
        bars[bar.min(BARS - 1)] += 1;
    }
    bars
}

/// Where a value is drawn. Where less is better and `full` is small against the band, everything from nothing to `full` would be one
/// bar: there the part that earns all points is drawn from 0 to `full`.
fn drawn(position: f64, band: Band) -> f64 {
    let full_in_bands = band.full / (band.zero - band.full);
    if position < 0.0 && full_in_bands > 0.0 && band.zero > band.full {
        -FROM * position / full_in_bands
    } else {
        position
    }
}

/// The band in words, numbers and units kept on one line.
fn scale(values: &CheckValues) -> String {
    let kept = |value: f64| with_unit(value, &values.unit).replace(' ', "\u{a0}");
    let Band { full, zero } = values.band;
    let (within, beyond) = if zero >= full {
        ("≤", "≥")
    } else {
        ("≥", "≤")
    };
    let mut words = format!("full {within} {}, none {beyond} {}", kept(full), kept(zero));
    if values.bands > 1 {
        words += ", and other bands by variant";
    }
    words
}

/// What the picture shows.
fn words(values: &CheckValues) -> String {
    let all = values.positions.len();
    let full = values.positions.iter().filter(|at| **at <= 0.0).count();
    let none = values.positions.iter().filter(|at| **at >= 1.0).count();
    let unit = |value: Option<&f64>| {
        value.map_or_else(String::new, |value| with_unit(*value, &values.unit))
    };
    let (least, most) = (unit(values.values.first()), unit(values.values.last()));
    format!(
        "{all} values from {least} to {most}: {full} where all points are earned, {} between, {none} where none are",
        all - full - none
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(full: f64, zero: f64, values: &[f64]) -> CheckValues {
        let mut positions: Vec<f64> = values
            .iter()
            .map(|value| (value - full) / (zero - full))
            .collect();
        positions.sort_by(f64::total_cmp);
        CheckValues {
            quantity: "error".to_owned(),
            unit: "m".to_owned(),
            band: Band { full, zero },
            bands: 1,
            values: values.to_vec(),
            positions,
            not_finite: 0,
            piles: Vec::new(),
        }
    }

    #[test]
    fn each_value_is_above_what_it_earns() {
        // a band of 1 to 2: ten bars up to it, twenty in it, ten beyond
        let bars = bars(&values(1.0, 2.0, &[0.0, 1.0, 1.01, 2.0, 2.01, 99.0]));
        let at = |bar: usize| (bars[bar], zone(bar));
        assert_eq!(at(0), (1, "full"));
        assert_eq!(at(9), (1, "full"), "on the edge");
        assert_eq!(at(10), (1, "partial"));
        assert_eq!(at(29), (1, "partial"), "on the edge");
        assert_eq!(at(30), (1, "none"));
        assert_eq!(at(39), (1, "none"));
        assert_eq!(bars.iter().sum::<usize>(), 6);
    }

    #[test]
    fn what_is_perfect_is_not_drawn_at_the_edge() {
        let near = values(1e-4, 5e-3, &[1e-16, 0.99e-4]);
        assert_eq!((bars(&near)[0], bars(&near)[9]), (1, 1));
        // more is better: 1 is on the edge
        let up = values(1.0, 0.5, &[1.0]);
        assert_eq!(bars(&up)[9], 1);
    }

    #[test]
    fn the_picture_says_what_it_shows() {
        let shown = strip(&values(0.002, 0.02, &[0.001, 0.005, 0.5])).into_string();
        assert!(shown.contains(
            "<title>3 values from 1.0 mm to 0.500 m: 1 where all points are earned, 1 between, 1 where none are</title>"
        ));
        assert!(shown.contains("full ≤ 2.0\u{a0}mm, none ≥ 20.0\u{a0}mm"));
        assert!(strip(&values(0.0, 0.0, &[])).into_string().contains("–"));
    }
}
