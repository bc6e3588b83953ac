//! Rise, settling, overshoot and peak of a step response, exactly: no time grid that could miss a crossing.
//!
//! Each search splits the time line until a bound on the change of the curve (or of its derivatives) decides what an
//! interval holds: nothing, or a monotone piece, on which bisection is safe. Beyond a horizon the bounds tend to zero,
//! so a time constant of 10⁴ s costs as little as one of a millisecond. What costs is ringing that lasts for many
//! thousands of cycles while a slow part of the response creeps along the level sought: each cycle is then looked at.
//! The loops of [`super::PidLoop`] do not behave so; products of unrelated slow and undamped factors can.

use std::fmt;

use nalgebra::Complex;

use super::exponential_sum::Curve;
use super::transfer_function::{StepResponse, TransferFunction};

/// What is read off a step response that tends to a steady state other than zero.
///
/// All are relative to the steady state, so a negative one is treated as its mirror image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepMetrics {
    /// From the first crossing of 10 % to that of 90 % \[s\].
    pub rise_time_10_90_s: f64,
    /// First crossing of 10 % of the steady state \[s\]; 0 where the value just after the step is there already.
    pub t10_s: f64,
    /// First crossing of 90 % of the steady state \[s\]; 0 where the value just after the step is there already.
    pub t90_s: f64,
    /// Last time outside the band of ±2 % \[s\]; 0 if never outside.
    pub settling_time_2pct_s: f64,
    /// Last time outside the band of ±5 % \[s\]; 0 if never outside.
    pub settling_time_5pct_s: f64,
    /// How far the peak exceeds the steady state, in percent of it; 0 if it does not.
    pub overshoot_pct: f64,
    /// How far the response goes to the other side of zero, in percent of the steady state; 0 if it does not.
    pub undershoot_pct: f64,
    /// The furthest value on the side of the steady state; the steady state itself where it is never exceeded.
    pub peak: f64,
    /// When the peak is reached \[s\]; `None` where the steady state is never exceeded.
    pub peak_time_s: Option<f64>,
    /// What the response tends to.
    pub steady_state: f64,
    /// The value just after the step.
    pub value_at_0plus: f64,
}

/// Why a response has no metrics.
#[derive(Debug, Clone, PartialEq)]
pub enum StepMetricsError {
    /// A pole has a real part that is not negative, so there is no steady state.
    NotStable {
        /// The pole with the largest real part \[1/s\].
        pole: Complex<f64>,
    },
    /// The response returns to zero, as a sensitivity does: nothing to be relative to.
    SteadyStateIsZero,
}

impl fmt::Display for StepMetricsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotStable { pole } => {
                write!(f, "pole at {pole} 1/s is not stable: no steady state")
            }
            Self::SteadyStateIsZero => write!(
                f,
                "steady state is zero: metrics relative to it are undefined"
            ),
        }
    }
}

impl std::error::Error for StepMetricsError {}

impl TransferFunction {
    /// Metrics of the unit step response, to round-off (about 1e-12 of the time scale where the curve is not flat).
    ///
    /// # Errors
    ///
    /// - [`StepMetricsError::NotStable`]: a pole on or right of the imaginary axis.
    /// - [`StepMetricsError::SteadyStateIsZero`]: the response returns to zero.
    pub fn step_metrics(&self) -> Result<StepMetrics, StepMetricsError> {
        let response = self.step_response();
        let Some(steady_state) = response.steady_state() else {
            // Poles are sorted by real part.
            let pole = self.poles().last().copied().unwrap_or_default();
            return Err(StepMetricsError::NotStable { pole });
        };
        if steady_state == 0.0 {
            return Err(StepMetricsError::SteadyStateIsZero);
        }
        Ok(metrics_of(&response, steady_state))
    }
}

fn metrics_of(response: &StepResponse, steady_state: f64) -> StepMetrics {
    let value_at_0plus = response.value_at_0plus();
    let relative_at_0plus = value_at_0plus / steady_state;
    // y / steady - 1, which tends to zero
    let deviation = Curve::new(response.varying.divided_by(steady_state));
    let first_time_at = |fraction: f64| {
        if relative_at_0plus >= fraction {
            0.0
        } else {
            deviation.first_crossing(fraction - 1.0)
        }
    };
    let (t10_s, t90_s) = (first_time_at(0.1), first_time_at(0.9));

    // Less than the round-off of the sum is no overshoot.
    let noise = 8.0 * f64::EPSILON * (1.0 + deviation.f().bound(0.0, f64::INFINITY));
    let excess = deviation.highest_above(noise);
    let below_steady = Curve::new(deviation.f().negated());
    let trough = below_steady.highest_above(1.0 + noise);
    StepMetrics {
        rise_time_10_90_s: t90_s - t10_s,
        t10_s,
        t90_s,
        settling_time_2pct_s: deviation.last_time_beyond(0.02),
        settling_time_5pct_s: deviation.last_time_beyond(0.05),
        overshoot_pct: excess.map_or(0.0, |top| 100.0 * top.value),
        undershoot_pct: trough.map_or(0.0, |bottom| 100.0 * (bottom.value - 1.0)),
        peak: steady_state * (1.0 + excess.map_or(0.0, |top| top.value)),
        peak_time_s: excess.map(|top| top.t_s),
        steady_state,
        value_at_0plus,
    }
}

