//! The planar arm with two revolute joints, in closed form.
//!
//! The *lab frame* has x up along the base, y sideways and z along the joint axes; its origin is at the foot of the
//! base, and the shoulder is at `(base_height, 0, 0)`. With both angles zero the arm points straight up. The elbow's
//! angle is relative to the upper link. Gravity acts along -x.
//!
//! Source: the virtual-robotics lab, equations 9 to 21, corrected where its errata (003-06 to 003-10) say so; dynamics
//! from the Lagrangian of two rigid links.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Matrix4, Vector2, Vector3};

/// Dimensions, masses and damping of a planar arm with two revolute joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planar2r {
    /// Height of the shoulder above the foot of the base, along x \[m\].
    pub base_height_m: f64,
    /// Length of the upper link, shoulder to elbow \[m\].
    pub l1_m: f64,
    /// Length of the lower link, elbow to TCP \[m\].
    pub l2_m: f64,
    /// Offset of the upper link along z \[m\].
    pub offset_z1_m: f64,
    /// Offset of the lower link from the upper one along z \[m\].
    pub offset_z2_m: f64,
    /// Mass of the upper link \[kg\].
    pub m1_kg: f64,
    /// Mass of the lower link \[kg\].
    pub m2_kg: f64,
    /// Distance of the upper link's centre of mass from the shoulder, along the link \[m\].
    pub com1_m: f64,
    /// Distance of the lower link's centre of mass from the elbow, along the link \[m\].
    pub com2_m: f64,
    /// Inertia of the upper link about z through its centre of mass \[kg m²\].
    pub i1_com_kg_m2: f64,
    /// Inertia of the lower link about z through its centre of mass \[kg m²\].
    pub i2_com_kg_m2: f64,
    /// Viscous damping of each joint \[N m s/rad\].
    pub joint_damping_n_m_s: f64,
    /// Acceleration of gravity, towards -x \[m/s²\].
    pub gravity_m_s2: f64,
}

/// Joint positions and velocities of the arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointState {
    /// Shoulder and elbow angle \[rad\].
    pub q_rad: Vector2<f64>,
    /// Shoulder and elbow rate \[rad/s\].
    pub qd_rad_s: Vector2<f64>,
}

/// The inverse kinematics of a point: all branches; angles `[q₁, q₂]` with `q₁` in `[-π, π)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum IkSolutions {
    /// A point inside the workspace: two branches.
    Branches {
        /// The branch with `0 < q₂ < π` \[rad\].
        elbow_plus_rad: Vector2<f64>,
        /// The branch with `-π < q₂ < 0` \[rad\].
        elbow_minus_rad: Vector2<f64>,
    },
    /// On the outer circle, to rounding: both branches meet with `q₂ = 0`. The Jacobian is singular.
    Straight {
        /// The only solution \[rad\].
        q_rad: Vector2<f64>,
    },
    /// On the inner circle of unequal links, to rounding: both branches meet with `q₂ = π`. The Jacobian is singular.
    Folded {
        /// The only solution, up to full turns \[rad\].
        q_rad: Vector2<f64>,
    },
    /// On the shoulder with equal links: folded (`q₂ = ±π`) with any shoulder angle.
    AnyShoulderAngle,
    /// Outside the workspace.
    Unreachable {
        /// Distance of the point from the shoulder \[m\]; infinite for a point that is not finite.
        distance_m: f64,
        /// The least distance the arm reaches, `|l₁ - l₂|` \[m\].
        nearest_m: f64,
        /// The greatest distance the arm reaches, `l₁ + l₂` \[m\].
        farthest_m: f64,
    },
}

impl IkSolutions {
    /// The isolated solutions: two, one, or none (unreachable, or infinitely many).
    pub fn isolated(&self) -> Vec<Vector2<f64>> {
        match *self {
            Self::Branches {
                elbow_plus_rad,
                elbow_minus_rad,
            } => vec![elbow_plus_rad, elbow_minus_rad],
            Self::Straight { q_rad } | Self::Folded { q_rad } => vec![q_rad],
            Self::AnyShoulderAngle | Self::Unreachable { .. } => Vec::new(),
        }
    }
}

impl Planar2r {
    /// The arm of the virtual-robotics lab: RRBot with links of 1 m, 0.5 kg and a section of 0.05 m by 0.05 m.
    pub fn lab_arm() -> Self {
        // of a box, about the axis through its centre of mass across its length
        let inertia = 0.5 * (1.0 + 0.05 * 0.05) / 12.0;
        Self {
            base_height_m: 2.0,
            l1_m: 1.0,
            l2_m: 1.0,
            offset_z1_m: 0.025,
            offset_z2_m: 0.025,
            m1_kg: 0.5,
            m2_kg: 0.5,
            com1_m: 0.5,
            com2_m: 0.5,
            i1_com_kg_m2: inertia,
            i2_com_kg_m2: inertia,
            joint_damping_n_m_s: 0.7,
            gravity_m_s2: 9.81,
        }
    }

