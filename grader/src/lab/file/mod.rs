//! The TOML types of a lab's files, as typed; spans are kept wherever a later check may point.
//!
//! Here is what stands at the top of `lab.toml`; below it function tasks (`function.rs`) and motion tasks (`motion.rs`), and beside it
//! what course staff keep (`staff.rs`).

mod function;
mod motion;
mod staff;

use std::collections::BTreeMap;

use kinemark_sim::text::schema::exactly_one;
use kinemark_sim::text::{FileFormat, ParameterSchema, Spanned};
use schemars::{JsonSchema, Schema};
use serde::Deserialize;

use crate::check::check_schema::only_kinds_that_fit;
use crate::check::registry::CheckTable;
use crate::lab::parameters::NumbersTable;

pub(in crate::lab) use self::function::{CaseTable, ExpectedTable, FunctionTable, TurnsTable};
pub(in crate::lab) use self::motion::{
    FrictionAt, FrictionTable, GoalTable, LawTable, MotionTable, PathTable, PerJoint, ServoTable,
    WindTable,
};
pub(in crate::lab) use self::staff::{
    DrawTable, HiddenRunsTable, HiddenTable, MutantTable, MutantsTable, Ranges, RangesTable,
    SaysTable,
};

/// A number as typed, whole or not.
pub(in crate::lab) type NumberAt = Spanned<f64>;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct LabTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The folder's name.
    pub(in crate::lab) name: Spanned<String>,
    /// One line, which students read.
    pub(in crate::lab) title: String,
    /// One sentence, which `kinemark` lists.
    #[serde(default)]
    pub(in crate::lab) summary: String,
    /// Name of a file in `robots/`, without `.toml`; or a URDF with its ending, such as `arm.urdf`.
    pub(in crate::lab) robot: Spanned<String>,
    /// How that URDF is read.
    pub(in crate::lab) robot_options: Option<Spanned<RobotOptionsTable>>,
    /// The robot's frame in which students work; its first link where it is left out.
    pub(in crate::lab) frame: Option<Spanned<String>>,
    /// How much a submission may compute.
    #[serde(default)]
    pub(in crate::lab) budgets: BudgetTable,
    /// The share of its points that a run keeps in which the submission failed, 0 to 1; 0.8 where it is left out.
    pub(in crate::lab) kept_after_stop: Option<NumberAt>,
    /// Named numbers, or lists of them, for expressions such as `"= line_x"`.
    // read before all else, for the expressions: see `parameters`
    #[serde(default, rename = "parameters")]
    #[schemars(with = "BTreeMap<String, ParameterSchema>")]
    _parameters: NumbersTable,
    /// Dimensions of the robot that this lab changes.
    #[serde(default)]
    pub(in crate::lab) dimensions: NumbersTable,
    /// The values that parameters take in students' variants: `{ from, to, step }`, or a list of such tables for a list.
    #[serde(default)]
    pub(in crate::lab) variants: BTreeMap<Spanned<String>, Spanned<VariesTable>>,
    /// The tasks, in the order in which they are graded and shown.
    #[serde(default)]
    pub(in crate::lab) tasks: Vec<TaskTable>,
}

/// How a URDF is read.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct RobotOptionsTable {
    /// Whether mimic joints have entries of their own in `q`; false where it is left out.
    #[serde(default)]
    pub(in crate::lab) ignore_mimic: bool,
    /// Whether inertias that no body can have are taken as they are; false where it is left out.
    #[serde(default)]
    pub(in crate::lab) accept_unphysical: bool,
    /// Whether the principal moments of such inertias become their mean; false where it is left out.
    #[serde(default)]
    pub(in crate::lab) balance: bool,
    /// Folders of packages of ROS, by their names.
    #[serde(default)]
    pub(in crate::lab) packages: BTreeMap<String, String>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct BudgetTable {
    /// Operations of a script in a call, 1 to 1,000,000,000; 25,000 where it is left out.
    pub(in crate::lab) operations_per_call: Option<Spanned<u64>>,
    /// Operations of a script in a task, 1 to 1,000,000,000; 5,000,000 where it is left out.
    pub(in crate::lab) operations_per_task: Option<Spanned<u64>>,
    /// Instructions of a compiled module in a call, 1 to 40,000,000,000; 1,000,000 where it is left out.
    pub(in crate::lab) instructions_per_call: Option<Spanned<u64>>,
    /// Instructions of a compiled module in a task, 1 to 40,000,000,000; 200,000,000 where it is left out.
    pub(in crate::lab) instructions_per_task: Option<Spanned<u64>>,
}

/// A task is of one kind.
fn of_one_work(schema: &mut Schema) {
    exactly_one(&["function", "motion"])(schema);
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = of_one_work, transform = only_kinds_that_fit)]
pub(in crate::lab) struct TaskTable {
    /// Its name: lower-case letters, digits and `-`.
    pub(in crate::lab) name: Spanned<String>,
    /// One line, which students read.
    pub(in crate::lab) title: String,
    /// A robot in place of the lab's: a file or a row of joints, as there.
    pub(in crate::lab) robot: Option<Spanned<String>>,
    /// Dimensions of the task's robot that differ in this task.
    #[serde(default)]
    pub(in crate::lab) dimensions: NumbersTable,
    /// A function of the submission is called on cases.
    pub(in crate::lab) function: Option<FunctionTable>,
    /// The robot moves under the submission's `control`.
    pub(in crate::lab) motion: Option<Spanned<MotionTable>>,
    /// What earns points, at least one.
    #[serde(default)]
    pub(in crate::lab) checks: Vec<Spanned<CheckTable>>,
}

/// The values that a parameter takes in variants.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct StepsTable {
    /// The first value.
    pub(in crate::lab) from: f64,
    /// No value is beyond this.
    pub(in crate::lab) to: f64,
    /// From one value to the next.
    pub(in crate::lab) step: f64,
}

/// What a parameter varies over: steps of a number, one such table for each number of a list, or choices of anything.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected { from, to, step }, a list of such tables, or { choices = [...] }"
)]
pub(in crate::lab) enum VariesTable {
    /// Steps of a number.
    Steps(StepsTable),
    /// Steps of each number of a list.
    Each(Vec<StepsTable>),
    /// One of several values.
    Choices(ChoicesTable),
}

/// Choices, all of the parameter's shape.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct ChoicesTable {
    /// The values, each as likely as the others.
    #[schemars(with = "Vec<ParameterSchema>")]
    pub(in crate::lab) choices: Vec<kinemark_sim::text::Dimension>,
}
