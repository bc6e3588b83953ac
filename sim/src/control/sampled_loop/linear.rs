//! Robot and servos near rest at one position as a linear difference equation, in the independent joints.

use nalgebra::{DMatrix, Vector3};

use crate::control::matrix_functions::exponential;
use crate::control::servo::{Derivative, Gains, Mode, ServoSettings};
use crate::dynamics::driven_mass_matrix;
use crate::dynamics::rnea::Rnea;
use crate::joint_space::JointPositions;
use crate::kinematics::closure::{Closure, independent_motions};
use crate::model::robot::Robot;

/// Robots with more independent joints are not analysed: the cost grows with the third power.
const MOST_JOINTS: usize = 40;

/// Half the distance over which gravity's slope is taken \[rad or m\]: truncation O(h²) and round-off O(ε/h) meet near it.
const SLOPE_STEP: f64 = 1e-5;

/// The robot near one position, by its `k` independent joints.
pub(super) struct Linear<'a> {
    settings: &'a ServoSettings,
    /// Rates of all joints per unit rate of each independent one, shape `(n, k)`.
    motions: DMatrix<f64>,
    mass: DMatrix<f64>,
    inverse_mass: DMatrix<f64>,
    /// Which joints have a drive.
    driven: Vec<bool>,
    damping: DMatrix<f64>,
    /// Slope of the gravity efforts.
    stiffness: DMatrix<f64>,
}

impl<'a> Linear<'a> {
    /// `None` as [`super::sampled_loop`] says.
    pub(super) fn new(
        robot: &Robot,
        settings: &'a ServoSettings,
        gravity_m_s2: &Vector3<f64>,
        q: &[f64],
    ) -> Option<Self> {
        let k = robot.independent().len();
        let velocity_of_velocity = settings.derivative == Derivative::Velocity
            && settings.gains.iter().any(|gains| gains.kd != 0.0);
        match settings.mode {
            Mode::Effort | Mode::Prescribed => return None,
            Mode::Velocity if velocity_of_velocity => return None,
            Mode::Velocity | Mode::Position => {}
        }
        if k == 0 || k > MOST_JOINTS || !q.iter().all(|q| q.is_finite()) {
            return None;
        }
        let motions = independent_motions(robot, q).ok()?;
        let mass = driven_mass_matrix(robot, &JointPositions::new(q.iter().copied())).ok()?;
        let inverse_mass = mass.clone().cholesky()?.inverse();
        let mut viscous = vec![0.0; robot.n()];
        for body in robot.bodies() {
            viscous[body.q_index] += body.gear * body.gear * body.damping;
        }
        let stiffness = match settings.mode {
            Mode::Position => gravity_slope(robot, gravity_m_s2, q, &motions)?,
            _ => DMatrix::zeros(k, k),
        };
        Some(Self {
            settings,
            damping: by_independent(&motions, &viscous),
            motions,
            mass,
            inverse_mass,
            driven: robot.moving_joints().map(|joint| !joint.passive).collect(),
            stiffness,
        })
    }

    /// Number of states of the robot itself: `T q̇`, and in position mode also `q`.
    fn moving(&self) -> usize {
        match self.settings.mode {
            Mode::Position => 2 * self.mass.nrows(),
            _ => self.mass.nrows(),
        }
    }

    /// The robot discretized over a period with zero-order hold of the effort; `None` if not finite.
    ///
    /// Time is in units of the period `T`, which keeps all states at a similar scale: the matrix maps `[q, T q̇, τ]` to the next sample,
    /// in velocity mode without `q`.
    pub(super) fn discretize(&self, period_s: f64) -> Option<DiscretePlant> {
        let (k, moving, t) = (self.mass.nrows(), self.moving(), period_s);
        let rate = moving - k;
        let mut flow: DMatrix<f64> = DMatrix::zeros(moving + k, moving + k);
        for i in 0..k {
            for j in 0..k {
                let along = |m: &DMatrix<f64>| -> f64 {
                    (0..k).map(|l| self.inverse_mass[(i, l)] * m[(l, j)]).sum()
                };
                if rate > 0 {
                    flow[(rate + i, j)] = -along(&self.stiffness) * t * t;
                }
                flow[(rate + i, rate + j)] = -along(&self.damping) * t;
                flow[(rate + i, moving + j)] = self.inverse_mass[(i, j)] * t * t;
            }
            if rate > 0 {
                flow[(i, rate + i)] = 1.0;
            }
        }
        Some(DiscretePlant {
            motion: exponential(&flow)?,
            period_s,
        })
    }

