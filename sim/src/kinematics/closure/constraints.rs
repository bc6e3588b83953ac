//! The loop-closure constraints at one state: their residual, Jacobian and bias, and the joint rates that they allow.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::least_squares::{least_squares, rank_within};
use super::loop_error::LoopError;
use crate::kinematics::body_motion::{BodyMotions, Motion};
use crate::model::robot::{Loop, LoopKind, Robot};

/// Below this ratio of the smallest to the largest pivot, the dependent joints do not follow from the others: a little further,
/// accelerations would lose all their digits.
const DETERMINED: f64 = 1e-5;

/// The loop-closure constraints of one robot at one state.
#[derive(Debug, Clone)]
pub(crate) struct Closure {
    motions: BodyMotions,
    /// Residual of each constraint \[m for positions, 1 for directions\].
    pub(crate) residual: DVector<f64>,
    /// Jacobian of the constraints, shape `(constraints, n)`.
    pub(crate) jacobian: DMatrix<f64>,
    /// Their second time derivative at `qdd = 0` (the bias).
    pub(crate) bias: DVector<f64>,
}

impl Closure {
    pub(crate) fn new(robot: &Robot) -> Self {
        let rows = robot
            .loops()
            .iter()
            .map(|l| l.kind.constraint_count())
            .sum();
        Self {
            motions: BodyMotions::new(robot),
            residual: DVector::zeros(rows),
            jacobian: DMatrix::zeros(rows, robot.n()),
            bias: DVector::zeros(rows),
        }
    }

    /// Evaluates all constraints at `(q, qd)`.
    pub(crate) fn update(&mut self, robot: &Robot, q: &[f64], qd: &[f64]) {
        self.motions.update(robot, q, qd);
        self.jacobian.fill(0.0);
        let mut row = 0;
        for closing in robot.loops() {
            self.one(robot, closing, row);
            row += closing.kind.constraint_count();
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
            let spin = |m: &Motion, u: &Vector3<f64>| {
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
                // rotating the first frame also rotates the axes of the residual: so the lever arms of both sides end in the second point
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

    pub(super) fn columns(&self, which: &[usize]) -> DMatrix<f64> {
        self.jacobian.select_columns(which)
    }

    /// The largest gap \[m\] and angle \[rad\] of any loop; infinite where an axis points in the opposite direction.
    pub(super) fn errors(&self, robot: &Robot) -> (f64, f64) {
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
            row += closing.kind.constraint_count();
        }
        (gap, angle)
    }

    /// The largest gap of any loop at `q` \[m\].
    pub(crate) fn gap_m(&mut self, robot: &Robot, q: &[f64]) -> f64 {
        self.update(robot, q, &vec![0.0; robot.n()]);
        self.errors(robot).0
    }

    /// Sets the dependent entries of `rates` from the independent ones and `given`, so that `J rates + given = 0` at the state of the
    /// last update. Exact where the loops determine the dependent joints.
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
