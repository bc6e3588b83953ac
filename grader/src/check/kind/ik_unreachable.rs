//! ik-unreachable: the share of the targets out of reach that are answered with an empty list, `[]`.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use schemars::JsonSchema;
use serde::Deserialize;

use super::ik_reach;
use crate::attempt::answers::{CaseError, CaseFacts};
use crate::check::cases::{CaseScore, Summary, without_answer};
use crate::check::contract::{CheckKind, FunctionCheck};
use crate::check::finding::Finding;
use crate::check::reading::FunctionReading;
use crate::check::registry::FunctionTable;
use crate::task::model::{Band, Function};
use crate::task::problem::LabError;

/// No keys: write `{}`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {}

impl FunctionTable for Table {
    const NAME: &'static str = "ik-unreachable";
    const TASK: &'static str = ik_reach::TASK;
    type Check = IkUnreachable;

    fn fits(function: &Function) -> bool {
        *function == Function::InverseKinematics
    }

    fn read(&self, _: Range<usize>, _: &FunctionReading<'_>) -> Result<IkUnreachable, LabError> {
        Ok(IkUnreachable)
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct IkUnreachable;

impl CheckKind for IkUnreachable {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        None
    }
}

impl FunctionCheck for IkUnreachable {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: "targets out of reach that are told so".to_owned(),
            band: Band {
                full: 0.0,
                zero: 0.0,
            },
            unit: "",
        };
        let mut finding = summary.mean_score(cases, score).advise(
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
            let name = facts.told();
            format!("{name}: angles for a target no arm of these lengths reaches")
        })
    };
    Some(CaseScore {
        score: if said_so { 1.0 } else { 0.0 },
        lost: (!said_so).then(|| (1.0, message())),
    })
}
