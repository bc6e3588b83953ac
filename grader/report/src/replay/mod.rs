//! What a viewer needs to show a run again: shapes, poses by frame, and the moments worth a mark, as JSON that can stand in a page.

mod beside;
mod between;
mod column;
mod course;
mod frames;
mod live_arm;
mod moments;
mod motion;
mod nodes;
mod record;
mod shapes;
mod wanted;

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::model::scene::{BodyKind, Scene};
use kinemark_sim::spatial::Pose;
use kinemark_sim::trace::Trace;

use self::column::{Track, tick_column};
use self::course::{Course, What};
use self::frames::{looked, sound_ticks, steps};
pub use self::live_arm::{ArmShows, LiveArm};
use self::moments::{ContactMark, EventMark, MOST_OF_A_NAME, contacts, events};
use self::motion::{Motion, PLACE};
use self::nodes::Nodes;
use self::record::{FrameRecord, GoalRecord, JointRecord, PathRecord, Record, ReferencePath};
use self::shapes::pose_record;
use crate::visible::{shortened, visible};
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;

/// The format and its version.
const FORMAT: &str = "kinemark-replay/2";
/// Between frames everything is shown to this \[m or rad\].
const WITHIN: f64 = 3e-4;
/// TCP and joints, which are read as numbers of four decimals, to this \[m or rad\].
const NUMBERS_WITHIN: f64 = 1e-4;
/// Characters of coded motion of a run of ten seconds or less; longer runs may have as much more as they are longer. Beyond, what takes
/// the most is recorded less accurately, and the record says how much.
const MOST_CHARACTERS: usize = 90_000;
/// So much less accurately each time.
const LESS_TRUE: f64 = 3.0;
/// Nothing is recorded less accurately than this \[m or rad\].
const LEAST_TRUE: f64 = 10.0;
/// Points of a reference path or of a path to follow.
const MOST_POINTS: usize = 20_000;

/// A second motion, shown translucent beside the first.
#[derive(Debug, Clone, Copy)]
pub struct Overlay<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// What was around it.
    pub scene: Option<&'a Scene>,
    /// How it moved.
    pub trace: &'a Trace,
    /// What it is called, such as `reference` or `B`.
    pub label: &'a str,
    /// All of the run, where it is another and not the reference's: its path, its surroundings and its marks are shown, too.
    pub run: Option<(&'a TaskRun, Option<&'a TaskGrade>)>,
}

/// A run as a viewer shows it.
#[derive(Debug, Clone, Copy)]
pub struct Replay<'a> {
    run: &'a TaskRun,
    task: Option<&'a TaskGrade>,
    label: Option<&'a str>,
    ghost: Option<Overlay<'a>>,
}

impl<'a> Replay<'a> {
    /// The replay of a run, with what was graded of it; beside it the reference solution's, where the run brings that.
    pub fn of(run: &'a TaskRun, task: Option<&'a TaskGrade>) -> Self {
        let ghost = run.reference_overlay.as_ref().map(|trace| Overlay {
            robot: &run.robot,
            scene: run.scene.as_ref().map(|scene| &scene.scene),
            trace,
            label: "reference",
            run: None,
        });
        Self {
            run,
            task,
            label: None,
            ghost,
        }
    }

    /// The same, called `label`, beside another motion.
    pub fn beside(self, label: &'a str, ghost: Overlay<'a>) -> Self {
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
        let other = self.ghost.and_then(|ghost| ghost.run);
        let ticks = self.ticks();
        let mut events = self.events();
        for event in &mut events {
            // what ended a run has no row of its own
            event.tick = event.tick.min(ticks.saturating_sub(1) as u64);
        }
        let moments: Vec<u64> = events.iter().map(|event| event.tick).collect();
        let step_s = run.trace.step_s;
        let tracked = self.tracked(ticks, &moments);
        let stepped = steps(step_s, ticks, &moments);
        let steps = tick_column(&stepped);
        let tens = (ticks as f64 * step_s / 10.0).max(1.0);
        let most = ((tens * MOST_CHARACTERS as f64) as usize).saturating_sub(steps.len());
        let mut tracks = tracked.tracks(step_s, most);
        let nodes = tracks.split_off(1 + run.robot.n());
        let q = tracks.split_off(1);
        let tcp = tracks.pop().unwrap_or_default();
        let reference = match other {
            Some((other, _)) => Some(beside::tcp_path(other, run)),
            None => self.reference(),
        };
        let joints = run.robot.moving_joints().map(|joint| JointRecord {
            name: shortened(&joint.name, MOST_OF_A_NAME),
            unit: if joint.kind.turns() { "rad" } else { "m" },
        });
        Record {
            format: FORMAT,
            task: visible(&run.task).into_owned(),
            title: shortened(self.task.map_or(&run.task, |task| &task.title), 200),
            step_s,
            ticks: steps,
            nodes: tracked.nodes.nodes,
            meshes: tracked.nodes.meshes.records(),
            tcp,
            q,
            wanted: wanted::velocity(run, &stepped),
            tracks: nodes,
            lab: self.lab(),
            frames: self.frames(),
            joints: joints.collect(),
            reference,
            other: other.and_then(|(other, _)| beside::numbers(other, run, &stepped)),
            goals: self.goals(),
            paths: self.paths(),
            contacts: self.contacts(),
            events,
            ghost_label: self
                .ghost
                .map(|ghost| shortened(ghost.label, MOST_OF_A_NAME)),
            main_label: self.label.map(|label| shortened(label, MOST_OF_A_NAME)),
            ended: self.ended(),
        }
    }

