//! Events of the dynamic bodies of a scene: moved, toppled, left its support, fell over which side.

use nalgebra::Vector3;

use super::event::{EventKind, SeenSide, Side};
use crate::engine::BodyState;
use crate::kinematics::FramePoses;
use crate::model::contact::{ContactFact, Party};
use crate::model::extent::box_around;
use crate::model::scene::{BodyKind, Scene};
use crate::run::Setup;
use crate::spatial::{Pose, direction};
use crate::step::hybrid::HybridStep;

/// A contact supports a body only if it pushes it up by at least this fraction of the body's weight.
const LEAST_LIFT: f64 = 0.1;
/// A body has moved when its centre of mass is this far from its start \[m\].
const MOVED_M: f64 = 0.005;
/// Cosine of the tilt at which a body counts as toppled: 45 degrees.
const TOPPLED_COS: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// A body has fallen when its centre of mass is this far below its support and below its start \[m\].
const FELL_M: f64 = 0.05;

#[derive(Debug, Clone)]
pub(super) struct BodyWatch<'a> {
    scene: Option<&'a Scene>,
    apart_ticks: u64,
    /// Against gravity; z where there is none.
    up: Vector3<f64>,
    p_base_in_world: Vector3<f64>,
    free: Vec<FreeBody>,
}

#[derive(Debug, Clone)]
struct FreeBody {
    index: usize,
    /// Upward impulse in a step from which something supports it: a tenth of the impulse of its weight \[N s\].
    least_lift_n_s: f64,
    /// The tick since which it has had no contact at all.
    clear_since: Option<u64>,
    /// Whether it has been without contact for long enough since it last touched its support.
    flew: bool,
    p_com_in_body: Vector3<f64>,
    start_com: Vector3<f64>,
    /// The direction that pointed up at the start, in the body's frame.
    up_in_body: Vector3<f64>,
    support: Option<Support>,
    /// The tick since which nothing has supported it.
    adrift_since: Option<u64>,
    moved: bool,
    toppled: bool,
    left: bool,
    fell: bool,
}

/// The first support of a body.
#[derive(Debug, Clone, Copy)]
struct Support {
    party: Party,
    /// Height of the support \[m\].
    height_m: f64,
}

impl<'a> BodyWatch<'a> {
    pub(super) fn new(setup: &Setup<'a>, apart_ticks: u64) -> Self {
        let up = direction(-setup.gravity_m_s2).unwrap_or_else(Vector3::z);
        let bodies = setup.scene.map_or(&[][..], |scene| &scene.bodies);
        let free = bodies.iter().enumerate();
        let free = free.filter(|(_, body)| matches!(body.kind, BodyKind::Free));
        let mut poses = FramePoses::new(setup.robot);
        poses.update(setup.robot, &setup.start_q);
        Self {
            scene: setup.scene,
            apart_ticks,
            up,
            p_base_in_world: base(setup, &poses),
            free: free
                .map(|(index, body)| FreeBody {
                    index,
                    least_lift_n_s: LEAST_LIFT
                        * body.inertia.mass_kg
                        * setup.gravity_m_s2.norm()
                        * setup.periods.step_s,
                    clear_since: None,
                    flew: false,
                    p_com_in_body: body.inertia.com_m,
                    start_com: com(&body.world_from_body, &body.inertia.com_m),
                    up_in_body: body.world_from_body.inverse_transform_vector(&up),
                    support: None,
                    adrift_since: None,
                    moved: false,
                    toppled: false,
                    left: false,
                    fell: false,
                })
                .collect(),
        }
    }

