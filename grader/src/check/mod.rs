//! The checks, one file each: what is measured, the band it is held against, and the evidence where points are lost.

mod alternation;
pub mod body_falls;
#[cfg(test)]
mod by_hand;
pub mod chatter;
pub mod contact_impulse;
pub mod effort_peak;
pub mod effort_rms;
pub mod effort_saturation;
pub mod energy;
pub mod finish_time;
pub mod fk_error;
pub mod function_cases;
pub mod ik_branches;
pub mod ik_reach;
pub mod ik_unreachable;
pub mod jacobian_match;
pub mod jerk;
pub mod joint_limits;
pub mod joint_reached;
pub mod joint_speed;
pub mod overshoot;
pub mod path_coverage;
pub mod path_deviation;
pub mod path_speed;
pub mod pose_reached;
mod response;
pub mod rise_time;
pub mod road;
pub mod robustness;
pub mod settling_time;
#[cfg(test)]
mod sliding;
pub mod stay;
pub mod steady_error;
pub mod step_overshoot;
pub mod tcp_speed;
pub mod time_limit;
pub mod trajectory_match;

use kinemark_sim::robot::Robot;
use kinemark_sim::trace::Trace;

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::lab::joint_units::JointUnits;
use crate::lab::model::{Band, Check, CheckKind, Function, MotionTask};
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::{Curve, TcpPath};
use crate::record::names::Names;
use robustness::RungFacts;
use stay::Stay;

/// What a check found.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The share of points earned, in `[0, 1]`.
    pub score: f64,
    /// What was measured.
    pub measure: Option<Measure>,
    /// Why points were lost, worst first.
    pub evidence: Vec<Evidence>,
    /// The next step where points were lost; the lab's own hint comes before it, unless this one `insists`.
    pub next_step: String,
    /// Whether what was seen makes the lab's hint beside the point, such as a joint that never comes to rest.
    pub insists: bool,
    /// The curve it judged.
    pub curve: Option<Curve>,
}

/// A run as the checks of a motion task see it.
#[derive(Debug)]
pub struct MotionFacts<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// Its names, and those of what was around it.
    pub names: Names<'a>,
    /// What was asked for.
    pub motion: &'a MotionTask,
    /// What was recorded.
    pub trace: &'a Trace,
    /// The best stay at each goal, in order; empty where the task has no goals or the run is shorter than the dwells.
    pub stays: Vec<Stay>,
    /// The band by which stays were chosen \[m\].
    pub pose_band: Band,
    /// The reference's path.
    pub reference: Option<&'a TcpPath>,
    /// How the same motion went on the rungs of robustness checks; empty where nothing was disturbed.
    pub climbs: Vec<Climb>,
}

/// The runs of one robustness check.
#[derive(Debug, Clone)]
pub struct Climb {
    /// The check's name.
    pub check: String,
    /// Title of the check that is repeated.
    pub repeated: String,
    /// One run per rung.
    pub rungs: Vec<RungFacts>,
}

impl MotionFacts<'_> {
    /// The time of a tick \[s\].
    pub fn time_s(&self, tick: usize) -> f64 {
        self.motion.periods.time_s(tick as u64)
    }

    /// The name of a joint by its index in `q`.
    pub fn joint_name(&self, joint: usize) -> &str {
        let found = self.robot.moving_joints().nth(joint);
        found.map_or("?", |joint| joint.name.as_str())
    }

    /// The units of a joint by its index in `q`.
    fn units(&self, joint: usize) -> JointUnits {
        JointUnits::of(self.robot, joint)
    }

    /// The joint `asked`, or that with the greatest value, and its value; one that is no number is the greatest of all.
    fn worst_joint(&self, asked: Option<usize>, value: impl Fn(usize) -> f64) -> (usize, f64) {
        let joints = match asked {
            Some(joint) => joint..joint + 1,
            None => 0..self.robot.n(),
        };
        let values = joints.map(|joint| (joint, value(joint)));
        let greater = |a: &(usize, f64), b: &(usize, f64)| {
            // of equal ones the first
            b.1.abs().total_cmp(&a.1.abs()).is_gt()
        };
        values
            .reduce(|a, b| if greater(&a, &b) { b } else { a })
            .unwrap_or((0, f64::NAN))
    }

    /// A piece of evidence at a tick.
    fn evidence(&self, message: String, signal: String, tick: usize) -> Evidence {
        Evidence {
            message,
            signal,
            tick: Some(tick as u64),
            time_s: Some(self.time_s(tick)),
            run: None,
            case: None,
            value: None,
            limit: None,
            unit: String::new(),
        }
    }
}

