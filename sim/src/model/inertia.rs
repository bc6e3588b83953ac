//! Mass, centre of mass and rotational inertia: of shapes and of sums.

use std::sync::Arc;

use nalgebra::Vector3;

use super::mesh::mesh_problem::MeshProblem;
use super::mesh::surface::Mesh;
use crate::spatial::{Pose, Symmetric3};

/// Mass properties of a rigid body, in the axes of the frame its owner names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass \[m\].
    pub com_m: Vector3<f64>,
    /// Rotational inertia about the centre of mass \[kg m²\].
    pub about_com_kg_m2: Symmetric3,
}

impl Inertia {
    /// No mass at all.
    pub fn zero() -> Self {
        Self {
            mass_kg: 0.0,
            com_m: Vector3::zeros(),
            about_com_kg_m2: Symmetric3::default(),
        }
    }

    /// Rotational inertia about the origin of the frame \[kg m²\] (parallel axes).
    pub fn about_origin_kg_m2(&self) -> Symmetric3 {
        let mut tensor = self.about_com_kg_m2;
        tensor.add(&Symmetric3::of_point_mass(self.mass_kg, &self.com_m));
        tensor
    }

    /// The same body in the frame `a`; `a_from_b` is the pose of its frame `b`.
    pub fn seen_from(&self, a_from_b: &Pose) -> Self {
        Self {
            mass_kg: self.mass_kg,
            com_m: a_from_b.rotation * self.com_m + a_from_b.translation.vector,
            about_com_kg_m2: self.about_com_kg_m2.rotated(a_from_b.rotation.matrix()),
        }
    }

    /// Two bodies in the same frame, joined to one rigid body.
    pub fn plus(&self, other: &Self) -> Self {
        let mass_kg = self.mass_kg + other.mass_kg;
        if mass_kg <= 0.0 {
            let mut sum = *self;
            sum.about_com_kg_m2.add(&other.about_com_kg_m2);
            return sum;
        }
        let com_m = (self.com_m * self.mass_kg + other.com_m * other.mass_kg) / mass_kg;
        let mut about_com_kg_m2 = self.about_com_kg_m2;
        about_com_kg_m2.add(&other.about_com_kg_m2);
        for part in [self, other] {
            about_com_kg_m2.add(&Symmetric3::of_point_mass(
                part.mass_kg,
                &(part.com_m - com_m),
            ));
        }
        Self {
            mass_kg,
            com_m,
            about_com_kg_m2,
        }
    }
}

/// A mesh as a robot or a scene uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSolid {
    /// The path of the file, as written in the description.
    pub file: Arc<str>,
    /// Scale of the file's coordinates along x, y, z; already in `mesh`.
    pub scale: [f64; 3],
    /// Its triangles, scaled \[m\].
    pub mesh: Arc<Mesh>,
    /// Whether contact uses its convex hull; else it uses the triangles themselves, which is possible only for fixed bodies.
    pub convex: bool,
}

/// A solid of uniform density, centred on its own frame; the axis of round ones is `z`, a mesh lies as its file says.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// Edge lengths \[m\].
    Box {
        /// Edge lengths along x, y, z \[m\].
        size_m: [f64; 3],
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius \[m\].
        radius_m: f64,
        /// Length along z \[m\].
        length_m: f64,
    },
    /// A cylinder along z with a half ball on each end.
    Capsule {
        /// Radius \[m\].
        radius_m: f64,
        /// Length of the cylindrical part \[m\].
        length_m: f64,
    },
    /// A ball.
    Sphere {
        /// Radius \[m\].
        radius_m: f64,
    },
    /// What a closed mesh encloses.
    Mesh(MeshSolid),
}

impl Solid {
    /// Volume \[m³\].
    ///
    /// # Errors
    /// A mesh that encloses nothing: leaky, inside-out, or flat.
    pub fn volume_m3(&self) -> Result<f64, MeshProblem> {
        Ok(match self {
            Self::Mesh(solid) => solid.mesh.volume_m3()?,
            primitive => primitive.primitive_volume_m3(),
        })
    }

    fn primitive_volume_m3(&self) -> f64 {
        let pi = std::f64::consts::PI;
        match *self {
            Self::Mesh(_) => 0.0,
            Self::Box { size_m: [x, y, z] } => x * y * z,
            Self::Cylinder { radius_m, length_m } => pi * radius_m * radius_m * length_m,
            Self::Capsule {
                radius_m: r,
                length_m,
            } => pi * r * r * length_m + 4.0 / 3.0 * pi * r * r * r,
            Self::Sphere { radius_m: r } => 4.0 / 3.0 * pi * r * r * r,
        }
    }

