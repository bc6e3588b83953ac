//! What a body looks like: its solids, and each mesh once.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kinemark_sim::model::robot::Shape;
use kinemark_sim::spatial::{Pose, pose};
use kinemark_sim::trace::pose_numbers;
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use crate::solid::{ReplayForm, Surface, drawn};

/// Triangles of all meshes of a replay; a mesh beyond them is shown as the box around it. So many take some 4 MB.
const MOST_TRIANGLES: usize = 200_000;

/// A shape on its node.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ShapeRecord {
    solid: SolidRecord,
    pose: [f64; 7],
}

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
enum SolidRecord {
    /// Edge lengths \[m\].
    Box([f64; 3]),
    /// Along z \[m\].
    Cylinder { radius: f64, length: f64 },
    /// Along z, the length without its half balls \[m\].
    Capsule { radius: f64, length: f64 },
    /// \[m\]
    Sphere { radius: f64 },
    /// Index of a mesh.
    Mesh(usize),
}

/// A mesh: single precision, little-endian, in base64.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct MeshRecord {
    vertices: String,
    triangles: String,
}

/// A pose as it is written: what is below a nanometre is noise.
pub(super) fn pose_record(pose: &Pose) -> [f64; 7] {
    rounded(pose_numbers(pose))
}

pub(super) fn rounded(pose: [f64; 7]) -> [f64; 7] {
    // adding zero turns -0 into 0
    pose.map(|x| (x * 1e9).round() / 1e9 + 0.0)
}

/// The meshes of a replay.
#[derive(Debug, Default)]
pub(super) struct Meshes {
    known: Vec<Surface>,
    triangles: usize,
}

impl Meshes {
    /// How shapes are written; their meshes are noted.
    pub(super) fn shapes(&mut self, shapes: &[Shape]) -> Vec<ShapeRecord> {
        shapes.iter().map(|shape| self.shape(shape)).collect()
    }

    fn shape(&mut self, shape: &Shape) -> ShapeRecord {
        let at = &shape.link_from_shape;
        let solid = match drawn(&shape.solid).replay_form() {
            ReplayForm::Box(size_m) => SolidRecord::Box(size_m),
            ReplayForm::Cylinder { radius_m, length_m } => SolidRecord::Cylinder {
                radius: radius_m,
                length: length_m,
            },
            ReplayForm::Capsule { radius_m, length_m } => SolidRecord::Capsule {
                radius: radius_m,
                length: length_m,
            },
            ReplayForm::Sphere { radius_m } => SolidRecord::Sphere { radius: radius_m },
            ReplayForm::Surface(surface) => match self.index(&surface) {
                Some(index) => SolidRecord::Mesh(index),
                None => return around(&surface, at),
            },
        };
        ShapeRecord {
            solid,
            pose: pose_record(at),
        }
    }

    /// The index of a mesh; none where there is no room for it.
    fn index(&mut self, surface: &Surface) -> Option<usize> {
        if let Some(index) = self.known.iter().position(|known| known == surface) {
            return Some(index);
        }
        let triangles = self.triangles + surface.triangles().len();
        if triangles > MOST_TRIANGLES {
            return None;
        }
        self.triangles = triangles;
        self.known.push(surface.clone());
        Some(self.known.len() - 1)
    }

    /// The meshes, written.
    pub(super) fn records(&self) -> Vec<MeshRecord> {
        let record = |mesh: &Surface| {
            let vertices = mesh.vertices().as_flattened().iter();
            let vertices: Vec<u8> = vertices.flat_map(|x| (*x as f32).to_le_bytes()).collect();
            let triangles = mesh.triangles().as_flattened().iter();
            let triangles: Vec<u8> = triangles.flat_map(|i| i.to_le_bytes()).collect();
            MeshRecord {
                vertices: STANDARD.encode(&vertices),
                triangles: STANDARD.encode(&triangles),
            }
        };
        self.known.iter().map(record).collect()
    }
}

/// The box around a mesh.
fn around(mesh: &Surface, link_from_mesh: &Pose) -> ShapeRecord {
    let (low, high) = mesh.bounds();
    let (low, high) = (Vector3::from(low), Vector3::from(high));
    let centre = link_from_mesh * pose(Matrix3::identity(), 0.5 * (low + high));
    ShapeRecord {
        solid: SolidRecord::Box((high - low).into()),
        pose: pose_record(&centre),
    }
}
