//! Poses, twists and symmetric tensors, and the few products of them the recursive algorithms need.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3, Vector6};

/// Pose of a frame `b` in a frame `a`, named `a_from_b`: maps coordinates in `b` to coordinates in `a`.
pub type Pose = IsometryMatrix3<f64>;

/// Velocity of a rigid frame, expressed in the axes its variable names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Velocity of the frame's origin \[m/s\].
    pub linear: Vector3<f64>,
    /// Angular velocity \[rad/s\].
    pub angular: Vector3<f64>,
}

impl Twist {
    /// No velocity at all.
    pub fn zero() -> Self {
        Self {
            linear: Vector3::zeros(),
            angular: Vector3::zeros(),
        }
    }

    /// Stacks as `[linear; angular]`, the row order of every Jacobian here.
    pub fn to_vector(self) -> Vector6<f64> {
        Vector6::new(
            self.linear.x,
            self.linear.y,
            self.linear.z,
            self.angular.x,
            self.angular.y,
            self.angular.z,
        )
    }
}

/// A pose from a rotation matrix, taken as it is, and the position of the child's origin \[m\].
pub fn pose(rotation: Matrix3<f64>, position_m: Vector3<f64>) -> Pose {
    Pose::from_parts(
        Translation3::from(position_m),
        Rotation3::from_matrix_unchecked(rotation),
    )
}

/// Rotation about the axis `x`, then the parent's `y`, then the parent's `z`: `Rz(yaw) Ry(pitch) Rx(roll)`, angles in rad.
///
/// Quarter turns are exact: `rpy_deg` may hold integer multiples of 90.
pub fn rotation_from_rpy_deg(rpy_deg: [f64; 3]) -> Matrix3<f64> {
    rotation_from_sines(rpy_deg.map(sin_cos_deg))
}

/// The same rotation as [`rotation_from_rpy_deg`], from angles in rad: `Rz(yaw) Ry(pitch) Rx(roll)`, as a URDF has them.
pub fn rotation_from_rpy(rpy_rad: [f64; 3]) -> Matrix3<f64> {
    rotation_from_sines(rpy_rad.map(libm::sincos))
}

/// `Rz Ry Rx` from sine and cosine of roll, pitch and yaw.
fn rotation_from_sines([(sr, cr), (sp, cp), (sy, cy)]: [(f64, f64); 3]) -> Matrix3<f64> {
    let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    let ry = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
    let rz = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    rz * ry * rx
}

/// Roll, pitch and yaw of a rotation \[degrees\]: those that [`rotation_from_rpy_deg`] makes it of. Where the pitch is a quarter turn roll and
/// yaw are not unique, and rounding decides between them: such angles may give another rotation.
pub fn rpy_deg_from_rotation(r: &Matrix3<f64>) -> [f64; 3] {
    [
        libm::atan2(r.m32, r.m33).to_degrees(),
        libm::atan2(-r.m31, libm::hypot(r.m11, r.m21)).to_degrees(),
        libm::atan2(r.m21, r.m11).to_degrees(),
    ]
}

/// The unit vector along `v`, or `None` where `v` is zero. Coordinate axes stay exact.
pub fn direction(v: Vector3<f64>) -> Option<Vector3<f64>> {
    // scaled first, so that neither tiny nor huge vectors are lost in their squares
    let largest = v.amax();
    (largest > 0.0).then(|| {
        let scaled = v / largest;
        scaled / scaled.norm()
    })
}

/// Rotation by `angle_deg` about the unit vector `axis` (Rodrigues).
pub fn rotation_about_axis_deg(axis: Vector3<f64>, angle_deg: f64) -> Matrix3<f64> {
    let (sine, cosine) = sin_cos_deg(angle_deg);
    let cross = axis.cross_matrix();
    Matrix3::identity() + cross * sine + cross * cross * (1.0 - cosine)
}

