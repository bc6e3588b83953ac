//! Hidden cases that are drawn: their table held against the lab, and what the solution answers to those of a free function.

use kinemark_sim::robot::Dimension;
use kinemark_sim::source::Source;
use toml::Spanned;

use super::{all_rising, known_task, named, rising};
use crate::lab::draw::{Draw, Drawn};
use crate::lab::file::{DrawTable, Ranges};
use crate::lab::load::Reporter;
use crate::lab::model::{Case, Function, FunctionTask, Given, Lab, TaskWork};
use crate::lab::problem::LabError;

/// Lets the solution answer the cases of a free function: what it says is what is expected, entry by entry as in visible cases.
pub(super) fn expect(
    lab: &Lab,
    task: &str,
    cases: &mut [Case],
    solution: &Source,
) -> Result<(), String> {
    let mut tasks = lab.tasks.iter();
    let Some(task) = tasks.find(|known| known.name == task) else {
        return Ok(());
    };
    let TaskWork::Function(FunctionTask {
        function: function @ Function::Free(_),
        cases: visible,
        ..
    }) = &task.work
    else {
        return Ok(());
    };
    let Some(Given::Values {
        expected: names, ..
    }) = visible.first().map(|case| &case.given)
    else {
        return Ok(());
    };
    let answers = crate::judge::answers(lab, task, function, cases, solution)?;
    for (case, answer) in cases.iter_mut().zip(answers) {
        if let Given::Values { expected, .. } = &mut case.given {
            *expected = crate::submission::answer::named_entries(&answer, names)
                .map_err(|what| format!("`{}` of the solution returned {what}", function.name()))?;
        }
    }
    Ok(())
}

pub(super) fn checked(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<DrawTable>,
) -> Result<Draw, LabError> {
    let table = spanned.get_ref();
    let refuse = |message: String, help: &str| {
        report.err(
            spanned.span(),
            "staff::draw",
            message,
            "this draw",
            Some(help.to_owned()),
        )
    };
    let TaskWork::Function(task) = known_task(report, lab, &table.task)? else {
        return refuse(
            format!("task `{}` is no function task", table.task.get_ref()),
            "hidden cases are drawn for function tasks",
        );
    };
    if table.count == 0 || table.count > 1000 {
        return refuse(
            format!("a draw has 1 to 1000 cases, got {}", table.count),
            "change `count`",
        );
    }
    let code = "staff::draw";
    named(report, code, &table.class)?;
    all_rising(report, code, &table.dimensions)?;
    if let Some(given) = &table.given {
        all_rising(report, code, given)?;
    }
    if let Some(at) = &table.position_m {
        rising(report, code, at.span(), "position_m", at.get_ref())?;
    }
    if let Some(at) = &table.q_rad {
        rising(report, code, at.span(), "q_rad", at.get_ref())?;
    }
    let joints = lab.robot.n();
    let q_ranges = match &table.q_rad {
        Some(ranges) if ranges.get_ref().len() != joints => {
            return refuse(
                format!(
                    "`q_rad` has {} ranges for {joints} joints",
                    ranges.get_ref().len()
                ),
                "give one [low, high] per joint that moves",
            );
        }
        Some(ranges) => Some(ranges.get_ref().clone()),
        None => None,
    };
    let free = matches!(task.function, Function::Free(_));
    if free != table.given.is_some() || (free && !table.dimensions.is_empty()) {
        return refuse(
            format!(
                "a draw for `{}` {} `given`",
                task.function.name(),
                if free { "is of" } else { "has no" }
            ),
            "a function of the lab's own is drawn by `given`, and nothing else is",
        );
    }
    let position_m = table.position_m.as_ref().map(|at| *at.get_ref());
    let what = match (&task.function, q_ranges, position_m) {
        (Function::Free(_), None, None) => {
            let ranges: Vec<(String, Ranges)> = table
                .given
                .iter()
                .flatten()
                .map(|(name, ranges)| (name.clone(), ranges.get_ref().clone()))
                .collect();
            let drawn: Vec<&str> = ranges.iter().map(|(name, _)| name.as_str()).collect();
            let of_cases: Vec<&str> = match task.cases.first().map(|case| &case.given) {
                Some(Given::Values { given, .. }) => {
                    given.iter().map(|(name, _)| name.as_str()).collect()
                }
                _ => Vec::new(),
            };
            if drawn != of_cases {
                return refuse(
                    format!(
                        "this draw gives {}, the visible cases give {}",
                        drawn.join(", "),
                        of_cases.join(", ")
                    ),
                    "give the same names",
                );
            }
            Drawn::Values(ranges)
        }
        (Function::ForwardKinematics | Function::Jacobian(_), Some(q), None) => Drawn::Q(q),
        (Function::InverseKinematics, Some(q), None) => {
            Drawn::PositionOf(q, table.branches.unwrap_or(2))
        }
        (Function::InverseKinematics, None, Some(position)) => match table.branches {
            Some(branches) => Drawn::Position(position, branches),
            None => {
                return refuse(
                    "a draw of positions must say how many `branches` reach them".to_owned(),
                    "write `branches = 0` for positions out of reach",
                );
            }
        },
        _ => {
            return refuse(
                "a draw is of `q_rad`, or for `inverse_kinematics` of `position_m`".to_owned(),
                "give one of the two",
            );
        }
    };
    let dimensions: Vec<(String, Ranges)> = table
        .dimensions
        .iter()
        .map(|(name, ranges)| (name.clone(), ranges.get_ref().clone()))
        .collect();
    // what can be built at the low ends can be built between: expressions are monotone in practice, and both ends are tried
    for end in [0, 1] {
        let changed: Vec<(String, Dimension)> = dimensions
            .iter()
            .map(|(name, ranges)| (name.clone(), ranges.end(end)))
            .collect();
        if let Err(error) = lab.robot_file.build(&changed) {
            return refuse(error.to_string(), "change the ranges of `dimensions`");
        }
    }
    Ok(Draw {
        task: table.task.get_ref().clone(),
        class: table.class.get_ref().clone(),
        count: table.count,
        what,
        dimensions,
    })
}
