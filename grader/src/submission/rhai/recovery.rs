//! A file from which is taken out what the parser stops at, line by line, so that the rest can be parsed again.

use std::collections::BTreeSet;

use super::signs::Signs;
use crate::submission::controller::{Mistake, SourcePosition};

/// Lines that one statement may have.
const MOST_LINES: usize = 30;

/// Words of a line that may declare names.
const DECLARING: [&str; 5] = ["let", "const", "for", "fn", "function"];

/// Words that begin a block in other languages, too.
const BLOCKS: [&str; 6] = ["if", "for", "while", "switch", "fn", "function"];

/// A file from which statements are taken out.
pub(super) struct Rest {
    pub(super) lines: Vec<String>,
    /// Lines that were taken out.
    pub(super) changed: BTreeSet<usize>,
    /// Every word of what was taken out: names that may have been declared there.
    pub(super) taken_out: BTreeSet<String>,
}

impl Rest {
    pub(super) fn of(source: &str) -> Self {
        let mut rest = Self {
            lines: source.lines().map(str::to_owned).collect(),
            changed: BTreeSet::new(),
            taken_out: BTreeSet::new(),
        };
        rest.close_blocks();
        rest
    }

    /// Ends the blocks that end with a word of another language: one that begins with `{` gets its `}`, and what ends another one goes,
    /// as does a `pass`.
    fn close_blocks(&mut self) {
        let text = self.lines.join("\n");
        // whether each open block begins with a brace
        let mut open: Vec<bool> = Vec::new();
        for (line, code) in Signs::of(&text).lines() {
            let word = code.trim().trim_end_matches(';');
            if word == "pass" {
                self.lines[line - 1].clear();
                continue;
            }
            if word == "end" {
                let closed = if open.pop() == Some(true) { "}" } else { "" };
                self.lines[line - 1] = closed.to_owned();
                continue;
            }
            let first = code
                .trim_start()
                .split(|c: char| !c.is_alphanumeric())
                .next();
            let begins = first.is_some_and(|word| BLOCKS.contains(&word));
            let ends_itself = code.contains("end") && code.contains(',');
            if begins && !code.contains('{') && !ends_itself {
                open.push(false);
            }
            for sign in code.chars() {
                match sign {
                    '{' => open.push(true),
                    '}' => {
                        open.pop();
                    }
                    _ => {}
                }
            }
        }
    }

    pub(super) fn is_changed(&self, line: usize) -> bool {
        self.changed.contains(&line)
    }

    /// Takes out or completes what the parser stopped at; false where that would change nothing.
    pub(super) fn repair(&mut self, mistake: &Mistake, place: SourcePosition) -> bool {
        let Some(line) = self.lines.get_mut(place.line.wrapping_sub(1)) else {
            return false;
        };
        for sign in [';', ','] {
            let is_missing = format!("a `{sign}` is missing at the end of line");
            if mistake.message.starts_with(&is_missing) {
                let at = line.char_indices().nth(place.column.saturating_sub(1));
                let at = at.map_or(line.len(), |(at, _)| at);
                line.insert(at, sign);
                return true;
            }
        }
        self.take_out(place)
    }

    /// Takes out the statement at a place, all but its braces.
    fn take_out(&mut self, place: SourcePosition) -> bool {
        let signs = Signs::of(&self.lines.join("\n"));
        let [first, last] = statement(&signs, place.line);
        let of_statement: Vec<(usize, String)> = signs
            .lines()
            .filter(|(line, _)| (first..=last).contains(line))
            .collect();
        let mut is_new = false;
        for (line, code) in of_statement {
            let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            if words.iter().any(|word| DECLARING.contains(word)) {
                self.taken_out.extend(words.into_iter().map(str::to_owned));
            }
            let left = without_statements(&code);
            let text = &mut self.lines[line - 1];
            is_new |= *text != left;
            *text = left;
            self.changed.insert(line);
        }
        is_new
    }
}

/// The lines of the statement in a line: those that brackets tie together.
fn statement(signs: &Signs, line: usize) -> [usize; 2] {
    let begins = SourcePosition { line, column: 1 };
    let mut first = line;
    let mut at = begins;
    while let Some((open, sign)) = signs.open_at(at)
        && sign != '{'
    {
        (first, at) = (open.line, open);
    }
    let mut depth = 0_i64;
    let mut last = line;
    for (number, code) in signs.lines().filter(|(number, _)| *number >= first) {
        let change = |sign: char| match sign {
            '(' | '[' => 1,
            ')' | ']' => -1,
            _ => 0,
        };
        depth += code.chars().map(change).sum::<i64>();
        last = number.max(line);
        if number >= line && depth <= 0 || number - first >= MOST_LINES {
            break;
        }
    }
    [first, last]
}

/// Blocks that open and close as those of a line of code do, with nothing in them.
fn without_statements(code: &str) -> String {
    let mut left = String::new();
    let mut open = 0_usize;
    let function = header(code);
    for sign in code.chars() {
        match sign {
            '{' => {
                let begins = match &function {
                    Some(header) if open == 0 => header,
                    _ => "if true",
                };
                left += &format!("{begins} {{ ");
                open += 1;
            }
            '}' => {
                left += "} ";
                open = open.saturating_sub(1);
            }
            _ => {}
        }
    }
    left
}

/// The header of the function that a line of code defines, its name and its parameters as names alone. With a brace in it, a line would
/// be longer after every repair.
fn header(code: &str) -> Option<String> {
    let (before, rest) = code.split_once("fn ")?;
    let is_of_rust = before.trim().is_empty() || before.trim() == "pub";
    let (name, rest) = rest.split_once('(').filter(|_| is_of_rust)?;
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let name = Some(name.trim()).filter(|name| name.chars().all(is_name))?;
    let (parameters, _) = rest.split_once(')')?;
    let name_of = |parameter: &str| {
        let name = parameter.split([':', '=']).next().unwrap_or_default();
        let mut words = name.split(|c: char| !is_name(c));
        let word = words.rfind(|word| !word.is_empty() && !["mut", "self"].contains(word));
        word.map(str::to_owned)
    };
    let parameters: Vec<String> = parameters.split(',').filter_map(name_of).collect();
    Some(format!("fn {name}({})", parameters.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_a_line_stays_as_it_is() {
        for code in [
            "fn f(a, b) { let x = ; } }",
            "fn f == b { 2 } else { c } d(row); }",
            "fn { } { } (",
            "fn {{{( } { })",
            "pub fn f(mut a: f64) -> f64 { a } fn g() { { } }",
        ] {
            let once = without_statements(code);
            assert_eq!(without_statements(&once), once, "{code}");
        }
    }

    #[test]
    fn a_header_is_of_a_function_with_a_name() {
        assert_eq!(
            header("pub fn f(&mut a: f64, b) {").as_deref(),
            Some("fn f(a, b)")
        );
        assert_eq!(header("fn f == b { 2 } (c)"), None);
    }
}
