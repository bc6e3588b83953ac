//! The TOML tables of checks of step responses, efforts, energy and smoothness, as typed.

use serde::Deserialize;
use toml::Spanned;

use super::{DerivativeName, NumberAt};

/// The signal of a joint that is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(in crate::lab) enum OfName {
    #[default]
    Position,
    Velocity,
}

/// The linear loop drawn beside the run.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct PredictionTable {
    pub(in crate::lab) inertia: f64,
    #[serde(default)]
    pub(in crate::lab) damping: f64,
    #[serde(default)]
    pub(in crate::lab) kp: f64,
    #[serde(default)]
    pub(in crate::lab) ki: f64,
    #[serde(default)]
    pub(in crate::lab) kd: f64,
    pub(in crate::lab) derivative: Option<Spanned<DerivativeName>>,
}

/// The keys that checks of a step response share, of one table.
pub(in crate::lab) struct StepKeys<'t> {
    pub(in crate::lab) joint: &'t Spanned<String>,
    pub(in crate::lab) of: OfName,
    pub(in crate::lab) target_rad: &'t Option<NumberAt>,
    pub(in crate::lab) target_rad_s: &'t Option<NumberAt>,
    /// Length of the part at the end that counts, and the name of its key.
    pub(in crate::lab) last: (&'t Option<NumberAt>, &'static str),
    pub(in crate::lab) prediction: &'t Option<Spanned<PredictionTable>>,
}

/// A table with the keys of every check of a step response, the one of its last part under `$last`, and with its own. (Serde cannot
/// flatten a table that refuses unknown keys.)
macro_rules! step_table {
    ($table:ident, $last:ident, { $($own:ident: $type:ty,)* }) => {
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(in crate::lab) struct $table {
            joint: Spanned<String>,
            #[serde(default)]
            pub(in crate::lab) of: OfName,
            target_rad: Option<NumberAt>,
            target_rad_s: Option<NumberAt>,
            $last: Option<NumberAt>,
            prediction: Option<Spanned<PredictionTable>>,
            $(pub(in crate::lab) $own: $type,)*
        }

        impl $table {
            pub(in crate::lab) fn keys(&self) -> StepKeys<'_> {
                StepKeys {
                    joint: &self.joint,
                    of: self.of,
                    target_rad: &self.target_rad,
                    target_rad_s: &self.target_rad_s,
                    last: (&self.$last, concat!("`", stringify!($last), "`")),
                    prediction: &self.prediction,
                }
            }
        }
    };
}

step_table!(RiseTimeTable, final_s, {
    from: Option<NumberAt>,
    to: Option<NumberAt>,
    full_s: f64,
    zero_s: f64,
});

step_table!(SettlingTimeTable, final_s, {
    within: Option<NumberAt>,
    full_s: f64,
    zero_s: f64,
});

step_table!(StepOvershootTable, final_s, {
    full: f64,
    zero: f64,
});

step_table!(SteadyErrorTable, last_s, {
    full_rad: Option<NumberAt>,
    zero_rad: Option<NumberAt>,
    full_rad_s: Option<NumberAt>,
    zero_rad_s: Option<NumberAt>,
});

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct EffortTable {
    pub(in crate::lab) joint: Option<Spanned<String>>,
    pub(in crate::lab) full_n_m: f64,
    pub(in crate::lab) zero_n_m: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct BandJ {
    pub(in crate::lab) full_j: f64,
    pub(in crate::lab) zero_j: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct BandRadS {
    pub(in crate::lab) full_rad_s: f64,
    pub(in crate::lab) zero_rad_s: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct BandJerk {
    pub(in crate::lab) full_m_s3: f64,
    pub(in crate::lab) zero_m_s3: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct ChatterTable {
    pub(in crate::lab) joint: Option<Spanned<String>>,
    pub(in crate::lab) full_hz: f64,
    pub(in crate::lab) zero_hz: f64,
}
