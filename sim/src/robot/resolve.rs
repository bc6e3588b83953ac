//! From the tables of a robot file to the immutable robot: names become indices, expressions numbers, links moving bodies.

mod mass;
mod origin;
mod tree;

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

use super::expression;
use super::file::{
    Dimension, Dimensions, JointTable, JointType, LimitTable, Number, NumberAt, RobotFile,
};
use super::inertia::Inertia;
use super::model::{Attachment, Body, Contact, Frame, Joint, JointKind, Limits, Link, Robot};
use super::problem::{RobotError, RobotProblem};
use crate::source::{Source, suggest};
use crate::spatial::{Pose, Symmetric3, pose};

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
        let builder = Builder {
            file: self,
            dimensions: &dimensions,
        };
        builder.robot()
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

struct Builder<'a> {
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

impl Builder<'_> {
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
        // scaled first, so that neither tiny nor huge axes are lost in their squares
        let largest = axis.amax();
        if largest > 0.0 {
            let scaled = axis / largest;
            return Ok(scaled / scaled.norm());
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

    fn joint(
        &self,
        table: &JointTable,
        links: &BTreeMap<&str, usize>,
    ) -> Result<Joint, RobotError> {
        let name = table.name.get_ref().clone();
        let link = |end: &Spanned<String>| match links.get(end.get_ref().as_str()) {
            Some(&index) => Ok(index),
            None => self.err(
                end.span(),
                RobotProblem::UnknownLink {
                    name: end.get_ref().clone(),
                    help: suggest(end.get_ref(), "links", links.keys().copied()),
                },
            ),
        };
        let kind = match table.kind.get_ref() {
            JointType::Revolute => JointKind::Revolute,
            JointType::Continuous => JointKind::Continuous,
            JointType::Prismatic => JointKind::Prismatic,
            JointType::Fixed => JointKind::Fixed,
        };
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
        let not_negative = |n: &Option<NumberAt>, what| {
            self.number_or(n.as_ref(), what, Allowed::NotNegative, 0.0)
        };
        Ok(Joint {
            parent: link(&table.parent)?,
            child: link(&table.child)?,
            parent_from_child: self.origin(table.origin.as_ref())?,
            damping: not_negative(&table.damping, "damping")?,
            dry_friction: not_negative(&table.dry_friction, "dry_friction")?,
            armature: not_negative(&table.armature, "armature")?,
            limits: match &table.limit {
                Some(limit) => self.limits(&name, kind, limit)?,
                None => Limits::default(),
            },
            name,
            kind,
            axis,
        })
    }

    /// Names of one kind, each checked to be usable and to be there once.
    fn names<'n>(
        &self,
        what: &'static str,
        names: impl Iterator<Item = &'n Spanned<String>>,
        taken: &BTreeMap<&str, usize>,
    ) -> Result<BTreeMap<&'n str, usize>, RobotError> {
        let mut seen = BTreeMap::new();
        for (index, at) in names.enumerate() {
            let name = at.get_ref().as_str();
            if name.trim().is_empty() || name == "world" {
                let name = name.to_owned();
                return self.err(at.span(), RobotProblem::BadName { what, name });
            }
            if taken.contains_key(name) || seen.insert(name, index).is_some() {
                let name = name.to_owned();
                return self.err(at.span(), RobotProblem::Duplicate { what, name });
            }
        }
        Ok(seen)
    }

    fn robot(&self) -> Result<Robot, RobotError> {
        let tables = &self.file.tables;
        if *tables.format.get_ref() != 1 {
            let found = *tables.format.get_ref();
            return self.err(tables.format.span(), RobotProblem::UnknownFormat { found });
        }
        if tables.links.is_empty() {
            return self.err(tables.name.span(), RobotProblem::NoLinks);
        }
        let nothing = BTreeMap::new();
        let link_names = self.names("link", tables.links.iter().map(|l| &l.name), &nothing)?;
        self.names("joint", tables.joints.iter().map(|j| &j.name), &nothing)?;
        self.names("frame", tables.frames.iter().map(|f| &f.name), &link_names)?;

        let joints: Vec<Joint> = tables
            .joints
            .iter()
            .map(|table| self.joint(table, &link_names))
            .collect::<Result<_, _>>()?;
        let order = self.order(&joints)?;
        let moving: Vec<usize> = (0..joints.len())
            .filter(|&j| joints[j].kind != JointKind::Fixed)
            .collect();

        let mut attachments = vec![
            Attachment {
                body: None,
                body_from_here: Pose::identity(),
            };
            tables.links.len()
        ];
        let mut bodies = Vec::with_capacity(moving.len());
        for &j in &order {
            let joint = &joints[j];
            let parent = &attachments[joint.parent];
            let body_from_child = parent.body_from_here * joint.parent_from_child;
            attachments[joint.child] = match moving.binary_search(&j) {
                Err(_) => Attachment {
                    body: parent.body,
                    body_from_here: body_from_child,
                },
                Ok(q_index) => {
                    let child_from_body = axes_with_z_along(&joint.axis);
                    bodies.push(Body {
                        parent: parent.body,
                        turns: joint.kind.turns(),
                        q_index,
                        parent_from_body: body_from_child.rotation.matrix() * child_from_body,
                        p_body_in_parent: body_from_child.translation.vector,
                        mass_kg: 0.0,
                        first_moment: Vector3::zeros(),
                        inertia: Symmetric3::default(),
                        damping: joint.damping,
                        dry_friction: joint.dry_friction,
                        armature: joint.armature,
                    });
                    Attachment {
                        body: Some(bodies.len() - 1),
                        body_from_here: pose(child_from_body.transpose(), Vector3::zeros()),
                    }
                }
            };
        }

        let mut links = Vec::with_capacity(tables.links.len());
        for (table, attachment) in tables.links.iter().zip(attachments) {
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
            links.push(Link {
                name: table.name.get_ref().clone(),
                shapes,
                inertia,
                contact,
                attachment,
            });
        }
        let world_inertia = gather_inertia(&links, &mut bodies);
        let frames = self.frames(&links, &link_names)?;
        Ok(Robot {
            name: tables.name.get_ref().clone(),
            dimensions: self.dimensions.clone(),
            links,
            joints,
            moving,
            frames,
            bodies,
            world_inertia,
        })
    }

    fn frames(
        &self,
        links: &[Link],
        link_names: &BTreeMap<&str, usize>,
    ) -> Result<Vec<Frame>, RobotError> {
        let mut frames: Vec<Frame> = links
            .iter()
            .enumerate()
            .map(|(index, link)| Frame {
                name: link.name.clone(),
                link: index,
                attachment: link.attachment.clone(),
            })
            .collect();
        for table in &self.file.tables.frames {
            let Some(&link) = link_names.get(table.link.get_ref().as_str()) else {
                return self.err(
                    table.link.span(),
                    RobotProblem::UnknownLink {
                        name: table.link.get_ref().clone(),
                        help: suggest(table.link.get_ref(), "links", link_names.keys().copied()),
                    },
                );
            };
            let Attachment {
                body,
                body_from_here,
            } = &links[link].attachment;
            frames.push(Frame {
                name: table.name.get_ref().clone(),
                link,
                attachment: Attachment {
                    body: *body,
                    body_from_here: body_from_here * self.origin(table.origin.as_ref())?,
                },
            });
        }
        Ok(frames)
    }
}

