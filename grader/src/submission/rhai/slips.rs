//! Slips that the parser notices at another place, or takes for another one: a missing `;`, another language's way to write something.

use rhai::{LexError, ParseErrorType};

use super::foreign;
use super::habits::percent_comment;
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
                Some(stopped.slip(
                    message,
                    "write \"text\"; the transpose of a matrix m is m.T",
                ))
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
        let of_one = self
            .of_matlab_or_python()
            .or_else(|| self.element_or_column(kind))
            .or_else(|| self.of_rust(kind))
            .or_else(|| self.of_javascript(kind));
        let found = if let Some(found) = of_one {
            found
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
                let is_returned = self.signs.word_before(at).as_deref() == Some("return");
                sign == '(' && (is_returned || matches!(before, Some('=' | ',' | '(' | '[')))
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
                "of a matrix write m.T; a vector is neither row nor column, so leave it out; dot(a, b) is the product of two",
            )
        } else {
            return None;
        };
        Some(self.slip(found.0, found.1))
    }

    /// What MATLAB and Python write.
    fn of_matlab_or_python(&self) -> Option<(&'static str, &'static str)> {
        let after = &self.line[self.before.len()..];
        let comment = percent_comment(self.line);
        if comment.is_some_and(|at| at < self.before.len()) {
            Some((
                "`%` begins no comment here",
                "a comment begins with //; the remainder of a division is a % b",
            ))
        } else if self.line.contains("\"\"\"") {
            Some((
                "`\"\"\"` is not available here",
                "a comment begins with //, or goes between /* and */",
            ))
        } else if after.starts_with("@(") {
            Some((
                "functions without a name are not available",
                "write a function with a name: fn name(x) { ... }",
            ))
        } else if after.starts_with("...") {
            Some((
                "`...` is not available here",
                "leave it out: a statement goes on until its ;",
            ))
        } else if self.word == "case" && self.before.trim().is_empty() {
            Some((
                "`case` is not available here",
                "write if x == \"a\" { ... } else { ... }",
            ))
        } else {
            None
        }
    }

    /// What of another language picks elements: `v(1:2)`, `J(:, k)`, `q[:2]`.
    fn element_or_column(&self, kind: &ParseErrorType) -> Option<(&'static str, &'static str)> {
        let is_path =
            self.line[self.before.len()..].starts_with("::") || self.before.ends_with(':');
        if self.sign != Some(':') || is_path {
            return None;
        }
        let before = self.before.trim_end();
        if matches!(kind, ParseErrorType::BadInput(_)) && before.ends_with(['(', '[', ',']) {
            return Some((
                "`:` is no index here",
                "v[0..2] is the first two elements; col(m, k) reads a column, m[0][k] = x; sets one element of it",
            ));
        }
        let is_parenthesis = matches!(kind, ParseErrorType::MissingToken(token, _) if matches!(token.as_str(), ")" | ","));
        let is_number = before.ends_with(|c: char| c.is_ascii_digit());
        (is_parenthesis && is_number).then_some((
            "elements are in square brackets",
            "v[0..2] is the first two elements: counting starts at 0, and the end is not included",
        ))
    }

    /// What Rust writes.
    fn of_rust(&self, kind: &ParseErrorType) -> Option<(&'static str, &'static str)> {
        let after = &self.line[self.before.len()..];
        let before = self.before.trim_end();
        let is_definition = self.line.trim_start().starts_with("fn ");
        let word_before = before
            .rsplit(|c: char| !(c.is_alphanumeric() || c == '_'))
            .next()
            .unwrap_or_default();
        if is_definition && (after.starts_with("->") || before.ends_with("->")) {
            Some((
                "functions have no return type",
                "leave it out: fn name(x) { ... }",
            ))
        } else if is_definition && before.ends_with(['(', ',']) && self.sign == Some('&') {
            Some((
                "parameters are names alone",
                "leave `&` and `mut` out, and `&mut self` too: what is kept between calls is in `this`",
            ))
        } else if self.word == "as" {
            Some(("numbers need no conversion", "leave `as` and the type out"))
        } else if self.sign == Some('!')
            && self.line[self.before.len()..].starts_with(['!'])
            && !word_before.is_empty()
            && matches!(
                kind,
                ParseErrorType::MissingToken(..) | ParseErrorType::BadInput(_)
            )
            || (before.ends_with('!')
                && before
                    .trim_end_matches('!')
                    .ends_with(char::is_alphanumeric))
        {
            Some((
                "there are no macros",
                "write [0.0, 0.0] or zeros(2) for vec![0.0; 2], print(x) for println!",
            ))
        } else if after.starts_with("f64") || after.starts_with("_f64") {
            Some(("numbers have no types", "leave it out: write 1.0"))
        } else {
            None
        }
    }

    /// What JavaScript and Python write.
    fn of_javascript(&self, kind: &ParseErrorType) -> Option<(&'static str, &'static str)> {
        let after = &self.line[self.before.len()..];
        let line = self.line.trim_start();
        let is_missing = |wanted: &[&str]| matches!(kind, ParseErrorType::MissingToken(token, _) if wanted.contains(&token.as_str()));
        if self.line.contains("=>")
            && is_missing(&[";", ")", ",", "}"])
            && (after.starts_with("=>")
                || self.line[self.before.len()..].contains("=>")
                || self.before.contains("=>"))
        {
            Some((
                "functions without a name are not available",
                "write a function with a name: fn name(x) { ... }; go over a list with for x in list { ... }",
            ))
        } else if line.contains("lambda") && is_missing(&[")", ",", ";"]) {
            Some((
                "functions without a name are not available",
                "write a function with a name: fn name(x) { ... }",
            ))
        } else if matches!(kind, ParseErrorType::VariableExpected)
            && self.before.trim_end().ends_with("const")
        {
            Some((
                "`const` declares one name at a time",
                "write let a = p[0]; let b = p[1];",
            ))
        } else if is_missing(&[";"]) && self.sign == Some(',') && self.is_declaration_or_names() {
            Some((
                "one variable is set at a time",
                "write let a = p[0]; let b = p[1];",
            ))
        } else if is_missing(&["{"]) && self.word == "is" {
            Some((
                "`is` is not available here",
                "write x == () to ask whether x is nothing",
            ))
        } else {
            None
        }
    }

    /// Whether a `,` stands between values of one `let`, or between names that are set together: `let a = 1, b = 2`, `a, b = p`.
    fn is_declaration_or_names(&self) -> bool {
        let before = self.before.trim();
        let is_declared = ["let ", "const "]
            .iter()
            .any(|word| before.starts_with(word));
        let is_name = !before.is_empty() && before.chars().all(|c| c.is_alphanumeric() || c == '_');
        (is_declared && before.contains('=')) || (is_name && self.line.contains('='))
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
                "`;` does not separate elements here",
                "write [a, b] for a vector, zeros(2) for two zeros, matrix([[1, 2], [3, 4]]) for a matrix",
            )),
            _ if in_list && self.word == "for" => Some(self.slip(
                "a list is filled in a loop",
                "write let x = []; for i in 0..3 { x.push(i); }",
            )),
            ("," | ";", Some('"')) if self.before.ends_with('f') => Some(self.slip(
                "a string with values in it is written in backticks",
                "write `x = ${x}`",
            )),
            (")", Some('=')) => {
                let mut words = self.line.split(|c: char| !c.is_alphanumeric());
                words
                    .any(|word| matches!(word, "if" | "while"))
                    .then(|| self.assignment_in_condition())
            }
            ("=>", _) if self.word == "case" || self.before.contains("case") => Some(self.slip(
                "`case` is not available here",
                "write if x == \"a\" { ... } else if x == \"b\" { ... } else { ... }",
            )),
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
            let inside = self.before.rsplit('{').next().unwrap_or_default().trim();
            let is_key = !inside.is_empty()
                && self.before.contains('{')
                && inside.chars().all(|c| c.is_alphanumeric() || c == '_');
            sign == '{' && (first == Some('"') || self.before.contains('=') || returned || is_key)
        })
    }

    /// A `;` that is missing at the end of a line above.
    fn missing_semicolon(&self) -> Option<Mistake> {
        // a function begins where a block should have ended
        if self.word == "fn"
            && let Some(opened) = self.signs.never_closed()
        {
            let message = format!("the `{{` of line {} is never closed", opened.line);
            return Some(slip_at(opened, message, "write a } where its block ends"));
        }
        let (last, _) = self.signs.last_before(self.place)?;
        let another_language = foreign::syntax(self.line, self.place.column).is_some()
            || self
                .signs
                .word_before(self.place)
                .is_some_and(|word| foreign::word(&word).is_some());
        // a word of another language on a line above
        if let Some((at, word)) = self.signs.word_at_end(self.place)
            && at.line < self.place.line
            && let Some(help) = foreign::word(&word)
        {
            return Some(slip_at(
                at,
                format!("`{word}` is not available here"),
                &help,
            ));
        }
        (last.line < self.place.line && !another_language).then(|| self.ended(last, ';'))
    }

    /// A `{` that is missing at the end of a line above.
    fn block_without_brace(&self) -> Option<Mistake> {
        let (last, _) = self.signs.last_before(self.place)?;
        if last.line == self.place.line {
            return matches!(self.sign, Some(','))
                .then(|| self.slip("a `{` is missing before this", "write if condition { ... }"));
        }
        let of_switch = self
            .signs
            .lines()
            .any(|(line, text)| line == last.line && text.trim_start().starts_with("switch"));
        let message = format!("a `{{` is missing at the end of line {}", last.line);
        let help = match of_switch {
            true => "write if x == \"a\" { ... } else if x == \"b\" { ... } else { ... }",
            false => "a block is written { ... }",
        };
        Some(slip_at(behind(last), message, help))
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
        further: Vec::new(),
    }
}

/// Where the character at a column begins, or the end of the line.
fn column_to_byte(line: &str, column: usize) -> usize {
    let mut starts = line.char_indices().map(|(at, _)| at);
    starts.nth(column.saturating_sub(1)).unwrap_or(line.len())
}
