//! The trait of all trajectories, the sample of one axis, limits, and rest outside the motion.

use super::trajectory_error::{TrajectoryError, finite, in_range, positive_limit};

/// A motion over time with an exact end.
pub trait Trajectory {
    /// The state at one time.
    type Sample;

    /// The time from start to end \[s\], in closed form; zero if nothing moves.
    fn duration_s(&self) -> f64;

    /// The motion at `t_s` \[s\] after its start; at rest at the ends before 0 and after the duration.
    fn at(&self, t_s: f64) -> Self::Sample;
}

/// Position, velocity and acceleration of one axis: \[rad\], \[rad/s\], \[rad/s²\] or \[m\], \[m/s\], \[m/s²\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position \[rad or m\].
    pub position: f64,
    /// Velocity \[rad/s or m/s\].
    pub velocity: f64,
    /// Acceleration \[rad/s² or m/s²\].
    pub acceleration: f64,
}

impl Sample {
    /// At `position`, not moving.
    pub fn at_rest(position: f64) -> Self {
        Self {
            position,
            velocity: 0.0,
            acceleration: 0.0,
        }
    }
}

/// Position and velocity of one axis where two pieces of a motion meet, or where one ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Position \[rad or m\].
    pub position: f64,
    /// Velocity \[rad/s or m/s\].
    pub velocity: f64,
}

impl Knot {
    /// At `position`, not moving.
    pub fn at_rest(position: f64) -> Self {
        Self {
            position,
            velocity: 0.0,
        }
    }
}

/// Limits of speed and acceleration of one axis, the same in both directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest speed \[rad/s or m/s\].
    pub speed: f64,
    /// Largest acceleration \[rad/s² or m/s²\].
    pub acceleration: f64,
}

impl Limits {
    pub(super) fn checked(&self) -> Result<Self, TrajectoryError> {
        Ok(Self {
            speed: positive_limit("speed", self.speed)?,
            acceleration: positive_limit("acceleration", self.acceleration)?,
        })
    }
}

/// [`Limits`] of speed and acceleration, and of jerk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JerkLimits {
    /// Largest speed \[rad/s or m/s\].
    pub speed: f64,
    /// Largest acceleration \[rad/s² or m/s²\].
    pub acceleration: f64,
    /// Largest jerk \[rad/s³ or m/s³\].
    pub jerk: f64,
}

/// A motion of one axis from rest to rest, the fastest of its kind under its limits.
pub trait RestToRest: Trajectory<Sample = Sample> + Sized {
    /// The limits this kind of motion keeps (to rounding, some 1e-15 of the limit).
    type Limits;

    /// Moves from `start` to `end` \[rad or m\]; zero distance takes zero time.
    ///
    /// # Errors
    /// `NotFinite` for positions or limits that are not finite, `LimitNotPositive`, and `OutOfRange` where the distance or
    /// the duration leaves the range of numbers.
    fn rest_to_rest(start: f64, end: f64, limits: &Self::Limits) -> Result<Self, TrajectoryError>;
}

/// The signed distance from `start` to `end`, if all three are finite.
pub(super) fn distance(start: f64, end: f64) -> Result<f64, TrajectoryError> {
    in_range(
        "distance",
        finite("end position", end)? - finite("start position", start)?,
    )
}

/// The rest outside a motion; `None` inside it, both ends included, and for NaN.
pub(super) fn rest(t_s: f64, duration_s: f64, start: f64, end: f64) -> Option<Sample> {
    if t_s < 0.0 {
        Some(Sample::at_rest(start))
    } else if t_s > duration_s || duration_s <= 0.0 {
        Some(Sample::at_rest(end))
    } else {
        None
    }
}
