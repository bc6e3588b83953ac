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

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct RiseTimeTable {
    pub(in crate::lab) joint: Spanned<String>,
    #[serde(default)]
    pub(in crate::lab) of: OfName,
    pub(in crate::lab) target_rad: Option<NumberAt>,
    pub(in crate::lab) target_rad_s: Option<NumberAt>,
    pub(in crate::lab) final_s: Option<NumberAt>,
    pub(in crate::lab) prediction: Option<Spanned<PredictionTable>>,
    pub(in crate::lab) from: Option<NumberAt>,
    pub(in crate::lab) to: Option<NumberAt>,
    pub(in crate::lab) full_s: f64,
    pub(in crate::lab) zero_s: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct SettlingTimeTable {
    pub(in crate::lab) joint: Spanned<String>,
    #[serde(default)]
    pub(in crate::lab) of: OfName,
    pub(in crate::lab) target_rad: Option<NumberAt>,
    pub(in crate::lab) target_rad_s: Option<NumberAt>,
    pub(in crate::lab) final_s: Option<NumberAt>,
    pub(in crate::lab) prediction: Option<Spanned<PredictionTable>>,
    pub(in crate::lab) within: Option<NumberAt>,
    pub(in crate::lab) full_s: f64,
    pub(in crate::lab) zero_s: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct StepOvershootTable {
    pub(in crate::lab) joint: Spanned<String>,
    #[serde(default)]
    pub(in crate::lab) of: OfName,
    pub(in crate::lab) target_rad: Option<NumberAt>,
    pub(in crate::lab) target_rad_s: Option<NumberAt>,
    pub(in crate::lab) final_s: Option<NumberAt>,
    pub(in crate::lab) prediction: Option<Spanned<PredictionTable>>,
    pub(in crate::lab) full: f64,
    pub(in crate::lab) zero: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct SteadyErrorTable {
    pub(in crate::lab) joint: Spanned<String>,
    #[serde(default)]
    pub(in crate::lab) of: OfName,
    pub(in crate::lab) target_rad: Option<NumberAt>,
    pub(in crate::lab) target_rad_s: Option<NumberAt>,
    pub(in crate::lab) last_s: Option<NumberAt>,
    pub(in crate::lab) prediction: Option<Spanned<PredictionTable>>,
    pub(in crate::lab) full_rad: Option<NumberAt>,
    pub(in crate::lab) zero_rad: Option<NumberAt>,
    pub(in crate::lab) full_rad_s: Option<NumberAt>,
    pub(in crate::lab) zero_rad_s: Option<NumberAt>,
}

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
