//! The signs of a script without its comments and strings: which bracket is open, which comment is not closed.

use std::collections::{BTreeMap, BTreeSet};

use crate::submission::controller::SourcePosition;

/// A script's signs outside of comments; a string is one `"`.
pub(super) struct Signs {
    signs: Vec<(SourcePosition, char)>,
    /// The beginning of a comment that is not closed.
    pub(super) open_comment: Option<SourcePosition>,
    /// Lines whose comment at the end has a `;`.
    hidden_semicolons: BTreeSet<usize>,
}

impl Signs {
    pub(super) fn of(source: &str) -> Self {
        let mut all = Vec::new();
        for (line, text) in source.lines().enumerate() {
            for (column, sign) in text.chars().enumerate() {
                all.push((at(line + 1, column + 1), sign));
            }
            all.push((at(line + 1, text.chars().count() + 1), '\n'));
        }
        let mut found = Self {
            signs: Vec::new(),
            open_comment: None,
            hidden_semicolons: BTreeSet::new(),
        };
        let mut rest = all.as_slice();
        while let Some((&(place, sign), after)) = rest.split_first() {
            let next = after.first().map(|(_, next)| *next);
            let skipped = match (sign, next) {
                ('/', Some('/')) => {
                    let length = until_line_ends(rest);
                    if rest[..length].iter().any(|(_, sign)| *sign == ';') {
                        found.hidden_semicolons.insert(place.line);
                    }
                    length
                }
                ('/', Some('*')) => block_comment(rest).unwrap_or_else(|| {
                    found.open_comment = Some(place);
                    rest.len()
                }),
                ('"' | '`', _) => {
                    found.signs.push((place, '"'));
                    string(rest)
                }
                // the character '"' begins no string
                ('\'', Some('"')) => 2,
                _ => {
                    found.signs.push((place, sign));
                    1
                }
            };
            rest = rest.get(skipped..).unwrap_or(&[]);
        }
        found.signs.retain(|(_, sign)| !sign.is_whitespace());
        found
    }

