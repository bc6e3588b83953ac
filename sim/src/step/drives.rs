//! What the drives of a robot deliver of the efforts that its servos ask for: speed limits, torque-speed lines, losses of gears.
//!
//! The effort over a physics step is found from the rate at its end, for all joints together: an effort found from the rate at the
//! start would let a joint exceed its limit by what the motor adds in a step, and switch on and off around it. So a speed limit holds
//! at any gain, and nothing chatters. Joints are coupled through the mass matrix, dry friction and joint limits act in the same step;
//! each joint in turn is solved exactly, by projected Gauss-Seidel, as dry friction is. A drive whose limits do not bind delivers what
//! is asked for, to the last bit.
//!
//! The rates at the end are foreseen by a linear step. Where the step itself then ends beyond a speed limit, what was not foreseen is
//! added and the efforts are found again: it matters where a joint turns so far within a step that the mass matrix changes.
//!
//! On its torque-speed line a drive gives the mean of the line over the step, for the rate that a joint of this inertia alone would have:
//! the weight of the rate at the end is `weight_of_end`. For one joint under constant load that is the exact solution at any step.
//!
//! Source: Stewart & Trinkle, *An implicit time-stepping scheme for rigid body dynamics* (1996), restricted to joints; the weight is that
//! of exponential fitting: Liniger & Willoughby, *Efficient integration methods for stiff systems* (1970).

use nalgebra::Vector3;

use super::free::FreeStep;
use super::smooth::Foreseen;
use crate::control::Gains;
use crate::dynamics::ForwardDynamics;
use crate::dynamics::dry_friction::friction_by_entry;
use crate::kinematics::position_range::position_ranges;
use crate::model::drive::TorqueSpeedLine;
use crate::model::joint_friction::JointFriction;
use crate::model::robot::{Joint, Robot};

/// Sweeps over the joints: on arms, more than enough for rounding.
const SWEEPS: usize = 40;

/// Times that efforts are found again where the step ends beyond a speed limit.
const CORRECTIONS: usize = 12;

/// By this fraction a step may end beyond a speed limit.
const TOLERANCE: f64 = 1e-4;

/// A step that changes a rate by more than this fraction of its speed limit is checked even where no drive is at a limit.
const VIOLENT: f64 = 0.1;

/// A joint this fraction below its speed limit is at it: the integrator leaves it so near.
const AT_LIMIT: f64 = 1e-3;

/// The speed limits of the joints that have an entry in `q`; infinite where there is none or no drive to keep it \[rad/s or m/s\].
fn speed_limit(joint: &Joint) -> f64 {
    match joint.limits.speed {
        Some(limit) if !joint.passive => limit,
        _ => f64::INFINITY,
    }
}

/// The joints at their speed limits, as an event reports them.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedLimits(Vec<f64>);

impl SpeedLimits {
    /// The limits of the joints of `robot`.
    pub fn new(robot: &Robot) -> Self {
        Self(robot.moving_joints().map(speed_limit).collect())
    }

    /// Whether joint `joint` of `q` at the rate `qd` is at its limit: within a thousandth of it, or beyond.
    pub fn is_reached(&self, joint: usize, qd: f64) -> bool {
        qd.abs() >= (1.0 - AT_LIMIT) * self.0[joint]
    }
}

/// The drive of one entry of `q`, with what else acts on its joint within a step.
#[derive(Debug, Clone, Copy)]
struct JointDrive {
    /// \[rad/s or m/s\].
    speed_limit: f64,
    /// That of the servo \[N m or N\].
    effort_limit: f64,
    /// That of the servo or the joint, whichever is less: with so much it brakes at its speed limit, or with as much as is asked for where
    /// that is more.
    brake_limit: f64,
    line: Option<TorqueSpeedLine>,
    /// Effort at the joint per effort of the motor where the joint moves against it; 1 without losses.
    held_per_driven: f64,
    friction: JointFriction,
    range: (f64, f64),
}

impl JointDrive {
    fn is_limited(&self) -> bool {
        self.speed_limit < f64::INFINITY || self.line.is_some() || self.held_per_driven > 1.0
    }
}

