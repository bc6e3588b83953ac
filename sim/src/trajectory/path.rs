//! A path in task space with a time law: pose, twist and rate of the twist at every time.

use nalgebra::Vector3;

use super::axis::{RestToRest, Sample, Trajectory};
use super::trajectory_error::TrajectoryError;
use super::turn::Turn;
use crate::spatial::{Pose, Twist};

/// A pose on a [`Path`] and the derivatives of its position by the fraction of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// The pose.
    pub world_from_tcp: Pose,
    /// First derivative of the position by the fraction \[m\], world axes.
    pub first: Vector3<f64>,
    /// Second derivative of the position by the fraction \[m\], world axes.
    pub second: Vector3<f64>,
}

/// Geometry in task space, without time, over a fraction from 0 at its start to 1 at its end.
pub trait Path {
    /// Length of the path of the position \[m\].
    fn length_m(&self) -> f64;

    /// The orientation along the path.
    fn turn(&self) -> &Turn;

    /// The point at a fraction; exact at 0 and 1, extrapolated beyond.
    fn at(&self, fraction: f64) -> PathPoint;

    /// The range of a time law, from 0: the length \[m\], or the angle \[rad\] if the position is constant.
    ///
    /// A limit of angular speed `ω` is the limit `ω · extent / angle` for the law; the same holds for acceleration and jerk.
    fn extent(&self) -> f64 {
        let length_m = self.length_m();
        if length_m > 0.0 {
            length_m
        } else {
            self.turn().angle_rad()
        }
    }
}

/// Time derivative of a [`Twist`], in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwistRate {
    /// Acceleration of the frame's origin \[m/s²\].
    pub linear: Vector3<f64>,
    /// Angular acceleration \[rad/s²\].
    pub angular: Vector3<f64>,
}

/// A pose in motion; twist and its rate are in world axes, at the origin of the moving frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseSample {
    /// The pose.
    pub world_from_tcp: Pose,
    /// Its velocity.
    pub twist: Twist,
    /// Its acceleration; on an arc including the centripetal part.
    pub twist_rate: TwistRate,
}

/// A trajectory: a [`Path`] with a time law over its extent.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongPath<P, L> {
    path: P,
    law: L,
    extent: f64,
}

impl<P: Path, L: Trajectory<Sample = Sample>> AlongPath<P, L> {
    /// The trajectory along `path` by `law`, whose position runs from exactly 0 to exactly [`Path::extent`].
    ///
    /// In between the law may leave that range, as a polynomial with velocities at its ends can; the path is then extrapolated.
    ///
    /// # Errors
    /// `LawOffPath` if the law starts or ends elsewhere.
    pub fn new(path: P, law: L) -> Result<Self, TrajectoryError> {
        let extent = path.extent();
        let from = law.at(f64::NEG_INFINITY).position;
        let to = law.at(f64::INFINITY).position;
        if from == 0.0 && to - extent == 0.0 {
            Ok(Self { path, law, extent })
        } else {
            Err(TrajectoryError::LawOffPath { from, to, extent })
        }
    }

    /// The geometry.
    pub fn path(&self) -> &P {
        &self.path
    }

    /// The time law.
    pub fn law(&self) -> &L {
        &self.law
    }
}

impl<P: Path, L: RestToRest> AlongPath<P, L> {
    /// The trajectory along `path` from rest to rest under limits of the speed of the position and of its tangential acceleration and
    /// jerk, or of their angular counterparts if the position is constant.
    ///
    /// # Errors
    /// What the time law refuses.
    pub fn rest_to_rest(path: P, limits: &L::Limits) -> Result<Self, TrajectoryError> {
        let law = L::rest_to_rest(0.0, path.extent(), limits)?;
        Self::new(path, law)
    }
}

impl<P: Path, L: Trajectory<Sample = Sample>> Trajectory for AlongPath<P, L> {
    type Sample = PoseSample;

    fn duration_s(&self) -> f64 {
        self.law.duration_s()
    }

