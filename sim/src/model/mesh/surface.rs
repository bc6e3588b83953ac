//! The mesh itself: welded vertices, the triangles over them, its scale and its bounds.

use std::collections::HashMap;

use super::mesh_problem::MeshProblem;
use super::{closed, integrals};
use crate::model::inertia::Inertia;

/// Most triangles a mesh may have, before or after welding; a file of 100 MB.
pub(crate) const MAX_TRIANGLES: usize = 2_000_000;

/// A surface of triangles. Its vertices are finite when read, distinct, all used, and in the order of their first use.
///
/// Corners are counter-clockwise seen from outside. Coordinates are in the axes of the file, in metres once scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The distinct vertices, shape `(n, 3)`.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Three vertices for each triangle, shape `(m, 3)`, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The same mesh with each axis multiplied by its factor; the triangles of a mirror image (a negative product) are reversed, so that
    /// they still face outwards.
    ///
    /// A factor of zero makes a flat mesh, which has vertices that coincide and no inertia.
    pub fn scaled(&self, scale: [f64; 3]) -> Self {
        let vertices = self
            .vertices
            .iter()
            .map(|p| [p[0] * scale[0], p[1] * scale[1], p[2] * scale[2]])
            .collect();
        // the sign of each factor, because their product may underflow
        let mirrored = scale.iter().filter(|factor| **factor < 0.0).count() % 2 == 1;
        let triangles = self.triangles.iter().map(|&[a, b, c]| match mirrored {
            true => [a, c, b],
            false => [a, b, c],
        });
        Self {
            vertices,
            triangles: triangles.collect(),
        }
    }

    /// The least and the greatest coordinate along each axis.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        self.vertices.iter().fold(EMPTY, widened)
    }

    /// Checks that the triangles bound a solid: each edge has two triangles that agree on what is outside.
    ///
    /// Several shells are fine, and so are shells that only touch in points; whether a shell is inside out is a matter of
    /// its volume, which [`Mesh::volume_m3`] and the inertias check.
    ///
    /// # Errors
    ///
    /// [`MeshProblem::Leaky`], [`MeshProblem::Crowded`], [`MeshProblem::Flipped`] or [`MeshProblem::OneSided`], the former
    /// before the latter.
    pub fn check_closed(&self) -> Result<(), MeshProblem> {
        closed::check(self)
    }

    /// The volume inside \[m³\].
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::check_closed`]; [`MeshProblem::InsideOut`], [`MeshProblem::ShellInsideOut`]; [`MeshProblem::NoVolume`]
    /// where the thickness is that of rounding; [`MeshProblem::TooLarge`] where it overflows.
    pub fn volume_m3(&self) -> Result<f64, MeshProblem> {
        Ok(integrals::of_unit_density(self)?.mass_kg)
    }

    /// Mass properties of the solid at a uniform density \[kg/m³\], in the axes of the mesh.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::volume_m3`]; [`MeshProblem::Amount`] for a density that is not positive and finite.
    pub fn inertia(&self, density_kg_m3: f64) -> Result<Inertia, MeshProblem> {
        positive("density", "kg/m³", density_kg_m3)?;
        integrals::multiplied(&integrals::of_unit_density(self)?, density_kg_m3)
    }

    /// Mass properties of the solid with its mass \[kg\] spread evenly, in the axes of the mesh.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::volume_m3`]; [`MeshProblem::Amount`] for a mass that is not positive and finite.
    pub fn inertia_of_mass(&self, mass_kg: f64) -> Result<Inertia, MeshProblem> {
        positive("mass", "kg", mass_kg)?;
        let unit = integrals::of_unit_density(self)?;
        let mut inertia = integrals::multiplied(&unit, mass_kg / unit.mass_kg)?;
        inertia.mass_kg = mass_kg; // as given, not to rounding
        Ok(inertia)
    }

    /// The corners of triangle `t`, which the mesh holds.
    pub(crate) fn corners(&self, t: usize) -> [[f64; 3]; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }
}

fn positive(what: &'static str, unit: &'static str, found: f64) -> Result<(), MeshProblem> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(MeshProblem::Amount { what, unit, found })
}

/// The least and the greatest coordinate along each axis.
pub(crate) type Bounds = ([f64; 3], [f64; 3]);

/// The bounds of an empty set of points.
pub(crate) const EMPTY: Bounds = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);

/// The bounds extended to contain the point.
pub(crate) fn widened((mut low, mut high): Bounds, p: &[f64; 3]) -> Bounds {
    for axis in 0..3 {
        low[axis] = low[axis].min(p[axis]);
        high[axis] = high[axis].max(p[axis]);
    }
    (low, high)
}

/// Makes a mesh of corners as a file gives them, one triangle after another.
#[derive(Default)]
pub(crate) struct Welder {
    // only looked up, never iterated: its order has no effect
    index_of: HashMap<[u64; 3], u32>,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    dropped: usize,
}

impl Welder {
    /// Adds a triangle with finite corners; drops it if two of them are equal.
    pub(crate) fn add(&mut self, corners: [[f64; 3]; 3]) -> Result<(), MeshProblem> {
        if self.triangles.len() + self.dropped >= MAX_TRIANGLES {
            return Err(MeshProblem::TooManyTriangles);
        }
        let corners = corners.map(|p| p.map(|x| x + 0.0)); // -0 + 0 is 0
        let [a, b, c] = corners.map(|p| p.map(f64::to_bits));
        if a == b || b == c || c == a {
            self.dropped += 1;
            return Ok(());
        }
        let triangle = corners.map(|p| self.vertex(p));
        self.triangles.push(triangle);
        Ok(())
    }

    fn vertex(&mut self, p: [f64; 3]) -> u32 {
        // at most three vertices a triangle, so the index fits
        let next = self.vertices.len() as u32;
        let index = *self.index_of.entry(p.map(f64::to_bits)).or_insert(next);
        if index == next {
            self.vertices.push(p);
        }
        index
    }

    /// The mesh, if a triangle is left.
    pub(crate) fn finish(self) -> Result<Mesh, MeshProblem> {
        if self.triangles.is_empty() {
            return Err(MeshProblem::NoTriangles {
                dropped: self.dropped,
            });
        }
        Ok(Mesh {
            vertices: self.vertices,
            triangles: self.triangles,
        })
    }
}
