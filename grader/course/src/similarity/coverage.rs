//! Files as streams of keys with what was given taken out, and how far two of them go on alike.

use super::token::{Kind, Reading, Token, tokens};

/// So many tokens in a row that are in a given text are taken out.
const GIVEN_TOKENS: usize = 8;
/// Tokens of a fingerprint.
const GRAM: usize = 16;
/// One fingerprint of so many neighbours is kept (winnowing: Schleimer, Wilkerson and Aiken, *Winnowing: Local Algorithms for Document
/// Fingerprinting*, 2003), so that no equal passage of `GRAM + WINDOW - 1` = 24 tokens is missed.
const WINDOW: usize = 9;
/// A passage is long from so many tokens on ...
const LONG: usize = 60;
/// ... or from so many, if it has comments, which nobody writes alike by chance.
const LONG_WITH_COMMENTS: usize = 40;
/// Words of comments that make a passage one with comments.
const COMMENT_WORDS: usize = 10;

/// What was given, as the hashes of all its runs of a few tokens.
#[derive(Debug, Default)]
pub(super) struct Known(Vec<u64>);

impl Known {
    /// Of texts with how they are read.
    pub(super) fn of<'t>(texts: impl Iterator<Item = (&'t str, Reading)>) -> Self {
        let mut hashes = Vec::new();
        for (text, reading) in texts {
            let keys: Vec<u64> = tokens(text, reading).iter().map(Token::key).collect();
            hashes.extend(keys.windows(GIVEN_TOKENS).map(hash));
        }
        hashes.sort_unstable();
        hashes.dedup();
        Self(hashes)
    }
}

/// How a given file is read: a brief is prose.
pub(super) fn reading_of(path: &str) -> Reading {
    let ending = path.rsplit('.').next().unwrap_or_default();
    match ending {
        "md" | "txt" | "toml" | "json" => Reading::Prose,
        _ => Reading::Code,
    }
}

/// A file.
#[derive(Debug)]
pub(super) struct Stream<'t> {
    pub(super) tokens: Vec<Token<'t>>,
    pub(super) keys: Vec<u64>,
    /// Which tokens are its author's own.
    own: Vec<bool>,
}

impl<'t> Stream<'t> {
    pub(super) fn of(text: &'t str, known: &Known) -> Self {
        let tokens = tokens(text, Reading::Code);
        let keys: Vec<u64> = tokens.iter().map(Token::key).collect();
        let mut own = vec![true; keys.len()];
        for (at, window) in keys.windows(GIVEN_TOKENS).enumerate() {
            if known.0.binary_search(&hash(window)).is_ok() {
                own[at..at + GIVEN_TOKENS].fill(false);
            }
        }
        Self { tokens, keys, own }
    }

    /// How many tokens are its author's own.
    pub(super) fn own_tokens(&self) -> usize {
        self.own.iter().filter(|own| **own).count()
    }

    /// Hashes of runs of tokens and where each begins, of every few neighbours one; runs with given tokens in them have none.
    pub(super) fn fingerprints(&self) -> Vec<(u64, usize)> {
        let mut kept: Vec<(u64, usize)> = Vec::new();
        let mut at = 0;
        while at < self.keys.len() {
            let length = self.own[at..].iter().take_while(|own| **own).count();
            let hashes: Vec<(u64, usize)> = self.keys[at..at + length]
                .windows(GRAM)
                .enumerate()
                .map(|(i, window)| (hash(window), at + i))
                .collect();
            for window in hashes.windows(WINDOW.min(hashes.len().max(1))) {
                // the last of the least, so that neighbours choose the same
                let least = window.iter().rev().min_by_key(|(hash, _)| *hash);
                kept.extend(least.filter(|least| kept.last() != Some(least)).copied());
            }
            at += length.max(1);
        }
        kept
    }

    fn is_own(&self, at: usize) -> bool {
        self.own.get(at).copied().unwrap_or(false)
    }

    /// Words of comments among so many tokens.
    pub(super) fn comment_words(&self, at: usize, length: usize) -> usize {
        let tokens = self.tokens[at..at + length].iter();
        tokens.filter(|token| token.kind == Kind::Comment).count()
    }
}

/// A hash of tokens in a row.
fn hash(keys: &[u64]) -> u64 {
    keys.iter().fold(0x9e37_79b9_7f4a_7c15, |hash: u64, key| {
        (hash.rotate_left(5) ^ key).wrapping_mul(0x517c_c1b7_2722_0a95)
    })
}

