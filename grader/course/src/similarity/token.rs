//! A file as tokens: words, numbers, strings, signs, and the words of comments. White space and the shape of the text are gone, names
//! are kept.

use std::iter::Peekable;
use std::str::CharIndices;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A name or a word of the language.
    Word,
    /// A word in a comment.
    Comment,
    /// A number, as it is written without a sign.
    Number(f64),
    /// A string.
    Text,
    /// A sign such as `+` or `{`.
    Sign,
}

/// A token and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Token<'t> {
    pub(super) kind: Kind,
    pub(super) text: &'t str,
    /// Its line, from one.
    pub(super) line: usize,
}

impl Token<'_> {
    /// What two tokens have in common if they are the same: words of code and of comments are alike, and so is a number however it is
    /// written.
    pub(super) fn key(&self) -> u64 {
        match self.kind {
            Kind::Number(value) => fnv(b"number", &value.to_bits().to_le_bytes()),
            Kind::Word | Kind::Comment => fnv(b"word", self.text.as_bytes()),
            Kind::Text => fnv(b"text", self.text.as_bytes()),
            Kind::Sign => fnv(b"sign", self.text.as_bytes()),
        }
    }
}

/// FNV-1a over both, the same on every machine.
fn fnv(kind: &[u8], text: &[u8]) -> u64 {
    let bytes = kind.iter().chain(text);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// How a text is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    /// As a script or a program with `//` and `/* */`, strings and numbers.
    Code,
    /// As prose, in which an apostrophe opens no string.
    Prose,
}

/// The tokens of a text.
pub(super) fn tokens(text: &str, reading: Reading) -> Vec<Token<'_>> {
    let mut scanner = Scanner {
        text,
        chars: text.char_indices().peekable(),
        line: 1,
        tokens: Vec::new(),
        reading,
    };
    while let Some((at, c)) = scanner.next() {
        scanner.token(at, c);
    }
    scanner.tokens
}

struct Scanner<'t> {
    text: &'t str,
    chars: Peekable<CharIndices<'t>>,
    line: usize,
    tokens: Vec<Token<'t>>,
    reading: Reading,
}

impl<'t> Scanner<'t> {
    fn next(&mut self) -> Option<(usize, char)> {
        let next = self.chars.next();
        self.line += usize::from(matches!(next, Some((_, '\n'))));
        next
    }

    fn peek(&mut self) -> Option<char> {
        self.chars.peek().map(|(_, c)| *c)
    }

