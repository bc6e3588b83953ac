//! The TOML types of a scene file, as typed by a person; shapes, masses, surfaces and origins are those of a robot file.

use schemars::{JsonSchema, Schema};
use serde::Deserialize;

use super::scene_problem::SceneProblem;
use crate::part::document::{Document, Tables};
use crate::part::part_tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use crate::text::schema::schema_of;
use crate::text::{Dimensions, FileFormat, Spanned};

/// A scene file: its text and its tables. [`SceneFile::build`] makes the scene.
pub type SceneFile = Document<SceneTables>;

impl SceneFile {
    /// The JSON schema of a scene file.
    pub fn schema() -> Schema {
        schema_of::<SceneTables>("A scene of Kinemark")
    }

    /// Where in the text the name of body `index` stands; none where there is no such body.
    pub fn place_of_body(&self, index: usize) -> Option<std::ops::Range<usize>> {
        self.tables.bodies.get(index).map(|body| body.name.span())
    }
}

impl Tables for SceneTables {
    const KIND: &'static str = "scene";
    type Problem = SceneProblem;

    fn dimensions(&mut self) -> &mut Dimensions {
        &mut self.dimensions
    }

    fn shapes(&self) -> Box<dyn Iterator<Item = &Spanned<ShapeTable>> + '_> {
        Box::new(self.bodies.iter().flat_map(|body| &body.shapes))
    }
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneTables {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    pub(crate) _format: FileFormat,
    /// The scene's name.
    pub(crate) name: Spanned<String>,
    /// Named dimensions, in SI units: numbers and lists of numbers, which any other number may be an expression over.
    #[serde(default)]
    pub(crate) dimensions: Dimensions,
    /// Gravity, ground and wind.
    #[serde(default)]
    pub(crate) environment: EnvironmentTable,
    /// What is around the robot.
    #[serde(default)]
    pub(crate) bodies: Vec<BodyTable>,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct EnvironmentTable {
    /// Acceleration of free fall \[m/s²\]; `[0, 0, -9.81]` where it is left out.
    pub(crate) gravity_m_s2: Option<[NumberAt; 3]>,
    /// Surface of the plane z = 0; without it bodies fall for ever.
    pub(crate) ground: Option<ContactTable>,
    /// The air; without it nothing resists motion.
    pub(crate) wind: Option<WindTable>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindTable {
    /// Mean velocity of the air \[m/s\]; zero is still air, which slows bodies down.
    pub(crate) velocity_m_s: TripleAt,
    /// Density of the air \[kg/m³\]; 1.225 where it is left out.
    pub(crate) air_density_kg_m3: Option<NumberAt>,
    /// What comes and goes along the mean velocity.
    pub(crate) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GustTable {
    /// Standard deviation of the speed, zero or more \[m/s\].
    pub(crate) speed_m_s: NumberAt,
    /// Time in which the correlation falls to 1/e, positive \[s\].
    pub(crate) correlation_s: NumberAt,
    /// The same seed gives the same gusts on every machine.
    pub(crate) seed: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum BodyType {
    /// Fixed to the world.
    Fixed,
    /// Moves as its `motion` says, whatever it touches.
    Kinematic,
    /// Forces and contacts move it.
    Free,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyTable {
    /// Its name.
    pub(crate) name: Spanned<String>,
    /// What moves it.
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<BodyType>,
    /// Its shapes, at least one.
    #[serde(default)]
    pub(crate) shapes: Vec<Spanned<ShapeTable>>,
    /// Its mass; needed for `free`, without effect for the others.
    pub(crate) inertia: Option<Spanned<InertiaTable>>,
    /// Its surface.
    pub(crate) contact: ContactTable,
    /// Where it starts in the world; identity where it is left out.
    pub(crate) origin: Option<Spanned<OriginTable>>,
    /// Its velocity at the start; only for `free`.
    pub(crate) velocity: Option<Spanned<VelocityTable>>,
    /// How a `kinematic` body moves; needed there and refused elsewhere.
    pub(crate) motion: Option<Spanned<MotionTable>>,
    /// How the air pushes it; only for `free`.
    pub(crate) drag: Option<Spanned<DragTable>>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VelocityTable {
    /// Velocity of the body's origin, in the axes of the world \[m/s\]; zero where it is left out.
    pub(crate) linear_m_s: Option<[NumberAt; 3]>,
    /// Angular velocity, in the axes of the world \[rad/s\]; zero where it is left out.
    pub(crate) angular_rad_s: Option<[NumberAt; 3]>,
}

/// One velocity for ever, or waypoints.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionTable {
    /// Velocity of the body's origin, in the axes of the world \[m/s\]; zero where it is left out.
    pub(crate) linear_m_s: Option<[NumberAt; 3]>,
    /// Angular velocity, in the axes of the world \[rad/s\]; zero where it is left out.
    pub(crate) angular_rad_s: Option<[NumberAt; 3]>,
    /// Poses that it passes in order, at least two, in place of a velocity and an `origin`.
    pub(crate) waypoints: Option<Vec<Spanned<WaypointTable>>>,
    /// Whether it continues from the last waypoint to the first, which must have the same pose; else it stays there.
    pub(crate) repeat: Option<Spanned<bool>>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaypointTable {
    /// When it is there \[s\]; later than the waypoint before.
    pub(crate) t_s: NumberAt,
    /// Position in the world \[m\].
    pub(crate) xyz_m: [NumberAt; 3],
    /// Rotation: roll, pitch and yaw about the fixed axes of the world \[deg\]; zero where it is left out.
    pub(crate) rpy_deg: Option<[NumberAt; 3]>,
}
