//! How a check of a lab file finds its kind: the keys that every check has, and one table whose key names the kind.
//!
//! The list of kinds is [`super::kind`]. A kind's table says how it is read ([`MotionTable`], [`FunctionTable`]).

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::text::{Problem, suggest};
use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;
use serde::de::{DeserializeOwned, Error as _, MapAccess, Visitor};
use toml::Spanned;

use super::contract::{Check, FunctionCheck, MotionCheck};
use super::kind;
use super::reading::{FunctionReading, InTask, MotionReading, NumberAt};
use crate::task::model::{Function, MotionTask};
use crate::task::problem::LabError;
use crate::task::reporter::Reporter;

/// The table of a kind that judges runs.
pub(crate) trait MotionTable: DeserializeOwned + JsonSchema + fmt::Debug + 'static {
    /// The key of the table, which is the name of the kind.
    const NAME: &'static str;
    /// What the table becomes.
    type Check: MotionCheck + 'static;

    /// What the kind needs and `task` lacks, in words.
    fn lacks(task: &MotionTask) -> Option<&'static str> {
        let _ = task;
        None
    }

    /// Reads the table that stands at `at`.
    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Self::Check, LabError>;
}

/// The table of a kind that judges answers.
pub(crate) trait FunctionTable:
    DeserializeOwned + JsonSchema + fmt::Debug + 'static
{
    /// The key of the table, which is the name of the kind.
    const NAME: &'static str;
    /// The task that the kind needs, in words.
    const TASK: &'static str;
    /// What the table becomes.
    type Check: FunctionCheck + 'static;

    /// Whether the kind judges answers of `function`.
    fn fits(function: &Function) -> bool;

    /// Reads the table that stands at `at`.
    fn read(
        &self,
        at: Range<usize>,
        reading: &FunctionReading<'_>,
    ) -> Result<Self::Check, LabError>;
}

/// What kinds need that look at how goals are reached.
pub(super) fn lacks_goals(task: &MotionTask) -> Option<&'static str> {
    task.goals.is_empty().then_some("`goals` in [tasks.motion]")
}

/// An entry of the list of kinds.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// The key in a lab file.
    pub name: &'static str,
    /// The file of the kind, without its extension.
    pub module: &'static str,
    /// Whether it judges runs of motion tasks; else answers of function tasks.
    pub of_motion: bool,
    /// The JSON schema of its table.
    pub schema: fn() -> Schema,
}

impl Kind {
    pub(super) const fn motion<T: MotionTable>(module: &'static str) -> Self {
        Self {
            name: T::NAME,
            module,
            of_motion: true,
            schema: || schema_for!(T),
        }
    }

    pub(super) const fn function<T: FunctionTable>(module: &'static str) -> Self {
        Self {
            name: T::NAME,
            module,
            of_motion: false,
            schema: || schema_for!(T),
        }
    }
}

/// The table of some kind, as typed.
#[derive(Debug)]
pub(crate) enum KindTable {
    Motion(Box<dyn ReadMotion>),
    Function(Box<dyn ReadFunction>),
}

impl KindTable {
    pub(super) fn motion<T: MotionTable>(table: Spanned<T>) -> Self {
        Self::Motion(Box::new(table))
    }

    pub(super) fn function<T: FunctionTable>(table: Spanned<T>) -> Self {
        Self::Function(Box::new(table))
    }
}

/// A [`MotionTable`] whose type is not known.
pub(crate) trait ReadMotion: fmt::Debug {
    fn name(&self) -> &'static str;
    fn lacks(&self, task: &MotionTask) -> Option<&'static str>;
    fn read(&self, reading: &InTask<'_>) -> Result<Arc<dyn MotionCheck>, LabError>;
}

impl<T: MotionTable> ReadMotion for Spanned<T> {
    fn name(&self) -> &'static str {
        T::NAME
    }

    fn lacks(&self, task: &MotionTask) -> Option<&'static str> {
        T::lacks(task)
    }

    fn read(&self, reading: &InTask<'_>) -> Result<Arc<dyn MotionCheck>, LabError> {
        Ok(Arc::new(self.get_ref().read(self.span(), reading)?))
    }
}

