//! The joint servo: a sampled PID on each joint, its effort held until the next sample.
//!
//! At sample `k`, with measurement `z` (position or velocity by mode), command `r`, period `Ts`:
//! `e = r - z`, `S = S + Ts e`, `u = kp e + ki S + kd D`, then gravity compensation is added and the sum clamped to the effort
//! limit. `D` is `(e - e_before) / Ts` with `e_before = 0` at first, or `-(z - z_before) / Ts` with `z_before = z` at first, or minus
//! the joint velocity. In effort mode the command itself takes the place of the PID.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::dynamics::rnea::Rnea;
use crate::kinematics::closure::independent_motions;
use crate::model::robot::Robot;

/// What a command means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Mode {
    /// Joint positions \[rad or m\].
    Position,
    /// Joint velocities \[rad/s or m/s\].
    Velocity,
    /// Joint efforts \[N m or N\].
    Effort,
    /// The joints follow laws. A command moves nothing: it says which efforts the controller expects \[N m or N\].
    Prescribed,
}

impl Mode {
    /// The word of lab files and requests.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Effort => "effort",
            Self::Prescribed => "prescribed",
        }
    }
}

/// Where the derivative term takes its rate from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Derivative {
    /// Backward difference of the error: kicks when the command jumps.
    Error,
    /// Backward difference of the measurement.
    Measurement,
    /// The joint velocity itself; for position mode.
    Velocity,
}

/// Gains and limits of one joint's servo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Effort per error \[N m/rad, N m s/rad, N/m or N s/m\].
    pub kp: f64,
    /// Effort per integrated error.
    pub ki: f64,
    /// Effort per rate of error.
    pub kd: f64,
    /// Greatest effort \[N m or N\]; infinite where unlimited.
    pub effort_limit: f64,
    /// Greatest effort of the integral term, `|ki S|` \[N m or N\]; infinite where unlimited.
    pub integral_limit: f64,
}

/// The servos of all joints.
#[derive(Debug, Clone, PartialEq)]
pub struct ServoSettings {
    /// What the command means.
    pub mode: Mode,
    /// Where the derivative comes from.
    pub derivative: Derivative,
    /// One per joint that moves.
    pub gains: Vec<Gains>,
    /// Whether gravity compensation is added.
    pub gravity_compensation: bool,
}

/// The gains and limits of all joints as a file or a request lists them: each list has one number per joint that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct GainLists {
    /// Effort per error, zero or more \[N m/rad, N m s/rad, N/m or N s/m\].
    pub kp: Vec<f64>,
    /// Effort per integrated error, zero or more.
    pub ki: Vec<f64>,
    /// Effort per rate of error, zero or more.
    pub kd: Vec<f64>,
    /// Greatest effort, positive \[N m or N\]; infinite where unlimited.
    pub effort_limit: Vec<f64>,
    /// Greatest effort of the integral term, positive \[N m or N\]; infinite where unlimited.
    pub integral_limit: Vec<f64>,
}

impl GainLists {
    /// No gain and no limit on any of `n` joints.
    pub fn none(n: usize) -> Self {
        Self {
            kp: vec![0.0; n],
            ki: vec![0.0; n],
            kd: vec![0.0; n],
            effort_limit: vec![f64::INFINITY; n],
            integral_limit: vec![f64::INFINITY; n],
        }
    }

    /// One set of gains per joint, each in its range.
    fn checked(&self, n: usize) -> Result<Vec<Gains>, ServoError> {
        for (what, list, is_limit) in [
            ("kp", &self.kp, false),
            ("ki", &self.ki, false),
            ("kd", &self.kd, false),
            ("effort_limit", &self.effort_limit, true),
            ("integral_limit", &self.integral_limit, true),
        ] {
            if list.len() != n {
                let (expected, found) = (n, list.len());
                return Err(ServoError::Count { expected, found });
            }
            // a limit of zero would leave a motor without effort; NaN is in no range
            let fits = |value: &f64| *value > 0.0 || (!is_limit && *value >= 0.0);
            match list.iter().copied().find(|value| !fits(value)) {
                Some(found) if is_limit => return Err(ServoError::Limit { what, found }),
                Some(found) => return Err(ServoError::Gain { what, found }),
                None => {}
            }
        }
        let gains = (0..n).map(|i| Gains {
            kp: self.kp[i],
            ki: self.ki[i],
            kd: self.kd[i],
            effort_limit: self.effort_limit[i],
            integral_limit: self.integral_limit[i],
        });
        Ok(gains.collect())
    }
}

