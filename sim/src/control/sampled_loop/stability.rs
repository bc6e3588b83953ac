//! The gains and periods at which the loop is stable, found by bisection on its spectral radius.

use nalgebra::Vector3;

use super::linear::{DiscretePlant, Linear};
use crate::control::matrix_functions::{is_stable, spectral_radius};
use crate::control::servo::{Gains, ServoSettings};
use crate::model::robot::Robot;

/// The search for a stable period or gain uses steps of this factor, and so misses narrower gaps.
const RANGE_FACTOR: f64 = 1.25;

/// The search for a stable period or gain goes this far, as a factor of the given value either way.
const RANGE_REACH: f64 = 256.0;

/// The search for a stable share of the gains uses steps of this factor, down to [`LEAST_SHARE`].
const SHARE_FACTOR: f64 = 0.75;

/// The search does not go below this share of the gains.
const LEAST_SHARE: f64 = 1e-5;

/// Halvings of a bracket: limits are exact to about five digits.
const HALVINGS: u32 = 16;

/// How a robot under sampled servos behaves near one position.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledLoop {
    /// Spectral radius: growth of the fastest growing mode from one servo sample to the next, a ratio. Above 1 the loop is unstable.
    pub spectral_radius: f64,
    /// Entry of `q` with the largest share of kinetic energy in that mode.
    pub worst_joint: usize,
    /// The greatest factor, at most 1, on all gains of that joint alone with which the loop is stable; a ratio.
    ///
    /// `None` if there is none down to 1e-5: other joints are unstable too, or the robot falls without high gains.
    pub stable_share: Option<f64>,
    /// As [`Self::stable_share`], on all gains of all joints together.
    pub stable_share_of_all: Option<f64>,
    /// The servo period up to which these gains are stable \[s\]: the end of the range of stable periods that contains the given one or,
    /// if that is unstable, of the next range below it. Gaps narrower than a factor of 1.25 between ranges are not found.
    ///
    /// Infinite if no period up to 256 times the given one is unstable; `None` if none down to a 256th of it is stable.
    pub stable_period_s: Option<f64>,
}

impl SampledLoop {
    /// Whether the loop is stable. A marginally stable loop, such as an uncontrolled joint, counts as stable, and so does one that
    /// grows by less than 1e-7 a sample.
    pub fn is_stable(&self) -> bool {
        self.stable_share_of_all.is_some_and(|share| share >= 1.0)
    }
}

/// Analyses `robot` under the servos of `settings`, sampled every `servo_s`, near rest at `q`, shape `(n)`.
///
/// Robots with loops are analysed in their independent joints, at a `q` that closes the loops. The slope of gravity is a central
/// difference. Gravity compensation follows the measured position, sampled and held like the rest of the servo.
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
    let plant = near.discretize(servo_s)?;
    let (radius, mode) = spectral_radius(&near.transition(&plant, &settings.gains)?)?;
    let worst_joint = robot.independent()[near.largest_share(&mode)];
    let stable = |plant: &DiscretePlant, gains: &[Gains]| {
        let transition = near.transition(plant, gains);
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
            stable(&plant, &gains)
        })
    };
    Some(SampledLoop {
        spectral_radius: radius,
        worst_joint,
        stable_share: share(Some(worst_joint)),
        stable_share_of_all: share(None),
        stable_period_s: end_of_stable_range(servo_s, |period_s| {
            let plant = near.discretize(period_s);
            plant.is_some_and(|plant| stable(&plant, &settings.gains))
        }),
    })
}

/// Whether the loop of [`sampled_loop`] is stable, at a fraction of its cost; `None` where that has no result.
///
/// # Panics
/// If `q` does not have the shape of the robot.
pub fn is_sampled_loop_stable(
    robot: &Robot,
    settings: &ServoSettings,
    servo_s: f64,
    gravity_m_s2: &Vector3<f64>,
    q: &[f64],
) -> Option<bool> {
    assert_eq!(q.len(), robot.n(), "one position per joint that moves");
    if settings.gains.len() != robot.n() || !(servo_s > 0.0 && servo_s.is_finite()) {
        return None;
    }
    let near = Linear::new(robot, settings, gravity_m_s2, q)?;
    let transition = near.transition(&near.discretize(servo_s)?, &settings.gains)?;
    Some(is_stable(&transition))
}

/// One of the three gains of a servo.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariedGain {
    /// The proportional gain.
    Kp,
    /// The integral gain.
    Ki,
    /// The derivative gain.
    Kd,
}

/// The factor on one gain of all joints up to which the loop of [`sampled_loop`] is stable, with the other gains as they are: the end
/// of the range of stable factors that contains 1 or, if that is unstable, of the next range below it.
///
/// Infinite if no factor up to 256 is unstable; `None` if none down to a 256th is stable, and where [`sampled_loop`] has no result.
///
/// # Panics
/// If `q` does not have the shape of the robot.
pub fn stable_gain_factor(
    robot: &Robot,
    settings: &ServoSettings,
    servo_s: f64,
    gravity_m_s2: &Vector3<f64>,
    q: &[f64],
    varied: VariedGain,
) -> Option<f64> {
    assert_eq!(q.len(), robot.n(), "one position per joint that moves");
    if settings.gains.len() != robot.n() || !(servo_s > 0.0 && servo_s.is_finite()) {
        return None;
    }
    let near = Linear::new(robot, settings, gravity_m_s2, q)?;
    let plant = near.discretize(servo_s)?;
    end_of_stable_range(1.0, |factor| {
        let mut gains = settings.gains.clone();
        for gains in &mut gains {
            match varied {
                VariedGain::Kp => gains.kp *= factor,
                VariedGain::Ki => gains.ki *= factor,
                VariedGain::Kd => gains.kd *= factor,
            }
        }
        let transition = near.transition(&plant, &gains);
        transition.is_some_and(|transition| is_stable(&transition))
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

/// The end of the range of stable values that contains `given` or, if that is unstable, of the next range below it.
fn end_of_stable_range(given: f64, stable: impl Fn(f64) -> bool) -> Option<f64> {
    let mut value = given;
    if stable(given) {
        while value <= given * RANGE_REACH {
            let greater = value * RANGE_FACTOR;
            if !stable(greater) {
                return Some(last_stable(value, greater, stable));
            }
            value = greater;
        }
        return Some(f64::INFINITY);
    }
    while value >= given / RANGE_REACH {
        let smaller = value / RANGE_FACTOR;
        if stable(smaller) {
            return Some(last_stable(smaller, value, stable));
        }
        value = smaller;
    }
    None
}

/// The stability limit between `low`, which is stable, and `high`, which is not.
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
