//! Sensors at work: what the world shows them tick by tick, and what their devices make of it.

mod device;
mod limit_switch;
mod range_finder;
mod sampling;
mod wrench;

pub use sampling::{Seen, SensorError, Sensors};
