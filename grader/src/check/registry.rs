//! How a check of a lab file finds its kind: the keys that every check has, and one table whose key names the kind.
//!
//! The list of kinds is [`super::kind`]. A kind's table says how it is read ([`MotionTable`], [`FunctionTable`]).

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::text::{Mistakes, Problem, Spanned};
use schemars::{JsonSchema, Schema, SchemaGenerator, schema_for};
use serde::Deserialize;
use serde::de::{DeserializeOwned, Error as _, MapAccess, Visitor};

use super::contract::{Check, Criterion, FunctionCheck, MotionCheck};
use super::hints::{EARLIER_KEY, HintsTable};
use super::kind;
use super::reading::{FunctionReading, InMotion, MotionReading, Reading};
use crate::task::model::{FunctionTask, MotionTask};
use crate::task::problem::{LabError, near, problems};
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

    /// The name of an earlier check that it is about, if it is about one.
    fn about(&self) -> Option<&str> {
        None
    }

    /// Reads the table.
    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError>;
}

/// The table of a kind that judges answers.
pub(crate) trait FunctionTable:
    DeserializeOwned + JsonSchema + fmt::Debug + 'static
{
    /// The key of the table, which is the name of the kind.
    const NAME: &'static str;
    /// The function whose answers it judges; none for a function of the lab's own.
    const FUNCTION: Option<&'static str>;
    /// What the table becomes.
    type Check: FunctionCheck + 'static;

    /// Reads the table.
    fn read(&self, reading: &FunctionReading<'_>) -> Result<Self::Check, LabError>;
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
    /// The function whose answers it judges; none for runs, and for a function of the lab's own.
    pub function: Option<&'static str>,
    /// The JSON schema of its table.
    pub schema: fn() -> Schema,
    /// The same as a part of a larger one.
    pub(super) in_schema: fn(&mut SchemaGenerator) -> Schema,
}

impl Kind {
    pub(super) const fn motion<T: MotionTable>(module: &'static str) -> Self {
        Self {
            name: T::NAME,
            module,
            of_motion: true,
            function: None,
            schema: || schema_for!(T),
            in_schema: T::json_schema,
        }
    }

    pub(super) const fn function<T: FunctionTable>(module: &'static str) -> Self {
        Self {
            name: T::NAME,
            module,
            of_motion: false,
            function: T::FUNCTION,
            schema: || schema_for!(T),
            in_schema: T::json_schema,
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

    fn name(&self) -> &'static str {
        match self {
            Self::Motion(table) => table.name(),
            Self::Function(table) => table.name(),
        }
    }

    fn about(&self) -> Option<&str> {
        match self {
            Self::Motion(table) => table.about(),
            Self::Function(_) => None,
        }
    }
}

/// A [`MotionTable`] whose type is not known.
pub(crate) trait ReadMotion: fmt::Debug {
    fn name(&self) -> &'static str;
    fn lacks(&self, task: &MotionTask) -> Option<&'static str>;
    fn about(&self) -> Option<&str>;
    fn read(
        &self,
        report: Reporter<'_>,
        of: InMotion<'_>,
    ) -> Result<Arc<dyn MotionCheck>, LabError>;
}

impl<T: MotionTable> ReadMotion for Spanned<T> {
    fn name(&self) -> &'static str {
        T::NAME
    }

    fn lacks(&self, task: &MotionTask) -> Option<&'static str> {
        T::lacks(task)
    }

    fn about(&self) -> Option<&str> {
        self.get_ref().about()
    }

    fn read(
        &self,
        report: Reporter<'_>,
        of: InMotion<'_>,
    ) -> Result<Arc<dyn MotionCheck>, LabError> {
        let at = self.span();
        Ok(Arc::new(self.get_ref().read(&Reading {
            report,
            at,
            of,
        })?))
    }
}

/// A [`FunctionTable`] whose type is not known.
pub(crate) trait ReadFunction: fmt::Debug {
    fn name(&self) -> &'static str;
    fn function(&self) -> Option<&'static str>;
    fn read(
        &self,
        report: Reporter<'_>,
        of: &FunctionTask,
    ) -> Result<Arc<dyn FunctionCheck>, LabError>;
}

impl<T: FunctionTable> ReadFunction for Spanned<T> {
    fn name(&self) -> &'static str {
        T::NAME
    }

    fn function(&self) -> Option<&'static str> {
        T::FUNCTION
    }

    fn read(
        &self,
        report: Reporter<'_>,
        of: &FunctionTask,
    ) -> Result<Arc<dyn FunctionCheck>, LabError> {
        let at = self.span();
        Ok(Arc::new(self.get_ref().read(&Reading {
            report,
            at,
            of,
        })?))
    }
}

