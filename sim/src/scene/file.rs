//! The TOML types of a scene file, as typed by a person; shapes, masses, surfaces and origins are those of a robot file.

use serde::Deserialize;
use toml::Spanned;

use super::problem::{SceneError, SceneProblem};
use crate::robot::file::Dimensions;
use crate::robot::part::tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use crate::robot::part::{Meshes, PartProblem};
use crate::source::{Source, TomlRefusal};

/// What messages call this kind of file.
pub(super) const KIND: &str = "scene";

/// A scene file: its text and its tables. [`SceneFile::build`] makes the scene.
#[derive(Debug, Clone)]
pub struct SceneFile {
    pub(super) source: Source,
    pub(super) tables: Tables,
    pub(super) meshes: Meshes,
}

impl SceneFile {
    /// Reads a scene file's text.
    ///
    /// # Errors
    /// What the TOML reader refuses: syntax, an unknown key, a wrong type, a missing key.
    pub fn parse(source: Source) -> Result<Self, SceneError> {
        match toml::from_str::<Tables>(source.text()) {
            Ok(tables) => Ok(Self {
                source,
                tables,
                meshes: Meshes::default(),
            }),
            Err(error) => {
                let TomlRefusal { message, help, at } =
                    TomlRefusal::from_error(&error, source.text());
                let problem = SceneProblem::Part(PartProblem::Toml { message, help });
                Err(SceneError::new(problem, &source, at))
            }
        }
    }

    /// Reads the meshes that its shapes name, each once, by `read`: the bytes of a file, or why there are none.
    ///
    /// # Errors
    /// A file that cannot be read, or is no mesh.
    pub fn with_meshes(
        mut self,
        read: impl FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, SceneError> {
        let shapes = self.tables.bodies.iter().flat_map(|body| &body.shapes);
        self.meshes = Meshes::read(&self.source, KIND, shapes, read)?;
        Ok(self)
    }

    /// The text it was read from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Where in the text the name of body `index` stands; none where there is no such body.
    pub fn place_of_body(&self, index: usize) -> Option<std::ops::Range<usize>> {
        self.tables.bodies.get(index).map(|body| body.name.span())
    }

    /// The dimensions as the file states them.
    pub fn dimensions(&self) -> &Dimensions {
        &self.tables.dimensions
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tables {
    pub(super) format: Spanned<i64>,
    pub(super) name: Spanned<String>,
    #[serde(default)]
    pub(super) dimensions: Dimensions,
    #[serde(default)]
    pub(super) environment: EnvironmentTable,
    #[serde(default)]
    pub(super) bodies: Vec<BodyTable>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnvironmentTable {
    pub(super) gravity_m_s2: Option<[NumberAt; 3]>,
    pub(super) ground: Option<ContactTable>,
    pub(super) wind: Option<WindTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WindTable {
    pub(super) velocity_m_s: TripleAt,
    pub(super) air_density_kg_m3: Option<NumberAt>,
    pub(super) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GustTable {
    pub(super) speed_m_s: NumberAt,
    pub(super) correlation_s: NumberAt,
    pub(super) seed: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum BodyType {
    Fixed,
    Kinematic,
    Free,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    pub(super) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(super) kind: Spanned<BodyType>,
    #[serde(default)]
    pub(super) shapes: Vec<Spanned<ShapeTable>>,
    pub(super) inertia: Option<Spanned<InertiaTable>>,
    pub(super) contact: ContactTable,
    pub(super) origin: Option<Spanned<OriginTable>>,
    pub(super) velocity: Option<Spanned<VelocityTable>>,
    pub(super) motion: Option<Spanned<MotionTable>>,
    pub(super) drag: Option<Spanned<DragTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VelocityTable {
    pub(super) linear_m_s: Option<[NumberAt; 3]>,
    pub(super) angular_rad_s: Option<[NumberAt; 3]>,
}

/// One velocity for ever, or waypoints.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionTable {
    pub(super) linear_m_s: Option<[NumberAt; 3]>,
    pub(super) angular_rad_s: Option<[NumberAt; 3]>,
    pub(super) waypoints: Option<Vec<Spanned<WaypointTable>>>,
    pub(super) repeat: Option<Spanned<bool>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WaypointTable {
    pub(super) t_s: NumberAt,
    pub(super) xyz_m: [NumberAt; 3],
    pub(super) rpy_deg: Option<[NumberAt; 3]>,
}