impl ServoSettings {
    /// Settings for `robot`, by the same rules for labs and requests.
    ///
    /// Every joint that is not marked `passive` has a drive and gains, also a dependent joint of a loop: two drives in a loop work with
    /// or against each other, as they would in a real mechanism. Gains of passive joints have no effect.
    ///
    /// # Errors
    /// [`ServoError`]: a list of another length than the robot has joints that move, a negative gain, a limit that is not positive, a
    /// derivative that the mode does not have.
    pub fn new(
        robot: &Robot,
        mode: Mode,
        derivative: Derivative,
        gains: &GainLists,
        gravity_compensation: bool,
    ) -> Result<Self, ServoError> {
        let settings = Self {
            mode,
            derivative,
            gains: gains.checked(robot.n())?,
            gravity_compensation,
        };
        settings.check(robot)?;
        Ok(settings)
    }

    /// Whether the settings fit the robot and each other.
    fn check(&self, robot: &Robot) -> Result<(), ServoError> {
        let (expected, found) = (robot.n(), self.gains.len());
        if found != expected {
            return Err(ServoError::Count { expected, found });
        }
        let has_derivative = self.gains.iter().any(|g| g.kd != 0.0);
        let is_of_velocity = self.mode == Mode::Velocity && self.derivative == Derivative::Velocity;
        if is_of_velocity && has_derivative {
            return Err(ServoError::VelocityOfVelocity);
        }
        Ok(())
    }
}

/// Settings that do not fit the robot or each other.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ServoError {
    /// One set of gains per joint is needed.
    #[error("expected gains for {expected} joints, got {found}")]
    Count {
        /// Joints that move.
        expected: usize,
        /// Gains given.
        found: usize,
    },
    /// A gain that would push the joint away from its command.
    #[error("`{what}` must be zero or more, got {found}")]
    Gain {
        /// The name of the list.
        what: &'static str,
        /// The gain.
        found: f64,
    },
    /// A limit that would allow no effort.
    #[error("`{what}` must be positive, got {found}")]
    Limit {
        /// The name of the list.
        what: &'static str,
        /// The limit \[N m or N\].
        found: f64,
    },
    /// A derivative that needs a measured acceleration, in velocity mode.
    #[error(
        "derivative `velocity` is for position mode; in velocity mode take `measurement` or `error`"
    )]
    VelocityOfVelocity,
}

/// The servos with their state.
#[derive(Debug, Clone)]
pub struct Servo {
    settings: ServoSettings,
    period_s: f64,
    gravity_m_s2: Vector3<f64>,
    rnea: Rnea,
    gravity_effort: Vec<f64>,
    /// Which joints have a drive.
    driven: Vec<bool>,
    integral: Vec<f64>,
    before: Vec<f64>,
    started: bool,
}

impl Servo {
    /// Servos at rest, sampling every `period_s`.
    ///
    /// # Errors
    /// [`ServoError`] if the settings do not fit the robot or each other.
    pub fn new(
        robot: &Robot,
        settings: ServoSettings,
        period_s: f64,
        gravity_m_s2: Vector3<f64>,
    ) -> Result<Self, ServoError> {
        let n = robot.n();
        settings.check(robot)?;
        Ok(Self {
            settings,
            period_s,
            gravity_m_s2,
            rnea: Rnea::new(robot),
            gravity_effort: vec![0.0; n],
            driven: robot.moving_joints().map(|joint| !joint.passive).collect(),
            integral: vec![0.0; n],
            before: vec![0.0; n],
            started: false,
        })
    }

