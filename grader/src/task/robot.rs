//! The robot of a lab: its file, and the meshes that file names, all of them inside `robots/`.

use kinemark_sim::format::RobotFile;

use super::files::{Files, read_source};
use super::mesh_file::{self, MeshFile};
use super::problem::LoadError;

/// A robot file of the labs with its meshes.
#[derive(Debug, Clone)]
pub struct LabRobot {
    /// The file, its meshes read.
    pub file: RobotFile,
    /// The meshes as they were read, in the order the file names them.
    pub meshes: Vec<MeshFile>,
}

/// Names of the robots in `files`.
pub fn robot_names(files: &dyn Files) -> Vec<String> {
    files
        .list("robots")
        .iter()
        .filter_map(|file| Some(file.strip_suffix(".toml")?.to_owned()))
        .collect()
}

impl LabRobot {
    /// Loads the robot called `name`; `None` where there is none.
    ///
    /// # Errors
    /// [`LoadError`] where its file cannot be read, is no robot file, or names a mesh that is none or lies outside `robots/`.
    pub fn load(files: &dyn Files, name: &str) -> Result<Option<Self>, LoadError> {
        let Some(source) = read_source(files, &format!("robots/{name}.toml"))? else {
            return Ok(None);
        };
        let mut meshes = Vec::new();
        let file = RobotFile::parse(source)?.with_meshes(|name| {
            let mesh = mesh_file::read(files, "robots", name)?;
            let bytes = mesh.bytes.clone();
            meshes.push(mesh);
            Ok(bytes)
        })?;
        Ok(Some(Self { file, meshes }))
    }

    /// Identifies this robot: the digest of its file, and of its meshes if it has any.
    pub fn digest(file: &RobotFile, meshes: &[MeshFile]) -> blake3::Hash {
        mesh_file::digest(file.source().text(), meshes)
    }
}
