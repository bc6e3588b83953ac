//! The laws of a prescribed motion: one per independent joint, within its limits.

use std::sync::Arc;

use kinemark_sim::model::robot::Joint;
use kinemark_sim::run::PrescribedMotion;
use kinemark_sim::text::Spanned;
use kinemark_sim::text::number::trimmed;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trajectory::{JointLaw, TrajectoryError};

use super::Reader;
use crate::lab::file::{LawTable, MotionTable};
use crate::task::problem::{LabError, near, problems};

/// A law may pass a limit by this, which is rounding \[rad or m\].
const ROUNDING: f64 = 1e-9;

problems! {
    /// What is wrong with the laws of a task.
    enum LawProblem {
        NotPrescribed:
            "lab::prescribed", "laws are for mode `prescribed`", "these move nothing",
            "write `mode = \"prescribed\"`, or leave them out";
        NoLaws:
            "lab::prescribed", "a prescribed motion needs laws", "no [[tasks.motion.laws]]",
            "add a table such as { joint = \"NAME\", sine = { amplitude = 0.5, angular_frequency_rad_s = 1.0 } }";
        Start { key: &'static str }:
            "lab::prescribed", "a prescribed motion starts where its laws start", "of no effect",
            format!("leave `{key}` out");
        Servo:
            "lab::prescribed", "a prescribed motion has no servo", "of no effect", "leave it out";
        UnknownJoint { joint: String, known: Vec<String> }:
            "lab::law", "`{joint}` is no joint that a law can move", "no such joint", near(joint, "joints", known);
        Dependent { joint: String }:
            "lab::law", "joint `{joint}` follows the others through a loop", "not independent", "leave its law out";
        Twice { joint: String }:
            "lab::law", "joint `{joint}` has two laws", "the second one", "leave one of them out";
        Kind:
            "lab::law", "a law is one of `constant`, `polynomial`, `sine`, `trapezoid` and `table`", "this law",
            "give exactly one of them";
        Trajectory { error: TrajectoryError }:
            "lab::law", "{error}", "this law";
        Limit { joint: String, position: String, time_s: String, side: &'static str, limit: String }:
            "lab::law", "at {time_s} s the law of joint `{joint}` is at {position}, beyond its {side} limit of {limit}", "this law",
            "a robot cannot be there: change the law";
        NotFinite { joint: String, time_s: String }:
            "lab::law", "at {time_s} s the law of joint `{joint}` is no finite number", "this law", "change it";
        Loops { error: String }:
            "lab::law", "the robot cannot start where these laws start: {error}", "these laws";
    }
}

impl Reader<'_> {
    /// The laws of a task of `ticks` in mode `prescribed`, with the state in which it starts; nothing in another mode.
    pub(super) fn laws(
        &self,
        table: &Spanned<MotionTable>,
        is_prescribed: bool,
        (periods, ticks): (&Periods, u64),
    ) -> Result<Option<PrescribedStart>, LabError> {
        let motion = table.get_ref();
        let Some(first) = motion.laws.first() else {
            return match is_prescribed {
                true => self.report.refuse_at(table, LawProblem::NoLaws),
                false => Ok(None),
            };
        };
        if !is_prescribed {
            return self.report.refuse_at(first, LawProblem::NotPrescribed);
        }
        for (key, typed) in [
            ("start_rad", &motion.start_rad),
            ("start_rad_s", &motion.start_rad_s),
        ] {
            if let Some(typed) = typed {
                return self.report.refuse_at(typed, LawProblem::Start { key });
            }
        }
        if let Some(servo) = &motion.servo {
            return self.report.refuse_at(servo, LawProblem::Servo);
        }
        let robot = self.robot;
        let mut laws: Vec<Option<JointLaw>> = vec![None; robot.n()];
        for typed in &motion.laws {
            let (index, joint) = self.joint_of(typed.get_ref())?;
            if laws[index].is_some() {
                let joint = joint.name.clone();
                let problem = LawProblem::Twice { joint };
                return self.report.refuse_at(&typed.get_ref().joint, problem);
            }
            let law = self.law(typed)?;
            self.stays_within_limits(typed, joint, &law, (periods, ticks))?;
            laws[index] = Some(law);
        }
        // a joint without a law stays where it is at home
        let independent = robot.independent().iter();
        let laws: Result<Vec<JointLaw>, TrajectoryError> = independent
            .map(|&index| match laws[index].take() {
                Some(law) => Ok(law),
                None => JointLaw::constant(robot.home()[index]),
            })
            .collect();
        let laws: Arc<[JointLaw]> = match laws {
            Ok(laws) => laws.into(),
            Err(error) => {
                return self
                    .report
                    .refuse_at(first, LawProblem::Trajectory { error });
            }
        };
        match PrescribedMotion::new(robot, Arc::clone(&laws)) {
            Ok(start) => {
                let [q, qd, _] = start.state().map(<[f64]>::to_vec);
                Ok(Some(PrescribedStart { laws, q, qd }))
            }
            Err(error) => {
                let error = error.to_string();
                self.report.refuse_at(first, LawProblem::Loops { error })
            }
        }
    }

    /// The joint of a law, with its index in `q`.
    fn joint_of(&self, table: &LawTable) -> Result<(usize, &Joint), LabError> {
        let name = table.joint.get_ref();
        let mut joints = self.robot.moving_joints().enumerate();
        let joint = name.clone();
        match joints.find(|(_, joint)| joint.name == *name) {
            Some((index, known)) if self.robot.independent().contains(&index) => Ok((index, known)),
            Some(_) => self
                .report
                .refuse_at(&table.joint, LawProblem::Dependent { joint }),
            None => {
                let independent = self.robot.independent();
                let joints = self.robot.moving_joints().enumerate();
                let joints = joints.filter(|(index, _)| independent.contains(index));
                let known = joints.map(|(_, joint)| joint.name.clone()).collect();
                let problem = LawProblem::UnknownJoint { joint, known };
                self.report.refuse_at(&table.joint, problem)
            }
        }
    }

    fn law(&self, typed: &Spanned<LawTable>) -> Result<JointLaw, LabError> {
        let Some(law) = typed.get_ref().law().law() else {
            return self.report.refuse_at(typed, LawProblem::Kind);
        };
        law.or_else(|error| {
            self.report
                .refuse_at(typed, LawProblem::Trajectory { error })
        })
    }

    fn stays_within_limits(
        &self,
        typed: &Spanned<LawTable>,
        joint: &Joint,
        law: &JointLaw,
        (periods, ticks): (&Periods, u64),
    ) -> Result<(), LabError> {
        let lower = joint.limits.lower.unwrap_or(f64::NEG_INFINITY);
        let upper = joint.limits.upper.unwrap_or(f64::INFINITY);
        for tick in 0..=ticks {
            let time_s = periods.time_s(tick);
            let sample = law.at(time_s);
            let (joint, time_s) = (joint.name.clone(), trimmed(time_s, 6));
            let numbers = [sample.position, sample.velocity, sample.acceleration];
            if !numbers.iter().all(|number| number.is_finite()) {
                let problem = LawProblem::NotFinite { joint, time_s };
                return self.report.refuse_at(typed, problem);
            }
            let beyond = [("lower", lower), ("upper", upper)]
                .into_iter()
                .zip([lower - sample.position, sample.position - upper])
                .find(|(_, beyond)| *beyond > ROUNDING);
            if let Some(((side, limit), _)) = beyond {
                let problem = LawProblem::Limit {
                    joint,
                    position: trimmed(sample.position, 6),
                    time_s,
                    side,
                    limit: trimmed(limit, 6),
                };
                return self.report.refuse_at(typed, problem);
            }
        }
        Ok(())
    }
}

/// The laws of the independent joints, and the state in which they start, shape `(n)` each.
pub(super) struct PrescribedStart {
    pub(super) laws: Arc<[JointLaw]>,
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
}
