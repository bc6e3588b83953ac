//! Arc: a circular path through three points, or about an axis.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Unit, Vector3};

use super::path::{Path, PathPoint};
use super::trajectory_error::{TrajectoryError, finite, in_range};
use super::turn::Turn;
use crate::spatial::{Pose, pose};

/// Flatness below which three points count as a line: half a micrometre over half a metre, which no arm can follow; and the least
/// distance of two of them, as a fraction of the greatest.
const FLAT: f64 = 1e-6;

/// The orientation along an arc about an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArcOrientation {
    /// Constant.
    Kept,
    /// It rotates with the arc, as if fixed to the radius.
    Carried,
    /// It rotates by the smaller angle to this `world_from_tcp`.
    To(Matrix3<f64>),
}

/// Position on a circle, orientation about one fixed axis, both proportional to the fraction of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    start_m: Vector3<f64>,
    end_m: Vector3<f64>,
    /// From the centre to the start.
    radius: Vector3<f64>,
    /// `axis × radius`: the direction of travel at the start, with the length of the radius.
    across: Vector3<f64>,
    axis: Unit<Vector3<f64>>,
    angle_rad: f64,
    turn: Turn,
}

impl Arc {
    /// The arc from `world_from_start` through the point `p_via_in_world` \[m\] to `world_from_end`, less than a full
    /// circle.
    ///
    /// # Errors
    /// `SamePoint` where two of the points are within 1e-6 of the greatest distance, `CollinearPoints` where one is as
    /// near to the line through the others, `NotFinite` and `OutOfRange`.
    ///
    /// Source: the circumcentre `((|a|² b - |b|² a) × (a × b)) / (2 |a × b|²)` of the triangle `0, a, b`.
    pub fn through(
        world_from_start: &Pose,
        p_via_in_world: Vector3<f64>,
        world_from_end: &Pose,
    ) -> Result<Self, TrajectoryError> {
        let start_m = world_from_start.translation.vector;
        let end_m = world_from_end.translation.vector;
        for &x in start_m
            .iter()
            .chain(p_via_in_world.iter())
            .chain(end_m.iter())
        {
            finite("coordinate of the arc", x)?;
        }
        let (a, b) = (p_via_in_world - start_m, end_m - start_m);
        let sides = [
            ("start and via point", a.norm()),
            ("via point and end", (b - a).norm()),
            ("start and end", b.norm()),
        ];
        let longest_m = sides
            .iter()
            .fold(0.0, |longest: f64, side| longest.max(side.1));
        in_range("size of the arc", longest_m * longest_m)?;
        for (pair, distance_m) in sides {
            if distance_m <= FLAT * longest_m {
                let (first, second) = pair.split_once(" and ").unwrap_or((pair, ""));
                return Err(TrajectoryError::SamePoint {
                    first,
                    second,
                    distance_m,
                });
            }
        }
        // in units of the longest side, so that small arcs do not underflow
        let (a, b) = (a / longest_m, b / longest_m);
        let normal = a.cross(&b);
        let height = normal.norm();
        if height <= FLAT {
            return Err(TrajectoryError::CollinearPoints {
                height_m: height * longest_m,
                longest_m,
            });
        }
        let axis = Unit::new_unchecked(normal / height);
        let to_centre =
            (b * a.norm_squared() - a * b.norm_squared()).cross(&normal) / (2.0 * height * height);
        let radius = -to_centre;
        let across = axis.cross(&radius);
        // start, via and end are in this order counter-clockwise about the normal, so the angle is that of the end
        let to_end = b + radius;
        let angle = libm::atan2(across.dot(&to_end), radius.dot(&to_end));
        let turn = Turn::between(
            *world_from_start.rotation.matrix(),
            *world_from_end.rotation.matrix(),
        )?;
        Ok(Self {
            start_m,
            end_m,
            radius: radius * longest_m,
            across: across * longest_m,
            axis,
            angle_rad: if angle < 0.0 { angle + TAU } else { angle },
            turn,
        })
    }

