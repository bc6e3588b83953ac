//! When a run diverges: its state is no longer finite, or has an energy that no arm of a course can have.
//!
//! A run ends when the kinetic energy of the robot is that of its whole moving mass at [`RUNAWAY_SPEED_M_S`], or a dynamic body of the
//! scene is that fast. An unstable loop passes this bound within a fraction of a second, while its numbers can still be shown and plotted.

use crate::dynamics::energy::kinetic_energy_j;
use crate::model::robot::Robot;
use crate::step::hybrid::HybridStep;

/// A speed that no moving mass reaches in a stable run \[m/s\].
pub const RUNAWAY_SPEED_M_S: f64 = 1000.0;

/// Below these joint rates the energy is not checked: no arm diverges at them \[rad/s or m/s\].
const CALM_RATE: f64 = 100.0;

/// How a run diverged.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DivergenceKind {
    /// A joint's position or velocity is no longer finite.
    #[error("the state was no longer finite")]
    NotFinite {
        /// Index of the joint in `q`.
        joint: usize,
    },
    /// The robot's kinetic energy is beyond the bound.
    #[error(
        "the robot's kinetic energy {} {kinetic_j:.1e} J, beyond the bound of {bound_j:.1e} J,",
        if *.at_start { "began at" } else { "grew to" }
    )]
    Runaway {
        /// Index of the fastest joint in `q`.
        joint: usize,
        /// The energy \[J\].
        kinetic_j: f64,
        /// The bound \[J\].
        bound_j: f64,
        /// Whether it was beyond the bound where the run started; `kinetic_j` is that energy then.
        at_start: bool,
    },
    /// A dynamic body is faster than [`RUNAWAY_SPEED_M_S`].
    #[error("a body of the scene was as fast as {speed_m_s:.0} m/s")]
    BodyRunaway {
        /// Index of the body in the scene.
        body: usize,
        /// Its speed \[m/s\].
        speed_m_s: f64,
    },
    /// A body or a link in contact flew apart within one step.
    #[error("{} flew apart in contact", .body.as_ref().map_or_else(|| "a link".to_owned(), |body| format!("body `{body}`")))]
    InContact {
        /// The body's name; none where it is a link of the robot.
        body: Option<String>,
    },
}

/// Checks every state of a run for divergence.
#[derive(Debug, Clone)]
pub(crate) struct RunawayGuard {
    bound_j: f64,
    /// The kinetic energy at the start \[J\].
    start_j: f64,
}

impl RunawayGuard {
    /// For a run that starts at `(q, qd)`, shape `(n)` each.
    pub(crate) fn new(robot: &Robot, q: &[f64], qd: &[f64]) -> Self {
        let moving_kg: f64 = robot.bodies().iter().map(|body| body.mass_kg).sum();
        // a robot with nothing but armatures has no mass; a gram is less than the mass of any arm
        let mass_kg = moving_kg.max(1e-3);
        Self {
            start_j: kinetic_energy_j(robot, q, qd),
            bound_j: 0.5 * mass_kg * RUNAWAY_SPEED_M_S * RUNAWAY_SPEED_M_S,
        }
    }

    /// Whether the state `(q, qd)`, shape `(n)` each, or the state of `scene` has diverged, and how.
    pub(crate) fn check(
        &self,
        robot: &Robot,
        q: &[f64],
        qd: &[f64],
        scene: Option<&HybridStep>,
    ) -> Option<DivergenceKind> {
        let mut fastest = (0, 0.0_f64);
        for (joint, (position, rate)) in q.iter().zip(qd).enumerate() {
            if !(position.is_finite() && rate.is_finite()) {
                return Some(DivergenceKind::NotFinite { joint });
            }
            if rate.abs() > fastest.1 {
                fastest = (joint, rate.abs());
            }
        }
        if fastest.1 > CALM_RATE {
            let kinetic_j = kinetic_energy_j(robot, q, qd);
            // NaN is beyond any bound
            let bounded = kinetic_j <= self.bound_j;
            if !bounded {
                let at_start = self.start_j > self.bound_j;
                return Some(DivergenceKind::Runaway {
                    joint: fastest.0,
                    kinetic_j: if at_start { self.start_j } else { kinetic_j },
                    bound_j: self.bound_j,
                    at_start,
                });
            }
        }
        let (body, speed_m_s) = scene?.fastest_body()?;
        (speed_m_s > RUNAWAY_SPEED_M_S).then_some(DivergenceKind::BodyRunaway { body, speed_m_s })
    }
}
