//! The world of one run: the scene's bodies and the robot's multibody, stepped together.

use nalgebra::Vector3;
use rapier3d_f64::dynamics::{MassProperties, RigidBody, RigidBodyBuilder, RigidBodyHandle};
use rapier3d_f64::geometry::{
    Collider, ColliderBuilder, ColliderHandle, ContactManifold, NarrowPhase, Shape, SharedShape,
};
use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::bounding_volume::BoundingVolume as _;
use rapier3d_f64::pipeline::PhysicsWorld;

use super::arm::{Arm, insert_base};
use super::bounce::{ArmAfter, Bounce};
use super::clearance::Obstacle;
use super::collider::collider;
use super::contact_facts::to_user_data;
use super::convert::{engine_pose, from_engine_pose, from_vector, matrix, vector};
use super::engine_error::EngineError;
use super::engine_settings::COMBINE;
use super::ray::Ray;
use super::wind::Air;
use super::{contact_facts, engine_settings, fresh, work};
use crate::model::air::{AirNow, Drag};
use crate::model::contact::{ContactFact, Party};
use crate::model::prescribed_motion::Motion;
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

/// Triangles of surfaces that may be near moving shapes at once: the engine keeps 200 bytes for each.
const MOST_TRIANGLES_NEAR: usize = 500_000;

/// A step that was not done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StepFault {
    /// The state of a body, by its index, is no longer finite.
    Lost(Option<usize>),
    /// More triangles of surfaces are near what moves than memory would do for.
    TooManyTriangles,
}

/// A dynamic body.
#[derive(Clone, Copy)]
struct FreeBody {
    /// Its index in the scene.
    index: usize,
    handle: RigidBodyHandle,
    /// Radius of a sphere about its centre of mass that contains it \[m\].
    radius_m: f64,
    /// What it costs in a step by itself ([`super::work`]).
    work: u64,
}

/// All bodies of one run.
pub(crate) struct World {
    physics: PhysicsWorld,
    arm: Option<Arm>,
    bodies: Vec<RigidBodyHandle>,
    free: Vec<FreeBody>,
    driven: Vec<(RigidBodyHandle, Motion)>,
    blown: Vec<(RigidBodyHandle, Drag)>,
    obstacles: Vec<ColliderHandle>,
    /// The obstacles that are surfaces of triangles, where so many triangles could be near moving shapes that memory would not do.
    surfaces: Vec<ColliderHandle>,
    ground: bool,
    air: Option<Air>,
    /// Present if any party has a restitution.
    bounce: Option<Bounce>,
    /// Joint rates after a bounce, if the arm took part in the step.
    bounced_qd: Option<Vec<f64>>,
    dt_s: f64,
    tick: u64,
    /// What all steps cost so far ([`super::work`]).
    work: u64,
}

