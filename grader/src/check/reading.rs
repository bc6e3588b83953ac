//! What a kind of check has at hand while its table is read: the robot, the task, the checks before it; names become indices.

use std::ops::{Deref, Range};
use std::sync::Arc;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::model::sensor::Measured;
use kinemark_sim::text::{Problem, Spanned};
use kinemark_sim::ticks::whole_ratio;

use super::contract::{Check, MotionCheck};
use crate::task::joint_units::JointUnits;
use crate::task::model::{FunctionTask, MotionTask};
use crate::task::problem::{LabError, near, problems};
use crate::task::reporter::Reporter;
use crate::task::scene::LabScene;
use crate::task::watched::PathToFollow;

/// A short name for what nearly every key of a check is: a value as typed, with its place.
pub(crate) use kinemark_sim::text::Spanned as At;

/// What the table of a check is read with: `T` is what the kind may look at.
#[derive(Debug, Clone)]
pub(crate) struct Reading<'a, T> {
    /// Where problems are reported.
    pub(crate) report: Reporter<'a>,
    /// Where the table stands.
    pub(crate) at: Range<usize>,
    /// What the check is of.
    pub(crate) of: T,
}

/// What a check of a motion task is read with.
pub(crate) type MotionReading<'a> = Reading<'a, InMotion<'a>>;

/// What a check of a function task is read with.
pub(crate) type FunctionReading<'a> = Reading<'a, &'a FunctionTask>;

/// What a check of a motion task can name.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InMotion<'a> {
    /// The robot of the lab.
    pub(crate) robot: &'a Robot,
    /// The task.
    pub(crate) motion: &'a MotionTask,
    /// The name of the check.
    pub(crate) check: &'a str,
    /// The checks before it.
    pub(crate) earlier: &'a [Check<dyn MotionCheck>],
}

impl<T> Deref for Reading<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.of
    }
}

/// A number that sensors read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Channel {
    /// The sensor's name, with that of the part if one is named.
    pub(super) name: String,
    /// Its index among all numbers that sensors read.
    pub(super) index: usize,
    /// Whether it is 1 or 0.
    pub(super) is_switch: bool,
    /// Its unit; empty for a switch.
    pub(super) unit: &'static str,
}

problems! {
    /// A name or a time in the table of a check that does not fit the task, the robot or the scene.
    enum ReadingProblem {
        UnknownJoint { robot: String, joint: String, known: Vec<String> }:
            "lab::unknown_joint", "robot `{robot}` has no joint `{joint}` that moves", "not a joint of this robot",
            near(joint, "joints", known);
        NoScene { kind: &'static str }:
            "lab::check_kind", "a check of kind `{kind}` needs `scene` in [tasks.motion]", "there is no scene in this task",
            "name one, such as `scene = \"shelf-and-can\"`";
        UnknownBody { scene: String, body: String, known: Vec<String> }:
            "lab::unknown_body", "scene `{scene}` has no body `{body}`", "not a body of this scene",
            near(body, "bodies", known);
        CannotFall { body: String, free: Vec<String> }:
            "lab::body_falls", "body `{body}` cannot fall: it is not dynamic", "not a dynamic body",
            near(body, "dynamic bodies", free);
        NoPaths { path: String }:
            "lab::unknown_path", "this task has no path `{path}`", "not a path of [tasks.motion.paths]",
            format!("add a table: [tasks.motion.paths] with `{path} = {{ points_m = [[..], [..]], trim_m = 0.05 }}`");
        UnknownPath { path: String, known: Vec<String> }:
            "lab::unknown_path", "this task has no path `{path}`", "not a path of [tasks.motion.paths]",
            near(path, "paths", known);
        NoSegment { path: String, count: usize, segment: u64 }:
            "lab::path", "path `{path}` has segments 1 to {count}, got {segment}", "not a segment of this path",
            "leave `segment` out to have the worst one counted";
        NoSensors { sensor: String }:
            "lab::unknown_sensor", "this task has no sensor `{sensor}`: it has none at all", "not a sensor of this task",
            "add one in [[tasks.motion.sensors]], or to the robot file";
        UnknownSensor { sensor: String, known: Vec<String> }:
            "lab::unknown_sensor", "this task has no sensor `{sensor}`", "not a sensor of this task",
            near(sensor, "sensors", known);
        UnknownPart { sensor: String, part: String, known: Vec<String> }:
            "lab::unknown_sensor", "sensor `{sensor}` has no part `{part}`", "not a part of this sensor",
            match known.is_empty() {
                true => "it reads one number: leave `part` out".to_owned(),
                false => near(part, "parts", known),
            };
        NotWholeSteps { time_s: f64, step_s: f64 }:
            "lab::periods", "{time_s} s is not an integer multiple of the physics step of {step_s} s", "does not divide";
        LongerThanRun { time_s: f64 }:
            "lab::periods", "{time_s} s is longer than the run", "longer than the run";
    }
}

impl<T> Reading<'_, T> {
    /// Refuses the table for `problem`.
    pub(crate) fn refuse<R>(&self, problem: impl Problem) -> Result<R, LabError> {
        self.report.refuse(self.at.clone(), problem)
    }

    /// Refuses what was `typed` for `problem`.
    pub(crate) fn refuse_at<R, V>(
        &self,
        typed: &Spanned<V>,
        problem: impl Problem,
    ) -> Result<R, LabError> {
        self.report.refuse_at(typed, problem)
    }
}

