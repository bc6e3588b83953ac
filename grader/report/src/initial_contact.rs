//! Contacts that are there before anything has moved, such as of what rests on another: they are no news.

use kinemark_sim::model::contact::Party;
use kinemark_sim::watch::event::EventKind;

use kinemark_grader::record::graded::TaskRun;

/// Bodies that touch each other before this have done so from the start: they settle in less \[s\].
const SETTLED_S: f64 = 0.1;

/// Whether two that first touch each other at `tick` have done so from the start. What the arm touches is always news.
pub(super) fn is_initial(parties: [Party; 2], tick: u64, run: &TaskRun) -> bool {
    let arm = parties.iter().any(|party| matches!(party, Party::Link(_)));
    !arm && tick as f64 * run.trace.step_s < SETTLED_S
}

/// Whether an event is the beginning of such a contact.
pub(super) fn begins_initial(kind: &EventKind, tick: u64, run: &TaskRun) -> bool {
    matches!(kind, EventKind::Touched { parties } if is_initial(*parties, tick, run))
}
