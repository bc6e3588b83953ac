//! A line cut to what is around some places in it: a message quotes lines of any length, and a person reads a few words.

use std::ops::Range;

/// Lines of at most so many characters are shown whole.
const LONGEST: usize = 160;
/// Characters that are shown before a place in a longer line, and after it.
const AROUND: usize = LONGEST / 2;
/// What stands for what is left out.
const LEFT_OUT: char = '…';

/// A line, and which parts of it are shown.
#[derive(Debug, Clone)]
pub struct CutLine<'l> {
    line: &'l str,
    /// The bytes that are shown, in order; they do not touch.
    pieces: Vec<Range<usize>>,
}

impl<'l> CutLine<'l> {
    /// `line` cut to what is around the bytes `places`; without a place it is its beginning that is shown.
    pub fn around(line: &'l str, places: &[usize]) -> Self {
        let whole = 0..line.len();
        if line.chars().nth(LONGEST).is_none() {
            let pieces = Vec::from([whole]);
            return Self { line, pieces };
        }
        let mut places: Vec<usize> = places.iter().map(|at| floor(line, *at)).collect();
        if places.is_empty() {
            // as many characters as around a place
            let middle = line.char_indices().nth(AROUND);
            places.push(middle.map_or(0, |(at, _)| at));
        }
        places.sort_unstable();
        let mut pieces: Vec<Range<usize>> = Vec::new();
        for at in places {
            let mut before = line[..at].char_indices().rev();
            let start = before.nth(AROUND - 1).map_or(0, |(at, _)| at);
            let mut after = line[at..].char_indices();
            let end = after.nth(AROUND).map_or(line.len(), |(off, _)| at + off);
            match pieces.last_mut() {
                Some(last) if last.end >= start => last.end = end,
                _ => pieces.push(start..end),
            }
        }
        Self { line, pieces }
    }

    /// The text, each part of the line as `shown` writes it.
    pub fn text(&self, shown: impl Fn(&str) -> String) -> String {
        let mut text = self.before(self.line.len(), shown);
        let end = self.pieces.last().map_or(0, |last| last.end);
        text.extend((end < self.line.len()).then_some(LEFT_OUT));
        text
    }

    /// The text before the byte `at` of the line, which is one of the places or between two that are shown.
    pub fn before(&self, at: usize, shown: impl Fn(&str) -> String) -> String {
        let at = floor(self.line, at);
        let mut text = String::new();
        let mut end = 0;
        for piece in self.pieces.iter().filter(|piece| piece.start <= at) {
            text.extend((piece.start > end).then_some(LEFT_OUT));
            text += &shown(&self.line[piece.start..piece.end.min(at)]);
            end = piece.end;
        }
        text
    }
}

/// The start of the character at the byte `at`, or the end of the line.
fn floor(line: &str, at: usize) -> usize {
    line.floor_char_boundary(at.min(line.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(line: &str, places: &[usize]) -> String {
        CutLine::around(line, places).text(str::to_owned)
    }

    #[test]
    fn a_short_line_is_whole() {
        let line = "ü".repeat(LONGEST);
        assert_eq!(cut(&line, &[3]), line);
        assert_eq!(cut("", &[0]), "");
    }

    #[test]
    fn a_long_line_is_shown_around_its_places() {
        let line = format!("{}HERE{}", "a".repeat(70_000), "b".repeat(70_000));
        let shown = cut(&line, &[70_000, 70_004]);
        let words = format!("…{}HERE{}…", "a".repeat(AROUND), "b".repeat(AROUND));
        assert_eq!(shown, words);
        let of_line = CutLine::around(&line, &[70_000]);
        let before = of_line.before(70_000, str::to_owned);
        assert_eq!(before, format!("…{}", "a".repeat(AROUND)));
        // its beginning, where nothing in it is meant
        assert_eq!(cut(&line, &[]), format!("{}…", "a".repeat(LONGEST)));
        // far apart, with a gap between them
        let two = cut(&line, &[0, line.len()]);
        let words = format!("{}…{}", "a".repeat(AROUND), "b".repeat(AROUND));
        assert_eq!(two, words);
    }

    #[test]
    fn places_are_between_characters_and_in_the_line() {
        let line = "ü".repeat(1_000);
        for at in [0, 1, 999, 1_999, 2_000, 9_999] {
            let of_line = CutLine::around(&line, &[at]);
            let text = of_line.text(str::to_owned);
            assert!(text.chars().count() <= LONGEST + 2, "{at}");
            let before = of_line.before(at, str::to_owned);
            assert!(text.starts_with(&before), "{at}");
        }
    }

    #[test]
    fn what_is_written_longer_moves_what_is_behind_it() {
        let of_line = CutLine::around("\u{1b}[31m = 3", &[5]);
        let shown = |part: &str| part.replace('\u{1b}', "⟨U+001B⟩");
        assert_eq!(of_line.text(shown), "⟨U+001B⟩[31m = 3");
        assert_eq!(of_line.before(5, shown), "⟨U+001B⟩[31m");
    }
}
