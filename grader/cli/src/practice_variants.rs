//! The submission on other variants: practice for the hidden runs, which change the same numbers. A number that is typed in shows here
//! and not in the student's own variant.

use std::fmt::Write as _;
use std::ops::Range;

use indicatif::ProgressBar;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::lab::Lab;
use kinemark_grader::lab::practice::{PRACTICE_SALT, practice_student};
use kinemark_grader::lab::variant::Variant;
use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome};
use kinemark_grader::record::quantity::points;
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use kinemark_report::visible::visible;
use kinemark_sim::text::{Dimension, Source};
use serde::Serialize;

use crate::failure::Failure;
use crate::worker::WorkerHost;

/// The grades of a submission on practice variants.
#[derive(Debug, Serialize)]
pub(crate) struct PracticeVariants {
    /// One per variant, in order.
    variants: Vec<OnVariant>,
    /// Numbers of the submission's own variant that stand in it, where points are lost on other variants.
    typed_in: Vec<TypedIn>,
}

/// The grade on one practice variant.
#[derive(Debug, Serialize)]
struct OnVariant {
    /// The variant, as `practice 3`.
    name: String,
    points: f64,
    max_points: f64,
    parameters: Vec<(String, Dimension)>,
    /// Checks that lost points here and not in the own variant: task, check, and the first evidence.
    lost: Vec<LostHere>,
}

#[derive(Debug, Serialize)]
struct LostHere {
    task: String,
    check: String,
    title: String,
    why: Option<String>,
}

/// A number in the submission that is one of its own variant, and without which another variant earns more.
#[derive(Debug, Clone, Serialize, PartialEq)]
struct TypedIn {
    /// The line, from one.
    line: usize,
    /// The number as it stands there.
    number: String,
    /// The parameters that have this value, such as `right[1]`.
    parameters: Vec<String>,
}

/// A number in the submission that has the value of a parameter.
#[derive(Debug)]
struct Candidate {
    typed: TypedIn,
    /// Its bytes in the text.
    at: Range<usize>,
    /// What it would be in the other variant.
    other: f64,
    /// Whether it is no number that is in every program.
    is_own: bool,
}

/// Numbers of a submission that are tried in another variant, at most.
const MOST_TRIED: usize = 12;

/// Grades `submission` on the first `count` practice variants of `lab`; `own` is its grade on the own variant.
///
/// # Errors
/// Exit code 2 for a lab without variants; else what loading a variant refuses, and an interrupt.
pub(crate) fn try_variants(
    count: u32,
    lab: &Lab,
    files: &dyn Files,
    submission: &SubmissionSource,
    own: &Grade,
) -> Result<PracticeVariants, Failure> {
    if lab.variants.is_empty() {
        return Err(Failure::usage(
            format!(
                "lab `{}` has no variants: everybody has the same parameters",
                lab.name
            ),
            "leave --variants out",
        ));
    }
    let progress = ProgressBar::new(count.into());
    let mut variants = Vec::new();
    for number in 1..=count {
        let (variant, other) = practice_variant(lab, files, number)?;
        let grade = on_other(submission, &other)?;
        variants.push(OnVariant {
            name: practice_student(number),
            points: grade.points,
            max_points: grade.max_points,
            parameters: variant
                .parameters()
                .map(|(name, value)| (name.to_owned(), value.clone()))
                .collect(),
            lost: lost_here(own, &grade),
        });
        progress.inc(1);
    }
    let typed_in = match least(&variants) {
        Some((index, least)) if !least.lost.is_empty() => {
            let (_, other) = practice_variant(lab, files, index as u32 + 1)?;
            let text = submission.submission.text();
            let candidates = candidates(text, lab, &least.parameters);
            typed_in(text, candidates, least.points, &mut |changed| {
                let source = Source::new(submission.submission.name(), changed);
                on_other(&SubmissionSource::of_text(source), &other).map(|grade| grade.points)
            })?
        }
        _ => Vec::new(),
    };
    progress.finish_and_clear();
    Ok(PracticeVariants { variants, typed_in })
}

/// A practice variant, and the lab in it.
fn practice_variant(lab: &Lab, files: &dyn Files, number: u32) -> Result<(Variant, Lab), Failure> {
    let variant = lab.variant_of(PRACTICE_SALT, &practice_student(number));
    let variant = variant.map_err(LoadError::from)?;
    let other = Lab::load_variant(files, &lab.name, Some(&variant))?;
    Ok((variant, other))
}

