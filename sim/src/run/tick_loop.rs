//! The tick loop: observe, control, servo, step. Time is counted, never measured.
//!
//! At each tick the controller is called if a control period begins, then the servos if a servo period does; the row is recorded, and the
//! state advances to the next tick. [`Run`] goes tick by tick; [`run`] goes to the end. In mode `Prescribed` laws take the place of servos
//! and step, and the efforts in a row are those that the motion takes.

use std::sync::Arc;

use super::disturbance::{Disturbance, Disturbed};
use super::divergence::RunawayGuard;
use super::prescribed::PrescribedMotion;
use super::setup::{End, Observation, Recorder, Row, RunError, Setup};
use super::stepper::{StepOutcome, Stepper};
use crate::control::servo::{Mode, Servo};
use crate::dynamics::link_forces::LinkForces;
use crate::engine::WorkBudget;
use crate::kinematics::FramePoses;
use crate::model::push::Push;
use crate::model::robot::Robot;
use crate::model::sensor::Seen;
use crate::model::unphysical::UnphysicalLinks;
use crate::sensing::Sensors;
use crate::step::drives::Drives;
use crate::step::hybrid::{HybridStep, StateFrom};

/// What a run may cost, however short it is, in the units of [`WorkBudget`]: ten seconds of many shapes in contact ...
const WORK: u64 = 1_000_000_000;
/// ... and for each of its ticks: some thirty pairs of shapes in contact all the time, or an arm of a hundred joints.
const WORK_PER_TICK: u64 = 10_000;
/// What a ray costs for each shape that it may meet.
const RAY: u64 = 10;
/// What a joint costs in a tick.
const JOINT: u64 = 100;
/// With closed loops a tick solves a dense system: so many of the cubes of its size cost one unit.
const CUBES: u64 = 10;

/// A run between two ticks.
#[derive(Debug)]
pub struct Run<'a> {
    setup: Setup<'a>,
    /// The robot as the servos know it.
    known: &'a Robot,
    state: State,
}

/// All that later ticks depend on, except the controller's memory.
#[derive(Debug)]
struct State {
    /// The tick that comes next.
    tick: u64,
    q: Vec<f64>,
    qd: Vec<f64>,
    command: Vec<f64>,
    /// The efforts commanded by the servos, held between their samples.
    driven: Vec<f64>,
    /// The efforts that the motors deliver.
    effort: Vec<f64>,
    servo: Servo,
    stepper: Stepper,
    drives: Drives,
    /// The motion in mode `Prescribed`, and the forces on its links.
    prescribed: Option<(PrescribedMotion, LinkForces)>,
    sensors: Sensors,
    /// Velocities a step ago, for sensors.
    qd_before: Vec<f64>,
    /// Mean accelerations over the last step, for sensors.
    qdd: Vec<f64>,
    guard: RunawayGuard,
    poses: FramePoses,
    /// What the run may still cost, but for what the stepper counts.
    budget: WorkBudget,
    /// What the stepper has counted so far.
    stepped: u64,
    /// Shapes that a ray may meet.
    shapes: u64,
    /// Noise and delay between robot and controller, if any.
    disturbed: Option<Disturbed>,
}

