//! Hidden runs of motion tasks: a lab of its own each, with drawn numbers.

use kinemark_sim::text::Dimension;
use kinemark_sim::text::suggest;
use toml::Spanned;

use super::{HiddenRun, all_rising, known_task, named};
use crate::lab::draw::parameters;
use crate::lab::file::{HiddenRunsTable, Ranges, RangesTable};
use crate::lab::load::Reporter;
use crate::lab::model::Lab;
use crate::lab::model::TaskWork;
use crate::task::problem::LabError;

/// The runs of one `[[runs]]` table, each a lab of its own.
pub(super) fn hidden_runs(
    report: Reporter<'_>,
    lab: &Lab,
    salt: &str,
    spanned: &Spanned<HiddenRunsTable>,
) -> Result<Vec<HiddenRun>, LabError> {
    let table = spanned.get_ref();
    is_of_goals(report, lab, spanned)?;
    let ranges = fitting_ranges(report, lab, spanned)?;
    let with = |parameters: Vec<(String, Dimension)>| {
        lab.with_parameters(&parameters).or_else(|error| {
            report.err(
                spanned.span(),
                "staff::runs",
                error.to_string(),
                "these runs",
                Some("change the ranges of `parameters`".to_owned()),
            )
        })
    };
    // what can be loaded at both ends can be loaded between: expressions are monotone in practice
    for end in [0, 1] {
        let all = ranges.iter();
        with(
            all.map(|(name, ranges)| (name.clone(), ranges.get_ref().end(end)))
                .collect(),
        )?;
    }
    let class = table.class.get_ref();
    (0..table.count)
        .map(|number| {
            let drawn = parameters(salt, table.task.get_ref(), class, number, ranges);
            Ok(HiddenRun {
                class: class.clone(),
                lab: with(drawn)?,
            })
        })
        .collect()
}

/// Refuses a task that is no motion task, or is judged by one path; and a count beyond what a class can wait for.
fn is_of_goals(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<HiddenRunsTable>,
) -> Result<(), LabError> {
    let table = spanned.get_ref();
    let refuse = |message: String, help: &str| {
        let help = Some(help.to_owned());
        report.err(spanned.span(), "staff::runs", message, "these runs", help)
    };
    let TaskWork::Motion(..) = known_task(report, lab, &table.task)? else {
        return refuse(
            format!("task `{}` is no motion task", table.task.get_ref()),
            "hidden cases of function tasks are [[draws]]",
        );
    };
    if table.count == 0 || table.count > MOST_RUNS {
        return refuse(
            format!(
                "there are 1 to {MOST_RUNS} hidden runs of a class, got {}",
                table.count
            ),
            "change `count`",
        );
    }
    let task = lab
        .tasks
        .iter()
        .find(|task| task.name == *table.task.get_ref());
    let mut checks = task.into_iter().flat_map(|task| task.checks());
    if let Some(check) = checks.find(|check| check.kind.follows_one_path()) {
        return refuse(
            format!(
                "check `{}` compares with one path, and every run has its own",
                check.name
            ),
            "judge the task by goals or a path of its own instead",
        );
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
    let refuse = |message: String, help: &str| {
        let help = Some(help.to_owned());
        report.err(spanned.span(), "staff::runs", message, "these runs", help)
    };
    named(report, "staff::runs", &table.class)?;
    let ranges = table.parameters.get_ref();
    if ranges.is_empty() {
        return report.err(
            table.parameters.span(),
            "staff::runs",
            "a hidden run without other numbers is the visible run again".to_owned(),
            "nothing is drawn",
            Some("give parameters, such as { can_y = [0.95, 1.05] }".to_owned()),
        );
    }
    all_rising(report, "staff::runs", ranges)?;
    for (name, ranges) in ranges {
        let fits = match (lab.parameters.get(name), ranges.get_ref()) {
            (Some(Dimension::Number(_)), Ranges::One(_)) => true,
            (Some(Dimension::List(base)), Ranges::Each(each)) => base.len() == each.len(),
            (Some(Dimension::List(_) | Dimension::Number(_)), _) => false,
            (None, _) => {
                return refuse(
                    format!("lab `{}` has no parameter `{name}`", lab.name),
                    &suggest(name, "parameters", lab.parameters.names()),
                );
            }
        };
        if !fits {
            return refuse(
                format!("the ranges of `{name}` do not fit its shape"),
                "give [low, high] for one number, and a list of such ranges for a list",
            );
        }
    }
    Ok(ranges)
}

/// A run costs about as much as the visible one; a class of students is to be graded in minutes.
const MOST_RUNS: u32 = 20;
