//! Values in words, for messages, and as text, for `print`.

use std::fmt::Write;

use rhai::{Array, Dynamic, ImmutableString, Map};

use super::budget::Meter;
use super::mistake::{Fault, Problem};
use super::vector::{Matrix, Vector};
use crate::submission::controller::Budget;

/// A value in words: `the number 2`, `a vector of 3`.
pub(super) fn describe(value: &Dynamic) -> String {
    if let Ok(whole) = value.as_int() {
        format!("the number {whole}")
    } else if let Ok(float) = value.as_float() {
        format!("the number {}", number(float))
    } else if let Ok(boolean) = value.as_bool() {
        boolean.to_string()
    } else if value.is_unit() {
        "nothing `()`".to_owned()
    } else if let Ok(text) = value.as_immutable_string_ref() {
        let start: String = text.chars().take(20).collect();
        let dots = if start.len() < text.len() { "..." } else { "" };
        format!("the string \"{start}{dots}\"")
    } else if let Some(vector) = value.read_lock::<Vector>() {
        format!("a vector of {}", vector.len())
    } else if let Some(matrix) = value.read_lock::<Matrix>() {
        format!("a {}x{} matrix", matrix.rows(), matrix.columns())
    } else if let Ok(list) = value.as_array_ref() {
        format!("a list of {}", list.len())
    } else if value.is_map() {
        "a map".to_owned()
    } else {
        kind(value).to_owned()
    }
}

/// The names of the other types of the language.
pub(super) fn kind(value: &Dynamic) -> &'static str {
    if value.is_fnptr() {
        "a function"
    } else if value.is_char() {
        "a character"
    } else {
        "a range"
    }
}

/// A number as the shortest text that reads back to the same bits.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if size >= 1e16 || (size > 0.0 && size < 1e-5) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// A value as text, within the budget of a text.
pub(super) fn show(meter: &Meter, value: &Dynamic) -> Result<String, Problem> {
    let mut text = String::new();
    write_value(&mut text, value, false, &|bytes| {
        meter.within(Budget::TextSize, bytes)
    })?;
    meter.charge(text.len())?;
    Ok(text)
}

/// A value as text, cut short; for messages.
pub(super) fn show_briefly(value: &Dynamic) -> String {
    const LONGEST: usize = 200;
    let mut text = String::new();
    let cut = write_value(&mut text, value, false, &|length| {
        if length <= LONGEST {
            Ok(())
        } else {
            Err(super::mistake::fault(""))
        }
    });
    if cut.is_err() {
        text = text.chars().take(LONGEST).collect::<String>() + "...";
    }
    text
}

type Check<'a> = &'a dyn Fn(usize) -> Result<(), Problem>;

fn write_value(
    text: &mut String,
    value: &Dynamic,
    quoted: bool,
    check: Check<'_>,
) -> Result<(), Problem> {
    if let Ok(whole) = value.as_int() {
        // writing to a String cannot fail
        let _ = write!(text, "{whole}");
    } else if let Ok(float) = value.as_float() {
        text.push_str(&number(float));
    } else if let Ok(boolean) = value.as_bool() {
        let _ = write!(text, "{boolean}");
    } else if let Ok(content) = value.as_immutable_string_ref() {
        write_text(text, &content, quoted);
    } else if let Some(vector) = value.read_lock::<Vector>() {
        write_sequence(text, vector.elements().iter(), check, |text, element| {
            text.push_str(&number(*element));
            Ok(())
        })?;
    } else if let Some(matrix) = value.read_lock::<Matrix>() {
        write_sequence(text, 0..matrix.rows(), check, |text, row| {
            let row = matrix.row(row);
            write_sequence(text, row.elements().iter(), check, |text, element| {
                text.push_str(&number(*element));
                Ok(())
            })
        })?;
    } else if let Ok(list) = value.as_array_ref() {
        let list: &Array = &list;
        write_sequence(text, list.iter(), check, |text, element| {
            write_value(text, element, true, check)
        })?;
    } else if let Ok(map) = value.as_map_ref() {
        let map: &Map = &map;
        text.push('#');
        text.push('{');
        for (index, (key, element)) in map.iter().enumerate() {
            if index > 0 {
                text.push_str(", ");
            }
            text.push_str(key);
            text.push_str(": ");
            write_value(text, element, true, check)?;
            check(text.len())?;
        }
        text.push('}');
    } else if let Some(fault) = value.read_lock::<Fault>() {
        text.push_str(&fault.message);
    } else if value.is_unit() {
        text.push_str("()");
    } else if let Ok(character) = value.as_char() {
        text.push(character);
    } else {
        text.push_str(kind(value));
    }
    check(text.len())
}

fn write_text(text: &mut String, content: &ImmutableString, quoted: bool) {
    if quoted {
        let _ = write!(text, "{:?}", content.as_str());
    } else {
        text.push_str(content);
    }
}

fn write_sequence<T>(
    text: &mut String,
    elements: impl Iterator<Item = T>,
    check: Check<'_>,
    mut write: impl FnMut(&mut String, T) -> Result<(), Problem>,
) -> Result<(), Problem> {
    text.push('[');
    for (index, element) in elements.enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        write(text, element)?;
        // a list may hold one shared vector a thousand times: stop at the first element too many
        check(text.len())?;
    }
    text.push(']');
    check(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        assert_eq!(number(2.0), "2");
        assert_eq!(number(0.1 + 0.2), "0.30000000000000004");
        assert_eq!(number(1e300), "1e300");
        assert_eq!(number(-2.5e-9), "-2.5e-9");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(f64::INFINITY), "inf");
        assert_eq!(number(f64::NAN), "NaN");
    }

    #[test]
    fn values_are_named_with_their_size() {
        assert_eq!(
            describe(&Dynamic::from(Vector::new(&[1.0, 2.0]))),
            "a vector of 2"
        );
        assert_eq!(describe(&Dynamic::UNIT), "nothing `()`");
        assert_eq!(describe(&Dynamic::from(true)), "true");
        assert_eq!(describe(&"abc".into()), "the string \"abc\"");
    }
}
