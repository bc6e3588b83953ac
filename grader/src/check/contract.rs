//! What a check is: the keys that every check of a lab file has, and what its kind answers for.
//!
//! A kind implements [`CheckKind`], and [`MotionCheck`] or [`FunctionCheck`] by the tasks that it judges. What every kind has to
//! decide is a method without a default.

use std::fmt::Debug;
use std::sync::Arc;

use kinemark_sim::model::robot::Robot;

use super::facts::MotionFacts;
use super::finding::Finding;
use super::kind::robustness::Sweep;
use crate::attempt::answers::CaseFacts;
use crate::record::quantity::with_unit;
use crate::task::model::{Band, Function};

/// A check: one criterion with its points. `K` is [`dyn MotionCheck`](MotionCheck) or [`dyn FunctionCheck`](FunctionCheck).
#[derive(Debug)]
pub struct Check<K: ?Sized> {
    /// Unique in its task; lower-case letters, digits and `-`.
    pub name: String,
    /// What a student reads.
    pub title: String,
    /// What full marks are worth; positive.
    pub points: f64,
    /// Earlier checks of the task that must earn something before this one counts, by index.
    pub needs: Vec<usize>,
    /// The next step to suggest where points are lost, in place of the kind's own.
    pub hint: Option<String>,
    /// What it measures.
    pub kind: Arc<K>,
}

impl<K: ?Sized> Clone for Check<K> {
    fn clone(&self) -> Self {
        Self {
            name: self.name.clone(),
            title: self.title.clone(),
            points: self.points,
            needs: self.needs.clone(),
            hint: self.hint.clone(),
            kind: Arc::clone(&self.kind),
        }
    }
}

/// A check whose task may be of either kind.
#[derive(Debug, Clone, Copy)]
pub struct AnyCheck<'a> {
    /// As in [`Check`].
    pub name: &'a str,
    /// As in [`Check`].
    pub title: &'a str,
    /// As in [`Check`].
    pub points: f64,
    /// As in [`Check`].
    pub needs: &'a [usize],
    /// What both kinds of checks answer for.
    pub kind: &'a dyn CheckKind,
}

impl<'a> AnyCheck<'a> {
    /// Of a check of a motion task.
    pub fn of_motion(check: &'a Check<dyn MotionCheck>) -> Self {
        Self::of(check, &*check.kind)
    }

    /// Of a check of a function task.
    pub fn of_function(check: &'a Check<dyn FunctionCheck>) -> Self {
        Self::of(check, &*check.kind)
    }

    fn of<K: ?Sized>(check: &'a Check<K>, kind: &'a dyn CheckKind) -> Self {
        Self {
            name: &check.name,
            title: &check.title,
            points: check.points,
            needs: &check.needs,
            kind,
        }
    }
}

/// What every kind of check answers for.
pub trait CheckKind: Debug + Send + Sync {
    /// The band of its measured value, with the value's unit on `robot`; none where it has fixed scores.
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)>;

    /// What earns all points and what earns none, for the table of a brief. `titles` are those of the task's checks.
    fn bounds(&self, robot: &Robot, titles: &[&str]) -> [String; 2] {
        let _ = titles;
        match self.band(robot) {
            Some((band, unit)) => [
                format!("up to {}", with_unit(band.full, unit)),
                format!("from {}", with_unit(band.zero, unit)),
            ],
            None => ["every one".to_owned(), "none".to_owned()],
        }
    }

    /// Whether it compares a whole run with the reference's path, which is that of the lab's own numbers.
    fn follows_one_path(&self) -> bool {
        false
    }
}

/// A kind of check that judges the run of a motion task.
pub trait MotionCheck: CheckKind {
    /// What it finds in a run that came to its end.
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding;

    /// Where it began to lose points, told from its curve and its evidence.
    fn first_loss(&self) -> FirstLoss;

    /// The band by which the task's dwells are chosen, if this check judges them.
    fn dwell_band(&self) -> Option<Band> {
        None
    }

    /// The band that plots draw around the path called `path`, if this check measures the distance from it.
    fn path_band(&self, path: &str) -> Option<Band> {
        let _ = path;
        None
    }

    /// The runs under disturbances that it needs, if it judges such runs.
    fn sweep(&self) -> Option<&Sweep> {
        None
    }
}

/// A kind of check that judges the answers of a function task.
pub trait FunctionCheck: CheckKind {
    /// What it finds in the answers to all cases, hidden ones too.
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding;

    /// The band by which a single answer is called good or wrong, if this check has one.
    fn answer_band(&self) -> Option<Band>;
}

/// How the curve of a check is held against its band: where points began to be lost follows from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstLoss {
    /// The greatest value of the curve counts, so that the first one beyond the band costs points.
    Greatest,
    /// A mean of the curve counts, so that points are lost from where it leaves the band for what the evidence shows.
    Mean,
    /// The curve is what has come together so far; its last value counts.
    SoFar,
    /// There is no curve, or moments beyond the band may cost nothing, as on the way to a goal: the evidence says where.
    Evidence,
}

/// Judges a check of a motion task; its curve gets the check's name.
pub fn judge_motion(check: &Check<dyn MotionCheck>, facts: &MotionFacts<'_>) -> Finding {
    let mut finding = check.kind.judge(facts);
    if let Some(curve) = &mut finding.curve {
        curve.check.clone_from(&check.name);
    }
    finding
}

/// Judges a check of a function task.
pub fn judge_function(
    check: &Check<dyn FunctionCheck>,
    function: &Function,
    cases: &[CaseFacts<'_>],
) -> Finding {
    check.kind.judge(function, cases)
}

/// The band by which the dwells of a motion task are chosen: that of its first check that judges them.
pub fn dwell_band(checks: &[Check<dyn MotionCheck>]) -> Band {
    let found = checks.iter().find_map(|check| check.kind.dwell_band());
    found.unwrap_or(Band {
        full: 0.002,
        zero: 0.02,
    })
}

/// The band of distances, or of relative ones, by which single answers of a function task are called good or wrong.
pub fn answer_band(checks: &[Check<dyn FunctionCheck>]) -> Band {
    let found = checks.iter().find_map(|check| check.kind.answer_band());
    found.unwrap_or(Band {
        full: 1e-3,
        zero: 1e-2,
    })
}

/// The band of the first check that measures the distance from the path called `path` \[m\].
pub fn path_band(checks: &[Check<dyn MotionCheck>], path: &str) -> Option<Band> {
    checks.iter().find_map(|check| check.kind.path_band(path))
}
