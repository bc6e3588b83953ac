//! How fast viscous damping can brake a robot: an upper bound of the largest eigenvalue of `M⁻¹ D` over all configurations.
//!
//! A lower bound of the mass matrix comes from the kinetic energy. The motion of joint `i` is the difference of the motions of two
//! bodies, its own and its parent, seen along the joint's axis. A body that moves with `s` along an axis has at least the energy
//! `½ μ s²`, where `1/μ = Fᵀ I⁻¹ F` for the unit wrench `F` of that axis. Each body shares its energy equally among the joints at which
//! it hangs or that hang on it, so `2 T ≥ Σ b_i q̇_i²` with `1/b_i = 1/(share of the body) + 1/(share of its parent)`. Hence
//! `λ_max(M⁻¹ D) ≤ max D_i / (b_i + armature_i)`. None of these numbers depends on the configuration, because the axis of a joint is
//! fixed in both of its bodies.
//!
//! The bound is coarse (50 1/s for the course's arm, whose eigenvalue is at most 21 1/s), and infinite for bodies without inertia about
//! their joint.

use nalgebra::{Matrix3, Vector3};

use crate::model::robot::{Body, Robot};
use crate::spatial::Symmetric3;

/// An upper bound of the largest eigenvalue of `M⁻¹ D` over all configurations \[1/s\]; 0 without damping.
pub(crate) fn fastest_damping_rate_bound(robot: &Robot) -> f64 {
    let bodies = robot.bodies();
    let mut sharers = vec![1.0; bodies.len()];
    for body in bodies {
        if let Some(parent) = body.parent {
            sharers[parent] += 1.0;
        }
    }
    let mut bound = 0.0_f64;
    for (i, body) in bodies.iter().enumerate() {
        if body.damping <= 0.0 {
            continue;
        }
        let z = Vector3::z();
        let own = mobility(body, body.turns, &z, &Vector3::zeros()) * sharers[i];
        let of_parent = match body.parent {
            // the world does not move
            None => 0.0,
            Some(parent) => {
                let (axis, point) = (body.parent_from_body * z, &body.p_body_in_parent);
                mobility(&bodies[parent], body.turns, &axis, point) * sharers[parent]
            }
        };
        let felt = 1.0 / (own + of_parent) + body.armature;
        bound = bound.max(body.damping / felt);
    }
    bound
}

/// `1/μ` of a body for the axis through `point` of a joint that turns, or that slides; infinite for a body without inertia against it.
fn mobility(body: &Body, turns: bool, axis: &Vector3<f64>, point: &Vector3<f64>) -> f64 {
    if body.mass_kg <= 0.0 {
        return f64::INFINITY;
    }
    let com = body.first_moment / body.mass_kg;
    let of_mass = Symmetric3::of_point_mass(body.mass_kg, &com);
    let about_com = body.inertia.to_matrix() - of_mass.to_matrix();
    if turns {
        turning_mobility(&about_com, axis)
    } else {
        1.0 / body.mass_kg + turning_mobility(&about_com, &(point - com).cross(axis))
    }
}

/// `mᵀ I⁻¹ m` of a moment `m` on the rotational inertia `I`; infinite where `I` is singular, unless there is no moment.
fn turning_mobility(inertia: &Matrix3<f64>, moment: &Vector3<f64>) -> f64 {
    if moment.norm_squared() == 0.0 {
        return 0.0;
    }
    inertia
        .cholesky()
        .map_or(f64::INFINITY, |factor| moment.dot(&factor.solve(moment)))
}
