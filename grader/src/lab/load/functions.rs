//! Function tasks: the function that is called, what of the robot it is about, and its visible cases.

use std::collections::BTreeSet;

use kinemark_sim::spatial::direction;
use kinemark_sim::text::{Mistakes, Spanned};
use nalgebra::Vector3;

use super::Reader;
use crate::lab::file::{CaseTable, FunctionTable};
use crate::submission::rhai::refused_name;
use crate::task::model::{About, Case, Compared, Function, FunctionTask, Rows};
use crate::task::pose::PoseForm;
use crate::task::problem::{LabError, near, problems};
use crate::task::quantity::Quantity;

problems! {
    /// What is wrong with a function task, or a visible case of one.
    pub(super) enum FunctionProblem {
        BadName { name: String, why: String }:
            "lab::call", "`{name}` cannot be the name of a function: {why}", "this name",
            "one of the functions that Kinemark knows, such as `forward_kinematics`, or a name of your own in lower-case letters, digits and `_`";
        NearName { name: String, near: String }:
            "lab::call", "no built-in task function is called `{name}`", "this name",
            format!("did you mean `{near}`? A function of your own needs `given` and `expected` in every case");
        SameCase { case: String }:
            "lab::duplicate", "case `{case}` is defined twice", "the second one", "give each its own name";
        FreeInput { case: String, function: String }:
            "lab::case_input", "case `{case}` of `{function}` is given by `given` and `expected`", "this case",
            "write `given = { kp = 100.0 }, expected = { damping_ratio = 2.2 }`, or one number for `expected`";
        NoExpected { case: String }:
            "lab::case_input", "case `{case}` does not say what is `expected`", "this case",
            "write it, or let `kinemark lab fill` write what the reference solution answers";
        NothingExpected { case: String }:
            "lab::case_input", "case `{case}` expects nothing", "this case",
            "name in `expected` what the function is to return";
        OtherNames { case: String, differs: String }:
            "lab::case_input", "case `{case}` {differs}", "unlike the first case", "all cases of a task have the same names";
        UnevenRows { case: String }:
            "lab::case_input", "a matrix of case `{case}` has no rows, or rows of different lengths", "this case",
            "write rows of equal length: [[1, 2], [3, 4]]";
        RowsOfWhat { function: String }:
            "lab::rows", "`{function}` has no `rows`", "rows of what?", "`rows` are those of `jacobian`, `velocity` and `acceleration`: remove them here";
        Rows { known: String }:
            "lab::rows", "`rows` names some of {known}, each once and in this order", "not such rows",
            "write `rows = [\"x\", \"y\"]` for motion in a plane";
        NoCases { function: String }:
            "lab::no_cases", "`{function}` has no visible cases", "this function",
            "add [[tasks.function.cases]]: students practise on them";
        NotOf { key: &'static str, function: String, of: &'static str }:
            "lab::function_key", "`{key}` means nothing to `{function}`", "of no effect", format!("it is for {of}: remove it here");
        Pose { name: String }:
            "lab::pose", "there is no form of poses called `{name}`", "not a form of poses",
            near(name, "forms", PoseForm::NAMES);
        PoseAxis:
            "lab::pose", "`axis` is for `pose = \"axis\"`", "of no effect", "remove it, or ask for that form";
        NoDirection { what: &'static str }:
            "lab::pose", "`{what}` has no direction", "too short, or not finite", "such as [0, 0, 1]: its length makes no difference";
        UnknownFrame { robot: String, frame: String, known: Vec<String> }:
            "lab::unknown_frame", "robot `{robot}` has no frame `{frame}`", "not a frame of this robot",
            near(frame, "frames", known);
        MovingFrame { frame: String }:
            "lab::unknown_frame", "the lab's frame `{frame}` moves with the robot, and `acceleration` is seen from one that stands still",
            "of this lab", "name another `frame` at the top of the file";
        UnknownJoint { robot: String, joint: String, known: Vec<String> }:
            "lab::unknown_joint", "robot `{robot}` has no joint `{joint}` that could be left out", "not a joint of this robot",
            near(joint, "joints", known);
        AllIgnored:
            "lab::unknown_joint", "`ignore` leaves no joint", "all of them", "keep those that the task is about";
        Gravity:
            "lab::out_of_range", "`gravity_m_s2` is three finite numbers", "not finite";
        LeastSize { value: f64 }:
            "lab::out_of_range", "`least_size` is zero or more, got {value}", "below zero";
        Turns { name: String, known: Vec<String> }:
            "lab::unknown_entry", "no case expects an entry `{name}`", "not an entry of `expected`", near(name, "entries", known);
        TurnsOfWhole:
            "lab::unknown_entry", "`turns = true` is for an answer without names", "the answers have entries",
            "name those that are angles: turns = [\"yaw\"]";
    }
}

/// All cases, or all mistakes in them: none depends on another.
pub(super) fn all_read(
    cases: impl Iterator<Item = Result<Case, LabError>>,
) -> Result<Vec<Case>, LabError> {
    let mut mistakes = Mistakes::default();
    let read = cases.filter_map(|case| mistakes.keep(case)).collect();
    mistakes.finish()?;
    Ok(read)
}

impl Reader<'_> {
    pub(super) fn function(&self, table: &FunctionTable) -> Result<FunctionTask, LabError> {
        let function = self.called(table)?;
        self.keys_fit(table, &function)?;
        if table.cases.is_empty() {
            let function = function.name().to_owned();
            let problem = FunctionProblem::NoCases { function };
            return self.report.refuse_at(&table.call, problem);
        }
        self.distinct(&table.cases)?;
        let about = self.about(table, &function)?;
        let cases: Vec<Case> = match &function {
            Function::Free(_) => self.free_cases(table, &about)?,
            function => {
                let cases = table.cases.iter();
                all_read(cases.map(|case| self.case(function, &about, case)))?
            }
        };
        self.turns_fit(table, &cases)?;
        Ok(FunctionTask {
            grants: self.function_grants(table, &function, &about)?,
            function,
            cases,
            about,
        })
    }

    /// The function that the task calls.
    fn called(&self, table: &FunctionTable) -> Result<Function, LabError> {
        let name = table.call.get_ref().as_str();
        Ok(match name {
            "forward_kinematics" => Function::ForwardKinematics(self.pose_form(table)?),
            "inverse_kinematics" => Function::InverseKinematics(self.pose_form(table)?),
            "jacobian" => Function::Jacobian(self.rows(table.rows.as_ref())?),
            _ => {
                let rows = self.rows(table.rows.as_ref())?;
                let mut quantities = Quantity::all(rows).into_iter();
                // a function of this name with `given` and `expected` is the lab's own
                let is_free = |case: &Spanned<CaseTable>| case.get_ref().given.is_some();
                match quantities.find(|quantity| quantity.name() == name) {
                    Some(quantity) if !table.cases.iter().any(is_free) => {
                        Function::Quantity(quantity)
                    }
                    _ => self.free_function(&table.call)?,
                }
            }
        })
    }

    /// How much of the pose is asked for or given: the position where nothing is said.
    fn pose_form(&self, table: &FunctionTable) -> Result<PoseForm, LabError> {
        let form = match table.pose.as_ref().map(|name| name.get_ref().as_str()) {
            None | Some("position") => PoseForm::Position,
            Some("yaw") => PoseForm::Yaw,
            Some("full") => PoseForm::Full,
            Some("axis") => {
                let typed = table.axis.as_ref().map(Spanned::get_ref);
                let of_tcp = direction(typed.map_or(Vector3::z(), |axis| Vector3::from(*axis)));
                match (of_tcp, &table.axis) {
                    (Some(of_tcp), _) => return Ok(PoseForm::Axis { of_tcp }),
                    (None, Some(axis)) => {
                        let problem = FunctionProblem::NoDirection { what: "axis" };
                        return self.report.refuse_at(axis, problem);
                    }
                    (None, None) => PoseForm::Position,
                }
            }
            Some(name) => {
                let problem = FunctionProblem::Pose {
                    name: name.to_owned(),
                };
                let at = table.pose.as_ref().map_or(0..0, Spanned::span);
                return self.report.refuse(at, problem);
            }
        };
        match &table.axis {
            Some(axis) => self.report.refuse_at(axis, FunctionProblem::PoseAxis),
            None => Ok(form),
        }
    }

    /// Refuses keys that mean nothing to this function.
    // long: a row for each key
    fn keys_fit(&self, table: &FunctionTable, function: &Function) -> Result<(), LabError> {
        use Function::{ForwardKinematics, Free, InverseKinematics, Jacobian};
        let has_rows = match function {
            Jacobian(_) => true,
            Function::Quantity(quantity) => quantity.rows().is_some(),
            _ => false,
        };
        if let (Some(rows), false) = (&table.rows, has_rows) {
            let function = function.name().to_owned();
            let problem = FunctionProblem::RowsOfWhat { function };
            return self.report.refuse_at(rows, problem);
        }
        let feels_gravity =
            matches!(function, Function::Quantity(quantity) if quantity.feels_gravity());
        let (poses, is_free) = (
            matches!(function, ForwardKinematics(_) | InverseKinematics(_)),
            matches!(function, Free(_)),
        );
        fn place<T>(typed: &Option<Spanned<T>>) -> Option<std::ops::Range<usize>> {
            typed.as_ref().map(Spanned::span)
        }
        let fits = [
            (
                "pose",
                place(&table.pose),
                poses,
                "`forward_kinematics` and `inverse_kinematics`",
            ),
            (
                "axis",
                place(&table.axis),
                poses,
                "`forward_kinematics` and `inverse_kinematics`",
            ),
            (
                "as",
                place(&table.r#as),
                !is_free,
                "functions that Kinemark knows; your own has its name in `call`",
            ),
            (
                "frame",
                place(&table.frame),
                !is_free,
                "functions that Kinemark knows",
            ),
            (
                "within_limits",
                place(&table.within_limits),
                matches!(function, InverseKinematics(_)),
                "`inverse_kinematics`",
            ),
            (
                "gravity_m_s2",
                place(&table.gravity_m_s2),
                feels_gravity,
                "`torque` and `gravity`",
            ),
            (
                "with_robot",
                place(&table.with_robot),
                is_free,
                "functions of the lab's own; the others are given the robot anyway",
            ),
            (
                "turns",
                place(&table.turns),
                is_free,
                "functions of the lab's own",
            ),
            (
                "least_size",
                place(&table.least_size),
                is_free || matches!(function, Function::Quantity(_)),
                "quantities and functions of the lab's own",
            ),
            (
                "ignore",
                table.ignore.first().map(Spanned::span),
                !is_free || table.with_robot.is_some(),
                "functions that are given the robot",
            ),
        ];
        for (key, at, fits, of) in fits {
            if let (Some(at), false) = (at, fits) {
                let function = function.name().to_owned();
                let problem = FunctionProblem::NotOf { key, function, of };
                return self.report.refuse(at, problem);
            }
        }
        Ok(())
    }

    /// What of the robot the task is about.
    fn about(&self, table: &FunctionTable, function: &Function) -> Result<About, LabError> {
        let mut about = About {
            name: self.own_name(table, function)?,
            ..About::default()
        };
        if let Some(frame) = &table.frame {
            about.frame = Some(frame.get_ref().clone());
            let has_row = |case: &Spanned<CaseTable>| case.get_ref().robot.is_some();
            // robots of the cases' own are asked when they are built
            if !table.cases.iter().all(has_row) && self.robot.frame(frame.get_ref()).is_none() {
                return self.refuse_frame(self.robot, frame);
            }
        }
        let joints = self.robot.independent();
        let all: Vec<&str> = self
            .robot
            .moving_joints()
            .map(|joint| joint.name.as_str())
            .collect();
        let known: Vec<&str> = joints.iter().map(|&entry| all[entry]).collect();
        for joint in &table.ignore {
            let name = joint.get_ref();
            if !known.contains(&name.as_str()) {
                let problem = FunctionProblem::UnknownJoint {
                    robot: self.robot.name().to_owned(),
                    joint: name.clone(),
                    known: known.iter().map(|name| (*name).to_owned()).collect(),
                };
                return self.report.refuse_at(joint, problem);
            }
            about.ignored.push(name.clone());
        }
        if let Some(first) = table.ignore.first()
            && known
                .iter()
                .all(|name| about.ignored.iter().any(|ignored| ignored == name))
        {
            return self.report.refuse_at(first, FunctionProblem::AllIgnored);
        }
        if let Some(within_limits) = &table.within_limits {
            about.within_limits = *within_limits.get_ref();
        }
        if let Some(gravity) = &table.gravity_m_s2 {
            about.gravity_m_s2 = Vector3::from(*gravity.get_ref());
            if !about.gravity_m_s2.iter().all(|x| x.is_finite()) {
                return self.report.refuse_at(gravity, FunctionProblem::Gravity);
            }
        }
        about.gives_robot = table
            .with_robot
            .as_ref()
            .is_some_and(|with| *with.get_ref());
        about.compared = self.compared(table)?;
        if let Function::Quantity(quantity) = function {
            if quantity.needs_masses() {
                self.has_inertias(&table.call)?;
            }
            let stands = |name: &str| {
                let frame = self.robot.frame(name);
                frame.is_some_and(|frame| frame.attachment.body.is_none())
            };
            if matches!(quantity, Quantity::Acceleration(_)) && !stands(self.frame) {
                let frame = self.frame.to_owned();
                let problem = FunctionProblem::MovingFrame { frame };
                return self.report.refuse_at(&table.call, problem);
            }
        }
        Ok(about)
    }

    /// The name that the lab gives the function in submissions.
    fn own_name(
        &self,
        table: &FunctionTable,
        function: &Function,
    ) -> Result<Option<String>, LabError> {
        let Some(typed) = &table.r#as else {
            return Ok(None);
        };
        let name = typed.get_ref();
        if name == function.name() {
            return Ok(None);
        }
        match refused_name(name) {
            None => Ok(Some(name.clone())),
            Some(why) => {
                let problem = FunctionProblem::BadName {
                    name: name.clone(),
                    why: why.to_owned(),
                };
                self.report.refuse_at(typed, problem)
            }
        }
    }

    /// A frame that a robot does not have.
    pub(super) fn refuse_frame<T>(
        &self,
        robot: &kinemark_sim::model::robot::Robot,
        frame: &Spanned<String>,
    ) -> Result<T, LabError> {
        let known = robot.frames().iter().map(|frame| frame.name.clone());
        let problem = FunctionProblem::UnknownFrame {
            robot: robot.name().to_owned(),
            frame: frame.get_ref().clone(),
            known: known.collect(),
        };
        self.report.refuse_at(frame, problem)
    }

    /// How the answers of the lab's own function are compared.
    fn compared(&self, table: &FunctionTable) -> Result<Compared, LabError> {
        use crate::lab::file::TurnsTable;
        let turns = match table.turns.as_ref().map(Spanned::get_ref) {
            None | Some(TurnsTable::Whole(false)) => Vec::new(),
            Some(TurnsTable::Whole(true)) => vec![String::new()],
            Some(TurnsTable::Entries(names)) => names.clone(),
        };
        let mut least_size = 0.0;
        if let Some(typed) = &table.least_size {
            let value = *typed.get_ref();
            if !(value >= 0.0 && value.is_finite()) {
                let problem = FunctionProblem::LeastSize { value };
                return self.report.refuse_at(typed, problem);
            }
            least_size = value;
        }
        Ok(Compared { turns, least_size })
    }

    /// The entries that are angles are among those that the cases expect.
    fn turns_fit(&self, table: &FunctionTable, cases: &[Case]) -> Result<(), LabError> {
        use crate::lab::file::TurnsTable;
        use crate::task::model::Given;
        let (Some(typed), Some(Given::Values { expected, .. })) =
            (&table.turns, cases.first().map(|case| &case.given))
        else {
            return Ok(());
        };
        let known: Vec<String> = expected.iter().map(|(name, _)| name.clone()).collect();
        match typed.get_ref() {
            TurnsTable::Whole(true) if known != [""] => {
                self.report.refuse_at(typed, FunctionProblem::TurnsOfWhole)
            }
            TurnsTable::Whole(_) => Ok(()),
            TurnsTable::Entries(names) => match names.iter().find(|name| !known.contains(name)) {
                Some(name) => {
                    let name = name.clone();
                    self.report
                        .refuse_at(typed, FunctionProblem::Turns { name, known })
                }
                None => Ok(()),
            },
        }
    }

    /// Refuses a name that two cases have.
    fn distinct(&self, cases: &[Spanned<CaseTable>]) -> Result<(), LabError> {
        let mut known = BTreeSet::new();
        for case in cases {
            let name = &case.get_ref().name;
            if !known.insert(name.get_ref()) {
                let case = name.get_ref().clone();
                let problem = FunctionProblem::SameCase { case };
                return self.report.refuse_at(name, problem);
            }
        }
        Ok(())
    }

    /// The rows of a Jacobian or of the TCP's motion: the linear ones where none are named.
    fn rows(&self, typed: Option<&Spanned<Vec<String>>>) -> Result<Rows, LabError> {
        let Some(typed) = typed else {
            return Ok(Rows::LINEAR);
        };
        match Rows::named(typed.get_ref().iter().map(String::as_str)) {
            Some(rows) => Ok(rows),
            None => {
                let known = Rows::NAMES.join(", ");
                self.report
                    .refuse_at(typed, FunctionProblem::Rows { known })
            }
        }
    }
}
