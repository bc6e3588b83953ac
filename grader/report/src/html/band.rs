//! A measured value against its band: in words, and as a small gauge.

use maud::{Markup, html};

use crate::measured::Measured;
use crate::visible::visible;
use kinemark_grader::record::grade::{CheckGrade, Measure, Outcome};

/// Value, limits and margin as a person reads them.
pub(super) struct MeasureText {
    /// The value.
    pub(super) value: String,
    /// What earns all and what earns none.
    pub(super) band: String,
    /// How far the value is from where all points are earned, if it is not right there.
    pub(super) margin: Option<String>,
    /// What the reference solution and the linear loop reach, where that is known.
    pub(super) beside: Option<String>,
}

/// The words for a measure.
pub(super) fn measure_text(measure: &Measure) -> MeasureText {
    let measured = Measured::of(measure);
    // a number and its unit are kept on one line
    let kept = |text: &str| visible(text).replace(' ', "\u{a0}");
    let (within, beyond) = if measure.zero >= measure.full {
        ("≤", "≥")
    } else {
        ("≥", "≤")
    };
    let words = match measure.margin() > Some(0.0) {
        true => "margin",
        false if measure.zero >= measure.full => "more than full points allow",
        false => "less than full points need",
    };
    MeasureText {
        value: match measure.value {
            Some(_) => kept(&measured.value),
            None => measured.value,
        },
        band: format!(
            "full {within} {}, none {beyond} {}",
            kept(&measured.full),
            kept(&measured.zero)
        ),
        margin: measured
            .margin
            .map(|margin| format!("{} {words}", kept(&margin))),
        beside: measured.beside.map(|beside| kept(&beside)),
    }
}

/// A bar from where all points are earned to where none are, with both numbers and a mark at the value; it says nothing that the words do not.
pub(super) fn gauge(measure: &Measure) -> Markup {
    // 0 at full, 1 at zero, drawn from -0.5 to 1.5
    let span = measure.zero - measure.full;
    let at = measure
        .value
        .filter(|_| span != 0.0)
        .map(|value| (value - measure.full) / span);
    let x = |at: f64| 20.0 + 80.0 * (at.clamp(-0.5, 1.5) + 0.5);
    let label = |x: f64| format!("{x:.1}");
    let Measured { full, zero, .. } = Measured::of(measure);
    html! {
        svg class="gauge" viewBox="18 0 164 34" aria-hidden="true" focusable="false" {
            rect class="full" x="20" y="9" width="40" height="6" rx="1" {}
            rect class="partial" x="60" y="9" width="80" height="6" {}
            rect class="none" x="140" y="9" width="40" height="6" rx="1" {}
            @if let Some(at) = at {
                @let x = x(at);
                @if at < -0.5 { path class="mark" d="M27 6 L19 12 L27 18 z" {} }
                @else if at > 1.5 { path class="mark" d="M173 6 L181 12 L173 18 z" {} }
                @else { rect class="mark" x=(label(x - 2.0)) y="3" width="4" height="18" rx="2" {} }
            }
            text x="60" y="31" text-anchor="middle" { (visible(&full)) }
            text x="140" y="31" text-anchor="middle" { (visible(&zero)) }
        }
    }
}

/// The outcome as symbol and word.
pub(super) fn outcome(check: &CheckGrade) -> Markup {
    let (class, word, path) = match check.outcome {
        Outcome::Full => ("full", "full points", "M3.5 8.5 L6.8 11.8 L12.5 4.8"),
        Outcome::Partial => ("partial", "some points", "M3.5 8 H12.5 M8 3.5 V12.5"),
        Outcome::None => ("none", "no points", "M4 4 L12 12 M12 4 L4 12"),
        Outcome::NotJudged => ("unjudged", "not judged", "M4 8 H12"),
        Outcome::AtHandIn => ("unjudged", "when you hand in", "M4 8 H12"),
    };
    html! {
        span class={ "pill " (class) } {
            @if check.outcome == Outcome::Partial {
                svg viewBox="0 0 16 16" aria-hidden="true" focusable="false" {
                    circle cx="8" cy="8" r="5.6" fill="none" stroke="currentColor" stroke-width="1.8" {}
                    path d="M8 2.4 A5.6 5.6 0 0 1 8 13.6 z" fill="currentColor" {}
                }
            } @else {
                svg viewBox="0 0 16 16" aria-hidden="true" focusable="false" {
                    path d=(path) fill="none" stroke="currentColor" stroke-width="2.2" stroke-linecap="round" stroke-linejoin="round" {}
                }
            }
            (word)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(value: Option<f64>, full: f64, zero: f64) -> Measure {
        Measure {
            quantity: "distance".to_owned(),
            value,
            unit: "m".to_owned(),
            full,
            zero,
            reference: None,
            prediction: None,
        }
    }

    #[test]
    fn a_value_is_shown_with_its_limits() {
        let text = measure_text(&measure(Some(0.0041), 0.002, 0.02));
        assert_eq!(text.value, "4.1\u{a0}mm");
        assert_eq!(text.band, "full ≤ 2.0\u{a0}mm, none ≥ 20.0\u{a0}mm");
        assert_eq!(
            text.margin.as_deref(),
            Some("2.1\u{a0}mm more than full points allow")
        );
    }

    #[test]
    fn a_band_can_run_downwards() {
        let text = measure_text(&measure(Some(0.5), 0.45, 0.1));
        assert_eq!(text.band, "full ≥ 0.450\u{a0}m, none ≤ 0.100\u{a0}m");
        assert_eq!(text.margin.as_deref(), Some("50.0\u{a0}mm margin"));
    }

    #[test]
    fn a_wild_answer_is_shown_in_metres() {
        let text = measure_text(&measure(Some(2325.872), 1e-4, 5e-3));
        assert_eq!(text.value, "2325.872\u{a0}m");
        assert_eq!(
            text.margin.as_deref(),
            Some("2325.872\u{a0}m more than full points allow")
        );
    }

    #[test]
    fn rounding_is_shown_as_next_to_nothing() {
        for full in [1e-4, 0.0] {
            let text = measure_text(&measure(Some(2.2e-16), full, 5e-3));
            assert_eq!(text.value, "under\u{a0}0.001\u{a0}mm");
        }
    }

    #[test]
    fn what_is_not_finite_says_so() {
        let text = measure_text(&measure(None, 0.002, 0.02));
        assert_eq!(
            (text.value.as_str(), text.margin),
            ("nothing to measure", None)
        );
    }
}
