//! A motion task: periods that divide, goals that fit, servos that fit the robot.

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoError, ServoSettings};
use kinemark_sim::dynamics::{ForwardDynamics, SingularMassMatrix};
use kinemark_sim::kinematics::closure::{closed_positions, closed_velocities, loop_gap_m};
use kinemark_sim::model::sensor::{Sensor, replaced};
use kinemark_sim::sensing::Sensors;
use kinemark_sim::sensor::read_all;
use kinemark_sim::spatial::{direction, rotation_from_rpy_deg};
use kinemark_sim::step::hybrid::HybridStep;
use kinemark_sim::text::number::trimmed;
use kinemark_sim::text::{Problem, Spanned};
use kinemark_sim::ticks::Periods;
use nalgebra::{Rotation3, Vector3};

use super::{Reader, numbers};
use crate::lab::file::{GoalTable, MotionTable, NumberAt, PerJoint, ServoTable};
use crate::task::model::{GoalOrientation, MotionGoal, MotionTask};
use crate::task::problem::{LabError, problems};
use crate::task::push::PushReading;
use crate::task::scene::LabScene;
use crate::task::value::Value;

/// The first step closes a gap of so much without a jolt \[m\]: what four decimals of an angle leave open.
const MOST_GAP_M: f64 = 1e-3;
/// Velocities of dependent joints may be off by this \[rad/s or m/s\].
const MOST_RATE_OFF: f64 = 1e-3;