    /// The arc from `world_from_start` by `angle_rad` about the line along `axis` through `p_on_axis_in_world` \[m\].
    ///
    /// Negative angles turn the other way; angles above 2π go round more than once. The centre of the circle is the point of
    /// the axis nearest to the start. At a full turn the end is where rounding of `2π` puts it, about 1e-16 radii from the
    /// start.
    ///
    /// # Errors
    /// `StartOnAxis` where the distance from the axis is within 1e-6 of that from the point given or zero, `NotFinite` and
    /// `OutOfRange`.
    pub fn about_axis(
        world_from_start: &Pose,
        p_on_axis_in_world: Vector3<f64>,
        axis: Unit<Vector3<f64>>,
        angle_rad: f64,
        orientation: ArcOrientation,
    ) -> Result<Self, TrajectoryError> {
        let start_m = world_from_start.translation.vector;
        for &x in start_m.iter().chain(p_on_axis_in_world.iter()) {
            finite("coordinate of the arc", x)?;
        }
        for &x in axis.iter() {
            finite("axis of the arc", x)?;
        }
        finite("angle of the arc", angle_rad)?;
        let from_axis = start_m - p_on_axis_in_world;
        let radius = from_axis - *axis * axis.dot(&from_axis);
        in_range("size of the arc", from_axis.norm_squared())?;
        if radius.norm() <= FLAT * from_axis.norm() {
            return Err(TrajectoryError::StartOnAxis {
                distance_m: radius.norm(),
            });
        }
        let start_rotation = *world_from_start.rotation.matrix();
        let turn = match orientation {
            ArcOrientation::Kept => Turn::by(start_rotation, Vector3::zeros())?,
            ArcOrientation::Carried => Turn::by(start_rotation, *axis * angle_rad)?,
            ArcOrientation::To(end) => Turn::between(start_rotation, end)?,
        };
        let mut arc = Self {
            start_m,
            end_m: start_m,
            radius,
            across: axis.cross(&radius),
            axis,
            angle_rad,
            turn,
        };
        in_range("length of the arc", arc.length_m())?;
        arc.end_m = arc.position_at_angle(angle_rad);
        Ok(arc)
    }

    /// The centre of the circle in the world \[m\].
    pub fn centre_in_world(&self) -> Vector3<f64> {
        self.start_m - self.radius
    }

    /// The radius \[m\].
    pub fn radius_m(&self) -> f64 {
        self.radius.norm()
    }

    /// The axis of the circle, counter-clockwise about which positive angles go.
    pub fn axis_in_world(&self) -> Unit<Vector3<f64>> {
        self.axis
    }

    /// The angle from start to end \[rad\], about the axis.
    pub fn angle_rad(&self) -> f64 {
        self.angle_rad
    }

    /// From the start rather than the centre, which is far away where the arc is flat; `1 - cos` as twice a squared sine.
    fn position_at_angle(&self, angle_rad: f64) -> Vector3<f64> {
        let half = libm::sin(0.5 * angle_rad);
        self.start_m + self.across * libm::sin(angle_rad) - self.radius * (2.0 * half * half)
    }
}

impl Path for Arc {
    fn length_m(&self) -> f64 {
        self.radius_m() * self.angle_rad.abs()
    }

    fn turn(&self) -> &Turn {
        &self.turn
    }