impl<'a> Run<'a> {
    /// A run of `setup` before its first tick.
    ///
    /// # Errors
    /// [`RunError`] if the robot is for kinematics only, the servo settings do not fit it, its loops cannot follow their laws, or robot
    /// and scene cannot have contact.
    ///
    /// # Panics
    /// If a start vector does not have the shape of the robot, or the mode is `Prescribed` without laws.
    pub fn new(setup: Setup<'a>) -> Result<Self, RunError> {
        let Setup {
            robot,
            periods,
            gravity_m_s2,
            ..
        } = setup;
        let n = robot.n();
        assert_eq!(
            (setup.start_q.len(), setup.start_qd.len()),
            (n, n),
            "a start state per joint that moves"
        );
        robot.check_inertias().map_err(UnphysicalLinks::clone)?;
        let prescribed = prescribed(&setup)?;
        let [q, qd] = match &prescribed {
            None => [&setup.start_q[..], &setup.start_qd],
            Some((motion, _)) => {
                let [q, qd, _] = motion.state();
                [q, qd]
            }
        }
        .map(<[f64]>::to_vec);
        let state = State {
            tick: 0,
            command: vec![0.0; n],
            driven: vec![0.0; n],
            effort: vec![0.0; n],
            servo: Servo::new(robot, setup.servo.clone(), periods.servo_s(), gravity_m_s2)?,
            stepper: Stepper::new(&setup)?,
            drives: Drives::new(robot, &setup.servo.gains, gravity_m_s2, periods.step_s),
            sensors: Sensors::new(robot, setup.sensors.clone(), periods.step_s)?,
            prescribed,
            qd_before: qd.clone(),
            qdd: vec![0.0; n],
            guard: RunawayGuard::new(robot, &q, &qd),
            q,
            qd,
            poses: FramePoses::new(robot),
            budget: WorkBudget::new(WORK + WORK_PER_TICK * setup.ticks),
            stepped: 0,
            shapes: shapes_of(&setup),
            disturbed: None,
        };
        Ok(Self {
            known: robot,
            setup,
            state,
        })
    }

    /// A run of `setup` under a disturbance. The trace holds the true state, and commands as they reach the servos.
    ///
    /// # Errors
    /// As [`Run::new`].
    ///
    /// # Panics
    /// As [`Run::new`], and if the nominal model has another number of joints than the robot that moves.
    pub fn disturbed(setup: Setup<'a>, disturbance: &Disturbance<'a>) -> Result<Self, RunError> {
        let n = setup.robot.n();
        let mut run = Self::new(setup)?;
        run.state.disturbed = Some(Disturbed::new(disturbance, n));
        if let Some(known) = disturbance.known {
            assert_eq!(known.n(), n, "a nominal model of the same joints");
            run.known = known;
        }
        Ok(run)
    }

    /// The setup of the run.
    pub fn setup(&self) -> &Setup<'a> {
        &self.setup
    }

    /// The tick that comes next.
    pub fn tick(&self) -> u64 {
        self.state.tick
    }

    /// Runs one tick: calls `control` if a control period begins, records the row, and advances the state. The last tick is only
    /// recorded, because its command would have no effect.
    ///
    /// Returns how the run ended, once it has.
    ///
    /// # Errors
    /// [`RunError`] if a joint moves no inertia, or the run has been too much work.
    pub fn advance<E>(
        &mut self,
        control: &mut impl FnMut(&Observation<'_>, &mut [f64]) -> Result<(), E>,
        recorder: &mut impl Recorder,
    ) -> Result<Option<End<E>>, RunError> {
        let Setup { robot, periods, .. } = self.setup;
        let state = &mut self.state;
        let tick = state.tick;
        if tick > self.setup.ticks {
            return Ok(Some(End::Finished));
        }
        state.measure(&self.setup);
        let begins = |ticks: std::num::NonZeroU32| tick.is_multiple_of(u64::from(ticks.get()));
        // every control period begins with a servo period
        if let Some(disturbed) = &mut state.disturbed
            && begins(periods.ticks_per_servo)
        {
            disturbed.measure(&state.q, &state.qd);
        }
        if begins(periods.ticks_per_control)
            && (tick < self.setup.ticks || tick == 0)
            && let Err(why) = state.ask(&self.setup, control)
        {
            return Ok(Some(End::Stopped { tick, why }));
        }
        if state.prescribed.is_some() {
            state.take_effort(&self.setup)?;
        } else {
            state.deliver_effort(&self.setup, self.known, begins(periods.ticks_per_servo));
        }
        recorder.row(Row {
            tick,
            q: &state.q,
            qd: &state.qd,
            command: &state.command,
            effort: &state.effort,
            sensors: state.sensors.values(),
            scene: state.stepper.scene(),
        });
        state.tick += 1;
        if tick == self.setup.ticks {
            return Ok(Some(End::Finished));
        }
        let moved = state.step(&self.setup)?;
        state.count(&self.setup);
        if state.budget.is_spent() {
            let time_s = periods.time_s(tick);
            return Err(RunError::TooMuchWork { time_s });
        }
        let lost = match moved {
            StepOutcome::Diverged(what) => Some(what),
            StepOutcome::Advanced => {
                let scene = state.stepper.scene();
                state.guard.check(robot, &state.q, &state.qd, scene)
            }
        };
        Ok(lost.map(|what| End::Diverged {
            tick: tick + 1,
            what,
        }))
    }
}

