//! What else is wrong further down in a file that does not parse: the parser stops at the first, and a student should not need a run for
//! each. What it stops at is taken out, line by line, and the rest is parsed again.

use std::collections::BTreeMap;

use rhai::Engine;

use super::foreign;
use super::mistake::Context;
use super::parsing::END_BEFORE;
use super::signs::Signs;
use super::unknown::{Unknown, unknown};
use crate::submission::controller::{Mistake, SourcePosition};

/// Places that are listed.
const MOST: usize = 14;
/// Times that a file is parsed again.
const MOST_REPAIRS: usize = 40;
/// Lines that one statement may have.
const MOST_LINES: usize = 30;

/// Words that nobody gives to a variable.
const WORDS: [&str; 11] = [
    "pass", "and", "or", "not", "elif", "elseif", "def", "function", "lambda", "struct", "enum",
];
/// Words of a line that may declare names.
const DECLARING: [&str; 5] = ["let", "const", "for", "fn", "function"];
/// Signs that the language does not have outside of strings and comments.
const FOREIGN_SIGNS: [&str; 10] = [".*", "./", ".^", "++", "===", "!==", "~=", "@", "~", "^"];
/// Prefixes of modules.
const PREFIXES: [&str; 4] = ["np", "numpy", "math", "Math"];

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
        let further = context.further(engine, &mistake);
        let Mistake {
            message,
            place,
            help,
        } = mistake;
        let line = place.map_or_else(String::new, |place| format!("line {}: ", place.line));
        let first = format!("{line}{}", help.unwrap_or(message));
        let all = further.map_or_else(|| first.clone(), |further| format!("{first}; {further}"));
        fence.with_more("Further down, ", Some(all))
    }

    /// The lines below that of `first`, where the parser stopped at first, each with what to write there.
    pub(super) fn further(&self, engine: &Engine, first: &Mistake) -> Option<String> {
        let after = first.place?;
        let mut found: BTreeMap<usize, String> = BTreeMap::new();
        self.parse_on(engine, first.clone(), &mut found);
        // what the parser did not come to, because it stood in a line with something else
        for (line, text) in Signs::of(self.source).lines() {
            // in its own line a power stands for itself, and other signs belong to what was found there
            let counts = line > after.line || (line == after.line && text.contains('^'));
            if counts && let Some(help) = of_line(&text) {
                found.entry(line).or_insert(help);
            }
        }
        let first_help = first.help.as_deref().unwrap_or_default();
        let is_first = |help: &str| !first_help.is_empty() && help.ends_with(first_help);
        let mut words: Vec<String> = Vec::new();
        let mut said: Vec<&str> = vec![first_help];
        for (line, help) in &found {
            // the same advice once, with all lines it is for
            if said.contains(&help.as_str()) || is_first(help) {
                continue;
            }
            said.push(help);
            let lines: Vec<String> = found
                .iter()
                .filter(|(_, other)| *other == help)
                .map(|(line, _)| line.to_string())
                .collect();
            words.push(match lines.len() {
                1 => format!("line {line}: {help}"),
                2 | 3 => format!("lines {}: {help}", lines.join(", ")),
                count => format!("line {line} and {} more: {help}", count - 1),
            });
        }
        words.truncate(MOST);
        (!words.is_empty()).then(|| words.join("; "))
    }

    /// Takes out what the parser stops at, again and again, and adds what it stops at next to `found`.
    fn parse_on(&self, engine: &Engine, first: Mistake, found: &mut BTreeMap<usize, String>) {
        let mut rest = Rest::of(self.source);
        let first_line = first.place.map(|place| place.line);
        let mut mistake = first;
        for _ in 0..MOST_REPAIRS {
            let Some(place) = mistake.place else {
                return;
            };
            if !rest.repair(&mistake, place) {
                return;
            }
            let source = rest.lines.join("\n");
            match engine.compile(&source) {
                Ok(ast) => {
                    for Unknown { line, help, .. } in unknown(&ast, self.names, &rest.taken_out) {
                        if Some(line) != first_line {
                            found.entry(line).or_insert(help);
                        }
                    }
                    return;
                }
                Err(error) => {
                    let context = Context {
                        source: &source,
                        ..*self
                    };
                    let Some(next) = context.parse_mistake(&error) else {
                        return;
                    };
                    let Some(at) = next.place.filter(|at| at.line >= place.line) else {
                        return;
                    };
                    // what says no more than that something is wrong may come from what was taken out
                    let says_more = next.help.as_deref().map_or_else(
                        || !next.message.starts_with("unexpected "),
                        |help| help != END_BEFORE,
                    );
                    if at.line > place.line && !rest.is_changed(at.line) && says_more {
                        let help = next.help.clone().unwrap_or_else(|| next.message.clone());
                        found.entry(at.line).or_insert(help);
                    }
                    mistake = next;
                }
            }
        }
    }
}

/// A file from which statements are taken out.
struct Rest {
    lines: Vec<String>,
    changed: Vec<usize>,
    /// Every word of what was taken out: names that may have been declared there.
    taken_out: Vec<String>,
}

