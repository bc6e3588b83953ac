//! Long passages that few files of the class share.

use std::collections::{BTreeMap, BTreeSet};

use super::coverage::{Passage, Stream, excerpt, lines, long_ones};
use super::finding::{Finding, Found, Kind, Whose};
use super::search::{Prepared, rare};

/// Lines of a passage that are shown.
pub(super) const MOST_LINES: usize = 12;
/// A file with fewer tokens of its author's own says nothing where another is equal: the starter, or nearly nothing.
const FEWEST_TOKENS: usize = 30;

/// Files that are equal but for white space, each group once.
pub(super) fn same_files(class: &[Prepared<'_>]) -> Vec<Finding> {
    let mut equal: BTreeMap<&[u64], Vec<usize>> = BTreeMap::new();
    let mut binary: BTreeMap<&[u8], Vec<usize>> = BTreeMap::new();
    for (i, prepared) in class.iter().enumerate() {
        match &prepared.stream {
            Some(stream) if stream.own_tokens() >= FEWEST_TOKENS => {
                equal.entry(&stream.keys).or_default().push(i);
            }
            Some(_) => {}
            None => binary.entry(&prepared.file.bytes).or_default().push(i),
        }
    }
    let groups = equal.into_values().chain(binary.into_values());
    groups
        .filter_map(|members| same_file(class, &members))
        .collect()
}

fn same_file(class: &[Prepared<'_>], members: &[usize]) -> Option<Finding> {
    if hands(class, members) < 2 {
        return None;
    }
    let first = &class[*members.first()?];
    let is_exact = members
        .iter()
        .all(|member| class[*member].file.bytes == first.file.bytes);
    let but = if is_exact {
        "byte for byte"
    } else {
        "but for white space"
    };
    let found = |member: &usize| Found {
        whose: Whose::Student(class[*member].file.student.clone()),
        file: class[*member].file.file.clone(),
        lines: Vec::new(),
    };
    Some(Finding {
        kind: Kind::SameFile,
        files: members.iter().map(found).collect(),
        says: format!("The files are the same, {but}."),
        excerpt: String::new(),
        size: first
            .stream
            .as_ref()
            .map_or(first.file.bytes.len(), |stream| stream.keys.len()),
        shared_by: members.len(),
        of: class.len(),
    })
}

/// How many people or groups stand behind files.
fn hands(class: &[Prepared<'_>], members: &[usize]) -> usize {
    let hands: BTreeSet<&str> = members.iter().map(|member| class[*member].hand()).collect();
    hands.len()
}

/// Where a fingerprint is: in each file that has it, first.
type Places = BTreeMap<usize, usize>;

/// Passages that at least two and at most a few share, a finding for each set of students.
pub(super) fn rare_passages(class: &[Prepared<'_>]) -> Vec<Finding> {
    let mut places: BTreeMap<u64, Places> = BTreeMap::new();
    for (i, prepared) in class.iter().enumerate() {
        for (hash, at) in prepared.stream.iter().flat_map(Stream::fingerprints) {
            places.entry(hash).or_default().entry(i).or_insert(at);
        }
    }
    let mut sets: BTreeMap<Vec<usize>, Vec<Vec<usize>>> = BTreeMap::new();
    for places in places.into_values() {
        if places.len() < 2 || places.len() > rare(class.len()) {
            continue;
        }
        let (members, starts) = places.into_iter().unzip();
        sets.entry(members).or_default().push(starts);
    }
    let sets = sets.into_iter();
    sets.filter_map(|(members, starts)| shared(class, &members, &starts))
        .collect()
}

fn shared(class: &[Prepared<'_>], members: &[usize], starts: &[Vec<usize>]) -> Option<Finding> {
    if hands(class, members) < 2 {
        return None;
    }
    let streams: Vec<&Stream<'_>> = members
        .iter()
        .filter_map(|member| class[*member].stream.as_ref())
        .collect();
    let first = *streams.first()?;
    // those of one file are a finding already
    if streams.iter().all(|stream| stream.keys == first.keys) {
        return None;
    }
    let around = starts
        .iter()
        .filter_map(|starts| Passage::around(&streams, starts));
    let passages = long_ones(around.collect(), first);
    let longest = passages.first()?;
    let found = members
        .iter()
        .zip(&streams)
        .enumerate()
        .map(|(i, (member, stream))| Found {
            whose: Whose::Student(class[*member].file.student.clone()),
            file: class[*member].file.file.clone(),
            lines: lines(
                stream,
                passages
                    .iter()
                    .map(|passage| (passage.starts[i], passage.length)),
            ),
        });
    let shown = lines(first, std::iter::once((longest.starts[0], longest.length)));
    let text = class[members[0]].file.text().unwrap_or_default();
    Some(Finding {
        kind: Kind::Passage,
        files: found.collect(),
        says: says(&passages, first),
        excerpt: shown
            .first()
            .map(|range| excerpt(text, *range, MOST_LINES))
            .unwrap_or_default(),
        size: passages.iter().map(|passage| passage.length).sum(),
        shared_by: members.len(),
        of: class.len(),
    })
}

/// Passages in words: how long they are, and what of them is comment.
pub(super) fn says(passages: &[Passage], first: &Stream<'_>) -> String {
    let lengths: Vec<String> = passages
        .iter()
        .take(4)
        .map(|passage| passage.length.to_string())
        .collect();
    let comments: usize = passages
        .iter()
        .map(|passage| first.comment_words(passage.starts[0], passage.length))
        .sum();
    let mut says = match passages.len() {
        1 => format!("{} tokens in a row are the same", lengths.concat()),
        n if n > lengths.len() => format!(
            "{n} passages are the same, the longest of {} tokens in a row",
            lengths.join(", ")
        ),
        n => format!(
            "{n} passages are the same, of {} tokens in a row",
            lengths.join(", ")
        ),
    };
    if comments > 0 {
        says += &format!("; {comments} of them are words of comments");
    }
    says + "."
}
