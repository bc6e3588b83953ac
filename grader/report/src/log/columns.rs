//! A JSON message as a row: every number, text and truth value in a column named by the way to it.

use std::collections::HashMap;
use std::sync::Arc;

use super::json::Json;

/// The first column of every table: the time of the message.
pub(super) const TIME: &str = "time_s";
/// As many as the widest spreadsheet has.
pub(super) const MOST_COLUMNS: usize = 16_384;
/// Characters of a column's name.
pub(super) const MOST_NAME: usize = 1_000;

/// What distinguishes the items of a list, if all of them have it and no two have the same.
const NAMES: [&str; 3] = ["name", "child_frame_id", "id"];

/// Columns of all tables of a log, and bytes of their names: what is held while they are written.
const MOST_OF_ALL: Budget = Budget {
    columns: 200_000,
    bytes: 16 << 20,
};

/// What the columns of a log's tables may still take, all together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget {
    columns: usize,
    bytes: usize,
}

impl Default for Budget {
    fn default() -> Self {
        MOST_OF_ALL
    }
}

impl Budget {
    fn take(&mut self, name: &str) -> Result<(), TooWide> {
        let columns = self.columns.checked_sub(1).ok_or(TooWide::All)?;
        let bytes = self.bytes.checked_sub(name.len()).ok_or(TooWide::All)?;
        *self = Self { columns, bytes };
        Ok(())
    }
}

/// Why a message does not fit a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TooWide {
    Columns,
    Name,
    /// The tables of the log together.
    All,
}

/// The columns of one topic, in the order of its messages.
#[derive(Debug, Default)]
pub(super) struct Columns {
    /// Numbers of columns, by name.
    by_name: HashMap<Arc<str>, usize>,
    /// Names by number.
    names: Vec<Arc<str>>,
    /// Numbers in the order of the table.
    order: Vec<usize>,
}

impl Columns {
    /// Names in the order of the table.
    pub(super) fn names(&self) -> Vec<Arc<str>> {
        let names = self.order.iter().map(|n| Arc::clone(&self.names[*n]));
        names.collect()
    }

    /// Takes in the columns of a message. A new one stands after the one that precedes it in the message, so that what is left out
    /// of the first message is in its place all the same.
    pub(super) fn learn(&mut self, message: &Json, left: &mut Budget) -> Result<(), TooWide> {
        let mut before: Option<usize> = None;
        walk(message, &mut |name, _| {
            let known = self.by_name.get(name).copied();
            let number = match known {
                Some(number) => number,
                None => {
                    left.take(name)?;
                    self.add(name, before)?
                }
            };
            before = Some(number);
            Ok(())
        })
    }

    fn add(&mut self, name: &str, before: Option<usize>) -> Result<usize, TooWide> {
        let number = self.names.len();
        if number >= MOST_COLUMNS {
            return Err(TooWide::Columns);
        }
        let last = before.and_then(|before| self.order.iter().rposition(|n| *n == before));
        self.order.insert(last.map_or(0, |last| last + 1), number);
        let name: Arc<str> = name.into();
        self.names.push(Arc::clone(&name));
        self.by_name.insert(name, number);
        Ok(number)
    }
}

/// Calls `each` with the name and the value of everything in a message that holds nothing else.
pub(super) fn walk<'a>(
    message: &'a Json,
    each: &mut dyn FnMut(&str, &'a Json) -> Result<(), TooWide>,
) -> Result<(), TooWide> {
    below(message, &mut String::new(), each)
}

fn below<'a>(
    value: &'a Json,
    path: &mut String,
    each: &mut dyn FnMut(&str, &'a Json) -> Result<(), TooWide>,
) -> Result<(), TooWide> {
    let mut inside = |part: &str, value: &'a Json, path: &mut String| -> Result<(), TooWide> {
        let length = path.len();
        if length > 0 {
            path.push('.');
        }
        push_part(path, part);
        if path.len() > MOST_NAME {
            return Err(TooWide::Name);
        }
        let done = below(value, path, each);
        path.truncate(length);
        done
    };
    match value {
        Json::Object(members) if !members.is_empty() => members
            .iter()
            .try_for_each(|(key, value)| inside(key, value, path)),
        Json::List(items) if !items.is_empty() => match names_of(items) {
            Some((by, names)) => items
                .iter()
                .zip(names)
                .try_for_each(|(item, name)| match item {
                    Json::Object(members) => {
                        let length = path.len();
                        let others = members.iter().filter(|(key, _)| key != by);
                        if length > 0 {
                            path.push('.');
                        }
                        push_part(path, name);
                        let done = others
                            .into_iter()
                            .try_for_each(|(key, value)| inside(key, value, path));
                        path.truncate(length);
                        done
                    }
                    _ => Ok(()),
                }),
            None => items
                .iter()
                .enumerate()
                .try_for_each(|(i, item)| inside(&i.to_string(), item, path)),
        },
        leaf => match path.as_str() {
            "" => each("value", leaf),
            // the first column has this name
            TIME => each(r"\time_s", leaf),
            path => each(path, leaf),
        },
    }
}