    /// Takes one sample and writes the effort to hold until the next, zero for joints without a drive; all slices have shape `(n)`.
    /// Allocates nothing, except in the gravity compensation of a robot with loops, whose dependent joints get none.
    pub fn sample(
        &mut self,
        robot: &Robot,
        command: &[f64],
        q: &[f64],
        qd: &[f64],
        effort: &mut [f64],
    ) {
        if self.settings.gravity_compensation {
            let hold = &mut self.gravity_effort;
            self.rnea.gravity(robot, &self.gravity_m_s2, q, hold);
            if !robot.loops().is_empty() {
                carried_by_independent(robot, q, hold);
            }
        }
        for (i, gains) in self.settings.gains.iter().enumerate() {
            if !self.driven[i] {
                effort[i] = 0.0;
                continue;
            }
            let u = match self.settings.mode {
                Mode::Effort | Mode::Prescribed => command[i],
                Mode::Position => {
                    let memory = (&mut self.integral[i], &mut self.before[i]);
                    let clock = (self.period_s, self.started);
                    pid(
                        &self.settings,
                        gains,
                        clock,
                        memory,
                        command[i],
                        q[i],
                        qd[i],
                    )
                }
                Mode::Velocity => {
                    let memory = (&mut self.integral[i], &mut self.before[i]);
                    let clock = (self.period_s, self.started);
                    pid(&self.settings, gains, clock, memory, command[i], qd[i], 0.0)
                }
            };
            let wanted = if self.settings.gravity_compensation {
                u + self.gravity_effort[i]
            } else {
                u
            };
            effort[i] = wanted.clamp(-gains.effort_limit, gains.effort_limit);
        }
        self.started = true;
    }
}

/// Maps the efforts of a tree to its independent joints; in a singular configuration, where that is impossible, it only sets those of
/// the dependent joints to zero.
fn carried_by_independent(robot: &Robot, q: &[f64], effort: &mut [f64]) {
    if let Ok(motions) = independent_motions(robot, q) {
        let tree = effort.to_vec();
        for (&i, column) in robot.independent().iter().zip(motions.column_iter()) {
            effort[i] = column.iter().zip(&tree).map(|(b, t)| b * t).sum();
        }
    }
    for &i in robot.dependent() {
        effort[i] = 0.0;
    }
}

/// One joint's PID; `clock` is the period \[s\] and whether a sample came before, `memory` the error's integral and the error
/// or measurement of the sample before.
fn pid(
    settings: &ServoSettings,
    gains: &Gains,
    (period_s, started): (f64, bool),
    (integral, before): (&mut f64, &mut f64),
    command: f64,
    measured: f64,
    rate: f64,
) -> f64 {
    let error = command - measured;
    *integral = bounded_integral(gains, *integral + period_s * error);
    let slope = match settings.derivative {
        Derivative::Error => {
            let slope = (error - *before) / period_s;
            *before = error;
            slope
        }
        Derivative::Measurement => {
            let slope = if started {
                (*before - measured) / period_s
            } else {
                0.0
            };
            *before = measured;
            slope
        }
        Derivative::Velocity => -rate,
    };
    // without an integral gain the sum must not matter even where it overflowed: 0 times infinity is NaN
    let held = if gains.ki == 0.0 {
        0.0
    } else {
        gains.ki * *integral
    };
    gains.kp * error + held + gains.kd * slope
}

