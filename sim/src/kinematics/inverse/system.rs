//! All targets of one solve as one system: errors and Jacobians of several frames stacked over the joints that may move.

use nalgebra::{Vector3, Vector6};

use super::mechanism::Mechanism;
use super::target::{PoseError, Target};
use super::{ErrorClamp, Goal};
use crate::kinematics::chain::Chain;
use crate::kinematics::closure::LoopError;
use crate::kinematics::position_range::PositionRange;
use crate::model::robot::Robot;
use crate::spatial::Pose;

/// Lower bound of the length that scales errors \[m\], for chains of no length.
const SHORTEST_M: f64 = 1e-3;

#[derive(Debug, Clone)]
struct Task {
    chain: Chain,
    target: Target,
    weight: f64,
    /// Index of its first row.
    first: usize,
    pose: Pose,
}

impl Task {
    fn rows(&self) -> usize {
        let (position, rotation) = self.target.asks();
        3 * (usize::from(position) + usize::from(rotation))
    }
}

/// The residual of all frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Residual {
    /// The largest distance \[m\].
    pub(super) distance_m: f64,
    /// The largest angle \[rad\].
    pub(super) angle_rad: f64,
    /// Half the square of the weighted error, which the solver minimizes.
    pub(super) objective: f64,
}

impl Residual {
    pub(super) fn within(&self, tolerance_m: f64, tolerance_rad: f64) -> bool {
        self.distance_m <= tolerance_m
            && self.angle_rad <= tolerance_rad
            && self.objective.is_finite()
    }
}

/// The stacked targets over the unknowns.
#[derive(Debug, Clone)]
pub(super) struct System<'r> {
    pub(super) robot: &'r Robot,
    tasks: Vec<Task>,
    /// Entries of `q` that the solver moves.
    pub(super) unknowns: Vec<usize>,
    rows: usize,
    /// The weighted error, clamped if the settings say so.
    pub(super) error: Vec<f64>,
    /// Its Jacobian, column by column.
    pub(super) jacobian: Vec<f64>,
    /// Weight of a metre relative to a radian.
    per_metre: f64,
    clamp: Option<ErrorClamp>,
    mechanism: Option<Mechanism>,
}

