//! What is analysed: the joint, its step, the servos and the surroundings, and what these must be.

use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::control::{Derivative, GainLists, Mode, ServoError, ServoSettings};
use kinemark_sim::kinematics::closure::loop_gap_m;
use kinemark_sim::model::air::Drag;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run::RunError;
use kinemark_sim::text::suggest;

use crate::joint_names::joint_names;

/// The part at the end of a run whose mean is the final value \[s\].
pub(super) const FINAL_S: f64 = 0.2;
/// The longest physics step \[s\]; a servo period is cut into equal steps that are not longer.
const LONGEST_STEP_S: f64 = 1e-3;
/// More physics steps than this take too much memory: every value is kept.
const MOST_STEPS: f64 = 500_000.0;
/// A start counts as closed below this gap.
const MOST_GAP_M: f64 = 1e-6;

/// The gains of every joint, in the units of the joint and the signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidGains {
    /// Effort per error.
    pub kp: f64,
    /// Effort per integrated error.
    pub ki: f64,
    /// Effort per rate of error.
    pub kd: f64,
}

/// What acts on the robot besides its motors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surroundings {
    /// Gravity, downwards \[m/s²\].
    pub gravity_m_s2: f64,
    /// Velocity of the air, world axes, if there is air \[m/s\].
    pub wind_m_s: Option<[f64; 3]>,
    /// Drag of every link that moves, in place of the robot's own.
    pub drag: Option<Drag>,
    /// Dry friction in every joint, besides the robot's own \[N m or N\].
    pub dry_friction: f64,
}

/// A step of one joint, and all that it depends on but the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseSettings {
    /// The entry of `q` that gets the step.
    pub joint: usize,
    /// What is fed back, and jumps.
    pub fed: Fed,
    /// The height of the step \[rad or m, rad/s or m/s\].
    pub step: f64,
    /// The gains of every joint.
    pub gains: PidGains,
    /// What the derivative is taken of; not [`Derivative::Velocity`] where velocities are fed back.
    pub derivative: Derivative,
    /// Whether the servos add the effort that gravity takes.
    pub gravity_compensation: bool,
    /// The greatest effort of each joint, one for all or one per joint; the robot's own limits if it is empty \[N m or N\].
    pub effort_limit: Vec<f64>,
    /// Positions before the step, one per joint; the robot's home if it is empty \[rad or m\].
    pub start: Vec<f64>,
    /// Time between two samples of the servos \[s\].
    pub servo_period_s: f64,
    /// How long the run is \[s\].
    pub duration_s: f64,
    /// What acts besides the motors.
    pub surroundings: Surroundings,
}

