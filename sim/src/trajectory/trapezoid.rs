//! Trapezoidal velocity profile: from rest to rest under limits of speed and acceleration, a triangle over a short distance.

use super::axis::{Limits, RestToRest, Sample, Trajectory, distance, rest};
use super::trajectory_error::{TrajectoryError, duration_for, positive_limit};

/// Constant acceleration, constant speed, constant deceleration: the fastest motion under [`Limits`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trapezoid {
    start: f64,
    end: f64,
    /// +1 or -1: the direction from `start` to `end`.
    direction: f64,
    speed: f64,
    acceleration: f64,
    deceleration: f64,
    speeding_up_s: f64,
    slowing_down_s: f64,
    duration_s: f64,
}

impl Trapezoid {
    /// Moves from `start` to `end` \[rad or m\] from rest to rest, slowing down with at most `deceleration` \[rad/s² or
    /// m/s²\].
    ///
    /// The end time is `v/a + v/d + (D - v²/2a - v²/2d) / v`, where `v` is the speed limit or, over a short distance,
    /// `sqrt(2 D a d / (a + d))`.
    ///
    /// # Errors
    /// `NotFinite`, `LimitNotPositive`, and `OutOfRange` where the distance or the duration leaves the range of numbers.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 9.2.2.3, here with two slopes.
    pub fn with_deceleration(
        start: f64,
        end: f64,
        limits: &Limits,
        deceleration: f64,
    ) -> Result<Self, TrajectoryError> {
        let signed = distance(start, end)?;
        let Limits {
            speed,
            acceleration: a,
        } = limits.checked()?;
        let d = positive_limit("deceleration", deceleration)?;
        let way = signed.abs();
        // the peak speed sqrt(2 D a d / (a + d)) of a motion without cruise, in an order that does not overflow
        let harmonic = a.min(d) / (1.0 + a.min(d) / a.max(d));
        let triangle = (2.0 * way).sqrt() * harmonic.sqrt();
        let peak = speed.min(triangle);
        let (speeding_up_s, slowing_down_s) = (peak / a, peak / d);
        let cruise = way - 0.5 * peak * (speeding_up_s + slowing_down_s);
        // a triangle has no cruise; what rounding leaves of it is dropped
        let cruise_s = if triangle > speed {
            cruise.max(0.0) / peak
        } else {
            0.0
        };
        Ok(Self {
            start,
            end,
            direction: 1.0_f64.copysign(signed),
            speed: peak,
            acceleration: a,
            deceleration: d,
            speeding_up_s,
            slowing_down_s,
            duration_s: duration_for(way, speeding_up_s + cruise_s + slowing_down_s)?,
        })
    }

    /// The highest speed of the motion \[rad/s or m/s\]: the limit, or less over a short distance.
    pub fn peak_speed(&self) -> f64 {
        self.speed
    }
}

impl RestToRest for Trapezoid {
    type Limits = Limits;

    fn rest_to_rest(start: f64, end: f64, limits: &Limits) -> Result<Self, TrajectoryError> {
        limits.checked()?;
        Self::with_deceleration(start, end, limits, limits.acceleration)
    }
}

