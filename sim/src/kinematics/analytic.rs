//! The analytic Jacobian: maps joint velocities to the rates of three orientation angles instead of an angular velocity.

use nalgebra::{Matrix3, Matrix6xX, Vector3};
use serde::Deserialize;

use super::forward::forward_kinematics;
use super::jacobian::fill;
use crate::joint_space::JointPositions;
use crate::model::robot::{Frame, Robot};

/// The cosine (or sine) below which the rates of three angles are not unique: 1e-9 rad from the singular angle.
const SINGULAR: f64 = 1e-9;

/// A representation of a rotation by three angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Angles {
    /// Roll, pitch, yaw of URDF: `R = Rz(yaw) Ry(pitch) Rx(roll)`, in the order (roll, pitch, yaw). Singular at pitch ±90°.
    #[serde(rename = "rpy")]
    RollPitchYaw,
    /// Euler angles `R = Rz(phi) Ry(theta) Rz(psi)`, in the order (phi, theta, psi). Singular at theta 0 and 180°.
    Zyz,
}

/// Representation singularity: at this rotation two of the angles are about the same axis.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the {angles} rates are not defined at {name} {angle_rad:.6} rad: the first and the third angle turn about one axis there"
)]
pub struct SingularAngles {
    angles: &'static str,
    name: &'static str,
    /// The second angle \[rad\].
    pub angle_rad: f64,
}

impl Angles {
    /// The angles of `rotation` \[rad\]: the first and third in (-pi, pi], pitch in \[-pi/2, pi/2\], theta in \[0, pi\].
    ///
    /// At the singular angle the first and third are not unique; there the third (of roll, pitch, yaw: the first) is zero.
    pub fn of(self, rotation: &Matrix3<f64>) -> [f64; 3] {
        let r = rotation;
        match self {
            Self::RollPitchYaw => {
                let cosine = libm::hypot(r.m11, r.m21);
                let pitch = libm::atan2(-r.m31, cosine);
                if cosine <= SINGULAR {
                    return [0.0, pitch, libm::atan2(-r.m12, r.m22)];
                }
                [libm::atan2(r.m32, r.m33), pitch, libm::atan2(r.m21, r.m11)]
            }
            Self::Zyz => {
                let sine = libm::hypot(r.m13, r.m23);
                let theta = libm::atan2(sine, r.m33);
                if sine <= SINGULAR {
                    return [libm::atan2(-r.m12, r.m22), theta, 0.0];
                }
                [libm::atan2(r.m23, r.m13), theta, libm::atan2(r.m32, -r.m31)]
            }
        }
    }

    /// The matrix that maps an angular velocity in world axes to the rates of the angles of `rotation`.
    ///
    /// # Errors
    /// [`SingularAngles`] at a representation singularity.
    pub fn rates_from_angular_velocity(
        self,
        rotation: &Matrix3<f64>,
    ) -> Result<Matrix3<f64>, SingularAngles> {
        let angles = self.of(rotation);
        let middle = angles[1];
        match self {
            Self::RollPitchYaw => {
                let (sp, cp) = libm::sincos(middle);
                if cp.is_nan() || cp <= SINGULAR {
                    return Err(SingularAngles {
                        angles: "roll, pitch, yaw",
                        name: "pitch",
                        angle_rad: middle,
                    });
                }
                let (sy, cy) = libm::sincos(angles[2]);
                Ok(Matrix3::new(
                    cy / cp,
                    sy / cp,
                    0.0,
                    -sy,
                    cy,
                    0.0,
                    cy * sp / cp,
                    sy * sp / cp,
                    1.0,
                ))
            }
            Self::Zyz => {
                let (st, ct) = libm::sincos(middle);
                if st.is_nan() || st <= SINGULAR {
                    return Err(SingularAngles {
                        angles: "ZYZ",
                        name: "theta",
                        angle_rad: middle,
                    });
                }
                let (sf, cf) = libm::sincos(angles[0]);
                Ok(Matrix3::new(
                    -cf * ct / st,
                    -sf * ct / st,
                    1.0,
                    -sf,
                    cf,
                    0.0,
                    cf / st,
                    sf / st,
                    0.0,
                ))
            }
        }
    }
}

