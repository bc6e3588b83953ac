//! Bounces by the coefficient of restitution, at all points of a contact together.
//!
//! The engine itself goes through the points of a contact once and bounces each separately. The first corner of a face then gets most of
//! the impulse, and the face leaves too fast and rotates. Here the engine solves the contacts without restitution, and the velocities
//! after its step are then corrected until every point that approached faster than [`SLOWEST_M_S`] leaves with its fraction of that
//! speed, and no contact point approaches faster than before (Newton's hypothesis, by projected Gauss-Seidel over all points).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix3, Vector3};
use rapier3d_f64::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier3d_f64::geometry::{ColliderHandle, ColliderSet, NarrowPhase};

use super::contact_facts::from_user_data;
use super::convert::{from_engine_pose, from_vector, vector};
use super::engine_settings::SURFACE;
use crate::dynamics::crba::Crba;
use crate::kinematics::body_motion::BodyMotions;
use crate::model::contact::{ContactFact, Party};
use crate::model::robot::Robot;
use crate::model::scene::{BodyKind, Scene};

/// Slower than this nothing bounces: twice the speed that gravity adds in a step of 1 ms, so that resting bodies stay at rest \[m/s\].
const SLOWEST_M_S: f64 = 0.02;
/// Iterations over all points: the corners of a face then agree to 1e-6.
const PASSES: usize = 200;
/// An iteration that changes no velocity by more than this is the last \[m/s\].
const SETTLED_M_S: f64 = 1e-12;

/// The restitutions of one world, and its velocities before the step.
pub(super) struct Bounce {
    of_links: Vec<f64>,
    of_bodies: Vec<f64>,
    of_ground: f64,
    /// Of dynamic bodies the inverse mass \[1/kg\] and the inverse tensor about the centre of mass, in the body's axes \[1/(kg m²)\].
    inverse: Vec<Option<(f64, Matrix3<f64>)>>,
    /// Of dynamic bodies the velocity of the centre of mass and the angular velocity before the step, world axes.
    before: Vec<(Vector3<f64>, Vector3<f64>)>,
    arm_before: BodyMotions,
    arm_after: BodyMotions,
}

/// One side of a contact point.
enum End {
    /// A party that the bounce does not move, with its velocity along the normal \[m/s\].
    Driven(f64),
    /// A dynamic body by its index, and the vector from its centre of mass to the point.
    Free(usize, Vector3<f64>),
    /// A link: its point's velocity along the normal is `row · qd`, and an impulse there changes `qd` by `solved`.
    Arm { row: Vec<f64>, solved: DVector<f64> },
}

/// A contact point with a normal force, as the engine leaves it.
struct Touch {
    /// The parties, in the engine's order.
    parties: [Party; 2],
    /// World axes \[m\].
    p: Vector3<f64>,
    /// The normal, from the first party to the second.
    normal: Vector3<f64>,
}

/// A contact point whose normal velocity an impulse can change.
struct Point {
    touch: Touch,
    ends: [End; 2],
    /// Change of the speed along the normal by an impulse of one \[1/kg\].
    softness: f64,
    /// The least speed along the normal after the bounce \[m/s\].
    least_m_s: f64,
    impulse_n_s: f64,
}

/// The bodies of the scene after the engine's step, before any of them bounces.
struct BodiesAfter<'a> {
    bodies: &'a RigidBodySet,
    handles: &'a [RigidBodyHandle],
    /// Centres of mass, world axes \[m\].
    coms: Vec<Vector3<f64>>,
}

impl<'a> BodiesAfter<'a> {
    fn new(bodies: &'a RigidBodySet, handles: &'a [RigidBodyHandle]) -> Self {
        Self {
            bodies,
            handles,
            coms: handles
                .iter()
                .map(|handle| from_vector(bodies[*handle].center_of_mass()))
                .collect(),
        }
    }

    /// The velocity of the body's matter at `p`, world axes \[m/s\].
    fn velocity_at(&self, index: usize, p: &Vector3<f64>) -> Vector3<f64> {
        from_vector(self.bodies[self.handles[index]].velocity_at_point(vector(p)))
    }
}

/// Velocities of dynamic bodies and joints during the iteration.
struct Velocities {
    free: Vec<(Vector3<f64>, Vector3<f64>)>,
    /// Inverse mass and inverse inertia tensor in world axes.
    inverse: Vec<Option<(f64, Matrix3<f64>)>>,
    qd: Vec<f64>,
}

impl Velocities {
    fn along(&self, end: &End, normal: &Vector3<f64>) -> f64 {
        match end {
            End::Driven(speed) => *speed,
            End::Free(index, r) => {
                let (v, w) = &self.free[*index];
                normal.dot(&(v + w.cross(r)))
            }
            End::Arm { row, .. } => row.iter().zip(&self.qd).map(|(g, qd)| g * qd).sum(),
        }
    }

