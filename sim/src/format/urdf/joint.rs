//! Joints of a URDF: each becomes one joint, or for `floating` and `planar` a chain of them.

use nalgebra::Vector3;

use super::mimic;
use super::origin::origin;
use crate::format::assembly::assembler::axes_with_z_along;
use crate::format::assembly::description::{JointPart, LinkPart};
use crate::format::robot_format::ReadOptions;
use crate::format::robot_problem::RobotError;
use crate::format::xml::reader::{Node, Reader, elements};
use crate::model::joint_friction::JointFriction;
use crate::model::robot::JointKind;
use crate::part::part_problem::PartProblem;
use crate::part::values::Allowed;
use crate::spatial::{Pose, direction};
use crate::text::{Spanned, suggest};

/// The types of a URDF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    Single(JointKind),
    Floating,
    Planar,
}

const TYPES: [(&str, Type); 6] = [
    ("revolute", Type::Single(JointKind::Revolute)),
    ("continuous", Type::Single(JointKind::Continuous)),
    ("prismatic", Type::Single(JointKind::Prismatic)),
    ("fixed", Type::Single(JointKind::Fixed)),
    ("floating", Type::Floating),
    ("planar", Type::Planar),
];

impl Type {
    /// How many massless links its chain puts between parent and child.
    pub(super) fn links_between(self) -> usize {
        match self {
            Self::Single(_) => 0,
            Self::Floating => 5,
            Self::Planar => 2,
        }
    }
}

/// What a joint joins, read before any of its numbers.
pub(super) struct Head<'a> {
    node: Node<'a>,
    pub(super) name: Spanned<String>,
    pub(super) kind: Type,
    pub(super) parent: Spanned<String>,
    pub(super) child: Spanned<String>,
}

/// One joint of the file as joints of one degree of freedom each.
pub(super) struct Chain {
    pub(super) joints: Vec<JointPart>,
    pub(super) links_between: Vec<LinkPart>,
}

pub(super) fn head<'a>(reader: &Reader<'_>, node: Node<'a>) -> Result<Head<'a>, RobotError> {
    let name = reader.required(node, "name", "a joint")?;
    let tag = node.tag_name().name();
    if tag != "joint" {
        return reader.refuse(
            Reader::tag(node),
            format!("unknown element `<{tag}>`"),
            "it leads from one link to another",
            "did you mean `<joint>`?",
        );
    }
    let owner = format!("joint `{}`", name.get_ref());
    let word = reader.required(node, "type", &owner)?;
    let Some(&(_, kind)) = TYPES.iter().find(|(known, _)| known == word.get_ref()) else {
        return reader.refuse(
            word.span(),
            format!("{owner}: type `{}` is not known", word.get_ref()),
            "not a joint type",
            &suggest(
                word.get_ref(),
                "types",
                TYPES.iter().map(|(known, _)| *known),
            ),
        );
    };
    let link = |tag: &str| {
        let mut children = elements(node);
        match children.find(|child| child.tag_name().name() == tag) {
            Some(child) => reader.required(child, "link", &owner),
            None => reader.refuse(
                Reader::tag(node),
                format!("{owner} has no `<{tag}>`"),
                "in this joint",
                &format!("add <{tag} link=\"...\"/>"),
            ),
        }
    };
    Ok(Head {
        node,
        kind,
        parent: link("parent")?,
        child: link("child")?,
        name,
    })
}

/// Reads the rest of a joint. `is_base` says that it is the only joint of the root.
pub(super) fn chain(
    reader: &mut Reader<'_>,
    options: ReadOptions,
    head: &Head<'_>,
    is_base: bool,
) -> Result<Chain, RobotError> {
    let node = head.node;
    let owner = format!("joint `{}`", head.name.get_ref());
    check_tags(reader, node, &owner);
    let mut joint = JointPart::fixed(
        head.name.clone(),
        head.parent.clone(),
        head.child.clone(),
        origin(reader, node, &owner)?,
    );
    match head.kind {
        Type::Single(kind) => {
            joint.kind = kind;
            if kind != JointKind::Fixed {
                joint.axis = axis(reader, node, &owner)?;
                joint.limits = super::limits::limits(reader, node, &owner, kind)?;
                dynamics(reader, node, &owner, &mut joint)?;
            }
            if !options.ignore_mimic {
                joint.mimic = mimic::mimic(reader, node, &owner, kind)?;
            }
            Ok(Chain {
                joints: vec![joint],
                links_between: Vec::new(),
            })
        }
        Type::Floating | Type::Planar => {
            if !options.ignore_mimic {
                mimic::leave_out(reader, node, &owner);
            }
            let motions = motions(reader, head, &owner, is_base)?;
            Ok(unfold(&joint, &motions))
        }
    }
}

