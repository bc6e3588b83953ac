//! Which steps take viscous damping implicitly: those with `h λ_max(M⁻¹ D) ≥ 0.5`.
//!
//! Runge-Kutta of order four diverges from `h λ = 2.785` on, and at 0.5 its error in a decaying velocity is 3e-4 of it a step. The rule
//! depends on the robot, the step and the configuration alone. `h λ_max < 0.5` holds exactly where `M - 2 h D` is positive definite,
//! which one pass over the bodies decides. An upper bound of `λ_max` over all configurations spares most robots that pass.

use crate::dynamics::ForwardDynamics;
use crate::dynamics::damping_rate::fastest_damping_rate_bound;
use crate::model::robot::Robot;

/// Damping is implicit from this `h λ_max` on.
const STIFF: f64 = 0.5;

/// The damping of one robot, as inertia in a step of one length.
#[derive(Debug, Clone)]
pub(super) struct ImplicitDamping {
    /// `h D` by parts of a step: the whole, a half, a third, a quarter. Empty where no configuration needs it.
    parts: Vec<Vec<f64>>,
    /// `-h D / STIFF`.
    test: Vec<f64>,
}

impl ImplicitDamping {
    /// The damping of `robot` in steps of `dt_s`.
    pub(super) fn new(robot: &Robot, dt_s: f64) -> Self {
        // NaN and infinity are in doubt
        let never = dt_s * fastest_damping_rate_bound(robot) < STIFF;
        if never {
            return Self {
                parts: Vec::new(),
                test: Vec::new(),
            };
        }
        let mut damping = vec![0.0; robot.n()];
        for body in robot.bodies() {
            damping[body.q_index] += body.gear * body.gear * body.damping;
        }
        let times = |factor: f64| damping.iter().map(|d| factor * d).collect::<Vec<f64>>();
        Self {
            parts: (1_u8..=4)
                .map(|parts| times(dt_s / f64::from(parts)))
                .collect(),
            test: times(-dt_s / STIFF),
        }
    }

    /// `h D`, shape `(n)`, if a step from `q` takes damping implicitly.
    pub(super) fn added_inertia(
        &self,
        robot: &Robot,
        dynamics: &mut ForwardDynamics,
        q: &[f64],
    ) -> Option<&[f64]> {
        let whole = self.parts.first()?;
        let is_slow = dynamics.is_positive_with(robot, q, &self.test);
        (!is_slow).then_some(whole)
    }

    /// `h D` of the whole step, shape `(n)`; empty where no configuration needs it.
    pub(super) fn whole_step(&self) -> &[f64] {
        self.part_of_step(1)
    }

    /// `h D` of a step of the `parts`-th part of the length, shape `(n)`; empty where no configuration needs it.
    pub(super) fn part_of_step(&self, parts: u8) -> &[f64] {
        let index = usize::from(parts).saturating_sub(1);
        self.parts.get(index).map_or(&[], Vec::as_slice)
    }
}

/// In a step of `dt_s` from `q` that takes damping implicitly, the joint that damping brakes fastest, and `h D` by the inertia that it
/// feels there with the other joints free; `None` where the step is explicit or `q` is not finite.
pub(crate) fn stiffest_joint(robot: &Robot, dt_s: f64, q: &[f64]) -> Option<(usize, f64)> {
    let mut dynamics = ForwardDynamics::new(robot);
    let damping = ImplicitDamping::new(robot, dt_s);
    let added = damping.added_inertia(robot, &mut dynamics, q)?;
    let inverse = dynamics.inverse_inertia(robot, q, None)?;
    let rates = added
        .iter()
        .enumerate()
        .map(|(i, d)| (i, d * inverse[(i, i)]));
    rates.reduce(|a, b| if b.1 > a.1 { b } else { a })
}
