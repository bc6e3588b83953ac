//! The robot of a URDF: links and joints in file order, and the parts that they become.

use super::inertial::Inertial;
use super::joint::{Chain, Head};
use super::shape::Meshes;
use super::{document, inertial, joint, mimic, shape, tree};
use crate::format::assembly::assembler::MOST_LINKS;
use crate::format::assembly::description::{
    Description, GivenInertia, JointPart, LinkPart, UnphysicalWords,
};
use crate::format::robot_format::{ReadFile, ReadOptions};
use crate::format::robot_problem::{KIND, RobotError, RobotProblem};
use crate::format::xml::reader::{Node, Reader, elements};
use crate::model::robot::Robot;
use crate::part::part_problem::PartProblem;
use crate::text::{Dimensions, Mistakes, Source, Spanned, nearest};

/// How to go on with a tensor that no body can have.
const REMEDY: &str = "--accept-unphysical takes these tensors as they are, --balance makes all three principal moments of each their \
                      mean (in lab.toml, the same words in [robot_options])";

/// Reads the robot of a URDF.
///
/// `read_mesh` gets the `filename` of a mesh as written (`package://x/y.stl`, `file:///x.stl`, `y.stl`; see
/// [`MeshLocation`](crate::format::MeshLocation)) and returns the bytes of that file, or why it cannot. Each file is
/// requested once. A file that cannot be read is in [`Robot::warnings`], and its shape is left out.
///
/// # Errors
/// Whatever makes the text no robot, with its place, and what else is wrong: see [`RobotProblem`](crate::format::RobotProblem).
pub(super) fn robot(
    source: Source,
    options: &ReadOptions,
    read_mesh: &mut ReadFile<'_>,
) -> Result<Robot, RobotError> {
    let mut robot = describe(&source, *options, read_mesh)?.assemble()?;
    inertial::warn_of_massless(&mut robot);
    Ok(robot)
}

