//! One change of a solution, where it is, and the solution with it.

use std::collections::BTreeSet;

use kinemark_sim::random::KeyedStream;
use kinemark_sim::text::Source;
use serde::Serialize;

use super::operators::{DELAY, OPERATORS, OperatorName, Program};
use crate::audit::rubric::MUTATION;
use crate::submission::rhai::{Bytes, ProgramTree};

/// One change of a solution.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mutation {
    /// Its number, from one; the same as long as the solution is the same.
    pub number: usize,
    /// The kind of change.
    pub operator: OperatorName,
    /// The line in which it begins, from one.
    pub line: usize,
    /// The column in that line, in characters, from one.
    pub column: usize,
    /// The line before, without its comment; of a change over several lines all of them, with a blank between.
    pub before: String,
    /// The line after it.
    pub after: String,
    /// The bytes of the solution that are replaced.
    #[serde(skip)]
    pub at: Bytes,
    /// What replaces them.
    #[serde(skip)]
    pub text: String,
}

impl Mutation {
    /// What names it in `accepted.toml`: the line before and the line after.
    pub fn of(&self) -> String {
        format!("{} -> {}", self.before, self.after)
    }

    /// The entry of `accepted.toml` that accepts it, with the reason left to write; `choice` is the rule of what is no mistake.
    pub fn entry(&self) -> String {
        let of = toml::Value::String(self.of());
        format!("[[accepted]]\nrule = \"{MUTATION}\"\nof = {of}\nbecause = \"\"\n")
    }

    /// The changed solution.
    pub fn program(&self, solution: &str) -> String {
        let (before, behind) = (&solution[..self.at.start], &solution[self.at.end..]);
        format!("{before}{}{behind}", self.text)
    }
}

/// Every change of a solution, by place; two that give the same program are one. Empty where its brackets do not match.
pub fn mutations(solution: &Source) -> Vec<Mutation> {
    let text = solution.text();
    let Some(tree) = ProgramTree::read(text) else {
        return Vec::new();
    };
    let program = Program { text, tree: &tree };
    let mut all = Vec::new();
    for (rank, operator) in OPERATORS.iter().enumerate() {
        let mut found = Vec::new();
        (operator.find)(&program, &mut found);
        let of_kind = found.into_iter();
        all.extend(of_kind.map(|(at, text)| (at.start, at.end, rank, at, text, operator.name)));
    }
    // of the same place and kind in the order in which they were found
    all.sort_by_key(|(start, end, rank, ..)| (*start, *end, *rank));
    let mut programs = BTreeSet::new();
    let mut mutations: Vec<Mutation> = Vec::new();
    for (_, _, _, at, replacement, name) in all {
        let (line, column) = solution.line_and_column(at.start);
        let lines = lines_around(text, &at);
        let before = without_comments(text, &lines, &tree.comments, None);
        let after = match name {
            DELAY => format!("{before} // one control period late"),
            _ => without_comments(text, &lines, &tree.comments, Some((&at, &replacement))),
        };
        let mutation = Mutation {
            number: mutations.len() + 1,
            operator: OperatorName(name),
            line,
            column,
            before,
            after,
            at,
            text: replacement,
        };
        let changed = mutation.program(text);
        if changed != text && programs.insert(changed) {
            mutations.push(mutation);
        }
    }
    mutations
}

/// So many of `count` mutations, drawn by `seed` and the lab's name, in their order; all of them where there are no more.
pub fn drawn(lab: &str, count: usize, draw: usize, seed: u64) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..count).collect();
    let mut stream = KeyedStream::new("kinemark 2026 drawn mutations", &[lab], &seed.to_le_bytes());
    let draw = draw.min(count);
    for i in 0..draw {
        let left = (count - i) as u64;
        let other = i + stream.below(left) as usize;
        numbers.swap(i, other);
    }
    numbers.truncate(draw);
    numbers.sort_unstable();
    numbers
}

/// The bytes of all lines that a change touches.
fn lines_around(text: &str, at: &Bytes) -> Bytes {
    let start = text[..at.start].rfind('\n').map_or(0, |end| end + 1);
    let length = text[at.end..].find('\n');
    start..length.map_or(text.len(), |length| at.end + length)
}

/// Code without comments, with a single blank for all that is blank, and with `change` in it.
fn without_comments(
    text: &str,
    lines: &Bytes,
    comments: &[Bytes],
    change: Option<(&Bytes, &str)>,
) -> String {
    let mut code = String::new();
    let mut from = lines.start;
    let mut copy = |until: usize, code: &mut String, skip_to: usize| {
        if from < until {
            code.push_str(&text[from..until]);
        }
        from = from.max(skip_to);
    };
    let mut cuts: Vec<(Bytes, &str)> = comments
        .iter()
        .filter(|comment| comment.start < lines.end && lines.start < comment.end)
        // what is replaced takes its comments with it
        .filter(|comment| {
            !change.is_some_and(|(at, _)| at.start <= comment.start && comment.end <= at.end)
        })
        .map(|comment| (comment.clone(), ""))
        .collect();
    cuts.extend(change.map(|(at, replacement)| (at.clone(), replacement)));
    cuts.sort_by_key(|(at, _)| at.start);
    for (at, replacement) in cuts {
        copy(at.start, &mut code, at.end);
        code.push_str(replacement);
    }
    copy(lines.end, &mut code, lines.end);
    code.split_whitespace().collect::<Vec<_>>().join(" ")
}
