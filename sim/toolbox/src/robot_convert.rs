//! Any robot as a robot file.

use kinemark_sim::model::robot::Robot;

/// A robot file, and what its reader should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Converted {
    /// The text of the robot file (TOML).
    pub toml: String,
    /// The warnings of the robot, and the meshes that have no path.
    pub warnings: Vec<String>,
}

/// Writes `robot` as a robot file; `mesh_path` gives the path of a mesh as the new file should name it, if the mesh is a file.
pub fn robot_file(robot: &Robot, mut mesh_path: impl FnMut(&str) -> Option<String>) -> Converted {
    let mut warnings = robot.warnings().to_vec();
    let toml = robot.to_toml(&mut |name| {
        mesh_path(name).unwrap_or_else(|| {
            warnings.push(format!(
                "mesh `{name}` is built into this program and has no path"
            ));
            name.to_owned()
        })
    });
    Converted { toml, warnings }
}
