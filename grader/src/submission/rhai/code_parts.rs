//! The parts of a program that are worth a colour, as the language's own lexer finds them: for pages that show code.

use std::ops::Range;

use rhai::Token;

use super::tokens::{is_name, tokens};

/// What a part of a program is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodePart {
    /// A word of the language, such as `let`, `if` or `this`.
    Keyword,
    /// A number.
    Number,
    /// Text in quotes.
    Text,
    /// A comment.
    Comment,
    /// The name of a function where it is declared or called.
    Function,
}

impl CodePart {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Keyword => "keyword",
            Self::Number => "number",
            Self::Text => "text",
            Self::Comment => "comment",
            Self::Function => "function",
        }
    }
}

/// A longer program has no parts: to find its tokens takes long.
const MOST_BYTES: usize = 20_000;

/// The parts of a program in its order, each with its bytes. From the first character that the language does not have there are none.
pub fn code_parts(program: &str) -> Vec<(CodePart, Range<usize>)> {
    if program.len() > MOST_BYTES {
        return Vec::new();
    }
    let mut parts: Vec<(CodePart, Range<usize>)> = Vec::new();
    // a name that is a function's if a parenthesis follows it
    let mut name: Option<Range<usize>> = None;
    for (token, at) in tokens(program) {
        let called = name.take().filter(|_| token == Token::LeftParen);
        parts.extend(called.map(|at| (CodePart::Function, at)));
        if is_name(&token) {
            name = Some(at);
        } else if let Some(part) = part(&token) {
            parts.push((part, at));
        }
    }
    parts
}

fn part(token: &Token) -> Option<CodePart> {
    match token {
        Token::IntegerConstant(_) | Token::FloatConstant(_) => Some(CodePart::Number),
        Token::StringConstant(_) | Token::InterpolatedString(_) | Token::CharConstant(_) => {
            Some(CodePart::Text)
        }
        Token::Comment(_) => Some(CodePart::Comment),
        Token::Reserved(word) if word.as_str() == "this" => Some(CodePart::Keyword),
        token if token.is_standard_keyword() => Some(CodePart::Keyword),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(program: &str) -> Vec<(&'static str, &str)> {
        code_parts(program)
            .into_iter()
            .map(|(part, at)| (part.name(), &program[at]))
            .collect()
    }

    #[test]
    fn every_kind_of_part_is_found_where_it_stands() {
        assert_eq!(
            found(
                "// how far\nfn reach(q) {\n    let d = 1.5e-3 * norm(q) - 2; // é\n    this.sum = \"a\"; print(d);\n}"
            ),
            [
                ("comment", "// how far"),
                ("keyword", "fn"),
                ("function", "reach"),
                ("keyword", "let"),
                ("number", "1.5e-3"),
                ("function", "norm"),
                ("number", "2"),
                ("comment", "// é"),
                ("keyword", "this"),
                ("text", "\"a\""),
                ("function", "print"),
            ]
        );
        assert_eq!(
            found("/* one\ntwo */ `a ${ #{b: f(1)}.b } c` 0x1f"),
            [
                ("comment", "/* one\ntwo */"),
                ("text", "`a $"),
                ("function", "f"),
                ("number", "1"),
                ("text", "c`"),
                ("number", "0x1f"),
            ]
        );
    }

    #[test]
    fn what_is_not_the_language_has_no_parts() {
        assert_eq!(
            found("let a = 1; \" never ends"),
            [("keyword", "let"), ("number", "1")]
        );
        assert_eq!(found(""), []);
        assert_eq!(found(&"1 ".repeat(MOST_BYTES)), []);
    }

    /// Parts are in order, apart, and on borders of characters, whatever the text is.
    #[test]
    fn parts_never_overlap() {
        let pieces = [
            "fn ", "f(", "é", "\"", "`", "${", "}", "{", "/*", "*/", "// x\n", "\r\n", "1.", "..",
            "0x", "'", "😀", "#{", "this", "\\", "\t", "-", "#", "\"a\"",
        ];
        let mut state = 12_345_u64;
        for _ in 0..4_000 {
            let mut program = String::new();
            for _ in 0..(state >> 60) + 2 {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                program.push_str(pieces[(state >> 33) as usize % pieces.len()]);
            }
            let mut end = 0;
            for (_, at) in code_parts(&program) {
                assert!(end <= at.start && at.start < at.end, "{program:?}: {at:?}");
                assert!(program.get(at.clone()).is_some(), "{program:?}: {at:?}");
                end = at.end;
            }
        }
    }
}