/// A [`FunctionTable`] whose type is not known.
pub(crate) trait ReadFunction: fmt::Debug {
    fn name(&self) -> &'static str;
    fn task(&self) -> &'static str;
    fn fits(&self, function: &Function) -> bool;
    fn read(&self, reading: &FunctionReading<'_>) -> Result<Arc<dyn FunctionCheck>, LabError>;
}

impl<T: FunctionTable> ReadFunction for Spanned<T> {
    fn name(&self) -> &'static str {
        T::NAME
    }

    fn task(&self) -> &'static str {
        T::TASK
    }

    fn fits(&self, function: &Function) -> bool {
        T::fits(function)
    }

    fn read(&self, reading: &FunctionReading<'_>) -> Result<Arc<dyn FunctionCheck>, LabError> {
        Ok(Arc::new(self.get_ref().read(self.span(), reading)?))
    }
}

/// A `[[tasks.checks]]` table, as typed.
#[derive(Debug)]
pub(crate) struct CheckTable {
    /// Unique in its task.
    pub(crate) name: Spanned<String>,
    title: String,
    points: NumberAt,
    needs: Vec<Spanned<String>>,
    hint: Option<String>,
    kinds: Vec<KindTable>,
}

/// A key of a `[[tasks.checks]]` table that is known.
struct Key(&'static str);

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct KnownKey;
        impl Visitor<'_> for KnownKey {
            type Value = Key;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a key of a check")
            }
            fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<Key, E> {
                let known = kind::KEYS.iter().find(|known| **known == key);
                known
                    .map(|known| Key(known))
                    .ok_or_else(|| E::unknown_field(key, kind::KEYS))
            }
        }
        deserializer.deserialize_identifier(KnownKey)
    }
}

impl<'de> Deserialize<'de> for CheckTable {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct KeysAndKinds;
        impl<'de> Visitor<'de> for KeysAndKinds {
            type Value = CheckTable;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of a check")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<CheckTable, A::Error> {
                let (mut name, mut title, mut points) = (None, None, None);
                let (mut needs, mut hint, mut kinds) = (Vec::new(), None, Vec::new());
                while let Some(Key(key)) = map.next_key()? {
                    match key {
                        "name" => name = Some(map.next_value()?),
                        "title" => title = Some(map.next_value()?),
                        "points" => points = Some(map.next_value()?),
                        "needs" => needs = map.next_value()?,
                        "hint" => hint = map.next_value()?,
                        kind => kinds.push(kind::table(kind, &mut map)?),
                    }
                }
                let missing = A::Error::missing_field;
                Ok(CheckTable {
                    name: name.ok_or_else(|| missing("name"))?,
                    title: title.ok_or_else(|| missing("title"))?,
                    points: points.ok_or_else(|| missing("points"))?,
                    needs,
                    hint,
                    kinds,
                })
            }
        }
        deserializer.deserialize_struct("CheckTable", kind::KEYS, KeysAndKinds)
    }
}

/// What is wrong with the keys that every check has.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CheckProblem {
    /// Points that nobody could earn, or too many.
    #[error("check `{check}` must be worth more than 0 and at most 1000 points, got {points}")]
    Points {
        /// The check's name.
        check: String,
        /// The number as typed.
        points: f64,
    },
    /// `needs` names what does not stand before the check.
    #[error("no earlier check of this task is called `{needed}`")]
    UnknownNeed {
        /// The name as typed.
        needed: String,
        /// The checks before this one.
        known: Vec<String>,
    },
    /// There is no table of a kind, or more than one.
    #[error("check `{check}` must have exactly one kind")]
    NotOneKind {
        /// The check's name.
        check: String,
    },
    /// The task has nothing of what the kind judges.
    #[error("check `{check}` of kind `{kind}` needs {wanted}")]
    Misfit {
        /// The check's name.
        check: String,
        /// The kind.
        kind: &'static str,
        /// What the kind needs, in words.
        wanted: &'static str,
    },
}

