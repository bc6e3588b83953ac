//! A sweep: one number of the settings with several values, and everything else as it is.

use std::fmt;

use kinemark_sim::text::number::short;

use super::settings::{ResponseError, ResponseSettings};

/// The most values of a sweep: as many curves as a picture has colours.
pub const MOST_VALUES: usize = 6;

/// The number that a sweep varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varied {
    /// The proportional gain.
    Kp,
    /// The integral gain.
    Ki,
    /// The derivative gain.
    Kd,
    /// The height of the step.
    Step,
    /// The time between two samples of the servos \[ms\].
    ServoPeriodMs,
    /// Gravity, downwards \[m/s²\].
    Gravity,
    /// The speed of the wind along the world's x axis \[m/s\].
    Wind,
    /// Additional dry friction in every joint.
    Friction,
}

impl Varied {
    /// All of them, in the order in which help lists them.
    pub const ALL: [Self; 8] = [
        Self::Kp,
        Self::Ki,
        Self::Kd,
        Self::Step,
        Self::ServoPeriodMs,
        Self::Gravity,
        Self::Wind,
        Self::Friction,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kp => "kp",
            Self::Ki => "ki",
            Self::Kd => "kd",
            Self::Step => "step",
            Self::ServoPeriodMs => "servo-period-ms",
            Self::Gravity => "gravity",
            Self::Wind => "wind",
            Self::Friction => "friction",
        }
    }

    /// A value in words: `kd 2`, `gravity 1.62 m/s²`.
    pub fn with_value(self, value: f64) -> String {
        let value = short(value);
        match self {
            Self::Kp | Self::Ki | Self::Kd | Self::Step | Self::Friction => {
                format!("{} {value}", self.name())
            }
            Self::ServoPeriodMs => format!("{value} ms"),
            Self::Gravity => format!("gravity {value} m/s²"),
            Self::Wind => format!("wind {value} m/s"),
        }
    }
}

impl fmt::Display for Varied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One number of the settings, and its values in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The number that varies.
    pub varied: Varied,
    /// Its values, at least one.
    pub values: Vec<f64>,
}

/// Gravity in words or as a number: `earth`, `moon`, `mars`, `zero`, or \[m/s²\] downwards; `None` for anything else.
pub fn gravity_m_s2(text: &str) -> Option<f64> {
    match text {
        "earth" => Some(9.81),
        "moon" => Some(1.62),
        "mars" => Some(3.71),
        "zero" => Some(0.0),
        number => number.parse().ok().filter(|value: &f64| value.is_finite()),
    }
}

impl Sweep {
    /// Reads `kd=2,5,10`.
    ///
    /// # Errors
    /// [`ResponseError::Sweep`]: a name that cannot be varied, a value that is no number, no value, or more than [`MOST_VALUES`].
    pub fn parse(text: &str) -> Result<Self, ResponseError> {
        let refuse = |why: String| Err(ResponseError::Sweep(why));
        let Some((name, values)) = text.split_once('=') else {
            return refuse(format!("`{text}` is no sweep: it has no `=`"));
        };
        let name = name.trim();
        let Some(varied) = Varied::ALL.into_iter().find(|varied| varied.name() == name) else {
            let known = Varied::ALL.map(Varied::name);
            let names =
                kinemark_sim::text::suggest(name, "a sweep varies one of", known.into_iter());
            return refuse(format!("`{name}` cannot be swept; {names}"));
        };
        let mut read = Vec::new();
        for part in values.split(',').map(str::trim) {
            let value = match varied {
                Varied::Gravity => gravity_m_s2(part),
                _ => part.parse().ok().filter(|value: &f64| value.is_finite()),
            };
            let Some(value) = value else {
                return refuse(format!("`{part}` in the sweep of {name} is not a number"));
            };
            read.push(value);
        }
        if read.len() > MOST_VALUES {
            return refuse(format!(
                "the sweep of {name} has {} values, at most {MOST_VALUES}",
                read.len()
            ));
        }
        Ok(Self {
            varied,
            values: read,
        })
    }

    /// The settings with one of its values.
    pub(super) fn applied(&self, settings: &ResponseSettings, value: f64) -> ResponseSettings {
        let mut applied = settings.clone();
        match self.varied {
            Varied::Kp => applied.gains.kp = value,
            Varied::Ki => applied.gains.ki = value,
            Varied::Kd => applied.gains.kd = value,
            Varied::Step => applied.step = value,
            Varied::ServoPeriodMs => applied.servo_period_s = value / 1000.0,
            Varied::Gravity => applied.surroundings.gravity_m_s2 = value,
            Varied::Wind => applied.surroundings.wind_m_s = Some([value, 0.0, 0.0]),
            Varied::Friction => applied.surroundings.dry_friction = value,
        }
        applied
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_is_read_or_refused_with_a_reason() {
        let sweep = Sweep::parse("kd = 2, 5,10").unwrap();
        assert_eq!(
            (sweep.varied, sweep.values),
            (Varied::Kd, vec![2.0, 5.0, 10.0])
        );
        let sweep = Sweep::parse("gravity=earth,moon,mars,zero,-1").unwrap();
        assert_eq!(sweep.values, [9.81, 1.62, 3.71, 0.0, -1.0]);
        for (text, why) in [
            ("kd", "no `=`"),
            ("kq=1", "`kq` cannot be swept; did you mean `kp`?"),
            ("kd=1,x", "`x` in the sweep of kd is not a number"),
            ("kd=", "`` in the sweep"),
            ("kd=inf", "not a number"),
            ("kd=1,2,3,4,5,6,7", "7 values, at most 6"),
        ] {
            let refused = Sweep::parse(text).unwrap_err().to_string();
            assert!(refused.contains(why), "{text}: {refused}");
        }
    }
}
