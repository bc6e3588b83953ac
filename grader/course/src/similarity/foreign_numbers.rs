//! Numbers in a file that belong to another student's variant, and not to its own student's.
//!
//! One such number is nothing: variants are drawn from few values. So all numbers of the other variant must be there that are not one's
//! own, nor the default's, nor in any text that was given; of four or more, one may be missing. Integers below 100 and numbers of one
//! digit do not count, nor do variants that more than three students share in these numbers.

use std::collections::{BTreeMap, BTreeSet};

use super::class_file::{Numbers, text};
use super::coverage::{excerpt, reading_of};
use super::finding::{Finding, Found, Kind, Whose};
use super::search::{Class, Prepared};
use super::token::{Kind as TokenKind, Reading, Token, tokens};
use crate::student::StudentId;

/// Numbers that more students have in their variants name nobody.
const MOST_OWNERS: usize = 3;
/// Lines with numbers that are shown.
const MOST_LINES: usize = 6;

/// A number without its sign, which a script writes apart from it.
fn bits(value: f64) -> u64 {
    value.abs().to_bits()
}

/// Whether a number is one that not everybody writes: of two digits at least, and no small integer.
fn says_something(value: f64) -> bool {
    let size = value.abs();
    let text = format!("{size:e}");
    let mantissa = text.split('e').next().unwrap_or_default();
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
    size.is_finite() && digits >= 2 && !(size < 100.0 && size.fract() == 0.0)
}

fn set_of(numbers: &[(String, Vec<f64>)]) -> BTreeSet<u64> {
    let values = numbers.iter().flat_map(|(_, values)| values);
    values
        .copied()
        .filter(|value| says_something(*value))
        .map(bits)
        .collect()
}

/// The numbers in tokens with the lines of each.
fn literals(tokens: &[Token<'_>]) -> BTreeMap<u64, Vec<usize>> {
    let mut found: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for token in tokens {
        if let TokenKind::Number(value) = token.kind
            && says_something(value)
        {
            found.entry(bits(value)).or_default().push(token.line);
        }
    }
    found
}

/// A finding for each set of numbers.
pub(super) fn foreign_numbers(class: &Class<'_>, files: &[Prepared<'_>]) -> Vec<Finding> {
    let mut common = set_of(class.default);
    for (path, bytes) in &class.material.given {
        let given = text(bytes).map(|given| tokens(given, reading_of(path)));
        common.extend(literals(&given.unwrap_or_default()).into_keys());
    }
    let variants: BTreeMap<&StudentId, BTreeSet<u64>> = class
        .variants
        .iter()
        .map(|(student, numbers)| (student, set_of(numbers)))
        .collect();
    // comments and strings as well: a header that was copied has them there
    let of_file = |prepared: &Prepared<'_>| {
        let text = prepared.file.text().unwrap_or_default();
        literals(&tokens(text, Reading::Prose))
    };
    let found: Vec<BTreeMap<u64, Vec<usize>>> = files.iter().map(of_file).collect();
    // places in the class of the files that have them
    let mut groups: BTreeMap<Vec<u64>, BTreeSet<usize>> = BTreeMap::new();
    for (i, prepared) in files.iter().enumerate() {
        let foreign = foreign(prepared, files, &found[i], &variants, &common);
        if let Some(numbers) = most_of_another(&foreign, prepared, files, &variants, &common) {
            groups.entry(numbers).or_default().insert(i);
        }
    }
    let groups = groups.into_iter();
    groups
        .filter_map(|(numbers, holders)| {
            finding(class, files, &found, &variants, &numbers, &holders)
        })
        .collect()
}

/// Those of the same group, and the student: their numbers are one's own.
fn own<'p>(
    prepared: &'p Prepared<'_>,
    files: &'p [Prepared<'_>],
) -> impl Iterator<Item = &'p StudentId> {
    let hand = prepared.hand();
    let members = files.iter().filter(move |other| other.hand() == hand);
    members.map(|member| &member.file.student)
}

