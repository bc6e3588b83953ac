//! A graded run: the record, and the runs that renderers need in addition to it.

use std::collections::BTreeMap;
use std::sync::Arc;

use kinemark_sim::control::Mode;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::sensor::Sensor;
use kinemark_sim::trace::Trace;
use serde::{Deserialize, Serialize};

use crate::record::grade::{Divergence, Grade};
use crate::record::names::Names;
use crate::record::shown_case::ShownCases;
use crate::record::staff_fault::StaffFault;
use crate::task::scene::LabScene;

/// The grade of a submission with the runs it rests on.
#[derive(Debug, Clone)]
pub struct GradedRun {
    /// The record.
    pub grade: Grade,
    /// The lab's title.
    pub title: String,
    /// Submissions of the course staff that failed, once each; their part of the feedback is missing.
    pub staff_faults: Vec<Arc<StaffFault>>,
    /// The motion tasks that ran, in the lab's order.
    pub runs: Vec<TaskRun>,
    /// The visible cases of the function tasks, in the lab's order.
    pub cases: Vec<ShownCases>,
}

/// The run of one motion task.
#[derive(Debug, Clone)]
pub struct TaskRun {
    /// The task's name.
    pub task: String,
    /// The robot that moved.
    pub robot: Robot,
    /// The scene around it, if there is one.
    pub scene: Option<Arc<LabScene>>,
    /// The robot's sensors, in the order of the trace's readings.
    pub sensors: Vec<Sensor>,
    /// The frame in which the TCP, the goals and the paths are given.
    pub seen_from: String,
    /// The servo's mode: what the command means.
    pub mode: Mode,
    /// Effort limits of the servo, shape `(n)`; infinity where there is none \[N m or N\].
    pub effort_limits: Vec<f64>,
    /// The recorded run, up to its end or its early stop.
    pub trace: Trace,
    /// The goals of the TCP, in order.
    pub goals: Vec<Goal>,
    /// The reference solution's TCP path, if the lab has one.
    pub reference_tcp: Option<TcpPath>,
    /// The paths that the TCP should follow.
    pub paths: Vec<AskedPath>,
    /// The curves that checks judged, in the lab's order.
    pub curves: Vec<Curve>,
    /// The titles of the task's checks by their names.
    pub check_titles: BTreeMap<String, String>,
    /// Its first difference from the reference solution's run, if that is reported.
    pub divergence: Option<Divergence>,
    /// The reference solution's run, present only if the course staff requested it, because its joint motion is the answer.
    pub reference_overlay: Option<Trace>,
}

impl TaskRun {
    /// Robot, scene and frame, for the names in events and contacts.
    pub fn names(&self) -> Names<'_> {
        Names {
            robot: &self.robot,
            scene: self.scene.as_ref().map(|scene| &scene.scene),
            seen_from: &self.seen_from,
        }
    }
}

/// A position that the TCP should reach, with a dwell there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Position in the lab's frame \[m\].
    pub position_m: [f64; 3],
    /// Duration of the dwell \[s\].
    pub dwell_s: f64,
    /// Distance that earns all points \[m\].
    pub full_m: f64,
    /// Distance that earns none \[m\].
    pub zero_m: f64,
    /// First and last tick of the dwell that was judged, if one was found.
    pub stay: Option<(u64, u64)>,
}

/// A path of straight segments that the TCP should follow.
#[derive(Debug, Clone, PartialEq)]
pub struct AskedPath {
    /// Its name.
    pub name: String,
    /// Its points in the lab's frame \[m\].
    pub points_m: Vec<[f64; 3]>,
    /// Distances from it that earn all points and none \[m\], where a check measures them.
    pub tube_m: Option<[f64; 2]>,
}

/// TCP positions at a fixed period, from time zero.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TcpPath {
    /// Time from one point to the next \[s\].
    pub period_s: f64,
    /// Positions in the lab's frame \[m\].
    pub points_m: Vec<[f64; 3]>,
}

/// A curve over time that a check judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The check's name.
    pub check: String,
    /// Title of the plot, such as `distance to the goal`.
    pub title: String,
    /// Unit of the values; empty for a ratio.
    pub unit: String,
    /// Times \[s\].
    pub t_s: Vec<f64>,
    /// Values.
    pub values: Vec<f64>,
    /// The value that earns all points, drawn as a line.
    pub full: Option<f64>,
    /// The value that earns none, drawn as a line.
    pub zero: Option<f64>,
    /// Marked moments, with their labels.
    pub marks: Vec<(f64, String)>,
    /// The same curve of the reference solution's run from time zero, where it may be drawn.
    pub reference: Option<Vec<f64>>,
    /// Additions for the plot of a step response, if it is one.
    pub step: Option<StepBackdrop>,
}

/// Additions to the plot of a step response.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepBackdrop {
    /// The response of the linear loop, at the times of the curve.
    pub prediction: Option<Vec<f64>>,
    /// The setpoint of the joint, drawn as a line.
    pub target: Option<f64>,
    /// A shaded range: lower value, upper value and label.
    pub band: Option<(f64, f64, String)>,
}