impl<'r> System<'r> {
    /// Stacks `goals` over the entries `joints` of `q`, or over all that move one of their frames. Dependent joints of loops are
    /// never unknowns. With `balanced`, an error of one chain length has the weight of one radian; else one metre has.
    pub(super) fn new(
        robot: &'r Robot,
        goals: &[Goal<'_>],
        joints: Option<&[usize]>,
        clamp: Option<ErrorClamp>,
        balanced: bool,
    ) -> Self {
        let looped = !robot.loops().is_empty();
        let mut unknowns = match joints {
            Some(joints) => joints.to_vec(),
            None if looped => robot.independent().to_vec(),
            None => {
                let chains = goals.iter().map(|goal| Chain::new(robot, goal.frame));
                chains.flat_map(|chain| chain.joints().to_vec()).collect()
            }
        };
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns.retain(|i| robot.independent().contains(i));
        let all: Vec<usize> = (0..robot.n()).collect();
        let columns = if looped { &all } else { &unknowns };
        let mut first = 0;
        let mut length_m = SHORTEST_M;
        let tasks: Vec<Task> = goals
            .iter()
            .map(|goal| {
                let chain = Chain::with_joints(robot, goal.frame, columns);
                length_m = chain.length_m().max(length_m);
                let task = Task {
                    chain,
                    target: goal.target,
                    weight: goal.weight,
                    first,
                    pose: Pose::identity(),
                };
                first += task.rows();
                task
            })
            .collect();
        Self {
            robot,
            error: vec![0.0; first],
            jacobian: vec![0.0; first * unknowns.len()],
            rows: first,
            per_metre: if balanced { 1.0 / length_m } else { 1.0 },
            mechanism: looped.then(|| Mechanism::new(robot, unknowns.len())),
            tasks,
            unknowns,
            clamp,
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Sets another target, of the same kind, of goal `index`.
    pub(super) fn set_target(&mut self, index: usize, target: Target) -> bool {
        let task = &mut self.tasks[index];
        let same = task.target.asks() == target.asks();
        if same {
            task.target = target;
        }
        same
    }

    /// Closes the robot's loops at `q`, if it has any.
    pub(super) fn close(&mut self, q: &mut [f64]) -> Result<(), LoopError> {
        match &mut self.mechanism {
            Some(mechanism) => mechanism.close(self.robot, q),
            None => Ok(()),
        }
    }

    /// Moves all chains to `q` and computes the error there.
    pub(super) fn place(&mut self, q: &[f64]) -> Residual {
        let mut residual = Residual {
            distance_m: 0.0,
            angle_rad: 0.0,
            objective: 0.0,
        };
        for task in &mut self.tasks {
            task.pose = task.chain.update(q);
            let PoseError {
                mut linear,
                mut angular,
            } = task.target.error(&task.pose);
            let (position, rotation) = task.target.asks();
            let mut row = task.first;
            if position {
                let distance_m = length(&linear);
                residual.distance_m = residual.distance_m.max(distance_m);
                let weight = task.weight * self.per_metre;
                residual.objective += 0.5 * (weight * distance_m) * (weight * distance_m);
                if let Some(clamp) = &self.clamp {
                    linear = shortened(linear, distance_m, clamp.distance_m);
                }
                for (to, from) in self.error[row..row + 3].iter_mut().zip(linear.iter()) {
                    *to = weight * from;
                }
                row += 3;
            }
            if rotation {
                let angle_rad = length(&angular);
                residual.angle_rad = residual.angle_rad.max(angle_rad);
                let weighted = task.weight * angle_rad;
                residual.objective += 0.5 * weighted * weighted;
                if let Some(clamp) = &self.clamp {
                    angular = shortened(angular, angle_rad, clamp.angle_rad);
                }
                for (to, from) in self.error[row..row + 3].iter_mut().zip(angular.iter()) {
                    *to = task.weight * from;
                }
            }
        }
        residual
    }

    /// Computes the Jacobian of the error at the `q` of the last [`System::place`].
    ///
    /// # Errors
    /// [`LoopError::Singular`] where the loops do not determine the dependent joints.
    pub(super) fn differentiate(&mut self, q: &[f64]) -> Result<(), LoopError> {
        if let Some(mechanism) = &mut self.mechanism {
            mechanism.differentiate(self.robot, &self.unknowns, q)?;
        }
        let rows = self.rows;
        for task in &mut self.tasks {
            let (position, rotation) = task.target.asks();
            let weight = task.weight;
            let weight_linear = weight * self.per_metre;
            let free_axis = task.target.free_axis(&task.pose);
            let columns = task.chain.jacobian();
            for k in 0..self.unknowns.len() {
                let column: Vector6<f64> = match &self.mechanism {
                    None => columns[k],
                    Some(mechanism) => {
                        let rates = mechanism.tangent(k);
                        let moved = columns.iter().zip(rates).map(|(c, rate)| c * *rate);
                        moved.fold(Vector6::zeros(), |sum, c| sum + c)
                    }
                };
                let mut row = k * rows + task.first;
                if position {
                    for i in 0..3 {
                        self.jacobian[row + i] = weight_linear * column[i];
                    }
                    row += 3;
                }
                if rotation {
                    let mut turn = Vector3::new(column[3], column[4], column[5]);
                    if let Some(axis) = &free_axis {
                        turn -= axis * axis.dot(&turn);
                    }
                    for i in 0..3 {
                        self.jacobian[row + i] = weight * turn[i];
                    }
                }
            }
        }
        Ok(())
    }

    /// Moves `q` by `step` of the unknowns; dependent joints follow, as far as loops and `limits` allow. False if they allow no motion.
    pub(super) fn advance(
        &mut self,
        step: &[f64],
        limits: Option<&[PositionRange]>,
        q: &mut [f64],
    ) -> bool {
        match &mut self.mechanism {
            None => {
                for (&i, step) in self.unknowns.iter().zip(step) {
                    q[i] += step;
                    if let Some(limits) = limits {
                        // a step to the bound may round to beyond it
                        q[i] = limits[i].clamp(q[i]);
                    }
                }
                true
            }
            Some(mechanism) => mechanism.advance(self.robot, &self.unknowns, step, limits, q),
        }
    }
}

/// The length of `v`, correct even if its square overflows.
fn length(v: &Vector3<f64>) -> f64 {
    let length = v.norm();
    if length.is_finite() {
        return length;
    }
    let largest = v.amax();
    largest * (v / largest).norm()
}

/// `v`, which has the length `length`, shortened to at most `longest`.
fn shortened(v: Vector3<f64>, length: f64, longest: f64) -> Vector3<f64> {
    if length > longest {
        v * (longest / length)
    } else {
        v
    }
}
