//! The TOML types of a function task: what is called, with which cases.

use std::collections::BTreeMap;

use kinemark_sim::text::Spanned;
use schemars::JsonSchema;
use serde::Deserialize;

use super::NumberAt;
use crate::task::entry::Entry;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct FunctionTable {
    /// `forward_kinematics`, `inverse_kinematics`, `jacobian`, or a function of the lab's own.
    pub(in crate::lab) call: Spanned<String>,
    /// The function's name in submissions, where it is not the name in `call`.
    pub(in crate::lab) r#as: Option<Spanned<String>>,
    /// The rows of `jacobian`, `velocity` or `acceleration`: some of `x`, `y`, `z`, `rx`, `ry`, `rz`, in this order; `["x", "y", "z"]`
    /// where it is left out.
    pub(in crate::lab) rows: Option<Spanned<Vec<String>>>,
    /// How much of the pose counts for the two kinematics: `position`, `yaw`, `axis` or `full`.
    pub(in crate::lab) pose: Option<Spanned<String>>,
    /// With `pose = "axis"`: the axis of the TCP that counts; `[0, 0, 1]` where it is left out.
    pub(in crate::lab) axis: Option<Spanned<[f64; 3]>>,
    /// The frame or link of the robot that is the TCP in this task.
    pub(in crate::lab) frame: Option<Spanned<String>>,
    /// Joints that the function neither is given nor answers.
    #[serde(default)]
    pub(in crate::lab) ignore: Vec<Spanned<String>>,
    /// For `inverse_kinematics`: whether a branch beyond the limits of a joint is none; true where it is left out.
    pub(in crate::lab) within_limits: Option<Spanned<bool>>,
    /// For `torque` and `gravity`: gravity in the world \[m/s²\].
    pub(in crate::lab) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    /// Whether a function of the lab's own is given the robot.
    pub(in crate::lab) with_robot: Option<Spanned<bool>>,
    /// Entries of the answer that are angles, or `true` for an answer without names.
    pub(in crate::lab) turns: Option<Spanned<TurnsTable>>,
    /// What is expected counts as this great where it is smaller.
    pub(in crate::lab) least_size: Option<NumberAt>,
    /// Functions of `robot` that the task lends: `fk`, `jacobian`, `gravity`, `mass_matrix`.
    #[serde(default)]
    pub(in crate::lab) grants: Vec<Spanned<String>>,
    /// The visible cases, at least one.
    #[serde(default)]
    pub(in crate::lab) cases: Vec<Spanned<CaseTable>>,
}

/// Which entries are angles: the answer itself, or those of these names.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`turns` is true, or a list of names of entries")]
pub(in crate::lab) enum TurnsTable {
    /// Whether the answer itself is one.
    Whole(bool),
    /// Those of these names.
    Entries(Vec<String>),
}

/// What a free function is to answer.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "`expected` is a number, a list of numbers or of rows, or a table of these"
)]
pub(in crate::lab) enum ExpectedTable {
    /// A number, a list of numbers or a matrix.
    Whole(Entry),
    /// Entries by name.
    Entries(BTreeMap<String, Entry>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct CaseTable {
    /// Its name, which reports show.
    pub(in crate::lab) name: Spanned<String>,
    /// A row of joints such as `RzTxRy` in place of the lab's robot.
    pub(in crate::lab) robot: Option<Spanned<String>>,
    /// Joint positions, one per joint of the task \[rad, or m of a prismatic joint\].
    pub(in crate::lab) q_rad: Option<Spanned<Vec<f64>>>,
    /// Joint velocities \[rad/s, or m/s of a prismatic joint\].
    pub(in crate::lab) qd_rad_s: Option<Spanned<Vec<f64>>>,
    /// Joint accelerations \[rad/s², or m/s² of a prismatic joint\].
    pub(in crate::lab) qdd_rad_s2: Option<Spanned<Vec<f64>>>,
    /// Where the TCP is to be, for `inverse_kinematics`: `[x, y, z]` in the lab's frame \[m\].
    pub(in crate::lab) position_m: Option<[f64; 3]>,
    /// The heading of the TCP there, with `pose = "yaw"` \[degrees\].
    pub(in crate::lab) yaw_deg: Option<NumberAt>,
    /// Where the axis of the TCP points there, with `pose = "axis"`.
    pub(in crate::lab) axis: Option<Spanned<[f64; 3]>>,
    /// How the TCP is turned there, with `pose = "full"`: roll, pitch, yaw \[degrees\].
    pub(in crate::lab) rpy_deg: Option<Spanned<[f64; 3]>>,
    /// How many branches reach the position; 2 where it is left out, 1 at the boundary, 0 out of reach.
    pub(in crate::lab) branches: Option<Spanned<u64>>,
    /// Dimensions of the robot that differ in this case.
    #[serde(default)]
    pub(in crate::lab) dimensions: BTreeMap<String, kinemark_sim::text::Dimension>,
    /// The argument of a function of the lab's own: numbers, lists of numbers and matrices by name.
    pub(in crate::lab) given: Option<BTreeMap<String, Entry>>,
    /// What a function of the lab's own is to answer.
    pub(in crate::lab) expected: Option<ExpectedTable>,
}
