//! Why a file does not compile: the parser's error in plain words.

use rhai::{LexError, ParseErrorType};

use super::foreign;
use super::mistake::{Context, WHOLE_INDEX, plain, shortened};
use super::signs::Signs;
use crate::submission::controller::{ENTRY_POINTS, Mistake, SourcePosition};

/// The help where nothing is known but that a statement ends.
pub(super) const END_BEFORE: &str = "end the statement before it with `;`";

/// A message and its help.
type Words = (String, Option<String>);

impl Context<'_> {
    /// The message for an error of the parser.
    pub(super) fn unparsed(&self, kind: &ParseErrorType, place: Option<SourcePosition>) -> Mistake {
        let signs = Signs::of(self.source);
        let slip = place.and_then(|place| self.slip(kind, place, &signs));
        slip.unwrap_or_else(|| {
            let (message, help) = self.parse_words(kind, place, &signs);
            Mistake {
                message: shortened(message),
                place,
                help: help.map(shortened),
                further: Vec::new(),
            }
        })
    }

    fn sign_at(&self, place: SourcePosition) -> Option<char> {
        let line = self.line(place.line)?;
        line.chars().nth(place.column.checked_sub(1)?)
    }

    fn parse_words(
        &self,
        kind: &ParseErrorType,
        place: Option<SourcePosition>,
        signs: &Signs,
    ) -> Words {
        let line = place.and_then(|place| self.line(place.line)).unwrap_or("");
        let foreign = place.and_then(|place| foreign::syntax(line, place.column));
        let (message, help) = match kind {
            ParseErrorType::UnexpectedEOF => (
                "the file ends in the middle of something".to_owned(),
                Some("a closing `}`, `)` or `]` is missing".to_owned()),
            ),
            ParseErrorType::BadInput(error) => bad_input(error),
            ParseErrorType::Reserved(word) => foreign::reserved(word),
            ParseErrorType::MissingToken(token, _) if token == ";" => {
                if place.is_some_and(|place| self.sign_at(place).is_none()) {
                    return ("a `}` is missing before this".to_owned(), foreign);
                }
                let near = place.and_then(|place| foreign::near_keyword(line, place.column));
                let above = place.and_then(|place| foreign::word(&signs.word_before(place)?));
                if let Some(help) = foreign.or(above) {
                    return ("this is written differently here".to_owned(), Some(help));
                }
                let help = END_BEFORE.to_owned();
                return (
                    "a `;` is missing before this".to_owned(),
                    near.or(Some(help)),
                );
            }
            ParseErrorType::MissingToken(token, what) => missing(
                token,
                what,
                line,
                place.and_then(|place| self.sign_at(place)),
            ),
            ParseErrorType::MalformedIndexExpr(text) if text.contains("integer") => (
                "the index of a list is an integer".to_owned(),
                Some(WHOLE_INDEX.to_owned()),
            ),
            ParseErrorType::PropertyExpected => {
                let before = place.and_then(|place| signs.last_before(place));
                let message = match before {
                    Some((_, '.')) => "a name must follow the `.`",
                    _ => "a key of a map is a name or a string",
                };
                (message.to_owned(), None)
            }
            ParseErrorType::ExprExpected(_)
                if place.and_then(|place| signs.word_before(place)).as_deref() == Some("in") =>
            {
                (
                    "what `for` goes over is missing before this".to_owned(),
                    Some("count with `for i in 0..n`".to_owned()),
                )
            }
            other => definition(other)
                .or_else(|| statement(other))
                .unwrap_or_else(|| (plain(&other.to_string()), None)),
        };
        (message, help.or(foreign))
    }
}

/// The words for a character or a symbol that the language does not have.
fn bad_input(error: &LexError) -> Words {
    match error {
        LexError::UnterminatedString => (
            "a string is not closed".to_owned(),
            Some("put a `\"` at its end".to_owned()),
        ),
        LexError::MalformedChar(_) => (
            "a string goes in double quotes".to_owned(),
            Some("write \"text\" instead of 'text'".to_owned()),
        ),
        LexError::MalformedEscapeSequence(sequence) => (
            format!("a string has no `{sequence}`"),
            Some("write \\\\ for a backslash and \\n for a new line".to_owned()),
        ),
        LexError::MalformedNumber(_) => ("this is not a number".to_owned(), None),
        LexError::ImproperSymbol(word, _) => foreign::reserved(word),
        LexError::UnexpectedInput(sign) => match sign.as_str() {
            ";" | ")" | "]" | "}" | "," | "=" => {
                (format!("a value is missing before this `{sign}`"), None)
            }
            "else" => (
                "`else` has no `if` before it".to_owned(),
                Some("write if condition { ... } else { ... }".to_owned()),
            ),
            "|" => ("unexpected `|`".to_owned(), foreign::reserved("|").1),
            sign => (format!("unexpected `{sign}`"), foreign::character(sign)),
        },
        other => (plain(&other.to_string()), None),
    }
}

