//! The smooth step: classical Runge-Kutta of order four over forward dynamics, effort held over the step; then, if the robot has
//! loops, a projection onto the loop-closure constraints.
//!
//! Where viscous damping is too stiff for Runge-Kutta (see `implicit_damping.rs`), a step of the same order takes damping implicitly: `k` Euler
//! steps of `h/k` with `(M + h/k D) q̈ = τ - h(q, q̇) - D q̇` for each `k` from 1 to 4, extrapolated to steps without length. Damping
//! alone then decays at any rate (the step is L-stable there), and everything else is as explicit, and as accurate, as before.
//!
//! Source: Deuflhard, Hairer & Zugck, *One-step and extrapolation methods for differential-algebraic systems* (1987); Hairer & Wanner,
//! *Solving Ordinary Differential Equations II* (1996), sec. IV.9. The positions follow the new velocities, as in the symplectic
//! Euler method, which makes the error of an oscillation a sixth of that of Runge-Kutta.
//!
//! The air, if there is any, and pushes are constant over a step; their efforts follow the motion of the links within the step.
//!
//! Drives foresee a step by the accelerations at its start, which are those of the first stage: they are handed over with the state and
//! the effort that they belong to, and a stage that is just that, bit for bit, is not computed again.
//!
//! [`HybridStep`](super::hybrid::HybridStep) adds contact behind the same interface: a state and held efforts in, the next state out.

use nalgebra::Vector3;

use super::implicit_damping::ImplicitDamping;
use crate::dynamics::ForwardDynamics;
use crate::dynamics::SingularMassMatrix;
use crate::dynamics::dry_friction::DryFriction;
use crate::dynamics::link_forces::LinkForces;
use crate::model::air::AirNow;
use crate::model::push::Push;
use crate::model::robot::Robot;

/// Weights of the results of 1, 2, 3 and 4 partial steps: `Σ c_k = 1`, and `Σ c_k / kʲ = 0` for `j` from 1 to 3.
const EXTRAPOLATION: [f64; 4] = [-1.0 / 6.0, 4.0, -13.5, 32.0 / 3.0];

/// The accelerations of one state under one effort, as forward dynamics alone has them; all slices have shape `(n)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Foreseen<'a> {
    pub(crate) q: &'a [f64],
    pub(crate) qd: &'a [f64],
    pub(crate) effort: &'a [f64],
    pub(crate) qdd: &'a [f64],
}

/// The last accelerations that were foreseen; none before the first, which no state can equal.
#[derive(Debug, Clone, Default)]
struct Known {
    q: Vec<f64>,
    qd: Vec<f64>,
    effort: Vec<f64>,
    qdd: Vec<f64>,
}

impl Known {
    fn set(&mut self, foreseen: Foreseen<'_>) {
        let Foreseen { q, qd, effort, qdd } = foreseen;
        for (known, given) in [
            (&mut self.q, q),
            (&mut self.qd, qd),
            (&mut self.effort, effort),
            (&mut self.qdd, qdd),
        ] {
            known.clear();
            known.extend_from_slice(given);
        }
    }

    /// The accelerations at just this state, under just this effort.
    fn at(&self, q: &[f64], qd: &[f64], effort: &[f64]) -> Option<&[f64]> {
        let same = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
        };
        let known = !q.is_empty() && same(&self.q, q);
        (known && same(&self.qd, qd) && same(&self.effort, effort)).then_some(&self.qdd)
    }
}

