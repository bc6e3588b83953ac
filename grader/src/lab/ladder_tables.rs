//! The TOML types of a robustness check: a ladder of rungs, each a disturbance of the same motion.

use serde::Deserialize;
use toml::Spanned;

use super::file::NumberAt;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobustnessTable {
    pub(super) check: Spanned<String>,
    #[serde(default)]
    pub(super) rungs: Vec<Spanned<RungTable>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RungTable {
    pub(super) name: Spanned<String>,
    pub(super) share: Option<NumberAt>,
    pub(super) noise: Option<Spanned<NoiseTable>>,
    pub(super) delay_ms: Option<NumberAt>,
    pub(super) payload_kg: Option<NumberAt>,
    pub(super) friction_n_m: Option<NumberAt>,
    pub(super) damping: Option<NumberAt>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NoiseTable {
    #[serde(default)]
    pub(super) q_rad: f64,
    #[serde(default)]
    pub(super) qd_rad_s: f64,
}
