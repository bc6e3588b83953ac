//! What checks of a step response look at: a joint's signal, where it is to go, and the linear loop it is compared with.

use kinemark_sim::control::LinearStep;
use kinemark_sim::control::linear_step::Fed;

use super::joint_units::JointUnits;

/// The step response of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct StepResponse {
    /// Index of the joint in `q`.
    pub joint: usize,
    /// Its units.
    pub units: JointUnits,
    /// The signal.
    pub of: Fed,
    /// Where it is to go, where the lab says so, in the unit of the signal.
    pub target: Option<f64>,
    /// Ticks at the end of the run whose mean is the final value; at least 1, fewer than the run has.
    pub final_ticks: usize,
    /// The loop drawn beside the run; only with a target.
    pub prediction: Option<LinearStep>,
}

impl StepResponse {
    /// Unit of the signal.
    pub fn unit(&self) -> &'static str {
        match self.of {
            Fed::Position => self.units.position(),
            Fed::Velocity => self.units.speed(),
        }
    }

    /// Its column in the trace.
    pub fn column(&self) -> &'static str {
        match self.of {
            Fed::Position => "q",
            Fed::Velocity => "qd",
        }
    }
}
