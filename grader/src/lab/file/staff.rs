//! The TOML types of `hidden.toml` and `mutants.toml`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use kinemark_sim::random::KeyedStream;
use kinemark_sim::text::schema::either;
use kinemark_sim::text::{Dimension, FileFormat, Spanned};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};

use super::ChoicesTable;

/// `hidden.toml` in the staff's folder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct HiddenTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// A text that nobody guesses: the numbers are drawn from it.
    pub(in crate::lab) salt: Spanned<String>,
    /// Hidden cases of function tasks.
    #[serde(default)]
    pub(in crate::lab) draws: Vec<Spanned<DrawTable>>,
    /// Hidden runs of motion tasks.
    #[serde(default)]
    pub(in crate::lab) runs: Vec<Spanned<HiddenRunsTable>>,
}

/// Cases drawn at random, all of one class.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct DrawTable {
    /// A function task.
    pub(in crate::lab) task: Spanned<String>,
    /// All that students learn about these cases.
    pub(in crate::lab) class: Spanned<String>,
    /// How many cases, 1 to 1000.
    pub(in crate::lab) count: Spanned<u32>,
    /// Rows of joints of equal length, one of which each case has for its robot.
    #[serde(default)]
    pub(in crate::lab) robots: Vec<Spanned<String>>,
    /// `[low, high]` per joint of the task \[rad, or m of a prismatic joint\]; for `inverse_kinematics` the target is the pose there.
    pub(in crate::lab) q_rad: Option<Spanned<Vec<[f64; 2]>>>,
    /// `[low, high]` per joint of the task: joint velocities \[rad/s or m/s\].
    pub(in crate::lab) qd_rad_s: Option<Spanned<Vec<[f64; 2]>>>,
    /// `[low, high]` per joint of the task: joint accelerations \[rad/s² or m/s²\].
    pub(in crate::lab) qdd_rad_s2: Option<Spanned<Vec<[f64; 2]>>>,
    /// For `inverse_kinematics`: `[low, high]` for x, y and z in the lab's frame \[m\].
    pub(in crate::lab) position_m: Option<Spanned<[[f64; 2]; 3]>>,
    /// How many branches reach the positions; 2 where it is left out with `q_rad`, needed with `position_m`.
    pub(in crate::lab) branches: Option<u32>,
    /// Dimensions of the robot: `[low, high]`, a list of such ranges for a list, or `{ choices = [...] }`.
    #[serde(default)]
    pub(in crate::lab) dimensions: RangesTable,
    /// For a function of the lab's own: `[low, high]` for every name that the visible cases give, a list of such ranges for a list, or
    /// `{ choices = [...] }`.
    pub(in crate::lab) given: Option<RangesTable>,
}

/// Names with ranges, the places of both kept.
pub(in crate::lab) type RangesTable = BTreeMap<Spanned<String>, Spanned<Ranges>>;

/// What a hidden number is drawn from: a range for a number, one for each number of a list, or choices.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::lab) enum Ranges {
    One([f64; 2]),
    Each(Vec<[f64; 2]>),
    /// Values of one shape, at least one.
    Choices(Vec<Dimension>),
}

impl Ranges {
    /// All of them; choices have none.
    pub(in crate::lab) fn all(&self) -> &[[f64; 2]] {
        match self {
            Self::One(range) => std::slice::from_ref(range),
            Self::Each(ranges) => ranges,
            Self::Choices(_) => &[],
        }
    }

    /// The low ends (0) or the high ones (1); the first or the last choice.
    pub(in crate::lab) fn end(&self, end: usize) -> Dimension {
        match self {
            Self::One(range) => Dimension::Number(range[end]),
            Self::Each(ranges) => Dimension::List(ranges.iter().map(|r| r[end]).collect()),
            Self::Choices(choices) => choices[end * (choices.len() - 1)].clone(),
        }
    }

