//! Any robot as a description that is written.

use kinemark_sim::format::NameMesh;
use kinemark_sim::model::robot::Robot;

/// A description, and what its reader should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Converted {
    /// The text of the description.
    pub text: String,
    /// The warnings of the robot, and the meshes that have no path.
    pub warnings: Vec<String>,
}

/// Writes `robot` with the writer of a format; `mesh_path` gives the path of a mesh as the new file should name it, if the mesh is a
/// file.
pub fn converted(
    robot: &Robot,
    write: fn(&Robot, &mut NameMesh<'_>) -> String,
    mut mesh_path: impl FnMut(&str) -> Option<String>,
) -> Converted {
    let mut warnings = robot.warnings().to_vec();
    let text = write(robot, &mut |name| {
        mesh_path(name).unwrap_or_else(|| {
            warnings.push(format!(
                "mesh `{name}` is built into this program and has no path"
            ));
            name.to_owned()
        })
    });
    Converted { text, warnings }
}
