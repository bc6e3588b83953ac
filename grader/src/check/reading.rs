//! What a kind of check has at hand while its table is read: the robot, the task, the checks before it; names become indices.

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::text::{Problem, suggest};
use kinemark_sim::ticks::whole_ratio;
use toml::Spanned;

use super::contract::{Check, MotionCheck};
use crate::task::model::{FunctionTask, MotionTask};
use crate::task::problem::LabError;
use crate::task::reporter::Reporter;
use crate::task::scene::LabScene;
use crate::task::watched::PathToFollow;

/// A number as typed, whole or not, with its place.
pub(super) type NumberAt = Spanned<f64>;

/// What checks of a motion task are read with.
pub(crate) struct MotionReading<'a> {
    /// Where problems are reported.
    pub(crate) report: Reporter<'a>,
    /// The robot of the lab.
    pub(crate) robot: &'a Robot,
    /// The name of the task.
    pub(crate) task: &'a str,
    /// The task.
    pub(crate) motion: &'a MotionTask,
    /// Whether the lab has the reference's path in this task.
    pub(crate) has_reference_path: bool,
}

/// What checks of a function task are read with.
pub(crate) struct FunctionReading<'a> {
    /// Where problems are reported.
    pub(crate) report: Reporter<'a>,
    /// The task.
    pub(crate) function: &'a FunctionTask,
}

/// A motion check as it is read: what it can name.
pub(crate) struct InTask<'a> {
    /// The task around it.
    pub(crate) reading: &'a MotionReading<'a>,
    /// Its own name.
    pub(crate) check: &'a str,
    /// The checks before it.
    pub(crate) earlier: &'a [Check<dyn MotionCheck>],
}

impl<'a> std::ops::Deref for InTask<'a> {
    type Target = MotionReading<'a>;

    fn deref(&self) -> &Self::Target {
        self.reading
    }
}

/// A name or a time in the table of a check that does not fit the task, the robot or the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadingProblem {
    /// No joint that moves has this name.
    #[error("robot `{robot}` has no joint `{joint}` that moves")]
    UnknownJoint {
        /// The robot's name.
        robot: String,
        /// The name as typed.
        joint: String,
        /// The joints that move.
        known: Vec<String>,
    },
    /// The kind looks at bodies, and the task has none.
    #[error("a check of kind `{kind}` needs `scene` in [tasks.motion]")]
    NoScene {
        /// The kind.
        kind: &'static str,
    },
    /// No body of the scene has this name.
    #[error("scene `{scene}` has no body `{body}`")]
    UnknownBody {
        /// The scene's name.
        scene: String,
        /// The name as typed.
        body: String,
        /// The bodies of the scene.
        known: Vec<String>,
    },
    /// The body is fixed, or moves by itself.
    #[error("body `{body}` cannot fall: it is not free")]
    CannotFall {
        /// The body's name.
        body: String,
        /// The bodies that can fall.
        free: Vec<String>,
    },
    /// No path of the task has this name.
    #[error("this task has no path `{path}`")]
    UnknownPath {
        /// The name as typed.
        path: String,
        /// The paths of the task.
        known: Vec<String>,
    },
    /// The path has fewer segments.
    #[error("path `{path}` has segments 1 to {count}, got {segment}")]
    NoSegment {
        /// The path's name.
        path: String,
        /// How many segments it has.
        count: usize,
        /// The number as typed.
        segment: u64,
    },
    /// A time between two physics steps.
    #[error("{time_s} s is not a whole number of physics steps of {step_s} s")]
    NotWholeSteps {
        /// The time as typed \[s\].
        time_s: f64,
        /// The physics step \[s\].
        step_s: f64,
    },
    /// A time that the run does not have.
    #[error("{time_s} s is longer than the run")]
    LongerThanRun {
        /// The time as typed \[s\].
        time_s: f64,
    },
}