    /// The rest of the text.
    fn rest(&mut self) -> &'t str {
        let at = self.chars.peek().map_or(self.text.len(), |(at, _)| *at);
        &self.text[at..]
    }

    /// Takes characters as long as they fit; gives where the first that does not begins.
    fn take_while(&mut self, fits: impl Fn(char) -> bool) -> usize {
        while self.peek().is_some_and(&fits) {
            self.next();
        }
        self.text.len() - self.rest().len()
    }

    fn push(&mut self, kind: Kind, from: usize, to: usize, line: usize) {
        let text = &self.text[from..to];
        self.tokens.push(Token { kind, text, line });
    }

    fn token(&mut self, at: usize, c: char) {
        let line = self.line;
        let is_code = self.reading == Reading::Code;
        match c {
            _ if c.is_whitespace() => {}
            '/' if is_code && self.peek() == Some('/') => {
                let end = self.take_while(|c| c != '\n');
                self.words(at, end, line);
            }
            '/' if is_code && self.peek() == Some('*') => self.block_comment(at),
            '"' | '`' if is_code => self.string(at, c),
            _ if c.is_ascii_digit() => self.number(at, line),
            _ if is_in_word(c) => {
                let end = self.take_while(is_in_word);
                self.push(Kind::Word, at, end, line);
            }
            _ => self.push(Kind::Sign, at, at + c.len_utf8(), line),
        }
    }

    /// The words of a comment of one line.
    fn words(&mut self, from: usize, to: usize, line: usize) {
        let mut begin = None;
        let text = &self.text[from..to];
        for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
            match (is_in_word(c), begin) {
                (true, None) => begin = Some(at),
                (false, Some(start)) => {
                    self.push(Kind::Comment, from + start, from + at, line);
                    begin = None;
                }
                _ => {}
            }
        }
    }

    /// A comment over lines, which may hold another one; without its end it is the rest of the text.
    fn block_comment(&mut self, at: usize) {
        self.next();
        let (mut depth, mut from, mut line) = (1, at, self.line);
        while let Some((end, c)) = self.next() {
            match (c, self.peek()) {
                ('\n', _) => {
                    self.words(from, end, line);
                    (from, line) = (end, self.line);
                }
                ('/', Some('*')) => {
                    self.next();
                    depth += 1;
                }
                ('*', Some('/')) => {
                    self.next();
                    depth -= 1;
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        let end = self.text.len() - self.rest().len();
        self.words(from, end, line);
    }

    /// A string; one in quotes ends with its line at the latest.
    fn string(&mut self, at: usize, quote: char) {
        let line = self.line;
        while let Some(c) = self.peek() {
            if c == '\n' && quote == '"' {
                break;
            }
            self.next();
            if c == '\\' {
                self.next();
            } else if c == quote {
                break;
            }
        }
        let end = self.text.len() - self.rest().len();
        self.push(Kind::Text, at, end, line);
    }

    /// A number with fraction and exponent; a range such as `0..5` is two.
    fn number(&mut self, at: usize, line: usize) {
        let mut end = self.take_while(|c| c.is_ascii_digit() || c == '_');
        let digit_at =
            |text: &str, at: usize| text.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
        if self.peek() == Some('.') && digit_at(self.rest(), 1) {
            self.next();
            end = self.take_while(|c| c.is_ascii_digit() || c == '_');
        }
        if matches!(self.peek(), Some('e' | 'E')) {
            let rest = self.rest();
            let signed = usize::from(matches!(rest.as_bytes().get(1), Some(b'+' | b'-')));
            if digit_at(rest, 1 + signed) {
                for _ in 0..=signed {
                    self.next();
                }
                end = self.take_while(|c| c.is_ascii_digit());
            }
        }
        let plain = self.text[at..end].replace('_', "");
        match plain.parse() {
            Ok(value) if !self.peek().is_some_and(is_in_word) => {
                self.push(Kind::Number(value), at, end, line);
            }
            // 0x1f, or a name of digits and letters
            _ => {
                let end = self.take_while(is_in_word);
                self.push(Kind::Word, at, end, line);
            }
        }
    }
}

fn is_in_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<&str> {
        tokens(text, Reading::Code)
            .iter()
            .map(|token| token.text)
            .collect()
    }

    fn keys(text: &str, reading: Reading) -> Vec<u64> {
        tokens(text, reading).iter().map(Token::key).collect()
    }

    #[test]
    fn a_script_falls_into_its_parts() {
        assert_eq!(
            texts("let x=1.5e-3*q[0]; // the elbow's\nfor i in 0..5 { \"a // b\" }"),
            [
                "let",
                "x",
                "=",
                "1.5e-3",
                "*",
                "q",
                "[",
                "0",
                "]",
                ";",
                "the",
                "elbow",
                "s",
                "for",
                "i",
                "in",
                "0",
                ".",
                ".",
                "5",
                "{",
                "\"a // b\"",
                "}"
            ]
        );
        assert_eq!(
            texts("0x1f 2.max 1_000.5 x2"),
            ["0x1f", "2", ".", "max", "1_000.5", "x2"]
        );
        assert_eq!(texts("/* a /* b */ c */ d"), ["a", "b", "c", "d"]);
        assert_eq!(texts("`a\n b` \"open\nx"), ["`a\n b`", "\"open", "x"]);
        assert_eq!(texts("größe ≤ 日本"), ["größe", "≤", "日本"]);
    }

    #[test]
    fn lines_are_counted_through_comments_and_strings() {
        let found = tokens("/* a\nb */ `c\nd` e\n\nf", Reading::Code);
        let lines: Vec<(&str, usize)> =
            found.iter().map(|token| (token.text, token.line)).collect();
        assert_eq!(
            lines,
            [("a", 1), ("b", 2), ("`c\nd`", 2), ("e", 3), ("f", 5)]
        );
    }

    #[test]
    fn white_space_and_the_form_of_a_number_do_not_count() {
        let one = keys("let x = [2.150, -1];", Reading::Code);
        assert_eq!(one, keys("let x=[ 2.15 ,\n -1.0 ] ;", Reading::Code));
        assert_ne!(one, keys("let y = [2.15, -1];", Reading::Code));
        // what the brief says in prose is the same in a comment
        assert_eq!(
            keys("the elbow's angle", Reading::Prose)[0],
            keys("// the elbow", Reading::Code)[0]
        );
    }

    #[test]
    fn no_text_is_too_strange() {
        for text in [
            "",
            "\"",
            "`",
            "/*",
            "/",
            "\\",
            "\"\\",
            "1.",
            "1e",
            "1e+",
            ".5",
            "\u{0}\u{202E}",
            "//",
        ] {
            for reading in [Reading::Code, Reading::Prose] {
                let found = tokens(text, reading);
                assert!(found.len() <= text.len(), "{text:?}: {found:?}");
            }
        }
    }
}
