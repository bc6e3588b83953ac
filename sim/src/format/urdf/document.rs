//! The document of a URDF: one `<robot>` element that has gone through xacro.

use roxmltree::Document;

use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::format::xml::document;
use crate::format::xml::reader::{Dialect, Node, Reader, elements};
use crate::text::{Source, Spanned};

/// What messages say of URDFs.
pub(super) const DIALECT: Dialect = Dialect {
    code: "robot::urdf",
    name: "a URDF",
    root: "a URDF is one `<robot name=\"...\">` element",
    unbound: |prefix| (prefix == "xacro").then(xacro),
};

/// Parses the XML and refuses what has yet to go through xacro.
pub(super) fn parse(source: &Source) -> Result<Document<'_>, RobotError> {
    let document = document::parse(source, &DIALECT)?;
    refuse_xacro(source, &document)?;
    Ok(document)
}

fn xacro() -> RobotProblem {
    DIALECT.problem(
        "this is a xacro file, not yet a URDF".to_owned(),
        "xacro has to fill this in",
        Some("run xacro first: `xacro robot.urdf.xacro > robot.urdf`"),
    )
}

/// Finds the first element of xacro, or the first `${...}` or `$(...)` in a link or a joint.
fn refuse_xacro(source: &Source, document: &Document<'_>) -> Result<(), RobotError> {
    let is_xacro = |node: Node<'_>| {
        let namespace = node.tag_name().namespace();
        namespace.is_some_and(|uri| uri.contains("xacro"))
    };
    if let Some(node) = document.descendants().find(|node| is_xacro(*node)) {
        return Err(RobotError::new(xacro(), source, Reader::tag(node)));
    }
    let root = document.root_element();
    // extensions of simulators may keep `$(...)` for their own use
    let parts = elements(root)
        .filter(|node| matches!(node.tag_name().name(), "link" | "joint"))
        .flat_map(|part| part.descendants());
    for node in std::iter::once(root).chain(parts) {
        for attribute in node.attributes() {
            if attribute.value().contains("${") || attribute.value().contains("$(") {
                return Err(RobotError::new(xacro(), source, attribute.range_value()));
            }
        }
    }
    Ok(())
}

/// The name of the robot that the root element is.
pub(super) fn robot_name(
    reader: &Reader<'_>,
    root: Node<'_>,
) -> Result<Spanned<String>, RobotError> {
    let found = root.tag_name().name();
    if found != "robot" {
        let help = match found {
            "sdf" | "world" | "model" => "this looks like SDF: export the model as URDF",
            "mujoco" => "this looks like MJCF: export the model as URDF",
            _ => DIALECT.root,
        };
        return reader.refuse(
            Reader::tag(root),
            format!("the root element is `<{found}>`, not `<robot>`"),
            "expected `<robot>`",
            help,
        );
    }
    let name = reader.required(root, "name", "the robot")?;
    if name.get_ref().trim().is_empty() {
        return reader.refuse(
            name.span(),
            "the robot's name is empty".to_owned(),
            "this name",
            "give the robot a name",
        );
    }
    Ok(name)
}
