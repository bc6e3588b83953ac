//! The feedback law behind efforts: which gains on the error, the speed, the integral and gravity give what `control` returned. It is
//! fitted by least squares, and kept only where it gives every command to some thousandths.

use kinemark_sim::control::Mode;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::dynamics::gravity_effort;

use crate::check::step_response::Response;

/// Root mean square of what the law leaves over, as a share of that of the commands.
const LEFT_OVER: f64 = 3e-3;
/// Terms that differ less than this, as a share of their size, cannot be separated.
const APART: f64 = 1e-4;
/// Calls that are looked at, at most.
const MOST_CALLS: usize = 500;

/// What `control` returns for a joint: the sum of these terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::check) struct Law {
    /// Effort for each unit of the error, target minus measured \[N m/rad, or of a speed N m s/rad\].
    pub(in crate::check) error: f64,
    /// Effort for each unit of the joint's speed, in a loop of the position \[N m s/rad\].
    pub(in crate::check) speed: f64,
    /// How often the effort that holds the arm against gravity is added.
    pub(in crate::check) gravity: f64,
    /// Effort for each unit of the integral of the error.
    pub(in crate::check) integral: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Term {
    Error,
    Speed,
    Gravity,
    Integral,
    Constant,
}

impl Law {
    /// The simplest law that gives the efforts of the joint of `response`; none where none of those tried does.
    pub(in crate::check) fn of(response: &Response<'_>) -> Option<Self> {
        use Term::{Error, Gravity, Integral, Speed};
        if response.facts.motion.servo.mode != Mode::Effort || response.asked.target.is_none() {
            return None;
        }
        let tried: &[&[Term]] = match response.asked.of {
            Fed::Position => &[
                &[Error],
                &[Error, Speed],
                &[Error, Gravity],
                &[Error, Integral],
                &[Error, Speed, Gravity],
                &[Error, Speed, Integral],
                &[Error, Speed, Gravity, Integral],
            ],
            Fed::Velocity => &[
                &[Error],
                &[Error, Integral],
                &[Error, Gravity],
                &[Error, Integral, Gravity],
            ],
        };
        let calls = Calls::of(response)?;
        tried.iter().find_map(|terms| calls.fitted(terms))
    }
}

/// Where the law of a position or a speed without an integral steers the joint of `response`, whatever its target.
pub(super) fn setpoint(response: &Response<'_>) -> Option<f64> {
    use Term::{Constant, Error, Gravity, Speed};
    if response.facts.motion.servo.mode != Mode::Effort {
        return None;
    }
    let tried: &[&[Term]] = match response.asked.of {
        Fed::Position => &[
            &[Error, Speed, Constant],
            &[Error, Speed, Gravity, Constant],
        ],
        Fed::Velocity => &[&[Error, Constant]],
    };
    let calls = Calls::of(response)?;
    let gains = tried.iter().find_map(|terms| calls.gains(terms))?;
    let of = |term: Term| gains[term as usize];
    // a gain of nothing steers nowhere
    (of(Error) > 1e-6).then(|| response.asked.target.unwrap_or(0.0) + of(Constant) / of(Error))
}

/// The calls of a run: what was returned for the joint, and what the terms were.
struct Calls {
    returned: Vec<f64>,
    /// One list for each [`Term`].
    terms: [Vec<f64>; 5],
}

impl Calls {
    fn of(response: &Response<'_>) -> Option<Self> {
        let (facts, joint) = (response.facts, response.asked.joint);
        let (trace, target) = (facts.trace, response.asked.target?);
        let stride = facts.motion.periods.ticks_per_control.get() as usize;
        let dt_s = facts.motion.periods.control_s();
        let calls: Vec<usize> = (0..facts.last_tick()).step_by(stride).collect();
        let every = calls.len().div_ceil(MOST_CALLS).max(1);
        let mut terms: [Vec<f64>; 5] = Default::default();
        let (mut returned, mut integral) = (Vec::new(), 0.0);
        for (i, &tick) in calls.iter().enumerate() {
            let error = target - response.values[tick];
            integral += error * dt_s;
            if i % every != 0 {
                continue;
            }
            let q = facts.robot.positions(trace.q.at(tick)).ok()?;
            let gravity = gravity_effort(facts.robot, &facts.motion.gravity_m_s2, &q);
            let now = [
                error,
                trace.qd.at(tick)[joint],
                gravity.as_slice()[joint],
                integral,
                1.0,
            ];
            terms
                .iter_mut()
                .zip(now)
                .for_each(|(term, now)| term.push(now));
            returned.push(trace.command.at(tick)[joint]);
        }
        Some(Self { returned, terms })
    }

