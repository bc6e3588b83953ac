//! Jerk-limited motion: from rest to rest in seven segments of constant jerk, under limits of speed, acceleration and jerk.
//!
//! Written here rather than taken from the crate `rsruckig`, which plans between arbitrary states and failed in none of 120,000
//! random motions: its roots of polynomials use the platform's cosine, arc cosine and cube root as soon as any other crate
//! switches on `num-traits/std` (nalgebra does), so its bits may differ between platforms; and its end is summed up, not exact
//! to the bit (13,694 of 20,000 motions from rest to rest ended up to 9e-16 of their way off). From rest to rest the closed
//! form needs one square root and one cube root.

use super::axis::{JerkLimits, RestToRest, Sample, Trajectory, distance, rest};
use super::trajectory_error::{TrajectoryError, duration_for, positive_limit};

/// Jerk up, none, down; cruise; and the same mirrored: the fastest motion from rest to rest under [`JerkLimits`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JerkLimited {
    start: f64,
    end: f64,
    /// +1 or -1: the direction from `start` to `end`.
    direction: f64,
    jerk: f64,
    acceleration: f64,
    speed: f64,
    /// Time in which acceleration grows to its peak.
    jerking_s: f64,
    /// Time from rest to the peak speed.
    speeding_up_s: f64,
    duration_s: f64,
}

impl JerkLimited {
    /// The highest speed of the motion \[rad/s or m/s\]: the limit, or less over a short distance.
    pub fn peak_speed(&self) -> f64 {
        self.speed
    }

    /// The highest acceleration of the motion \[rad/s² or m/s²\]: the limit, or less if the jerk limit prevents reaching it.
    pub fn peak_acceleration(&self) -> f64 {
        self.acceleration
    }

    /// Distance, speed and acceleration `t_s` after the start, in the first half; mirrored, before the end.
    fn first_half(&self, t_s: f64) -> (f64, f64, f64) {
        let (j, a, v) = (self.jerk, self.acceleration, self.speed);
        let (jerking, speeding_up) = (self.jerking_s, self.speeding_up_s);
        if t_s < jerking {
            (j * t_s * t_s * t_s / 6.0, 0.5 * j * t_s * t_s, j * t_s)
        } else if t_s < speeding_up - jerking {
            let since = t_s - jerking;
            let v_jerking = 0.5 * a * jerking;
            (
                a * jerking * jerking / 6.0 + v_jerking * since + 0.5 * a * since * since,
                v_jerking + a * since,
                a,
            )
        } else if t_s < speeding_up {
            let until = speeding_up - t_s;
            let lag = 0.5 * j * until * until;
            (
                v * (0.5 * speeding_up - until) + lag * until / 3.0,
                v - lag,
                j * until,
            )
        } else {
            (v * (t_s - 0.5 * speeding_up), v, 0.0)
        }
    }
}

impl RestToRest for JerkLimited {
    type Limits = JerkLimits;

    /// Source: Biagiotti & Melchiorri, *Trajectory Planning for Automatic Machines and Robots* (2008), sec. 3.4.
    fn rest_to_rest(start: f64, end: f64, limits: &JerkLimits) -> Result<Self, TrajectoryError> {
        let signed = distance(start, end)?;
        let way = signed.abs();
        let v = positive_limit("speed", limits.speed)?;
        let a = positive_limit("acceleration", limits.acceleration)?;
        let j = positive_limit("jerk", limits.jerk)?;
        let a_over_j = a / j;

        // speeding up to the limit of speed, with and without a time at the limit of acceleration
        let (jerking_s, speeding_up_s) = if v < a * a_over_j {
            let jerking = (v / j).sqrt();
            (jerking, 2.0 * jerking)
        } else {
            (a_over_j, a_over_j + v / a)
        };
        let (jerking_s, speeding_up_s, speed, cruise_s) = if way >= v * speeding_up_s {
            (jerking_s, speeding_up_s, v, way / v - speeding_up_s)
        } else if way >= 2.0 * a * a_over_j * a_over_j {
            // speeding up takes the time t with t (t - a/j) a = distance
            let half = 0.5 * a_over_j;
            let speeding_up = half + (half * half + way / a).sqrt();
            (a_over_j, speeding_up, a * (speeding_up - a_over_j), 0.0)
        } else {
            let jerking = libm::cbrt(0.5 * (way / j));
            (jerking, 2.0 * jerking, j * jerking * jerking, 0.0)
        };
        Ok(Self {
            start,
            end,
            direction: 1.0_f64.copysign(signed),
            jerk: j,
            acceleration: a.min(j * jerking_s),
            speed,
            jerking_s,
            speeding_up_s,
            duration_s: duration_for(way, 2.0 * speeding_up_s + cruise_s.max(0.0))?,
        })
    }
}

