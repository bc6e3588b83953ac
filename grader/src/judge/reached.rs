//! What the reference solution reaches in the checks of a motion task: from its run in the same variant, or in practice from the numbers
//! that the lab ships.

use std::borrow::Cow;
use std::sync::Arc;

use kinemark_sim::control::Mode;
use kinemark_sim::text::Source;
use kinemark_sim::trace::Trace;

use super::motion_judge::MotionJudge;
use crate::attempt::{Attempt, Ended};
use crate::check::{Check, Finding, FromReference, MotionCheck, MotionFacts, Reached};
use crate::record::graded::Curve;
use crate::submission::handed_in::Submission;
use crate::task::joint_units::JointUnits;

/// What a judge knows of the reference solution in its variant.
#[derive(Debug, Default)]
pub(super) struct OfReference {
    /// Its run, if a check compares with it.
    pub(super) run: Option<Arc<Attempt<Trace>>>,
    /// What it reaches in checks.
    pub(super) reached: Vec<Reached>,
    /// Checks that cannot be judged without its run, by index: in practice.
    pub(super) at_hand_in: Vec<usize>,
    /// Why its run does not say what a check needs.
    pub(super) fault: Option<String>,
}

impl OfReference {
    /// Its run to the end, if there is one.
    pub(super) fn whole_run(&self) -> Option<&Trace> {
        let run = self.run.as_deref().filter(|run| run.ended.is_none());
        run.map(|run| &run.recorded)
    }
}

impl MotionJudge<'_> {
    /// Whether a check needs something of the reference solution.
    pub(super) fn needs_reference(&self) -> bool {
        let needs = |check: &Check<_>| needs_of(check) != FromReference::Nothing;
        self.checks.iter().any(needs)
    }

    /// The same judge with what `solution`, the reference solution, reaches in `run`, its own run of the task.
    pub(super) fn against(self, solution: &Source, run: Arc<Attempt<Trace>>) -> Self {
        let own = MotionJudge::new(
            self.lab,
            self.task,
            (self.work, &self.checks),
            &Submission::from(solution),
            None,
        );
        let mut of_reference = OfReference::default();
        if run.ended.is_some() {
            of_reference.fault = Some("the reference solution does not reach the end".to_owned());
        } else {
            match own.reached(&run.recorded) {
                Ok(reached) => of_reference.reached = reached,
                Err(why) => of_reference.fault = Some(why),
            }
        }
        of_reference.run = Some(run);
        self.with(of_reference)
    }

    /// The same judge with what students get of the reference solution.
    pub(super) fn in_practice(self) -> Self {
        let mut of_reference = OfReference::default();
        for (i, check) in self.checks.iter().enumerate() {
            let value = self.lab.practice.value(&self.task.name, &check.name);
            match (needs_of(check), value) {
                (FromReference::Nothing, _) => {}
                (FromReference::Value, Some(_)) => of_reference.reached.push(Reached {
                    check: check.name.clone(),
                    value,
                    curve: None,
                }),
                (FromReference::Value, None) | (FromReference::Run, _) => {
                    of_reference.at_hand_in.push(i);
                }
            }
        }
        self.with(of_reference)
    }

    /// What is reached in every check that needs to know it, in a run of the reference solution.
    pub(super) fn reached(&self, run: &Trace) -> Result<Vec<Reached>, String> {
        let facts = self.facts(run);
        let mut reached = Vec::new();
        for check in self.checks.iter() {
            let needs = needs_of(check);
            if needs == FromReference::Nothing {
                continue;
            }
            let Finding { measure, curve, .. } = check.kind.judge(&facts);
            let value = measure.and_then(|measure| measure.value);
            let value = value.filter(|_| needs == FromReference::Value);
            if needs == FromReference::Value && value.is_none() {
                let why = self.first_loss(&facts).unwrap_or_default();
                return Err(format!(
                    "the reference solution has no value for \"{}\"{why}",
                    check.title
                ));
            }
            let curve = curve.filter(|curve| self.may_be_drawn(curve));
            reached.push(Reached {
                check: check.name.clone(),
                value,
                curve: curve.map(|curve| curve.values),
            });
        }
        Ok(reached)
    }

    /// What the first of the other checks says in which a run of the reference solution loses points.
    fn first_loss(&self, facts: &MotionFacts<'_>) -> Option<String> {
        let others = self.checks.iter();
        let mut others = others.filter(|check| needs_of(check) == FromReference::Nothing);
        others.find_map(|check| {
            let finding = check.kind.judge(facts);
            let evidence = finding.evidence.first().filter(|_| finding.score < 1.0)?;
            Some(format!("; in \"{}\" {}", check.title, evidence.message))
        })
    }

    /// Whether a curve of the reference solution may be seen: not in a unit that the task commands, because that could be typed in.
    fn may_be_drawn(&self, curve: &Curve) -> bool {
        let joints = 0..self.lab.robot.n();
        let unit = |joint| {
            let units = JointUnits::of(&self.lab.robot, joint);
            match self.work.servo.mode {
                Mode::Position => units.position(),
                Mode::Velocity => units.speed(),
                Mode::Effort | Mode::Prescribed => units.effort(),
            }
        };
        !joints.map(unit).any(|unit| unit == curve.unit)
    }

    /// The same judge with numbers in the bands that name the reference.
    fn with(mut self, of_reference: OfReference) -> Self {
        let mut checks = self.checks.into_owned();
        let mut fault = None;
        for reached in &of_reference.reached {
            let own = checks.iter_mut().find(|check| check.name == reached.check);
            let (Some(check), Some(value)) = (own, reached.value) else {
                continue;
            };
            match check.kind.at_reference(value) {
                Some(fixed) => {
                    check.criterion.bounds = fixed.bounds();
                    check.kind = fixed;
                }
                None => {
                    fault = Some(format!(
                        "the reference solution reaches {value} in \"{}\", which gives it no band",
                        check.title
                    ));
                }
            }
        }
        self.checks = Cow::Owned(checks);
        self.pose_band = crate::check::dwell_band(&self.checks);
        self.of_reference = OfReference {
            fault: of_reference.fault.clone().or(fault),
            ..of_reference
        };
        self
    }

    /// How `attempt` ended, or that nothing can be decided because the reference solution fails.
    pub(super) fn ended(&self, attempt: &Attempt<Trace>) -> Option<Ended> {
        use crate::submission::controller::Stop;
        match &self.of_reference.fault {
            Some(why) => Some(Ended::stopped_by(Stop::GraderFault(why.clone()), 0)),
            None => attempt.ended.clone(),
        }
    }
}

/// What a check needs of the reference solution.
fn needs_of(check: &Check<dyn MotionCheck>) -> FromReference {
    check.kind.reference_use()
}
