//! The choice of the dependent joints of a robot with loops, if its description does not make it, and its home configuration.

use nalgebra::DVector;

use super::constraints::Closure;
use super::least_squares::{RANK_TOLERANCE, rank};
use super::loop_error::LoopError;
use crate::model::robot::Robot;

/// What [`dependents`] found.
pub(crate) struct Dependents {
    pub(crate) dependent: Vec<usize>,
    pub(crate) home: Vec<f64>,
}

/// Chooses the dependent joints of a robot whose loops are set but not yet closed, and closes them: independent joints at their
/// guess (zero if absent), dependent ones near theirs.
pub(crate) fn dependents(robot: &Robot) -> Result<Dependents, LoopError> {
    let n = robot.n();
    let mut home = robot.home().to_vec();
    let mut closure = Closure::new(robot);
    let marked: Vec<usize> = (0..n)
        .filter(|&i| robot.moving_joints().nth(i).is_some_and(|j| j.passive))
        .collect();
    if !marked.is_empty() {
        if let Err(open) = closure.newton(robot, &marked, &mut home) {
            // with too few passive joints the loops may stay open although all joints together could close them
            let mut all = robot.home().to_vec();
            closure.newton(robot, &(0..n).collect::<Vec<_>>(), &mut all)?;
            closure.update(robot, &all, &vec![0.0; n]);
            let determined = rank(&closure.jacobian);
            return Err(if determined > marked.len() {
                LoopError::PassiveCount {
                    passive: marked.len(),
                    determined,
                }
            } else {
                open
            });
        }
        closure.update(robot, &home, &vec![0.0; n]);
        let determined = rank(&closure.jacobian);
        if determined != marked.len() {
            return Err(LoopError::PassiveCount {
                passive: marked.len(),
                determined,
            });
        }
        if rank(&closure.columns(&marked)) != determined {
            return Err(LoopError::Singular);
        }
        return Ok(Dependents {
            dependent: marked,
            home,
        });
    }
    // close with all joints first, then let the later joints of the loops follow the earlier ones
    closure.newton(robot, &(0..n).collect::<Vec<_>>(), &mut home)?;
    closure.update(robot, &home, &vec![0.0; n]);
    let strongest = closure
        .jacobian
        .column_iter()
        .map(|column| column.norm())
        .fold(0.0, f64::max);
    let (mut dependent, mut basis) = (Vec::new(), Vec::<DVector<f64>>::new());
    for i in (0..n).rev() {
        let mut column = closure.jacobian.column(i).into_owned();
        // twice is enough to be orthogonal to rounding
        for _ in 0..2 {
            for known in &basis {
                let along = known.dot(&column);
                column.axpy(-along, known, 1.0);
            }
        }
        let news = column.norm();
        if news > RANK_TOLERANCE * strongest {
            basis.push(column / news);
            dependent.insert(0, i);
        }
    }
    Ok(Dependents { dependent, home })
}