fn on_other(submission: &SubmissionSource, other: &Lab) -> Result<Grade, Failure> {
    let graded = submission.grade(other, None, &mut WorkerHost::new(None));
    Ok(graded.map_err(|_| Failure::interrupted())?.grade)
}

/// The variant with the fewest points, the first of equal ones, and its index.
fn least(variants: &[OnVariant]) -> Option<(usize, &OnVariant)> {
    let variants = variants.iter().enumerate();
    variants.min_by(|(_, a), (_, b)| a.points.total_cmp(&b.points))
}

/// Of `candidates`, those without which another variant earns more than `before`, what it does with `text` as it is. `earned` says what
/// a changed text earns there. A number that happens to be a parameter's, such as a gain, changes nothing or costs points.
fn typed_in<E>(
    text: &str,
    mut candidates: Vec<Candidate>,
    before: f64,
    earned: &mut impl FnMut(String) -> Result<f64, E>,
) -> Result<Vec<TypedIn>, E> {
    candidates.truncate(MOST_TRIED);
    if candidates.is_empty() {
        return Ok(Vec::new());
    }
    let all: Vec<&Candidate> = candidates.iter().collect();
    let with_all = earned(replaced(text, &all))?;
    // numbers may count only together: so each in turn is left as it is while the others change
    let mut needed = Vec::new();
    for (i, candidate) in candidates.iter().enumerate() {
        let others: Vec<&Candidate> = all
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != i)
            .map(|(_, other)| *other)
            .collect();
        let without = match others.is_empty() {
            true => before,
            false => earned(replaced(text, &others))?,
        };
        if with_all > before && without < with_all {
            needed.extend(candidate.is_own.then_some(candidate));
        } else if without > before.max(with_all) {
            // the others do it, and this one is something else
            return typed_in(text, owned_without(candidates, i), before, earned);
        }
    }
    let mut found: Vec<TypedIn> = Vec::new();
    for candidate in needed {
        if !found.contains(&candidate.typed) {
            found.push(candidate.typed.clone());
        }
    }
    Ok(found)
}

fn owned_without(mut candidates: Vec<Candidate>, index: usize) -> Vec<Candidate> {
    candidates.remove(index);
    candidates
}

/// The text with the values that these numbers have in the other variant.
fn replaced(text: &str, candidates: &[&Candidate]) -> String {
    let mut out = text.to_owned();
    // from the end, so that places before stay where they are
    for candidate in candidates.iter().rev() {
        out.replace_range(candidate.at.clone(), &format!("({:?})", candidate.other));
    }
    out
}

/// The checks that are full in `own` and lose points in `other`.
fn lost_here(own: &Grade, other: &Grade) -> Vec<LostHere> {
    let mut lost = Vec::new();
    for task in &other.tasks {
        let of_own = own.tasks.iter().find(|known| known.name == task.name);
        for check in &task.checks {
            let own_check = of_own.and_then(|known| {
                let mut checks = known.checks.iter();
                checks.find(|known| known.name == check.name)
            });
            let was_full = own_check.is_some_and(|known| known.outcome == Outcome::Full);
            // what waits for another check says nothing of its own
            if was_full && matches!(check.outcome, Outcome::Partial | Outcome::None) {
                lost.push(LostHere {
                    task: task.name.clone(),
                    check: check.name.clone(),
                    title: check.title.clone(),
                    why: why(check),
                });
            }
        }
    }
    lost
}

fn why(check: &CheckGrade) -> Option<String> {
    check.evidence.first().map(|fact| fact.message.clone())
}

