//! Something that may happen in a run, as a check names it: an event, a touch, a sensor that comes to read something, or a joint that
//! passes a position.

use schemars::JsonSchema;
use serde::Deserialize;

use super::facts::MotionFacts;
use super::reading::{At, Channel, MotionReading};
use super::touching::two_that_touch;
use crate::record::quantity::with_unit;
use crate::task::problem::{LabError, near, problems};
use crate::task::watched::TouchingParty;

/// The events that a check can name.
const OF_JOINTS: [&str; 3] = ["saturated", "limit-hit", "speed-limit-hit"];
const OF_BODIES: [&str; 4] = ["moved", "toppled", "left-support", "body-fell"];
const OF_NOBODY: [&str; 1] = ["near-singular"];

problems! {
    /// What is wrong with the name of something that may happen.
    enum OccurrenceProblem {
        NotOne:
            "lab::occurrence", "what happens is one of `event`, `touch`, `sensor`, and a `joint` with what its position `becomes`", "here",
            "such as `event = \"body-fell\", body = \"can\"`, `touch = [\"arm\", \"shelf\"]`, `sensor = \"switch\", becomes = true` or `joint = \"elbow\", becomes = { above = 0.5 }`";
        UnknownEvent { event: String, known: Vec<String> }:
            "lab::occurrence", "no event is called `{event}`", "not an event", near(event, "events", known);
        NotOf { key: &'static str, event: String, of: &'static str }:
            "lab::occurrence", "`{key}` has no meaning for {event}", "of no effect", format!("leave it out{of}");
        NoBecomes:
            "lab::occurrence", "a sensor happens when it comes to read something", "`becomes` is missing",
            "such as `becomes = true` for a switch, or `becomes = { above = 2.0 }` for numbers";
        Becomes { sensor: String, is_switch: bool }:
            "lab::occurrence", "sensor `{sensor}` never reads that", "this one",
            match is_switch {
                true => "a switch reads true or false: write `becomes = true`",
                false => "it reads numbers: write `becomes = { above = 2.0 }` or `becomes = { below = 2.0 }`",
            };
        OfJoint { joint: String }:
            "lab::occurrence", "the position of joint `{joint}` is a number, neither true nor false", "this one",
            "write `becomes = { above = 0.5 }` or `becomes = { below = 0.5 }`, in rad, or m of a prismatic joint";
    }
}

/// Something that may happen.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OccurrenceTable {
    /// An event of [physics.md](physics.md#what-a-run-reports): `moved`, `toppled`, `left-support` or `body-fell` of a body;
    /// `saturated`, `limit-hit` or `speed-limit-hit` of a joint; `near-singular`.
    pub(super) event: Option<At<String>>,
    /// The body of the event; any where it is left out.
    pub(super) body: Option<At<String>>,
    /// The joint of the event; any where it is left out. Without an event, the joint whose position comes to be what `becomes` says.
    pub(super) joint: Option<At<String>>,
    /// In place of an event, two that touch, as in `contact-impulse`.
    pub(super) touch: Option<[At<String>; 2]>,
    /// In place of an event, a sensor that comes to read what `becomes` says.
    pub(super) sensor: Option<At<String>>,
    /// The part of a sensor with several numbers, such as `fz`; the first where it is left out.
    pub(super) part: Option<At<String>>,
    /// What the sensor comes to read: `true` or `false` of a switch, `{ above = 2.0 }` or `{ below = 2.0 }` of others, in the
    /// sensor's unit; or which position the joint passes, in rad, or m of a prismatic joint. It happens anew each time, not at the
    /// start.
    pub(super) becomes: Option<Becomes>,
}

/// What a sensor comes to read, or a position comes to be.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected true, false, { above = NUMBER } or { below = NUMBER }"
)]
pub(super) enum Becomes {
    /// Of a switch.
    Switched(bool),
    /// A number above this.
    Above {
        /// The number.
        above: f64,
    },
    /// A number below this.
    Below {
        /// The number.
        below: f64,
    },
}

/// Something that may happen, as read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Occurrence {
    /// An event of this name; of this joint or body, or of any.
    Event {
        name: &'static str,
        of: Option<usize>,
    },
    /// These two press on each other.
    Touch([TouchingParty; 2]),
    /// A number that a sensor reads comes to be so.
    Sensor { channel: Channel, becomes: Becomes },
    /// The position of a joint comes to be so, in `unit`.
    Position {
        joint: usize,
        becomes: Becomes,
        unit: &'static str,
    },
}