/// What is known of a joint's step while all other joints are left as they are.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// Rate at the end of the step without any effort of drive, friction and stop on this joint.
    coasting: f64,
    /// Rate per effort over the step, positive.
    per_effort: f64,
    /// The effort that the servo asks for.
    effort: f64,
    /// Rate at the start of the step.
    rate: f64,
    /// Position limit that the joint is on: 1 the upper, -1 the lower, 0 none.
    stop: f64,
}

impl Asked {
    /// The same joint counted in the other direction.
    fn mirrored(self) -> Self {
        Self {
            coasting: -self.coasting,
            per_effort: self.per_effort,
            effort: -self.effort,
            rate: -self.rate,
            stop: -self.stop,
        }
    }
}

/// What becomes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Given {
    /// Rate at the end of the step.
    rate: f64,
    /// What the drive delivers to the joint.
    effort: f64,
}

/// The drives of one robot, with scratch memory.
#[derive(Debug, Clone)]
pub struct Drives {
    joints: Vec<JointDrive>,
    gravity_m_s2: Vector3<f64>,
    dt_s: f64,
    dynamics: ForwardDynamics,
    step: FreeStep,
    end_q: Vec<f64>,
    end_qd: Vec<f64>,
    accelerations: Vec<f64>,
    /// What the servos ask for.
    asked: Vec<f64>,
    /// Whether `accelerations` are those under `asked`.
    is_foreseen: bool,
    /// Rates at the end of the step with what is asked for, as far as they are foreseen.
    plain: Vec<f64>,
    rates: Vec<f64>,
    /// What friction, stops and drives add to the efforts asked for.
    added: Vec<f64>,
    delivered: Vec<f64>,
    is_limited: bool,
    has_friction: bool,
    met: Met,
}

/// What contact did to the rates in the last two steps.
#[derive(Debug, Clone)]
struct Met {
    before: Vec<f64>,
    last: Vec<f64>,
    used: Vec<f64>,
}

impl Drives {
    /// The drives of `robot` behind servos with these `gains`, for steps of `dt_s` under `gravity_m_s2` (world).
    pub fn new(robot: &Robot, gains: &[Gains], gravity_m_s2: Vector3<f64>, dt_s: f64) -> Self {
        let zeros = vec![0.0; robot.n()];
        let frictions = friction_by_entry(robot);
        let ranges = position_ranges(robot);
        let joints: Vec<JointDrive> = robot
            .moving_joints()
            .enumerate()
            .map(|(i, joint)| {
                let effort_limit = gains.get(i).map_or(f64::INFINITY, |g| g.effort_limit);
                JointDrive {
                    speed_limit: speed_limit(joint),
                    effort_limit,
                    brake_limit: effort_limit.min(joint.limits.effort.unwrap_or(f64::INFINITY)),
                    line: joint.drive.and_then(|drive| drive.line),
                    held_per_driven: joint.drive.map_or(1.0, |drive| drive.held_per_driven()),
                    friction: frictions[i],
                    range: (ranges[i].lower, ranges[i].upper),
                }
            })
            .collect();
        let rubs = |joint: &JointDrive| joint.friction != JointFriction::default();
        Self {
            is_limited: joints.iter().any(JointDrive::is_limited),
            has_friction: joints.iter().any(rubs),
            joints,
            gravity_m_s2,
            dt_s,
            dynamics: ForwardDynamics::new(robot),
            step: FreeStep::new(robot, gravity_m_s2, dt_s),
            end_q: zeros.clone(),
            end_qd: zeros.clone(),
            accelerations: zeros.clone(),
            asked: zeros.clone(),
            is_foreseen: false,
            plain: zeros.clone(),
            rates: zeros.clone(),
            added: zeros.clone(),
            delivered: zeros.clone(),
            met: Met {
                before: zeros.clone(),
                last: zeros.clone(),
                used: zeros,
            },
        }
    }