fn bounded_integral(gains: &Gains, integral: f64) -> f64 {
    if gains.ki != 0.0 && gains.integral_limit.is_finite() {
        let bound = gains.integral_limit / gains.ki.abs();
        integral.clamp(-bound, bound)
    } else {
        integral
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::GRAVITY_M_S2;
    use crate::format::RobotFile;
    use crate::text::Source;

    fn slider() -> Robot {
        let text = r#"
            format = 1
            name = "slider"
            [[links]]
            name = "rail"
            [[links]]
            name = "cart"
            inertia = { mass_kg = 2.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
            [[joints]]
            name = "slide"
            type = "prismatic"
            parent = "rail"
            child = "cart"
            axis = [0, 0, 1]
        "#;
        let file = RobotFile::parse(Source::new("slider.toml", text)).unwrap();
        file.build(&[]).unwrap()
    }

    fn servo(mode: Mode, derivative: Derivative, compensate: bool) -> Servo {
        let gains = Gains {
            kp: 10.0,
            ki: 4.0,
            kd: 0.5,
            effort_limit: 30.0,
            integral_limit: 1.0,
        };
        let settings = ServoSettings {
            mode,
            derivative,
            gains: vec![gains],
            gravity_compensation: compensate,
        };
        Servo::new(&slider(), settings, 0.1, GRAVITY_M_S2).unwrap()
    }

    fn effort(servo: &mut Servo, command: f64, q: f64, qd: f64) -> f64 {
        let mut effort = [0.0];
        servo.sample(&slider(), &[command], &[q], &[qd], &mut effort);
        effort[0]
    }

    #[test]
    fn the_three_terms_by_hand() {
        let mut s = servo(Mode::Position, Derivative::Error, false);
        // e = 1: 10 + 4 * 0.1 + 0.5 * 1 / 0.1
        assert!((effort(&mut s, 1.0, 0.0, 0.0) - 15.4).abs() < 1e-12);
        // e = 0.5: 5 + 4 * 0.15 - 0.5 * 0.5 / 0.1
        assert!((effort(&mut s, 1.0, 0.5, 0.0) - 3.1).abs() < 1e-12);
        let mut s = servo(Mode::Position, Derivative::Measurement, false);
        assert!((effort(&mut s, 1.0, 0.0, 0.0) - 10.4).abs() < 1e-12);
        assert!((effort(&mut s, 1.0, 0.5, 0.0) - (5.0 + 0.6 - 2.5)).abs() < 1e-12);
        let mut s = servo(Mode::Position, Derivative::Velocity, false);
        assert!((effort(&mut s, 1.0, 0.0, 2.0) - (10.4 - 1.0)).abs() < 1e-12);
    }

    #[test]
    fn the_integral_term_stops_at_its_limit() {
        let mut s = servo(Mode::Position, Derivative::Velocity, false);
        for _ in 0..10 {
            effort(&mut s, 1.0, 0.0, 0.0);
        }
        assert!((effort(&mut s, 1.0, 0.0, 0.0) - 11.0).abs() < 1e-12);
        // and comes back at once
        assert!(effort(&mut s, -1.0, 0.0, 0.0) < -10.0 + 1.0 - 0.3);
    }

    #[test]
    fn compensation_carries_the_weight_within_the_limit() {
        let mut s = servo(Mode::Effort, Derivative::Error, true);
        assert!((effort(&mut s, 0.0, 0.0, 0.0) - 2.0 * 9.81).abs() < 1e-12);
        assert_eq!(effort(&mut s, 20.0, 0.0, 0.0), 30.0);
        assert_eq!(effort(&mut s, -90.0, 0.0, 0.0), -30.0);
    }

    #[test]
    fn velocity_mode_has_no_velocity_derivative() {
        let settings = servo(Mode::Position, Derivative::Velocity, false).settings;
        let settings = ServoSettings {
            mode: Mode::Velocity,
            ..settings
        };
        let refused = Servo::new(&slider(), settings, 0.1, GRAVITY_M_S2);
        assert_eq!(refused.map(|_| ()), Err(ServoError::VelocityOfVelocity));
    }

    #[test]
    fn gains_and_limits_out_of_range_are_refused_by_name() {
        let robot = slider();
        let new = |gains: &GainLists| {
            ServoSettings::new(&robot, Mode::Position, Derivative::Error, gains, false)
        };
        let none = GainLists::none(1);
        assert!(new(&none).is_ok());
        for (gains, expected) in [
            (
                GainLists {
                    kp: vec![-1.0],
                    ..none.clone()
                },
                "`kp` must be zero or more, got -1",
            ),
            (
                GainLists {
                    kd: vec![f64::NAN],
                    ..none.clone()
                },
                "`kd` must be zero or more, got NaN",
            ),
            (
                GainLists {
                    effort_limit: vec![0.0],
                    ..none.clone()
                },
                "`effort_limit` must be positive, got 0",
            ),
            (
                GainLists {
                    integral_limit: vec![-2.5],
                    ..none.clone()
                },
                "`integral_limit` must be positive, got -2.5",
            ),
            (
                GainLists {
                    ki: vec![0.0; 2],
                    ..none.clone()
                },
                "expected gains for 1 joints, got 2",
            ),
        ] {
            assert_eq!(new(&gains).unwrap_err().to_string(), expected);
        }
    }
}
