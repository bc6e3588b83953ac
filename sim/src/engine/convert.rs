//! Conversions between our vectors and poses and those of the collision library.

use nalgebra::{Matrix3, Vector3};
use parry3d_f64::math::{Matrix, Pose as EnginePose, Rotation, Vector};

use crate::spatial::Pose;

pub(super) fn vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(super) fn from_vector(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

fn matrix(m: &Matrix3<f64>) -> Matrix {
    Matrix::from_cols(
        Vector::new(m.m11, m.m21, m.m31),
        Vector::new(m.m12, m.m22, m.m32),
        Vector::new(m.m13, m.m23, m.m33),
    )
}

pub(super) fn rotation(m: &Matrix3<f64>) -> Rotation {
    Rotation::from_mat3(&matrix(m)).normalize()
}

pub(super) fn engine_pose(ours: &Pose) -> EnginePose {
    EnginePose::from_parts(
        vector(&ours.translation.vector),
        rotation(ours.rotation.matrix()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::{pose, rotation_from_rpy_deg};

    #[test]
    fn a_pose_keeps_its_place_and_turns_vectors_alike() {
        for rpy in [
            [0.0, 0.0, 0.0],
            [20.0, -35.0, 170.0],
            [180.0, 0.0, 0.0],
            [0.0, 90.0, -90.0],
        ] {
            let ours = pose(rotation_from_rpy_deg(rpy), Vector3::new(1.0, -2.0, 3.0));
            let theirs = engine_pose(&ours);
            let p = Vector3::new(0.3, -0.2, 0.9);
            let moved = from_vector(theirs * vector(&p));
            // a quaternion and its products round a few times
            let expected = ours.rotation * p + ours.translation.vector;
            assert!((moved - expected).norm() < 1e-15, "{rpy:?}");
        }
    }
}