impl MotionReading<'_> {
    /// Units of the joint with this index in `q`, or of all joints.
    pub(super) fn units(&self, joint: Option<usize>) -> JointUnits {
        match joint {
            Some(joint) => JointUnits::of(self.robot, joint),
            None => JointUnits::of_all(self.robot),
        }
    }

    /// Index in `q` of the joint called `name`.
    pub(super) fn joint(&self, name: &Spanned<String>) -> Result<usize, LabError> {
        let joints = self.robot.moving_joints();
        let known: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
        if let Some(index) = known.iter().position(|known| known == name.get_ref()) {
            return Ok(index);
        }
        let problem = ReadingProblem::UnknownJoint {
            robot: self.robot.name().to_owned(),
            joint: name.get_ref().clone(),
            known,
        };
        self.refuse_at(name, problem)
    }

    /// Index in `q` of the joint called `name`, where one is named.
    pub(super) fn maybe_joint(&self, name: Option<&At<String>>) -> Result<Option<usize>, LabError> {
        name.map(|name| self.joint(name)).transpose()
    }

    /// The scene of the task, which a check of `kind` needs.
    pub(super) fn scene(&self, kind: &'static str) -> Result<&Arc<LabScene>, LabError> {
        match &self.motion.scene {
            Some(scene) => Ok(scene),
            None => self.refuse(ReadingProblem::NoScene { kind }),
        }
    }

    /// Index of a body of the scene.
    pub(super) fn body(&self, scene: &LabScene, name: &Spanned<String>) -> Result<usize, LabError> {
        let bodies = scene.scene.bodies.iter();
        let known: Vec<String> = bodies.map(|body| body.name.clone()).collect();
        if let Some(index) = known.iter().position(|known| known == name.get_ref()) {
            return Ok(index);
        }
        let problem = ReadingProblem::UnknownBody {
            scene: scene.name.clone(),
            body: name.get_ref().clone(),
            known,
        };
        self.refuse_at(name, problem)
    }

    /// Index of a body of the scene that can fall.
    pub(super) fn free_body(
        &self,
        scene: &LabScene,
        name: &Spanned<String>,
    ) -> Result<usize, LabError> {
        let body = self.body(scene, name)?;
        let bodies = &scene.scene.bodies;
        if matches!(bodies[body].kind, BodyKind::Free) {
            return Ok(body);
        }
        let free = bodies
            .iter()
            .filter(|body| matches!(body.kind, BodyKind::Free));
        let problem = ReadingProblem::CannotFall {
            body: name.get_ref().clone(),
            free: free.map(|body| body.name.clone()).collect(),
        };
        self.refuse_at(name, problem)
    }

    /// The path of the task called `name`.
    pub(super) fn path(&self, name: &Spanned<String>) -> Result<PathToFollow, LabError> {
        let paths = &self.motion.paths;
        if let Some(path) = paths.iter().find(|path| path.name == *name.get_ref()) {
            return Ok(path.clone());
        }
        let path = name.get_ref().clone();
        let known: Vec<String> = paths.iter().map(|path| path.name.clone()).collect();
        let problem = match known.is_empty() {
            true => ReadingProblem::NoPaths { path },
            false => ReadingProblem::UnknownPath { path, known },
        };
        self.refuse_at(name, problem)
    }

    /// The index of a segment that is counted from 1, where one is named.
    pub(super) fn segment(
        &self,
        typed: Option<&At<u64>>,
        path: &PathToFollow,
    ) -> Result<Option<usize>, LabError> {
        let Some(typed) = typed else {
            return Ok(None);
        };
        let count = path.points_m.len() - 1;
        let found = usize::try_from(*typed.get_ref()).ok();
        if let Some(segment) = found.filter(|segment| (1..=count).contains(segment)) {
            return Ok(Some(segment - 1));
        }
        let problem = ReadingProblem::NoSegment {
            path: path.name.clone(),
            count,
            segment: *typed.get_ref(),
        };
        self.refuse_at(typed, problem)
    }

    /// The number that the sensor called `name` reads, or a part of what it reads.
    pub(super) fn channel(
        &self,
        name: &Spanned<String>,
        part: Option<&At<String>>,
    ) -> Result<Channel, LabError> {
        let sensors = &self.motion.sensors;
        let sensor = name.get_ref().clone();
        let Some(index) = sensors.iter().position(|known| known.name == sensor) else {
            let known: Vec<String> = sensors.iter().map(|known| known.name.clone()).collect();
            let problem = match known.is_empty() {
                true => ReadingProblem::NoSensors { sensor },
                false => ReadingProblem::UnknownSensor { sensor, known },
            };
            return self.refuse_at(name, problem);
        };
        let before = sensors[..index].iter();
        let before = before.map(|known| known.kind.measured().channels());
        let first: usize = before.sum();
        let kind = &sensors[index].kind;
        let measured = kind.measured();
        let channel = |name, offset| Channel {
            name,
            index: first + offset,
            is_switch: measured == Measured::Switch,
            unit: kind.unit(self.robot, offset),
        };
        let Some(typed) = part else {
            return Ok(channel(sensor, 0));
        };
        let known: &[&str] = match measured {
            Measured::Parts(names) => names,
            Measured::Switch | Measured::Number => &[],
        };
        let part = typed.get_ref().clone();
        if let Some(offset) = known.iter().position(|known| *known == part) {
            return Ok(channel(format!("{sensor}.{part}"), offset));
        }
        let known = known.iter().map(|part| (*part).to_owned()).collect();
        let problem = ReadingProblem::UnknownPart {
            sensor,
            part,
            known,
        };
        self.refuse_at(typed, problem)
    }

    /// The first and the last tick of a part of the run, of the whole run where nothing is typed; `turned` is the problem of a part that
    /// ends before it begins, at these times \[s\].
    pub(super) fn part_of_run(
        &self,
        from_s: Option<&At<f64>>,
        to_s: Option<&At<f64>>,
        turned: impl FnOnce(f64, f64) -> Box<dyn Problem>,
    ) -> Result<[usize; 2], LabError> {
        let first = match from_s {
            None => 0,
            // a part may begin at the start
            Some(typed) if typed.get_ref().abs() <= 0.0 => 0,
            Some(typed) => self.ticks(typed, "`from_s`")?,
        };
        let last = match to_s {
            None => self.motion.ticks,
            Some(typed) => self.ticks(typed, "`to_s`")?,
        };
        if last < first {
            let [from_s, to_s] = [first, last].map(|tick| self.motion.periods.time_s(tick));
            return Err(LabError::new(
                turned(from_s, to_s),
                self.report.source,
                self.at.clone(),
            ));
        }
        Ok([first as usize, last as usize])
    }

    /// A time within the run, in ticks; `what` names it in the message.
    pub(super) fn ticks(&self, time: &At<f64>, what: &str) -> Result<u64, LabError> {
        let time_s = self.report.positive(time, what)?;
        let step_s = self.motion.periods.step_s;
        let refuse = |problem| self.refuse_at(time, problem);
        match whole_ratio(time_s, step_s) {
            None => refuse(ReadingProblem::NotWholeSteps { time_s, step_s }),
            Some(ticks) if ticks > self.motion.ticks => {
                refuse(ReadingProblem::LongerThanRun { time_s })
            }
            Some(ticks) => Ok(ticks),
        }
    }
}
