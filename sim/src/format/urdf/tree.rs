//! Which link of a URDF is the root: the one that no joint holds.

use std::collections::BTreeMap;

use super::joint::Head;
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::format::xml::reader::{Node, Reader};
use crate::part::part_problem::PartProblem;
use crate::text::Spanned;

/// The index of the root among `links`. Cycles beside the tree are for `assemble` to find.
pub(super) fn root(
    reader: &Reader<'_>,
    robot: Node<'_>,
    links: &[&Spanned<String>],
    joints: &[Head<'_>],
) -> Result<usize, RobotError> {
    let mut index: BTreeMap<&str, usize> = BTreeMap::new();
    for (i, at) in links.iter().enumerate() {
        let name = at.get_ref().as_str();
        if index.insert(name, i).is_some() {
            let (what, name) = ("link", name.to_owned());
            return reader.err(at.span(), PartProblem::Duplicate { what, name });
        }
    }
    // a name that is not there would otherwise look like a second root
    let mut carrier: Vec<Option<usize>> = vec![None; links.len()];
    for (j, joint) in joints.iter().enumerate() {
        for at in [&joint.parent, &joint.child] {
            if !index.contains_key(at.get_ref().as_str()) {
                let known = links.iter().map(|link| link.get_ref().as_str());
                let problem = PartProblem::unknown("link", at.get_ref(), known);
                return reader.err(at.span(), problem);
            }
        }
        if let Some(&child) = index.get(joint.child.get_ref().as_str())
            && let Some(first) = carrier[child].replace(j)
        {
            let problem = RobotProblem::TwoParents {
                link: joint.child.get_ref().clone(),
                first: joints[first].name.get_ref().clone(),
                second: joint.name.get_ref().clone(),
            };
            return reader.err(joint.child.span(), problem);
        }
    }
    let mut roots = (0..links.len()).filter(|&link| carrier[link].is_none());
    let Some(first) = roots.next() else {
        return no_root(reader, robot, &index, joints, &carrier);
    };
    let Some(second) = roots.next() else {
        return Ok(first);
    };
    let (first, second) = (links[first], links[second]);
    reader.refuse(
        second.span(),
        format!(
            "links `{}` and `{}` are both roots: no joint has either as its child",
            first.get_ref(),
            second.get_ref()
        ),
        "a second root",
        &format!(
            "a robot is one tree: add a joint with child `{}`, or remove the link",
            second.get_ref()
        ),
    )
}

/// Every link is held, or there are none: climbs from the first until a joint comes round again.
fn no_root(
    reader: &Reader<'_>,
    robot: Node<'_>,
    index: &BTreeMap<&str, usize>,
    joints: &[Head<'_>],
    carrier: &[Option<usize>],
) -> Result<usize, RobotError> {
    let mut joint = None;
    let mut link = 0;
    for _ in 0..=carrier.len() {
        joint = carrier.get(link).copied().flatten();
        let parent = joint.map(|j: usize| joints[j].parent.get_ref().as_str());
        link = parent
            .and_then(|name| index.get(name).copied())
            .unwrap_or(0);
    }
    match joint {
        None => reader.refuse(
            Reader::tag(robot),
            "a robot needs at least one link".to_owned(),
            "no <link>",
            "add a <link name=\"...\"/>: the one that is no joint's child is the root",
        ),
        Some(j) => {
            let joint = joints[j].name.get_ref().clone();
            let link = joints[j].child.get_ref().clone();
            reader.err(joints[j].name.span(), RobotProblem::Cycle { joint, link })
        }
    }
}
