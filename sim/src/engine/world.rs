//! The world of one run: the scene's bodies and the robot's multibody, stepped together.

use nalgebra::Vector3;
use rapier3d_f64::dynamics::{MassProperties, RigidBody, RigidBodyBuilder, RigidBodyHandle};
use rapier3d_f64::geometry::{ColliderBuilder, ColliderHandle, NarrowPhase, SharedShape};
use rapier3d_f64::math::Vector;
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
use super::{contact_facts, engine_settings, fresh};
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

/// A dynamic body.
#[derive(Clone, Copy)]
struct FreeBody {
    /// Its index in the scene.
    index: usize,
    handle: RigidBodyHandle,
    /// Radius of a sphere about its centre of mass that contains it \[m\].
    radius_m: f64,
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
    ground: bool,
    air: Option<Air>,
    /// Present if any party has a restitution.
    bounce: Option<Bounce>,
    /// Joint rates after a bounce, if the arm took part in the step.
    bounced_qd: Option<Vec<f64>>,
    dt_s: f64,
    tick: u64,
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
            ground: scene.environment.ground.is_some(),
            air,
            bounce: Bounce::new(robot, scene),
            bounced_qd: None,
            dt_s,
            tick: 0,
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
        Ok(world)
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
                self.free.push(FreeBody {
                    index,
                    handle,
                    radius_m,
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
    /// The index of a body whose state is no longer finite.
    pub(crate) fn step(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &[f64],
        qd: &[f64],
        travel_m: Option<f64>,
        facts: &mut Vec<ContactFact>,
    ) -> Result<(), Option<usize>> {
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
        if let Some(bounce) = &mut self.bounce {
            bounce.remember(robot, q, qd, &self.physics.bodies, &self.bodies);
        }
        self.physics.step();
        self.rest();
        if let Some(lost) = self.physics.quarantine().bodies().first() {
            return Err(self.bodies.iter().position(|handle| handle == lost));
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

    pub(crate) fn body_count(&self) -> usize {
        self.bodies.len()
    }
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
