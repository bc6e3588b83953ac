//! Columns of numbers that change evenly, written small: whole multiples of a quantum, given by how far they are from where the two
//! before them lead.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// A number farther from zero than so many quanta is written as this many: all differences stay exact integers in a script.
const MOST_QUANTA: f64 = (1u64 << 40) as f64;

/// How many quanta a number is, limited to [`MOST_QUANTA`] in either direction.
pub(super) fn quanta_of(value: f64, quantum: f64) -> i64 {
    (value / quantum).round().clamp(-MOST_QUANTA, MOST_QUANTA) as i64
}

/// `width` columns of `count` numbers each, one at each of its frames.
///
/// Column after column: each number is a whole multiple of its column's quantum. Written are the first of them, the first difference, and
/// then how far each is from the line through the two before it, at its tick, rounded to the nearest whole (half up). All are zigzag
/// (0, -1, 1, -2 ... become 0, 1, 2, 3 ...) and LEB128: seven bits a byte, the lowest first, the eighth set where more follow.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Track {
    width: usize,
    count: usize,
    quanta: Vec<f64>,
    /// The tick of each frame, as a column; none of numbers at a fixed period.
    #[serde(skip_serializing_if = "Option::is_none")]
    ticks: Option<String>,
    /// How far the way between frames is from the run's at most \[m or rad\].
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<f64>,
    data: String,
}

impl Track {
    /// Rows at a fixed period.
    pub(super) fn even<R: AsRef<[f64]>>(quanta: &[f64], rows: impl Iterator<Item = R>) -> Self {
        Self::of(None, quanta, rows)
    }

    /// Rows at `ticks`, one each, which the page has already.
    pub(super) fn at<R: AsRef<[f64]>>(
        ticks: &[usize],
        quanta: &[f64],
        rows: impl Iterator<Item = R>,
    ) -> Self {
        Self::of(Some(ticks), quanta, rows)
    }

    /// Rows at `ticks`, one each, between which the way is `within` of the run's \[m or rad\].
    pub(super) fn through<R: AsRef<[f64]>>(
        ticks: &[usize],
        quanta: &[f64],
        rows: impl Iterator<Item = R>,
        within: f64,
    ) -> Self {
        Self {
            ticks: Some(tick_column(ticks)),
            within: Some(within),
            ..Self::of(Some(ticks), quanta, rows)
        }
    }

    fn of<R: AsRef<[f64]>>(
        ticks: Option<&[usize]>,
        quanta: &[f64],
        rows: impl Iterator<Item = R>,
    ) -> Self {
        let mut columns = vec![Vec::new(); quanta.len()];
        for row in rows {
            let row = row.as_ref();
            for (c, column) in columns.iter_mut().enumerate() {
                column.push(quanta_of(row[c], quanta[c]));
            }
        }
        let mut bytes = Vec::new();
        for column in &columns {
            write(column, ticks, &mut bytes);
        }
        Self {
            width: quanta.len(),
            count: columns.first().map_or(0, Vec::len),
            quanta: quanta.to_vec(),
            ticks: None,
            within: None,
            data: STANDARD.encode(bytes),
        }
    }

    /// Characters of its data.
    pub(super) fn size(&self) -> usize {
        self.data.len() + self.ticks.as_ref().map_or(0, String::len)
    }
}

/// Ticks in order, as a column of their own.
pub(super) fn tick_column(ticks: &[usize]) -> String {
    let whole: Vec<i64> = ticks.iter().map(|tick| *tick as i64).collect();
    let mut bytes = Vec::new();
    write(&whole, None, &mut bytes);
    STANDARD.encode(bytes)
}

/// Where the line through two numbers leads, `ratio` times their distance on.
fn ahead(before: i64, value: i64, ratio: f64) -> i64 {
    value + ((value - before) as f64 * ratio + 0.5).floor() as i64
}

/// The distance from frame `i - 1` to `i` in parts of that before it.
fn ratio(ticks: Option<&[usize]>, i: usize) -> f64 {
    ticks.map_or(1.0, |ticks| {
        (ticks[i] - ticks[i - 1]) as f64 / (ticks[i - 1] - ticks[i - 2]) as f64
    })
}

