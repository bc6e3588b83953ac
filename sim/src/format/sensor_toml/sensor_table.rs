//! The TOML table of one sensor, as typed by a person; a robot file has a list of them, and other files may have the same.

use serde::Deserialize;
use toml::Spanned;

use crate::format::part::part_tables::{NumberAt, TripleAt};

/// A `[[sensors]]` table; [`resolve`](super::resolve()) makes the [`Sensor`](crate::model::sensor::Sensor) of it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorTable {
    pub(crate) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<SensorType>,
    pub(crate) joint: Option<Spanned<String>>,
    pub(crate) frame: Option<Spanned<String>>,
    pub(crate) link: Option<Spanned<String>>,
    pub(crate) at: Option<NumberAt>,
    pub(crate) side: Option<Spanned<SideName>>,
    pub(crate) opens_motor: Option<Spanned<bool>>,
    pub(crate) axis: Option<TripleAt>,
    pub(crate) range_m: Option<NumberAt>,
    pub(crate) noise: Option<NumberAt>,
    pub(crate) quantisation: Option<NumberAt>,
    pub(crate) delay_s: Option<NumberAt>,
    pub(crate) rate_hz: Option<NumberAt>,
    pub(crate) seed: Option<Spanned<u64>>,
}

impl SensorTable {
    /// The name as typed, with its place.
    pub fn name(&self) -> &Spanned<String> {
        &self.name
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SensorType {
    JointPosition,
    JointVelocity,
    JointEffort,
    LimitSwitch,
    RangeFinder,
    Contact,
    Wrench,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SideName {
    Lower,
    Upper,
}
