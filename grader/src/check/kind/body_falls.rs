//! body-falls: a dynamic body of the scene falls off what it stood on, over a named side or over any.
//!
//! It has fixed scores instead of a band: 1 where it fell over the named side; `toppled` where it only toppled, or fell
//! over another side or over none; `moved` where it only moved; 0 where it stayed. [physics.md](physics.md#what-a-run-reports) defines
//! these words. It does not matter how the body was brought down.

use kinemark_sim::trace::Trace;
use kinemark_sim::watch::event::{EventKind, SeenSide};

use crate::check::prelude::*;
use crate::record::names::Names;
use crate::task::watched::TouchingParty;

/// A side of what a body stands on, seen from the robot's base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum SideName {
    Far,
    Near,
    Left,
    Right,
}

problems! {
    /// Shares of the points that do not grow with what happened.
    enum ShareProblem {
        NotInOrder { moved: f64, toppled: f64 }:
            "lab::body_falls", "`moved` and `toppled` are shares in order, 0 <= moved <= toppled <= 1, got {moved} and {toppled}",
            "this check", "left out they are 0.3 and 0.6";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A dynamic body of the scene.
    body: At<String>,
    /// The side it should fall over, as seen from the robot's first joint: `far`, `near`, `left` or `right`; any where it is left
    /// out.
    side: Option<SideName>,
    /// Share of the points where it toppled, or fell otherwise; 0.6 where it is left out.
    toppled: Option<f64>,
    /// Share of the points where it only moved; 0.3 where it is left out.
    moved: Option<f64>,
}

impl MotionTable for Table {
    const NAME: &'static str = "body-falls";
    type Check = BodyFalls;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let body = reading.free_body(reading.scene(Self::NAME)?, &self.body)?;
        let (toppled, moved) = (self.toppled.unwrap_or(0.6), self.moved.unwrap_or(0.3));
        if !(0.0 <= moved && moved <= toppled && toppled <= 1.0) {
            return reading.refuse(ShareProblem::NotInOrder { moved, toppled });
        }
        Ok(BodyFalls(Fall {
            body,
            side: self.side.map(|side| match side {
                SideName::Far => SeenSide::Far,
                SideName::Near => SeenSide::Near,
                SideName::Left => SeenSide::Left,
                SideName::Right => SeenSide::Right,
            }),
            toppled,
            moved,
        }))
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct BodyFalls(Fall);

/// How a free body is to fall, and what less than that is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fall {
    /// Index of the body in the scene.
    body: usize,
    /// The side it is to fall over; any where there is none.
    side: Option<SeenSide>,
    /// Share of the points where it toppled, or fell otherwise.
    toppled: f64,
    /// Share of the points where it only moved.
    moved: f64,
}

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
    fn explained(
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

impl MotionCheck for BodyFalls {
    fn bounds(&self) -> [String; 2] {
        let Self(fall) = self;
        let falls = match fall.side {
            Some(side) => format!("it falls over the {} side", side.name()),
            None => "it falls".to_owned(),
        };
        let stays = format!(
            "it stays ({} if it topples, {} if it moves)",
            with_unit(fall.toppled, ""),
            with_unit(fall.moved, "")
        );
        [falls, stays]
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let Self(fall) = self;
        let fate = Fate::of(facts.trace, fall.body);
        let score = fate.score(fall);
        let (message, tick, next_step) =
            fate.explained(fall, &facts.names, |tick| facts.motion.periods.time_s(tick));
        let name = facts.names.body(fall.body);
        let side = fall.side.map_or_else(String::new, |side| {
            format!(" over the {} side", side.name())
        });
        let quantity = format!("how far `{name}` got towards falling{side}");
        let finding = Finding::share(score, quantity).advise(next_step);
        finding.shown_at(facts, || {
            let tick = tick.map_or(facts.last_tick(), |tick| tick as usize);
            (message, "bodies".to_owned(), tick)
        })
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
    fn what_did_happen_is_explained_with_its_times() {
        let run = crate::record::sample::task_run();
        let names = run.names();
        let explained = |fate: Fate| fate.explained(&FAR, &names, |tick| tick as f64 / 1000.0);
        let (message, tick, _) = explained(fate(true, true, None));
        // the sample has no scene, so its bodies have no names
        assert_eq!(
            message,
            "`?` moved at 3.21 s and toppled at 3.3 s, but did not fall"
        );
        assert_eq!(tick, Some(3300));
        let (message, ..) = explained(fate(true, true, Some(Some(SeenSide::Near))));
        assert_eq!(
            message,
            "`?` fell over the near side at 3.5 s; it was to fall over the far side"
        );
        let (message, tick, _) = explained(fate(false, false, None));
        assert!(message.ends_with("the arm never touched it"), "{message}");
        assert_eq!(tick, None);
    }
}
