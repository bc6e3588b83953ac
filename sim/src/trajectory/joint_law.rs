//! A law of motion of one joint: position, velocity and acceleration at any time, in closed form.

use super::axis::{Limits, RestToRest, Sample, Trajectory};
use super::spline::{Spline, SplineEnds};
use super::trajectory_error::{TrajectoryError, finite};
use super::trapezoid::Trapezoid;

/// A law of motion of one joint over the time of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct JointLaw(Kind);

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Polynomial(Vec<f64>),
    Sine(Sine),
    Trapezoid(Later<Trapezoid>),
    Table(Later<Spline>),
}

/// `offset + amplitude sin(ω t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    /// Greatest distance from the offset \[rad or m\].
    pub amplitude: f64,
    /// Angular frequency `ω` \[rad/s\].
    pub angular_frequency_rad_s: f64,
    /// Phase at time zero \[rad\].
    pub phase_rad: f64,
    /// Position about which it swings \[rad or m\].
    pub offset: f64,
}

/// A motion that starts at a time \[s\]; at rest before it starts and after it ends.
#[derive(Debug, Clone, PartialEq)]
struct Later<M> {
    start_s: f64,
    motion: M,
}

impl<M: Trajectory> Later<M> {
    fn at(&self, time_s: f64) -> M::Sample {
        self.motion.at(time_s - self.start_s)
    }
}

impl JointLaw {
    /// At rest at `position` \[rad or m\].
    ///
    /// # Errors
    /// `NotFinite`.
    pub fn constant(position: f64) -> Result<Self, TrajectoryError> {
        Self::polynomial(&[position])
    }

    /// `c₀ + c₁ t + c₂ t² + ...`, the coefficients in this order \[rad or m, per sᵏ\].
    ///
    /// # Errors
    /// `TooFew` without a coefficient, `NotFinite`.
    pub fn polynomial(coefficients: &[f64]) -> Result<Self, TrajectoryError> {
        if coefficients.is_empty() {
            return Err(TrajectoryError::TooFew {
                what: "coefficients",
                got: 0,
                least: 1,
            });
        }
        for coefficient in coefficients {
            finite("coefficient", *coefficient)?;
        }
        Ok(Self(Kind::Polynomial(coefficients.to_vec())))
    }

    /// A sine.
    ///
    /// # Errors
    /// `NotFinite`.
    pub fn sine(sine: Sine) -> Result<Self, TrajectoryError> {
        for (what, value) in [
            ("amplitude", sine.amplitude),
            ("angular frequency", sine.angular_frequency_rad_s),
            ("phase", sine.phase_rad),
            ("offset", sine.offset),
        ] {
            finite(what, value)?;
        }
        Ok(Self(Kind::Sine(sine)))
    }

    /// From rest at `from` to rest at `to` \[rad or m\] under `limits`, from `start_s` on.
    ///
    /// # Errors
    /// `NotFinite`, and what [`Trapezoid`] refuses.
    pub fn trapezoid(
        from: f64,
        to: f64,
        limits: &Limits,
        start_s: f64,
    ) -> Result<Self, TrajectoryError> {
        Ok(Self(Kind::Trapezoid(Later {
            start_s: finite("start", start_s)?,
            motion: Trapezoid::rest_to_rest(from, to, limits)?,
        })))
    }

    /// Through `positions` \[rad or m\] at `times_s`, shape `(m)` each, by a cubic spline; at rest before the first and after the last.
    ///
    /// # Errors
    /// `TooFew` below two points, `NotFinite`, and what [`Spline::through`] refuses.
    pub fn table(
        times_s: &[f64],
        positions: &[f64],
        ends: SplineEnds,
    ) -> Result<Self, TrajectoryError> {
        let start_s = finite("first time", times_s.first().copied().unwrap_or(0.0))?;
        let from_start: Vec<f64> = times_s.iter().map(|time_s| time_s - start_s).collect();
        Ok(Self(Kind::Table(Later {
            start_s,
            motion: Spline::through(&from_start, positions, ends)?,
        })))
    }

    /// The motion at `time_s`.
    pub fn at(&self, time_s: f64) -> Sample {
        match &self.0 {
            Kind::Polynomial(coefficients) => polynomial_at(coefficients, time_s),
            Kind::Sine(sine) => sine.at(time_s),
            Kind::Trapezoid(later) => later.at(time_s),
            Kind::Table(later) => later.at(time_s),
        }
    }
}

