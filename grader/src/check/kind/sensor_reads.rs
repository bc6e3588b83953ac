//! sensor-reads: what a sensor of the task reads, at the end of the run or over a part of it.
//!
//! Of a switch the reading should be `value`, and it is right or wrong. Of other sensors the measured number is the reading or a
//! statistic of it, or its distance from `value` where one is given, in the sensor's unit.

use std::sync::Arc;

use kinemark_sim::text::Problem;

use crate::check::contract::FromReference;
use crate::check::prelude::*;
use crate::check::reading::Channel;

/// What of the readings counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Which {
    /// The last one.
    #[default]
    End,
    /// The least one.
    Min,
    /// The greatest one.
    Max,
    /// Their mean.
    Mean,
}

impl Which {
    fn words(self) -> &'static str {
        match self {
            Self::End => "last reading",
            Self::Min => "least reading",
            Self::Max => "greatest reading",
            Self::Mean => "mean reading",
        }
    }
}

/// What a sensor should read.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected true, false or a number")]
enum Wanted {
    /// Of a switch.
    Switched(bool),
    /// Of others.
    Number(f64),
}

problems! {
    /// A reading that the sensor cannot have, or a band that it needs or does not.
    enum WantedProblem {
        Switch { sensor: String }:
            "lab::sensor_reads", "sensor `{sensor}` is a switch: its reading is right or wrong", "this one",
            "write `value = true` or `value = false`, and leave out `full`, `zero` and `at_least`";
        Number { sensor: String }:
            "lab::sensor_reads", "sensor `{sensor}` reads numbers", "this one", "write `full` and `zero`, in its unit";
        Window { from_s: f64, to_s: f64 }:
            "lab::sensor_reads", "the part that counts ends before it begins, got {from_s} s to {to_s} s", "this part",
            "exchange the two";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A sensor of the task.
    sensor: At<String>,
    /// The part of a sensor with several numbers, such as `fz`; the first where it is left out.
    part: Option<At<String>>,
    /// What counts: `end` (the last reading), `min`, `max` or `mean`; `end` where it is left out.
    #[serde(default)]
    of: Which,
    /// Where the part of the run begins that counts \[s\]; the start where it is left out.
    from_s: Option<At<f64>>,
    /// Where it ends \[s\]; the end of the run where it is left out.
    to_s: Option<At<f64>>,
    /// What it should read: `true` or `false` of a switch, a number of others; the reading itself is held against the band where it is
    /// left out.
    value: Option<Wanted>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// What earns all points, in the sensor's unit.
    full: Option<BandEnd>,
    /// What earns none.
    zero: Option<BandEnd>,
}

impl MotionTable for Table {
    const NAME: &'static str = "sensor-reads";
    type Check = SensorReads;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let channel = reading.channel(&self.sensor, self.part.as_ref())?;
        let (is_switch, unit) = (channel.is_switch, channel.unit);
        let readings = self.readings(reading, channel)?;
        let sensor = self.sensor.get_ref().clone();
        let band = self.full.zip(self.zero);
        match (is_switch, self.value, band) {
            (true, Some(Wanted::Switched(wanted)), None) if self.has_no_band() => {
                Ok(SensorReads::Switch(readings, wanted))
            }
            (true, ..) => reading.refuse_at(&self.sensor, WantedProblem::Switch { sensor }),
            (false, Some(Wanted::Switched(_)), _) | (false, _, None) => {
                reading.refuse_at(&self.sensor, WantedProblem::Number { sensor })
            }
            (false, wanted, Some((full, zero))) => {
                let wanted = match wanted {
                    Some(Wanted::Number(wanted)) => Some(wanted),
                    _ => None,
                };
                let measure = NumberRead { readings, wanted };
                let band = [full, zero];
                let number = reading.in_band_either(self.at_least, band, unit, measure)?;
                Ok(SensorReads::Number(number))
            }
        }
    }
}

impl Table {
    fn has_no_band(&self) -> bool {
        self.full.is_none() && self.zero.is_none() && !self.at_least
    }

