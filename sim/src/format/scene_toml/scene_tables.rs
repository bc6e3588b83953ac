//! The TOML types of a scene file, as typed by a person; shapes, masses, surfaces and origins are those of a robot file.

use crate::text::Spanned;
use serde::Deserialize;

use super::scene_problem::SceneProblem;
use crate::part::document::{Document, Tables};
use crate::part::part_tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use crate::text::Dimensions;

/// A scene file: its text and its tables. [`SceneFile::build`] makes the scene.
pub type SceneFile = Document<SceneTables>;

impl SceneFile {
    /// Where in the text the name of body `index` stands; none where there is no such body.
    pub fn place_of_body(&self, index: usize) -> Option<std::ops::Range<usize>> {
        self.tables.bodies.get(index).map(|body| body.name.span())
    }
}

impl Tables for SceneTables {
    const KIND: &'static str = "scene";
    type Problem = SceneProblem;

    fn format(&self) -> &Spanned<i64> {
        &self.format
    }

    fn dimensions(&mut self) -> &mut Dimensions {
        &mut self.dimensions
    }

    fn shapes(&self) -> Box<dyn Iterator<Item = &Spanned<ShapeTable>> + '_> {
        Box::new(self.bodies.iter().flat_map(|body| &body.shapes))
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneTables {
    pub(crate) format: Spanned<i64>,
    pub(crate) name: Spanned<String>,
    #[serde(default)]
    pub(crate) dimensions: Dimensions,
    #[serde(default)]
    pub(crate) environment: EnvironmentTable,
    #[serde(default)]
    pub(crate) bodies: Vec<BodyTable>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EnvironmentTable {
    pub(crate) gravity_m_s2: Option<[NumberAt; 3]>,
    pub(crate) ground: Option<ContactTable>,
    pub(crate) wind: Option<WindTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindTable {
    pub(crate) velocity_m_s: TripleAt,
    pub(crate) air_density_kg_m3: Option<NumberAt>,
    pub(crate) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GustTable {
    pub(crate) speed_m_s: NumberAt,
    pub(crate) correlation_s: NumberAt,
    pub(crate) seed: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum BodyType {
    Fixed,
    Kinematic,
    Free,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyTable {
    pub(crate) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<BodyType>,
    #[serde(default)]
    pub(crate) shapes: Vec<Spanned<ShapeTable>>,
    pub(crate) inertia: Option<Spanned<InertiaTable>>,
    pub(crate) contact: ContactTable,
    pub(crate) origin: Option<Spanned<OriginTable>>,
    pub(crate) velocity: Option<Spanned<VelocityTable>>,
    pub(crate) motion: Option<Spanned<MotionTable>>,
    pub(crate) drag: Option<Spanned<DragTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct VelocityTable {
    pub(crate) linear_m_s: Option<[NumberAt; 3]>,
    pub(crate) angular_rad_s: Option<[NumberAt; 3]>,
}

/// One velocity for ever, or waypoints.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionTable {
    pub(crate) linear_m_s: Option<[NumberAt; 3]>,
    pub(crate) angular_rad_s: Option<[NumberAt; 3]>,
    pub(crate) waypoints: Option<Vec<Spanned<WaypointTable>>>,
    pub(crate) repeat: Option<Spanned<bool>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaypointTable {
    pub(crate) t_s: NumberAt,
    pub(crate) xyz_m: [NumberAt; 3],
    pub(crate) rpy_deg: Option<[NumberAt; 3]>,
}
