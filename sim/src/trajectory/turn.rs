//! Turn: a rotation about one axis fixed in the world.

use nalgebra::{Matrix3, Vector3};

use super::trajectory_error::{TrajectoryError, finite};
use crate::spatial::{rotation_exp, rotation_log};

/// A rotation from one orientation to another about a fixed axis, proportional to the fraction of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    start: Matrix3<f64>,
    end: Matrix3<f64>,
    /// Axis times angle \[rad\], world axes.
    rotation_vector: Vector3<f64>,
}

impl Turn {
    /// The rotation by the smaller angle between two orientations `world_from_tcp`, at most half a turn.
    ///
    /// At exactly half a turn both directions are equally short, and the one of [`rotation_log`] is used.
    ///
    /// # Errors
    /// `NotFinite`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), sec. 9.2.1, here with the axis in the world.
    pub fn between(start: Matrix3<f64>, end: Matrix3<f64>) -> Result<Self, TrajectoryError> {
        for &element in start.iter().chain(end.iter()) {
            finite("element of a rotation", element)?;
        }
        // the product with the transpose is the identity only to rounding, and no rotation must take no time
        let rotation_vector = if start == end {
            Vector3::zeros()
        } else {
            rotation_log(&(end * start.transpose()))
        };
        Ok(Self {
            start,
            end,
            rotation_vector,
        })
    }

    /// The turn by `rotation_vector_rad`, axis times angle in world axes; more than half a turn and full turns included.
    ///
    /// # Errors
    /// `NotFinite`, also where the angle is too large to square (above 1e154 rad).
    pub fn by(
        start: Matrix3<f64>,
        rotation_vector_rad: Vector3<f64>,
    ) -> Result<Self, TrajectoryError> {
        for &element in start.iter() {
            finite("element of a rotation", element)?;
        }
        finite("angle of a turn", rotation_vector_rad.norm_squared())?;
        Ok(Self {
            start,
            end: rotation_exp(&rotation_vector_rad) * start,
            rotation_vector: rotation_vector_rad,
        })
    }

    /// The whole angle \[rad\], zero or more.
    pub fn angle_rad(&self) -> f64 {
        self.rotation_vector.norm()
    }

    /// Axis times angle \[rad\] in world axes: the derivative of the orientation by the fraction of the path.
    pub fn rotation_vector_rad(&self) -> Vector3<f64> {
        self.rotation_vector
    }

    /// The orientation `world_from_tcp` at a fraction of the path; exact at 0 and 1.
    pub fn at(&self, fraction: f64) -> Matrix3<f64> {
        if fraction - 1.0 == 0.0 {
            return self.end;
        }
        rotation_exp(&(self.rotation_vector * fraction)) * self.start
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::spatial::rotation_from_rpy_deg;

    #[test]
    fn half_of_a_quarter_turn_is_an_eighth() {
        let start = rotation_from_rpy_deg([10.0, 20.0, 30.0]);
        let end = rotation_from_rpy_deg([0.0, 0.0, 90.0]) * start;
        let turn = Turn::between(start, end).unwrap();
        assert!((turn.rotation_vector_rad() - Vector3::z() * FRAC_PI_2).norm() < 1e-15);
        let expected = rotation_from_rpy_deg([0.0, 0.0, 45.0]) * start;
        assert!((turn.at(0.5) - expected).norm() < 1e-15);
        assert_eq!(turn.at(0.0), start);
        assert_eq!(turn.at(1.0), end);
    }

    #[test]
    fn a_full_turn_goes_all_the_way_round() {
        let start = rotation_from_rpy_deg([10.0, 20.0, 30.0]);
        let turn = Turn::by(start, Vector3::x() * (2.0 * PI)).unwrap();
        let half = rotation_from_rpy_deg([180.0, 0.0, 0.0]) * start;
        assert!((turn.at(0.5) - half).norm() < 1e-15);
        assert!((turn.at(1.0) - start).norm() < 1e-15);
        assert!(Turn::by(start, Vector3::x() * 1e200).is_err());
    }
}
