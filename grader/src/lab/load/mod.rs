//! From the texts of a lab to a [`Lab`]: names become indices, bands are ordered, periods divide; what cannot hold is an error
//! with its place.

mod checks;
mod free_function;
mod functions;
mod grants;
mod ladder;
mod motion;
mod path_checks;
mod prediction;
mod reading;
mod run_checks;
mod step_checks;
mod target;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use kinemark_sim::robot::{Robot, RobotFile};
use kinemark_sim::source::suggest;
use toml::Spanned;

use super::file::{BudgetTable, LabTable, NumberAt, TaskTable};
use super::model::{Check, Lab, ReferencePaths, Task};
use super::parameters;
use super::variant::{self, Variant};
use crate::record::graded::TcpPath;
use crate::submission::controller::Budgets;
use crate::task::files::{Files, read_source};
use crate::task::model::TaskWork;
use crate::task::problem::{LabError, LoadError};
use crate::task::robot::{LabRobot, robot_names};
use crate::task::scene::{LabScene, scene_names};

pub(super) use reading::{Reporter, refuse_not_finite, tables};

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
        let lab: LabTable = parameters::tables_with(&source, &parameters)?;
        let report = Reporter { source: &source };
        report.format(&lab.format)?;
        if lab.name.get_ref() != name {
            return Ok(report.err(
                lab.name.span(),
                "lab::name",
                format!(
                    "the lab in folder `{name}` calls itself `{}`",
                    lab.name.get_ref()
                ),
                "differs from its folder",
                Some(format!("write `name = \"{name}\"`, or rename the folder")),
            )?);
        }
        let Some(LabRobot {
            file: robot_file,
            meshes: robot_meshes,
        }) = LabRobot::load(files, lab.robot.get_ref())?
        else {
            let robot_path = format!("robots/{}.toml", lab.robot.get_ref());
            let known = robot_names(files);
            return Ok(report.err(
                lab.robot.span(),
                "lab::unknown_robot",
                format!("no robot file `{robot_path}`"),
                "not a robot of this place",
                Some(suggest(
                    lab.robot.get_ref(),
                    "robots",
                    known.iter().map(String::as_str),
                )),
            )?);
        };
        let robot_file = of_dimensions(report, robot_file, &lab)?;
        let robot = robot_file.build(&[])?;
        let frame = match &lab.frame {
            None => robot.links()[0].name.clone(),
            Some(frame) if robot.frame(frame.get_ref()).is_some() => frame.get_ref().clone(),
            Some(frame) => {
                let known = robot.frames().iter().map(|frame| frame.name.as_str());
                return Ok(report.err(
                    frame.span(),
                    "lab::unknown_frame",
                    format!(
                        "robot `{}` has no frame `{}`",
                        robot.name(),
                        frame.get_ref()
                    ),
                    "not a frame of this robot",
                    Some(suggest(frame.get_ref(), "frames", known)),
                )?);
            }
        };
        let mut reference_paths = reference_paths(files, name)?;
        let scenes = scenes(files, report, &robot, &lab)?;
        let reader = Reader {
            report,
            robot: &robot,
            robot_at: lab.robot.span(),
            scenes: &scenes,
            robot_file: &robot_file,
            reference_paths: &reference_paths.paths,
        };
        let tasks = reader.tasks(&lab)?;
        let budgets = reader.budgets(&lab.budgets)?;
        let variants = variant::rules(report, &lab.variants, &stated)?;
        if let (Some(at), Some(check)) = (lab.variants.keys().next(), one_path(&tasks)) {
            return Ok(report.err(
                at.span(),
                "lab::variants",
                format!("check `{check}` compares with one path, and every variant has its own"),
                "varies the path",
                Some("judge the task by goals or a path of its own instead".to_owned()),
            )?);
        }
        if parameters != stated {
            // it is the path of the numbers in lab.toml
            reference_paths.paths.clear();
        }
        Ok(Self {
            name: name.to_owned(),
            title: lab.title,
            summary: lab.summary,
            parameters,
            variants,
            variant: variant.cloned(),
            budgets,
            tasks,
            source,
            robot_file,
            robot_meshes,
            robot,
            scenes,
            frame,
            reference_paths,
        })
    }
}

