//! A run: the tick loop of controller, servos, sensors and step; disturbances of it; and when its motion diverges.

mod disturbance;
mod divergence;
mod prescribed;
mod setup;
mod stepper;
mod tick_loop;

pub use disturbance::Disturbance;
pub use divergence::{DivergenceKind, RUNAWAY_SPEED_M_S};
pub use prescribed::PrescribedMotion;
pub use setup::{End, Observation, Recorder, Row, RunError, Setup};
pub use tick_loop::{Run, run};