fn describe(
    source: &Source,
    options: ReadOptions,
    read_mesh: &mut ReadFile<'_>,
) -> Result<Description, RobotError> {
    let document = document::parse(source)?;
    let root: Node<'_> = document.root_element();
    let mut reader = Reader::new(source, &document::DIALECT);
    let name = document::robot_name(&reader, root)?;
    let (links, joints) = parts(&mut reader, root);
    let mut mistakes = Mistakes::default();
    let links: Vec<(Spanned<String>, Node<'_>)> = links
        .into_iter()
        .filter_map(|link| {
            let name = mistakes.keep(reader.required(link, "name", "a link"))?;
            Some((name, link))
        })
        .collect();
    let joints: Vec<Head<'_>> = joints
        .into_iter()
        .filter_map(|joint| mistakes.keep(joint::head(&reader, joint)))
        .collect();
    // before anything is unfolded, so that no file costs more than its size
    let found = links.len() + joints.iter().map(|j| j.kind.links_between()).sum::<usize>();
    if found > MOST_LINKS {
        let most = MOST_LINKS;
        return reader.err(
            Reader::tag(root),
            PartProblem::TooLarge {
                kind: KIND,
                parts: "links",
                found,
                most,
            },
        );
    }
    let names: Vec<&Spanned<String>> = links.iter().map(|(name, _)| name).collect();
    // what is left out would be missed in the tree
    let base = if mistakes.is_empty() {
        mistakes.keep(tree::root(&reader, root, &names, &joints))
    } else {
        None
    };
    let mut meshes = Meshes::new(read_mesh);
    let mut link_parts = Vec::with_capacity(found);
    for (name, node) in &links {
        let part = link(&mut reader, &mut meshes, options, name, *node);
        link_parts.extend(mistakes.keep(part));
    }
    let base_name = base.map(|base| links[base].0.get_ref().as_str());
    let chains = chains(&mut reader, options, &joints, base_name, &mut mistakes);
    mistakes.finish()?;
    let Some(base) = base else {
        // a tree without a root is a mistake
        return reader.err(Reader::tag(root), RobotProblem::NoLinks);
    };
    let base = link_parts.remove(base);
    link_parts.insert(0, base);
    let mut joint_parts = unfolded(&joints, chains, &mut link_parts);
    mimic::settle(&mut reader, &mut joint_parts)?;
    Ok(Description {
        source: source.clone(),
        name: name.get_ref().clone(),
        at: name.span(),
        dimensions: Dimensions::default(),
        links: link_parts,
        joints: joint_parts,
        frames: Vec::new(),
        loops: Vec::new(),
        warnings: reader.into_warnings(),
        unphysical: UnphysicalWords {
            remedy: REMEDY,
            lists_treated: true,
        },
    })
}

/// The joints of the file, each as a chain; those that are mistakes are left out.
fn chains(
    reader: &mut Reader<'_>,
    options: ReadOptions,
    joints: &[Head<'_>],
    base_name: Option<&str>,
    mistakes: &mut Mistakes<RobotProblem>,
) -> Vec<Chain> {
    let is_on_base = |joint: &&Head<'_>| Some(joint.parent.get_ref().as_str()) == base_name;
    let one_joint_on_base = joints.iter().filter(is_on_base).count() == 1;
    let mut chains = Vec::with_capacity(joints.len());
    for head in joints {
        // without a root nobody knows which joint floats
        let is_base = base_name.is_none() || (one_joint_on_base && is_on_base(&head));
        let chain = joint::chain(reader, options, head, is_base);
        chains.extend(mistakes.keep(chain));
    }
    chains
}

/// The joints of all chains, whose links come into `links`.
fn unfolded(joints: &[Head<'_>], chains: Vec<Chain>, links: &mut Vec<LinkPart>) -> Vec<JointPart> {
    let mut parts = Vec::with_capacity(links.len());
    for (head, chain) in joints.iter().zip(chains) {
        if !chain.links_between.is_empty() {
            // before the link they lead to, so that the last link stays the last
            let is_child = |link: &LinkPart| link.name.get_ref() == head.child.get_ref();
            let at = links.iter().position(is_child);
            let at = at.unwrap_or(links.len());
            links.splice(at..at, chain.links_between);
        }
        parts.extend(chain.joints);
    }
    parts
}

/// The links and the joints of a robot element, each in file order.
fn parts<'a>(reader: &mut Reader<'_>, robot: Node<'a>) -> (Vec<Node<'a>>, Vec<Node<'a>>) {
    let (mut links, mut joints) = (Vec::new(), Vec::new());
    for node in elements(robot) {
        match node.tag_name().name() {
            "link" => links.push(node),
            "joint" => joints.push(node),
            // extensions come under any name, so only a near miss is worth a word
            other => {
                if let Some(near) = nearest(other, ["link", "joint"].into_iter())
                    && node.has_attribute("name")
                {
                    // what leads from a link to a link is nothing else
                    let has = |name: &str| elements(node).any(|n| n.tag_name().name() == name);
                    if near == "joint" && has("parent") && has("child") {
                        joints.push(node);
                        continue;
                    }
                    let message = format!(
                        "unknown element `<{other}>` is left out: did you mean `<{near}>`?"
                    );
                    reader.warn(Reader::tag(node), &message);
                }
            }
        }
    }
    (links, joints)
}

fn link(
    reader: &mut Reader<'_>,
    meshes: &mut Meshes<'_>,
    options: ReadOptions,
    name: &Spanned<String>,
    node: Node<'_>,
) -> Result<LinkPart, RobotError> {
    let owner = format!("link `{}`", name.get_ref());
    reader.check(
        node,
        &owner,
        &["name", "type"],
        &[
            "inertial",
            "visual",
            "collision",
            "contact",
            "self_collision_checking",
            "sensor",
            "gazebo",
            "material",
        ],
    );
    let Inertial { inertia, at } = inertial::inertia(reader, &owner, node)?;
    Ok(LinkPart {
        name: name.clone(),
        inertia,
        given_inertia: at.map(|at| GivenInertia {
            at,
            on_unphysical: options.on_unphysical,
        }),
        shapes: shape::shapes(reader, meshes, &owner, node)?,
        contact: None,
        drag: None,
    })
}
