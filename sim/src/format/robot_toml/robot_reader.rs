//! From the tables of a robot file to parts: expressions become numbers, origins poses, DH rows joints.

use std::ops::Range;

use nalgebra::Vector3;

use super::drives::Driven;
use super::robot_tables::{
    JointTable, JointType, LimitTable, LinkTable, LoopTable, LoopType, MimicTable, RobotFile,
};
use crate::format::assembly::assembler::axes_with_z_along;
use crate::format::assembly::description::{
    Description, FramePart, GivenInertia, JointPart, LinkPart, LoopPart, MimicPart, UnphysicalWords,
};
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::model::inertia::{Inertia, Solid};
use crate::model::robot::{JointKind, Limits, LoopKind, Robot, Shape};
use crate::model::unphysical::OnUnphysical;
use crate::part::part_problem::PartProblem;
use crate::part::part_tables::{InertiaTable, NumberAt, ShapeTable};
use crate::part::values::{Allowed, Values};
use crate::sensor::sensors_of;
use crate::spatial::pose;
use crate::text::{Dimension, Mistakes, Spanned};

impl RobotFile {
    /// Makes the robot, with the dimensions `changed` instead of the file's (those of a variant or a hidden case).
    ///
    /// # Errors
    /// Whatever makes the description no robot: see [`RobotProblem`].
    pub fn build(&self, changed: &[(String, Dimension)]) -> Result<Robot, RobotError> {
        let dimensions = self.changed(changed)?;
        let values = self.values(&dimensions);
        let resolver = Resolver { file: self, values };
        let mut robot = resolver.description()?.assemble()?;
        robot.sensors = sensors_of(&self.tables.sensors, values, &robot)?;
        Ok(robot)
    }

    /// As [`RobotFile::build`]; `None` where nothing is changed.
    ///
    /// # Errors
    /// As [`RobotFile::build`].
    pub fn build_changed(
        &self,
        changed: &[(String, Dimension)],
    ) -> Result<Option<Robot>, RobotError> {
        let is_changed = !changed.is_empty();
        is_changed.then(|| self.build(changed)).transpose()
    }
}

/// What a robot file says of inertias that no body can have; what it treats, it says itself.
const UNPHYSICAL: UnphysicalWords = UnphysicalWords {
    remedy: "in the `inertia` of such a link, `accept_unphysical = true` takes the tensor as it is, and `balance = true` makes all \
             three principal moments their mean",
    lists_treated: false,
};

pub(super) struct Resolver<'a> {
    pub(super) file: &'a RobotFile,
    pub(super) values: Values<'a>,
}