impl State {
    /// Computes the efforts of a tick: what the servos ask for if they sample now, as the drives deliver it.
    fn deliver_effort(&mut self, setup: &Setup<'_>, known: &Robot, samples: bool) {
        if samples {
            let (q, qd) = seen(&self.disturbed, &self.q, &self.qd);
            self.servo
                .sample(known, &self.command, q, qd, &mut self.driven);
        }
        self.effort.copy_from_slice(&self.driven);
        self.sensors.open_motors(&mut self.effort);
        self.drives
            .deliver(setup.robot, &self.q, &self.qd, &mut self.effort);
        // a drive that brakes cannot do so through an open circuit either
        self.sensors.open_motors(&mut self.effort);
    }

    /// Computes the efforts that the prescribed motion takes at a tick.
    ///
    /// # Errors
    /// [`RunError::Loops`].
    fn take_effort(&mut self, setup: &Setup<'_>) -> Result<(), RunError> {
        let Some((motion, forces)) = &mut self.prescribed else {
            return Ok(());
        };
        let (robot, periods) = (setup.robot, &setup.periods);
        let scene = self.stepper.scene();
        forces.set_air(scene.and_then(HybridStep::air_now));
        forces.set_pushes(robot, pushes_at(setup, self.tick));
        let contacts = scene.map_or(&[][..], |scene| &scene.report().contacts);
        forces.set_contacts(robot, contacts, periods.step_s);
        motion
            .efforts(robot, &setup.gravity_m_s2, forces, &mut self.effort)
            .map_err(|error| RunError::Loops {
                time_s: periods.time_s(self.tick),
                error,
            })
    }

    /// Advances robot and scene from the tick before.
    ///
    /// # Errors
    /// [`RunError`] if a joint moves no inertia, laws leave what the loops allow, or a surface has too many triangles.
    fn step(&mut self, setup: &Setup<'_>) -> Result<StepOutcome, RunError> {
        let robot = setup.robot;
        if !setup.pushes.is_empty() {
            let pushes = pushes_at(setup, self.tick - 1);
            self.stepper.set_pushes(robot, pushes);
        }
        if let Some((motion, _)) = &mut self.prescribed {
            let time_s = setup.periods.time_s(self.tick);
            motion
                .move_to(robot, time_s)
                .map_err(|error| RunError::Loops { time_s, error })?;
            let [next_q, next_qd, _] = motion.state();
            let next = (next_q, next_qd);
            return self
                .stepper
                .advance_along(robot, next, &mut self.q, &mut self.qd);
        }
        if let Some(foreseen) = self.drives.foreseen(&self.q, &self.qd) {
            self.stepper.foresee(foreseen);
        }
        let moved = self
            .stepper
            .advance(robot, &self.effort, &mut self.q, &mut self.qd)?;
        let scene = self.stepper.scene();
        let in_contact = scene.is_some_and(|scene| scene.report().state_from == StateFrom::Contact);
        self.drives.meet(&self.qd, in_contact);
        Ok(moved)
    }

    /// Takes what the last tick cost from the budget.
    fn count(&mut self, setup: &Setup<'_>) {
        let robot = setup.robot;
        let n = robot.bodies().len() as u64;
        let dense = match robot.loops().is_empty() {
            true => 0,
            false => n * n * n / CUBES,
        };
        let stepped = self.stepper.work();
        let rays = self.sensors.take_rays() * self.shapes * RAY;
        let work = n * JOINT + dense + (stepped - self.stepped) + rays;
        self.stepped = stepped;
        self.budget.spend(work);
    }

