//! A scene of the labs: its file, and the meshes that file names, all of them inside `scenes/`.

use kinemark_sim::format::{SceneError, SceneFile};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{Environment, Scene};
use kinemark_sim::text::Dimension;

use super::files::{Files, read_source};
use super::mesh_file::{self, MeshFile};
use super::problem::LoadError;

/// A scene file of the labs with its meshes, and the scene it makes.
#[derive(Debug, Clone)]
pub struct LabScene {
    /// Its name, which is its file's.
    pub name: String,
    /// The file, its meshes read.
    pub file: SceneFile,
    /// The meshes as they were read, in the order the file names them.
    pub meshes: Vec<MeshFile>,
    /// Dimensions that a lab changes.
    pub dimensions: Vec<(String, Dimension)>,
    /// The scene as its file states it, but for these dimensions, and for the gravity and the wind of a task.
    pub scene: Scene,
}

/// Names of the scenes in `files`.
pub fn scene_names(files: &dyn Files) -> Vec<String> {
    files
        .list("scenes")
        .iter()
        .filter_map(|file| Some(file.strip_suffix(".toml")?.to_owned()))
        .collect()
}

impl LabScene {
    /// Loads the scene called `name`; `None` where there is none.
    ///
    /// # Errors
    /// [`LoadError`] where its file cannot be read, is no scene file, or names a mesh that is none or lies outside `scenes/`.
    pub fn load(files: &dyn Files, name: &str) -> Result<Option<Self>, LoadError> {
        let Some(source) = read_source(files, &format!("scenes/{name}.toml"))? else {
            return Ok(None);
        };
        let mut meshes = Vec::new();
        let file = SceneFile::parse(source)?.with_meshes(|name| {
            let mesh = mesh_file::read(files, "scenes", name)?;
            let bytes = mesh.bytes.clone();
            meshes.push(mesh);
            Ok(bytes)
        })?;
        Ok(Some(Self {
            name: name.to_owned(),
            scene: file.build(&[])?,
            file,
            meshes,
            dimensions: Vec::new(),
        }))
    }

    /// This scene with other dimensions.
    ///
    /// # Errors
    /// A dimension its file does not have, or a scene that cannot be with it.
    pub fn with_dimensions(self, dimensions: Vec<(String, Dimension)>) -> Result<Self, SceneError> {
        let file = self.file.with_dimensions(&dimensions)?;
        Ok(Self {
            scene: file.build(&[])?,
            file,
            dimensions,
            ..self
        })
    }

    /// This scene with another gravity, wind or ground than its file states.
    pub fn in_environment(&self, environment: Environment) -> Self {
        let mut changed = self.clone();
        changed.scene.environment = environment;
        changed
    }

    /// Whether it is the scene of this name with these dimensions.
    pub fn is(&self, name: &str, dimensions: &[(String, Dimension)]) -> bool {
        self.name == name && self.dimensions == dimensions
    }

    /// A body with the name of a link of `robot`: a report could not distinguish the two.
    pub fn namesake(&self, robot: &Robot) -> Option<&str> {
        let names = self.scene.bodies.iter().map(|body| body.name.as_str());
        let mut names = names.filter(|name| robot.frame(name).is_some());
        names.next()
    }

    /// Identifies this scene: the digest of its file and meshes.
    pub fn digest(&self) -> blake3::Hash {
        mesh_file::digest(self.file.source().text(), &self.meshes)
    }
}
