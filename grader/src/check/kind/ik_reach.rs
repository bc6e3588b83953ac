//! ik-reach: how near the best branch of each answer comes to its target, by Kinemark's forward kinematics \[m\].
//!
//! Each reachable case is scored by the band; the check's score is their mean. Whole turns and the order of branches make no
//! difference.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::metres;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::check::cases::{CaseScore, Summary, without_answer};
use crate::check::contract::{CheckKind, FunctionCheck};
use crate::check::finding::Finding;
use crate::check::reading::FunctionReading;
use crate::check::registry::FunctionTable;
use crate::record::quantity::with_unit;
use crate::task::model::{Band, Function};
use crate::task::problem::LabError;

/// What every check of inverse kinematics needs.
pub(super) const TASK: &str = "a function task of `inverse_kinematics`";

/// What the brief says of a band that every target is held against.
pub(super) fn bounds_of_each(band: Band) -> [String; 2] {
    [
        format!("every target within {}", with_unit(band.full, "m")),
        format!("every target {} off", with_unit(band.zero, "m")),
    ]
}

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
    const TASK: &'static str = TASK;
    type Check = IkReach;

    fn fits(function: &Function) -> bool {
        *function == Function::InverseKinematics
    }

    fn read(&self, at: Range<usize>, reading: &FunctionReading<'_>) -> Result<IkReach, LabError> {
        let band = reading.report.band(self.full_m, self.zero_m, at)?;
        Ok(IkReach { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct IkReach {
    band: Band,
}

impl CheckKind for IkReach {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }

    fn bounds(&self, _: &Robot, _: &[&str]) -> [String; 2] {
        bounds_of_each(self.band)
    }
}

impl FunctionCheck for IkReach {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: "targets reached".to_owned(),
            band: self.band,
            unit: "m",
        };
        let score = |facts: &CaseFacts<'_>| {
            let CaseError::Reach { branches_m, .. } = &facts.error else {
                return None;
            };
            let nearest_m = branches_m.first().copied().unwrap_or(f64::INFINITY);
            Some(CaseScore::of(nearest_m, self.band, || {
                message(facts, nearest_m)
            }))
        };
        summary.mean_score(cases, score).advise(
            "Put your angles through your own forward kinematics: it must give the target back.",
        )
    }

    fn answer_band(&self) -> Option<Band> {
        Some(self.band)
    }
}

fn message(facts: &CaseFacts<'_>, nearest_m: f64) -> String {
    let name = facts.told();
    match &facts.answer {
        Answered::Branches(branches) if branches.is_empty() => {
            format!("{name}: said to be out of reach, but it is not")
        }
        _ => without_answer(facts).unwrap_or_else(|| {
            format!("{name}: the arm ends {} from the target", metres(nearest_m))
        }),
    }
}
