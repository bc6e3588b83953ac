//! Quintic polynomial: position, velocity and acceleration at both ends, in a given time.

use super::axis::{Limits, RestToRest, Sample, Trajectory, distance, rest};
use super::trajectory_error::{TrajectoryError, duration_for, finite, in_range, positive_duration};

/// `10 / √3`: the peak acceleration of a quintic from rest to rest, times `T² / D`.
const PEAK_ACCELERATION: f64 = 5.773_502_691_896_257;

/// A quintic in time between two full states; from rest to rest it is the minimum-jerk trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quintic {
    start: Sample,
    end: Sample,
    duration_s: f64,
    /// Factors of `u³`, `u⁴` and `u⁵`, `u = t / duration`, in units of position.
    factors: [f64; 3],
}

impl Quintic {
    /// The quintic from `start` to `end` in `duration_s`.
    ///
    /// # Errors
    /// `NotFinite`, `DurationNotPositive`, and `OutOfRange` where accelerations leave the range of numbers.
    ///
    /// Source: Craig, *Introduction to Robotics*, 3rd ed. (2005), sec. 7.3, in `u = t / duration`.
    pub fn between(start: Sample, end: Sample, duration_s: f64) -> Result<Self, TrajectoryError> {
        let d = distance(start.position, end.position)?;
        let t = positive_duration(duration_s)?;
        let v0 = finite("start velocity", start.velocity)? * t;
        let v1 = finite("end velocity", end.velocity)? * t;
        let a0 = finite("start acceleration", start.acceleration)? * t * t;
        let a1 = finite("end acceleration", end.acceleration)? * t * t;
        let factors = [
            10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
            -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
            6.0 * d - 3.0 * (v0 + v1) - 0.5 * a0 + 0.5 * a1,
        ];
        Self::from_factors(start, end, t, factors)
    }

    /// Shortest time \[s\] in which a quintic from rest to rest over `distance` \[rad or m\] keeps `limits`.
    ///
    /// The peak speed is `15/8 D / T` half way, the peak acceleration `10/√3 D / T²` at `u = 1/2 ± √3/6`.
    ///
    /// # Errors
    /// `NotFinite`, `LimitNotPositive`, and `OutOfRange` where the time leaves the range of numbers.
    ///
    /// Source: Biagiotti & Melchiorri, *Trajectory Planning for Automatic Machines and Robots* (2008), sec. 2.1.
    pub fn shortest_duration_s(distance: f64, limits: &Limits) -> Result<f64, TrajectoryError> {
        let limits = limits.checked()?;
        let d = finite("distance", distance)?.abs();
        let for_speed = 1.875 * (d / limits.speed);
        let for_acceleration = (PEAK_ACCELERATION * (d / limits.acceleration)).sqrt();
        duration_for(d, for_speed.max(for_acceleration))
    }

    fn from_factors(
        start: Sample,
        end: Sample,
        duration_s: f64,
        factors: [f64; 3],
    ) -> Result<Self, TrajectoryError> {
        // bounds every acceleration of the motion
        let sum = 6.0 * factors[0].abs() + 12.0 * factors[1].abs() + 20.0 * factors[2].abs();
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

impl RestToRest for Quintic {
    type Limits = Limits;

    fn rest_to_rest(start: f64, end: f64, limits: &Limits) -> Result<Self, TrajectoryError> {
        let d = distance(start, end)?;
        let duration_s = Self::shortest_duration_s(d, limits)?;
        let (start, end) = (Sample::at_rest(start), Sample::at_rest(end));
        Self::from_factors(start, end, duration_s, [10.0 * d, -15.0 * d, 6.0 * d])
    }
}

impl Trajectory for Quintic {
    type Sample = Sample;

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn at(&self, t_s: f64) -> Sample {
        let (start, end, duration) = (self.start, self.end, self.duration_s);
        if let Some(rest) = rest(t_s, duration, start.position, end.position) {
            return rest;
        }
        if t_s >= duration {
            return end;
        }
        let u = t_s / duration;
        let [b3, b4, b5] = self.factors;
        let drift = t_s * (start.velocity + 0.5 * start.acceleration * t_s);
        let bend = u * (6.0 * b3 + u * (12.0 * b4 + 20.0 * b5 * u));
        let slope = u * u * (3.0 * b3 + u * (4.0 * b4 + 5.0 * b5 * u));
        Sample {
            position: start.position + (drift + u * u * u * (b3 + u * (b4 + u * b5))),
            velocity: start.velocity + (start.acceleration * t_s + slope / duration),
            acceleration: start.acceleration + bend / duration / duration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_way_from_rest_to_rest_the_speed_is_fifteen_eighths_of_the_mean() {
        let (start, end) = (Sample::at_rest(1.0), Sample::at_rest(3.0));
        let quintic = Quintic::between(start, end, 4.0).unwrap();
        let middle = Sample {
            position: 2.0,
            velocity: 0.9375,
            acceleration: 0.0,
        };
        assert_eq!(quintic.at(2.0), middle);
        assert_eq!(quintic.at(0.0), start);
        assert_eq!(quintic.at(4.0), end);
        // a quarter: 10/64 - 15/256 + 6/1024 = 106/1024 of the way
        assert_eq!(quintic.at(1.0).position, 1.0 + 2.0 * 106.0 / 1024.0);
    }

    #[test]
    fn it_follows_a_parabola_exactly_where_the_ends_ask_for_one() {
        // p = 1 - 2 t + 1.5 t²
        let state = |t: f64| Sample {
            position: 1.0 - 2.0 * t + 1.5 * t * t,
            velocity: -2.0 + 3.0 * t,
            acceleration: 3.0,
        };
        let quintic = Quintic::between(state(0.0), state(2.0), 2.0).unwrap();
        assert_eq!(quintic.at(0.5), state(0.5));
        assert_eq!(quintic.at(1.75), state(1.75));
    }

    #[test]
    fn the_shortest_time_reaches_the_limit_where_the_theory_says() {
        let limits = Limits {
            speed: 100.0,
            acceleration: 2.0,
        };
        let quintic = Quintic::rest_to_rest(0.0, 1.0, &limits).unwrap();
        let peak_s = quintic.duration_s() * (0.5 - 3.0_f64.sqrt() / 6.0);
        // rounding of a dozen operations on numbers near 10
        assert!((quintic.at(peak_s).acceleration - 2.0).abs() < 1e-14);
        // T = sqrt(5.773503 / 2) = 1.699044
        assert!((quintic.duration_s() - 1.699_044).abs() < 1e-6);
        let limits = Limits {
            speed: 0.5,
            acceleration: 100.0,
        };
        assert_eq!(Quintic::shortest_duration_s(1.0, &limits).unwrap(), 3.75);
    }

    #[test]
    fn wrong_numbers_are_reported() {
        let mut start = Sample::at_rest(0.0);
        start.acceleration = f64::INFINITY;
        assert_eq!(
            Quintic::between(start, Sample::at_rest(1.0), 1.0)
                .unwrap_err()
                .to_string(),
            "start acceleration must be a finite number, got inf"
        );
    }
}
