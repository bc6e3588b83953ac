//! What moves a run on by one step: smooth motion alone, or smooth motion and contact in a scene.

use super::divergence::BlowUp;
use super::tick_loop::{RunError, Setup};
use crate::model::robot::Robot;
use crate::step::hybrid::{HybridStep, StepError};
use crate::step::smooth::SmoothStep;

#[derive(Debug)]
pub(super) enum Stepper {
    Free(Box<SmoothStep>),
    InScene(Box<HybridStep>),
}

/// What came of a step.
pub(super) enum Moved {
    On,
    Lost(BlowUp),
}

impl Stepper {
    pub(super) fn new(setup: &Setup<'_>) -> Result<Self, RunError> {
        let (robot, gravity, step_s) = (setup.robot, setup.gravity_m_s2, setup.periods.step_s);
        Ok(match setup.scene {
            None => Self::Free(Box::new(SmoothStep::new(robot, gravity, step_s))),
            Some(scene) => Self::InScene(Box::new(HybridStep::new(robot, scene, gravity, step_s)?)),
        })
    }

    /// Moves robot and scene on under `effort`, held.
    pub(super) fn advance(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<Moved, RunError> {
        match self {
            Self::Free(step) => {
                step.advance(robot, effort, q, qd)?;
                Ok(Moved::On)
            }
            Self::InScene(step) => match step.advance(robot, effort, q, qd) {
                Ok(_) => Ok(Moved::On),
                Err(StepError::Singular(singular)) => Err(singular.into()),
                Err(StepError::Lost { body }) => Ok(Moved::Lost(BlowUp::InContact { body })),
            },
        }
    }

    /// The scene as it stands, where there is one.
    pub(super) fn scene(&self) -> Option<&HybridStep> {
        match self {
            Self::Free(_) => None,
            Self::InScene(step) => Some(step),
        }
    }
}
