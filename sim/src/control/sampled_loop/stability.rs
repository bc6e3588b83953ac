//! At which gains and periods the loop is stable, found by bracketing over its spectral radius.

use nalgebra::Vector3;

use super::linear::{Held, Linear};
use crate::control::matrix_functions::{is_stable, spectral_radius};
use crate::control::servo::{Gains, ServoSettings};
use crate::model::robot::Robot;

/// The search for a stable period goes by this factor, and so sees no gap that is narrower.
const PERIOD_FACTOR: f64 = 1.25;

/// The search for a stable period goes this far, as a factor of the period either way.
const PERIOD_REACH: f64 = 256.0;

/// The search for a stable share of gains goes by this factor, down to [`LEAST_SHARE`].
const SHARE_FACTOR: f64 = 0.75;

/// Gains are not looked for below this share of theirs.
const LEAST_SHARE: f64 = 1e-5;

/// Halvings of a bracket: limits are told to about five digits.
const HALVINGS: u32 = 16;

/// How a robot under sampled servos behaves near one position.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledLoop {
    /// Growth from one servo sample to the next of what grows most, or decays least; a ratio. Beyond 1 the loop is unstable.
    pub spectral_radius: f64,
    /// Entry of `q` with the largest share of kinetic energy in that motion.
    pub worst_joint: usize,
    /// The greatest factor, at most 1, on all gains of that joint alone with which the loop is stable; a ratio.
    ///
    /// `None` where there is none down to 1e-5: other joints are unstable too, or the robot falls without strong gains.
    pub stable_share: Option<f64>,
    /// As [`Self::stable_share`], on all gains of all joints together.
    pub stable_share_of_all: Option<f64>,
    /// The servo period up to which these gains are stable \[s\]: the end of the range of stable periods that holds the given one or,
    /// if that is unstable, of the next range below it, ranges being told apart at a factor of 1.25.
    ///
    /// Infinite if no period up to 256 times the given one is unstable; `None` if none down to a 256th of it is stable.
    pub stable_period_s: Option<f64>,
}

impl SampledLoop {
    /// Whether the loop is stable; one on the edge, such as a joint that nothing holds, is, and so is all that grows by less than
    /// 1e-7 a sample.
    pub fn is_stable(&self) -> bool {
        self.stable_share_of_all.is_some_and(|share| share >= 1.0)
    }
}

/// Tells how `robot` under the servos of `settings`, sampled every `servo_s`, behaves near rest at `q`, shape `(n)`.
///
/// Robots with loops are taken by their independent joints, at a position that closes the loops. Gravity's slope is a central
/// difference. Gravity compensation follows the measured position, sampled and held like all else.
///
/// `None` in effort mode, which closes no loop; where the settings do not fit the robot or each other; where a joint moves no
/// inertia or the loops are singular; where a number is not finite; and for more than 40 independent joints.
///
/// # Panics
/// If `q` does not have the shape of the robot.
pub fn sampled_loop(
    robot: &Robot,
    settings: &ServoSettings,
    servo_s: f64,
    gravity_m_s2: &Vector3<f64>,
    q: &[f64],
) -> Option<SampledLoop> {
    assert_eq!(q.len(), robot.n(), "one position per joint that moves");
    if settings.gains.len() != robot.n() || !(servo_s > 0.0 && servo_s.is_finite()) {
        return None;
    }
    let near = Linear::new(robot, settings, gravity_m_s2, q)?;
    let held = near.held(servo_s)?;
    let (radius, mode) = spectral_radius(&near.transition(&held, &settings.gains)?)?;
    let worst_joint = robot.independent()[near.largest_share(&mode)];
    let stable = |held: &Held, gains: &[Gains]| {
        let transition = near.transition(held, gains);
        transition.is_some_and(|transition| is_stable(&transition))
    };
    let share = |alone: Option<usize>| {
        greatest_share(|share| {
            let mut gains = settings.gains.clone();
            for (i, gains) in gains.iter_mut().enumerate() {
                if alone.is_none_or(|joint| joint == i) {
                    gains.kp *= share;
                    gains.ki *= share;
                    gains.kd *= share;
                }
            }
            stable(&held, &gains)
        })
    };
    Some(SampledLoop {
        spectral_radius: radius,
        worst_joint,
        stable_share: share(Some(worst_joint)),
        stable_share_of_all: share(None),
        stable_period_s: end_of_stable_periods(servo_s, |period_s| {
            let held = near.held(period_s);
            held.is_some_and(|held| stable(&held, &settings.gains))
        }),
    })
}

/// The greatest stable share in (0, 1].
fn greatest_share(stable: impl Fn(f64) -> bool) -> Option<f64> {
    if stable(1.0) {
        return Some(1.0);
    }
    let mut above = 1.0;
    while above > LEAST_SHARE {
        let share = above * SHARE_FACTOR;
        if stable(share) {
            return Some(last_stable(share, above, stable));
        }
        above = share;
    }
    None
}

fn end_of_stable_periods(given_s: f64, stable: impl Fn(f64) -> bool) -> Option<f64> {
    let mut period_s = given_s;
    if stable(given_s) {
        while period_s <= given_s * PERIOD_REACH {
            let longer_s = period_s * PERIOD_FACTOR;
            if !stable(longer_s) {
                return Some(last_stable(period_s, longer_s, stable));
            }
            period_s = longer_s;
        }
        return Some(f64::INFINITY);
    }
    while period_s >= given_s / PERIOD_REACH {
        let shorter_s = period_s / PERIOD_FACTOR;
        if stable(shorter_s) {
            return Some(last_stable(shorter_s, period_s, stable));
        }
        period_s = shorter_s;
    }
    None
}

/// The end of what is stable between `low`, which is, and `high`, which is not.
fn last_stable(mut low: f64, mut high: f64, stable: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if stable(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
