//! Robot files: TOML, with expressions over named dimensions; read and written.

mod dh;
mod robot_reader;
pub(super) mod robot_tables;
mod robot_writer;
mod sensor_writer;

pub use robot_tables::RobotFile;
