//! A mesh from the bytes of a file, whose name says its format.

use super::{obj, stl};
use crate::model::mesh::{Mesh, MeshProblem};

impl Mesh {
    /// Reads a mesh; the extension of `name` gives its format, `.stl` (binary or text) or `.obj`, in any case.
    ///
    /// Corners with the same coordinates become one vertex; triangles with two equal corners are dropped. Binary STL holds
    /// single precision; text is read in double precision, in both formats. Polygons become fans. Colours, normals, textures, names and groups are passed over: the winding says which side is out.
    ///
    /// # Errors
    ///
    /// [`MeshProblem`] of the unknown extension; of the line or byte that cannot be read; of a coordinate that is not finite; of
    /// a file with no triangle, or with more than two million.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Self, MeshProblem> {
        let extension = name.rsplit_once('.').map(|(_, extension)| extension);
        let read = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("stl") => stl::read,
            Some("obj") => obj::read,
            _ => {
                return Err(MeshProblem::UnknownFormat {
                    name: name.to_owned(),
                });
            }
        };
        if bytes.is_empty() {
            return Err(MeshProblem::Empty);
        }
        read(bytes)
    }
}
