//! fk-orientation: the mean angle between the answered orientations of the TCP and the true ones \[rad\], over all cases of a task that
//! asks for more than positions. One answer that is no pose makes it infinite.
//!
//! With `pose = "yaw"` it is the turn between the headings, with `"axis"` the angle between the axes, whatever the length of the answered
//! one. With `"full"` it is `2 asin(‖R - R_true‖ / (2 √2))` in the Frobenius norm, which of two rotations is the angle of the turn between
//! them; a matrix that is no rotation is off by at least as much, and by `π` at most.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Mean angle that earns all points \[rad\].
    full_rad: f64,
    /// Mean angle that earns none \[rad\].
    zero_rad: f64,
}

problems! {
    /// A task whose poses are not turned.
    enum OrientationProblem {
        NoOrientation:
            "lab::pose", "this task asks for positions alone", "an orientation that nobody answers",
            "write `pose = \"full\"`, or \"axis\" or \"yaw\", below [tasks.function]";
    }
}

impl FunctionTable for Table {
    const NAME: &'static str = "fk-orientation";
    const FUNCTION: Option<&'static str> = Some("forward_kinematics");
    type Check = InBand<FkOrientation>;

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError> {
        if let Function::ForwardKinematics(form) = &reading.of.function
            && !form.is_turned()
        {
            return reading.refuse(OrientationProblem::NoOrientation);
        }
        reading.in_band([self.full_rad, self.zero_rad], "rad", FkOrientation)
    }
}

/// The mean angle from the true orientations.
#[derive(Debug)]
pub(crate) struct FkOrientation;

impl AnswerMeasure for FkOrientation {
    fn judge(&self, cases: &Cases<'_>) -> Finding {
        let error_rad = |facts: &CaseFacts<'_>| match facts.error {
            CaseError::Pose { angle_rad, .. } => angle_rad,
            _ => f64::INFINITY,
        };
        let mistakes = |facts: &CaseFacts<'_>, error_rad: f64| {
            let message = without_answer(facts).unwrap_or_else(|| {
                let off = with_unit(error_rad, "rad");
                format!(
                    "{}: turned {off} away from the true orientation",
                    facts.label()
                )
            });
            vec![WrongAnswer::whole(facts, error_rad, message)]
        };
        cases
            .mean_error("mean angle from the true orientation", error_rad, mistakes)
            .advise("Look at one case in which a single joint has turned by a quarter: where do the axes of the TCP point?")
    }

    fn is_of_single_answers(&self) -> bool {
        // the band that says whether an answer is good is one of metres
        false
    }
}
