//! Where the sampled loop of the whole robot becomes unstable: by each gain, and by the servo period.

use nalgebra::Vector3;

use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::control::{VariedGain, sampled_loop, stable_gain_factor};
use kinemark_sim::model::robot::Robot;

use super::settings::{ResponseError, ResponseSettings};

/// A limit of one gain of all joints, the other gains as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GainLimit {
    /// The gain.
    pub name: &'static str,
    /// The gain up to which the loop is stable; infinite if it is with 256 times the gain, `None` if it is not with a 256th.
    pub limit: Option<f64>,
}

/// Whether the loop near rest is stable, and up to where; of the positions at the start and at the end of the step, the stricter.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityLimit {
    /// Whether the loop is stable.
    pub is_stable: bool,
    /// By which factor the fastest growing motion grows from one servo sample to the next.
    pub growth: f64,
    /// The entry of `q` that moves most in it.
    pub worst_joint: usize,
    /// The greatest factor, at most 1, on all gains together with which the loop is stable; `None` if there is none down to 1e-5.
    pub share_of_all: Option<f64>,
    /// The limits of the gains that are not zero.
    pub gains: Vec<GainLimit>,
    /// The servo period up to which these gains are stable \[s\]; infinite and `None` as in [`GainLimit::limit`].
    pub period_s: Option<f64>,
}

/// The smaller of two limits; none where one of them is none.
fn stricter(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    Some(a?.min(b?))
}

impl StabilityLimit {
    fn and(self, other: Self) -> Self {
        let gains = self.gains.iter().zip(&other.gains).map(|(a, b)| GainLimit {
            name: a.name,
            limit: stricter(a.limit, b.limit),
        });
        Self {
            is_stable: self.is_stable && other.is_stable,
            growth: self.growth.max(other.growth),
            worst_joint: if other.growth > self.growth {
                other.worst_joint
            } else {
                self.worst_joint
            },
            share_of_all: stricter(self.share_of_all, other.share_of_all),
            gains: gains.collect(),
            period_s: stricter(self.period_s, other.period_s),
        }
    }
}

/// The limits of the loop; `None` where the loop cannot be analysed, such as with singular loops or more than 40 joints.
pub(super) fn stability_limit(
    robot: &Robot,
    settings: &ResponseSettings,
    start_q: &[f64],
) -> Result<Option<StabilityLimit>, ResponseError> {
    let servo = settings.servo(robot)?;
    let gravity = Vector3::new(0.0, 0.0, -settings.surroundings.gravity_m_s2);
    let period_s = settings.servo_period_s;
    let mut places = vec![start_q.to_vec()];
    // where loops join the joints, another position would have to be closed first
    if settings.fed == Fed::Position && robot.loops().is_empty() {
        places.push(settings.command(start_q));
    }
    let gains = [
        ("kp", VariedGain::Kp, settings.gains.kp),
        ("ki", VariedGain::Ki, settings.gains.ki),
        ("kd", VariedGain::Kd, settings.gains.kd),
    ];
    let limits = places.iter().map(|q| {
        let found = sampled_loop(robot, &servo, period_s, &gravity, q)?;
        let given = gains.iter().filter(|(_, _, gain)| *gain > 0.0);
        let limits = given.map(|&(name, varied, gain)| {
            let factor = stable_gain_factor(robot, &servo, period_s, &gravity, q, varied);
            let limit = factor.map(|factor| factor * gain);
            GainLimit { name, limit }
        });
        Some(StabilityLimit {
            is_stable: found.is_stable(),
            growth: found.spectral_radius,
            worst_joint: found.worst_joint,
            share_of_all: found.stable_share_of_all,
            gains: limits.collect(),
            period_s: found.stable_period_s,
        })
    });
    let limits: Option<Vec<StabilityLimit>> = limits.collect();
    Ok(limits.and_then(|limits| limits.into_iter().reduce(StabilityLimit::and)))
}
