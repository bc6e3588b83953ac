//! The moments worth a mark: what happened, who pressed on whom, and where points were lost first.

use kinemark_sim::watch::event::{Event, EventKind};
use nalgebra::Vector3;
use serde::Serialize;

use crate::initial_contact::begins_initial;
use crate::moment::has_lost;
use crate::visible::{shortened, shortened_in_words};
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::with_unit;

/// Events of a replay.
const MOST_EVENTS: usize = 200;
/// Events of one kind that come in heaps: saturated efforts, breaches.
const MOST_OF_A_KIND: usize = 20;
/// Contacts of a replay.
const MOST_CONTACTS: usize = 200;
/// Characters of an event's text.
const MOST_CHARACTERS: usize = 160;
/// Characters of a name.
pub(super) const MOST_OF_A_NAME: usize = 60;

/// Something that happened.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct EventMark {
    pub(super) tick: u64,
    pub(super) kind: &'static str,
    pub(super) text: String,
}

/// A contact, with where it began in the world \[m\] and its impulse \[N s\].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ContactMark {
    from: u64,
    to: u64,
    first: String,
    second: String,
    point: [f64; 3],
    impulse: f64,
    /// The greatest normal force \[N\], and its direction on the second party; none where it has no direction.
    force: f64,
    normal: Option<[f64; 3]>,
}

impl ContactMark {
    /// The same, between parties of another run that is called `label`.
    pub(super) fn of(mut self, label: &str) -> Self {
        for party in [&mut self.first, &mut self.second] {
            *party = format!("{label}/{party}");
        }
        self
    }
}

/// What kind of mark an event is.
fn mark(kind: &EventKind) -> &'static str {
    match kind {
        EventKind::Saturated { .. } => "saturation",
        EventKind::LimitHit { .. } | EventKind::SpeedLimitHit { .. } => "limit",
        EventKind::Touched { .. } => "contact",
        EventKind::Toppled { .. } | EventKind::BodyFell { .. } => "fell",
        EventKind::Diverged | EventKind::Stopped => "stop",
        EventKind::UnderResolved { .. }
        | EventKind::NearSingular
        | EventKind::Moved { .. }
        | EventKind::LeftSupport { .. } => "other",
    }
}

/// Whether a run ends with it before its time.
pub(super) fn ends(kind: &EventKind) -> bool {
    matches!(kind, EventKind::Diverged | EventKind::Stopped)
}

/// Words without the marks of code, which a picture does not show.
fn plain(text: &str) -> String {
    shortened_in_words(&text.replace('`', ""), MOST_CHARACTERS)
}

/// Events of a run by time, with the first breach of every check that lost points.
pub(super) fn events(run: &TaskRun, task: Option<&TaskGrade>) -> Vec<EventMark> {
    let names = run.names();
    let mut breaches = breaches(task);
    let room = MOST_EVENTS - breaches.len();
    let (mut all, mut saturated) = (0, 0);
    let news = |event: &&Event| !begins_initial(&event.kind, event.tick, run);
    let kept = run.trace.events.iter().filter(news).filter(|event| {
        let counts = !matches!(event.kind, EventKind::Saturated { .. });
        saturated += usize::from(!counts);
        let kept = if counts {
            all < room - MOST_OF_A_KIND
        } else {
            saturated <= MOST_OF_A_KIND
        };
        all += usize::from(counts);
        // how a run ended is never left out
        kept || ends(&event.kind)
    });
    let mut marks: Vec<EventMark> = kept
        .map(|event| EventMark {
            tick: event.tick,
            kind: mark(&event.kind),
            text: plain(&names.event(&event.kind)),
        })
        .collect();
    marks.append(&mut breaches);
    // stable: of one tick, what happened comes before what it cost
    marks.sort_by_key(|event| event.tick);
    marks
}

/// Where each check began to lose points.
fn breaches(task: Option<&TaskGrade>) -> Vec<EventMark> {
    let checks = task.into_iter().flat_map(|task| &task.checks);
    let first = checks.filter(|check| has_lost(check)).filter_map(|check| {
        let first = check.first_lost?;
        let mut evidence = check.evidence.iter();
        let first_fact = evidence.find(|fact| fact.tick == Some(first.tick));
        let why = match (first_fact, &check.measure) {
            (Some(fact), _) => format!(": {}", fact.message),
            (None, Some(measure)) => {
                format!(
                    ": beyond {} from here on",
                    with_unit(measure.full, &measure.unit)
                )
            }
            (None, None) => ", from here on".to_owned(),
        };
        Some(EventMark {
            tick: first.tick,
            kind: "breach",
            text: plain(&format!("{}{why}", check.title)),
        })
    });
    first.take(MOST_OF_A_KIND).collect()
}

/// A direction to four decimals; none of what is no unit vector.
fn direction(normal: &Vector3<f64>) -> Option<[f64; 3]> {
    let is_direction = (normal.norm() - 1.0).abs() < 1e-6;
    is_direction.then(|| (*normal).map(rounded).into())
}

/// A number to four decimals.
fn rounded(value: f64) -> f64 {
    match value.is_finite() {
        true => (value * 1e4).round() / 1e4,
        false => 0.0,
    }
}

/// Contacts of a run, in the order they began.
pub(super) fn contacts(run: &TaskRun) -> Vec<ContactMark> {
    let names = run.names();
    let party = |party| shortened(names.party(party), MOST_OF_A_NAME);
    let sound = run.trace.contacts.iter().filter(|contact| {
        contact.p_first_in_world.iter().all(|x| x.is_finite()) && contact.impulse_n_s.is_finite()
    });
    let mark = sound.take(MOST_CONTACTS).map(|contact| ContactMark {
        from: contact.first_tick,
        to: contact.last_tick,
        first: party(contact.parties[0]),
        second: party(contact.parties[1]),
        point: contact.p_first_in_world.into(),
        impulse: contact.impulse_n_s,
        force: rounded(contact.peak_force_n),
        normal: direction(&contact.peak_normal_in_world),
    });
    mark.collect()
}
