//! What happened in a run, in words: events and contacts with the names of the robot and the scene.

use kinemark_sim::engine::Party;
use kinemark_sim::event::{EventKind, Side};
use kinemark_sim::robot::Robot;
use kinemark_sim::scene::Scene;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::Trace;
use nalgebra::Vector3;

use crate::record::grade::{ContactRecord, EventRecord};
use crate::task::watched::TouchingParty;

/// Contacts, and events of bodies, that a record keeps.
const MOST_RECORDS: usize = 200;
/// Events of joints and singular positions that a record keeps beside them: a loop that buzzes makes thousands.
const MOST_OF_JOINTS: usize = 100;

/// The names of a run.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// What was around it.
    pub scene: Option<&'a Scene>,
    /// The frame in which students work.
    pub seen_from: &'a str,
}

impl<'a> Names<'a> {
    /// The name of a joint by its index in `q`.
    pub fn joint(&self, index: usize) -> &'a str {
        let found = self.robot.moving_joints().nth(index);
        found.map_or("?", |joint| joint.name.as_str())
    }

    /// The name of a body of the scene.
    pub fn body(&self, index: usize) -> &'a str {
        let found = self.scene.and_then(|scene| scene.bodies.get(index));
        found.map_or("?", |body| body.name.as_str())
    }

    /// The name of a party of a contact.
    pub fn party(&self, party: Party) -> &'a str {
        match party {
            Party::Link(index) => self.robot.links().get(index).map_or("?", |link| &link.name),
            Party::Body(index) => self.body(index),
            Party::Ground => "ground",
        }
    }

    /// What happened, in a sentence without its end.
    pub fn event(&self, kind: &EventKind) -> String {
        match kind {
            EventKind::Saturated { joint } => {
                format!("effort of `{}` reached its limit", self.joint(*joint))
            }
            EventKind::LimitHit { joint } => {
                format!("`{}` reached a position limit", self.joint(*joint))
            }
            EventKind::SpeedLimitHit { joint } => {
                format!("`{}` reached its speed limit", self.joint(*joint))
            }
            EventKind::NearSingular => {
                "the arm is near a singular configuration: the TCP cannot move in some direction"
                    .to_owned()
            }
            EventKind::Touched { parties } => {
                let [first, second] = parties.map(|party| self.party(party));
                format!("`{first}` touched `{second}`")
            }
            EventKind::Moved { body } => format!("`{}` moved", self.body(*body)),
            EventKind::Toppled { body } => format!("`{}` toppled", self.body(*body)),
            EventKind::LeftSupport { body } => {
                format!("`{}` lost its support", self.body(*body))
            }
            EventKind::BodyFell { body, side } => match side {
                None => format!("`{}` fell", self.body(*body)),
                Some(side) => format!(
                    "`{}` fell over the {} side{}",
                    self.body(*body),
                    side.seen.name(),
                    self.axis(side)
                ),
            },
            EventKind::Diverged => "the simulation diverged".to_owned(),
            EventKind::Stopped => "the submission was stopped".to_owned(),
        }
    }

    /// The axis of the students' frame that leads out over a side, in brackets, if one does within 20 degrees.
    fn axis(&self, side: &Side) -> String {
        let Some(frame) = self.robot.frame(self.seen_from) else {
            return String::new();
        };
        // frames that move have no fixed axes
        if frame.attachment.body.is_some() {
            return String::new();
        }
        let world_from_frame = frame.attachment.body_from_here.rotation;
        let out: Vector3<f64> = world_from_frame.inverse_transform_vector(&side.outward);
        let axis = out.iamax();
        if out[axis].abs() < 0.94 {
            return String::new();
        }
        let sign = if out[axis] > 0.0 { '+' } else { '-' };
        format!(" ({sign}{})", ["x", "y", "z"][axis])
    }

    /// The events of a run, as far as a record keeps them.
    pub fn events(&self, trace: &Trace, periods: &Periods) -> Vec<EventRecord> {
        let (mut of_joints, mut others) = (0, 0);
        let kept = trace.events.iter().filter(|event| {
            let joints = event.kind.joint().is_some() || event.kind == EventKind::NearSingular;
            let (count, most) = if joints {
                (&mut of_joints, MOST_OF_JOINTS)
            } else {
                (&mut others, MOST_RECORDS)
            };
            *count += 1;
            // how a run ended is never left out
            *count <= most || matches!(event.kind, EventKind::Diverged | EventKind::Stopped)
        });
        kept.map(|event| EventRecord {
            tick: event.tick,
            time_s: periods.time_s(event.tick),
            event: event.kind.name().to_owned(),
            message: self.event(&event.kind),
        })
        .collect()
    }

    /// The contacts of a run, as far as a record keeps them.
    pub fn contacts(&self, trace: &Trace) -> Vec<ContactRecord> {
        let contacts = trace.contacts.iter().take(MOST_RECORDS);
        contacts
            .map(|contact| ContactRecord {
                parties: contact.parties.map(|party| self.party(party).to_owned()),
                first_tick: contact.first_tick,
                last_tick: contact.last_tick,
                peak_force_n: contact.peak_force_n,
                peak_tick: contact.peak_tick,
                impulse_n_s: contact.impulse_n_s,
            })
            .collect()
    }
}

impl TouchingParty {
    /// Its name as it stands in a sentence.
    pub fn told(self, names: &Names<'_>) -> String {
        match self {
            Self::Arm => "the arm".to_owned(),
            Self::Link(index) => format!("`{}`", names.party(Party::Link(index))),
            Self::Body(index) => format!("`{}`", names.party(Party::Body(index))),
            Self::Ground => "the ground".to_owned(),
        }
    }
}