impl OccurrenceTable {
    /// What it names, for a check of `kind`.
    pub(super) fn read(
        &self,
        reading: &MotionReading<'_>,
        kind: &'static str,
    ) -> Result<Occurrence, LabError> {
        match (&self.event, &self.touch, &self.sensor) {
            (Some(event), None, None) => self.event(reading, kind, event),
            (None, Some(touch), None) => {
                self.has_no_owner(reading, "a touch", ": `touch` names both")?;
                self.has_no_reading(reading, "a touch")?;
                Ok(Occurrence::Touch(two_that_touch(reading, kind, touch)?))
            }
            (None, None, Some(sensor)) => {
                self.has_no_owner(reading, "a sensor", "")?;
                self.of_sensor(reading, sensor)
            }
            (None, None, None) => self.of_position(reading),
            _ => reading.refuse(OccurrenceProblem::NotOne),
        }
    }

    fn event(
        &self,
        reading: &MotionReading<'_>,
        kind: &'static str,
        event: &At<String>,
    ) -> Result<Occurrence, LabError> {
        let typed = event.get_ref();
        let mut names = OF_BODIES.into_iter().chain(OF_JOINTS).chain(OF_NOBODY);
        let Some(name) = names.find(|name| name == typed) else {
            let names = OF_BODIES.into_iter().chain(OF_JOINTS).chain(OF_NOBODY);
            let problem = OccurrenceProblem::UnknownEvent {
                event: typed.clone(),
                known: names.map(str::to_owned).collect(),
            };
            return reading.refuse_at(event, problem);
        };
        self.has_no_reading(reading, "an event")?;
        let refuse = |typed: &At<String>, key| {
            let event = format!("the event `{name}`");
            reading.refuse_at(typed, OccurrenceProblem::NotOf { key, event, of: "" })
        };
        let of = if OF_BODIES.contains(&name) {
            if let Some(joint) = &self.joint {
                return refuse(joint, "joint");
            }
            let scene = reading.scene(kind)?;
            let body = self.body.as_ref();
            body.map(|body| reading.free_body(scene, body))
                .transpose()?
        } else {
            if let Some(body) = &self.body {
                return refuse(body, "body");
            }
            match &self.joint {
                Some(joint) if OF_NOBODY.contains(&name) => return refuse(joint, "joint"),
                joint => reading.maybe_joint(joint.as_ref())?,
            }
        };
        Ok(Occurrence::Event { name, of })
    }

    fn of_sensor(
        &self,
        reading: &MotionReading<'_>,
        sensor: &At<String>,
    ) -> Result<Occurrence, LabError> {
        let channel = reading.channel(sensor, self.part.as_ref())?;
        let Some(becomes) = self.becomes else {
            return reading.refuse_at(sensor, OccurrenceProblem::NoBecomes);
        };
        let is_switch = channel.is_switch;
        if is_switch != matches!(becomes, Becomes::Switched(_)) {
            let sensor_name = sensor.get_ref().clone();
            let problem = OccurrenceProblem::Becomes {
                sensor: sensor_name,
                is_switch,
            };
            return reading.refuse_at(sensor, problem);
        }
        Ok(Occurrence::Sensor { channel, becomes })
    }

    fn of_position(&self, reading: &MotionReading<'_>) -> Result<Occurrence, LabError> {
        let (Some(joint), Some(becomes)) = (&self.joint, self.becomes) else {
            return reading.refuse(OccurrenceProblem::NotOne);
        };
        for (key, typed) in [("body", &self.body), ("part", &self.part)] {
            if let Some(typed) = typed {
                let event = "the position of a joint".to_owned();
                let of = "";
                return reading.refuse_at(typed, OccurrenceProblem::NotOf { key, event, of });
            }
        }
        let index = reading.joint(joint)?;
        if matches!(becomes, Becomes::Switched(_)) {
            let name = joint.get_ref().clone();
            return reading.refuse_at(joint, OccurrenceProblem::OfJoint { joint: name });
        }
        Ok(Occurrence::Position {
            joint: index,
            becomes,
            unit: reading.units(Some(index)).position(),
        })
    }

    fn has_no_owner(
        &self,
        reading: &MotionReading<'_>,
        event: &str,
        of: &'static str,
    ) -> Result<(), LabError> {
        for (key, typed) in [("body", &self.body), ("joint", &self.joint)] {
            if let Some(typed) = typed {
                let event = event.to_owned();
                return reading.refuse_at(typed, OccurrenceProblem::NotOf { key, event, of });
            }
        }
        Ok(())
    }