/// The task that a kind of function checks needs, in words.
fn task_of(function: Option<&str>) -> String {
    match function {
        Some(name) => format!("a function task of `{name}`"),
        None => "a function task of a quantity such as `torque`, or of the lab's own, with `given` and `expected`".to_owned(),
    }
}

/// A `[[tasks.checks]]` table, as typed.
#[derive(Debug)]
pub(crate) struct CheckTable {
    /// Unique in its task.
    pub(crate) name: Spanned<String>,
    title: String,
    points: Spanned<f64>,
    needs: Vec<Spanned<String>>,
    hints: HintsTable,
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
                // refused later, with what to write instead
                let known = kind::KEYS.iter().chain([&EARLIER_KEY]);
                known
                    .copied()
                    .find(|known| *known == key)
                    .map(Key)
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
                let (mut needs, mut kinds) = (Vec::new(), Vec::new());
                let mut hints = HintsTable::default();
                while let Some(Key(key)) = map.next_key()? {
                    match key {
                        "name" => name = Some(map.next_value()?),
                        "title" => title = Some(map.next_value()?),
                        "points" => points = Some(map.next_value()?),
                        "needs" => needs = map.next_value()?,
                        "hints" => hints.hints = Some(map.next_value()?),
                        EARLIER_KEY => hints.earlier = Some(map.next_value()?),
                        kind => kinds.push(kind::table(kind, &mut map)?),
                    }
                }
                let missing = A::Error::missing_field;
                Ok(CheckTable {
                    name: name.ok_or_else(|| missing("name"))?,
                    title: title.ok_or_else(|| missing("title"))?,
                    points: points.ok_or_else(|| missing("points"))?,
                    needs,
                    hints,
                    kinds,
                })
            }
        }
        deserializer.deserialize_struct("CheckTable", kind::KEYS, KeysAndKinds)
    }
}

