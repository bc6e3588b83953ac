//! What a script keeps between calls, `this`, as values that can be kept and given back without losing a bit.

use rhai::{Array, Dynamic, Map};

use super::range::Range;
use super::vector::{Matrix, Vector};
use super::words::kind;
use crate::submission::controller::Kept;

/// `value` as it can be kept; the words for what cannot.
pub(super) fn keep(value: &Dynamic) -> Result<Kept, String> {
    Ok(if let Ok(number) = value.as_float() {
        Kept::Number(number)
    } else if let Ok(whole) = value.as_int() {
        Kept::Whole(whole)
    } else if let Some(vector) = value.read_lock::<Vector>() {
        Kept::Vector(vector.elements().to_vec())
    } else if let Some(matrix) = value.read_lock::<Matrix>() {
        Kept::Matrix {
            columns: matrix.columns(),
            elements: matrix.elements().collect(),
        }
    } else if let Ok(list) = value.as_array_ref() {
        let list: &Array = &list;
        Kept::List(list.iter().map(keep).collect::<Result<_, _>>()?)
    } else if let Ok(map) = value.as_map_ref() {
        let map: &Map = &map;
        let entries = map
            .iter()
            .map(|(key, element)| Ok((key.to_string(), keep(element)?)));
        Kept::Map(entries.collect::<Result<_, String>>()?)
    } else if let Ok(text) = value.as_immutable_string_ref() {
        Kept::Text(text.to_string())
    } else if let Ok(truth) = value.as_bool() {
        Kept::Boolean(truth)
    } else if let Ok(character) = value.as_char() {
        Kept::Character(character)
    } else if let Some(range) = Range::of(value) {
        Kept::Range {
            from: range.from,
            to: range.to,
        }
    } else if value.is_unit() {
        Kept::Nothing
    } else {
        return Err(kind(value).to_owned());
    })
}

/// The value that was kept.
pub(super) fn give_back(kept: &Kept) -> Dynamic {
    match kept {
        Kept::Nothing => Dynamic::UNIT,
        Kept::Boolean(truth) => (*truth).into(),
        Kept::Whole(whole) => (*whole).into(),
        Kept::Number(number) => (*number).into(),
        Kept::Character(character) => (*character).into(),
        Kept::Text(text) => text.as_str().into(),
        Kept::Vector(elements) => Dynamic::from(Vector::new(elements.clone())),
        Kept::Matrix { columns, elements } => {
            let rows = elements.len().checked_div(*columns).unwrap_or(0);
            let at = |i: usize, j: usize| elements[i * columns + j];
            Dynamic::from(Matrix::from_fn(rows, *columns, at))
        }
        Kept::Range { from, to } => Dynamic::from(Range {
            from: *from,
            to: *to,
        }),
        Kept::List(elements) => Dynamic::from_array(elements.iter().map(give_back).collect()),
        Kept::Map(entries) => Dynamic::from_map(
            entries
                .iter()
                .map(|(key, value)| (key.as_str().into(), give_back(value)))
                .collect(),
        ),
    }
}
