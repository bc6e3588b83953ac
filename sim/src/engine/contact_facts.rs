//! The contacts of a step: their parties, points, forces and impulses.

use std::cmp::Ordering;

use rapier3d_f64::dynamics::RigidBodySet;
use rapier3d_f64::geometry::{ColliderHandle, ColliderSet, NarrowPhase};
use rapier3d_f64::math::Vector;
use rapier3d_f64::utils::OrthonormalBasis;

use super::convert::from_vector;
use crate::model::contact::{ContactFact, Party};

/// The party as the user data of a collider.
pub(super) fn to_user_data(party: Party) -> u128 {
    match party {
        Party::Link(index) => index as u128,
        Party::Body(index) => (1 << 64) | index as u128,
        Party::Ground => 2 << 64,
    }
}

/// The party of a collider with the user data `data`.
pub(super) fn from_user_data(data: u128) -> Party {
    let index = data as u64 as usize;
    match data >> 64 {
        0 => Party::Link(index),
        1 => Party::Body(index),
        _ => Party::Ground,
    }
}

/// Writes the contact of every pair in the last step, in the order of the parties.
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
            .map(|collider| from_user_data(collider.user_data))
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
                // predicted contacts have no force
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
        facts.push(fact);
    }
    // links and bodies may have several shapes: in the engine's order, since the last bit of a sum depends on it
    facts.sort_by_key(|fact| fact.parties);
    facts.dedup_by(|next, known| {
        let is_same = next.parties == known.parties;
        if is_same {
            add(known, next);
        }
        is_same
    });
}

/// Adds the contact at other points of the same two parties.
fn add(known: &mut ContactFact, other: &ContactFact) {
    let impulse = known.impulse_n_s + other.impulse_n_s;
    known.p_centre_in_world = (known.p_centre_in_world * known.impulse_n_s
        + other.p_centre_in_world * other.impulse_n_s)
        / impulse;
    known.impulse_n_s = impulse;
    known.normal_impulse_n_s += other.normal_impulse_n_s;
    known.friction_impulse_n_s += other.friction_impulse_n_s;
    known.moment_impulse_n_m_s += other.moment_impulse_n_m_s;
    known.force_n += other.force_n;
    known.depth_m = known.depth_m.max(other.depth_m);
    known.points += other.points;
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
            assert_eq!(from_user_data(to_user_data(party)), party);
        }
    }
}
