//! From the tables of a robot file to parts: expressions become numbers, origins poses, DH rows joints.

mod dh;
mod mass;
mod origin;

use std::ops::Range;

use nalgebra::Vector3;
use toml::Spanned;

use super::assemble::axes_with_z_along;
use super::description::{Description, FramePart, JointPart, LinkPart, LoopPart, MimicPart};
use super::expression;
use super::file::{
    Dimension, Dimensions, JointTable, JointType, LimitTable, LoopTable, LoopType, MimicTable,
    Number, NumberAt, RobotFile,
};
use super::inertia::Inertia;
use super::model::{Contact, JointKind, Limits, LoopKind, Robot};
use super::problem::{RobotError, RobotProblem};
use crate::source::{Source, suggest};
use crate::spatial::{direction, pose};

impl RobotFile {
    /// Makes the robot, with the dimensions `changed` instead of the file's (those of a variant or a hidden case).
    ///
    /// # Errors
    /// Whatever makes the description no robot: see [`RobotProblem`].
    pub fn build(&self, changed: &[(String, Dimension)]) -> Result<Robot, RobotError> {
        let mut dimensions = self.tables.dimensions.clone();
        for (name, value) in changed {
            check_change(&self.source, &dimensions, name, value)?;
            dimensions.set(name.clone(), value.clone());
        }
        let resolver = Resolver {
            file: self,
            dimensions: &dimensions,
        };
        resolver.description()?.assemble()
    }
}

fn check_change(
    source: &Source,
    dimensions: &Dimensions,
    name: &str,
    value: &Dimension,
) -> Result<(), RobotError> {
    let at = source
        .text()
        .find("[dimensions]")
        .map_or(0..0, |start| start..start + "[dimensions]".len());
    let problem = match dimensions.get(name) {
        None => RobotProblem::UnknownDimension {
            name: name.to_owned(),
            help: suggest(name, "dimensions", dimensions.names()),
        },
        Some(old) if old.to_string() != value.to_string() => RobotProblem::DimensionShape {
            name: name.to_owned(),
            expected: old.to_string(),
            found: value.to_string(),
        },
        Some(_) => return Ok(()),
    };
    Err(RobotError::new(problem, source, at))
}

struct Resolver<'a> {
    file: &'a RobotFile,
    dimensions: &'a Dimensions,
}

/// What a number may be.
#[derive(Clone, Copy)]
enum Allowed {
    Any,
    Positive,
    NotNegative,
}

