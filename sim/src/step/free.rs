//! The step of a robot that touches nothing: the smooth step, and joint limits as hard stops.
//!
//! As long as no joint reaches a limit, this is the smooth step to the last bit. A step that would end beyond a limit is made again:
//! joints at rest on their limits are held there, and joints that arrive are stopped ([`super::joint_limits`]).

use nalgebra::Vector3;

use super::joint_limits::JointLimitConstraints;
use super::smooth::{Foreseen, SmoothStep};
use crate::dynamics::SingularMassMatrix;
use crate::model::air::AirNow;
use crate::model::push::Push;
use crate::model::robot::Robot;

/// Integrates one robot with a fixed step, between its joint limits; its memory is allocated once.
#[derive(Debug, Clone)]
pub(crate) struct FreeStep {
    smooth: SmoothStep,
    stops: JointLimitConstraints,
    gravity_m_s2: Vector3<f64>,
    dt_s: f64,
    start_q: Vec<f64>,
    start_qd: Vec<f64>,
    held: Vec<f64>,
    loose_q: Vec<f64>,
    loose_qd: Vec<f64>,
    /// Efforts of the forces on links at the start of a step; all zero where there are none.
    forces: Vec<f64>,
    acted: Vec<(usize, f64)>,
}

impl FreeStep {
    /// A step of `dt_s` for `robot` under `gravity_m_s2` (world).
    pub(crate) fn new(robot: &Robot, gravity_m_s2: Vector3<f64>, dt_s: f64) -> Self {
        let room = vec![0.0; robot.n()];
        Self {
            smooth: SmoothStep::new(robot, gravity_m_s2, dt_s),
            stops: JointLimitConstraints::new(robot),
            gravity_m_s2,
            dt_s,
            start_q: room.clone(),
            start_qd: room.clone(),
            held: room.clone(),
            loose_q: room.clone(),
            loose_qd: room.clone(),
            forces: room,
            acted: Vec::new(),
        }
    }

    /// Sets the air of the following steps; initially there is none.
    pub(crate) fn set_air(&mut self, air: Option<AirNow>) {
        self.smooth.set_air(air);
    }

    /// Sets the pushes in effect during the following steps; initially there are none.
    pub(crate) fn set_pushes<'p>(&mut self, robot: &Robot, pushes: impl Iterator<Item = &'p Push>) {
        self.smooth.set_pushes(robot, pushes);
    }

    /// Takes accelerations that are known: a step that starts there need not compute them.
    pub(crate) fn foresee(&mut self, foreseen: Foreseen<'_>) {
        self.smooth.foresee(foreseen);
    }

    /// Advances `(q, qd)` by one step under `effort`, held constant; all slices have shape `(n)`. Allocates nothing without dry friction
    /// while no joint reaches a limit.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn advance(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.start_q.copy_from_slice(q);
        self.start_qd.copy_from_slice(qd);
        self.acted.clear();
        self.smooth.advance(robot, effort, q, qd)?;
        if self.stops.allow(&self.start_q, q) {
            return Ok(());
        }
        q.copy_from_slice(&self.start_q);
        qd.copy_from_slice(&self.start_qd);
        self.hold_with_forces(robot, effort);
        let added = self.smooth.damping_inertia(robot, q);
        let (gravity, step) = (&self.gravity_m_s2, (self.dt_s, added));
        self.stops
            .hold(robot, gravity, step, (q, qd), &mut self.held)?;
        if self.smooth.feels_forces() {
            // the step adds them anew
            for (held, force) in self.held.iter_mut().zip(&self.forces) {
                *held -= force;
            }
        }
        self.smooth.advance(robot, &self.held, q, qd)?;
        let added = self.smooth.damping_inertia(robot, &self.start_q);
        self.stops.catch(robot, &self.start_q, added, q, qd);
        let acted = self.stops.impulses().iter().copied().enumerate();
        self.acted
            .extend(acted.filter(|(_, impulse)| *impulse != 0.0));
        Ok(())
    }

    /// The state at the start of the last step.
    pub(crate) fn start(&self) -> (&[f64], &[f64]) {
        (&self.start_q, &self.start_qd)
    }

    /// The joints on which a position limit acted in the last step, with its impulse \[N m s or N s\].
    pub(crate) fn acted(&self) -> &[(usize, f64)] {
        &self.acted
    }

    /// What [`FreeStep::loosen`] left, shape `(n)` each.
    pub(crate) fn loose(&self) -> (&[f64], &[f64]) {
        (&self.loose_q, &self.loose_qd)
    }

    /// Sets `held` to `effort` and that of the forces on links at the start of the step.
    fn hold_with_forces(&mut self, robot: &Robot, effort: &[f64]) {
        self.held.copy_from_slice(effort);
        if self.smooth.feels_forces() {
            let (q, qd) = (&self.start_q, &self.start_qd);
            self.forces.fill(0.0);
            self.smooth.add_forces(robot, q, qd, &mut self.forces);
            for (held, force) in self.held.iter_mut().zip(&self.forces) {
                *held += force;
            }
        }
    }

    /// Leaves in [`FreeStep::loose`] the last step as nothing holds its joints, neither limits nor dry friction, which contact then
    /// settles together with its own impulses; `(q, qd)` is the state after the step as it was.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn loosen(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &[f64],
        qd: &[f64],
    ) -> Result<(), SingularMassMatrix> {
        if !self.smooth.has_dry_friction() && self.acted.is_empty() {
            self.loose_q.copy_from_slice(q);
            self.loose_qd.copy_from_slice(qd);
            return Ok(());
        }
        self.loose_q.copy_from_slice(&self.start_q);
        self.loose_qd.copy_from_slice(&self.start_qd);
        let (q, qd) = (&mut self.loose_q, &mut self.loose_qd);
        self.smooth
            .advance_without_dry_friction(robot, effort, q, qd)
    }

    /// Sets joints that another step from the same start took beyond their limits back on them without changing their velocities, and
    /// moves the state onto the loop-closure constraints.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia.
    pub(crate) fn keep_inside(
        &mut self,
        robot: &Robot,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.stops.keep_inside(robot, &self.start_q, q, qd)
    }

    /// Lists the joints that are on a limit or beyond it at `q`.
    pub(crate) fn list_at_limit(&self, q: &[f64], joints: &mut Vec<usize>) {
        self.stops.list_at_limit(q, joints);
    }
}