    /// Replaces the efforts that the servos ask for by those that the drives deliver over the step from `(q, qd)`; all slices have shape
    /// `(n)`.
    ///
    /// Does nothing to a robot with a joint that moves no inertia: the step itself reports it.
    pub fn deliver(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        if !self.is_limited {
            return;
        }
        self.is_foreseen = false;
        let gravity = &self.gravity_m_s2;
        let free =
            self.dynamics
                .acceleration(robot, gravity, q, qd, effort, &mut self.accelerations);
        if free.is_err() {
            return;
        }
        for (i, rate) in self.plain.iter_mut().enumerate() {
            *rate = qd[i] + self.dt_s * self.accelerations[i] + self.met.used[i];
        }
        self.rates.copy_from_slice(&self.plain);
        // NaN is left to the guard against divergence
        let mut known = self.rates.iter().chain(effort.iter());
        if !known.all(|x| x.is_finite()) {
            return;
        }
        self.asked.copy_from_slice(effort);
        self.is_foreseen = true;
        if self.has_friction || !self.none_binds(qd, effort) {
            self.solve(robot, q, qd, effort);
        }
        if self.is_violent(qd, effort) {
            self.correct(robot, q, qd, effort);
        }
    }

    /// The accelerations at `(q, qd)`, the state of the last call of [`Drives::deliver`], under the efforts that the servos asked for;
    /// `None` where they were not needed.
    pub(crate) fn foreseen<'a>(&'a self, q: &'a [f64], qd: &'a [f64]) -> Option<Foreseen<'a>> {
        self.is_foreseen.then_some(Foreseen {
            q,
            qd,
            effort: &self.asked,
            qdd: &self.accelerations,
        })
    }

    /// Whether the end of the step may be far from what is foreseen: a drive is at a limit, or a rate changes by much of its limit.
    fn is_violent(&self, qd: &[f64], effort: &[f64]) -> bool {
        let mut given = effort.iter().zip(&self.asked);
        let mut changes = self.rates.iter().zip(qd).zip(&self.joints);
        given.any(|(given, asked)| given.to_bits() != asked.to_bits())
            || changes
                .any(|((end, start), joint)| (end - start).abs() > VIOLENT * joint.speed_limit)
    }

    /// Finds the efforts again for as long as the step ends beyond a speed limit that a drive keeps.
    fn correct(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        for _ in 0..CORRECTIONS {
            self.end_q.copy_from_slice(q);
            self.end_qd.copy_from_slice(qd);
            let (end_q, end_qd) = (&mut self.end_q, &mut self.end_qd);
            if self.step.advance(robot, effort, end_q, end_qd).is_err() {
                return;
            }
            for (end, met) in self.end_qd.iter_mut().zip(&self.met.used) {
                *end += met;
            }
            let exceeds = |i: usize| {
                let most = self.joints[i].speed_limit.max(self.rates[i].abs());
                self.end_qd[i].abs() > most * (1.0 + TOLERANCE) && !is_off(self.asked[i])
            };
            let finite = self.end_qd.iter().all(|end| end.is_finite());
            if !finite || !(0..q.len()).any(exceeds) {
                return;
            }
            for (i, plain) in self.plain.iter_mut().enumerate() {
                *plain += self.end_qd[i] - self.rates[i];
            }
            self.rates.copy_from_slice(&self.plain);
            effort.copy_from_slice(&self.asked);
            self.solve(robot, q, qd, effort);
        }
    }

    /// Whether every drive can give what is asked for from the start of the step to its end.
    fn none_binds(&self, qd: &[f64], effort: &[f64]) -> bool {
        self.joints.iter().enumerate().all(|(i, joint)| {
            let (start, end, asked) = (qd[i], self.rates[i], effort[i]);
            let on_line = joint.line.is_none_or(|line| {
                [start, end]
                    .iter()
                    .all(|rate| line.least(*rate) <= asked && asked <= line.most(*rate))
            });
            let drives =
                joint.held_per_driven <= 1.0 || (asked * start >= 0.0 && asked * end >= 0.0);
            let slow = end.abs() <= joint.speed_limit || is_off(asked);
            slow && on_line && drives
        })
    }

    /// Finds what all drives deliver together.
    fn solve(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        let Some(inverse) = self.dynamics.inverse_inertia(robot, q, None) else {
            return;
        };
        self.added.fill(0.0);
        self.delivered.copy_from_slice(effort);
        for _ in 0..SWEEPS {
            // a sweep that changes no bit is followed by others that change none
            let mut is_settled = true;
            for i in 0..self.joints.len() {
                let per_effort = self.dt_s * inverse[(i, i)];
                // no effort moves a joint that the loops lock
                if per_effort <= 0.0 {
                    continue;
                }
                let joint = &self.joints[i];
                // with what is asked for, and nothing else on this joint
                let plain = self.rates[i] - per_effort * self.added[i];
                let asked = Asked {
                    coasting: plain - per_effort * effort[i],
                    per_effort,
                    effort: effort[i],
                    rate: qd[i],
                    stop: stop(joint.range, q[i]),
                };
                let given = joint.given(asked);
                self.delivered[i] = given.effort;
                let next = (given.rate - plain) / per_effort;
                let change = next - self.added[i];
                is_settled &= next.to_bits() == self.added[i].to_bits();
                self.added[i] = next;
                for (j, rate) in self.rates.iter_mut().enumerate() {
                    let moved = *rate + self.dt_s * inverse[(j, i)] * change;
                    is_settled &= rate.to_bits() == moved.to_bits();
                    *rate = moved;
                }
            }
            if is_settled {
                break;
            }
        }
        effort.copy_from_slice(&self.delivered);
    }

    /// Takes note of what contact did in the step that ended at `qd`: whatever differs from the rates foreseen. `in_contact` is whether
    /// the state is the contact engine's.
    ///
    /// A joint that presses on something needs the effort that contact takes up, so the next step counts on it: on the lesser of what
    /// contact did in the last two steps, which leaves out impacts.
    pub fn meet(&mut self, qd: &[f64], in_contact: bool) {
        if !self.is_limited {
            return;
        }
        let Met { before, last, used } = &mut self.met;
        std::mem::swap(before, last);
        for i in 0..qd.len() {
            last[i] = match in_contact {
                true => qd[i] - (self.rates[i] - used[i]),
                false => 0.0,
            };
            used[i] = if before[i] * last[i] > 0.0 {
                last[i].signum() * before[i].abs().min(last[i].abs())
            } else {
                0.0
            };
        }
    }
}