/// Judges a check of a motion task.
pub fn judge_motion(check: &Check, facts: &MotionFacts<'_>) -> Finding {
    match &check.kind {
        CheckKind::JointReached {
            joint,
            position,
            hold_ticks,
            band,
        } => joint_reached::judge(facts, *joint, *position, *hold_ticks, *band, &check.name),
        CheckKind::PoseReached(band) => pose_reached::judge(facts, *band, &check.name),
        CheckKind::FinishTime(band) => finish_time::judge(facts, *band, facts.pose_band),
        CheckKind::Overshoot(band) => overshoot::judge(facts, *band, &check.name),
        CheckKind::EffortSaturation(band) => effort_saturation::judge(facts, *band, &check.name),
        CheckKind::JointLimits(band) => joint_limits::judge(facts, *band),
        CheckKind::TrajectoryMatch {
            span,
            max_shift_ticks,
            band,
        } => trajectory_match::judge(facts, *span, *max_shift_ticks, *band),
        CheckKind::BodyFalls(fall) => body_falls::judge(facts, fall),
        CheckKind::ContactImpulse { between, band } => {
            contact_impulse::judge(facts, *between, *band, &check.name)
        }
        CheckKind::TcpSpeed { at, band } => tcp_speed::judge(facts, *at, *band, &check.name),
        CheckKind::PathDeviation {
            path,
            segment,
            band,
        } => path_deviation::judge(facts, path, *segment, *band, &check.name),
        CheckKind::PathCoverage {
            path,
            within_m,
            shares,
        } => path_coverage::judge(facts, path, *within_m, *shares),
        CheckKind::PathSpeed {
            path,
            segment,
            speed_m_s,
            band,
        } => path_speed::judge(facts, path, *segment, *speed_m_s, *band, &check.name),
        CheckKind::TimeLimit { until, band } => time_limit::judge(facts, until, *band),
        CheckKind::Robustness(ladder) => {
            let climb = facts.climbs.iter().find(|climb| climb.check == check.name);
            let (repeated, rungs) =
                climb.map_or(("", &[][..]), |climb| (&climb.repeated, &climb.rungs));
            let periods = facts.motion.periods;
            robustness::judge(ladder, repeated, rungs, |tick| periods.time_s(tick))
        }
        CheckKind::RiseTime {
            response,
            from,
            to,
            band,
        } => rise_time::judge(facts, response, [*from, *to], *band, &check.name),
        CheckKind::SettlingTime {
            response,
            within,
            band,
        } => settling_time::judge(facts, response, *within, *band, &check.name),
        CheckKind::StepOvershoot { response, band } => {
            step_overshoot::judge(facts, response, *band, &check.name)
        }
        CheckKind::SteadyError {
            response,
            target,
            band,
        } => steady_error::judge(facts, response, *target, *band, &check.name),
        CheckKind::EffortPeak { joint, band } => {
            effort_peak::judge(facts, *joint, *band, &check.name)
        }
        CheckKind::EffortRms { joint, band } => {
            effort_rms::judge(facts, *joint, *band, &check.name)
        }
        CheckKind::Energy(band) => energy::judge(facts, *band, &check.name),
        CheckKind::Jerk(band) => jerk::judge(facts, *band, &check.name),
        CheckKind::JointSpeed(band) => joint_speed::judge(facts, *band, &check.name),
        CheckKind::Chatter { joint, band } => chatter::judge(facts, *joint, *band, &check.name),
        CheckKind::FkError(_)
        | CheckKind::IkReach(_)
        | CheckKind::IkBranches(_)
        | CheckKind::IkUnreachable
        | CheckKind::JacobianMatch(_)
        | CheckKind::FunctionCases { .. } => foreign(),
    }
}

