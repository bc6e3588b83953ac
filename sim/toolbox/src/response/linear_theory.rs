//! The linear theory: the joint alone under an ideal PID controller, all others held, without gravity, friction, limits and sampling.

use kinemark_sim::control::linear_step::{Fed, LinearStep};
use kinemark_sim::control::{Derivative, JointAlone};
use kinemark_sim::model::robot::Robot;

use super::analysis::Measured;
use super::settings::{FINAL_S, ResponseSettings};

/// Values of the linear response for each physics step: its measures are then exact to about four digits where the run's are to three.
const FINER: usize = 16;

/// What linear theory says of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearTheory {
    /// The loop.
    pub linear_loop: LinearStep,
    /// The response at every physics step, the first one just after the step \[rad or m, rad/s or m/s\].
    pub values: Vec<f64>,
    /// What is measured of it.
    pub measured: Measured,
}

impl LinearTheory {
    /// The theory of a step from `start`, over so many physics steps of `step_s`, with the joints at `q`.
    ///
    /// `None` where the joint moves no inertia, and where the loop is too fast for its numbers.
    pub(super) fn new(
        robot: &Robot,
        settings: &ResponseSettings,
        q: &[f64],
        (start, steps, step_s): (f64, usize, f64),
    ) -> Option<Self> {
        let JointAlone { inertia, damping } = JointAlone::new(robot, q, settings.joint)?;
        let linear_loop = LinearStep {
            fed: settings.fed,
            inertia_kg_m2: inertia,
            damping_n_m_s: damping,
            kp: settings.gains.kp,
            ki: settings.gains.ki,
            kd: settings.gains.kd,
            derivative_of_error: settings.derivative == Derivative::Error,
        };
        let interval_s = step_s / FINER as f64;
        let mut fine = linear_loop.response(interval_s, FINER * steps + 1)?;
        for value in &mut fine {
            *value = start + settings.step * *value;
        }
        let measured = Measured::of(&fine, interval_s, start, start + settings.step, FINAL_S);
        Some(Self {
            linear_loop,
            values: fine.iter().step_by(FINER).copied().collect(),
            measured,
        })
    }

    /// The natural frequency of a position loop without its integral term \[rad/s\]; none of a velocity loop, or without stiffness.
    pub fn natural_frequency_rad_s(&self) -> Option<f64> {
        let LinearStep {
            fed,
            inertia_kg_m2: inertia,
            kp,
            ..
        } = self.linear_loop;
        (fed == Fed::Position && kp > 0.0).then(|| (kp / inertia).sqrt())
    }

    /// The damping ratio of the same.
    pub fn damping_ratio(&self) -> Option<f64> {
        let LinearStep {
            inertia_kg_m2: inertia,
            damping_n_m_s: damping,
            kd,
            ..
        } = self.linear_loop;
        let frequency = self.natural_frequency_rad_s()?;
        Some(0.5 * (damping + kd) / (inertia * frequency))
    }

    /// The share of the step that a velocity loop takes at once; none of a position loop.
    pub fn share_at_once(&self) -> Option<f64> {
        let LinearStep {
            fed,
            inertia_kg_m2: inertia,
            kd,
            derivative_of_error,
            ..
        } = self.linear_loop;
        let kick = if derivative_of_error { kd } else { 0.0 };
        (fed == Fed::Velocity).then(|| kick / (inertia + kd))
    }

    /// The share of the step to which a velocity loop comes without its integral term; none of a position loop, or without damping and
    /// gain.
    pub fn share_by_proportional(&self) -> Option<f64> {
        let LinearStep {
            fed,
            damping_n_m_s: damping,
            kp,
            ..
        } = self.linear_loop;
        (fed == Fed::Velocity && damping + kp > 0.0).then(|| kp / (damping + kp))
    }

    /// The time constant of the same \[s\].
    pub fn time_constant_s(&self) -> Option<f64> {
        let LinearStep {
            inertia_kg_m2: inertia,
            damping_n_m_s: damping,
            kp,
            kd,
            ..
        } = self.linear_loop;
        self.share_by_proportional()?;
        Some((inertia + kd) / (damping + kp))
    }
}
