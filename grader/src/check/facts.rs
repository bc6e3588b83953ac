//! What checks of a motion task look at: a run, and how it went under disturbances.

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::trace::Trace;
use nalgebra::Vector3;

use super::dwell::Dwell;
use super::finding::curve;
use super::kind::robustness::LevelOutcome;
use super::signal::greatest;
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
    /// The best dwell at each goal, in order; empty where the task has no goals or the run is shorter than all dwells.
    pub dwells: Vec<Dwell>,
    /// The band by which dwells were chosen \[m\].
    pub pose_band: Band,
    /// The reference's path.
    pub reference: Option<&'a TcpPath>,
    /// The reference solution's run in the same variant, where a check compares with it.
    pub solution: Option<&'a Trace>,
    /// What the reference solution reaches in checks whose bands depend on it.
    pub reached: &'a [Reached],
    /// How the same motion went under the levels of robustness checks; empty where nothing was disturbed.
    pub sweeps: Vec<SweepRuns>,
}

/// What the reference solution reaches in a check.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The check's name.
    pub check: String,
    /// The value of its measure, where its band depends on it.
    pub value: Option<f64>,
    /// The values of its curve, tick by tick, where they may be drawn.
    pub curve: Option<Vec<f64>>,
}

/// The runs of one robustness check.
#[derive(Debug, Clone)]
pub struct SweepRuns {
    /// The check's name.
    pub check: String,
    /// One run per level; none where the repeated check earned nothing undisturbed.
    pub levels: Vec<LevelOutcome>,
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
        match asked {
            Some(joint) => (joint, value(joint)),
            None => greatest((0..self.robot.n()).map(value)).unwrap_or((0, f64::NAN)),
        }
    }

    /// Ticks whose efforts were applied: all but the last.
    pub fn applied_ticks(&self) -> usize {
        self.trace.len().saturating_sub(1)
    }

    /// The efforts of a joint that were applied, tick by tick \[N m or N\].
    pub fn applied_efforts(&self, joint: usize) -> Vec<f64> {
        let efforts = self.trace.effort.component(joint);
        efforts.take(self.applied_ticks()).collect()
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

    /// Position of the origin of a body of the scene in the lab's frame at a tick \[m\]; `None` if it cannot move.
    pub fn p_body_in_lab(&self, body: usize, tick: usize) -> Option<Vector3<f64>> {
        let world_from_body = self.trace.world_from_body(body, tick)?;
        let mut poses = FramePoses::new(self.robot);
        poses.update(self.robot, self.trace.q.at(tick));
        let world_from_lab = poses.world_from(self.robot.frame(self.names.seen_from)?);
        Some(world_from_lab.inv_mul(&world_from_body).translation.vector)
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
            ..Evidence::default()
        }
    }
}