problems! {
    /// What is wrong with the keys that every check has.
    enum CheckProblem {
        Points { check: String, points: f64 }:
            "lab::points", "check `{check}` must be worth more than 0 and at most 1000 points, got {points}", "out of range",
            "points are earned, never taken away: write what full marks are worth";
        UnknownNeed { needed: String, known: Vec<String> }:
            "lab::unknown_check", "no earlier check of this task is called `{needed}`", "must stand before this check",
            near(needed, "earlier checks", known);
        NoKind { check: String, example: &'static str }:
            "lab::check_kind", "check `{check}` has no kind", "this check",
            format!("add the table of one, such as `{example}`");
        TwoKinds { check: String, first: &'static str, second: &'static str }:
            "lab::check_kind", "check `{check}` has two kinds, `{first}` and `{second}`", "this check",
            "keep one of them, and give the other a check of its own";
        Misfit { check: String, kind: &'static str, wanted: String }:
            "lab::check_kind", "check `{check}` of kind `{kind}` needs {wanted}", "this check";
    }
}

/// The checks of a task that cannot be read: what rests on one of them is not looked at, since it may be right.
#[derive(Debug, Default)]
struct Refused<'t> {
    names: Vec<&'t str>,
    mistakes: Mistakes<Box<dyn Problem>>,
}

impl<'t> Refused<'t> {
    /// The check, if it can be read and rests on none that cannot.
    fn keep<T>(
        &mut self,
        table: &'t CheckTable,
        read: impl FnOnce() -> Result<T, LabError>,
    ) -> Option<T> {
        let needs = table.needs.iter().map(|need| need.get_ref().as_str());
        let about = table.kinds.iter().filter_map(KindTable::about);
        let check = match needs.chain(about).any(|name| self.names.contains(&name)) {
            true => None,
            false => self.mistakes.keep(read()),
        };
        if check.is_none() {
            self.names.push(table.name.get_ref());
        }
        check
    }
}

/// Reads the checks of a motion task, in order; `of` is what they can name, without name and checks before.
pub(crate) fn motion_checks(
    tables: &[Spanned<CheckTable>],
    report: Reporter<'_>,
    of: InMotion<'_>,
) -> Result<Vec<Check<dyn MotionCheck>>, LabError> {
    let mut checks: Vec<Check<dyn MotionCheck>> = Vec::new();
    let mut refused = Refused::default();
    for table in tables {
        let table = table.get_ref();
        let of = InMotion {
            check: table.name.get_ref(),
            earlier: &checks,
            ..of
        };
        checks.extend(refused.keep(table, || motion_check(table, report, of)));
    }
    refused.mistakes.finish()?;
    Ok(checks)
}

fn motion_check(
    table: &CheckTable,
    report: Reporter<'_>,
    of: InMotion<'_>,
) -> Result<Check<dyn MotionCheck>, LabError> {
    let example = "pose-reached = { full_m = 0.002, zero_m = 0.02 }";
    let kind = match table.kind(report, example)? {
        KindTable::Motion(kind) => match kind.lacks(of.motion) {
            None => kind,
            Some(lacks) => return table.misfit(report, kind.name(), lacks.to_owned()),
        },
        KindTable::Function(kind) => {
            return table.misfit(report, kind.name(), task_of(kind.function()));
        }
    };
    let needs = table.needs(report, of.earlier.iter().map(|check| check.name.as_str()))?;
    let kind = kind.read(report, of)?;
    let mut criterion = table.criterion(report, needs, kind.bounds())?;
    // what earned nothing undisturbed is not tried again
    if let Some(sweep) = kind.sweep()
        && !criterion.needs.contains(&sweep.check)
    {
        criterion.needs.push(sweep.check);
    }
    Ok(Check { criterion, kind })
}

/// Reads the checks of a function task, in order.
pub(crate) fn function_checks(
    tables: &[Spanned<CheckTable>],
    report: Reporter<'_>,
    task: &FunctionTask,
) -> Result<Vec<Check<dyn FunctionCheck>>, LabError> {
    let mut checks: Vec<Check<dyn FunctionCheck>> = Vec::new();
    let mut refused = Refused::default();
    for table in tables {
        let table = table.get_ref();
        let read = || function_check(table, report, task, &checks);
        checks.extend(refused.keep(table, read));
    }
    refused.mistakes.finish()?;
    Ok(checks)
}

fn function_check(
    table: &CheckTable,
    report: Reporter<'_>,
    task: &FunctionTask,
    earlier: &[Check<dyn FunctionCheck>],
) -> Result<Check<dyn FunctionCheck>, LabError> {
    let example = match task.function.known_name() {
        Some("inverse_kinematics") => "ik-reach = { full_m = 1e-3, zero_m = 1e-2 }",
        Some("jacobian") => "jacobian-match = { full = 0.01, zero = 0.1 }",
        Some(_) => "fk-error = { full_m = 1e-4, zero_m = 5e-3 }",
        None => "function-cases = { full = 0.01, zero = 0.1 }",
    };
    let kind = match table.kind(report, example)? {
        KindTable::Function(kind) if kind.function() == task.function.known_name() => kind,
        KindTable::Function(kind) => {
            return table.misfit(report, kind.name(), task_of(kind.function()));
        }
        KindTable::Motion(kind) => {
            return table.misfit(report, kind.name(), "a motion task".to_owned());
        }
    };
    let needs = table.needs(report, earlier.iter().map(|check| check.name.as_str()))?;
    let kind = kind.read(report, task)?;
    let criterion = table.criterion(report, needs, kind.bounds())?;
    Ok(Check { criterion, kind })
}

impl CheckTable {
    /// Its one kind; its points are in range. `example` is a kind that it could have.
    fn kind(&self, report: Reporter<'_>, example: &'static str) -> Result<&KindTable, LabError> {
        let check = self.name.get_ref().clone();
        let points = *self.points.get_ref();
        if !(points > 0.0 && points <= 1000.0) {
            return report.refuse(self.points.span(), CheckProblem::Points { check, points });
        }
        match &self.kinds[..] {
            [kind] => Ok(kind),
            [] => report.refuse(self.name.span(), CheckProblem::NoKind { check, example }),
            [first, second, ..] => {
                let [first, second] = [first, second].map(KindTable::name);
                let problem = CheckProblem::TwoKinds {
                    check,
                    first,
                    second,
                };
                report.refuse(self.name.span(), problem)
            }
        }
    }

    /// The checks that it needs, by index among the `earlier` ones.
    fn needs<'c>(
        &self,
        report: Reporter<'_>,
        earlier: impl Iterator<Item = &'c str>,
    ) -> Result<Vec<usize>, LabError> {
        let known: Vec<String> = earlier.map(str::to_owned).collect();
        let index = |typed: &Spanned<String>| {
            let needed = typed.get_ref().clone();
            match known.iter().position(|check| *check == needed) {
                Some(index) => Ok(index),
                None => {
                    let known = known.clone();
                    report.refuse(typed.span(), CheckProblem::UnknownNeed { needed, known })
                }
            }
        };
        self.needs.iter().map(index).collect()
    }

    /// The bytes of its steps behind the question of its hints, which no grade depends on.
    pub(crate) fn steps_behind_question(&self) -> Option<Range<usize>> {
        self.hints.behind_question()
    }

    fn criterion(
        &self,
        report: Reporter<'_>,
        needs: Vec<usize>,
        bounds: [String; 2],
    ) -> Result<Criterion, LabError> {
        Ok(Criterion {
            name: self.name.get_ref().clone(),
            title: self.title.clone(),
            points: *self.points.get_ref(),
            needs,
            hints: self.hints.read(report, self.name.get_ref())?,
            bounds,
        })
    }

    fn misfit<T>(
        &self,
        report: Reporter<'_>,
        kind: &'static str,
        wanted: String,
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
