//! What a check is: the keys that every check of a lab file has, and what its kind answers for.
//!
//! A kind implements [`MotionCheck`] or [`FunctionCheck`], by the tasks that it judges.

use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

use super::facts::MotionFacts;
use super::finding::Finding;
use super::kind::robustness::Sweep;
use crate::attempt::answers::CaseFacts;
use crate::task::model::{Band, FunctionTask};

/// What a lab file says of a check, whatever its kind.
#[derive(Debug, Clone)]
pub struct Criterion {
    /// Unique in its task; lower-case letters, digits and `-`.
    pub name: String,
    /// What a student reads.
    pub title: String,
    /// What full marks are worth; positive.
    pub points: f64,
    /// Earlier checks of the task that must earn something before this one counts, by index.
    pub needs: Vec<usize>,
    /// A question, which is the next step where points are lost in place of the kind's own, and the steps that `kinemark hint` unfolds
    /// behind it; empty where the lab has none.
    pub hints: Vec<String>,
    /// What earns all points and what earns none, in words.
    pub bounds: [String; 2],
}

/// A check: one criterion, and how it is judged. `K` is [`dyn MotionCheck`](MotionCheck) or [`dyn FunctionCheck`](FunctionCheck).
#[derive(Debug)]
pub struct Check<K: ?Sized> {
    /// What the lab file says of it.
    pub criterion: Criterion,
    /// What it measures.
    pub kind: Arc<K>,
}

impl<K: ?Sized> Clone for Check<K> {
    fn clone(&self) -> Self {
        Self {
            criterion: self.criterion.clone(),
            kind: Arc::clone(&self.kind),
        }
    }
}

impl<K: ?Sized> Deref for Check<K> {
    type Target = Criterion;

    fn deref(&self) -> &Criterion {
        &self.criterion
    }
}

/// What a check needs of the reference solution, run in the same variant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FromReference {
    /// Nothing: its band is made of numbers.
    Nothing,
    /// The value that its measure reaches there.
    Value,
    /// The whole run.
    Run,
}

/// A kind of check that judges the run of a motion task.
pub trait MotionCheck: Debug + Send + Sync {
    /// What earns all points and what earns none, for the table of a brief.
    fn bounds(&self) -> [String; 2];

    /// Its band and the band's unit, if it has one of numbers.
    fn band(&self) -> Option<(Band, &'static str)> {
        None
    }

    /// What it finds in a run that came to its end.
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding;

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

    /// What it needs of the reference solution before it can judge.
    fn reference_use(&self) -> FromReference {
        FromReference::Nothing
    }

    /// The same check where its measure reaches `value` in the reference solution's run; `None` if that gives it no band.
    fn at_reference(&self, value: f64) -> Option<Arc<dyn MotionCheck>> {
        let _ = value;
        None
    }
}

/// A kind of check that judges the answers of a function task.
pub trait FunctionCheck: Debug + Send + Sync {
    /// What earns all points and what earns none, for the table of a brief.
    fn bounds(&self) -> [String; 2];

    /// Its band and the band's unit, if it has one.
    fn band(&self) -> Option<(Band, &'static str)> {
        None
    }

    /// What it finds in the answers to all cases, hidden ones too.
    fn judge(&self, task: &FunctionTask, cases: &[CaseFacts<'_>]) -> Finding;

    /// The band by which a single answer is called good or wrong, if this check has one.
    fn answer_band(&self) -> Option<Band>;
}

/// Judges a check of a motion task; its curve gets the check's name, and what the reference solution reaches stands beside it.
pub fn judge_motion(check: &Check<dyn MotionCheck>, facts: &MotionFacts<'_>) -> Finding {
    let mut finding = check.kind.judge(facts);
    let mut reached = facts.reached.iter();
    let reached = reached.find(|reached| reached.check == check.name);
    if let (Some(measure), Some(reached)) = (&mut finding.measure, reached) {
        measure.reference = reached.value;
    }
    if let Some(curve) = &mut finding.curve {
        curve.check.clone_from(&check.name);
        curve.reference = reached.and_then(|reached| reached.curve.clone());
    }
    finding
}

/// The band by which the dwells of a motion task are chosen: that of its first check that judges them.
pub fn dwell_band(checks: &[Check<dyn MotionCheck>]) -> Band {
    let found = checks.iter().find_map(|check| check.kind.dwell_band());
    found.unwrap_or(Band {
        full: 0.002,
        zero: 0.02,
    })
}

/// The band of distances, or of relative ones, by which single answers of a function task are called good or wrong: of several that judge
/// them, the one whose `zero` is least.
pub fn answer_band(checks: &[Check<dyn FunctionCheck>]) -> Band {
    let found = checks.iter().filter_map(|check| check.kind.answer_band());
    let found = found.min_by(|a, b| a.zero.total_cmp(&b.zero));
    found.unwrap_or(Band {
        full: 1e-3,
        zero: 1e-2,
    })
}

/// The band of the first check that measures the distance from the path called `path` \[m\].
pub fn path_band(checks: &[Check<dyn MotionCheck>], path: &str) -> Option<Band> {
    checks.iter().find_map(|check| check.kind.path_band(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A check that calls answers good or wrong by a band.
    #[derive(Debug)]
    struct By(Option<Band>);

    impl FunctionCheck for By {
        fn bounds(&self) -> [String; 2] {
            [String::new(), String::new()]
        }

        fn judge(&self, _: &FunctionTask, _: &[CaseFacts<'_>]) -> Finding {
            unreachable!("nothing is judged here")
        }

        fn answer_band(&self) -> Option<Band> {
            self.0
        }
    }

    #[test]
    fn of_several_checks_the_strictest_says_which_answers_are_wrong() {
        let check = |zero: Option<f64>| Check {
            criterion: Criterion {
                name: "check".to_owned(),
                title: "Check".to_owned(),
                points: 1.0,
                needs: Vec::new(),
                hints: Vec::new(),
                bounds: [String::new(), String::new()],
            },
            kind: Arc::new(By(zero.map(|zero| Band { full: 1e-6, zero })))
                as Arc<dyn FunctionCheck>,
        };
        let zero = |bands: &[Option<f64>]| {
            let checks: Vec<_> = bands.iter().map(|zero| check(*zero)).collect();
            answer_band(&checks).zero
        };
        // in whichever order they stand
        assert_eq!(zero(&[Some(0.5), None, Some(1e-3)]), 1e-3);
        assert_eq!(zero(&[Some(1e-3), Some(0.5)]), 1e-3);
        assert_eq!(zero(&[None]), 1e-2, "where none has a band");
    }
}
