//! Sensors at work: what the world shows them tick by tick, and what their devices make of it.

mod device;
mod sampling;

pub use sampling::{SensorError, Sensors};
