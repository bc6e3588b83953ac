//! Advances a run by one step: the robot alone, or in contact with a scene.

use super::divergence::DivergenceKind;
use super::setup::{RunError, Setup};
use crate::model::push::Push;
use crate::model::robot::Robot;
use crate::step::free::FreeStep;
use crate::step::hybrid::{HybridStep, StepError, StepReport};
use crate::step::smooth::Foreseen;

#[derive(Debug)]
pub(super) enum Stepper {
    Free(Box<FreeStep>),
    InScene(Box<HybridStep>),
}

/// The outcome of a step.
pub(super) enum StepOutcome {
    Advanced,
    Diverged(DivergenceKind),
}

impl Stepper {
    pub(super) fn new(setup: &Setup<'_>) -> Result<Self, RunError> {
        let (robot, gravity, step_s) = (setup.robot, setup.gravity_m_s2, setup.periods.step_s);
        Ok(match setup.scene {
            None => Self::Free(Box::new(FreeStep::new(robot, gravity, step_s))),
            Some(scene) => Self::InScene(Box::new(HybridStep::new(robot, scene, gravity, step_s)?)),
        })
    }

    /// Advances robot and scene by one step under `effort`, held constant.
    pub(super) fn advance(
        &mut self,
        robot: &Robot,
        effort: &[f64],
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<StepOutcome, RunError> {
        match self {
            Self::Free(step) => {
                step.advance(robot, effort, q, qd)?;
                Ok(StepOutcome::Advanced)
            }
            Self::InScene(step) => outcome(step.advance(robot, effort, q, qd)),
        }
    }

    /// Advances the robot to the state `next`, which laws prescribe, and the scene with it.
    pub(super) fn advance_along(
        &mut self,
        robot: &Robot,
        next: (&[f64], &[f64]),
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<StepOutcome, RunError> {
        match self {
            Self::Free(_) => {
                q.copy_from_slice(next.0);
                qd.copy_from_slice(next.1);
                Ok(StepOutcome::Advanced)
            }
            Self::InScene(step) => outcome(step.advance_along(robot, next, q, qd)),
        }
    }

    /// Takes accelerations that are known: a step that starts there need not compute them.
    pub(super) fn foresee(&mut self, foreseen: Foreseen<'_>) {
        match self {
            Self::Free(step) => step.foresee(foreseen),
            Self::InScene(step) => step.foresee(foreseen),
        }
    }

    /// Sets the pushes in effect during the next step.
    pub(super) fn set_pushes<'p>(
        &mut self,
        robot: &Robot,
        pushes: impl Iterator<Item = &'p Push> + Clone,
    ) {
        match self {
            Self::Free(step) => step.set_pushes(robot, pushes),
            Self::InScene(step) => step.set_pushes(robot, pushes),
        }
    }

    /// What all steps cost so far, in the units of a work budget.
    pub(super) fn work(&self) -> u64 {
        self.scene().map_or(0, HybridStep::work)
    }

    /// The scene in its current state, if there is one.
    pub(super) fn scene(&self) -> Option<&HybridStep> {
        match self {
            Self::Free(_) => None,
            Self::InScene(step) => Some(step),
        }
    }
}

fn outcome(step: Result<&StepReport, StepError>) -> Result<StepOutcome, RunError> {
    match step {
        Ok(_) => Ok(StepOutcome::Advanced),
        Err(StepError::Singular(singular)) => Err(singular.into()),
        Err(StepError::Lost { body }) => {
            Ok(StepOutcome::Diverged(DivergenceKind::InContact { body }))
        }
        Err(StepError::TooManyTriangles) => Err(RunError::TooManyTriangles),
    }
}
