//! Robots with loops: the unknowns are the independent joints, and the dependent ones follow so that every iterate is closed.

use crate::kinematics::closure::{CLOSED, Closure, LoopError};
use crate::kinematics::position_range::PositionRange;
use crate::model::robot::Robot;

/// Halvings of a step that the mechanism cannot follow, or that takes a dependent joint beyond its limit.
const HALVINGS: u32 = 20;

/// The closed loops of one robot, and the rates of its joints per unknown.
#[derive(Debug, Clone)]
pub(super) struct Mechanism {
    closure: Closure,
    /// For each unknown, the rates of all joints per unit of its rate.
    tangents: Vec<Vec<f64>>,
    target: Vec<f64>,
    trial: Vec<f64>,
    still: Vec<f64>,
}

impl Mechanism {
    pub(super) fn new(robot: &Robot, unknowns: usize) -> Self {
        Self {
            closure: Closure::new(robot),
            tangents: vec![vec![0.0; robot.n()]; unknowns],
            target: Vec::with_capacity(robot.independent().len()),
            trial: robot.home().to_vec(),
            still: vec![0.0; robot.n()],
        }
    }

    /// Closes the loops of `q` at its own independent positions: on its branch if it is closed already, else from home.
    pub(super) fn close(&mut self, robot: &Robot, q: &mut [f64]) -> Result<(), LoopError> {
        // closed to the rounding of a number in a file
        const NEARLY: f64 = 1e6 * CLOSED;
        if self.closure.gap_m(robot, q) <= NEARLY
            && self.closure.newton(robot, robot.dependent(), q).is_ok()
        {
            return Ok(());
        }
        self.target.clear();
        self.target
            .extend(robot.independent().iter().map(|&i| q[i]));
        self.trial.copy_from_slice(robot.home());
        self.closure.follow(robot, &self.target, &mut self.trial)?;
        q.copy_from_slice(&self.trial);
        Ok(())
    }

    /// Rates of all joints per unit rate of each of the `unknowns`, in the closed configuration `q`.
    pub(super) fn differentiate(
        &mut self,
        robot: &Robot,
        unknowns: &[usize],
        q: &[f64],
    ) -> Result<(), LoopError> {
        self.closure.update(robot, q, &self.still);
        for (&unknown, rates) in unknowns.iter().zip(&mut self.tangents) {
            rates.fill(0.0);
            rates[unknown] = 1.0;
            self.closure.complete(robot, None, rates)?;
        }
        Ok(())
    }

    pub(super) fn tangent(&self, unknown: usize) -> &[f64] {
        &self.tangents[unknown]
    }

    /// Moves the closed configuration `q` by `step` of the `unknowns`, or by as large a part of it as the loops and the dependent
    /// joints' `limits` allow; false if they allow none.
    pub(super) fn advance(
        &mut self,
        robot: &Robot,
        unknowns: &[usize],
        step: &[f64],
        limits: Option<&[PositionRange]>,
        q: &mut [f64],
    ) -> bool {
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            self.trial.copy_from_slice(q);
            for (&unknown, step) in unknowns.iter().zip(step) {
                let position = q[unknown] + part * step;
                self.trial[unknown] =
                    limits.map_or(position, |limits| limits[unknown].clamp(position));
            }
            self.target.clear();
            let trial = &self.trial;
            self.target
                .extend(robot.independent().iter().map(|&i| trial[i]));
            self.trial.copy_from_slice(q);
            let inside = |trial: &[f64]| {
                limits.is_none_or(|limits| {
                    robot.dependent().iter().all(|&i| {
                        // from beyond a limit, motion towards it is allowed
                        limits[i].contains(trial[i])
                            || (trial[i] - limits[i].clamp(trial[i])).abs()
                                <= (q[i] - limits[i].clamp(q[i])).abs()
                    })
                })
            };
            let followed = self.closure.follow(robot, &self.target, &mut self.trial);
            if followed.is_ok() && inside(&self.trial) {
                q.copy_from_slice(&self.trial);
                return true;
            }
            part *= 0.5;
        }
        false
    }
}
