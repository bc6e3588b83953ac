//! `<mimic>` of URDF joints: which of them follow another, and what is wrong with those that cannot. Simulators and planners ignore
//! much of it, and files that nobody mended are common, so that what has no effect or no master is a warning.

use std::collections::BTreeMap;

use crate::format::assembly::description::{JointPart, MimicPart};
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::format::xml::reader::{Node, Reader};
use crate::model::robot::JointKind;
use crate::part::values::Allowed;
use crate::text::nearest;

/// What to do about any mimic.
const FLAG: &str = "--ignore-mimic reads the file as if no joint followed another";

/// Reads `<mimic>` of a joint with one motion; `None` where it has none, or does not move.
pub(super) fn mimic(
    reader: &mut Reader<'_>,
    joint: Node<'_>,
    owner: &str,
    kind: JointKind,
) -> Result<Option<MimicPart>, RobotError> {
    let Some(mimic) = reader.child(joint, "mimic", owner) else {
        return Ok(None);
    };
    if kind == JointKind::Fixed {
        let message = format!("{owner} is fixed: its `<mimic>` is left out");
        reader.warn(Reader::tag(mimic), &message);
        return Ok(None);
    }
    reader.check(mimic, owner, &["joint", "multiplier", "offset"], &[]);
    if mimic.attribute_node("joint").is_none() {
        let help = format!("add joint=\"...\", the joint that it follows; {FLAG}");
        let message = format!("`<mimic>` of {owner} has no `joint`");
        return reader.refuse(Reader::tag(mimic), message, "in this element", &help);
    }
    let read = |name| reader.number(mimic, name, owner, Allowed::Any);
    Ok(Some(MimicPart {
        joint: reader.required(mimic, "joint", owner)?,
        multiplier: read("multiplier")?.unwrap_or(1.0),
        offset: read("offset")?.unwrap_or(0.0),
    }))
}

/// Warns of `<mimic>` of a joint with several motions, which follows nothing.
pub(super) fn leave_out(reader: &mut Reader<'_>, joint: Node<'_>, owner: &str) {
    if let Some(mimic) = reader.child(joint, "mimic", owner) {
        let message = format!("{owner} has more than one motion: its `<mimic>` is left out");
        reader.warn(Reader::tag(mimic), &message);
    }
}

/// The joint nearest to the `wanted` master of joint `name`; of several, one that begins like `name`, as the same hand does.
fn near_master<'j>(name: &str, wanted: &str, joints: &'j [JointPart]) -> Option<&'j str> {
    let alike = |known: &str| {
        let pairs = known.bytes().zip(name.bytes());
        pairs.take_while(|(a, b)| a == b).count()
    };
    let known = joints.iter().map(|joint| joint.name.get_ref().as_str());
    let mut known: Vec<&str> = known.filter(|known| *known != name).collect();
    known.sort_by_key(|known| std::cmp::Reverse(alike(known)));
    nearest(wanted, known.into_iter())
}

/// Frees the joints whose master is not there or does not move, each with a warning.
///
/// # Errors
/// A joint that follows itself, by others or at once.
pub(super) fn settle(reader: &mut Reader<'_>, joints: &mut [JointPart]) -> Result<(), RobotError> {
    // a name that is there twice is a mistake of its own
    let index: BTreeMap<String, usize> = joints
        .iter()
        .enumerate()
        .map(|(j, joint)| (joint.name.get_ref().clone(), j))
        .collect();
    let mut masters: Vec<Option<usize>> = vec![None; joints.len()];
    for j in 0..joints.len() {
        let Some(mimic) = &joints[j].mimic else {
            continue;
        };
        let (name, wanted) = (joints[j].name.get_ref(), mimic.joint.get_ref());
        let why = match index.get(wanted) {
            None => match near_master(name, wanted, joints) {
                Some(near) => format!("which is not there; did you mean `{near}`?"),
                None => "which is not there".to_owned(),
            },
            Some(&master) if joints[master].kind == JointKind::Fixed => "which is fixed".to_owned(),
            Some(&master) => {
                masters[j] = Some(master);
                continue;
            }
        };
        let freed = "it follows nothing and has an entry of its own in q";
        let (at, message) = (
            mimic.joint.span(),
            format!("joint `{name}`: {freed}, since it mimics `{wanted}`, {why}"),
        );
        reader.warn(at, &message);
        joints[j].mimic = None;
    }
    for (j, joint) in joints.iter().enumerate() {
        let mut follows = masters[j];
        for _ in 0..joints.len() {
            let Some(master) = follows else { break };
            if master == j {
                let problem = RobotProblem::Mimic {
                    message: format!("joint `{}` mimics itself in a circle", joint.name.get_ref()),
                    help: format!("one joint of the circle must have an entry of its own; {FLAG}"),
                };
                return reader.err(joint.name.span(), problem);
            }
            follows = masters[master];
        }
    }
    Ok(())
}
