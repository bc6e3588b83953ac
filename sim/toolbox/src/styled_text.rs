//! Text with emphasis. Which colours that means is up to whoever shows it.

use std::fmt;

/// What a part of a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emphasis {
    /// Plain text.
    Plain,
    /// A name that the text is about.
    Strong,
    /// A label, or a detail that most readers skip.
    Faint,
    /// An error.
    Error,
    /// A warning.
    Warning,
    /// A note.
    Note,
}

/// A text in parts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StyledText {
    parts: Vec<(Emphasis, String)>,
}

impl StyledText {
    /// Appends a part.
    pub fn push(&mut self, emphasis: Emphasis, text: impl Into<String>) {
        self.parts.push((emphasis, text.into()));
    }

    /// Appends plain text.
    pub fn plain(&mut self, text: impl Into<String>) {
        self.push(Emphasis::Plain, text);
    }

    /// Appends another text.
    pub fn append(&mut self, other: Self) {
        self.parts.extend(other.parts);
    }

    /// The parts in their order.
    pub fn parts(&self) -> impl Iterator<Item = (Emphasis, &str)> {
        self.parts
            .iter()
            .map(|(emphasis, text)| (*emphasis, text.as_str()))
    }
}

impl fmt::Display for StyledText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.parts
            .iter()
            .try_for_each(|(_, text)| f.write_str(text))
    }
}
