//! From the tables of sensors to the sensors: names become indices of a robot, expressions over its dimensions numbers.

use schemars::JsonSchema;
use serde::Deserialize;

use super::kind::KINDS;
use super::registry::SensorReading;
use super::sensor_problem::SensorProblem;
use crate::model::robot::Robot;
use crate::model::sensor::Sensor;
use crate::part::mesh_files::Meshes;
use crate::part::part_problem::{PartError, PartProblem};
use crate::part::part_tables::NumberAt;
use crate::part::values::{Allowed, Values};
use crate::random::seed_of_name;
use crate::text::{Located, Source, Spanned, TypedTable, suggest};

/// A robot or a lab has at most this many sensors: far more than any real one, and few enough to read at every step.
const MOST_SENSORS: usize = 200;

/// A `[[sensors]]` table as typed; [`read_all`] makes the sensors of a list.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct SensorTable(TypedTable);

/// The keys that sensors of every kind have, but the last three only those that are noisy.
pub(super) const COMMON: [&str; 7] = [
    "name",
    "type",
    "delay_s",
    "rate_hz",
    "noise",
    "quantisation",
    "seed",
];

/// How many of [`COMMON`] sensors without noise have.
pub(super) const NOISELESS: usize = 4;

#[derive(Debug, Deserialize, JsonSchema)]
pub(super) struct CommonTable {
    /// Its name, by which submissions read it.
    name: Spanned<String>,
    /// What it measures.
    #[serde(rename = "type")]
    kind: Spanned<String>,
    /// How much later values arrive \[s\]; 0 where it is left out.
    delay_s: Option<NumberAt>,
    /// Values taken each second \[Hz\]; one at every step where it is left out.
    rate_hz: Option<NumberAt>,
    /// Standard deviation of normal noise, in the unit of the value; 0 where it is left out.
    noise: Option<NumberAt>,
    /// Values are integer multiples of this, in their unit; 0 where it is left out.
    quantisation: Option<NumberAt>,
    /// Seed of the noise; made from the name where it is left out.
    seed: Option<u64>,
}

/// Makes the sensors on `robot` of a list in `source`; `kind` is the word for the file in messages.
///
/// Numbers may be expressions over the robot's dimensions.
///
/// # Errors
/// A joint, link or frame that is not there or cannot be measured, a key that the type does not have or lacks, a number
/// out of range, a name that is defined twice.
pub fn read_all(
    tables: &[SensorTable],
    source: &Source,
    kind: &'static str,
    robot: &Robot,
) -> Result<Vec<Sensor>, Located<SensorProblem>> {
    let values = Values {
        source,
        kind,
        dimensions: robot.dimensions(),
        meshes: &Meshes::default(),
    };
    Ok(sensors_of(tables, values, robot)?)
}

/// As [`read_all`], with the problem of whatever file the list is in.
pub(crate) fn sensors_of(
    tables: &[SensorTable],
    values: Values<'_>,
    robot: &Robot,
) -> Result<Vec<Sensor>, PartError> {
    let read = tables.iter().take(MOST_SENSORS + 1);
    let read = read.map(|table| sensor(table, values, robot));
    let (names, sensors): (Vec<Spanned<String>>, Vec<Sensor>) =
        read.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    if let Some(last) = names.get(MOST_SENSORS) {
        return values.err(
            last.span(),
            PartProblem::TooLarge {
                kind: values.kind,
                parts: "sensors",
                found: tables.len(),
                most: MOST_SENSORS,
            },
        );
    }
    values.check_names("sensor", &names, &[], "a name is not empty")?;
    Ok(sensors)
}

/// Reads one sensor, and its name with its place.
fn sensor(
    SensorTable(table): &SensorTable,
    values: Values<'_>,
    robot: &Robot,
) -> Result<(Spanned<String>, Sensor), PartError> {
    let common = table.read::<CommonTable>(|key| COMMON.contains(&key));
    let common = common.map_err(|error| {
        let (problem, at) = PartProblem::of_toml(&error, values.source.text());
        values.located(at, problem)
    })?;
    let type_name = common.kind.get_ref();
    let Some(kind) = KINDS.iter().find(|kind| kind.name == type_name) else {
        let message = format!("unknown value `{type_name}`");
        let names = KINDS.iter().map(|kind| kind.name);
        let help = Some(suggest(type_name, "types", names));
        return values.err(common.kind.span(), PartProblem::Toml { message, help });
    };
    let others = if kind.is_noisy {
        COMMON.len()
    } else {
        NOISELESS
    };
    let reading = SensorReading {
        robot,
        values,
        name: common.name.get_ref(),
        type_at: common.kind.span(),
        table,
        others: &COMMON[..others],
    };
    let number = |number: &Option<NumberAt>, what| {
        let number = number.as_ref();
        number.map_or(Ok(0.0), |n| values.bounded(n, what, Allowed::NotNegative))
    };
    let rate_hz = common.rate_hz.as_ref();
    let rate_hz = rate_hz.map(|rate| values.bounded(rate, "rate_hz", Allowed::Positive));
    let sensor = Sensor {
        type_name: kind.name,
        kind: (kind.read)(&reading)?,
        noise: number(&common.noise, "noise")?,
        quantisation: number(&common.quantisation, "quantisation")?,
        delay_s: number(&common.delay_s, "delay_s")?,
        rate_hz: rate_hz.transpose()?,
        seed: common.seed.unwrap_or_else(|| seed_of_name(reading.name)),
        name: reading.name.to_owned(),
    };
    Ok((common.name, sensor))
}
