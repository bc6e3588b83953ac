//! order: some things happen in the run, one after the other.
//!
//! Each of `events` is an event, a touch, or a sensor that comes to read something, with the keys of `never`. It is looked for after
//! the one before it; the score is the share of them that are found, up to the first that is not. What happens besides, and again,
//! does not count.

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
        Ok(Order(events.collect::<Result<_, _>>()?))
    }
}

/// What is to happen, in order.
#[derive(Debug)]
pub(crate) struct Order(Vec<Occurrence>);

impl MotionCheck for Order {
    fn bounds(&self) -> [String; 2] {
        let all = format!("all {} in order", self.0.len());
        [all, "the first does not happen".to_owned()]
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let mut after: Option<usize> = None;
        let mut found = 0;
        for (i, event) in self.0.iter().enumerate() {
            // two things may happen at once, but not the same thing twice
            let is_again = i > 0 && self.0[i - 1] == *event;
            let follows = |tick: &usize| {
                after.is_none_or(|after| *tick > after || (*tick == after && !is_again))
            };
            let next = event.ticks(facts).into_iter().find(follows);
            let Some(tick) = next else { break };
            after = Some(tick);
            found += 1;
        }
        let count = self.0.len();
        let score = found as f64 / count as f64;
        let finding = Finding::share(score, "share of the events that happened in order");
        let Some(missing) = self.0.get(found) else {
            return finding;
        };
        let what = missing.in_words(facts);
        let ever = missing.ticks(facts);
        let before = found.checked_sub(1).map(|i| self.0[i].in_words(facts));
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