/// Numbers in the text that are values of the lab's varied parameters, in order, and what they are with the `other` parameters. 0, 1 and 2
/// are in every program: they count only in a list with another such number, as in `[2.0, 1.4]`.
fn candidates(text: &str, lab: &Lab, other: &[(String, Dimension)]) -> Vec<Candidate> {
    let named = named_numbers(lab, other);
    let mut found = Vec::new();
    let mut line_start = 0;
    for (i, line) in text.split_inclusive('\n').enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        // each with the parameter that it is most likely to be, and whether it is in every program
        let numbers: Vec<(usize, &str, Vec<&NamedNumber>)> = numbers_in(code)
            .filter_map(|(at, number)| {
                let parameters = of_value(&named, code, at, number);
                (!parameters.is_empty()).then_some((at, number, parameters))
            })
            .collect();
        let is_own = |parameters: &[&NamedNumber]| !parameters[0].is_everywhere();
        for (at, number, parameters) in &numbers {
            let companion = numbers.iter().find(|(place, _, of)| {
                is_own(of) && list_around(code, *place).is_some_and(|list| list.contains(at))
            });
            let parameter = match (is_own(parameters), companion) {
                (true, _) => parameters[0],
                (false, Some((_, _, of))) => {
                    let mut of_same = parameters.iter();
                    of_same
                        .find(|it| it.list() == of[0].list())
                        .copied()
                        .unwrap_or(parameters[0])
                }
                (false, None) => continue,
            };
            let start = line_start + at;
            found.push(Candidate {
                at: start..start + number.len(),
                // the sign before it stays
                other: parameter.other * parameter.own.signum(),
                is_own: is_own(parameters),
                typed: TypedIn {
                    line: i + 1,
                    number: (*number).to_owned(),
                    parameters: parameters.iter().map(|known| known.name.clone()).collect(),
                },
            });
        }
        line_start += line.len();
    }
    found
}

/// The parameters whose value stands at a place, first those with the sign that it has there.
fn of_value<'n>(
    named: &'n [NamedNumber],
    code: &str,
    at: usize,
    number: &str,
) -> Vec<&'n NamedNumber> {
    let Ok(value) = number.parse::<f64>() else {
        return Vec::new();
    };
    let is_negative = code[..at].trim_end().ends_with('-');
    let same = named
        .iter()
        .filter(|known| known.own.abs().to_bits() == value.to_bits());
    let (mut parameters, others): (Vec<_>, Vec<_>) =
        same.partition(|known| (known.own < 0.0) == is_negative);
    parameters.extend(others);
    parameters
}

/// The list around a place in a line of code: what is between its brackets.
fn list_around(code: &str, at: usize) -> Option<Range<usize>> {
    let mut depth = 0_usize;
    let begin = code[..at].char_indices().rev().find_map(|(i, sign)| {
        match sign {
            ']' => depth += 1,
            '[' if depth == 0 => return Some(i + 1),
            '[' => depth -= 1,
            _ => {}
        }
        None
    })?;
    let end = code[at..].find([']', '[']).map(|end| at + end)?;
    Some(begin..end)
}

/// A varied number of a lab: its name, and its value here and in another variant.
struct NamedNumber {
    name: String,
    own: f64,
    other: f64,
}

impl NamedNumber {
    /// Whether such a number is in every program.
    fn is_everywhere(&self) -> bool {
        [0.0, 1.0, 2.0].contains(&self.own.abs())
    }

    /// The parameter of which it is an element: `left` of `left[0]`.
    fn list(&self) -> &str {
        self.name.split('[').next().unwrap_or_default()
    }
}

fn named_numbers(lab: &Lab, other: &[(String, Dimension)]) -> Vec<NamedNumber> {
    let mut named = Vec::new();
    for rule in &lab.variants {
        let other = other.iter().find(|(name, _)| *name == rule.name);
        match (lab.parameters.get(&rule.name), other) {
            (Some(Dimension::Number(own)), Some((name, Dimension::Number(other)))) => {
                named.push(NamedNumber {
                    name: name.clone(),
                    own: *own,
                    other: *other,
                });
            }
            (Some(Dimension::List(own)), Some((name, Dimension::List(other)))) => {
                let pairs = own.iter().zip(other).enumerate();
                named.extend(pairs.map(|(i, (own, other))| NamedNumber {
                    name: format!("{name}[{i}]"),
                    own: *own,
                    other: *other,
                }));
            }
            _ => {}
        }
    }
    named
}

/// The numbers of a line of code, each with its first byte: digits with a point, not part of a name.
fn numbers_in(code: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut at = 0;
    let words = code
        .split_inclusive(move |c| !is_of_word(c))
        .map(move |piece| {
            let start = at;
            at += piece.len();
            (start, piece.trim_end_matches(|c| !is_of_word(c)))
        });
    words.filter(|(_, word)| word.starts_with(|c: char| c.is_ascii_digit()))
}

