//! From the table of a sensor to the sensor: names become indices of a robot, expressions over its dimensions numbers.

use std::collections::BTreeSet;
use std::ops::Range;

use nalgebra::Vector3;
use toml::Spanned;

use super::sensor_problem::{SensorProblem, SensorTableError};
use super::sensor_table::{SensorTable, SensorType, SideName};
use crate::format::part::mesh_files::Meshes;
use crate::format::part::part_problem::PartProblem;
use crate::format::part::part_tables::NumberAt;
use crate::format::part::values::{Allowed, Values};
use crate::model::robot::{Joint, JointKind, Loop, Robot, carried_by};
use crate::model::sensor::{LimitSwitch, RangeFinder, Sensor, SensorKind, Side, default_seed};
use crate::text::{Located, Source, suggest};

/// A robot or a lab has at most this many sensors: far more than any real one, and few enough to read at every step.
const MOST_SENSORS: usize = 200;

/// No noise, quantisation, range, delay or rate is beyond this, in SI units: far beyond any lab, and every value stays
/// finite.
const MOST: f64 = 1e6;

/// How far from a joint's limit a switch at that limit is already pressed \[rad or m\]: contact may hold a joint a
/// tenth of this away from its stop.
const SWITCH_TRAVEL: f64 = 1e-6;

/// Makes the sensor that `table` of `source` describes on `robot`; `kind` is the word for the file in messages.
///
/// Numbers may be expressions over the robot's dimensions.
///
/// # Errors
/// A joint, link or frame that is not there or cannot be measured, a key that the type does not have or lacks, a number
/// out of range.
pub fn resolve(
    table: &SensorTable,
    source: &Source,
    kind: &'static str,
    robot: &Robot,
) -> Result<Sensor, Located<SensorProblem>> {
    let resolver = Resolver {
        table,
        robot,
        values: Values {
            source,
            kind,
            dimensions: robot.dimensions(),
            meshes: &Meshes::default(),
        },
    };
    resolver.sensor()
}

/// Makes the sensors of a list, whose names must differ.
///
/// # Errors
/// As [`resolve`], and a name that is there twice.
pub fn resolve_all(
    tables: &[SensorTable],
    source: &Source,
    kind: &'static str,
    robot: &Robot,
) -> Result<Vec<Sensor>, Located<SensorProblem>> {
    if let Some(last) = tables.get(MOST_SENSORS) {
        let problem = PartProblem::TooLarge {
            kind,
            parts: "sensors",
            found: tables.len(),
            most: MOST_SENSORS,
        };
        return Err(Located::new(problem.into(), source, last.name.span()));
    }
    let mut seen = BTreeSet::new();
    let mut sensors = Vec::with_capacity(tables.len());
    for table in tables {
        if !seen.insert(table.name.get_ref()) {
            let (what, name) = ("sensor", table.name.get_ref().clone());
            let problem = PartProblem::Duplicate { what, name };
            return Err(Located::new(problem.into(), source, table.name.span()));
        }
        sensors.push(resolve(table, source, kind, robot)?);
    }
    Ok(sensors)
}

impl SensorType {
    fn name(self) -> &'static str {
        match self {
            Self::JointPosition => "joint-position",
            Self::JointVelocity => "joint-velocity",
            Self::JointEffort => "joint-effort",
            Self::LimitSwitch => "limit-switch",
            Self::RangeFinder => "range-finder",
            Self::Contact => "contact",
            Self::Wrench => "wrench",
        }
    }

    /// The keys it has beside `name`, `type`, `delay_s` and `rate_hz`.
    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::JointPosition | Self::JointVelocity | Self::JointEffort | Self::Wrench => {
                &["joint", "noise", "quantisation", "seed"]
            }
            Self::LimitSwitch => &["joint", "at", "side", "opens_motor"],
            Self::RangeFinder => &["frame", "axis", "range_m", "noise", "quantisation", "seed"],
            Self::Contact => &["link", "noise", "quantisation", "seed"],
        }
    }
}

struct Resolver<'a> {
    table: &'a SensorTable,
    robot: &'a Robot,
    values: Values<'a>,
}

