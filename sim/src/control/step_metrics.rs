//! The measures of a step response: final value, rise, settling and overshoot, of a run as of a linear loop.
//!
//! A response is given by its values at equal intervals, the first one just after the step, by its start (the value before the step)
//! and by its final value (the mean over the last part). All measures are shares of the way from the start to the final value. Times
//! are counted in intervals; between two values the response is a straight line.

/// A response lasts at least this share of the way to its target, or the joint hardly moved.
const LEAST_WAY: f64 = 0.01;
/// The least step where the target is not known \[rad, m, rad/s or m/s\].
pub const LEAST_STEP: f64 = 1e-3;

/// A response has settled where its last part stays this near to its mean, as a share of the step.
pub const SETTLED: f64 = 0.05;

/// A step response at equal intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepCurve<'a> {
    /// The values, in order.
    pub values: &'a [f64],
    /// The value before the step.
    pub start: f64,
    /// The final value.
    pub end: f64,
}

/// The mean of the last `count + 1` values, of all if there are fewer; NaN without values.
pub fn final_value(values: &[f64], count: usize) -> f64 {
    let part = &values[values.len().saturating_sub(1 + count)..];
    part.iter().sum::<f64>() / part.len() as f64
}

impl StepCurve<'_> {
    /// The way from the start to the final value.
    pub fn step(&self) -> f64 {
        self.end - self.start
    }

    /// The share of the step that is done at a value.
    fn gone(&self, value: f64) -> f64 {
        (value - self.start) / (self.end - self.start)
    }

    /// Whether the step is large enough to be measured: towards `target`, where it is known and not the start itself.
    pub fn has_moved(&self, target: Option<f64>) -> bool {
        match target.map(|target| target - self.start) {
            Some(way) if way.abs() > LEAST_STEP => self.step() / way >= LEAST_WAY,
            _ => self.step().abs() >= LEAST_STEP,
        }
    }

    /// The index of the last value that is further than `tolerance` from the final value; NaN is far.
    pub fn last_outside(&self, tolerance: f64) -> Option<usize> {
        let far = |value: &f64| {
            let near = (value - self.end).abs() <= tolerance;
            !near
        };
        self.values.iter().rposition(far)
    }

    /// When the response first reaches a share of its step, in intervals; zero where it begins there.
    fn first_at(&self, share: f64) -> Option<f64> {
        let gone = |at: usize| self.gone(self.values[at]);
        let at = (0..self.values.len()).find(|at| gone(*at) >= share)?;
        let Some(before) = at.checked_sub(1) else {
            return Some(0.0);
        };
        let (from, to) = (gone(before), gone(at));
        Some(before as f64 + (share - from) / (to - from))
    }

    /// When the response first reaches both shares of its step, in intervals.
    pub fn passes(&self, shares: [f64; 2]) -> Option<[f64; 2]> {
        let [from, to] = shares.map(|share| self.first_at(share));
        Some([from?, to?])
    }

    /// When the response is last further than `tolerance` from its final value, in intervals; zero where it never is, infinite where
    /// its last value is.
    pub fn settled_at(&self, tolerance: f64) -> f64 {
        let Some(last) = self.last_outside(tolerance) else {
            return 0.0;
        };
        let Some(next) = self.values.get(last + 1) else {
            return f64::INFINITY;
        };
        let edge = if self.values[last] > self.end {
            self.end + tolerance
        } else {
            self.end - tolerance
        };
        last as f64 + (self.values[last] - edge) / (self.values[last] - next)
    }

    /// How far the response goes past its final value, as a share of its step, and the index of its furthest value; zero where it does
    /// not, NaN where a value is.
    pub fn overshoot(&self) -> (f64, usize) {
        let rank = |value: f64| {
            if value.is_nan() {
                f64::NAN.abs()
            } else {
                value
            }
        };
        let gone = self.values.iter().map(|value| self.gone(*value));
        let furthest = gone.enumerate().reduce(|most, next| {
            let is_further = rank(next.1).total_cmp(&rank(most.1)).is_gt();
            if is_further { next } else { most }
        });
        let (at, most) = furthest.unwrap_or((0, f64::NAN));
        let over = most - 1.0;
        (if over < 0.0 { 0.0 } else { over }, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 2 down to 0 in four intervals, one interval at -0.5, then at rest at zero.
    const FALLS: [f64; 9] = [2.0, 1.5, 1.0, 0.5, 0.0, -0.5, 0.0, 0.0, 0.0];

    #[test]
    fn a_polygon_is_measured_by_hand() {
        let end = final_value(&FALLS, 2);
        assert_eq!(end, 0.0);
        let curve = StepCurve {
            values: &FALLS,
            start: 2.0,
            end,
        };
        assert_eq!(curve.step(), -2.0);
        // a tenth of the way is 1.8, nine tenths 0.2
        let [from, to] = curve.passes([0.1, 0.9]).expect("both");
        assert!((from - 0.4).abs() < 1e-12 && (to - 3.6).abs() < 1e-12);
        assert_eq!(curve.overshoot(), (0.25, 5));
        // within 0.1 from a fifth of an interval before the sixth value
        assert!((curve.settled_at(0.1) - 5.8).abs() < 1e-12);
        assert_eq!(curve.settled_at(3.0), 0.0);
        assert_eq!(curve.last_outside(0.1), Some(5));
        assert!(curve.has_moved(None) && curve.has_moved(Some(-1.0)));
        // the other way
        assert!(!curve.has_moved(Some(3.0)));
    }

    #[test]
    fn what_begins_beyond_a_share_takes_no_time_to_it() {
        let curve = StepCurve {
            values: &[0.95, 1.0, 1.0],
            start: 0.0,
            end: 1.0,
        };
        assert_eq!(curve.passes([0.1, 0.9]), Some([0.0, 0.0]));
        assert_eq!(curve.overshoot().0, 0.0);
        let never = StepCurve { end: 2.0, ..curve };
        assert_eq!(never.passes([0.1, 0.9]), None);
        assert_eq!(never.settled_at(0.1), f64::INFINITY);
    }

    #[test]
    fn a_value_that_is_no_number_is_no_measure() {
        let values = [0.0, f64::NAN, 1.0];
        let curve = StepCurve {
            values: &values,
            start: 0.0,
            end: 1.0,
        };
        assert!(curve.overshoot().0.is_nan());
        assert_eq!(curve.last_outside(0.5), Some(1));
        assert!(final_value(&[], 3).is_nan());
    }
}
