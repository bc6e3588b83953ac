//! The columns of one run, in tick order, and their digests: the identity of the run.

use crate::kinematics::FramePoses;
use crate::model::robot::{Frame, Robot};
use crate::model::scene::BodyKind;
use crate::run::{Recorder, Row, Setup};
use crate::spatial::Pose;
use crate::step::hybrid::HybridStep;
use crate::watch::event::Event;
use crate::watch::{ContactSpan, Watch};

/// One signal of a run: `width` numbers a tick, rows in tick order.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    name: &'static str,
    width: usize,
    values: Vec<f64>,
}

impl Signal {
    fn new(name: &'static str, width: usize, ticks: u64) -> Self {
        Self {
            name,
            width,
            values: Vec::with_capacity(width * (ticks as usize + 1)),
        }
    }

    /// Its name in digests and logs.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Numbers a tick.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The numbers at a tick.
    ///
    /// # Panics
    /// If the tick was not recorded.
    pub fn at(&self, tick: usize) -> &[f64] {
        &self.values[tick * self.width..(tick + 1) * self.width]
    }

    /// The `i`-th number of every tick, in order.
    pub fn component(&self, i: usize) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.values.iter().skip(i).step_by(self.width).copied()
    }
}

/// A line the submission printed.
#[derive(Debug, Clone, PartialEq)]
pub struct LogLine {
    /// The tick of the call that printed it.
    pub tick: u64,
    /// The text.
    pub text: String,
    /// The line of the submission that printed it, where that is known.
    pub line: Option<usize>,
}

/// A signal the submission drew with `plot`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotSignal {
    /// Its name.
    pub name: String,
    /// Ticks and values, in order.
    pub samples: Vec<(u64, f64)>,
}

/// The columns of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// The physics step \[s\].
    pub step_s: f64,
    /// Joint positions \[rad or m\].
    pub q: Signal,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Signal,
    /// The command held from the tick on, in the servo's mode.
    pub command: Signal,
    /// The effort held from the tick on \[N m or N\].
    pub effort: Signal,
    /// The TCP in the frame in which it is reported: position x, y, z \[m\], then the unit quaternion w, x, y, z with `w >= 0`.
    pub tcp: Signal,
    /// The scene's bodies that can move, in scene order, in the world: for each, position x, y, z \[m\] and unit quaternion w, x, y, z.
    pub bodies: Signal,
    /// Indices in the scene of the bodies in `bodies`.
    pub moving_bodies: Vec<usize>,
    /// What the sensors read, channel by channel.
    pub sensors: Signal,
    /// The contacts, with their parties and first and last ticks, in the order in which they began.
    pub contacts: Vec<ContactSpan>,
    /// What happened, in tick order.
    pub events: Vec<Event>,
    /// What the submission printed, in order.
    pub log: Vec<LogLine>,
    /// What the submission plotted, by first use.
    pub plots: Vec<PlotSignal>,
}

/// Digests of one simulated second, or less at the end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SecondDigest {
    /// Of all signals of the second.
    pub all: blake3::Hash,
    /// Of each signal, in the order of [`Trace::signals`].
    pub signals: Vec<blake3::Hash>,
}

/// The identity of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TraceDigest {
    /// Of the whole run, with its events, log and plots.
    pub all: blake3::Hash,
    /// Of each simulated second.
    pub seconds: Vec<SecondDigest>,
}

impl Trace {
    /// The number of ticks recorded.
    pub fn len(&self) -> usize {
        self.q.values.len() / self.q.width.max(1)
    }

    /// Whether nothing was recorded.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All signals. Without a scene the signal of the bodies is empty; without sensors, theirs.
    pub fn signals(&self) -> [&Signal; 7] {
        [
            &self.q,
            &self.qd,
            &self.command,
            &self.effort,
            &self.tcp,
            &self.bodies,
            &self.sensors,
        ]
    }

    /// Pose in the world of body `index` of the scene at a tick; `None` if that body cannot move.
    ///
    /// # Panics
    /// If the tick was not recorded.
    pub fn world_from_body(&self, index: usize, tick: usize) -> Option<Pose> {
        let at = self.moving_bodies.iter().position(|body| *body == index)?;
        let row = &self.bodies.at(tick)[7 * at..7 * at + 7];
        let [x, y, z, qw, qx, qy, qz] = *row else {
            return None;
        };
        let turn = nalgebra::Quaternion::new(qw, qx, qy, qz);
        Some(Pose::from_parts(
            nalgebra::Translation3::new(x, y, z),
            nalgebra::UnitQuaternion::from_quaternion(turn).to_rotation_matrix(),
        ))
    }

