//! The serial robot with a revolute, two prismatic and a revolute joint (RPPR), in closed form.
//!
//! The base frame has z up along the first joint's axis. `q₁` turns the column, `q₂` lifts the carriage, `q₃` draws the arm
//! in (the arm's reach `A = l₄ + l₆ - q₃` shrinks as `q₃` grows) and `q₄` turns the tool about the arm. With `q = 0` the arm
//! points along the base's y, `l₃` beside the column, `l₅` below the carriage. The TCP's z lies along the arm.
//!
//! Joint vectors are `[q₁, q₂, q₃, q₄]`, of units \[rad, m, m, rad\] and their rates.
//!
//! Source: the document of the RPPR industrial robot, equations 1 to 23, derived anew from its table of Craig's parameters
//! ([`Rppr::dh_rows`]). Where it is wrong as printed, these forms differ from it: equation 1 is the inverse of the transform
//! that it is called (001-01); `q̇₃` has the wrong sign in equations 10, 12, 13, 14, 20 and 21 (001-03, 001-04, 001-06,
//! 001-07, 001-09, 001-10), and so has `q̇₁` in equation 18 (001-08) and `l₃ cos q₁` in the y velocity (001-04, 001-05);
//! equation 23 adds a squared rate to accelerations, without `l₃` (001-11); gravity is part of the accelerations of
//! equations 14 and 22 (001-07, 001-12); equation 17 gives one branch of two, and `q₄` is not solved for (001-14).

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// Dimensions of an RPPR robot, named as the links of its document; there is no `l₂`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rppr {
    /// Height of the first joint's frame above the base \[m\].
    pub l0_m: f64,
    /// Height of the carriage above it at `q₂ = 0` \[m\].
    pub l1_m: f64,
    /// Distance of the arm from the column's axis \[m\].
    pub l3_m: f64,
    /// Length of the arm to the tool joint at `q₃ = 0` \[m\].
    pub l4_m: f64,
    /// How far the tool's axis lies below the carriage \[m\].
    pub l5_m: f64,
    /// Length of the tool along the arm \[m\].
    pub l6_m: f64,
}

/// Every way to put the TCP on a point with a given roll; joint vectors `[q₁, q₂, q₃, q₄]`, with `q₁`, `q₄` in `[-π, π]`.
///
/// Joint limits are not looked at: the heading and the branch's `q₃` may be out of the robot's strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RpprIk {
    /// A point outside the hole: two ways.
    Branches {
        /// The way with `A > 0`, the arm towards the point.
        forward: Vector4<f64>,
        /// The way with `A < 0`, the arm drawn through the column's far side; its `q₃` exceeds `l₄ + l₆`.
        backward: Vector4<f64>,
    },
    /// On the edge of the hole, to rounding: both branches meet with `A = 0`, where velocities cannot be inverted.
    HoleEdge {
        /// The only way.
        q: Vector4<f64>,
    },
    /// On the column's axis, for a robot with `l₃ = 0`: any `q₁` with `A = 0`.
    AnyHeading,
    /// In the hole around the column, or not a finite point.
    Unreachable {
        /// Distance of the point from the column's axis \[m\]; infinite for a point that is not finite.
        distance_m: f64,
        /// The least distance the robot reaches, `|l₃|` \[m\].
        nearest_m: f64,
    },
}

impl RpprIk {
    /// The isolated solutions: two, with the forward one first; one; or none.
    pub fn isolated(&self) -> Vec<Vector4<f64>> {
        match *self {
            Self::Branches { forward, backward } => vec![forward, backward],
            Self::HoleEdge { q } => vec![q],
            Self::AnyHeading | Self::Unreachable { .. } => Vec::new(),
        }
    }
}

/// One row of Craig's (modified) table: `Rx(α) Tx(a) Rz(θ) Tz(d)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DhRow {
    /// Distance along the parent's x \[m\].
    pub a_m: f64,
    /// Twist about the parent's x \[rad\].
    pub alpha_rad: f64,
    /// Distance along the joint's z \[m\].
    pub d_m: f64,
    /// Angle about the joint's z \[rad\].
    pub theta_rad: f64,
}

