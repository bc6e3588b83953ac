//! Elements and attributes of an XML document: what is there, what is missing, numbers, and warnings, each with its place.

use std::ops::Range;

use roxmltree::Attribute;

use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::part::part_problem::PartProblem;
use crate::part::values::Allowed;
use crate::text::{Source, Spanned, nearest};

/// An element of the document.
pub(in crate::format) type Node<'a> = roxmltree::Node<'a, 'a>;

/// After this many warnings the rest are counted: a text of slips would cost its own square.
const MOST_WARNINGS: usize = 100;
/// A warning is cut after this many characters, for names of a size that only a broken file has.
const LONGEST_WARNING: usize = 400;
/// A name, a word or a path has at most this many bytes: messages repeat them.
const LONGEST_TEXT: usize = 1000;

/// The words of one format for what is wrong with its documents.
pub(in crate::format) struct Dialect {
    /// The code of its problems, such as `robot::urdf`.
    pub(in crate::format) code: &'static str,
    /// What messages call a document, with its article.
    pub(in crate::format) name: &'static str,
    /// What its root element is, as a sentence.
    pub(in crate::format) root: &'static str,
    /// What is wrong with a document whose elements have this prefix, which nothing declares, if that says something.
    pub(in crate::format) unbound: fn(&str) -> Option<RobotProblem>,
}

impl Dialect {
    /// A problem that only documents of this format have.
    pub(in crate::format) fn problem(
        &self,
        message: String,
        label: &str,
        help: Option<&str>,
    ) -> RobotProblem {
        RobotProblem::Own {
            code: self.code,
            message,
            label: label.to_owned(),
            help: help.map(str::to_owned),
        }
    }
}

/// Reads elements of one text and collects warnings.
pub(in crate::format) struct Reader<'s> {
    source: &'s Source,
    dialect: &'static Dialect,
    warnings: Vec<String>,
    /// Warnings so far, those that were not kept too.
    given: usize,
}

/// The child elements of the format itself, without those of other namespaces than their parent's.
pub(in crate::format) fn elements<'a>(node: Node<'a>) -> impl Iterator<Item = Node<'a>> {
    node.children().filter(move |child| {
        child.is_element() && child.tag_name().namespace() == node.tag_name().namespace()
    })
}

impl<'s> Reader<'s> {
    pub(in crate::format) fn new(source: &'s Source, dialect: &'static Dialect) -> Self {
        Self {
            source,
            dialect,
            warnings: Vec::new(),
            given: 0,
        }
    }

    pub(in crate::format) fn err<T>(
        &self,
        at: Range<usize>,
        problem: impl Into<RobotProblem>,
    ) -> Result<T, RobotError> {
        Err(RobotError::new(problem.into(), self.source, at))
    }

    /// A problem that only documents of this format have.
    pub(in crate::format) fn refuse<T>(
        &self,
        at: Range<usize>,
        message: String,
        label: &str,
        help: &str,
    ) -> Result<T, RobotError> {
        self.err(at, self.dialect.problem(message, label, Some(help)))
    }

    /// The bytes of `<name` where an element starts.
    pub(in crate::format) fn tag(node: Node<'_>) -> Range<usize> {
        let range = node.range();
        let end = range.start + 1 + node.tag_name().name().len();
        range.start..end.min(range.end)
    }

    /// Whether a warning more would only be counted; counts it then.
    fn is_full(&mut self) -> bool {
        let full = self.given >= MOST_WARNINGS;
        self.given += usize::from(full);
        full
    }

    /// Keeps a warning, once, with its line.
    pub(in crate::format) fn warn(&mut self, at: Range<usize>, message: &str) {
        if self.is_full() {
            return;
        }
        self.given += 1;
        let mut message: String = message.chars().take(LONGEST_WARNING).collect();
        let (line, _) = self.source.line_and_column(at.start);
        message += &format!(" (line {line})");
        if !self.warnings.contains(&message) {
            self.warnings.push(message);
        }
    }

    pub(in crate::format) fn into_warnings(mut self) -> Vec<String> {
        if self.given > MOST_WARNINGS {
            let more = self.given - MOST_WARNINGS;
            self.warnings.push(format!("and {more} more warnings"));
        }
        self.warnings
    }

    /// Warns of attributes and elements that `node` of `owner` is not known to have.
    pub(in crate::format) fn check(
        &mut self,
        node: Node<'_>,
        owner: &str,
        attributes: &[&str],
        children: &[&str],
    ) {
        let tag = node.tag_name().name();
        let or_near = |given: &str, known: &[&str]| match nearest(given, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if known.is_empty() => "none is expected".to_owned(),
            None => format!("known here: {}", known.join(", ")),
        };
        for attribute in node.attributes() {
            let name = attribute.name();
            let is_known = attribute.namespace().is_some() || attributes.contains(&name);
            if !is_known && !self.is_full() {
                let hint = or_near(name, attributes);
                let message =
                    format!("{owner}: unknown attribute `{name}` of `<{tag}>` is left out: {hint}");
                self.warn(attribute.range(), &message);
            }
        }
        for child in elements(node) {
            let name = child.tag_name().name();
            if !children.contains(&name) && !self.is_full() {
                let hint = or_near(name, children);
                let message =
                    format!("{owner}: unknown element `<{name}>` in `<{tag}>` is left out: {hint}");
                self.warn(Self::tag(child), &message);
            }
        }
    }

