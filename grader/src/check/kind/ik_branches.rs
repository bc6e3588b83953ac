//! ik-branches: whether an answer has every branch that reaches its target, and no wrong one \[m\].
//!
//! Judged where two or more branches exist. A case is scored by its worst branch; a branch that is missing, or equals another but
//! for whole turns, scores nothing. Two branches are the same if every revolute joint agrees to 0.02 rad, apart from whole turns,
//! and every prismatic joint to 1 mm; joints that do not move the TCP, such as a wrist that turns about it, do not count. A branch
//! beyond the limits of a joint is none.

use super::ik_reach::{any_beyond_limit, of_every_target};
use crate::attempt::branches::count_distinct;
use crate::check::prelude::*;

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
    const FUNCTION: Option<&'static str> = Some("inverse_kinematics");
    type Check = InBand<IkBranches>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_m, self.zero_m], "m", IkBranches)
    }
}

/// The distance of the worst branch from its target, where none is missing.
#[derive(Debug)]
pub(crate) struct IkBranches;

impl AnswerMeasure for IkBranches {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        cases
            .mean_score("targets with every branch", |facts| {
                score(facts, cases.band)
            })
            .advise("The arm can bend either way: return both, `[[q1, q2], [q1, q2]]`.")
    }

    fn is_of_single_answers(&self) -> bool {
        // an answer with one good branch of two is good
        false
    }

    fn bounds(&self, full: String, zero: String) -> [String; 2] {
        of_every_target(full, zero)
    }
}

/// The score of a case with two or more branches.
fn score(facts: &CaseFacts<'_>, band: Band) -> Option<CaseScore> {
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
        Answered::Branches(branches) => count_distinct(facts.robot, branches),
        _ => 0,
    };
    let complete = distinct >= *expected as usize;
    let worst_m = match branches_m.last() {
        Some(worst_m) if complete => *worst_m,
        _ => f64::INFINITY,
    };
    Some(CaseScore::of(facts, worst_m, band, || {
        let name = facts.label();
        if let Some(beyond) = any_beyond_limit(facts).filter(|_| complete) {
            format!("{name}: {beyond}")
        } else if complete {
            let off = metres(worst_m);
            format!("{name}: one of the branches ends {off} from the target")
        } else {
            format!("{name}: {distinct} of {expected} branches")
        }
    }))
}
