//! A mesh of a lab's robot or scene: it lies beside the file that names it, so that a copy of the lab has it too.

use super::files::Files;

/// A mesh as its file has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshFile {
    /// What the file that names it calls it, such as `package://hand_description/meshes/hand.stl`.
    pub name: String,
    /// Its path inside the labs, such as `robots/meshes/hand.stl`.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Reads the mesh `name` below `folder`.
pub(crate) fn read(files: &dyn Files, folder: &str, name: &str) -> Result<MeshFile, String> {
    let inside = |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':']);
    if !name.split('/').all(inside) {
        return Err(format!(
            "a mesh of a lab lies inside its {folder} folder, so its path is neither absolute nor has it `..`"
        ));
    }
    let path = format!("{folder}/{name}");
    match files.bytes(&path)? {
        Some(bytes) => Ok(MeshFile {
            name: name.to_owned(),
            path,
            bytes,
        }),
        None => Err(format!("there is no file `{path}` in {}", files.name())),
    }
}

/// The path below `root` to which `path` leads from its folder `folder`; `None` where it leads out of `root`.
pub(crate) fn inside(root: &str, folder: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part if part.contains(['\\', ':']) => return None,
            part => parts.push(part),
        }
    }
    Some(format!("{root}/{}", parts.join("/")))
}

/// Reads the mesh called `name` from the first of `paths` where a file is.
pub(crate) fn read_first(
    files: &dyn Files,
    name: &str,
    paths: &[String],
) -> Result<MeshFile, String> {
    for path in paths {
        if let Some(bytes) = files.bytes(path)? {
            return Ok(MeshFile {
                name: name.to_owned(),
                path: path.clone(),
                bytes,
            });
        }
    }
    let tried: Vec<String> = paths.iter().map(|path| format!("`{path}`")).collect();
    Err(format!(
        "there is no file {} in {}",
        tried.join(" or "),
        files.name()
    ))
}

/// The digest of a file and its meshes: another one for any other file.
pub(crate) fn digest(text: &str, meshes: &[MeshFile]) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(text.as_bytes());
    for mesh in meshes {
        // a length before each part, so that no two have the same bytes in all
        for part in [mesh.path.as_bytes(), &mesh.bytes] {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part);
        }
    }
    hasher.finalize()
}
