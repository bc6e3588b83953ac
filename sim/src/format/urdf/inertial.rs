//! Mass properties of a URDF link, in its own, possibly turned, inertial frame; and joints that move no mass. Whether a body can have
//! them is decided for all links together.

use std::ops::Range;

use super::origin::origin;
use crate::format::robot_problem::RobotError;
use crate::format::xml::reader::{Node, Reader};
use crate::model::inertia::Inertia;
use crate::model::robot::{JointKind, Robot};
use crate::part::part_problem::PartProblem;
use crate::part::values::Allowed;
use crate::spatial::{Pose, Symmetric3};

/// What is written of a tensor, before anybody asks whether a body can have it.
pub(super) struct Inertial {
    pub(super) inertia: Inertia,
    /// Where the tensor stands, or what is there instead; `None` without `<inertial>`.
    pub(super) at: Option<Range<usize>>,
}

/// Reads `<inertial>`; a link without it has no mass.
pub(super) fn inertia(
    reader: &mut Reader<'_>,
    owner: &str,
    link: Node<'_>,
) -> Result<Inertial, RobotError> {
    let Some(inertial) = reader.child(link, "inertial", owner) else {
        return Ok(Inertial {
            inertia: Inertia::zero(),
            at: None,
        });
    };
    reader.check(inertial, owner, &[], &["origin", "mass", "inertia"]);
    let link_from_inertial: Pose = origin(reader, inertial, owner)?;
    let Some(mass) = reader.child(inertial, "mass", owner) else {
        return incomplete(
            reader,
            inertial,
            format!("`<inertial>` of {owner} has no `<mass>`"),
            "add <mass value=\"...\"/>, or remove the `<inertial>`",
        );
    };
    reader.check(mass, owner, &["value"], &[]);
    reader.required(mass, "value", owner)?;
    let mass_kg = reader
        .number(mass, "value", owner, Allowed::Any)?
        .unwrap_or(0.0);
    let mut at = Reader::tag(mass);
    let about_com_kg_m2 = match reader.child(inertial, "inertia", owner) {
        Some(inertia) => {
            if mass_kg >= 0.0 {
                at = Reader::tag(inertia);
            }
            tensor(reader, owner, inertia)?
        }
        None if mass_kg == 0.0 => Symmetric3::default(),
        None => {
            return incomplete(
                reader,
                inertial,
                format!("`<inertial>` of {owner} has a mass but no `<inertia>`"),
                "add <inertia ixx=\"...\" .../>, about the centre of mass",
            );
        }
    };
    if mass_kg == 0.0 && about_com_kg_m2 != Symmetric3::default() {
        let message = format!("{owner} has an inertia but no mass");
        reader.warn(Reader::tag(mass), &message);
    }
    let own = Inertia {
        mass_kg,
        about_com_kg_m2,
        ..Inertia::zero()
    };
    Ok(Inertial {
        inertia: own.seen_from(&link_from_inertial),
        at: Some(at),
    })
}

fn incomplete<T>(
    reader: &Reader<'_>,
    node: Node<'_>,
    message: String,
    help: &str,
) -> Result<T, RobotError> {
    let help = help.to_owned();
    reader.err(Reader::tag(node), PartProblem::Inertia { message, help })
}

/// The tensor, all six numbers, in the axes of the inertial frame.
fn tensor(
    reader: &mut Reader<'_>,
    owner: &str,
    inertia: Node<'_>,
) -> Result<Symmetric3, RobotError> {
    let names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
    reader.check(inertia, owner, &names, &[]);
    let mut values = [0.0; 6];
    for (name, value) in names.iter().zip(&mut values) {
        match reader.number(inertia, name, owner, Allowed::Any)? {
            Some(number) => *value = number,
            None => {
                return incomplete(
                    reader,
                    inertia,
                    format!("`<inertia>` of {owner} has no `{name}`"),
                    "all six numbers are needed: ixx, iyy, izz, ixy, ixz, iyz",
                );
            }
        }
    }
    let [xx, yy, zz, xy, xz, yz] = values;
    Ok(Symmetric3 {
        xx,
        yy,
        zz,
        xy,
        xz,
        yz,
    })
}

/// Adds a warning for every joint that moves no mass at all: its acceleration is undefined.
pub(super) fn warn_of_massless(robot: &mut Robot) {
    let bodies = robot.bodies();
    // parents come first, so walking backwards gathers each subtree before it is asked for
    let mut moves_mass: Vec<bool> = bodies
        .iter()
        .map(|b| b.mass_kg > 0.0 || b.armature > 0.0 || b.inertia != Symmetric3::default())
        .collect();
    for b in (0..bodies.len()).rev() {
        if moves_mass[b]
            && let Some(parent) = bodies[b].parent
        {
            moves_mass[parent] = true;
        }
    }
    let warnings: Vec<String> = robot
        .joints()
        .iter()
        .filter(|joint| joint.kind != JointKind::Fixed)
        .filter(|joint| {
            let body = robot.links()[joint.child].attachment.body;
            body.is_some_and(|body| !moves_mass[body])
        })
        .map(|joint| {
            format!(
                "joint `{}` moves link `{}`, which has no mass, nor has anything it carries: \
                 its acceleration is undefined",
                joint.name,
                robot.links()[joint.child].name
            )
        })
        .collect();
    robot.warnings.extend(warnings);
}
