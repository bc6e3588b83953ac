//! Errors of trajectory planning: the invalid numbers, and what to give instead.

/// Why a trajectory cannot be planned from the given numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TrajectoryError {
    /// A number is NaN or infinite.
    #[error("{what} must be a finite number, got {got}")]
    NotFinite {
        /// What the number is.
        what: &'static str,
        /// The number.
        got: f64,
    },
    /// A duration is zero or negative.
    #[error("duration must be positive, got {got_s} s")]
    DurationNotPositive {
        /// The duration given.
        got_s: f64,
    },
    /// A limit of speed, acceleration, deceleration or jerk is zero or negative.
    #[error("limit of {what} must be positive, got {got}: give its size, without a sign")]
    LimitNotPositive {
        /// What is limited.
        what: &'static str,
        /// The limit given.
        got: f64,
    },
    /// A result overflows.
    #[error("{what} comes out as {got}: the numbers given are too large or too small to plan with")]
    OutOfRange {
        /// What was computed.
        what: &'static str,
        /// The result.
        got: f64,
    },
    /// The times of via points do not start at zero.
    #[error("the first via point must be at 0 s, got {got_s} s: count time from the first point")]
    FirstTimeNotZero {
        /// The time of the first point.
        got_s: f64,
    },
    /// The times of via points do not increase.
    #[error(
        "times of via points must increase: point {index} (from 0) is at {got_s} s, the one before at {previous_s} s"
    )]
    TimesNotIncreasing {
        /// The point whose time is not later than the one before, counted from 0.
        index: usize,
        /// Its time.
        got_s: f64,
        /// The time of the point before.
        previous_s: f64,
    },
    /// Too few points or axes.
    #[error("at least {least} {what} are needed, got {got}")]
    TooFew {
        /// Points or axes.
        what: &'static str,
        /// How many were given.
        got: usize,
        /// How many are needed.
        least: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("{what}: expected {expected} values, got {got}")]
    WrongCount {
        /// The list.
        what: &'static str,
        /// Its length.
        got: usize,
        /// The length it must have.
        expected: usize,
    },
    /// Two of the three points of an arc coincide.
    #[error(
        "{first} and {second} of the arc are {distance_m} m apart, too near to fix a circle: \
         for a full circle give its axis and an angle of 2π"
    )]
    SamePoint {
        /// Name of one point.
        first: &'static str,
        /// Name of the other.
        second: &'static str,
        /// Their distance.
        distance_m: f64,
    },
    /// The three points of an arc are on one line.
    #[error(
        "the points of the arc are on one line: they leave it by {height_m} m over {longest_m} m; \
         plan a straight line instead"
    )]
    CollinearPoints {
        /// Distance of one point from the line through the two that are farthest apart.
        height_m: f64,
        /// Distance of those two.
        longest_m: f64,
    },
    /// The start of an arc is on the axis it should turn about.
    #[error("the arc starts {distance_m} m from its axis: move the axis or the start")]
    StartOnAxis {
        /// Distance of the start from the axis.
        distance_m: f64,
    },
    /// A time law does not run from the start to the end of its path.
    #[error("the time law runs from {from} to {to}, the path from 0 to {extent}")]
    LawOffPath {
        /// Where the law starts.
        from: f64,
        /// Where the law ends.
        to: f64,
        /// The extent of the path \[m\], or \[rad\] for a turn on the spot.
        extent: f64,
    },
}

/// Refuses NaN and infinities.
pub(super) fn finite(what: &'static str, got: f64) -> Result<f64, TrajectoryError> {
    if got.is_finite() {
        Ok(got)
    } else {
        Err(TrajectoryError::NotFinite { what, got })
    }
}

/// Refuses durations that are not positive and finite.
pub(super) fn positive_duration(got_s: f64) -> Result<f64, TrajectoryError> {
    if finite("duration", got_s)? > 0.0 {
        Ok(got_s)
    } else {
        Err(TrajectoryError::DurationNotPositive { got_s })
    }
}

/// Refuses limits that are not positive and finite.
pub(super) fn positive_limit(what: &'static str, got: f64) -> Result<f64, TrajectoryError> {
    if finite(what, got)? > 0.0 {
        Ok(got)
    } else {
        Err(TrajectoryError::LimitNotPositive { what, got })
    }
}

/// Refuses results that left the range of finite numbers.
pub(super) fn in_range(what: &'static str, got: f64) -> Result<f64, TrajectoryError> {
    if got.is_finite() {
        Ok(got)
    } else {
        Err(TrajectoryError::OutOfRange { what, got })
    }
}

/// Refuses a computed duration that is not finite, or that rounding made zero although there is a distance to go.
pub(super) fn duration_for(way: f64, got_s: f64) -> Result<f64, TrajectoryError> {
    if got_s > 0.0 || way <= 0.0 {
        in_range("duration", got_s)
    } else {
        Err(TrajectoryError::OutOfRange {
            what: "duration",
            got: got_s,
        })
    }
}

/// Refuses lists of the wrong length.
pub(super) fn count(
    what: &'static str,
    got: usize,
    expected: usize,
) -> Result<(), TrajectoryError> {
    if got == expected {
        Ok(())
    } else {
        Err(TrajectoryError::WrongCount {
            what,
            got,
            expected,
        })
    }
}