impl Rppr {
    /// Returns the rows of joints 1 to 4 and of the TCP at `q`: Table 1 of the document.
    pub fn dh_rows(&self, q: Vector4<f64>) -> [DhRow; 5] {
        let row = |a_m, alpha_rad, d_m, theta_rad| DhRow {
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        [
            row(0.0, 0.0, self.l0_m, q[0]),
            row(0.0, 0.0, self.l1_m + q[1], 0.0),
            row(self.l3_m, -quarter, -q[2], quarter),
            row(self.l5_m, 0.0, self.l4_m, q[3]),
            row(0.0, 0.0, self.l6_m, 0.0),
        ]
    }

    /// Returns the signed reach `A = l₄ + l₆ - q₃` of the arm \[m\]; zero where velocities cannot be inverted.
    pub fn reach_m(&self, q3_m: f64) -> f64 {
        self.l4_m + self.l6_m - q3_m
    }

    /// Returns the position of the TCP in the base frame \[m\].
    ///
    /// Source: equation 3.
    pub fn p_tcp_in_base(&self, q: Vector4<f64>) -> Vector3<f64> {
        let h = Heading::of(q[0]);
        h.beside * self.l3_m
            + h.along * self.reach_m(q[2])
            + Vector3::z() * (self.l0_m + self.l1_m - self.l5_m + q[1])
    }

    /// Returns the pose of the TCP in the base frame, shape `(4, 4)`, homogeneous \[m\].
    ///
    /// Source: equation 3, which follows from Craig's forward transforms and not from the printed equation 1 (001-01, 001-02).
    pub fn base_from_tcp(&self, q: Vector4<f64>) -> Matrix4<f64> {
        let h = Heading::of(q[0]);
        let (s4, c4) = libm::sincos(q[3]);
        let x = -h.beside * s4 - Vector3::z() * c4;
        let y = -h.beside * c4 + Vector3::z() * s4;
        let p = self.p_tcp_in_base(q);
        #[rustfmt::skip]
        let pose = Matrix4::new(
            x.x, y.x, h.along.x, p.x,
            x.y, y.y, h.along.y, p.y,
            x.z, y.z, h.along.z, p.z,
            0.0, 0.0, 0.0,       1.0,
        );
        pose
    }

    /// Returns the velocity of the TCP in the base frame \[m/s\].
    ///
    /// Source: equation 13 with the signs of `q̇₃` and of `l₃ cos q₁` corrected (001-04, 001-05).
    pub fn v_tcp_in_base(&self, q: Vector4<f64>, qd: Vector4<f64>) -> Vector3<f64> {
        let h = Heading::of(q[0]);
        let (beside, along) = self.planar_velocity(q, qd);
        h.beside * beside + h.along * along + Vector3::z() * qd[1]
    }

    /// Returns the velocity of the TCP in its own axes \[m/s\].
    ///
    /// Source: equation 10 with `- q̇₃` in the third component (001-03).
    pub fn v_tcp_in_tcp(&self, q: Vector4<f64>, qd: Vector4<f64>) -> Vector3<f64> {
        let (beside, along) = self.planar_velocity(q, qd);
        in_tcp(q[3], beside, along, qd[1])
    }

    /// Returns the acceleration of the TCP in the base frame \[m/s²\]: of its position, without gravity.
    ///
    /// Source: equation 14 with the signs of `q̇₃`, `q̈₃` corrected and without its `+ g`, which makes it what an
    /// accelerometer feels (001-07).
    pub fn a_tcp_in_base(
        &self,
        q: Vector4<f64>,
        qd: Vector4<f64>,
        qdd: Vector4<f64>,
    ) -> Vector3<f64> {
        let h = Heading::of(q[0]);
        let (beside, along) = self.planar_acceleration(q, qd, qdd);
        h.beside * beside + h.along * along + Vector3::z() * qdd[1]
    }

    /// Returns the acceleration of the TCP in its own axes \[m/s²\], without gravity.
    ///
    /// Source: equation 12 with `-2 q̇₁ q̇₃` and `- q̈₃` (001-06), less gravity.
    pub fn a_tcp_in_tcp(
        &self,
        q: Vector4<f64>,
        qd: Vector4<f64>,
        qdd: Vector4<f64>,
    ) -> Vector3<f64> {
        let (beside, along) = self.planar_acceleration(q, qd, qdd);
        in_tcp(q[3], beside, along, qdd[1])
    }

    /// Returns the angular velocity of the TCP in the base frame \[rad/s\].
    pub fn angular_velocity_in_base(&self, q: Vector4<f64>, qd: Vector4<f64>) -> Vector3<f64> {
        Vector3::z() * qd[0] + Heading::of(q[0]).along * qd[3]
    }

    /// Returns the angular velocity of the TCP in its own axes \[rad/s\].
    ///
    /// Source: equation 9, right as printed (001-16).
    pub fn angular_velocity_in_tcp(&self, q: Vector4<f64>, qd: Vector4<f64>) -> Vector3<f64> {
        in_tcp(q[3], 0.0, qd[3], qd[0])
    }

    /// Returns the angular acceleration of the TCP in the base frame \[rad/s²\].
    ///
    /// Source: the derivative of the angular velocity; equation 11, right as printed, has it in the TCP's axes (001-16).
    pub fn angular_acceleration_in_base(
        &self,
        q: Vector4<f64>,
        qd: Vector4<f64>,
        qdd: Vector4<f64>,
    ) -> Vector3<f64> {
        let h = Heading::of(q[0]);
        Vector3::z() * qdd[0] + h.along * qdd[3] - h.beside * (qd[0] * qd[3])
    }

    /// Returns every way to put the TCP on a point of the base frame \[m\] with the roll `q₄` \[rad\], which is passed on.
    ///
    /// The point alone decides where the arm points: a whole pose is reached by at most one of the branches, the one whose
    /// [`Rppr::base_from_tcp`] has its third column. A point off the edge of the hole by no more than rounding counts as
    /// on it. Never gives NaN for a finite roll.
    ///
    /// Source: equations 15 to 17, with the branch that equation 17 leaves out (001-14) and without the division of
    /// equation 15 by `q₃ - l₆ - l₄`, which is 0/0 on the hole's edge (001-13).
    pub fn inverse_kinematics(&self, p_tcp_in_base_m: Vector3<f64>, q4_rad: f64) -> RpprIk {
        let (x, y, z) = (p_tcp_in_base_m.x, p_tcp_in_base_m.y, p_tcp_in_base_m.z);
        let nearest_m = self.l3_m.abs();
        let distance_m = libm::hypot(x, y);
        if !distance_m.is_finite() || !z.is_finite() {
            return RpprIk::Unreachable {
                distance_m: f64::INFINITY,
                nearest_m,
            };
        }
        // On the edge, forward kinematics rounds products of l₃ only.
        let rounding_m = 8.0 * f64::EPSILON * nearest_m;
        if distance_m < nearest_m - rounding_m {
            return RpprIk::Unreachable {
                distance_m,
                nearest_m,
            };
        }
        let branch = |reach_m: f64| {
            // The common divisor A² + l₃² of sine and cosine is positive, and atan2 needs only their ratio.
            let sine = y * self.l3_m - x * reach_m;
            let cosine = x * self.l3_m + y * reach_m;
            Vector4::new(
                libm::atan2(sine, cosine),
                z + self.l5_m - self.l0_m - self.l1_m,
                self.l4_m + self.l6_m - reach_m,
                q4_rad,
            )
        };
        if distance_m <= nearest_m + rounding_m {
            if distance_m <= 0.0 {
                return RpprIk::AnyHeading;
            }
            return RpprIk::HoleEdge { q: branch(0.0) };
        }
        // factored, which keeps the digits near the edge
        let reach_m = libm::sqrt(distance_m - nearest_m) * libm::sqrt(distance_m + nearest_m);
        RpprIk::Branches {
            forward: branch(reach_m),
            backward: branch(-reach_m),
        }
    }

    /// Returns the joint rates that move the TCP at a velocity \[m/s\] and turn it at an angular velocity \[rad/s\], both in
    /// the base frame; `None` where `A = 0`, to rounding.
    ///
    /// Four joints follow the linear velocity and the angular velocity about the arm; the other two components of the
    /// latter are not free and are not looked at.
    ///
    /// Source: equations 18 to 20 with the signs corrected (001-08, 001-09).
    pub fn inverse_velocity(
        &self,
        q: Vector4<f64>,
        v_tcp_in_base_m_s: Vector3<f64>,
        omega_in_base_rad_s: Vector3<f64>,
    ) -> Option<Vector4<f64>> {
        let reach_m = self.invertible_reach_m(q[2])?;
        let h = Heading::of(q[0]);
        let qd1 = -v_tcp_in_base_m_s.dot(&h.beside) / reach_m;
        Some(Vector4::new(
            qd1,
            v_tcp_in_base_m_s.z,
            self.l3_m * qd1 - v_tcp_in_base_m_s.dot(&h.along),
            omega_in_base_rad_s.dot(&h.along),
        ))
    }

    /// Returns the joint accelerations for an acceleration of the TCP \[m/s²\], without gravity, and an angular
    /// acceleration \[rad/s²\], both in the base frame; `None` where `A = 0`, to rounding.
    ///
    /// As with velocities, the angular acceleration counts about the arm only.
    ///
    /// Source: equations 21 to 23 with the signs corrected (001-10, 001-11); `q̈₂` is the vertical acceleration itself,
    /// from which equation 22 takes gravity (001-12).
    pub fn inverse_acceleration(
        &self,
        q: Vector4<f64>,
        qd: Vector4<f64>,
        a_tcp_in_base_m_s2: Vector3<f64>,
        alpha_in_base_rad_s2: Vector3<f64>,
    ) -> Option<Vector4<f64>> {
        let reach_m = self.invertible_reach_m(q[2])?;
        let h = Heading::of(q[0]);
        let (beside, along) = (
            a_tcp_in_base_m_s2.dot(&h.beside),
            a_tcp_in_base_m_s2.dot(&h.along),
        );
        let qdd1 = -(self.l3_m * qd[0] * qd[0] - 2.0 * qd[0] * qd[2] + beside) / reach_m;
        Some(Vector4::new(
            qdd1,
            a_tcp_in_base_m_s2.z,
            self.l3_m * qdd1 - reach_m * qd[0] * qd[0] - along,
            alpha_in_base_rad_s2.dot(&h.along),
        ))
    }

    /// The reach, unless it is zero but for the rounding of its sum.
    fn invertible_reach_m(&self, q3_m: f64) -> Option<f64> {
        let reach_m = self.reach_m(q3_m);
        let rounding_m = 4.0 * f64::EPSILON * (self.l4_m.abs() + self.l6_m.abs() + q3_m.abs());
        (reach_m.abs() > rounding_m).then_some(reach_m)
    }

    /// The horizontal velocity, across the arm and along it \[m/s\].
    fn planar_velocity(&self, q: Vector4<f64>, qd: Vector4<f64>) -> (f64, f64) {
        (-self.reach_m(q[2]) * qd[0], self.l3_m * qd[0] - qd[2])
    }

    /// The horizontal acceleration, across the arm and along it \[m/s²\].
    fn planar_acceleration(
        &self,
        q: Vector4<f64>,
        qd: Vector4<f64>,
        qdd: Vector4<f64>,
    ) -> (f64, f64) {
        let reach_m = self.reach_m(q[2]);
        (
            -reach_m * qdd[0] - self.l3_m * qd[0] * qd[0] + 2.0 * qd[0] * qd[2],
            self.l3_m * qdd[0] - qdd[2] - reach_m * qd[0] * qd[0],
        )
    }
}

/// Returns the roll `q₄` of a TCP with a rotation in the base frame \[rad\], in `[-π, π]`.
///
/// `None` where the TCP's z stands upright, which no posture of the robot has and which leaves the roll open.
///
/// Source: the third row of equation 3; the document does not solve for `q₄` (001-14).
pub fn roll_rad(base_from_tcp: &Matrix3<f64>) -> Option<f64> {
    let (sine, minus_cosine) = (base_from_tcp.m32, base_from_tcp.m31);
    // NaN is no roll either
    (libm::hypot(sine, minus_cosine) > 1e-9).then(|| libm::atan2(sine, -minus_cosine))
}

/// The horizontal axes that turn with the column.
struct Heading {
    /// From the column's axis to the arm, `(c₁, s₁, 0)`.
    beside: Vector3<f64>,
    /// Along the arm, `(-s₁, c₁, 0)`: the TCP's z.
    along: Vector3<f64>,
}

impl Heading {
    fn of(q1_rad: f64) -> Self {
        let (s1, c1) = libm::sincos(q1_rad);
        Self {
            beside: Vector3::new(c1, s1, 0.0),
            along: Vector3::new(-s1, c1, 0.0),
        }
    }
}

/// A vector given across the arm, along it and upwards, in the axes of the TCP.
fn in_tcp(q4_rad: f64, beside: f64, along: f64, up: f64) -> Vector3<f64> {
    let (s4, c4) = libm::sincos(q4_rad);
    Vector3::new(-s4 * beside - c4 * up, -c4 * beside + s4 * up, along)
}
