//! Targets of a frame: a position, an orientation, both, or a position and one direction; and the error of a pose.

use nalgebra::{Matrix3, Unit, Vector3};

use crate::spatial::{Pose, rotation_log};

/// Where a frame should be, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// Position of the frame's origin \[m\]; its orientation is free.
    Position(Vector3<f64>),
    /// Origin and orientation: `world_from_frame`.
    Pose(Pose),
    /// The frame's orientation, `world_from_frame`; its origin is free.
    Rotation(Matrix3<f64>),
    /// Position of the frame's origin and direction of one of its axes; rotation about that axis is free.
    Axis {
        /// Position of the frame's origin \[m\].
        position_m: Vector3<f64>,
        /// The axis, fixed in the frame.
        axis_in_frame: Unit<Vector3<f64>>,
        /// Its target direction in the world.
        direction_in_world: Unit<Vector3<f64>>,
    },
}

/// The error of a frame relative to its target, world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PoseError {
    /// Translation to the target \[m\]; zero if the position is free.
    pub(super) linear: Vector3<f64>,
    /// Rotation to the target, axis times angle \[rad\]; zero if the orientation is free.
    pub(super) angular: Vector3<f64>,
}

impl Target {
    pub(super) fn is_finite(&self) -> bool {
        let all = |v: &[f64]| v.iter().all(|x| x.is_finite());
        match self {
            Self::Position(p) => all(p.as_slice()),
            Self::Pose(pose) => {
                all(pose.translation.vector.as_slice()) && all(pose.rotation.matrix().as_slice())
            }
            Self::Rotation(r) => all(r.as_slice()),
            Self::Axis {
                position_m,
                axis_in_frame,
                direction_in_world,
            } => {
                all(position_m.as_slice())
                    && all(axis_in_frame.as_slice())
                    && all(direction_in_world.as_slice())
            }
        }
    }

    /// Whether it constrains the position, and whether it constrains the orientation.
    pub(super) fn asks(&self) -> (bool, bool) {
        match self {
            Self::Position(_) => (true, false),
            Self::Rotation(_) => (false, true),
            Self::Pose(_) | Self::Axis { .. } => (true, true),
        }
    }

    /// The error of `world_from_frame`: `[p_t - p; log(R_t Rᵀ)]`, or the smallest rotation that aligns the axis.
    #[inline]
    pub(super) fn error(&self, world_from_frame: &Pose) -> PoseError {
        let p = &world_from_frame.translation.vector;
        let r = world_from_frame.rotation.matrix();
        let turn_to = |wanted: &Matrix3<f64>| rotation_log(&(wanted * r.transpose()));
        match self {
            Self::Position(wanted) => PoseError {
                linear: wanted - p,
                angular: Vector3::zeros(),
            },
            Self::Pose(wanted) => PoseError {
                linear: wanted.translation.vector - p,
                angular: turn_to(wanted.rotation.matrix()),
            },
            Self::Rotation(wanted) => PoseError {
                linear: Vector3::zeros(),
                angular: turn_to(wanted),
            },
            Self::Axis {
                position_m,
                axis_in_frame,
                direction_in_world,
            } => PoseError {
                linear: position_m - p,
                angular: smallest_turn(&(r * axis_in_frame.as_ref()), direction_in_world),
            },
        }
    }

    /// The direction about which rotation is free, world axes; for an axis target only.
    pub(super) fn free_axis(&self, world_from_frame: &Pose) -> Option<Vector3<f64>> {
        match self {
            Self::Axis { axis_in_frame, .. } => {
                Some(world_from_frame.rotation.matrix() * axis_in_frame.as_ref())
            }
            _ => None,
        }
    }
}

/// Axis times angle \[rad\] of the smallest rotation from the unit vector `from` to the unit vector `to`; between opposite vectors half
/// a turn about any perpendicular axis.
fn smallest_turn(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    let across = from.cross(to);
    let (sine, cosine) = (across.norm(), from.dot(to));
    let angle = libm::atan2(sine, cosine);
    if sine > 0.0 {
        return across * (angle / sine);
    }
    if cosine > 0.0 {
        return Vector3::zeros();
    }
    let least = from.iamin();
    let mut other = Vector3::zeros();
    other[least] = 1.0;
    from.cross(&other).normalize() * angle
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_smallest_turn_at_its_special_angles() {
        let (x, y) = (Vector3::x(), Vector3::y());
        assert_eq!(smallest_turn(&x, &y), Vector3::z() * FRAC_PI_2);
        assert_eq!(smallest_turn(&x, &x), Vector3::zeros());
        let back = smallest_turn(&x, &-x);
        assert_eq!((back.norm(), back.dot(&x)), (PI, 0.0));
    }
}
