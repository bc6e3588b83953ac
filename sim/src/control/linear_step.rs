//! The step response of one joint under an ideal PID controller: the linear loop of the textbooks, to compare with a run.
//!
//! The joint is `J dω/dt + b ω = torque`, and the controller gives `kp e + ki ∫e dt + kd de/dt`: no filter, no limit, no sampling, no
//! gravity. From the reference the closed loops are
//!
//! - to the position `(kd s² + kp s + ki) / (J s³ + (b + kd) s² + kp s + ki)`,
//! - to the velocity `(kd s² + kp s + ki) / ((J + kd) s² + (b + kp) s + ki)`,
//!
//! both without `kd` in the numerator where the derivative is taken of the measurement.
//!
//! With the error as a state, the position loop is homogeneous and the velocity loop has a constant input, so a matrix exponential
//! advances either exactly from one time to the next.
//!
//! Source: Åström & Murray, *Feedback Systems* (2008), sec. 10.1 (PID), 5.3 (matrix exponential).

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::matrix_functions::exponential;

/// The quantity that is fed back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fed {
    /// Its position.
    Position,
    /// Its velocity.
    Velocity,
}

/// One revolute joint with viscous damping, and its controller. The units of the gains are those of a position loop; in a velocity loop
/// each has a factor s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearStep {
    /// What is fed back.
    pub fed: Fed,
    /// Moment of inertia about the joint, positive \[kg m²\].
    pub inertia_kg_m2: f64,
    /// Viscous damping, not negative \[N m s/rad\].
    pub damping_n_m_s: f64,
    /// Proportional gain, not negative \[N m/rad\].
    pub kp: f64,
    /// Integral gain, not negative \[N m/(rad s)\].
    pub ki: f64,
    /// Derivative gain, not negative \[N m s/rad\].
    pub kd: f64,
    /// Whether the derivative is taken of the error, so that a step of the reference kicks; else of the measurement.
    pub derivative_of_error: bool,
}

impl LinearStep {
    /// Whether the response stays bounded: by Routh's criterion a position loop does up to `(b + kd) kp = J ki`, a velocity loop
    /// always does.
    pub fn is_bounded(&self) -> bool {
        match self.fed {
            Fed::Position => {
                (self.damping_n_m_s + self.kd) * self.kp >= self.inertia_kg_m2 * self.ki
            }
            Fed::Velocity => true,
        }
    }

    /// The response to a unit step of the reference at time zero, at `count` times that start at zero and are `dt_s` apart; the first
    /// value is the one just after the step.
    ///
    /// `None` if numbers are too large to compute the loop.
    pub fn response(&self, dt_s: f64, count: usize) -> Option<Vec<f64>> {
        let (rates, start) = self.error_dynamics();
        let scaled = DMatrix::from_iterator(3, 3, rates.iter().map(|rate| rate * dt_s));
        let transition = Matrix3::from_iterator(exponential(&scaled)?.iter().copied());
        let mut state = start;
        let mut values = Vec::with_capacity(count);
        for _ in 0..count {
            let value = 1.0 - state.x;
            if !value.is_finite() {
                return None;
            }
            values.push(value);
            state = transition * state;
        }
        Some(values)
    }

    /// `x' = A x` with the error first, and `x` just after the step.
    fn error_dynamics(&self) -> (Matrix3<f64>, Vector3<f64>) {
        let Self {
            inertia_kg_m2: inertia,
            damping_n_m_s: damping,
            kp,
            ki,
            kd,
            ..
        } = *self;
        let kick = if self.derivative_of_error { kd } else { 0.0 };
        match self.fed {
            // error, its integral, velocity
            Fed::Position => (
                Matrix3::new(
                    0.0,
                    0.0,
                    -1.0,
                    1.0,
                    0.0,
                    0.0,
                    kp / inertia,
                    ki / inertia,
                    -(damping + kd) / inertia,
                ),
                Vector3::new(1.0, 0.0, kick / inertia),
            ),
            // error, its integral, one
            Fed::Velocity => {
                let moved = inertia + kd;
                (
                    Matrix3::new(
                        -(damping + kp) / moved,
                        -ki / moved,
                        damping / moved,
                        1.0,
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                    ),
                    Vector3::new(1.0 - kick / moved, 0.0, 1.0),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSITION: LinearStep = LinearStep {
        fed: Fed::Position,
        inertia_kg_m2: 0.5,
        damping_n_m_s: 0.0,
        kp: 2.0,
        ki: 0.0,
        kd: 0.0,
        derivative_of_error: false,
    };

    #[test]
    fn a_spring_and_a_mass_swing_for_ever() {
        // J = 0.5 and kp = 2: 2 rad/s, so 1 - cos(2 t)
        let values = POSITION.response(0.01, 1001).expect("finite");
        for (k, value) in values.iter().enumerate() {
            let expected = 1.0 - libm::cos(0.02 * k as f64);
            // a thousand steps of rounding
            assert!((value - expected).abs() < 1e-12, "{k}: {value}");
        }
    }

    #[test]
    fn a_velocity_loop_jumps_by_its_derivative_and_lags_by_its_damping() {
        let of_velocity = LinearStep {
            fed: Fed::Velocity,
            inertia_kg_m2: 0.5,
            damping_n_m_s: 1.0,
            kp: 3.0,
            ki: 0.0,
            kd: 1.5,
            derivative_of_error: true,
        };
        // jump kd/(J + kd), final value kp/(kp + b), time constant (J + kd)/(b + kp)
        let values = of_velocity.response(0.1, 21).expect("finite");
        for (k, value) in values.iter().enumerate() {
            let expected = 0.75; // jump and final value happen to be equal
            assert!((value - expected).abs() < 1e-14, "{k}: {value}");
        }
        let smooth = LinearStep {
            derivative_of_error: false,
            ..of_velocity
        };
        let values = smooth.response(0.1, 21).expect("finite");
        for (k, value) in values.iter().enumerate() {
            let expected = 0.75 * (1.0 - libm::exp(-0.2 * k as f64));
            assert!((value - expected).abs() < 1e-14, "{k}: {value}");
        }
    }

    #[test]
    fn routh_predicts_growth() {
        let with = |kd: f64, ki: f64| LinearStep { kd, ki, ..POSITION };
        assert!(with(0.0, 0.0).is_bounded());
        assert!(with(1.0, 3.9).is_bounded() && !with(1.0, 4.1).is_bounded());
        let grows = with(1.0, 40.0).response(0.01, 2001).expect("finite yet");
        assert!(grows.iter().any(|value| value.abs() > 1e3));
        let absurd = LinearStep {
            inertia_kg_m2: 1e-300,
            ..with(1e10, 0.0)
        };
        assert_eq!(absurd.response(0.001, 10), None);
    }
}