    fn softness(&self, end: &End, normal: &Vector3<f64>) -> f64 {
        match end {
            End::Driven(_) => 0.0,
            End::Free(index, r) => self.inverse[*index].map_or(0.0, |(inverse_mass, inverse)| {
                let lever = r.cross(normal);
                inverse_mass + lever.dot(&(inverse * lever))
            }),
            End::Arm { row, solved } => row.iter().zip(solved.iter()).map(|(g, s)| g * s).sum(),
        }
    }

    fn push(&mut self, end: &End, impulse: &Vector3<f64>, along: f64) {
        match end {
            End::Driven(_) => {}
            End::Free(index, r) => {
                if let Some((inverse_mass, inverse)) = self.inverse[*index] {
                    let (v, w) = &mut self.free[*index];
                    *v += impulse * inverse_mass;
                    *w += inverse * r.cross(impulse);
                }
            }
            End::Arm { solved, .. } => {
                for (qd, solved) in self.qd.iter_mut().zip(solved.iter()) {
                    *qd += solved * along;
                }
            }
        }
    }
}

/// The arm after the engine's step, where it is in the world and can be moved.
pub(super) struct ArmAfter<'a> {
    pub(super) q: &'a [f64],
    pub(super) qd: &'a mut [f64],
}

impl Bounce {
    /// The bounces of `robot` in `scene`; `None` if all restitutions are zero.
    pub(super) fn new(robot: &Robot, scene: &Scene) -> Option<Self> {
        let of_links: Vec<f64> = robot
            .links()
            .iter()
            .map(|link| link.contact.unwrap_or(SURFACE).restitution)
            .collect();
        let of_bodies: Vec<f64> = scene.bodies.iter().map(|b| b.contact.restitution).collect();
        let of_ground = scene
            .environment
            .ground
            .map_or(0.0, |ground| ground.restitution);
        let bounces = {
            let mut all = of_links.iter().chain(&of_bodies).chain([&of_ground]);
            all.any(|restitution| *restitution > 0.0)
        };
        bounces.then(|| Self {
            inverse: scene
                .bodies
                .iter()
                .map(|body| {
                    let inverse = body.inertia.about_com_kg_m2.to_matrix().try_inverse()?;
                    let free = matches!(body.kind, BodyKind::Free);
                    free.then_some((1.0 / body.inertia.mass_kg, inverse))
                })
                .collect(),
            before: vec![(Vector3::zeros(), Vector3::zeros()); of_bodies.len()],
            arm_before: BodyMotions::new(robot),
            arm_after: BodyMotions::new(robot),
            of_links,
            of_bodies,
            of_ground,
        })
    }

    /// Records all velocities before a step.
    pub(super) fn remember(
        &mut self,
        robot: &Robot,
        q: &[f64],
        qd: &[f64],
        bodies: &RigidBodySet,
        handles: &[RigidBodyHandle],
    ) {
        // a world may be stepped without its arm
        if q.len() == robot.n() {
            self.arm_before.update(robot, q, qd);
        }
        for (before, handle) in self.before.iter_mut().zip(handles) {
            let body = &bodies[*handle];
            *before = (from_vector(body.linvel()), from_vector(body.angvel()));
        }
    }

    fn of(&self, party: Party) -> f64 {
        match party {
            Party::Link(index) => self.of_links[index],
            Party::Body(index) => self.of_bodies[index],
            Party::Ground => self.of_ground,
        }
    }

