//! The messages of a log, topic by topic.

use std::borrow::Cow;

use kinemark_sim::event::EventKind;
use kinemark_sim::kinematics::FramePoses;
use serde::Serialize;
use serde_json::Value;

use super::bodies::Bodies;
use super::mcap::LogError;
use super::message::{
    Flat, JointState, JointStates, Level, Log, Pose, PoseInFrame, Quaternion, Time, Vector,
};
use super::names::{REFERENCE, fields, frame_id_of};
use super::tree::Tree;
use super::{scene, schema};
use crate::graded::TaskRun;
use crate::report::goal::current_goal;
use crate::report::visible::visible;

/// Poses and joint states a second.
const POSE_RATE_HZ: f64 = 60.0;
/// Flat signals a second; those of the submission and of checks at most so many.
const SIGNAL_RATE_HZ: f64 = 100.0;

/// A channel to be: its topic and the schema of its messages.
pub(super) struct Topic {
    pub(super) topic: String,
    pub(super) schema_name: String,
    pub(super) schema: Value,
}

/// A message to be.
pub(super) struct Message {
    pub(super) log_time_ns: u64,
    pub(super) topic: usize,
    /// Where its bytes are.
    pub(super) bytes: std::ops::Range<usize>,
}

/// The messages of a run, gathered by topic and then written by time.
pub(super) struct Messages<'a> {
    pub(super) run: &'a TaskRun,
    pub(super) topics: Vec<Topic>,
    pub(super) messages: Vec<Message>,
    pub(super) bytes: Vec<u8>,
}

impl<'a> Messages<'a> {
    /// All messages of a run.
    pub(super) fn gather(run: &'a TaskRun) -> Result<Self, LogError> {
        let mut log = Self::new(run);
        log.scenes()?;
        log.motion()?;
        log.ghost()?;
        log.signals()?;
        log.sensors()?;
        log.errors()?;
        log.plots()?;
        log.checks()?;
        log.lines()?;
        Ok(log)
    }

    fn new(run: &'a TaskRun) -> Self {
        Self {
            run,
            topics: Vec::new(),
            messages: Vec::new(),
            bytes: Vec::new(),
        }
    }

    fn topic(
        &mut self,
        topic: impl Into<String>,
        schema_name: impl Into<String>,
        mut schema: Value,
    ) -> usize {
        // whether a JSON map is sorted depends on how its crate was built; the bytes must not
        schema.sort_all_objects();
        self.topics.push(Topic {
            topic: topic.into(),
            schema_name: schema_name.into(),
            schema,
        });
        self.topics.len() - 1
    }

    fn message(
        &mut self,
        topic: usize,
        log_time_ns: u64,
        message: &impl Serialize,
    ) -> Result<(), LogError> {
        let start = self.bytes.len();
        serde_json::to_writer(&mut self.bytes, message)?;
        self.messages.push(Message {
            log_time_ns,
            topic,
            bytes: start..self.bytes.len(),
        });
        Ok(())
    }

    /// The time of a tick \[ns\].
    fn ns(&self, tick: u64) -> u64 {
        (tick as f64 * self.run.trace.step_s * 1e9).round() as u64
    }

    /// Ticks nearest to a rate, the first and the last among them.
    fn ticks(&self, rate_hz: f64) -> Vec<usize> {
        let last = match self.run.trace.len() {
            0 => return Vec::new(),
            len => len - 1,
        };
        let mut ticks: Vec<usize> = (0..)
            .map(|k| (f64::from(k) / (rate_hz * self.run.trace.step_s)).round() as usize)
            .take_while(|tick| *tick <= last)
            .collect();
        // a rate above the tick's own asks for the same tick twice
        ticks.dedup();
        if ticks.last() != Some(&last) {
            ticks.push(last);
        }
        ticks
    }

    fn scenes(&mut self) -> Result<(), LogError> {
        let topic = self.topic("/scene", "foxglove.SceneUpdate", schema::scene_update());
        self.message(topic, 0, &scene::scene(self.run))?;
        if let Some(reference) = scene::reference(self.run) {
            let topic = self.topic(
                "/reference/scene",
                "foxglove.SceneUpdate",
                schema::scene_update(),
            );
            self.message(topic, 0, &reference)?;
        }
        Ok(())
    }

