//! The world of one run: the scene's bodies and the robot's links, stepped together.
//!
//! A step is a drift, a kick and a drift: everything moves freely, impulses act at one time within the step, everything moves on. The
//! robot's free motion comes from the smooth step; that of a body is exact for constant forces and conserves its momentum. The kick is
//! in the middle of the step, or when the first surfaces meet that were apart.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::BoundingVolume as _;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::SharedShape;

use super::arm::Arm;
use super::clearance::Obstacle;
use super::collider::shape_of;
use super::contacts::{Contacts, Movers};
use super::convert::{engine_pose, from_vector};
use super::engine_error::EngineError;
use super::engine_settings::{self, SURFACE};
use super::free_body::FreeBody;
use super::pairs::{Carrier, Collider, Pairs, vertices};
use super::ray::Ray;
use super::rest;
use super::wind::Air;
use super::{contact_facts, work};
use crate::model::air::{AirNow, Drag};
use crate::model::contact::{ContactFact, Party};
use crate::model::prescribed_motion::Motion;
use crate::model::push::{Push, Pushed};
use crate::model::robot::Robot;
use crate::model::scene::{BodyKind, Scene, SceneBody};
use crate::spatial::{Pose, Twist};

/// Pose and twist of a body of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    /// The pose of its frame in the world.
    pub world_from_body: Pose,
    /// Its motion, world axes, at the origin of its frame.
    pub twist: Twist,
    /// Whether it has rested so long that it is no longer stepped; such a body does not move at all.
    pub sleeps: bool,
}

/// Triangles of surfaces that may be near moving shapes at once: more would need gigabytes.
const MOST_TRIANGLES_NEAR: usize = 500_000;

/// A step that was not done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StepFault {
    /// The state of a body, by its index, is no longer finite.
    Lost(Option<usize>),
    /// More triangles of surfaces are near what moves than memory would do for.
    TooManyTriangles,
}

/// A body that follows a prescribed motion.
pub(super) struct Driven {
    motion: Motion,
    /// Its pose now, and at the end of the step.
    pub(super) now: Pose,
    pub(super) next: Pose,
    pub(super) twist: Twist,
}

impl Driven {
    pub(super) fn moves(&self) -> bool {
        self.next != self.now
    }

    /// Displacement in the step of its matter at `p`, world axes \[m\].
    pub(super) fn displacement(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let here = self.now.inverse_transform_point(&(*p).into());
        (self.next * here).coords - p
    }

    /// Velocity of its matter at `p` at the end of the step, world axes \[m/s\].
    pub(super) fn velocity(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let origin = self.next.translation.vector;
        self.twist.linear + self.twist.angular.cross(&(p - origin))
    }
}

/// What a body of the scene is here.
#[derive(Debug, Clone, Copy)]
enum Place {
    Fixed(Pose),
    Driven(usize),
    Free(usize),
}

/// The free motion of the robot in a step, which contact changes; all slices have shape `(n)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmStep<'a> {
    pub(crate) q: &'a [f64],
    pub(crate) qd: &'a [f64],
    /// The state at the end of the step without contact, dry friction and joint limits.
    pub(crate) next_q: &'a [f64],
    pub(crate) next_qd: &'a [f64],
    /// No link travels farther than about this \[m\].
    pub(crate) travel_m: f64,
    /// Whether contact changes its motion; else it pushes aside what gives, and passes through the rest.
    pub(crate) gives: bool,
}

/// All bodies of one run.
pub(crate) struct World {
    gravity_m_s2: Vector3<f64>,
    arm: Option<Arm>,
    colliders: Vec<Collider>,
    pairs: Pairs,
    places: Vec<Place>,
    free: Vec<FreeBody>,
    driven: Vec<Driven>,
    /// The dynamic bodies with drag.
    blown: Vec<(usize, Drag)>,
    /// The forces of pushes on dynamic bodies in the next step, world axes \[N\].
    pushed: Vec<(usize, Vector3<f64>)>,
    /// The shapes that are surfaces of triangles, where so many triangles could be near moving shapes that memory would not do.
    surfaces: Vec<usize>,
    contacts: Contacts,
    /// The shapes that moved in the last step.
    moved: Vec<usize>,
    air: Option<Air>,
    dt_s: f64,
    tick: u64,
    /// What all steps cost so far ([`super::work`]).
    work: u64,
}

