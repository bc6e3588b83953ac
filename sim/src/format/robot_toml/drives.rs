//! What a robot file says of the drive of a joint: dry friction, which may have two directions, and the motor with its gear.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

use crate::text::schema::either;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, MapAccess, Visitor};

use super::robot_reader::Resolver;
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::model::drive::{Drive, TorqueSpeedLine};
use crate::model::joint_friction::JointFriction;
use crate::part::part_tables::{Number, NumberAt};
use crate::part::values::Allowed;
use crate::text::Spanned;

/// `dry_friction` as typed: one number, or one for each direction.
#[derive(Debug, Clone)]
pub(crate) enum FrictionEntry {
    Both(Number),
    Each(FrictionTable),
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FrictionTable {
    /// Effort against motion in the positive direction \[N m or N\].
    positive: NumberAt,
    /// Effort against motion in the negative direction \[N m or N\].
    negative: NumberAt,
}

impl<'de> Deserialize<'de> for FrictionEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrTable;
        impl<'de> Visitor<'de> for NumberOrTable {
            type Value = FrictionEntry;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, an expression, or { positive = ..., negative = ... }")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<FrictionEntry, E> {
                Ok(FrictionEntry::Both(Number::Literal(value as f64)))
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<FrictionEntry, E> {
                if value.is_finite() {
                    Ok(FrictionEntry::Both(Number::Literal(value)))
                } else {
                    Err(E::custom(format!("expected a finite number, got {value}")))
                }
            }
            fn visit_str<E: de::Error>(self, value: &str) -> Result<FrictionEntry, E> {
                Ok(FrictionEntry::Both(Number::Expression(value.to_owned())))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<FrictionEntry, A::Error> {
                FrictionTable::deserialize(MapAccessDeserializer::new(map)).map(FrictionEntry::Each)
            }
        }
        deserializer.deserialize_any(NumberOrTable)
    }
}

/// In a schema it is a number, a text that may be any expression, or the table.
impl JsonSchema for FrictionEntry {
    fn schema_name() -> Cow<'static, str> {
        "FrictionEntry".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let number = Number::json_schema(generator);
        either(number, FrictionTable::json_schema(generator))
    }
}

/// `drive` as typed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DriveTable {
    /// Effort at the joint that holds it still against the motor at full voltage \[N m or N\]; none where it is left out.
    stall: Option<NumberAt>,
    /// Rate of the joint at full voltage without load \[rad/s or m/s\]; given with `stall`, or neither.
    free_speed: Option<NumberAt>,
    /// Rotation of the rotor per unit of the joint \[rad/rad or rad/m\]; 1 where it is left out.
    ratio: Option<NumberAt>,
    /// Inertia of the rotor about its axis \[kg m²\]; needs `ratio`, and excludes `armature`.
    rotor_inertia: Option<NumberAt>,
    /// Fraction of the power that gets through the gear, more than 0 and at most 1; 1 where it is left out.
    efficiency: Option<NumberAt>,
}

/// What else the file says of the joint that has the drive.
pub(super) struct Driven<'a> {
    pub(super) joint: &'a str,
    pub(super) armature: f64,
    /// Why the joint can have no drive of its own, if it cannot.
    pub(super) undriven: Option<&'static str>,
}

impl Resolver<'_> {
    pub(super) fn friction(
        &self,
        entry: Option<&Spanned<FrictionEntry>>,
    ) -> Result<JointFriction, RobotError> {
        let Some(entry) = entry else {
            return Ok(JointFriction::default());
        };
        let read = |number: &NumberAt, what| self.values.number(number, what, Allowed::NotNegative);
        Ok(match entry.get_ref() {
            FrictionEntry::Both(number) => {
                let number = Spanned::new(entry.span(), number.clone());
                JointFriction::both(read(&number, "dry_friction")?)
            }
            FrictionEntry::Each(table) => JointFriction {
                positive: read(&table.positive, "positive")?,
                negative: read(&table.negative, "negative")?,
            },
        })
    }

    pub(super) fn drive(
        &self,
        driven: &Driven<'_>,
        table: Option<&Spanned<DriveTable>>,
    ) -> Result<Option<Drive>, RobotError> {
        let Some(at) = table else { return Ok(None) };
        let (table, joint) = (at.get_ref(), driven.joint);
        if let Some(why) = driven.undriven {
            return self.refuse_drive(
                at.span(),
                format!("joint `{joint}` {why} and has no drive of its own"),
                "leave `drive` out",
            );
        }
        let read = |number: &Option<NumberAt>, what, allowed| {
            let number = number.as_ref();
            number
                .map(|number| self.values.bounded(number, what, allowed))
                .transpose()
        };
        let stall = read(&table.stall, "stall", Allowed::Positive)?;
        let free_speed = read(&table.free_speed, "free_speed", Allowed::Positive)?;
        let line = match (stall, free_speed) {
            (Some(stall), Some(free_speed)) => Some(TorqueSpeedLine { stall, free_speed }),
            (None, None) => None,
            _ => {
                return self.refuse_drive(
                    at.span(),
                    format!("joint `{joint}`: `stall` and `free_speed` make one line, and one of them is missing"),
                    "give both, or neither",
                );
            }
        };
        let ratio = read(&table.ratio, "ratio", Allowed::Positive)?;
        let rotor = read(&table.rotor_inertia, "rotor_inertia", Allowed::NotNegative)?;
        let rotor_inertia_kg_m2 = rotor.unwrap_or(0.0);
        if rotor_inertia_kg_m2 > 0.0 && ratio.is_none() {
            return self.refuse_drive(
                at.span(),
                format!("joint `{joint}`: `rotor_inertia` needs the `ratio` of the gear"),
                "add `ratio`, in rad of the rotor per rad or m of the joint; 1 without a gear",
            );
        }
        if rotor_inertia_kg_m2 > 0.0 && driven.armature > 0.0 {
            return self.refuse_drive(
                at.span(),
                format!("joint `{joint}`: the inertia of the drive is given twice, by `armature` and by `rotor_inertia`"),
                "keep one of the two; `armature` is ratio² times `rotor_inertia`",
            );
        }
        let efficiency = read(&table.efficiency, "efficiency", Allowed::Fraction)?.unwrap_or(1.0);
        if efficiency <= 0.0 {
            return self.refuse_drive(
                at.span(),
                format!("joint `{joint}`: no power gets through a gear of efficiency 0"),
                "write a fraction of more than 0 and at most 1",
            );
        }
        Ok(Some(Drive {
            line,
            ratio: ratio.unwrap_or(1.0),
            rotor_inertia_kg_m2,
            efficiency,
        }))
    }

    fn refuse_drive<T>(
        &self,
        at: Range<usize>,
        message: String,
        help: &str,
    ) -> Result<T, RobotError> {
        let problem = RobotProblem::Own {
            code: "robot::drive",
            message,
            label: "this drive".to_owned(),
            help: Some(help.to_owned()),
        };
        self.err(at, problem)
    }
}
