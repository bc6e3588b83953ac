//! ik-branches: whether an answer has every branch that reaches its target, and no wrong one \[m\].
//!
//! Judged where two or more branches exist. A case is scored by its worst branch; a branch that is missing, or equals another but
//! for whole turns, scores nothing. Two branches are the same if every revolute joint agrees to 0.02 rad, apart from whole turns,
//! and every prismatic joint to 1 mm.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::metres;
use schemars::JsonSchema;
use serde::Deserialize;

use super::ik_reach;
use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::measure::count_distinct;
use crate::check::cases::{CaseScore, Summary};
use crate::check::contract::{CheckKind, FunctionCheck};
use crate::check::finding::Finding;
use crate::check::reading::FunctionReading;
use crate::check::registry::FunctionTable;
use crate::task::model::{Band, Function};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance of the worst branch with which a case earns everything \[m\].
    full_m: f64,
    /// Distance with which a case earns nothing \[m\].
    zero_m: f64,
}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-branches";
    const TASK: &'static str = ik_reach::TASK;
    type Check = IkBranches;

    fn fits(function: &Function) -> bool {
        *function == Function::InverseKinematics
    }

    fn read(
        &self,
        at: Range<usize>,
        reading: &FunctionReading<'_>,
    ) -> Result<IkBranches, LabError> {
        let band = reading.report.band(self.full_m, self.zero_m, at)?;
        Ok(IkBranches { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct IkBranches {
    band: Band,
}

impl CheckKind for IkBranches {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }

    fn bounds(&self, _: &Robot, _: &[&str]) -> [String; 2] {
        ik_reach::bounds_of_each(self.band)
    }
}

impl FunctionCheck for IkBranches {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: "targets with every branch".to_owned(),
            band: self.band,
            unit: "m",
        };
        summary
            .mean_score(cases, |facts| self.score(facts))
            .advise("The arm can bend either way: return both, `[[q1, q2], [q1, q2]]`.")
    }

    fn answer_band(&self) -> Option<Band> {
        // an answer with one good branch of two is good
        None
    }
}

impl IkBranches {
    /// The score of a case with two or more branches.
    fn score(&self, facts: &CaseFacts<'_>) -> Option<CaseScore> {
        let CaseError::Reach {
            branches_m,
            expected,
        } = &facts.error
        else {
            return None;
        };
        if *expected < 2 {
            return None;
        }
        let distinct = match &facts.answer {
            Answered::Branches(branches) => count_distinct(&facts.robot, branches),
            Answered::Position(_)
            | Answered::Matrix(_)
            | Answered::Entries(_)
            | Answered::Invalid(_)
            | Answered::Stopped => 0,
        };
        let complete = distinct >= *expected as usize;
        let worst_m = match branches_m.last() {
            Some(worst_m) if complete => *worst_m,
            _ => f64::INFINITY,
        };
        Some(CaseScore::of(worst_m, self.band, || {
            let name = facts.told();
            if complete {
                let off = metres(worst_m);
                format!("{name}: one of the branches ends {off} from the target")
            } else {
                format!("{name}: {distinct} of {expected} branches")
            }
        }))
    }
}