/// The numbers of a file that are neither common nor one's own.
fn foreign(
    prepared: &Prepared<'_>,
    files: &[Prepared<'_>],
    literals: &BTreeMap<u64, Vec<usize>>,
    variants: &BTreeMap<&StudentId, BTreeSet<u64>>,
    common: &BTreeSet<u64>,
) -> BTreeSet<u64> {
    let mut rest: BTreeSet<u64> = literals
        .keys()
        .copied()
        .filter(|number| !common.contains(number))
        .collect();
    for student in own(prepared, files) {
        for number in variants.get(student).into_iter().flatten() {
            rest.remove(number);
        }
    }
    rest
}

/// The most numbers of any other variant that are among `foreign`, if they are all of it, or all but one of many.
fn most_of_another(
    foreign: &BTreeSet<u64>,
    prepared: &Prepared<'_>,
    files: &[Prepared<'_>],
    variants: &BTreeMap<&StudentId, BTreeSet<u64>>,
    common: &BTreeSet<u64>,
) -> Option<Vec<u64>> {
    if foreign.is_empty() {
        return None;
    }
    let own: BTreeSet<&StudentId> = own(prepared, files).collect();
    let mine: BTreeSet<u64> = own
        .iter()
        .filter_map(|student| variants.get(student))
        .flatten()
        .copied()
        .collect();
    let others = variants
        .iter()
        .filter(|(student, _)| !own.contains(**student));
    let matched = others.filter_map(|(_, numbers)| {
        let differing: Vec<u64> = numbers
            .iter()
            .copied()
            .filter(|number| !mine.contains(number) && !common.contains(number))
            .collect();
        let held: Vec<u64> = differing
            .iter()
            .copied()
            .filter(|number| foreign.contains(number))
            .collect();
        let needed = match differing.len() {
            // a single number is only worth something where the variant has no other
            0 => return None,
            1 if numbers.len() > 1 => return None,
            n @ 1..=3 => n,
            n => n - 1,
        };
        (held.len() >= needed).then_some(held)
    });
    // among equals the first by number, so that the order of students does not matter
    matched.max_by(|a, b| a.len().cmp(&b.len()).then(b.cmp(a)))
}

fn finding(
    class: &Class<'_>,
    files: &[Prepared<'_>],
    found: &[BTreeMap<u64, Vec<usize>>],
    variants: &BTreeMap<&StudentId, BTreeSet<u64>>,
    numbers: &[u64],
    holders: &BTreeSet<usize>,
) -> Option<Finding> {
    let holds = |set: &BTreeSet<u64>| numbers.iter().all(|number| set.contains(number));
    let owners: Vec<&StudentId> = variants
        .iter()
        .filter(|(_, set)| holds(set))
        .map(|(student, _)| *student)
        .collect();
    if owners.is_empty() || owners.len() > MOST_OWNERS {
        return None;
    }
    let with_all = found
        .iter()
        .filter(|literals| numbers.iter().all(|number| literals.contains_key(number)));
    let shared_by = with_all.count();
    let lines_in = |i: usize| -> Vec<(usize, usize)> {
        let lines: BTreeSet<usize> = numbers
            .iter()
            .filter_map(|number| found[i].get(number))
            .flatten()
            .copied()
            .collect();
        lines.into_iter().map(|line| (line, line)).collect()
    };
    let mut places: Vec<Found> = Vec::new();
    for i in holders {
        places.push(in_file(&files[*i], lines_in(*i)));
    }
    for owner in &owners {
        let file = files
            .iter()
            .position(|prepared| prepared.file.student == **owner);
        places.push(match file {
            Some(i) => in_file(&files[i], lines_in(i)),
            None => Found {
                whose: Whose::Student((*owner).clone()),
                file: String::new(),
                lines: Vec::new(),
            },
        });
    }
    let first = *holders.first()?;
    let text = files[first].file.text().unwrap_or_default();
    let shown: Vec<String> = lines_in(first)
        .into_iter()
        .take(MOST_LINES)
        .map(|range| excerpt(text, range, 1))
        .collect();
    Some(Finding {
        kind: Kind::ForeignNumbers,
        files: places,
        says: says(numbers, &owners, class.variants),
        excerpt: shown.join("\n"),
        size: numbers.len(),
        shared_by,
        of: files.len(),
    })
}

fn in_file(prepared: &Prepared<'_>, lines: Vec<(usize, usize)>) -> Found {
    Found {
        whose: Whose::Student(prepared.file.student.clone()),
        file: prepared.file.file.clone(),
        lines,
    }
}

/// Which numbers, and whose.
fn says(numbers: &[u64], owners: &[&StudentId], variants: &BTreeMap<StudentId, Numbers>) -> String {
    let mut named = Vec::new();
    for (name, values) in owners
        .first()
        .and_then(|owner| variants.get(*owner))
        .into_iter()
        .flatten()
    {
        for (i, value) in values.iter().enumerate() {
            if numbers.contains(&bits(*value)) {
                named.push(match values.len() {
                    1 => format!("{name} = {value}"),
                    _ => format!("{name}[{i}] = {value}"),
                });
            }
        }
    }
    let owners: Vec<&str> = owners.iter().map(|owner| owner.as_str()).collect();
    format!(
        "Numbers of the variant of {}: {}.",
        owners.join(", "),
        named.join(", ")
    )
}
