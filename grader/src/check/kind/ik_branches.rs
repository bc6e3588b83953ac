//! ik-branches: whether an answer has every branch that reaches its target, and no wrong one \[m\].
//!
//! Judged where two or more branches exist, and where an answer has a wrong branch beside the only one. A case is scored by its
//! worst branch; a branch that is missing, or equals another but for whole turns, scores nothing. Two branches are the same if
//! every revolute joint agrees to 0.02 rad, apart from whole turns, and every prismatic joint to 1 mm; joints that do not move the
//! TCP, such as a wrist that turns about it, do not count. A branch beyond the limits of a joint is none, unless the task has
//! `within_limits = false`. Where the task is about more than positions, branches are compared in every joint, and `full_rad` and
//! `zero_rad` count as with `ik-reach`.

use super::ik_reach::{any_beyond_limit, branch_score, of_every_target, turned_band};
use crate::attempt::branches::{count_different, count_distinct};
use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance of the worst branch with which a case earns everything \[m\].
    full_m: f64,
    /// Distance with which a case earns nothing \[m\].
    zero_m: f64,
    /// Angle of the worst branch with which a case earns everything \[rad\].
    full_rad: Option<At<f64>>,
    /// Angle with which a case earns nothing \[rad\].
    zero_rad: Option<At<f64>>,
}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-branches";
    const FUNCTION: Option<&'static str> = Some("inverse_kinematics");
    type Check = InBand<IkBranches>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        let turned = turned_band(reading, self.full_rad.as_ref(), self.zero_rad.as_ref())?;
        reading.in_band([self.full_m, self.zero_m], "m", IkBranches { turned })
    }
}

/// The distance of the worst branch from its target, where none is missing.
#[derive(Debug)]
pub(crate) struct IkBranches {
    /// The band of angles, where the task is about more than positions.
    turned: Option<Band>,
}

impl AnswerMeasure for IkBranches {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        cases
            .mean_score("targets with every branch", |facts| {
                score(facts, cases.band, self.turned)
            })
            .advise("Return every branch that reaches the target, within the limits of the joints: a list of lists, such as `[[q1, q2], [q1, q2]]` for an arm that can bend either way.")
    }

    fn is_of_single_answers(&self) -> bool {
        // an answer with one good branch of two is good
        false
    }

    fn bounds(&self, full: String, zero: String) -> [String; 2] {
        of_every_target((full, zero), self.turned)
    }
}

/// The score of a case with two or more branches, or with an answer of more branches than exist, one of them wrong.
fn score(facts: &CaseFacts<'_>, band: Band, turned: Option<Band>) -> Option<CaseScore> {
    let score = of_worst_branch(facts, band, turned)?;
    let CaseError::Reach {
        branches_m,
        expected,
        ..
    } = &facts.error
    else {
        return None;
    };
    // whether the only branch is right is what `ik-reach` asks; where an arm is stretched, it may be given twice
    let has_other = branches_m.len() > 1 && score.score < 1.0;
    (*expected > 1 || has_other).then_some(score)
}

/// The score of the worst branch of a target that can be reached.
fn of_worst_branch(facts: &CaseFacts<'_>, band: Band, turned: Option<Band>) -> Option<CaseScore> {
    let CaseError::Reach {
        branches_m,
        angles_rad,
        expected,
    } = &facts.error
    else {
        return None;
    };
    if *expected == 0 {
        return None;
    }
    let distinct = match &facts.answer {
        Answered::Branches(branches) => match turned {
            Some(_) => count_different(facts.robot, branches),
            None => count_distinct(facts.robot, branches),
        },
        _ => 0,
    };
    let complete = distinct >= *expected as usize;
    let worst_m = match branches_m.last() {
        Some(worst_m) if complete => *worst_m,
        _ => f64::INFINITY,
    };
    if let (true, Some(turned)) = (complete, turned) {
        let both = (branches_m.as_slice(), angles_rad.as_slice());
        let of = |index: usize| branch_score(both, index, (band, Some(turned)));
        let worst = (0..branches_m.len()).min_by(|a, b| of(*a).total_cmp(&of(*b)));
        if let Some(worst) = worst.filter(|worst| of(*worst) < band.score(branches_m[*worst])) {
            let off = with_unit(angles_rad[worst], "rad");
            let message = format!(
                "{}: one of the branches ends turned {off} away from the target",
                facts.label()
            );
            return Some(CaseScore {
                score: of(worst),
                lost: vec![WrongAnswer::whole(facts, branches_m[worst], message)],
            });
        }
    }
    Some(CaseScore::of(facts, worst_m, band, || {
        let name = facts.label();
        if let Some(beyond) = any_beyond_limit(facts).filter(|_| complete && !worst_m.is_finite()) {
            format!("{name}: {beyond}")
        } else if complete {
            let off = metres(worst_m);
            format!("{name}: one of the branches ends {off} from the target")
        } else {
            format!("{name}: {distinct} of {expected} branches")
        }
    }))
}
