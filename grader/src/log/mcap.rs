//! The log of a run as MCAP: what viewers such as Foxglove and Lichtblick replay. The clock is the simulation's.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Cursor;

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::robot::{Frame, Robot};
use kinemark_sim::spatial::Pose as Isometry;
use kinemark_sim::trace::EventKind;
use mcap::records::{MessageHeader, Metadata};
use mcap::{Compression, WriteOptions};
use serde::Serialize;
use serde_json::Value;

use super::message::{
    Flat, FrameTransform, FrameTransforms, JointState, JointStates, Level, Log, Pose, PoseInFrame,
    Quaternion, Time, Vector,
};
use super::names::{WORLD, fields, frame_id, frame_id_of};
use super::{scene, schema};
use crate::grade::Grade;
use crate::graded::TaskRun;
use crate::report::{current_goal, visible};

/// Poses and joint states a second.
const POSE_RATE_HZ: f64 = 60.0;
/// Flat signals a second; those of the submission and of checks at most so many.
const SIGNAL_RATE_HZ: f64 = 100.0;

/// A file that travels inside the log.
#[derive(Debug, Clone, Copy)]
pub struct Attachment<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its media type, such as `application/json`.
    pub media_type: &'a str,
    /// Its content.
    pub bytes: &'a [u8],
}