/// Gives every body the mass of the links fixed to it; returns what is fixed to the world.
fn gather_inertia(links: &[Link], bodies: &mut [Body]) -> Inertia {
    let mut sums = vec![Inertia::zero(); bodies.len()];
    let mut world = Inertia::zero();
    for link in links {
        let Attachment {
            body,
            body_from_here,
        } = &link.attachment;
        let part = link.inertia.seen_from(body_from_here);
        let sum = body.map_or(&mut world, |body| &mut sums[body]);
        *sum = sum.plus(&part);
    }
    for (body, sum) in bodies.iter_mut().zip(sums) {
        body.mass_kg = sum.mass_kg;
        body.first_moment = sum.com_m * sum.mass_kg;
        body.inertia = sum.about_origin_kg_m2();
    }
    world
}

/// Axes, as columns, whose third is `axis`; a cyclic or signed permutation, and so exact, where `axis` is a coordinate axis.
fn axes_with_z_along(axis: &Vector3<f64>) -> Matrix3<f64> {
    let largest = axis.iamax();
    let mut beside = Vector3::zeros();
    beside[(largest + 1) % 3] = 1.0;
    let x = (beside - axis * axis.dot(&beside)).normalize();
    Matrix3::from_columns(&[x, axis.cross(&x), *axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Robot, RobotError> {
        RobotFile::parse(Source::new("robot.toml", text))?.build(&[])
    }

    #[test]
    fn coordinate_axes_are_exact() {
        for axis in [
            Vector3::x(),
            Vector3::y(),
            Vector3::z(),
            -Vector3::x(),
            -Vector3::y(),
            -Vector3::z(),
        ] {
            let m = axes_with_z_along(&axis);
            assert!(m.iter().all(|v| *v == 0.0 || v.abs() == 1.0), "{m}");
            assert_eq!(m.determinant(), 1.0);
            assert_eq!(m * Vector3::z(), axis);
        }
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
