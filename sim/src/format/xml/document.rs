//! Text becomes an XML document that is safe to walk, or an error at its place.

use std::ops::Range;

use roxmltree::{Document, Error, ParsingOptions};

use super::reader::Dialect;
use crate::format::robot_problem::RobotError;
use crate::text::Source;

/// A text longer than this \[bytes\] is no description: the largest real ones, mesh data aside, stay below one megabyte.
const MOST_BYTES: usize = 16 << 20;
/// A document may declare this many namespaces; the parser's memory grows with the square of how many are nested.
const MOST_NAMESPACES: usize = 100;
/// An element may have this many attributes; the parser's time grows with their square.
const MOST_ATTRIBUTES: usize = 1000;
/// The parser takes about 70 bytes for each.
const MOST_NODES: u32 = 4_000_000;

/// The name of the element that a text begins with, as far as that can be seen without parsing it; empty for no name, and none
/// where the text is no XML.
pub(in crate::format) fn root_name(text: &str) -> Option<&str> {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    // declarations, comments and document types may stand before it
    let before = [("<?", "?>"), ("<!--", "-->"), ("<!", ">")];
    while let Some((_, end)) = before.iter().find(|(start, _)| rest.starts_with(start)) {
        rest = match rest.split_once(end) {
            Some((_, after)) => after.trim_start(),
            None => return Some(""),
        };
    }
    let name = rest.strip_prefix('<')?;
    name.split(|c: char| c.is_whitespace() || matches!(c, '>' | '/'))
        .next()
}

/// Parses the XML of a format.
pub(in crate::format) fn parse<'s>(
    source: &'s Source,
    dialect: &Dialect,
) -> Result<Document<'s>, RobotError> {
    refuse_bombs(source, dialect)?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        entity_resolver: None,
    };
    Document::parse_with_options(source.text(), options)
        .map_err(|error| malformed(source, dialect, &error))
}

/// Refuses texts on which the parser itself would be slow or large.
fn refuse_bombs(source: &Source, dialect: &Dialect) -> Result<(), RobotError> {
    let text = source.text();
    let name = dialect.name;
    let refuse = |at: Range<usize>, message: String, label: &str| {
        let help = format!("{name} holds links and joints; meshes lie in files of their own");
        let problem = dialect.problem(message, label, Some(&help));
        Err(RobotError::new(problem, source, at))
    };
    if text.len() > MOST_BYTES {
        let message = format!(
            "{} bytes are more than {name} may have ({MOST_BYTES})",
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
fn malformed(source: &Source, dialect: &Dialect, error: &Error) -> RobotError {
    let text = source.text();
    let pos = error.pos();
    if let Error::UnknownNamespace(prefix, _) = error
        && let Some(problem) = (dialect.unbound)(prefix)
    {
        return RobotError::new(problem, source, point(text, pos));
    }
    let dtd = format!("remove the document type: {} needs none", dialect.name);
    let (at, help) = match error {
        Error::DtdDetected => {
            let start = text.find("<!DOCTYPE").unwrap_or(0);
            let end = text.len().min(start + "<!DOCTYPE".len());
            (start..end, Some(dtd.as_str()))
        }
        Error::NoRootNode => (0..0, Some(dialect.root)),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => (
            text.len()..text.len(),
            Some("an element, a comment or a text in quotes is opened and never closed"),
        ),
        Error::UnexpectedCloseTag(..) => (
            point(text, pos),
            Some("close elements in the order they were opened"),
        ),
        // an attribute without its quotes, or without what is before its `=`
        Error::InvalidChar2("a quote", ..)
        | Error::InvalidChar2(_, b'=', _)
        | Error::InvalidChar(b'=', ..) => {
            (point(text, pos), Some("an attribute is name=\"value\""))
        }
        _ => (point(text, pos), None),
    };
    let message = error.to_string();
    // the place is said by the caret
    let place = format!(" at {pos}");
    let message = format!("not well-formed XML: {}", message.replacen(&place, "", 1));
    RobotError::new(dialect.problem(message, "here", help), source, at)
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
