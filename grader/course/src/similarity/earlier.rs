//! Files of an earlier year and public solutions that a file of the class equals, or has long passages of.

use std::collections::{BTreeMap, BTreeSet};

use super::coverage::{Passage, Stream, excerpt, lines, long_ones};
use super::finding::{Finding, Found, Kind, Whose};
use super::passages::{MOST_LINES, says};
use super::search::Prepared;

/// An earlier file, ready to compare.
pub(super) struct EarlierFile<'a> {
    pub(super) path: &'a str,
    pub(super) bytes: &'a [u8],
    /// None of a compiled one.
    pub(super) stream: Option<Stream<'a>>,
}

/// What a student shares with an earlier file.
struct Match {
    student: usize,
    earlier: usize,
    is_whole: bool,
    passages: Vec<Passage>,
}

impl Match {
    fn size(&self) -> usize {
        self.passages.iter().map(|passage| passage.length).sum()
    }
}

/// For each earlier file, who has it or long passages of it; a student counts for the file that most is shared with. `class` is
/// prepared with what was given taken out, and the reference solution left in.
pub(super) fn earlier(class: &[Prepared<'_>], files: &[EarlierFile<'_>]) -> Vec<Finding> {
    let matches = matches(class, files);
    let mut sharers: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    let mut best: BTreeMap<usize, &Match> = BTreeMap::new();
    for found in &matches {
        sharers
            .entry(found.earlier)
            .or_default()
            .insert(found.student);
        let better =
            |known: &&Match| (found.is_whole, found.size()) > (known.is_whole, known.size());
        if best.get(&found.student).is_none_or(better) {
            best.insert(found.student, found);
        }
    }
    let mut groups: BTreeMap<(bool, usize), Vec<&Match>> = BTreeMap::new();
    for found in best.into_values() {
        groups
            .entry((!found.is_whole, found.earlier))
            .or_default()
            .push(found);
    }
    let groups = groups.into_iter();
    groups
        .filter_map(|((_, earlier), group)| {
            let shared_by = sharers.get(&earlier).map_or(0, BTreeSet::len);
            finding(class, &files[earlier], &group, shared_by)
        })
        .collect()
}

/// Everything that is shared with any earlier file.
fn matches(class: &[Prepared<'_>], files: &[EarlierFile<'_>]) -> Vec<Match> {
    let mut places: BTreeMap<u64, BTreeMap<usize, usize>> = BTreeMap::new();
    for (i, file) in files.iter().enumerate() {
        for (hash, at) in file.stream.iter().flat_map(Stream::fingerprints) {
            places.entry(hash).or_default().entry(i).or_insert(at);
        }
    }
    let own: Vec<Vec<(u64, usize)>> = class
        .iter()
        .map(|prepared| {
            prepared
                .stream
                .as_ref()
                .map(Stream::fingerprints)
                .unwrap_or_default()
        })
        .collect();
    let mut frequency: BTreeMap<u64, usize> = BTreeMap::new();
    for hashes in &own {
        let hashes: BTreeSet<u64> = hashes.iter().map(|(hash, _)| *hash).collect();
        for hash in hashes {
            *frequency.entry(hash).or_default() += 1;
        }
    }
    // what more than half of the class has is the course's own text of an earlier year; of a few files nothing can be said
    let is_everybodys =
        |hash: &u64| class.len() > 4 && 2 * frequency.get(hash).copied().unwrap_or(0) > class.len();
    let mut matches = Vec::new();
    for (student, (prepared, hashes)) in class.iter().zip(&own).enumerate() {
        let mut starts: BTreeMap<usize, Vec<[usize; 2]>> = BTreeMap::new();
        for (hash, at) in hashes.iter().filter(|(hash, _)| !is_everybodys(hash)) {
            for (earlier, there) in places.get(hash).into_iter().flatten() {
                starts.entry(*earlier).or_default().push([*at, *there]);
            }
        }
        for (earlier, file) in files.iter().enumerate() {
            let starts = starts.get(&earlier).map_or(&[][..], Vec::as_slice);
            matches.extend(
                matched(prepared, file, starts).map(|(is_whole, passages)| Match {
                    student,
                    earlier,
                    is_whole,
                    passages,
                }),
            );
        }
    }
    matches
}

fn matched(
    prepared: &Prepared<'_>,
    file: &EarlierFile<'_>,
    starts: &[[usize; 2]],
) -> Option<(bool, Vec<Passage>)> {
    let (Some(stream), Some(there)) = (&prepared.stream, &file.stream) else {
        let is_same =
            prepared.stream.is_none() && file.stream.is_none() && prepared.file.bytes == file.bytes;
        return is_same.then(|| (true, Vec::new()));
    };
    let around = starts
        .iter()
        .filter_map(|starts| Passage::around(&[stream, there], starts));
    let passages = long_ones(around.collect(), stream);
    (!passages.is_empty()).then(|| (stream.keys == there.keys, passages))
}

fn finding(
    class: &[Prepared<'_>],
    file: &EarlierFile<'_>,
    group: &[&Match],
    shared_by: usize,
) -> Option<Finding> {
    let first = group.iter().max_by_key(|found| found.size())?;
    let is_whole = first.is_whole;
    let runs = |found: &Match, side: usize| -> Vec<(usize, usize)> {
        let passages = found.passages.iter();
        passages
            .map(|passage| (passage.starts[side], passage.length))
            .collect()
    };
    let mut found: Vec<Found> = group
        .iter()
        .map(|found| Found {
            whose: Whose::Student(class[found.student].file.student.clone()),
            file: class[found.student].file.file.clone(),
            lines: match &class[found.student].stream {
                Some(stream) if !is_whole => lines(stream, runs(found, 0).into_iter()),
                _ => Vec::new(),
            },
        })
        .collect();
    found.push(Found {
        whose: Whose::Earlier(file.path.to_owned()),
        file: file.path.rsplit('/').next().unwrap_or(file.path).to_owned(),
        lines: match &file.stream {
            Some(stream) if !is_whole => {
                lines(stream, group.iter().flat_map(|found| runs(found, 1)))
            }
            _ => Vec::new(),
        },
    });
    let prepared = &class[first.student];
    let stream = prepared.stream.as_ref();
    let is_exact = group
        .iter()
        .all(|found| class[found.student].file.bytes == file.bytes);
    let longest = stream.zip(first.passages.first()).filter(|_| !is_whole);
    let shown = longest.and_then(|(stream, passage)| {
        lines(stream, std::iter::once((passage.starts[0], passage.length)))
            .first()
            .copied()
    });
    Some(Finding {
        kind: if is_whole {
            Kind::EarlierFile
        } else {
            Kind::EarlierPassage
        },
        files: found,
        says: match (is_whole, stream) {
            (true, _) if is_exact => "The files are the same, byte for byte.".to_owned(),
            (true, _) => "The files are the same, but for white space.".to_owned(),
            (false, Some(stream)) => says(&first.passages, stream),
            (false, None) => return None,
        },
        excerpt: shown
            .map(|range| excerpt(prepared.file.text().unwrap_or_default(), range, MOST_LINES))
            .unwrap_or_default(),
        size: first.size(),
        shared_by,
        of: class.len(),
    })
}