impl Problem for ReadingProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::UnknownJoint { .. } => "lab::unknown_joint",
            Self::NoScene { .. } => "lab::check_kind",
            Self::UnknownBody { .. } => "lab::unknown_body",
            Self::CannotFall { .. } => "lab::body_falls",
            Self::UnknownPath { .. } => "lab::unknown_path",
            Self::NoSegment { .. } => "lab::path",
            Self::NotWholeSteps { .. } | Self::LongerThanRun { .. } => "lab::periods",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::UnknownJoint { .. } => "not a joint of this robot",
            Self::NoScene { .. } => "there is no scene in this task",
            Self::UnknownBody { .. } => "not a body of this scene",
            Self::CannotFall { .. } => "not a free body",
            Self::UnknownPath { .. } => "not a path of [tasks.motion.paths]",
            Self::NoSegment { .. } => "not a segment of this path",
            Self::NotWholeSteps { .. } => "does not divide",
            Self::LongerThanRun { .. } => "longer than the run",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        let near = |typed: &str, what: &str, known: &[String]| {
            Some(suggest(typed, what, known.iter().map(String::as_str)))
        };
        match self {
            Self::UnknownJoint { joint, known, .. } => near(joint, "joints", known),
            Self::NoScene { .. } => {
                Some("name one, such as `scene = \"shelf-and-can\"`".to_owned())
            }
            Self::UnknownBody { body, known, .. } => near(body, "bodies", known),
            Self::CannotFall { body, free } => near(body, "free bodies", free),
            Self::UnknownPath { path, known } if known.is_empty() => Some(format!(
                "add a table: [tasks.motion.paths] with `{path} = {{ points_m = [[..], [..]], trim_m = 0.05 }}`"
            )),
            Self::UnknownPath { path, known } => near(path, "paths", known),
            Self::NoSegment { .. } => {
                Some("leave `segment` out to have the worst one counted".to_owned())
            }
            Self::NotWholeSteps { .. } | Self::LongerThanRun { .. } => None,
        }
    }
}

impl MotionReading<'_> {
    /// Index in `q` of the joint called `name`.
    pub(crate) fn joint(&self, name: &Spanned<String>) -> Result<usize, LabError> {
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
        self.report.refuse(name.span(), problem)
    }

    /// Index in `q` of the joint called `name`, where one is named.
    pub(crate) fn maybe_joint(
        &self,
        name: Option<&Spanned<String>>,
    ) -> Result<Option<usize>, LabError> {
        name.map(|name| self.joint(name)).transpose()
    }

    /// The scene of the task, which a check of `kind` at `at` needs.
    pub(crate) fn scene(
        &self,
        kind: &'static str,
        at: Range<usize>,
    ) -> Result<&Arc<LabScene>, LabError> {
        match &self.motion.scene {
            Some(scene) => Ok(scene),
            None => self.report.refuse(at, ReadingProblem::NoScene { kind }),
        }
    }

    /// Index of a body of the scene.
    pub(crate) fn body(&self, scene: &LabScene, name: &Spanned<String>) -> Result<usize, LabError> {
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
        self.report.refuse(name.span(), problem)
    }

    /// Index of a body of the scene that can fall.
    pub(crate) fn free_body(
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
        self.report.refuse(name.span(), problem)
    }

    /// The path of the task called `name`.
    pub(crate) fn path(&self, name: &Spanned<String>) -> Result<PathToFollow, LabError> {
        let paths = &self.motion.paths;
        if let Some(path) = paths.iter().find(|path| path.name == *name.get_ref()) {
            return Ok(path.clone());
        }
        let problem = ReadingProblem::UnknownPath {
            path: name.get_ref().clone(),
            known: paths.iter().map(|path| path.name.clone()).collect(),
        };
        self.report.refuse(name.span(), problem)
    }

    /// The index of a segment that is counted from 1, where one is named.
    pub(crate) fn segment(
        &self,
        typed: Option<&Spanned<u64>>,
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
        self.report.refuse(typed.span(), problem)
    }

    /// A time within the run, in ticks; `what` names it in the message.
    pub(crate) fn ticks(&self, time: &NumberAt, what: &str) -> Result<u64, LabError> {
        let time_s = self.report.positive(time, what)?;
        let step_s = self.motion.periods.step_s;
        let refuse = |problem| self.report.refuse(time.span(), problem);
        match whole_ratio(time_s, step_s) {
            None => refuse(ReadingProblem::NotWholeSteps { time_s, step_s }),
            Some(ticks) if ticks > self.motion.ticks => {
                refuse(ReadingProblem::LongerThanRun { time_s })
            }
            Some(ticks) => Ok(ticks),
        }
    }
}