/// Warns of what does not belong in a joint; tags for other programs are let through.
fn check_tags(reader: &mut Reader<'_>, node: Node<'_>, owner: &str) {
    reader.check(
        node,
        owner,
        &["name", "type"],
        &[
            "origin",
            "parent",
            "child",
            "axis",
            "limit",
            "dynamics",
            "mimic",
            "calibration",
            "safety_controller",
            "gazebo",
        ],
    );
    for tag in ["parent", "child"] {
        if let Some(child) = reader.child(node, tag, owner) {
            reader.check(child, owner, &["link"], &[]);
        }
    }
}

/// The motions of a floating or planar joint, from its parent to its child: slides before turns, so that the turns do not tilt the
/// axes of the slides.
fn motions(
    reader: &mut Reader<'_>,
    head: &Head<'_>,
    owner: &str,
    is_base: bool,
) -> Result<Vec<Motion>, RobotError> {
    let node = head.node;
    // URDF does not say which of the motions they are for
    for tag in ["limit", "dynamics"] {
        if let Some(child) = reader.child(node, tag, owner) {
            let message = format!("{owner}: `<{tag}>` of a joint with several motions is left out");
            reader.warn(Reader::tag(child), &message);
        }
    }
    if head.kind == Type::Planar {
        let axes = axes_with_z_along(&axis(reader, node, owner)?);
        let [x, y, z] = [0, 1, 2].map(|i| axes.column(i).into_owned());
        Ok(vec![slide("x", x), slide("y", y), turn("yaw", z)])
    } else if is_base {
        Ok(vec![
            slide("x", Vector3::x()),
            slide("y", Vector3::y()),
            slide("z", Vector3::z()),
            turn("yaw", Vector3::z()),
            turn("pitch", Vector3::y()),
            turn("roll", Vector3::x()),
        ])
    } else {
        reader.refuse(
            Reader::tag(node),
            format!("{owner} is floating, but not the base"),
            "a floating joint",
            "only the base floats: its parent is the root, and it is the root's only joint",
        )
    }
}

type Motion = (&'static str, JointKind, Vector3<f64>);

fn slide(name: &'static str, axis: Vector3<f64>) -> Motion {
    (name, JointKind::Prismatic, axis)
}

fn turn(name: &'static str, axis: Vector3<f64>) -> Motion {
    (name, JointKind::Continuous, axis)
}

/// Motions one after the other, from the joint's parent to its child, with massless links between.
fn unfold(joint: &JointPart, motions: &[Motion]) -> Chain {
    let named = |suffix: &str| {
        let name = format!("{}_{suffix}", joint.name.get_ref());
        Spanned::new(joint.name.span(), name)
    };
    let mut chain = Chain {
        joints: Vec::with_capacity(motions.len()),
        links_between: Vec::with_capacity(motions.len()),
    };
    let (mut parent, mut origin) = (joint.parent.clone(), joint.parent_from_child);
    for (i, (name, kind, axis)) in motions.iter().enumerate() {
        let child = if i + 1 == motions.len() {
            joint.child.clone()
        } else {
            let link = named(&format!("{name}_link"));
            chain.links_between.push(LinkPart::bare(link.clone()));
            link
        };
        chain.joints.push(JointPart {
            kind: *kind,
            axis: *axis,
            ..JointPart::fixed(named(name), parent, child.clone(), origin)
        });
        (parent, origin) = (child, Pose::identity());
    }
    chain
}

/// The unit axis, in the child's frame; `x` where the file does not say.
fn axis(reader: &mut Reader<'_>, node: Node<'_>, owner: &str) -> Result<Vector3<f64>, RobotError> {
    let Some(axis) = reader.child(node, "axis", owner) else {
        return Ok(Vector3::x());
    };
    reader.check(axis, owner, &["xyz"], &[]);
    let Some(xyz) = reader.triple(axis, "xyz", owner)? else {
        return Ok(Vector3::x());
    };
    match direction(Vector3::from(xyz)) {
        Some(axis) => Ok(axis),
        None => {
            let at = axis.attribute_node("xyz").map(|a| a.range_value());
            let message = format!("the axis of {owner} is zero");
            reader.err(
                at.unwrap_or_else(|| Reader::tag(axis)),
                PartProblem::Axis { message },
            )
        }
    }
}

fn dynamics(
    reader: &mut Reader<'_>,
    node: Node<'_>,
    owner: &str,
    joint: &mut JointPart,
) -> Result<(), RobotError> {
    if let Some(dynamics) = reader.child(node, "dynamics", owner) {
        reader.check(dynamics, owner, &["damping", "friction"], &[]);
        let read = |name| reader.number(dynamics, name, owner, Allowed::NotNegative);
        joint.damping = read("damping")?.unwrap_or(0.0);
        joint.dry_friction = JointFriction::both(read("friction")?.unwrap_or(0.0));
    }
    Ok(())
}