impl Resolver<'_> {
    pub(super) fn err<T>(
        &self,
        at: Range<usize>,
        problem: impl Into<RobotProblem>,
    ) -> Result<T, RobotError> {
        self.file.err(at, problem)
    }

    pub(super) fn limits(
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
                .map(|n| self.values.number(n, what, allowed))
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
                    PartProblem::Axis {
                        message: format!("joint `{name}` is fixed and has no axis"),
                    },
                );
            }
            (Some(axis), _) => self.values.unit(axis, &format!("axis of joint `{name}`"))?,
            (None, _) => {
                return self.err(
                    table.name.span(),
                    PartProblem::Axis {
                        message: format!("joint `{name}` moves but has no axis"),
                    },
                );
            }
        };
        let armature = self.not_negative(&table.armature, "armature")?;
        let driven = Driven {
            joint: name,
            armature,
            undriven: undriven(kind, table.mimic.is_some(), table.passive),
        };
        Ok(JointPart {
            kind,
            parent: table.parent.clone(),
            child: table.child.clone(),
            parent_from_child: self.values.origin(table.origin.as_ref())?,
            axis,
            damping: self.not_negative(&table.damping, "damping")?,
            dry_friction: self.friction(table.dry_friction.as_ref())?,
            armature,
            drive: self.drive(&driven, table.drive.as_ref())?,
            limits: match &table.limit {
                Some(limit) => self.limits(name, kind, limit)?,
                None => Limits::default(),
            },
            mimic: self.mimic(table.mimic.as_ref())?,
            passive: table.passive,
            guess: self
                .values
                .number_or(table.guess.as_ref(), "guess", Allowed::Any, 0.0)?,
            name: table.name.clone(),
        })
    }

    pub(super) fn not_negative(
        &self,
        number: &Option<NumberAt>,
        what: &'static str,
    ) -> Result<f64, RobotError> {
        let number = number.as_ref();
        Ok(self
            .values
            .number_or(number, what, Allowed::NotNegative, 0.0)?)
    }

    pub(super) fn mimic(
        &self,
        table: Option<&MimicTable>,
    ) -> Result<Option<MimicPart>, RobotError> {
        let Some(table) = table else { return Ok(None) };
        let number = |n: &Option<NumberAt>, what, absent| {
            self.values
                .number_or(n.as_ref(), what, Allowed::Any, absent)
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
                axes_with_z_along(&self.values.unit(axis, "axis of a loop")?),
                Vector3::zeros(),
            ),
            Some(axis) => {
                return self.err(
                    axis.span(),
                    PartProblem::Axis {
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
                self.values.origin(table.frame_on_first.as_ref())? * turned,
                self.values.origin(table.frame_on_second.as_ref())? * turned,
            ],
        })
    }

    fn shape(&self, table: &Spanned<ShapeTable>) -> Result<Shape, RobotError> {
        if let Some(convex) = table
            .get_ref()
            .mesh
            .as_ref()
            .and_then(|m| m.convex.as_ref())
        {
            let problem = PartProblem::Toml {
                message: "`convex` belongs to the bodies of a scene".to_owned(),
                help: Some(
                    "leave it out: a link touches others as the convex hull of its mesh".to_owned(),
                ),
            };
            return self.err(convex.span(), problem);
        }
        let mut shape = self.values.shape(table)?;
        if let Solid::Mesh(mesh) = &mut shape.solid {
            mesh.convex = true;
        }
        Ok(shape)
    }

    fn link(&self, table: &LinkTable) -> Result<LinkPart, RobotError> {
        let shapes = table
            .shapes
            .iter()
            .map(|shape| self.shape(shape))
            .collect::<Result<Vec<_>, _>>()?;
        let inertia = match &table.inertia {
            Some(inertia) => {
                let owner = format!("link `{}`", table.name.get_ref());
                self.values.inertia(&owner, &shapes, inertia)?
            }
            None => Inertia::zero(),
        };
        let given_inertia = table.inertia.as_ref().map(|table| self.given(table));
        let contact = table.contact.as_ref();
        let contact = contact
            .map(|c| self.values.contact(c, &shapes))
            .transpose()?;
        let drag = table.drag.as_ref();
        let drag = drag.map(|d| self.values.drag(d)).transpose()?;
        Ok(LinkPart {
            name: table.name.clone(),
            shapes,
            inertia,
            given_inertia: given_inertia.transpose()?.flatten(),
            contact,
            drag,
        })
    }

    /// What the table of an inertia says of a tensor that is written out; `None` where it follows from the shapes.
    fn given(&self, table: &Spanned<InertiaTable>) -> Result<Option<GivenInertia>, RobotError> {
        let InertiaTable {
            tensor_kg_m2,
            accept_unphysical,
            balance,
            ..
        } = table.get_ref();
        let on_unphysical = match (accept_unphysical, balance) {
            (false, false) => OnUnphysical::Refuse,
            (true, false) => OnUnphysical::Accept,
            (false, true) => OnUnphysical::Balance,
            (true, true) => {
                let problem = PartProblem::Inertia {
                    message: "`accept_unphysical` and `balance` exclude each other".to_owned(),
                    help: "leave one of them out: a tensor is taken as it is, or balanced"
                        .to_owned(),
                };
                return self.err(table.span(), problem);
            }
        };
        let given = tensor_kg_m2.as_ref().map(|tensor| GivenInertia {
            at: tensor.span(),
            on_unphysical,
        });
        Ok(given)
    }

    fn description(&self) -> Result<Description, RobotError> {
        let tables = &self.file.tables;
        let frames = tables
            .frames
            .iter()
            .map(|table| {
                Ok(FramePart {
                    name: table.name.clone(),
                    link: table.link.clone(),
                    link_from_frame: self.values.origin(table.origin.as_ref())?,
                })
            })
            .collect::<Result<_, RobotError>>()?;
        let mut mistakes = Mistakes::default();
        let links = tables.links.iter();
        let links = links.filter_map(|table| mistakes.keep(self.link(table)));
        let links: Vec<LinkPart> = links.collect();
        let joints = tables.joints.iter();
        let joints = joints.filter_map(|table| mistakes.keep(self.joint(table)));
        let joints: Vec<JointPart> = joints.collect();
        mistakes.finish()?;
        let mut description = Description {
            source: self.file.source.clone(),
            name: tables.name.get_ref().clone(),
            at: tables.name.span(),
            dimensions: self.values.dimensions.clone(),
            links,
            joints: Vec::new(),
            frames,
            loops: Vec::new(),
            warnings: Vec::new(),
            unphysical: UNPHYSICAL,
        };
        if let Some(table) = &tables.dh {
            self.dh(table, &mut description)?;
        }
        description.joints.extend(joints);
        for table in &tables.loops {
            description.loops.push(self.loop_part(table)?);
        }
        Ok(description)
    }
}

/// Why a joint can have no drive, if it cannot.
pub(super) fn undriven(kind: JointKind, mimics: bool, passive: bool) -> Option<&'static str> {
    match (kind, mimics, passive) {
        (JointKind::Fixed, ..) => Some("is fixed"),
        (_, true, _) => Some("mimics another"),
        (.., true) => Some("is passive"),
        _ => None,
    }
}

pub(super) fn kind(word: JointType) -> JointKind {
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
    use crate::text::Source;

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
                format!("{HEAD}contact = {{ friction = 1, restitution = 1.1 }}"),
                "robot::out_of_range",
                7,
            ),
            (
                format!("{HEAD}shapes = [{{ mesh = {{ file = \"a.stl\", convex = true }} }}]"),
                "robot::toml",
                7,
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
            use crate::text::Problem as _;
            assert_eq!(error.problem.code(), code, "{error}\n{text}");
            assert_eq!(error.line_and_column().0, line, "{error}\n{text}");
        }
    }

    #[test]
    fn an_unknown_key_says_what_was_meant() {
        let text = format!("{HEAD}shpaes = []");
        let error = parse(&text).expect_err("must be refused");
        use crate::text::Problem as _;
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
