//! How near the arm is to a singular configuration, in which its TCP cannot move in some direction.

use super::event::EventKind;
use crate::kinematics::chain::Chain;
use crate::kinematics::manipulability::{LINEAR, Manipulability, TWIST};
use crate::run::{Row, Setup};

/// Condition number of the Jacobian from which a configuration counts as near-singular.
const NEAR: f64 = 50.0;
/// Condition number below which it no longer does: the hysteresis avoids repeated events at the border.
const CLEAR: f64 = 40.0;

#[derive(Debug, Clone)]
pub(super) struct SingularityWatch {
    /// None for robots with loops or mimic joints, whose rates depend on each other, and with fewer than two joints.
    chain: Option<Chain>,
    near: bool,
}

impl SingularityWatch {
    pub(super) fn new(setup: &Setup<'_>) -> Self {
        let chain = setup
            .robot
            .is_plain_tree()
            .then(|| Chain::new(setup.robot, setup.tcp))
            .filter(|chain| chain.joints().len() > 1);
        Self { chain, near: false }
    }

    /// With fewer than six joints only the linear rows of the Jacobian count; otherwise all rows, the angular ones scaled by the arm's
    /// length.
    pub(super) fn observe(&mut self, row: &Row<'_>, emit: &mut impl FnMut(u64, EventKind)) {
        let Some(chain) = &mut self.chain else {
            return;
        };
        chain.update(row.q);
        let mut jacobian = chain.jacobian_matrix();
        let whole = chain.joints().len() >= 6;
        if whole {
            let length_m = chain.length_m();
            for mut column in jacobian.column_iter_mut() {
                for row in 3..6 {
                    column[row] *= length_m;
                }
            }
        }
        let rows = if whole { TWIST } else { LINEAR };
        let condition = Manipulability::of(&jacobian, rows)
            .condition()
            .unwrap_or(f64::INFINITY);
        if !self.near && condition >= NEAR {
            emit(row.tick, EventKind::NearSingular);
            self.near = true;
        } else if condition < CLEAR {
            self.near = false;
        }
    }
}
