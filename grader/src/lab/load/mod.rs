//! From the texts of a lab to a [`Lab`]: names become indices, bands are ordered, periods divide; what cannot hold is an error
//! with its place.

mod cases;
mod checks;
mod free_function;
mod functions;
mod grants;
mod laws;
mod motion;
mod parts;
mod paths;
mod reading;
mod surroundings;
mod target;

use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::format::joint_string::looks_like_one;
use kinemark_sim::format::{ReadOptions, RobotDescription};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::unphysical::OnUnphysical;
use kinemark_sim::text::{Mistakes, Spanned, suggest};

use super::file::{BudgetTable, LabTable, NumberAt, TaskTable};
use super::hints::with_questions_alone;
use super::model::{Lab, OwnRobot, Task, TaskWork};
use super::parameters::{self, NumbersTable};
use super::practice::Practice;
use super::variant::Variant;
use super::variant_rule::rules;
use crate::submission::controller::Budgets;
use crate::task::files::{Files, read_source};
use crate::task::mesh_file::MeshFile;
use crate::task::model::FunctionTask;
use crate::task::problem::{LabError, LoadError, near, problems};
use crate::task::reporter::Reporter;
use crate::task::robot::{LabRobot, RobotOptions, robot_names, robot_path};
use crate::task::scene::{LabScene, scene_names};

pub(super) use reading::refuse_unreadable;
pub(crate) use reading::tables;

