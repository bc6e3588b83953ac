//! Disturbances of a run: noise on the joint sensors, delayed commands, and servos whose nominal model differs from the robot that
//! moves.

use std::collections::VecDeque;

use crate::model::robot::Robot;
use crate::random::SplitMix64;

/// A disturbance of a run; [`Default`] is none at all.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disturbance<'a> {
    /// Standard deviation of the noise on measured joint positions \[rad or m\].
    pub q_noise: f64,
    /// Standard deviation of the noise on measured joint velocities \[rad/s or m/s\].
    pub qd_noise: f64,
    /// Seed of the noise: the same seed gives the same noise, whatever is commanded.
    pub seed: u64,
    /// Control periods until a command reaches the servos. The first command arrives at once, since there is none before it.
    pub delay_periods: u32,
    /// The nominal model that the servos use for gravity compensation, with the same joints; `None` for the robot that moves.
    pub known: Option<&'a Robot>,
}

/// The state of a disturbance: a copy continues with the same noise and the same delayed commands.
#[derive(Debug, Clone)]
pub(super) struct Disturbed {
    q_noise: f64,
    qd_noise: f64,
    numbers: SplitMix64,
    delay_periods: usize,
    under_way: VecDeque<Vec<f64>>,
    has_command: bool,
    /// Measured joint positions at the tick \[rad or m\].
    pub(super) q: Vec<f64>,
    /// Measured joint velocities at the tick \[rad/s or m/s\].
    pub(super) qd: Vec<f64>,
}

impl Disturbed {
    pub(super) fn new(disturbance: &Disturbance<'_>, n: usize) -> Self {
        Self {
            q_noise: disturbance.q_noise,
            qd_noise: disturbance.qd_noise,
            numbers: SplitMix64::new(disturbance.seed),
            delay_periods: disturbance.delay_periods as usize,
            under_way: VecDeque::new(),
            has_command: false,
            q: vec![0.0; n],
            qd: vec![0.0; n],
        }
    }

    /// Measures the state: once at every tick at which servos or controller sample it, so that both get the same numbers.
    pub(super) fn measure(&mut self, q: &[f64], qd: &[f64]) {
        for (measured, exact, noise) in [
            (&mut self.q, q, self.q_noise),
            (&mut self.qd, qd, self.qd_noise),
        ] {
            measured.copy_from_slice(exact);
            if noise > 0.0 {
                for value in measured {
                    *value += noise * self.numbers.normal();
                }
            }
        }
    }

    /// Takes the newest command and leaves in `command` the one that reaches the servos now.
    pub(super) fn deliver(&mut self, command: &mut [f64]) {
        if self.delay_periods == 0 {
            return;
        }
        if !self.has_command {
            // it is held until the next one arrives, one delay after that is commanded
            self.has_command = true;
            self.under_way
                .extend((0..=self.delay_periods).map(|_| command.to_vec()));
        } else {
            self.under_way.push_back(command.to_vec());
        }
        if let Some(due) = self.under_way.pop_front() {
            command.copy_from_slice(&due);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_comes_as_many_periods_late_and_the_first_at_once() {
        let late = |delay_periods: u32| {
            let disturbance = Disturbance {
                delay_periods,
                ..Disturbance::default()
            };
            let mut disturbed = Disturbed::new(&disturbance, 1);
            let given = [1.0, 2.0, 3.0, 4.0, 5.0];
            given.map(|value| {
                let mut command = [value];
                disturbed.deliver(&mut command);
                command[0]
            })
        };
        assert_eq!(late(0), [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(late(1), [1.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(late(3), [1.0, 1.0, 1.0, 1.0, 2.0]);
    }

    #[test]
    fn noise_has_its_deviation_and_is_the_same_for_the_same_seed() {
        let noise = |seed: u64| {
            let disturbance = Disturbance {
                q_noise: 0.1,
                seed,
                ..Disturbance::default()
            };
            let mut disturbed = Disturbed::new(&disturbance, 1);
            let values = (0..10_000).map(|_| {
                disturbed.measure(&[2.0], &[3.0]);
                assert_eq!(disturbed.qd, [3.0]);
                disturbed.q[0] - 2.0
            });
            values.collect::<Vec<f64>>()
        };
        let values = noise(7);
        assert_eq!(values, noise(7));
        assert_ne!(values, noise(8));
        let square = values.iter().map(|x| x * x).sum::<f64>() / 10_000.0;
        // five standard errors of a variance: 5 sqrt(2 / 10000)
        assert!((square / 0.01 - 1.0).abs() < 0.071, "{square}");
    }
}
