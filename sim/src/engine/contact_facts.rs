//! The contacts of a step: their parties, points, forces and impulses.

use nalgebra::Vector3;

use super::convert::from_vector;
use super::pairs::{Collider, Pairs};
use crate::model::contact::ContactFact;

/// Writes the contact of every pair in the last step, in the order of the parties. The colliders are where they were at its start.
pub(super) fn read(pairs: &Pairs, colliders: &[Collider], dt_s: f64, facts: &mut Vec<ContactFact>) {
    facts.clear();
    for pair in pairs.as_slice() {
        let [one, other] = pair.colliders.map(|index| &colliders[index]);
        // normals lead from the first collider to the second
        let (parties, sign) = if one.party > other.party {
            ([other.party, one.party], -1.0)
        } else {
            ([one.party, other.party], 1.0)
        };
        let mut fact = ContactFact {
            parties,
            impulse_n_s: 0.0,
            normal_impulse_n_s: Vector3::zeros(),
            friction_impulse_n_s: Vector3::zeros(),
            moment_impulse_n_m_s: Vector3::zeros(),
            force_n: 0.0,
            depth_m: 0.0,
            points: 0,
            p_centre_in_world: Vector3::zeros(),
        };
        for manifold in &pair.manifolds {
            let first = match manifold.subshape_pos1() {
                Some(place) => one.world_from_shape * *place,
                None => one.world_from_shape,
            };
            let normal = from_vector(first.rotation * manifold.local_n1) * sign;
            for point in &manifold.points {
                let pressed = point.data.impulse;
                // predicted contacts have no force
                if pressed <= 0.0 {
                    continue;
                }
                let p = from_vector(point.data.p);
                let (on_second, along) = (normal * pressed, from_vector(point.data.rubbed) * sign);
                fact.impulse_n_s += pressed;
                fact.normal_impulse_n_s += on_second;
                fact.friction_impulse_n_s += along;
                fact.moment_impulse_n_m_s += p.cross(&(on_second + along));
                fact.p_centre_in_world += p * pressed;
                fact.depth_m = fact.depth_m.max(-point.dist);
                fact.points += 1;
            }
        }
        if fact.points > 0 {
            fact.p_centre_in_world /= fact.impulse_n_s;
            fact.force_n = fact.impulse_n_s / dt_s;
            facts.push(fact);
        }
    }
    // links and bodies may have several shapes: in the order of the pairs, since the last bit of a sum depends on it
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
