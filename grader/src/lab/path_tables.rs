//! The TOML types of a task's paths, and of the checks of how they are followed and by when.

use serde::Deserialize;
use toml::Spanned;

use super::file::NumberAt;

/// A path of straight segments, named by its key in `[tasks.motion.paths]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathTable {
    pub(super) points_m: Spanned<Vec<[f64; 3]>>,
    pub(super) trim_m: NumberAt,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathDeviationTable {
    pub(super) path: Spanned<String>,
    pub(super) segment: Option<Spanned<u64>>,
    pub(super) full_m: f64,
    pub(super) zero_m: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathCoverageTable {
    pub(super) path: Spanned<String>,
    pub(super) within_m: NumberAt,
    pub(super) full: f64,
    pub(super) zero: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathSpeedTable {
    pub(super) path: Spanned<String>,
    pub(super) segment: Option<Spanned<u64>>,
    pub(super) speed_m_s: NumberAt,
    pub(super) full: f64,
    pub(super) zero: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TimeLimitTable {
    pub(super) until: UntilName,
    pub(super) body: Option<Spanned<String>>,
    pub(super) path: Option<Spanned<String>>,
    pub(super) full_s: f64,
    pub(super) zero_s: f64,
}

/// What ends the time of a time limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum UntilName {
    Fall,
    Path,
}
