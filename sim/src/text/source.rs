//! Text from outside, and errors that point into it: the file, the line, the column, and what to do next.

use std::fmt;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};

/// A text and the name under which messages refer to it (`robots/rrbot.toml`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    name: Arc<str>,
    text: Arc<str>,
}

impl Source {
    /// Keeps `text` under `name`.
    pub fn new(name: impl Into<Arc<str>>, text: impl Into<Arc<str>>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
        }
    }

    /// The name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Line and column of a byte offset, both from one, the column in characters.
    pub fn line_and_column(&self, offset: usize) -> (usize, usize) {
        let mut end = offset.min(self.text.len());
        while !self.text.is_char_boundary(end) {
            end -= 1;
        }
        let before = &self.text[..end];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        (line, column)
    }
}

/// An error in a text of one kind: a short message, what to do, and a code for machines.
pub trait Problem: fmt::Debug + fmt::Display + Send + Sync + 'static {
    /// Stable name of the problem, such as `robot::unknown_link`.
    fn code(&self) -> &'static str;
    /// The label under the caret.
    fn label(&self) -> String;
    /// What to do, if there is more to say than the label.
    fn help(&self) -> Option<String>;
}

impl Problem for Box<dyn Problem> {
    fn code(&self) -> &'static str {
        self.as_ref().code()
    }

    fn label(&self) -> String {
        self.as_ref().label()
    }

    fn help(&self) -> Option<String> {
        self.as_ref().help()
    }
}

/// A [`Problem`] with its position in a [`Source`].
#[derive(Debug)]
pub struct Located<P> {
    /// What is wrong.
    pub problem: P,
    inner: Box<Place<P>>,
}

/// Where a problem is, and what else is wrong there; apart from the problem, so that a result that may be one stays small.
#[derive(Debug)]
struct Place<P> {
    excerpt: SourceExcerpt,
    others: Vec<Located<P>>,
}

#[derive(Debug)]
struct SourceExcerpt {
    source: Source,
    named: NamedSource<Arc<str>>,
    at: SourceSpan,
}

impl<P> Located<P> {
    /// Puts `problem` at the bytes `at` of `source`.
    pub fn new(problem: P, source: &Source, at: std::ops::Range<usize>) -> Self {
        let named = NamedSource::new(source.name(), Arc::clone(&source.text));
        Self {
            problem,
            inner: Box::new(Place {
                excerpt: SourceExcerpt {
                    source: source.clone(),
                    named,
                    at: (at.start, at.end.saturating_sub(at.start)).into(),
                },
                others: Vec::new(),
            }),
        }
    }

    /// The first of `all` in the text, with the rest of them behind it; `None` if there is none.
    pub fn first_of(mut all: Vec<Self>) -> Option<Self> {
        all.sort_by_key(|one| one.inner.excerpt.at.offset());
        let mut all = all.into_iter();
        let mut first = all.next()?;
        for one in all {
            first.push(one);
        }
        Some(first)
    }

    fn push(&mut self, mut other: Self) {
        let behind = std::mem::take(&mut other.inner.others);
        self.inner.others.push(other);
        self.inner.others.extend(behind);
    }

    /// Problems of the same text beside this one, in its order.
    pub fn others(&self) -> &[Self] {
        &self.inner.others
    }

    /// The same positions with each problem replaced by `words(problem)`.
    pub fn map<Q>(self, mut words: impl FnMut(P) -> Q) -> Located<Q> {
        self.mapped(&mut words)
    }

    fn mapped<Q>(self, words: &mut impl FnMut(P) -> Q) -> Located<Q> {
        let Place { excerpt, others } = *self.inner;
        let problem = words(self.problem);
        let others = others.into_iter().map(|other| other.mapped(words));
        let others = others.collect();
        Located {
            problem,
            inner: Box::new(Place { excerpt, others }),
        }
    }

    /// The text that holds the problem.
    pub fn source(&self) -> &Source {
        &self.inner.excerpt.source
    }

    /// Line and column where the problem starts, both from one.
    pub fn line_and_column(&self) -> (usize, usize) {
        let SourceExcerpt { source, at, .. } = &self.inner.excerpt;
        source.line_and_column(at.offset())
    }
}

impl<P: Problem> fmt::Display for Located<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.problem, f)
    }
}

impl<P: Problem> std::error::Error for Located<P> {}

impl<P: Problem> Diagnostic for Located<P> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.problem.code()))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.problem.help().map(|help| Box::new(help) as Box<_>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.inner.excerpt.named)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = LabeledSpan::new_with_span(Some(self.problem.label()), self.inner.excerpt.at);
        Some(Box::new(std::iter::once(label)))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let others = self.others().iter();
        if others.len() == 0 {
            return None;
        }
        Some(Box::new(others.map(|other| other as &dyn Diagnostic)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_not_bytes() {
        let source = Source::new("x", "a\nü = 1");
        assert_eq!(source.line_and_column("a\nü".len()), (2, 2));
    }
}
