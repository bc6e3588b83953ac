//! contact-impulse: how hard and how long two pressed on each other, all contacts together \[N s\].
//!
//! Measured is the sum of the normal impulses of all contacts of the two, `Σ ∫ F dt`. Two that could touch but never did
//! have 0, and two that can never touch are refused. An arm that stays where it is touches nothing, so let this check need another.

use kinemark_sim::watch::ContactSpan;

use crate::check::prelude::*;
use crate::check::touching::two_that_touch;
use crate::task::watched::TouchingParty;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The two: `arm` (any link of the robot), a link, a body of the scene, or `ground`.
    between: [At<String>; 2],
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Impulse that earns all points \[N s\].
    full_n_s: BandEnd,
    /// Impulse that earns none \[N s\].
    zero_n_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "contact-impulse";
    type Check = InBand<ContactImpulse>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let between = two_that_touch(reading, Self::NAME, &self.between)?;
        reading.in_band_either(
            self.at_least,
            [self.full_n_s, self.zero_n_s],
            "N s",
            ContactImpulse(between),
        )
    }
}

/// The impulse between these two.
#[derive(Debug)]
pub(crate) struct ContactImpulse([TouchingParty; 2]);

/// All contacts of two, together.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Touches<'a> {
    count: usize,
    impulse_n_s: f64,
    first: &'a ContactSpan,
    hardest: &'a ContactSpan,
}

fn touches(contacts: &[ContactSpan], between: [TouchingParty; 2]) -> Option<Touches<'_>> {
    let mut all: Option<Touches<'_>> = None;
    for span in contacts {
        if !between[0].meets(between[1], span.parties) {
            continue;
        }
        let so_far = all.get_or_insert(Touches {
            count: 0,
            impulse_n_s: 0.0,
            first: span,
            hardest: span,
        });
        so_far.count += 1;
        so_far.impulse_n_s += span.impulse_n_s;
        if span.first_tick < so_far.first.first_tick {
            so_far.first = span;
        }
        if span.peak_force_n > so_far.hardest.peak_force_n {
            so_far.hardest = span;
        }
    }
    all
}

impl RunMeasure for ContactImpulse {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let found = touches(&facts.trace.contacts, self.0);
        let value = found.map_or(0.0, |touches| touches.impulse_n_s);
        let [a, b] = self.0.map(|party| party.in_sentence(&facts.names));
        let quantity = format!("impulse between {a} and {b}");
        let mut curve = facts.curve(
            "impulse so far, each contact's at its peak",
            "N s",
            self.so_far(facts),
            band,
        );
        let mut finding = Finding::against(band, value, "N s", quantity);
        if let Some(touches) = found {
            let first = touches.first.first_tick as usize;
            curve.marks = vec![(facts.time_s(first), "first touch".to_owned())];
            finding = finding.shown_at(facts, || {
                (message(facts, &touches), "contacts".to_owned(), first)
            });
        }
        if found.is_none() && finding.is_lost() {
            let message = format!("{a} and {b} never pressed on each other");
            let last = facts.last_tick();
            finding = finding.with(facts.evidence(message, "contacts".to_owned(), last));
        }
        finding
            .advise(band.advice(
                format!("Leave more room between {a} and {b} on the way."),
                format!("Let {a} and {b} press on each other harder, or for longer."),
            ))
            .drawn(curve)
    }
}

fn message(facts: &MotionFacts<'_>, touches: &Touches<'_>) -> String {
    let [a, b] = touches.first.parties.map(|party| facts.names.party(party));
    let contacts = match touches.count {
        1 => "in this contact".to_owned(),
        count => format!("in {count} contacts"),
    };
    let first = (touches.first.first_tick as usize).min(facts.last_tick());
    format!(
        "`{a}` first touched `{b}` at {}, with the hand at {}; {contacts} the impulse is {} N s, and the force {} N at its peak, at {}",
        seconds(facts.motion.periods.time_s(touches.first.first_tick)),
        list(facts.trace.tcp_position(first).as_slice()),
        trimmed(touches.impulse_n_s, 3),
        trimmed(touches.hardest.peak_force_n, 1),
        seconds(facts.motion.periods.time_s(touches.hardest.peak_tick)),
    )
}

impl ContactImpulse {
    /// The impulse so far, each contact's added where its force is at its peak: what went before and after is not in a trace.
    fn so_far(&self, facts: &MotionFacts<'_>) -> Vec<f64> {
        let ticks = facts.trace.len();
        let mut values = vec![0.0; ticks];
        let [one, other] = self.0;
        let contacts = facts.trace.contacts.iter();
        for span in contacts.filter(|span| one.meets(other, span.parties)) {
            let from = (span.peak_tick as usize).min(ticks);
            for value in &mut values[from..] {
                *value += span.impulse_n_s;
            }
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::model::contact::Party;
    use nalgebra::Vector3;

    fn span(parties: [Party; 2], first_tick: u64, impulse_n_s: f64, peak_n: f64) -> ContactSpan {
        ContactSpan {
            parties,
            first_tick,
            last_tick: first_tick + 9,
            peak_force_n: peak_n,
            peak_tick: first_tick + 4,
            peak_normal_in_world: nalgebra::Vector3::zeros(),
            impulse_n_s,
            depth_m: 0.0,
            p_first_in_world: Vector3::zeros(),
        }
    }

    #[test]
    fn contacts_of_the_two_add_up_and_others_do_not_count() {
        let (shelf, can) = (Party::Body(0), Party::Body(1));
        let contacts = [
            span([shelf, can], 1, 9.0, 4.0),
            span([Party::Link(2), shelf], 50, 0.25, 30.0),
            span([Party::Link(2), can], 60, 0.75, 5.0),
            span([Party::Link(1), shelf], 40, 0.125, 20.0),
            span([Party::Link(2), Party::Ground], 70, 0.5, 1.0),
        ];
        let arm_and = |other| touches(&contacts, [TouchingParty::Arm, other]);
        let of_shelf = arm_and(TouchingParty::Body(0)).expect("two contacts");
        assert_eq!((of_shelf.count, of_shelf.impulse_n_s), (2, 0.375));
        assert_eq!(of_shelf.first.first_tick, 40);
        assert_eq!(of_shelf.hardest.peak_tick, 54);
        let of_ground = arm_and(TouchingParty::Ground).expect("one contact");
        assert_eq!(of_ground.impulse_n_s, 0.5);
        // the order in which the lab names them says nothing
        for between in [
            [TouchingParty::Body(1), TouchingParty::Body(0)],
            [TouchingParty::Body(0), TouchingParty::Body(1)],
        ] {
            let found = touches(&contacts, between).expect("shelf and can");
            assert_eq!(found.impulse_n_s, 9.0);
        }
        let link = TouchingParty::Link(1);
        let found = touches(&contacts, [TouchingParty::Body(0), link]).expect("one");
        assert_eq!(found.impulse_n_s, 0.125);
        assert!(arm_and(TouchingParty::Body(7)).is_none());
    }
}
