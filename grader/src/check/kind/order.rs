//! order: some things happen in the run, one after the other.
//!
//! Each of `events` is an event, a touch, a sensor that comes to read something, or a joint that passes a position, with the keys of
//! `never`. It is looked for after the one before it; the score is the share of them that are found, up to the first that is not, or
//! with `whole` all or nothing. What happens besides, and again, does not count.

use crate::check::occurrence::{Occurrence, OccurrenceTable};
use crate::check::prelude::*;

problems! {
    /// A list that has no order.
    enum OrderProblem {
        Count { count: usize }:
            "lab::order", "an order is one of 2 to 20 events, got {count}", "this check",
            "such as `events = [{ sensor = \"lift_top\", becomes = true }, { event = \"moved\", body = \"can\" }]`";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// What is to happen, in order: 2 to 20 tables.
    events: Vec<OccurrenceTable>,
    /// Whether all points are for the whole order and none for a part of it; false where it is left out.
    #[serde(default)]
    whole: bool,
}

impl MotionTable for Table {
    const NAME: &'static str = "order";
    type Check = Order;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let count = self.events.len();
        if !(2..=20).contains(&count) {
            return reading.refuse(OrderProblem::Count { count });
        }
        let events = self.events.iter();
        let events = events.map(|event| event.read(reading, Self::NAME));
        Ok(Order {
            events: events.collect::<Result<_, _>>()?,
            whole: self.whole,
        })
    }
}

/// What is to happen, in order.
#[derive(Debug)]
pub(crate) struct Order {
    events: Vec<Occurrence>,
    /// Whether a part of the order earns nothing.
    whole: bool,
}

impl MotionCheck for Order {
    fn bounds(&self) -> [String; 2] {
        let all = format!("all {} in order", self.events.len());
        let none = match self.whole {
            true => "one of them does not happen in its turn",
            false => "the first does not happen",
        };
        [all, none.to_owned()]
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let mut after: Option<usize> = None;
        let mut found = 0;
        for (i, event) in self.events.iter().enumerate() {
            // two things may happen at once, but not the same thing twice
            let is_again = i > 0 && self.events[i - 1] == *event;
            let follows = |tick: &usize| {
                after.is_none_or(|after| *tick > after || (*tick == after && !is_again))
            };
            let next = event.ticks(facts).into_iter().find(follows);
            let Some(tick) = next else { break };
            after = Some(tick);
            found += 1;
        }
        let count = self.events.len();
        let (score, quantity) = match self.whole {
            true => (
                f64::from(u8::from(found == count)),
                "whether the events happened in order",
            ),
            false => (
                found as f64 / count as f64,
                "share of the events that happened in order",
            ),
        };
        let finding = Finding::share(score, quantity);
        let Some(missing) = self.events.get(found) else {
            return finding;
        };
        let what = missing.in_words(facts);
        let ever = missing.ticks(facts);
        let before = found.checked_sub(1).map(|i| self.events[i].in_words(facts));
        let (message, tick) = match (ever.last(), before, after) {
            (Some(&early), Some(before), Some(after)) => (
                format!(
                    "{what} at {}, but is to do so after {before}, which is at {}",
                    seconds(facts.time_s(early)),
                    seconds(facts.time_s(after)),
                ),
                early,
            ),
            (_, Some(before), Some(after)) => (
                format!(
                    "{before} at {}; after that is to happen, and never did: {what}",
                    seconds(facts.time_s(after))
                ),
                facts.last_tick(),
            ),
            _ => (
                format!("this is to happen first, and never did: {what}"),
                facts.last_tick(),
            ),
        };
        finding
            .with(facts.evidence(message, missing.signal(), tick))
            .advise(format!(
                "Number {} of {count} is missing: in which order does your program ask for them?",
                found + 1
            ))
    }
}
