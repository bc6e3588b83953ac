//! The loops of one joint under PID control, linear and without gravity, as transfer functions.
//!
//! The joint is `J dω/dt + b ω = torque`, so the plant is `1/(Js + b)` to the velocity and `1/(s(Js + b))` to the
//! position. The controller `C = Kp + Ki/s + Kd s` is ideal: no filter on the derivative, no limit, no sampling.

use super::transfer_function::{TransferFunction, TransferFunctionError};

/// Gains of a PID controller whose output is a torque \[N m\].
///
/// Units are those of a position loop; in a velocity loop each gains a factor s, since the error is in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidGains {
    /// Proportional gain \[N m/rad\].
    pub kp: f64,
    /// Integral gain \[N m/(rad s)\].
    pub ki: f64,
    /// Derivative gain \[N m s/rad\].
    pub kd: f64,
}

/// One joint that turns freely but for viscous damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPlant {
    /// Moment of inertia `J` about the joint \[kg m²\].
    pub inertia_kg_m2: f64,
    /// Viscous damping `b` \[N m s/rad\].
    pub damping_n_m_s: f64,
}

/// What the derivative term differentiates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeOn {
    /// The error: a step of the reference kicks.
    Error,
    /// The measurement: the reference does not pass through it, which takes `Kd s` out of the numerator.
    Measurement,
}

/// A joint with its controller.
///
/// Each method errs as [`TransferFunction::new`] does: with gains that are not finite, or with so many of them zero
/// that no proper function is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidLoop {
    /// The joint.
    pub plant: JointPlant,
    /// The controller.
    pub gains: PidGains,
}

impl PidLoop {
    /// From reference to position \[rad/rad\]: `(Kd s² + Kp s + Ki) / (J s³ + (b + Kd) s² + Kp s + Ki)`.
    ///
    /// This is what equation 6 of the virtual-robotics lab is meant to be (errata 003-01);
    /// [`Self::equation_6_as_printed`] is what it prints.
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn position_closed_loop(
        &self,
        derivative: DerivativeOn,
    ) -> Result<TransferFunction, TransferFunctionError> {
        TransferFunction::new(&self.controller(derivative), &self.position_denominator())
    }

    /// From reference to velocity \[(rad/s)/(rad/s)\]: `(Kd s² + Kp s + Ki) / ((J + Kd) s² + (b + Kp) s + Ki)`.
    ///
    /// With the derivative on the error the response jumps to `Kd/(J + Kd)` at once. Without `Kd` this is the PI loop.
    /// It is what equation 7 of the virtual-robotics lab is meant to be (errata 003-02);
    /// [`Self::equation_7_as_printed`] is what it prints.
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn velocity_closed_loop(
        &self,
        derivative: DerivativeOn,
    ) -> Result<TransferFunction, TransferFunctionError> {
        TransferFunction::new(&self.controller(derivative), &self.velocity_denominator())
    }

    /// From a disturbing torque at the joint to position \[rad/(N m)\], in the position loop:
    /// `s / (J s³ + (b + Kd) s² + Kp s + Ki)`. Returns to zero if `Ki > 0`.
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn disturbance_to_position(&self) -> Result<TransferFunction, TransferFunctionError> {
        TransferFunction::new(&[1.0, 0.0], &self.position_denominator())
    }

    /// From a disturbing torque at the joint to velocity \[(rad/s)/(N m)\], in the velocity loop:
    /// `s / ((J + Kd) s² + (b + Kp) s + Ki)`. Returns to zero if `Ki > 0`.
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn disturbance_to_velocity(&self) -> Result<TransferFunction, TransferFunctionError> {
        TransferFunction::new(&[1.0, 0.0], &self.velocity_denominator())
    }

    /// Equation 6 of the virtual-robotics lab as printed: `s² (Js + b) / (J s³ + (b + Kd) s² + Kp s + Ki)`.
    ///
    /// The lab calls it the closed loop from reference to position. It is the *sensitivity* `1 - T`, from reference to
    /// error: its step response starts at 1 and returns to 0 (errata 003-01). Nor is it the response to a torque, which
    /// its left side names (003-03); that is [`Self::disturbance_to_position`].
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn equation_6_as_printed(&self) -> Result<TransferFunction, TransferFunctionError> {
        let JointPlant {
            inertia_kg_m2,
            damping_n_m_s,
        } = self.plant;
        TransferFunction::new(
            &[inertia_kg_m2, damping_n_m_s, 0.0, 0.0],
            &self.position_denominator(),
        )
    }

    /// Equation 7 of the virtual-robotics lab as printed: `s (Js + b) / ((J + Kd) s² + (b + Kp) s + Ki)`.
    ///
    /// The lab calls it the closed loop from reference to velocity. It is the *sensitivity* `1 - T`, from reference to
    /// error, which returns to 0 (errata 003-02); the lab's own 99.3 % is `Kp/(Kp + b)` of the right function,
    /// [`Self::velocity_closed_loop`].
    ///
    /// # Errors
    ///
    /// See [`PidLoop`].
    pub fn equation_7_as_printed(&self) -> Result<TransferFunction, TransferFunctionError> {
        let JointPlant {
            inertia_kg_m2,
            damping_n_m_s,
        } = self.plant;
        TransferFunction::new(
            &[inertia_kg_m2, damping_n_m_s, 0.0],
            &self.velocity_denominator(),
        )
    }

    /// `s C(s)`, without `Kd` where the reference does not pass through the derivative.
    fn controller(&self, derivative: DerivativeOn) -> [f64; 3] {
        let PidGains { kp, ki, kd } = self.gains;
        match derivative {
            DerivativeOn::Error => [kd, kp, ki],
            DerivativeOn::Measurement => [0.0, kp, ki],
        }
    }

    fn position_denominator(&self) -> [f64; 4] {
        let (
            JointPlant {
                inertia_kg_m2,
                damping_n_m_s,
            },
            PidGains { kp, ki, kd },
        ) = (self.plant, self.gains);
        [inertia_kg_m2, damping_n_m_s + kd, kp, ki]
    }

    fn velocity_denominator(&self) -> [f64; 3] {
        let (
            JointPlant {
                inertia_kg_m2,
                damping_n_m_s,
            },
            PidGains { kp, ki, kd },
        ) = (self.plant, self.gains);
        [inertia_kg_m2 + kd, damping_n_m_s + kp, ki]
    }
}