    /// Ticks that are shown: of the run, and of another beside it that went on longer.
    fn ticks(&self) -> usize {
        let other = self.ghost.and_then(|ghost| ghost.run);
        let other = other.map_or(0, |(run, _)| {
            // two runs may have steps of different length
            let steps = run.trace.step_s / self.run.trace.step_s;
            (sound_ticks(&run.trace) as f64 * steps).ceil() as usize
        });
        match sound_ticks(&self.run.trace) {
            0 => 0,
            ticks => ticks.max(other),
        }
    }

    /// What happened in the run, and in another beside it under that one's label.
    fn events(&self) -> Vec<EventMark> {
        let mut marks = events(self.run, self.task);
        if let Some((ghost, (run, task))) = self.ghost.and_then(|g| Some((g, g.run?))) {
            let labelled = |label: &str, mut mark: EventMark| {
                mark.text = format!("{}: {}", shortened(label, MOST_OF_A_NAME), mark.text);
                mark
            };
            let ours = marks.into_iter();
            let ours = ours.map(|mark| labelled(self.label.unwrap_or("A"), mark));
            let theirs = events(run, task).into_iter();
            marks = ours
                .chain(theirs.map(|mark| labelled(ghost.label, mark)))
                .collect();
            marks.sort_by_key(|mark| mark.tick);
        }
        marks
    }

    /// The contacts of the run, and of another beside it under that one's label.
    fn contacts(&self) -> Vec<ContactMark> {
        let mut marks = contacts(self.run);
        if let Some((ghost, (run, _))) = self.ghost.and_then(|g| Some((g, g.run?))) {
            let label = shortened(ghost.label, MOST_OF_A_NAME);
            marks.extend(contacts(run).into_iter().map(|mark| mark.of(&label)));
        }
        marks
    }

    fn reference(&self) -> Option<ReferencePath> {
        let path = self.run.reference_tcp.as_ref()?;
        Some(ReferencePath {
            period_s: path.period_s,
            path: Track::even(
                &[PLACE; 3],
                path.points_m
                    .iter()
                    .take(MOST_POINTS)
                    .take_while(|p| p.iter().all(|x| x.is_finite())),
            ),
        })
    }

