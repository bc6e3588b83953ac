//! What a log is requested to be: how its messages are written, and how many of them.

use serde::{Deserialize, Serialize};

/// Flat signals a second where nothing is requested.
const SIGNAL_RATE_HZ: u32 = 100;
/// The highest rate of flat signals; no physics step is shorter than a tenth of a millisecond.
pub const MOST_SIGNAL_RATE_HZ: u32 = 10_000;

/// How messages with Foxglove's schemas are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Encoding {
    /// In Foxglove's binary form, which every viewer of such logs reads.
    #[default]
    Protobuf,
    /// As text, for programs of one's own.
    Json,
}

/// What a log is requested to be.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogRequest {
    /// How messages with Foxglove's schemas are written.
    pub encoding: Encoding,
    /// Flat signals a second \[Hz\], from 1 to [`MOST_SIGNAL_RATE_HZ`]; 100 where it is absent. There are at most as many as there are physics steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<u32>,
}

impl LogRequest {
    /// Flat signals a second \[Hz\].
    pub fn signal_rate_hz(self) -> f64 {
        let rate_hz = self.rate_hz.unwrap_or(SIGNAL_RATE_HZ);
        f64::from(rate_hz.clamp(1, MOST_SIGNAL_RATE_HZ))
    }
}