/// A passage that several streams have.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Passage {
    /// Where it begins in each.
    pub(super) starts: Vec<usize>,
    /// How many tokens it has.
    pub(super) length: usize,
}

impl Passage {
    /// The passage around `starts`, as far as all `streams` go on alike with tokens of their authors' own; none where they differ
    /// within a fingerprint's length.
    pub(super) fn around(streams: &[&Stream<'_>], starts: &[usize]) -> Option<Self> {
        let key = |back: usize, forth: usize| {
            let mut keys = streams.iter().zip(starts).map(|(stream, start)| {
                let at = (start + forth).checked_sub(back)?;
                stream.is_own(at).then(|| stream.keys[at])
            });
            let first = keys.next()??;
            keys.all(|key| key == Some(first)).then_some(first)
        };
        let forth = (0..).take_while(|forth| key(0, *forth).is_some()).count();
        let back = (1..).take_while(|back| key(*back, 0).is_some()).count();
        (forth >= GRAM).then(|| Self {
            starts: starts.iter().map(|start| start - back).collect(),
            length: back + forth,
        })
    }

    /// The parts of it that lie in none of the fingerprints that begin at `common` tokens of the first stream.
    pub(super) fn without(&self, common: impl Iterator<Item = usize>) -> Vec<Self> {
        let (from, to) = (self.starts[0], self.starts[0] + self.length);
        let mut is_common = vec![false; self.length];
        for at in common.filter(|at| from <= *at && at + GRAM <= to) {
            is_common[at - from..at - from + GRAM].fill(true);
        }
        let mut parts = Vec::new();
        let mut at = 0;
        while at < self.length {
            let length = is_common[at..].iter().take_while(|is| !**is).count();
            if length > 0 {
                parts.push(Self {
                    starts: self.starts.iter().map(|start| start + at).collect(),
                    length,
                });
            }
            at += length.max(1);
        }
        parts
    }

    /// Whether it is long enough to be more than chance; `stream` is the first that has it.
    pub(super) fn is_long(&self, stream: &Stream<'_>) -> bool {
        self.length >= LONG || (self.length >= LONG_WITH_COMMENTS && self.has_comments(stream))
    }

    /// Whether enough of it is words of comments; `stream` is the first that has it.
    pub(super) fn has_comments(&self, stream: &Stream<'_>) -> bool {
        stream.comment_words(self.starts[0], self.length) >= COMMENT_WORDS
    }
}

/// Each long passage once, the longest first; of two that cover the same tokens of the first stream the longer stays.
pub(super) fn long_ones(mut passages: Vec<Passage>, first: &Stream<'_>) -> Vec<Passage> {
    passages.retain(|passage| passage.is_long(first));
    passages.sort_by(|a, b| b.length.cmp(&a.length).then(a.starts.cmp(&b.starts)));
    let mut kept: Vec<Passage> = Vec::new();
    for passage in passages {
        let (from, to) = (passage.starts[0], passage.starts[0] + passage.length);
        let is_covered =
            |known: &Passage| known.starts[0] <= from && to <= known.starts[0] + known.length;
        if !kept.iter().any(is_covered) {
            kept.push(passage);
        }
    }
    kept
}

/// The lines of tokens in a row, first and last of each, in order and joined where they meet.
pub(super) fn lines(
    stream: &Stream<'_>,
    runs: impl Iterator<Item = (usize, usize)>,
) -> Vec<(usize, usize)> {
    let line = |at: usize| stream.tokens.get(at).map_or(1, |token| token.line);
    let mut ranges: Vec<(usize, usize)> = runs
        .map(|(at, length)| (line(at), line(at + length.max(1) - 1)))
        .collect();
    ranges.sort_unstable();
    let mut joined: Vec<(usize, usize)> = Vec::new();
    for range in ranges {
        match joined.last_mut() {
            Some(last) if range.0 <= last.1 + 1 => last.1 = last.1.max(range.1),
            _ => joined.push(range),
        }
    }
    joined
}

/// The lines `from` to `to` of a text, at most `most` of them.
pub(super) fn excerpt(text: &str, (from, to): (usize, usize), most: usize) -> String {
    let lines: Vec<&str> = text
        .lines()
        .skip(from.saturating_sub(1))
        .take((to + 1 - from).min(most))
        .collect();
    lines.join("\n")
}
