//! Arithmetic over named numbers: `+ - * /`, parentheses, names and indexing, as in `"link_lengths[0] / 2"`, and the functions and
//! the constant of trigonometry, as in `"0.3 * cos(pi / 6)"`.

use std::ops::Range;

use super::{Dimension, Dimensions, Source};

/// An error in an expression, with the bytes that cause it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionProblem {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// Bytes of the expression's own text.
    pub at: Range<usize>,
}

/// The value of `text` over `dimensions`; the result is finite.
///
/// # Errors
/// An unknown name, a missing or superfluous index, a stray character, or a result that is not finite.
pub fn evaluate(text: &str, dimensions: &Dimensions) -> Result<f64, ExpressionProblem> {
    evaluate_named(text, dimensions, "dimension")
}

/// As [`evaluate`], over values that messages call `noun` (`dimension`, `parameter`).
///
/// # Errors
/// Those of [`evaluate`].
pub fn evaluate_named(
    text: &str,
    dimensions: &Dimensions,
    noun: &'static str,
) -> Result<f64, ExpressionProblem> {
    let mut reader = Reader {
        text,
        at: 0,
        depth: 0,
        dimensions,
        noun,
    };
    let value = reader.sum()?;
    reader.skip_spaces();
    if reader.at < text.len() {
        return Err(reader.stray("expected an operator (+ - * /) or the end"));
    }
    if !value.is_finite() {
        return Err(problem(
            format!("`{text}` is {value}"),
            Some("divide by something that is not zero".to_owned()),
            0..text.len(),
        ));
    }
    Ok(value)
}

/// The mark of an expression: optional where only a number is valid, required where a string is valid too.
pub const MARK: char = '=';

/// The value of the TOML string `typed`, with its mark or without. It is at `span` of `source`, quotes included.
///
/// # Errors
/// Those of [`evaluate`], at bytes of `source`.
pub fn evaluate_in(
    source: &Source,
    span: &Range<usize>,
    typed: &str,
    dimensions: &Dimensions,
    noun: &'static str,
) -> Result<f64, ExpressionProblem> {
    let expression = typed.strip_prefix(MARK).unwrap_or(typed);
    evaluate_named(expression, dimensions, noun).map_err(|problem| {
        // after the quote; a string with escapes has other bytes in the source than it has as text
        let start = span.start + 1;
        let is_as_typed = source.text().get(start..start + typed.len()) == Some(typed);
        let before = start + typed.len() - expression.len();
        let at = if is_as_typed {
            before + problem.at.start..before + problem.at.end
        } else {
            span.clone()
        };
        ExpressionProblem { at, ..problem }
    })
}

/// A function of an expression.
#[derive(Clone, Copy)]
enum Function {
    OfOne(fn(f64) -> f64),
    OfTwo(fn(f64, f64) -> f64),
}

/// The functions by their names; angles are in radians. All are of `libm`, so that they have the same bits everywhere.
const FUNCTIONS: [(&str, Function); 12] = [
    ("sin", Function::OfOne(libm::sin)),
    ("cos", Function::OfOne(libm::cos)),
    ("tan", Function::OfOne(libm::tan)),
    ("asin", Function::OfOne(libm::asin)),
    ("acos", Function::OfOne(libm::acos)),
    ("atan", Function::OfOne(libm::atan)),
    ("atan2", Function::OfTwo(libm::atan2)),
    ("hypot", Function::OfTwo(libm::hypot)),
    ("sqrt", Function::OfOne(libm::sqrt)),
    ("abs", Function::OfOne(libm::fabs)),
    ("min", Function::OfTwo(libm::fmin)),
    ("max", Function::OfTwo(libm::fmax)),
];

const MAX_DEPTH: usize = 64; // parentheses and signs: enough for any real expression, and far below the limit of the stack

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    dimensions: &'a Dimensions,
    noun: &'static str,
}

fn problem(message: String, help: Option<String>, at: Range<usize>) -> ExpressionProblem {
    ExpressionProblem { message, help, at }
}

