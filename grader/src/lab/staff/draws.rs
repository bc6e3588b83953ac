//! Hidden cases that are drawn: their table held against the lab.

use std::borrow::Cow;

use kinemark_sim::format::RobotError;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::{Dimension, Spanned};

use super::{Ends, all_rising, known_task, named, rising};
use crate::lab::Lab;
use crate::lab::TaskWork;
use crate::lab::case_robot;
use crate::lab::draw::{Draw, Drawn};
use crate::lab::file::{DrawTable, Ranges};
use crate::task::model::{Case, Function, FunctionTask, Given};
use crate::task::problem::{LabError, near, problems};
use crate::task::reporter::Reporter;
use crate::task::task_joints::TaskJoints;

/// A `[[draws]]` table as a draw that fits its lab.
pub(super) fn checked(
    report: Reporter<'_>,
    lab: &Lab,
    spanned: &Spanned<DrawTable>,
    ends: Ends,
) -> Result<Draw, LabError> {
    let table = spanned.get_ref();
    let mut tasks = lab.tasks.iter();
    let found = tasks.find(|task| task.name == *table.task.get_ref());
    let reader = DrawReader {
        report,
        lab,
        seen: found.map_or(lab, |task| lab.of_task(task)),
        spanned,
        table,
    };
    let task = reader.task()?;
    reader.ranges_rise()?;
    reader.rows_fit(task)?;
    let what = reader.what(task)?;
    Ok(Draw {
        task: table.task.get_ref().clone(),
        class: table.class.get_ref().clone(),
        count: *table.count.get_ref(),
        what,
        dimensions: reader.dimensions(task, ends)?,
        rows: reader.rows().map(str::to_owned).collect(),
        about: task.about.clone(),
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

/// A range per joint, as typed.
type JointRanges = Spanned<Vec<[f64; 2]>>;

struct DrawReader<'a> {
    report: Reporter<'a>,
    lab: &'a Lab,
    /// The lab as its task sees it.
    seen: &'a Lab,
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
        JointCount { what: &'static str, found: String, joints: String }:
            "staff::draw", "`{what}` has {found} for {joints}", "these ranges",
            "give one [low, high] per joint of the task";
        Row { error: String }:
            "staff::draw", "{error}", "one of the robots of this draw",
            "write rows of joints such as \"RzTxRy\": R turns about an axis, T slides along it";
        OtherCount { joints: usize, first: usize }:
            "staff::draw", "a robot of {joints} joints in a draw whose first has {first}", "this robot",
            "put robots with another number of joints into a draw of their own";
        NotByMotion { function: String, wanted: String }:
            "staff::draw", "a draw for `{function}` is of {wanted}", "this draw", format!("give {wanted} and nothing else");
        PoseOfPosition:
            "staff::draw", "positions within reach are drawn by `q_rad`, where the task is about more than positions", "this draw",
            "write `q_rad`, or `branches = 0` for positions out of reach";
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
        NotOfMotion { function: String }:
            "staff::draw", "`{function}` is given no velocities", "this draw", "take `qd_rad_s` and `qdd_rad_s2` out";
        OtherNames { drawn: String, given: String }:
            "staff::draw", "this draw gives {drawn}, the visible cases give {given}", "this draw", "give the same names";
        Text { name: String }:
            "staff::draw", "`{name}` is given as a text", "these choices", "functions are given numbers and lists of numbers";
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
        for (what, typed) in self.state() {
            if let Some(at) = typed {
                rising(report, what, at, at.get_ref())?;
            }
        }
        Ok(())
    }

    /// The ranges of positions, velocities and accelerations, as far as they are typed.
    fn state(&self) -> [(&'static str, Option<&'a JointRanges>); 3] {
        let DrawTable {
            q_rad,
            qd_rad_s,
            qdd_rad_s2,
            ..
        } = self.table;
        [
            ("q_rad", q_rad.as_ref()),
            ("qd_rad_s", qd_rad_s.as_ref()),
            ("qdd_rad_s2", qdd_rad_s2.as_ref()),
        ]
    }

    /// The rows of joints that are robots of this draw.
    fn rows(&self) -> impl Iterator<Item = &'a str> {
        self.table.robots.iter().map(|row| row.get_ref().as_str())
    }

    /// The robot of this draw, or the first of them; with the dimensions of the lab.
    fn first_robot(&self, task: &FunctionTask) -> Result<Cow<'a, Robot>, LabError> {
        let row = self.rows().next();
        let robot = case_robot::built(&self.seen.robot_file, row, &[], &task.about);
        match robot {
            Ok(Some(robot)) => Ok(Cow::Owned(robot)),
            Ok(None) => Ok(Cow::Borrowed(&self.seen.robot)),
            Err(error) => {
                let error = error.to_string();
                self.refuse(DrawProblem::Dimensions { error })
            }
        }
    }

    /// Rows of joints that are some, all of the same number of joints.
    fn rows_fit(&self, task: &FunctionTask) -> Result<(), LabError> {
        let mut first = None;
        for typed in &self.table.robots {
            let row = Some(typed.get_ref().as_str());
            match case_robot::built(&self.seen.robot_file, row, &[], &task.about) {
                Ok(robot) => {
                    let joints = robot.as_ref().map_or(0, Robot::n);
                    let first = *first.get_or_insert(joints);
                    if joints != first {
                        let problem = DrawProblem::OtherCount { joints, first };
                        return self.report.refuse_at(typed, problem);
                    }
                }
                Err(error) => {
                    let error = error.to_string();
                    return self.report.refuse_at(typed, DrawProblem::Row { error });
                }
            }
        }
        Ok(())
    }

    /// The ranges that are typed as `what`, one per joint of the task.
    fn per_joint(
        &self,
        task: &FunctionTask,
        (what, typed): (&'static str, Option<&JointRanges>),
    ) -> Result<Option<Vec<[f64; 2]>>, LabError> {
        let Some(typed) = typed else {
            return Ok(None);
        };
        let robot = self.first_robot(task)?;
        let joints = TaskJoints::of(&robot, &task.about.ignored).count();
        let ranges = typed.get_ref();
        if ranges.len() != joints {
            let counted = |n: usize, what: &str| match n {
                1 => format!("1 {what}"),
                _ => format!("{n} {what}s"),
            };
            let problem = DrawProblem::JointCount {
                what,
                found: counted(ranges.len(), "range"),
                joints: counted(joints, "joint"),
            };
            return self.report.refuse_at(typed, problem);
        }
        Ok(Some(ranges.clone()))
    }

    /// What is drawn, which fits what the function is given.
    fn what(&self, task: &FunctionTask) -> Result<Drawn, LabError> {
        let table = self.table;
        let free = matches!(task.function, Function::Free(_));
        let is_of_robot = !table.dimensions.is_empty() || !table.robots.is_empty();
        if free != table.given.is_some() || (free && is_of_robot && !task.about.gives_robot) {
            let function = task.function.name().to_owned();
            return self.refuse(match free {
                true => DrawProblem::NotByGiven { function },
                false => DrawProblem::ByGiven { function },
            });
        }
        let position_m = table.position_m.as_ref().map(|at| *at.get_ref());
        let [q, qd, qdd] = self.state().map(|typed| self.per_joint(task, typed));
        let (q, qd, qdd) = (q?, qd?, qdd?);
        if let Function::Quantity(quantity) = &task.function {
            let state: Vec<Vec<[f64; 2]>> =
                [q, qd, qdd].into_iter().map_while(|part| part).collect();
            let typed = self
                .state()
                .iter()
                .filter(|(_, typed)| typed.is_some())
                .count();
            if state.len() == quantity.order() && typed == state.len() && position_m.is_none() {
                return Ok(Drawn::Motion(state));
            }
            let names = self.state().map(|(name, _)| format!("`{name}`"));
            return self.refuse(DrawProblem::NotByMotion {
                function: task.function.name().to_owned(),
                wanted: names[..quantity.order()].join(", "),
            });
        }
        if qd.is_some() || qdd.is_some() {
            let function = task.function.name().to_owned();
            return self.refuse(DrawProblem::NotOfMotion { function });
        }
        match (&task.function, q, position_m) {
            (Function::Free(_), None, None) => self.values(task),
            (Function::ForwardKinematics(_) | Function::Jacobian(_), Some(q), None) => {
                Ok(Drawn::Q(q))
            }
            (Function::InverseKinematics(form), Some(q), None) => {
                Ok(Drawn::PoseOf(q, table.branches.unwrap_or(2), *form))
            }
            (Function::InverseKinematics(form), None, Some(position)) => match table.branches {
                Some(1..) if form.is_turned() => self.refuse(DrawProblem::PoseOfPosition),
                Some(branches) => Ok(Drawn::Position(position, branches, *form)),
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
        let mut given = self.table.given.iter().flatten();
        let is_text = |ranges: &Ranges| matches!(ranges.end(0), Dimension::Text(_));
        if let Some((name, at)) = given.find(|(_, ranges)| is_text(ranges.get_ref())) {
            let name = name.get_ref().clone();
            return self.report.refuse_at(at, DrawProblem::Text { name });
        }
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
    fn dimensions(
        &self,
        task: &FunctionTask,
        ends: Ends,
    ) -> Result<Vec<(String, Ranges)>, LabError> {
        let rows: Vec<Option<&str>> = match self.table.robots.is_empty() {
            true => vec![None],
            false => self.rows().map(Some).collect(),
        };
        let stated = self.first_robot(task)?.dimensions().clone();
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
            let mut built = rows
                .iter()
                .map(|row| case_robot::built(&self.seen.robot_file, *row, &changed, &task.about));
            if let Some(Err(error)) = built.find(Result::is_err) {
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