fn write(column: &[i64], ticks: Option<&[usize]>, bytes: &mut Vec<u8>) {
    for (i, value) in column.iter().enumerate() {
        let difference = match i {
            0 => *value,
            1 => value - column[0],
            _ => value - ahead(column[i - 2], column[i - 1], ratio(ticks, i)),
        };
        let mut rest = ((difference << 1) ^ (difference >> 63)) as u64;
        while rest >= 0x80 {
            bytes.push(rest as u8 | 0x80);
            rest >>= 7;
        }
        bytes.push(rest as u8);
    }
}

/// Reads columns back, as a viewer does.
#[cfg(test)]
pub(super) fn read(
    count: usize,
    quanta: &[f64],
    ticks: Option<&[usize]>,
    data: &str,
) -> Vec<Vec<f64>> {
    let mut bytes = STANDARD.decode(data).expect("base64").into_iter();
    let mut columns = Vec::new();
    for quantum in quanta {
        let mut column: Vec<i64> = Vec::new();
        for i in 0..count {
            let (mut coded, mut shift) = (0u64, 0);
            loop {
                let byte = bytes.next().expect("a number a frame");
                coded |= u64::from(byte & 0x7F) << shift;
                shift += 7;
                if byte < 0x80 {
                    break;
                }
            }
            let difference = (coded >> 1) as i64 ^ -((coded & 1) as i64);
            column.push(match i {
                0 => difference,
                1 => column[0] + difference,
                _ => ahead(column[i - 2], column[i - 1], ratio(ticks, i)) + difference,
            });
        }
        columns.push(column.iter().map(|value| *value as f64 * quantum).collect());
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
        let numbers = [100.0, 110.0, 120.0, 131.0, 131.0];
        let even = Track::even(&[1.0], numbers.iter().map(|x| [*x]));
        // 100, +10, 0, +1, -11 zigzag to 200 (two bytes), 20, 0, 2, 21
        let bytes = [0xC8, 0x01, 20, 0, 2, 21];
        assert_eq!(even.data, STANDARD.encode(bytes));
        assert_eq!((even.count, even.ticks, even.within), (5, None, None));

        // at 0, 2, 3, 7: after 0 and 10 the line leads to 15 at tick 3, and after 10 and 16 to 40 at tick 7
        let uneven = Track::through(
            &[0, 2, 3, 7],
            &[1.0],
            [0.0, 10.0, 16.0, 39.0].iter().map(|x| [*x]),
            0.5,
        );
        assert_eq!(uneven.data, STANDARD.encode([0, 20, 2, 1]));
        // ticks 0, +2, -1, +3
        assert_eq!(uneven.ticks, Some(STANDARD.encode([0, 4, 1, 6])));
        assert_eq!(uneven.within, Some(0.5));
        // half a whole goes up, on both sides of zero
        assert_eq!((ahead(0, 1, 0.5), ahead(0, -1, 0.5)), (2, -1));
    }

    #[test]
    fn nothing_and_numbers_beyond_reason() {
        assert_eq!(Track::even(&[1.0, 1.0], [[0.0; 2]; 0].iter()).data, "");
        let wild = [1e300, -1e300, 1e300, f64::INFINITY];
        let track = Track::even(&[1e-5], wild.iter().map(|x| [*x]));
        let most = MOST_QUANTA * 1e-5;
        let read = read(4, &[1e-5], None, &track.data);
        assert_eq!(read, [[most, -most, most, most]]);
    }

    proptest! {
        #[test]
        fn what_is_read_is_what_was_written(
            rows in proptest::collection::vec(([-1e4..1e4f64, -1.0..1.0f64], 1..300usize), 0..60),
        ) {
            let quanta = [1e-5, 2e-5];
            let ticks: Vec<usize> = rows.iter().scan(0, |tick, (_, step)| { *tick += step; Some(*tick) }).collect();
            let track = Track::through(&ticks, &quanta, rows.iter().map(|(row, _)| row), 1e-3);
            let read = read(rows.len(), &quanta, Some(&ticks), &track.data);
            for (i, (row, _)) in rows.iter().enumerate() {
                for c in 0..2 {
                    // half a quantum, and the rounding of numbers of this size
                    prop_assert!((read[c][i] - row[c]).abs() <= 0.5 * quanta[c] + 1e-11);
                }
            }
        }
    }
}
