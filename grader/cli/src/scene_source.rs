//! The scene that a person names on the command line: a scene file, or a scene of the labs.

use std::path::Path;

use kinemark_grader::task::scene::LabScene;
use kinemark_grader::task::scene::scene_names;
use kinemark_sim::format::{SceneError, SceneFile};
use kinemark_sim::model::scene::Scene;
use kinemark_sim::text::{Source, suggest};

use crate::disk::{self, MOST_MESH_BYTES, bytes_of};
use crate::failure::{BROKEN, Failure};
use crate::labs_folder::{self, LabsFolderArgs};

/// Above this a file is no scene.
const MOST_BYTES: u64 = 16 << 20;

/// A scene with the file it was read from.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) file: SceneFile,
    pub(crate) scene: Scene,
}

/// Whether `named` can only be a file: the labs' scenes have plain names.
pub(crate) fn is_file(named: &Path) -> bool {
    named.exists() || named.extension().is_some() || named.components().count() > 1
}

/// Reads the scene called `named`, a file or a scene of the labs.
///
/// # Errors
/// Exit code 2 for a scene that is not there, 3 for a file that is no scene.
pub(crate) fn load(named: &Path, labs: &LabsFolderArgs) -> Result<Loaded, Failure> {
    if is_file(named) {
        return from_file(disk::read(named, "a scene file", MOST_BYTES)?, named);
    }
    let name = named.to_string_lossy();
    let (files, _) = labs_folder::open(labs)?;
    if let Some(LabScene { file, scene, .. }) = LabScene::load(files.as_ref(), &name)? {
        return Ok(Loaded { file, scene });
    }
    let known = scene_names(files.as_ref());
    Err(Failure::usage(
        format!("there is no scene file or scene `{name}`"),
        &suggest(&name, "scenes", known.iter().map(String::as_str)),
    ))
}

/// The scene of a file's text; its meshes lie in the file's folder.
///
/// # Errors
/// Exit code 3 for a text that is no scene.
pub(crate) fn from_file(source: Source, path: &Path) -> Result<Loaded, Failure> {
    let broken = |error: SceneError| Failure::diagnostic(BROKEN, error);
    let folder = path.parent().unwrap_or(Path::new(""));
    let file = SceneFile::parse(source)
        .and_then(|file| file.with_meshes(|name| bytes_of(&folder.join(name), MOST_MESH_BYTES)))
        .map_err(broken)?;
    let scene = file.build(&[]).map_err(broken)?;
    Ok(Loaded { file, scene })
}
