//! Rest: bodies that have not moved for a while are not stepped any more, together with all that they touch.

use super::engine_settings::{REST_SPEED_M_S, REST_TIME_S};
use super::free_body::FreeBody;
use super::pairs::{Carrier, Collider, Pairs};
use super::world::Driven;

/// Puts to sleep what has rested long enough: bodies that press on each other only together, and none that a link or a moving kinematic
/// body presses on.
pub(super) fn settle(
    free: &mut [FreeBody],
    driven: &[Driven],
    colliders: &[Collider],
    pairs: &Pairs,
    dt_s: f64,
) {
    let mut any = false;
    for body in free.iter_mut().filter(|body| !body.sleeps) {
        let rests = !body.restless && body.speed_m_s() < REST_SPEED_M_S;
        body.rested = if rests {
            body.rested.saturating_add(1)
        } else {
            0
        };
        any |= rests_enough(body, dt_s);
    }
    if !any {
        return;
    }
    // the least index of what is connected
    let mut group: Vec<usize> = (0..free.len()).collect();
    let mut stays: Vec<bool> = free.iter().map(|body| rests_enough(body, dt_s)).collect();
    for pair in pairs.as_slice().iter().filter(|pair| pair.is_fresh) {
        let points = pair.manifolds.iter().flat_map(|one| &one.points);
        if !points.into_iter().any(|point| point.data.impulse > 0.0) {
            continue;
        }
        let [first, second] = pair.colliders.map(|index| colliders[index].carrier);
        match (first, second) {
            (Carrier::Free(a), Carrier::Free(b)) => {
                let (a, b) = (root(&group, a), root(&group, b));
                group[a.max(b)] = a.min(b);
            }
            (Carrier::Free(body), other) | (other, Carrier::Free(body)) => {
                let moves = match other {
                    Carrier::Arm(_) => true,
                    Carrier::Driven(index) => driven[index].moves(),
                    Carrier::World | Carrier::Free(_) => false,
                };
                stays[body] &= !moves;
            }
            _ => {}
        }
    }
    for index in 0..free.len() {
        let root = root(&group, index);
        stays[root] &= stays[index] || free[index].sleeps;
    }
    for (index, body) in free.iter_mut().enumerate() {
        let root = root(&group, index);
        if stays[root] && !body.sleeps {
            body.sleep(root as u64);
        }
    }
}

fn rests_enough(body: &FreeBody, dt_s: f64) -> bool {
    !body.sleeps && f64::from(body.rested) * dt_s >= REST_TIME_S
}

fn root(group: &[usize], mut index: usize) -> usize {
    while group[index] != index {
        index = group[index];
    }
    index
}
