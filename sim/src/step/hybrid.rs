//! The step in a scene: the free step, and what contact makes of it.
//!
//! Every step is first computed as if there were no scene. If anything in the scene is awake, or a link may come near anything, contact
//! is computed too, on top of that free motion and without what holds the joints in it: dry friction and joint limits are settled
//! together with contact. If something pressed on a moving link, the result is kept; on all other steps the free step is, to the last
//! bit. So free motion has fourth order; motion in contact has the second for a block that slides, and the first where normals turn.
//! The air of a step is the same for links and bodies.

use nalgebra::Vector3;

use super::free::FreeStep;
use super::smooth::Foreseen;
use crate::dynamics::SingularMassMatrix;
use crate::engine::{ArmStep, BodyState, Clearance, EngineError, Ray, StepFault, World};
use crate::model::air::AirNow;
use crate::model::contact::{ContactFact, Party};
use crate::model::push::Push;
use crate::model::robot::Robot;
use crate::model::scene::Scene;

/// Contact may speed up a body within a step by this factor of the fastest motion; beyond it, the contact engine sees a touch one step late.
const FORCES_MARGIN: f64 = 2.0;

/// A step that failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// A joint moves no inertia.
    #[error(transparent)]
    Singular(#[from] SingularMassMatrix),
    /// The motion of a body is no longer finite.
    #[error("the motion of {} is no longer finite; look for overlaps at the start, masses that differ by orders of magnitude, or efforts that are far too large",
        .body.as_ref().map_or_else(|| "a link in contact".to_owned(), |body| format!("body `{body}`")))]
    Lost {
        /// The body of the scene; a link where there is none.
        body: Option<String>,
    },
    /// What moves is near more triangles of a surface than fit into memory.
    #[error("too many triangles of a surface are near what moves: give it a coarser mesh")]
    TooManyTriangles,
}

/// Which integrator's state the robot has after a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StateFrom {
    /// The smooth step's: nothing pressed on a moving link.
    Smooth,
    /// The contact engine's.
    Contact,
}

/// The contacts and limits that acted in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepReport {
    /// Whose state the robot has.
    pub state_from: StateFrom,
    /// Whether the contact engine stepped at all. If not, `contacts` are those of its last step: resting bodies press on as before.
    pub engine_stepped: bool,
    /// The contacts, in the order of their parties.
    pub contacts: Vec<ContactFact>,
    /// The joints on which a position limit acted, with its impulse \[N m s or N s\]; empty when the engine's state is kept.
    pub stops: Vec<(usize, f64)>,
    /// The joints that are on a position limit after the step.
    pub at_limit: Vec<usize>,
}

/// Steps one robot in one scene.
pub struct HybridStep {
    free: FreeStep,
    clearance: Clearance,
    world: World,
    /// Which links move: only what presses on these matters to the robot's state.
    moves: Vec<bool>,
    names: Vec<String>,
    /// Upper bound of what gravity adds to the travel of a dynamic body in one step \[m\].
    falls_m: f64,
    /// The air of the last step.
    air: Option<AirNow>,
    report: StepReport,
}

impl HybridStep {
    /// A step of `dt_s` for `robot` in `scene` under `gravity_m_s2` (world), with the scene's bodies where they start.
    ///
    /// # Errors
    /// Shapes or masses that cannot have contact.
    pub fn new(
        robot: &Robot,
        scene: &Scene,
        gravity_m_s2: Vector3<f64>,
        dt_s: f64,
    ) -> Result<Self, EngineError> {
        let clearance = Clearance::new(robot);
        Ok(Self {
            free: FreeStep::new(robot, gravity_m_s2, dt_s),
            world: World::new(robot, scene, &gravity_m_s2, dt_s, clearance.has_shapes())?,
            clearance,
            moves: robot
                .links()
                .iter()
                .map(|link| link.attachment.body.is_some())
                .collect(),
            names: scene.bodies.iter().map(|body| body.name.clone()).collect(),
            falls_m: 2.0 * gravity_m_s2.norm() * dt_s * dt_s,
            air: None,
            report: StepReport {
                state_from: StateFrom::Smooth,
                engine_stepped: false,
                contacts: Vec::new(),
                stops: Vec::new(),
                at_limit: Vec::new(),
            },
        })
    }