impl PracticeVariants {
    /// For a terminal, behind the grade of the own variant.
    pub(crate) fn text(&self, own: &Grade) -> String {
        let mut out = String::new();
        let full = self
            .variants
            .iter()
            .filter(|variant| variant.points >= variant.max_points)
            .count();
        let Some((_, least)) = least(&self.variants) else {
            return out;
        };
        let of = |earned: f64, max: f64| format!("{} of {}", points(earned), points(max));
        let _ = writeln!(
            out,
            "your variant {}; of {} other variants {full} have full marks, and the least is {}",
            of(own.points, own.max_points),
            self.variants.len(),
            of(least.points, least.max_points),
        );
        if least.lost.is_empty() {
            return out;
        }
        let _ = writeln!(out, "  {} ({}):", least.name, numbers(&least.parameters));
        for lost in least.lost.iter().take(3) {
            let why = lost
                .why
                .as_deref()
                .map_or(String::new(), |why| format!(": {why}"));
            let _ = writeln!(
                out,
                "  - {} \"{}\"{}",
                lost.task,
                visible(&lost.title),
                visible(&why)
            );
        }
        for typed in self.typed_in.iter().take(5) {
            let _ = writeln!(
                out,
                "  line {} has {}, which is {} of your variant: is it typed in?",
                typed.line,
                typed.number,
                typed
                    .parameters
                    .iter()
                    .map(|name| format!("`{name}`"))
                    .collect::<Vec<_>>()
                    .join(" and ")
            );
        }
        let _ = writeln!(
            out,
            "  next: take every number that may change from `robot` or `observation.target`; the hidden runs change the same ones."
        );
        out
    }
}

/// Parameters in a line.
fn numbers(parameters: &[(String, Dimension)]) -> String {
    let words = parameters.iter().map(|(name, value)| match value {
        Dimension::Number(number) => format!("{name} = {number}"),
        Dimension::List(numbers) => format!("{name} = {numbers:?}"),
        Dimension::Text(text) => format!("{name} = {text}"),
    });
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_apart_from_names_and_comments() {
        let code = "let q2 = x1 + 1.45 * (3 - 0.25e1) - a.b";
        let found: Vec<(usize, &str)> = numbers_in(code).collect();
        assert_eq!(found, [(14, "1.45"), (22, "3"), (26, "0.25e1")]);
        for (at, number) in found {
            assert!(code[at..].starts_with(number), "{number}");
        }
    }

    fn candidate(text: &str, number: &str, other: f64) -> Candidate {
        let at = text.find(number).expect("the number");
        Candidate {
            at: at..at + number.len(),
            other,
            is_own: true,
            typed: TypedIn {
                line: 1,
                number: number.to_owned(),
                parameters: vec![],
            },
        }
    }

    /// Points of a text in a variant whose place is (3.5, 4.5), and whose gain of 0.3 costs points where it is another.
    fn earned(text: String) -> Result<f64, ()> {
        let place = f64::from(text.contains("3.5") && text.contains("4.5"));
        let gain = f64::from(text.contains("gain = 0.3"));
        Ok(10.0 * place + 5.0 * gain)
    }

    #[test]
    fn a_list_is_what_stands_between_its_brackets() {
        let code = "[[2.0, 1.4], [2.0, -1.4]]";
        let inside = |at: usize| list_around(code, at).map(|list| &code[list]);
        assert_eq!(inside(2), Some("2.0, 1.4"));
        assert_eq!(inside(20), Some("2.0, -1.4"));
        assert_eq!(list_around("a = 2.0", 4), None);
    }

    #[test]
    fn numbers_are_typed_in_if_another_variant_earns_more_without_them() {
        let text = "place = [3.1, 4.1]; gain = 0.3; other = 0.7";
        let all = || {
            vec![
                candidate(text, "3.1", 3.5),
                candidate(text, "4.1", 4.5),
                candidate(text, "0.3", 0.4),
                candidate(text, "0.7", 0.8),
            ]
        };
        let found = typed_in(text, all(), 5.0, &mut earned).expect("tried");
        let numbers: Vec<&str> = found.iter().map(|typed| typed.number.as_str()).collect();
        assert_eq!(numbers, ["3.1", "4.1"]);
        // what changes nothing is nobody's number
        let none = typed_in(text, all().split_off(2), 5.0, &mut earned).expect("tried");
        assert_eq!(none, []);
    }
}