    /// The transition matrix of robot and servos from one sample to the next under `gains`; `None` if not finite.
    ///
    /// The state holds those of the robot, then, if used, the previous measurement and the sum of errors, all \[rad or m\].
    pub(super) fn transition(
        &self,
        plant: &DiscretePlant,
        gains: &[Gains],
    ) -> Option<DMatrix<f64>> {
        let DiscretePlant {
            motion,
            period_s: t,
        } = plant;
        let (k, moving) = (self.mass.nrows(), self.moving());
        let reduced = |pick: fn(&Gains) -> f64| {
            let drives = gains.iter().zip(&self.driven);
            let values: Vec<f64> = drives
                .map(|(gains, is_driven)| if *is_driven { pick(gains) } else { 0.0 })
                .collect();
            by_independent(&self.motions, &values)
        };
        let (kp, ki, kd) = (reduced(|g| g.kp), reduced(|g| g.ki), reduced(|g| g.kd));
        let position = self.settings.mode == Mode::Position;
        let differences = self.settings.derivative != Derivative::Velocity
            && self.settings.gains.iter().any(|gains| gains.kd != 0.0);

        // indices in the state; the measurement comes first in both modes, and an unused sum would add an eigenvalue of one
        let (rate, before) = (moving - k, moving);
        let sum = if differences { moving + k } else { moving };
        let summed = |j: &usize| ki.column(*j).iter().any(|x| *x != 0.0);
        let sums: Vec<usize> = (0..k).filter(summed).collect();
        let size = sum + sums.len();

        // effort by state: u = kp e + ki S + kd D with e = -z; velocity mode measures v/T, whose sum over time is that of v
        let (per_error, per_sum) = if position { (1.0, *t) } else { (1.0 / t, 1.0) };
        let mut feedback: DMatrix<f64> = DMatrix::zeros(k, size);
        for i in 0..k {
            for j in 0..k {
                feedback[(i, j)] -= kp[(i, j)] * per_error;
                if differences {
                    let slope = kd[(i, j)] * per_error / t;
                    feedback[(i, j)] -= slope;
                    feedback[(i, before + j)] += slope;
                } else {
                    feedback[(i, rate + j)] -= kd[(i, j)] / t;
                }
                if position && self.settings.gravity_compensation {
                    feedback[(i, j)] += self.stiffness[(i, j)];
                }
            }
            for (s, &j) in sums.iter().enumerate() {
                // the sum that acts is the one with this sample's error in it
                feedback[(i, sum + s)] += ki[(i, j)] * per_sum;
                feedback[(i, j)] -= ki[(i, j)] * per_sum;
            }
        }

        let mut transition: DMatrix<f64> = DMatrix::zeros(size, size);
        for i in 0..moving {
            for j in 0..size {
                let driven: f64 = (0..k)
                    .map(|l| motion[(i, moving + l)] * feedback[(l, j)])
                    .sum();
                let free = if j < moving { motion[(i, j)] } else { 0.0 };
                transition[(i, j)] = free + driven;
            }
        }
        if differences {
            for j in 0..k {
                transition[(before + j, j)] = 1.0;
            }
        }
        for (s, &j) in sums.iter().enumerate() {
            transition[(sum + s, sum + s)] = 1.0;
            transition[(sum + s, j)] = -1.0;
        }
        let finite = transition.iter().all(|x| x.is_finite());
        finite.then_some(transition)
    }

    /// The independent joint with the largest share of kinetic energy in a mode, whose columns are states.
    pub(super) fn largest_share(&self, mode: &DMatrix<f64>) -> usize {
        let k = self.mass.nrows();
        let rate = self.moving() - k;
        let mut shares = vec![0.0; k];
        for column in mode.column_iter() {
            for (i, share) in shares.iter_mut().enumerate() {
                let momentum: f64 = (0..k).map(|j| self.mass[(i, j)] * column[rate + j]).sum();
                *share += column[rate + i] * momentum;
            }
        }
        let mut worst = 0;
        for (i, share) in shares.iter().enumerate() {
            if *share > shares[worst] {
                worst = i;
            }
        }
        worst
    }
}

/// A robot's discrete-time motion from one sample to the next, under held effort.
pub(super) struct DiscretePlant {
    motion: DMatrix<f64>,
    period_s: f64,
}

/// `Bᵀ diag(values) B`: joint-wise values mapped to the independent joints.
fn by_independent(motions: &DMatrix<f64>, values: &[f64]) -> DMatrix<f64> {
    let k = motions.ncols();
    DMatrix::from_fn(k, k, |i, j| {
        let (a, b) = (motions.column(i), motions.column(j));
        let terms = a.iter().zip(b.iter()).zip(values);
        terms.map(|((a, b), value)| a * value * b).sum()
    })
}

/// The slope of the gravity efforts on the independent joints, shape `(k, k)`, with the loops closed on both sides of `q`; `None` if
/// they do not close.
fn gravity_slope(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &[f64],
    motions: &DMatrix<f64>,
) -> Option<DMatrix<f64>> {
    let k = motions.ncols();
    let mut closure = Closure::new(robot);
    let mut rnea = Rnea::new(robot);
    let mut holding = |along: usize, step: f64| -> Option<Vec<f64>> {
        let mut at = q.to_vec();
        for (at, rate) in at.iter_mut().zip(motions.column(along).iter()) {
            *at += step * rate;
        }
        let mut tree = vec![0.0; robot.n()];
        if robot.loops().is_empty() {
            rnea.gravity(robot, gravity_m_s2, &at, &mut tree);
            return Some(tree);
        }
        closure.newton(robot, robot.dependent(), &mut at).ok()?;
        rnea.gravity(robot, gravity_m_s2, &at, &mut tree);
        let motions = independent_motions(robot, &at).ok()?;
        let felt = motions.column_iter();
        Some(
            felt.map(|b| b.iter().zip(&tree).map(|(b, t)| b * t).sum())
                .collect(),
        )
    };
    let mut slope = DMatrix::zeros(k, k);
    for j in 0..k {
        let (above, below) = (holding(j, SLOPE_STEP)?, holding(j, -SLOPE_STEP)?);
        for i in 0..k {
            slope[(i, j)] = (above[i] - below[i]) / (2.0 * SLOPE_STEP);
        }
    }
    Some(slope)
}