    fn has_no_reading(&self, reading: &MotionReading<'_>, event: &str) -> Result<(), LabError> {
        let event = event.to_owned();
        let of = "";
        if let Some(part) = &self.part {
            let key = "part";
            return reading.refuse_at(part, OccurrenceProblem::NotOf { key, event, of });
        }
        match self.becomes {
            Some(_) => {
                let key = "becomes";
                reading.refuse(OccurrenceProblem::NotOf { key, event, of })
            }
            None => Ok(()),
        }
    }
}

impl Becomes {
    fn holds(self, value: f64) -> bool {
        match self {
            Self::Switched(wanted) => (value > 0.5) == wanted,
            Self::Above { above } => value > above,
            Self::Below { below } => value < below,
        }
    }

    /// That the value of `owner` comes to be so, in `unit`.
    fn in_words(self, owner: &str, unit: &str) -> String {
        match self {
            Self::Switched(wanted) => format!("{owner} becomes {wanted}"),
            Self::Above { above } => format!("{owner} rises above {}", with_unit(above, unit)),
            Self::Below { below } => format!("{owner} falls below {}", with_unit(below, unit)),
        }
    }
}

/// The ticks of a run of so many at which something holds that did not hold at the tick before.
fn comes_to_hold(count: usize, holds: impl Fn(usize) -> bool) -> Vec<usize> {
    (1..count)
        .filter(|tick| holds(*tick) && !holds(tick - 1))
        .collect()
}

impl Occurrence {
    /// The ticks at which it happened, in order.
    pub(super) fn ticks(&self, facts: &MotionFacts<'_>) -> Vec<usize> {
        let trace = facts.trace;
        match self {
            Self::Event { name, of } => {
                let events = trace.events.iter().filter(|event| {
                    let owner = event.kind.body().or(event.kind.joint());
                    event.kind.name() == *name && of.is_none_or(|of| owner == Some(of))
                });
                events.map(|event| event.tick as usize).collect()
            }
            Self::Touch([one, other]) => {
                let contacts = trace.contacts.iter();
                let touches = contacts.filter(|span| one.meets(*other, span.parties));
                let mut ticks: Vec<usize> = touches.map(|span| span.first_tick as usize).collect();
                ticks.sort_unstable();
                ticks
            }
            Self::Sensor { channel, becomes } => comes_to_hold(trace.len(), |tick| {
                becomes.holds(trace.sensors.at(tick)[channel.index])
            }),
            Self::Position { joint, becomes, .. } => {
                comes_to_hold(trace.len(), |tick| becomes.holds(trace.q.at(tick)[*joint]))
            }
        }
    }

    /// What it is, as it stands in a sentence, such as `` `can` falls ``.
    pub(super) fn in_words(&self, facts: &MotionFacts<'_>) -> String {
        match self {
            Self::Event { name, of } => {
                let owner = match of {
                    Some(of) if OF_BODIES.contains(name) => format!("`{}`", facts.names.body(*of)),
                    Some(of) => format!("joint `{}`", facts.joint_name(*of)),
                    None if OF_BODIES.contains(name) => "a body".to_owned(),
                    None => "a joint".to_owned(),
                };
                match *name {
                    "moved" => format!("{owner} moves"),
                    "toppled" => format!("{owner} topples"),
                    "left-support" => format!("{owner} leaves its support"),
                    "body-fell" => format!("{owner} falls"),
                    "saturated" => format!("{owner} has its effort at its limit"),
                    "limit-hit" => format!("{owner} comes to a position limit"),
                    "speed-limit-hit" => format!("{owner} comes to its speed limit"),
                    _ => "the arm is near a singular configuration".to_owned(),
                }
            }
            Self::Touch(between) => {
                let [one, other] = between.map(|party| party.in_sentence(&facts.names));
                format!("{one} touches {other}")
            }
            Self::Sensor { channel, becomes } => {
                becomes.in_words(&format!("`{}`", channel.name), channel.unit)
            }
            Self::Position {
                joint,
                becomes,
                unit,
            } => becomes.in_words(&format!("joint `{}`", facts.joint_name(*joint)), unit),
        }
    }

    /// The signal in which it shows.
    pub(super) fn signal(&self) -> String {
        match self {
            Self::Event { name, .. } if OF_BODIES.contains(name) => "bodies".to_owned(),
            Self::Event { of, .. } => match of {
                Some(joint) => format!("q[{joint}]"),
                None => "q".to_owned(),
            },
            Self::Touch(_) => "contacts".to_owned(),
            Self::Sensor { channel, .. } => format!("sensors[{}]", channel.index),
            Self::Position { joint, .. } => format!("q[{joint}]"),
        }
    }
}
