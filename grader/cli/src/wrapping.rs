//! Lines for a terminal: as wide as it is, with what goes over below the words of its line, and with nothing taken apart that belongs
//! together: names, options, paths, and numbers with their units.

use std::io::IsTerminal;

use textwrap::core::Word;
use textwrap::{Options, WordSeparator, WordSplitter};

/// A narrower terminal wraps by itself as well as anybody could.
const LEAST_COLUMNS: usize = 40;
/// How wide a terminal is that does not say so.
const USUAL_COLUMNS: usize = 80;

/// How wide `stream` is, if it is a terminal in which lines can be wrapped.
pub(crate) fn columns(stream: &impl IsTerminal) -> Option<usize> {
    stream.is_terminal().then(|| {
        let known = terminal_size::terminal_size();
        known.map_or(USUAL_COLUMNS, |(terminal_size::Width(columns), _)| {
            columns.into()
        })
    })
}

/// `text` in lines of at most `columns`. What goes over stands below the words of its line: below the text behind `next: `, or in the
/// last column of a table.
pub(crate) fn wrapped(text: &str, columns: usize) -> String {
    if columns < LEAST_COLUMNS {
        return text.to_owned();
    }
    let wrap = |line: &str| {
        let hanging = " ".repeat(hanging(line, columns));
        let options = Options::new(columns)
            .subsequent_indent(&hanging)
            .word_separator(separator())
            .word_splitter(WordSplitter::NoHyphenation)
            .break_words(false);
        textwrap::fill(line, options)
    };
    let lines: Vec<String> = text.split('\n').map(wrap).collect();
    lines.join("\n")
}

/// Parts lines where a line may end.
pub(crate) fn separator() -> WordSeparator {
    WordSeparator::Custom(parts)
}

/// How far the lines after the first are indented.
fn hanging(line: &str, columns: usize) -> usize {
    let line = anstream::adapter::strip_str(line).to_string();
    let words = line.trim_start_matches(' ');
    let indent = line.len() - words.len();
    let labels = [
        "next: ",
        "also: ",
        "likely: ",
        "stopped: ",
        "inaccurate: ",
        "first differs ",
        "report: ",
        "look here first: ",
    ];
    let label = labels.iter().find(|label| words.starts_with(**label));
    let behind_label = label.map(|label| indent + label.len());
    let hanging = behind_label.or_else(|| last_column(&line, columns / 2));
    // a line that is mostly indent would be a column of single words
    hanging.unwrap_or(indent).min(columns / 2)
}

/// Where the last column of a row of a table begins, if that is before `most`: columns are parted by two blanks or more.
fn last_column(line: &str, most: usize) -> Option<usize> {
    let begins = |(at, blanks): (usize, &str)| at + blanks.len();
    let gaps = line.match_indices("  ").map(begins);
    let gaps = gaps.filter(|at| line.as_bytes().get(*at).is_some_and(|byte| *byte != b' '));
    let width = |at: usize| textwrap::core::display_width(&line[..at]);
    gaps.map(width).filter(|column| *column <= most).last()
}

/// The parts of a line between which it may end, as [`Word`]s.
fn parts(line: &str) -> Box<dyn Iterator<Item = Word<'_>> + '_> {
    let mut parts = Vec::new();
    let mut together = Together::default();
    let mut begin = 0;
    let mut end = 0;
    for word in WordSeparator::AsciiSpace.find_words(line) {
        let may_end = !together.goes_on(&word);
        end += word.word.len() + word.whitespace.len();
        if may_end {
            parts.push(Word::from(&line[begin..end]));
            begin = end;
        }
    }
    if begin < end {
        parts.push(Word::from(&line[begin..end]));
    }
    Box::new(parts.into_iter())
}

/// Longer quotations and vectors may be taken apart: a terminal must have room for other words.
const LONGEST_TOGETHER: usize = 36;

/// What belongs together so far.
#[derive(Debug, Default)]
struct Together {
    /// What closes what was opened: a quotation or a vector.
    closing: Option<char>,
    /// The width since then.
    width: usize,
}

