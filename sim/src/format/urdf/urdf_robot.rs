//! The robot of a URDF: links and joints in file order, and the parts that they become.

use toml::Spanned;

use super::joint::Head;
use super::shape::Meshes;
use super::{document, inertial, joint, shape, tree};
use crate::format::assembly::assembler::MOST_LINKS;
use crate::format::assembly::description::{Description, JointPart, LinkPart};
use crate::format::robot_format::{ReadFile, ReadOptions};
use crate::format::robot_problem::{KIND, RobotError};
use crate::format::xml::reader::{Node, Reader, elements};
use crate::model::robot::Robot;
use crate::part::part_problem::PartProblem;
use crate::text::{Dimensions, Source, nearest};

/// Reads the robot of a URDF.
///
/// `read_mesh` gets the `filename` of a mesh as written (`package://x/y.stl`, `file:///x.stl`, `y.stl`; see
/// [`MeshLocation`](crate::format::MeshLocation)) and returns the bytes of that file, or why it cannot. Each file is
/// requested once. A file that cannot be read is in [`Robot::warnings`], and its shape is left out.
///
/// # Errors
/// Whatever makes the text no robot, with its place: see [`RobotProblem`](crate::format::RobotProblem).
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
    let links = links
        .into_iter()
        .map(|link| Ok((reader.required(link, "name", "a link")?, link)))
        .collect::<Result<Vec<_>, RobotError>>()?;
    let joints = joints
        .into_iter()
        .map(|joint| joint::head(&reader, joint))
        .collect::<Result<Vec<Head<'_>>, RobotError>>()?;
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
    let base = tree::root(&reader, root, &names, &joints)?;

    let mut meshes = Meshes::new(read_mesh);
    let mut link_parts = Vec::with_capacity(found);
    for (name, node) in &links {
        link_parts.push(link(&mut reader, &mut meshes, name, *node)?);
    }
    let base = link_parts.remove(base);
    let base_name = base.name.get_ref().clone();
    link_parts.insert(0, base);
    let held_by_base = joints.iter().filter(|j| j.parent.get_ref() == &base_name);
    let one_joint_on_base = held_by_base.count() == 1;
    let mut joint_parts: Vec<JointPart> = Vec::with_capacity(found);
    for head in &joints {
        let is_base = one_joint_on_base && head.parent.get_ref() == &base_name;
        let chain = joint::chain(&mut reader, options, head, is_base)?;
        if !chain.links_between.is_empty() {
            // before the link they lead to, so that the last link stays the last
            let is_child = |link: &LinkPart| link.name.get_ref() == head.child.get_ref();
            let at = link_parts.iter().position(is_child);
            let at = at.unwrap_or(link_parts.len());
            link_parts.splice(at..at, chain.links_between);
        }
        joint_parts.extend(chain.joints);
    }
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
    })
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
    Ok(LinkPart {
        name: name.clone(),
        inertia: inertial::inertia(reader, &owner, node)?,
        shapes: shape::shapes(reader, meshes, &owner, node)?,
        contact: None,
        drag: None,
    })
}