    /// Advances robot and scene by one step under `effort`, held constant; `q` and `qd` become the next state. All have shape `(n)`.
    ///
    /// The caller must check that the state is finite, as after the smooth step alone.
    ///
    /// # Errors
    /// [`StepError`]: a joint without inertia, or a body that flew apart.
    pub fn advance(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<&StepReport, StepError> {
        self.begin();
        self.free.set_air(self.air);
        self.free.advance(robot, effort, q, qd)?;
        self.report.stops.extend_from_slice(self.free.acted());

        let awake = self.world.is_awake();
        let (start_q, _) = self.free.start();
        let near = is_near(
            &mut self.clearance,
            &self.world,
            robot,
            (start_q, q),
            self.falls_m,
        );
        let finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
        let usable = finite(q) && finite(qd) && finite(start_q) && finite(effort);
        self.report.engine_stepped = awake || (near && usable);
        if self.report.engine_stepped {
            self.advance_in_contact(robot, effort, q, qd, near && usable)?;
        } else {
            self.world.rest();
        }
        self.free.list_at_limit(q, &mut self.report.at_limit);
        Ok(&self.report)
    }

    /// Starts a step: nothing has acted yet, and the air is that of the scene.
    fn begin(&mut self) {
        self.report.state_from = StateFrom::Smooth;
        self.report.stops.clear();
        self.report.at_limit.clear();
        self.air = self.world.air_now();
    }

    fn advance_in_contact(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
        near: bool,
    ) -> Result<(), StepError> {
        if near {
            self.free.loosen(robot, effort, q, qd)?;
        }
        let (start_q, start_qd) = self.free.start();
        let (loose_q, loose_qd) = self.free.loose();
        let arm = near.then(|| ArmStep {
            q: start_q,
            qd: start_qd,
            next_q: loose_q,
            next_qd: loose_qd,
            travel_m: self.clearance.travel_m(robot, start_q, loose_q),
            gives: true,
        });
        let facts = &mut self.report.contacts;
        self.world
            .step(robot, arm, facts)
            .map_err(|fault| failed(fault, &self.names))?;
        let pressed = |party: &Party| matches!(party, Party::Link(link) if self.moves[*link]);
        if facts.iter().any(|fact| fact.parties.iter().any(pressed)) {
            self.world.read_arm(q, qd);
            self.free.keep_inside(robot, q, qd)?;
            self.report.state_from = StateFrom::Contact;
            self.report.stops.clear();
        }
        Ok(())
    }

    /// Advances the robot to the state `next`, whatever it meets, and the scene with it; all slices have shape `(n)`.
    ///
    /// What can move is pushed aside. A robot that cannot give way passes through what cannot either: the ground, bodies that are fixed or
    /// kinematic.
    ///
    /// # Errors
    /// [`StepError`]: a body that flew apart.
    pub(crate) fn advance_along(
        &mut self,
        robot: &Robot,
        next: (&[f64], &[f64]),
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<&StepReport, StepError> {
        self.begin();
        let (next_q, next_qd) = next;
        let near = is_near(
            &mut self.clearance,
            &self.world,
            robot,
            (q, next_q),
            self.falls_m,
        );
        self.report.engine_stepped = self.world.is_awake() || near;
        if self.report.engine_stepped {
            let arm = near.then(|| ArmStep {
                q,
                qd,
                next_q,
                next_qd,
                travel_m: self.clearance.travel_m(robot, q, next_q),
                gives: false,
            });
            self.world
                .step(robot, arm, &mut self.report.contacts)
                .map_err(|fault| failed(fault, &self.names))?;
        } else {
            self.world.rest();
        }
        q.copy_from_slice(next_q);
        qd.copy_from_slice(next_qd);
        Ok(&self.report)
    }

    /// Takes accelerations of the robot that are known: a step that starts there need not compute them.
    pub(crate) fn foresee(&mut self, foreseen: Foreseen<'_>) {
        self.free.foresee(foreseen);
    }

    /// Sets the pushes in effect during the next step; initially there are none. A body that is pushed wakes.
    pub(crate) fn set_pushes<'p>(
        &mut self,
        robot: &Robot,
        pushes: impl Iterator<Item = &'p Push> + Clone,
    ) {
        self.free.set_pushes(robot, pushes.clone());
        self.world.set_pushes(pushes);
    }

    /// The report of the last step.
    pub fn report(&self) -> &StepReport {
        &self.report
    }

    /// What contact cost in all steps so far, in units that are the same on every machine.
    pub(crate) fn work(&self) -> u64 {
        self.world.work() + self.clearance.work()
    }

    /// The bodies of the scene, in its order.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyState> {
        (0..self.world.body_count()).map(|index| self.world.body(index))
    }

