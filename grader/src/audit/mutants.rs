//! Mutants: each runs to its end, loses points, shows in enough cases, and is named, in each of its tasks.

use super::form::{Form, Found};
use super::reference::stop_problem;
use super::row::{Problem, Row, Tried};
use super::unnamed::why_unnamed;
use crate::judge::Examined;
use crate::judge::diagnose::Ruling;
use crate::lab::staff::Mutant;
use crate::lab::{Lab, Staff};
use crate::record::grade::{Grade, HiddenClass, TaskGrade};
use crate::record::quantity::with_unit;
use crate::record::verdict::Verdict;

/// The share of a function task's cases in which a mutant must give a wrong answer.
pub const LEAST_SHARE: f64 = 0.3;
/// Checks whose values are listed, where a mutant loses in none.
const MOST_VALUES: usize = 4;

impl Form<'_> {
    /// Tries mutant `index` in its own tasks.
    pub fn mutant(&self, index: usize) -> Found {
        let Some(mutant) = self.staff.mutants.get(index) else {
            return Found::default();
        };
        // run only the tasks of the mutant
        let mut part = self.lab.clone();
        part.tasks.retain(|task| mutant.tasks.contains(&task.name));
        let Some(Examined { graded, rulings }) = self.examined_in(&part, &mutant.source) else {
            return Found::default();
        };
        let grade = graded.grade;
        let rows = grade.tasks.iter().zip(&rulings).map(|(task, rulings)| {
            let earned = Some((task.points, task.max_points));
            let of = OfMutant {
                lab: self.lab,
                staff: self.staff,
                grade: &grade,
                task,
                rulings: rulings.as_deref(),
                mutant,
            };
            let tried = (Tried::Mutant, &mutant.name[..]);
            Row::new(tried, Some(&task.name), earned, of.problem())
        });
        Found {
            rows: rows.collect(),
            grade: Some(grade),
        }
    }
}

/// A mutant in one of its tasks.
pub(super) struct OfMutant<'a> {
    pub(super) lab: &'a Lab,
    pub(super) staff: &'a Staff,
    /// Its grade in all of its tasks.
    pub(super) grade: &'a Grade,
    pub(super) task: &'a TaskGrade,
    /// What its comparison with each mutant came to, itself among them; `None` where it was not compared.
    pub(super) rulings: Option<&'a [Ruling]>,
    pub(super) mutant: &'a Mutant,
}

impl OfMutant<'_> {
    fn problem(&self) -> Option<Problem> {
        let task = self.task;
        if task.verdict == Verdict::Passed {
            let what = format!("loses no point{}", values(task));
            return Some((what, "narrow the band, or add cases in which it shows").into());
        }
        if !matches!(task.verdict, Verdict::Missed | Verdict::InvalidOutput) {
            let help = "a mutant runs to its end, and is wrong";
            let source = &self.mutant.source;
            return Some(stop_problem(self.lab, self.staff, task, source, help));
        }
        if !self.mutant.is_named {
            return None;
        }
        self.shows_in_few_cases().or_else(|| self.not_named())
    }

    /// What is wrong where it shows in too few cases.
    fn shows_in_few_cases(&self) -> Option<Problem> {
        let task = self.task;
        let hidden = |of: fn(&HiddenClass) -> u32| -> usize {
            task.hidden.iter().map(|class| of(class) as usize).sum()
        };
        let total = task.cases.len() + hidden(|class| class.total);
        let good = task.cases.iter().filter(|case| case.good).count() + hidden(|class| class.good);
        let wrong = total - good;
        if total == 0 || wrong as f64 >= LEAST_SHARE * total as f64 {
            return None;
        }
        let visible = task.cases.iter().filter(|case| !case.good);
        let visible = visible.map(|case| format!("\"{}\"", case.name));
        let classes = task.hidden.iter().filter(|class| class.good < class.total);
        let classes = classes.map(|class| {
            let (wrong, total) = (class.total - class.good, class.total);
            format!("{wrong} of {total} hidden ones of \"{}\"", class.class)
        });
        let places: Vec<String> = visible.chain(classes).collect();
        let places = match places.is_empty() {
            true => String::new(),
            false => format!(": {}", places.join(", ")),
        };
        let needed = (LEAST_SHARE * total as f64).ceil();
        // a motion task has hidden runs beside its visible one
        let (cases, help) = match task.cases.is_empty() {
            true => (
                "hidden runs",
                "let it show in the visible run, which is what a diagnosis looks at, or say `named = false`: then it only has to lose points",
            ),
            false => (
                "cases",
                "add cases in which it shows, or leave the task out of it",
            ),
        };
        let what =
            format!("shows in {wrong} of {total} {cases} only, and {needed} are needed{places}");
        Some((what, help).into())
    }

    /// What is wrong where it is not named, with the rule that failed.
    fn not_named(&self) -> Option<Problem> {
        let (why, help) = match self.task.diagnoses.as_slice() {
            [found] if found.mistake == self.mutant.name => return None,
            [other, ..] => {
                let what = format!(
                    "is diagnosed as `{}`, with which it agrees in {} of {} places where that shows",
                    other.mistake, other.agreeing, other.telling
                );
                match why_unnamed(self) {
                    // it agrees with itself, and with the other in more places
                    None => (
                        what,
                        "two mistakes with the same results are one: leave one out".to_owned(),
                    ),
                    Some((why, help)) => (format!("{what}; itself it is not named: {why}"), help),
                }
            }
            [] => {
                let (why, help) = why_unnamed(self).unwrap_or_default();
                (format!("is not named: {why}"), help)
            }
        };
        Some((why, help).into())
    }
}

/// What was measured, with what earns all points, in words.
fn values(task: &TaskGrade) -> String {
    let measures = task.checks.iter().filter_map(|check| {
        let measure = check.measure.as_ref()?;
        let value = with_unit(measure.value?, &measure.unit);
        let full = with_unit(measure.full, &measure.unit);
        let least = measure.full > measure.zero;
        let words = if least { "from" } else { "up to" };
        Some(format!(
            "{} {value} (all points {words} {full})",
            check.title
        ))
    });
    let measures: Vec<String> = measures.take(MOST_VALUES).collect();
    match measures.is_empty() {
        true => String::new(),
        false => format!(": {}", measures.join("; ")),
    }
}
