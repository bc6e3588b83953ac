//! Parses the return value of a submission: checks its shape and finiteness, or describes the invalid value.

use kinemark_sim::text::number::{list, trimmed};
use nalgebra::Vector3;

use crate::submission::controller::Value;
use crate::task::entry::Entry;
use crate::task::pose::PoseForm;

/// How the log says that the result of a built-in is no number: the end of its line.
pub const NOT_A_NUMBER: &str = "the result is not a number";

/// A position: three finite numbers \[m\].
///
/// # Errors
/// A description of the invalid value.
pub fn position(value: &Value) -> Result<Vector3<f64>, String> {
    match numbers(value).as_deref() {
        Some([x, y, z]) => finite(value, &[*x, *y, *z]).map(|()| Vector3::new(*x, *y, *z)),
        _ => Err(flat_instead(value, "3 numbers [x, y, z]")),
    }
}

/// Branches of `n` finite numbers each; one bare branch is accepted, and `[]` says there is none.
///
/// # Errors
/// A description of the invalid value; also for more than `most` branches.
pub fn branches(value: &Value, n: usize, most: usize) -> Result<Vec<Vec<f64>>, String> {
    let wrong = || {
        Err(instead(
            value,
            &format!("a list of branches of {n} numbers each, one branch, or []"),
        ))
    };
    let Value::List(items) = value else {
        return wrong();
    };
    let mut branches: Vec<Vec<f64>> = Vec::new();
    if let Some(bare) = numbers(value)
        && !items.is_empty()
    {
        branches.push(bare);
    } else {
        for item in items {
            match numbers(item) {
                Some(branch) => branches.push(branch),
                None => return wrong(),
            }
        }
    }
    if branches.iter().any(|branch| branch.len() != n) {
        return wrong();
    }
    if branches.len() > most {
        return Err(format!(
            "{} branches where at most {most} exist: return the right ones only",
            branches.len()
        ));
    }
    for branch in &branches {
        finite(value, branch)?;
    }
    Ok(branches)
}

/// A matrix of `rows` rows of `columns` finite numbers each, row by row; a single row may be bare.
///
/// # Errors
/// A description of the invalid value.
pub fn matrix(value: &Value, rows: usize, columns: usize) -> Result<Vec<Vec<f64>>, String> {
    let found: Option<Vec<Vec<f64>>> = match (value, numbers(value)) {
        (_, Some(bare)) if rows == 1 => Some(vec![bare]),
        (Value::List(items), _) => items.iter().map(numbers).collect(),
        _ => None,
    };
    let fits =
        |found: &[Vec<f64>]| found.len() == rows && found.iter().all(|row| row.len() == columns);
    match found {
        Some(found) if fits(&found) => {
            for row in &found {
                finite(value, row)?;
            }
            Ok(found)
        }
        found => {
            let shape = found.as_deref().and_then(|found| {
                let first = found.first()?.len();
                let even = found.iter().all(|row| row.len() == first);
                even.then(|| format!("{} x {first} numbers ", found.len()))
            });
            Err(format!(
                "{}{}, expected {rows} x {columns} numbers (rows x columns)",
                shape.unwrap_or_default(),
                describe(value)
            ))
        }
    }
}

/// The numbers of a pose in this form, those of a matrix row by row; the last row of a matrix must be that of a pose.
///
/// # Errors
/// A description of the invalid value.
pub fn pose(value: &Value, form: PoseForm) -> Result<Vec<f64>, String> {
    if form == PoseForm::Full {
        let rows = matrix(value, 4, 4)?;
        let [.., last] = rows.as_slice() else {
            return Err(instead(value, form.expected()));
        };
        if *last != [0.0, 0.0, 0.0, 1.0] {
            let message = format!("a matrix with the last row {}", list(last));
            return Err(format!("{message}, expected [0, 0, 0, 1] there"));
        }
        return Ok(rows.concat());
    }
    match numbers(value) {
        Some(found) if found.len() == form.numbers() => finite(value, &found).map(|()| found),
        _ => Err(flat_instead(value, form.expected())),
    }
}