    /// Samples the sensors at the new tick.
    fn measure(&mut self, setup: &Setup<'_>) {
        if self.sensors.is_empty() {
            return;
        }
        if let Some((motion, _)) = &self.prescribed {
            let [_, _, qdd] = motion.state();
            self.qdd.copy_from_slice(qdd);
        } else if self.tick > 0 {
            let step_s = setup.periods.step_s;
            for (i, qdd) in self.qdd.iter_mut().enumerate() {
                *qdd = (self.qd[i] - self.qd_before[i]) / step_s;
            }
        }
        self.qd_before.copy_from_slice(&self.qd);
        let scene = self.stepper.scene();
        let seen = Seen {
            tick: self.tick,
            robot: setup.robot,
            q: &self.q,
            qd: &self.qd,
            effort: &self.effort,
            qdd: &self.qdd,
            gravity_m_s2: &setup.gravity_m_s2,
            contacts: scene.map_or(&[], |scene| &scene.report().contacts),
        };
        self.sensors.sample(&seen, scene);
    }

    /// Gets from `control` the command of the control period that begins; the disturbance may delay it.
    ///
    /// # Errors
    /// The controller's reason to stop the run.
    fn ask<E>(
        &mut self,
        setup: &Setup<'_>,
        control: &mut impl FnMut(&Observation<'_>, &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let (q, qd) = seen(&self.disturbed, &self.q, &self.qd);
        self.poses.update(setup.robot, q);
        let world_from_tcp = self.poses.world_from(setup.tcp);
        let world_from_seen = self.poses.world_from(setup.seen_from);
        let tcp = world_from_seen.inv_mul(&world_from_tcp);
        let observation = Observation {
            tick: self.tick,
            time_s: setup.periods.time_s(self.tick),
            dt_s: setup.periods.control_s(),
            q,
            qd,
            effort: &self.effort,
            tcp: &tcp,
            sensors: self.sensors.values(),
        };
        control(&observation, &mut self.command)?;
        if let Some(disturbed) = &mut self.disturbed {
            disturbed.deliver(&mut self.command);
        }
        Ok(())
    }
}

/// The motion of a run in mode `Prescribed`, at its start, and the forces on its links.
fn prescribed(setup: &Setup<'_>) -> Result<Option<(PrescribedMotion, LinkForces)>, RunError> {
    assert_eq!(
        setup.servo.mode == Mode::Prescribed,
        setup.laws.is_some(),
        "laws in mode `Prescribed`, and only there"
    );
    let Some(laws) = &setup.laws else {
        return Ok(None);
    };
    let robot = setup.robot;
    let motion = PrescribedMotion::new(robot, Arc::clone(laws))
        .map_err(|error| RunError::Loops { time_s: 0.0, error })?;
    Ok(Some((motion, LinkForces::new(robot))))
}

/// The pushes that act from `tick` to the next.
fn pushes_at<'s>(setup: &'s Setup<'_>, tick: u64) -> impl Iterator<Item = &'s Push> + Clone {
    let pushes = setup.pushes.iter();
    pushes.filter(move |push| push.acts_at(tick))
}

/// The shapes that a ray may meet.
fn shapes_of(setup: &Setup<'_>) -> u64 {
    let links = setup.robot.links().iter().map(|link| link.shapes.len());
    let bodies = setup.scene.iter().flat_map(|scene| &scene.bodies);
    let shapes = links.chain(bodies.map(|body| body.shapes.len()));
    shapes.sum::<usize>() as u64
}

/// Positions and velocities for controller and servos: the measured ones under a disturbance, else the true ones.
fn seen<'s>(
    disturbed: &'s Option<Disturbed>,
    q: &'s [f64],
    qd: &'s [f64],
) -> (&'s [f64], &'s [f64]) {
    match disturbed {
        Some(disturbed) => (&disturbed.q, &disturbed.qd),
        None => (q, qd),
    }
}

