//! Joint servos: a command in, an effort out; and the gains and periods at which they are stable.

pub mod sampled_loop;
pub mod servo;

pub use sampled_loop::{SampledLoop, sampled_loop};
pub use servo::{Derivative, Gains, Mode, Servo, ServoSettings};