/// The expected entries of a map, in their order: each is a finite number, or a list or matrix with the expected shape, its numbers row
/// by row. A single entry without a name is the answer itself.
///
/// A description of the invalid value, for each entry or for all of them.
pub fn entries(value: &Value, expected: &[(String, Entry)]) -> Vec<Result<Vec<f64>, String>> {
    let names = || expected.iter().map(|(name, _)| name.as_str());
    let entry = |(name, should): &(String, Entry)| {
        let (found, of) = match (value, name.as_str()) {
            (value, "") => (value, String::new()),
            (Value::Map(map), name) => {
                let Some((_, found)) = map.iter().find(|(key, _)| key == name) else {
                    return Err(format!("{}, without `{name}`", describe(value)));
                };
                (found, format!(" as `{name}`"))
            }
            _ => {
                let names: Vec<&str> = names().collect();
                return Err(instead(
                    value,
                    &format!("entries named {}", names.join(", ")),
                ));
            }
        };
        let numbers = match (should, found) {
            (Entry::Number(_), Value::Number(number)) => Some(vec![*number]),
            (Entry::Number(_), _) => None,
            // one joint has one number, with brackets or without
            (Entry::List(list), Value::Number(number)) if list.len() == 1 => Some(vec![*number]),
            (Entry::List(list), found) => numbers(found).filter(|found| found.len() == list.len()),
            (Entry::Matrix(rows), found) => {
                let columns = rows.first().map_or(0, Vec::len);
                let answered = matrix(found, rows.len(), columns);
                return answered
                    .map(|rows| rows.concat())
                    .map_err(|what| match of.as_str() {
                        "" => what,
                        of => format!("{what}{of}"),
                    });
            }
        };
        match numbers {
            None => {
                let (shown, wanted) = (describe(found), should.shape());
                let without = without_inner_brackets(found);
                Err(format!("{shown}{of}, expected {wanted}{without}"))
            }
            Some(numbers) if numbers.iter().all(|number| number.is_finite()) => Ok(numbers),
            Some(_) => Err(format!("{}{of}, expected finite numbers", describe(found))),
        }
    };
    expected.iter().map(entry).collect()
}

/// The entries of an answer under the names of `like`: numbers where that has numbers, lists of any length where it has lists, and
/// matrices of its shape where it has matrices.
///
/// # Errors
/// A description of the invalid value.
pub fn named_entries(
    value: &Value,
    like: &[(String, Entry)],
) -> Result<Vec<(String, Entry)>, String> {
    let length = |name: &str| match value {
        Value::Map(map) => match map.iter().find(|(key, _)| key == name) {
            Some((_, Value::List(items))) => items.len(),
            _ => 0,
        },
        Value::List(items) if name.is_empty() => items.len(),
        _ => 0,
    };
    let expected: Vec<(String, Entry)> = like
        .iter()
        .map(|(name, like)| match like {
            Entry::List(_) => (name.clone(), Entry::List(vec![0.0; length(name)])),
            like => (name.clone(), like.clone()),
        })
        .collect();
    let found = entries(value, &expected);
    let found: Vec<Vec<f64>> = found.into_iter().collect::<Result<_, _>>()?;
    let filled = expected.into_iter().zip(found);
    Ok(filled
        .map(|((name, kind), numbers)| (name, kind.with(&numbers)))
        .collect())
}

/// A command: `n` finite numbers; one bare number where `n` is 1.
///
/// # Errors
/// A description of the invalid value.
pub fn command(value: &Value, n: usize) -> Result<Vec<f64>, String> {
    let found = match value {
        Value::Number(number) if n == 1 => Some(vec![*number]),
        value => numbers(value),
    };
    match found {
        Some(numbers) if numbers.len() == n => finite(value, &numbers).map(|()| numbers),
        _ => Err(flat_instead(value, &format!("{n} numbers, one per joint"))),
    }
}

fn finite(value: &Value, numbers: &[f64]) -> Result<(), String> {
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(())
    } else {
        Err(instead(value, "finite numbers"))
    }
}

/// A message with the invalid value and the expectation.
fn instead(value: &Value, expected: &str) -> String {
    format!("{}, expected {expected}", describe(value))
}

/// The same where a flat list of numbers was expected.
fn flat_instead(value: &Value, expected: &str) -> String {
    instead(value, expected) + without_inner_brackets(value)
}

