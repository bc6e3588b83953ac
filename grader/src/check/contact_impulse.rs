//! contact-impulse: how hard and how long two pressed on each other, all contacts together \[N s\].
//!
//! Measured is the sum of the normal impulses of all contacts of the two, `Σ ∫ F dt`. Two that never met have 0: an arm that stays
//! where it is touches nothing, so a lab lets this check need another.

use kinemark_sim::watch::ContactSpan;

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::watched::TouchingParty;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

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

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    between: [TouchingParty; 2],
    band: Band,
    check: &str,
) -> Finding {
    let found = touches(&facts.trace.contacts, between);
    let value = found.map_or(0.0, |touches| touches.impulse_n_s);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let Some(touches) = found
        && score < 1.0
    {
        let [a, b] = touches.first.parties.map(|party| facts.names.party(party));
        let contacts = match touches.count {
            1 => "in this contact".to_owned(),
            count => format!("in {count} contacts"),
        };
        let message = format!(
            "`{a}` first touched `{b}` at {}; {contacts} the impulse is {} N s, and the force {} N at its peak, at {}",
            seconds(facts.motion.periods.time_s(touches.first.first_tick)),
            trimmed(value, 3),
            trimmed(touches.hardest.peak_force_n, 1),
            seconds(facts.motion.periods.time_s(touches.hardest.peak_tick)),
        );
        let first = touches.first.first_tick as usize;
        evidence.push(Evidence {
            value: Some(value),
            limit: Some(band.full),
            unit: "N s".to_owned(),
            ..facts.evidence(message, "contacts".to_owned(), first)
        });
    }
    let [a, b] = between.map(|party| party.told(&facts.names));
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("impulse between {a} and {b}"),
            value: value.is_finite().then_some(value),
            unit: "N s".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: format!("Leave more room between {a} and {b} on the way."),
        curve: Some(curve(facts, between, band, check)),
    }
}

/// The impulse so far, each contact's added where its force is at its peak: what went before and after is not in a trace.
fn curve(facts: &MotionFacts<'_>, between: [TouchingParty; 2], band: Band, check: &str) -> Curve {
    let ticks = facts.trace.len();
    let mut values = vec![0.0; ticks];
    let contacts = facts.trace.contacts.iter();
    for span in contacts.filter(|span| between[0].meets(between[1], span.parties)) {
        let from = (span.peak_tick as usize).min(ticks);
        for value in &mut values[from..] {
            *value += span.impulse_n_s;
        }
    }
    let found = touches(&facts.trace.contacts, between);
    let marks = found.map(|touches| {
        let at = facts.motion.periods.time_s(touches.first.first_tick);
        (at, "first touch".to_owned())
    });
    Curve {
        check: check.to_owned(),
        title: "impulse so far, each contact's at its peak".to_owned(),
        unit: "N s".to_owned(),
        t_s: (0..ticks).map(|tick| facts.time_s(tick)).collect(),
        values,
        full: Some(band.full),
        zero: Some(band.zero),
        marks: marks.into_iter().collect(),
        step: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_sim::engine::Party;
    use nalgebra::Vector3;

    fn span(parties: [Party; 2], first_tick: u64, impulse_n_s: f64, peak_n: f64) -> ContactSpan {
        ContactSpan {
            parties,
            first_tick,
            last_tick: first_tick + 9,
            peak_force_n: peak_n,
            peak_tick: first_tick + 4,
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
