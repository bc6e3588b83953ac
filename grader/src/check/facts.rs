//! What checks of a motion task look at: a run, and how it went under disturbances.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::trace::Trace;
use nalgebra::Vector3;

use super::finding::curve;
use super::kind::robustness::RungFacts;
use super::stay::Stay;
use crate::record::grade::Evidence;
use crate::record::graded::{Curve, TcpPath};
use crate::record::names::Names;
use crate::task::joint_units::JointUnits;
use crate::task::model::{Band, MotionTask};

/// A run as the checks of a motion task see it.
#[derive(Debug)]
pub struct MotionFacts<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// Its names, and those of what was around it.
    pub names: Names<'a>,
    /// What was asked for.
    pub motion: &'a MotionTask,
    /// What was recorded.
    pub trace: &'a Trace,
    /// The best stay at each goal, in order; empty where the task has no goals or the run is shorter than the dwells.
    pub stays: Vec<Stay>,
    /// The band by which stays were chosen \[m\].
    pub pose_band: Band,
    /// The reference's path.
    pub reference: Option<&'a TcpPath>,
    /// How the same motion went on the rungs of robustness checks; empty where nothing was disturbed.
    pub climbs: Vec<Climb>,
}

/// The runs of one robustness check.
#[derive(Debug, Clone)]
pub struct Climb {
    /// The check's name.
    pub check: String,
    /// Title of the check that is repeated.
    pub repeated: String,
    /// One run per rung.
    pub rungs: Vec<RungFacts>,
}

impl MotionFacts<'_> {
    /// The time of a tick \[s\].
    pub fn time_s(&self, tick: usize) -> f64 {
        self.motion.periods.time_s(tick as u64)
    }

    /// The name of a joint by its index in `q`.
    pub fn joint_name(&self, joint: usize) -> &str {
        let found = self.robot.moving_joints().nth(joint);
        found.map_or("?", |joint| joint.name.as_str())
    }

    /// The units of a joint by its index in `q`.
    pub fn units(&self, joint: usize) -> JointUnits {
        JointUnits::of(self.robot, joint)
    }

    /// The joint `asked`, or that with the greatest value, and its value; one that is no number is the greatest of all.
    pub fn worst_joint(&self, asked: Option<usize>, value: impl Fn(usize) -> f64) -> (usize, f64) {
        let joints = match asked {
            Some(joint) => joint..joint + 1,
            None => 0..self.robot.n(),
        };
        let values = joints.map(|joint| (joint, value(joint)));
        let greater = |a: &(usize, f64), b: &(usize, f64)| {
            // of equal ones the first
            b.1.abs().total_cmp(&a.1.abs()).is_gt()
        };
        values
            .reduce(|a, b| if greater(&a, &b) { b } else { a })
            .unwrap_or((0, f64::NAN))
    }

    /// Ticks whose efforts were applied: all but the last.
    pub fn applied_ticks(&self) -> usize {
        self.trace.len().saturating_sub(1)
    }

    /// The last tick of the run.
    pub fn last_tick(&self) -> usize {
        self.trace.len().saturating_sub(1)
    }

    /// Positions of the TCP in the lab's frame, tick by tick \[m\].
    pub fn p_tcp_m(&self) -> Vec<Vector3<f64>> {
        (0..self.trace.len())
            .map(|tick| self.trace.tcp_position(tick))
            .collect()
    }

    /// A curve with one value for each of the first ticks, against a band.
    pub fn curve(
        &self,
        title: impl Into<String>,
        unit: &str,
        values: Vec<f64>,
        band: Band,
    ) -> Curve {
        let t_s = (0..values.len()).map(|tick| self.time_s(tick)).collect();
        curve(title, unit, t_s, values, Some(band))
    }

    /// A piece of evidence at a tick.
    pub fn evidence(&self, message: String, signal: String, tick: usize) -> Evidence {
        Evidence {
            message,
            signal,
            tick: Some(tick as u64),
            time_s: Some(self.time_s(tick)),
            run: None,
            case: None,
            value: None,
            limit: None,
            unit: String::new(),
        }
    }
}
