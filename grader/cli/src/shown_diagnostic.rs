//! A diagnostic as a terminal may show it: characters that hide or steer are written out, and of a long line only what is around the
//! places that are meant is quoted, with the caret below it.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;

use kinemark_report::visible::visible;
use kinemark_sim::text::CutLine;
use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, Severity, SourceCode, SourceSpan,
    SpanContents,
};

/// Lines that are shown before and after a place.
const CONTEXT: usize = 1;
/// Lines of a message, and of one place, that are shown: a table of a file may have hundreds.
const MOST_LINES: usize = 24;
/// Characters of one word: more than paths that people type have, and less than a screen.
const LONGEST_WORD: usize = 400;
/// Characters of one line of a message.
const LONGEST_LINE: usize = 2_000;

/// What a message says, in one line for a terminal: names in it may be a student's, and none is endless.
pub(crate) fn words(text: &str) -> String {
    let words: Vec<String> = visible(text).split(' ').map(short_word).collect();
    let line = words.join(" ");
    match line.char_indices().nth(LONGEST_LINE) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

/// The same for a message that may have several lines: each is shown below the others and behind the margin of the diagnostic, so that
/// none can be taken for something else.
pub(crate) fn lines(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').take(MOST_LINES).map(words).collect();
    lines.join("\n")
}

/// A word without its middle, where it is longer than a person reads.
fn short_word(word: &str) -> String {
    if word.chars().nth(LONGEST_WORD).is_none() {
        return word.to_owned();
    }
    let half = LONGEST_WORD / 2;
    let head = word.char_indices().nth(half).map_or(0, |(at, _)| at);
    let tail = word.char_indices().nth_back(half - 1);
    let tail = tail.map_or(word.len(), |(at, _)| at);
    format!("{}…{}", &word[..head], &word[tail..])
}

/// A diagnostic, with all that it says and quotes as a terminal may show it.
#[derive(Debug)]
pub(crate) struct ShownDiagnostic {
    message: String,
    code: Option<String>,
    help: Option<String>,
    severity: Option<Severity>,
    excerpt: Option<Excerpt>,
    labels: Vec<LabeledSpan>,
    cause: Option<Cause>,
    related: Vec<Self>,
}

/// What a diagnostic comes from.
#[derive(Debug)]
enum Cause {
    Diagnostic(Box<ShownDiagnostic>),
    Error(Box<ShownDiagnostic>),
}

impl ShownDiagnostic {
    /// What may be shown of `diagnostic`.
    pub(crate) fn of(diagnostic: &dyn Diagnostic) -> Self {
        Self::inside(diagnostic, None)
    }

    /// The same for one inside another, whose text it may point into.
    fn inside(diagnostic: &dyn Diagnostic, source: Option<&dyn SourceCode>) -> Self {
        let source = diagnostic.source_code().or(source);
        let labels: Vec<LabeledSpan> = diagnostic.labels().into_iter().flatten().collect();
        let (excerpt, labels) = match source {
            Some(source) => Excerpt::of(source, &labels),
            None => (None, Vec::new()),
        };
        let cause = match (diagnostic.diagnostic_source(), diagnostic.source()) {
            (Some(cause), _) => Some(Cause::Diagnostic(Box::new(Self::inside(cause, source)))),
            (None, Some(cause)) => Some(Cause::Error(Box::new(Self::of_error(cause)))),
            (None, None) => None,
        };
        let related = diagnostic.related().into_iter().flatten();
        Self {
            message: lines(&diagnostic.to_string()),
            code: diagnostic.code().map(|code| words(&code.to_string())),
            help: diagnostic.help().map(|help| lines(&help.to_string())),
            severity: diagnostic.severity(),
            excerpt,
            labels,
            cause,
            related: related.map(|inner| Self::inside(inner, source)).collect(),
        }
    }

    /// An error that has nothing but a message.
    fn of_error(error: &dyn Error) -> Self {
        let cause = error.source();
        Self {
            message: lines(&error.to_string()),
            code: None,
            help: None,
            severity: None,
            excerpt: None,
            labels: Vec::new(),
            cause: cause.map(|cause| Cause::Error(Box::new(Self::of_error(cause)))),
            related: Vec::new(),
        }
    }
}

impl fmt::Display for ShownDiagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for ShownDiagnostic {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match &self.cause {
            Some(Cause::Error(error)) => Some(error.as_ref()),
            Some(Cause::Diagnostic(_)) | None => None,
        }
    }
}

