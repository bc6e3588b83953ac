//! The mesh files that the shapes of a robot or a scene name, each read once.

use std::sync::Arc;

use super::part_problem::{PartError, PartProblem};
use super::part_tables::ShapeTable;
use super::shape_count::ShapeCount;
use crate::model::mesh::surface::Mesh;
use crate::text::{Located, Source, Spanned};

/// Meshes by the name the file calls them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Meshes(Vec<(String, Arc<Mesh>)>);

impl Meshes {
    /// Reads what `shapes` name by `read`: the bytes of a file, or why there are none. `kind` is the word for the file.
    pub(crate) fn read<'a>(
        source: &Source,
        kind: &'static str,
        shapes: impl Iterator<Item = &'a Spanned<ShapeTable>>,
        mut read: impl FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, PartError> {
        let mut meshes = Self::default();
        let mut count = ShapeCount::default();
        for table in shapes.filter_map(|shape| shape.get_ref().mesh.as_ref()) {
            let file = table.file.get_ref();
            let mut count = |mesh: &Mesh| {
                let counted = count.mesh(kind, mesh.triangles().len());
                counted.map_err(|problem| Located::new(problem, source, table.file.span()))
            };
            if let Some(mesh) = meshes.get(file) {
                count(mesh)?;
                continue;
            }
            let refuse = |message: String, help: Option<String>| {
                Located::new(
                    PartProblem::Mesh { message, help },
                    source,
                    table.file.span(),
                )
            };
            let bytes = read(file).map_err(|why| {
                let help = format!("the path starts at the folder of the {kind} file");
                refuse(format!("mesh `{file}`: {why}"), Some(help))
            })?;
            let mesh = Mesh::parse(file, &bytes)
                .map_err(|problem| refuse(format!("mesh `{file}`: {problem}"), problem.help()))?;
            count(&mesh)?;
            meshes.0.push((file.clone(), Arc::new(mesh)));
        }
        Ok(meshes)
    }

    pub(crate) fn get(&self, file: &str) -> Option<&Arc<Mesh>> {
        let found = self.0.iter().find(|(name, _)| name == file);
        found.map(|(_, mesh)| mesh)
    }
}