/// Whether a motor is off, because nothing is asked of it: then its electronics keep no speed limit.
fn is_off(effort: f64) -> bool {
    effort == 0.0
}

/// 1 on the upper limit or beyond, -1 on the lower one, 0 between them.
fn stop((lower, upper): (f64, f64), q: f64) -> f64 {
    if q >= upper {
        1.0
    } else if q <= lower {
        -1.0
    } else {
        0.0
    }
}

impl TorqueSpeedLine {
    /// Effort per rate by which the line falls.
    fn slope(&self) -> f64 {
        self.stall / self.free_speed
    }

    /// The greatest effort at `rate`: at full voltage.
    fn most(&self, rate: f64) -> f64 {
        self.stall - self.slope() * rate
    }

    /// The least effort at `rate`: at full voltage of the other sign.
    fn least(&self, rate: f64) -> f64 {
        -self.stall - self.slope() * rate
    }
}

/// A line of efforts over the rate at the end of the step: `at_rest - slope * rate`.
#[derive(Debug, Clone, Copy)]
struct Falling {
    at_rest: f64,
    slope: f64,
}

impl JointDrive {
    /// Rate and effort of the joint at the end of the step.
    fn given(&self, asked: Asked) -> Given {
        let at_rest = self.motor_at_rest(&asked);
        let other = at_rest * self.held_per_driven;
        let (least, most) = (at_rest.min(other), at_rest.max(other));
        let JointFriction { positive, negative } = self.friction;
        let needed = -asked.coasting / asked.per_effort;
        if needed > most + negative {
            let back = JointDrive {
                friction: JointFriction {
                    positive: negative,
                    negative: positive,
                },
                ..*self
            };
            let given = back.given_forwards(asked.mirrored());
            Given {
                rate: -given.rate,
                effort: -given.effort,
            }
        } else if needed < least - positive {
            self.given_forwards(asked)
        } else {
            // it stands: friction takes up what it can, the gear's loss the rest
            let effort = at_rest.max(needed - negative).min(needed + positive);
            Given { rate: 0.0, effort }
        }
    }

