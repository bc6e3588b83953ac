//! The cases of a function task in the record: visible ones with their numbers, hidden ones by class.

use kinemark_sim::text::Dimension;
use kinemark_sim::text::number::{list, lists, trimmed};

use crate::attempt::answers::{Answered, CaseError, CaseFacts};
use crate::attempt::measure::as_slice;
use crate::check::function_cases::written;
use crate::lab::Lab;
use crate::record::grade::{CaseGrade, HiddenClass};
use crate::task::model::{Band, Case, Given};
use crate::task::tcp::tcp_in;

pub(super) fn case_grade(lab: &Lab, facts: &CaseFacts<'_>, band: Band) -> CaseGrade {
    let expected = match &facts.case.given {
        Given::Q(q) => match &facts.error {
            CaseError::Jacobian { truth, .. } => Some(lists(truth)),
            _ => tcp_in(facts.robot, &lab.frame, q).map(|p| format!("{} m", list(p.as_slice()))),
        },
        // the expected angles would be the answer of the task
        Given::Position { branches, .. } => {
            (*branches == 0).then(|| "[] (out of reach)".to_owned())
        }
        Given::Values { expected, .. } => Some(entries(expected)),
    };
    let error_m = match &facts.error {
        CaseError::Position(error_m) => Some(*error_m),
        CaseError::Reach { branches_m, .. } => branches_m.first().copied(),
        CaseError::Unreachable { .. } | CaseError::Jacobian { .. } | CaseError::Entries(_) => None,
    };
    let relative_error = match &facts.error {
        CaseError::Jacobian { relative, .. } => Some(*relative),
        CaseError::Entries(relative) => relative.iter().copied().max_by(f64::total_cmp),
        _ => None,
    };
    CaseGrade {
        name: facts.case.name.clone(),
        given: given_in_words(facts.case),
        answer: match &facts.answer {
            Answered::Position(p) => format!("{} m", list(p.as_slice())),
            Answered::Branches(rows) | Answered::Matrix(rows) => lists(rows),
            Answered::Entries(answer) => match &facts.case.given {
                Given::Values { expected, .. } => named(
                    expected
                        .iter()
                        .zip(answer)
                        .map(|((name, _), numbers)| (name.as_str(), numbers.as_slice())),
                ),
                _ => lists(answer),
            },
            Answered::Invalid(what) => what.clone(),
            Answered::Stopped => "no answer".to_owned(),
        },
        expected,
        error_m: error_m.filter(|error_m| error_m.is_finite()),
        relative_error: relative_error.filter(|relative| relative.is_finite()),
        good: is_good(facts, band),
    }
}

/// The input of a case in words, with the dimensions that are its own.
pub(super) fn given_in_words(case: &Case) -> String {
    let given = match &case.given {
        Given::Q(q) => format!("q = {} rad", list(q)),
        Given::Position { position_m, .. } => format!("position = {} m", list(position_m)),
        Given::Values { given, .. } => entries(given),
    };
    let changed = case.dimensions.iter().map(|(name, dimension)| {
        let value = match dimension {
            Dimension::Number(number) => trimmed(*number, 4),
            Dimension::List(numbers) => list(numbers),
        };
        format!(", {name} = {value}")
    });
    given + changed.collect::<String>().as_str()
}

pub(super) fn hidden_classes(facts: &[CaseFacts<'_>], band: Band) -> Vec<HiddenClass> {
    let mut classes: Vec<HiddenClass> = Vec::new();
    for facts in facts {
        let Some(class) = &facts.case.hidden_class else {
            continue;
        };
        let good = u32::from(is_good(facts, band));
        match classes.iter_mut().find(|known| known.class == *class) {
            Some(known) => {
                known.good += good;
                known.total += 1;
            }
            None => classes.push(HiddenClass {
                class: class.clone(),
                good,
                total: 1,
                under_resolved: 0,
            }),
        }
    }
    classes
}

pub(super) fn is_good(facts: &CaseFacts<'_>, band: Band) -> bool {
    match &facts.error {
        CaseError::Position(error_m) => *error_m <= band.full,
        CaseError::Reach { branches_m, .. } => branches_m
            .first()
            .is_some_and(|error_m| *error_m <= band.full),
        CaseError::Unreachable { said_so } => *said_so,
        CaseError::Jacobian { relative, .. } => *relative <= band.full,
        CaseError::Entries(relative) => relative.iter().all(|relative| *relative <= band.full),
    }
}

/// Entries as people read them: `kp = 100, inertia = 0.1668`.
pub(super) fn entries(entries: &[(String, Dimension)]) -> String {
    named(
        entries
            .iter()
            .map(|(name, value)| (name.as_str(), as_slice(value))),
    )
}

fn named<'e>(entries: impl Iterator<Item = (&'e str, &'e [f64])>) -> String {
    let texts: Vec<String> = entries
        .map(|(name, numbers)| match name {
            "" => written(numbers, 6),
            name => format!("{name} = {}", written(numbers, 6)),
        })
        .collect();
    texts.join(", ")
}
