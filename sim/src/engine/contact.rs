//! Contact facts: who pressed on whom during a step, where and how hard.

use std::cmp::Ordering;

use nalgebra::Vector3;
use rapier3d_f64::dynamics::RigidBodySet;
use rapier3d_f64::geometry::{ColliderHandle, ColliderSet, NarrowPhase};
use rapier3d_f64::math::Vector;
use rapier3d_f64::utils::OrthonormalBasis;

use super::convert::from_vector;

/// One side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Party {
    /// A link of the robot, by its index among [`crate::robot::Robot::links`].
    Link(usize),
    /// A body of the scene, by its index among [`crate::scene::Scene::bodies`].
    Body(usize),
    /// The ground.
    Ground,
}

impl Party {
    pub(super) fn to_user_data(self) -> u128 {
        match self {
            Self::Link(index) => index as u128,
            Self::Body(index) => (1 << 64) | index as u128,
            Self::Ground => 2 << 64,
        }
    }

    /// Its kind and its index, as numbers for digests.
    pub(crate) fn numbers(self) -> (u64, u64) {
        match self {
            Self::Link(index) => (0, index as u64),
            Self::Body(index) => (1, index as u64),
            Self::Ground => (2, 0),
        }
    }

    pub(super) fn from_user_data(data: u128) -> Self {
        let index = data as u64 as usize;
        match data >> 64 {
            0 => Self::Link(index),
            1 => Self::Body(index),
            _ => Self::Ground,
        }
    }
}

/// What two parties did to each other during one step; only pairs that pressed are told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFact {
    /// The two, the lesser first.
    pub parties: [Party; 2],
    /// Sum of the normal impulses at all points, never negative \[N s\]; over the step's time it is the mean force.
    pub impulse_n_s: f64,
    /// Normal impulses on the second party, as a vector in the world \[N s\].
    pub normal_impulse_n_s: Vector3<f64>,
    /// Friction impulses on the second party, as a vector in the world \[N s\]; zero where no party is a link that
    /// moves, because the engine tells none.
    pub friction_impulse_n_s: Vector3<f64>,
    /// Moment of all these impulses on the second party about the world's origin \[N m s\].
    pub moment_impulse_n_m_s: Vector3<f64>,
    /// Mean normal force over the step \[N\].
    pub force_n: f64,
    /// How deep the deepest point lies inside the other at the start of the step, 0 if none does \[m\].
    pub depth_m: f64,
    /// Points that pressed.
    pub points: usize,
    /// Their centre, weighted by impulse, in the world at the end of the step \[m\].
    pub p_centre_in_world: Vector3<f64>,
}

/// Writes what every pair did in the last step, in the order of the parties.
pub(super) fn read(
    narrow_phase: &NarrowPhase,
    colliders: &ColliderSet,
    bodies: &RigidBodySet,
    dt_s: f64,
    facts: &mut Vec<ContactFact>,
) {
    facts.clear();
    let party = |handle: ColliderHandle| {
        colliders
            .get(handle)
            .map(|collider| Party::from_user_data(collider.user_data))
    };
    for pair in narrow_phase.contact_pairs() {
        let (Some(first), Some(second)) = (party(pair.collider1), party(pair.collider2)) else {
            continue;
        };
        // the engine's normals lead from its first collider to its second
        let (parties, sign) = match first.cmp(&second) {
            Ordering::Greater => ([second, first], -1.0),
            _ => ([first, second], 1.0),
        };
        let (mut impulse, mut vector, mut moment) = (0.0, Vector::ZERO, Vector::ZERO);
        let (mut friction, mut turning) = (Vector::ZERO, Vector::ZERO);
        let (mut depth_m, mut points) = (0.0_f64, 0);
        for manifold in pair.solver_manifolds() {
            // the axes of friction, as the engine chooses them; its impulses are those on the first collider
            let back = -manifold.data.normal;
            let tangent = back.orthonormal_vector();
            let tangents = [tangent, back.cross(tangent)].map(|tangent| tangent * -sign);
            for contact in &manifold.data.solver_contacts {
                let [id] = contact.contact_indices();
                let Some(point) = manifold.points.get(id as usize) else {
                    continue;
                };
                let pressed = point.data.impulse;
                // speculative pairs press nothing
                if pressed > 0.0 {
                    let (a, b) = manifold.data.solver_contact_world_points(contact, bodies);
                    impulse += pressed;
                    let on_second = manifold.data.normal * (sign * pressed);
                    let rubbed = point.data.tangent_impulse;
                    let along_surface = tangents[0] * rubbed.x + tangents[1] * rubbed.y;
                    vector += on_second;
                    friction += along_surface;
                    turning += ((a + b) * 0.5).cross(on_second + along_surface);
                    moment += (a + b) * (0.5 * pressed);
                    depth_m = depth_m.max(-point.dist);
                    points += 1;
                }
            }
        }
        if points == 0 {
            continue;
        }
        let fact = ContactFact {
            parties,
            impulse_n_s: impulse,
            normal_impulse_n_s: from_vector(vector),
            friction_impulse_n_s: from_vector(friction),
            moment_impulse_n_m_s: from_vector(turning),
            force_n: impulse / dt_s,
            depth_m,
            points,
            p_centre_in_world: from_vector(moment / impulse),
        };
        // links and bodies may have several shapes
        match facts.iter_mut().find(|known| known.parties == parties) {
            None => facts.push(fact),
            Some(known) => known.add(&fact),
        }
    }
    facts.sort_by_key(|fact| fact.parties);
}

impl ContactFact {
    fn add(&mut self, other: &Self) {
        let impulse = self.impulse_n_s + other.impulse_n_s;
        self.p_centre_in_world = (self.p_centre_in_world * self.impulse_n_s
            + other.p_centre_in_world * other.impulse_n_s)
            / impulse;
        self.impulse_n_s = impulse;
        self.normal_impulse_n_s += other.normal_impulse_n_s;
        self.friction_impulse_n_s += other.friction_impulse_n_s;
        self.moment_impulse_n_m_s += other.moment_impulse_n_m_s;
        self.force_n += other.force_n;
        self.depth_m = self.depth_m.max(other.depth_m);
        self.points += other.points;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_party_survives_the_way_there_and_back() {
        for party in [
            Party::Link(0),
            Party::Link(7),
            Party::Body(3),
            Party::Ground,
        ] {
            assert_eq!(Party::from_user_data(party.to_user_data()), party);
        }
    }
}
