//! Joint servos: a command in, an effort out.

pub mod servo;

pub use servo::{Derivative, Gains, Mode, Servo, ServoSettings};