    /// Everything that moves, at the moments looked at, and what it belongs to.
    fn tracked(&self, ticks: usize, moments: &[u64]) -> Tracked {
        let run = self.run;
        let trace = &run.trace;
        let ghosts = self.ghost.map_or(0, |ghost| ghost.robot.links().len());
        let poses = run.robot.links().len() + trace.moving_bodies.len() + ghosts;
        let looked = looked(ticks, 7 * poses + run.robot.n() + 3, moments);
        let unit_m = unit_m(run, ticks);
        let mut nodes = Nodes::default();
        let motion = Motion::of(&run.robot, trace, &looked, trace.step_s, unit_m);
        nodes.robot(&run.robot, motion.links, None);
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
            let course = at.and_then(|at| motion.bodies.get(at)).cloned();
            let shapes = nodes.meshes.shapes(&body.shapes);
            let name = shortened(&body.name, MOST_OF_A_NAME);
            nodes.node(name, kind, None, shapes, &body.world_from_body, course);
        }
        if let Some(ghost) = &self.ghost {
            nodes.ghost(ghost, run, &motion.bodies, &looked, unit_m);
            if let Some((other, _)) = ghost.run {
                beside::surroundings(&mut nodes, other, run, ghost.label);
            }
        }
        let place = PLACE * unit_m;
        let mut tcp = Course::new(What::Place, &[place; 3], unit_m);
        let joints = run.robot.moving_joints();
        let mut q: Vec<Course> = joints
            .map(|joint| match joint.kind.turns() {
                true => Course::new(What::Number, &[PLACE], 1.0),
                false => Course::new(What::Number, &[place], unit_m),
            })
            .collect();
        // after its end a run stays where it was
        let last = sound_ticks(trace).saturating_sub(1);
        for tick in looked.iter().map(|tick| (*tick).min(last)) {
            tcp.push(trace.tcp.at(tick));
            for (course, q) in q.iter_mut().zip(trace.q.at(tick)) {
                course.push(&[*q]);
            }
        }
        Tracked {
            looked,
            tcp,
            q,
            nodes,
        }
    }

    /// The frame in which the TCP, goals and paths are given.
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

    /// Why the run, or another beside it, ended before its time, if it did.
    fn ended(&self) -> Option<String> {
        let ours = ended(self.run, self.task);
        let Some((ghost, (run, task))) = self.ghost.and_then(|g| Some((g, g.run?))) else {
            return ours;
        };
        let label = self.label.unwrap_or("A");
        let endings = [(label, ours), (ghost.label, ended(run, task))];
        let endings = endings.into_iter().filter_map(|(label, why)| {
            let label = shortened(label, MOST_OF_A_NAME);
            why.map(|why| format!("{label}: {why}"))
        });
        let endings: Vec<String> = endings.collect();
        (!endings.is_empty()).then(|| endings.join("; "))
    }
}

/// What moves, and the moments at which it was looked at.
struct Tracked {
    looked: Vec<usize>,
    tcp: Course,
    q: Vec<Course>,
    nodes: Nodes,
}

impl Tracked {
    /// The tracks of the TCP, of the joints, and of the nodes, in at most `most` characters: while they take more, whatever takes the
    /// most is recorded less accurately.
    fn tracks(&self, step_s: f64, most: usize) -> Vec<Track> {
        let courses: Vec<&Course> = [&self.tcp]
            .into_iter()
            .chain(&self.q)
            .chain(&self.nodes.courses)
            .collect();
        let track = |course: &Course, within: f64| course.track(&self.looked, step_s, within);
        let numbers = 1 + self.q.len();
        let mut within = vec![WITHIN; courses.len()];
        within[..numbers].fill(NUMBERS_WITHIN);
        let each = courses.iter().zip(&within);
        let mut tracks: Vec<Track> = each
            .map(|(course, within)| track(course, *within))
            .collect();
        let mut size: usize = tracks.iter().map(Track::size).sum();
        while size > most {
            let can = (0..tracks.len()).filter(|i| within[*i] < LEAST_TRUE);
            let Some(largest) = can.max_by_key(|i| tracks[*i].size()) else {
                break;
            };
            within[largest] *= LESS_TRUE;
            size -= tracks[largest].size();
            tracks[largest] = track(courses[largest], within[largest]);
            size += tracks[largest].size();
        }
        tracks
    }
}

/// The unit of length of a run \[m\]: a metre, or for an arm that reaches less far than a quarter of that, four times its reach.
fn unit_m(run: &TaskRun, ticks: usize) -> f64 {
    let mut poses = FramePoses::new(&run.robot);
    if ticks > 0 {
        poses.update(&run.robot, run.trace.q.at(0));
    }
    let frames = run.robot.frames();
    let place = |frame: &Frame| poses.world_from(frame).translation.vector;
    let base = frames.first().map(place).unwrap_or_default();
    let reach_m = frames
        .iter()
        .map(|frame| (place(frame) - base).norm())
        .fold(0.0, f64::max);
    if reach_m > 0.0 {
        (4.0 * reach_m).clamp(1e-4, 1.0)
    } else {
        1.0
    }
}

/// Why a run ended before its time, if it did.
fn ended(run: &TaskRun, task: Option<&TaskGrade>) -> Option<String> {
    kinemark_grader::record::comparison::ended(run, task)
        .map(|ended| shortened(&ended.message.replace('`', ""), 300))
}

/// A frame of a robot: on the node of its link, or in the world where that never moves.
fn frame_record(robot: &Robot, frame: &Frame) -> FrameRecord {
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

#[cfg(test)]
mod tests;
