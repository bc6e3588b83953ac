//! The smooth step: classical Runge-Kutta of order four over forward dynamics, effort held over the step; then, if the robot has
//! loops, a projection onto the loop-closure constraints.
//!
//! The air, if there is any, is constant over a step; its drag follows the motion of the links within the step.
//!
//! [`HybridStep`](super::hybrid::HybridStep) adds contact behind the same interface: a state and held efforts in, the next state out.

use nalgebra::Vector3;

use crate::dynamics::ForwardDynamics;
use crate::dynamics::SingularMassMatrix;
use crate::dynamics::drag::LinkDrag;
use crate::dynamics::dry_friction::DryFriction;
use crate::model::air::AirNow;
use crate::model::robot::Robot;

/// Integrates one robot with a fixed step; its memory is allocated once.
#[derive(Debug, Clone)]
pub struct SmoothStep {
    dt_s: f64,
    gravity_m_s2: Vector3<f64>,
    dynamics: ForwardDynamics,
    friction: DryFriction,
    drag: LinkDrag,
    /// The air of the step, if any link has drag.
    air: Option<AirNow>,
    held: Vec<f64>,
    /// Held effort and drag of one stage.
    stage_effort: Vec<f64>,
    stage_q: Vec<f64>,
    stage_qd: Vec<f64>,
    /// Velocities and accelerations of the four stages.
    rates: [Vec<f64>; 4],
    slopes: [Vec<f64>; 4],
}

impl SmoothStep {
    /// A step of `dt_s` for `robot` under `gravity_m_s2` (world).
    pub fn new(robot: &Robot, gravity_m_s2: Vector3<f64>, dt_s: f64) -> Self {
        let room = || vec![0.0; robot.n()];
        Self {
            dt_s,
            gravity_m_s2,
            dynamics: ForwardDynamics::new(robot),
            friction: DryFriction::new(robot),
            drag: LinkDrag::new(robot),
            air: None,
            held: room(),
            stage_effort: room(),
            stage_q: room(),
            stage_qd: room(),
            rates: [room(), room(), room(), room()],
            slopes: [room(), room(), room(), room()],
        }
    }

    /// Sets the air of the following steps; initially there is none.
    pub fn set_air(&mut self, air: Option<AirNow>) {
        self.air = air.filter(|_| self.drag.is_present());
    }

    /// Whether drag acts on the robot: there is air, and a moving link has drag.
    pub fn feels_air(&self) -> bool {
        self.air.is_some()
    }

    /// Adds the efforts of the drag at `(q, qd)` to `effort`; all slices have shape `(n)`. Does nothing without air.
    pub fn add_drag(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        if let Some(air) = &self.air {
            self.drag.add_efforts(robot, q, qd, air, effort);
        }
    }

    /// Advances `(q, qd)` by one step under `effort`, held constant; all slices have shape `(n)`. Allocates nothing without dry friction.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves no inertia; the state is then unchanged.
    pub fn advance(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.advance_rubbing(robot, effort, q, qd, self.friction.is_present())
    }

    /// Whether a joint of the robot has dry friction.
    pub(super) fn has_dry_friction(&self) -> bool {
        self.friction.is_present()
    }

    /// As [`Self::advance`], without dry friction: contact settles it together with its own impulses.
    pub(super) fn advance_without_dry_friction(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.advance_rubbing(robot, effort, q, qd, false)
    }

    fn advance_rubbing(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
        rubs: bool,
    ) -> Result<(), SingularMassMatrix> {
        let n = q.len();
        let dt = self.dt_s;
        self.held[..n].copy_from_slice(&effort[..n]);
        if rubs {
            let slope = &mut self.slopes[0];
            let effort = match &self.air {
                None => effort,
                Some(air) => {
                    let room = &mut self.stage_effort;
                    with_drag(&mut self.drag, robot, (q, qd), air, effort, room)
                }
            };
            self.dynamics
                .acceleration(robot, &self.gravity_m_s2, q, qd, effort, slope)?;
            let friction = self
                .friction
                .efforts(robot, &mut self.dynamics, dt, q, qd, slope);
            for (held, friction) in self.held.iter_mut().zip(friction) {
                *held += friction;
            }
        }
        if self.air.is_some() {
            self.stages::<true>(robot, q, qd)?;
        } else {
            self.stages::<false>(robot, q, qd)?;
        }
        let sixth = dt / 6.0;
        let ([r0, r1, r2, r3], [s0, s1, s2, s3]) = (&self.rates, &self.slopes);
        for i in 0..n {
            q[i] += sixth * (r0[i] + 2.0 * (r1[i] + r2[i]) + r3[i]);
            qd[i] += sixth * (s0[i] + 2.0 * (s1[i] + s2[i]) + s3[i]);
        }
        self.dynamics.close_loops(robot, q, qd)
    }

    /// Velocities and accelerations of the four stages; compiled separately with and without air, so that drag costs nothing without
    /// air.
    fn stages<const AIR: bool>(
        &mut self,
        robot: &Robot,
        q: &[f64],
        qd: &[f64],
    ) -> Result<(), SingularMassMatrix> {
        let n = q.len();
        let dt = self.dt_s;
        // stages at 0, dt/2, dt/2, dt
        for stage in 0..4 {
            let (stage_q, stage_qd) = (&mut self.stage_q[..n], &mut self.stage_qd[..n]);
            if stage == 0 {
                stage_q.copy_from_slice(q);
                stage_qd.copy_from_slice(qd);
            } else {
                let reach = if stage == 3 { dt } else { 0.5 * dt };
                let (rate, slope) = (&self.rates[stage - 1][..n], &self.slopes[stage - 1][..n]);
                for i in 0..n {
                    stage_q[i] = q[i] + reach * rate[i];
                    stage_qd[i] = qd[i] + reach * slope[i];
                }
            }
            self.rates[stage][..n].copy_from_slice(stage_qd);
            let effort = match &self.air {
                Some(air) if AIR => {
                    let (state, room) = ((&*stage_q, &*stage_qd), &mut self.stage_effort);
                    with_drag(&mut self.drag, robot, state, air, &self.held, room)
                }
                _ => &self.held,
            };
            self.dynamics.acceleration(
                robot,
                &self.gravity_m_s2,
                stage_q,
                stage_qd,
                effort,
                &mut self.slopes[stage],
            )?;
        }
        Ok(())
    }
}

/// `effort` and the drag at `(q, qd)`, in `room`.
fn with_drag<'a>(
    drag: &mut LinkDrag,
    robot: &Robot,
    (q, qd): (&[f64], &[f64]),
    air: &AirNow,
    effort: &[f64],
    room: &'a mut [f64],
) -> &'a [f64] {
    room.copy_from_slice(&effort[..room.len()]);
    drag.add_efforts(robot, q, qd, air, room);
    room
}