/// Returns the analytic Jacobian of `frame`, shape `(6, n)`: the rates of its position in the world \[m/s\] and of the `angles` of its
/// rotation \[rad/s\] per unit of joint velocity.
///
/// # Errors
/// [`SingularAngles`] at a representation singularity.
///
/// Source: Siciliano et al., *Robotics* (2009), sec. 3.6; the inverse of the rate-to-angular-velocity matrix in closed form.
pub fn analytic_jacobian(
    robot: &Robot,
    q: &JointPositions,
    frame: &Frame,
    angles: Angles,
) -> Result<Matrix6xX<f64>, SingularAngles> {
    let poses = forward_kinematics(robot, q);
    let rotation = poses.world_from(frame).rotation;
    let rates = angles.rates_from_angular_velocity(rotation.matrix())?;
    let mut jacobian = Matrix6xX::zeros(robot.n());
    fill(robot, &poses, frame, &mut jacobian);
    for mut column in jacobian.column_iter_mut() {
        let turned: Vector3<f64> = rates * column.fixed_rows::<3>(3);
        column.fixed_rows_mut::<3>(3).copy_from(&turned);
    }
    Ok(jacobian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::rotation_from_rpy_deg;

    #[test]
    fn angles_come_back_and_their_rates_are_the_difference_quotient() {
        let about = |axis: usize, angle: f64| {
            let mut rpy_deg = [0.0; 3];
            rpy_deg[axis] = angle.to_degrees();
            rotation_from_rpy_deg(rpy_deg)
        };
        let compose = |kind: Angles, a: [f64; 3]| match kind {
            Angles::RollPitchYaw => about(2, a[2]) * about(1, a[1]) * about(0, a[0]),
            Angles::Zyz => about(2, a[0]) * about(1, a[1]) * about(2, a[2]),
        };
        // central differences: truncation O(h²) and round-off O(ε/h) meet near 1e-10
        const H: f64 = 1e-5;
        for kind in [Angles::RollPitchYaw, Angles::Zyz] {
            for a in [[0.3, 0.9, -2.0], [-3.0, 1.2, 3.0], [0.0, 0.5, 0.0]] {
                let r = compose(kind, a);
                let back = kind.of(&r);
                for k in 0..3 {
                    assert!(
                        (back[k] - a[k]).abs() < 1e-15 * 4.0,
                        "{kind:?} {a:?} {back:?}"
                    );
                }
                let rates = kind.rates_from_angular_velocity(&r).unwrap();
                for k in 0..3 {
                    let mut step = [a, a];
                    step[0][k] -= H;
                    step[1][k] += H;
                    let [r0, r1] = step.map(|a| compose(kind, a));
                    let spin = (r1 - r0) / (2.0 * H) * r.transpose();
                    let w = Vector3::new(spin.m32, spin.m13, spin.m21);
                    let mut unit = Vector3::zeros();
                    unit[k] = 1.0;
                    assert!((rates * w - unit).norm() < 1e-9, "{kind:?} {a:?}");
                }
            }
        }
    }

    #[test]
    fn at_the_singular_angle_there_is_an_error_and_the_angles_still_make_the_rotation() {
        let up = rotation_from_rpy_deg([20.0, 90.0, 50.0]);
        let error = Angles::RollPitchYaw
            .rates_from_angular_velocity(&up)
            .unwrap_err();
        assert_eq!(error.angle_rad, std::f64::consts::FRAC_PI_2);
        let [roll, pitch, yaw] = Angles::RollPitchYaw.of(&up).map(f64::to_degrees);
        // only yaw - roll matters there: 30 degrees
        assert_eq!((roll, pitch), (0.0, 90.0));
        assert!((yaw - 30.0).abs() < 1e-13);
        let still = Matrix3::identity();
        assert!(Angles::Zyz.rates_from_angular_velocity(&still).is_err());
        assert_eq!(Angles::Zyz.of(&still), [0.0; 3]);
        // upside down: Rz(phi) Ry(pi)
        let over =
            rotation_from_rpy_deg([0.0, 0.0, 40.0]) * rotation_from_rpy_deg([0.0, 180.0, 0.0]);
        let [phi, theta, psi] = Angles::Zyz.of(&over).map(f64::to_degrees);
        assert!(
            (phi - 40.0).abs() < 1e-13 && theta == 180.0 && psi == 0.0,
            "{phi} {theta} {psi}"
        );
    }
}
