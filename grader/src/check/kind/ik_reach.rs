//! ik-reach: how near the best branch of each answer comes to its target, by Kinemark's forward kinematics \[m\].
//!
//! Each reachable case is scored by the band; the check's score is their mean. Whole turns and the order of branches make no
//! difference. A branch beyond the limits of a joint does not reach its target; to a joint that can make a full turn, whole turns make
//! no difference.

use crate::attempt::branches::beyond_limit;
use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance from its target with which a case earns everything \[m\].
    full_m: f64,
    /// Distance with which a case earns nothing \[m\].
    zero_m: f64,
}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-reach";
    const FUNCTION: Option<&'static str> = Some("inverse_kinematics");
    type Check = InBand<IkReach>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_m, self.zero_m], "m", IkReach)
    }
}

/// The distance of the best branch from its target.
#[derive(Debug)]
pub(crate) struct IkReach;

impl AnswerMeasure for IkReach {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let score = |facts: &CaseFacts<'_>| {
            let CaseError::Reach { branches_m, .. } = &facts.error else {
                return None;
            };
            let nearest_m = branches_m.first().copied().unwrap_or(f64::INFINITY);
            let message = || message(facts, nearest_m);
            Some(CaseScore::of(facts, nearest_m, cases.band, message))
        };
        cases.mean_score("targets reached", score).advise(
            "Put your angles through your own forward kinematics: it must give the target back.",
        )
    }

    fn bounds(&self, full: String, zero: String) -> [String; 2] {
        of_every_target(full, zero)
    }
}

/// What the brief says of a band in which every target is judged.
pub(super) fn of_every_target(full: String, zero: String) -> [String; 2] {
    [
        format!("every target within {full}"),
        format!("every target {zero} off"),
    ]
}

fn message(facts: &CaseFacts<'_>, nearest_m: f64) -> String {
    let name = facts.label();
    match &facts.answer {
        Answered::Branches(branches) if branches.is_empty() => {
            // the lab's own target may be the one that is wrong
            format!(
                "{name}: inverse_kinematics returned [], expected the angles of a target within reach"
            )
        }
        _ => without_answer(facts).unwrap_or_else(|| {
            let beyond = any_beyond_limit(facts).filter(|_| !nearest_m.is_finite());
            let missed = || format!("the arm ends {} from the target", metres(nearest_m));
            format!("{name}: {}", beyond.unwrap_or_else(missed))
        }),
    }
}

/// The first joint that some branch of an answer puts beyond its limits, in words.
pub(super) fn any_beyond_limit(facts: &CaseFacts<'_>) -> Option<String> {
    let Answered::Branches(branches) = &facts.answer else {
        return None;
    };
    let mut beyond = branches.iter();
    beyond.find_map(|q| beyond_limit(facts.robot, q))
}