impl Together {
    /// Whether a line must not end behind `word`: a number has its unit behind it; a vector and a quoted command are one thing.
    fn goes_on(&mut self, word: &Word<'_>) -> bool {
        let text = anstream::adapter::strip_str(word.word).to_string();
        if self.closing.is_none() {
            self.closing = opened(&text);
            self.width = 0;
        }
        if let Some(closing) = self.closing {
            self.width += text.chars().count() + 1;
            let is_closed = text.contains(closing) && opened(&text).is_none();
            if is_closed || self.width > LONGEST_TOGETHER {
                self.closing = None;
            } else {
                return true;
            }
        }
        is_number(&text)
    }
}

/// What closes the quotation, the command or the vector that a word opens and does not close.
fn opened(text: &str) -> Option<char> {
    if text.matches('`').count() % 2 == 1 && text.trim_start_matches(['(', '"']).starts_with('`') {
        return Some('`');
    }
    if text == "(kinemark" {
        return Some(')');
    }
    let number = text.strip_prefix('[').filter(|rest| !rest.contains(']'))?;
    is_number(number.trim_end_matches(',')).then_some(']')
}

/// Whether a word is a number, or ends a vector.
fn is_number(text: &str) -> bool {
    let digits = text.trim_start_matches(['(', '[', '-', '+', '\u{2212}', '\u{b1}']);
    let digits = digits.trim_end_matches(']');
    digits.starts_with(|first: char| first.is_ascii_digit())
        && digits
            .chars()
            .all(|part| part.is_ascii_digit() || matches!(part, '.' | 'e' | '-'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_stands_below_its_words() {
        let text = "  + 2/2  short\n      next: \u{1b}[2mlook where the arm\u{1b}[0m stands at the end of the run\n";
        assert_eq!(
            wrapped(text, 40),
            "  + 2/2  short\n      next: \u{1b}[2mlook where the arm\u{1b}[0m stands at\n            the end of the run\n"
        );
        // a link is not taken apart
        let link = "      look here first: out/report.html#task=knock&t=6.0512345";
        assert!(
            wrapped(link, 40)
                .contains("\n                    out/report.html#task=knock&t=6.0512345")
        );
    }

    #[test]
    fn the_last_column_of_a_row_goes_on_below_itself() {
        let row = "  -       0/3  On the second line of the path that is followed";
        assert_eq!(
            wrapped(row, 40),
            "  -       0/3  On the second line of the\n               path that is followed"
        );
    }

    /// Every width from the least on, so that each break that can be made is made.
    #[test]
    fn what_belongs_together_is_not_taken_apart() {
        let line = "of 04-knock-with-velocity, from [2, 1.4, 0.05] m to 30.2 mm, 0 % is covered within -50.0 mm (`kinemark hint fk/near`) of 0.650 m/s  (kinemark hint fk/far)";
        let whole = [
            "04-knock-with-velocity,",
            "[2, 1.4, 0.05] m",
            "30.2 mm,",
            "0 %",
            "-50.0 mm",
            "(`kinemark hint fk/near`)",
            "0.650 m/s",
            "(kinemark hint fk/far)",
        ];
        for columns in LEAST_COLUMNS..140 {
            let text = wrapped(line, columns);
            for part in whole {
                assert!(text.contains(part), "{columns}: {text}");
            }
            let widest = text.lines().map(str::len).max();
            assert!(widest <= Some(columns), "{columns}: {text}");
        }
    }

    #[test]
    fn a_quotation_without_an_end_goes_on_as_other_words_do() {
        let line = format!("`{}", "word ".repeat(40));
        let text = wrapped(&line, 60);
        assert!(text.lines().all(|line| line.len() <= 60), "{text}");
    }

    #[test]
    fn a_narrow_terminal_wraps_by_itself() {
        let line = "word ".repeat(20);
        assert_eq!(wrapped(&line, LEAST_COLUMNS - 1), line);
    }
}