/// What to do about a matrix with a single row or column where a list of numbers was expected: numpy makes them all the time.
fn without_inner_brackets(value: &Value) -> &'static str {
    let Value::List(items) = value else {
        return "";
    };
    let is_column = |item: &Value| numbers(item).is_some_and(|row| row.len() == 1);
    let is_row = items.len() == 1 && items.iter().all(|item| numbers(item).is_some());
    match is_row || !items.is_empty() && items.iter().all(is_column) {
        true => ", without the inner brackets (in numpy `.ravel()`)",
        false => "",
    }
}

/// The numbers of a list of numbers.
pub(super) fn numbers(value: &Value) -> Option<Vec<f64>> {
    let Value::List(items) = value else {
        return None;
    };
    items
        .iter()
        .map(|item| match item {
            Value::Number(number) => Some(*number),
            _ => None,
        })
        .collect()
}

/// A value in a few words: `[1, NaN]`, `the text "up"`, `nothing`.
pub fn describe(value: &Value) -> String {
    let text = match value {
        Value::Nothing => {
            "nothing (does the function end without `return`, or in Rhai with `;`?)".to_owned()
        }
        Value::Text(text) => format!("the string {text:?}"),
        Value::Map(entries) if entries.is_empty() => "no entries".to_owned(),
        Value::Map(entries) => {
            let names: Vec<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
            format!("entries named {}", names.join(", "))
        }
        Value::Other(name) => format!("a value of type {name}"),
        Value::List(_) | Value::Number(_) | Value::Boolean(_) => plain(value, 0),
    };
    const LONGEST: usize = 120;
    if text.chars().count() > LONGEST {
        let start: String = text.chars().take(LONGEST).collect();
        format!("{start}…")
    } else {
        text
    }
}