/// The words for a sign or a word that must stand before the place.
fn missing(token: &str, what: &str, line: &str, at: Option<char>) -> Words {
    let before_this = |token: &str| format!("a `{token}` is missing before this");
    match token {
        "]" if at == Some(',') => (
            before_this(token),
            Some("an element of a matrix is m[row][column]".to_owned()),
        ),
        "," if line.contains("for (") => (
            "`for` is written without `(` and `)`".to_owned(),
            Some("write for i in 0..n { ... }".to_owned()),
        ),
        "," => {
            let closing = closing_bracket(what);
            let message = format!("a `{closing}` or a `,` is missing before this");
            let is_value = at.is_some_and(|sign| sign.is_alphanumeric() || "\"([-".contains(sign));
            let help = "elements and arguments are separated by ,";
            (message, is_value.then(|| help.to_owned()))
        }
        "in" => (
            "`in` is missing before this".to_owned(),
            Some("write for i in 0..n { ... }".to_owned()),
        ),
        "catch" => (
            before_this(token),
            Some("write try { ... } catch { ... }".to_owned()),
        ),
        "{" if at == Some(':') => (
            before_this(token),
            Some("a block is written { ... }, without `:`".to_owned()),
        ),
        token => (before_this(token), None),
    }
}

/// The bracket that closes what the engine was reading, from its description of that.
fn closing_bracket(what: &str) -> &'static str {
    if what.contains("array") {
        "]"
    } else if what.contains("map") {
        "}"
    } else {
        ")"
    }
}

/// The words for a mistake in the definition of a function.
fn definition(kind: &ParseErrorType) -> Option<Words> {
    let parameters = |name: &str| {
        let entry = ENTRY_POINTS.iter().find(|(entry, _)| *entry == name);
        entry.map_or_else(|| "x".to_owned(), |(_, parameters)| parameters.join(", "))
    };
    let (message, help) = match kind {
        ParseErrorType::FnMissingBody(name) => {
            let body = if name == "control" { "[0.5, 0]" } else { "..." };
            (
                "a function's body is in { }".to_owned(),
                format!("fn {name}({}) {{ {body} }}", parameters(name)),
            )
        }
        ParseErrorType::FnMissingParams(name) => (
            format!("the parameters of `{name}` are missing"),
            format!("write fn {name}({}) {{ ... }}", parameters(name)),
        ),
        ParseErrorType::FnMissingName => (
            "the name of the function is missing".to_owned(),
            "write fn name(x) { ... }; the name is not a word of the language".to_owned(),
        ),
        ParseErrorType::FnDuplicatedParam(name, parameter) => (
            format!("`{name}` has two parameters `{parameter}`"),
            "rename one of them".to_owned(),
        ),
        ParseErrorType::FnDuplicatedDefinition(name, _) => (
            format!("there are two functions `{name}` with the same parameters"),
            "remove or rename one of them".to_owned(),
        ),
        ParseErrorType::WrongFnDefinition => (
            "a function is inside another function or block".to_owned(),
            "move it to the top level of the file; is a `}` missing above?".to_owned(),
        ),
        ParseErrorType::WrongDocComment => (
            "a comment with `///` is not before a function".to_owned(),
            "begin it with //".to_owned(),
        ),
        _ => return None,
    };
    Some((message, Some(help)))
}

/// The words for a mistake in a statement.
fn statement(kind: &ParseErrorType) -> Option<Words> {
    let (message, help) = match kind {
        ParseErrorType::MismatchedType(wanted, _) if wanted.contains("iterable") => (
            "`for` goes over a range, a list, a vector or a string".to_owned(),
            "count with `for i in 0..n`",
        ),
        ParseErrorType::MismatchedType(wanted, got) if wanted.contains("boolean") => (
            format!("a condition is true or false, got {got}"),
            "compare: x > 0",
        ),
        ParseErrorType::ExprExpected(wanted) if wanted.contains("boolean") => (
            "a condition is missing before this".to_owned(),
            "a condition is true or false: if x > 0 { ... }",
        ),
        ParseErrorType::VariableExpected => (
            "the name of a variable is missing here".to_owned(),
            "a name begins with a letter and is not a word of the language: let gain = 1;",
        ),
        ParseErrorType::AssignmentToConstant(name) if !name.is_empty() => (
            format!("`{name}` is a constant and cannot change"),
            "declare it with `let`, or keep what changes in `this`",
        ),
        ParseErrorType::AssignmentToConstant(_) | ParseErrorType::AssignmentToInvalidLHS(_) => (
            "this cannot be set".to_owned(),
            "on the left of `=` is a variable, an element v[0] or m[0][1], or a key; list.push(x) appends; == compares",
        ),
        ParseErrorType::DuplicatedProperty(key) => (
            format!("the map has two entries `{key}`"),
            "remove or rename one of them",
        ),
        ParseErrorType::UnknownOperator(sign) => {
            return Some((format!("`{sign}` is not an operator here"), None));
        }
        ParseErrorType::LoopBreak => (
            "`break` and `continue` work only in a loop".to_owned(),
            "end a function with `return`",
        ),
        _ => return None,
    };
    Some((message, Some(help.to_owned())))
}
