//! How far a lab is, in a line: `287 graded, 9 missing, 4 need you`.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_course::question::Question;
use kinemark_course::standing::{Standing, Status};
use kinemark_course::student::StudentId;

/// The parts of the line: students by status, and files that need a person.
pub(crate) fn lab_counts(standings: &[Standing], questions: &[Question]) -> Vec<String> {
    let mut counts: BTreeMap<Status, usize> = BTreeMap::new();
    for standing in standings {
        // counted as the files that need one
        if standing.status != Status::NeedsPerson {
            *counts.entry(standing.status).or_default() += 1;
        }
    }
    let near: BTreeSet<&StudentId> = questions.iter().flat_map(|open| &open.near).collect();
    let perhaps = standings
        .iter()
        .filter(|standing| standing.status == Status::Missing && near.contains(&standing.student));
    let perhaps = perhaps.count();
    let words = |(status, count): (Status, usize)| match status {
        Status::Missing if perhaps > 0 => {
            format!("{count} missing ({perhaps} of them perhaps among the files that need you)")
        }
        status => format!("{count} {}", status.words()),
    };
    let mut parts: Vec<String> = counts.into_iter().map(words).collect();
    match questions.len() {
        0 => {}
        1 => parts.push("1 needs you".to_owned()),
        count => parts.push(format!("{count} need you")),
    }
    parts
}