/// The robot file with the dimensions that the lab changes.
fn of_dimensions(
    report: Reporter<'_>,
    robot_file: RobotFile,
    lab: &LabTable,
) -> Result<RobotFile, LabError> {
    let mut robot_file = robot_file;
    for (name, value) in &lab.dimensions {
        let changed = [(name.get_ref().clone(), value.get_ref().clone())];
        let known = suggest(
            name.get_ref(),
            "dimensions",
            robot_file.dimensions().names(),
        );
        // one by one, so that the place is that of the one that is wrong
        robot_file = match robot_file.with_dimensions(&changed) {
            Ok(changed) => changed,
            Err(error) => {
                return report.err(
                    name.span(),
                    "lab::dimensions",
                    error.to_string(),
                    "this dimension",
                    Some(known),
                );
            }
        };
    }
    if let (Some(name), Err(error)) = (lab.dimensions.keys().next(), robot_file.build(&[])) {
        return report.err(
            name.span(),
            "lab::dimensions",
            format!("with these dimensions: {error}"),
            "here they begin",
            None,
        );
    }
    Ok(robot_file)
}

/// The first check that compares the whole run with `reference-path.json`.
fn one_path(tasks: &[Task]) -> Option<&str> {
    let mut checks = tasks.iter().flat_map(|task| &task.checks);
    let found = checks.find(|check| check.kind.follows_one_path())?;
    Some(&found.name)
}

/// Loads the scenes that motion tasks name, each once.
fn scenes(
    files: &dyn Files,
    report: Reporter<'_>,
    robot: &Robot,
    lab: &LabTable,
) -> Result<Vec<Arc<LabScene>>, LoadError> {
    let mut scenes: Vec<Arc<LabScene>> = Vec::new();
    let motions = lab.tasks.iter().filter_map(|task| task.motion.as_ref());
    for at in motions.filter_map(|motion| motion.get_ref().scene.as_ref()) {
        let table = at.get_ref();
        let name = table.name.as_str();
        let name_at = || table.name_at.clone().unwrap_or(at.span());
        let dimensions: Vec<_> = table.dimensions.clone().into_iter().collect();
        if scenes.iter().any(|scene| scene.is(name, &dimensions)) {
            continue;
        }
        let Some(scene) = LabScene::load(files, name)? else {
            let known = scene_names(files);
            return Ok(report.err(
                name_at(),
                "lab::unknown_scene",
                format!("no scene file `scenes/{name}.toml`"),
                "not a scene of this place",
                Some(suggest(name, "scenes", known.iter().map(String::as_str))),
            )?);
        };
        let known: Vec<String> = scene.file.dimensions().names().map(str::to_owned).collect();
        let scene = match scene.with_dimensions(dimensions) {
            Ok(scene) => scene,
            Err(error) => {
                let is_known = |name: &String| known.contains(name);
                let typed = table.dimensions_at.iter().find(|(name, _)| !is_known(name));
                let (typed, place) = typed.map_or(("", at.span()), |(name, at)| (name, at.clone()));
                return Ok(report.err(
                    place,
                    "lab::dimensions",
                    error.to_string(),
                    if typed.is_empty() {
                        "this scene"
                    } else {
                        "not a dimension of this scene"
                    },
                    Some(suggest(
                        typed,
                        "dimensions",
                        known.iter().map(String::as_str),
                    )),
                )?);
            }
        };
        if let Some(body) = scene.namesake(robot) {
            return Ok(report.err(
                at.span(),
                "lab::scene_names",
                format!(
                    "`{body}` is a body of this scene and a link or frame of robot `{}`",
                    robot.name()
                ),
                "two things of one name",
                Some("give the body of the scene another name".to_owned()),
            )?);
        }
        scenes.push(Arc::new(scene));
    }
    Ok(scenes)
}

/// Reads `reference-path.json`: an object of tasks, each with `period_s` and `points_m`.
fn reference_paths(files: &dyn Files, name: &str) -> Result<ReferencePaths, LoadError> {
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct PathTable {
        period_s: f64,
        points_m: Vec<[f64; 3]>,
    }
    let path = format!("{name}/reference-path.json");
    let Some(source) = read_source(files, &path)? else {
        return Ok(ReferencePaths::default());
    };
    let tables: BTreeMap<String, PathTable> = match serde_json::from_str(source.text()) {
        Ok(tables) => tables,
        Err(error) => return Ok(Reporter { source: &source }.json(&error)?),
    };
    let paths = tables.into_iter().map(|(task, table)| {
        let path = TcpPath {
            period_s: table.period_s,
            points_m: table.points_m,
        };
        (task, path)
    });
    Ok(ReferencePaths {
        paths: paths.collect(),
        text: source.text().to_owned(),
    })
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
    robot_file: &'a RobotFile,
    reference_paths: &'a [(String, TcpPath)],
}