/// Integrates one robot with a fixed step; its memory is allocated once.
#[derive(Debug, Clone)]
pub struct SmoothStep {
    dt_s: f64,
    gravity_m_s2: Vector3<f64>,
    dynamics: ForwardDynamics,
    damping: ImplicitDamping,
    friction: DryFriction,
    /// The forces of the air and of pushes.
    forces: LinkForces,
    known: Known,
    held: Vec<f64>,
    /// Held effort, and that of forces on links, of one stage.
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
            damping: ImplicitDamping::new(robot, dt_s),
            friction: DryFriction::new(robot),
            forces: LinkForces::new(robot),
            known: Known::default(),
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
        self.forces.set_air(air);
    }

    /// Sets the pushes in effect during the following steps; initially there are none.
    pub fn set_pushes<'p>(&mut self, robot: &Robot, pushes: impl Iterator<Item = &'p Push>) {
        self.forces.set_pushes(robot, pushes);
    }

    /// Takes accelerations that are known, of this robot under this gravity: a step that starts there need not compute them.
    pub(super) fn foresee(&mut self, foreseen: Foreseen<'_>) {
        self.known.set(foreseen);
    }

    /// Whether forces act on the links: there is air and a moving link has drag, or a push.
    pub fn feels_forces(&self) -> bool {
        self.forces.act()
    }

    /// Adds the efforts of the forces on links at `(q, qd)` to `effort`; all slices have shape `(n)`. Does nothing without any.
    pub fn add_forces(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        if self.forces.act() {
            self.forces.add_efforts(robot, q, qd, effort);
        }
    }

    /// The inertia that damping adds to the joints in a step from `q`, `h D` in units of armature, shape `(n)`: an impulse acts through
    /// `M` plus it. `None` where the step is explicit, and an impulse acts through `M`.
    ///
    /// Follows from the robot, the step and `q` alone, and is what [`Self::advance`] uses there.
    pub fn damping_inertia(&mut self, robot: &Robot, q: &[f64]) -> Option<&[f64]> {
        self.damping.added_inertia(robot, &mut self.dynamics, q)
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
        self.held[..n].copy_from_slice(&effort[..n]);
        let is_stiff = self
            .damping
            .added_inertia(robot, &mut self.dynamics, q)
            .is_some();
        if rubs {
            self.hold_friction(robot, effort, (q, qd), is_stiff)?;
        }
        self.advance_held(robot, is_stiff, q, qd)
    }

    /// Advances `(q, qd)` by one step under the efforts that `other` held in its last step, dry friction included, and under its forces.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub(super) fn advance_like(
        &mut self,
        other: &Self,
        robot: &Robot,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.held.copy_from_slice(&other.held);
        self.forces.set_like(&other.forces);
        let is_stiff = self.damping_inertia(robot, q).is_some();
        self.advance_held(robot, is_stiff, q, qd)
    }

    /// Advances `(q, qd)` by one step under what is held.
    fn advance_held(
        &mut self,
        robot: &Robot,
        is_stiff: bool,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        let n = q.len();
        if is_stiff {
            self.extrapolate(robot, q, qd)?;
            return self.dynamics.close_loops(robot, q, qd);
        }
        if self.forces.act() {
            self.stages::<true>(robot, q, qd)?;
        } else {
            self.stages::<false>(robot, q, qd)?;
        }
        let sixth = self.dt_s / 6.0;
        let ([r0, r1, r2, r3], [s0, s1, s2, s3]) = (&self.rates, &self.slopes);
        for i in 0..n {
            q[i] += sixth * (r0[i] + 2.0 * (r1[i] + r2[i]) + r3[i]);
            qd[i] += sixth * (s0[i] + 2.0 * (s1[i] + s2[i]) + s3[i]);
        }
        self.dynamics.close_loops(robot, q, qd)
    }

    /// Adds the dry friction of a step from `(q, qd)` under `effort` to what is held.
    fn hold_friction(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        (q, qd): (&[f64], &[f64]),
        is_stiff: bool,
    ) -> Result<(), SingularMassMatrix> {
        let dt = self.dt_s;
        let slope = &mut self.slopes[0];
        let effort = if self.forces.act() {
            let room = &mut self.stage_effort;
            with_forces(&mut self.forces, robot, (q, qd), effort, room)
        } else {
            effort
        };
        let added = is_stiff.then(|| self.damping.whole_step());
        let (dynamics, gravity) = (&mut self.dynamics, &self.gravity_m_s2);
        match (added, self.known.at(q, qd, effort)) {
            (None, Some(qdd)) => slope.copy_from_slice(qdd),
            (None, None) => dynamics.acceleration(robot, gravity, q, qd, effort, slope)?,
            (Some(added), _) => {
                dynamics.acceleration_with(robot, gravity, (q, qd), effort, added, slope)?;
            }
        }
        let friction = self
            .friction
            .efforts(robot, dynamics, dt, (q, qd), added, slope);
        for (held, friction) in self.held.iter_mut().zip(friction) {
            *held += friction;
        }
        Ok(())
    }

    /// The step that takes damping implicitly.
    fn extrapolate(
        &mut self,
        robot: &Robot,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        let n = q.len();
        let [sum_q, sum_qd, ..] = &mut self.rates;
        sum_q[..n].fill(0.0);
        sum_qd[..n].fill(0.0);
        for (parts, weight) in (1_u8..).zip(EXTRAPOLATION) {
            let part_s = self.dt_s / f64::from(parts);
            let added = self.damping.part_of_step(parts);
            let (part_q, part_qd) = (&mut self.stage_q[..n], &mut self.stage_qd[..n]);
            part_q.copy_from_slice(q);
            part_qd.copy_from_slice(qd);
            for _ in 0..parts {
                let effort = if self.forces.act() {
                    let (state, room) = ((&*part_q, &*part_qd), &mut self.stage_effort);
                    with_forces(&mut self.forces, robot, state, &self.held, room)
                } else {
                    &self.held
                };
                self.dynamics.acceleration_with(
                    robot,
                    &self.gravity_m_s2,
                    (part_q, part_qd),
                    effort,
                    added,
                    &mut self.slopes[0],
                )?;
                for i in 0..n {
                    part_qd[i] += part_s * self.slopes[0][i];
                    part_q[i] += part_s * part_qd[i];
                }
            }
            for i in 0..n {
                sum_q[i] += weight * (part_q[i] - q[i]);
                sum_qd[i] += weight * (part_qd[i] - qd[i]);
            }
        }
        for i in 0..n {
            q[i] += sum_q[i];
            qd[i] += sum_qd[i];
        }
        Ok(())
    }

    /// Velocities and accelerations of the four stages; compiled separately with and without forces on links, so that these cost nothing
    /// where there are none.
    fn stages<const FORCES: bool>(
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
            let effort = if FORCES {
                let (state, room) = ((&*stage_q, &*stage_qd), &mut self.stage_effort);
                with_forces(&mut self.forces, robot, state, &self.held, room)
            } else {
                &self.held
            };
            if stage == 0
                && let Some(qdd) = self.known.at(stage_q, stage_qd, effort)
            {
                self.slopes[0][..n].copy_from_slice(qdd);
                continue;
            }
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

/// `effort` and that of `forces` at `(q, qd)`, in `room`.
fn with_forces<'a>(
    forces: &mut LinkForces,
    robot: &Robot,
    (q, qd): (&[f64], &[f64]),
    effort: &[f64],
    room: &'a mut [f64],
) -> &'a [f64] {
    room.copy_from_slice(&effort[..room.len()]);
    forces.add_efforts(robot, q, qd, room);
    room
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::RobotFile;
    use crate::text::Source;

    /// The state after a step of a pendulum with friction under 2 N m, after the accelerations `foreseen` for `effort` were handed over.
    fn step(friction_n_m: f64, effort: f64, foreseen: Option<f64>) -> [f64; 2] {
        let pendulum = format!(
            "format = 1\nname = 'p'\n[[links]]\nname = 'base'\n[[links]]\nname = 'bob'\n\
             inertia = {{ mass_kg = 1.0, com_m = [0.3, 0.0, 0.0], tensor_kg_m2 = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0] }}\n[[joints]]\nname = 'hinge'\ntype = 'revolute'\n\
             parent = 'base'\nchild = 'bob'\naxis = [0.0, 1.0, 0.0]\ndry_friction = {friction_n_m:?}\n"
        );
        let robot = RobotFile::parse(Source::new("p", pendulum)).unwrap();
        let robot = robot.build(&[]).unwrap();
        let mut smooth = SmoothStep::new(&robot, Vector3::new(0.0, 0.0, -9.81), 1e-3);
        let (mut q, mut qd) = ([0.4], [1.5]);
        let mut known = [0.0];
        let (mut dynamics, gravity) = (ForwardDynamics::new(&robot), smooth.gravity_m_s2);
        let computed = dynamics.acceleration(&robot, &gravity, &q, &qd, &[effort], &mut known);
        assert_eq!(computed, Ok(()));
        if let Some(wrong_by) = foreseen {
            smooth.foresee(Foreseen {
                q: &q,
                qd: &qd,
                effort: &[effort],
                qdd: &[known[0] + wrong_by],
            });
        }
        smooth.advance(&robot, &[2.0], &mut q, &mut qd).unwrap();
        [q[0], qd[0]]
    }

    #[test]
    fn what_is_foreseen_is_taken_where_it_is_the_start_of_the_step_and_changes_no_bit() {
        for friction_n_m in [0.0, 0.7] {
            let expected = step(friction_n_m, 2.0, None);
            assert_eq!(step(friction_n_m, 2.0, Some(0.0)), expected);
            // it was not computed again: friction would have to turn round for this
            assert_ne!(step(friction_n_m, 2.0, Some(-3000.0)), expected);
            // under another effort it is of no use
            assert_eq!(
                step(friction_n_m, 2.0_f64.next_up(), Some(-3000.0)),
                expected
            );
        }
    }
}
