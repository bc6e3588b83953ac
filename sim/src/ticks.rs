//! Time as integers: the physics step is the tick, the servo and control periods are integer multiples of the one before.

use std::num::NonZeroU32;

/// The three periods of a run. Seconds are computed from ticks and never accumulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Periods {
    /// The physics step \[s\]: one tick.
    pub step_s: f64,
    /// Ticks from one servo sample to the next.
    pub ticks_per_servo: NonZeroU32,
    /// Ticks from one call of `control` to the next; an integer number of servo periods.
    pub ticks_per_control: NonZeroU32,
}

/// A time that is not a positive integer multiple of a shorter one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{longer} of {longer_s} s is not an integer multiple of the {shorter} of {shorter_s} s")]
pub struct PeriodError {
    /// What the longer time is.
    pub longer: &'static str,
    /// The longer time \[s\].
    pub longer_s: f64,
    /// What the shorter time is.
    pub shorter: &'static str,
    /// The shorter time \[s\].
    pub shorter_s: f64,
}

/// The ratio of `longer_s` to `shorter_s` if it is a positive integer (to one part in a million of itself).
pub fn whole_ratio(longer_s: f64, shorter_s: f64) -> Option<u64> {
    let ratio = longer_s / shorter_s;
    let whole = ratio.round();
    let fits = (1.0..9e15).contains(&whole) && (ratio - whole).abs() <= 1e-6;
    fits.then_some(whole as u64)
}

impl Periods {
    /// Periods from seconds.
    ///
    /// # Errors
    /// [`PeriodError`] where a period is not an integer multiple of the one before.
    pub fn new(step_s: f64, servo_s: f64, control_s: f64) -> Result<Self, PeriodError> {
        let ratio = |longer, longer_s, shorter, shorter_s| {
            whole_ratio(longer_s, shorter_s)
                .and_then(|whole| u32::try_from(whole).ok())
                .and_then(NonZeroU32::new)
                .ok_or(PeriodError {
                    longer,
                    longer_s,
                    shorter,
                    shorter_s,
                })
        };
        let ticks_per_servo = ratio("a servo period", servo_s, "physics step", step_s)?;
        ratio("a control period", control_s, "servo period", servo_s)?;
        let ticks_per_control = ratio("a control period", control_s, "physics step", step_s)?;
        Ok(Self {
            step_s,
            ticks_per_servo,
            ticks_per_control,
        })
    }

    /// The time of a tick \[s\].
    pub fn time_s(&self, tick: u64) -> f64 {
        // a step such as 0.001 s is not exact in binary, but an integer rate such as 1000 Hz is: dividing by it is exact to half a bit
        let rate_hz = (1.0 / self.step_s).round();
        if ((1.0 / rate_hz) - self.step_s).abs() <= f64::EPSILON * self.step_s {
            tick as f64 / rate_hz
        } else {
            tick as f64 * self.step_s
        }
    }

    /// The servo period \[s\].
    pub fn servo_s(&self) -> f64 {
        self.time_s(u64::from(self.ticks_per_servo.get()))
    }

    /// The control period \[s\].
    pub fn control_s(&self) -> f64 {
        self.time_s(u64::from(self.ticks_per_control.get()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_must_divide() {
        let periods = Periods::new(0.001, 0.001, 0.01).unwrap();
        assert_eq!(periods.ticks_per_control.get(), 10);
        assert!(Periods::new(0.001, 0.0015, 0.01).is_err());
        assert!(Periods::new(0.001, 0.004, 0.01).is_err());
        assert!(Periods::new(0.001, 0.0, 0.01).is_err());
        assert!(Periods::new(f64::NAN, 0.001, 0.01).is_err());
    }

    #[test]
    fn time_is_the_nearest_number_to_the_decimal() {
        let periods = Periods::new(0.001, 0.001, 0.01).unwrap();
        assert_eq!(periods.time_s(2350), 2.35);
        assert_eq!(periods.time_s(7), 0.007);
    }
}
