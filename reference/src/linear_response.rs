//! Exact step responses of rational transfer functions.
//!
//! A response is a finite sum of exponentials (times powers of `t` where poles meet), so its value, slope and
//! extrema need no integration and no sampling. The way through the files:
//!
//! ```text
//! PidLoop ──> TransferFunction ──> StepResponse ──> StepMetrics
//!              poles, zeros          value(t)         rise, settling, overshoot, peak
//! ```

mod exponential_sum;
mod pid_loop;
mod polynomial;
mod step_metrics;
mod transfer_function;
mod two_double;

pub use pid_loop::{DerivativeOn, JointPlant, PidGains, PidLoop};
pub use step_metrics::{StepMetrics, StepMetricsError};
pub use transfer_function::{StepResponse, TransferFunction, TransferFunctionError};