    /// The next value of `stream`: uniform in each range, and each choice as likely.
    pub(in crate::lab) fn drawn(&self, stream: &mut KeyedStream) -> Dimension {
        match self {
            Self::One(range) => Dimension::Number(stream.between(*range)),
            Self::Each(ranges) => {
                Dimension::List(ranges.iter().map(|range| stream.between(*range)).collect())
            }
            Self::Choices(choices) => choices[stream.below(choices.len() as u64) as usize].clone(),
        }
    }
}

impl JsonSchema for Ranges {
    fn schema_name() -> Cow<'static, str> {
        "Ranges".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let ranges = either(
            <[f64; 2]>::json_schema(generator),
            <Vec<[f64; 2]>>::json_schema(generator),
        );
        either(ranges, ChoicesTable::json_schema(generator))
    }
}

impl<'de> Deserialize<'de> for Ranges {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RangesOrChoices;
        impl<'de> Visitor<'de> for RangesOrChoices {
            type Value = Ranges;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("[low, high], a list of them, or { choices = [...] }")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Ranges, A::Error> {
                let mut numbers = Vec::new();
                let mut pairs = Vec::new();
                while let Some(item) = seq.next_element::<Dimension>()? {
                    match item {
                        Dimension::Number(number) => numbers.push(number),
                        Dimension::List(list) => match <[f64; 2]>::try_from(list) {
                            Ok(pair) => pairs.push(pair),
                            Err(_) => return Err(A::Error::custom("a range is [low, high]")),
                        },
                        Dimension::Text(_) => {
                            return Err(A::Error::custom(
                                "a range is of numbers; of texts write { choices = [...] }",
                            ));
                        }
                    }
                }
                match (<[f64; 2]>::try_from(numbers), pairs.is_empty()) {
                    (Ok(pair), true) => Ok(Ranges::One(pair)),
                    (Err(numbers), false) if numbers.is_empty() => Ok(Ranges::Each(pairs)),
                    _ => Err(A::Error::custom("expected [low, high], or a list of them")),
                }
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Ranges, A::Error> {
                let table = ChoicesTable::deserialize(MapAccessDeserializer::new(map))?;
                let Some(first) = table.choices.first() else {
                    return Err(A::Error::custom("`choices` has nothing to choose"));
                };
                let shape = first.to_string();
                match table.choices.iter().find(|one| one.to_string() != shape) {
                    Some(other) => Err(A::Error::custom(format!(
                        "the first choice is {shape}, and another is {other}"
                    ))),
                    None => Ok(Ranges::Choices(table.choices)),
                }
            }
        }
        deserializer.deserialize_any(RangesOrChoices)
    }
}

/// `mutants.toml` in the staff's folder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct MutantsTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The mutants.
    #[serde(default)]
    pub(in crate::lab) mutants: Vec<MutantTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct MutantTable {
    /// Its name: the submission is `mutants/NAME.rhai`.
    pub(in crate::lab) name: Spanned<String>,
    /// The tasks in which the misconception shows.
    pub(in crate::lab) tasks: Spanned<Vec<Spanned<String>>>,
    /// The misconception in words, as students read it; or such words for each of the tasks, by their names.
    pub(in crate::lab) says: Spanned<SaysTable>,
    /// Whether students who make it read what it `says`; true where it is left out. With `false` it has to lose points and no more: for
    /// mistakes that show in hidden runs or under disturbances alone.
    pub(in crate::lab) named: Option<bool>,
}

/// What a mutant says.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "`says` is a text, or a table with a text for each task: { fk = \"...\", ik = \"...\" }"
)]
pub(in crate::lab) enum SaysTable {
    /// The same in every task.
    All(String),
    /// For each task by its name.
    Each(BTreeMap<String, String>),
}

/// A motion task that is run again with other parameters, drawn at random.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct HiddenRunsTable {
    /// A motion task.
    pub(in crate::lab) task: Spanned<String>,
    /// All that students learn about these runs.
    pub(in crate::lab) class: Spanned<String>,
    /// How many runs, 1 to 20.
    pub(in crate::lab) count: Spanned<u32>,
    /// Parameters that are drawn: `[low, high]`, or a list of such ranges for a list.
    pub(in crate::lab) parameters: Spanned<RangesTable>,
}