    /// The element `name` of `node`; warns where there are more.
    pub(in crate::format) fn child<'a>(
        &mut self,
        node: Node<'a>,
        name: &str,
        owner: &str,
    ) -> Option<Node<'a>> {
        let mut all = elements(node).filter(|child| child.tag_name().name() == name);
        let first = all.next()?;
        if let Some(second) = all.next() {
            let message = format!("{owner}: a second `<{name}>` is left out");
            self.warn(Self::tag(second), &message);
        }
        Some(first)
    }

    /// The text of an attribute that must be there.
    pub(in crate::format) fn required(
        &self,
        node: Node<'_>,
        name: &str,
        owner: &str,
    ) -> Result<Spanned<String>, RobotError> {
        match node.attribute_node(name) {
            Some(attribute) if attribute.value().len() > LONGEST_TEXT => self.refuse(
                attribute.range_value(),
                format!(
                    "`{name}` is {} bytes long, more than {LONGEST_TEXT}",
                    attribute.value().len()
                ),
                "too long",
                "shorten it",
            ),
            Some(attribute) => Ok(Spanned::new(
                attribute.range_value(),
                attribute.value().to_owned(),
            )),
            None => {
                let tag = node.tag_name().name();
                self.refuse(
                    Self::tag(node),
                    format!("`<{tag}>` of {owner} has no `{name}`"),
                    "in this element",
                    &format!("add {name}=\"...\""),
                )
            }
        }
    }

    /// One number, or `None` where the attribute is not there.
    pub(in crate::format) fn number(
        &self,
        node: Node<'_>,
        name: &str,
        owner: &str,
        allowed: Allowed,
    ) -> Result<Option<f64>, RobotError> {
        let Some(attribute) = node.attribute_node(name) else {
            return Ok(None);
        };
        let [value] = self.list(&attribute, owner)?;
        if let Some(expected) = allowed.instead_of(value) {
            let problem = PartProblem::OutOfRange {
                what: format!("{} `{name}` of {owner}", node.tag_name().name()),
                expected,
                found: value.to_string(),
            };
            return self.err(attribute.range_value(), problem);
        }
        Ok(Some(value))
    }

    /// Three numbers, or `None` where the attribute is not there.
    pub(in crate::format) fn triple(
        &self,
        node: Node<'_>,
        name: &str,
        owner: &str,
    ) -> Result<Option<[f64; 3]>, RobotError> {
        let attribute = node.attribute_node(name);
        attribute.map(|a| self.list(&a, owner)).transpose()
    }

    fn list<const N: usize>(
        &self,
        attribute: &Attribute<'_, '_>,
        owner: &str,
    ) -> Result<[f64; N], RobotError> {
        let (text, at) = (attribute.value(), attribute.range_value());
        let name = attribute.name();
        let mut numbers = [0.0; N];
        let mut found = 0;
        for word in text.split_whitespace() {
            let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
            let Some(value) = value else {
                let shown: String = word.chars().take(40).collect();
                let help = match word {
                    _ if word.contains(',') => {
                        "separate numbers with spaces, and write decimals with a point"
                    }
                    _ if word.parse::<f64>().is_ok() => "every number of a robot is finite",
                    _ => "write a plain number such as 0.25 or 1e-3, in SI units",
                };
                return self.refuse(
                    self.word(text, word, at),
                    format!("`{name}` of {owner}: `{shown}` is not a finite number"),
                    "not a finite number",
                    help,
                );
            };
            if let Some(place) = numbers.get_mut(found) {
                *place = value;
            }
            found += 1;
        }
        if found == N {
            return Ok(numbers);
        }
        let expected = if N == 1 {
            "one number"
        } else {
            "three numbers"
        };
        self.refuse(
            at,
            format!("`{name}` of {owner} must be {expected}, got {found}"),
            &format!("expected {expected}"),
            "separate numbers with spaces",
        )
    }

    /// Where a word of an attribute stands, or the whole value where the file spells it with entities.
    fn word(&self, text: &str, word: &str, at: Range<usize>) -> Range<usize> {
        if self.source.text().get(at.clone()) != Some(text) {
            return at;
        }
        let start = at.start + (word.as_ptr() as usize - text.as_ptr() as usize);
        start..start + word.len()
    }
}
