//! Everything that can be wrong with a part of a robot or a scene, whichever file it stands in.

use std::ops::Range;

use crate::text::{FormatProblem, Located, TomlRefusal, suggest};

/// A problem in a part, with its place.
pub(crate) type PartError = Located<PartProblem>;

/// What is wrong with a part of a robot or a scene; `kind` is the word for the file it stands in.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum PartProblem {
    #[error("{message}")]
    Toml {
        message: String,
        help: Option<String>,
    },
    #[error("{problem}")]
    Format { problem: FormatProblem },
    #[error("{message}")]
    Expression {
        message: String,
        help: Option<String>,
    },
    #[error("no {what} is called `{name}`")]
    Unknown {
        what: &'static str,
        name: String,
        help: String,
    },
    #[error("{message}")]
    Sensor { message: String, help: String },
    #[error("{what} `{name}` is defined twice")]
    Duplicate { what: &'static str, name: String },
    #[error("{what} name {name:?} cannot be used")]
    BadName {
        what: &'static str,
        name: String,
        help: &'static str,
    },
    #[error("{found} {parts} are more than a {kind} may have ({most})")]
    TooLarge {
        kind: &'static str,
        parts: &'static str,
        found: usize,
        most: usize,
    },
    #[error("{found} {parts} are more than a {kind} may have ({most})")]
    TooManyShapes {
        kind: &'static str,
        parts: &'static str,
        found: usize,
        most: usize,
    },
    #[error("{message}")]
    Axis { message: String },
    #[error("{what} must be {expected}, got {found}")]
    OutOfRange {
        what: String,
        expected: &'static str,
        found: String,
    },
    #[error("{message}")]
    Inertia { message: String, help: String },
    #[error("{message}")]
    Origin { message: String, help: String },
    #[error("{message}")]
    Mesh {
        message: String,
        help: Option<String>,
    },
    #[error("no dimension `{name}` in this {kind}")]
    UnknownDimension {
        kind: &'static str,
        name: String,
        help: String,
    },
    #[error("dimension `{name}` is {expected} and cannot become {found}")]
    DimensionShape {
        kind: &'static str,
        name: String,
        expected: String,
        found: String,
    },
}

/// The stable names of a problem, by the file it stands in.
pub(crate) struct Codes {
    pub(crate) robot: &'static str,
    pub(crate) scene: &'static str,
    pub(crate) sensor: &'static str,
}

macro_rules! codes {
    ($name:literal) => {
        Codes {
            robot: concat!("robot::", $name),
            scene: concat!("scene::", $name),
            sensor: concat!("sensor::", $name),
        }
    };
}

impl PartProblem {
    /// What the TOML reader refuses, and its place in `text`.
    pub(crate) fn of_toml(error: &toml::de::Error, text: &str) -> (Self, Range<usize>) {
        let TomlRefusal { message, help, at } = TomlRefusal::from_error(error, text);
        (Self::Toml { message, help }, at)
    }

