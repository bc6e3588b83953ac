//! The branches in which a robot reaches a point or a pose: the distinct solutions of inverse kinematics, from starts spread over the joint
//! ranges.

use nalgebra::Vector3;

use crate::kinematics::inverse::Goal;
use crate::kinematics::joint_samples::JointSamples;
use crate::kinematics::position_range::{PositionRange, position_ranges};
use crate::kinematics::{IkError, IkSettings, IkSolver, Target};
use crate::model::robot::Robot;

/// Starts in addition to the robot's own: with so many, a branch of an arm with six joints is rarely missed.
const STARTS: usize = 48;
/// More branches than this indicate a continuum of solutions; the branches are then samples of it.
const MOST_BRANCHES: usize = 16;
/// Closer solutions count as one: where an arm is straight its two branches meet, to the tolerance \[rad\], \[m\].
const SAME: (f64, f64) = (0.05, 0.01);

/// Whether and how a target is reached.
#[derive(Debug)]
pub enum Reach {
    /// In these branches, at least one, each a `q` of shape `(n)`.
    In(Vec<Vec<f64>>),
    /// In none.
    Not {
        /// The distance left at the nearest configuration found \[m\].
        residual_m: f64,
        /// The angle left there \[rad\]; zero where only a position is asked for.
        residual_rad: f64,
    },
}

/// Finds the branches of one robot's TCP.
#[derive(Debug)]
pub struct BranchFinder<'r> {
    robot: &'r Robot,
    start_q: &'r [f64],
    /// Tries start after start until one converges.
    stubborn: IkSolver<'r>,
    /// Tries a single start.
    near: IkSolver<'r>,
    ranges: Vec<PositionRange>,
    /// Entries of `q` that move the TCP here.
    carries: Vec<bool>,
    /// How often it has looked for a configuration.
    pub(crate) solved: u64,
}

impl<'r> BranchFinder<'r> {
    /// A finder that starts from `start_q`, shape `(n)`, and looks around it.
    ///
    /// # Errors
    /// [`IkError`] for a robot whose loops cannot be closed.
    pub fn new(robot: &'r Robot, start_q: &'r [f64]) -> Result<Self, IkError> {
        Self::of_kind(robot, start_q, Target::Position(Vector3::zeros()), None)
    }

    /// As [`BranchFinder::new`], for targets of the kind of `target` in place of points; of the joints only the entries `chain` of `q` move,
    /// where it is given, and those that loops bind to them.
    ///
    /// # Errors
    /// [`IkError`] for a robot whose loops cannot be closed, a target without finite numbers, or a joint that does not exist.
    pub fn of_kind(
        robot: &'r Robot,
        start_q: &'r [f64],
        target: Target,
        chain: Option<&[usize]>,
    ) -> Result<Self, IkError> {
        let goal = Goal {
            frame: robot.tcp(),
            target,
            weight: 1.0,
        };
        let stubborn = IkSettings {
            chain: chain.map(<[usize]>::to_vec),
            ..IkSettings::default()
        };
        let alone = IkSettings {
            restarts: 0,
            ..stubborn.clone()
        };
        let mut carries = carries_tcp(robot);
        if let Some(chain) = chain {
            for (entry, carries) in carries.iter_mut().enumerate() {
                *carries &= chain.contains(&entry);
            }
        }
        Ok(Self {
            robot,
            start_q,
            stubborn: IkSolver::new(robot, &[goal], stubborn)?,
            near: IkSolver::new(robot, &[goal], alone)?,
            ranges: position_ranges(robot),
            carries,
            solved: 0,
        })
    }

    /// The branches that reach `p_in_world`, within the limits of the joints; with 16 of them there may be more.
    ///
    /// # Errors
    /// [`IkError`] for a point without finite numbers.
    pub fn reach(&mut self, p_in_world: &Vector3<f64>) -> Result<Reach, IkError> {
        self.reach_target(Target::Position(*p_in_world))
    }

    /// The branches that reach `target`, which is of the finder's kind, within the limits of the joints; with 16 of them there may be more.
    ///
    /// # Errors
    /// [`IkError`] for a target of another kind or without finite numbers.
    pub fn reach_target(&mut self, target: Target) -> Result<Reach, IkError> {
        self.stubborn.set_target(0, target)?;
        self.solved += 1;
        let first = self.stubborn.solve(self.start_q)?;
        if !first.reached {
            return Ok(Reach::Not {
                residual_m: first.residual_m,
                residual_rad: first.residual_rad,
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
            self.solved += 1;
            match self.near.solve(&from) {
                Ok(answer) if answer.reached => {
                    let q = self.unwound(answer.q);
                    if !branches.iter().any(|known| self.same(known, &q)) {
                        branches.push(q);
                    }
                }
                // skip a start whose loops cannot be closed
                Ok(_) | Err(IkError::Loops(_)) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(Reach::In(branches))
    }

    /// The configuration near `q` that brings the TCP to `p_in_world`.
    ///
    /// The inner result is the residual \[m\] if there is none.
    ///
    /// # Errors
    /// [`IkError`] for a point without finite numbers.
    pub fn follow(
        &mut self,
        q: &[f64],
        p_in_world: &Vector3<f64>,
    ) -> Result<Result<Vec<f64>, f64>, IkError> {
        self.near.set_target(0, Target::Position(*p_in_world))?;
        self.solved += 1;
        match self.near.solve(q) {
            Ok(answer) if answer.reached => Ok(Ok(answer.q)),
            Ok(answer) => Ok(Err(answer.residual_m)),
            Err(error) => Err(error),
        }
    }

    /// Whether entry `entry` of `q` is of a revolute joint.
    pub(crate) fn turns(&self, entry: usize) -> bool {
        self.ranges[entry].turns
    }

    /// `q` moved by full turns to be near the start.
    fn unwound(&self, mut q: Vec<f64>) -> Vec<f64> {
        // with closed loops, one turn further may be on another branch
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