problems! {
    /// What is wrong with a lab file as a whole, whatever its tasks are.
    enum LabFileProblem {
        NotOfFolder { name: String, folder: String }:
            "lab::name", "the lab in folder `{folder}` calls itself `{name}`", "differs from its folder",
            format!("write `name = \"{folder}\"`, or rename the folder");
        NoRow { name: String, why: String, known: Vec<String> }:
            "lab::unknown_robot", "robot `{name}` is neither a file in robots/ nor a row of joints: {why}", "this robot",
            near(name, "robots", known);
        UnknownRobot { path: String, name: String, known: Vec<String> }:
            "lab::unknown_robot", "no robot file `{path}`", "no such robot",
            match name.strip_suffix(".toml") {
                Some(name) if known.iter().any(|known| known == name) => format!("leave out `.toml`: write `robot = \"{name}\"`"),
                _ => near(name, "robots", known),
            };
        UnknownFrame { robot: String, frame: String, known: Vec<String> }:
            "lab::unknown_frame", "robot `{robot}` has no frame `{frame}`", "not a frame of this robot",
            near(frame, "frames", known);
        RobotOptions { robot: String }:
            "lab::robot_options", "[robot_options] is for URDFs, but `{robot}` is a robot file", "of no effect",
            "leave it out: a robot file says itself which joints follow others, and which inertias are taken as they are";
        Treatments:
            "lab::robot_options", "`accept_unphysical` and `balance` exclude each other", "both in here",
            "leave one of them out: tensors are taken as they are, or balanced";
        MissingMesh { robot: String, mesh: String, warning: String }:
            "lab::robot_mesh", "robot `{robot}` names the mesh `{mesh}`, which is not among the files of the labs", "this robot",
            format!("{warning}; put it there, or name its package's folder: packages = {{ NAME = \"FOLDER\" }} below [robot_options]");
        Unphysical { why: String }:
            "lab::unphysical", "{why}", "needs inertias that a body can have";
        Dimension { name: String, error: String, known: Vec<String> }:
            "lab::dimensions", "{error}", "this dimension", near(name, "dimensions", known);
        Dimensions { error: String }:
            "lab::dimensions", "with these dimensions: {error}", "here they begin";
        UnknownScene { name: String, known: Vec<String> }:
            "lab::unknown_scene", "no scene file `scenes/{name}.toml`", "no such scene",
            near(name, "scenes", known);
        SceneDimension { name: String, error: String, known: Vec<String> }:
            "lab::dimensions", "{error}", if name.is_empty() { "this scene" } else { "not a dimension of this scene" },
            near(name, "dimensions", known);
        Namesake { body: String, robot: String }:
            "lab::scene_names", "`{body}` is a body of this scene and a link or frame of robot `{robot}`", "two things of one name",
            "give the body of the scene another name";
        Kept { share: f64 }:
            "lab::out_of_range", "a share is 0 to 1, got {share}", "out of range",
            format!("left out it is {KEPT_AFTER_STOP}; 0 takes all points of a run in which the submission fails");
        Budget { highest: u64, value: u64 }:
            "lab::budget", "a budget is 1 to {highest} operations, got {value}", "out of range";
        NoTasks:
            "lab::no_tasks", "a lab needs at least one task", "no [[tasks]]", "add a [[tasks]] table";
        TaskKind { task: String }:
            "lab::task_kind", "task `{task}` must have either `function` or `motion`", "this task",
            "add one table: [tasks.function] or [tasks.motion]";
        TwoMeanings { function: String, first: String, second: String }:
            "lab::call", "tasks `{first}` and `{second}` ask different things of `{function}`, which cannot know for which it is called",
            "the second of them", "give it a name of its own here: as = \"...\"";
        NoChecks { task: String }:
            "lab::no_checks", "task `{task}` has no checks, so nothing in it earns a point", "this task",
            "add a [[tasks.checks]] table";
        JointCount { what: &'static str, count: String, expected: usize, robot: String, joints: Vec<String> }:
            "lab::joint_count", "`{what}` has {count} for {expected} joints", "one number per joint that moves",
            format!("joints of `{robot}`: {}", joints.join(", "));
    }
}

/// Names of the labs in `files`: folders that hold a `lab.toml`.
pub fn lab_names(files: &dyn Files) -> Vec<String> {
    let mut names = files.list("");
    names.retain(|name| {
        matches!(
            files.read(&format!("{name}/lab.toml")),
            Ok(Some(_)) | Err(_)
        )
    });
    names
}

impl Lab {
    /// Loads the lab called `name`, with its robot.
    ///
    /// # Errors
    /// [`LoadError`] if there is no such lab, or something in its files is wrong.
    pub fn load(files: &dyn Files, name: &str) -> Result<Self, LoadError> {
        Self::load_variant(files, name, None)
    }

    /// Loads the lab called `name` with the numbers of `variant`: a lab like any other.
    ///
    /// # Errors
    /// Those of [`Lab::load`], and a variant that is none of this lab.
    pub fn load_variant(
        files: &dyn Files,
        name: &str,
        variant: Option<&Variant>,
    ) -> Result<Self, LoadError> {
        let Some(source) = read_source(files, &format!("{name}/lab.toml"))? else {
            let known = lab_names(files);
            return Err(LoadError::UnknownLab {
                name: name.to_owned(),
                help: format!(
                    "{} (in {})",
                    suggest(name, "labs", known.iter().map(String::as_str)),
                    files.name()
                ),
            });
        };
        let stated = parameters::stated(&source)?;
        let mut parameters = stated.clone();
        if let Some(variant) = variant {
            variant.fits(name, &stated)?;
            for (name, value) in variant.parameters() {
                parameters.set(name.to_owned(), value.clone());
            }
        }
        let lab: LabTable = parameters::tables_with(&source, &parameters)
            .map_err(|error| parts::all_refused(&source, &parameters, error))?;
        let report = Reporter { source: &source };
        is_of_folder(report, &lab, name)?;
        let LabRobot { file, meshes, .. } = lab_robot(files, report, &lab)?;
        let robot_file = of_dimensions(report, file, &lab.dimensions)?;
        let robot = robot_file.build(&[])?;
        let frame = frame(report, &lab, &robot)?;
        let own = own_robots(files, report, &lab, (&robot_file, &meshes, &frame))?;
        let practice = Practice::load(files, name, (&stated, &parameters))?;
        let scenes = scenes(files, report, &robot, (&lab, &own))?;
        let reader = Reader {
            report,
            robot: &robot,
            robot_at: lab.robot.span(),
            scenes: &scenes,
            robot_file: &robot_file,
            frame: &frame,
        };
        // none of these depends on another
        let mut mistakes = Mistakes::default();
        let tasks = mistakes.keep(reader.tasks(&lab, &own)).unwrap_or_default();
        let budgets = mistakes.keep(reader.budgets(&lab.budgets));
        let budgets = budgets.unwrap_or_default();
        let kept = kept_after_stop(report, lab.kept_after_stop.as_ref());
        let kept_after_stop = mistakes.keep(kept).unwrap_or(KEPT_AFTER_STOP);
        let variants = rules(report, &lab.variants, &stated);
        let variants = mistakes.keep(variants).unwrap_or_default();
        mistakes.finish()?;
        let mut loaded = Self {
            name: name.to_owned(),
            graded_text: with_questions_alone(&source, &lab),
            title: lab.title,
            summary: lab.summary,
            parameters,
            variants,
            variant: variant.cloned(),
            budgets,
            kept_after_stop,
            tasks,
            source,
            robot_file,
            robot_meshes: meshes,
            robot,
            scenes,
            frame,
            practice,
        };
        loaded.give_own_robots(own);
        Ok(loaded)
    }
}

/// The share of its points that a run keeps in which the submission failed, where the lab does not say.
const KEPT_AFTER_STOP: f64 = 0.8;

/// That share.
fn kept_after_stop(report: Reporter<'_>, typed: Option<&NumberAt>) -> Result<f64, LabError> {
    let Some(typed) = typed else {
        return Ok(KEPT_AFTER_STOP);
    };
    let share = *typed.get_ref();
    if (0.0..=1.0).contains(&share) {
        return Ok(share);
    }
    report.refuse_at(typed, LabFileProblem::Kept { share })
}

/// Refuses a lab that is not called like its folder.
fn is_of_folder(report: Reporter<'_>, lab: &LabTable, folder: &str) -> Result<(), LabError> {
    let name = lab.name.get_ref();
    if name == folder {
        return Ok(());
    }
    let (name, folder) = (name.clone(), folder.to_owned());
    report.refuse_at(&lab.name, LabFileProblem::NotOfFolder { name, folder })
}

/// The robot that the lab names.
fn lab_robot(
    files: &dyn Files,
    report: Reporter<'_>,
    lab: &LabTable,
) -> Result<LabRobot, LoadError> {
    let name = lab.robot.get_ref();
    let options = robot_options(report, lab)?;
    let robot = robot_called(files, report, &lab.robot, &options)?;
    if let (Some(table), false) = (&lab.robot_options, robot.is_of_ros) {
        let robot = name.clone();
        return Ok(report.refuse_at(table, LabFileProblem::RobotOptions { robot })?);
    }
    Ok(robot)
}

/// The robot of this name, with all its meshes.
fn robot_called(
    files: &dyn Files,
    report: Reporter<'_>,
    typed: &Spanned<String>,
    options: &RobotOptions,
) -> Result<LabRobot, LoadError> {
    let name = typed.get_ref();
    let named = LabRobot::named(files, name, options);
    if let Err(why) = &named
        && looks_like_one(name)
        && !robot_names(files).contains(name)
    {
        let problem = LabFileProblem::NoRow {
            name: name.clone(),
            why: why.to_string(),
            known: robot_names(files),
        };
        return Ok(report.refuse_at(typed, problem)?);
    }
    let Some(robot) = named? else {
        let problem = LabFileProblem::UnknownRobot {
            path: robot_path(name),
            name: name.clone(),
            known: robot_names(files),
        };
        return Ok(report.refuse_at(typed, problem)?);
    };
    if let Some(mesh) = &robot.missing_mesh {
        let built = robot.file.build(&[])?;
        let mut warnings = built.warnings().iter();
        let warning = warnings.find(|warning| warning.contains(mesh.as_str()));
        let problem = LabFileProblem::MissingMesh {
            robot: name.clone(),
            mesh: mesh.clone(),
            warning: warning.cloned().unwrap_or_default(),
        };
        return Ok(report.refuse_at(typed, problem)?);
    }
    Ok(robot)
}

/// The robots of tasks that differ from the lab's, which has these meshes and this frame, by their name or their dimensions; one entry
/// for each task. Students work in the frame of the lab's name, where such a robot has one, else in its first link.
fn own_robots(
    files: &dyn Files,
    report: Reporter<'_>,
    lab: &LabTable,
    (of_lab, meshes_of_lab, frame): (&RobotDescription, &[MeshFile], &str),
) -> Result<Vec<Option<OwnRobot>>, LoadError> {
    let mut own = Vec::new();
    for task in &lab.tasks {
        if task.robot.is_none() && task.dimensions.is_empty() {
            own.push(None);
            continue;
        }
        let (file, meshes) = match &task.robot {
            Some(typed) => {
                let named = robot_called(files, report, typed, &RobotOptions::default())?;
                (named.file, named.meshes)
            }
            None => (of_lab.clone(), meshes_of_lab.to_vec()),
        };
        let file = of_dimensions(report, file, &task.dimensions)?;
        let robot = file.build(&[])?;
        let frame = match robot.frame(frame) {
            Some(_) => frame.to_owned(),
            None => robot.links()[0].name.clone(),
        };
        own.push(Some(OwnRobot {
            file,
            meshes,
            robot,
            frame,
        }));
    }
    Ok(own)
}

/// How the lab reads its robot, if that is a URDF.
fn robot_options(report: Reporter<'_>, lab: &LabTable) -> Result<RobotOptions, LabError> {
    let Some(typed) = &lab.robot_options else {
        return Ok(RobotOptions::default());
    };
    let table = typed.get_ref();
    let on_unphysical = match (table.accept_unphysical, table.balance) {
        (false, false) => OnUnphysical::Refuse,
        (true, false) => OnUnphysical::Accept,
        (false, true) => OnUnphysical::Balance,
        (true, true) => return report.refuse_at(typed, LabFileProblem::Treatments),
    };
    Ok(RobotOptions {
        read: ReadOptions {
            ignore_mimic: table.ignore_mimic,
            on_unphysical,
        },
        packages: table.packages.clone(),
    })
}

/// The frame in which students work: the one that the lab names, or the first link.
fn frame(report: Reporter<'_>, lab: &LabTable, robot: &Robot) -> Result<String, LabError> {
    let Some(typed) = &lab.frame else {
        return Ok(robot.links()[0].name.clone());
    };
    let name = typed.get_ref();
    if robot.frame(name).is_some() {
        return Ok(name.clone());
    }
    let known = robot.frames().iter().map(|frame| frame.name.clone());
    let problem = LabFileProblem::UnknownFrame {
        robot: robot.name().to_owned(),
        frame: name.clone(),
        known: known.collect(),
    };
    report.refuse_at(typed, problem)
}

/// The robot file with the dimensions that the lab or a task changes.
fn of_dimensions(
    report: Reporter<'_>,
    robot_file: RobotDescription,
    typed: &NumbersTable,
) -> Result<RobotDescription, LabError> {
    let mut robot_file = robot_file;
    for (name, value) in typed {
        let changed = [(name.get_ref().clone(), value.get_ref().clone())];
        let known = robot_file.dimensions().names().map(str::to_owned).collect();
        // one by one, so that the place is that of the one that is wrong
        robot_file = match robot_file.with_dimensions(&changed) {
            Ok(changed) => changed,
            Err(error) => {
                let problem = LabFileProblem::Dimension {
                    name: name.get_ref().clone(),
                    error: error.to_string(),
                    known,
                };
                return report.refuse_at(name, problem);
            }
        };
    }
    if let (Some(name), Err(error)) = (typed.keys().next(), robot_file.build(&[])) {
        let error = error.to_string();
        return report.refuse_at(name, LabFileProblem::Dimensions { error });
    }
    Ok(robot_file)
}

/// Loads the scenes that motion tasks name, each once.
fn scenes(
    files: &dyn Files,
    report: Reporter<'_>,
    robot: &Robot,
    (lab, own): (&LabTable, &[Option<OwnRobot>]),
) -> Result<Vec<Arc<LabScene>>, LoadError> {
    let mut scenes: Vec<Arc<LabScene>> = Vec::new();
    for (task, own) in lab.tasks.iter().zip(own) {
        let motion = task.motion.as_ref();
        let Some(at) = motion.and_then(|motion| motion.get_ref().scene.as_ref()) else {
            continue;
        };
        let robot = own.as_ref().map_or(robot, |own| &own.robot);
        let table = at.get_ref();
        let name = table.name.as_str();
        let dimensions: Vec<_> = table.dimensions.clone().into_iter().collect();
        if scenes.iter().any(|scene| scene.is(name, &dimensions)) {
            continue;
        }
        let Some(scene) = LabScene::load(files, name)? else {
            let at = table.name_at.clone().unwrap_or(at.span());
            let (name, known) = (name.to_owned(), scene_names(files));
            return Ok(report.refuse(at, LabFileProblem::UnknownScene { name, known })?);
        };
        let known: Vec<String> = scene.file.dimensions().names().map(str::to_owned).collect();
        let scene = match scene.with_dimensions(dimensions) {
            Ok(scene) => scene,
            Err(error) => {
                let is_known = |name: &String| known.contains(name);
                let typed = table.dimensions_at.iter().find(|(name, _)| !is_known(name));
                let (typed, place) = typed.map_or(("", at.span()), |(name, at)| (name, at.clone()));
                let problem = LabFileProblem::SceneDimension {
                    name: typed.to_owned(),
                    error: error.to_string(),
                    known,
                };
                return Ok(report.refuse(place, problem)?);
            }
        };
        if let Some(body) = scene.namesake(robot) {
            let (body, robot) = (body.to_owned(), robot.name().to_owned());
            return Ok(report.refuse_at(at, LabFileProblem::Namesake { body, robot })?);
        }
        scenes.push(Arc::new(scene));
    }
    Ok(scenes)
}

/// So many numbers, in words.
fn numbers(count: usize) -> String {
    match count {
        1 => "1 number".to_owned(),
        _ => format!("{count} numbers"),
    }
}

struct Reader<'a> {
    report: Reporter<'a>,
    robot: &'a Robot,
    /// Where the lab names its robot.
    robot_at: Range<usize>,
    scenes: &'a [Arc<LabScene>],
    robot_file: &'a RobotDescription,
    /// Name of the frame in which students work.
    frame: &'a str,
}