    fn at(&self, t_s: f64) -> PoseSample {
        let law = self.law.at(t_s);
        // a path without extent is at its end from the start
        let (fraction, rate, rate_of_rate) = if self.extent > 0.0 {
            (
                law.position / self.extent,
                law.velocity / self.extent,
                law.acceleration / self.extent,
            )
        } else {
            (1.0, 0.0, 0.0)
        };
        let point = self.path.at(fraction);
        let rotation_vector = self.path.turn().rotation_vector_rad();
        PoseSample {
            world_from_tcp: point.world_from_tcp,
            twist: Twist {
                linear: point.first * rate,
                angular: rotation_vector * rate,
            },
            twist_rate: TwistRate {
                linear: point.first * rate_of_rate + point.second * (rate * rate),
                angular: rotation_vector * rate_of_rate,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use nalgebra::Matrix3;

    use super::*;
    use crate::spatial::{pose, rotation_from_rpy_deg};
    use crate::trajectory::arc::{Arc, ArcOrientation};
    use crate::trajectory::axis::{Knot, Limits};
    use crate::trajectory::cubic::Cubic;
    use crate::trajectory::line::Line;
    use crate::trajectory::trapezoid::Trapezoid;

    const LIMITS: Limits = Limits {
        speed: 0.5,
        acceleration: 1.0,
    };

    #[test]
    fn speed_along_a_line_is_the_speed_of_the_law() {
        let quarter = rotation_from_rpy_deg([0.0, 90.0, 0.0]);
        let end = pose(quarter, Vector3::new(0.0, 0.6, 0.8));
        let line = Line::between(&Pose::identity(), &end).unwrap();
        let motion = AlongPath::<_, Trapezoid>::rest_to_rest(line, &LIMITS).unwrap();
        // 0.5 s up, 0.5 s down over 0.125 m each, 1.5 s of cruise
        assert!((motion.duration_s() - 2.5).abs() < 1e-15);
        let middle = motion.at(1.25);
        assert!((middle.twist.linear - Vector3::new(0.0, 0.3, 0.4)).norm() < 1e-15);
        // a quarter turn over 1 m at 0.5 m/s
        assert!((middle.twist.angular - Vector3::y() * (0.5 * FRAC_PI_2)).norm() < 1e-15);
        assert_eq!(middle.twist_rate.linear, Vector3::zeros());
        assert_eq!(motion.at(motion.duration_s()).world_from_tcp, end);
        assert_eq!(motion.at(-1.0).world_from_tcp, Pose::identity());
    }

    #[test]
    fn on_a_circle_the_acceleration_points_to_the_centre() {
        let start = pose(Matrix3::identity(), Vector3::new(0.25, 0.0, 0.0));
        let arc = Arc::about_axis(
            &start,
            Vector3::zeros(),
            Vector3::z_axis(),
            2.0 * PI,
            ArcOrientation::Carried,
        );
        let motion = AlongPath::<_, Trapezoid>::rest_to_rest(arc.unwrap(), &LIMITS).unwrap();
        // half way round, in the cruise: v²/r = 1 m/s² towards the centre, v/r = 2 rad/s
        let half = motion.at(0.5 * motion.duration_s());
        assert!((half.twist.linear + Vector3::y() * 0.5).norm() < 1e-14);
        assert!((half.twist.angular - Vector3::z() * 2.0).norm() < 1e-14);
        assert!((half.twist_rate.linear - Vector3::x()).norm() < 1e-14);
    }

    #[test]
    fn a_turn_on_the_spot_runs_over_its_angle() {
        let half_turn = pose(rotation_from_rpy_deg([180.0, 0.0, 0.0]), Vector3::zeros());
        let line = Line::between(&Pose::identity(), &half_turn).unwrap();
        assert_eq!(line.extent(), PI);
        let motion = AlongPath::<_, Cubic>::rest_to_rest(line, &LIMITS).unwrap();
        let middle = motion.at(0.5 * motion.duration_s());
        assert!((middle.twist.angular.norm() - 0.5).abs() < 1e-15);
        assert_eq!(motion.at(motion.duration_s()).world_from_tcp, half_turn);
    }

    #[test]
    fn a_path_without_extent_takes_no_time() {
        let here = pose(rotation_from_rpy_deg([10.0, 0.0, 0.0]), Vector3::x());
        let line = Line::between(&here, &here).unwrap();
        let motion = AlongPath::<_, Trapezoid>::rest_to_rest(line, &LIMITS).unwrap();
        assert_eq!(motion.duration_s(), 0.0);
        assert_eq!(motion.at(0.0).world_from_tcp, here);
    }

    #[test]
    fn a_law_for_another_length_is_refused() {
        let end = pose(Matrix3::identity(), Vector3::x());
        let line = Line::between(&Pose::identity(), &end).unwrap();
        let law = Cubic::between(Knot::at_rest(0.0), Knot::at_rest(2.0), 1.0).unwrap();
        assert_eq!(
            AlongPath::new(line, law).unwrap_err().to_string(),
            "the time law runs from 0 to 2, the path from 0 to 1"
        );
    }
}