impl Diagnostic for ShownDiagnostic {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.code.as_ref().map(|code| Box::new(code) as Box<_>)
    }

    fn severity(&self) -> Option<Severity> {
        self.severity
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<_>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        let excerpt = self.excerpt.as_ref()?;
        Some(excerpt)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let related = self.related.iter();
        Some(Box::new(related.map(|inner| inner as &dyn Diagnostic)))
    }

    fn diagnostic_source(&self) -> Option<&dyn Diagnostic> {
        match &self.cause {
            Some(Cause::Diagnostic(cause)) => Some(cause.as_ref()),
            Some(Cause::Error(_)) | None => None,
        }
    }
}

/// The lines of a text that labels need, as they are shown; all others are empty, so that each keeps its number.
#[derive(Debug)]
struct Excerpt {
    name: Option<String>,
    text: String,
    /// The columns of the labels in the text as it is, in characters from zero, by where they are in the shown one.
    columns: BTreeMap<usize, usize>,
}

/// A place in a text: its line from zero, and the byte in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    line: usize,
    at: usize,
}

impl Place {
    fn of(text: &str, offset: usize) -> Self {
        let before = &text.as_bytes()[..offset.min(text.len())];
        let start = before.iter().rposition(|byte| *byte == b'\n');
        Self {
            line: before.iter().filter(|byte| **byte == b'\n').count(),
            at: before.len() - start.map_or(0, |newline| newline + 1),
        }
    }
}

impl Excerpt {
    /// What `labels` need of `source`, and they in it. A label outside of the text is left out.
    fn of(source: &dyn SourceCode, labels: &[LabeledSpan]) -> (Option<Self>, Vec<LabeledSpan>) {
        // the text from its beginning to the line behind the label
        let read = |end: usize| source.read_span(&(0, end).into(), CONTEXT, CONTEXT).ok();
        let end_of = |label: &LabeledSpan| label.offset().saturating_add(label.len());
        let known = labels.iter().filter(|label| read(end_of(label)).is_some());
        let known: Vec<&LabeledSpan> = known.collect();
        let end = known.iter().map(|label| end_of(label)).max();
        let Some(contents) = end.and_then(read) else {
            return (None, Vec::new());
        };
        let text = String::from_utf8_lossy(contents.data());
        let places: Vec<[Place; 2]> = known
            .iter()
            .map(|label| [label.offset(), end_of(label)].map(|offset| Place::of(&text, offset)))
            .map(|[start, end]| {
                let last = Place {
                    line: start.line + MOST_LINES - 1,
                    at: usize::MAX,
                };
                [start, end.min(last)]
            })
            .collect();
        let shown = ShownLines::of(&text, &places);
        let mut columns = BTreeMap::new();
        let labels = known.iter().zip(&places).map(|(label, places)| {
            let [start, end] = places.map(|place| shown.offset(place));
            columns.insert(start, shown.column(places[0]));
            let words = label.label().map(words);
            let span = SourceSpan::from((start, end.saturating_sub(start)));
            match label.primary() {
                true => LabeledSpan::new_primary_with_span(words, span),
                false => LabeledSpan::new_with_span(words, span),
            }
        });
        let labels = labels.collect();
        let excerpt = Self {
            name: contents.name().map(words),
            text: shown.text,
            columns,
        };
        (Some(excerpt), labels)
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let inner = self.text.read_span(span, before, after)?;
        let column = self.columns.get(&span.offset()).filter(|_| before == 0);
        let column = column.copied().unwrap_or_else(|| inner.column());
        let (data, span) = (inner.data(), *inner.span());
        let (line, count) = (inner.line(), inner.line_count());
        Ok(Box::new(match &self.name {
            Some(name) => {
                MietteSpanContents::new_named(name.clone(), data, span, line, column, count)
            }
            None => MietteSpanContents::new(data, span, line, column, count),
        }))
    }
}