    /// Bounces everything that approached fast enough: changes velocities of bodies and of `arm`, and adds to `facts`.
    #[expect(
        clippy::too_many_arguments,
        reason = "what one step of the engine leaves"
    )]
    pub(super) fn apply(
        &mut self,
        robot: &Robot,
        mut arm: Option<ArmAfter<'_>>,
        narrow_phase: &NarrowPhase,
        colliders: &ColliderSet,
        bodies: &mut RigidBodySet,
        handles: &[RigidBodyHandle],
        dt_s: f64,
        facts: &mut [ContactFact],
    ) {
        let touches = pressed(narrow_phase, colliders, bodies);
        let after = BodiesAfter::new(bodies, handles);
        let leaves = self.leaves_m_s(robot, &after, &touches);
        if !leaves.iter().flatten().any(|out| *out > 0.0) {
            return;
        }
        let mut velocities = self.velocities(&after, arm.as_ref());
        let mass = self.arm_mass(robot, arm.as_ref());
        let mut points = Vec::new();
        for (touch, leaves_m_s) in touches.into_iter().zip(leaves) {
            let ends = touch
                .parties
                .map(|party| self.end(robot, &after, mass.as_ref(), party, &touch));
            points.extend(Point::new(touch, ends, leaves_m_s, &velocities));
        }
        settle(&mut points, &mut velocities);
        self.move_bodies(&velocities, bodies, handles);
        if let Some(arm) = &mut arm {
            arm.qd.copy_from_slice(&velocities.qd);
        }
        for point in points.iter().filter(|point| point.impulse_n_s > 0.0) {
            record_bounce(point, dt_s, facts);
        }
    }

    /// The normal speed with which each contact that approached fast enough should leave \[m/s\]; the larger restitution counts.
    fn leaves_m_s(
        &self,
        robot: &Robot,
        after: &BodiesAfter<'_>,
        touches: &[Touch],
    ) -> Vec<Option<f64>> {
        let leaves = |touch: &Touch| {
            let velocity = |party| self.velocity_before(robot, after, party, &touch.p);
            let [first, second] = touch.parties.map(velocity);
            let came_in = touch.normal.dot(&(second - first));
            let [first, second] = touch.parties.map(|party| self.of(party));
            (came_in < -SLOWEST_M_S).then(|| -came_in * first.max(second))
        };
        touches.iter().map(leaves).collect()
    }

    /// The velocity that `party` had at `p` before the step, world axes \[m/s\]. A kinematic body follows its prescribed motion, and so
    /// still has that velocity.
    fn velocity_before(
        &self,
        robot: &Robot,
        after: &BodiesAfter<'_>,
        party: Party,
        p: &Vector3<f64>,
    ) -> Vector3<f64> {
        match party {
            Party::Ground => Vector3::zeros(),
            Party::Link(index) => {
                let motion = self.arm_before.of(&robot.links()[index].attachment);
                motion.at(&(p - motion.placed.position)).velocity
            }
            Party::Body(index) if self.inverse[index].is_some() => {
                let (v, w) = &self.before[index];
                v + w.cross(&(p - after.coms[index]))
            }
            Party::Body(index) => after.velocity_at(index, p),
        }
    }

    /// The velocities after the engine's step, from which the iteration starts, world axes.
    fn velocities(&self, after: &BodiesAfter<'_>, arm: Option<&ArmAfter<'_>>) -> Velocities {
        let (bodies, handles) = (after.bodies, after.handles);
        Velocities {
            free: handles
                .iter()
                .map(|handle| {
                    let body = &bodies[*handle];
                    (from_vector(body.linvel()), from_vector(body.angvel()))
                })
                .collect(),
            inverse: self
                .inverse
                .iter()
                .zip(handles)
                .map(|(inverse, handle)| {
                    let turn = from_engine_pose(bodies[*handle].position()).rotation;
                    let turn = *turn.matrix();
                    inverse.map(|(mass, tensor)| (mass, turn * tensor * turn.transpose()))
                })
                .collect(),
            qd: arm.map_or_else(Vec::new, |arm| arm.qd.to_vec()),
        }
    }

    /// The factor of the arm's mass matrix in the configuration after the step, to which `arm_after` is moved too. Without it the arm
    /// counts as kinematic; so does an arm with closed loops, for which the mass matrix alone does not give the effect of an impulse.
    fn arm_mass(
        &mut self,
        robot: &Robot,
        arm: Option<&ArmAfter<'_>>,
    ) -> Option<Cholesky<f64, Dyn>> {
        let arm = arm.filter(|_| robot.loops().is_empty())?;
        self.arm_after.update(robot, arm.q, arm.qd);
        let mut mass = DMatrix::zeros(robot.n(), robot.n());
        Crba::new(robot).fill(robot, arm.q, &mut mass);
        mass.cholesky()
    }

    /// The side of `party` at `touch`.
    fn end(
        &self,
        robot: &Robot,
        after: &BodiesAfter<'_>,
        mass: Option<&Cholesky<f64, Dyn>>,
        party: Party,
        touch: &Touch,
    ) -> End {
        let Touch { p, normal, .. } = touch;
        match (party, mass) {
            (Party::Ground, _) => End::Driven(0.0),
            (Party::Body(index), _) if self.inverse[index].is_some() => {
                End::Free(index, p - after.coms[index])
            }
            (Party::Link(index), Some(mass)) => match robot.links()[index].attachment.body {
                None => End::Driven(0.0),
                Some(body) => {
                    let row = self.row(robot, body, p, normal);
                    let mut solved = DVector::from_column_slice(&row);
                    mass.solve_mut(&mut solved);
                    End::Arm { row, solved }
                }
            },
            (Party::Body(_), _) | (Party::Link(_), None) => {
                End::Driven(normal.dot(&self.velocity_before(robot, after, party, p)))
            }
        }
    }

    /// Sets the velocities of the dynamic bodies after the bounce, and wakes those that it moved.
    fn move_bodies(
        &self,
        velocities: &Velocities,
        bodies: &mut RigidBodySet,
        handles: &[RigidBodyHandle],
    ) {
        for (index, handle) in handles.iter().enumerate() {
            if self.inverse[index].is_some() {
                let (v, w) = velocities.free[index];
                let body = &mut bodies[*handle];
                let moved = from_vector(body.linvel()) != v || from_vector(body.angvel()) != w;
                if moved {
                    body.set_linvel(vector(&v), true);
                    body.set_angvel(vector(&w), true);
                }
            }
        }
    }

    /// `row · qd` is the speed along `normal` of the point `p` of body `body`.
    fn row(&self, robot: &Robot, body: usize, p: &Vector3<f64>, normal: &Vector3<f64>) -> Vec<f64> {
        let mut row = vec![0.0; robot.n()];
        let mut next = Some(body);
        while let Some(index) = next {
            let body = &robot.bodies()[index];
            let placed = &self.arm_after.body(index).placed;
            let axis = placed.axis();
            let velocity = if body.turns {
                axis.cross(&(p - placed.position))
            } else {
                axis
            };
            row[body.q_index] += body.gear * normal.dot(&velocity);
            next = body.parent;
        }
        row
    }
}

