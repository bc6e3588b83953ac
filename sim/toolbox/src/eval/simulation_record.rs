//! What `simulate` answers: rows at the sample times, readings of sensors, and what happened in a scene.

use std::collections::BTreeMap;

use kinemark_sim::diagnosis::{is_calm, likely_cause_without_feedback};
use kinemark_sim::run::{DivergenceKind, Recorder, Row, Setup};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::pose_numbers;
use kinemark_sim::watch::Names;
use kinemark_sim::watch::event::{Event, EventKind};
use kinemark_sim::watch::{ContactSpan, ResolutionWatch, Watch};
use serde::Serialize;

use super::number_fields::{Numbers, finite, finite_number, finite_rows};
use super::refusal::Refusal;

/// The answer to [`Simulate`](super::simulation::Simulate); each list has one entry per sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SampledRun {
    /// Times.
    pub t_s: Vec<f64>,
    /// Joint positions \[rad or m\].
    pub q: Vec<Vec<f64>>,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Vec<Vec<f64>>,
    /// Joint efforts, applied from that time on \[N m or N\].
    pub effort: Vec<Vec<f64>>,
    /// Readings by sensor: a number, or a list where it has several channels; only where the robot has sensors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensors: Option<BTreeMap<String, Vec<Numbers>>>,
    /// Without a scene, what the periods of the run do not resolve, if there is anything; in a scene it is among the events there.
    #[serde(rename = "events", skip_serializing_if = "Vec::is_empty")]
    pub unresolved: Vec<EventRecord>,
    /// What happened in the scene.
    #[serde(flatten)]
    pub scene: Option<SceneRecord>,
}

/// What happened in a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneRecord {
    /// Poses by body, one per sample: x, y, z \[m\] and the unit quaternion w, x, y, z, in the world.
    pub bodies: BTreeMap<String, Vec<Vec<f64>>>,
    /// What happened, in the order of time.
    pub events: Vec<EventRecord>,
    /// Contacts, in the order in which they begin.
    pub contacts: Vec<ContactRecord>,
}

/// One thing that happened.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EventRecord {
    /// When.
    pub t_s: f64,
    /// Its kind, such as `touched`.
    pub event: String,
    /// What happened, as a sentence without its end.
    pub message: String,
    /// The joint it happened to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The body it happened to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// The two that touched.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parties: Option<[String; 2]>,
    /// The side over which a body fell: `far`, `near`, `left` or `right`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<String>,
    /// The direction out over that side, in the world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outward: Option<[f64; 3]>,
}

/// One contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContactRecord {
    /// The two that touch.
    pub parties: [String; 2],
    /// When it begins.
    pub from_s: f64,
    /// When it ends.
    pub until_s: f64,
    /// Greatest force.
    pub peak_force_n: f64,
    /// When the force is greatest.
    pub peak_s: f64,
    /// Impulse over the contact.
    pub impulse_n_s: f64,
    /// Greatest depth.
    pub depth_m: f64,
    /// Where it begins, in the world.
    pub first_point_m: [f64; 3],
}

/// Keeps every `stride`-th row, and what happened.
pub(super) struct Sampler<'a> {
    setup: &'a Setup<'a>,
    stride: u64,
    t_s: Vec<f64>,
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    effort: Vec<Vec<f64>>,
    /// Poses of the scene's bodies, one list per body.
    bodies: Vec<Vec<Vec<f64>>>,
    watch: Watched<'a>,
    /// Readings of the sensors, channel by channel.
    sensors: Vec<Vec<f64>>,
    /// The last state, and the last one with low joint rates: where a cause is sought if the run diverges.
    last: (Vec<f64>, Vec<f64>),
    last_calm: Option<(Vec<f64>, Vec<f64>)>,
}

/// What is watched.
enum Watched<'a> {
    /// Everything, in a scene.
    Scene(Box<Watch<'a>>),
    /// What the periods do not resolve, and the events so far.
    Resolution(Box<ResolutionWatch<'a>>, Vec<Event>),
}

impl Recorder for Sampler<'_> {
    fn row(&mut self, row: Row<'_>) {
        match &mut self.watch {
            Watched::Scene(watch) => watch.observe(&row),
            Watched::Resolution(watch, events) => {
                watch.observe(&row, &mut |tick, kind| events.push(Event { tick, kind }));
            }
        }
        let keep = |(q, qd): &mut (Vec<f64>, Vec<f64>)| {
            q.copy_from_slice(row.q);
            qd.copy_from_slice(row.qd);
        };
        keep(&mut self.last);
        if is_calm(row.qd) {
            keep(self.last_calm.get_or_insert_with(|| self.last.clone()));
        }
        if !row.tick.is_multiple_of(self.stride) {
            return;
        }
        self.t_s.push(self.setup.periods.time_s(row.tick));
        self.q.push(row.q.to_vec());
        self.qd.push(row.qd.to_vec());
        self.effort.push(row.effort.to_vec());
        self.sensors.push(row.sensors.to_vec());
        let bodies = row.scene.iter().flat_map(|scene| scene.bodies());
        for (body, poses) in bodies.zip(&mut self.bodies) {
            poses.push(pose_numbers(&body.world_from_body).to_vec());
        }
    }
}

