//! How much a robot or a scene may be made of: so many shapes, and so many triangles in all uses of its meshes. Far more than any lab
//! needs, and few enough that a short file costs seconds, not hours.

use std::ops::Range;

use crate::text::Spanned;

use super::part_problem::PartProblem;
use super::part_tables::ShapeTable;

/// Shapes of all links of a robot, or of all bodies of a scene.
pub(crate) const MOST_SHAPES: usize = 2000;
/// Triangles of all meshes, each counted as often as it is used: every shape of a mesh has a hull or a surface of its own, and a hull
/// of so many takes half a minute.
pub(crate) const MOST_TRIANGLES: usize = 1_000_000;

/// What is wrong with so many `shapes` in this `kind` of file, and the place of the first one too many.
pub(crate) fn too_many_shapes<'a>(
    kind: &'static str,
    shapes: impl Iterator<Item = &'a Spanned<ShapeTable>>,
) -> Option<(PartProblem, Range<usize>)> {
    let mut beyond = shapes.skip(MOST_SHAPES);
    let at = beyond.next()?.span();
    let found = MOST_SHAPES + 1 + beyond.count();
    Some((too_many(kind, "shapes", found, MOST_SHAPES), at))
}

/// The shapes and triangles of a robot, counted one by one.
#[derive(Debug, Default)]
pub(crate) struct ShapeCount {
    shapes: usize,
    triangles: usize,
}

impl ShapeCount {
    /// Counts one more shape.
    ///
    /// # Errors
    /// It is one too many for this `kind` of file.
    pub(crate) fn shape(&mut self, kind: &'static str) -> Result<(), PartProblem> {
        self.shapes += 1;
        match self.shapes {
            found if found > MOST_SHAPES => Err(too_many(kind, "shapes", found, MOST_SHAPES)),
            _ => Ok(()),
        }
    }

    /// Counts one more use of a mesh with so many triangles.
    ///
    /// # Errors
    /// These are too many for this `kind` of file.
    pub(crate) fn mesh(&mut self, kind: &'static str, triangles: usize) -> Result<(), PartProblem> {
        self.triangles = self.triangles.saturating_add(triangles);
        match self.triangles {
            found if found > MOST_TRIANGLES => {
                Err(too_many(kind, "triangles", found, MOST_TRIANGLES))
            }
            _ => Ok(()),
        }
    }
}

fn too_many(kind: &'static str, parts: &'static str, found: usize, most: usize) -> PartProblem {
    PartProblem::TooManyShapes {
        kind,
        parts,
        found,
        most,
    }
}