    /// Position of the TCP at a tick \[m\].
    ///
    /// # Panics
    /// If the tick was not recorded.
    pub fn tcp_position(&self, tick: usize) -> nalgebra::Vector3<f64> {
        let row = self.tcp.at(tick);
        nalgebra::Vector3::new(row[0], row[1], row[2])
    }

    /// Rotation of the TCP at a tick, in the frame in which it is reported.
    ///
    /// # Panics
    /// If the tick was not recorded.
    pub fn tcp_rotation(&self, tick: usize) -> nalgebra::Rotation3<f64> {
        let row = self.tcp.at(tick);
        let turn = nalgebra::Quaternion::new(row[3], row[4], row[5], row[6]);
        nalgebra::UnitQuaternion::from_quaternion(turn).to_rotation_matrix()
    }

    /// Ticks in a simulated second.
    pub fn ticks_per_second(&self) -> usize {
        ((1.0 / self.step_s).round() as usize).max(1)
    }

    /// Hashes the run: BLAKE3 over the little-endian bits of every signal, a second at a time.
    pub fn digest(&self) -> TraceDigest {
        let per_second = self.ticks_per_second();
        let ticks = self.len();
        let mut all = blake3::Hasher::new();
        all.update(b"kinemark-trace/2");
        all.update(&self.step_s.to_le_bytes());
        all.update(&(ticks as u64).to_le_bytes());
        let mut seconds = Vec::with_capacity(ticks.div_ceil(per_second));
        for start in (0..ticks).step_by(per_second) {
            let end = (start + per_second).min(ticks);
            let mut second = blake3::Hasher::new();
            let mut signals = Vec::with_capacity(7);
            for signal in self.signals() {
                let values = &signal.values[start * signal.width..end * signal.width];
                let hash = hash_bits(values);
                second.update(signal.name.as_bytes());
                second.update(&(signal.width as u64).to_le_bytes());
                second.update(hash.as_bytes());
                signals.push(hash);
            }
            let hash = second.finalize();
            all.update(hash.as_bytes());
            seconds.push(SecondDigest { all: hash, signals });
        }
        let text = |hasher: &mut blake3::Hasher, text: &str| {
            hasher.update(&(text.len() as u64).to_le_bytes());
            hasher.update(text.as_bytes());
        };
        all.update(&(self.events.len() as u64).to_le_bytes());
        for event in &self.events {
            all.update(&event.tick.to_le_bytes());
            event.kind.digest_into(&mut all);
        }
        all.update(&(self.contacts.len() as u64).to_le_bytes());
        for contact in &self.contacts {
            contact.digest_into(&mut all);
        }
        all.update(&(self.log.len() as u64).to_le_bytes());
        for line in &self.log {
            all.update(&line.tick.to_le_bytes());
            text(&mut all, &line.text);
        }
        all.update(&(self.plots.len() as u64).to_le_bytes());
        for plot in &self.plots {
            text(&mut all, &plot.name);
            all.update(&(plot.samples.len() as u64).to_le_bytes());
            for (tick, value) in &plot.samples {
                all.update(&tick.to_le_bytes());
                // every NaN is one NaN: its bits are not the same on every platform
                let value = if value.is_nan() { f64::NAN } else { *value };
                all.update(&value.to_bits().to_le_bytes());
            }
        }
        TraceDigest {
            all: all.finalize(),
            seconds,
        }
    }
}

/// BLAKE3 of the numbers' little-endian bits.
pub fn hash_bits(values: &[f64]) -> blake3::Hash {
    if cfg!(target_endian = "little") {
        blake3::hash(bytemuck::cast_slice(values))
    } else {
        let mut hasher = blake3::Hasher::new();
        for value in values {
            hasher.update(&value.to_le_bytes());
        }
        hasher.finalize()
    }
}

/// Records a run as a [`Trace`], with the TCP's pose at every tick, the bodies of the scene, and what a [`Watch`] reports.
#[derive(Debug, Clone)]
pub struct TraceRecorder<'a> {
    robot: &'a Robot,
    tcp: &'a Frame,
    seen_from: &'a Frame,
    poses: FramePoses,
    watch: Watch<'a>,
    trace: Trace,
}

