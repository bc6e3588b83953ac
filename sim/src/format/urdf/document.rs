//! The XML of a URDF: text becomes a document that is safe to walk, or an error at its place.

use std::ops::Range;

use roxmltree::{Document, Error, ParsingOptions};
use toml::Spanned;

use super::reader::{Node, Reader};
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::text::Source;

/// A text longer than this \[bytes\] is no URDF: the largest real ones, mesh data aside, stay below one megabyte.
const MOST_BYTES: usize = 16 << 20;
/// A URDF may declare this many namespaces; the parser's memory grows with the square of how many are nested.
const MOST_NAMESPACES: usize = 100;
/// An element may have this many attributes; the parser's time grows with their square.
const MOST_ATTRIBUTES: usize = 1000;
/// The parser takes about 70 bytes for each.
const MOST_NODES: u32 = 4_000_000;

/// Parses the XML and refuses what has yet to go through xacro.
pub(super) fn parse(source: &Source) -> Result<Document<'_>, RobotError> {
    refuse_bombs(source)?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        entity_resolver: None,
    };
    let document = Document::parse_with_options(source.text(), options)
        .map_err(|error| malformed(source, &error))?;
    refuse_xacro(source, &document)?;
    Ok(document)
}

fn problem(message: String, label: &str, help: Option<&str>) -> RobotProblem {
    RobotProblem::Urdf {
        message,
        label: label.to_owned(),
        help: help.map(str::to_owned),
    }
}

/// Refuses texts on which the parser itself would be slow or large.
fn refuse_bombs(source: &Source) -> Result<(), RobotError> {
    let text = source.text();
    let refuse = |at: Range<usize>, message: String, label: &str| {
        let help = "a URDF holds links and joints; meshes lie in files of their own";
        let problem = problem(message, label, Some(help));
        Err(RobotError::new(problem, source, at))
    };
    if text.len() > MOST_BYTES {
        let message = format!(
            "{} bytes are more than a URDF may have ({MOST_BYTES})",
            text.len()
        );
        return refuse(0..0, message, "this file");
    }
    if let Some((at, _)) = text.match_indices("xmlns").nth(MOST_NAMESPACES) {
        let message = format!("more than {MOST_NAMESPACES} namespaces are declared");
        return refuse(at..at + "xmlns".len(), message, "one too many");
    }
    // `<` cannot stand in an attribute, so all attributes of an element lie before the next one
    let mut start = 0;
    for piece in text.split('<') {
        let is_element = !piece.starts_with(['!', '?', '/']);
        let mut signs = piece.bytes().filter(|b| *b == b'=');
        if is_element && signs.nth(MOST_ATTRIBUTES).is_some() {
            let message = format!("more than {MOST_ATTRIBUTES} attributes in one element");
            return refuse(start..start, message, "this element");
        }
        start += piece.len() + 1;
    }
    Ok(())
}

/// The parser's own error, with its place as bytes.
fn malformed(source: &Source, error: &Error) -> RobotError {
    let text = source.text();
    let pos = error.pos();
    if let Error::UnknownNamespace(prefix, _) = error
        && prefix == "xacro"
    {
        return xacro(source, point(text, pos));
    }
    let (at, help) = match error {
        Error::DtdDetected => {
            let start = text.find("<!DOCTYPE").unwrap_or(0);
            let end = text.len().min(start + "<!DOCTYPE".len());
            (
                start..end,
                Some("remove the document type: a URDF needs none"),
            )
        }
        Error::NoRootNode => (0..0, Some("a URDF is one `<robot name=\"...\">` element")),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => (
            text.len()..text.len(),
            Some("an element, a comment or a text in quotes is opened and never closed"),
        ),
        Error::UnexpectedCloseTag(..) => (
            point(text, pos),
            Some("close elements in the order they were opened"),
        ),
        _ => (point(text, pos), None),
    };
    let message = error.to_string();
    // the place is said by the caret
    let place = format!(" at {pos}");
    let message = format!("not well-formed XML: {}", message.replacen(&place, "", 1));
    RobotError::new(problem(message, "here", help), source, at)
}

/// A line and a column, both from one, as a place in the text.
fn point(text: &str, pos: roxmltree::TextPos) -> Range<usize> {
    let mut start = 0;
    for _ in 1..pos.row {
        match text[start..].find('\n') {
            Some(length) => start += length + 1,
            None => break,
        }
    }
    let line = text[start..].split('\n').next().unwrap_or("");
    let column = (pos.col as usize).saturating_sub(1);
    let (inside, length) = line
        .char_indices()
        .nth(column)
        .map_or((line.len(), 0), |(i, c)| (i, c.len_utf8()));
    start + inside..start + inside + length
}

fn xacro(source: &Source, at: Range<usize>) -> RobotError {
    let problem = problem(
        "this is a xacro file, not yet a URDF".to_owned(),
        "xacro has to fill this in",
        Some("run xacro first: `xacro robot.urdf.xacro > robot.urdf`"),
    );
    RobotError::new(problem, source, at)
}

/// Finds the first element of xacro, or the first `${...}` or `$(...)` in a link or a joint.
fn refuse_xacro(source: &Source, document: &Document<'_>) -> Result<(), RobotError> {
    let is_xacro = |node: Node<'_>| {
        let namespace = node.tag_name().namespace();
        namespace.is_some_and(|uri| uri.contains("xacro"))
    };
    if let Some(node) = document.descendants().find(|node| is_xacro(*node)) {
        return Err(xacro(source, Reader::tag(node)));
    }
    let root = document.root_element();
    // extensions of simulators may keep `$(...)` for their own use
    let parts = super::reader::elements(root)
        .filter(|node| matches!(node.tag_name().name(), "link" | "joint"))
        .flat_map(|part| part.descendants());
    for node in std::iter::once(root).chain(parts) {
        for attribute in node.attributes() {
            if attribute.value().contains("${") || attribute.value().contains("$(") {
                return Err(xacro(source, attribute.range_value()));
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
            _ => "a URDF is one `<robot name=\"...\">` element",
        };
        let problem = problem(
            format!("the root element is `<{found}>`, not `<robot>`"),
            "expected `<robot>`",
            Some(help),
        );
        return reader.err(Reader::tag(root), problem);
    }
    let name = reader.required(root, "name", "the robot")?;
    if name.get_ref().trim().is_empty() {
        let problem = problem(
            "the robot's name is empty".to_owned(),
            "this name",
            Some("give the robot a name"),
        );
        return reader.err(name.span(), problem);
    }
    Ok(name)
}
