//! Triangles over vertices: of a mesh, or made from faces.

use std::sync::Arc;

use kinemark_sim::model::mesh::Mesh;

/// Triangles over vertices, counter-clockwise seen from outside.
#[derive(Debug, Clone)]
pub(crate) enum Surface {
    /// A mesh's own.
    Mesh(Arc<Mesh>),
    /// Made from the faces of a solid.
    Made {
        /// \[m\]
        vertices: Vec<[f64; 3]>,
        /// Indices of vertices.
        triangles: Vec<[u32; 3]>,
    },
}

impl Surface {
    /// Corners \[m\].
    pub(crate) fn vertices(&self) -> &[[f64; 3]] {
        match self {
            Self::Mesh(mesh) => mesh.vertices(),
            Self::Made { vertices, .. } => vertices,
        }
    }

    /// Triples of indices of corners.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        match self {
            Self::Mesh(mesh) => mesh.triangles(),
            Self::Made { triangles, .. } => triangles,
        }
    }

    /// Lowest and highest coordinates \[m\].
    pub(crate) fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        let empty = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        self.vertices().iter().fold(empty, |(low, high), vertex| {
            let pick =
                |of: fn(f64, f64) -> f64, a: [f64; 3]| [0, 1, 2].map(|k| of(a[k], vertex[k]));
            (pick(f64::min, low), pick(f64::max, high))
        })
    }
}

impl PartialEq for Surface {
    fn eq(&self, other: &Self) -> bool {
        // the same mesh is not read through
        if let (Self::Mesh(one), Self::Mesh(other)) = (self, other)
            && Arc::ptr_eq(one, other)
        {
            return true;
        }
        self.vertices() == other.vertices() && self.triangles() == other.triangles()
    }
}
