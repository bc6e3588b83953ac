//! Hidden runs of motion tasks: a lab of its own each, with drawn numbers.

use kinemark_sim::text::{Dimension, Spanned};

use super::{Ends, HiddenRun, all_rising, known_task, named};
use crate::lab::Lab;
use crate::lab::TaskWork;
use crate::lab::draw::parameters;
use crate::lab::file::{HiddenRunsTable, Ranges, RangesTable};
use crate::task::problem::{LabError, near, problems};
use crate::task::reporter::Reporter;

problems! {
    /// What is wrong with hidden runs.
    enum RunsProblem {
        Numbers { error: String }:
            "staff::runs", "{error}", "these runs", "change the ranges of `parameters`";
        NoMotionTask { task: String }:
            "staff::runs", "task `{task}` is not a motion task", "this task", "hidden cases of function tasks are [[draws]]";
        Count { count: u32 }:
            "staff::runs", "there are 1 to {MOST_RUNS} hidden runs of a class, got {count}", "this count", "change `count`";
        SameNumbers:
            "staff::runs", "a hidden run without other numbers is the visible run again", "nothing is drawn",
            "give parameters, such as { can_y = [0.95, 1.05] }";
        UnknownParameter { lab: String, name: String, known: Vec<String> }:
            "staff::runs", "lab `{lab}` has no parameter `{name}`", "not a parameter of this lab", near(name, "parameters", known);
        Shape { name: String }:
            "staff::runs", "the ranges or choices of `{name}` do not fit its shape", "another shape",
            "give [low, high] for one number, a list of such ranges for a list, or { choices = [...] } for anything";
    }
}

/// What one `[[runs]]` table asks for, each run a lab of its own.
#[derive(Debug, Clone)]
pub(super) struct RunsOfTable {
    /// Those that are graded.
    pub(super) runs: Vec<HiddenRun>,
    /// What would be graded at the ends of the ranges, where these are tried; numbered from zero.
    pub(super) ends: Vec<HiddenRun>,
}

/// The runs of one `[[runs]]` table.
pub(super) fn hidden_runs(
    report: Reporter<'_>,
    lab: &Lab,
    (salt, ends): (&str, Ends),
    spanned: &Spanned<HiddenRunsTable>,
) -> Result<RunsOfTable, LabError> {
    let table = spanned.get_ref();
    is_of_a_motion(report, lab, spanned)?;
    let ranges = fitting_ranges(report, lab, spanned)?;
    let with = |parameters: Vec<(String, Dimension)>| {
        lab.with_parameters(&parameters).or_else(|error| {
            let error = error.to_string();
            report.refuse_at(spanned, RunsProblem::Numbers { error })
        })
    };
    let class = table.class.get_ref();
    let run = |number: u32, drawn: Vec<(String, Dimension)>| -> Result<HiddenRun, LabError> {
        Ok(HiddenRun {
            class: class.clone(),
            number,
            lab: with(drawn.clone())?,
            drawn,
        })
    };
    // what can be loaded at both ends can be loaded between: expressions are monotone in practice
    let at_end = |&end: &usize| {
        let all = ranges.iter();
        let numbers = all.map(|(name, ranges)| (name.get_ref().clone(), ranges.get_ref().end(end)));
        run(0, numbers.collect())
    };
    let drawn = |number: u32| {
        let drawn = parameters(salt, table.task.get_ref(), class, number, ranges);
        run(number + 1, drawn)
    };
    Ok(RunsOfTable {
        ends: ends.to_try().iter().map(at_end).collect::<Result<_, _>>()?,
        runs: (0..*table.count.get_ref())
            .map(drawn)
            .collect::<Result<_, _>>()?,
    })
}

/// Refuses a task that is not a motion task, and a count beyond what a class can wait for.
fn is_of_a_motion(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<HiddenRunsTable>,
) -> Result<(), LabError> {
    let table = spanned.get_ref();
    let TaskWork::Motion(..) = known_task(report, lab, &table.task)? else {
        let task = table.task.get_ref().clone();
        return report.refuse_at(&table.task, RunsProblem::NoMotionTask { task });
    };
    let count = *table.count.get_ref();
    if count == 0 || count > MOST_RUNS {
        return report.refuse_at(&table.count, RunsProblem::Count { count });
    }
    Ok(())
}

/// The ranges of parameters, which fit those of the lab.
fn fitting_ranges<'t>(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &'t Spanned<HiddenRunsTable>,
) -> Result<&'t RangesTable, LabError> {
    let table = spanned.get_ref();
    named(report, &table.class)?;
    let ranges = table.parameters.get_ref();
    if ranges.is_empty() {
        return report.refuse_at(&table.parameters, RunsProblem::SameNumbers);
    }
    all_rising(report, ranges)?;
    for (name, ranges) in ranges {
        let fits = match (lab.parameters.get(name.get_ref()), ranges.get_ref()) {
            (Some(Dimension::Number(_)), Ranges::One(_)) => true,
            (Some(Dimension::List(base)), Ranges::Each(each)) => base.len() == each.len(),
            (Some(base), Ranges::Choices(choices)) => choices
                .iter()
                .all(|one| one.to_string() == base.to_string()),
            (Some(_), _) => false,
            (None, _) => {
                let problem = RunsProblem::UnknownParameter {
                    lab: lab.name.clone(),
                    name: name.get_ref().clone(),
                    known: lab.parameters.names().map(str::to_owned).collect(),
                };
                return report.refuse_at(name, problem);
            }
        };
        if !fits {
            let name = name.get_ref().clone();
            return report.refuse_at(ranges, RunsProblem::Shape { name });
        }
    }
    Ok(ranges)
}

/// A run costs about as much as the visible one; a class of students is to be graded in minutes.
const MOST_RUNS: u32 = 20;