    /// As [`JointDrive::given`] for a joint that moves towards greater positions at the end of the step.
    fn given_forwards(&self, asked: Asked) -> Given {
        if asked.stop > 0.0 {
            let effort = self.motor_at_rest(&asked);
            return Given { rate: 0.0, effort };
        }
        let coasting = asked.coasting - asked.per_effort * self.friction.positive;
        let under = |effort: f64| Given {
            rate: coasting + asked.per_effort * effort,
            effort,
        };
        let at_joint = |motor: f64| {
            motor
                * if motor < 0.0 {
                    self.held_per_driven
                } else {
                    1.0
                }
        };
        let mut given = under(at_joint(asked.effort));
        if let Some(line) = &self.line {
            let [most, least] = self.ends(line, &asked);
            // the effort falls with the rate, so the side on which the asked one lies beyond the line is the side of the solution
            if asked.effort > most.at(given.rate) {
                given = under(at_joint(self.bounded(self.on(most, coasting, &asked))));
            } else if asked.effort < least.at(given.rate) {
                given = under(at_joint(self.bounded(self.on(least, coasting, &asked))));
            }
        }
        if given.rate > self.speed_limit && !is_off(asked.effort) {
            let needed = (self.speed_limit - coasting) / asked.per_effort;
            let most = self
                .line
                .map_or(f64::NEG_INFINITY, |line| line.least(self.speed_limit));
            let brake = most.max(-self.brake_limit.max(asked.effort.abs()));
            given = under(needed.max(at_joint(brake)));
        }
        given
    }

    /// The motor's effort where the joint is at rest at the end of the step.
    fn motor_at_rest(&self, asked: &Asked) -> f64 {
        match &self.line {
            None => asked.effort,
            Some(line) => {
                let [most, least] = self.ends(line, asked);
                let within = asked.effort.max(least.at_rest).min(most.at_rest);
                self.bounded(within)
            }
        }
    }

    fn bounded(&self, motor: f64) -> f64 {
        motor.max(-self.effort_limit).min(self.effort_limit)
    }

    /// Both ends of what the motor can give, as mean over the step.
    fn ends(&self, line: &TorqueSpeedLine, asked: &Asked) -> [Falling; 2] {
        let weight = weight_of_end(asked.per_effort * line.slope());
        let start = (1.0 - weight) * asked.rate;
        let slope = weight * line.slope();
        [line.most(start), line.least(start)].map(|at_rest| Falling { at_rest, slope })
    }

    /// The motor's effort where the joint moves forwards at the end of the step and the motor is on `end`.
    fn on(&self, end: Falling, coasting: f64, asked: &Asked) -> f64 {
        let with_loss = |gain: f64| {
            let rate = (coasting + asked.per_effort * gain * end.at_rest)
                / (1.0 + asked.per_effort * gain * end.slope);
            end.at(rate)
        };
        let driving = with_loss(1.0);
        if driving < 0.0 {
            with_loss(self.held_per_driven)
        } else {
            driving
        }
    }
}

impl Falling {
    fn at(&self, rate: f64) -> f64 {
        self.at_rest - self.slope * rate
    }
}

