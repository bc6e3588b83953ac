//! ik-unreachable: the share of the targets out of reach that are answered with an empty list, `[]`.

use crate::check::prelude::*;
use crate::task::model::FunctionTask;

/// No keys: write `{}`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-unreachable";
    const FUNCTION: Option<&'static str> = Some("inverse_kinematics");
    type Check = IkUnreachable;

    fn read(&self, _: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        Ok(IkUnreachable)
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct IkUnreachable;

impl FunctionCheck for IkUnreachable {
    fn bounds(&self) -> [String; 2] {
        ["every one".to_owned(), "none".to_owned()]
    }

    fn judge(&self, task: &FunctionTask, cases: &[CaseFacts<'_>]) -> Finding {
        let (band, unit) = (Band::default(), "");
        let cases = Cases {
            task,
            cases,
            band,
            unit,
        };
        let quantity = "targets out of reach that are recognised as such";
        let mut finding = cases.mean_score(quantity, score).advise(
            "Compare the target's distance from the shoulder with the lengths of the links, and return `[]` where it is too far or too near.",
        );
        for piece in &mut finding.evidence {
            (piece.value, piece.limit) = (None, None);
        }
        finding
    }

    fn answer_band(&self) -> Option<Band> {
        None
    }
}

fn score(facts: &CaseFacts<'_>) -> Option<CaseScore> {
    let CaseError::Unreachable { said_so } = facts.error else {
        return None;
    };
    let message = || {
        without_answer(facts).unwrap_or_else(|| {
            let name = facts.label();
            format!("{name}: angles for a target no arm of these lengths reaches")
        })
    };
    let lost = (!said_so).then(|| WrongAnswer::whole(facts, 1.0, message()));
    Some(CaseScore {
        score: if said_so { 1.0 } else { 0.0 },
        lost: lost.into_iter().collect(),
    })
}