    /// The part of the run that counts.
    fn readings(
        &self,
        reading: &MotionReading<'_>,
        channel: Channel,
    ) -> Result<Readings, LabError> {
        let [first, last] = reading.part_of_run(
            self.from_s.as_ref(),
            self.to_s.as_ref(),
            |from_s, to_s| -> Box<dyn Problem> { Box::new(WantedProblem::Window { from_s, to_s }) },
        )?;
        Ok(Readings {
            channel,
            of: self.of,
            first,
            last,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) enum SensorReads {
    /// A switch that should read so.
    Switch(Readings, bool),
    /// A number in a band.
    Number(InBand<NumberRead>),
}

/// What counts of what a sensor reads.
#[derive(Debug)]
pub(crate) struct Readings {
    channel: Channel,
    of: Which,
    /// The first tick that counts.
    first: usize,
    /// The last one.
    last: usize,
}

impl Readings {
    /// What counts, and the tick that shows it.
    fn read(&self, facts: &MotionFacts<'_>) -> (usize, f64) {
        let last = self.last.min(facts.last_tick());
        let first = self.first.min(last);
        let signal = facts.trace.sensors.component(self.channel.index);
        let readings: Vec<f64> = signal.skip(first).take(last - first + 1).collect();
        let (index, read) = match self.of {
            Which::End => (last - first, readings.last().copied().unwrap_or(f64::NAN)),
            Which::Max => greatest(readings).unwrap_or_default(),
            Which::Min => {
                let least = greatest(readings.iter().map(|read| -read)).unwrap_or_default();
                (least.0, -least.1)
            }
            Which::Mean => {
                let sum: f64 = readings.iter().sum();
                (last - first, sum / readings.len() as f64)
            }
        };
        (first + index, read)
    }

    fn number(&self, value: f64) -> String {
        match self.channel.is_switch {
            true if value > 0.5 => "true".to_owned(),
            true => "false".to_owned(),
            false => with_unit(value, self.channel.unit),
        }
    }

    /// What it read, and what was asked for, if points are lost.
    fn explained(&self, facts: &MotionFacts<'_>, finding: Finding, wanted: Option<f64>) -> Finding {
        let (tick, read) = self.read(facts);
        let (name, words) = (&self.channel.name, self.of.words());
        let finding = finding.shown_at(facts, || {
            let wanted = match wanted {
                Some(wanted) => format!("; it was to be {}", self.number(wanted)),
                None => String::new(),
            };
            let message = format!(
                "the {words} of `{name}`, at {}, is {}{wanted}",
                seconds(facts.time_s(tick)),
                self.number(read),
            );
            (message, format!("sensors[{}]", self.channel.index), tick)
        });
        finding.advise(format!(
            "What makes `{name}` read so? Compare its plot with the motion of the arm."
        ))
    }
}

impl MotionCheck for SensorReads {
    fn bounds(&self) -> [String; 2] {
        match self {
            Self::Switch(_, wanted) => [format!("it is {wanted}"), format!("it is {}", !wanted)],
            Self::Number(number) => number.bounds(),
        }
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        match self {
            Self::Switch(readings, wanted) => {
                let wanted = if *wanted { 1.0 } else { 0.0 };
                let (_, read) = readings.read(facts);
                let score = if (read - wanted).abs() < 0.5 {
                    1.0
                } else {
                    0.0
                };
                let (name, words) = (&readings.channel.name, readings.of.words());
                let wanted_words = readings.number(wanted);
                let finding = Finding::share(
                    score,
                    format!("whether the {words} of `{name}` is {wanted_words}"),
                );
                readings.explained(facts, finding, Some(wanted))
            }
            Self::Number(number) => number.judge(facts),
        }
    }

    fn reference_use(&self) -> FromReference {
        match self {
            Self::Switch(..) => FromReference::Nothing,
            Self::Number(number) => number.reference_use(),
        }
    }

    fn at_reference(&self, value: f64) -> Option<Arc<dyn MotionCheck>> {
        match self {
            Self::Switch(..) => None,
            Self::Number(number) => number.at_reference(value),
        }
    }
}

/// What a sensor reads, or its distance from a number.
#[derive(Debug)]
pub(crate) struct NumberRead {
    readings: Readings,
    /// What it should read.
    wanted: Option<f64>,
}

impl RunMeasure for NumberRead {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let (_, read) = self.readings.read(facts);
        let value = self.wanted.map_or(read, |wanted| (read - wanted).abs());
        let (name, words) = (&self.readings.channel.name, self.readings.of.words());
        let quantity = match self.wanted {
            Some(wanted) => {
                let wanted = self.readings.number(wanted);
                format!("distance of the {words} of `{name}` from {wanted}")
            }
            None => format!("{words} of `{name}`"),
        };
        let finding = Finding::against(band, value, self.readings.channel.unit, quantity);
        self.readings.explained(facts, finding, self.wanted)
    }
}
