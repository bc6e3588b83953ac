//! A mesh.

use std::sync::Arc;

use kinemark_sim::model::inertia::MeshSolid;
use nalgebra::Point3;

use super::drawn::{Drawn, ReplayForm};
use super::faces::{Detail, Faces};
use super::surface::Surface;

/// Vertices of a mesh that an outline looks at.
const MOST_VERTICES: usize = 20_000;

impl Drawn for &MeshSolid {
    fn faces(&self, detail: Detail) -> Faces {
        Faces::thinned(
            self.mesh.vertices(),
            self.mesh.triangles(),
            detail.triangles,
        )
    }

    fn outline_m(&self) -> Vec<Point3<f64>> {
        let vertices = self.mesh.vertices().iter().take(MOST_VERTICES);
        vertices.map(|p| Point3::from(*p)).collect()
    }

    fn own_triangles(&self) -> usize {
        self.mesh.triangles().len()
    }

    fn replay_form(&self) -> ReplayForm {
        ReplayForm::Surface(Surface::Mesh(Arc::clone(&self.mesh)))
    }

    #[cfg(feature = "log")]
    fn log_forms(&self) -> Vec<(Option<kinemark_sim::spatial::Pose>, super::LogForm)> {
        let surface = Surface::Mesh(Arc::clone(&self.mesh));
        vec![(None, super::LogForm::Surface(surface))]
    }
}
