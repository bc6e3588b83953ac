//! The device of one sensor: what it does to a value between the world and the reader.
//!
//! A value is taken at the sensor's rate, gets its noise, is quantised, travels for the delay, and is held until the
//! next one arrives. Noise comes before quantisation because an encoder's counter sees the true position and its jitter
//! together; the delay comes last because it is the transport of the finished number. To hold first and to travel then
//! is the same.

use std::collections::VecDeque;

use super::sampling::SensorError;
use crate::model::sensor::Sensor;
use crate::random::SplitMix64;
use crate::ticks::whole_ratio;

/// Most physics steps a value may travel, 10 s at a step of 1 ms: it bounds the values under way.
const MOST_DELAY_STEPS: u64 = 10_000;

/// The device of one sensor in one run.
#[derive(Debug)]
pub(super) struct Device {
    noise: f64,
    quantisation: f64,
    every_steps: u64,
    delay_steps: u64,
    numbers: SplitMix64,
    has_taken: bool,
    /// Ticks at which the values under way arrive, and the values, channel by channel.
    arrivals: VecDeque<u64>,
    under_way: VecDeque<f64>,
}

impl Device {
    pub(super) fn new(sensor: &Sensor, step_s: f64) -> Result<Self, SensorError> {
        Ok(Self {
            noise: sensor.noise,
            quantisation: sensor.quantisation,
            every_steps: match sensor.rate_hz {
                Some(rate_hz) => period(&sensor.name, rate_hz, step_s)?,
                None => 1,
            },
            delay_steps: delay(&sensor.name, sensor.delay_s, step_s)?,
            numbers: SplitMix64::new(sensor.seed),
            has_taken: false,
            arrivals: VecDeque::new(),
            under_way: VecDeque::new(),
        })
    }

    /// Whether a new value is taken at `tick`.
    pub(super) fn is_due(&self, tick: u64) -> bool {
        !self.has_taken || tick.is_multiple_of(self.every_steps)
    }

    /// Adds noise to a new value and quantises it, channel by channel.
    pub(super) fn disturb(&mut self, values: &mut [f64]) {
        for value in values {
            if self.noise > 0.0 {
                *value += self.noise * self.numbers.normal();
            }
            if self.quantisation > 0.0 {
                let rounded = (*value / self.quantisation).round() * self.quantisation;
                // a step too small to divide by leaves the value as it is
                if rounded.is_finite() {
                    *value = rounded;
                }
            }
        }
    }

    /// Sends a finished value on its way. The first one is there at once, since there is none before it.
    pub(super) fn send(&mut self, tick: u64, values: &[f64], held: &mut [f64]) {
        if self.delay_steps == 0 || !self.has_taken {
            held.copy_from_slice(values);
        } else {
            self.arrivals.push_back(tick + self.delay_steps);
            self.under_way.extend(values);
        }
        self.has_taken = true;
    }

    /// Leaves in `held` what has arrived last at `tick`.
    pub(super) fn receive(&mut self, tick: u64, held: &mut [f64]) {
        while self.arrivals.front().is_some_and(|due| *due <= tick) {
            self.arrivals.pop_front();
            let arrived = self.under_way.drain(..held.len());
            for (channel, value) in arrived.enumerate() {
                held[channel] = value;
            }
        }
    }
}

fn period(sensor: &str, rate_hz: f64, step_s: f64) -> Result<u64, SensorError> {
    let period_s = 1.0 / rate_hz;
    whole_ratio(period_s, step_s).ok_or_else(|| SensorError::Rate {
        sensor: sensor.to_owned(),
        rate_hz,
        step_s,
        nearest_hz: 1.0 / ((period_s / step_s).round().max(1.0) * step_s),
    })
}

