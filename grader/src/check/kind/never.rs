//! never: something must not happen in the run: an event, a touch, a sensor that comes to read something, or a joint that passes a
//! position.
//!
//! It earns all points where it happens no more often than `at_most`, and none where it does. An arm that does nothing lets nothing
//! happen, so let this check need another.

use crate::check::occurrence::{Becomes, Occurrence, OccurrenceTable};
use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// An event of [physics.md](physics.md#what-a-run-reports): `moved`, `toppled`, `left-support` or `body-fell` of a body;
    /// `saturated`, `limit-hit` or `speed-limit-hit` of a joint; `near-singular`.
    event: Option<At<String>>,
    /// The body of the event; any where it is left out.
    body: Option<At<String>>,
    /// The joint of the event; any where it is left out. Without an event, the joint whose position comes to be what `becomes` says.
    joint: Option<At<String>>,
    /// In place of an event, two that touch, as in `contact-impulse`.
    touch: Option<[At<String>; 2]>,
    /// In place of an event, a sensor that comes to read what `becomes` says.
    sensor: Option<At<String>>,
    /// The part of a sensor with several numbers, such as `fz`; the first where it is left out.
    part: Option<At<String>>,
    /// What the sensor comes to read: `true` or `false` of a switch, `{ above = 2.0 }` or `{ below = 2.0 }` of others, in the
    /// sensor's unit; or which position the joint passes, in rad, or m of a prismatic joint. It happens anew each time, not at the
    /// start.
    becomes: Option<Becomes>,
    /// How often it may happen; 0 where it is left out.
    #[serde(default)]
    at_most: u32,
}

impl MotionTable for Table {
    const NAME: &'static str = "never";
    type Check = Never;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let table = OccurrenceTable {
            event: self.event.clone(),
            body: self.body.clone(),
            joint: self.joint.clone(),
            touch: self.touch.clone(),
            sensor: self.sensor.clone(),
            part: self.part.clone(),
            becomes: self.becomes,
        };
        Ok(Never {
            occurrence: table.read(reading, Self::NAME)?,
            at_most: self.at_most as usize,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Never {
    occurrence: Occurrence,
    /// How often it may happen.
    at_most: usize,
}

fn times(count: usize) -> String {
    match count {
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        count => format!("{count} times"),
    }
}

impl MotionCheck for Never {
    fn bounds(&self) -> [String; 2] {
        match self.at_most {
            0 => ["it never happens".to_owned(), "it happens".to_owned()],
            most => [
                format!("it happens {} at most", times(most)),
                "it happens more often".to_owned(),
            ],
        }
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let ticks = self.occurrence.ticks(facts);
        let what = self.occurrence.in_words(facts);
        let too_many = ticks.get(self.at_most);
        let score = if too_many.is_some() { 0.0 } else { 1.0 };
        let finding = Finding::share(score, format!("whether {what} no more often than allowed"));
        let Some(&tick) = too_many else {
            return finding;
        };
        let mut message = format!("{what} at {}", seconds(facts.time_s(tick)));
        if self.at_most > 0 {
            let (most, count) = (times(self.at_most), times(ticks.len()));
            message += &format!(": this may happen {most}, and happens {count}");
        } else if ticks.len() > 1 {
            message += &format!(", and {} in all", times(ticks.len()));
        }
        finding
            .with(facts.evidence(message, self.occurrence.signal(), tick))
            .advise(format!(
                "What does the arm do just before {}? See that moment in the replay.",
                seconds(facts.time_s(tick))
            ))
    }
}