problems! {
    /// What is wrong with a motion task.
    enum MotionProblem {
        Periods { error: String }:
            "lab::periods", "{error}", "does not divide", "each period must be an integer multiple of the one before";
        TwoOrientations:
            "lab::goal", "a goal has one orientation", "the second one", "leave out `rpy_deg` or `axis`";
        NoDirection { what: &'static str }:
            "lab::goal", "`{what}` has no direction", "too short, or not finite", "such as [0, 0, -1]: its length makes no difference";
        Dwells { dwells_s: f64, run_s: f64 }:
            "lab::periods", "the dwells take {dwells_s} s of a run of {run_s} s", "shorter than its dwells";
        Scene { error: String }:
            "lab::scene", "{error}", "this scene with this robot";
        Sensor { error: String }:
            "lab::sensor", "{error}", "in this task";
        OpenLoop { robot: String, gap_m: f64, help: String }:
            "lab::start", "a loop of robot `{robot}` is open by {gap_m:.4} m at this start",
            "not a place where the robot can be", help;
        Unclosed { error: String }:
            "lab::start", "at this start a loop stays open: {error}", "not a place where the robot can be",
            "choose other positions of the independent joints";
        OpeningLoop { help: String }:
            "lab::start", "these velocities would open a loop", "the loops do not allow this", help;
        NoInertia { robot: String, link: String, joint: String }:
            "lab::no_inertia", "robot `{robot}` cannot be simulated: link `{link}` has no inertia that its joint `{joint}` could move",
            "has a link without inertia",
            format!("give link `{link}` an `inertia`, or joint `{joint}` an `armature`, in the robot file: motion tasks need masses");
        JointCount { what: &'static str, count: String, n: usize }:
            "lab::joint_count", "`{what}` has {count} for {n} joints", "this servo",
            "give one number for all joints, or one per joint";
        Gains { error: ServoError }:
            "lab::out_of_range", "{error}", "this servo";
        Servo { error: ServoError }:
            "lab::servo", "{error}", "this servo";
    }
}

impl Reader<'_> {
    pub(super) fn motion(&self, table: &Spanned<MotionTable>) -> Result<MotionTask, LabError> {
        let motion = table.get_ref();
        let periods = self.periods(table)?;
        let duration_s = self.positive(&motion.duration_s, "the duration")?;
        let ticks =
            self.report
                .whole_ticks(&periods, duration_s, &motion.duration_s, "the duration")?;
        let is_prescribed = motion.mode == Mode::Prescribed;
        let (laws, start_q, start_qd) = match self.laws(table, is_prescribed, (&periods, ticks))? {
            Some(start) => (Some(start.laws), start.q, start.qd),
            None => {
                let (q, qd) = self.start(motion)?;
                (None, q, qd)
            }
        };
        let goals = self.goals(motion, &periods, ticks, duration_s)?;
        self.can_move(&start_q)?;
        let servo = self.motion_servo(table)?;
        let scene = self.scene(motion, &periods)?;
        let pushes = PushReading {
            report: self.report,
            robot: self.robot,
            scene: scene.as_deref(),
            periods: &periods,
            ticks,
        };
        let pushes = pushes.all(&motion.pushes)?;
        let around = self.surroundings(motion, scene)?;
        Ok(MotionTask {
            periods,
            ticks,
            servo,
            scene: around.scene,
            air: around.air,
            gravity_m_s2: around.gravity_m_s2,
            dry_friction: around.dry_friction,
            sensors: self.sensors(table, &periods)?,
            start_q,
            start_qd,
            laws,
            pushes,
            target: match &motion.target {
                Some(target) => self.target(target)?,
                None => Value::List(Vec::new()),
            },
            has_target: motion.target.is_some(),
            goals,
            grants: self.grants(&motion.grants, None)?,
            paths: self.paths(&motion.paths)?,
        })
    }

    /// Positions and velocities at the start, shape `(n)` each.
    fn start(&self, motion: &MotionTable) -> Result<(Vec<f64>, Vec<f64>), LabError> {
        let q = match &motion.start_rad {
            None => self.robot.home().to_vec(),
            Some(start) if self.is_of_independent(start) => {
                let closed = closed_positions(self.robot, start.get_ref());
                closed.or_else(|error| self.stays_open(start, &error))?
            }
            Some(start) => {
                self.counted(start, "start_rad")?;
                self.closes(start)?;
                start.get_ref().clone()
            }
        };
        let qd = match &motion.start_rad_s {
            None => vec![0.0; self.robot.n()],
            Some(start) if self.is_of_independent(start) => {
                let closed = closed_velocities(self.robot, &q, start.get_ref());
                closed.or_else(|error| self.stays_open(start, &error))?
            }
            Some(start) => {
                self.counted(start, "start_rad_s")?;
                self.keeps_closed(start, &q)?;
                start.get_ref().clone()
            }
        };
        Ok((q, qd))
    }

    /// Whether a list has a number for each independent joint of a robot with loops, and none for the others, which follow.
    fn is_of_independent(&self, typed: &Spanned<Vec<f64>>) -> bool {
        let independent = self.robot.independent().len();
        independent < self.robot.n() && typed.get_ref().len() == independent
    }

    /// Refuses a start for which the loops cannot be closed.
    fn stays_open<T>(
        &self,
        start: &Spanned<Vec<f64>>,
        error: &impl std::fmt::Display,
    ) -> Result<T, LabError> {
        let error = error.to_string();
        self.report
            .refuse_at(start, MotionProblem::Unclosed { error })
    }

    /// The periods, each a whole number of the one before.
    fn periods(&self, table: &Spanned<MotionTable>) -> Result<Periods, LabError> {
        let motion = table.get_ref();
        let milliseconds = |typed: &Option<NumberAt>, what, absent: f64| match typed {
            None => Ok(absent),
            Some(number) => Ok(self.positive(number, what)? / 1000.0),
        };
        let step_s = milliseconds(&motion.physics_step_ms, "the physics step", 0.001)?;
        let servo_s = milliseconds(&motion.servo_period_ms, "the servo period", 0.001)?;
        let control_s = milliseconds(&motion.control_period_ms, "the control period", 0.01)?;
        Periods::new(step_s, servo_s, control_s).or_else(|error| {
            let typed = [&motion.control_period_ms, &motion.servo_period_ms];
            let at = typed.into_iter().flatten().next();
            let at = at.map_or(table.span(), Spanned::span);
            let error = error.to_string();
            self.report.refuse(at, MotionProblem::Periods { error })
        })
    }

    /// The goals, whose dwells fit into the run.
    fn goals(
        &self,
        motion: &MotionTable,
        periods: &Periods,
        ticks: u64,
        duration_s: f64,
    ) -> Result<Vec<MotionGoal>, LabError> {
        let mut goals = Vec::new();
        for goal in &motion.goals {
            let dwell_s = self.positive(&goal.dwell_s, "the dwell")?;
            goals.push(MotionGoal {
                position_m: Vector3::from(goal.position_m),
                dwell_ticks: self.report.whole_ticks(
                    periods,
                    dwell_s,
                    &goal.dwell_s,
                    "the dwell",
                )?,
                orientation: self.goal_orientation(goal)?,
            });
        }
        let dwells: u64 = goals.iter().map(|goal| goal.dwell_ticks).sum();
        if dwells > ticks {
            let problem = MotionProblem::Dwells {
                dwells_s: periods.time_s(dwells),
                run_s: duration_s,
            };
            return self.report.refuse_at(&motion.duration_s, problem);
        }
        Ok(goals)
    }

    /// How the TCP is to be turned at a goal, if the lab says so.
    fn goal_orientation(&self, goal: &GoalTable) -> Result<Option<GoalOrientation>, LabError> {
        match (&goal.rpy_deg, &goal.axis) {
            (None, None) => Ok(None),
            (Some(_), Some(axis)) => self.report.refuse_at(axis, MotionProblem::TwoOrientations),
            (Some(rpy_deg), None) => {
                let rotation = rotation_from_rpy_deg(*rpy_deg.get_ref());
                if !rotation.iter().all(|entry| entry.is_finite()) {
                    let problem = MotionProblem::NoDirection { what: "rpy_deg" };
                    return self.report.refuse_at(rpy_deg, problem);
                }
                let rotation = Rotation3::from_matrix_unchecked(rotation);
                Ok(Some(GoalOrientation::Rotation(rotation)))
            }
            (None, Some(typed)) => {
                let axis = typed.get_ref();
                let unit = |what, numbers: [f64; 3]| match direction(Vector3::from(numbers)) {
                    Some(unit) => Ok(unit),
                    None => self
                        .report
                        .refuse_at(typed, MotionProblem::NoDirection { what }),
                };
                Ok(Some(GoalOrientation::Axis {
                    of_tcp: unit("of_tcp", axis.of_tcp)?,
                    along: unit("along", axis.along)?,
                }))
            }
        }
    }

    /// The servos, which the robot can have.
    fn motion_servo(&self, table: &Spanned<MotionTable>) -> Result<ServoSettings, LabError> {
        let motion = table.get_ref();
        let default_servo = ServoTable::default();
        let (servo, at) = match &motion.servo {
            Some(servo) => (servo.get_ref(), servo.span()),
            None => (&default_servo, table.span()),
        };
        self.servo(motion.mode, servo, at)
    }

    /// The scene, in which the robot can be simulated.
    fn scene(
        &self,
        motion: &MotionTable,
        periods: &Periods,
    ) -> Result<Option<Arc<LabScene>>, LabError> {
        let Some(named) = &motion.scene else {
            return Ok(None);
        };
        let table = named.get_ref();
        let dimensions: Vec<_> = table.dimensions.clone().into_iter().collect();
        let mut scenes = self.scenes.iter();
        let Some(scene) = scenes.find(|scene| scene.is(&table.name, &dimensions)) else {
            return Ok(None);
        };
        let gravity_m_s2 = scene.scene.environment.gravity_m_s2;
        match HybridStep::new(self.robot, &scene.scene, gravity_m_s2, periods.step_s) {
            Ok(_) => Ok(Some(Arc::clone(scene))),
            Err(error) => {
                let error = error.to_string();
                self.report.refuse_at(named, MotionProblem::Scene { error })
            }
        }
    }

    /// The robot's sensors, with the task's in their place or after them.
    fn sensors(
        &self,
        table: &Spanned<MotionTable>,
        periods: &Periods,
    ) -> Result<Vec<Sensor>, LabError> {
        let typed = &table.get_ref().sensors;
        let changes = read_all(typed, self.report.source, "lab", self.robot)
            .map_err(|error| error.map(|problem| Box::new(problem) as Box<dyn Problem>))?;
        let sensors = replaced(self.robot.sensors(), changes);
        match Sensors::new(self.robot, sensors.clone(), periods.step_s) {
            Ok(_) => Ok(sensors),
            // the sensor at fault may be the robot's own, so the task is what does not fit
            Err(error) => {
                let error = error.to_string();
                self.report
                    .refuse_at(table, MotionProblem::Sensor { error })
            }
        }
    }

    /// Refuses a start at which a loop is open: the robot cannot be there.
    fn closes(&self, start: &Spanned<Vec<f64>>) -> Result<(), LabError> {
        let (robot, q) = (self.robot, start.get_ref());
        let gap_m = loop_gap_m(robot, q);
        if gap_m <= MOST_GAP_M {
            return Ok(());
        }
        let independent: Vec<f64> = robot.independent().iter().map(|&i| q[i]).collect();
        let names: Vec<&str> = robot.moving_joints().map(|j| j.name.as_str()).collect();
        let named = |which: &[usize]| {
            let names: Vec<&str> = which.iter().map(|&i| names[i]).collect();
            names.join(", ")
        };
        let help = match closed_positions(robot, &independent) {
            Ok(closed) => {
                let closed: Vec<String> = closed.iter().map(|q| trimmed(*q, 6)).collect();
                format!(
                    "{} follow from {}: the loops are closed at [{}]; left out, the robot starts at its home",
                    named(robot.dependent()),
                    named(robot.independent()),
                    closed.join(", ")
                )
            }
            Err(error) => format!("{error}: {}", error.help()),
        };
        let robot = robot.name().to_owned();
        let problem = MotionProblem::OpenLoop { robot, gap_m, help };
        self.report.refuse_at(start, problem)
    }

    /// Refuses velocities that would open a loop.
    fn keeps_closed(&self, start: &Spanned<Vec<f64>>, q: &[f64]) -> Result<(), LabError> {
        let (robot, qd) = (self.robot, start.get_ref());
        let independent: Vec<f64> = robot.independent().iter().map(|&i| qd[i]).collect();
        let problem = match closed_velocities(robot, q, &independent) {
            Ok(closed) => {
                let off = closed.iter().zip(qd).map(|(a, b)| (a - b).abs());
                if off.fold(0.0, f64::max) <= MOST_RATE_OFF {
                    return Ok(());
                }
                let closed: Vec<String> = closed.iter().map(|rate| trimmed(*rate, 6)).collect();
                let help = format!("the loops stay closed at [{}]", closed.join(", "));
                MotionProblem::OpeningLoop { help }
            }
            Err(error) => MotionProblem::OpeningLoop {
                help: format!("{error}: {}", error.help()),
            },
        };
        self.report.refuse_at(start, problem)
    }

    /// Refuses a robot with a joint that moves neither mass nor armature: no effort on it has a finite answer.
    fn can_move(&self, start_q: &[f64]) -> Result<(), LabError> {
        let robot = self.robot;
        let rest = vec![0.0; robot.n()];
        let moved = ForwardDynamics::new(robot).acceleration(
            robot,
            &Vector3::zeros(),
            start_q,
            &rest,
            &rest,
            &mut rest.clone(),
        );
        let Err(SingularMassMatrix { joint }) = moved else {
            return Ok(());
        };
        let known = robot.joints().iter().find(|known| known.name == joint);
        let link = known.map(|known| robot.links()[known.child].name.clone());
        let problem = MotionProblem::NoInertia {
            robot: robot.name().to_owned(),
            link: link.unwrap_or_default(),
            joint,
        };
        self.report.refuse(self.robot_at.clone(), problem)
    }

    fn servo(
        &self,
        mode: Mode,
        table: &ServoTable,
        at: Range<usize>,
    ) -> Result<ServoSettings, LabError> {
        let n = self.robot.n();
        let spread = |typed: &Option<PerJoint>, what: &'static str, absent: f64| {
            let values = match typed {
                None => vec![absent; n],
                Some(PerJoint::All(value)) => vec![*value; n],
                Some(PerJoint::Each(values)) if values.len() == n => values.clone(),
                Some(PerJoint::Each(values)) => {
                    let count = numbers(values.len());
                    let problem = MotionProblem::JointCount { what, count, n };
                    return self.report.refuse(at.clone(), problem);
                }
            };
            Ok(values)
        };
        let mut effort_limit = spread(&table.effort_limit, "effort_limit", f64::INFINITY)?;
        let of_robot = |joint: usize| {
            let limit = self
                .robot
                .moving_joints()
                .nth(joint)
                .and_then(|j| j.limits.effort);
            limit.unwrap_or(f64::INFINITY)
        };
        // a lab may be stricter than the robot, never more generous; NaN and other limits out of range stay, to be refused
        for (joint, limit) in effort_limit.iter_mut().enumerate() {
            if *limit > of_robot(joint) {
                *limit = of_robot(joint);
            }
        }
        let gains = GainLists {
            kp: spread(&table.kp, "kp", 0.0)?,
            ki: spread(&table.ki, "ki", 0.0)?,
            kd: spread(&table.kd, "kd", 0.0)?,
            effort_limit,
            integral_limit: spread(&table.integral_limit, "integral_limit", f64::INFINITY)?,
        };
        ServoSettings::new(
            self.robot,
            mode,
            table.derivative.unwrap_or(Derivative::Measurement),
            &gains,
            table.gravity_compensation,
        )
        .or_else(|error| {
            let problem = match error {
                ServoError::Gain { .. } | ServoError::Limit { .. } => {
                    MotionProblem::Gains { error }
                }
                ServoError::Count { .. } | ServoError::VelocityOfVelocity => {
                    MotionProblem::Servo { error }
                }
            };
            self.report.refuse(at, problem)
        })
    }
}
