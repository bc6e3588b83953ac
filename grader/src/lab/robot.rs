//! The robot of a lab: its file, and the meshes that file names, all of them inside `robots/`.

use kinemark_sim::robot::RobotFile;

use super::files::Files;
use super::load::read;
use super::problem::LoadError;

/// A robot file of the labs with its meshes.
#[derive(Debug, Clone)]
pub struct LabRobot {
    /// The file, its meshes read.
    pub file: RobotFile,
    /// The meshes as they were read, in the order the file names them.
    pub meshes: Vec<MeshFile>,
}

/// A mesh as its file has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshFile {
    /// Its path inside the labs, such as `robots/meshes/hand.stl`.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
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
        let Some(source) = read(files, &format!("robots/{name}.toml"))? else {
            return Ok(None);
        };
        let mut meshes = Vec::new();
        let file = RobotFile::parse(source)?.with_meshes(|name| {
            let mesh = mesh(files, name)?;
            let bytes = mesh.bytes.clone();
            meshes.push(mesh);
            Ok(bytes)
        })?;
        Ok(Some(Self { file, meshes }))
    }

    /// What tells this robot from any other: the digest of its file, and of its meshes where it has some.
    pub fn digest(file: &RobotFile, meshes: &[MeshFile]) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        hasher.update(file.source().text().as_bytes());
        for mesh in meshes {
            // a length before each part, so that no two robots have the same bytes in all
            for part in [mesh.path.as_bytes(), &mesh.bytes] {
                hasher.update(&(part.len() as u64).to_le_bytes());
                hasher.update(part);
            }
        }
        hasher.finalize()
    }
}

/// A lab can be copied and graded elsewhere, so its meshes lie beside its robots.
fn mesh(files: &dyn Files, name: &str) -> Result<MeshFile, String> {
    let inside = |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':']);
    if !name.split('/').all(inside) {
        return Err(
            "a mesh of a lab lies inside its robots folder, so its path is neither absolute nor has it `..`"
                .to_owned(),
        );
    }
    let path = format!("robots/{name}");
    match files.bytes(&path)? {
        Some(bytes) => Ok(MeshFile { path, bytes }),
        None => Err(format!("there is no file `{path}` in {}", files.name())),
    }
}
