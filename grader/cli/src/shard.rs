//! A part of a class: which students one of several machines grades. By the id alone, so every machine agrees without asking.

use std::fmt;
use std::str::FromStr;

/// Part `number` of `count`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    /// From one.
    number: u32,
    count: u32,
}

impl Shard {
    /// Part `number` of `count`, where there is such a part.
    pub(crate) fn new(number: u32, count: u32) -> Option<Self> {
        (1..=count)
            .contains(&number)
            .then_some(Self { number, count })
    }

    /// All parts.
    pub(crate) fn all(count: u32) -> impl Iterator<Item = Self> {
        (1..=count).map(move |number| Self { number, count })
    }

    pub(crate) fn number(self) -> u32 {
        self.number
    }

    pub(crate) fn count(self) -> u32 {
        self.count
    }

    /// Whether the student of this id is in the part.
    pub(crate) fn has(self, student: &str) -> bool {
        let digest = blake3::hash(student.as_bytes());
        let [a, b, c, d, ..] = *digest.as_bytes();
        u32::from_le_bytes([a, b, c, d]) % self.count == self.number - 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(typed: &str) -> Result<Self, String> {
        let help = "write it as I/N with I from 1 to N, such as 2/4";
        let parts = typed.split_once('/').ok_or(help)?;
        let number: u32 = parts.0.trim().parse().map_err(|_| help)?;
        let count: u32 = parts.1.trim().parse().map_err(|_| help)?;
        Self::new(number, count).ok_or_else(|| help.to_owned())
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_student_is_in_one_part() {
        for count in [1, 2, 7] {
            let parts: Vec<Shard> = Shard::all(count).collect();
            let mut sizes = vec![0; parts.len()];
            for student in 0..700 {
                let id = format!("s{student}");
                let of: Vec<usize> = (0..parts.len()).filter(|i| parts[*i].has(&id)).collect();
                assert_eq!(of.len(), 1, "{id} of {count}");
                sizes[of[0]] += 1;
            }
            assert!(
                sizes.iter().all(|size| *size > 350 / parts.len()),
                "{sizes:?}"
            );
        }
    }

    #[test]
    fn what_is_no_part_is_refused() {
        for typed in ["", "1", "0/4", "5/4", "a/4", "1/0", "-1/4"] {
            assert!(typed.parse::<Shard>().is_err(), "{typed}");
        }
        assert_eq!("2/4".parse::<Shard>().unwrap().to_string(), "2/4");
    }
}