impl Point {
    /// `None` if no impulse changes the normal velocity at the contact. A contact that did not approach fast enough to bounce keeps its
    /// velocity, or is brought to rest.
    fn new(
        touch: Touch,
        ends: [End; 2],
        leaves_m_s: Option<f64>,
        velocities: &Velocities,
    ) -> Option<Self> {
        let normal = &touch.normal;
        let softness: f64 = ends
            .iter()
            .map(|end| velocities.softness(end, normal))
            .sum();
        let now = velocities.along(&ends[1], normal) - velocities.along(&ends[0], normal);
        (softness > 0.0).then(|| Self {
            touch,
            least_m_s: leaves_m_s.unwrap_or(now.min(0.0)),
            ends,
            softness,
            impulse_n_s: 0.0,
        })
    }
}

/// Finds impulses that give every point at least its required speed, none of them pulling (projected Gauss-Seidel), and applies them to
/// `velocities`.
fn settle(points: &mut [Point], velocities: &mut Velocities) {
    for _ in 0..PASSES {
        let mut changed_m_s = 0.0_f64;
        for point in &mut *points {
            let [first, second] = &point.ends;
            let normal = &point.touch.normal;
            let now = velocities.along(second, normal) - velocities.along(first, normal);
            let wanted = point.impulse_n_s + (point.least_m_s - now) / point.softness;
            let change = wanted.max(0.0) - point.impulse_n_s;
            point.impulse_n_s += change;
            changed_m_s = changed_m_s.max((change * point.softness).abs());
            let impulse = normal * change;
            velocities.push(second, &impulse, change);
            velocities.push(first, &-impulse, -change);
        }
        if changed_m_s <= SETTLED_M_S {
            break;
        }
    }
}

/// All contact points with a normal force, in the engine's order.
fn pressed(
    narrow_phase: &NarrowPhase,
    colliders: &ColliderSet,
    bodies: &RigidBodySet,
) -> Vec<Touch> {
    let party = |handle: ColliderHandle| {
        let collider = colliders.get(handle)?;
        Some(from_user_data(collider.user_data))
    };
    let mut points = Vec::new();
    for pair in narrow_phase.contact_pairs() {
        let (Some(first), Some(second)) = (party(pair.collider1), party(pair.collider2)) else {
            continue;
        };
        for manifold in pair.solver_manifolds() {
            let normal = from_vector(manifold.data.normal);
            for contact in &manifold.data.solver_contacts {
                let [id] = contact.contact_indices();
                let presses = manifold
                    .points
                    .get(id as usize)
                    .is_some_and(|point| point.data.impulse > 0.0);
                if presses {
                    let (a, b) = manifold.data.solver_contact_world_points(contact, bodies);
                    points.push(Touch {
                        parties: [first, second],
                        p: from_vector((a + b) * 0.5),
                        normal,
                    });
                }
            }
        }
    }
    points
}

/// Adds the impulse of a bounce to the contact of its pair.
fn record_bounce(point: &Point, dt_s: f64, facts: &mut [ContactFact]) {
    let touch = &point.touch;
    let [first, second] = touch.parties;
    let (parties, sign) = if first > second {
        ([second, first], -1.0)
    } else {
        ([first, second], 1.0)
    };
    if let Some(fact) = facts.iter_mut().find(|fact| fact.parties == parties) {
        let on_second = touch.normal * (sign * point.impulse_n_s);
        fact.impulse_n_s += point.impulse_n_s;
        fact.normal_impulse_n_s += on_second;
        fact.moment_impulse_n_m_s += touch.p.cross(&on_second);
        fact.force_n += point.impulse_n_s / dt_s;
    }
}
