//! The TOML table of one sensor, as typed by a person; a robot file has a list of them, and other files may have the same.

use serde::Deserialize;
use toml::Spanned;

use crate::robot::part::tables::{NumberAt, TripleAt};

/// A `[[sensors]]` table; [`resolve`](super::resolve()) makes the [`Sensor`](super::Sensor) of it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorTable {
    pub(super) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(super) kind: Spanned<SensorType>,
    pub(super) joint: Option<Spanned<String>>,
    pub(super) frame: Option<Spanned<String>>,
    pub(super) link: Option<Spanned<String>>,
    pub(super) at: Option<NumberAt>,
    pub(super) side: Option<Spanned<SideName>>,
    pub(super) opens_motor: Option<Spanned<bool>>,
    pub(super) axis: Option<TripleAt>,
    pub(super) range_m: Option<NumberAt>,
    pub(super) noise: Option<NumberAt>,
    pub(super) quantisation: Option<NumberAt>,
    pub(super) delay_s: Option<NumberAt>,
    pub(super) rate_hz: Option<NumberAt>,
    pub(super) seed: Option<Spanned<u64>>,
}

impl SensorTable {
    /// The name as typed, with its place.
    pub fn name(&self) -> &Spanned<String> {
        &self.name
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SensorType {
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
pub(super) enum SideName {
    Lower,
    Upper,
}