fn plain(value: &Value, depth: usize) -> String {
    match value {
        Value::Nothing => "nothing".to_owned(),
        Value::Boolean(boolean) => boolean.to_string(),
        Value::Number(number) if number.is_finite() => trimmed(*number, 6),
        Value::Number(number) if number.is_nan() => "NaN".to_owned(),
        Value::Number(number) => if *number > 0.0 {
            "infinity"
        } else {
            "-infinity"
        }
        .to_owned(),
        Value::Text(text) => format!("{text:?}"),
        Value::List(_) if depth > 3 => "[…]".to_owned(),
        Value::List(items) => {
            let mut texts: Vec<String> = items
                .iter()
                .take(8)
                .map(|item| plain(item, depth + 1))
                .collect();
            if items.len() > 8 {
                texts.push(format!("… {} in all", items.len()));
            }
            format!("[{}]", texts.join(", "))
        }
        Value::Map(_) => "named entries".to_owned(),
        Value::Other(name) => name.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers_of(values: &[f64]) -> Value {
        Value::List(values.iter().copied().map(Value::Number).collect())
    }

    #[test]
    fn a_position_is_three_finite_numbers() {
        assert_eq!(
            position(&numbers_of(&[1.0, 2.0, 3.0])),
            Ok(Vector3::new(1.0, 2.0, 3.0))
        );
        assert!(
            position(&numbers_of(&[1.0, 2.0]))
                .unwrap_err()
                .starts_with("[1, 2], expected")
        );
        assert!(
            position(&numbers_of(&[1.0, f64::NAN, 0.0]))
                .unwrap_err()
                .contains("[1, NaN, 0]")
        );
        assert!(position(&Value::Nothing).unwrap_err().contains("nothing"));
    }

    #[test]
    fn a_row_or_a_column_of_a_matrix_is_to_lose_its_brackets() {
        let column = Value::List(vec![numbers_of(&[1.0]), numbers_of(&[2.0])]);
        let row = Value::List(vec![numbers_of(&[1.0, 2.0])]);
        for value in [&column, &row] {
            let what = command(value, 2).unwrap_err();
            assert!(what.ends_with("without the inner brackets (in numpy `.ravel()`)"));
        }
        let answer = Value::Map(vec![("a".into(), column)]);
        let expected = [("a".to_owned(), Entry::List(vec![0.0, 0.0]))];
        let what = entries(&answer, &expected).remove(0).unwrap_err();
        assert!(what.ends_with("(in numpy `.ravel()`)"), "{what}");
        for value in [numbers_of(&[1.0]), Value::List(Vec::new()), Value::Nothing] {
            assert!(!command(&value, 2).unwrap_err().contains("brackets"));
        }
    }

    #[test]
    fn branches_may_be_bare_many_or_none() {
        let bare = numbers_of(&[1.0, 2.0]);
        let both = Value::List(vec![numbers_of(&[1.0, 2.0]), numbers_of(&[3.0, 4.0])]);
        assert_eq!(branches(&bare, 2, 2), Ok(vec![vec![1.0, 2.0]]));
        assert_eq!(branches(&both, 2, 2).map(|b| b.len()), Ok(2));
        assert_eq!(branches(&numbers_of(&[]), 2, 2), Ok(vec![]));
        assert!(branches(&both, 2, 1).is_err());
        assert!(branches(&numbers_of(&[1.0, 2.0, 3.0]), 2, 2).is_err());
        assert!(branches(&Value::Number(1.0), 2, 2).is_err());
    }

    #[test]
    fn a_matrix_has_its_rows_and_columns() {
        let both = Value::List(vec![
            numbers_of(&[1.0, 2.0, 3.0]),
            numbers_of(&[4.0, 5.0, 6.0]),
        ]);
        let rows = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
        assert_eq!(matrix(&both, 2, 3), Ok(rows));
        assert_eq!(
            matrix(&both, 3, 2).unwrap_err(),
            "2 x 3 numbers [[1, 2, 3], [4, 5, 6]], expected 3 x 2 numbers (rows x columns)"
        );
        let uneven = Value::List(vec![numbers_of(&[1.0, 2.0]), numbers_of(&[4.0])]);
        assert!(
            matrix(&uneven, 2, 2)
                .unwrap_err()
                .starts_with("[[1, 2], [4]], expected")
        );
        assert_eq!(
            matrix(&numbers_of(&[1.0, 2.0]), 1, 2),
            Ok(vec![vec![1.0, 2.0]])
        );
        assert!(matrix(&numbers_of(&[1.0, 2.0]), 2, 1).is_err());
        assert!(matrix(&Value::Nothing, 1, 1).is_err());
        let nan = Value::List(vec![numbers_of(&[1.0, f64::NAN])]);
        assert!(matrix(&nan, 1, 2).unwrap_err().contains("finite"));
    }

    #[test]
    fn entries_are_found_by_name_each_for_itself() {
        let number = |name: &str, x| (name.to_owned(), Entry::Number(x));
        let map = |entries: &[(&str, Value)]| {
            Value::Map(
                entries
                    .iter()
                    .map(|(k, v)| ((*k).to_owned(), v.clone()))
                    .collect(),
            )
        };
        let expected = [
            number("a", 1.0),
            ("b".to_owned(), Entry::List(vec![1.0, 2.0])),
        ];
        let answer = map(&[("b", numbers_of(&[3.0, 4.0])), ("c", Value::Nothing)]);
        let found = entries(&answer, &expected);
        assert_eq!(found[0], Err("entries named b, c, without `a`".to_owned()));
        assert_eq!(found[1], Ok(vec![3.0, 4.0]));
        let found = entries(
            &map(&[("a", Value::Number(f64::NAN)), ("b", numbers_of(&[1.0]))]),
            &expected,
        );
        assert_eq!(
            found[0],
            Err("NaN as `a`, expected finite numbers".to_owned())
        );
        assert_eq!(
            found[1],
            Err("[1] as `b`, expected a list of 2 numbers".to_owned())
        );
        assert_eq!(
            entries(&Value::Number(1.0), &expected)[0],
            Err("1, expected entries named a, b".to_owned())
        );
        assert_eq!(
            entries(&Value::Number(7.0), &[number("", 1.0)]),
            [Ok(vec![7.0])]
        );
    }

    #[test]
    fn a_single_joint_may_be_commanded_by_a_number() {
        assert_eq!(command(&Value::Number(1.5), 1), Ok(vec![1.5]));
        assert!(command(&Value::Number(1.5), 2).is_err());
        assert!(
            command(&numbers_of(&[1.0, f64::INFINITY]), 2)
                .unwrap_err()
                .contains("infinity")
        );
    }
}
