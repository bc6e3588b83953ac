//! The linear loop drawn beside a step response: numbers that make a loop, and one that stays bounded.

use kinemark_sim::control::LinearStep;
use kinemark_sim::control::linear_step::Fed;
use schemars::JsonSchema;
use serde::Deserialize;

use super::reading::{At, MotionReading};
use crate::task::problem::{LabError, problems};

/// The linear loop drawn beside the run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PredictionTable {
    /// Moment of inertia about the joint \[kg m²\]; for a prismatic joint the mass that it moves \[kg\].
    inertia: f64,
    /// Viscous damping \[N m s/rad, or N s/m\]; 0 where it is left out.
    #[serde(default)]
    damping: f64,
    /// Proportional gain; 0 where it is left out.
    #[serde(default)]
    kp: f64,
    /// Integral gain; 0 where it is left out.
    #[serde(default)]
    ki: f64,
    /// Derivative gain; 0 where it is left out.
    #[serde(default)]
    kd: f64,
    /// What the derivative is taken of: `error` or `measurement` (`velocity` is the same); `error` where it is left out.
    #[serde(default)]
    derivative: DerivativeOf,
}

/// What the derivative of a predicted loop is taken of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum DerivativeOf {
    #[default]
    Error,
    Measurement,
    Velocity,
}

problems! {
    /// Numbers that make no loop, or none that can be drawn.
    enum LoopProblem {
        Inertia { inertia: f64 }:
            "lab::prediction", "`inertia` must be positive, got {inertia}", "this prediction",
            "it is the joint's moment of inertia [kg m²]";
        Negative { name: &'static str, value: f64 }:
            "lab::prediction", "`{name}` must be zero or more, got {value}", "this prediction", "left out it is 0";
        Unstable { damped: f64, driven: f64 }:
            "lab::prediction", "the predicted loop is unstable: (damping + kd) kp = {damped} is less than inertia ki = {driven}",
            "this prediction", "predict a loop that settles, or leave the prediction out";
        TooFast:
            "lab::prediction", "the predicted loop is too fast to be computed", "this prediction", "look at its inertia and gains";
    }
}

impl MotionReading<'_> {
    /// The loop that a table describes, closed over the signal `of`.
    pub(super) fn prediction(
        &self,
        typed: &At<PredictionTable>,
        of: Fed,
    ) -> Result<LinearStep, LabError> {
        let table = typed.get_ref();
        let refuse = |problem| self.refuse_at(typed, problem);
        let inertia = table.inertia;
        if !(inertia > 0.0 && inertia.is_finite()) {
            return refuse(LoopProblem::Inertia { inertia });
        }
        let others = [
            ("damping", table.damping),
            ("kp", table.kp),
            ("ki", table.ki),
            ("kd", table.kd),
        ];
        for (name, value) in others {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(LoopProblem::Negative { name, value });
            }
        }
        let prediction = LinearStep {
            fed: of,
            inertia_kg_m2: inertia,
            damping_n_m_s: table.damping,
            kp: table.kp,
            ki: table.ki,
            kd: table.kd,
            // of a measured position both others are the velocity
            derivative_of_error: table.derivative == DerivativeOf::Error,
        };
        if !prediction.is_bounded() {
            return refuse(LoopProblem::Unstable {
                damped: (table.damping + table.kd) * table.kp,
                driven: inertia * table.ki,
            });
        }
        if prediction.response(0.001, 2).is_none() {
            return refuse(LoopProblem::TooFast);
        }
        Ok(prediction)
    }
}