/// Rotation about the axis of `rotation_vector_rad` by its length \[rad\]: the exponential of SO(3), for any angle.
///
/// The identity at zero. NaN where the vector or its square is not finite.
///
/// Source: Rodrigues' formula as `cos θ 1 + sin θ/θ [φ] + (1 - cos θ)/θ² φ φᵀ`, with `1 - cos θ = 2 sin²(θ/2)`.
pub fn rotation_exp(rotation_vector_rad: &Vector3<f64>) -> Matrix3<f64> {
    let v = rotation_vector_rad;
    let angle = v.norm_squared().sqrt();
    // both quotients are well behaved down to the smallest angle; only zero itself needs its limit
    let (sine_by_angle, half_sine_by_angle) = if angle == 0.0 {
        (1.0, 0.5)
    } else {
        (libm::sin(angle) / angle, libm::sin(0.5 * angle) / angle)
    };
    let outer = 2.0 * half_sine_by_angle * half_sine_by_angle;
    let s = v * sine_by_angle;
    let c = 1.0 - outer * (angle * angle);
    Matrix3::new(
        c + outer * v.x * v.x,
        outer * v.x * v.y - s.z,
        outer * v.x * v.z + s.y,
        outer * v.x * v.y + s.z,
        c + outer * v.y * v.y,
        outer * v.y * v.z - s.x,
        outer * v.x * v.z - s.y,
        outer * v.y * v.z + s.x,
        c + outer * v.z * v.z,
    )
}

