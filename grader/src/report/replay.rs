//! What a viewer needs to show a run again: shapes, poses by frame, and the moments worth a mark, as JSON that can stand in a page.

mod column;
mod frames;
mod moments;
mod motion;
mod nodes;
mod record;
mod shapes;

use kinemark_sim::robot::Robot;
use kinemark_sim::scene::{BodyKind, Scene};
use kinemark_sim::spatial::Pose;
use kinemark_sim::trace::Trace;

use self::column::{Columns, Track};
use self::frames::{frames, sound_ticks};
use self::moments::{MOST_OF_A_NAME, contacts, events};
use self::motion::{Motion, PLACE};
use self::nodes::Nodes;
use self::record::{
    Coded, FrameRecord, GoalRecord, JointRecord, PathRecord, Record, ReferencePath,
};
use self::shapes::pose_record;
use crate::grade::TaskGrade;
use crate::graded::TaskRun;
use crate::report::visible::{shortened, visible};

/// The format and its version.
const FORMAT: &str = "kinemark-replay/1";
/// Characters of coded data of a run of ten seconds or less; longer runs may have as much more as they are longer.
const MOST_CHARACTERS: usize = 120_000;
/// How many periods apart the frames may be, finest first.
const COARSENESS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Frames at events are left out from this coarseness on: of many joints, they are most of the data.
const TOO_COARSE_FOR_EVENTS: usize = 8;
/// Points of a reference path or of a path to follow.
const MOST_POINTS: usize = 20_000;

/// A second motion, shown translucent beside the first.
#[derive(Debug, Clone, Copy)]
pub struct Ghost<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// What was around it.
    pub scene: Option<&'a Scene>,
    /// How it moved.
    pub trace: &'a Trace,
    /// What it is called, such as `reference` or `B`.
    pub label: &'a str,
}

/// A run as a viewer shows it.
#[derive(Debug, Clone, Copy)]
pub struct Replay<'a> {
    run: &'a TaskRun,
    task: Option<&'a TaskGrade>,
    label: Option<&'a str>,
    ghost: Option<Ghost<'a>>,
}

impl<'a> Replay<'a> {
    /// The replay of a run, with what was graded of it; beside it the reference solution's, where the run brings that.
    pub fn of(run: &'a TaskRun, task: Option<&'a TaskGrade>) -> Self {
        let ghost = run.ghost.as_ref().map(|trace| Ghost {
            robot: &run.robot,
            scene: run.scene.as_ref().map(|scene| &scene.scene),
            trace,
            label: "reference",
        });
        Self {
            run,
            task,
            label: None,
            ghost,
        }
    }

    /// The same, called `label`, beside another motion.
    pub fn beside(self, label: &'a str, ghost: Ghost<'a>) -> Self {
        Self {
            label: Some(label),
            ghost: Some(ghost),
            ..self
        }
    }

    /// Whether there is nothing to show: the run has no row, or its first is not finite.
    pub fn is_empty(&self) -> bool {
        sound_ticks(&self.run.trace) == 0
    }

    /// The replay as JSON without a `<`, so that nothing in it can end the element it stands in. The same run gives the same bytes.
    pub fn json(&self) -> String {
        let record = self.record();
        // a record of texts and finite numbers has a JSON form
        let json = serde_json::to_string(&record).unwrap_or_default();
        json.replace('<', "\\u003c")
    }

