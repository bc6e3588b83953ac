//! Expressions that are linear in a number known only later: `1.3 * reference + 0.05`.

use std::ops::Range;

use serde::Deserialize;
use serde::de::{Error as _, MapAccess, Visitor};

use super::expression::{ExpressionProblem, evaluate_in};
use super::{Dimension, Dimensions, Source};

/// `times` x + `plus`, where x is known later. In TOML a number, which does not depend on x, or what an expression that names x is
/// replaced by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// What x is multiplied by.
    pub times: f64,
    /// What is added.
    pub plus: f64,
}

impl Linear {
    /// A number that does not depend on x.
    pub fn constant(plus: f64) -> Self {
        Self { times: 0.0, plus }
    }

    /// Whether it depends on x.
    pub fn is_of_later(self) -> bool {
        self.times.abs() > 0.0
    }

    /// Its value at `x`.
    pub fn at(self, x: f64) -> f64 {
        if self.is_of_later() {
            self.times * x + self.plus
        } else {
            self.plus
        }
    }

    /// It as a TOML value that [`Linear`] is read from, and a number is not.
    pub(super) fn as_toml(self) -> String {
        format!("{{ times = {:?}, plus = {:?} }}", self.times, self.plus)
    }
}

/// Whether the expression `text` names `name`.
pub(super) fn names(text: &str, name: &str) -> bool {
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.split(|c| !is_of_name(c)).any(|word| word == name)
}

/// The expression `typed` at `span` of `source` as a linear one in `later`.
///
/// # Errors
/// Those of [`evaluate_in`], and an expression that is not linear in `later`.
pub(super) fn linear_in(
    source: &Source,
    span: &Range<usize>,
    typed: &str,
    named: &Dimensions,
    (noun, later): (&'static str, &'static str),
) -> Result<Linear, ExpressionProblem> {
    let with = |x: f64| {
        let mut named = named.clone();
        named.set(later.to_owned(), Dimension::Number(x));
        evaluate_in(source, span, typed, &named, noun)
    };
    let one = with(1.0)?;
    let not_linear = || ExpressionProblem {
        message: format!("this is not linear in `{later}`"),
        help: Some(format!(
            "multiply `{later}` by a number, add a number, or both: `= 1.3 * {later} + 0.05`"
        )),
        at: span.clone(),
    };
    let plus = with(0.0).map_err(|_| not_linear())?;
    let linear = Linear {
        times: without_rounding(one - plus),
        plus,
    };
    // three points and the line through two of them, but for rounding
    for x in [3.0, -7.5] {
        let (value, expected) = (with(x).map_err(|_| not_linear())?, linear.at(x));
        if (value - expected).abs() > 1e-9 * (1.0 + value.abs() + expected.abs()) {
            return Err(not_linear());
        }
    }
    Ok(linear)
}

/// To 12 significant digits: what is left of a difference is 1.3, not 1.3000000000000003.
fn without_rounding(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

impl From<f64> for Linear {
    fn from(number: f64) -> Self {
        Self::constant(number)
    }
}

impl<'de> Deserialize<'de> for Linear {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrLinear;
        impl<'de> Visitor<'de> for NumberOrLinear {
            type Value = Linear;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("f64")
            }
            fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Linear, E> {
                Ok(Linear::constant(number))
            }
            fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<Linear, E> {
                Ok(Linear::constant(number as f64))
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Linear, A::Error> {
                let (mut times, mut plus) = (None, None);
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "times" => times = Some(map.next_value()?),
                        "plus" => plus = Some(map.next_value()?),
                        _ => return Err(A::Error::custom("invalid type: map, expected f64")),
                    }
                }
                match (times, plus) {
                    (Some(times), Some(plus)) => Ok(Linear { times, plus }),
                    _ => Err(A::Error::custom("invalid type: map, expected f64")),
                }
            }
        }
        deserializer.deserialize_any(NumberOrLinear)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(typed: &str) -> Result<Linear, ExpressionProblem> {
        let source = Source::new("lab.toml", format!("\"{typed}\""));
        let named = Dimensions::from_pairs([("slack".to_owned(), Dimension::Number(0.25))]);
        let span = 0..typed.len() + 2;
        linear_in(&source, &span, typed, &named, ("parameter", "reference"))
    }

    #[test]
    fn a_factor_and_a_sum_are_linear() {
        for (typed, times, plus) in [
            ("= reference", 1.0, 0.0),
            ("= 1.3 * reference", 1.3, 0.0),
            ("= reference + 0.05", 1.0, 0.05),
            ("= 2 * (reference - slack) / 4", 0.5, -0.125),
            ("= -reference", -1.0, 0.0),
            ("= reference + 0.1", 1.0, 0.1),
        ] {
            let linear = read(typed).unwrap();
            assert_eq!(linear.times, times, "{typed}");
            assert!((linear.plus - plus).abs() < 1e-15, "{typed}: {linear:?}");
            let at = linear.at(3.0);
            assert!((at - (3.0 * times + plus)).abs() < 1e-14, "{typed}: {at}");
        }
        assert_eq!(Linear::constant(2.0).at(f64::NAN), 2.0);
    }

    #[test]
    fn what_is_not_linear_is_refused_in_words() {
        for typed in [
            "= 1 / reference",
            "= reference * reference",
            "= 1 / (reference - 3)",
        ] {
            let problem = read(typed).unwrap_err();
            assert_eq!(
                problem.message, "this is not linear in `reference`",
                "{typed}"
            );
        }
        let problem = read("= 2 * referenc + reference").unwrap_err();
        assert!(
            problem.message.contains("`referenc`"),
            "{}",
            problem.message
        );
    }

    #[test]
    fn a_name_is_found_as_a_whole_word() {
        assert!(names("= 2*reference", "reference"));
        assert!(!names("= 2*reference_speed + a.reference2", "reference"));
    }
}
