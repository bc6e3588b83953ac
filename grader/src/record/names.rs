//! The events and contacts of a run that a record keeps, in words.

use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::Trace;
pub use kinemark_sim::watch::Names;
use kinemark_sim::watch::event::EventKind;

use crate::record::grade::{ContactRecord, EventRecord};

/// Most contacts, and most events of bodies, that a record keeps.
const MOST_RECORDS: usize = 200;
/// Most events of joints and of singular configurations that a record keeps in addition: an oscillating loop makes thousands.
const MOST_OF_JOINTS: usize = 100;

/// The events of a run that a record keeps.
pub fn events(names: &Names<'_>, trace: &Trace, periods: &Periods) -> Vec<EventRecord> {
    let (mut of_joints, mut others) = (0, 0);
    let kept = trace.events.iter().filter(|event| {
        let joints = event.kind.joint().is_some() || event.kind == EventKind::NearSingular;
        let (count, most) = if joints {
            (&mut of_joints, MOST_OF_JOINTS)
        } else {
            (&mut others, MOST_RECORDS)
        };
        *count += 1;
        // the end of a run is always kept, and so is what makes it inaccurate, of which there are two for each joint at most
        let always = matches!(
            event.kind,
            EventKind::Diverged | EventKind::Stopped | EventKind::UnderResolved { .. }
        );
        *count <= most || always
    });
    kept.map(|event| EventRecord {
        tick: event.tick,
        time_s: periods.time_s(event.tick),
        event: event.kind.name().to_owned(),
        message: names.event(&event.kind),
    })
    .collect()
}

/// The contacts of a run that a record keeps.
pub fn contacts(names: &Names<'_>, trace: &Trace) -> Vec<ContactRecord> {
    let contacts = trace.contacts.iter().take(MOST_RECORDS);
    contacts
        .map(|contact| ContactRecord {
            parties: contact.parties.map(|party| names.party(party).to_owned()),
            first_tick: contact.first_tick,
            last_tick: contact.last_tick,
            peak_force_n: contact.peak_force_n,
            peak_tick: contact.peak_tick,
            impulse_n_s: contact.impulse_n_s,
        })
        .collect()
}
