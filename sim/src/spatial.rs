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
/// Whole quarter turns are exact when `rpy_deg` holds whole multiples of 90.
pub fn rotation_from_rpy_deg(rpy_deg: [f64; 3]) -> Matrix3<f64> {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy_deg.map(sin_cos_deg);
    let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    let ry = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
    let rz = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    rz * ry * rx
}

/// Rotation by `angle_deg` about the unit vector `axis` (Rodrigues).
pub fn rotation_about_axis_deg(axis: Vector3<f64>, angle_deg: f64) -> Matrix3<f64> {
    let (sine, cosine) = sin_cos_deg(angle_deg);
    let cross = axis.cross_matrix();
    Matrix3::identity() + cross * sine + cross * cross * (1.0 - cosine)
}

/// Sine and cosine of an angle in degrees, exact at whole quarter turns, where `sin(pi)` is not zero in floating point.
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

    /// The upper triangle of a matrix that is symmetric but for rounding.
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        Self {
            xx: m.m11,
            yy: m.m22,
            zz: m.m33,
            xy: m.m12,
            xz: m.m13,
            yz: m.m23,
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

    /// The inertia `m (|c|² 1 - c cᵀ)` of a point mass at `c`: what moving the reference point away from a centre of mass adds.
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
}
