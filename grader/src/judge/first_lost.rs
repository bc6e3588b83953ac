//! The moment at which a check of a motion task began to lose points: when the curve it judged left the band of full points, or the
//! earliest moment of its evidence. Where more is better, a curve that is too low at some moment may still rise: then the evidence says it.

use kinemark_sim::ticks::Periods;

use crate::check::{Finding, Statistic};
use crate::record::grade::Instant;
use crate::record::graded::Curve;

/// The moment at which a check began to lose points in the visible run, if its curve or its evidence gives one.
pub(super) fn first_lost(finding: &Finding, periods: &Periods) -> Option<Instant> {
    let times = || finding.evidence.iter().filter_map(|fact| fact.time_s);
    let falls = |curve: &&Curve| curve.full <= curve.zero;
    let curve = finding.curve.as_ref().filter(falls);
    let left = curve.zip(finding.statistic);
    let left = left.and_then(|(curve, statistic)| match statistic {
        Statistic::Greatest => first_beyond(curve),
        Statistic::RootMeanSquare => mean_left(curve).or_else(|| {
            times()
                .filter_map(|time_s| went_beyond(curve, time_s))
                .min_by(f64::total_cmp)
        }),
        Statistic::SoFar => went_beyond(curve, f64::INFINITY),
    });
    let time_s = left.or_else(|| times().min_by(f64::total_cmp))?;
    // times of curves and of evidence are those of ticks
    let tick = (time_s / periods.step_s).round() as u64;
    Some(Instant {
        tick,
        time_s: periods.time_s(tick),
    })
}

/// The first moment beyond the band of full points \[s\].
fn first_beyond(curve: &Curve) -> Option<f64> {
    let full = curve.full?;
    let mut samples = curve.t_s.iter().zip(&curve.values);
    let first = samples.find(|(_, value)| **value > full);
    first.map(|(t_s, _)| *t_s)
}

/// The start \[s\] of the stretch beyond the band of full points with which the root mean square so far left it for good. A start that
/// is a little off and is made up for does not count.
fn mean_left(curve: &Curve) -> Option<f64> {
    let full = curve.full?;
    let numbers = curve.t_s.iter().zip(&curve.values);
    let numbers = numbers.filter(|(_, value)| !value.is_nan());
    let (mut sum, mut count, mut since) = (0.0, 0.0, None);
    for (t_s, value) in numbers {
        sum += value * value;
        count += 1.0;
        if (sum / count).sqrt() <= full {
            since = None;
        } else {
            since.get_or_insert(*t_s);
        }
    }
    went_beyond(curve, since?)
}

/// The start \[s\] of the stretch beyond the band of full points that contains the last sample up to `until_s`; `None` if that sample is
/// inside the band. NaN samples are gaps, which do not end a stretch.
fn went_beyond(curve: &Curve, until_s: f64) -> Option<f64> {
    let full = curve.full?;
    let samples = curve.t_s.iter().zip(&curve.values);
    let before = samples.rev().filter(|(t_s, _)| **t_s <= until_s);
    let numbers = before.filter(|(_, value)| !value.is_nan());
    let beyond = numbers.take_while(|(_, value)| **value > full);
    beyond.last().map(|(t_s, _)| *t_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples 0.1 s apart against a band that is full up to 1.
    fn curve(values: &[f64]) -> Curve {
        Curve {
            check: "check".to_owned(),
            title: "value".to_owned(),
            unit: String::new(),
            t_s: (0..values.len()).map(|i| i as f64 * 0.1).collect(),
            values: values.to_vec(),
            full: Some(1.0),
            zero: Some(2.0),
            reference: None,
            marks: Vec::new(),
            step: None,
        }
    }

    #[test]
    fn the_first_sample_beyond_counts_where_the_greatest_does() {
        assert_eq!(first_beyond(&curve(&[0.0, 1.0, 1.5, 0.5, 9.0])), Some(0.2));
        assert_eq!(first_beyond(&curve(&[0.0, 1.0, f64::NAN])), None);
    }

    #[test]
    fn a_mean_is_left_where_it_does_not_come_back() {
        // 1.5 at 0.1 s is made up for by 0.3 s; what begins at 0.4 s is not
        let left = mean_left(&curve(&[0.0, 1.5, 0.5, 0.0, 1.2, 3.0, 0.9]));
        assert_eq!(left, Some(curve(&[0.0; 5]).t_s[4]));
        // from the first sample on, although the band is entered later
        assert_eq!(mean_left(&curve(&[9.0, 3.0, 0.5, 0.5])), Some(0.0));
        assert_eq!(mean_left(&curve(&[0.5, 1.2, f64::NAN, 0.5])), None);
    }

    #[test]
    fn a_stretch_beyond_begins_where_the_band_was_left_for_it() {
        let twice = curve(&[0.0, 1.5, 0.5, 1.5, f64::NAN, 4.0, 1.5]);
        // the worst sample, at 0.5 s, is in the stretch from 0.3 s on, across the gap
        assert_eq!(went_beyond(&twice, 0.5), Some(curve(&[0.0; 4]).t_s[3]));
        assert_eq!(went_beyond(&twice, 0.1), Some(0.1));
        assert_eq!(went_beyond(&twice, 0.2), None);
        // a mean accumulates from the start
        assert_eq!(
            went_beyond(&curve(&[0.0, 3.0, 0.5, 2.0, 2.0]), f64::INFINITY),
            Some(curve(&[0.0; 4]).t_s[3])
        );
    }
}
