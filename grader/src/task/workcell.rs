//! What all tasks of a lab are done with: its robot, and the frame in which students work.

use kinemark_sim::model::robot::Robot;

/// The robot of a lab, and the frame in which positions are given to submissions.
#[derive(Debug, Clone, Copy)]
pub struct Workcell<'a> {
    /// The robot as its file states it, but for the dimensions that the lab changes.
    pub robot: &'a Robot,
    /// Name of the frame in which students work.
    pub frame: &'a str,
}