    /// The lines that have signs, in order, each as its signs with a blank for what is between two of them.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, String)> {
        self.signs
            .chunk_by(|a, b| a.0.line == b.0.line)
            .map(|line| {
                let mut text = String::new();
                let mut next = line[0].0.column;
                for (at, sign) in line {
                    if at.column > next {
                        text.push(' ');
                    }
                    text.push(*sign);
                    next = at.column + 1;
                }
                (line[0].0.line, text)
            })
    }

    /// The signs before a place, from the last to the first.
    fn before(&self, place: SourcePosition) -> impl Iterator<Item = (SourcePosition, char)> {
        let end = self.signs.partition_point(|(at, _)| is_before(*at, place));
        self.signs[..end].iter().rev().copied()
    }

    /// The last sign before a place.
    pub(super) fn last_before(&self, place: SourcePosition) -> Option<(SourcePosition, char)> {
        self.before(place).next()
    }

    /// The first sign after a place.
    pub(super) fn first_after(&self, place: SourcePosition) -> Option<(SourcePosition, char)> {
        let begin = self.signs.partition_point(|(at, _)| !is_before(place, *at));
        self.signs.get(begin).copied()
    }

    /// Whether the comment at the end of a line has a `;`.
    pub(super) fn hides_semicolon(&self, line: usize) -> bool {
        self.hidden_semicolons.contains(&line)
    }

    /// The `{` that no `}` closes. Where one is missing, the `}` of a block around it takes its place: so it is the innermost whose line
    /// is indented more than the line of the `}` that would close it, or else the outermost that is open at the end.
    pub(super) fn never_closed(&self) -> Option<SourcePosition> {
        let mut indents = BTreeMap::new();
        for (at, _) in &self.signs {
            indents.entry(at.line).or_insert(at.column);
        }
        let mut open: Vec<SourcePosition> = Vec::new();
        let mut suspect = None;
        for (at, sign) in &self.signs {
            match sign {
                '{' => open.push(*at),
                '}' => {
                    let opened = open.pop()?;
                    let begins_line = indents.get(&at.line) == Some(&at.column);
                    let deeper = indents.get(&opened.line) > Some(&at.column);
                    if begins_line && deeper && opened.line < at.line {
                        suspect = suspect.or(Some(opened));
                    }
                }
                _ => {}
            }
        }
        let outermost = open.first().copied()?;
        suspect.or(Some(outermost))
    }

    /// The bracket that is open at a place.
    pub(super) fn open_at(&self, place: SourcePosition) -> Option<(SourcePosition, char)> {
        let mut closed = 0_usize;
        self.before(place).find(|(_, sign)| match sign {
            ')' | ']' | '}' => {
                closed += 1;
                false
            }
            '(' | '[' | '{' if closed > 0 => {
                closed -= 1;
                false
            }
            sign => matches!(sign, '(' | '[' | '{'),
        })
    }

    /// Whether a closing bracket at a place closes nothing.
    pub(super) fn closes_nothing(&self, place: SourcePosition, closing: char) -> bool {
        let opening = match closing {
            ')' => '(',
            ']' => '[',
            '}' => '{',
            _ => return false,
        };
        self.open_at(place).is_none_or(|(_, sign)| sign != opening)
    }

    /// The word that ends before a place, and where it begins.
    pub(super) fn word_at_end(&self, place: SourcePosition) -> Option<(SourcePosition, String)> {
        let word = self.word_before(place)?;
        let (last, _) = self.last_before(place)?;
        let column = (last.column + 1).saturating_sub(word.chars().count());
        Some((at(last.line, column), word))
    }

    /// The word that ends before a place, on its line or one above.
    pub(super) fn word_before(&self, place: SourcePosition) -> Option<String> {
        let (last, sign) = self.last_before(place)?;
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let mut column = last.column + 1;
        let word: Vec<char> = is_word(sign).then(|| {
            self.before(place)
                .take_while(|(at, sign)| {
                    let joined = at.line == last.line && at.column + 1 == column;
                    column = at.column;
                    joined && is_word(*sign)
                })
                .map(|(_, sign)| sign)
                .collect()
        })?;
        Some(word.into_iter().rev().collect())
    }
}

/// Whether a place comes before another.
pub(super) fn is_before(one: SourcePosition, other: SourcePosition) -> bool {
    (one.line, one.column) < (other.line, other.column)
}

fn at(line: usize, column: usize) -> SourcePosition {
    SourcePosition { line, column }
}

fn until_line_ends(signs: &[(SourcePosition, char)]) -> usize {
    let length = signs.iter().position(|(_, sign)| *sign == '\n');
    length.unwrap_or(signs.len())
}

/// The length of a comment with those inside it; `None` if it is not closed.
fn block_comment(signs: &[(SourcePosition, char)]) -> Option<usize> {
    let mut depth = 0_usize;
    let mut index = 0;
    loop {
        let pair = (signs.get(index)?.1, signs.get(index + 1).map(|(_, c)| *c));
        index += match pair {
            ('/', Some('*')) => {
                depth += 1;
                2
            }
            ('*', Some('/')) => {
                depth -= 1;
                2
            }
            _ => 1,
        };
        if depth == 0 {
            return Some(index);
        }
    }
}

/// The length of a string; one in double quotes ends with its line.
fn string(signs: &[(SourcePosition, char)]) -> usize {
    let quote = signs.first().map(|(_, sign)| *sign);
    let mut index = 1;
    while let Some((_, sign)) = signs.get(index) {
        match sign {
            '\\' => index += 1,
            '\n' if quote == Some('"') => return index,
            sign if Some(*sign) == quote => return index + 1,
            _ => {}
        }
        index += 1;
    }
    signs.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_strings_hide_brackets() {
        let signs = Signs::of("f(\"(\", /* [ /* */ */ x // {\n y");
        assert_eq!(signs.open_at(at(2, 2)), Some((at(1, 2), '(')));
        assert_eq!(signs.open_comment, None);
        assert_eq!(signs.word_before(at(2, 2)), Some("x".into()));
        assert_eq!(Signs::of("a\n  /* b").open_comment, Some(at(2, 3)));
    }
}
