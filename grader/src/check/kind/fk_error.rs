//! fk-error: the mean distance of the answered positions from the true ones \[m\], over all cases. One answer that is no position
//! makes it infinite.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::metres;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::attempt::answers::{CaseError, CaseFacts};
use crate::check::cases::{Summary, without_answer};
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
    /// Mean distance that earns all points \[m\].
    full_m: f64,
    /// Mean distance that earns none \[m\].
    zero_m: f64,
}

impl FunctionTable for Table {
    const NAME: &'static str = "fk-error";
    const TASK: &'static str = "a function task of `forward_kinematics`";
    type Check = FkError;

    fn fits(function: &Function) -> bool {
        *function == Function::ForwardKinematics
    }

    fn read(&self, at: Range<usize>, reading: &FunctionReading<'_>) -> Result<FkError, LabError> {
        let band = reading.report.band(self.full_m, self.zero_m, at)?;
        Ok(FkError { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct FkError {
    band: Band,
}

impl CheckKind for FkError {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }
}

impl FunctionCheck for FkError {
    fn judge(&self, function: &Function, cases: &[CaseFacts<'_>]) -> Finding {
        let summary = Summary {
            function,
            quantity: "mean position error".to_owned(),
            band: self.band,
            unit: "m",
        };
        let error_m = |facts: &CaseFacts<'_>| match facts.error {
            CaseError::Position(error_m) => error_m,
            CaseError::Reach { .. }
            | CaseError::Unreachable { .. }
            | CaseError::Jacobian { .. }
            | CaseError::Entries(_) => f64::INFINITY,
        };
        let message = |facts: &CaseFacts<'_>, error_m: f64| {
            without_answer(facts).unwrap_or_else(|| {
                format!(
                    "{}: {} from the true position",
                    facts.told(),
                    metres(error_m)
                )
            })
        };
        summary
            .mean_error(cases, error_m, message)
            .advise("Work one of these cases by hand, and compare.")
    }

    fn answer_band(&self) -> Option<Band> {
        Some(self.band)
    }
}
