//! Line: a straight path from pose to pose.

use nalgebra::Vector3;

use super::path::{Path, PathPoint};
use super::trajectory_error::{TrajectoryError, finite, in_range};
use super::turn::Turn;
use crate::spatial::{Pose, pose};

/// Position on a straight line, orientation about one fixed axis, both proportional to the fraction of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    start_m: Vector3<f64>,
    end_m: Vector3<f64>,
    turn: Turn,
}

impl Line {
    /// The line between two poses, with a rotation by the smaller angle (at most half a turn).
    ///
    /// Equal positions give a rotation on the spot; equal poses a path without extent.
    ///
    /// # Errors
    /// `NotFinite` and `OutOfRange`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 9.2.1 (the path decoupled into position and orientation).
    pub fn between(
        world_from_start: &Pose,
        world_from_end: &Pose,
    ) -> Result<Self, TrajectoryError> {
        let (start, end) = (world_from_start, world_from_end);
        let (start_m, end_m) = (start.translation.vector, end.translation.vector);
        for &coordinate in start_m.iter().chain(end_m.iter()) {
            finite("coordinate of a pose", coordinate)?;
        }
        in_range("squared length", (end_m - start_m).norm_squared())?;
        Ok(Self {
            start_m,
            end_m,
            turn: Turn::between(*start.rotation.matrix(), *end.rotation.matrix())?,
        })
    }
}

impl Path for Line {
    fn length_m(&self) -> f64 {
        (self.end_m - self.start_m).norm()
    }

    fn turn(&self) -> &Turn {
        &self.turn
    }

    fn at(&self, fraction: f64) -> PathPoint {
        let way = self.end_m - self.start_m;
        let position_m = if fraction - 1.0 == 0.0 {
            self.end_m
        } else {
            self.start_m + way * fraction
        };
        PathPoint {
            world_from_tcp: pose(self.turn.at(fraction), position_m),
            first: way,
            second: Vector3::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::rotation_from_rpy_deg;
    use nalgebra::Matrix3;

    #[test]
    fn it_is_straight_and_ends_exactly() {
        let end_rotation = rotation_from_rpy_deg([0.0, 0.0, 90.0]);
        let start = pose(Matrix3::identity(), Vector3::new(0.1, 0.2, 0.3));
        let end = pose(end_rotation, Vector3::new(0.7, 0.2, -0.5));
        let line = Line::between(&start, &end).unwrap();
        // 0.6 and 0.8: length 1
        assert!((line.length_m() - 1.0).abs() < 1e-15);
        assert_eq!(line.at(0.0).world_from_tcp, start);
        assert_eq!(line.at(1.0).world_from_tcp, end);
        let middle = line.at(0.5).world_from_tcp;
        let expected = Vector3::new(0.4, 0.2, -0.1);
        assert!((middle.translation.vector - expected).norm() < 1e-15);
        let eighth = rotation_from_rpy_deg([0.0, 0.0, 45.0]);
        assert!((middle.rotation.matrix() - eighth).norm() < 1e-15);
    }

    #[test]
    fn wrong_numbers_are_reported() {
        let start = pose(Matrix3::identity(), Vector3::new(f64::NAN, 0.0, 0.0));
        assert_eq!(
            Line::between(&start, &Pose::identity())
                .unwrap_err()
                .to_string(),
            "coordinate of a pose must be a finite number, got NaN"
        );
    }
}