    /// Mass properties for a mass \[kg\] spread evenly.
    ///
    /// # Errors
    /// A mesh that encloses nothing: leaky, inside-out, or flat.
    pub fn inertia(&self, mass_kg: f64) -> Result<Inertia, MeshProblem> {
        let diagonal = match *self {
            Self::Mesh(ref solid) => return solid.mesh.inertia_of_mass(mass_kg),
            Self::Box { size_m: [x, y, z] } => {
                let m = mass_kg / 12.0;
                [
                    m * (y * y + z * z),
                    m * (x * x + z * z),
                    m * (x * x + y * y),
                ]
            }
            Self::Cylinder {
                radius_m: r,
                length_m: l,
            } => {
                let across = mass_kg * (3.0 * r * r + l * l) / 12.0;
                [across, across, mass_kg * r * r / 2.0]
            }
            Self::Capsule {
                radius_m: r,
                length_m: l,
            } => {
                let pi = std::f64::consts::PI;
                let density = mass_kg / self.primitive_volume_m3();
                let barrel = density * pi * r * r * l;
                let balls = density * 4.0 / 3.0 * pi * r * r * r;
                // each half ball's centre of mass lies 3r/8 beyond the barrel's end
                let across = barrel * (3.0 * r * r + l * l) / 12.0
                    + balls * (2.0 * r * r / 5.0 + l * l / 4.0 + 3.0 * l * r / 8.0);
                [
                    across,
                    across,
                    barrel * r * r / 2.0 + balls * 2.0 * r * r / 5.0,
                ]
            }
            Self::Sphere { radius_m: r } => [2.0 / 5.0 * mass_kg * r * r; 3],
        };
        Ok(Inertia {
            mass_kg,
            com_m: Vector3::zeros(),
            about_com_kg_m2: Symmetric3 {
                xx: diagonal[0],
                yy: diagonal[1],
                zz: diagonal[2],
                ..Symmetric3::default()
            },
        })
    }
}

/// The principal moments of an inertia tensor \[kg m²\], least first; NaN where the tensor is not finite.
pub(crate) fn principal_moments(tensor: &Symmetric3) -> [f64; 3] {
    let full = tensor.to_matrix();
    // scaled first: neither squares that overflow nor NaN may reach the iteration
    let largest = full.amax();
    if largest == 0.0 || !full.iter().all(|x| x.is_finite()) {
        return full.diagonal().map(|x| x * 0.0).into();
    }
    let mut moments: [f64; 3] = (full / largest).symmetric_eigenvalues().into();
    moments.sort_by(f64::total_cmp);
    moments.map(|moment| moment * largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    #[test]
    fn a_capsule_without_barrel_is_a_ball() {
        let ball = Solid::Sphere { radius_m: 0.3 }.inertia(2.0).unwrap();
        let capsule = Solid::Capsule {
            radius_m: 0.3,
            length_m: 0.0,
        }
        .inertia(2.0)
        .unwrap();
        let (a, b) = (ball.about_com_kg_m2, capsule.about_com_kg_m2);
        for (x, y) in [(a.xx, b.xx), (a.yy, b.yy), (a.zz, b.zz)] {
            assert!((x - y).abs() < 1e-15, "{x} against {y}");
        }
    }

    #[test]
    fn a_long_capsule_matches_its_integral() {
        // slices along z: a disc of radius s(z) has inertia dm (s²/4 + z²) about a transverse axis
        let (r, l, mass) = (0.2, 0.5, 3.0);
        let capsule = Solid::Capsule {
            radius_m: r,
            length_m: l,
        };
        let (mut volume, mut across) = (0.0, 0.0);
        let n = 400_000;
        let half = l / 2.0 + r;
        for i in 0..n {
            let z = -half + (f64::from(i) + 0.5) * 2.0 * half / f64::from(n);
            let beyond = (z.abs() - l / 2.0).max(0.0);
            let s2 = r * r - beyond * beyond;
            volume += s2;
            across += s2 * (s2 / 4.0 + z * z);
        }
        let expected = mass * across / volume;
        let got = capsule.inertia(mass).unwrap().about_com_kg_m2.xx;
        assert!((got - expected).abs() < 1e-9, "{got} against {expected}");
    }

    #[test]
    fn two_halves_make_the_whole_box() {
        let whole = Solid::Box {
            size_m: [0.1, 0.2, 1.0],
        }
        .inertia(4.0)
        .unwrap();
        let half = Solid::Box {
            size_m: [0.1, 0.2, 0.5],
        }
        .inertia(2.0)
        .unwrap();
        let shift = |z| crate::spatial::pose(Matrix3::identity(), Vector3::new(0.0, 0.0, z));
        let sum = half
            .seen_from(&shift(0.25))
            .plus(&half.seen_from(&shift(-0.25)));
        assert!(
            (sum.about_com_kg_m2.to_matrix() - whole.about_com_kg_m2.to_matrix()).norm() < 1e-15
        );
    }

    #[test]
    fn principal_moments_of_any_size_come_to_an_end() {
        let tensor = |size: f64| Symmetric3 {
            xx: 2.0 * size,
            yy: 2.0 * size,
            zz: 4.0 * size,
            xy: size,
            ..Symmetric3::default()
        };
        for size in [1e-300, 1.0, 1e300] {
            // (2, 1; 1, 2) has the eigenvalues 1 and 3
            let moments = principal_moments(&tensor(size)).map(|moment| moment / size);
            for (moment, expected) in moments.into_iter().zip([1.0, 3.0, 4.0]) {
                assert!((moment - expected).abs() < 1e-14, "{moments:?}");
            }
        }
        for broken in [f64::NAN, f64::INFINITY] {
            assert!(principal_moments(&tensor(broken))[0].is_nan());
        }
        assert_eq!(principal_moments(&tensor(0.0)), [0.0; 3]);
    }
}