impl World {
    /// Puts `scene` and `robot`, its moving part only if `with_arm`, into a world with steps of `dt_s`.
    ///
    /// # Errors
    /// Shapes or masses that the engine cannot use.
    pub(crate) fn new(
        robot: &Robot,
        scene: &Scene,
        gravity_m_s2: &Vector3<f64>,
        dt_s: f64,
        with_arm: bool,
    ) -> Result<Self, EngineError> {
        let air = scene
            .environment
            .wind
            .as_ref()
            .map(|wind| Air::new(wind, dt_s));
        let mut world = Self {
            gravity_m_s2: *gravity_m_s2,
            arm: (with_arm && robot.n() > 0).then(|| Arm::new(robot, dt_s)),
            colliders: links(robot, with_arm)?,
            pairs: Pairs::default(),
            places: Vec::new(),
            free: Vec::new(),
            driven: Vec::new(),
            blown: Vec::new(),
            pushed: Vec::new(),
            surfaces: Vec::new(),
            contacts: Contacts::new(robot, dt_s),
            moved: Vec::new(),
            air,
            dt_s,
            tick: 0,
            work: 0,
        };
        if let Some(surface) = scene.environment.ground {
            let ground = (
                SharedShape::halfspace(Vector::Z),
                engine_pose(&Pose::identity()),
            );
            let ground = Collider::new(Party::Ground, Carrier::World, surface, ground);
            world.colliders.push(ground);
        }
        for (index, body) in scene.bodies.iter().enumerate() {
            world.insert(index, body)?;
        }
        world.pairs = Pairs::new(&world.colliders);
        world.list_surfaces();
        Ok(world)
    }

    fn insert(&mut self, index: usize, body: &SceneBody) -> Result<(), EngineError> {
        let pose = body.world_from_body;
        let (place, carrier) = match &body.kind {
            BodyKind::Fixed => (Place::Fixed(pose), Carrier::World),
            BodyKind::Kinematic(motion) => {
                let (now, twist) = motion.at(0.0);
                self.driven.push(Driven {
                    motion: motion.clone(),
                    now,
                    next: now,
                    twist,
                });
                let index = self.driven.len() - 1;
                (Place::Driven(index), Carrier::Driven(index))
            }
            BodyKind::Free => {
                // a body in gusts must not sleep: it would not react to the next gust
                let gusts = self.air.as_ref().is_some_and(Air::gusts);
                let restless = body.drag.is_some() && gusts;
                self.free.push(FreeBody::new(index, body, restless)?);
                let free = self.free.len() - 1;
                self.blown.extend(body.drag.map(|drag| (free, drag)));
                (Place::Free(free), Carrier::Free(free))
            }
        };
        self.places.push(place);
        let now = match place {
            Place::Driven(driven) => self.driven[driven].now,
            _ => pose,
        };
        for shape in &body.shapes {
            let shape = shape_of(&body.name, shape, &Pose::identity())?;
            let party = Party::Body(index);
            let mut collider = Collider::new(party, carrier, body.contact, shape);
            collider.place(&engine_pose(&now));
            if let Place::Free(free) = place {
                self.free[free].cover(&collider.bounds);
            }
            self.colliders.push(collider);
        }
        Ok(())
    }

    /// Lists the surfaces, unless what moves can never be near too many of their triangles.
    fn list_surfaces(&mut self) {
        let triangles = |collider: &Collider| {
            let surface = collider.shape.as_trimesh();
            surface.map_or(0, |surface| surface.indices().len())
        };
        let all: usize = self.colliders.iter().map(triangles).sum();
        let moving = self
            .colliders
            .iter()
            .filter(|one| matches!(one.carrier, Carrier::Free(_) | Carrier::Arm(_)));
        if all.saturating_mul(moving.count()) > MOST_TRIANGLES_NEAR {
            let surfaces = self.colliders.iter().enumerate();
            let surfaces = surfaces.filter(|(_, one)| triangles(one) > 0);
            self.surfaces = surfaces.map(|(index, _)| index).collect();
        }
    }

    /// Whether more triangles of surfaces are near what moves than memory would do for.
    fn has_too_many_triangles_near(&self, with_arm: bool, ahead_m: f64) -> bool {
        let mut near = 0;
        for surface in self.surfaces.iter().map(|index| &self.colliders[*index]) {
            let Some(mesh) = surface.shape.as_trimesh() else {
                continue;
            };
            for moving in &self.colliders {
                let moves = match moving.carrier {
                    Carrier::Free(index) => !self.free[index].sleeps,
                    Carrier::Arm(_) => with_arm,
                    Carrier::World | Carrier::Driven(_) => false,
                };
                if !moves {
                    continue;
                }
                let here_from_moving = surface.world_from_shape.inv_mul(&moving.world_from_shape);
                let bounds = moving.shape.compute_aabb(&here_from_moving);
                let bounds = bounds.loosened(ahead_m);
                // one more shows that there are too many
                let left = MOST_TRIANGLES_NEAR + 1 - near;
                near += mesh.bvh().intersect_aabb(&bounds).take(left).count();
                if near > MOST_TRIANGLES_NEAR {
                    return true;
                }
            }
        }
        false
    }

