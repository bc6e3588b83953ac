//! Cubic polynomial: position and velocity at both ends, in a given time.

use super::axis::{Knot, Limits, RestToRest, Sample, Trajectory, distance, rest};
use super::trajectory_error::{TrajectoryError, duration_for, finite, in_range, positive_duration};

/// A cubic in time through two [`Knot`]s. Acceleration is linear in time and jumps at the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    start: Knot,
    end: Knot,
    duration_s: f64,
    /// Factors of `u²` and `u³`, `u = t / duration`, in units of position.
    factors: [f64; 2],
}

impl Cubic {
    /// The cubic from `start` to `end` in `duration_s`.
    ///
    /// # Errors
    /// `NotFinite`, `DurationNotPositive`, and `OutOfRange` where accelerations leave the range of numbers.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 9.2.2.1 and 9.3, in `u = t / duration`.
    pub fn between(start: Knot, end: Knot, duration_s: f64) -> Result<Self, TrajectoryError> {
        let d = distance(start.position, end.position)?;
        let t = positive_duration(duration_s)?;
        let v0 = finite("start velocity", start.velocity)? * t;
        let v1 = finite("end velocity", end.velocity)? * t;
        Self::from_factors(start, end, t, [3.0 * d - 2.0 * v0 - v1, v0 + v1 - 2.0 * d])
    }

    /// Shortest time \[s\] in which a cubic from rest to rest over `distance` \[rad or m\] keeps `limits`.
    ///
    /// The peak speed is `1.5 D / T` half way, the peak acceleration `6 D / T²` at the ends.
    ///
    /// # Errors
    /// `NotFinite`, `LimitNotPositive`, and `OutOfRange` where the time leaves the range of numbers.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 9.2.2.1.
    pub fn shortest_duration_s(distance: f64, limits: &Limits) -> Result<f64, TrajectoryError> {
        let limits = limits.checked()?;
        let d = finite("distance", distance)?.abs();
        let for_speed = 1.5 * (d / limits.speed);
        let for_acceleration = (6.0 * (d / limits.acceleration)).sqrt();
        duration_for(d, for_speed.max(for_acceleration))
    }

    fn from_factors(
        start: Knot,
        end: Knot,
        duration_s: f64,
        factors: [f64; 2],
    ) -> Result<Self, TrajectoryError> {
        // bounds every acceleration of the motion
        let sum = 2.0 * factors[0].abs() + 6.0 * factors[1].abs();
        if duration_s > 0.0 {
            in_range("acceleration", sum / duration_s / duration_s)?;
        }
        Ok(Self {
            start,
            end,
            duration_s,
            factors,
        })
    }
}

impl RestToRest for Cubic {
    type Limits = Limits;

    fn rest_to_rest(start: f64, end: f64, limits: &Limits) -> Result<Self, TrajectoryError> {
        let d = distance(start, end)?;
        let duration_s = Self::shortest_duration_s(d, limits)?;
        let (start, end) = (Knot::at_rest(start), Knot::at_rest(end));
        Self::from_factors(start, end, duration_s, [3.0 * d, -2.0 * d])
    }
}

impl Trajectory for Cubic {
    type Sample = Sample;

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn at(&self, t_s: f64) -> Sample {
        let (start, end, duration) = (self.start, self.end, self.duration_s);
        if let Some(rest) = rest(t_s, duration, start.position, end.position) {
            return rest;
        }
        let u = t_s / duration;
        let [b2, b3] = self.factors;
        let acceleration = (2.0 * b2 + 6.0 * b3 * u) / duration / duration;
        if t_s >= duration {
            return Sample {
                position: end.position,
                velocity: end.velocity,
                acceleration,
            };
        }
        Sample {
            position: start.position + (start.velocity * t_s + u * u * (b2 + u * b3)),
            velocity: start.velocity + u * (2.0 * b2 + 3.0 * b3 * u) / duration,
            acceleration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_way_from_rest_to_rest_the_speed_is_three_halves_of_the_mean() {
        let cubic = Cubic::between(Knot::at_rest(1.0), Knot::at_rest(3.0), 4.0).unwrap();
        // D = 2, T = 4: v = 1.5 D / T = 0.75, a = ± 6 D / T² = ± 0.75
        let expected = |position, velocity, acceleration| Sample {
            position,
            velocity,
            acceleration,
        };
        assert_eq!(cubic.at(0.0), expected(1.0, 0.0, 0.75));
        assert_eq!(cubic.at(2.0), expected(2.0, 0.75, 0.0));
        assert_eq!(cubic.at(4.0), expected(3.0, 0.0, -0.75));
        // a quarter: 3/16 - 2/64 = 10/64 of the way
        assert_eq!(cubic.at(1.0).position, 1.0 + 2.0 * 10.0 / 64.0);
    }

    #[test]
    fn outside_it_rests_even_where_the_ends_move() {
        let start = Knot {
            position: -1.0,
            velocity: 2.0,
        };
        let end = Knot {
            position: 0.1,
            velocity: -3.0,
        };
        let cubic = Cubic::between(start, end, 0.3).unwrap();
        assert_eq!(cubic.at(0.0).velocity, 2.0);
        assert_eq!(cubic.at(0.3).velocity, -3.0);
        assert_eq!(cubic.at(-1e-300), Sample::at_rest(-1.0));
        assert_eq!(cubic.at(0.300_000_1), Sample::at_rest(0.1));
        assert_eq!(cubic.at(f64::INFINITY), Sample::at_rest(0.1));
        assert!(cubic.at(f64::NAN).position.is_nan());
    }

    #[test]
    fn the_shortest_time_is_set_by_the_tighter_limit() {
        let limits = Limits {
            speed: 0.5,
            acceleration: 100.0,
        };
        assert_eq!(Cubic::shortest_duration_s(-1.0, &limits).unwrap(), 3.0);
        let limits = Limits {
            speed: 100.0,
            acceleration: 1.5,
        };
        assert_eq!(Cubic::shortest_duration_s(1.0, &limits).unwrap(), 2.0);
    }

    #[test]
    fn a_standing_axis_takes_no_time() {
        let limits = Limits {
            speed: 1.0,
            acceleration: 1.0,
        };
        let cubic = Cubic::rest_to_rest(0.7, 0.7, &limits).unwrap();
        assert_eq!(cubic.duration_s(), 0.0);
        assert_eq!(cubic.at(0.0), Sample::at_rest(0.7));
    }

    #[test]
    fn wrong_numbers_are_reported() {
        let (a, b) = (Knot::at_rest(0.0), Knot::at_rest(1.0));
        let text = |error: TrajectoryError| error.to_string();
        assert_eq!(
            text(Cubic::between(a, b, -0.5).unwrap_err()),
            "duration must be positive, got -0.5 s"
        );
        assert_eq!(
            text(Cubic::between(Knot::at_rest(f64::NAN), b, 1.0).unwrap_err()),
            "start position must be a finite number, got NaN"
        );
        assert!(matches!(
            Cubic::between(a, b, 1e-200).unwrap_err(),
            TrajectoryError::OutOfRange { .. }
        ));
        let limits = Limits {
            speed: 1.0,
            acceleration: -2.0,
        };
        assert_eq!(
            text(Cubic::rest_to_rest(0.0, 1.0, &limits).unwrap_err()),
            "limit of acceleration must be positive, got -2: give its size, without a sign"
        );
    }
}
