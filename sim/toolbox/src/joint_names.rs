//! Names of joints by their entries of `q`.

use kinemark_sim::model::robot::Robot;

/// The names of the joints that have these entries of `q`.
pub(crate) fn joint_names(robot: &Robot, entries: &[usize]) -> Vec<String> {
    let all: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    entries.iter().map(|&i| all[i].to_owned()).collect()
}
