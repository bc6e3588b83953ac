//! Hidden cases that are drawn: their table held against the lab.

use kinemark_sim::format::RobotError;
use kinemark_sim::text::Dimension;
use toml::Spanned;

use super::{Ends, all_rising, known_task, named, rising};
use crate::lab::Lab;
use crate::lab::TaskWork;
use crate::lab::draw::{Draw, Drawn};
use crate::lab::file::{DrawTable, Ranges};
use crate::task::model::{Case, Function, FunctionTask, Given};
use crate::task::problem::{LabError, near, problems};
use crate::task::reporter::Reporter;

/// A `[[draws]]` table as a draw that fits its lab.
pub(super) fn checked(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<DrawTable>,
    ends: Ends,
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
        count: *table.count.get_ref(),
        what,
        dimensions: reader.dimensions(ends)?,
    })
}

/// The cases of a draw, or why its numbers make no robot.
pub(super) fn drawn(
    report: Reporter<'_>,
    spanned: &Spanned<DrawTable>,
    cases: Result<Vec<Case>, RobotError>,
) -> Result<Vec<Case>, LabError> {
    cases.or_else(|error| {
        let error = error.to_string();
        report.refuse_at(spanned, DrawProblem::Dimensions { error })
    })
}

struct DrawReader<'a> {
    report: Reporter<'a>,
    lab: &'a Lab,
    spanned: &'a Spanned<DrawTable>,
    table: &'a DrawTable,
}

problems! {
    /// What is wrong with a draw.
    enum DrawProblem {
        NoFunctionTask { task: String }:
            "staff::draw", "task `{task}` is not a function task", "this task", "hidden cases are drawn for function tasks";
        Count { count: u32 }:
            "staff::draw", "a draw has 1 to 1000 cases, got {count}", "this count", "change `count`";
        JointCount { found: String, joints: String }:
            "staff::draw", "`q_rad` has {found} for {joints}", "these ranges",
            "give one [low, high] per joint that moves";
        NotByGiven { function: String }:
            "staff::draw", "a draw for `{function}` is of `given`", "this draw",
            "a function of the lab's own is drawn by `given`, and nothing else is";
        ByGiven { function: String }:
            "staff::draw", "a draw for `{function}` has no `given`", "this draw",
            "a function of the lab's own is drawn by `given`, and nothing else is";
        NoBranches:
            "staff::draw", "a draw of positions must say how many `branches` reach them", "this draw",
            "write `branches = 0` for positions out of reach";
        NotOneQuantity:
            "staff::draw", "a draw is of `q_rad`, or for `inverse_kinematics` of `position_m`", "this draw", "give one of the two";
        OtherNames { drawn: String, given: String }:
            "staff::draw", "this draw gives {drawn}, the visible cases give {given}", "this draw", "give the same names";
        UnknownDimension { name: String, known: Vec<String> }:
            "staff::draw", "no dimension `{name}` in this robot", "not a dimension of this robot", near(name, "dimensions", known);
        Dimensions { error: String }:
            "staff::draw", "{error}", "this draw", "change the ranges of `dimensions`";
    }
}

impl<'a> DrawReader<'a> {
    fn refuse<T>(&self, problem: DrawProblem) -> Result<T, LabError> {
        self.report.refuse_at(self.spanned, problem)
    }

