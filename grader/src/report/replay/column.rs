//! Columns of numbers that change slowly, written small: whole multiples of a quantum, told by how their change changes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// What is farther from zero than so many quanta is told as if it were there: all differences stay whole numbers in a script.
const MOST_QUANTA: f64 = (1u64 << 40) as f64;

/// `width` columns of `count` numbers each.
///
/// Column after column: each number is a whole multiple of its column's quantum; of these the first, the first difference, and then
/// the differences of differences, each zigzag (0, -1, 1, -2 ... become 0, 1, 2, 3 ...) and as LEB128: seven bits a byte, the
/// lowest first, the eighth set where more follow.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Track {
    width: usize,
    count: usize,
    quanta: Vec<f64>,
    data: String,
}

impl Track {
    /// Characters of its data.
    pub(super) fn size(&self) -> usize {
        self.data.len()
    }

    /// Its data alone.
    pub(super) fn into_data(self) -> String {
        self.data
    }
}

/// Columns in the making: whole multiples of their quanta.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Columns {
    quanta: Vec<f64>,
    columns: Vec<Vec<i64>>,
}

impl Columns {
    /// Empty columns of these quanta.
    pub(super) fn new(quanta: &[f64]) -> Self {
        Self {
            quanta: quanta.to_vec(),
            columns: vec![Vec::new(); quanta.len()],
        }
    }

    /// Adds a number to every column, each finite.
    pub(super) fn push(&mut self, row: &[f64]) {
        for ((column, quantum), value) in self.columns.iter_mut().zip(&self.quanta).zip(row) {
            let quanta = (value / quantum).round();
            column.push(quanta.clamp(-MOST_QUANTA, MOST_QUANTA) as i64);
        }
    }

    /// Whether no column ever changes.
    pub(super) fn stands_still(&self) -> bool {
        let still = |column: &Vec<i64>| column.windows(2).all(|pair| pair[0] == pair[1]);
        self.columns.iter().all(still)
    }

    /// The columns, written.
    pub(super) fn track(&self) -> Track {
        let count = self.columns.first().map_or(0, Vec::len);
        let mut bytes = Vec::with_capacity(count * self.columns.len() * 5 / 4);
        for column in &self.columns {
            write(column, &mut bytes);
        }
        Track {
            width: self.columns.len(),
            count,
            quanta: self.quanta.clone(),
            data: STANDARD.encode(&bytes),
        }
    }
}

fn write(column: &[i64], bytes: &mut Vec<u8>) {
    let (mut before, mut step) = (0, 0);
    for (i, value) in column.iter().enumerate() {
        let change = value - before;
        // the first number and the first difference stand for themselves
        let told = if i < 2 { change } else { change - step };
        before = *value;
        step = if i == 0 { 0 } else { change };
        let mut rest = ((told << 1) ^ (told >> 63)) as u64;
        while rest >= 0x80 {
            bytes.push(rest as u8 | 0x80);
            rest >>= 7;
        }
        bytes.push(rest as u8);
    }
}

/// Reads columns back, as a viewer does.
#[cfg(test)]
pub(super) fn read(width: usize, count: usize, quanta: &[f64], data: &str) -> Vec<Vec<f64>> {
    let bytes = STANDARD.decode(data).expect("base64");
    let mut bytes = bytes.into_iter();
    let mut columns = Vec::new();
    for quantum in &quanta[..width] {
        let (mut value, mut step, mut column) = (0i64, 0i64, Vec::new());
        for i in 0..count {
            let (mut told, mut shift) = (0u64, 0);
            loop {
                let byte = bytes.next().expect("a number a frame");
                told |= u64::from(byte & 0x7F) << shift;
                shift += 7;
                if byte < 0x80 {
                    break;
                }
            }
            let told = (told >> 1) as i64 ^ -((told & 1) as i64);
            let change = if i < 2 { told } else { step + told };
            value += change;
            step = if i == 0 { 0 } else { change };
            column.push(value as f64 * quantum);
        }
        columns.push(column);
    }
    assert_eq!(bytes.next(), None, "bytes after the last number");
    columns
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn written_by_hand() {
        let mut columns = Columns::new(&[1.0]);
        for value in [100.0, 110.0, 120.0, 131.0, 131.0] {
            columns.push(&[value]);
        }
        // 100, +10, 0, +1, -11 zigzag to 200 (two bytes), 20, 0, 2, 21
        let bytes = [0xC8, 0x01, 20, 0, 2, 21];
        assert_eq!(columns.track().data, STANDARD.encode(&bytes));
        assert!(!columns.stands_still());
    }

    #[test]
    fn nothing_and_numbers_beyond_reason() {
        assert_eq!(Columns::new(&[1.0, 1.0]).track().data, "");
        let mut columns = Columns::new(&[1e-5]);
        for value in [1e300, -1e300, 1e300, f64::INFINITY] {
            columns.push(&[value]);
        }
        let track = columns.track();
        let most = MOST_QUANTA * 1e-5;
        let read = read(1, 4, &[1e-5], &track.data);
        assert_eq!(read, [[most, -most, most, most]]);
    }

    proptest! {
        #[test]
        fn what_is_read_is_what_was_written(rows in proptest::collection::vec([-1e4..1e4f64, -1.0..1.0f64], 0..60)) {
            let quanta = [1e-5, 2e-5];
            let mut columns = Columns::new(&quanta);
            for row in &rows {
                columns.push(row);
            }
            let track = columns.track();
            let read = read(2, rows.len(), &quanta, &track.data);
            for (i, row) in rows.iter().enumerate() {
                for c in 0..2 {
                    // half a quantum, and the rounding of numbers of this size
                    prop_assert!((read[c][i] - row[c]).abs() <= 0.5 * quanta[c] + 1e-11);
                }
            }
        }
    }
}