    /// Returns the position of the TCP in the lab frame \[m\].
    ///
    /// Source: equation 9 of the lab.
    pub fn p_tcp_in_lab(&self, q_rad: Vector2<f64>) -> Vector3<f64> {
        let Trig {
            s1, c1, s12, c12, ..
        } = Trig::of(q_rad);
        Vector3::new(
            self.base_height_m + self.l1_m * c1 + self.l2_m * c12,
            self.l1_m * s1 + self.l2_m * s12,
            self.offset_z1_m + self.offset_z2_m,
        )
    }

    /// Returns the pose of the TCP in the lab frame, shape `(4, 4)`, homogeneous \[m\]; the TCP's x lies along the lower link.
    pub fn lab_from_tcp(&self, q_rad: Vector2<f64>) -> Matrix4<f64> {
        let Trig { s12, c12, .. } = Trig::of(q_rad);
        let p = self.p_tcp_in_lab(q_rad);
        #[rustfmt::skip]
        let pose = Matrix4::new(
            c12, -s12, 0.0, p.x,
            s12,  c12, 0.0, p.y,
            0.0,  0.0, 1.0, p.z,
            0.0,  0.0, 0.0, 1.0,
        );
        pose
    }

    /// Returns the Jacobian of the TCP position, shape `(2, 2)` \[m/rad\].
    ///
    /// Rows are the x and y velocity of the TCP in the lab frame, columns the shoulder and elbow rates. Loses rank where
    /// the arm is straight or folded (`sin q₂ = 0`).
    ///
    /// Source: equation 19 of the lab, with the second column by `q₁ + q₂` (errata 003-09).
    pub fn tcp_jacobian_in_lab(&self, q_rad: Vector2<f64>) -> Matrix2<f64> {
        let Trig {
            s1, c1, s12, c12, ..
        } = Trig::of(q_rad);
        let (l1, l2) = (self.l1_m, self.l2_m);
        Matrix2::new(-l1 * s1 - l2 * s12, -l2 * s12, l1 * c1 + l2 * c12, l2 * c12)
    }

    /// Returns the determinant of the Jacobian, `l₁ l₂ sin q₂` \[m²/rad²\].
    pub fn jacobian_determinant(&self, q_rad: Vector2<f64>) -> f64 {
        self.l1_m * self.l2_m * libm::sin(q_rad.y)
    }

    /// Returns all branches of inverse kinematics for the TCP at `(x, y)` of the lab frame \[m\].
    ///
    /// A point off a circle of the workspace by no more than rounding counts as on it. Never gives NaN.
    ///
    /// Source: equations 12 to 18 of the lab, corrected (errata 003-06 to 003-08). The elbow is found from its half angle,
    /// `tan²(q₂/2) = ((l₁+l₂)² - d²) / (d² - (l₁-l₂)²)`, which keeps its digits near the straight and the folded arm,
    /// where the lab's arc cosine loses half of them.
    pub fn inverse_kinematics(&self, x_m: f64, y_m: f64) -> IkSolutions {
        let (l1, l2) = (self.l1_m, self.l2_m);
        let (nearest_m, farthest_m) = ((l1 - l2).abs(), l1 + l2);
        let u = x_m - self.base_height_m;
        let distance_m = libm::hypot(u, y_m);
        if !distance_m.is_finite() {
            return IkSolutions::Unreachable {
                distance_m: f64::INFINITY,
                nearest_m,
                farthest_m,
            };
        }

        // Forward kinematics rounds each of a few sums to half a last place of its largest term.
        let rounding_m = 8.0 * f64::EPSILON * (self.base_height_m.abs() + farthest_m);
        let direction = libm::atan2(y_m, u);
        if distance_m > farthest_m + rounding_m || distance_m < nearest_m - rounding_m {
            return IkSolutions::Unreachable {
                distance_m,
                nearest_m,
                farthest_m,
            };
        }
        if distance_m >= farthest_m - rounding_m {
            return IkSolutions::Straight {
                q_rad: Vector2::new(wrapped_rad(direction), 0.0),
            };
        }
        if distance_m <= nearest_m + rounding_m {
            if nearest_m <= rounding_m {
                return IkSolutions::AnyShoulderAngle;
            }
            // The longer link points at the target if it is the upper one, away if it is the lower.
            let q1 = if l1 > l2 { direction } else { direction + PI };
            return IkSolutions::Folded {
                q_rad: Vector2::new(wrapped_rad(q1), PI),
            };
        }

        let to_straight = (farthest_m - distance_m) * (farthest_m + distance_m);
        let to_folded = (distance_m - nearest_m) * (distance_m + nearest_m);
        let q2 = 2.0 * libm::atan2(libm::sqrt(to_straight), libm::sqrt(to_folded));
        let (s2, c2) = libm::sincos(q2);
        let elbow_turn = libm::atan2(l2 * s2, l1 + l2 * c2);
        IkSolutions::Branches {
            elbow_plus_rad: Vector2::new(wrapped_rad(direction - elbow_turn), q2),
            elbow_minus_rad: Vector2::new(wrapped_rad(direction + elbow_turn), -q2),
        }
    }

