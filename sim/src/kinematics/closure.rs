//! Closed loops: how far they are from closed, the positions that close them, and the velocities they allow.
//!
//! A loop keeps two frames together. With `d` the way from the first origin to the second, its conditions are `d = 0` in the axes
//! of the first frame, and for a hinge also `z2·x1 = 0` and `z2·y1 = 0`. A planar loop in space has conditions that say nothing
//! new; they are carried along and dropped by rank.
//!
//! Independent joints are chosen by the description (`passive` marks the others) or, where it is silent, by rank: the later joint
//! of a loop is dependent. Dependent positions are followed from [`Robot::home`] in small steps along the tangent, so that a
//! mechanism stays on its branch, also through a flat position it can pass; nothing here guesses a branch.
//!
//! Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), ch. 8; redundant conditions by column-pivoted QR.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::body_motion::BodyMotions;
use crate::model::robot::{Loop, LoopKind, Robot};

/// A position counts as closed below this gap \[m\], and angle \[rad\].
pub const CLOSED: f64 = 1e-10;

/// Greatest step of an independent joint while its loop is followed \[rad or m\].
const FOLLOW_STEP: f64 = 0.05;

/// Loops are followed no further from where they start: 100 turns \[rad or m\].
const FURTHEST: f64 = 630.0;

/// Halvings of a step before a way is given up.
const HALVINGS: u32 = 12;

/// Newton steps for one position; it converges quadratically or not at all.
const NEWTON_STEPS: usize = 30;

/// Dependent joints do not follow from the others where the weakest of their motions is this part of the strongest: accelerations
/// would lose all digits soon after.
const DETERMINED: f64 = 1e-5;

/// Steps of the search for the least gap; it serves a message only.
const NEAREST_STEPS: usize = 200;

/// A gap that this search brings below this is none: it converges slowly where loops just touch \[m or rad\].
const ONCE_CLOSED: f64 = 1e-8;

/// Columns weaker than this part of the strongest have no say.
const RANK_TOLERANCE: f64 = 1e-9;

/// Why loops cannot be closed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// No position of the dependent joints closes the loops.
    #[error("the loop cannot be closed: {} is left", left(*gap_m, *angle_rad))]
    Open {
        /// Largest distance left \[m\].
        gap_m: f64,
        /// Largest angle left between axes \[rad\].
        angle_rad: f64,
    },
    /// More or fewer joints are passive than the loops determine.
    #[error("{passive} joints are passive, but the loops determine {determined}")]
    PassiveCount {
        /// Joints marked passive.
        passive: usize,
        /// Joints the loops determine at that position.
        determined: usize,
    },
    /// The loops close there, but not on the straight way from home.
    #[error(
        "the loops close there, but open on the straight way from home: it lies on another branch"
    )]
    Apart,
    /// The position is too far from home to be followed in small steps.
    #[error("a joint is {far:?} from home: loops are followed up to {FURTHEST} rad or m")]
    TooFar {
        /// The farthest way asked for \[rad or m\].
        far: f64,
    },
    /// The passive joints do not follow from the others at that position.
    #[error("the loops do not determine the dependent joints at this position (it is singular)")]
    Singular,
}

/// A gap and an angle in words, what is zero left out.
fn left(gap_m: f64, angle_rad: f64) -> String {
    let mut parts = Vec::new();
    if gap_m > CLOSED {
        parts.push(format!("a gap of {gap_m:.3e} m"));
    }
    if angle_rad > CLOSED {
        parts.push(format!("an angle of {angle_rad:.3e} rad"));
    }
    parts.join(" and ")
}

impl LoopError {
    /// What to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Open { .. } => {
                "check the two frames and the lengths; give passive joints a `guess` near the closed position"
            }
            Self::PassiveCount { .. } => {
                "mark as `passive` all joints of the loop that have no drive; if it is flat at home, give them another `guess`"
            }
            Self::Apart => "give the joints a `guess` on that branch",
            Self::TooFar { .. } => "take whole turns off the angles",
            Self::Singular => {
                "give the joints a `guess` away from flat positions, or mark other joints `passive`"
            }
        }
    }
}

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
            // too few marked joints cannot close what all could
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

