//! Ladders of a robustness check: rungs under which a motion is run again, each harder than what was asked for in some way.

use crate::record::quantity::{seconds, trimmed};

/// What a robustness check climbs.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// Index, among the task's checks, of the one that judges every rung; earlier than the robustness check.
    pub check: usize,
    /// Its rungs, at least one.
    pub rungs: Vec<Rung>,
}

/// One rung: the disturbance under which the motion is run again. It is the same for every submission.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// Its name.
    pub name: String,
    /// How much it counts against the others; positive.
    pub share: f64,
    /// Standard deviation of the noise on measured joint positions \[rad or m\].
    pub q_noise: f64,
    /// Standard deviation of the noise on measured joint velocities \[rad/s or m/s\].
    pub qd_noise: f64,
    /// By how many control periods commands are late.
    pub delay_periods: u32,
    /// The same as a time \[s\].
    pub delay_s: f64,
    /// Mass at the TCP that nobody knows of \[kg\].
    pub payload_kg: f64,
    /// Dry friction that every joint has more \[N m or N\].
    pub friction: f64,
    /// Factor of every joint's viscous damping, where it changes.
    pub damping: Option<f64>,
}

impl Rung {
    /// What is different, in words: `commands 0.01 s late, 0.2 kg more at the TCP`.
    pub fn told(&self) -> String {
        let mut parts = Vec::new();
        let noises = [(self.q_noise, "rad on q"), (self.qd_noise, "rad/s on qd")];
        let noises = noises.iter().filter(|(noise, _)| *noise > 0.0);
        let noises: Vec<String> = noises
            .map(|(noise, what)| format!("{noise} {what}"))
            .collect();
        if !noises.is_empty() {
            parts.push(format!("noise of {}", noises.join(" and ")));
        }
        if self.delay_periods > 0 {
            parts.push(format!("commands {} late", seconds(self.delay_s)));
        }
        if self.payload_kg > 0.0 {
            let mass = trimmed(self.payload_kg, 4);
            parts.push(format!("{mass} kg more at the TCP"));
        }
        if self.friction > 0.0 {
            let friction = trimmed(self.friction, 4);
            parts.push(format!("{friction} N m more friction in every joint"));
        }
        if let Some(factor) = self.damping {
            let factor = trimmed(factor, 4);
            parts.push(format!("{factor} times the damping"));
        }
        parts.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rung_tells_all_that_is_different() {
        let rung = Rung {
            name: "all".to_owned(),
            share: 1.0,
            q_noise: 1e-4,
            qd_noise: 0.01,
            delay_periods: 2,
            delay_s: 0.02,
            payload_kg: 0.2,
            friction: 0.3,
            damping: Some(1.3),
        };
        assert_eq!(
            rung.told(),
            "noise of 0.0001 rad on q and 0.01 rad/s on qd, commands 0.02 s late, 0.2 kg more at the TCP, \
             0.3 N m more friction in every joint, 1.3 times the damping"
        );
    }
}