    /// Whether something in the scene moves, or has not rested long enough to be left alone.
    pub(crate) fn is_awake(&self) -> bool {
        !self.driven.is_empty() || self.free.iter().any(|body| !body.sleeps)
    }

    /// Lists the obstacles that a link could touch, at their current poses.
    pub(crate) fn obstacles(&self, list: &mut Vec<Obstacle>) {
        for collider in &self.colliders {
            match collider.party {
                Party::Link(_) => {}
                Party::Ground => list.push(Obstacle::Ground),
                Party::Body(_) => list.push(Obstacle::Box([
                    from_vector(collider.bounds.mins),
                    from_vector(collider.bounds.maxs),
                ])),
            }
        }
    }

    /// The air of the next step, if there is any.
    pub(crate) fn air_now(&self) -> Option<AirNow> {
        self.air.as_ref().map(Air::now)
    }

    /// Advances only the air by one step.
    pub(crate) fn rest(&mut self) {
        self.tick += 1;
        if let Some(air) = &mut self.air {
            air.advance();
        }
    }

    /// Steps all bodies and the robot, whose free motion is `arm`, and writes the contacts; without `arm` the robot can touch nothing.
    ///
    /// # Errors
    /// [`StepFault`].
    pub(crate) fn step(
        &mut self,
        robot: &Robot,
        arm: Option<ArmStep<'_>>,
        facts: &mut Vec<ContactFact>,
    ) -> Result<(), StepFault> {
        let arm = arm.filter(|_| self.arm.is_some());
        let end_s = (self.tick + 1) as f64 * self.dt_s;
        for driven in &mut self.driven {
            (driven.next, driven.twist) = driven.motion.at(end_s);
        }
        if let (Some(arm), Some(links)) = (&arm, &mut self.arm) {
            links.place(robot, arm.q, arm.qd);
        }
        let travel_m = self.travel_m().max(arm.map_or(0.0, |arm| arm.travel_m));
        let ahead_m = (travel_m * engine_settings::PREDICTION_OF_TRAVEL).clamp(
            engine_settings::PREDICTION_M,
            engine_settings::PREDICTION_MOST_M,
        );
        self.place_links(arm.is_some());
        if !self.surfaces.is_empty() && self.has_too_many_triangles_near(arm.is_some(), ahead_m) {
            return Err(StepFault::TooManyTriangles);
        }
        self.load();
        loop {
            self.look(arm.map(|arm| arm.gives), ahead_m);
            if !self.wake() {
                break;
            }
        }
        if let (Some(arm), Some(links)) = (&arm, &mut self.arm) {
            links.advance_to_middle(robot, arm.q, arm.qd, arm.next_q);
        }
        let mut movers = Movers {
            robot,
            arm: self.arm.as_mut().filter(|_| arm.is_some()),
            free: &mut self.free,
            driven: &self.driven,
        };
        self.contacts.solve(
            &mut movers,
            arm.as_ref(),
            &self.colliders,
            &mut self.pairs,
            travel_m,
        );
        self.work += self.work_of_step();
        contact_facts::read(&self.pairs, &self.colliders, self.dt_s, facts);
        self.finish()
    }

