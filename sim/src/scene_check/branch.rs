//! The ways in which a robot reaches a place: every distinct answer of inverse kinematics found from starts all over the joint ranges.

use nalgebra::Vector3;

use crate::kinematics::inverse::Goal;
use crate::kinematics::joint_samples::JointSamples;
use crate::kinematics::position_range::{PositionRange, position_ranges};
use crate::kinematics::{IkError, IkSettings, IkSolver, Target};
use crate::model::robot::Robot;

/// Starts beside the robot's own: enough that a branch of an arm with six joints is hardly missed.
const STARTS: usize = 48;
/// More branches than this are a continuum, of which these are samples.
const MOST_BRANCHES: usize = 16;
/// Closer than this two answers are one: where an arm is straight its two branches meet, blurred by the tolerance \[rad\], \[m\].
const SAME: (f64, f64) = (0.05, 0.01);

/// How a place is reached.
#[derive(Debug)]
pub(super) enum Reach {
    /// In these branches, at least one, each a `q` of shape `(n)`.
    In(Vec<Vec<f64>>),
    /// Not at all; this is left at the nearest position found \[m\].
    Not { residual_m: f64 },
}

/// Finds the ways of one robot's TCP.
pub(super) struct BranchFinder<'r> {
    robot: &'r Robot,
    start_q: &'r [f64],
    /// Goes from start to start until one arrives.
    stubborn: IkSolver<'r>,
    /// Goes from one start alone.
    near: IkSolver<'r>,
    ranges: Vec<PositionRange>,
    /// Entries of `q` that carry the TCP.
    carries: Vec<bool>,
}

impl<'r> BranchFinder<'r> {
    pub(super) fn new(robot: &'r Robot, start_q: &'r [f64]) -> Result<Self, IkError> {
        let goal = Goal {
            frame: robot.tcp(),
            target: Target::Position(Vector3::zeros()),
            weight: 1.0,
        };
        let alone = IkSettings {
            restarts: 0,
            ..IkSettings::default()
        };
        Ok(Self {
            robot,
            start_q,
            stubborn: IkSolver::new(robot, &[goal], IkSettings::default())?,
            near: IkSolver::new(robot, &[goal], alone)?,
            ranges: position_ranges(robot),
            carries: carries_tcp(robot),
        })
    }

    /// The branches that reach `p_in_world`.
    pub(super) fn reach(&mut self, p_in_world: &Vector3<f64>) -> Result<Reach, IkError> {
        let target = Target::Position(*p_in_world);
        self.stubborn.set_target(0, target)?;
        let first = self.stubborn.solve(self.start_q)?;
        if !first.reached {
            return Ok(Reach::Not {
                residual_m: first.residual_m,
            });
        }
        self.near.set_target(0, target)?;
        let mut branches = vec![self.unwound(first.q)];
        let mut samples = JointSamples::new(self.robot);
        let mut from = vec![0.0; self.robot.n()];
        for start in 0..=STARTS {
            if branches.len() == MOST_BRANCHES {
                break;
            }
            if start == 0 {
                from.copy_from_slice(self.robot.home());
            } else {
                samples.next_into(&mut from);
            }
            for (entry, position) in from.iter_mut().enumerate() {
                if !self.carries[entry] {
                    *position = self.start_q[entry];
                }
            }
            match self.near.solve(&from) {
                Ok(answer) if answer.reached => {
                    let q = self.unwound(answer.q);
                    if !branches.iter().any(|known| self.same(known, &q)) {
                        branches.push(q);
                    }
                }
                // a start whose loops cannot be closed is no start
                Ok(_) | Err(IkError::Loops(_)) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(Reach::In(branches))
    }

    /// The position that brings the TCP to `p_in_world` from `q`, close by, and what is left there.
    ///
    /// # Errors
    /// The residual \[m\] where there is none.
    pub(super) fn follow(
        &mut self,
        q: &[f64],
        p_in_world: &Vector3<f64>,
    ) -> Result<Result<Vec<f64>, f64>, IkError> {
        self.near.set_target(0, Target::Position(*p_in_world))?;
        match self.near.solve(q) {
            Ok(answer) if answer.reached => Ok(Ok(answer.q)),
            Ok(answer) => Ok(Err(answer.residual_m)),
            Err(error) => Err(error),
        }
    }

    /// Entry `entry` of `q`: whether it turns.
    pub(super) fn turns(&self, entry: usize) -> bool {
        self.ranges[entry].turns
    }

    /// `q`, by whole turns, near the start.
    fn unwound(&self, mut q: Vec<f64>) -> Vec<f64> {
        // in a mechanism a turn on may be on another branch
        if self.robot.loops().is_empty() {
            for (entry, range) in self.ranges.iter().enumerate() {
                q[entry] = range.nearest_turn(q[entry], self.start_q[entry]);
            }
        }
        q
    }

    fn same(&self, a: &[f64], b: &[f64]) -> bool {
        let mut pairs = a.iter().zip(b).enumerate();
        pairs.all(|(entry, (a, b))| {
            let apart = (a - b).abs();
            if !self.ranges[entry].turns {
                return apart <= SAME.1;
            }
            let turn = 2.0 * std::f64::consts::PI;
            let rest = apart % turn;
            rest.min(turn - rest) <= SAME.0
        })
    }
}

/// Which entries of `q` move the TCP; in a robot with loops, all may.
fn carries_tcp(robot: &Robot) -> Vec<bool> {
    let mut carries = vec![!robot.loops().is_empty(); robot.n()];
    let mut next = robot.tcp().attachment.body;
    while let Some(index) = next {
        let body = &robot.bodies()[index];
        carries[body.q_index] = true;
        next = body.parent;
    }
    carries
}
