//! Tables of sensors, in a robot file or wherever else sensors are described.

pub(super) mod sensor_problem;
mod sensor_reader;
mod sensor_table;

pub use sensor_problem::SensorProblem;
pub use sensor_reader::{resolve, resolve_all};
pub use sensor_table::SensorTable;
