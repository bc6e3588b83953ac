//! What a lab is once its file has been read: nothing in it can be wrong any more.

use std::sync::Arc;

use kinemark_sim::format::RobotDescription;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Dimensions;
use kinemark_sim::text::Source;

use super::practice::Practice;
use super::variant::Variant;
use super::variant_rule::VariantRule;
use crate::check::{Check, Criterion, FromReference, FunctionCheck, MotionCheck};
use crate::submission::controller::Budgets;
use crate::task::mesh_file::MeshFile;
use crate::task::model::{FunctionTask, MotionTask};
use crate::task::scene::LabScene;
use crate::task::workcell::Workcell;

/// A lab: ordered tasks on one robot.
#[derive(Debug, Clone)]
pub struct Lab {
    /// Its name, which is its folder's.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What it is about, in a sentence.
    pub summary: String,
    /// The text of `lab.toml`.
    pub source: Source,
    /// That text with the questions of its hints alone: what a grade follows from, and what a report holds.
    pub graded_text: String,
    /// Its parameters, with the numbers of its variant where it is one.
    pub parameters: Dimensions,
    /// How variants are drawn; empty where everyone has the same numbers.
    pub variants: Vec<VariantRule>,
    /// The variant it is, if it is one.
    pub variant: Option<Variant>,
    /// The robot's description, which variants and cases build with other dimensions.
    pub robot_file: RobotDescription,
    /// The meshes the description names.
    pub robot_meshes: Vec<MeshFile>,
    /// The robot as its file states it, but for the dimensions that the lab changes.
    pub robot: Robot,
    /// The scenes of its motion tasks, each once, in the order the tasks name them.
    pub scenes: Vec<Arc<LabScene>>,
    /// The frame in which students work.
    pub frame: String,
    /// What submissions may use up.
    pub budgets: Budgets,
    /// The share of its points that a run keeps in which the submission failed, in `[0, 1]`.
    pub kept_after_stop: f64,
    /// What students get of the reference solution in this variant.
    pub practice: Practice,
    /// The tasks, in order.
    pub tasks: Vec<Task>,
}

impl Lab {
    /// What its tasks are done with.
    pub fn workcell(&self) -> Workcell<'_> {
        Workcell {
            robot: &self.robot,
            frame: &self.frame,
        }
    }

    /// The lab as `task` sees it: with the robot of that task, where it has one of its own.
    pub fn of_task<'l>(&'l self, task: &'l Task) -> &'l Self {
        task.own.as_deref().unwrap_or(self)
    }

    /// Gives tasks the lab with the robot that each has of its own; one entry for each task.
    pub(super) fn give_own_robots(&mut self, own: Vec<Option<OwnRobot>>) {
        let views: Vec<_> = own
            .into_iter()
            .map(|own| own.map(|own| Arc::new(self.with_robot(own))))
            .collect();
        for (task, view) in self.tasks.iter_mut().zip(views) {
            task.own = view;
        }
    }

    /// This lab with another robot and no tasks: what a task with a robot of its own sees.
    fn with_robot(&self, own: OwnRobot) -> Self {
        Self {
            robot_file: own.file,
            robot_meshes: own.meshes,
            robot: own.robot,
            frame: own.frame,
            tasks: Vec::new(),
            ..self.clone()
        }
    }
}

/// The robot of a task that has one of its own.
#[derive(Debug, Clone)]
pub(super) struct OwnRobot {
    pub(super) file: RobotDescription,
    pub(super) meshes: Vec<MeshFile>,
    pub(super) robot: Robot,
    /// The frame in which students work.
    pub(super) frame: String,
}

/// A task.
#[derive(Debug, Clone)]
pub struct Task {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What is done in it, and the checks that judge it.
    pub work: TaskWork,
    /// The lab with the robot of this task, where it has one of its own: [`Lab::of_task`].
    pub own: Option<Arc<Lab>>,
}

/// What a task asks for, with its checks in order.
#[derive(Debug, Clone)]
pub enum TaskWork {
    /// A function called on cases.
    Function(Box<FunctionTask>, Vec<Check<dyn FunctionCheck>>),
    /// A run under `control`.
    Motion(Box<MotionTask>, Vec<Check<dyn MotionCheck>>),
}

impl Task {
    /// Its checks, in order, whatever they judge.
    pub fn checks(&self) -> Vec<&Criterion> {
        match &self.work {
            TaskWork::Function(_, checks) => checks.iter().map(|check| &check.criterion).collect(),
            TaskWork::Motion(_, checks) => checks.iter().map(|check| &check.criterion).collect(),
        }
    }

    /// Whether a check compares with what the reference solution does in its own run.
    pub fn needs_reference(&self) -> bool {
        match &self.work {
            TaskWork::Function(..) => false,
            TaskWork::Motion(_, checks) => {
                let mut uses = checks.iter().map(|check| check.kind.reference_use());
                uses.any(|of_reference| of_reference != FromReference::Nothing)
            }
        }
    }

    /// Points of all its checks.
    pub fn max_points(&self) -> f64 {
        self.checks().iter().map(|check| check.points).sum()
    }
}