    pub(super) fn observe(
        &mut self,
        tick: u64,
        step: &HybridStep,
        emit: &mut impl FnMut(u64, EventKind),
    ) {
        // nothing has been stepped yet: no contact is known
        if tick == 0 {
            return;
        }
        for free in &mut self.free {
            let body = free.index;
            let BodyState {
                world_from_body,
                sleeps,
                ..
            } = step.body(body);
            if sleeps {
                continue;
            }
            let now = com(&world_from_body, &free.p_com_in_body);
            if !free.moved && (now - free.start_com).norm() >= MOVED_M {
                free.moved = true;
                emit(tick, EventKind::Moved { body });
            }
            let up_now = world_from_body.transform_vector(&free.up_in_body);
            if !free.toppled && up_now.dot(&self.up) <= TOPPLED_COS {
                free.toppled = true;
                emit(tick, EventKind::Toppled { body });
            }
            let contacts = &step.report().contacts;
            let of_body = |fact: &&ContactFact| fact.parties.contains(&Party::Body(body));
            let mut touching = contacts.iter().filter(of_body).peekable();
            if touching.peek().is_some() {
                free.clear_since = None;
                // back on its support, wherever that is by now
                let home = free.support.map(|support| support.party);
                free.flew &=
                    !touching.any(|fact| home.is_some_and(|home| fact.parties.contains(&home)));
            } else {
                let since = *free.clear_since.get_or_insert(tick);
                free.flew |= free.support.is_some() && tick - since >= self.apart_ticks;
            }
            let carrier = carrier(body, contacts, &self.up, free.least_lift_n_s);
            match (carrier, &free.support) {
                (Some(found), None) => free.support = Some(found),
                (Some(_), Some(_)) => free.adrift_since = None,
                (None, Some(_)) => {
                    let since = *free.adrift_since.get_or_insert(tick);
                    if !free.left && tick - since >= self.apart_ticks {
                        free.left = true;
                        emit(since, EventKind::LeftSupport { body });
                    }
                }
                (None, None) => {}
            }
            let Some(support) = free.support else {
                continue;
            };
            let bar = support.height_m.min(free.start_com.dot(&self.up)) - FELL_M;
            if !free.fell && free.flew && now.dot(&self.up) <= bar {
                free.fell = true;
                let side = self
                    .scene
                    .and_then(|scene| side(scene, step, &support, &now, &self.up));
                let side = side.map(|(outward, centre)| Side {
                    seen: seen(&outward, &(centre - self.p_base_in_world), &self.up),
                    outward,
                });
                emit(tick, EventKind::BodyFell { body, side });
            }
        }
    }
}

/// Position of the first moving joint at the start, in the world \[m\]: near and far sides are relative to it.
fn base(setup: &Setup<'_>, poses: &FramePoses) -> Vector3<f64> {
    let robot = setup.robot;
    robot
        .moving_joints()
        .next()
        .and_then(|joint| robot.frames().get(joint.child))
        .map_or_else(Vector3::zeros, |frame| {
            poses.world_from(frame).translation.vector
        })
}

fn com(world_from_body: &Pose, p_com_in_body: &Vector3<f64>) -> Vector3<f64> {
    world_from_body
        .transform_point(&(*p_com_in_body).into())
        .coords
}

/// The party that pushes `body` up most, if any does by more than `least_n_s`.
fn carrier(
    body: usize,
    contacts: &[ContactFact],
    up: &Vector3<f64>,
    least_n_s: f64,
) -> Option<Support> {
    let mut most = least_n_s;
    let mut carrier = None;
    for fact in contacts {
        let [first, second] = fact.parties;
        let (party, lift) = if second == Party::Body(body) {
            (first, fact.normal_impulse_n_s.dot(up))
        } else if first == Party::Body(body) {
            (second, -fact.normal_impulse_n_s.dot(up))
        } else {
            continue;
        };
        if lift > most {
            most = lift;
            carrier = Some(Support {
                party,
                height_m: fact.p_centre_in_world.dot(up),
            });
        }
    }
    carrier
}

