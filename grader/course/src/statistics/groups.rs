//! Points of parts of the class: sections, numbers of attempts, lateness.

use std::collections::BTreeMap;

use serde::Serialize;

use super::spread::Spread;
use crate::roster::Roster;
use crate::standing::{Standing, Status};

/// Attempts beyond this are one group.
const MOST_ATTEMPTS: usize = 5;
const HOUR_S: i64 = 3600;
const DAY_S: i64 = 24 * HOUR_S;

/// A part of the class.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupPoints {
    /// What it is called.
    pub name: String,
    /// How many students are in it, excused ones aside.
    pub students: usize,
    /// The points of those with a grade.
    pub points: Option<Spread>,
}

/// Students by a key that orders them; `None` leaves a student out.
fn grouped<K: Ord>(
    standings: &[&Standing],
    key: impl Fn(&Standing) -> Option<K>,
    name: impl Fn(&K) -> String,
) -> Vec<GroupPoints> {
    let mut groups: BTreeMap<K, Vec<Option<f64>>> = BTreeMap::new();
    for standing in standings {
        if standing.status == Status::Excused {
            continue;
        }
        if let Some(key) = key(standing) {
            groups.entry(key).or_default().push(standing.points);
        }
    }
    let groups = groups.into_iter();
    groups
        .map(|(key, points)| GroupPoints {
            name: name(&key),
            students: points.len(),
            points: Spread::of(&points.into_iter().flatten().collect::<Vec<_>>()),
        })
        .collect()
}

/// By section, as the roster has it; none where it has no sections.
pub(super) fn sections(standings: &[&Standing], roster: &Roster) -> Vec<GroupPoints> {
    if roster
        .people()
        .iter()
        .all(|person| person.section.is_empty())
    {
        return Vec::new();
    }
    let of_student: BTreeMap<&str, &str> = roster
        .people()
        .iter()
        .map(|person| (person.id.as_str(), person.section.as_str()))
        .collect();
    let section = |standing: &Standing| {
        let section = of_student.get(standing.student.as_str())?;
        Some((section.is_empty(), (*section).to_owned()))
    };
    grouped(standings, section, |(is_none, section)| {
        if *is_none {
            "no section".to_owned()
        } else {
            section.clone()
        }
    })
}

/// By how often they handed in.
pub(super) fn attempts(standings: &[&Standing]) -> Vec<GroupPoints> {
    let attempts =
        |standing: &Standing| (standing.attempts > 0).then(|| standing.attempts.min(MOST_ATTEMPTS));
    grouped(standings, attempts, |attempts| match *attempts {
        1 => "1 attempt".to_owned(),
        MOST_ATTEMPTS => format!("{MOST_ATTEMPTS} attempts or more"),
        attempts => format!("{attempts} attempts"),
    })
}

/// How late a hand-in is, from early to late; what is not known comes last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Lateness {
    InTime,
    Hour,
    Day,
    Week,
    More,
    Marked,
    Unknown,
}

impl Lateness {
    fn of(standing: &Standing) -> Self {
        match standing.late_s {
            Some(late_s) if late_s <= 0 => Self::InTime,
            Some(late_s) if late_s <= HOUR_S => Self::Hour,
            Some(late_s) if late_s <= DAY_S => Self::Day,
            Some(late_s) if late_s <= 7 * DAY_S => Self::Week,
            Some(_) => Self::More,
            None if standing.marked_late => Self::Marked,
            None => Self::Unknown,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::InTime => "in time",
            Self::Hour => "up to an hour late",
            Self::Day => "up to a day late",
            Self::Week => "up to a week late",
            Self::More => "more than a week late",
            Self::Marked => "late, as the LMS marks it",
            Self::Unknown => "not known",
        }
    }
}

/// By lateness of the attempt that counts; none where it is not known of anybody.
pub(super) fn lateness(standings: &[&Standing]) -> Vec<GroupPoints> {
    let of = |standing: &Standing| (standing.attempts > 0).then(|| Lateness::of(standing));
    if standings
        .iter()
        .all(|standing| of(standing).is_none_or(|late| late == Lateness::Unknown))
    {
        return Vec::new();
    }
    // an LMS that marks what is late has looked at all of them
    let has_marks = standings
        .iter()
        .any(|standing| of(standing) == Some(Lateness::Marked));
    grouped(standings, of, |late| match late {
        Lateness::Unknown if has_marks => "not marked as late".to_owned(),
        late => late.words().to_owned(),
    })
}