impl Rest {
    fn of(source: &str) -> Self {
        let mut rest = Self {
            lines: source.lines().map(str::to_owned).collect(),
            changed: Vec::new(),
            taken_out: Vec::new(),
        };
        // the end of a block of another language, whose beginning is taken out when the parser stops at it, and an empty one
        for line in &mut rest.lines {
            if matches!(line.trim().trim_end_matches(';'), "end" | "pass") {
                line.clear();
            }
        }
        rest
    }

    fn is_changed(&self, line: usize) -> bool {
        self.changed.contains(&line)
    }

    /// Takes out or completes what the parser stopped at; false where that would change nothing.
    fn repair(&mut self, mistake: &Mistake, place: SourcePosition) -> bool {
        let Some(line) = self.lines.get_mut(place.line.wrapping_sub(1)) else {
            return false;
        };
        for sign in [';', ','] {
            let is_missing = format!("a `{sign}` is missing at the end of line");
            if mistake.message.starts_with(&is_missing) {
                let at = line.char_indices().nth(place.column.saturating_sub(1));
                let at = at.map_or(line.len(), |(at, _)| at);
                line.insert(at, sign);
                return true;
            }
        }
        self.take_out(place)
    }

    /// Takes out the statement at a place, all but its braces.
    fn take_out(&mut self, place: SourcePosition) -> bool {
        let [first, last] = self.statement(place.line);
        let text = self.lines.join("\n");
        let signs = Signs::of(&text);
        let of_statement: Vec<(usize, String)> = signs
            .lines()
            .filter(|(line, _)| (first..=last).contains(line))
            .collect();
        let mut is_new = false;
        for (line, code) in of_statement {
            let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            if words.iter().any(|word| DECLARING.contains(word)) {
                self.taken_out.extend(words.into_iter().map(str::to_owned));
            }
            let left = without_statements(&code);
            let text = &mut self.lines[line - 1];
            is_new |= *text != left;
            *text = left;
            self.changed.push(line);
        }
        is_new
    }

    /// The lines of the statement in a line: those that brackets tie together.
    fn statement(&self, line: usize) -> [usize; 2] {
        let text = self.lines.join("\n");
        let signs = Signs::of(&text);
        let begins = SourcePosition { line, column: 1 };
        let mut first = line;
        let mut at = begins;
        while let Some((open, sign)) = signs.open_at(at)
            && sign != '{'
        {
            (first, at) = (open.line, open);
        }
        let mut depth = 0_i64;
        let mut last = line;
        for (number, code) in signs.lines().filter(|(number, _)| *number >= first) {
            let change = |sign: char| match sign {
                '(' | '[' => 1,
                ')' | ']' => -1,
                _ => 0,
            };
            depth += code.chars().map(change).sum::<i64>();
            last = number.max(line);
            if number >= line && depth <= 0 || number - first >= MOST_LINES {
                break;
            }
        }
        [first, last]
    }
}

/// Blocks that open and close as those of a line of code do, with nothing in them.
fn without_statements(code: &str) -> String {
    let mut left = String::new();
    let mut open = 0_usize;
    let function = header(code);
    for sign in code.chars() {
        match sign {
            '{' => {
                let begins = match &function {
                    Some(header) if open == 0 => header,
                    _ => "if true",
                };
                left += &format!("{begins} {{ ");
                open += 1;
            }
            '}' => {
                left += "} ";
                open = open.saturating_sub(1);
            }
            _ => {}
        }
    }
    left
}

/// The header of the function that a line of code defines, its parameters as names alone.
fn header(code: &str) -> Option<String> {
    let (before, rest) = code.split_once("fn ")?;
    let is_of_rust = before.trim().is_empty() || before.trim() == "pub";
    let (name, rest) = rest.split_once('(').filter(|_| is_of_rust)?;
    let (parameters, _) = rest.split_once(')')?;
    let name_of = |parameter: &str| {
        let name = parameter.split([':', '=']).next().unwrap_or_default();
        let mut words = name.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let word = words.rfind(|word| !word.is_empty() && !["mut", "self"].contains(word));
        word.map(str::to_owned)
    };
    let parameters: Vec<String> = parameters.split(',').filter_map(name_of).collect();
    Some(format!("fn {}({})", name.trim(), parameters.join(", ")))
}

/// What to write for the first thing of another language in a line without its strings and comments.
fn of_line(text: &str) -> Option<String> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let mut words = words.filter(|word| !word.is_empty());
    let word = words.find(|word| WORDS.contains(word) || PREFIXES.contains(word));
    if let Some(word) = word {
        return foreign::word(word).or_else(|| foreign::variable(word));
    }
    if text.contains('^') && !text.contains(".^") {
        return Some("use ** for powers: x ** 2".to_owned());
    }
    if text.contains("@(") {
        return foreign::sign("@(");
    }
    let sign = FOREIGN_SIGNS.iter().find(|sign| text.contains(**sign))?;
    foreign::sign(sign)
}