impl<'a> Sampler<'a> {
    pub(super) fn new(setup: &'a Setup<'a>, stride: u64) -> Self {
        let bodies = setup.scene.map_or(0, |scene| scene.bodies.len());
        let watch = match setup.scene {
            Some(_) => Watched::Scene(Box::new(Watch::new(setup))),
            None => Watched::Resolution(Box::new(ResolutionWatch::new(setup)), Vec::new()),
        };
        Self {
            setup,
            stride,
            t_s: Vec::new(),
            q: Vec::new(),
            qd: Vec::new(),
            effort: Vec::new(),
            bodies: vec![Vec::new(); bodies],
            watch,
            sensors: Vec::new(),
            last: (setup.start_q.clone(), setup.start_qd.clone()),
            last_calm: None,
        }
    }

    /// Why the run diverged at `tick` as `what`, in words.
    pub(super) fn divergence(&self, tick: u64, what: &DivergenceKind) -> String {
        let names = names(self.setup);
        let (q, qd) = &self.last;
        let calm = self.last_calm.as_ref();
        let calm = calm.map(|(q, qd)| (q.as_slice(), qd.as_slice()));
        let cause = likely_cause_without_feedback(self.setup, what, (q, qd), calm);
        let mut text = format!("{what} at {} s", self.setup.periods.time_s(tick));
        if let Some(cause) = cause {
            text += &format!("; {}", cause.clause(&names, &self.setup.periods));
        }
        text
    }

    /// The answer to the request that described the setup.
    pub(super) fn answer(self) -> Result<SampledRun, Refusal> {
        let setup = self.setup;
        let names = names(setup);
        let (unresolved, scene) = match self.watch {
            Watched::Scene(watch) => (Vec::new(), Some(scene_record(setup, *watch, &self.bodies)?)),
            Watched::Resolution(_, events) => {
                let events = events.iter();
                let records = events.map(|event| event_record(&names, event, &setup.periods));
                (records.collect(), None)
            }
        };
        let has_sensors = !setup.robot.sensors().is_empty();
        Ok(SampledRun {
            t_s: finite(&self.t_s)?,
            q: finite_rows(&self.q)?,
            qd: finite_rows(&self.qd)?,
            effort: finite_rows(&self.effort)?,
            sensors: has_sensors
                .then(|| readings(setup, &self.sensors))
                .transpose()?,
            unresolved,
            scene,
        })
    }
}

/// The readings of each sensor, of rows that have all channels.
fn readings(
    setup: &Setup<'_>,
    rows: &[Vec<f64>],
) -> Result<BTreeMap<String, Vec<Numbers>>, Refusal> {
    let mut start = 0;
    let mut readings = BTreeMap::new();
    for sensor in setup.robot.sensors() {
        let channels = start..start + sensor.kind.measured().channels();
        start = channels.end;
        let reading = |row: &Vec<f64>| match &row[channels.clone()] {
            [one] => finite_number(*one).map(Numbers::One),
            several => finite(several).map(Numbers::List),
        };
        let of_sensor: Result<Vec<Numbers>, Refusal> = rows.iter().map(reading).collect();
        readings.insert(sensor.name.clone(), of_sensor?);
    }
    Ok(readings)
}

fn names<'a>(setup: &Setup<'a>) -> Names<'a> {
    Names {
        robot: setup.robot,
        scene: setup.scene,
        seen_from: "",
    }
}

fn scene_record(
    setup: &Setup<'_>,
    watch: Watch<'_>,
    bodies: &[Vec<Vec<f64>>],
) -> Result<SceneRecord, Refusal> {
    let names = names(setup);
    let (events, contacts) = watch.finish();
    let events = events
        .iter()
        .map(|event| event_record(&names, event, &setup.periods));
    let contacts = contacts
        .iter()
        .map(|contact| contact_record(&names, contact, &setup.periods));
    let named = setup.scene.into_iter().flat_map(|scene| &scene.bodies);
    let poses = named.zip(bodies);
    let poses = poses.map(|(body, poses)| Ok((body.name.clone(), finite_rows(poses)?)));
    Ok(SceneRecord {
        bodies: poses.collect::<Result<_, Refusal>>()?,
        events: events.collect(),
        contacts: contacts.collect(),
    })
}

fn event_record(names: &Names<'_>, event: &Event, periods: &Periods) -> EventRecord {
    let (parties, side) = match event.kind {
        EventKind::Touched { parties } => (Some(parties), None),
        EventKind::BodyFell { side, .. } => (None, side),
        _ => (None, None),
    };
    EventRecord {
        t_s: periods.time_s(event.tick),
        event: event.kind.name().to_owned(),
        message: names.event(&event.kind),
        joint: event
            .kind
            .joint()
            .map(|joint| names.joint(joint).to_owned()),
        body: event.kind.body().map(|body| names.body(body).to_owned()),
        parties: parties.map(|parties| parties.map(|party| names.party(party).to_owned())),
        side: side.as_ref().map(|side| side.seen.name().to_owned()),
        outward: side.map(|side| side.outward.into()),
    }
}

fn contact_record(names: &Names<'_>, contact: &ContactSpan, periods: &Periods) -> ContactRecord {
    ContactRecord {
        parties: contact.parties.map(|party| names.party(party).to_owned()),
        from_s: periods.time_s(contact.first_tick),
        until_s: periods.time_s(contact.last_tick),
        peak_force_n: contact.peak_force_n,
        peak_s: periods.time_s(contact.peak_tick),
        impulse_n_s: contact.impulse_n_s,
        depth_m: contact.depth_m,
        first_point_m: contact.p_first_in_world.into(),
    }
}
