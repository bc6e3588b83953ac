//! What else is wrong in a file that does not parse: the parser stops at the first, and a student should not need a run for each. What it
//! stops at is taken out, and the rest is parsed again; what stands in the lines that are taken out is read from their text.

use std::collections::BTreeSet;

use rhai::Engine;

use super::habits::{Written, of_line, percent_comment};
use super::mistake::Context;
use super::parsing::END_BEFORE;
use super::recovery::Rest;
use super::signs::Signs;
use super::unknown::{Unknown, unknown};
use crate::record::grade::FurtherMistake;
use crate::submission::controller::{Mistake, SourcePosition};

/// Places that are listed.
const MOST: usize = 40;
/// Times that a file is parsed again.
const MOST_REPAIRS: usize = 60;
/// Bytes that are parsed again, in all these times: a long file is parsed less often.
const MOST_READ_AGAIN: usize = 1 << 20;
const COMMENT: &str = "a comment begins with //; the remainder of a division is a % b";

/// A line, and what to write there.
type Found = Vec<(usize, String)>;

impl Context<'_> {
    /// What is wrong with the code that stands between two lines of a chat, of which `fence` is the first.
    pub(super) fn between_fences(&self, engine: &Engine, fence: Mistake) -> Mistake {
        let mut is_code = false;
        let lines: Vec<&str> = self
            .source
            .lines()
            .map(|line| {
                let is_fence = line.trim_start().starts_with("```");
                is_code ^= is_fence;
                if is_code && !is_fence { line } else { "" }
            })
            .collect();
        let source = lines.join("\n");
        let context = Context {
            source: &source,
            ..*self
        };
        let Err(error) = engine.compile(&source) else {
            return fence;
        };
        let Some(mistake) = context.parse_mistake(&error) else {
            return fence;
        };
        let mut further = context.further(engine, &mistake);
        let first = mistake.place.map(|place| FurtherMistake {
            lines: vec![place.line],
            help: mistake.help.unwrap_or(mistake.message),
        });
        further.splice(0..0, first);
        Mistake { further, ..fence }
    }

    /// What is wrong besides `first`, where the parser stopped at first: lines, each with what to write there.
    pub(super) fn further(&self, engine: &Engine, first: &Mistake) -> Vec<FurtherMistake> {
        let Some(SourcePosition {
            line: first_line, ..
        }) = first.place
        else {
            return Vec::new();
        };
        let mut found = Found::new();
        let taken_out = self.parse_on(engine, first, &mut found);
        let signs = Signs::of(self.source);
        let code: Vec<(usize, String)> = signs.lines().collect();
        let written = Written::of(code.iter().map(|(_, code)| code.as_str()));
        let raw: Vec<&str> = self.source.lines().collect();
        for (line, code) in &code {
            let raw = raw.get(*line - 1).copied().unwrap_or_default();
            let comment = percent_comment(raw);
            // without what is in a comment of another language
            let before = comment.and_then(|at| Signs::of(&raw[..at]).lines().next());
            let code = before.as_ref().map_or(code, |(_, before)| before);
            // powers parse, and are refused later
            let has_power = code.contains('^') && !code.contains(".^");
            if *line > first_line || has_power {
                let is_power = |help: &String| *line > first_line || help.contains("**");
                let of_line = of_line(code).into_iter().filter(is_power);
                found.extend(of_line.map(|help| (*line, help)));
            }
            if *line == first_line || taken_out.contains(line) {
                let of_text = written.of_taken_out(code, self.names).into_iter();
                let is_new = |help: &String| {
                    let name = help.split(':').next().unwrap_or_default();
                    *line != first_line || !first.message.contains(name)
                };
                found.extend(of_text.filter(is_new).map(|help| (*line, help)));
                found.extend(comment.map(|_| (*line, COMMENT.to_owned())));
            }
        }
        found.sort_by_key(|(line, _)| *line);
        listed(&found, first)
    }

    /// Takes out what the parser stops at, again and again, adds what it stops at next to `found`, and says which lines were taken out.
    fn parse_on(&self, engine: &Engine, first: &Mistake, found: &mut Found) -> BTreeSet<usize> {
        let mut rest = Rest::of(self.source);
        let first_line = first.place.map(|place| place.line);
        let mut mistake = first.clone();
        for _ in 0..most_repairs(self.source) {
            let Some(place) = mistake.place else {
                break;
            };
            if !rest.repair(&mistake, place) {
                break;
            }
            let source = rest.lines.join("\n");
            let error = match engine.compile(&source) {
                Ok(ast) => {
                    let names = unknown(&ast, self.names, &rest.taken_out).into_iter();
                    let others = names.filter(|unknown| Some(unknown.line) != first_line);
                    found.extend(others.map(|Unknown { line, help, .. }| (line, help)));
                    break;
                }
                Err(error) => error,
            };
            let context = Context {
                source: &source,
                ..*self
            };
            let Some(next) = context.parse_mistake(&error) else {
                break;
            };
            let Some(at) = next.place.filter(|at| at.line >= place.line) else {
                break;
            };
            // what says no more than that something is wrong may come from what was taken out
            let says_more = next.help.as_deref().map_or_else(
                || !next.message.starts_with("unexpected "),
                |help| help != END_BEFORE,
            );
            // the function around it has lost its head
            let is_lost = next.message.starts_with("`this` ");
            if at.line > place.line && !rest.is_changed(at.line) && says_more && !is_lost {
                let help = next.help.clone().unwrap_or_else(|| next.message.clone());
                found.push((at.line, help));
            }
            mistake = next;
        }
        rest.changed
    }
}

/// Times that this file is parsed again at most.
fn most_repairs(source: &str) -> usize {
    MOST_REPAIRS.min(MOST_READ_AGAIN / source.len().max(1))
}

/// What was found, the same advice once with all lines it is for; that of `first`, which has a line already, before all others.
fn listed(found: &Found, first: &Mistake) -> Vec<FurtherMistake> {
    let first_line = first.place.map(|place| place.line);
    let first_help = first.help.as_deref().unwrap_or_default();
    let is_first = |help: &str| !first_help.is_empty() && help.ends_with(first_help);
    let lines_of = |is_it: &dyn Fn(&str) -> bool| {
        let mut lines: Vec<usize> = Vec::new();
        for (line, _) in found.iter().filter(|(_, help)| is_it(help)) {
            if lines.last() != Some(line) {
                lines.push(*line);
            }
        }
        lines
    };
    let mut again = lines_of(&is_first);
    again.retain(|line| Some(*line) != first_line);
    let mut listed: Vec<FurtherMistake> = Vec::new();
    if !again.is_empty() {
        listed.push(FurtherMistake {
            lines: again,
            help: first_help.to_owned(),
        });
    }
    for (_, help) in found {
        let is_said = listed.iter().any(|known| known.help.ends_with(help));
        if is_said || is_first(help) || listed.len() == MOST {
            continue;
        }
        listed.push(FurtherMistake {
            lines: lines_of(&|other: &str| other == help),
            help: help.clone(),
        });
    }
    listed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_file_is_parsed_again_less_often() {
        assert_eq!(most_repairs("let x = ;"), MOST_REPAIRS);
        assert_eq!(most_repairs(&"x".repeat(10_000)), MOST_REPAIRS);
        assert_eq!(most_repairs(&"x".repeat(65_536)), 16);
        assert_eq!(most_repairs(""), MOST_REPAIRS);
    }
}