impl Trajectory for Trapezoid {
    type Sample = Sample;

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn at(&self, t_s: f64) -> Sample {
        if let Some(rest) = rest(t_s, self.duration_s, self.start, self.end) {
            return rest;
        }
        // at zero also where the time of speeding up is lost in rounding
        if t_s < self.speeding_up_s || t_s <= 0.0 {
            let speed = self.acceleration * t_s;
            return Sample {
                position: self.start + self.direction * (0.5 * speed * t_s),
                velocity: self.direction * speed,
                acceleration: self.direction * self.acceleration,
            };
        }
        let remaining_s = self.duration_s - t_s;
        // measured from the end, so that the end is exact
        if remaining_s <= self.slowing_down_s {
            let speed = self.deceleration * remaining_s;
            return Sample {
                position: self.end - self.direction * (0.5 * speed * remaining_s),
                velocity: self.direction * speed,
                acceleration: -self.direction * self.deceleration,
            };
        }
        let way = self.speed * (t_s - 0.5 * self.speeding_up_s);
        Sample {
            position: self.start + self.direction * way,
            velocity: self.direction * self.speed,
            acceleration: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        speed: 2.0,
        acceleration: 4.0,
    };

    #[test]
    fn a_long_way_cruises() {
        // 0.5 s to 2 m/s over 0.5 m, 2 m of cruise in 1 s, and down again
        let motion = Trapezoid::rest_to_rest(1.0, -2.0, &LIMITS).unwrap();
        assert_eq!(motion.duration_s(), 2.0);
        let cruise = Sample {
            position: -0.5,
            velocity: -2.0,
            acceleration: 0.0,
        };
        assert_eq!(motion.at(1.0), cruise);
        let slowing = Sample {
            position: -1.875,
            velocity: -1.0,
            acceleration: 4.0,
        };
        assert_eq!(motion.at(1.75), slowing);
    }

    #[test]
    fn a_short_way_is_a_triangle() {
        // D = 0.25: peak sqrt(a D) = 1, a quarter of a second up and down
        let motion = Trapezoid::rest_to_rest(0.0, 0.25, &LIMITS).unwrap();
        assert!((motion.duration_s() - 0.5).abs() < 1e-15);
        assert!((motion.peak_speed() - 1.0).abs() < 1e-15);
        assert!((motion.at(0.25).position - 0.125).abs() < 1e-15);
    }

    #[test]
    fn slowing_down_may_be_gentler() {
        // up: 0.5 s, 0.5 m; down with 1 m/s²: 2 s, 2 m; cruise 1 m: 0.5 s
        let motion = Trapezoid::with_deceleration(0.0, 3.5, &LIMITS, 1.0).unwrap();
        assert_eq!(motion.duration_s(), 3.0);
        assert_eq!(motion.at(1.0).position, 1.5);
        assert_eq!(motion.at(2.0).velocity, 1.0);
        // triangle: a = 4, d = 1, D = 0.625: v = sqrt(2 · 0.625 · 4 / 5) = 1; 0.25 s up, 1 s down
        let short = Trapezoid::with_deceleration(0.0, 0.625, &LIMITS, 1.0).unwrap();
        assert!((short.duration_s() - 1.25).abs() < 1e-15);
    }

    #[test]
    fn no_way_takes_no_time() {
        let motion = Trapezoid::rest_to_rest(-0.3, -0.3, &LIMITS).unwrap();
        assert_eq!(motion.duration_s(), 0.0);
        for t_s in [-1.0, 0.0, 1.0] {
            assert_eq!(motion.at(t_s), Sample::at_rest(-0.3));
        }
    }

    #[test]
    fn slopes_shorter_than_the_resolution_of_time_still_start_and_end_exactly() {
        for (acceleration, deceleration) in [(1e30, 1e30), (1e200, 1e-3), (1e-3, 1e200)] {
            let limits = Limits {
                speed: 1e-9,
                acceleration,
            };
            let motion =
                Trapezoid::with_deceleration(0.1, 1e6 + 0.7, &limits, deceleration).unwrap();
            assert_eq!(motion.at(0.0).position, 0.1);
            assert_eq!(motion.at(motion.duration_s()).position, 1e6 + 0.7);
            let short =
                Trapezoid::with_deceleration(0.1, 0.1 + 1e-17 + 2e-16, &limits, deceleration);
            assert_eq!(short.unwrap().at(0.0).position, 0.1);
        }
    }

    #[test]
    fn wrong_numbers_are_reported() {
        assert_eq!(
            Trapezoid::with_deceleration(0.0, 1.0, &LIMITS, 0.0)
                .unwrap_err()
                .to_string(),
            "limit of deceleration must be positive, got 0: give its size, without a sign"
        );
        assert!(matches!(
            Trapezoid::rest_to_rest(-1.7e308, 1.7e308, &LIMITS).unwrap_err(),
            TrajectoryError::OutOfRange {
                what: "distance",
                ..
            }
        ));
    }
}
