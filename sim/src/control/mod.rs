//! Joint servos: a command in, an effort out; the gains and periods at which they are stable; the step response of the ideal loop;
//! and the speed limits of drives.

pub mod linear_step;
mod matrix_functions;
pub mod sampled_loop;
pub mod servo;
pub mod speed_limit;

pub use linear_step::LinearStep;
pub use sampled_loop::{SampledLoop, sampled_loop};
pub use servo::{Derivative, GainLists, Gains, Mode, Servo, ServoError, ServoSettings};
