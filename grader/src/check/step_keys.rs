//! The keys that checks of a step response share: a joint and its signal, where it should go, and the linear loop drawn beside it.

use kinemark_sim::control::LinearStep;
use kinemark_sim::control::linear_step::Fed;
use schemars::JsonSchema;
use serde::Deserialize;

use super::prediction::PredictionTable;
use super::reading::{At, MotionReading};
use crate::task::joint_units::JointUnits;
use crate::task::problem::{LabError, problems};

/// The step response of a joint that a check looks at.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StepResponse {
    /// Index of the joint in `q`.
    pub(super) joint: usize,
    /// Units of the joint.
    pub(super) units: JointUnits,
    /// The signal.
    pub(super) of: Fed,
    /// The setpoint, where the lab says so, in the unit of the signal.
    pub(super) target: Option<f64>,
    /// Ticks at the end of the run whose mean is the final value; at least 1, fewer than the run has.
    pub(super) final_ticks: usize,
    /// The loop drawn beside the run; only with a target.
    pub(super) prediction: Option<LinearStep>,
}

impl StepResponse {
    /// Unit of the signal.
    pub(super) fn unit(&self) -> &'static str {
        match self.of {
            Fed::Position => self.units.position(),
            Fed::Velocity => self.units.speed(),
        }
    }

    /// Its column in the trace.
    pub(super) fn column(&self) -> &'static str {
        match self.of {
            Fed::Position => "q",
            Fed::Velocity => "qd",
        }
    }
}

/// The signal of a joint that is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum OfName {
    #[default]
    Position,
    Velocity,
}

/// The shared keys, of one table.
pub(super) struct StepKeys<'t> {
    pub(super) joint: &'t At<String>,
    pub(super) of: OfName,
    pub(super) target_rad: Option<&'t At<f64>>,
    pub(super) target_rad_s: Option<&'t At<f64>>,
    /// Length of the part at the end that counts.
    pub(super) last_s: Option<&'t At<f64>>,
    /// The key of that, in backquotes.
    pub(super) last_key: &'static str,
    /// Length of that part where the lab does not say \[s\].
    pub(super) absent_s: f64,
    pub(super) prediction: Option<&'t At<PredictionTable>>,
}

/// A `Table` with the keys of every check of a step response, the one of its last part under `$last` with its default, and with its
/// own. (Serde cannot flatten a table that refuses unknown keys.)
macro_rules! step_table {
    (
        $(#[$last_doc:meta])* $last:ident = $absent_s:literal;
        $($(#[$own_doc:meta])* $own:ident: $type:ty,)*
    ) => {
        /// The keys.
        #[derive(Debug, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct Table {
            /// A joint that moves.
            joint: At<String>,
            /// The signal: `position` or `velocity`; `position` where it is left out.
            #[serde(default)]
            of: $crate::check::step_keys::OfName,
            /// The setpoint of a `position` \[rad, or m of a prismatic joint\]; needed with a `prediction`.
            target_rad: Option<At<f64>>,
            /// The setpoint of a `velocity` \[rad/s, or m/s of a prismatic joint\]; needed with a `prediction`.
            target_rad_s: Option<At<f64>>,
            $(#[$last_doc])*
            $last: Option<At<f64>>,
            /// The linear loop that is drawn beside the run.
            prediction: Option<At<$crate::check::prediction::PredictionTable>>,
            $($(#[$own_doc])* $own: $type,)*
        }

        impl Table {
            fn keys(&self) -> $crate::check::step_keys::StepKeys<'_> {
                $crate::check::step_keys::StepKeys {
                    joint: &self.joint,
                    of: self.of,
                    target_rad: self.target_rad.as_ref(),
                    target_rad_s: self.target_rad_s.as_ref(),
                    last_s: self.$last.as_ref(),
                    last_key: concat!("`", stringify!($last), "`"),
                    absent_s: $absent_s,
                    prediction: self.prediction.as_ref(),
                }
            }
        }
    };
}
pub(super) use step_table;

problems! {
    /// What is wrong with the keys of a step response.
    enum StepProblem {
        Share { what: &'static str, value: f64, absent: f64 }:
            "lab::step", "{what} is a share of the step, above 0 and below 1, got {value}", "this share",
            format!("left out it is {absent}");
        TargetOfOther { wanted: &'static str }:
            "lab::step", "the target has the unit of another signal than `of` names", "of the wrong unit",
            format!("write `{wanted}`, or change `of`");
        NoTarget { wanted: &'static str }:
            "lab::step", "a prediction needs to know the step", "the target is missing",
            format!("add it, such as `{wanted} = 1.0`");
        NotShorterThanRun { what: &'static str, length_s: f64, run_s: f64 }:
            "lab::periods", "{what} is {length_s} s, and the run has {run_s} s in all", "not shorter than the run",
            format!("make {what} shorter, or the run longer");
    }
}

impl MotionReading<'_> {
    /// A share of the step, above 0 and below 1; `absent` where none is typed.
    pub(super) fn share_of_step(
        &self,
        typed: Option<&At<f64>>,
        what: &'static str,
        absent: f64,
    ) -> Result<f64, LabError> {
        let Some(number) = typed else {
            return Ok(absent);
        };
        let value = *number.get_ref();
        if value > 0.0 && value < 1.0 {
            return Ok(value);
        }
        let problem = StepProblem::Share {
            what,
            value,
            absent,
        };
        self.refuse_at(number, problem)
    }

    /// What a check looks at.
    pub(super) fn step_response(&self, keys: &StepKeys<'_>) -> Result<StepResponse, LabError> {
        let joint = self.joint(keys.joint)?;
        let position = (keys.target_rad, "target_rad");
        let velocity = (keys.target_rad_s, "target_rad_s");
        let (of, (target, wanted), (foreign, _)) = match keys.of {
            OfName::Position => (Fed::Position, position, velocity),
            OfName::Velocity => (Fed::Velocity, velocity, position),
        };
        if let Some(typed) = foreign {
            let problem = StepProblem::TargetOfOther { wanted };
            return self.refuse_at(typed, problem);
        }
        let prediction = keys.prediction.map(|table| self.prediction(table, of));
        let prediction = prediction.transpose()?;
        if prediction.is_some() && target.is_none() {
            return self.refuse(StepProblem::NoTarget { wanted });
        }
        Ok(StepResponse {
            joint,
            units: JointUnits::of(self.robot, joint),
            of,
            target: target.map(|number| *number.get_ref()),
            final_ticks: self.final_ticks(keys)?,
            prediction,
        })
    }

    /// Ticks of the part at the end that counts.
    fn final_ticks(&self, keys: &StepKeys<'_>) -> Result<usize, LabError> {
        let length_s = match keys.last_s {
            Some(number) => self.report.positive(number, keys.last_key)?,
            None => keys.absent_s,
        };
        let periods = &self.motion.periods;
        let ticks = (length_s / periods.step_s).round().max(1.0);
        if ticks < self.motion.ticks as f64 {
            return Ok(ticks as usize);
        }
        let problem = StepProblem::NotShorterThanRun {
            what: keys.last_key,
            length_s,
            run_s: periods.time_s(self.motion.ticks),
        };
        match keys.last_s {
            Some(typed) => self.refuse_at(typed, problem),
            None => self.refuse(problem),
        }
    }
}
