//! Joint servos: a command in, an effort out; the gains and periods at which they are stable; the step response of the ideal loop
//! and the measures of any.

mod joint_alone;
pub mod linear_step;
mod matrix_functions;
pub mod sampled_loop;
pub mod servo;
pub mod step_metrics;

pub use joint_alone::JointAlone;
pub use linear_step::LinearStep;
pub use sampled_loop::{SampledLoop, VariedGain, sampled_loop, stable_gain_factor};
pub use servo::{Derivative, GainLists, Gains, Mode, Servo, ServoError, ServoSettings};
pub use step_metrics::StepCurve;
