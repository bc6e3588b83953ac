//! fk-error: the mean distance of the answered positions from the true ones \[m\], over all cases. One answer that is no position, or
//! no pose where the task asks for one, makes it infinite. How a pose is turned is judged by `fk-orientation`.

use crate::check::prelude::*;

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
    const FUNCTION: Option<&'static str> = Some("forward_kinematics");
    type Check = InBand<FkError>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full_m, self.zero_m], "m", FkError)
    }
}

/// The mean distance from the true positions.
#[derive(Debug)]
pub(crate) struct FkError;

impl AnswerMeasure for FkError {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let error_m = |facts: &CaseFacts<'_>| match facts.error {
            CaseError::Position(error_m)
            | CaseError::Pose {
                position_m: error_m,
                ..
            } => error_m,
            _ => f64::INFINITY,
        };
        let mistakes = |facts: &CaseFacts<'_>, error_m: f64| {
            let message = without_answer(facts).unwrap_or_else(|| {
                let off = metres(error_m);
                format!("{}: {off} from the true position", facts.label())
            });
            vec![WrongAnswer::whole(facts, error_m, message)]
        };
        cases
            .mean_error("mean position error", error_m, mistakes)
            .advise("Work one of these cases by hand, and compare.")
    }
}
