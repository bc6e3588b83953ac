//! Settings of inverse kinematics: the method, its budgets, tolerances, limits, posture and joints.

use super::IkError;
use super::adaptive::Rules;
use super::query::check_positions;
use crate::kinematics::position_range::PositionRange;
use crate::model::robot::Robot;

/// Upper bound of the steps of one query: `max_iterations` times the number of starts.
pub const MOST_ITERATIONS: usize = 1_000_000;

/// The numerical method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Damped least squares with damping by the error, from several starts.
    Auto,
    /// Full steps of the pseudo-inverse; singular values below 1e-10 of the largest count as zero.
    PseudoInverse,
    /// Full steps `Jᵀ (J Jᵀ + λ² 1)⁻¹ e` of damped least squares, with a constant damping `λ` or with damping by the error.
    DampedLeastSquares {
        /// The damping `λ` \[m and rad per joint velocity\]; `None` to adapt it.
        damping: Option<f64>,
    },
    /// The pseudo-inverse, and if it does not converge, damped least squares from the same start.
    Fallback {
        /// The damping `λ` of the second; `None` to adapt it.
        damping: Option<f64>,
    },
}

/// Error clamping: the largest error that one step uses, so that a distant target is approached in pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorClamp {
    /// Largest distance \[m\].
    pub distance_m: f64,
    /// Largest angle \[rad\].
    pub angle_rad: f64,
}

/// A posture: joint positions to approach in the null space of the targets.
#[derive(Debug, Clone, PartialEq)]
pub struct Posture {
    /// The positions, shape `(n)` \[rad or m\].
    pub q: Vec<f64>,
    /// Gain: the fraction of the difference that one step removes, 0 to 1.
    pub gain: f64,
}

/// Settings of a query. The default is [`Method::Auto`] within joint limits.
#[derive(Debug, Clone, PartialEq)]
pub struct IkSettings {
    /// The numerical method.
    pub method: Method,
    /// Maximum number of steps from one start.
    pub max_iterations: usize,
    /// Number of further starts of [`Method::Auto`]; the other methods have a single start.
    pub restarts: usize,
    /// Tolerance of the position \[m\].
    pub tolerance_m: f64,
    /// Tolerance of the orientation \[rad\].
    pub tolerance_rad: f64,
    /// Whether joints stay within their limits. [`Method::Auto`] considers them in each step; the others clamp joints at them.
    pub respect_limits: bool,
    /// Error clamping, if any.
    pub error_clamp: Option<ErrorClamp>,
    /// The posture to approach in the null space of the targets, if any.
    pub posture: Option<Posture>,
    /// The entries of `q` that may move; `None` for all that move a frame of a goal. Dependent joints of loops always follow.
    pub chain: Option<Vec<usize>>,
}

impl Default for IkSettings {
    fn default() -> Self {
        Self {
            method: Method::Auto,
            max_iterations: 100,
            restarts: 100,
            tolerance_m: 1e-5,
            tolerance_rad: 1e-5,
            respect_limits: true,
            error_clamp: None,
            posture: None,
            chain: None,
        }
    }
}

impl IkSettings {
    pub(super) fn check(&self, robot: &Robot) -> Result<(), IkError> {
        let positive = |is: bool, what| {
            is.then_some(()).ok_or(IkError::Value {
                what,
                expected: "positive and finite",
            })
        };
        let size = |x: f64| x > 0.0 && x.is_finite();
        positive(size(self.tolerance_m), "the tolerance of the position")?;
        positive(size(self.tolerance_rad), "the tolerance of the orientation")?;
        if let Some(clamp) = &self.error_clamp {
            positive(size(clamp.distance_m), "the clamp of the distance")?;
            positive(size(clamp.angle_rad), "the clamp of the angle")?;
        }
        if let Method::DampedLeastSquares {
            damping: Some(damping),
        }
        | Method::Fallback {
            damping: Some(damping),
        } = self.method
            && !(damping >= 0.0 && damping.is_finite())
        {
            return Err(IkError::Value {
                what: "the damping",
                expected: "zero or more, and finite",
            });
        }
        if let Some(posture) = &self.posture {
            check_positions(robot, "the posture", &posture.q)?;
            if !(0.0..=1.0).contains(&posture.gain) {
                return Err(IkError::Value {
                    what: "the gain of the posture",
                    expected: "from 0 to 1",
                });
            }
        }
        if let Some(&index) = self.chain.iter().flatten().find(|&&i| i >= robot.n()) {
            return Err(IkError::NoSuchJoint {
                index,
                count: robot.n(),
            });
        }
        let starts = self.restarts.saturating_add(1);
        if self.max_iterations.saturating_mul(starts) > MOST_ITERATIONS {
            return Err(IkError::Budget {
                iterations: self.max_iterations,
                starts,
            });
        }
        Ok(())
    }

    /// Budget, limits and tolerances of one start.
    pub(super) fn rules<'a>(&self, ranges: &'a [PositionRange], impatient: bool) -> Rules<'a> {
        Rules {
            steps: self.max_iterations,
            tolerance_m: self.tolerance_m,
            tolerance_rad: self.tolerance_rad,
            limits: self.respect_limits.then_some(ranges),
            impatient,
        }
    }
}
