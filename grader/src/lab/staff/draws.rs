//! Hidden cases that are drawn: their table held against the lab.

use kinemark_sim::text::Dimension;
use toml::Spanned;

use super::{all_rising, known_task, named, rising};
use crate::lab::draw::{Draw, Drawn};
use crate::lab::file::{DrawTable, Ranges};
use crate::lab::load::Reporter;
use crate::lab::model::Lab;
use crate::lab::model::TaskWork;
use crate::task::model::{Function, FunctionTask, Given};
use crate::task::problem::LabError;

/// A `[[draws]]` table as a draw that fits its lab.
pub(super) fn checked(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<DrawTable>,
) -> Result<Draw, LabError> {
    let table = spanned.get_ref();
    let reader = DrawReader {
        report,
        lab,
        spanned,
        table,
    };
    let task = reader.task()?;
    reader.ranges_rise()?;
    let q_ranges = reader.q_ranges()?;
    let what = reader.what(task, q_ranges)?;
    Ok(Draw {
        task: table.task.get_ref().clone(),
        class: table.class.get_ref().clone(),
        count: table.count,
        what,
        dimensions: reader.dimensions()?,
    })
}

struct DrawReader<'a> {
    report: Reporter<'a>,
    lab: &'a Lab,
    spanned: &'a Spanned<DrawTable>,
    table: &'a DrawTable,
}

const CODE: &str = "staff::draw";

impl<'a> DrawReader<'a> {
    fn refuse<T>(&self, message: String, help: &str) -> Result<T, LabError> {
        let help = Some(help.to_owned());
        let at = self.spanned.span();
        self.report.err(at, CODE, message, "this draw", help)
    }

    /// The function task it is for; its count is within what a task may have.
    fn task(&self) -> Result<&'a FunctionTask, LabError> {
        let TaskWork::Function(task, _) = known_task(self.report, self.lab, &self.table.task)?
        else {
            return self.refuse(
                format!("task `{}` is no function task", self.table.task.get_ref()),
                "hidden cases are drawn for function tasks",
            );
        };
        let count = self.table.count;
        if count == 0 || count > 1000 {
            return self.refuse(
                format!("a draw has 1 to 1000 cases, got {count}"),
                "change `count`",
            );
        }
        Ok(task)
    }

    /// Refuses a class without a name, and a range that goes down.
    fn ranges_rise(&self) -> Result<(), LabError> {
        let (report, table) = (self.report, self.table);
        named(report, CODE, &table.class)?;
        all_rising(report, CODE, &table.dimensions)?;
        if let Some(given) = &table.given {
            all_rising(report, CODE, given)?;
        }
        if let Some(at) = &table.position_m {
            rising(report, CODE, at.span(), "position_m", at.get_ref())?;
        }
        if let Some(at) = &table.q_rad {
            rising(report, CODE, at.span(), "q_rad", at.get_ref())?;
        }
        Ok(())
    }

    /// The ranges of joint positions, one per joint.
    fn q_ranges(&self) -> Result<Option<Vec<[f64; 2]>>, LabError> {
        let joints = self.lab.robot.n();
        let Some(ranges) = self.table.q_rad.as_ref().map(Spanned::get_ref) else {
            return Ok(None);
        };
        if ranges.len() != joints {
            return self.refuse(
                format!("`q_rad` has {} ranges for {joints} joints", ranges.len()),
                "give one [low, high] per joint that moves",
            );
        }
        Ok(Some(ranges.clone()))
    }

    /// What is drawn, which fits what the function is given.
    fn what(
        &self,
        task: &FunctionTask,
        q_ranges: Option<Vec<[f64; 2]>>,
    ) -> Result<Drawn, LabError> {
        let table = self.table;
        let free = matches!(task.function, Function::Free(_));
        if free != table.given.is_some() || (free && !table.dimensions.is_empty()) {
            return self.refuse(
                format!(
                    "a draw for `{}` {} `given`",
                    task.function.name(),
                    if free { "is of" } else { "has no" }
                ),
                "a function of the lab's own is drawn by `given`, and nothing else is",
            );
        }
        let position_m = table.position_m.as_ref().map(|at| *at.get_ref());
        match (&task.function, q_ranges, position_m) {
            (Function::Free(_), None, None) => self.values(task),
            (Function::ForwardKinematics | Function::Jacobian(_), Some(q), None) => Ok(Drawn::Q(q)),
            (Function::InverseKinematics, Some(q), None) => {
                Ok(Drawn::PositionOf(q, table.branches.unwrap_or(2)))
            }
            (Function::InverseKinematics, None, Some(position)) => match table.branches {
                Some(branches) => Ok(Drawn::Position(position, branches)),
                None => self.refuse(
                    "a draw of positions must say how many `branches` reach them".to_owned(),
                    "write `branches = 0` for positions out of reach",
                ),
            },
            _ => self.refuse(
                "a draw is of `q_rad`, or for `inverse_kinematics` of `position_m`".to_owned(),
                "give one of the two",
            ),
        }
    }

    /// The entries of `given`, of the same names as those of the visible cases.
    fn values(&self, task: &FunctionTask) -> Result<Drawn, LabError> {
        let ranges = self.table.given.iter().flatten();
        let ranges: Vec<(String, Ranges)> = ranges
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
            return self.refuse(
                format!(
                    "this draw gives {}, the visible cases give {}",
                    drawn.join(", "),
                    of_cases.join(", ")
                ),
                "give the same names",
            );
        }
        Ok(Drawn::Values(ranges))
    }

    /// The ranges of dimensions, with which a robot can be built.
    fn dimensions(&self) -> Result<Vec<(String, Ranges)>, LabError> {
        let dimensions = self.table.dimensions.iter();
        let dimensions: Vec<(String, Ranges)> = dimensions
            .map(|(name, ranges)| (name.clone(), ranges.get_ref().clone()))
            .collect();
        // what can be built at the low ends can be built between: expressions are monotone in practice, and both ends are tried
        for end in [0, 1] {
            let changed: Vec<(String, Dimension)> = dimensions
                .iter()
                .map(|(name, ranges)| (name.clone(), ranges.end(end)))
                .collect();
            if let Err(error) = self.lab.robot_file.build(&changed) {
                return self.refuse(error.to_string(), "change the ranges of `dimensions`");
            }
        }
        Ok(dimensions)
    }
}
