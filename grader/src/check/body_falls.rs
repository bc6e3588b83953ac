//! body-falls: a free body of the scene falls off what it stood on, over a named side or over any.
//!
//! Fixed scores instead of a band: 1 where it fell so; `toppled` where it toppled only, or fell over another side or over none;
//! `moved` where it was only moved; 0 where it stayed. What each word means is told in [`kinemark_sim::watch`].

use kinemark_sim::event::{EventKind, SeenSide};
use kinemark_sim::trace::Trace;

use super::{Finding, MotionFacts};
use crate::lab::watched::{Fall, TouchingParty};
use crate::record::grade::{Evidence, Measure};
use crate::record::names::Names;
use crate::record::quantity::seconds;

/// What happened to the body: first ticks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Fate {
    moved: Option<u64>,
    toppled: Option<u64>,
    /// With the side, if it fell over one.
    fell: Option<(u64, Option<SeenSide>)>,
    /// A link of the arm touched it.
    touched: Option<u64>,
}

impl Fate {
    fn of(trace: &Trace, body: usize) -> Self {
        let mut fate = Self::default();
        for event in trace.events.iter().filter(|e| e.kind.body() == Some(body)) {
            match &event.kind {
                EventKind::Moved { .. } => fate.moved = fate.moved.or(Some(event.tick)),
                EventKind::Toppled { .. } => fate.toppled = fate.toppled.or(Some(event.tick)),
                EventKind::BodyFell { side, .. } => {
                    let side = side.map(|side| side.seen);
                    fate.fell = fate.fell.or(Some((event.tick, side)));
                }
                _ => {}
            }
        }
        let touches = trace.contacts.iter();
        let touches = touches
            .filter(|contact| TouchingParty::Arm.meets(TouchingParty::Body(body), contact.parties));
        fate.touched = touches.map(|contact| contact.first_tick).min();
        fate
    }

    fn score(&self, fall: &Fall) -> f64 {
        match (self.fell, self.toppled, self.moved) {
            (Some((_, side)), ..) if fall.side.is_none() || side == fall.side => 1.0,
            (Some(_), ..) | (_, Some(_), _) => fall.toppled,
            (.., Some(_)) => fall.moved,
            (None, None, None) => 0.0,
        }
    }

    /// What did happen, with its tick, and one thing to do; the score is not full.
    fn told(
        &self,
        fall: &Fall,
        names: &Names<'_>,
        time_s: impl Fn(u64) -> f64,
    ) -> (String, Option<u64>, String) {
        let name = names.body(fall.body);
        let at = |tick: u64| format!("at {}", seconds(time_s(tick)));
        let went = [("moved", self.moved), ("toppled", self.toppled)];
        let went: Vec<String> = went
            .iter()
            .filter_map(|(word, tick)| Some(format!("{word} {}", at((*tick)?))))
            .collect();
        match (self.fell, self.toppled.or(self.moved)) {
            (Some((tick, side)), _) => {
                let over = match side {
                    Some(side) => format!("over the {} side", side.name()),
                    None => "over none of the sides of what it stood on".to_owned(),
                };
                let wanted = fall.side.map_or("a", SeenSide::name);
                (
                    format!(
                        "`{name}` fell {over} {}; it was to fall over the {wanted} side",
                        at(tick)
                    ),
                    Some(tick),
                    format!(
                        "Push `{name}` towards the {wanted} side: start from the one opposite to it."
                    ),
                )
            }
            (None, Some(last)) => (
                format!("`{name}` {}, but did not fall", went.join(" and ")),
                Some(last),
                format!("Push `{name}` further, until it is over the edge."),
            ),
            (None, None) => match self.touched {
                Some(tick) => (
                    format!("`{name}` was touched {}, but stayed where it was", at(tick)),
                    Some(tick),
                    format!("Push on where the arm meets `{name}`, until it is over the edge."),
                ),
                None => (
                    format!("`{name}` stayed where it was: the arm never touched it"),
                    None,
                    format!("Lead the arm to `{name}`, and on through the place where it stands."),
                ),
            },
        }
    }
}

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, fall: &Fall) -> Finding {
    let fate = Fate::of(facts.trace, fall.body);
    let score = fate.score(fall);
    let (message, tick, next_step) =
        fate.told(fall, &facts.names, |tick| facts.motion.periods.time_s(tick));
    let mut evidence = Vec::new();
    if score < 1.0 {
        let last = facts.trace.len().saturating_sub(1);
        let tick = tick.map_or(last, |tick| tick as usize);
        evidence.push(Evidence {
            value: Some(score),
            limit: Some(1.0),
            ..facts.evidence(message, "bodies".to_owned(), tick)
        });
    }
    let name = facts.names.body(fall.body);
    let side = fall.side.map_or_else(String::new, |side| {
        format!(" over the {} side", side.name())
    });
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("how far `{name}` got towards falling{side}"),
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence,
        next_step,
        curve: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAR: Fall = Fall {
        body: 1,
        side: Some(SeenSide::Far),
        toppled: 0.6,
        moved: 0.3,
    };

    fn fate(moved: bool, toppled: bool, fell: Option<Option<SeenSide>>) -> Fate {
        Fate {
            moved: moved.then_some(3210),
            toppled: toppled.then_some(3300),
            fell: fell.map(|side| (3500, side)),
            touched: moved.then_some(3200),
        }
    }

    #[test]
    fn each_fate_has_its_score() {
        let any = Fall { side: None, ..FAR };
        let far = Some(Some(SeenSide::Far));
        let near = Some(Some(SeenSide::Near));
        for (fate, of_far, of_any) in [
            (fate(false, false, None), 0.0, 0.0),
            (fate(true, false, None), 0.3, 0.3),
            (fate(true, true, None), 0.6, 0.6),
            (fate(true, true, near), 0.6, 1.0),
            // through what it stood on, upright
            (fate(true, false, Some(None)), 0.6, 1.0),
            (fate(true, false, far), 1.0, 1.0),
        ] {
            assert_eq!((fate.score(&FAR), fate.score(&any)), (of_far, of_any));
        }
    }

    #[test]
    fn what_did_happen_is_told_with_its_times() {
        let run = crate::record::sample::task_run();
        let names = run.names();
        let told = |fate: Fate| fate.told(&FAR, &names, |tick| tick as f64 / 1000.0);
        let (message, tick, _) = told(fate(true, true, None));
        // the sample has no scene, so its bodies have no names
        assert_eq!(
            message,
            "`?` moved at 3.21 s and toppled at 3.3 s, but did not fall"
        );
        assert_eq!(tick, Some(3300));
        let (message, ..) = told(fate(true, true, Some(Some(SeenSide::Near))));
        assert_eq!(
            message,
            "`?` fell over the near side at 3.5 s; it was to fall over the far side"
        );
        let (message, tick, _) = told(fate(false, false, None));
        assert!(message.ends_with("the arm never touched it"), "{message}");
        assert_eq!(tick, None);
    }
}