fn delay(sensor: &str, delay_s: f64, step_s: f64) -> Result<u64, SensorError> {
    // a ratio is never zero
    let steps = if delay_s > 0.0 {
        whole_ratio(delay_s, step_s)
    } else {
        Some(0)
    };
    match steps {
        Some(steps) if steps <= MOST_DELAY_STEPS => Ok(steps),
        Some(_) => Err(SensorError::LongDelay {
            sensor: sensor.to_owned(),
            delay_s,
            most_s: MOST_DELAY_STEPS as f64 * step_s,
        }),
        None => Err(SensorError::Delay {
            sensor: sensor.to_owned(),
            delay_s,
            step_s,
            nearest_s: (delay_s / step_s).round() * step_s,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::example;

    fn sensor() -> Sensor {
        Sensor {
            seed: 7,
            ..example("contact")
        }
    }

    /// What is held at each tick while the true value is the tick.
    fn held(sensor: &Sensor, ticks: u64) -> Vec<f64> {
        let mut device = Device::new(sensor, 1e-3).unwrap();
        let mut held = [f64::NAN];
        (0..ticks)
            .map(|tick| {
                if device.is_due(tick) {
                    let mut value = [tick as f64];
                    device.disturb(&mut value);
                    device.send(tick, &value, &mut held);
                }
                device.receive(tick, &mut held);
                held[0]
            })
            .collect()
    }

    #[test]
    fn a_delayed_value_is_the_one_of_that_long_ago() {
        let delayed = Sensor {
            delay_s: 0.004,
            ..sensor()
        };
        let expected: Vec<f64> = (0..20)
            .map(|tick: u64| tick.saturating_sub(4) as f64)
            .collect();
        assert_eq!(held(&delayed, 20), expected);
    }

    #[test]
    fn a_value_is_held_until_the_next_one_arrives() {
        let slow = Sensor {
            rate_hz: Some(200.0),
            ..sensor()
        };
        let expected: Vec<f64> = (0..20).map(|tick: u64| (tick / 5 * 5) as f64).collect();
        assert_eq!(held(&slow, 20), expected);
        // slow and late: taken at 0, 5, 10, ..., there 7 steps after
        let late = Sensor {
            delay_s: 0.007,
            ..slow
        };
        let expected: Vec<f64> = (0..20)
            .map(|tick: u64| (tick.saturating_sub(7) / 5 * 5) as f64)
            .collect();
        assert_eq!(held(&late, 20), expected);
    }

    #[test]
    fn values_are_rounded_to_whole_multiples_halves_away_from_zero() {
        let coarse = Sensor {
            quantisation: 0.25,
            ..sensor()
        };
        let mut device = Device::new(&coarse, 1e-3).unwrap();
        let mut values = [0.3, 0.125, -0.125, 0.37, -1.0, 0.0, 1e300];
        device.disturb(&mut values);
        assert_eq!(values, [0.25, 0.25, -0.25, 0.25, -1.0, 0.0, 1e300]);
        // no step is too small
        device.quantisation = 5e-324;
        let mut values = [0.3];
        device.disturb(&mut values);
        assert_eq!(values, [0.3]);
    }

    #[test]
    fn noise_has_its_mean_and_deviation_and_repeats() {
        let noisy = Sensor {
            noise: 0.02,
            ..sensor()
        };
        let drawn = |seed| {
            let mut device = Device::new(
                &Sensor {
                    seed,
                    ..noisy.clone()
                },
                1e-3,
            )
            .unwrap();
            (0..100_000)
                .map(|_| {
                    let mut value = [3.0];
                    device.disturb(&mut value);
                    value[0] - 3.0
                })
                .collect::<Vec<f64>>()
        };
        let errors = drawn(7);
        let n = errors.len() as f64;
        let mean = errors.iter().sum::<f64>() / n;
        let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / n).sqrt();
        // five standard errors: 0.02 / sqrt(n), and that over sqrt(2)
        assert!(mean.abs() < 5.0 * 0.02 / n.sqrt(), "{mean:e}");
        assert!(
            (deviation - 0.02).abs() < 5.0 * 0.02 / (2.0 * n).sqrt(),
            "{deviation}"
        );
        assert_eq!(errors, drawn(7));
        assert_ne!(errors, drawn(8));
    }

    #[test]
    fn times_that_are_no_whole_steps_are_refused_with_the_nearest_that_fits() {
        let new = |sensor: Sensor| {
            Device::new(&sensor, 1e-3)
                .map(|_| ())
                .unwrap_err()
                .to_string()
        };
        assert_eq!(
            new(Sensor {
                delay_s: 0.0042,
                ..sensor()
            }),
            "sensor `example`: a delay of 0.0042 s is not an integer multiple of the physics step of 0.001 s; the nearest is 0.004 s"
        );
        assert_eq!(
            new(Sensor {
                rate_hz: Some(300.0),
                ..sensor()
            }),
            "sensor `example`: at 300 Hz, the time between values is not an integer multiple of the physics step of 0.001 s; the nearest rate is 333.3333333333333 Hz"
        );
        assert_eq!(
            new(Sensor {
                rate_hz: Some(5000.0),
                ..sensor()
            }),
            "sensor `example`: at 5000 Hz, the time between values is not an integer multiple of the physics step of 0.001 s; the nearest rate is 1000 Hz"
        );
        assert_eq!(
            new(Sensor {
                delay_s: 1e6,
                ..sensor()
            }),
            "sensor `example`: a delay of 1000000 s is too long; at this physics step it is at most 10 s"
        );
    }
}