/// A text of which only some lines are there.
struct ShownLines {
    text: String,
    /// Where places are in it, and their columns in the whole text.
    places: BTreeMap<Place, (usize, usize)>,
}

impl ShownLines {
    /// The lines of `text` that `places`, from one to another, need.
    fn of(text: &str, places: &[[Place; 2]]) -> Self {
        let mut wanted: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for [start, end] in places {
            for line in start.line.saturating_sub(CONTEXT)..=end.line + CONTEXT {
                wanted.entry(line).or_default();
            }
            for place in [start, end] {
                wanted.entry(place.line).or_default().push(place.at);
            }
        }
        // a place that goes on behind the last line that is shown of it
        let cut = places.iter().filter(|[_, end]| end.at == usize::MAX);
        let cut: Vec<usize> = cut.map(|[_, end]| end.line + CONTEXT).collect();
        let mut shown = Self {
            text: String::new(),
            places: BTreeMap::new(),
        };
        for (number, line) in text.split('\n').enumerate() {
            if number > 0 {
                shown.text.push('\n');
            }
            if let Some(places) = wanted.get(&number) {
                let is_cut = cut.contains(&number) && places.is_empty();
                shown.push(number, if is_cut { "…" } else { line }, places);
            }
        }
        shown
    }

    fn push(&mut self, number: usize, line: &str, places: &[usize]) {
        let line = line.strip_suffix('\r').unwrap_or(line);
        let cut = CutLine::around(line, places);
        let shown = |part: &str| visible(part).into_owned();
        for at in places {
            let place = Place {
                line: number,
                at: *at,
            };
            let before = line.floor_char_boundary((*at).min(line.len()));
            let column = line[..before].chars().count();
            let offset = self.text.len() + cut.before(*at, shown).len();
            self.places.insert(place, (offset, column));
        }
        self.text += &cut.text(shown);
    }

    /// Where a place is in the shown text.
    fn offset(&self, place: Place) -> usize {
        let known = self.places.get(&place);
        known.map_or(self.text.len(), |(offset, _)| *offset)
    }

    /// The column of a place in the whole text.
    fn column(&self, place: Place) -> usize {
        self.places.get(&place).map_or(0, |(_, column)| *column)
    }
}

#[cfg(test)]
mod tests {
    use miette::NamedSource;

    use super::*;
    use crate::failure::rendered;

    /// A diagnostic of a text with places in it.
    #[derive(Debug, thiserror::Error)]
    #[error("{message}")]
    struct Sample {
        message: String,
        source_code: NamedSource<String>,
        labels: Vec<LabeledSpan>,
    }

    impl Diagnostic for Sample {
        fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
            Some(Box::new("see \u{1b}[2Jhere"))
        }

        fn source_code(&self) -> Option<&dyn SourceCode> {
            Some(&self.source_code)
        }

        fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
            Some(Box::new(self.labels.iter().cloned()))
        }
    }

    fn shown(text: &str, labels: &[(usize, usize)]) -> String {
        let labels = labels.iter().enumerate().map(|(i, (at, len))| {
            let label = Some(format!("place {i}"));
            LabeledSpan::new_with_span(label, (*at, *len))
        });
        let sample = Sample {
            message: "no".to_owned(),
            source_code: NamedSource::new("a.toml", text.to_owned()),
            labels: labels.collect(),
        };
        let text = rendered(&sample);
        anstream::adapter::strip_str(&text).to_string()
    }

    /// The characters of the line of source that stand above those that underline it.
    fn underlined(shown: &str) -> String {
        let lines: Vec<Vec<char>> = shown.lines().map(|line| line.chars().collect()).collect();
        let is_mark = |c: &char| matches!(c, '─' | '┬' | '▲');
        let below = lines.windows(2).find_map(|pair| {
            let first = pair[1].get(3).filter(|c| **c == '·');
            first.map(|_| (&pair[0], &pair[1]))
        });
        let (source, marks) = below.expect("a line below a source");
        let marked = marks.iter().enumerate().filter(|(_, c)| is_mark(c));
        marked
            .map(|(i, _)| source.get(i).copied().unwrap_or(' '))
            .collect()
    }

    #[test]
    fn a_place_far_in_an_endless_line_is_shown_with_what_is_around_it() {
        let text = format!(
            "a = 1\n{}HERE{}\nb",
            " x".repeat(4 << 20),
            "y ".repeat(4 << 20)
        );
        let shown = shown(&text, &[(6 + (8 << 20), 4)]);
        assert!(shown.contains("[a.toml:2:8388609]"), "{shown}");
        assert_eq!(underlined(&shown), "HERE", "{shown}");
        assert!(
            shown.lines().all(|line| line.chars().count() < 180),
            "{shown}"
        );
        assert!(
            shown.contains("… x x") && shown.contains("y y …"),
            "{shown}"
        );
    }

    #[test]
    fn several_places_of_one_line_are_shown_with_gaps_between_them() {
        let text = format!(
            "{}FIRST{}SECOND{}",
            "a".repeat(900),
            "b".repeat(900),
            "c".repeat(900)
        );
        let shown = shown(&text, &[(900, 5), (1805, 6)]);
        assert_eq!(underlined(&shown), "FIRSTSECOND", "{shown}");
        assert_eq!(shown.matches('…').count(), 3, "{shown}");
        assert!(
            shown.contains("place 0") && shown.contains("place 1"),
            "{shown}"
        );
    }

    #[test]
    fn a_place_of_many_lines_ends_where_a_person_stops_reading() {
        let text = "line\n".repeat(500);
        let shown = shown(&text, &[(10, 2_000)]);
        assert!(
            shown.contains("\n 26 │ ") && shown.contains("│   line"),
            "{shown}"
        );
        assert!(shown.lines().count() < 40, "{shown}");
        assert!(shown.contains("27 │") && shown.contains('…'), "{shown}");
        assert!(shown.contains("place 0"), "{shown}");
    }

    #[test]
    fn columns_are_those_of_the_file_and_carets_those_of_what_is_shown() {
        let text = "x = 1\r\n\u{1b}[31m\u{202e}日\t= WRONG\r\ny\r\n";
        let at = text.find("WRONG").unwrap();
        let shown = shown(text, &[(at, 5)]);
        // escape, [31m, override, 日, tab, =, space
        assert!(shown.contains("[a.toml:2:11]"), "{shown}");
        assert!(
            shown.contains("⟨U+001B⟩[31m⟨U+202E⟩日    = WRONG\n"),
            "{shown}"
        );
        // one character that is two columns wide stands before it
        assert_eq!(underlined(&shown), "RONG ", "{shown}");
        assert!(shown.contains("see ⟨U+001B⟩[2Jhere"), "{shown}");
    }

    #[test]
    fn names_are_written_out_and_no_word_is_endless() {
        assert_eq!(words("a\nb\u{200b}\u{1b}c"), "a⏎b⟨U+200B⟩⟨U+001B⟩c");
        assert_eq!(lines("a\nb\u{1b}c"), "a\nb⟨U+001B⟩c");
        let path = format!("/{}", "folder/".repeat(50));
        assert_eq!(words(&path), path);
        let key = "z".repeat(70_000);
        let message = words(&format!("unknown key `{key}` here"));
        assert!(message.starts_with("unknown key `zzz") && message.ends_with("zzz` here"));
        assert_eq!(message.chars().count(), 17 + LONGEST_WORD + 1);
        assert_eq!(
            words(&"z ".repeat(70_000)).chars().count(),
            LONGEST_LINE + 1
        );
    }

    #[test]
    fn no_text_and_no_place_is_too_odd() {
        let long = format!("é{}\r\n\r{}", "\u{301}".repeat(300), "\t\u{0}".repeat(300));
        for text in [
            "",
            "\n",
            "a",
            "a\n",
            "a\r\n",
            "\r\r\n",
            "日\u{202e}\n\n",
            &long,
        ] {
            for at in 0..text.len() + 3 {
                for length in [0, 1, 2, 7, 700] {
                    let shown = shown(text, &[(at, length), (at / 2, 1), (0, 0)]);
                    let is_plain = |c: char| c == '\n' || !c.is_control();
                    assert!(shown.chars().all(is_plain), "{shown:?}");
                    assert!(shown.starts_with("  × no\n"), "{shown:?}");
                }
            }
        }
    }
}
