//! Slips that the parser notices at another place, or takes for another one: a missing `;`, another language's way to write something.

use rhai::{LexError, ParseErrorType};

use super::foreign;
use super::mistake::Context;
use super::signs::{Signs, is_before};
use crate::submission::controller::{Mistake, SourcePosition};

/// Words that begin a statement or a part of it.
const KEYWORDS: [&str; 10] = [
    "let", "const", "if", "else", "for", "while", "return", "in", "fn", "switch",
];

/// Where the parser stopped, and what is there.
struct Stopped<'a> {
    place: SourcePosition,
    /// The line of the place, and what of it comes before the place.
    line: &'a str,
    before: &'a str,
    /// The sign at the place; `None` at the end of the line.
    sign: Option<char>,
    /// The word that begins at the place; empty where none does.
    word: &'a str,
    signs: &'a Signs,
}

impl Context<'_> {
    /// The slip behind an error of the parser, if it is a known one.
    pub(super) fn slip(
        &self,
        kind: &ParseErrorType,
        place: SourcePosition,
        signs: &Signs,
    ) -> Option<Mistake> {
        if let Some(comment) = signs.open_comment.filter(|at| is_before(*at, place)) {
            let message = format!(
                "the comment that begins at {}:{} is not closed",
                comment.line, comment.column
            );
            return Some(slip_at(comment, message, "end it with */"));
        }
        let line = self.line(place.line)?;
        let at = column_to_byte(line, place.column);
        let (before, after) = line.split_at(at);
        let end = after.find(|c: char| !(c.is_alphanumeric() || c == '_'));
        let stopped = Stopped {
            place,
            line,
            before,
            sign: after.chars().next(),
            word: &after[..end.unwrap_or(after.len())],
            signs,
        };
        if let Some(slip) = stopped.other_language(kind) {
            return Some(slip);
        }
        match kind {
            ParseErrorType::MalformedIndexExpr(_) => stopped.between_lists(),
            ParseErrorType::MissingToken(token, what) => stopped.missing(token, what),
            ParseErrorType::VariableExpected if before.trim_end().ends_with("for (") => {
                Some(stopped.parentheses_around_for())
            }
            ParseErrorType::BadInput(LexError::ImproperSymbol(symbol, _)) if symbol == "=" => {
                Some(stopped.assignment_in_condition())
            }
            ParseErrorType::BadInput(LexError::UnterminatedString)
                if stopped.sign == Some('\'') =>
            {
                let message = "a string goes in double quotes";
                Some(stopped.slip(message, "write \"text\"; the transpose of m is m.T"))
            }
            ParseErrorType::BadInput(LexError::UnexpectedInput(_)) => stopped.closes_nothing(),
            ParseErrorType::UnexpectedEOF => stopped.never_closed(),
            _ => None,
        }
    }
}

