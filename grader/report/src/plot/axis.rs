//! Axes: a range that holds the data, and round ticks in it.

use kinemark_sim::text::number::{exponent, power_of_ten};

/// How numbers lie along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub(super) min: f64,
    pub(super) max: f64,
    logarithmic: bool,
}

/// A tick and its words.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// Numbers beyond this are drawn at the edge: their differences would overflow.
const HUGE: f64 = 1e100;

impl Axis {
    /// Exactly from `min` to `max`.
    pub(super) fn exact(min: f64, max: f64) -> Self {
        Self {
            min,
            max: if max > min { max } else { min + 1.0 },
            logarithmic: false,
        }
    }

    /// Holds all finite `values` with some air, and spans at least `least`.
    pub(super) fn around(values: impl Iterator<Item = f64>, least: f64) -> Self {
        let (min, max) = extent(values).unwrap_or((0.0, 1.0));
        // smaller differences cannot be seen, and the labels of their ticks would differ only in digits that nobody reads
        let least = least.max(1e-3 * min.abs().max(max.abs())).max(1e-12);
        let air = (0.07 * (max - min)).max(0.5 * (least - (max - min)));
        Self::exact(min - air, max + air)
    }

    /// Logarithmic from `min` up to what holds `max`, in whole decades.
    pub(super) fn decades(min: f64, max: f64) -> Self {
        let low = exponent(min.clamp(1e-12, HUGE));
        let high = exponent(max.clamp(1e-12, HUGE)) + 1;
        Self {
            min: power_of_ten(low),
            max: power_of_ten(high.max(low + 1)),
            logarithmic: true,
        }
    }

    /// Where a number lies: 0 at `min`, 1 at `max`; a logarithmic axis holds what is below it at its foot.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        if self.logarithmic {
            let (low, high) = (libm::log10(self.min), libm::log10(self.max));
            (libm::log10(value.max(self.min)) - low) / (high - low)
        } else {
            (value.clamp(-HUGE, HUGE) - self.min) / (self.max - self.min)
        }
    }

    /// Whether equal ways along it are equal ratios.
    pub(super) fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Whether a number lies between the ends.
    pub(super) fn holds(&self, value: f64) -> bool {
        self.min <= value && value <= self.max
    }

    /// Round ticks, about `wanted` of them, and at least two wherever numbers differ enough.
    pub(super) fn ticks(&self, wanted: usize) -> Vec<Tick> {
        let more = (wanted..wanted + 8).map(|wanted| self.about(wanted));
        let mut enough = more.skip_while(|ticks| ticks.len() < 2);
        enough.next().unwrap_or_else(|| self.about(wanted))
    }

    fn about(&self, wanted: usize) -> Vec<Tick> {
        if self.logarithmic {
            let (low, high) = (exponent(self.min * 1.001), exponent(self.max * 1.001));
            return (low..=high)
                .map(|e| Tick {
                    value: power_of_ten(e),
                    label: label(1, e),
                })
                .collect();
        }
        let rough = (self.max - self.min) / wanted.max(1) as f64;
        let mut e = exponent(rough);
        let mantissa = match rough / power_of_ten(e) {
            m if m <= 1.0 => 1,
            m if m <= 2.0 => 2,
            m if m <= 5.0 => 5,
            _ => {
                e += 1;
                1
            }
        };
        let step = mantissa as f64 * power_of_ten(e);
        let first = (self.min / step).ceil() as i64;
        let last = (self.max / step).floor() as i64;
        (first..=last.min(first.saturating_add(40)))
            .map(|k| Tick {
                value: k as f64 * step,
                label: label(k.saturating_mul(mantissa), e),
            })
            .collect()
    }
}

/// The least and the greatest of the finite values.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|value| value.is_finite())
        .map(|value| value.clamp(-HUGE, HUGE))
        .fold(None, |found, value| match found {
            None => Some((value, value)),
            Some((min, max)) => Some((value.min(min), value.max(max))),
        })
}

/// `k` times ten to the power `e`, exactly as it is.
fn label(k: i64, e: i32) -> String {
    let value = (k as f64 * power_of_ten(e)).abs();
    let (mut mantissa, mut exponent) = (k, e);
    while k != 0 && mantissa % 10 == 0 {
        (mantissa, exponent) = (mantissa / 10, exponent + 1);
    }
    // a large number of many digits, as ticks near each other have, is read better whole
    let is_round = mantissa.abs() < 1000 || value >= 1e9;
    let text = if k == 0 {
        "0".to_owned()
    } else if e < -5 || (value >= 1e5 && is_round) {
        format!("{mantissa}e{exponent}")
    } else {
        let decimals = (-e).max(0) as usize;
        format!("{:.decimals$}", k as f64 * power_of_ten(e))
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: Axis, wanted: usize) -> Vec<String> {
        axis.ticks(wanted)
            .into_iter()
            .map(|tick| tick.label)
            .collect()
    }

    /// A signal that stands still, as a target or a gain does, has ticks of few digits.
    #[test]
    fn what_stands_still_has_plain_ticks() {
        for value in [0.5, 100.0, -3.25, 1.2345e6] {
            let axis = Axis::around([value, value].into_iter(), 0.0);
            let labels: Vec<String> = axis.ticks(4).into_iter().map(|tick| tick.label).collect();
            assert!(labels.len() >= 2, "{value}: {labels:?}");
            assert!(
                labels
                    .iter()
                    .all(|label| label.chars().count() <= 7 + usize::from(value < 0.0)),
                "{value}: {labels:?}"
            );
        }
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(
            labels(Axis::exact(0.0, 8.0), 8),
            ["0", "1", "2", "3", "4", "5", "6", "7", "8"]
        );
        assert_eq!(
            labels(Axis::exact(-0.03, 0.03), 3),
            ["\u{2212}0.02", "0.00", "0.02"].map(|l| l.replace("0.00", "0"))
        );
        assert_eq!(labels(Axis::exact(0.0, 3e7), 3), ["0", "1e7", "2e7", "3e7"]);
        assert_eq!(labels(Axis::exact(0.0, 1e5), 2), ["0", "50000", "1e5"]);
        assert_eq!(
            labels(Axis::decades(0.0002, 3.0), 4),
            ["0.0001", "0.001", "0.01", "0.1", "1", "10"]
        );
    }

    #[test]
    fn nothing_constant_and_huge_have_axes() {
        for values in [
            vec![],
            vec![0.0],
            vec![f64::NAN],
            vec![5.0, 5.0],
            vec![-1e308, 1e308],
            vec![1e-300],
        ] {
            let axis = Axis::around(values.iter().copied(), 0.1);
            assert!(
                axis.max > axis.min && axis.max.is_finite(),
                "{values:?}: {axis:?}"
            );
            assert!(!axis.ticks(4).is_empty(), "{values:?}");
            let inside = values
                .iter()
                .filter(|v| v.is_finite())
                .map(|v| axis.fraction(*v));
            assert!(
                inside.clone().all(|f| (-1e-9..=1.0 + 1e-9).contains(&f)),
                "{values:?}"
            );
        }
    }
}