    /// A name that none of the joints, links or frames (`what`) has.
    pub(crate) fn unknown<'n>(
        what: &'static str,
        name: &str,
        known: impl Iterator<Item = &'n str>,
    ) -> Self {
        Self::Unknown {
            what,
            name: name.to_owned(),
            help: suggest(name, &format!("{what}s"), known),
        }
    }

    pub(crate) fn codes(&self) -> Codes {
        match self {
            Self::Toml { .. } => codes!("toml"),
            Self::Format { .. } => codes!("unknown_format"),
            Self::Expression { .. } => codes!("expression"),
            Self::Unknown { what: "joint", .. } => codes!("unknown_joint"),
            Self::Unknown { what: "link", .. } => codes!("unknown_link"),
            Self::Unknown { .. } => codes!("unknown_frame"),
            Self::Sensor { .. } => codes!("sensor"),
            Self::Duplicate { .. } => codes!("duplicate"),
            Self::BadName { .. } => codes!("bad_name"),
            Self::TooLarge { .. } | Self::TooManyShapes { .. } => codes!("too_large"),
            Self::Axis { .. } => codes!("axis"),
            Self::OutOfRange { .. } => codes!("out_of_range"),
            Self::Inertia { .. } => codes!("inertia"),
            Self::Origin { .. } => codes!("origin"),
            Self::Mesh { .. } => codes!("mesh"),
            Self::UnknownDimension { .. } => codes!("unknown_dimension"),
            Self::DimensionShape { .. } => codes!("dimension_shape"),
        }
    }

    pub(crate) fn label(&self) -> String {
        match self {
            Self::Toml { .. } => "here".to_owned(),
            Self::Format { problem } => problem.label().to_owned(),
            Self::Expression { .. } => "in this expression".to_owned(),
            Self::Unknown { what, .. } => format!("not a {what} of this robot"),
            Self::Sensor { .. } => "here".to_owned(),
            Self::Duplicate { .. } => "the second one".to_owned(),
            Self::BadName { .. } => "this name".to_owned(),
            Self::TooLarge { kind, .. } => format!("this {kind}"),
            Self::TooManyShapes { .. } => "one too many".to_owned(),
            Self::Axis { .. } => "this axis".to_owned(),
            Self::OutOfRange { .. } => "out of range".to_owned(),
            Self::Inertia { .. } => "this inertia".to_owned(),
            Self::Origin { .. } => "this origin".to_owned(),
            Self::Mesh { .. } => "this mesh".to_owned(),
            Self::UnknownDimension { kind, .. } | Self::DimensionShape { kind, .. } => {
                format!("the dimensions of this {kind}")
            }
        }
    }

    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Toml { help, .. } | Self::Expression { help, .. } | Self::Mesh { help, .. } => {
                help.clone()
            }
            Self::Format { problem } => Some(problem.help()),
            Self::Duplicate { .. } => Some("give each its own name".to_owned()),
            Self::BadName { help, .. } => Some((*help).to_owned()),
            Self::TooLarge { parts, .. } => Some(format!("leave out {parts} that nothing needs")),
            Self::TooManyShapes {
                parts: "triangles", ..
            } => Some("use coarser meshes; a mesh counts as often as it is used".to_owned()),
            Self::TooManyShapes { .. } => {
                Some("draw it with fewer shapes: contact needs no details".to_owned())
            }
            Self::Axis { .. } => {
                Some("an axis has three numbers, in the child's frame, not all zero".to_owned())
            }
            Self::Inertia { help, .. }
            | Self::Unknown { help, .. }
            | Self::Sensor { help, .. }
            | Self::Origin { help, .. }
            | Self::UnknownDimension { help, .. } => Some(help.clone()),
            Self::OutOfRange { what, expected, .. } => Some(format!(
                "write a number that is {expected}{}",
                unit_of(what)
            )),
            Self::DimensionShape { .. } => None,
        }
    }
}

/// The half sentence about the unit of what a message calls `what`; empty where that depends on more than its key.
fn unit_of(what: &str) -> &'static str {
    // a key of TOML, or an element or attribute of XML with its owner
    let key = what.split(" of ").next().unwrap_or(what);
    let ending = key.rsplit_once('_').map(|(_, ending)| ending);
    match (ending, key) {
        (Some("kg" | "m" | "m2" | "m3" | "s" | "hz" | "n" | "nm" | "rad" | "deg"), _) => {
            "; its unit is in the name of its key"
        }
        (_, "mass `value`") => "; it is in kg",
        (_, "box `size`" | "sphere `radius`" | "cylinder `radius`" | "cylinder `length`") => {
            "; it is in metres"
        }
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_mentioned_where_the_key_has_one() {
        for (what, unit) in [
            ("mass_kg", "; its unit is in the name of its key"),
            ("area_m2", "; its unit is in the name of its key"),
            ("mass `value` of link `hand`", "; it is in kg"),
            ("cylinder `radius` of link `hand`", "; it is in metres"),
            ("damping", ""),
            ("friction", ""),
            ("dynamics `damping` of joint `base_m`", ""),
        ] {
            assert_eq!(unit_of(what), unit, "{what}");
        }
    }
}