impl Resolver<'_> {
    fn err<T>(&self, at: Range<usize>, problem: RobotProblem) -> Result<T, RobotError> {
        Err(RobotError::new(problem, &self.file.source, at))
    }

    fn number(&self, number: &NumberAt, what: &str, allowed: Allowed) -> Result<f64, RobotError> {
        let span = number.span();
        let value = match number.get_ref() {
            Number::Literal(value) => *value,
            Number::Expression(text) => match expression::evaluate(text, self.dimensions) {
                Ok(value) => value,
                Err(problem) => {
                    // inside the quotes, where the text stands as typed
                    let inside = span.start + 1;
                    let typed = self.file.source.text().get(inside..inside + text.len());
                    let at = if typed == Some(text.as_str()) {
                        inside + problem.at.start..inside + problem.at.end
                    } else {
                        span
                    };
                    let (message, help) = (problem.message, problem.help);
                    return self.err(at, RobotProblem::Expression { message, help });
                }
            },
        };
        let expected = match allowed {
            Allowed::Positive if value <= 0.0 => "positive",
            Allowed::NotNegative if value < 0.0 => "zero or more",
            _ => return Ok(value),
        };
        self.err(
            span,
            RobotProblem::OutOfRange {
                what: what.to_owned(),
                expected,
                found: value.to_string(),
            },
        )
    }

    fn number_or(
        &self,
        number: Option<&NumberAt>,
        what: &str,
        allowed: Allowed,
        absent: f64,
    ) -> Result<f64, RobotError> {
        number.map_or(Ok(absent), |number| self.number(number, what, allowed))
    }

    fn triple(&self, numbers: &[NumberAt; 3], what: &str) -> Result<Vector3<f64>, RobotError> {
        let [x, y, z] = numbers;
        Ok(Vector3::new(
            self.number(x, what, Allowed::Any)?,
            self.number(y, what, Allowed::Any)?,
            self.number(z, what, Allowed::Any)?,
        ))
    }

    fn unit(
        &self,
        numbers: &Spanned<[NumberAt; 3]>,
        what: &str,
    ) -> Result<Vector3<f64>, RobotError> {
        let axis = self.triple(numbers.get_ref(), what)?;
        if let Some(unit) = direction(axis) {
            return Ok(unit);
        }
        self.err(
            numbers.span(),
            RobotProblem::Axis {
                message: format!("{what} is zero"),
            },
        )
    }

    fn limits(
        &self,
        joint: &str,
        kind: JointKind,
        table: &Spanned<LimitTable>,
    ) -> Result<Limits, RobotError> {
        let LimitTable {
            lower,
            upper,
            speed,
            effort,
        } = table.get_ref();
        let read = |n: &Option<NumberAt>, what, allowed| {
            n.as_ref()
                .map(|n| self.number(n, what, allowed))
                .transpose()
        };
        let limits = Limits {
            lower: read(lower, "lower", Allowed::Any)?,
            upper: read(upper, "upper", Allowed::Any)?,
            speed: read(speed, "speed", Allowed::Positive)?,
            effort: read(effort, "effort", Allowed::Positive)?,
        };
        let refuse = |message: String, help: &str| {
            self.err(
                table.span(),
                RobotProblem::Limit {
                    message,
                    help: help.to_owned(),
                },
            )
        };
        if kind == JointKind::Continuous && (limits.lower.is_some() || limits.upper.is_some()) {
            return refuse(
                format!("joint `{joint}` is continuous and has no lower or upper limit"),
                "make it `revolute`, or drop `lower` and `upper`",
            );
        }
        if let (Some(low), Some(high)) = (limits.lower, limits.upper)
            && low >= high
        {
            return refuse(
                format!("joint `{joint}`: lower limit {low} is not below upper limit {high}"),
                "swap them, or widen them",
            );
        }
        Ok(limits)
    }

    fn joint(&self, table: &JointTable) -> Result<JointPart, RobotError> {
        let name = table.name.get_ref();
        let kind = kind(*table.kind.get_ref());
        let axis = match (&table.axis, kind) {
            (None, JointKind::Fixed) => Vector3::zeros(),
            (Some(axis), JointKind::Fixed) => {
                return self.err(
                    axis.span(),
                    RobotProblem::Axis {
                        message: format!("joint `{name}` is fixed and has no axis"),
                    },
                );
            }
            (Some(axis), _) => self.unit(axis, &format!("axis of joint `{name}`"))?,
            (None, _) => {
                return self.err(
                    table.name.span(),
                    RobotProblem::Axis {
                        message: format!("joint `{name}` moves but has no axis"),
                    },
                );
            }
        };
        Ok(JointPart {
            kind,
            parent: table.parent.clone(),
            child: table.child.clone(),
            parent_from_child: self.origin(table.origin.as_ref())?,
            axis,
            damping: self.not_negative(&table.damping, "damping")?,
            dry_friction: self.not_negative(&table.dry_friction, "dry_friction")?,
            armature: self.not_negative(&table.armature, "armature")?,
            limits: match &table.limit {
                Some(limit) => self.limits(name, kind, limit)?,
                None => Limits::default(),
            },
            mimic: self.mimic(table.mimic.as_ref())?,
            passive: table.passive,
            guess: self.number_or(table.guess.as_ref(), "guess", Allowed::Any, 0.0)?,
            name: table.name.clone(),
        })
    }

    fn not_negative(
        &self,
        number: &Option<NumberAt>,
        what: &'static str,
    ) -> Result<f64, RobotError> {
        self.number_or(number.as_ref(), what, Allowed::NotNegative, 0.0)
    }

    fn mimic(&self, table: Option<&MimicTable>) -> Result<Option<MimicPart>, RobotError> {
        let Some(table) = table else { return Ok(None) };
        let number = |n: &Option<NumberAt>, what, absent| {
            self.number_or(n.as_ref(), what, Allowed::Any, absent)
        };
        Ok(Some(MimicPart {
            joint: table.joint.clone(),
            multiplier: number(&table.multiplier, "multiplier", 1.0)?,
            offset: number(&table.offset, "offset", 0.0)?,
        }))
    }

    fn loop_part(&self, table: &Spanned<LoopTable>) -> Result<LoopPart, RobotError> {
        let at = table.span();
        let table = table.get_ref();
        let kind = match table.kind {
            LoopType::Revolute => LoopKind::Revolute,
            LoopType::Spherical | LoopType::Point => LoopKind::Spherical,
        };
        let turned = match &table.axis {
            None => pose(nalgebra::Matrix3::identity(), Vector3::zeros()),
            Some(axis) if kind == LoopKind::Revolute => pose(
                axes_with_z_along(&self.unit(axis, "axis of a loop")?),
                Vector3::zeros(),
            ),
            Some(axis) => {
                return self.err(
                    axis.span(),
                    RobotProblem::Axis {
                        message: "a point has no axis; only a revolute loop has".to_owned(),
                    },
                );
            }
        };
        Ok(LoopPart {
            at,
            kind,
            links: table.links.clone(),
            link_from_end: [
                self.origin(table.frame_on_first.as_ref())? * turned,
                self.origin(table.frame_on_second.as_ref())? * turned,
            ],
        })
    }

    fn links(&self) -> Result<Vec<LinkPart>, RobotError> {
        let mut links = Vec::with_capacity(self.file.tables.links.len());
        for table in &self.file.tables.links {
            let shapes = table
                .shapes
                .iter()
                .map(|shape| self.shape(shape))
                .collect::<Result<Vec<_>, _>>()?;
            let inertia = match &table.inertia {
                Some(inertia) => self.inertia(table, &shapes, inertia)?,
                None => Inertia::zero(),
            };
            let contact = match &table.contact {
                Some(contact) => Some(Contact {
                    friction: self.number(&contact.friction, "friction", Allowed::NotNegative)?,
                    restitution: self.number_or(
                        contact.restitution.as_ref(),
                        "restitution",
                        Allowed::NotNegative,
                        0.0,
                    )?,
                }),
                None => None,
            };
            links.push(LinkPart {
                name: table.name.clone(),
                shapes,
                inertia,
                contact,
            });
        }
        Ok(links)
    }

    fn description(&self) -> Result<Description, RobotError> {
        let tables = &self.file.tables;
        if *tables.format.get_ref() != 1 {
            let found = *tables.format.get_ref();
            return self.err(tables.format.span(), RobotProblem::UnknownFormat { found });
        }
        let frames = tables
            .frames
            .iter()
            .map(|table| {
                Ok(FramePart {
                    name: table.name.clone(),
                    link: table.link.clone(),
                    link_from_frame: self.origin(table.origin.as_ref())?,
                })
            })
            .collect::<Result<_, RobotError>>()?;
        let mut description = Description {
            source: self.file.source.clone(),
            name: tables.name.get_ref().clone(),
            at: tables.name.span(),
            dimensions: self.dimensions.clone(),
            links: self.links()?,
            joints: Vec::new(),
            frames,
            loops: Vec::new(),
            warnings: Vec::new(),
        };
        if let Some(table) = &tables.dh {
            self.dh(table, &mut description)?;
        }
        for table in &tables.joints {
            description.joints.push(self.joint(table)?);
        }
        for table in &tables.loops {
            description.loops.push(self.loop_part(table)?);
        }
        Ok(description)
    }
}

