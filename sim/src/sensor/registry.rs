//! How the table of a sensor finds its kind. The list of kinds is [`super::kind`].

use std::ops::Range;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;

use crate::model::robot::{Joint, JointKind, Robot};
use crate::model::sensor::SensorKind;
use crate::part::part_problem::{PartError, PartProblem};
use crate::part::values::Values;
use crate::text::{Spanned, TypedTable, suggest};

/// The keys of one kind, beside those that every sensor has.
pub(super) trait KindTable: DeserializeOwned + JsonSchema {
    /// The word of `type`, which is the name of the kind.
    const NAME: &'static str;
    /// Whether it has `noise`, `quantisation` and a `seed`.
    const IS_NOISY: bool = true;
    /// Keys that fit the robot `rrbot` of the labs, for tests.
    #[cfg(test)]
    const EXAMPLE: &'static str;
    /// What the table becomes.
    type Kind: SensorKind + 'static;

    /// Reads the table.
    fn read(&self, reading: &SensorReading<'_>) -> Result<Self::Kind, PartError>;
}

/// Reads the own keys of a kind.
type ReadKind = fn(&SensorReading<'_>) -> Result<Arc<dyn SensorKind>, PartError>;

/// An entry of the list of kinds.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) is_noisy: bool,
    pub(super) read: ReadKind,
    /// The schema of its own keys.
    pub(super) schema: fn(&mut SchemaGenerator) -> Schema,
    #[cfg(test)]
    pub(super) example: &'static str,
    #[cfg(test)]
    pub(super) own_keys: fn() -> &'static [&'static str],
}

impl Kind {
    pub(super) const fn of<T: KindTable>() -> Self {
        Self {
            name: T::NAME,
            is_noisy: T::IS_NOISY,
            read: |reading| Ok(Arc::new(reading.own::<T>()?.read(reading)?)),
            schema: T::json_schema,
            #[cfg(test)]
            example: T::EXAMPLE,
            #[cfg(test)]
            own_keys: super::documentation::keys::<T>,
        }
    }
}

/// What a sensor is read against.
pub(super) struct SensorReading<'a> {
    pub(super) robot: &'a Robot,
    pub(super) values: Values<'a>,
    /// The sensor's name.
    pub(super) name: &'a str,
    /// Where its type stands.
    pub(super) type_at: Range<usize>,
    pub(super) table: &'a TypedTable,
    /// The keys of the table that are read already.
    pub(super) others: &'a [&'static str],
}

impl SensorReading<'_> {
    /// The keys that only the kind has.
    fn own<T: KindTable>(&self) -> Result<T, PartError> {
        let own = self.table.read(|key| !self.others.contains(&key));
        own.map_err(|error| self.refused(T::NAME, &error))
    }

    /// What the TOML reader refused, in the words of sensors.
    fn refused(&self, kind: &str, error: &toml::de::Error) -> PartError {
        let mut quoted = error.message().split('`').skip(1).step_by(2);
        let key = quoted.next().unwrap_or_default();
        let (mut problem, mut at) = PartProblem::of_toml(error, self.values.source.text());
        if error.message().starts_with("unknown field") {
            // `name` and `type` are there already
            let known = quoted.chain(self.others[2..].iter().copied());
            problem = PartProblem::Sensor {
                message: format!("a sensor of type `{kind}` has no `{key}`"),
                help: suggest(key, "it may have", known),
            };
        } else if error.message().starts_with("missing field") {
            at = self.type_at.clone();
            problem = PartProblem::Sensor {
                message: format!("sensor `{}` has no `{key}`", self.name),
                help: format!("a sensor of type `{kind}` needs `{key}`"),
            };
        }
        self.values.located(at, problem)
    }

    /// Refuses a sensor that cannot be there.
    pub(super) fn refuse<T>(
        &self,
        at: Range<usize>,
        message: String,
        help: String,
    ) -> Result<T, PartError> {
        self.values.err(at, PartProblem::Sensor { message, help })
    }

    /// The index of the joint called `given` among all joints, and the joint.
    pub(super) fn joint(&self, given: &Spanned<String>) -> Result<(usize, &Joint), PartError> {
        let joints = self.robot.joints();
        let names = joints.iter().map(|joint| joint.name.as_str());
        let index = self.values.index("joint", given, names)?;
        Ok((index, &joints[index]))
    }

    /// As [`Self::joint`], of a joint that moves.
    pub(super) fn moving_joint(
        &self,
        given: &Spanned<String>,
    ) -> Result<(usize, &Joint), PartError> {
        let (index, joint) = self.joint(given)?;
        if joint.kind != JointKind::Fixed {
            return Ok((index, joint));
        }
        let message = format!("joint `{}` is fixed and does not move", joint.name);
        let help = "name a joint that moves; through a fixed one only a `wrench` passes".to_owned();
        self.refuse(given.span(), message, help)
    }
}