    fn record(&self) -> Record<'_> {
        let run = self.run;
        let ticks = sound_ticks(&run.trace);
        let mut events = events(run, self.task);
        for event in &mut events {
            // what ended a run has no row of its own
            event.tick = event.tick.min(ticks.saturating_sub(1) as u64);
        }
        let moments: Vec<u64> = events.iter().map(|event| event.tick).collect();
        let step_s = run.trace.step_s;
        let tens = (ticks as f64 * step_s / 10.0).max(1.0);
        let most = (tens * MOST_CHARACTERS as f64) as usize;
        let mut coded = Coded::default();
        let mut between = "line";
        for coarseness in COARSENESS {
            let moments = if coarseness < TOO_COARSE_FOR_EVENTS {
                &moments[..]
            } else {
                &[]
            };
            between = if coarseness > 1 { "curve" } else { "line" };
            coded = self.coded(&frames(step_s, ticks, coarseness, moments));
            if coded.size() <= most {
                break;
            }
        }
        let reference = run.reference_tcp.as_ref().map(|path| ReferencePath {
            period_s: path.period_s,
            path: track(
                &[PLACE; 3],
                path.points_m
                    .iter()
                    .take(MOST_POINTS)
                    .take_while(|p| p.iter().all(|x| x.is_finite())),
            ),
        });
        let joints = run.robot.moving_joints().map(|joint| JointRecord {
            name: shortened(&joint.name, MOST_OF_A_NAME),
            unit: if joint.kind.turns() { "rad" } else { "m" },
        });
        Record {
            format: FORMAT,
            task: visible(&run.task).into_owned(),
            title: shortened(self.task.map_or(&run.task, |task| &task.title), 200),
            step_s,
            between,
            lab: self.lab(),
            frames: self.frames(),
            joints: joints.collect(),
            reference,
            goals: self.goals(),
            paths: self.paths(),
            contacts: contacts(run),
            events,
            ghost_label: self
                .ghost
                .map(|ghost| shortened(ghost.label, MOST_OF_A_NAME)),
            main_label: self.label.map(|label| shortened(label, MOST_OF_A_NAME)),
            ended: self.ended(),
            coded,
        }
    }

    /// All that changes from frame to frame, and what it belongs to.
    fn coded(&self, frames: &[usize]) -> Coded {
        let run = self.run;
        let trace = &run.trace;
        let mut nodes = Nodes::default();
        let motion = Motion::of(&run.robot, trace, frames, trace.step_s);
        nodes.robot(&run.robot, &motion, None);
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        for (index, body) in bodies.enumerate() {
            let kind = match body.kind {
                BodyKind::Fixed => "fixed",
                BodyKind::Kinematic(_) => "driven",
                BodyKind::Free => "free",
            };
            let at = trace
                .moving_bodies
                .iter()
                .position(|moving| *moving == index);
            let course = at.and_then(|at| motion.bodies.get(at));
            let shapes = nodes.meshes.shapes(&body.shapes);
            let name = shortened(&body.name, MOST_OF_A_NAME);
            nodes.node(name, kind, None, shapes, &body.world_from_body, course);
        }
        if let Some(ghost) = &self.ghost {
            nodes.ghost(ghost, run, &motion, frames);
        }
        let ticks = frames.iter().map(|tick| [*tick as f64]);
        Coded {
            ticks: track(&[1.0], ticks).into_data(),
            tcp: track(
                &[PLACE; 3],
                frames.iter().map(|tick| &trace.tcp.at(*tick)[..3]),
            ),
            q: track(
                &vec![PLACE; run.robot.n()],
                frames.iter().map(|tick| trace.q.at(*tick)),
            ),
            meshes: nodes.meshes.records(),
            nodes: nodes.nodes,
            tracks: nodes.tracks,
        }
    }

    /// The frame in which the TCP, goals and paths are told.
    fn lab(&self) -> FrameRecord {
        let robot = &self.run.robot;
        let name = &self.run.seen_from;
        let found = robot.frame(name).map(|frame| frame_record(robot, frame));
        found.unwrap_or_else(|| FrameRecord {
            name: shortened(name, MOST_OF_A_NAME),
            node: None,
            pose: pose_record(&Pose::identity()),
        })
    }

    /// The frames a robot names besides its links.
    fn frames(&self) -> Vec<FrameRecord> {
        let robot = &self.run.robot;
        let named = robot.frames().iter().skip(robot.links().len());
        named.map(|frame| frame_record(robot, frame)).collect()
    }

    fn goals(&self) -> Vec<GoalRecord> {
        let finite = |radius_m: f64| radius_m.is_finite().then_some(radius_m);
        let goals = self
            .run
            .goals
            .iter()
            .filter(|goal| goal.position_m.iter().all(|x| x.is_finite()));
        let record = goals.map(|goal| GoalRecord {
            position: goal.position_m,
            full: finite(goal.full_m),
            zero: finite(goal.zero_m),
        });
        record.collect()
    }

    fn paths(&self) -> Vec<PathRecord<'_>> {
        let record = self.run.paths.iter().map(|path| PathRecord {
            name: shortened(&path.name, MOST_OF_A_NAME),
            points: &path.points_m[..path.points_m.len().min(MOST_POINTS)],
            full: path.tube_m.map(|tube| tube[0]).filter(|x| x.is_finite()),
            zero: path.tube_m.map(|tube| tube[1]).filter(|x| x.is_finite()),
        });
        record.collect()
    }

    /// Why the run ended before its time, if it did.
    fn ended(&self) -> Option<String> {
        let names = self.run.names();
        let last = self
            .run
            .trace
            .events
            .iter()
            .rfind(|event| moments::ends(&event.kind));
        let stopped = self.task.and_then(|task| task.stopped.as_ref());
        let told = stopped.filter(|stopped| stopped.tick.is_some() || self.run.trace.is_empty());
        let words = match (told, last) {
            (Some(stopped), _) => stopped.message.clone(),
            (None, Some(event)) => names.event(&event.kind),
            (None, None) => return None,
        };
        Some(shortened(&words.replace('`', ""), 300))
    }
}

/// A frame of a robot: on the node of its link, or in the world where that never moves.
fn frame_record(robot: &Robot, frame: &kinemark_sim::robot::Frame) -> FrameRecord {
    let name = shortened(&frame.name, MOST_OF_A_NAME);
    match frame.attachment.body {
        None => FrameRecord {
            name,
            node: None,
            pose: pose_record(&frame.attachment.body_from_here),
        },
        Some(_) => {
            let body_from_link = &robot.frames()[frame.link].attachment.body_from_here;
            let link_from_frame = body_from_link.inv_mul(&frame.attachment.body_from_here);
            FrameRecord {
                name,
                node: Some(frame.link),
                pose: pose_record(&link_from_frame),
            }
        }
    }
}

/// Rows as a track.
fn track<R: AsRef<[f64]>>(quanta: &[f64], rows: impl Iterator<Item = R>) -> Track {
    let mut columns = Columns::new(quanta);
    for row in rows {
        columns.push(row.as_ref());
    }
    columns.track()
}

#[cfg(test)]
mod tests;
