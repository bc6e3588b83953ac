//! A solver for many queries about the same frames: its starts, its method, and the choice of the answer.

use super::adaptive::descend;
use super::ik_step::StepScratch;
use super::null_space::{SecondaryTask, follow};
use super::query::{check_goals, check_positions};
use super::system::{Residual, System};
use super::{Goal, IkAnswer, IkError, IkSettings, Method, Target, textbook};
use crate::kinematics::joint_samples::JointSamples;
use crate::kinematics::position_range::{PositionRange, position_ranges};
use crate::model::robot::Robot;

/// If no start converges, the best one continues for this many times the steps of one start.
const LAST_ITERATIONS_FACTOR: usize = 10;

/// Answers many queries about the same frames; all goals are solved together, as one stacked system.
#[derive(Debug, Clone)]
pub struct IkSolver<'r> {
    pub(super) system: System<'r>,
    scratch: StepScratch,
    settings: IkSettings,
    ranges: Vec<PositionRange>,
    samples: JointSamples,
    q: Vec<f64>,
    best: Vec<f64>,
    spare: Vec<f64>,
    drawn: Vec<f64>,
}

impl<'r> IkSolver<'r> {
    /// A solver for the frames of `goals`, with its memory.
    ///
    /// # Errors
    /// [`IkError`] for invalid goals or settings.
    pub fn new(
        robot: &'r Robot,
        goals: &[Goal<'_>],
        settings: IkSettings,
    ) -> Result<Self, IkError> {
        check_goals(goals)?;
        settings.check(robot)?;
        let adaptive = !matches!(
            settings.method,
            Method::PseudoInverse
                | Method::Fallback { .. }
                | Method::DampedLeastSquares { damping: Some(_) }
        );
        let system = System::new(
            robot,
            goals,
            settings.chain.as_deref(),
            settings.error_clamp,
            adaptive,
        );
        let ranges = position_ranges(robot);
        Ok(Self {
            scratch: StepScratch::new(system.rows(), system.unknowns.len()),
            samples: JointSamples::over(&ranges, &system.unknowns),
            drawn: vec![0.0; system.unknowns.len()],
            q: vec![0.0; robot.n()],
            best: vec![0.0; robot.n()],
            spare: vec![0.0; robot.n()],
            system,
            settings,
            ranges,
        })
    }

    /// Sets another target of goal `goal`, which must be of the same kind.
    ///
    /// # Errors
    /// [`IkError::Value`] for a target of another kind or with numbers that are not finite.
    ///
    /// # Panics
    /// If there is no goal of that index.
    pub fn set_target(&mut self, goal: usize, target: Target) -> Result<(), IkError> {
        let fits = target.is_finite() && self.system.set_target(goal, target);
        fits.then_some(()).ok_or(IkError::Value {
            what: "a target",
            expected: "finite and of the kind the solver was made for",
        })
    }

    /// Searches for the joint positions from `q0`, shape `(n)`.
    ///
    /// With [`IkSettings::respect_limits`] a start beyond the limits is clamped to them; joints that do not move keep their entry.
    ///
    /// # Errors
    /// [`IkError::JointCount`], [`IkError::Value`] for a `q0` without finite numbers, [`IkError::Loops`] for one whose independent
    /// joints leave the loops open.
    pub fn solve(&mut self, q0: &[f64]) -> Result<IkAnswer, IkError> {
        let robot = self.system.robot;
        check_positions(robot, "the start", q0)?;
        self.q.copy_from_slice(q0);
        if self.settings.respect_limits {
            for &i in &self.system.unknowns {
                self.q[i] = self.ranges[i].clamp(self.q[i]);
            }
        }
        self.system.close(&mut self.q)?;
        Ok(match self.settings.method {
            Method::Auto => self.solve_auto(q0),
            Method::PseudoInverse => self.solve_textbook(None),
            Method::DampedLeastSquares {
                damping: Some(damping),
            } => self.solve_textbook(Some(damping)),
            Method::DampedLeastSquares { damping: None } => self.solve_adaptive(q0),
            Method::Fallback { damping } => {
                self.best.copy_from_slice(&self.q);
                let first = self.solve_textbook(None);
                if first.reached {
                    return Ok(first);
                }
                self.q.copy_from_slice(&self.best);
                let second = match damping {
                    Some(damping) => self.solve_textbook(Some(damping)),
                    None => self.solve_adaptive(q0),
                };
                IkAnswer {
                    iterations: first.iterations + second.iterations,
                    ..second
                }
            }
        })
    }

    fn solve_auto(&mut self, q0: &[f64]) -> IkAnswer {
        let (mut least, mut iterations) = self.descend(true);
        self.best.copy_from_slice(&self.q);
        self.samples.restart();
        for _ in 0..self.settings.restarts {
            if self.reached(&least) {
                break;
            }
            self.samples.next_into(&mut self.drawn);
            self.q.copy_from_slice(q0);
            for (&i, drawn) in self.system.unknowns.iter().zip(&self.drawn) {
                self.q[i] = *drawn;
            }
            if self.system.close(&mut self.q).is_err() {
                continue;
            }
            let (residual, steps) = self.descend(true);
            iterations += steps;
            if residual.objective < least.objective {
                least = residual;
                self.best.copy_from_slice(&self.q);
            }
        }
        self.q.copy_from_slice(&self.best);
        if !self.reached(&least) {
            // no start converged: improve the best one, which takes many steps with a large residual
            let mut rules = self.settings.rules(&self.ranges, false);
            rules.steps = rules.steps.saturating_mul(LAST_ITERATIONS_FACTOR);
            let (residual, steps) = descend(
                &mut self.system,
                &mut self.scratch,
                &rules,
                &mut self.q,
                &mut self.spare,
            );
            iterations += steps;
            least = residual;
        }
        self.answer_nearest(q0, least, iterations)
    }

    fn solve_adaptive(&mut self, q0: &[f64]) -> IkAnswer {
        let (residual, iterations) = self.descend(false);
        self.answer_nearest(q0, residual, iterations)
    }

    /// The answer from `self.q`: moved by full turns to be near the posture or else `q0`, then improved towards the posture.
    fn answer_nearest(
        &mut self,
        q0: &[f64],
        mut residual: Residual,
        mut iterations: usize,
    ) -> IkAnswer {
        let near = self.settings.posture.as_ref().map_or(q0, |p| &p.q);
        // with closed loops, one turn further may be on another branch
        if self.system.robot.loops().is_empty() {
            let mut turned = false;
            for &i in &self.system.unknowns {
                let mut range = self.ranges[i];
                if !self.settings.respect_limits {
                    (range.lower, range.upper) = (f64::NEG_INFINITY, f64::INFINITY);
                }
                let nearest = range.nearest_turn(self.q[i], near[i]);
                turned |= nearest.to_bits() != self.q[i].to_bits();
                self.q[i] = nearest;
            }
            if turned {
                residual = self.system.place(&self.q);
            }
        }
        if self.reached(&residual)
            && let Some(posture) = &self.settings.posture
        {
            iterations += follow(
                &mut self.system,
                &mut self.scratch,
                &self.settings.rules(&self.ranges, false),
                SecondaryTask::Posture(posture),
                &mut self.q,
            );
            residual = self.system.place(&self.q);
        }
        self.answer(residual, iterations)
    }

    fn solve_textbook(&mut self, damping: Option<f64>) -> IkAnswer {
        let rules = self.settings.rules(&self.ranges, false);
        let (residual, iterations) = textbook::iterate(
            &mut self.system,
            &mut self.scratch,
            &rules,
            damping,
            self.settings.posture.as_ref(),
            &mut self.q,
            &mut self.spare,
        );
        self.answer(residual, iterations)
    }

    fn descend(&mut self, impatient: bool) -> (Residual, usize) {
        let rules = self.settings.rules(&self.ranges, impatient);
        descend(
            &mut self.system,
            &mut self.scratch,
            &rules,
            &mut self.q,
            &mut self.spare,
        )
    }

    pub(super) fn reached(&self, residual: &Residual) -> bool {
        residual.within(self.settings.tolerance_m, self.settings.tolerance_rad)
    }

    fn answer(&self, residual: Residual, iterations: usize) -> IkAnswer {
        IkAnswer {
            reached: self.reached(&residual),
            q: self.q.clone(),
            residual_m: residual.distance_m,
            residual_rad: residual.angle_rad,
            iterations,
        }
    }
}