fn rank(matrix: &DMatrix<f64>) -> usize {
    rank_within(matrix, RANK_TOLERANCE)
}

fn rank_within(matrix: &DMatrix<f64>, tolerance: f64) -> usize {
    if matrix.ncols() == 0 || matrix.nrows() == 0 {
        return 0;
    }
    let r = matrix.clone().col_piv_qr().r();
    let strongest = r[(0, 0)].abs();
    (0..r.nrows().min(r.ncols()))
        .filter(|&i| r[(i, i)].abs() > tolerance * strongest.max(f64::MIN_POSITIVE))
        .count()
}

/// The smallest `x` or near it that brings `a x` nearest to `b`; directions without a say stay zero.
pub(crate) fn least_squares(a: DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let (rows, columns) = a.shape();
    let qr = a.col_piv_qr();
    let r = qr.r();
    let mut rotated = b.clone();
    qr.q_tr_mul(&mut rotated);
    let strongest = if r.is_empty() { 0.0 } else { r[(0, 0)].abs() };
    let rank = (0..rows.min(columns))
        .take_while(|&i| r[(i, i)].abs() > RANK_TOLERANCE * strongest)
        .count();
    let mut x = DVector::zeros(columns);
    for i in (0..rank).rev() {
        let mut sum = rotated[i];
        for j in i + 1..rank {
            sum -= r[(i, j)] * x[j];
        }
        x[i] = sum / r[(i, i)];
    }
    qr.p().inv_permute_rows(&mut x);
    x
}

/// The conditions of all loops of one robot at one state.
#[derive(Debug, Clone)]
pub(crate) struct Closure {
    motions: BodyMotions,
    /// What each condition is off by \[m, then 1\].
    pub(crate) residual: DVector<f64>,
    /// Slope of the conditions, shape (conditions, n).
    pub(crate) jacobian: DMatrix<f64>,
    /// Their second time derivative at `qdd = 0`.
    pub(crate) bias: DVector<f64>,
}

impl Closure {
    pub(crate) fn new(robot: &Robot) -> Self {
        let rows = robot.loops().iter().map(|l| l.kind.conditions()).sum();
        Self {
            motions: BodyMotions::new(robot),
            residual: DVector::zeros(rows),
            jacobian: DMatrix::zeros(rows, robot.n()),
            bias: DVector::zeros(rows),
        }
    }

    /// Evaluates all conditions at `(q, qd)`.
    pub(crate) fn update(&mut self, robot: &Robot, q: &[f64], qd: &[f64]) {
        self.motions.update(robot, q, qd);
        self.jacobian.fill(0.0);
        let mut row = 0;
        for closing in robot.loops() {
            self.one(robot, closing, row);
            row += closing.kind.conditions();
        }
    }

