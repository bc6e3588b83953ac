//! Loop closure: the residual of closed loops, the configurations that close them, and the joint velocities they allow.
//!
//! A loop keeps two frames together. With `d` the vector from the first origin to the second, its constraints are `d = 0` in the axes
//! of the first frame, and for a hinge also `z2·x1 = 0` and `z2·y1 = 0`. A planar loop in space has redundant constraints; they are
//! kept and dropped by rank.
//!
//! Independent joints are chosen by the description (`passive` marks the others) or else by rank: the later joint of a loop is
//! dependent. Dependent positions are followed from [`Robot::home`] in small steps along the tangent, so that a mechanism stays on its
//! branch, also through a flat configuration that it can pass; nothing here guesses a branch.
//!
//! Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), ch. 8; redundant constraints by column-pivoted QR.

mod constraints;
mod dependent_joints;
mod following;
mod least_squares;
mod loop_error;

use nalgebra::DMatrix;

pub(crate) use self::constraints::Closure;
pub(crate) use self::dependent_joints::{Dependents, dependents};
pub use self::loop_error::LoopError;
use crate::model::robot::Robot;

/// A configuration counts as closed below this gap \[m\] and angle \[rad\].
pub const CLOSED: f64 = 1e-10;

/// The whole of `q`, shape `(n)`, that closes the loops of `robot` at the independent positions, followed from [`Robot::home`];
/// `independent` itself without loops.
///
/// # Errors
/// [`LoopError::Open`] if the mechanism cannot reach these positions, [`LoopError::Singular`] in a flat configuration,
/// [`LoopError::TooFar`] beyond 630 rad or m.
///
/// # Panics
/// If `independent` has another length than [`Robot::independent`].
pub fn closed_positions(robot: &Robot, independent: &[f64]) -> Result<Vec<f64>, LoopError> {
    assert_eq!(
        independent.len(),
        robot.independent().len(),
        "one position per independent joint"
    );
    let mut q = robot.home().to_vec();
    if robot.loops().is_empty() {
        return Ok(independent.to_vec());
    }
    Closure::new(robot).follow(robot, independent, &mut q)?;
    Ok(q)
}

/// The largest gap of any loop of `robot` at `q`, shape `(n)` \[m\]; zero without loops.
pub fn loop_gap_m(robot: &Robot, q: &[f64]) -> f64 {
    if robot.loops().is_empty() {
        return 0.0;
    }
    Closure::new(robot).gap_m(robot, q)
}

/// All joint velocities, shape `(n)`, that keep the loops closed while the independent joints move at `independent`; `q` is the
/// closed configuration, shape `(n)`.
///
/// # Errors
/// [`LoopError::Singular`] where the loops do not determine the dependent joints.
///
/// # Panics
/// If a slice has another length than stated.
pub fn closed_velocities(
    robot: &Robot,
    q: &[f64],
    independent: &[f64],
) -> Result<Vec<f64>, LoopError> {
    let mut rates = spread(robot, independent);
    if !robot.loops().is_empty() {
        let mut closure = Closure::new(robot);
        closure.update(robot, q, &rates);
        closure.complete(robot, None, &mut rates)?;
    }
    Ok(rates)
}

/// All joint accelerations, shape `(n)`, that keep the loops closed while the independent joints accelerate at `independent`; `q`
/// and `qd` are the closed configuration and its velocity, shape `(n)`.
///
/// # Errors
/// [`LoopError::Singular`] where the loops do not determine the dependent joints.
///
/// # Panics
/// If a slice has another length than stated.
pub fn closed_accelerations(
    robot: &Robot,
    q: &[f64],
    qd: &[f64],
    independent: &[f64],
) -> Result<Vec<f64>, LoopError> {
    let mut accelerations = spread(robot, independent);
    if !robot.loops().is_empty() {
        let mut closure = Closure::new(robot);
        closure.update(robot, q, qd);
        let bias = closure.bias.clone();
        closure.complete(robot, Some(&bias), &mut accelerations)?;
    }
    Ok(accelerations)
}

/// Rates of all joints per unit rate of each independent one, shape `(n, independent)`, in the closed configuration `q`, shape `(n)`:
/// the identity without loops.
///
/// # Errors
/// [`LoopError::Singular`] where the loops do not determine the dependent joints.
///
/// # Panics
/// If `q` has another length than [`Robot::n`].
pub fn independent_motions(robot: &Robot, q: &[f64]) -> Result<DMatrix<f64>, LoopError> {
    let (n, k) = (robot.n(), robot.independent().len());
    let mut motions = DMatrix::zeros(n, k);
    let mut closure = Closure::new(robot);
    closure.update(robot, q, &vec![0.0; n]);
    for (mut column, &i) in motions.column_iter_mut().zip(robot.independent()) {
        let mut rates = vec![0.0; n];
        rates[i] = 1.0;
        if !robot.loops().is_empty() {
            closure.complete(robot, None, &mut rates)?;
        }
        column.copy_from_slice(&rates);
    }
    Ok(motions)
}

/// Values of the independent joints at their entries of `q`, zeros elsewhere.
fn spread(robot: &Robot, independent: &[f64]) -> Vec<f64> {
    assert_eq!(
        independent.len(),
        robot.independent().len(),
        "one value per independent joint"
    );
    let mut all = vec![0.0; robot.n()];
    for (&i, value) in robot.independent().iter().zip(independent) {
        all[i] = *value;
    }
    all
}