    /// Sets the pushes in effect during the next step, and wakes what they are on.
    pub(crate) fn set_pushes<'p>(&mut self, pushes: impl Iterator<Item = &'p Push>) {
        self.pushed.clear();
        for push in pushes {
            let Pushed::Body(body) = push.on else {
                continue;
            };
            let Place::Free(index) = self.places[body] else {
                continue;
            };
            self.pushed.push((index, push.force_n));
            let (sleeps, island) = (self.free[index].sleeps, self.free[index].island);
            let together = self
                .free
                .iter_mut()
                .filter(|one| one.sleeps && one.island == island);
            if sleeps {
                together.for_each(FreeBody::wake);
            }
        }
    }

    /// Sets the accelerations of the dynamic bodies: gravity, drag and pushes.
    fn load(&mut self) {
        for body in &mut self.free {
            body.acceleration_m_s2 = self.gravity_m_s2;
        }
        if let Some(air) = self.air_now() {
            for (index, drag) in &self.blown {
                let body = &mut self.free[*index];
                let past = air.velocity_m_s - body.v;
                let force = air.drag_n(drag, &body.v);
                // drag strong enough to stop a body within a step would throw it back
                let most_n = body.mass_kg * past.norm() / self.dt_s;
                let force = force * (most_n / force.norm().max(most_n).max(f64::MIN_POSITIVE));
                body.acceleration_m_s2 += force / body.mass_kg;
            }
        }
        for (index, force) in &self.pushed {
            let body = &mut self.free[*index];
            body.acceleration_m_s2 += force / body.mass_kg;
        }
    }

    fn place_links(&mut self, with_arm: bool) {
        let Some(arm) = self.arm.as_ref().filter(|_| with_arm) else {
            return;
        };
        for collider in &mut self.colliders {
            if let Carrier::Arm(body) = collider.carrier {
                let placed = arm.placed(body);
                let pose = crate::spatial::pose(placed.world_from_body, placed.position);
                collider.place(&engine_pose(&pose));
            }
        }
        let of_arm = |index: &usize| matches!(self.colliders[*index].carrier, Carrier::Arm(_));
        let moved = (0..self.colliders.len()).filter(of_arm);
        self.pairs.sort(&self.colliders, moved);
    }

    /// Finds all contact points of what moves; the robot takes part if `arm_gives` says whether it gives way.
    fn look(&mut self, arm_gives: Option<bool>, ahead_m: f64) {
        let with_arm = arm_gives.is_some();
        let arm_gives = arm_gives == Some(true);
        let (free, driven) = (&self.free, &self.driven);
        let moves = |collider: &Collider| match collider.carrier {
            Carrier::World => false,
            Carrier::Driven(index) => driven[index].moves(),
            Carrier::Free(index) => !free[index].sleeps,
            Carrier::Arm(_) => with_arm,
        };
        let meet = |first: &Collider, second: &Collider| {
            let is_link = |one: &Collider| matches!(one.party, Party::Link(_));
            let absent = |one: &Collider| matches!(one.carrier, Carrier::Arm(_)) && !with_arm;
            let gives = |one: &Collider| match one.carrier {
                Carrier::Free(_) => true,
                Carrier::Arm(_) => arm_gives,
                Carrier::World | Carrier::Driven(_) => false,
            };
            first.carrier != second.carrier
                && !(is_link(first) && is_link(second))
                && !(absent(first) || absent(second))
                && (gives(first) || gives(second))
        };
        self.pairs.find(&self.colliders, ahead_m, moves, meet);
    }

    /// Wakes what sleeps and is hit, or loses its support; whether anything woke.
    fn wake(&mut self) -> bool {
        let mut woken = Vec::new();
        for pair in self.pairs.as_slice().iter().filter(|pair| pair.is_fresh) {
            for (this, other) in [(0, 1), (1, 0)] {
                let [this, other] =
                    [this, other].map(|side| self.colliders[pair.colliders[side]].carrier);
                let Carrier::Free(index) = this else {
                    continue;
                };
                if !self.free[index].sleeps {
                    continue;
                }
                // how far the other one can come in this step
                let reach_m = match other {
                    Carrier::World => continue,
                    Carrier::Free(other) => self.free[other].travel_m(self.dt_s),
                    Carrier::Driven(_) | Carrier::Arm(_) => engine_settings::PREDICTION_M,
                };
                let mut points = pair.manifolds.iter().flat_map(|manifold| &manifold.points);
                if points.any(|point| point.dist <= reach_m) {
                    woken.push(self.free[index].island);
                }
            }
        }
        for body in &mut self.free {
            if body.sleeps && woken.contains(&body.island) {
                body.wake();
            }
        }
        !woken.is_empty()
    }

    /// Moves the shapes to the end of the step, and lets rest what rests.
    fn finish(&mut self) -> Result<(), StepFault> {
        self.rest();
        if let Some(lost) = self.free.iter().find(|body| !body.is_finite()) {
            return Err(StepFault::Lost(Some(lost.index)));
        }
        rest::settle(
            &mut self.free,
            &self.driven,
            &self.colliders,
            &self.pairs,
            self.dt_s,
        );
        let moved = |collider: &Collider| match collider.carrier {
            Carrier::World | Carrier::Arm(_) => None,
            Carrier::Driven(index) => {
                let driven = &self.driven[index];
                driven.moves().then(|| engine_pose(&driven.next))
            }
            Carrier::Free(index) => {
                let body = &self.free[index];
                (!body.sleeps).then(|| engine_pose(&body.pose()))
            }
        };
        self.moved.clear();
        for (index, collider) in self.colliders.iter_mut().enumerate() {
            if let Some(pose) = moved(collider) {
                collider.place(&pose);
                self.moved.push(index);
            }
        }
        self.pairs.sort(&self.colliders, self.moved.iter().copied());
        for driven in &mut self.driven {
            driven.now = driven.next;
        }
        Ok(())
    }

    /// Approximate travel of the fastest point of a dynamic body, or of the origin of a kinematic one, in a step \[m\].
    pub(crate) fn travel_m(&self) -> f64 {
        let mut farthest = 0.0_f64;
        for body in self.free.iter().filter(|body| !body.sleeps) {
            farthest = farthest.max(body.travel_m(self.dt_s));
        }
        for driven in &self.driven {
            farthest = farthest.max(driven.twist.linear.norm() * self.dt_s);
        }
        farthest
    }

    /// The dynamic body whose centre of mass is fastest, with its speed \[m/s\]; `None` if all sleep.
    pub(crate) fn fastest_body(&self) -> Option<(usize, f64)> {
        let awake = self.free.iter().filter(|body| !body.sleeps);
        let speeds = awake.map(|body| (body.index, body.v.norm()));
        speeds.reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    /// Whether any body follows a prescribed motion.
    pub(crate) fn is_driven(&self) -> bool {
        !self.driven.is_empty()
    }

    /// Reads the robot's state after a step in which it was present, shape `(n)` each.
    pub(crate) fn read_arm(&self, q: &mut [f64], qd: &mut [f64]) {
        self.contacts.read_arm(q, qd);
    }

    /// The state of body `index` of the scene.
    pub(crate) fn body(&self, index: usize) -> BodyState {
        match self.places[index] {
            Place::Fixed(pose) => BodyState {
                world_from_body: pose,
                twist: Twist::zero(),
                sleeps: false,
            },
            Place::Driven(index) => BodyState {
                world_from_body: self.driven[index].now,
                twist: self.driven[index].twist,
                sleeps: false,
            },
            Place::Free(index) => self.free[index].state(),
        }
    }

    /// Tests `ray` against the bodies of the scene, in its order, and the ground, at their current poses.
    pub(crate) fn meet(&self, ray: &mut Ray) {
        for collider in &self.colliders {
            if matches!(collider.party, Party::Body(_)) {
                ray.meet_collider(collider);
            }
        }
        if self.colliders.iter().any(|one| one.party == Party::Ground) {
            ray.meet_ground();
        }
    }

    /// What all steps cost so far ([`super::work`]).
    pub(crate) fn work(&self) -> u64 {
        self.work
    }

    /// What the last step cost: bodies and pairs of shapes that are awake, and the sweeps over their points.
    fn work_of_step(&mut self) -> u64 {
        let awake = self.free.iter().filter(|body| !body.sleeps).count() as u64;
        let mut work = awake * work::BODY + self.contacts.take_visits() * work::VISIT;
        for pair in self.pairs.as_slice().iter().filter(|pair| pair.is_fresh) {
            let both = pair.colliders.map(|index| &self.colliders[index].shape);
            let vertices: usize = both.iter().map(|shape| vertices(shape.as_ref())).sum();
            let hulls = 1 + (vertices / work::HULL_VERTICES) as u64;
            // a surface has one for each of its triangles that is near
            let manifolds = &pair.manifolds;
            let touches = |one: &&super::pairs::Manifold| !one.points.is_empty();
            let patches = manifolds.iter().filter(touches).count() as u64;
            work += hulls * work::PAIR * (1 + manifolds.len() as u64) + work::PATCH * patches;
        }
        work
    }

    pub(crate) fn body_count(&self) -> usize {
        self.places.len()
    }
}

/// The shapes of the robot's links; those that move only if `with_arm`.
fn links(robot: &Robot, with_arm: bool) -> Result<Vec<Collider>, EngineError> {
    let mut colliders = Vec::new();
    for (index, link) in robot.links().iter().enumerate() {
        let carrier = match link.attachment.body {
            None => Carrier::World,
            Some(body) if with_arm => Carrier::Arm(body),
            Some(_) => continue,
        };
        for shape in &link.shapes {
            let shape = shape_of(&link.name, shape, &link.attachment.body_from_here)?;
            let surface = link.contact.unwrap_or(SURFACE);
            colliders.push(Collider::new(Party::Link(index), carrier, surface, shape));
        }
    }
    Ok(colliders)
}

/// A right-handed pair of unit vectors across the unit vector `normal`.
pub(super) fn tangents(normal: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = normal.abs().imin();
    let first = normal.cross(&Vector3::ith(least, 1.0)).normalize();
    [first, normal.cross(&first)]
}