    fn at(&self, fraction: f64) -> PathPoint {
        let angle = self.angle_rad * fraction;
        let position_m = if fraction - 1.0 == 0.0 {
            self.end_m
        } else {
            self.position_at_angle(angle)
        };
        let (sine, cosine) = libm::sincos(angle);
        let outward = self.radius * cosine + self.across * sine;
        let forward = self.across * cosine - self.radius * sine;
        PathPoint {
            world_from_tcp: pose(self.turn.at(fraction), position_m),
            first: forward * self.angle_rad,
            second: outward * (-self.angle_rad * self.angle_rad),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn at(x: f64, y: f64, z: f64) -> Pose {
        pose(Matrix3::identity(), Vector3::new(x, y, z))
    }

    #[test]
    fn three_points_fix_the_circle_and_its_sense() {
        // unit circle about (1, 1, 0.5): from the west over the south to the east, and the long way over the north and west
        let (west, south, east) = (
            at(0.0, 1.0, 0.5),
            Vector3::new(1.0, 0.0, 0.5),
            at(2.0, 1.0, 0.5),
        );
        let arc = Arc::through(&west, south, &east).unwrap();
        assert!((arc.centre_in_world() - Vector3::new(1.0, 1.0, 0.5)).norm() < 1e-15);
        assert!((arc.angle_rad() - PI).abs() < 1e-15);
        assert!((arc.length_m() - PI).abs() < 1e-15);
        assert!((arc.axis_in_world().into_inner() - Vector3::z()).norm() < 1e-15);
        let middle = arc.at(0.5).world_from_tcp.translation.vector;
        assert!((middle - south).norm() < 1e-15);
        assert_eq!(arc.at(0.0).world_from_tcp, west);
        assert_eq!(arc.at(1.0).world_from_tcp, east);
        let north = at(1.0, 2.0, 0.5);
        let long = Arc::through(&north, Vector3::new(0.0, 1.0, 0.5), &east).unwrap();
        assert!((long.angle_rad() - 1.5 * PI).abs() < 1e-15);
        let third = long.at(1.0 / 3.0).world_from_tcp.translation.vector;
        assert!((third - Vector3::new(0.0, 1.0, 0.5)).norm() < 1e-15);
    }

    #[test]
    fn an_axis_through_any_of_its_points_makes_the_same_arc() {
        let start = at(2.0, 0.0, 1.0);
        let about = |z| {
            let p_on_axis = Vector3::new(1.0, 0.0, z);
            Arc::about_axis(
                &start,
                p_on_axis,
                Vector3::z_axis(),
                -FRAC_PI_2,
                ArcOrientation::Carried,
            )
            .unwrap()
        };
        let arc = about(7.0);
        assert_eq!(arc.centre_in_world(), Vector3::new(1.0, 0.0, 1.0));
        let end = arc.at(1.0).world_from_tcp;
        assert!((end.translation.vector - Vector3::new(1.0, -1.0, 1.0)).norm() < 1e-15);
        // carried: x, which pointed outward at the start, still does
        assert!((end.rotation * Vector3::x() + Vector3::y()).norm() < 1e-15);
        assert_eq!(about(1.0).length_m(), arc.length_m());
        let start_position = arc.at(0.0).world_from_tcp.translation.vector;
        assert_eq!(start_position, start.translation.vector);
    }

    #[test]
    fn a_full_circle_comes_back() {
        let start = at(0.3, 0.0, 0.2);
        let circle = Arc::about_axis(
            &start,
            Vector3::zeros(),
            Vector3::z_axis(),
            TAU,
            ArcOrientation::Kept,
        )
        .unwrap();
        let end = circle.at(1.0).world_from_tcp;
        assert!((end.translation.vector - start.translation.vector).norm() < 1e-15);
        assert_eq!(end.rotation, start.rotation);
        let half = circle.at(0.5).world_from_tcp.translation.vector;
        assert!((half - Vector3::new(-0.3, 0.0, 0.2)).norm() < 1e-15);
    }

    #[test]
    fn a_flat_arc_is_as_exact_as_a_round_one() {
        // a sagitta of 2 µm over 1 m has its centre 62.5 km away; a quarter of the way along a parabola is 3/4 of the height
        let via = Vector3::new(0.5, 2e-6, 0.0);
        let arc = Arc::through(&at(0.0, 0.0, 0.0), via, &at(1.0, 0.0, 0.0)).unwrap();
        let quarter = arc.at(0.25).world_from_tcp.translation.vector;
        // rounding of the end's angle (1e-16 of a turn of 1.6e-5, times the radius) and of the normal's length
        assert!(
            (quarter - Vector3::new(0.25, 1.5e-6, 0.0)).norm() < 1e-10,
            "{quarter}"
        );
        let near_end = arc.position_at_angle(arc.angle_rad());
        assert!((near_end - Vector3::x()).norm() < 1e-10, "{near_end}");
    }

    #[test]
    fn points_that_fix_no_circle_are_reported_with_numbers() {
        let text = |via: [f64; 3], end: Pose| {
            Arc::through(&at(0.0, 0.0, 0.0), Vector3::from(via), &end)
                .unwrap_err()
                .to_string()
        };
        assert_eq!(
            text([0.25, 0.0, 0.0], at(0.5, 0.0, 0.0)),
            "the points of the arc are on one line: they leave it by 0 m over 0.5 m; plan a straight line instead"
        );
        assert_eq!(
            text([0.25, 0.0, 0.0], at(0.0, 0.0, 0.0)),
            "start and end of the arc are 0 m apart, too near to fix a circle: \
             for a full circle give its axis and an angle of 2π"
        );
        assert!(
            text([0.0; 3], at(0.0, 0.0, 0.0)).starts_with("start and via point of the arc are 0 m")
        );
        assert!(
            text([f64::NAN; 3], at(0.0, 0.0, 0.0)).starts_with("coordinate of the arc must be")
        );
        let on_axis = Arc::about_axis(
            &at(0.0, 0.0, 2.0),
            Vector3::zeros(),
            Vector3::z_axis(),
            1.0,
            ArcOrientation::Kept,
        );
        assert_eq!(
            on_axis.unwrap_err(),
            TrajectoryError::StartOnAxis { distance_m: 0.0 }
        );
    }
}