impl Resolver<'_> {
    fn err<T>(&self, at: Range<usize>, problem: SensorProblem) -> Result<T, SensorTableError> {
        Err(Located::new(problem, self.values.source, at))
    }

    fn unfit<T>(
        &self,
        at: Range<usize>,
        message: String,
        help: String,
    ) -> Result<T, SensorTableError> {
        self.err(at, SensorProblem::Unfit { message, help })
    }

    fn sensor(&self) -> Result<Sensor, SensorTableError> {
        let table = self.table;
        let name = table.name.get_ref();
        if name.trim().is_empty() {
            let problem = PartProblem::BadName {
                what: "sensor",
                name: name.clone(),
                help: "a name is not empty",
            };
            return self.err(table.name.span(), problem.into());
        }
        self.check_keys()?;
        let number = |number: &Option<NumberAt>, what| {
            let number = number.as_ref();
            number.map_or(Ok(0.0), |n| self.bounded(n, what, Allowed::NotNegative))
        };
        let rate_hz = table.rate_hz.as_ref();
        Ok(Sensor {
            kind: self.kind()?,
            noise: number(&table.noise, "noise")?,
            quantisation: number(&table.quantisation, "quantisation")?,
            delay_s: number(&table.delay_s, "delay_s")?,
            rate_hz: rate_hz
                .map(|rate| self.bounded(rate, "rate_hz", Allowed::Positive))
                .transpose()?,
            seed: match &table.seed {
                Some(seed) => *seed.get_ref(),
                None => default_seed(name),
            },
            name: name.clone(),
        })
    }

    /// Refuses what another type of sensor would have.
    fn check_keys(&self) -> Result<(), SensorTableError> {
        fn span<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
            value.as_ref().map(Spanned::span)
        }
        let table = self.table;
        let given = [
            ("joint", span(&table.joint)),
            ("frame", span(&table.frame)),
            ("link", span(&table.link)),
            ("at", span(&table.at)),
            ("side", span(&table.side)),
            ("opens_motor", span(&table.opens_motor)),
            ("axis", span(&table.axis)),
            ("range_m", span(&table.range_m)),
            ("noise", span(&table.noise)),
            ("quantisation", span(&table.quantisation)),
            ("seed", span(&table.seed)),
        ];
        let sensor_type = *table.kind.get_ref();
        let known = sensor_type.keys();
        for (key, at) in given {
            if let Some(at) = at
                && !known.contains(&key)
            {
                let name = sensor_type.name();
                let message = format!("a sensor of type `{name}` has no `{key}`");
                let help = format!("it may have {}, delay_s, rate_hz", known.join(", "));
                return self.unfit(at, message, help);
            }
        }
        Ok(())
    }

    fn bounded(
        &self,
        number: &NumberAt,
        what: &str,
        allowed: Allowed,
    ) -> Result<f64, SensorTableError> {
        let value = self.values.number(number, what, allowed)?;
        if value.abs() <= MOST {
            return Ok(value);
        }
        let problem = PartProblem::OutOfRange {
            what: what.to_owned(),
            expected: "at most 1e6",
            found: format!("{value:?}"),
        };
        self.err(number.span(), problem.into())
    }

    fn kind(&self) -> Result<SensorKind, SensorTableError> {
        Ok(match self.table.kind.get_ref() {
            SensorType::JointPosition => SensorKind::JointPosition {
                joint: self.moving_joint()?,
            },
            SensorType::JointVelocity => SensorKind::JointVelocity {
                joint: self.moving_joint()?,
            },
            SensorType::JointEffort => SensorKind::JointEffort {
                joint: self.driven_joint()?,
            },
            SensorType::LimitSwitch => SensorKind::LimitSwitch(self.limit_switch()?),
            SensorType::RangeFinder => SensorKind::RangeFinder(self.range_finder()?),
            SensorType::Contact => SensorKind::Contact { link: self.link()? },
            SensorType::Wrench => SensorKind::Wrench {
                joint: self.open_joint()?,
            },
        })
    }

    /// The value of a key that the type cannot do without.
    fn needed<'t, T>(&self, value: &'t Option<T>, key: &str) -> Result<&'t T, SensorTableError> {
        match value {
            Some(value) => Ok(value),
            None => self.unfit(
                self.table.kind.span(),
                format!("sensor `{}` has no `{key}`", self.table.name.get_ref()),
                format!(
                    "a sensor of type `{}` needs `{key}`",
                    self.table.kind.get_ref().name()
                ),
            ),
        }
    }

    fn joint(&self) -> Result<(usize, &Joint, Range<usize>), SensorTableError> {
        let given = self.needed(&self.table.joint, "joint")?;
        let joints = self.robot.joints();
        match joints.iter().position(|j| j.name == *given.get_ref()) {
            Some(index) => Ok((index, &joints[index], given.span())),
            None => {
                let name = given.get_ref().clone();
                let help = suggest(&name, "joints", joints.iter().map(|j| j.name.as_str()));
                self.err(given.span(), SensorProblem::UnknownJoint { name, help })
            }
        }
    }

    fn moving_joint(&self) -> Result<usize, SensorTableError> {
        let (index, joint, at) = self.joint()?;
        if joint.kind != JointKind::Fixed {
            return Ok(index);
        }
        let message = format!("joint `{}` is fixed and does not move", joint.name);
        let help = "name a joint that moves; through a fixed one only a `wrench` passes".to_owned();
        self.unfit(at, message, help)
    }

    fn driven_joint(&self) -> Result<usize, SensorTableError> {
        let index = self.moving_joint()?;
        let (_, joint, at) = self.joint()?;
        let Some(mimic) = joint.mimic else {
            return Ok(index);
        };
        let master = &self.robot.joints()[mimic.joint].name;
        self.unfit(
            at,
            format!(
                "joint `{}` mimics `{master}` and has no motor of its own",
                joint.name
            ),
            format!("name `{master}`, or the joint that it mimics in turn"),
        )
    }

    /// A joint through which all passes that its child's side is held by: no loop lies around it.
    fn open_joint(&self) -> Result<usize, SensorTableError> {
        let (index, joint, at) = self.joint()?;
        let carried = carried_by(self.robot, index);
        let around = |closed: &&Loop| {
            let [first, second] = closed.links;
            carried[first] != carried[second]
        };
        let Some(closed) = self.robot.loops().iter().find(around) else {
            return Ok(index);
        };
        let [first, second] = closed.links.map(|link| &self.robot.links()[link].name);
        self.unfit(
            at,
            format!(
                "joint `{}` shares its wrench with the loop between `{first}` and `{second}`",
                joint.name
            ),
            "name a joint outside of every loop".to_owned(),
        )
    }

    fn limit_switch(&self) -> Result<LimitSwitch, SensorTableError> {
        let index = self.moving_joint()?;
        let (_, joint, at) = self.joint()?;
        let side = match self.needed(&self.table.side, "side")?.get_ref() {
            SideName::Lower => Side::Lower,
            SideName::Upper => Side::Upper,
        };
        let limit = match side {
            Side::Lower => joint.limits.lower.map(|limit| limit + SWITCH_TRAVEL),
            Side::Upper => joint.limits.upper.map(|limit| limit - SWITCH_TRAVEL),
        };
        let position = match (&self.table.at, limit) {
            (Some(number), _) => self.values.number(number, "at", Allowed::Any)?,
            (None, Some(limit)) => limit,
            (None, None) => {
                let (joint, side) = (&joint.name, side.name());
                return self.unfit(
                    at,
                    format!("joint `{joint}` has no {side} limit to put a switch at"),
                    format!("say where with `at`, or give the joint a limit `{side}`"),
                );
            }
        };
        Ok(LimitSwitch {
            joint: index,
            at: position,
            side,
            opens_motor: self.table.opens_motor.as_ref().is_none_or(|o| *o.get_ref()),
        })
    }

    fn range_finder(&self) -> Result<RangeFinder, SensorTableError> {
        let given = self.needed(&self.table.frame, "frame")?;
        let frames = self.robot.frames();
        let Some(frame) = frames.iter().position(|f| f.name == *given.get_ref()) else {
            let name = given.get_ref().clone();
            let help = suggest(&name, "frames", frames.iter().map(|f| f.name.as_str()));
            return self.err(given.span(), SensorProblem::UnknownFrame { name, help });
        };
        let range = self.needed(&self.table.range_m, "range_m")?;
        Ok(RangeFinder {
            frame,
            axis: match &self.table.axis {
                Some(axis) => self.values.unit(axis, "axis of a range finder")?,
                None => Vector3::x(),
            },
            range_m: self.bounded(range, "range_m", Allowed::Positive)?,
        })
    }

    fn link(&self) -> Result<usize, SensorTableError> {
        let given = self.needed(&self.table.link, "link")?;
        let links = self.robot.links();
        match links.iter().position(|l| l.name == *given.get_ref()) {
            Some(index) => Ok(index),
            None => {
                let name = given.get_ref().clone();
                let help = suggest(&name, "links", links.iter().map(|l| l.name.as_str()));
                self.err(given.span(), SensorProblem::UnknownLink { name, help })
            }
        }
    }
}