impl Sine {
    fn at(&self, time_s: f64) -> Sample {
        let rate = self.angular_frequency_rad_s;
        let phase = rate * time_s + self.phase_rad;
        let (sine, cosine) = (libm::sin(phase), libm::cos(phase));
        Sample {
            position: self.offset + self.amplitude * sine,
            velocity: self.amplitude * rate * cosine,
            acceleration: -self.amplitude * rate * rate * sine,
        }
    }
}

/// A polynomial and its two derivatives, by Horner's scheme.
fn polynomial_at(coefficients: &[f64], t: f64) -> Sample {
    let (mut position, mut velocity, mut half) = (0.0, 0.0, 0.0);
    for coefficient in coefficients.iter().rev() {
        half = half * t + velocity;
        velocity = velocity * t + position;
        position = position * t + coefficient;
    }
    Sample {
        position,
        velocity,
        acceleration: 2.0 * half,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn sample(position: f64, velocity: f64, acceleration: f64) -> Sample {
        Sample {
            position,
            velocity,
            acceleration,
        }
    }

    #[test]
    fn a_polynomial_by_hand() {
        // 1 + 2 t - 3 t² + t³ at 2: 1 + 4 - 12 + 8; 2 - 12 + 12; -6 + 12
        let law = JointLaw::polynomial(&[1.0, 2.0, -3.0, 1.0]).unwrap();
        assert_eq!(law.at(2.0), sample(1.0, 2.0, 6.0));
        let still = JointLaw::constant(0.7).unwrap();
        assert_eq!(still.at(3.0), sample(0.7, 0.0, 0.0));
    }

    #[test]
    fn a_sine_by_hand() {
        let law = JointLaw::sine(Sine {
            amplitude: 2.0,
            angular_frequency_rad_s: PI,
            phase_rad: FRAC_PI_2,
            offset: 0.5,
        })
        .unwrap();
        // at its peak, and a quarter of a period later
        assert_eq!(law.at(0.0).position, 2.5);
        assert_eq!(law.at(0.0).acceleration, -2.0 * PI * PI);
        let quarter = law.at(0.5);
        assert!((quarter.position - 0.5).abs() < 1e-15);
        assert!((quarter.velocity + 2.0 * PI).abs() < 1e-15);
    }

    #[test]
    fn what_starts_later_rests_before_and_after() {
        let limits = Limits {
            speed: 1.0,
            acceleration: 1.0,
        };
        // 3 m: 1 + 2 + 1 s from second 5 on
        let law = JointLaw::trapezoid(0.0, 3.0, &limits, 5.0).unwrap();
        assert_eq!(law.at(4.0), sample(0.0, 0.0, 0.0));
        assert_eq!(law.at(7.0), sample(1.5, 1.0, 0.0));
        assert_eq!(law.at(10.0), sample(3.0, 0.0, 0.0));
        let ends = SplineEnds::AT_REST;
        let law = JointLaw::table(&[1.0, 2.0, 4.0], &[0.0, 1.0, -1.0], ends).unwrap();
        assert_eq!(law.at(0.0), sample(0.0, 0.0, 0.0));
        assert_eq!(law.at(2.0).position, 1.0);
        assert_eq!(law.at(5.0), sample(-1.0, 0.0, 0.0));
    }

    #[test]
    fn velocities_and_accelerations_are_derivatives() {
        let laws = [
            JointLaw::polynomial(&[0.2, -0.4, 0.3, 0.1, -0.05]).unwrap(),
            JointLaw::sine(Sine {
                amplitude: 0.7,
                angular_frequency_rad_s: 2.3,
                phase_rad: 0.4,
                offset: -0.1,
            })
            .unwrap(),
            JointLaw::table(&[0.0, 1.0, 3.0], &[0.2, 0.9, -0.4], SplineEnds::Natural).unwrap(),
        ];
        let h = 1e-5;
        for law in laws {
            for time_s in [0.3, 1.7, 2.6] {
                let [before, now, after] = [-h, 0.0, h].map(|d| law.at(time_s + d));
                let velocity = (after.position - before.position) / (2.0 * h);
                let acceleration = (after.velocity - before.velocity) / (2.0 * h);
                assert!((now.velocity - velocity).abs() < 1e-8, "{law:?}");
                assert!((now.acceleration - acceleration).abs() < 1e-8, "{law:?}");
            }
        }
    }

    #[test]
    fn what_is_no_law_is_refused() {
        let text = |result: Result<JointLaw, TrajectoryError>| result.unwrap_err().to_string();
        assert!(text(JointLaw::polynomial(&[])).contains("coefficients"));
        assert!(text(JointLaw::constant(f64::NAN)).contains("coefficient"));
        let decreasing = JointLaw::table(&[0.0, 2.0, 1.0], &[0.0; 3], SplineEnds::AT_REST);
        assert!(decreasing.is_err());
    }
}