impl<'a> TraceRecorder<'a> {
    /// A recorder for `setup`.
    pub fn new(setup: &Setup<'a>) -> Self {
        let robot = setup.robot;
        let n = robot.n();
        let bodies = setup.scene.map_or(&[][..], |scene| &scene.bodies);
        let moving = bodies.iter().enumerate();
        let moving = moving.filter(|(_, body)| !matches!(body.kind, BodyKind::Fixed));
        let width = setup
            .sensors
            .iter()
            .map(|sensor| sensor.kind.measured().channels());
        let width = width.sum();
        let moving_bodies: Vec<usize> = moving.map(|(index, _)| index).collect();
        Self {
            robot,
            tcp: setup.tcp,
            seen_from: setup.seen_from,
            poses: FramePoses::new(robot),
            watch: Watch::new(setup),
            trace: Trace {
                step_s: setup.periods.step_s,
                q: Signal::new("q", n, setup.ticks),
                qd: Signal::new("qd", n, setup.ticks),
                command: Signal::new("command", n, setup.ticks),
                effort: Signal::new("effort", n, setup.ticks),
                tcp: Signal::new("tcp", 7, setup.ticks),
                bodies: Signal::new("bodies", 7 * moving_bodies.len(), setup.ticks),
                moving_bodies,
                sensors: Signal::new("sensors", width, setup.ticks),
                contacts: Vec::new(),
                events: Vec::new(),
                log: Vec::new(),
                plots: Vec::new(),
            },
        }
    }

    /// The signals as far as they are recorded; contacts and events are known at the end only.
    pub fn so_far(&self) -> &Trace {
        &self.trace
    }

    /// The trace, once the run has ended.
    pub fn finish(self) -> Trace {
        let mut trace = self.trace;
        (trace.events, trace.contacts) = self.watch.finish();
        trace
    }
}

impl Recorder for TraceRecorder<'_> {
    fn row(&mut self, row: Row<'_>) {
        self.watch.observe(&row);
        let trace = &mut self.trace;
        trace.q.values.extend_from_slice(row.q);
        trace.qd.values.extend_from_slice(row.qd);
        trace.command.values.extend_from_slice(row.command);
        trace.effort.values.extend_from_slice(row.effort);
        trace.sensors.values.extend_from_slice(row.sensors);
        self.poses.update(self.robot, row.q);
        let tcp = self
            .poses
            .world_from(self.seen_from)
            .inv_mul(&self.poses.world_from(self.tcp));
        trace.tcp.values.extend_from_slice(&pose_numbers(&tcp));
        if let Some(scene) = row.scene {
            record_bodies(scene, row.tick, &trace.moving_bodies, &mut trace.bodies);
        }
    }
}

/// Writes where the bodies are; of a body that sleeps, what was written at the tick before.
fn record_bodies(scene: &HybridStep, tick: u64, moving: &[usize], signal: &mut Signal) {
    for &index in moving {
        let body = scene.body(index);
        if body.sleeps && tick > 0 {
            let before = signal.values.len() - signal.width;
            signal.values.extend_from_within(before..before + 7);
        } else {
            let pose = pose_numbers(&body.world_from_body);
            signal.values.extend_from_slice(&pose);
        }
    }
}

/// A pose as it is recorded: position x, y, z, then the unit quaternion w, x, y, z with `w >= 0`.
pub fn pose_numbers(pose: &Pose) -> [f64; 7] {
    let p = pose.translation.vector;
    let [w, x, y, z] = quaternion(pose.rotation.matrix());
    [p.x, p.y, p.z, w, x, y, z]
}

/// The unit quaternion `[w, x, y, z]` of a rotation matrix, with `w >= 0`; the largest element is found first, so that none is
/// divided by a small one.
///
/// Source: Shepperd, *Quaternion from rotation matrix* (1978).
pub fn quaternion(r: &nalgebra::Matrix3<f64>) -> [f64; 4] {
    let trace = r.m11 + r.m22 + r.m33;
    let [w, x, y, z] = if trace >= r.m11.max(r.m22).max(r.m33) {
        let s = 2.0 * (1.0 + trace).sqrt();
        [
            s / 4.0,
            (r.m32 - r.m23) / s,
            (r.m13 - r.m31) / s,
            (r.m21 - r.m12) / s,
        ]
    } else if r.m11 >= r.m22.max(r.m33) {
        let s = 2.0 * (1.0 + r.m11 - r.m22 - r.m33).sqrt();
        [
            (r.m32 - r.m23) / s,
            s / 4.0,
            (r.m12 + r.m21) / s,
            (r.m13 + r.m31) / s,
        ]
    } else if r.m22 >= r.m33 {
        let s = 2.0 * (1.0 + r.m22 - r.m11 - r.m33).sqrt();
        [
            (r.m13 - r.m31) / s,
            (r.m12 + r.m21) / s,
            s / 4.0,
            (r.m23 + r.m32) / s,
        ]
    } else {
        let s = 2.0 * (1.0 + r.m33 - r.m11 - r.m22).sqrt();
        [
            (r.m21 - r.m12) / s,
            (r.m13 + r.m31) / s,
            (r.m23 + r.m32) / s,
            s / 4.0,
        ]
    };
    if w < 0.0 {
        [-w, -x, -y, -z]
    } else {
        [w, x, y, z]
    }
}