    /// Every frame, the TCP, the joints.
    fn motion(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let tf = self.topic(
            "/tf",
            "foxglove.FrameTransforms",
            schema::frame_transforms(),
        );
        let tcp = self.topic("/tcp", "foxglove.PoseInFrame", schema::pose_in_frame());
        let states = self.topic(
            "/joint_states",
            "foxglove.JointStates",
            schema::joint_states(),
        );
        let tree = Tree::new(&run.robot, "");
        let bodies = Bodies::new(run);
        let lab = frame_id_of(&run.robot, &run.seen_from);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            let ns = self.ns(tick as u64);
            let timestamp = Time::from_ns(ns);
            let (q, qd, effort) = (
                run.trace.q.at(tick),
                run.trace.qd.at(tick),
                run.trace.effort.at(tick),
            );
            if q.iter().all(|q| q.is_finite()) {
                poses.update(&run.robot, q);
                let mut transforms = tree.transforms(&poses, timestamp);
                bodies.add(&run.trace, tick, timestamp, &mut transforms);
                self.message(tf, ns, &transforms)?;
            }
            let row = run.trace.tcp.at(tick);
            if row.iter().all(|x| x.is_finite()) {
                let pose = Pose {
                    position: Vector::new([row[0], row[1], row[2]]),
                    orientation: Quaternion::new([row[3], row[4], row[5], row[6]]),
                };
                let message = PoseInFrame {
                    timestamp,
                    frame_id: &lab,
                    pose,
                };
                self.message(tcp, ns, &message)?;
            }
            let joints = run
                .robot
                .moving_joints()
                .enumerate()
                .map(|(i, joint)| JointState {
                    name: &joint.name,
                    position: q[i],
                    velocity: qd[i],
                    effort: effort[i],
                });
            let message = JointStates {
                timestamp,
                joints: joints.collect(),
            };
            self.message(states, ns, &message)?;
        }
        Ok(())
    }

    /// The reference solution's motion, where it is to be shown: its links, and what of the scene can move.
    fn ghost(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let Some(trace) = &run.ghost else {
            return Ok(());
        };
        let tf = self.topic(
            "/reference/tf",
            "foxglove.FrameTransforms",
            schema::frame_transforms(),
        );
        let tree = Tree::new(&run.robot, REFERENCE);
        let bodies = Bodies::of_reference(run, trace);
        let mut poses = FramePoses::new(&run.robot);
        for tick in self.ticks(POSE_RATE_HZ) {
            // a run that goes on longer than the reference's shows how that ended
            let Some(at) = trace.len().checked_sub(1).map(|last| tick.min(last)) else {
                break;
            };
            let ns = self.ns(tick as u64);
            let timestamp = Time::from_ns(ns);
            poses.update(&run.robot, trace.q.at(at));
            let mut transforms = tree.transforms(&poses, timestamp);
            bodies.add(trace, at, timestamp, &mut transforms);
            self.message(tf, ns, &transforms)?;
        }
        Ok(())
    }

    /// Every number of every joint under a name of its own.
    fn signals(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let joints = fields(run.robot.moving_joints().map(|joint| joint.name.as_str()));
        let turns: Vec<bool> = run
            .robot
            .moving_joints()
            .map(|joint| joint.kind.turns())
            .collect();
        let trace = &run.trace;
        let sources = [&trace.q, &trace.qd, &trace.command, &trace.effort];
        let mut names = Vec::new();
        for signal in sources {
            for (i, joint) in joints.iter().enumerate() {
                let unit = match (signal.name(), turns[i]) {
                    ("q", true) => "rad",
                    ("q", false) => "m",
                    ("qd", true) => "rad/s",
                    ("qd", false) => "m/s",
                    ("effort", true) => "N m",
                    ("effort", false) => "N",
                    _ => "the unit of the servo's mode",
                };
                names.push((format!("{}_{joint}", signal.name()), unit.to_owned()));
            }
        }
        let topic = self.topic(
            "/signals",
            "kinemark.Signals",
            schema::flat("kinemark.Signals", &names),
        );
        for tick in self.ticks(SIGNAL_RATE_HZ) {
            let values = sources.iter().flat_map(|signal| signal.at(tick));
            let values = names
                .iter()
                .map(|(name, _)| name.as_str())
                .zip(values.copied());
            let message = Flat {
                values: values.collect(),
            };
            self.message(topic, self.ns(tick as u64), &message)?;
        }
        Ok(())
    }

    /// Every number of every sensor under a name of its own.
    fn sensors(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.sensors.is_empty() {
            return Ok(());
        }
        let channels = run.sensors.iter().flat_map(|sensor| {
            let wrench = ["fx", "fy", "fz", "mx", "my", "mz"];
            let parts = match sensor.kind.channels() {
                1 => vec![sensor.name.clone()],
                // a wrench is the only sensor of more than one number
                _ => wrench
                    .map(|part| format!("{} {part}", sensor.name))
                    .to_vec(),
            };
            parts.into_iter().map(|name| (name, sensor.kind.name()))
        });
        let (spoken, kinds): (Vec<String>, Vec<&str>) = channels.unzip();
        let names = fields(spoken.iter().map(String::as_str));
        let kinds = kinds
            .iter()
            .map(|kind| format!("a reading of a {kind} sensor"));
        let described: Vec<_> = names.iter().cloned().zip(kinds).collect();
        let topic = self.topic(
            "/sensors",
            "kinemark.Sensors",
            schema::flat("kinemark.Sensors", &described),
        );
        for tick in self.ticks(SIGNAL_RATE_HZ) {
            let values = run.trace.sensors.at(tick).iter().copied();
            let message = Flat {
                values: names.iter().map(String::as_str).zip(values).collect(),
            };
            self.message(topic, self.ns(tick as u64), &message)?;
        }
        Ok(())
    }

    /// How far the TCP is from the goal it is on its way to.
    fn errors(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.goals.is_empty() {
            return Ok(());
        }
        let names = [
            ("goal", "number of the goal, from one"),
            ("distance_m", "distance of the TCP to the goal, m"),
            ("full_m", "distance that earns all points, m"),
            ("zero_m", "distance that earns none, m"),
        ];
        let described: Vec<_> = names
            .iter()
            .map(|(name, what)| ((*name).to_owned(), (*what).to_owned()))
            .collect();
        let topic = self.topic(
            "/errors",
            "kinemark.Errors",
            schema::flat("kinemark.Errors", &described),
        );
        for tick in self.ticks(SIGNAL_RATE_HZ) {
            let Some(index) = current_goal(&run.goals, tick as u64) else {
                continue;
            };
            let goal = &run.goals[index];
            let distance_m =
                (run.trace.tcp_position(tick) - nalgebra::Vector3::from(goal.position_m)).norm();
            let values = [(index + 1) as f64, distance_m, goal.full_m, goal.zero_m];
            let message = Flat {
                values: names.iter().map(|(name, _)| *name).zip(values).collect(),
            };
            self.message(topic, self.ns(tick as u64), &message)?;
        }
        Ok(())
    }

    /// What the submission drew, all values of a tick in one message.
    fn plots(&mut self) -> Result<(), LogError> {
        let run = self.run;
        if run.trace.plots.is_empty() {
            return Ok(());
        }
        let names = fields(run.trace.plots.iter().map(|plot| plot.name.as_str()));
        let described: Vec<_> = names
            .iter()
            .zip(&run.trace.plots)
            .map(|(name, plot)| (name.clone(), visible(&plot.name).into_owned()))
            .collect();
        let topic = self.topic(
            "/plots",
            "kinemark.Plots",
            schema::flat("kinemark.Plots", &described),
        );
        let mut samples: Vec<(u64, usize, f64)> = Vec::new();
        for (i, plot) in run.trace.plots.iter().enumerate() {
            samples.extend(plot.samples.iter().map(|(tick, value)| (*tick, i, *value)));
        }
        samples.sort_by_key(|(tick, i, _)| (*tick, *i));
        for at_tick in samples.chunk_by(|a, b| a.0 == b.0) {
            let mut values: Vec<(&str, f64)> = Vec::new();
            for (_, i, value) in at_tick {
                let name = names[*i].as_str();
                // of two values of one tick the later stands
                match values.last_mut() {
                    Some(last) if last.0 == name => last.1 = *value,
                    _ => values.push((name, *value)),
                }
            }
            self.message(topic, self.ns(at_tick[0].0), &Flat { values })?;
        }
        Ok(())
    }

    /// What checks judged, with their bands.
    fn checks(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let names = fields(run.curves.iter().map(|curve| curve.check.as_str()));
        for (curve, name) in run.curves.iter().zip(&names) {
            let what = visible(&format!("{} [{}]", curve.title, curve.unit)).into_owned();
            let described = [
                ("value", what.as_str()),
                ("full", "earns all points"),
                ("zero", "earns none"),
            ];
            let described = described.map(|(name, what)| (name.to_owned(), what.to_owned()));
            let schema = schema::flat("kinemark.Judged", &described);
            let topic = self.topic(format!("/checks/{name}"), "kinemark.Judged", schema);
            let mut next_s = f64::NEG_INFINITY;
            let last = curve.t_s.len().saturating_sub(1);
            for (i, (t_s, value)) in curve.t_s.iter().zip(&curve.values).enumerate() {
                let is_due = *t_s >= next_s || i == last;
                if !t_s.is_finite() || *t_s < 0.0 || !is_due {
                    continue;
                }
                // a hair early, so that rounding does not skip every second one
                next_s = t_s + 0.999 / SIGNAL_RATE_HZ;
                let mut values = vec![("value", *value)];
                values.extend(curve.full.map(|full| ("full", full)));
                values.extend(curve.zero.map(|zero| ("zero", zero)));
                self.message(topic, (t_s * 1e9).round() as u64, &Flat { values })?;
            }
        }
        Ok(())
    }

    /// Events, printed lines, and the moments checks marked.
    fn lines(&mut self) -> Result<(), LogError> {
        let run = self.run;
        let topic = self.topic("/log", "foxglove.Log", schema::log());
        let mut lines: Vec<(u64, Level, Cow<'_, str>, &str)> = Vec::new();
        let names = run.names();
        for event in &run.trace.events {
            let level = match event.kind {
                EventKind::Diverged | EventKind::Stopped => Level::Error,
                EventKind::Saturated { .. }
                | EventKind::LimitHit { .. }
                | EventKind::SpeedLimitHit { .. } => Level::Warning,
                _ => Level::Info,
            };
            let message = names.event(&event.kind);
            lines.push((self.ns(event.tick), level, message.into(), "run"));
        }
        for contact in &run.trace.contacts {
            let [first, second] = contact.parties.map(|party| names.party(party));
            let message = format!(
                "`{first}` and `{second}` touch until {:.3} s: at most {:.3} N, {:.4} N s in all",
                contact.last_tick as f64 * run.trace.step_s,
                contact.peak_force_n,
                contact.impulse_n_s
            );
            let ns = self.ns(contact.first_tick);
            lines.push((ns, Level::Info, message.into(), "contact"));
        }
        for line in &run.trace.log {
            lines.push((
                self.ns(line.tick),
                Level::Info,
                line.text.as_str().into(),
                "submission",
            ));
        }
        for curve in &run.curves {
            for (t_s, text) in curve
                .marks
                .iter()
                .filter(|(t_s, _)| t_s.is_finite() && *t_s >= 0.0)
            {
                let ns = (t_s * 1e9).round() as u64;
                lines.push((ns, Level::Info, text.as_str().into(), &curve.check));
            }
        }
        for (ns, level, message, name) in lines {
            let line = Log {
                timestamp: Time::from_ns(ns),
                level,
                message: &visible(&message),
                name,
                file: "",
                line: 0,
            };
            self.message(topic, ns, &line)?;
        }
        Ok(())
    }
}