impl Reader<'_> {
    fn budgets(&self, table: &BudgetTable) -> Result<Budgets, LabError> {
        let mut budgets = Budgets::default();
        // above these, one call could keep a class waiting
        let (operations, instructions) = (1_000_000_000, 40_000_000_000);
        for (typed, slot, highest) in [
            (
                &table.operations_per_call,
                &mut budgets.operations_per_call,
                operations,
            ),
            (
                &table.operations_per_task,
                &mut budgets.operations_per_task,
                operations,
            ),
            (
                &table.instructions_per_call,
                &mut budgets.instructions_per_call,
                instructions,
            ),
            (
                &table.instructions_per_task,
                &mut budgets.instructions_per_task,
                instructions,
            ),
        ] {
            if let Some(value) = typed {
                let typed = value;
                let value = *typed.get_ref();
                if !(1..=highest).contains(&value) {
                    let problem = LabFileProblem::Budget { highest, value };
                    return self.report.refuse_at(typed, problem);
                }
                *slot = value;
            }
        }
        Ok(budgets)
    }

    fn tasks(&self, lab: &LabTable, own: &[Option<OwnRobot>]) -> Result<Vec<Task>, LabError> {
        if lab.tasks.is_empty() {
            return self.report.refuse_at(&lab.name, LabFileProblem::NoTasks);
        }
        self.report
            .unique("task", lab.tasks.iter().map(|task| &task.name))?;
        let mut mistakes = Mistakes::default();
        let tasks = lab.tasks.iter().zip(own);
        let tasks = tasks.filter_map(|(task, own)| {
            mistakes.keep(match own {
                None => self.task(task),
                Some(own) => self.of_robot(own, task).task(task),
            })
        });
        let tasks: Vec<Task> = tasks.collect();
        mistakes.finish()?;
        self.functions_differ(lab, &tasks)?;
        Ok(tasks)
    }

    /// The reader of a task with a robot of its own.
    fn of_robot<'r>(&'r self, own: &'r OwnRobot, task: &TaskTable) -> Reader<'r> {
        let typed = task.robot.as_ref();
        Reader {
            report: self.report,
            robot: &own.robot,
            robot_at: typed.map_or(self.robot_at.clone(), Spanned::span),
            scenes: self.scenes,
            robot_file: &own.file,
            frame: &own.frame,
        }
    }

    /// A function of a submission cannot know for which of two tasks it is called: what tasks ask of one name is the same.
    fn functions_differ(&self, lab: &LabTable, tasks: &[Task]) -> Result<(), LabError> {
        let mut known: Vec<(&Task, &FunctionTask)> = Vec::new();
        for (task, table) in tasks.iter().zip(&lab.tasks) {
            let (TaskWork::Function(work, _), Some(typed)) = (&task.work, &table.function) else {
                continue;
            };
            let same_name = known.iter().find(|(_, other)| other.name() == work.name());
            let is_other = |other: &FunctionTask| {
                other.function != work.function
                    || other.about.frame != work.about.frame
                    || other.about.ignored != work.about.ignored
            };
            if let Some((other, _)) = same_name.filter(|(_, other)| is_other(other)) {
                let problem = LabFileProblem::TwoMeanings {
                    function: work.name().to_owned(),
                    first: other.name.clone(),
                    second: task.name.clone(),
                };
                return self.report.refuse_at(&typed.call, problem);
            }
            known.push((task, work));
        }
        Ok(())
    }

    fn task(&self, table: &TaskTable) -> Result<Task, LabError> {
        let name = table.name.get_ref();
        let work = match (&table.function, &table.motion) {
            (Some(function), None) => {
                let function = self.function(function)?;
                self.has_checks(table)?;
                let checks = self.function_checks(&table.checks, &function)?;
                TaskWork::Function(Box::new(function), checks)
            }
            (None, Some(motion)) => {
                self.has_inertias(motion)?;
                let motion = self.motion(motion)?;
                self.has_checks(table)?;
                let checks = self.motion_checks(&table.checks, &motion)?;
                TaskWork::Motion(Box::new(motion), checks)
            }
            _ => {
                let task = name.clone();
                let problem = LabFileProblem::TaskKind { task };
                return self.report.refuse_at(&table.name, problem);
            }
        };
        Ok(Task {
            name: name.clone(),
            title: table.title.clone(),
            work,
            own: None,
        })
    }

    /// Whoever moves a robot, or asks for its gravity or its mass matrix, needs inertias that a body can have.
    pub(in crate::lab::load) fn has_inertias<T>(
        &self,
        needed_by: &Spanned<T>,
    ) -> Result<(), LabError> {
        match self.robot.check_inertias() {
            Ok(()) => Ok(()),
            Err(found) => {
                let why = found.to_string();
                self.report
                    .refuse_at(needed_by, LabFileProblem::Unphysical { why })
            }
        }
    }

    /// A task has checks, each with a name of its own.
    fn has_checks(&self, table: &TaskTable) -> Result<(), LabError> {
        if table.checks.is_empty() {
            let task = table.name.get_ref().clone();
            let problem = LabFileProblem::NoChecks { task };
            return self.report.refuse_at(&table.name, problem);
        }
        self.report.unique(
            "check",
            table.checks.iter().map(|check| &check.get_ref().name),
        )
    }

    fn positive(&self, number: &NumberAt, what: &str) -> Result<f64, LabError> {
        self.report.positive(number, what)
    }

    fn counted<T>(&self, list: &Spanned<Vec<T>>, what: &'static str) -> Result<(), LabError> {
        let (expected, found) = (self.robot.n(), list.get_ref().len());
        if expected == found {
            return Ok(());
        }
        let joints = self.robot.moving_joints().map(|joint| joint.name.clone());
        let problem = LabFileProblem::JointCount {
            what,
            count: numbers(found),
            expected,
            robot: self.robot.name().to_owned(),
            joints: joints.collect(),
        };
        self.report.refuse_at(list, problem)
    }
}