impl Stopped<'_> {
    fn slip(&self, message: &str, help: &str) -> Mistake {
        slip_at(self.place, message.to_owned(), help)
    }

    /// What another language writes where the parser stopped.
    fn other_language(&self, kind: &ParseErrorType) -> Option<Mistake> {
        let after = &self.line[self.before.len()..];
        let last = self.before.trim_end().chars().next_back();
        let is_operand = |c: char| c.is_alphanumeric() || matches!(c, '_' | ')' | ']');
        let is_missing = |wanted: &[&str]| matches!(kind, ParseErrorType::MissingToken(token, _) if wanted.contains(&token.as_str()));
        let opened = || self.signs.open_at(self.place);
        let found = if self.line.contains("\"\"\"") {
            (
                "`\"\"\"` is not available here",
                "a comment begins with //, or goes between /* and */",
            )
        } else if after.starts_with("::") || (self.sign == Some(':') && last == Some(':')) {
            (
                "`::` is not available here",
                "functions are built in: write atan2(y, x) without a prefix; a vector is [x, y, z]",
            )
        } else if is_missing(&[",", ")"])
            && self.sign == Some(':')
            && self.line.trim_start().starts_with("fn ")
        {
            (
                "parameters have no types",
                "leave it out: fn name(x, y) { ... }",
            )
        } else if matches!(kind, ParseErrorType::VariableExpected)
            && self.before.trim_end().ends_with("let")
            && matches!(self.sign, Some('[' | '(' | '{'))
        {
            (
                "`let` declares one variable at a time",
                "write let a = p[0]; let b = p[1];",
            )
        } else if is_missing(&[";", ")"]) && self.is_product() {
            (
                "an operator is missing before this",
                "for a product write *: 2 * x, a * (b + c)",
            )
        } else if is_missing(&[";"]) && after.starts_with("=>") {
            (
                "functions without a name are not available",
                "write a function with a name: fn name(x) { ... }",
            )
        } else if is_missing(&[")"])
            && self.sign == Some(',')
            && opened().is_some_and(|(at, sign)| {
                let before = self.signs.last_before(at).map(|(_, sign)| sign);
                sign == '(' && matches!(before, Some('=' | ',' | '(' | '['))
            })
        {
            ("a list is written with `[`", "write [1, 2]")
        } else if is_missing(&[";"])
            && self.sign == Some('(')
            && last.is_some_and(|c| matches!(c, ')' | ']'))
        {
            (
                "an element of a result is in square brackets",
                "write f(x)[0]",
            )
        } else if matches!(
            kind,
            ParseErrorType::BadInput(LexError::MalformedChar(_) | LexError::UnterminatedString)
        ) && self.sign == Some('\'')
            && self.before.chars().next_back().is_some_and(is_operand)
        {
            (
                "`'` is no transpose here",
                "write transpose(m) or m.T; of two vectors dot(a, b) is the product",
            )
        } else {
            return None;
        };
        Some(self.slip(found.0, found.1))
    }

    /// Whether two factors stand side by side, as on paper: `2 cos(x)`, `l1 cos(q)`, `2(a + b)`.
    fn is_product(&self) -> bool {
        let mut words = self
            .before
            .trim_end()
            .rsplit(|c: char| !(c.is_alphanumeric() || c == '_'));
        let last = words.next().unwrap_or_default();
        let is_number = last.starts_with(|c: char| c.is_ascii_digit());
        let ends_value = is_number || self.before.trim_end().ends_with(')');
        let next = self.line[self.before.len() + self.word.len()..].trim_start();
        let is_factor = !self.word.is_empty() && foreign::word(self.word).is_none();
        // a name and a call: `l1 cos(q)`; two names may be anything
        let is_name =
            !last.is_empty() && foreign::word(last).is_none() && !KEYWORDS.contains(&last);
        let after_operator =
            self.before.contains('=') || self.before.trim_start().starts_with("return");
        match self.sign {
            Some('(') => is_number,
            _ if is_factor && !KEYWORDS.contains(&self.word) => {
                ends_value || (is_name && next.starts_with('(') && after_operator)
            }
            _ => false,
        }
    }

    /// A sign that the parser misses before the place.
    fn missing(&self, token: &str, what: &str) -> Option<Mistake> {
        let in_list = token == "]" || (token == "," && what.contains("array"));
        match (token, self.sign) {
            ("]", Some(',')) => self.between_lists(),
            _ if in_list && self.sign == Some(':') => Some(self.slip(
                "a slice is written with `..`",
                "write v[0..2]; v[1..len(v)] goes to the end",
            )),
            _ if in_list && self.sign == Some(';') => Some(self.slip(
                "each row of a matrix is a list",
                "write matrix([[1, 2], [3, 4]])",
            )),
            _ if in_list && self.word == "for" => Some(self.slip(
                "a list is filled in a loop",
                "write let x = []; for i in 0..3 { x.push(i); }",
            )),
            (",", Some('"')) if self.before.ends_with('f') => Some(self.slip(
                "a string with values in it is written in backticks",
                "write `x = ${x}`",
            )),
            (")", Some('=')) => {
                let mut words = self.line.split(|c: char| !c.is_alphanumeric());
                words
                    .any(|word| matches!(word, "if" | "while"))
                    .then(|| self.assignment_in_condition())
            }
            ("{", _) => self.block_without_brace(),
            ("}", None) => self.never_closed(),
            (";", None) => self.never_closed().or_else(|| self.missing_semicolon()),
            (";", _) => self
                .closes_nothing()
                .or_else(|| self.other_statement())
                .or_else(|| self.missing_semicolon()),
            _ => None,
        }
    }

    /// What another language writes where this one has a `;`.
    fn other_statement(&self) -> Option<Mistake> {
        let mut words = self.before.split_whitespace();
        let declared = match (words.next(), words.next(), words.next()) {
            (Some("let" | "const"), Some(name), None) => Some(name),
            _ => None,
        };
        let found = match (declared, self.sign) {
            (Some("mut"), _) => (
                "`mut` is not needed: what `let` declares can change",
                "write let x = 1;",
            ),
            (Some(_), Some(',')) => (
                "`let` declares one variable at a time",
                "write let a = p[0]; let b = p[1];",
            ),
            (Some(_), Some(':')) => ("variables have no types", "leave it out: let x = 1;"),
            (None, Some(',')) if self.before.trim_start().starts_with("return") => (
                "a function returns one value",
                "return a list: return [a, b];",
            ),
            (_, Some(':'))
                if self
                    .before
                    .trim_end()
                    .ends_with(|c: char| c.is_ascii_digit()) =>
            {
                (
                    "a range is written with `..`",
                    "write 0..3; linspace(a, b, n) is a vector of points",
                )
            }
            (None, Some(':')) if self.is_in_block_of_keys() => {
                ("a map is written with `#{`", "write #{ a: 1, b: 2 }")
            }
            _ if self.word == "if" && !self.before.trim().is_empty() => (
                "`if` comes before the values to choose from",
                "write if condition { a } else { b }",
            ),
            _ => return None,
        };
        Some(self.slip(found.0, found.1))
    }

    /// Whether the place is in a block that looks like a map of another language: it begins like `{"a"`.
    fn is_in_block_of_keys(&self) -> bool {
        let opened = self.signs.open_at(self.place);
        opened.is_some_and(|(at, sign)| {
            let first = self.signs.first_after(at).map(|(_, sign)| sign);
            let returned = self.before.trim_start().starts_with("return");
            sign == '{' && (first == Some('"') || self.before.contains('=') || returned)
        })
    }

    /// A `;` that is missing at the end of a line above.
    fn missing_semicolon(&self) -> Option<Mistake> {
        let (last, _) = self.signs.last_before(self.place)?;
        let another_language = foreign::syntax(self.line, self.place.column).is_some()
            || self
                .signs
                .word_before(self.place)
                .is_some_and(|word| foreign::word(&word).is_some());
        (last.line < self.place.line && !another_language).then(|| self.ended(last, ';'))
    }

    /// A `{` that is missing at the end of a line above.
    fn block_without_brace(&self) -> Option<Mistake> {
        let (last, _) = self.signs.last_before(self.place)?;
        (last.line < self.place.line).then(|| {
            let message = format!("a `{{` is missing at the end of line {}", last.line);
            slip_at(behind(last), message, "a block is written { ... }")
        })
    }

    /// The statement or element that ends with `last` needs a `sign` after it.
    fn ended(&self, last: SourcePosition, sign: char) -> Mistake {
        let help = match sign {
            ',' => "elements and rows are separated by ,",
            _ if self.signs.hides_semicolon(last.line) => {
                "end the statement with ; (the one in this line is in a comment, which // begins; a quotient without remainder is floor(a / b))"
            }
            _ => "end the statement with ;",
        };
        let message = format!("a `{sign}` is missing at the end of line {}", last.line);
        slip_at(behind(last), message, help)
    }

    /// A list that the parser takes for an index, because nothing separates it from what is before it.
    fn between_lists(&self) -> Option<Mistake> {
        let (bracket, _) = self
            .signs
            .open_at(self.place)
            .filter(|(_, sign)| *sign == '[')?;
        let (last, _) = self.signs.last_before(bracket)?;
        let is_element = match self.signs.open_at(bracket) {
            Some((at, '{')) => matches!(self.signs.last_before(at), Some((_, '#'))),
            around => around.is_some(),
        };
        if last.line < bracket.line {
            return Some(self.ended(last, if is_element { ',' } else { ';' }));
        }
        (is_element && last.column + 1 < bracket.column).then(|| {
            let message = "a `,` is missing before this".to_owned();
            slip_at(bracket, message, "elements and rows are separated by ,")
        })
    }

    fn assignment_in_condition(&self) -> Mistake {
        self.slip(
            "`=` sets a value and cannot be part of a condition",
            "write == to compare",
        )
    }

    fn parentheses_around_for(&self) -> Mistake {
        self.slip(
            "`for` is written without `(` and `)`",
            "write for i in 0..n { ... }",
        )
    }

    /// A closing bracket without an opening one.
    fn closes_nothing(&self) -> Option<Mistake> {
        let sign = self
            .sign
            .filter(|sign| self.signs.closes_nothing(self.place, *sign))?;
        Some(self.slip(&format!("this `{sign}` closes nothing"), "remove it"))
    }

    /// A `{` whose `}` is missing, at the end of the file.
    fn never_closed(&self) -> Option<Mistake> {
        if self.signs.first_after(self.place).is_some() {
            return None;
        }
        let opened = self.signs.never_closed()?;
        let message = format!("the `{{` of line {} is never closed", opened.line);
        Some(slip_at(opened, message, "write a } where its block ends"))
    }
}

/// A line of backticks that marks code in a chat or on a web page. The language would take everything up to the next one for a string.
pub(super) fn chat_fence(source: &str) -> Option<Mistake> {
    let mut lines = source.lines().enumerate();
    let (index, line) = lines.find(|(_, line)| line.trim_start().starts_with("```"))?;
    let place = SourcePosition {
        line: index + 1,
        column: line.chars().take_while(|c| c.is_whitespace()).count() + 1,
    };
    Some(slip_at(
        place,
        "this line is not part of the script: it marks code in a chat or on a web page".to_owned(),
        "delete it, and what is not code around it",
    ))
}

/// The place behind a sign.
fn behind(sign: SourcePosition) -> SourcePosition {
    SourcePosition {
        column: sign.column + 1,
        ..sign
    }
}

fn slip_at(place: SourcePosition, message: String, help: &str) -> Mistake {
    Mistake {
        message,
        place: Some(place),
        help: Some(help.to_owned()),
    }
}

/// Where the character at a column begins, or the end of the line.
fn column_to_byte(line: &str, column: usize) -> usize {
    let mut starts = line.char_indices().map(|(at, _)| at);
    starts.nth(column.saturating_sub(1)).unwrap_or(line.len())
}