/// Settings that cannot be analysed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// A robot without a joint that moves by itself.
    #[error("`{robot}` has no joint with a drive")]
    NoJoint {
        /// The robot's name.
        robot: String,
    },
    /// A robot with several joints, and none was chosen.
    #[error("`{robot}` has several joints, and no joint was given")]
    WhichJoint {
        /// The robot's name.
        robot: String,
        /// What could be given.
        joints: Vec<String>,
    },
    /// A name that is not that of a joint with a drive.
    #[error("`{robot}` has no joint `{given}` with a drive")]
    UnknownJoint {
        /// The robot's name.
        robot: String,
        /// The name that was given.
        given: String,
        /// What could be given.
        joints: Vec<String>,
    },
    /// A number that is out of range.
    #[error("{what} must be {expected}, got {found}")]
    OutOfRange {
        /// What is out of range.
        what: &'static str,
        /// What it must be.
        expected: String,
        /// The number.
        found: f64,
    },
    /// One number for each joint is needed.
    #[error("{what} has {found} numbers; the robot has {expected} joints that move")]
    Count {
        /// What was given.
        what: &'static str,
        /// Joints that move.
        expected: usize,
        /// Numbers given.
        found: usize,
    },
    /// A start that leaves a loop open.
    #[error("the start leaves a loop of the robot open by {gap_m} m")]
    OpenLoop {
        /// By how much \[m\].
        gap_m: f64,
    },
    /// Wind that no link feels.
    #[error("the wind has no effect: no link of `{robot}` has drag")]
    NoDrag {
        /// The robot's name.
        robot: String,
    },
    /// A run with too many steps.
    #[error("the run has {steps:.0} physics steps, at most {MOST_STEPS:.0}")]
    TooLong {
        /// Steps.
        steps: f64,
    },
    /// A sweep that cannot be read.
    #[error("{0}")]
    Sweep(String),
    /// Servos that the robot cannot have.
    #[error(transparent)]
    Servo(#[from] ServoError),
    /// A robot that cannot run.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl ResponseError {
    /// What a person can do about it.
    pub fn help(&self) -> String {
        match self {
            Self::NoJoint { .. } => "`kinemark robot show` lists the joints".to_owned(),
            Self::WhichJoint { joints, .. } => {
                format!("name one with --joint: {}", joints.join(", "))
            }
            Self::UnknownJoint { given, joints, .. } => {
                suggest(given, "joints", joints.iter().map(String::as_str))
            }
            Self::OutOfRange { .. } => "give a number in that range".to_owned(),
            Self::Count { .. } => "give one number for each joint, separated by commas".to_owned(),
            Self::OpenLoop { .. } => {
                "give a start at which the loops are closed, or leave it out".to_owned()
            }
            Self::NoDrag { .. } => {
                "add --drag AREA,COEFFICIENT, such as --drag 0.05,1.1".to_owned()
            }
            Self::TooLong { .. } => {
                "give a shorter --duration or a longer --servo-period-ms".to_owned()
            }
            Self::Sweep(_) => {
                "write the name of one number, `=` and up to six values: --sweep kd=2,5,10"
                    .to_owned()
            }
            Self::Servo(ServoError::VelocityOfVelocity) => {
                "take --derivative measurement or --derivative error".to_owned()
            }
            Self::Servo(_) => "change the gains or the effort limits".to_owned(),
            Self::Run(_) => "`kinemark robot show` lists masses and joints".to_owned(),
        }
    }
}

/// The entry of `q` of the joint called `name`, or of the only one with a drive where no name is given.
///
/// # Errors
/// [`ResponseError`]: no such joint, several joints and no name, or a joint that only follows others.
pub fn joint_entry(robot: &Robot, name: Option<&str>) -> Result<usize, ResponseError> {
    let joints: Vec<_> = robot.moving_joints().collect();
    let with_drive = robot.independent().iter().copied();
    let with_drive: Vec<usize> = with_drive.filter(|i| !joints[*i].passive).collect();
    let names = || joint_names(robot, &with_drive);
    let robot_name = robot.name().to_owned();
    match (name, &with_drive[..]) {
        (_, []) => Err(ResponseError::NoJoint { robot: robot_name }),
        (None, [only]) => Ok(*only),
        (None, _) => Err(ResponseError::WhichJoint {
            robot: robot_name,
            joints: names(),
        }),
        (Some(given), _) => {
            let named = |i: &usize| joints[*i].name == given;
            let found = with_drive.iter().copied().find(named);
            found.ok_or_else(|| ResponseError::UnknownJoint {
                robot: robot_name,
                given: given.to_owned(),
                joints: names(),
            })
        }
    }
}

fn in_range(
    what: &'static str,
    value: f64,
    fits: bool,
    expected: impl Into<String>,
) -> Result<(), ResponseError> {
    if fits && value.is_finite() {
        return Ok(());
    }
    Err(ResponseError::OutOfRange {
        what,
        expected: expected.into(),
        found: value,
    })
}

impl ResponseSettings {
    /// What commands are.
    pub(super) fn mode(&self) -> Mode {
        match self.fed {
            Fed::Position => Mode::Position,
            Fed::Velocity => Mode::Velocity,
        }
    }