impl Problem for CheckProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Points { .. } => "lab::points",
            Self::UnknownNeed { .. } => "lab::unknown_check",
            Self::NotOneKind { .. } | Self::Misfit { .. } => "lab::check_kind",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Points { .. } => "out of range",
            Self::UnknownNeed { .. } => "must stand before this check",
            Self::NotOneKind { .. } | Self::Misfit { .. } => "this check",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Points { .. } => Some(
                "points are earned, never taken away: write what full marks are worth".to_owned(),
            ),
            Self::UnknownNeed { needed, known } => {
                let known = known.iter().map(String::as_str);
                Some(suggest(needed, "earlier checks", known))
            }
            Self::NotOneKind { .. } => {
                Some("add one table, such as [tasks.checks.pose-reached]".to_owned())
            }
            Self::Misfit { .. } => None,
        }
    }
}

/// Reads the checks of a motion task, in order.
pub(crate) fn motion_checks(
    tables: &[Spanned<CheckTable>],
    reading: &MotionReading<'_>,
) -> Result<Vec<Check<dyn MotionCheck>>, LabError> {
    let mut checks: Vec<Check<dyn MotionCheck>> = Vec::new();
    for table in tables {
        let table = table.get_ref();
        let mut check = table.check(reading.report, &checks, |kind| {
            let (name, wanted) = match kind {
                KindTable::Motion(kind) => match kind.lacks(reading.motion) {
                    None => {
                        return kind.read(&InTask {
                            reading,
                            check: table.name.get_ref(),
                            earlier: &checks,
                        });
                    }
                    Some(lacks) => (kind.name(), lacks),
                },
                KindTable::Function(kind) => (kind.name(), kind.task()),
            };
            table.misfit(reading.report, name, wanted)
        })?;
        // what earned nothing undisturbed is not tried again
        if let Some(sweep) = check.kind.sweep()
            && !check.needs.contains(&sweep.check)
        {
            check.needs.push(sweep.check);
        }
        checks.push(check);
    }
    Ok(checks)
}

/// Reads the checks of a function task, in order.
pub(crate) fn function_checks(
    tables: &[Spanned<CheckTable>],
    reading: &FunctionReading<'_>,
) -> Result<Vec<Check<dyn FunctionCheck>>, LabError> {
    let mut checks = Vec::new();
    for table in tables {
        let table = table.get_ref();
        let check = table.check(reading.report, &checks, |kind| {
            let (name, wanted) = match kind {
                KindTable::Function(kind) if kind.fits(&reading.function.function) => {
                    return kind.read(reading);
                }
                KindTable::Function(kind) => (kind.name(), kind.task()),
                KindTable::Motion(kind) => (kind.name(), "a motion task"),
            };
            table.misfit(reading.report, name, wanted)
        })?;
        checks.push(check);
    }
    Ok(checks)
}

impl CheckTable {
    /// Reads the keys that every check has, and its one kind with `read`.
    fn check<K: ?Sized>(
        &self,
        report: Reporter<'_>,
        earlier: &[Check<K>],
        read: impl FnOnce(&KindTable) -> Result<Arc<K>, LabError>,
    ) -> Result<Check<K>, LabError> {
        let name = self.name.get_ref();
        let points = *self.points.get_ref();
        if !(points > 0.0 && points <= 1000.0) {
            let check = name.clone();
            let problem = CheckProblem::Points { check, points };
            return report.refuse(self.points.span(), problem);
        }
        let mut needs = Vec::new();
        for needed in &self.needs {
            let is_needed = |check: &Check<K>| check.name == *needed.get_ref();
            let Some(index) = earlier.iter().position(is_needed) else {
                let problem = CheckProblem::UnknownNeed {
                    needed: needed.get_ref().clone(),
                    known: earlier.iter().map(|check| check.name.clone()).collect(),
                };
                return report.refuse(needed.span(), problem);
            };
            needs.push(index);
        }
        let [kind] = &self.kinds[..] else {
            let check = name.clone();
            return report.refuse(self.name.span(), CheckProblem::NotOneKind { check });
        };
        Ok(Check {
            name: name.clone(),
            title: self.title.clone(),
            points,
            needs,
            hint: self.hint.clone(),
            kind: read(kind)?,
        })
    }

    fn misfit<T>(
        &self,
        report: Reporter<'_>,
        kind: &'static str,
        wanted: &'static str,
    ) -> Result<T, LabError> {
        let check = self.name.get_ref().clone();
        let problem = CheckProblem::Misfit {
            check,
            kind,
            wanted,
        };
        report.refuse(self.name.span(), problem)
    }
}
