//! The submission on other variants: practice for the hidden runs, which change the same numbers. A number that is typed in shows here
//! and not in the student's own variant.

use std::fmt::Write as _;

use indicatif::ProgressBar;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::lab::Lab;
use kinemark_grader::lab::practice::{PRACTICE_SALT, practice_student};
use kinemark_grader::record::grade::{CheckGrade, Grade, Outcome};
use kinemark_grader::record::quantity::points;
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use kinemark_report::visible::visible;
use kinemark_sim::text::Dimension;
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

/// A number in the submission that is one of its own variant.
#[derive(Debug, Serialize, PartialEq)]
struct TypedIn {
    /// The line, from one.
    line: usize,
    /// The number as it stands there.
    number: String,
    /// The parameters that have this value, such as `right[1]`.
    parameters: Vec<String>,
}

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
        let name = practice_student(number);
        let variant = lab.variant_of(PRACTICE_SALT, &name);
        let variant = variant.map_err(LoadError::from)?;
        let other = Lab::load_variant(files, &lab.name, Some(&variant))?;
        let graded = submission.grade(&other, None, &mut WorkerHost::new(None));
        let grade = graded.map_err(|_| Failure::interrupted())?.grade;
        variants.push(OnVariant {
            name,
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
    progress.finish_and_clear();
    let is_lost = variants.iter().any(|variant| !variant.lost.is_empty());
    let typed_in = if is_lost {
        typed_in(submission.source.text(), lab)
    } else {
        Vec::new()
    };
    Ok(PracticeVariants { variants, typed_in })
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

/// Numbers in the text that are values of the lab's varied parameters; 0, 1 and 2 are in every program.
fn typed_in(text: &str, lab: &Lab) -> Vec<TypedIn> {
    let mut named: Vec<(String, f64)> = Vec::new();
    for rule in &lab.variants {
        match lab.parameters.get(&rule.name) {
            Some(Dimension::Number(value)) => named.push((rule.name.clone(), *value)),
            Some(Dimension::List(values)) => named.extend(
                values
                    .iter()
                    .enumerate()
                    .map(|(i, value)| (format!("{}[{i}]", rule.name), *value)),
            ),
            None => {}
        }
    }
    let is_everywhere = |value: f64| [0.0, 1.0, 2.0].contains(&value.abs());
    named.retain(|(_, value)| !is_everywhere(*value));
    let mut found = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for number in numbers_in(code) {
            let Ok(value) = number.parse::<f64>() else {
                continue;
            };
            let same = |known: &f64| known.abs().to_bits() == value.to_bits();
            let parameters = named.iter().filter(|(_, known)| same(known));
            let parameters: Vec<String> = parameters.map(|(name, _)| name.clone()).collect();
            if parameters.is_empty() {
                continue;
            }
            let typed = TypedIn {
                line: i + 1,
                number: number.to_owned(),
                parameters,
            };
            if !found.contains(&typed) {
                found.push(typed);
            }
        }
    }
    found
}

/// The numbers of a line of code: digits with a point, not part of a name.
fn numbers_in(code: &str) -> impl Iterator<Item = &str> {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    code.split(move |c| !is_of_word(c))
        .filter(|word| word.starts_with(|c: char| c.is_ascii_digit()))
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
        let least = self
            .variants
            .iter()
            .min_by(|a, b| a.points.total_cmp(&b.points));
        let Some(least) = least else {
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
    });
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_apart_from_names_and_comments() {
        let found: Vec<&str> = numbers_in("let q2 = x1 + 1.45 * (3 - 0.25e1) - a.b").collect();
        assert_eq!(found, ["1.45", "3", "0.25e1"]);
    }
}
