//! The TOML tables that robot and scene files share: numbers, origins, shapes, masses and surfaces, each as typed by a person.

use std::fmt;

use crate::text::Spanned;
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

pub(crate) type NumberAt = Spanned<Number>;
pub(crate) type TripleAt = Spanned<[NumberAt; 3]>;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShapeTable {
    #[serde(rename = "box")]
    pub(crate) cuboid: Option<BoxTable>,
    pub(crate) cylinder: Option<RoundTable>,
    pub(crate) capsule: Option<RoundTable>,
    pub(crate) sphere: Option<SphereTable>,
    pub(crate) mesh: Option<MeshTable>,
    pub(crate) origin: Option<OriginTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxTable {
    pub(crate) size_m: [NumberAt; 3],
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundTable {
    pub(crate) radius_m: NumberAt,
    pub(crate) length_m: NumberAt,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereTable {
    pub(crate) radius_m: NumberAt,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshTable {
    pub(crate) file: Spanned<String>,
    pub(crate) scale: Option<[NumberAt; 3]>,
    pub(crate) convex: Option<Spanned<bool>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaTable {
    pub(crate) mass_kg: Option<NumberAt>,
    pub(crate) density_kg_m3: Option<NumberAt>,
    pub(crate) com_m: Option<[NumberAt; 3]>,
    pub(crate) tensor_kg_m2: Option<Spanned<[NumberAt; 6]>>,
    #[serde(default)]
    pub(crate) accept_unphysical: bool,
    #[serde(default)]
    pub(crate) balance: bool,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactTable {
    pub(crate) friction: NumberAt,
    pub(crate) restitution: Option<NumberAt>,
    pub(crate) rolling_m: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DragTable {
    pub(crate) area_m2: NumberAt,
    pub(crate) coefficient: NumberAt,
}

/// Position, and at most one way to say the rotation: `rpy_deg`, `axis` with `angle_deg`, or `x_axis` with `y_axis`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OriginTable {
    pub(crate) xyz_m: Option<[NumberAt; 3]>,
    pub(crate) rpy_deg: Option<Spanned<[NumberAt; 3]>>,
    pub(crate) axis: Option<TripleAt>,
    pub(crate) angle_deg: Option<NumberAt>,
    pub(crate) x_axis: Option<TripleAt>,
    pub(crate) y_axis: Option<TripleAt>,
}