    fn one(&mut self, robot: &Robot, closing: &Loop, row: usize) {
        let sides = [0, 1].map(|i| {
            let end = &closing.ends[i];
            let motion = self.motions.of(end);
            let r = motion.placed.world_from_body * end.body_from_here.translation.vector;
            let axes: Matrix3<f64> =
                motion.placed.world_from_body * end.body_from_here.rotation.matrix();
            (motion, motion.at(&r), axes)
        });
        let [(m1, p1, r1), (m2, p2, r2)] = &sides;
        let (d, dd, ddd) = (
            p2.position - p1.position,
            p2.velocity - p1.velocity,
            p2.acceleration - p1.acceleration,
        );
        let seen = |v: Vector3<f64>| r1.tr_mul(&v);
        self.residual.fixed_rows_mut::<3>(row).copy_from(&seen(d));
        let curved = ddd - m1.w.cross(&dd) * 2.0 - m1.dw.cross(&d) + m1.w.cross(&m1.w.cross(&d));
        self.bias.fixed_rows_mut::<3>(row).copy_from(&seen(curved));
        let z2 = r2.column(2).into_owned();
        let hinge = closing.kind == LoopKind::Revolute;
        if hinge {
            let spin = |m: &super::body_motion::Motion, u: &Vector3<f64>| {
                (m.w.cross(u), m.dw.cross(u) + m.w.cross(&m.w.cross(u)))
            };
            let (dz, ddz) = spin(m2, &z2);
            for k in 0..2 {
                let u = r1.column(k).into_owned();
                let (du, ddu) = spin(m1, &u);
                self.residual[row + 3 + k] = z2.dot(&u);
                self.bias[row + 3 + k] = ddz.dot(&u) + 2.0 * dz.dot(&du) + z2.dot(&ddu);
            }
        }
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let mut next = closing.ends[side].body;
            while let Some(i) = next {
                let body = &robot.bodies()[i];
                let placed = &self.motions.body(i).placed;
                let axis = placed.axis() * (body.gear * sign);
                // turning the first frame also turns the axes that the way is seen in: both sides meet in the second point
                let column = if body.turns {
                    axis.cross(&(p2.position - placed.position))
                } else {
                    axis
                };
                let mut linear = self.jacobian.fixed_view_mut::<3, 1>(row, body.q_index);
                linear += r1.tr_mul(&column);
                if hinge && body.turns {
                    for k in 0..2 {
                        let u = r1.column(k).into_owned();
                        self.jacobian[(row + 3 + k, body.q_index)] += axis.dot(&z2.cross(&u));
                    }
                }
                next = body.parent;
            }
        }
    }

    fn columns(&self, which: &[usize]) -> DMatrix<f64> {
        self.jacobian.select_columns(which)
    }

    /// The largest gap \[m\] and angle \[rad\] of any loop; infinite where an axis points the wrong way.
    fn errors(&self, robot: &Robot) -> (f64, f64) {
        let (mut gap, mut angle, mut row) = (0.0_f64, 0.0_f64, 0);
        for closing in robot.loops() {
            gap = gap.max(self.residual.fixed_rows::<3>(row).norm());
            if closing.kind == LoopKind::Revolute {
                angle = angle.max(self.residual.fixed_rows::<2>(row + 3).norm());
                let [z1, z2] = [0, 1].map(|i| {
                    let end = &closing.ends[i];
                    let axes = self.motions.of(end).placed.world_from_body
                        * end.body_from_here.rotation.matrix();
                    axes.column(2).into_owned()
                });
                if z1.dot(&z2) < 0.0 {
                    angle = std::f64::consts::PI;
                }
            }
            row += closing.kind.conditions();
        }
        (gap, angle)
    }

    /// The largest gap of any loop at `q` \[m\].
    pub(crate) fn gap_m(&mut self, robot: &Robot, q: &[f64]) -> f64 {
        self.update(robot, q, &vec![0.0; robot.n()]);
        self.errors(robot).0
    }

    /// Closes all loops by the joints `free` alone, starting from `q`.
    pub(crate) fn newton(
        &mut self,
        robot: &Robot,
        free: &[usize],
        q: &mut [f64],
    ) -> Result<(), LoopError> {
        let still = vec![0.0; robot.n()];
        let mut before = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            self.update(robot, q, &still);
            let (gap_m, angle_rad) = self.errors(robot);
            let worst = gap_m.max(angle_rad);
            // on to rounding: the next step would not help
            if worst <= CLOSED && (worst <= 1e-15 || worst >= 0.5 * before) {
                return Ok(());
            }
            before = worst;
            let step = least_squares(self.columns(free), &self.residual);
            // far off, a full step may leave for another branch
            let scale = (0.5 / step.amax()).min(1.0);
            if !scale.is_finite() && step.amax() != 0.0 {
                break;
            }
            for (&i, change) in free.iter().zip(step.iter()) {
                q[i] -= scale.min(1.0) * change;
            }
        }
        self.update(robot, q, &still);
        let (gap_m, angle_rad) = self.errors(robot);
        if gap_m <= CLOSED && angle_rad <= CLOSED {
            Ok(())
        } else {
            Err(LoopError::Open { gap_m, angle_rad })
        }
    }

    /// Brings the loops as near to closed as the joints `free` can, from `q`; returns the gap \[m\] and the angle \[rad\] left there.
    ///
    /// Source: Levenberg and Marquardt's damping, raised until a step lessens the conditions' squares.
    fn nearest(&mut self, robot: &Robot, free: &[usize], q: &mut [f64]) -> (f64, f64) {
        let still = vec![0.0; robot.n()];
        self.update(robot, q, &still);
        let (mut left, mut damping) = (self.residual.norm_squared(), 1e-3);
        let mut trial = q.to_vec();
        for _ in 0..NEAREST_STEPS {
            let columns = self.columns(free);
            let k = free.len();
            let normal = DMatrix::from_fn(k, k, |i, j| {
                let along = columns.column(i).dot(&columns.column(j));
                if i == j { along + damping } else { along }
            });
            let slope = DVector::from_fn(k, |i, _| columns.column(i).dot(&self.residual));
            let Some(factor) = normal.cholesky() else {
                break;
            };
            let step = factor.solve(&slope);
            trial.copy_from_slice(q);
            for (&i, change) in free.iter().zip(step.iter()) {
                trial[i] -= change;
            }
            self.update(robot, &trial, &still);
            let then = self.residual.norm_squared();
            if then < left {
                q.copy_from_slice(&trial);
                (left, damping) = (then, 0.2 * damping);
            } else {
                damping *= 5.0;
                self.update(robot, q, &still);
            }
        }
        self.errors(robot)
    }

    /// Follows the loops from the closed position `q` to the independent positions `target`, shape `(independent)`; `q` is then
    /// the closed position there.
    pub(crate) fn follow(
        &mut self,
        robot: &Robot,
        target: &[f64],
        q: &mut [f64],
    ) -> Result<(), LoopError> {
        let independent = robot.independent();
        let start: Vec<f64> = independent.iter().map(|&i| q[i]).collect();
        let far = start
            .iter()
            .zip(target)
            .map(|(a, b)| (b - a).abs())
            .fold(0.0, |far: f64, way| if way <= far { far } else { way });
        if far.is_nan() || far > FURTHEST {
            return Err(LoopError::TooFar { far });
        }
        let longest = 1.0 / (far / FOLLOW_STEP).ceil().max(1.0);
        // halved so often, the way is at its end: what is done then no longer grows
        let shortest = longest / f64::from(1_u32 << HALVINGS);
        let (mut done, mut step) = (0.0_f64, longest);
        let mut trial = q.to_vec();
        while done < 1.0 {
            let next = (done + step).min(1.0);
            let tangent = self.tangent(robot, q, &start, target);
            trial.copy_from_slice(q);
            for (k, &i) in independent.iter().enumerate() {
                trial[i] = if next >= 1.0 {
                    target[k]
                } else {
                    start[k] + next * (target[k] - start[k])
                };
            }
            for (&i, slope) in robot.dependent().iter().zip(tangent.iter()) {
                trial[i] += (next - done) * slope;
            }
            let predicted = trial.clone();
            let closed = self.newton(robot, robot.dependent(), &mut trial);
            // a correction as large as the step itself has left the branch
            let corrected = (0..q.len())
                .map(|i| (trial[i] - predicted[i]).abs())
                .fold(0.0, f64::max);
            let moved = FOLLOW_STEP.max(
                (0..q.len())
                    .map(|i| (predicted[i] - q[i]).abs())
                    .fold(0.0, f64::max),
            );
            if closed.is_ok() && corrected <= 0.5 * moved {
                q.copy_from_slice(&trial);
                done = next;
                step = (2.0 * step).min(longest);
            } else {
                step *= 0.5;
                if step < shortest {
                    return Err(self.blocked(robot, target, q));
                }
            }
        }
        Ok(())
    }

    /// Why `target` was not reached from the last closed position `q` on the way there.
    fn blocked(&mut self, robot: &Robot, target: &[f64], q: &[f64]) -> LoopError {
        let mut least = (f64::INFINITY, f64::INFINITY);
        // by the dependent joints as they are, or as they are at home
        for from in [q, robot.home()] {
            let mut there = from.to_vec();
            for (&i, position) in robot.independent().iter().zip(target) {
                there[i] = *position;
            }
            let left = self.nearest(robot, robot.dependent(), &mut there);
            if left.0.max(left.1) < least.0.max(least.1) {
                least = left;
            }
        }
        let (gap_m, angle_rad) = least;
        if gap_m.max(angle_rad) <= ONCE_CLOSED {
            LoopError::Apart
        } else {
            LoopError::Open { gap_m, angle_rad }
        }
    }

    /// Rates of the dependent joints while the independent ones go from `start` to `target` in unit time.
    fn tangent(&mut self, robot: &Robot, q: &[f64], start: &[f64], target: &[f64]) -> DVector<f64> {
        let mut qd = vec![0.0; robot.n()];
        for (k, &i) in robot.independent().iter().enumerate() {
            qd[i] = target[k] - start[k];
        }
        self.update(robot, q, &vec![0.0; robot.n()]);
        let pull = &self.jacobian * DVector::from_vec(qd);
        -least_squares(self.columns(robot.dependent()), &pull)
    }

    /// Sets the dependent entries of `rates` to what the independent ones and `given` cause: `J rates + given = 0`, at the state
    /// of the last update. Exact where the loops determine the dependent joints.
    ///
    /// # Errors
    /// [`LoopError::Singular`] where they do not.
    pub(crate) fn complete(
        &self,
        robot: &Robot,
        given: Option<&DVector<f64>>,
        rates: &mut [f64],
    ) -> Result<(), LoopError> {
        let dependent = robot.dependent();
        for &i in dependent {
            rates[i] = 0.0;
        }
        let mut pull = &self.jacobian * DVector::from_column_slice(rates);
        if let Some(given) = given {
            pull += given;
        }
        let columns = self.columns(dependent);
        if rank_within(&columns, DETERMINED) < dependent.len() {
            return Err(LoopError::Singular);
        }
        let rest = least_squares(columns, &pull);
        for (&i, value) in dependent.iter().zip(rest.iter()) {
            rates[i] = -value;
        }
        Ok(())
    }
}

/// The whole of `q`, shape `(n)`, that closes the loops of `robot` at the independent positions, followed from [`Robot::home`];
/// `independent` itself where there are no loops.
///
/// # Errors
/// [`LoopError::Open`] where the mechanism does not reach that far, [`LoopError::Singular`] where it stands flat,
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

/// The largest gap of any loop of `robot` at `q`, shape `(n)` \[m\]; zero where there are no loops.
pub fn loop_gap_m(robot: &Robot, q: &[f64]) -> f64 {
    if robot.loops().is_empty() {
        return 0.0;
    }
    Closure::new(robot).gap_m(robot, q)
}

/// All joint velocities, shape `(n)`, that keep the loops closed while the independent joints move at `independent`; `q` is the
/// closed position, shape `(n)`.
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
/// and `qd` are the closed position and its velocity, shape `(n)`.
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

/// How all joints move per unit of each independent one, shape `(n, independent)`, at the closed position `q`, shape `(n)`: the
/// identity where there are no loops.
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

/// Values of the independent joints at their places in `q`, zeros elsewhere.
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
