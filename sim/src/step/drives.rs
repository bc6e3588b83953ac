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
//! What one drive does alone is in `joint_drive.rs`.
//!
//! Source: Stewart & Trinkle, *An implicit time-stepping scheme for rigid body dynamics* (1996), restricted to joints.

use nalgebra::Vector3;

use super::free::FreeStep;
use super::joint_drive::{Asked, JointDrive, is_off};
use super::smooth::Foreseen;
use crate::control::Gains;
use crate::dynamics::ForwardDynamics;
use crate::dynamics::dry_friction::friction_by_entry;
use crate::kinematics::position_range::position_ranges;
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