/// Axis times angle \[rad\] of a rotation, the angle from 0 to pi: the logarithm of SO(3).
///
/// Zero at the identity. At exactly half a turn both axes are valid, and the one whose largest component is positive is
/// returned; a rounding error away from half a turn the matrix itself decides the sign of the axis.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), sec. 3.2.3.3, with the angle from sine and cosine together, and the
/// axis from the symmetric part `cos θ 1 + (1 - cos θ) n nᵀ` beyond 120 degrees, where the antisymmetric part fades.
pub fn rotation_log(rotation: &Matrix3<f64>) -> Vector3<f64> {
    let r = rotation;
    // sin θ n and cos θ
    let v = Vector3::new(r.m32 - r.m23, r.m13 - r.m31, r.m21 - r.m12) * 0.5;
    let cosine = 0.5 * (r.m11 + r.m22 + r.m33 - 1.0);
    let sine = v.norm();
    let angle = libm::atan2(sine, cosine);
    if cosine > -0.5 {
        return if sine > 0.0 { v * (angle / sine) } else { v };
    }
    // the longest column of n nᵀ (1 - cos θ) has the direction of n
    let xy = 0.5 * (r.m12 + r.m21);
    let xz = 0.5 * (r.m13 + r.m31);
    let yz = 0.5 * (r.m23 + r.m32);
    let (xx, yy, zz) = (r.m11 - cosine, r.m22 - cosine, r.m33 - cosine);
    let column = if xx >= yy && xx >= zz {
        Vector3::new(xx, xy, xz)
    } else if yy >= zz {
        Vector3::new(xy, yy, yz)
    } else {
        Vector3::new(xz, yz, zz)
    };
    let signed_angle = if column.dot(&v) < 0.0 { -angle } else { angle };
    column * (signed_angle / column.norm())
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90, although `sin(pi)` is not zero in floating point.
fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    let quarters = angle_deg / 90.0;
    if quarters.fract() == 0.0 && quarters.abs() < 1e15 {
        return match (quarters as i64).rem_euclid(4) {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    libm::sincos(angle_deg.to_radians())
}

/// A symmetric 3 by 3 tensor in `[xx, yy, zz, xy, xz, yz]` order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Symmetric3 {
    /// Diagonal element.
    pub xx: f64,
    /// Diagonal element.
    pub yy: f64,
    /// Diagonal element.
    pub zz: f64,
    /// Off-diagonal element.
    pub xy: f64,
    /// Off-diagonal element.
    pub xz: f64,
    /// Off-diagonal element.
    pub yz: f64,
}

impl Symmetric3 {
    /// The multiple `s` of the identity.
    #[inline]
    pub fn scaled_identity(s: f64) -> Self {
        Self {
            xx: s,
            yy: s,
            zz: s,
            xy: 0.0,
            xz: 0.0,
            yz: 0.0,
        }
    }

    /// The full matrix.
    pub fn to_matrix(self) -> Matrix3<f64> {
        Matrix3::new(
            self.xx, self.xy, self.xz, self.xy, self.yy, self.yz, self.xz, self.yz, self.zz,
        )
    }

    /// The product with a vector.
    #[inline]
    pub fn times(&self, v: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }

    /// `R S Rᵀ`: the tensor in the axes that `rotation` leads to.
    #[inline]
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        let r = rotation;
        // rows of R S
        let a = self.times(&Vector3::new(r.m11, r.m12, r.m13));
        let b = self.times(&Vector3::new(r.m21, r.m22, r.m23));
        let c = self.times(&Vector3::new(r.m31, r.m32, r.m33));
        Self {
            xx: a.x * r.m11 + a.y * r.m12 + a.z * r.m13,
            xy: a.x * r.m21 + a.y * r.m22 + a.z * r.m23,
            xz: a.x * r.m31 + a.y * r.m32 + a.z * r.m33,
            yy: b.x * r.m21 + b.y * r.m22 + b.z * r.m23,
            yz: b.x * r.m31 + b.y * r.m32 + b.z * r.m33,
            zz: c.x * r.m31 + c.y * r.m32 + c.z * r.m33,
        }
    }

    /// Subtracts `u uᵀ s`.
    #[inline]
    pub fn subtract_outer(&mut self, u: &Vector3<f64>, s: f64) {
        let us = u * s;
        self.xx -= u.x * us.x;
        self.yy -= u.y * us.y;
        self.zz -= u.z * us.z;
        self.xy -= u.x * us.y;
        self.xz -= u.x * us.z;
        self.yz -= u.y * us.z;
    }

    /// Adds another tensor.
    #[inline]
    pub fn add(&mut self, other: &Self) {
        self.xx += other.xx;
        self.yy += other.yy;
        self.zz += other.zz;
        self.xy += other.xy;
        self.xz += other.xz;
        self.yz += other.yz;
    }

    /// The inertia `m (|c|² 1 - c cᵀ)` of a point mass at `c`: what moving the reference point away from a centre of mass
    /// adds.
    pub fn of_point_mass(mass_kg: f64, c: &Vector3<f64>) -> Self {
        Self {
            xx: mass_kg * (c.y * c.y + c.z * c.z),
            yy: mass_kg * (c.x * c.x + c.z * c.z),
            zz: mass_kg * (c.x * c.x + c.y * c.y),
            xy: -mass_kg * c.x * c.y,
            xz: -mass_kg * c.x * c.z,
            yz: -mass_kg * c.y * c.z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let r = rotation_from_rpy_deg([0.0, 90.0, 0.0]);
        assert_eq!(r * Vector3::z(), Vector3::x());
        let r = rotation_about_axis_deg(Vector3::y(), 180.0);
        assert_eq!(r * Vector3::x(), -Vector3::x());
    }

    #[test]
    fn rpy_turns_about_the_parents_axes_in_order() {
        let r = rotation_from_rpy_deg([90.0, 0.0, 90.0]);
        // roll takes y to z, yaw leaves z alone
        assert_eq!(r * Vector3::y(), Vector3::z());
        assert_eq!(r * Vector3::x(), Vector3::y());
    }

    #[test]
    fn radians_and_degrees_make_the_same_rotation() {
        let deg = [20.0, -35.0, 170.0];
        let error = rotation_from_rpy(deg.map(f64::to_radians)) - rotation_from_rpy_deg(deg);
        assert_eq!(error.amax(), 0.0);
    }

    #[test]
    fn angles_come_back_from_their_rotation() {
        for angles in [[20.0, -35.0, 170.0], [-179.0, 89.0, 0.5], [0.0, 0.0, -90.0]] {
            let found = rpy_deg_from_rotation(&rotation_from_rpy_deg(angles));
            let off = found
                .iter()
                .zip(angles)
                .map(|(found, angle)| (found - angle).abs());
            assert!(off.fold(0.0, f64::max) < 1e-10, "{angles:?}: {found:?}");
        }
    }

    #[test]
    fn a_direction_survives_the_ends_of_the_number_range() {
        for size in [5e-324, 1e-200, 1.0, 1e300] {
            assert_eq!(
                direction(Vector3::new(0.0, -size, 0.0)),
                Some(-Vector3::y())
            );
        }
        assert_eq!(direction(Vector3::zeros()), None);
    }

    #[test]
    fn rotating_a_tensor_agrees_with_the_matrix_product() {
        let s = Symmetric3 {
            xx: 1.0,
            yy: 2.0,
            zz: 4.0,
            xy: 0.3,
            xz: -0.2,
            yz: 0.5,
        };
        let r = rotation_from_rpy_deg([20.0, -35.0, 70.0]);
        let full = r * s.to_matrix() * r.transpose();
        assert!((s.rotated(&r).to_matrix() - full).norm() < 1e-14);
    }

    #[test]
    fn exp_and_log_of_quarter_and_half_turns() {
        use std::f64::consts::{FRAC_PI_2, PI};
        let quarter = rotation_from_rpy_deg([0.0, 0.0, 90.0]);
        assert_eq!(rotation_log(&quarter), Vector3::z() * FRAC_PI_2);
        assert!((rotation_exp(&(Vector3::z() * FRAC_PI_2)) - quarter).norm() < 1e-15);
        assert_eq!(rotation_log(&Matrix3::identity()), Vector3::zeros());
        assert_eq!(rotation_exp(&Vector3::zeros()), Matrix3::identity());
        // at exactly half a turn the largest component of the axis is positive, whichever way it was turned
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let half = rotation_about_axis_deg(-axis, 180.0);
            assert_eq!(rotation_log(&half), axis * PI);
        }
        let axis = Vector3::new(2.0, -3.0, 6.0) / 7.0;
        let half = 2.0 * axis * axis.transpose() - Matrix3::identity();
        assert!((rotation_log(&half) - axis * PI).norm() < 1e-15);
    }

    #[test]
    fn small_rotations_keep_their_relative_precision() {
        for size in [1e-3, 1e-7, 1e-9, 1e-12, 1e-100, 1e-160, 5e-324] {
            let v = Vector3::new(0.6 * size, 0.0, -0.8 * size);
            let back = rotation_log(&rotation_exp(&v));
            // 1e-15 of the vector, or what is left of numbers this small
            assert!((back - v).amax() <= 1e-15 * size + 5e-324, "{size}: {back}");
        }
    }

    #[test]
    fn near_half_a_turn_the_log_is_still_the_inverse_of_exp() {
        use std::f64::consts::PI;
        let axes = [
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(-2.0, 3.0, 6.0) / 7.0,
            Vector3::new(1.0, 1.0, -1.0) / 3.0_f64.sqrt(),
            Vector3::new(1e-9, -1.0, 0.0).normalize(),
        ];
        for axis in axes {
            for short_of_pi in [1.0, 0.1, 1e-3, 1e-6, 1e-8, 1e-10, 1e-13] {
                let v = axis * (PI - short_of_pi);
                let back = rotation_log(&rotation_exp(&v));
                // a few roundings of numbers near pi
                assert!((back - v).norm() < 5e-15, "{axis} {short_of_pi}: {back}");
            }
            // closer than rounding, the axis may flip: then the rotations agree
            for angle in [PI, PI - 1e-16, PI + 4e-16] {
                let r = rotation_exp(&(axis * angle));
                assert!((rotation_exp(&rotation_log(&r)) - r).norm() < 5e-15);
            }
        }
    }

    proptest::proptest! {
        #[test]
        fn log_inverts_exp_and_exp_is_a_rotation(
            x in -1.8..1.8_f64, y in -1.8..1.8_f64, z in -1.8..1.8_f64,
        ) {
            // at most sqrt(3) 1.8 = 3.118 rad, less than half a turn
            let v = Vector3::new(x, y, z);
            let r = rotation_exp(&v);
            // a few roundings of numbers up to 3
            proptest::prop_assert!((rotation_log(&r) - v).norm() < 1e-14);
            proptest::prop_assert!((r * r.transpose() - Matrix3::identity()).norm() < 1e-14);
            proptest::prop_assert!((r.determinant() - 1.0).abs() < 1e-14);
            // the axis stays
            proptest::prop_assert!((r * v - v).norm() < 1e-14);
        }
    }
}