/// One part of a column's name; a dot in it is no end of it.
fn push_part(path: &mut String, part: &str) {
    for c in part.chars() {
        if matches!(c, '.' | '\\') {
            path.push('\\');
        }
        path.push(c);
    }
}

/// The parts of a column's name, as the message has them.
pub(super) fn parts(name: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut chars = name.chars();
    while let Some(c) = chars.next() {
        let last = match c {
            '.' => {
                parts.push(String::new());
                continue;
            }
            '\\' => chars.next(),
            c => Some(c),
        };
        if let Some(part) = parts.last_mut() {
            part.extend(last);
        }
    }
    parts
}

/// The names of a list of things, where they have them and each has its own.
fn names_of(items: &[Json]) -> Option<(&'static str, Vec<&str>)> {
    NAMES.into_iter().find_map(|by| {
        // what has only a name would leave no trace in the table
        let has_more = |item: &&Json| matches!(item, Json::Object(members) if members.len() > 1);
        let names = items
            .iter()
            .map(|item| Some(item).filter(has_more)?.text_of(by));
        let names: Option<Vec<&str>> = names.collect();
        let names = names?;
        let mut sorted = names.clone();
        sorted.sort_unstable();
        sorted
            .windows(2)
            .all(|pair| pair[0] != pair[1])
            .then_some((by, names))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(messages: &[&str]) -> Vec<String> {
        let mut columns = Columns::default();
        for message in messages {
            columns
                .learn(
                    &Json::parse(message.as_bytes()).unwrap(),
                    &mut Budget::default(),
                )
                .unwrap();
        }
        let names = columns.names();
        names.iter().map(|name| name.to_string()).collect()
    }

    #[test]
    fn things_with_names_are_identified_by_them() {
        let joints =
            r#"{"joints": [{"name": "hip", "position": 1}, {"position": 2, "name": "knee.2"}]}"#;
        assert_eq!(
            names(&[joints]),
            ["joints.hip.position", r"joints.knee\.2.position"]
        );
        let frames = r#"{"transforms": [{"parent_frame_id": "a", "child_frame_id": "b", "t": {"x": 1, "y": 2}}]}"#;
        assert_eq!(
            names(&[frames]),
            [
                "transforms.b.parent_frame_id",
                "transforms.b.t.x",
                "transforms.b.t.y"
            ]
        );
        // two of one name are identified by their indices
        assert_eq!(
            names(&[r#"[{"name": "a", "x": 1}, {"name": "a", "x": 2}]"#]),
            ["0.name", "0.x", "1.name", "1.x"]
        );
    }

    #[test]
    fn a_column_that_comes_late_stands_where_it_belongs() {
        let messages = [
            r#"{"a": 1, "c": 2}"#,
            r#"{"a": 1, "b": 2, "c": 3}"#,
            r#"{"0": 1, "a": 2}"#,
        ];
        assert_eq!(names(&messages), ["0", "a", "b", "c"]);
    }

    #[test]
    fn every_kind_of_message_has_columns() {
        assert_eq!(names(&["3"]), ["value"]);
        assert_eq!(
            names(&[r#"{"list": [], "object": {}, "lists": [[1], [2, 3]]}"#]),
            ["list", "object", "lists.0.0", "lists.1.0", "lists.1.1"]
        );
    }

    #[test]
    fn the_name_of_the_first_column_is_taken() {
        assert_eq!(
            names(&[r#"{"time_s": 1, "a": {"time_s": 2}, "\\time_s": 3}"#]),
            [r"\time_s", "a.time_s", r"\\time_s"]
        );
    }

    #[test]
    fn tables_have_bounds() {
        let wide = format!("[{}0]", "0,".repeat(MOST_COLUMNS));
        let wide = Json::parse(wide.as_bytes()).unwrap();
        let learn = |json: &Json| Columns::default().learn(json, &mut Budget::default());
        assert_eq!(learn(&wide), Err(TooWide::Columns));
        let long = format!(r#"{{"{}": 1}}"#, "n".repeat(MOST_NAME + 1));
        let long = Json::parse(long.as_bytes()).unwrap();
        assert_eq!(learn(&long), Err(TooWide::Name));
        // all tables together
        let mut left = Budget {
            columns: 3,
            bytes: 100,
        };
        let two = Json::parse(br#"{"a": 1, "b": 2}"#).unwrap();
        assert_eq!(Columns::default().learn(&two, &mut left), Ok(()));
        let again = Columns::default().learn(&two, &mut left);
        assert_eq!(again, Err(TooWide::All));
        left.columns = 100;
        let long = format!(r#"{{"{}": 1}}"#, "n".repeat(99));
        let long = Json::parse(long.as_bytes()).unwrap();
        let long = Columns::default().learn(&long, &mut left);
        assert_eq!(long, Err(TooWide::All));
    }
}