impl Reader<'_> {
    fn budgets(&self, table: &BudgetTable) -> Result<Budgets, LabError> {
        let mut budgets = Budgets::default();
        for (typed, slot) in [
            (&table.operations_per_call, &mut budgets.operations_per_call),
            (&table.operations_per_task, &mut budgets.operations_per_task),
        ] {
            if let Some(value) = typed {
                // above this, one call could keep a class waiting
                let highest = 1_000_000_000;
                if !(1..=highest).contains(value.get_ref()) {
                    return self.report.err(
                        value.span(),
                        "lab::budget",
                        format!(
                            "a budget is 1 to {highest} operations, got {}",
                            value.get_ref()
                        ),
                        "out of range",
                        None,
                    );
                }
                *slot = *value.get_ref();
            }
        }
        Ok(budgets)
    }

    fn tasks(&self, lab: &LabTable) -> Result<Vec<Task>, LabError> {
        if lab.tasks.is_empty() {
            return self.report.err(
                lab.name.span(),
                "lab::no_tasks",
                "a lab needs at least one task".to_owned(),
                "no [[tasks]]",
                Some("add a [[tasks]] table".to_owned()),
            );
        }
        self.unique("task", lab.tasks.iter().map(|task| &task.name))?;
        lab.tasks.iter().map(|task| self.task(task)).collect()
    }

    /// Names are used in file names and links: letters, digits, `-`.
    fn unique<'n>(
        &self,
        what: &str,
        names: impl Iterator<Item = &'n Spanned<String>>,
    ) -> Result<(), LabError> {
        let mut seen: Vec<&str> = Vec::new();
        for at in names {
            let name = at.get_ref().as_str();
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            if name.is_empty() || !name.chars().all(plain) {
                return self.report.err(
                    at.span(),
                    "lab::bad_name",
                    format!("{what} name {name:?} cannot be used"),
                    "this name",
                    Some("use lower-case letters, digits and `-`".to_owned()),
                );
            }
            if seen.contains(&name) {
                return self.report.err(
                    at.span(),
                    "lab::duplicate",
                    format!("{what} `{name}` is there twice"),
                    "the second one",
                    Some("give each its own name".to_owned()),
                );
            }
            seen.push(name);
        }
        Ok(())
    }

    fn task(&self, table: &TaskTable) -> Result<Task, LabError> {
        let name = table.name.get_ref();
        let work = match (&table.function, &table.motion) {
            (Some(function), None) => TaskWork::Function(self.function(function)?),
            (None, Some(motion)) => TaskWork::Motion(Box::new(self.motion(motion)?)),
            _ => {
                return self.report.err(
                    table.name.span(),
                    "lab::task_kind",
                    format!("task `{name}` must have either `function` or `motion`"),
                    "this task",
                    Some("add one table: [tasks.function] or [tasks.motion]".to_owned()),
                );
            }
        };
        if table.checks.is_empty() {
            return self.report.err(
                table.name.span(),
                "lab::no_checks",
                format!("task `{name}` has no checks, so nothing in it earns a point"),
                "this task",
                Some("add a [[tasks.checks]] table".to_owned()),
            );
        }
        self.unique(
            "check",
            table.checks.iter().map(|check| &check.get_ref().name),
        )?;
        let mut checks: Vec<Check> = Vec::new();
        for check in &table.checks {
            let check = self.check(check, &checks, &work, name)?;
            checks.push(check);
        }
        Ok(Task {
            name: name.clone(),
            title: table.title.clone(),
            work,
            checks,
        })
    }

    fn positive(&self, number: &NumberAt, what: &str) -> Result<f64, LabError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        self.report.err(
            number.span(),
            "lab::out_of_range",
            format!("{what} must be positive and finite, got {value}"),
            "out of range",
            None,
        )
    }

    fn counted<T>(&self, list: &Spanned<Vec<T>>, what: &str) -> Result<(), LabError> {
        let (expected, found) = (self.robot.n(), list.get_ref().len());
        if expected == found {
            return Ok(());
        }
        let joints: Vec<&str> = self
            .robot
            .moving_joints()
            .map(|joint| joint.name.as_str())
            .collect();
        self.report.err(
            list.span(),
            "lab::joint_count",
            format!("`{what}` has {} for {expected} joints", numbers(found)),
            "one number per joint that moves",
            Some(format!(
                "joints of `{}`: {}",
                self.robot.name(),
                joints.join(", ")
            )),
        )
    }
}
