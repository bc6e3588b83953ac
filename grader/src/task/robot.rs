//! The robot of a lab: its description, a robot file or a URDF, and the meshes that it names, all of them inside `robots/`.

use std::collections::BTreeMap;

use kinemark_sim::format::joint_string::looks_like_one;
use kinemark_sim::format::{MeshLocation, ReadOptions, RobotDescription, detect};
use kinemark_sim::text::Source;

use super::files::{Files, read_source};
use super::mesh_file::{self, MeshFile};
use super::problem::LoadError;

/// A robot of the labs with its meshes.
#[derive(Debug, Clone)]
pub struct LabRobot {
    /// Its description, the meshes read.
    pub file: RobotDescription,
    /// The meshes as they were read, in the order the description names them.
    pub meshes: Vec<MeshFile>,
    /// Whether it is one of ROS, to which [`RobotOptions`] belong.
    pub is_of_ros: bool,
    /// The first mesh that the description names and nobody has: its shape is left out, so that nothing touches it.
    pub missing_mesh: Option<String>,
}

/// How a description of ROS is read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RobotOptions {
    /// What of the description counts.
    pub read: ReadOptions,
    /// Folders inside `robots/` by the name of the ROS package that lies there; any other package lies in the folder of its name.
    pub packages: BTreeMap<String, String>,
}

/// The ending of a URDF, which a lab writes with its name.
const URDF: &str = ".urdf";

/// Names of the robots in `files`: of robot files without their ending, of URDFs with it.
pub fn robot_names(files: &dyn Files) -> Vec<String> {
    files
        .list("robots")
        .iter()
        .filter_map(|file| match file.strip_suffix(".toml") {
            Some(name) => Some(name.to_owned()),
            None => file.ends_with(URDF).then(|| file.clone()),
        })
        .collect()
}

/// The path of the robot called `name`.
pub fn robot_path(name: &str) -> String {
    if name.ends_with(URDF) {
        format!("robots/{name}")
    } else {
        format!("robots/{name}.toml")
    }
}

impl LabRobot {
    /// The robot that a lab names: that of a file, or, where there is none of that name, a row of joints.
    ///
    /// # Errors
    /// Those of [`Self::load`] and [`Self::of_row`].
    pub fn named(
        files: &dyn Files,
        name: &str,
        options: &RobotOptions,
    ) -> Result<Option<Self>, LoadError> {
        let named = Self::load(files, name, options)?;
        let row = (named.is_none() && looks_like_one(name)).then(|| Self::of_row(name));
        Ok(named.or(row.transpose()?))
    }

    /// Loads the robot called `name`: a robot file, or a URDF by its path inside `robots/` with its ending. `None` where there is none.
    ///
    /// # Errors
    /// [`LoadError`] where its file cannot be read or is no robot, or a robot file names a mesh that is none or lies outside
    /// `robots/`.
    pub fn load(
        files: &dyn Files,
        name: &str,
        options: &RobotOptions,
    ) -> Result<Option<Self>, LoadError> {
        let path = robot_path(name);
        if mesh_file::inside("robots", "", &path["robots/".len()..]).as_ref() != Some(&path) {
            return Ok(None);
        }
        let Some(source) = read_source(files, &path)? else {
            return Ok(None);
        };
        let format = detect(&Source::new(path.as_str(), ""));
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let folder = folder.strip_prefix("robots").unwrap_or_default();
        let (mut meshes, mut missing_mesh) = (Vec::new(), None);
        let mut read = |name: &str| {
            let read = if format.is_of_ros {
                let location = (format.mesh_location)(name);
                candidates(location, folder.trim_start_matches('/'), options)
                    .and_then(|paths| mesh_file::read_first(files, name, &paths))
            } else {
                mesh_file::read(files, "robots", name)
            };
            if read.is_err() && missing_mesh.is_none() {
                missing_mesh = Some(name.to_owned());
            }
            let mesh = read?;
            let bytes = mesh.bytes.clone();
            meshes.push(mesh);
            Ok(bytes)
        };
        let file = RobotDescription::read(source, &options.read, &mut read)?;
        Ok(Some(Self {
            file,
            meshes,
            is_of_ros: format.is_of_ros,
            missing_mesh,
        }))
    }

    /// The robot of a row of joints such as `RzTxRy`, which needs no file.
    ///
    /// # Errors
    /// A letter that does not fit.
    pub fn of_row(row: &str) -> Result<Self, LoadError> {
        Ok(Self {
            file: RobotDescription::of_row(row)?,
            meshes: Vec::new(),
            is_of_ros: false,
            missing_mesh: None,
        })
    }

    /// Identifies this robot: the digest of its file, and of its meshes if it has any.
    pub fn digest(file: &RobotDescription, meshes: &[MeshFile]) -> blake3::Hash {
        mesh_file::digest(file.source().text(), meshes)
    }
}

/// The paths at which a mesh may lie that a description in the folder `folder` of `robots/` names, the best first.
fn candidates(
    location: MeshLocation<'_>,
    folder: &str,
    options: &RobotOptions,
) -> Result<Vec<String>, String> {
    let inside = |folder: &str, path: &str| {
        mesh_file::inside("robots", folder, path).ok_or_else(|| {
            "a mesh of a lab lies inside its robots folder, so its path is not absolute and does not lead out of it"
                .to_owned()
        })
    };
    match location {
        MeshLocation::Relative(path) => Ok(vec![inside(folder, path)?]),
        MeshLocation::Absolute(path) => Err(format!(
            "`{path}` is not inside the robots folder of the labs"
        )),
        MeshLocation::Unsupported { scheme } => Err(format!(
            "`{scheme}://` addresses are not supported; save the file in robots/ and use its path there"
        )),
        MeshLocation::Package { name, path } => {
            let at = options.packages.get(name).map_or(name, String::as_str);
            Ok(vec![inside(at, path)?, inside(folder, path)?])
        }
    }
}
