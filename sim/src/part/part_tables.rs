//! The TOML tables that robot and scene files share: numbers, origins, shapes, masses and surfaces, each as typed by a person.

use std::borrow::Cow;
use std::fmt;

use crate::text::Spanned;
use crate::text::schema::exactly_one;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

/// A number as typed: a literal, or an expression over the dimensions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Number {
    Literal(f64),
    Expression(String),
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct LiteralOrText;
        impl Visitor<'_> for LiteralOrText {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or an expression over the dimensions")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number::Literal(value as f64))
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Number, E> {
                if value.is_finite() {
                    Ok(Number::Literal(value))
                } else {
                    Err(E::custom(format!("expected a finite number, got {value}")))
                }
            }
            fn visit_str<E: de::Error>(self, value: &str) -> Result<Number, E> {
                Ok(Number::Expression(value.to_owned()))
            }
        }
        deserializer.deserialize_any(LiteralOrText)
    }
}

/// In a schema it is a number, or a text that may be any expression.
impl JsonSchema for Number {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "string"] })
    }
}

pub(crate) type NumberAt = Spanned<Number>;
pub(crate) type TripleAt = Spanned<[NumberAt; 3]>;

/// A shape has one kind. (An attribute with the list itself needs all of `syn`, which the crate by itself does not have.)
fn of_one_kind(schema: &mut Schema) {
    exactly_one(&["box", "cylinder", "capsule", "sphere", "mesh"])(schema);
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = of_one_kind)]
pub struct ShapeTable {
    /// A box about its own origin.
    #[serde(rename = "box")]
    pub(crate) cuboid: Option<BoxTable>,
    /// A cylinder about its own origin; the axis is z.
    pub(crate) cylinder: Option<RoundTable>,
    /// A capsule about its own origin: a cylinder along z with half a ball on each end.
    pub(crate) capsule: Option<RoundTable>,
    /// A ball about its own origin.
    pub(crate) sphere: Option<SphereTable>,
    /// A mesh, in the coordinates of its file.
    pub(crate) mesh: Option<MeshTable>,
    /// Where the shape is in its link or body; identity where it is left out.
    pub(crate) origin: Option<OriginTable>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxTable {
    /// Lengths of the edges along x, y and z \[m\].
    pub(crate) size_m: [NumberAt; 3],
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundTable {
    /// Radius \[m\].
    pub(crate) radius_m: NumberAt,
    /// Length of the cylinder, of a capsule without its ends \[m\].
    pub(crate) length_m: NumberAt,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereTable {
    /// Radius \[m\].
    pub(crate) radius_m: NumberAt,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshTable {
    /// An STL or OBJ file; the path starts at the folder of this file.
    pub(crate) file: Spanned<String>,
    /// Converts the coordinates of the mesh to metres, along x, y and z; 1 where it is left out.
    pub(crate) scale: Option<[NumberAt; 3]>,
    /// Whether contact uses the convex hull of the mesh; false where it is left out.
    pub(crate) convex: Option<Spanned<bool>>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaTable {
    /// Mass \[kg\]: spread over the volumes of the shapes, or that of `tensor_kg_m2`.
    pub(crate) mass_kg: Option<NumberAt>,
    /// Density of the shapes \[kg/m³\], in place of a mass.
    pub(crate) density_kg_m3: Option<NumberAt>,
    /// Centre of mass \[m\], beside `tensor_kg_m2`; the origin where it is left out.
    pub(crate) com_m: Option<[NumberAt; 3]>,
    /// `[ixx, iyy, izz, ixy, ixz, iyz]` about the centre of mass, in the axes of the link or body \[kg m²\].
    pub(crate) tensor_kg_m2: Option<Spanned<[NumberAt; 6]>>,
    /// Whether a tensor that no body can have is taken as it is; false where it is left out.
    #[serde(default)]
    pub(crate) accept_unphysical: bool,
    /// Whether the three principal moments become their mean; false where it is left out.
    #[serde(default)]
    pub(crate) balance: bool,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactTable {
    /// Coefficient of friction, zero or more.
    pub(crate) friction: NumberAt,
    /// Coefficient of restitution, 0 to 1; 0 where it is left out.
    pub(crate) restitution: Option<NumberAt>,
    /// Lever arm of the rolling resistance \[m\].
    pub(crate) rolling_m: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DragTable {
    /// Area that the air meets \[m²\], the same from every side.
    pub(crate) area_m2: NumberAt,
    /// Drag coefficient, zero or more.
    pub(crate) coefficient: NumberAt,
}

/// Position, and at most one way to say the rotation: `rpy_deg`, `axis` with `angle_deg`, or `x_axis` with `y_axis`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OriginTable {
    /// Position \[m\]; zero where it is left out.
    pub(crate) xyz_m: Option<[NumberAt; 3]>,
    /// Rotation: roll about x, then pitch about y, then yaw about z, about fixed axes \[deg\].
    pub(crate) rpy_deg: Option<Spanned<[NumberAt; 3]>>,
    /// Axis of the rotation by `angle_deg`, of any length but zero.
    pub(crate) axis: Option<TripleAt>,
    /// Angle about `axis` \[deg\].
    pub(crate) angle_deg: Option<NumberAt>,
    /// Direction of the x axis, with `y_axis` in place of another rotation.
    pub(crate) x_axis: Option<TripleAt>,
    /// Direction of the y axis, perpendicular to `x_axis`.
    pub(crate) y_axis: Option<TripleAt>,
}