impl World {
    /// Puts `scene` and, if `with_arm`, the moving part of `robot` into a world with steps of `dt_s`.
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
        let mut physics = PhysicsWorld {
            gravity: vector(gravity_m_s2),
            integration_parameters: engine_settings::parameters(dt_s),
            narrow_phase: NarrowPhase::with_query_dispatcher(fresh::queries()),
            ..PhysicsWorld::default()
        };
        let root = insert_base(robot, &mut physics)?;
        let arm = if with_arm {
            Arm::insert(robot, root, &mut physics)?
        } else {
            None
        };
        let air = scene
            .environment
            .wind
            .as_ref()
            .map(|wind| Air::new(wind, dt_s));
        let mut world = Self {
            physics,
            arm,
            bodies: Vec::new(),
            free: Vec::new(),
            driven: Vec::new(),
            blown: Vec::new(),
            obstacles: Vec::new(),
            surfaces: Vec::new(),
            ground: scene.environment.ground.is_some(),
            air,
            bounce: Bounce::new(robot, scene),
            bounced_qd: None,
            dt_s,
            tick: 0,
            work: 0,
        };
        if let Some(surface) = scene.environment.ground {
            let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
                .friction(surface.friction)
                .friction_combine_rule(COMBINE)
                .user_data(to_user_data(Party::Ground));
            world.physics.insert_collider(ground, None);
        }
        for (index, body) in scene.bodies.iter().enumerate() {
            world.insert(index, body)?;
        }
        world.list_surfaces();
        Ok(world)
    }

    /// Lists the surfaces, unless what moves can never be near too many of their triangles.
    fn list_surfaces(&mut self) {
        let colliders = &self.physics.colliders;
        let triangles = |handle: &ColliderHandle| {
            let surface = colliders[*handle].shape().as_trimesh();
            surface.map_or(0, |surface| surface.indices().len())
        };
        let all: usize = self.obstacles.iter().map(triangles).sum();
        let moving = self.moving_colliders().count();
        if all.saturating_mul(moving) > MOST_TRIANGLES_NEAR {
            let surfaces = self.obstacles.iter().filter(|one| triangles(one) > 0);
            self.surfaces = surfaces.copied().collect();
        }
    }

    /// What can touch a surface: the shapes of dynamic bodies and of the arm.
    fn moving_colliders(&self) -> impl Iterator<Item = &Collider> {
        let arm = self.arm.iter().flat_map(Arm::handles);
        let free = self.free.iter().map(|body| &body.handle);
        let bodies = arm.chain(free).map(|handle| &self.physics.bodies[*handle]);
        let awake = bodies.filter(|body| body.is_enabled() && !body.is_sleeping());
        let colliders = awake.flat_map(|body| body.colliders());
        colliders.map(|collider| &self.physics.colliders[*collider])
    }

    /// Whether more triangles of surfaces are near what moves than memory would do for.
    fn has_too_many_triangles_near(&self) -> bool {
        let margin_m = self.physics.integration_parameters.prediction_distance();
        let mut near = 0;
        for handle in &self.surfaces {
            let surface = &self.physics.colliders[*handle];
            let Some(mesh) = surface.shape().as_trimesh() else {
                continue;
            };
            let here_from_world = surface.position().inverse();
            for moving in self.moving_colliders() {
                let here_from_moving = here_from_world * *moving.position();
                let bounds = moving.shape().compute_aabb(&here_from_moving);
                let bounds = bounds.loosened(margin_m);
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

    fn insert(&mut self, index: usize, body: &SceneBody) -> Result<(), EngineError> {
        let builder = match &body.kind {
            BodyKind::Fixed => RigidBodyBuilder::fixed(),
            BodyKind::Kinematic(_) => RigidBodyBuilder::kinematic_position_based(),
            BodyKind::Free => {
                RigidBodyBuilder::dynamic().additional_mass_properties(mass_properties(body)?)
            }
        };
        // a body in gusts must not sleep: it would not react to the next gust
        let restless = body.drag.is_some() && self.air.as_ref().is_some_and(Air::gusts);
        let mut rigid: RigidBody = builder
            .pose(engine_pose(&body.world_from_body))
            .gyroscopic_forces_enabled(true)
            .can_sleep(!restless)
            .build();
        if !restless {
            let rest = rigid.activation_mut();
            rest.normalized_linear_threshold = engine_settings::REST_SPEED_M_S;
            rest.time_until_sleep = engine_settings::REST_TIME_S;
        }
        let handle = self.physics.insert_body(rigid);
        for shape in &body.shapes {
            let built = collider(&body.name, shape, &Pose::identity(), body.contact)?
                .user_data(to_user_data(Party::Body(index)));
            let collider = self.physics.insert_collider(built, Some(handle));
            self.obstacles.push(collider);
        }
        match &body.kind {
            BodyKind::Fixed => {}
            BodyKind::Kinematic(motion) => {
                self.driven.push((handle, motion.clone()));
            }
            BodyKind::Free => {
                if let Some(drag) = body.drag {
                    self.blown.push((handle, drag));
                }
                let rigid = &mut self.physics.bodies[handle];
                // the engine's velocity is that of the centre of mass
                let com =
                    from_vector(rigid.center_of_mass()) - body.world_from_body.translation.vector;
                let linear = body.twist.linear + body.twist.angular.cross(&com);
                rigid.set_linvel(vector(&linear), true);
                rigid.set_angvel(vector(&body.twist.angular), true);
                let com = rigid.center_of_mass();
                let radius_m = rigid
                    .colliders()
                    .iter()
                    .map(|collider| {
                        let ball = self.physics.colliders[*collider]
                            .compute_aabb()
                            .bounding_sphere();
                        (ball.center() - com).length() + ball.radius()
                    })
                    .fold(0.0, f64::max);
                let shapes = body.shapes.len() as u64;
                self.free.push(FreeBody {
                    index,
                    handle,
                    radius_m,
                    work: work::BODY + shapes * shapes / work::OWN_PAIRS,
                });
            }
        }
        self.bodies.push(handle);
        Ok(())
    }

    /// Whether something in the scene moves, or has not rested long enough to be left alone.
    pub(crate) fn is_awake(&self) -> bool {
        !self.driven.is_empty()
            || self
                .free
                .iter()
                .any(|body| !self.physics.bodies[body.handle].is_sleeping())
    }

    /// Lists the obstacles that a link could touch, at their current poses.
    pub(crate) fn obstacles(&self, list: &mut Vec<Obstacle>) {
        if self.ground {
            list.push(Obstacle::Ground);
        }
        for handle in &self.obstacles {
            let bounds = self.physics.colliders[*handle].compute_aabb();
            list.push(Obstacle::Box([
                from_vector(bounds.mins),
                from_vector(bounds.maxs),
            ]));
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

    /// Steps all bodies, the robot from `(q, qd)` under `effort`, all finite and of shape `(n)`, and writes the contacts.
    ///
    /// No link travels farther than about `travel_m` in the step; if `None`, the robot can touch nothing and is left out.
    ///
    /// # Errors
    /// [`StepFault`].
    pub(crate) fn step(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &[f64],
        qd: &[f64],
        travel_m: Option<f64>,
        facts: &mut Vec<ContactFact>,
    ) -> Result<(), StepFault> {
        self.foresee(travel_m.unwrap_or(0.0));
        if let Some(arm) = &mut self.arm {
            arm.set_present(&mut self.physics, travel_m.is_some());
            if travel_m.is_some() {
                arm.write(robot, &mut self.physics, effort, q, qd);
            }
        }
        if let Some(air) = self.air_now() {
            for (handle, drag) in &self.blown {
                let body = &mut self.physics.bodies[*handle];
                let past = air.velocity_m_s - from_vector(body.linvel());
                let force = air.drag_n(drag, &from_vector(body.linvel()));
                // drag strong enough to stop a body within a step would throw it back
                let most_n = body.mass() * past.norm() / self.dt_s;
                let force = force * (most_n / force.norm().max(most_n).max(f64::MIN_POSITIVE));
                body.reset_forces(false);
                body.add_force(vector(&force), false);
            }
        }
        let end_s = (self.tick + 1) as f64 * self.dt_s;
        for (handle, motion) in &self.driven {
            let (pose, _) = motion.at(end_s);
            let pose = engine_pose(&pose);
            self.physics.bodies[*handle].set_next_kinematic_position(pose);
        }
        if !self.surfaces.is_empty() && self.has_too_many_triangles_near() {
            return Err(StepFault::TooManyTriangles);
        }
        if let Some(bounce) = &mut self.bounce {
            bounce.remember(robot, q, qd, &self.physics.bodies, &self.bodies);
        }
        self.physics.step();
        self.rest();
        self.work += self.work_of_step();
        if let Some(lost) = self.physics.quarantine().bodies().first() {
            let index = self.bodies.iter().position(|handle| handle == lost);
            return Err(StepFault::Lost(index));
        }
        contact_facts::read(
            &self.physics.narrow_phase,
            &self.physics.colliders,
            &self.physics.bodies,
            self.dt_s,
            facts,
        );
        self.let_bounce(robot, travel_m.is_some(), facts);
        Ok(())
    }

    fn let_bounce(&mut self, robot: &Robot, with_arm: bool, facts: &mut [ContactFact]) {
        let Some(bounce) = &mut self.bounce else {
            return;
        };
        let mut after = None;
        if let Some(arm) = self.arm.as_ref().filter(|_| with_arm) {
            let (mut q, mut qd) = (vec![0.0; robot.n()], vec![0.0; robot.n()]);
            arm.read(&self.physics, &mut q, &mut qd);
            after = Some((q, qd));
        }
        let physics = &mut self.physics;
        bounce.apply(
            robot,
            after.as_mut().map(|(q, qd)| ArmAfter { q, qd }),
            &physics.narrow_phase,
            &physics.colliders,
            &mut physics.bodies,
            &self.bodies,
            self.dt_s,
            facts,
        );
        self.bounced_qd = after.map(|(_, qd)| qd);
    }

    /// Sets the prediction distance of contacts to the travel of the fastest body in a step.
    fn foresee(&mut self, travel_m: f64) {
        let farthest = self.travel_m().max(travel_m) * engine_settings::PREDICTION_OF_TRAVEL;
        self.physics
            .integration_parameters
            .normalized_prediction_distance = farthest.clamp(
            engine_settings::PREDICTION_M,
            engine_settings::PREDICTION_MOST_M,
        );
    }

    /// Approximate travel of the fastest point of a dynamic body, or of the origin of a kinematic one, in a step \[m\].
    pub(crate) fn travel_m(&self) -> f64 {
        let mut farthest = 0.0_f64;
        for body in &self.free {
            let rigid = &self.physics.bodies[body.handle];
            if !rigid.is_sleeping() {
                let speed = rigid.linvel().length() + rigid.angvel().length() * body.radius_m;
                farthest = farthest.max(speed * self.dt_s);
            }
        }
        for (handle, ..) in &self.driven {
            let rigid = &self.physics.bodies[*handle];
            farthest = farthest.max(rigid.linvel().length() * self.dt_s);
        }
        farthest
    }

    /// The dynamic body whose centre of mass is fastest, with its speed \[m/s\]; `None` if all sleep.
    pub(crate) fn fastest_body(&self) -> Option<(usize, f64)> {
        let speeds = self.free.iter().filter_map(|body| {
            let rigid = &self.physics.bodies[body.handle];
            (!rigid.is_sleeping()).then(|| (body.index, rigid.linvel().length()))
        });
        speeds.reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    /// Whether any body follows a prescribed motion.
    pub(crate) fn is_driven(&self) -> bool {
        !self.driven.is_empty()
    }

    /// Reads the robot's state after a step, shape `(n)` each.
    pub(crate) fn read_arm(&self, q: &mut [f64], qd: &mut [f64]) {
        if let Some(arm) = &self.arm {
            arm.read(&self.physics, q, qd);
        }
        if let Some(bounced) = &self.bounced_qd {
            qd.copy_from_slice(bounced);
        }
    }

    /// The state of body `index` of the scene.
    pub(crate) fn body(&self, index: usize) -> BodyState {
        let body = &self.physics.bodies[self.bodies[index]];
        BodyState {
            world_from_body: from_engine_pose(body.position()),
            twist: Twist {
                linear: from_vector(body.velocity_at_point(body.translation())),
                angular: from_vector(body.angvel()),
            },
            sleeps: body.is_sleeping(),
        }
    }

    /// Tests `ray` against the bodies of the scene, in its order, and the ground, at their current poses.
    pub(crate) fn meet(&self, ray: &mut Ray) {
        for handle in &self.bodies {
            let body = &self.physics.bodies[*handle];
            for collider in body.colliders() {
                ray.meet_collider(body.position(), &self.physics.colliders[*collider]);
            }
        }
        if self.ground {
            ray.meet_ground();
        }
    }

    /// What all steps cost so far ([`super::work`]).
    pub(crate) fn work(&self) -> u64 {
        self.work
    }

    /// What the last step cost: bodies and pairs of shapes that are awake.
    fn work_of_step(&self) -> u64 {
        let (bodies, colliders) = (&self.physics.bodies, &self.physics.colliders);
        let is_awake = |handle: &RigidBodyHandle| {
            let body = bodies.get(*handle);
            body.is_some_and(|body| !body.is_fixed() && !body.is_sleeping())
        };
        let free = self.free.iter().filter(|body| is_awake(&body.handle));
        let free: u64 = free.map(|body| body.work).sum();
        let pairs = self.physics.narrow_phase.contact_pairs().map(|pair| {
            let both = [pair.collider1, pair.collider2].map(|handle| colliders.get(handle));
            let mut parents = both.iter().flatten().filter_map(|one| one.parent());
            if !parents.any(|parent| is_awake(&parent)) {
                return 0;
            }
            let vertices = both.iter().flatten().map(|one| vertices(one.shape()));
            let hulls = 1 + (vertices.sum::<usize>() / work::HULL_VERTICES) as u64;
            // a surface has one for each of its triangles that is near
            let manifolds = pair.solver_manifolds();
            let touches = |one: &&ContactManifold| !one.data.solver_contacts.is_empty();
            let patches = manifolds.iter().filter(touches).count() as u64;
            hulls * (work::PAIR * (1 + manifolds.len() as u64) + work::PATCH * patches)
        });
        free + pairs.sum::<u64>()
    }

    pub(crate) fn body_count(&self) -> usize {
        self.bodies.len()
    }
}

/// The vertices of a hull; none of any other shape.
pub(super) fn vertices(shape: &dyn Shape) -> usize {
    let hull = shape.as_convex_polyhedron();
    hull.map_or(0, |hull| hull.points().len())
}

fn mass_properties(body: &SceneBody) -> Result<MassProperties, EngineError> {
    let inertia = &body.inertia;
    let tensor = inertia.about_com_kg_m2.to_matrix();
    let least_kg_m2 = tensor.symmetric_eigenvalues().min();
    if !(inertia.mass_kg > 0.0 && least_kg_m2 > 0.0) {
        return Err(EngineError::Massless {
            body: body.name.clone(),
            mass_kg: inertia.mass_kg,
            least_kg_m2,
        });
    }
    Ok(MassProperties::with_inertia_matrix(
        vector(&inertia.com_m),
        inertia.mass_kg,
        matrix(&tensor),
    ))
}