/// The side of the box around its support beyond which the point `now` lies: outward direction and centre of the box; none inside it.
fn side(
    scene: &Scene,
    step: &HybridStep,
    support: &Support,
    now: &Vector3<f64>,
    up: &Vector3<f64>,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let Party::Body(index) = support.party else {
        return None;
    };
    let world_from_support = step.body(index).world_from_body;
    let [low, high] = box_around(&scene.bodies[index].shapes)?;
    let local = world_from_support
        .inverse_transform_point(&(*now).into())
        .coords;
    let mut best: Option<(f64, Vector3<f64>)> = None;
    for axis in 0..3 {
        let unit = world_from_support.transform_vector(&Vector3::ith(axis, 1.0));
        // top and bottom do not count as sides
        if unit.dot(up).abs() > TOPPLED_COS {
            continue;
        }
        for (beyond, outward) in [
            (local[axis] - high[axis], unit),
            (low[axis] - local[axis], -unit),
        ] {
            if beyond > 0.0 && best.is_none_or(|(most, _)| beyond > most) {
                best = Some((beyond, outward));
            }
        }
    }
    let (_, outward) = best?;
    let level = direction(outward - up * outward.dot(up))?;
    let centre = (low + high) * 0.5;
    Some((
        level,
        world_from_support.transform_point(&centre.into()).coords,
    ))
}

/// The name of an outward direction relative to `away`, the direction from the robot to the support.
fn seen(outward: &Vector3<f64>, away: &Vector3<f64>, up: &Vector3<f64>) -> SeenSide {
    let ahead = direction(away - up * away.dot(up)).unwrap_or_else(Vector3::x);
    let along = outward.dot(&ahead);
    if along >= TOPPLED_COS {
        SeenSide::Far
    } else if along <= -TOPPLED_COS {
        SeenSide::Near
    } else if up.cross(&ahead).dot(outward) > 0.0 {
        SeenSide::Left
    } else {
        SeenSide::Right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_seen_from_the_robot() {
        let (up, ahead) = (Vector3::z(), Vector3::new(2.0, 0.0, 0.3));
        for (outward, side) in [
            (Vector3::x(), SeenSide::Far),
            (-Vector3::x(), SeenSide::Near),
            (Vector3::y(), SeenSide::Left),
            (-Vector3::y(), SeenSide::Right),
        ] {
            assert_eq!(seen(&outward, &ahead, &up), side);
            // the same scene, rotated by 90 degrees about the robot
            let turned = |v: &Vector3<f64>| Vector3::new(-v.y, v.x, v.z);
            assert_eq!(seen(&turned(&outward), &turned(&ahead), &up), side);
        }
    }

    #[test]
    fn what_pushes_up_most_carries() {
        let fact = |parties, lift: f64, height_m: f64| ContactFact {
            parties,
            impulse_n_s: 1.0,
            normal_impulse_n_s: Vector3::new(0.5, 0.0, lift),
            force_n: 1.0,
            depth_m: 0.0,
            points: 1,
            friction_impulse_n_s: Vector3::zeros(),
            moment_impulse_n_m_s: Vector3::zeros(),
            p_centre_in_world: Vector3::new(0.0, 0.0, height_m),
        };
        let up = Vector3::z();
        let contacts = [
            fact([Party::Link(2), Party::Body(4)], 0.1, 0.3),
            fact([Party::Body(1), Party::Body(4)], 0.2, 0.4),
            // body 4 pushes body 6 up, and is pushed down by it
            fact([Party::Body(4), Party::Body(6)], 0.9, 0.8),
            fact([Party::Body(4), Party::Ground], -0.1, 0.0),
        ];
        let found =
            carrier(4, &contacts, &up, 0.0).map(|support| (support.party, support.height_m));
        assert_eq!(found, Some((Party::Body(1), 0.4)));
        let found = carrier(6, &contacts, &up, 0.0).map(|support| support.party);
        assert_eq!(found, Some(Party::Body(4)));
        assert!(carrier(1, &contacts, &up, 0.0).is_none());
        // a push that is too weak
        assert!(carrier(4, &contacts, &up, 0.2).is_none());
    }
}