    /// Body `index` of the scene.
    ///
    /// # Panics
    /// If the scene has no such body.
    pub fn body(&self, index: usize) -> BodyState {
        self.world.body(index)
    }

    /// The air of the next step, if there is any.
    pub(crate) fn air_now(&self) -> Option<AirNow> {
        self.world.air_now()
    }

    /// The air of the last step; none before the first, or without air.
    pub(crate) fn air_of_last_step(&self) -> Option<&AirNow> {
        self.air.as_ref()
    }

    /// The dynamic body whose centre of mass is fastest, with its speed \[m/s\]; `None` if all sleep.
    pub(crate) fn fastest_body(&self) -> Option<(usize, f64)> {
        self.world.fastest_body()
    }

    /// The first of the scene's bodies and the ground that a ray hits, and its distance \[m\]; `None` beyond `range_m`. The ray starts
    /// at `from` along the unit vector `direction`, both in the world, and ignores the robot.
    ///
    /// 0 from inside a solid or below the ground. At equal distances the first in the order of [`Party`] is returned. The result
    /// depends only on the poses of the bodies, not on whether the engine stepped.
    pub fn cast_ray(
        &self,
        from: &Vector3<f64>,
        direction: &Vector3<f64>,
        range_m: f64,
    ) -> Option<(Party, f64)> {
        let mut ray = Ray::new(from, direction, range_m);
        self.show(&mut ray);
        ray.nearest()
    }

    /// Tests `ray` against the bodies of the scene and the ground.
    pub(crate) fn show(&self, ray: &mut Ray) {
        self.world.meet(ray);
    }
}

/// Whether a link may come near anything in a step from one position to another, as bodies move and as gravity lets them `fall` \[m\].
fn is_near(
    clearance: &mut Clearance,
    world: &World,
    robot: &Robot,
    (from_q, to_q): (&[f64], &[f64]),
    falls_m: f64,
) -> bool {
    if world.is_driven() {
        clearance.forget();
    }
    let others_m = if world.is_awake() {
        FORCES_MARGIN * world.travel_m() + falls_m
    } else {
        0.0
    };
    clearance.is_near(robot, from_q, to_q, others_m, |list| world.obstacles(list))
}

/// The error of a step that the contact engine did not do, in a scene whose bodies have these names.
fn failed(fault: StepFault, names: &[String]) -> StepError {
    match fault {
        StepFault::Lost(lost) => StepError::Lost {
            body: lost.map(|index| names[index].clone()),
        },
        StepFault::TooManyTriangles => StepError::TooManyTriangles,
    }
}

impl std::fmt::Debug for HybridStep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("HybridStep")
            .field("report", &self.report)
            .finish_non_exhaustive()
    }
}