    /// The law of these terms, if it gives what was returned.
    fn fitted(&self, terms: &[Term]) -> Option<Law> {
        let gains = self.gains(terms)?;
        Some(Law {
            error: gains[Term::Error as usize],
            speed: gains[Term::Speed as usize],
            gravity: gains[Term::Gravity as usize],
            integral: gains[Term::Integral as usize],
        })
    }

    /// The gain of each [`Term`], 0 of those that are not among `terms`, if together they give what was returned.
    fn gains(&self, terms: &[Term]) -> Option<[f64; 5]> {
        let columns: Vec<&[f64]> = terms
            .iter()
            .map(|term| &self.terms[*term as usize][..])
            .collect();
        let fitted = least_squares(&columns, &self.returned)?;
        let left = self.returned.iter().enumerate().map(|(row, returned)| {
            let given = columns
                .iter()
                .zip(&fitted)
                .map(|(column, gain)| column[row] * gain);
            returned - given.sum::<f64>()
        });
        let left = norm(&left.collect::<Vec<f64>>());
        let whole = norm(&self.returned);
        if whole.is_nan() || whole <= 0.0 || left > LEFT_OVER * whole {
            return None;
        }
        let mut gains = [0.0; 5];
        for (i, term) in terms.iter().enumerate() {
            gains[*term as usize] = fitted[i];
        }
        Some(gains)
    }
}

/// The factors of `columns` whose sum is nearest to `wanted`, by Gram and Schmidt; none where a column is nearly a sum of others. It is
/// arithmetic and roots alone, so it has the same bits everywhere.
fn least_squares(columns: &[&[f64]], wanted: &[f64]) -> Option<Vec<f64>> {
    if wanted.len() <= 2 * columns.len() {
        return None;
    }
    // columns[i] = sum of across[j] times upper[j][i]
    let count = columns.len();
    let mut across: Vec<Vec<f64>> = Vec::with_capacity(count);
    let mut upper = vec![vec![0.0; count]; count];
    for (i, column) in columns.iter().enumerate() {
        let mut rest = column.to_vec();
        let size = norm(&rest);
        for (j, known) in across.iter().enumerate() {
            let share = dot(known, &rest);
            upper[j][i] = share;
            let pairs = rest.iter_mut().zip(known);
            pairs.for_each(|(value, known)| *value -= share * known);
        }
        let left = norm(&rest);
        // NaN and a column of nothing, too
        let stands_apart = left > APART * size;
        if !stands_apart || !left.is_finite() {
            return None;
        }
        upper[i][i] = left;
        rest.iter_mut().for_each(|value| *value /= left);
        across.push(rest);
    }
    let mut factors = vec![0.0; count];
    for i in (0..count).rev() {
        let later: f64 = (i + 1..count).map(|j| upper[i][j] * factors[j]).sum();
        factors[i] = (dot(&across[i], wanted) - later) / upper[i][i];
    }
    Some(factors)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

#[cfg(test)]
mod tests {
    use super::least_squares;

    #[test]
    fn factors_are_found_and_columns_that_do_not_stand_apart_are_refused() {
        let ramp: Vec<f64> = (0..20).map(f64::from).collect();
        let ones = vec![1.0; 20];
        let wanted: Vec<f64> = ramp.iter().map(|x| 3.0 * x - 7.0).collect();
        let found = least_squares(&[&ramp, &ones], &wanted).expect("factors");
        assert!(
            (found[0] - 3.0).abs() < 1e-12 && (found[1] + 7.0).abs() < 1e-11,
            "{found:?}"
        );
        // of what is no sum of them the nearest: a line through 0, 1, 4, 9 by the normal equations
        let squares: Vec<f64> = ramp[..6].iter().map(|x| x * x).collect();
        let found = least_squares(&[&ramp[..6], &ones[..6]], &squares).expect("factors");
        // Σ x = 15, Σ x² = 55, Σ x³ = 225: slope 5, offset -10/3
        assert!((found[0] - 5.0).abs() < 1e-12, "{found:?}");
        assert!((found[1] + 10.0 / 3.0).abs() < 1e-12, "{found:?}");
        let twice: Vec<f64> = ramp.iter().map(|x| 2.0 * x).collect();
        assert_eq!(least_squares(&[&ramp, &twice], &wanted), None);
        assert_eq!(least_squares(&[&[0.0; 20]], &wanted), None);
        assert_eq!(least_squares(&[&[f64::NAN; 20]], &wanted), None);
        assert_eq!(least_squares(&[&ramp[..2]], &wanted[..2]), None);
    }
}
