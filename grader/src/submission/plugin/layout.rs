//! The structures of `kinemark.h` as bytes in a module's memory: pointers and counts of four bytes, numbers of eight, little-endian.

use crate::submission::answer::numbers;
use crate::submission::controller::{RobotFacts, Value};

/// What a place for a number holds until something is written there: a NaN that no computation of a module has as its result.
pub(super) const UNWRITTEN: u64 = 0x7ff8_0000_006b_6d00;

/// A block of a module's memory that grows.
pub(super) struct Block {
    base: u32,
    bytes: Vec<u8>,
}

/// Where a structure's map is.
#[derive(Clone, Copy)]
pub(super) struct MapAt {
    fields: u32,
    count: u32,
}

/// Bytes of a `km_field`.
pub(super) const FIELD_BYTES: usize = 20;

impl Block {
    /// An empty block that begins at the address `base`.
    pub(super) fn at(base: u32) -> Self {
        Self {
            base,
            bytes: Vec::new(),
        }
    }

    /// Its bytes.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// The offset of the next value of eight bytes.
    pub(super) fn aligned(&mut self) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        self.bytes.len()
    }

    /// The address of an offset.
    pub(super) fn address(&self, offset: usize) -> u32 {
        // a block of 4 GB is refused where it gets its place
        self.base
            .wrapping_add(u32::try_from(offset).unwrap_or(u32::MAX))
    }

    /// Room for so many bytes, as zeros; its address.
    pub(super) fn room(&mut self, bytes: usize) -> u32 {
        let at = self.aligned();
        self.bytes.resize(at + bytes, 0);
        self.address(at)
    }

    /// Room for so many numbers, each NaN until somebody writes it; its address.
    pub(super) fn unwritten(&mut self, count: usize) -> u32 {
        self.numbers(&vec![f64::from_bits(UNWRITTEN); count])
    }

    pub(super) fn numbers(&mut self, numbers: &[f64]) -> u32 {
        let at = self.aligned();
        self.bytes
            .extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        self.address(at)
    }

    /// A text with a zero byte at its end.
    pub(super) fn text(&mut self, text: &str) -> u32 {
        let at = self.bytes.len();
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(0);
        self.address(at)
    }

    /// Appends a pointer or a count.
    pub(super) fn word(&mut self, word: u32) {
        self.bytes.extend_from_slice(&word.to_le_bytes());
    }

    /// Appends a number in a structure.
    pub(super) fn number(&mut self, number: f64) {
        self.bytes.extend_from_slice(&number.to_le_bytes());
    }

    /// Appends a `km_map` in a structure.
    pub(super) fn map_word(&mut self, map: MapAt) {
        self.word(map.fields);
        self.word(map.count);
    }

    /// The fields of a map.
    pub(super) fn map(&mut self, fields: &[Field]) -> MapAt {
        let placed: Vec<[u32; 5]> = fields.iter().map(|field| self.placed(field)).collect();
        let at = self.aligned();
        for field in &placed {
            for word in field {
                self.word(*word);
            }
        }
        MapAt {
            fields: self.address(at),
            count: count(placed.len()),
        }
    }

    fn placed(&mut self, field: &Field) -> [u32; 5] {
        let name = self.text(&field.name);
        match &field.content {
            Content::Numbers { numbers, columns } => [
                name,
                self.numbers(numbers),
                0,
                count(numbers.len()),
                count(*columns),
            ],
            Content::At {
                address,
                count: numbers,
                columns,
            } => [name, *address, 0, count(*numbers), count(*columns)],
            Content::Text(text) => [name, 0, self.text(text), count(text.len()), 0],
        }
    }

    /// A `km_robot`; its address.
    pub(super) fn robot(&mut self, robot: &RobotFacts) -> u32 {
        let name = self.text(&robot.name);
        let names: Vec<u32> = robot
            .joint_names
            .iter()
            .map(|name| self.text(name))
            .collect();
        let at = self.aligned();
        for name in &names {
            self.word(*name);
        }
        let joint_names = self.address(at);
        let [lower, upper, effort] =
            [&robot.lower, &robot.upper, &robot.effort].map(|limits| self.numbers(limits));
        let mut fields = Vec::new();
        for (name, value) in &robot.dimensions {
            flatten(name, value, &mut fields);
        }
        let dimensions = self.map(&fields);
        let at = self.aligned();
        for word in [name, count(names.len()), joint_names, lower, upper, effort] {
            self.word(word);
        }
        self.map_word(dimensions);
        self.address(at)
    }

    /// An empty `km_answer` with room for `fields` and `numbers`.
    pub(super) fn answer(&mut self, fields: usize, numbers: usize) -> AnswerAt {
        let room = self.room(fields * FIELD_BYTES);
        let space = self.unwritten(numbers);
        let at = self.aligned();
        for word in [room, 0, count(fields), space, 0, count(numbers)] {
            self.word(word);
        }
        AnswerAt {
            at: self.address(at),
            fields: room,
            count: self.address(at + 4),
        }
    }
}

/// The addresses of a `km_answer`, of its fields, and of how many of them are written.
pub(super) struct AnswerAt {
    pub(super) at: u32,
    pub(super) fields: u32,
    pub(super) count: u32,
}

/// A count in a structure.
pub(super) fn count(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// A `km_field` before it has a place.
pub(super) struct Field {
    pub(super) name: String,
    pub(super) content: Content,
}

/// What a field holds.
pub(super) enum Content {
    /// Numbers, and how many of them are a row: 0 for a single number.
    Numbers { numbers: Vec<f64>, columns: usize },
    /// Numbers that have a place already.
    At {
        address: u32,
        count: usize,
        columns: usize,
    },
    /// A text.
    Text(String),
}

/// The fields of a value: maps and mixed lists are taken apart, with the way to each value in its name.
pub(super) fn flatten(name: &str, value: &Value, fields: &mut Vec<Field>) {
    let mut add = |content| {
        fields.push(Field {
            name: name.to_owned(),
            content,
        });
    };
    match value {
        Value::Number(number) => add(Content::Numbers {
            numbers: vec![*number],
            columns: 0,
        }),
        Value::Boolean(boolean) => add(Content::Numbers {
            numbers: vec![f64::from(u8::from(*boolean))],
            columns: 0,
        }),
        Value::Text(text) | Value::Other(text) => add(Content::Text(text.clone())),
        Value::Nothing => {}
        Value::List(items) => {
            if let Some(numbers) = numbers(value) {
                let columns = numbers.len();
                return add(Content::Numbers { numbers, columns });
            }
            let rows: Option<Vec<Vec<f64>>> = items.iter().map(numbers).collect();
            let columns = rows.as_ref().and_then(|rows| Some(rows.first()?.len()));
            match (rows, columns) {
                (Some(rows), Some(columns))
                    if columns > 0 && rows.iter().all(|row| row.len() == columns) =>
                {
                    add(Content::Numbers {
                        numbers: rows.concat(),
                        columns,
                    });
                }
                _ => {
                    for (i, item) in items.iter().enumerate() {
                        flatten(&format!("{name}[{i}]"), item, fields);
                    }
                }
            }
        }
        Value::Map(entries) => {
            for (key, value) in entries {
                let name = if name.is_empty() {
                    key.clone()
                } else {
                    format!("{name}.{key}")
                };
                flatten(&name, value, fields);
            }
        }
    }
}