/// A point of a curve.
#[derive(Debug, Clone, Copy)]
struct Point {
    t_s: f64,
    value: f64,
}

/// Which of several crossings is wanted.
#[derive(Clone, Copy)]
enum Wanted {
    First,
    Last,
}

impl Curve {
    /// A time after which `|f|` stays below `size` \[s\].
    fn horizon_s(&self, size: f64) -> f64 {
        let Some(growth) = self.f().slowest_growth() else {
            return 0.0;
        };
        if self.f().bound(0.0, f64::INFINITY) < size {
            return 0.0;
        }
        let mut t_s = -1.0 / growth;
        while self.f().bound(t_s, f64::INFINITY) >= size {
            t_s *= 2.0;
        }
        t_s
    }

    /// First time at `level < 0`, for a curve that starts below it.
    fn first_crossing(&self, level: f64) -> f64 {
        let horizon_s = self.horizon_s(-level);
        self.crossing(level, horizon_s, Wanted::First)
            .expect("a curve that starts below a negative level and tends to zero crosses it")
    }

    /// Last time with `|f| > band`, 0 if never.
    fn last_time_beyond(&self, band: f64) -> f64 {
        let horizon_s = self.horizon_s(band);
        let last = |level| self.crossing(level, horizon_s, Wanted::Last).unwrap_or(0.0);
        last(band).max(last(-band))
    }

    /// The first or last time in `[0, horizon]` where the curve crosses `level`.
    fn crossing(&self, level: f64, horizon_s: f64, wanted: Wanted) -> Option<f64> {
        let below = |t_s: f64| self.f().value(t_s) < level;
        let mut pieces = vec![(0.0, horizon_s)];
        while let Some((from_s, to_s)) = pieces.pop() {
            let bounds = self.enclosure(from_s, to_s);
            if bounds.never_at(level) || self.f().bound(from_s, to_s) < level.abs() {
                continue;
            }
            if bounds.is_monotone() || is_instant(from_s, to_s) {
                if below(from_s) != below(to_s) {
                    return Some(bisect(from_s, to_s, below));
                }
                continue;
            }
            // The piece pushed last is looked at first.
            let middle_s = from_s + (to_s - from_s) / 2.0;
            let (left, right) = ((from_s, middle_s), (middle_s, to_s));
            pieces.extend(match wanted {
                Wanted::First => [right, left],
                Wanted::Last => [left, right],
            });
        }
        None
    }

    /// The highest point above `floor > 0`, if there is one.
    fn highest_above(&self, floor: f64) -> Option<Point> {
        let mut best: Option<Point> = None;
        let mut pieces = vec![(0.0, self.horizon_s(floor))];
        while let Some((from_s, to_s)) = pieces.pop() {
            let to_beat = best.map_or(floor, |point| point.value);
            let bounds = self.enclosure(from_s, to_s);
            if bounds.highest().min(self.f().bound(from_s, to_s)) <= to_beat {
                continue;
            }
            let mut candidates_s = vec![from_s, to_s];
            if bounds.is_monotone() || is_instant(from_s, to_s) {
                // the higher end
            } else if bounds.bends_one_way() {
                let rising = |t_s: f64| self.slope().value(t_s) > 0.0;
                if rising(from_s) && !rising(to_s) {
                    // In place of the ends: the top can be too flat for its height to be seen above theirs.
                    candidates_s = vec![bisect(from_s, to_s, rising)];
                }
            } else {
                let middle_s = from_s + (to_s - from_s) / 2.0;
                candidates_s.clear();
                pieces.extend([(middle_s, to_s), (from_s, middle_s)]);
            }
            for t_s in candidates_s {
                let value = self.f().value(t_s);
                if value > best.map_or(floor, |point| point.value) {
                    best = Some(Point { t_s, value });
                }
            }
        }
        best
    }
}

/// Whether an interval is too short to split: a few doubles long.
fn is_instant(from_s: f64, to_s: f64) -> bool {
    to_s - from_s <= 4.0 * f64::EPSILON * to_s
}

/// Where `holds` changes between two times at which it differs, to the last double.
fn bisect(from_s: f64, to_s: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let at_start = holds(from_s);
    let (mut from_s, mut to_s) = (from_s, to_s);
    loop {
        let middle_s = from_s + (to_s - from_s) / 2.0;
        if middle_s <= from_s || middle_s >= to_s {
            return to_s;
        }
        if holds(middle_s) == at_start {
            from_s = middle_s;
        } else {
            to_s = middle_s;
        }
    }
}