    /// The function task it is for; its count is within what a task may have.
    fn task(&self) -> Result<&'a FunctionTask, LabError> {
        let TaskWork::Function(task, _) = known_task(self.report, self.lab, &self.table.task)?
        else {
            let task = self.table.task.get_ref().clone();
            let problem = DrawProblem::NoFunctionTask { task };
            return self.report.refuse_at(&self.table.task, problem);
        };
        let count = *self.table.count.get_ref();
        if count == 0 || count > 1000 {
            let problem = DrawProblem::Count { count };
            return self.report.refuse_at(&self.table.count, problem);
        }
        Ok(task)
    }

    /// Refuses a class without a name, and a range that goes down.
    fn ranges_rise(&self) -> Result<(), LabError> {
        let (report, table) = (self.report, self.table);
        named(report, &table.class)?;
        all_rising(report, &table.dimensions)?;
        if let Some(given) = &table.given {
            all_rising(report, given)?;
        }
        if let Some(at) = &table.position_m {
            rising(report, "position_m", at, at.get_ref())?;
        }
        if let Some(at) = &table.q_rad {
            rising(report, "q_rad", at, at.get_ref())?;
        }
        Ok(())
    }

    /// The ranges of joint positions, one per joint.
    fn q_ranges(&self) -> Result<Option<Vec<[f64; 2]>>, LabError> {
        let joints = self.lab.robot.n();
        let Some(typed) = &self.table.q_rad else {
            return Ok(None);
        };
        let ranges = typed.get_ref();
        if ranges.len() != joints {
            let counted = |n: usize, what: &str| match n {
                1 => format!("1 {what}"),
                _ => format!("{n} {what}s"),
            };
            let problem = DrawProblem::JointCount {
                found: counted(ranges.len(), "range"),
                joints: counted(joints, "joint"),
            };
            return self.report.refuse_at(typed, problem);
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
            let function = task.function.name().to_owned();
            return self.refuse(match free {
                true => DrawProblem::NotByGiven { function },
                false => DrawProblem::ByGiven { function },
            });
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
                None => self.refuse(DrawProblem::NoBranches),
            },
            _ => self.refuse(DrawProblem::NotOneQuantity),
        }
    }

    /// The entries of `given`, of the same names as those of the visible cases.
    fn values(&self, task: &FunctionTask) -> Result<Drawn, LabError> {
        let ranges = self.table.given.iter().flatten();
        let ranges: Vec<(String, Ranges)> = ranges
            .map(|(name, ranges)| (name.get_ref().clone(), ranges.get_ref().clone()))
            .collect();
        let drawn: Vec<&str> = ranges.iter().map(|(name, _)| name.as_str()).collect();
        let of_cases: Vec<&str> = match task.cases.first().map(|case| &case.given) {
            Some(Given::Values { given, .. }) => {
                given.iter().map(|(name, _)| name.as_str()).collect()
            }
            _ => Vec::new(),
        };
        if drawn != of_cases {
            let (drawn, given) = (drawn.join(", "), of_cases.join(", "));
            return self.refuse(DrawProblem::OtherNames { drawn, given });
        }
        Ok(Drawn::Values(ranges))
    }

    /// The ranges of dimensions, with which a robot can be built.
    fn dimensions(&self, ends: Ends) -> Result<Vec<(String, Ranges)>, LabError> {
        let stated = self.lab.robot_file.dimensions();
        let mut names = self.table.dimensions.keys();
        if let Some(at) = names.find(|name| stated.get(name.get_ref()).is_none()) {
            let problem = DrawProblem::UnknownDimension {
                name: at.get_ref().clone(),
                known: stated.names().map(str::to_owned).collect(),
            };
            return self.report.refuse_at(at, problem);
        }
        let dimensions = self.table.dimensions.iter();
        let dimensions: Vec<(String, Ranges)> = dimensions
            .map(|(name, ranges)| (name.get_ref().clone(), ranges.get_ref().clone()))
            .collect();
        // what can be built at the low ends can be built between: expressions are monotone in practice, and both ends are tried
        for &end in ends.to_try() {
            let changed: Vec<(String, Dimension)> = dimensions
                .iter()
                .map(|(name, ranges)| (name.clone(), ranges.end(end)))
                .collect();
            if let Err(error) = self.lab.robot_file.build(&changed) {
                let error = error.to_string();
                // what has another shape is wrong at its own place; which of several numbers is too much, nobody can say
                let misfit = self.table.dimensions.iter().find(|(name, ranges)| {
                    let base = stated.get(name.get_ref()).map(ToString::to_string);
                    base != Some(ranges.get_ref().end(end).to_string())
                });
                let at = misfit.map_or(self.spanned.span(), |(_, ranges)| ranges.span());
                return self.report.refuse(at, DrawProblem::Dimensions { error });
            }
        }
        Ok(dimensions)
    }
}