/// Judges a check of a function task.
pub fn judge_function(check: &Check, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
    match &check.kind {
        CheckKind::FkError(band) => fk_error::judge(cases, *band, function),
        CheckKind::IkReach(band) => ik_reach::judge(cases, *band, function),
        CheckKind::IkBranches(band) => ik_branches::judge(cases, *band, function),
        CheckKind::IkUnreachable => ik_unreachable::judge(cases, function),
        CheckKind::JacobianMatch(band) => jacobian_match::judge(cases, *band, function),
        CheckKind::FunctionCases { band, entry } => {
            function_cases::judge(cases, *band, entry.as_deref(), function)
        }
        CheckKind::JointReached { .. }
        | CheckKind::PoseReached(_)
        | CheckKind::FinishTime(_)
        | CheckKind::Overshoot(_)
        | CheckKind::EffortSaturation(_)
        | CheckKind::JointLimits(_)
        | CheckKind::TrajectoryMatch { .. }
        | CheckKind::BodyFalls(_)
        | CheckKind::ContactImpulse { .. }
        | CheckKind::TcpSpeed { .. }
        | CheckKind::PathDeviation { .. }
        | CheckKind::PathCoverage { .. }
        | CheckKind::PathSpeed { .. }
        | CheckKind::TimeLimit { .. }
        | CheckKind::Robustness(_)
        | CheckKind::RiseTime { .. }
        | CheckKind::SettlingTime { .. }
        | CheckKind::StepOvershoot { .. }
        | CheckKind::SteadyError { .. }
        | CheckKind::EffortPeak { .. }
        | CheckKind::EffortRms { .. }
        | CheckKind::Energy(_)
        | CheckKind::Jerk(_)
        | CheckKind::JointSpeed(_)
        | CheckKind::Chatter { .. } => foreign(),
    }
}

/// A check in a task of the other kind: loading a lab rules it out.
fn foreign() -> Finding {
    unreachable!("a lab's checks fit their tasks once it is loaded")
}

/// Evidence of a function task's case.
fn case_evidence(
    function: &Function,
    facts: &CaseFacts<'_>,
    message: String,
    value: f64,
    limit: f64,
    unit: &str,
) -> Evidence {
    Evidence {
        message,
        signal: function.name().to_owned(),
        tick: None,
        time_s: None,
        run: None,
        case: Some(facts.told().to_owned()),
        value: value.is_finite().then_some(value),
        limit: Some(limit),
        unit: unit.to_owned(),
    }
}

/// At most three visible cases, then hidden classes without their numbers: what a student can act on.
fn summarise(
    function: &Function,
    mut failed: Vec<(&CaseFacts<'_>, f64, String)>,
    totals: &[&CaseFacts<'_>],
    limit: f64,
    unit: &str,
) -> Vec<Evidence> {
    // worst first; cases without a number are the worst of all
    failed.sort_by(|a, b| b.1.total_cmp(&a.1));
    let visible = failed.iter().filter(|(facts, ..)| facts.is_visible());
    let mut evidence: Vec<Evidence> = visible
        .take(3)
        .map(|(facts, value, message)| {
            case_evidence(function, facts, message.clone(), *value, limit, unit)
        })
        .collect();
    let mut classes: Vec<&str> = Vec::new();
    for (facts, ..) in failed.iter().filter(|(facts, ..)| !facts.is_visible()) {
        if !classes.contains(&facts.told()) {
            classes.push(facts.told());
        }
    }
    classes.sort_unstable();
    for class in classes {
        let of_class = |facts: &CaseFacts<'_>| !facts.is_visible() && facts.told() == class;
        let lost = failed.iter().filter(|(facts, ..)| of_class(facts)).count();
        let total = totals.iter().filter(|facts| of_class(facts)).count();
        evidence.push(Evidence {
            message: format!("{lost} of {total} hidden cases of the class \"{class}\" are off"),
            signal: function.name().to_owned(),
            tick: None,
            time_s: None,
            run: None,
            case: Some(class.to_owned()),
            value: None,
            limit: Some(limit),
            unit: unit.to_owned(),
        });
    }
    evidence
}