/// Runs `setup` under `control`, which writes the command of each control period, and records every tick.
///
/// `control` is called at every tick that starts a control period, except the last tick, whose command would have no effect.
///
/// # Errors
/// [`RunError`] if the servo settings do not fit the robot, a joint moves no inertia, or robot and scene cannot have contact.
///
/// # Panics
/// If a start vector does not have the shape of the robot.
pub fn run<E>(
    setup: &Setup<'_>,
    mut control: impl FnMut(&Observation<'_>, &mut [f64]) -> Result<(), E>,
    recorder: &mut impl Recorder,
) -> Result<End<E>, RunError> {
    let mut run = Run::new(setup.clone())?;
    loop {
        if let Some(end) = run.advance(&mut control, recorder)? {
            return Ok(end);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU32;

    use nalgebra::Vector3;

    use super::*;
    use crate::control::{Derivative, Gains, ServoSettings};
    use crate::format::{RobotFile, SceneFile};
    use crate::text::Source;
    use crate::ticks::Periods;

    /// Counts the ticks that it gets.
    struct Ticks(u64);

    impl Recorder for Ticks {
        fn row(&mut self, _: Row<'_>) {
            self.0 += 1;
        }
    }

    /// How many ticks of a hundred there are where a run may cost so much; with a box that lies on the ground, or without a scene.
    fn ticks_for(units: u64, in_scene: bool) -> (u64, Option<RunError>) {
        let arm = "format = 1\nname = 'arm'\n[[links]]\nname = 'base'\n[[links]]\nname = 'bar'\n\
            inertia = { mass_kg = 1.0, com_m = [0, 0, 0.5], tensor_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }\n[[joints]]\nname = 'hinge'\n\
            type = 'revolute'\nparent = 'base'\nchild = 'bar'\naxis = [0, 1, 0]\n";
        let arm = RobotFile::parse(Source::new("arm", arm)).unwrap();
        let arm = arm.build(&[]).unwrap();
        let scene = "format = 1\nname = 's'\nenvironment = { ground = { friction = 0.4 } }\n[[bodies]]\nname = 'box'\ntype = 'free'\n\
            origin = { xyz_m = [3, 0, 0.05] }\ninertia = { mass_kg = 1.0 }\n\
            shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ncontact = { friction = 0.4 }\n";
        let scene = SceneFile::parse(Source::new("s", scene)).unwrap();
        let scene = scene.build(&[]).unwrap();
        let gains = Gains {
            kp: 0.0,
            ki: 0.0,
            kd: 0.0,
            effort_limit: 1.0,
            integral_limit: f64::INFINITY,
        };
        let setup = Setup {
            robot: &arm,
            scene: in_scene.then_some(&scene),
            tcp: arm.tcp(),
            seen_from: &arm.frames()[0],
            periods: Periods {
                step_s: 1e-3,
                ticks_per_servo: NonZeroU32::MIN,
                ticks_per_control: NonZeroU32::MIN,
            },
            gravity_m_s2: Vector3::new(0.0, 0.0, -9.81),
            servo: ServoSettings {
                mode: Mode::Effort,
                derivative: Derivative::Velocity,
                gains: vec![gains],
                gravity_compensation: false,
            },
            sensors: Vec::new(),
            start_q: vec![0.0],
            start_qd: vec![0.0],
            laws: None,
            pushes: Vec::new(),
            ticks: 99,
        };
        let mut run = Run::new(setup).unwrap();
        run.state.budget = WorkBudget::new(units);
        let mut control = |_: &Observation<'_>, _: &mut [f64]| Ok::<(), ()>(());
        let mut ticks = Ticks(0);
        loop {
            match run.advance(&mut control, &mut ticks) {
                Ok(None) => {}
                Ok(Some(_)) => return (ticks.0, None),
                Err(error) => return (ticks.0, Some(error)),
            }
        }
    }

    #[test]
    fn a_run_that_is_more_work_than_a_run_may_be_ends_with_an_error() {
        assert_eq!(ticks_for(u64::MAX, true), (100, None));
        // a joint alone
        assert_eq!(ticks_for(99 * JOINT + 1, false), (100, None));
        let at = |time_s| Some(RunError::TooMuchWork { time_s });
        assert_eq!(ticks_for(50 * JOINT, false), (50, at(0.049)));
        // with a box in contact there are fewer
        let (ticks, error) = ticks_for(50 * JOINT, true);
        assert!((1..40).contains(&ticks), "{ticks}");
        assert!(matches!(error, Some(RunError::TooMuchWork { .. })));
    }
}