/// The weight of the rate at the end of a step in the mean of a torque-speed line over it, where `z` is the step by the time constant of
/// the joint on the line: `1 / (1 - exp(-z)) - 1 / z`, from a half (slow) to one (fast).
fn weight_of_end(z: f64) -> f64 {
    // below, the difference of the two fractions loses more digits than the series leaves out
    if z < 1e-3 {
        0.5 + z / 12.0
    } else {
        -1.0 / libm::expm1(-z) - 1.0 / z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive() -> JointDrive {
        JointDrive {
            speed_limit: f64::INFINITY,
            effort_limit: f64::INFINITY,
            brake_limit: f64::INFINITY,
            line: None,
            held_per_driven: 1.0,
            friction: JointFriction::default(),
            range: (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// A joint at rest that 1 N brings to 1 m/s in the step.
    fn asked(effort: f64) -> Asked {
        Asked {
            coasting: 0.0,
            per_effort: 1.0,
            effort,
            rate: 0.0,
            stop: 0.0,
        }
    }

    fn given(drive: JointDrive, asked: Asked) -> (f64, f64) {
        let Given { rate, effort } = drive.given(asked);
        (rate, effort)
    }

    #[test]
    fn a_speed_limit_is_met_exactly_from_either_side() {
        let limited = JointDrive {
            speed_limit: 2.0,
            ..drive()
        };
        assert_eq!(given(limited, asked(1.5)), (1.5, 1.5));
        assert_eq!(given(limited, asked(1e9)), (2.0, 2.0));
        assert_eq!(given(limited, asked(-1e9)), (-2.0, -2.0));
        // a load that takes it along is braked, as far as the drive can
        let falling = Asked {
            coasting: 7.0,
            ..asked(0.5)
        };
        assert_eq!(given(limited, falling), (2.0, -5.0));
        // unless it is off
        let coasting = Asked {
            effort: 0.0,
            ..falling
        };
        assert_eq!(given(limited, coasting), (7.0, 0.0));
        let weak = JointDrive {
            brake_limit: 3.0,
            ..limited
        };
        assert_eq!(given(weak, falling), (4.0, -3.0));
        // friction helps, and is overcome first
        let rough = JointDrive {
            friction: JointFriction {
                positive: 1.0,
                negative: 4.0,
            },
            ..limited
        };
        assert_eq!(given(rough, falling), (2.0, -4.0));
        assert_eq!(given(rough, asked(1e9)), (2.0, 3.0));
        assert_eq!(given(rough, asked(0.5)), (0.0, 0.5));
        assert_eq!(given(rough, asked(-3.5)), (0.0, -3.5));
        assert_eq!(given(rough, asked(-5.0)), (-1.0, -5.0));
    }

    #[test]
    fn a_joint_on_its_stop_gets_the_whole_effort_and_stays() {
        let limited = JointDrive {
            speed_limit: 2.0,
            ..drive()
        };
        let on = |stop: f64, effort: f64| {
            given(
                limited,
                Asked {
                    stop,
                    ..asked(effort)
                },
            )
        };
        assert_eq!(on(1.0, 50.0), (0.0, 50.0));
        assert_eq!(on(-1.0, -50.0), (0.0, -50.0));
        assert_eq!(on(1.0, -50.0), (-2.0, -2.0));
    }

    #[test]
    fn the_line_gives_the_rate_of_the_exact_solution() {
        // M dv/dt = stall (1 - v / free): v = free (1 - exp(-t stall / (M free))), here after one step of z time constants
        for z in [1e-6_f64, 1e-3, 0.1, 1.0, 30.0] {
            let (stall, free_speed) = (10.0, 4.0);
            let motor = JointDrive {
                line: Some(TorqueSpeedLine { stall, free_speed }),
                ..drive()
            };
            let step = Asked {
                per_effort: z * free_speed / stall,
                ..asked(1e6)
            };
            let exact = -free_speed * libm::expm1(-z);
            let (rate, _) = given(motor, step);
            assert!((rate - exact).abs() <= 1e-12 * exact, "{z}: {rate} {exact}");
            let (back, _) = given(motor, step.mirrored());
            assert!((back + exact).abs() <= 1e-12 * exact, "{z}: {back}");
            // beyond the free speed it brakes, towards free (1 + load / stall)
            let pulled = Asked {
                coasting: 3.0 * free_speed,
                rate: 3.0 * free_speed,
                ..step
            };
            let exact = free_speed * (1.0 + 2.0 * libm::exp(-z));
            let (rate, effort) = given(motor, pulled);
            assert!((rate - exact).abs() <= 1e-12 * exact, "{z}: {rate} {exact}");
            assert!(effort < 0.0);
        }
    }

    #[test]
    fn a_gear_with_losses_is_harder_to_drive_back() {
        // efficiency 0.5: what drives with 1 holds against 4
        let lossy = JointDrive {
            held_per_driven: 4.0,
            ..drive()
        };
        let loaded = |load: f64| {
            given(
                lossy,
                Asked {
                    coasting: load,
                    ..asked(1.0)
                },
            )
        };
        assert_eq!(loaded(-0.5), (0.5, 1.0));
        assert_eq!(loaded(-1.0), (0.0, 1.0));
        assert_eq!(loaded(-3.0), (0.0, 3.0));
        assert_eq!(loaded(-4.5), (-0.5, 4.0));
    }
}
