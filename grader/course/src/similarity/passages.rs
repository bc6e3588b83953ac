//! Long passages that files of the class share: those that few share, and those with comments that many share.

use std::collections::{BTreeMap, BTreeSet};

use super::coverage::{Passage, Stream, excerpt, lines, long_ones};
use super::finding::{Finding, Found, Kind, Whose};
use super::search::{Prepared, common, rare};

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

/// Where the passages of a set of files begin: the files, by place in the class, and each start in all of them.
type Shared = BTreeMap<Vec<usize>, Vec<Vec<usize>>>;

/// Fingerprints of all files: those of each, and how many files have each.
struct Prints {
    of_file: Vec<Vec<(u64, usize)>>,
    files: BTreeMap<u64, usize>,
}

/// Passages that at least two and at most half of the class share, a finding for each set of students. Those that more than a few
/// share are a common way to write it, unless they have comments, which nobody writes alike by chance.
pub(super) fn shared_passages(class: &[Prepared<'_>]) -> Vec<Finding> {
    let of_file: Vec<Vec<(u64, usize)>> = class
        .iter()
        .map(|prepared| {
            prepared
                .stream
                .iter()
                .flat_map(Stream::fingerprints)
                .collect()
        })
        .collect();
    let mut places: BTreeMap<u64, Places> = BTreeMap::new();
    for (i, prints) in of_file.iter().enumerate() {
        for (hash, at) in prints {
            places.entry(*hash).or_default().entry(i).or_insert(*at);
        }
    }
    let files = places
        .iter()
        .map(|(hash, places)| (*hash, places.len()))
        .collect();
    let prints = Prints { of_file, files };
    let (mut few, mut many) = (Shared::new(), Shared::new());
    for places in places.into_values() {
        let sets = match places.len() {
            0 | 1 => continue,
            n if n <= rare(class.len()) => &mut few,
            n if n <= common(class.len()) => &mut many,
            _ => continue,
        };
        let (members, starts) = places.into_iter().unzip();
        sets.entry(members).or_default().push(starts);
    }
    let mut findings: Vec<Finding> = few
        .iter()
        .filter_map(|(members, starts)| {
            let (streams, passages) = shared(class, &prints, rare(class.len()), members, starts)?;
            Some(finding(class, Kind::Passage, members, &streams, &passages))
        })
        .collect();
    findings.extend(of_many(class, &prints, &many));
    findings
}

/// Passages with comments that many share. Who changed a word in it shares less of it with the others: of passages that overlap, that
/// of the most students stays.
fn of_many(class: &[Prepared<'_>], prints: &Prints, sets: &Shared) -> Vec<Finding> {
    let mut sets: Vec<(&Vec<usize>, &Vec<Vec<usize>>)> = sets.iter().collect();
    // stable: sets of one size stay in the order of students
    sets.sort_by_key(|(members, _)| std::cmp::Reverse(members.len()));
    // where passages that are shown lie, by file: first token, and the one behind the last
    let mut taken: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
    let mut findings = Vec::new();
    for (members, starts) in sets {
        let most = common(class.len());
        let Some((streams, mut passages)) = shared(class, prints, most, members, starts) else {
            continue;
        };
        passages.retain(|passage| passage.has_comments(streams[0]));
        let Some(longest) = passages.first() else {
            continue;
        };
        let overlaps = |member: usize, from: usize| {
            let mut ranges = taken.get(&member).into_iter().flatten();
            ranges.any(|(start, end)| from < *end && *start < from + longest.length)
        };
        if members
            .iter()
            .zip(&longest.starts)
            .any(|(member, from)| overlaps(*member, *from))
        {
            continue;
        }
        for passage in &passages {
            for (member, from) in members.iter().zip(&passage.starts) {
                let range = (*from, from + passage.length);
                taken.entry(*member).or_default().push(range);
            }
        }
        let kind = Kind::CommonPassage;
        findings.push(finding(class, kind, members, &streams, &passages));
    }
    findings
}

/// The long passages that all of `members` share, and no more than `most` files, the longest first, with the members' files; none where
/// all are one person's or one file. Whoever has one token more of a passage that everybody has would be two of a few otherwise.
fn shared<'c>(
    class: &'c [Prepared<'_>],
    prints: &Prints,
    most: usize,
    members: &[usize],
    starts: &[Vec<usize>],
) -> Option<(Vec<&'c Stream<'c>>, Vec<Passage>)> {
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
    let in_many = |hash: &u64| prints.files.get(hash).is_some_and(|files| *files > most);
    let of_first = || prints.of_file[members[0]].iter();
    let own = around.flat_map(|passage| {
        let common = of_first().filter(|(hash, _)| in_many(hash));
        passage.without(common.map(|(_, at)| *at))
    });
    let passages = long_ones(own.collect(), first);
    (!passages.is_empty()).then_some((streams, passages))
}

fn finding(
    class: &[Prepared<'_>],
    kind: Kind,
    members: &[usize],
    streams: &[&Stream<'_>],
    passages: &[Passage],
) -> Finding {
    let first = streams[0];
    let found = members
        .iter()
        .zip(streams)
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
    let longest = passages
        .first()
        .map(|passage| (passage.starts[0], passage.length));
    let shown = lines(first, longest.into_iter());
    let text = class[members[0]].file.text().unwrap_or_default();
    Finding {
        kind,
        files: found.collect(),
        says: says(passages, first),
        excerpt: shown
            .first()
            .map(|range| excerpt(text, *range, MOST_LINES))
            .unwrap_or_default(),
        size: passages.iter().map(|passage| passage.length).sum(),
        shared_by: members.len(),
        of: class.len(),
    }
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