fn kind(word: JointType) -> JointKind {
    match word {
        JointType::Revolute => JointKind::Revolute,
        JointType::Continuous => JointKind::Continuous,
        JointType::Prismatic => JointKind::Prismatic,
        JointType::Fixed => JointKind::Fixed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Robot, RobotError> {
        RobotFile::parse(Source::new("robot.toml", text))?.build(&[])
    }

    const HEAD: &str =
        "format = 1\nname = \"r\"\n[[links]]\nname = \"base\"\n[[links]]\nname = \"arm\"\n";

    #[test]
    fn each_mistake_is_named_at_its_place() {
        let joint = |rest: &str| {
            format!(
                "{HEAD}[[joints]]\nname = \"j\"\ntype = \"revolute\"\nparent = \"base\"\nchild = \"arm\"\n{rest}"
            )
        };
        let cases = [
            ("name = \"r\"".to_owned(), "robot::toml", 1),
            (HEAD.replace("= 1", "= 2"), "robot::unknown_format", 1),
            (HEAD.replace("arm", "base"), "robot::duplicate", 6),
            (HEAD.replace("arm", "world"), "robot::bad_name", 6),
            (HEAD.to_owned(), "robot::detached", 6),
            (joint(""), "robot::axis", 8),
            (joint("axis = [0, 0, 0]"), "robot::axis", 12),
            (joint("axis = [0, 0, 1]\ndampign = 1"), "robot::toml", 13),
            (
                joint("axis = [0, 0, 1]\ndamping = -1"),
                "robot::out_of_range",
                13,
            ),
            (joint("axis = [0, 0, \"a\"]"), "robot::expression", 12),
            (
                joint("axis = [0, 0, 1]\nlimit = { lower = 1, upper = 1 }"),
                "robot::limit",
                13,
            ),
            (
                joint("axis = [0, 0, 1]\norigin = { rpy_deg = [0, 0, 0], angle_deg = 3 }"),
                "robot::origin",
                13,
            ),
            (
                joint("axis = [0, 0, 1]").replace("child = \"arm\"", "child = \"amr\""),
                "robot::unknown_link",
                11,
            ),
            (
                joint("axis = [0, 0, 1]").replace("parent = \"base\"", "parent = \"arm\""),
                "robot::cycle",
                8,
            ),
            (
                joint("axis = [0, 0, 1]").replace("child = \"arm\"", "child = \"base\""),
                "robot::root_is_child",
                11,
            ),
        ];
        for (text, code, line) in cases {
            let error = parse(&text).expect_err(&text);
            use crate::source::Problem as _;
            assert_eq!(error.problem.code(), code, "{error}\n{text}");
            assert_eq!(error.line_and_column().0, line, "{error}\n{text}");
        }
    }

    #[test]
    fn an_unknown_key_says_what_was_meant() {
        let text = format!("{HEAD}shpaes = []");
        let error = parse(&text).expect_err("must be refused");
        use crate::source::Problem as _;
        assert_eq!(error.to_string(), "unknown key `shpaes`");
        assert_eq!(
            error.problem.help().as_deref(),
            Some("did you mean `shapes`?")
        );
    }

    #[test]
    fn a_changed_dimension_keeps_its_shape() {
        let text = format!(
            "format = 1\nname = \"r\"\n[dimensions]\nl = [1.0]\n{}",
            &HEAD[HEAD.find("[[").unwrap_or(0)..]
        );
        let text = text
            + "[[joints]]\nname = \"j\"\ntype = \"fixed\"\nparent = \"base\"\nchild = \"arm\"\norigin = { xyz_m = [\"l[0]\", 0, 0] }";
        let file = RobotFile::parse(Source::new("robot.toml", text)).unwrap();
        let robot = file
            .build(&[("l".to_owned(), Dimension::List(vec![2.5]))])
            .unwrap();
        assert_eq!(robot.joints()[0].parent_from_child.translation.x, 2.5);
        assert!(
            file.build(&[("l".to_owned(), Dimension::Number(1.0))])
                .is_err()
        );
        assert!(
            file.build(&[("k".to_owned(), Dimension::Number(1.0))])
                .is_err()
        );
    }
}