/// A log that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The writer refused.
    #[error("the log cannot be written: {0}")]
    Write(#[from] mcap::McapError),
    /// A message has no JSON form.
    #[error("a message cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// Writes the log of `run`, with the digests of `grade` as metadata and `attachments` beside the messages.
///
/// Topics: `/tf`, `/tcp` and `/joint_states` at 60 Hz, first and last tick included; `/scene` and `/reference/scene` once;
/// `/signals` and `/errors` at 100 Hz; `/plots` what the submission drew; `/checks/...` what checks judged; `/log` events and
/// printed lines. Messages are JSON. The same run gives the same bytes.
///
/// # Errors
/// [`LogError`] if the writer refuses, which no run of a robot should make it do.
pub fn mcap(
    run: &TaskRun,
    grade: &Grade,
    attachments: &[Attachment<'_>],
) -> Result<Vec<u8>, LogError> {
    let mut log = Messages::new(run);
    log.scenes()?;
    log.motion()?;
    log.signals()?;
    log.errors()?;
    log.plots()?;
    log.checks()?;
    log.lines()?;
    log.write(grade, attachments)
}

/// A channel to be: its topic and the schema of its messages.
struct Topic {
    topic: String,
    schema_name: String,
    schema: Value,
}

/// A message to be.
struct Message {
    log_time_ns: u64,
    topic: usize,
    /// Where its bytes are.
    bytes: std::ops::Range<usize>,
}

/// The messages of a run, gathered by topic and then written by time.
struct Messages<'a> {
    run: &'a TaskRun,
    topics: Vec<Topic>,
    messages: Vec<Message>,
    bytes: Vec<u8>,
}

impl<'a> Messages<'a> {
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
        let tree = Tree::new(&run.robot);
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
                self.message(tf, ns, &tree.transforms(&poses, timestamp))?;
            }
            let row = run.trace.tcp.at(tick);
            if row.iter().all(|x| x.is_finite()) {
                let pose = Pose {
                    position: Vector::new([row[0], row[1], row[2]]),
                    orientation: Quaternion {
                        w: row[3],
                        x: row[4],
                        y: row[5],
                        z: row[6],
                    },
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
        let joint = |i: usize| {
            run.robot
                .moving_joints()
                .nth(i)
                .map_or("?", |joint| joint.name.as_str())
        };
        for event in &run.trace.events {
            let (level, message) = match event.kind {
                EventKind::Saturated { joint: i } => (
                    Level::Warning,
                    format!("effort of `{}` reached its limit", joint(i)),
                ),
                EventKind::LimitCrossed { joint: i } => (
                    Level::Warning,
                    format!("`{}` left its position limits", joint(i)),
                ),
                EventKind::Diverged => (Level::Error, "the state is no longer finite".to_owned()),
                EventKind::Stopped => (Level::Error, "the submission was stopped".to_owned()),
            };
            lines.push((self.ns(event.tick), level, message.into(), "run"));
        }
        for line in &run.trace.log {
            lines.push((
                self.ns(line.tick),
                Level::Info,
                visible(&line.text),
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
                lines.push((ns, Level::Info, visible(text), &curve.check));
            }
        }
        for (ns, level, message, name) in lines {
            let line = Log {
                timestamp: Time::from_ns(ns),
                level,
                message: &message,
                name,
                file: "",
                line: 0,
            };
            self.message(topic, ns, &line)?;
        }
        Ok(())
    }

    fn write(mut self, grade: &Grade, attachments: &[Attachment<'_>]) -> Result<Vec<u8>, LogError> {
        let options = WriteOptions::new()
            .profile("")
            .library("kinemark")
            .compression(Some(Compression::Zstd))
            .compression_threads(0);
        let mut writer = options.create(Cursor::new(Vec::new()))?;
        let mut channels = Vec::new();
        for topic in &self.topics {
            let data = serde_json::to_vec(&topic.schema)?;
            let schema = writer.add_schema(&topic.schema_name, "jsonschema", &data)?;
            channels.push(writer.add_channel(schema, &topic.topic, "json", &BTreeMap::new())?);
        }
        // stable, so that messages of one instant keep the order of their topics
        self.messages.sort_by_key(|message| message.log_time_ns);
        let mut sequence = vec![0u32; channels.len()];
        for message in &self.messages {
            let header = MessageHeader {
                channel_id: channels[message.topic],
                sequence: sequence[message.topic],
                log_time: message.log_time_ns,
                publish_time: message.log_time_ns,
            };
            sequence[message.topic] += 1;
            writer.write_to_known_channel(&header, &self.bytes[message.bytes.clone()])?;
        }
        writer.write_metadata(&Metadata {
            name: "kinemark".to_owned(),
            metadata: facts(self.run, grade),
        })?;
        for attachment in attachments {
            writer.attach(&mcap::Attachment {
                log_time: 0,
                create_time: 0,
                name: attachment.name.to_owned(),
                media_type: attachment.media_type.to_owned(),
                data: Cow::Borrowed(attachment.bytes),
            })?;
        }
        writer.finish()?;
        Ok(writer.into_inner().into_inner())
    }
}

/// What the log rests on.
fn facts(run: &TaskRun, grade: &Grade) -> BTreeMap<String, String> {
    let mut facts = BTreeMap::from([
        ("engine".to_owned(), grade.engine.clone()),
        ("task".to_owned(), run.task.clone()),
        ("step_s".to_owned(), run.trace.step_s.to_string()),
        ("lab".to_owned(), grade.lab.name.clone()),
        ("lab_digest".to_owned(), grade.lab.digest.clone()),
        ("robot".to_owned(), grade.robot.name.clone()),
        ("robot_digest".to_owned(), grade.robot.digest.clone()),
        ("submission".to_owned(), grade.submission.name.clone()),
        (
            "submission_digest".to_owned(),
            grade.submission.digest.clone(),
        ),
    ]);
    if let Some(task) = grade.tasks.iter().find(|task| task.name == run.task) {
        facts.insert("trace_digest".to_owned(), task.digests.all.clone());
    }
    facts
}

/// The frames of a robot as a tree under the world.
struct Tree<'a> {
    robot: &'a Robot,
    /// Each frame's name, and which frame it hangs on.
    branches: Vec<(String, Option<usize>)>,
}

impl<'a> Tree<'a> {
    fn new(robot: &'a Robot) -> Self {
        let links = robot.links().len();
        let hangs_on = |(i, frame): (usize, &Frame)| {
            let parent = if i < links {
                robot
                    .joints()
                    .iter()
                    .find(|joint| joint.child == i)
                    .map(|joint| joint.parent)
            } else {
                Some(frame.link)
            };
            (frame_id(robot, frame), parent)
        };
        Self {
            robot,
            branches: robot.frames().iter().enumerate().map(hangs_on).collect(),
        }
    }

    fn transforms(&self, poses: &FramePoses, timestamp: Time) -> FrameTransforms<'_> {
        let world_from: Vec<Isometry> = self
            .robot
            .frames()
            .iter()
            .map(|frame| poses.world_from(frame))
            .collect();
        FrameTransforms {
            transforms: self
                .branches
                .iter()
                .enumerate()
                .map(|(i, (name, parent))| {
                    let pose = Pose::new(&match parent {
                        Some(parent) => world_from[*parent].inv_mul(&world_from[i]),
                        None => world_from[i],
                    });
                    FrameTransform {
                        timestamp,
                        parent_frame_id: parent.map_or(WORLD, |parent| &self.branches[parent].0),
                        child_frame_id: name,
                        translation: pose.position,
                        rotation: pose.orientation,
                    }
                })
                .collect(),
        }
    }
}