    /// Refuses numbers out of range.
    pub(super) fn check(&self, robot: &Robot) -> Result<(), ResponseError> {
        let Surroundings {
            gravity_m_s2,
            wind_m_s,
            drag,
            dry_friction,
        } = self.surroundings;
        in_range(
            "the step",
            self.step,
            self.step != 0.0,
            "a finite number other than 0",
        )?;
        let period_s = self.servo_period_s;
        in_range("the servo period", period_s, period_s > 0.0, "positive")?;
        in_range(
            "the duration",
            self.duration_s,
            self.duration_s > FINAL_S + period_s,
            format!("longer than {FINAL_S} s, whose mean is the final value, and a servo period"),
        )?;
        in_range("gravity", gravity_m_s2, true, "finite")?;
        in_range(
            "the dry friction",
            dry_friction,
            dry_friction >= 0.0,
            "zero or more",
        )?;
        for wind in wind_m_s.into_iter().flatten() {
            in_range("the wind", wind, true, "finite")?;
        }
        if let Some(drag) = drag {
            in_range(
                "the area of the drag",
                drag.area_m2,
                drag.area_m2 >= 0.0,
                "zero or more",
            )?;
            let coefficient = drag.coefficient;
            in_range(
                "the drag coefficient",
                coefficient,
                coefficient >= 0.0,
                "zero or more",
            )?;
        }
        let has_drag = || robot.links().iter().any(|link| link.drag.is_some());
        if wind_m_s.is_some() && drag.is_none() && !has_drag() {
            let robot = robot.name().to_owned();
            return Err(ResponseError::NoDrag { robot });
        }
        let steps = self.duration_s / self.physics_step_s();
        if steps > MOST_STEPS {
            return Err(ResponseError::TooLong { steps });
        }
        Ok(())
    }

    /// The physics step: a servo period, or the largest equal part of one that is at most a millisecond \[s\].
    pub(super) fn physics_step_s(&self) -> f64 {
        let parts = (self.servo_period_s / LONGEST_STEP_S - 1e-9)
            .ceil()
            .max(1.0);
        self.servo_period_s / parts
    }

    /// Positions before the step, shape `(n)` \[rad or m\].
    pub(super) fn start_q(&self, robot: &Robot) -> Result<Vec<f64>, ResponseError> {
        if self.start.is_empty() {
            return Ok(robot.home().to_vec());
        }
        let (expected, found) = (robot.n(), self.start.len());
        if expected != found {
            let what = "the start";
            return Err(ResponseError::Count {
                what,
                expected,
                found,
            });
        }
        for q in &self.start {
            in_range("the start", *q, true, "finite")?;
        }
        let gap_m = loop_gap_m(robot, &self.start);
        if gap_m > MOST_GAP_M {
            return Err(ResponseError::OpenLoop { gap_m });
        }
        Ok(self.start.clone())
    }

    /// The greatest effort of each joint, shape `(n)`; infinite where there is no limit \[N m or N\].
    pub(super) fn effort_limits(&self, robot: &Robot) -> Result<Vec<f64>, ResponseError> {
        let (n, found) = (robot.n(), self.effort_limit.len());
        match self.effort_limit[..] {
            // descriptions write 0 where nobody measured it
            [] => Ok(robot
                .moving_joints()
                .map(|joint| joint.limits.effort.filter(|limit| *limit > 0.0))
                .map(|limit| limit.unwrap_or(f64::INFINITY))
                .collect()),
            [all] => Ok(vec![all; n]),
            ref each if found == n => Ok(each.to_vec()),
            _ => Err(ResponseError::Count {
                what: "the effort limit",
                expected: n,
                found,
            }),
        }
    }

    /// The servos of all joints: the same gains everywhere, none where a joint follows others or has no drive.
    pub(super) fn servo(&self, robot: &Robot) -> Result<ServoSettings, ResponseError> {
        let mut gains = GainLists::none(robot.n());
        let joints: Vec<_> = robot.moving_joints().collect();
        for &i in robot.independent() {
            if !joints[i].passive {
                gains.kp[i] = self.gains.kp;
                gains.ki[i] = self.gains.ki;
                gains.kd[i] = self.gains.kd;
            }
        }
        gains.effort_limit = self.effort_limits(robot)?;
        let compensates = self.gravity_compensation;
        let servo = ServoSettings::new(robot, self.mode(), self.derivative, &gains, compensates)?;
        Ok(servo)
    }

    /// What the joints are commanded from the step on, shape `(n)`.
    pub(super) fn command(&self, start_q: &[f64]) -> Vec<f64> {
        let mut command = match self.fed {
            Fed::Position => start_q.to_vec(),
            Fed::Velocity => vec![0.0; start_q.len()],
        };
        command[self.joint] += self.step;
        command
    }
}
