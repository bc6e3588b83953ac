//! A description in TOML, of a robot or a scene: its text, its tables, and the meshes that they name.

use std::ops::Range;

use serde::de::DeserializeOwned;

use super::mesh_files::Meshes;
use super::part_problem::PartProblem;
use super::part_tables::ShapeTable;
use super::shape_count::too_many_shapes;
use super::values::{Values, changed_dimensions};
use crate::text::{Dimension, Dimensions, Located, Problem, Source, Spanned, format_of};

/// The tables of one kind of description.
pub trait Tables: DeserializeOwned {
    /// What messages call the kind.
    const KIND: &'static str;
    /// What can be wrong with it.
    type Problem: Problem + From<PartProblem>;
    /// The named numbers.
    fn dimensions(&mut self) -> &mut Dimensions;
    /// The shapes, wherever they stand.
    fn shapes(&self) -> Box<dyn Iterator<Item = &Spanned<ShapeTable>> + '_>;
}

/// A description: its text and its tables. `build` makes the robot or the scene.
#[derive(Debug, Clone)]
pub struct Document<T> {
    pub(crate) source: Source,
    pub(crate) tables: T,
    dimensions: Dimensions,
    meshes: Meshes,
}

impl<T: Tables> Document<T> {
    /// Reads the text of a description.
    ///
    /// # Errors
    /// What the TOML reader refuses: syntax, an unknown key, a wrong type, a missing key; a format that is not known; more shapes than
    /// are read.
    pub fn parse(source: Source) -> Result<Self, Located<T::Problem>> {
        format_of(&source).map_err(|(problem, at)| {
            let problem = PartProblem::Format { problem };
            located::<T>(problem, &source, at)
        })?;
        let mut tables: T = toml::from_str(source.text()).map_err(|error| {
            let (problem, at) = PartProblem::of_toml(&error, source.text());
            located::<T>(problem, &source, at)
        })?;
        if let Some((problem, at)) = too_many_shapes(T::KIND, tables.shapes()) {
            return Err(located::<T>(problem, &source, at));
        }
        Ok(Self {
            source,
            dimensions: std::mem::take(tables.dimensions()),
            tables,
            meshes: Meshes::default(),
        })
    }

    /// Reads the meshes that its shapes name, each once, by `read`: the bytes of a file, or why there are none.
    ///
    /// # Errors
    /// A file that cannot be read, or is no mesh.
    pub fn with_meshes(
        mut self,
        read: impl FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, Located<T::Problem>> {
        let meshes = Meshes::read(&self.source, T::KIND, self.tables.shapes(), read);
        self.meshes = meshes.map_err(|error| error.map(T::Problem::from))?;
        Ok(self)
    }

    /// This description with the dimensions `changed` for good: what is built from it has them, until they are changed again.
    ///
    /// # Errors
    /// A dimension that the file does not have, or has in another shape.
    pub fn with_dimensions(
        mut self,
        changed: &[(String, Dimension)],
    ) -> Result<Self, Located<T::Problem>> {
        self.dimensions = self.changed(changed)?;
        Ok(self)
    }

    /// The text it was read from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The dimensions as the file states them, or as they were changed for good.
    pub fn dimensions(&self) -> &Dimensions {
        &self.dimensions
    }

    /// Its dimensions with those `changed` instead (those of a variant or a hidden case).
    pub(crate) fn changed(
        &self,
        changed: &[(String, Dimension)],
    ) -> Result<Dimensions, Located<T::Problem>> {
        let changed = changed_dimensions(&self.source, T::KIND, &self.dimensions, changed);
        changed.map_err(|error| error.map(T::Problem::from))
    }

    /// What reads its values with `dimensions`.
    pub(crate) fn values<'a>(&'a self, dimensions: &'a Dimensions) -> Values<'a> {
        Values {
            source: &self.source,
            kind: T::KIND,
            dimensions,
            meshes: &self.meshes,
        }
    }

    /// Refuses the description for a `problem` at the bytes `at`.
    pub(crate) fn err<R>(
        &self,
        at: Range<usize>,
        problem: impl Into<T::Problem>,
    ) -> Result<R, Located<T::Problem>> {
        Err(located::<T>(problem, &self.source, at))
    }
}

fn located<T: Tables>(
    problem: impl Into<T::Problem>,
    source: &Source,
    at: Range<usize>,
) -> Located<T::Problem> {
    Located::new(problem.into(), source, at)
}
