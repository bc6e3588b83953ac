//! Watches a run tick by tick for events and contacts.
//!
//! | event | when |
//! |---|---|
//! | `saturated` | a joint's effort is at the servo's limit, and was not for 0.1 s before |
//! | `limit-hit` | a joint is on a position limit or beyond, and was not for 0.1 s before |
//! | `speed-limit-hit` | in a scene, a joint is as fast as its limit, and was not for 0.1 s before |
//! | `under-resolved` | a joint moves too fast for the physics step, or the servo's period is too long for its gains (see `resolution.rs`) |
//! | `near-singular` | at a control period the TCP's Jacobian has a condition number of 50 or more, after it was below 40 |
//! | `touched` | two parties press on each other for the first time in the run |
//! | `moved` | the centre of mass of a dynamic body is 5 mm or more from its start |
//! | `toppled` | a dynamic body is tilted by 45 degrees or more from its start |
//! | `left-support` | for 20 ms nothing has pushed the body up with a tenth of its weight or more; the tick is the first of them |
//! | `body-fell` | its centre of mass is 50 mm below its support and below its start, and it had no contact for 20 ms since it last touched the support |
//!
//! `moved`, `toppled`, `left-support` and `body-fell` are reported once for each body, `under-resolved` once for each joint and cause.

use super::contacts::ContactSpan;
use super::event::{Event, EventKind};
use super::{bodies, contacts, joints, resolution, singularity};
use crate::run::{Row, Setup};

/// A shorter pause neither separates two contacts nor a body from its support \[s\].
const APART_S: f64 = 0.02;

/// Watches one run.
#[derive(Debug, Clone)]
pub struct Watch<'a> {
    joints: joints::JointWatch,
    resolution: resolution::ResolutionWatch<'a>,
    singularity: singularity::SingularityWatch,
    contacts: contacts::ContactWatch,
    bodies: bodies::BodyWatch<'a>,
    ticks_per_control: u64,
    events: Vec<Event>,
}

impl<'a> Watch<'a> {
    /// A watch for a run of `setup`, before its first row.
    pub fn new(setup: &Setup<'a>) -> Self {
        let apart_ticks = ((APART_S / setup.periods.step_s).round() as u64).max(1);
        Self {
            joints: joints::JointWatch::new(setup),
            resolution: resolution::ResolutionWatch::new(setup),
            singularity: singularity::SingularityWatch::new(setup),
            contacts: contacts::ContactWatch::new(apart_ticks),
            bodies: bodies::BodyWatch::new(setup, apart_ticks),
            ticks_per_control: u64::from(setup.periods.ticks_per_control.get()),
            events: Vec::new(),
        }
    }

    /// Takes one tick; ticks come in order and none is left out.
    pub fn observe(&mut self, row: &Row<'_>) {
        let events = &mut self.events;
        let mut emit = |tick: u64, kind: EventKind| events.push(Event { tick, kind });
        self.joints.observe(row, &mut emit);
        self.resolution.observe(row, &mut emit);
        if row.tick.is_multiple_of(self.ticks_per_control) {
            self.singularity.observe(row, &mut emit);
        }
        if let Some(scene) = row.scene {
            self.contacts.observe(row.tick, scene.report(), &mut emit);
            self.bodies.observe(row.tick, scene, &mut emit);
        }
    }

    /// The events in tick order, and the contacts in the order in which they began.
    pub fn finish(mut self) -> (Vec<Event>, Vec<ContactSpan>) {
        self.events.sort_by_key(|event| event.tick);
        (self.events, self.contacts.finish())
    }
}
