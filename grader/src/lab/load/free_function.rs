//! A task of a function that the lab names itself: what it is called, what its cases give, what they expect.

use kinemark_sim::text::{Mistakes, Spanned, nearest};

use super::Reader;
use super::cases::changed;
use super::functions::{FunctionProblem, all_read};
use crate::lab::file::{CaseTable, ExpectedTable, FunctionTable};
use crate::submission::rhai::refused_name;
use crate::task::entry::Entry;
use crate::task::model::{About, Case, Function, Given, Rows};
use crate::task::problem::LabError;
use crate::task::quantity::Quantity;

impl Reader<'_> {
    /// The function called `name`.
    pub(super) fn free_function(&self, name: &Spanned<String>) -> Result<Function, LabError> {
        let typed = name.get_ref();
        match refused_name(typed) {
            None => Ok(Function::Free(typed.clone())),
            Some(why) => {
                let problem = FunctionProblem::BadName {
                    name: typed.clone(),
                    why: why.to_owned(),
                };
                self.report.refuse_at(name, problem)
            }
        }
    }

    /// The cases of a free function: all of them give and expect entries of the same names.
    pub(super) fn free_cases(
        &self,
        table: &FunctionTable,
        about: &About,
    ) -> Result<Vec<Case>, LabError> {
        let cases = table.cases.iter();
        let read = all_read(cases.map(|case| self.free_case(&table.call, about, case)))?;
        let Some((first, others)) = read.split_first() else {
            return Ok(read);
        };
        let mut mistakes = Mistakes::default();
        for (case, typed) in others.iter().zip(&table.cases[1..]) {
            if shape(first) != shape(case) {
                let problem = FunctionProblem::OtherNames {
                    case: case.name.clone(),
                    differs: differences(case, first),
                };
                mistakes.keep::<()>(self.report.refuse_at(typed, problem));
            }
        }
        mistakes.finish()?;
        Ok(read)
    }

    fn free_case(
        &self,
        function: &Spanned<String>,
        about: &About,
        spanned: &Spanned<CaseTable>,
    ) -> Result<Case, LabError> {
        let table = spanned.get_ref();
        let name = table.name.get_ref().clone();
        let is_of_robot = !table.dimensions.is_empty() || table.robot.is_some();
        let foreign = table.q_rad.is_some()
            || table.qd_rad_s.is_some()
            || table.qdd_rad_s2.is_some()
            || table.position_m.is_some()
            || table.yaw_deg.is_some()
            || table.axis.is_some()
            || table.rpy_deg.is_some()
            || table.branches.is_some()
            || (is_of_robot && !about.gives_robot);
        let (Some(given), Some(expected), false) = (&table.given, &table.expected, foreign) else {
            let near = near_built_in(function.get_ref());
            if let (true, Some(near)) = (foreign, near.filter(|near| near != function.get_ref())) {
                let problem = FunctionProblem::NearName {
                    name: function.get_ref().clone(),
                    near: near.to_owned(),
                };
                return self.report.refuse_at(function, problem);
            }
            if table.given.is_some() && !foreign {
                let problem = FunctionProblem::NoExpected { case: name };
                return self.report.refuse_at(spanned, problem);
            }
            let (case, function) = (name, function.get_ref().clone());
            let problem = FunctionProblem::FreeInput { case, function };
            return self.report.refuse_at(spanned, problem);
        };
        let expected = match expected {
            ExpectedTable::Whole(entry) => vec![(String::new(), entry.clone())],
            ExpectedTable::Entries(entries) => entries
                .iter()
                .map(|(k, v)| (k.clone(), v.clone()))
                .collect(),
        };
        if expected.is_empty() {
            let problem = FunctionProblem::NothingExpected { case: name };
            return self.report.refuse_at(spanned, problem);
        }
        let entries = given
            .values()
            .chain(expected.iter().map(|(_, entry)| entry));
        if entries.clone().any(Entry::is_uneven) {
            let problem = FunctionProblem::UnevenRows { case: name };
            return self.report.refuse_at(spanned, problem);
        }
        Ok(Case {
            name,
            hidden_class: None,
            row: table.robot.as_ref().map(|row| row.get_ref().clone()),
            dimensions: changed(table),
            robot: self.case_robot(about, spanned)?,
            given: Given::Values {
                given: given.iter().map(|(k, v)| (k.clone(), v.clone())).collect(),
                expected,
            },
        })
    }
}

/// The built-in function that is meant by this name, if it is near to one or another word for it.
fn near_built_in(name: &str) -> Option<&'static str> {
    let quantities = Quantity::all(Rows::LINEAR).map(Quantity::name);
    let known = ["forward_kinematics", "inverse_kinematics", "jacobian"];
    match name {
        "fk" | "fkine" | "forward" => Some(known[0]),
        "ik" | "ikine" | "inverse" => Some(known[1]),
        "jac" | "jacob" | "geometric_jacobian" => Some(known[2]),
        "inverse_dynamics" | "rnea" | "id" => Some(Quantity::Torque.name()),
        "inertia" | "crba" => Some(Quantity::MassMatrix.name()),
        name => nearest(name, known.into_iter().chain(quantities)),
    }
}

/// Stands for the name of an answer that is a list: no entry can be called so.
const LIST: &str = "[]";

/// The same of an answer that is a matrix.
const MATRIX: &str = "[[]]";

fn named((name, value): &(String, Entry)) -> &str {
    match value {
        Entry::List(_) if name.is_empty() => LIST,
        Entry::Matrix(_) if name.is_empty() => MATRIX,
        _ => name,
    }
}

/// The names of what a case gives and expects; of an answer without names, what it is.
fn shape(case: &Case) -> [Vec<&str>; 2] {
    match &case.given {
        Given::Values { given, expected } => {
            [given, expected].map(|entries| entries.iter().map(named).collect())
        }
        _ => [Vec::new(), Vec::new()],
    }
}

/// How what `case` gives and expects differs from the first one, in words: the names that differ, and no others.
fn differences(case: &Case, first: &Case) -> String {
    let [given, expected] = shape(case);
    let [first_given, first_expected] = shape(first);
    let both = [
        difference("give", &given, &first_given),
        difference("expect", &expected, &first_expected),
    ];
    let both: Vec<String> = both.into_iter().flatten().collect();
    both.join("; it ")
}

fn difference(verb: &str, of_case: &[&str], of_first: &[&str]) -> Option<String> {
    let without = |these: &[&str], those: &[&str]| {
        let only = these.iter().filter(|name| !those.contains(name));
        let only: Vec<String> = only
            .map(|name| match *name {
                "" => "one number".to_owned(),
                LIST => "a list".to_owned(),
                MATRIX => "a matrix".to_owned(),
                name => format!("`{name}`"),
            })
            .collect();
        only.join(", ")
    };
    let (more, less) = (without(of_case, of_first), without(of_first, of_case));
    match (more.is_empty(), less.is_empty()) {
        (true, true) => None,
        (false, true) => Some(format!("{verb}s {more}, the first case does not")),
        (true, false) => Some(format!("does not {verb} {less}, the first case does")),
        (false, false) => Some(format!("{verb}s {more}, the first case {verb}s {less}")),
    }
}
