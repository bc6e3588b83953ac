//! One joint under a sampled PID controller whose effort is held from one sample to the next: exact at every sample.
//!
//! Under a constant torque `u` the joint `J dω/dt + b ω = u` moves in a period `T`, with `E = e^{-bT/J}`, by
//!
//! ```text
//! ω⁺ = E ω + (1 - E)/b u          q⁺ = q + (1 - E) J/b ω + (T - (1 - E) J/b)/b u
//! ```
//!
//! so that nothing is integrated. The controller takes a backward difference for its derivative and a sum for its integral.
//!
//! Source: Åström & Wittenmark, *Computer-Controlled Systems* (1997), sec. 2.3 (zero-order hold), 8.5 (sampled PID).

use crate::joint_loop::{JointPlant, PidGains};

/// The quantity that the controller compares with its reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlledQuantity {
    /// Its position.
    Position,
    /// Its velocity.
    Velocity,
}

/// The source of the derivative term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rate {
    /// The difference of two errors, the one before the first being zero: a step of the reference kicks.
    OfError,
    /// The difference of two measurements, with its sign turned; zero at first.
    OfMeasurement,
    /// The velocity itself, with its sign turned.
    Velocity,
}

/// A joint with a sampled controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampledJoint {
    /// The joint.
    pub plant: JointPlant,
    /// The controller.
    pub gains: PidGains,
    /// Time from sample to sample \[s\].
    pub period_s: f64,
    /// The controlled quantity.
    pub controlled: ControlledQuantity,
    /// The source of its derivative term.
    pub rate: Rate,
}

/// The joint at a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMotion {
    /// Its position \[rad\].
    pub q_rad: f64,
    /// Its velocity \[rad/s\].
    pub qd_rad_s: f64,
}

impl SampledJoint {
    /// The joint at `count` samples after a step of the reference from 0 to `reference` at the first, where it rests at zero.
    pub fn step_response(&self, reference: f64, count: usize) -> Vec<JointMotion> {
        let PidGains { kp, ki, kd } = self.gains;
        let mut motion = JointMotion {
            q_rad: 0.0,
            qd_rad_s: 0.0,
        };
        let (mut sum, mut error_before, mut measured_before) = (0.0, 0.0, 0.0);
        let mut motions = Vec::with_capacity(count);
        for _ in 0..count {
            motions.push(motion);
            let measured = match self.controlled {
                ControlledQuantity::Position => motion.q_rad,
                ControlledQuantity::Velocity => motion.qd_rad_s,
            };
            let error = reference - measured;
            sum += error * self.period_s;
            let rate = match self.rate {
                Rate::OfError => (error - error_before) / self.period_s,
                Rate::OfMeasurement => (measured_before - measured) / self.period_s,
                Rate::Velocity => -motion.qd_rad_s,
            };
            (error_before, measured_before) = (error, measured);
            motion = self.held(motion, kp * error + ki * sum + kd * rate);
        }
        motions
    }

    /// The joint a period later, under a constant torque \[N m\].
    fn held(&self, JointMotion { q_rad, qd_rad_s }: JointMotion, torque_n_m: f64) -> JointMotion {
        let JointPlant {
            inertia_kg_m2: inertia,
            damping_n_m_s: damping,
        } = self.plant;
        let t = self.period_s;
        if damping == 0.0 {
            let acceleration = torque_n_m / inertia;
            return JointMotion {
                q_rad: q_rad + qd_rad_s * t + 0.5 * acceleration * t * t,
                qd_rad_s: qd_rad_s + acceleration * t,
            };
        }
        // (1 - E) J/b: the time for which the velocity of the start lasts
        let lasts_s = -libm::expm1(-damping * t / inertia) * inertia / damping;
        let final_speed = torque_n_m / damping;
        JointMotion {
            q_rad: q_rad + lasts_s * (qd_rad_s - final_speed) + t * final_speed,
            qd_rad_s: final_speed + (qd_rad_s - final_speed) * libm::exp(-damping * t / inertia),
        }
    }
}