    /// Returns the mass matrix `M(q)`, shape `(2, 2)`, symmetric \[kg m²\].
    pub fn mass_matrix(&self, q_rad: Vector2<f64>) -> Matrix2<f64> {
        let about_elbow = self.i2_com_kg_m2 + self.m2_kg * self.com2_m * self.com2_m;
        let about_shoulder = self.i1_com_kg_m2 + self.m1_kg * self.com1_m * self.com1_m;
        let coupling = self.m2_kg * self.l1_m * self.com2_m * libm::cos(q_rad.y);
        let carried = self.m2_kg * self.l1_m * self.l1_m;
        let m11 = about_shoulder + carried + about_elbow + 2.0 * coupling;
        let m12 = about_elbow + coupling;
        Matrix2::new(m11, m12, m12, about_elbow)
    }

    /// Returns the efforts that hold the arm still, shape `(2)` \[N m\]: the slope of the potential energy.
    pub fn gravity_efforts_n_m(&self, q_rad: Vector2<f64>) -> Vector2<f64> {
        let Trig { s1, s12, .. } = Trig::of(q_rad);
        let lower = -self.gravity_m_s2 * self.m2_kg * self.com2_m * s12;
        let upper = -self.gravity_m_s2 * (self.m1_kg * self.com1_m + self.m2_kg * self.l1_m) * s1;
        Vector2::new(upper + lower, lower)
    }

    /// Returns the bias `C(q, q̇) q̇ + G(q)`, shape `(2)` \[N m\]: Coriolis, centrifugal and gravity terms, no damping.
    pub fn bias_n_m(&self, state: &JointState) -> Vector2<f64> {
        let h = self.m2_kg * self.l1_m * self.com2_m * libm::sin(state.q_rad.y);
        let (w1, w2) = (state.qd_rad_s.x, state.qd_rad_s.y);
        let coriolis = Vector2::new(-h * (2.0 * w1 * w2 + w2 * w2), h * w1 * w1);
        coriolis + self.gravity_efforts_n_m(state.q_rad)
    }

    /// Returns the efforts of the motors for an acceleration, `M q̈ + C q̇ + G + b q̇`, shape `(2)` \[N m\].
    pub fn inverse_dynamics_n_m(
        &self,
        state: &JointState,
        qdd_rad_s2: Vector2<f64>,
    ) -> Vector2<f64> {
        let damping = self.joint_damping_n_m_s * state.qd_rad_s;
        self.mass_matrix(state.q_rad) * qdd_rad_s2 + self.bias_n_m(state) + damping
    }

    /// Returns the acceleration under efforts of the motors, shape `(2)` \[rad/s²\].
    ///
    /// The mass matrix is positive definite, hence invertible, for every arm whose links both have inertia.
    pub fn forward_dynamics_rad_s2(
        &self,
        state: &JointState,
        effort_n_m: Vector2<f64>,
    ) -> Vector2<f64> {
        let m = self.mass_matrix(state.q_rad);
        let rest = effort_n_m - self.bias_n_m(state) - self.joint_damping_n_m_s * state.qd_rad_s;
        // by Cramer's rule
        let determinant = m.m11 * m.m22 - m.m12 * m.m12;
        Vector2::new(
            m.m22 * rest.x - m.m12 * rest.y,
            m.m11 * rest.y - m.m12 * rest.x,
        ) / determinant
    }

    /// Returns the kinetic energy \[J\].
    pub fn kinetic_energy_j(&self, state: &JointState) -> f64 {
        0.5 * state
            .qd_rad_s
            .dot(&(self.mass_matrix(state.q_rad) * state.qd_rad_s))
    }

    /// Returns the potential energy \[J\], zero at the height of the shoulder.
    pub fn potential_energy_j(&self, q_rad: Vector2<f64>) -> f64 {
        let Trig { c1, c12, .. } = Trig::of(q_rad);
        let height1_m = self.com1_m * c1;
        let height2_m = self.l1_m * c1 + self.com2_m * c12;
        self.gravity_m_s2 * (self.m1_kg * height1_m + self.m2_kg * height2_m)
    }

    /// Returns kinetic plus potential energy \[J\], the latter zero at the height of the shoulder.
    ///
    /// It grows by the power of the efforts, `τ·q̇`, less that of damping, `b |q̇|²`.
    pub fn energy_j(&self, state: &JointState) -> f64 {
        self.kinetic_energy_j(state) + self.potential_energy_j(state.q_rad)
    }
}

/// Sines and cosines of `q₁` and `q₁ + q₂`.
struct Trig {
    s1: f64,
    c1: f64,
    s12: f64,
    c12: f64,
}

impl Trig {
    fn of(q_rad: Vector2<f64>) -> Self {
        let (s1, c1) = libm::sincos(q_rad.x);
        let (s12, c12) = libm::sincos(q_rad.x + q_rad.y);
        Self { s1, c1, s12, c12 }
    }
}

/// Brings an angle between -3π and 3π into `[-π, π)`.
fn wrapped_rad(angle_rad: f64) -> f64 {
    if angle_rad >= PI {
        angle_rad - TAU
    } else if angle_rad < -PI {
        angle_rad + TAU
    } else {
        angle_rad
    }
}