impl Reader<'_> {
    fn skip_spaces(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn peek(&mut self) -> Option<char> {
        self.skip_spaces();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn stray(&self, expected: &str) -> ExpressionProblem {
        match self.text[self.at..].chars().next() {
            Some(c) => problem(
                format!("`{c}` does not belong in an expression here"),
                Some(expected.to_owned()),
                self.at..self.at + c.len_utf8(),
            ),
            None => problem(
                "the expression ends too early".to_owned(),
                Some(expected.to_owned()),
                0..self.text.len(),
            ),
        }
    }

    fn sum(&mut self) -> Result<f64, ExpressionProblem> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, ExpressionProblem> {
        let mut value = self.factor()?;
        loop {
            if self.take('*') {
                value *= self.factor()?;
            } else if self.take('/') {
                value /= self.factor()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn factor(&mut self) -> Result<f64, ExpressionProblem> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(problem(
                format!("more than {MAX_DEPTH} signs and parentheses inside each other"),
                None,
                0..self.text.len(),
            ));
        }
        let value = if self.take('-') {
            -self.factor()?
        } else if self.take('+') {
            self.factor()?
        } else if self.take('(') {
            let value = self.sum()?;
            if !self.take(')') {
                return Err(self.stray("expected `)`"));
            }
            value
        } else {
            match self.peek() {
                Some(c) if c.is_ascii_digit() || c == '.' => self.number()?,
                Some(c) if c.is_ascii_alphabetic() || c == '_' => self.dimension()?,
                _ => {
                    return Err(
                        self.stray(&format!("expected a number, a {}'s name or `(`", self.noun))
                    );
                }
            }
        };
        self.depth -= 1;
        Ok(value)
    }

    fn number(&mut self) -> Result<f64, ExpressionProblem> {
        let start = self.at;
        let bytes = self.text.as_bytes();
        while self.at < bytes.len() {
            let c = bytes[self.at];
            let exponent_sign =
                (c == b'+' || c == b'-') && matches!(bytes[self.at - 1], b'e' | b'E');
            if !(c.is_ascii_digit() || matches!(c, b'.' | b'e' | b'E') || exponent_sign) {
                break;
            }
            self.at += 1;
        }
        let digits = &self.text[start..self.at];
        digits
            .parse()
            .map_err(|_| problem(format!("`{digits}` is not a number"), None, start..self.at))
    }

    /// The value of a function whose name was read, at its parenthesis.
    fn call(&mut self, name: &str, name_at: Range<usize>) -> Result<f64, ExpressionProblem> {
        let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) else {
            let known = FUNCTIONS.iter().map(|(known, _)| *known);
            return Err(problem(
                format!("no function of expressions is called `{name}`"),
                Some(crate::text::suggest(name, "functions", known)),
                name_at,
            ));
        };
        self.take('(');
        let first = self.sum()?;
        let value = match function {
            Function::OfOne(f) => f(first),
            Function::OfTwo(f) => {
                if !self.take(',') {
                    return Err(self.stray(&format!("expected `,`: `{name}` takes two numbers")));
                }
                f(first, self.sum()?)
            }
        };
        if !self.take(')') {
            return Err(self.stray("expected `)`"));
        }
        if value.is_nan() {
            let typed = &self.text[name_at.start..self.at];
            return Err(problem(
                format!("`{typed}` has no value"),
                Some(format!(
                    "`{name}` is asked for a number that it is not defined for"
                )),
                name_at.start..self.at,
            ));
        }
        Ok(value)
    }

    fn dimension(&mut self) -> Result<f64, ExpressionProblem> {
        let start = self.at;
        let rest = &self.text[start..];
        let length = rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(rest.len());
        self.at += length;
        let name = &self.text[start..self.at];
        let name_at = start..self.at;
        let dimensions = self.dimensions;
        if self.peek() == Some('(') {
            return self.call(name, name_at);
        }
        let Some(dimension) = dimensions.get(name) else {
            // a name of the file comes before the constant
            if name == "pi" {
                return Ok(std::f64::consts::PI);
            }
            return Err(problem(
                format!("no {} is called `{name}`", self.noun),
                Some(crate::text::suggest(
                    name,
                    &format!("{}s", self.noun),
                    dimensions.names(),
                )),
                name_at,
            ));
        };
        match dimension {
            Dimension::Number(value) => {
                if self.peek() == Some('[') {
                    return Err(problem(
                        format!("`{name}` is one number and takes no index"),
                        Some(format!("write `{name}`")),
                        start..self.at + 1,
                    ));
                }
                Ok(*value)
            }
            Dimension::Text(_) => Err(problem(
                format!("`{name}` is a text, and an expression is over numbers"),
                Some(format!("write \"= {name}\" alone where a text belongs")),
                name_at,
            )),
            Dimension::List(values) => {
                let last = values.len().saturating_sub(1);
                let help = Some(match values.len() {
                    1 => format!("`{name}` has 1 number: there is only {name}[0]"),
                    count => {
                        format!("write `{name}[0]` to `{name}[{last}]`: it has {count} numbers")
                    }
                });
                if !self.take('[') {
                    return Err(problem(
                        format!("`{name}` is a list and needs an index"),
                        help,
                        name_at,
                    ));
                }
                self.skip_spaces();
                let index_start = self.at;
                while self.text[self.at..].starts_with(|c: char| c.is_ascii_digit()) {
                    self.at += 1;
                }
                let index = self.text[index_start..self.at].parse::<usize>().ok();
                let index_at = index_start..self.at.max(index_start + 1).min(self.text.len());
                if !self.take(']') {
                    return Err(self.stray("expected `]` after an integer index"));
                }
                index
                    .and_then(|i| values.get(i).copied())
                    .ok_or_else(|| problem("no such index".to_owned(), help, index_at))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dimensions() -> Dimensions {
        Dimensions::from_pairs([
            ("h".to_owned(), Dimension::Number(2.0)),
            ("l".to_owned(), Dimension::List(vec![1.0, 3.0])),
        ])
    }

    #[test]
    fn arithmetic_keeps_the_usual_order() {
        let d = dimensions();
        assert_eq!(evaluate("h - l[1] * 2 / 4 + (1 - -1)", &d), Ok(2.5));
        assert_eq!(evaluate("-h/2-l[0]", &d), Ok(-2.0));
        assert_eq!(evaluate("1e-3 * 2.", &d), Ok(2e-3));
    }

    #[test]
    fn angles_have_their_functions_in_radians() {
        let d = dimensions();
        assert_eq!(evaluate("h * sin(pi / 2)", &d), Ok(2.0));
        assert_eq!(evaluate("atan2(0, -1) - pi", &d), Ok(0.0));
        assert_eq!(
            evaluate("hypot(l[1], 2 * h) + sqrt(4) * abs(-1)", &d),
            Ok(7.0)
        );
        assert_eq!(evaluate("max(h, l[1]) - min (h , l[1])", &d), Ok(1.0));
        assert_eq!(
            evaluate("cos(0.3)", &d).map(f64::to_bits),
            Ok(libm::cos(0.3).to_bits())
        );
        let own = Dimensions::from_pairs([("pi".to_owned(), Dimension::Number(3.0))]);
        assert_eq!(evaluate("2 * pi", &own), Ok(6.0));
    }

    #[test]
    fn problems_point_at_their_bytes() {
        let d = dimensions();
        for (text, at) in [
            ("h + m", 4..5),
            ("l", 0..1),
            ("l[2]", 2..3),
            ("h[0]", 0..2),
            ("h $ 1", 2..3),
            ("1.2.3", 0..5),
            ("h / (1 - 1)", 0..11),
            ("(h", 0..2),
            ("1 + sine(h)", 4..8),
            ("h(2)", 0..1),
            ("sin h", 0..3),
            ("sin(h", 0..5),
            ("sin(h, 1)", 5..6),
            ("atan2(h)", 7..8),
            ("1 + sqrt(-h)", 4..12),
            ("acos(h) + 1", 0..7),
        ] {
            assert_eq!(evaluate(text, &d).unwrap_err().at, at, "{text}");
        }
    }

    #[test]
    fn an_index_that_is_missing_is_reported_with_those_there_are() {
        let mut dimensions = dimensions();
        dimensions = Dimensions::from_pairs(
            (dimensions.names().map(str::to_owned))
                .filter_map(|name| Some((name.clone(), dimensions.get(&name)?.clone())))
                .chain([("right".to_owned(), Dimension::List(vec![1.0]))]),
        );
        for (text, help) in [
            ("right", "`right` has 1 number: there is only right[0]"),
            ("right[1]", "`right` has 1 number: there is only right[0]"),
            ("l[2]", "write `l[0]` to `l[1]`: it has 2 numbers"),
        ] {
            let problem = evaluate(text, &dimensions).unwrap_err();
            assert_eq!(problem.help.as_deref(), Some(help), "{text}");
        }
    }

    #[test]
    fn problems_point_into_the_source_with_a_mark_and_without() {
        for (text, at) in [
            ("a = \"h + m\"", 9..10),
            ("a = \"= h + m\"", 11..12),
            ("a = \"=m\"", 6..7),
            // an escape: the whole text
            ("a = \"\\u003d m\"", 4..14),
        ] {
            let source = Source::new("x", text);
            let typed = if text.contains('u') {
                "= m"
            } else {
                &text[5..text.len() - 1]
            };
            let problem = evaluate_in(&source, &(4..text.len()), typed, &dimensions(), "dimension");
            assert_eq!(problem.unwrap_err().at, at, "{text}");
        }
        let source = Source::new("x", "\"= h * 2\"");
        assert_eq!(
            evaluate_in(&source, &(0..9), "= h * 2", &dimensions(), "dimension"),
            Ok(4.0)
        );
    }

    #[test]
    fn deep_nesting_is_refused_not_overflowed() {
        for text in ["(", "sin(", "-"] {
            assert!(evaluate(&text.repeat(100_000), &dimensions()).is_err());
        }
    }
}