impl Trajectory for JerkLimited {
    type Sample = Sample;

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn at(&self, t_s: f64) -> Sample {
        if let Some(rest) = rest(t_s, self.duration_s, self.start, self.end) {
            return rest;
        }
        let remaining_s = self.duration_s - t_s;
        // the second half is measured from the end, so that the end is exact
        if remaining_s < t_s {
            let (way, speed, acceleration) = self.first_half(remaining_s);
            return Sample {
                position: self.end - self.direction * way,
                velocity: self.direction * speed,
                acceleration: -self.direction * acceleration,
            };
        }
        let (way, speed, acceleration) = self.first_half(t_s);
        Sample {
            position: self.start + self.direction * way,
            velocity: self.direction * speed,
            acceleration: self.direction * acceleration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(way: f64, speed: f64, acceleration: f64, jerk: f64) -> JerkLimited {
        let limits = JerkLimits {
            speed,
            acceleration,
            jerk,
        };
        JerkLimited::rest_to_rest(0.0, way, &limits).unwrap()
    }

    #[test]
    fn the_four_shapes_take_the_times_worked_by_hand() {
        // nothing but jerk reached: four segments of cbrt(D / 2j) = 0.793700525984
        let jerk_only = motion(1.0, 1.0, 1.0, 1.0);
        assert!((jerk_only.duration_s() - 4.0 * 0.793_700_525_984_099_7).abs() < 1e-15);
        // speed, not acceleration: 2 sqrt(v/j) = 1 s to 1 m/s over 0.5 m, 1 m of cruise
        let with_speed = motion(2.0, 1.0, 10.0, 4.0);
        assert_eq!(with_speed.duration_s(), 3.0);
        assert_eq!(with_speed.peak_acceleration(), 2.0);
        // acceleration, not speed: a/j = 1, t (t - 1) = 6 gives 3 s up, peak 2 m/s
        let with_acceleration = motion(6.0, 10.0, 1.0, 1.0);
        assert_eq!(with_acceleration.duration_s(), 6.0);
        assert_eq!(with_acceleration.peak_speed(), 2.0);
        // all seven: a/j + v/a = 3 s up over 3 m, 4 m of cruise in 2 s
        let all = motion(10.0, 2.0, 1.0, 1.0);
        assert_eq!(all.duration_s(), 8.0);
        // 1/6 after the jerk, 1/6 + 1/2 + 1/2 after constant acceleration, 3 at the top, 5 half way
        assert!((all.at(1.0).position - 1.0 / 6.0).abs() < 1e-16);
        assert!((all.at(2.0).position - 7.0 / 6.0).abs() < 1e-15);
        let at = |position, velocity, acceleration| Sample {
            position,
            velocity,
            acceleration,
        };
        assert_eq!(all.at(3.0), at(3.0, 2.0, 0.0));
        assert_eq!(all.at(4.0), at(5.0, 2.0, 0.0));
        assert_eq!(all.at(8.0), at(10.0, 0.0, 0.0));
    }

    #[test]
    fn an_unlimited_jerk_gives_the_trapezoid() {
        use crate::trajectory::trapezoid::Trapezoid;
        let limits = super::super::axis::Limits {
            speed: 1.0,
            acceleration: 2.0,
        };
        let trapezoid = Trapezoid::rest_to_rest(0.0, 3.0, &limits).unwrap();
        let smooth = motion(3.0, 1.0, 2.0, 1e12);
        // each corner is rounded off over a/j = 2e-12 s
        assert!((smooth.duration_s() - trapezoid.duration_s()).abs() < 1e-11);
        for t_s in [0.2, 1.0, 3.3] {
            assert!((smooth.at(t_s).position - trapezoid.at(t_s).position).abs() < 1e-11);
        }
    }

    #[test]
    fn no_way_takes_no_time() {
        let standing = motion(0.0, 1.0, 1.0, 1.0);
        assert_eq!(standing.duration_s(), 0.0);
        assert_eq!(standing.at(0.0), Sample::at_rest(0.0));
    }

    #[test]
    fn limits_far_apart_do_not_overflow() {
        // a³ / j² is 1 although a³ is not a number
        let wide = motion(4.0, 1e300, 1e200, 1e300);
        assert!((wide.at(0.5 * wide.duration_s()).position - 2.0).abs() < 1e-14);
    }

    #[test]
    fn wrong_limits_are_reported() {
        let limits = JerkLimits {
            speed: 1.0,
            acceleration: 1.0,
            jerk: f64::NAN,
        };
        assert_eq!(
            JerkLimited::rest_to_rest(0.0, 1.0, &limits)
                .unwrap_err()
                .to_string(),
            "jerk must be a finite number, got NaN"
        );
    }
}
