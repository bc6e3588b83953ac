//! The numbers of a class in a lab: how points are distributed, which students each check distinguishes, where hidden runs cost points,
//! and how sections, attempts and lateness compare. No name and no id is in them.
//!
//! Every number is made from sorted values in one order, so that the same class gives the same bits on every machine.

mod check;
mod groups;
mod lab;
mod mistakes;
mod runs;
mod spread;

pub use self::check::{Band, CheckStatistics, CheckValues, HiddenOnly, Pile};
pub use self::groups::GroupPoints;
pub use self::lab::{LabStatistics, StatusCount, Version, of_lab};
pub use self::mistakes::MistakeStatistics;
pub use self::runs::SlowRun;
pub use self::spread::{Bin, Spread, bins, correlation, mean};
