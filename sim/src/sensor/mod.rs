//! Sensors: what a robot measures of itself and of what is around it, as a real device would tell it.
//!
//! | file | what it holds |
//! |---|---|
//! | `file` | the TOML table of a sensor, in a robot file or wherever else sensors are described |
//! | `resolve` | from the table to the sensor: names become indices, expressions numbers |
//! | `model` | the sensor as the simulator gets it |
//! | `problem` | everything that can be wrong with a table |
//! | `device` | noise, quantisation, rate and delay of one sensor |
//! | `limit_switch` | when a switch is pressed, and the motor that it opens |
//! | `range_finder` | the ray among bodies, ground and links |
//! | `wrench` | what passes through a joint, by Newton and Euler |
//! | `sampling` | all sensors of one run, tick by tick |

mod device;
mod file;
mod limit_switch;
mod model;
mod problem;
mod range_finder;
mod resolve;
mod sampling;
mod wrench;

pub use file::SensorTable;
pub use limit_switch::{LimitSwitch, Side};
pub use model::{Sensor, SensorKind, default_seed, replaced};
pub use problem::SensorProblem;
pub use range_finder::RangeFinder;
pub use resolve::{resolve, resolve_all};
pub use sampling::{Seen, SensorError, Sensors};
