//! Which scenes are checked: one by itself, one with a robot, or every scene of a lab with the lab's robot, starts and goals.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::{Lab, TaskWork};
use kinemark_grader::task::scene::scene_names;
use kinemark_sim::kinematics::closure::{closed_positions, loop_gap_m};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::metres;
use kinemark_sim::text::suggest;
use kinemark_toolbox::scene_check::{ArmInScene, SceneToCheck};

use crate::commands::scene_check::Args;
use crate::disk::Folder;
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::robot_source::{self, RobotArgs};
use crate::typed_numbers::{numbers, points};
use crate::{labs_folder, scene_source};

/// People round the positions they type: loops may be open by this much \[m\].
const MOST_GAP_M: f64 = 1e-3;

/// The scenes that a person named.
pub(crate) struct ScenesToCheck {
    /// The name of the lab, if it is one.
    pub(crate) lab: Option<String>,
    pub(crate) scenes: Vec<SceneToCheck>,
}

/// Loads what was named.
///
/// # Errors
/// Exit code 2 for what was typed, 3 for a file that is not what it should be.
pub(crate) fn scenes_to_check(args: &Args) -> Result<ScenesToCheck, Failure> {
    if let Some(lab) = lab(args)? {
        if args.robot.is_some() || args.urdf.given().is_some() {
            return Err(Failure::usage(
                format!("`{}` is a lab, which has its own robot", lab.name),
                "leave out --robot and its options, or name one of the lab's scenes instead",
            ));
        }
        return of_lab(lab);
    }
    let loaded = scene_source::load(&args.scene, &args.labs_folder)?;
    let arm = arm(args)?;
    Ok(ScenesToCheck {
        lab: None,
        scenes: vec![SceneToCheck {
            task: None,
            file: loaded.file,
            scene: loaded.scene,
            arm,
        }],
    })
}

/// The lab that was named, if it was one.
fn lab(args: &Args) -> Result<Option<Lab>, Failure> {
    let named = &args.scene;
    if scene_source::is_file(named) {
        let folder = if named.file_name().is_some_and(|name| name == "lab.toml") {
            named.parent().unwrap_or(Path::new("")).to_owned()
        } else {
            named.clone()
        };
        if !folder.join("lab.toml").is_file() {
            return Ok(None);
        }
        let (labs, name) = labs_folder_of(&folder);
        return Ok(Some(Lab::load(&Folder::new(labs), &name)?));
    }
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    let (scenes, labs) = (scene_names(files.as_ref()), lab_names(files.as_ref()));
    let name = named.to_string_lossy();
    if scenes.iter().any(|scene| *scene == name) {
        return Ok(None);
    }
    if labs.iter().any(|lab| *lab == name) {
        return Ok(Some(Lab::load(files.as_ref(), &name)?));
    }
    let known = scenes.iter().chain(&labs).map(String::as_str);
    Err(Failure::usage(
        format!("there is no scene file, scene or lab `{name}`"),
        &suggest(&name, "scenes and labs", known),
    )
    .coded(ErrorCode::UnknownName))
}

/// The folder of labs that `folder` lies in, and its name there.
fn labs_folder_of(folder: &Path) -> (PathBuf, String) {
    let plain = |folder: &Path| {
        let name = folder.file_name()?.to_string_lossy().into_owned();
        let labs = match folder.parent() {
            Some(labs) if !labs.as_os_str().is_empty() => labs.to_owned(),
            _ => PathBuf::from("."),
        };
        Some((labs, name))
    };
    // `.` and `..` have no name of their own
    let found = plain(folder).or_else(|| {
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
        plain(&folder.canonicalize().ok()?)
    });
    found.unwrap_or_else(|| (PathBuf::from("."), folder.display().to_string()))
}

fn of_lab(lab: Lab) -> Result<ScenesToCheck, Failure> {
    let mut scenes = Vec::new();
    for task in &lab.tasks {
        let TaskWork::Motion(motion, _) = &task.work else {
            continue;
        };
        let Some(scene) = &motion.scene else {
            continue;
        };
        let lab = lab.of_task(task);
        let mut arm = ArmInScene::new(lab.robot.clone(), motion.start_q.clone(), &lab.frame);
        if let Some(arm) = &mut arm {
            arm.via = motion
                .goals
                .iter()
                .map(|goal| goal.position_m.into())
                .collect();
            arm.via_name = "goal";
            // a lab says where to stand, not which way to go
            arm.in_straight_lines = false;
        }
        scenes.push(SceneToCheck {
            task: Some(task.name.clone()),
            file: scene.file.clone(),
            scene: scene.scene.clone(),
            arm,
        });
    }
    if scenes.is_empty() {
        return Err(Failure::usage(
            format!("no motion task of lab `{}` has a scene", lab.name),
            "name a scene, or give a motion task of the lab `scene = \"NAME\"`",
        ));
    }
    Ok(ScenesToCheck {
        lab: Some(lab.name),
        scenes,
    })
}

fn arm(args: &Args) -> Result<Option<ArmInScene>, Failure> {
    let Some(named) = &args.robot else {
        return match args.urdf.given() {
            None => Ok(None),
            Some((given, _)) => Err(Failure::usage(
                format!("{given} is for the robot in the scene, and there is none"),
                "name one: --robot ROBOT",
            )),
        };
    };
    let robot = robot_source::load(&RobotArgs {
        robot: named.clone(),
        base: None,
        links: None,
        density: None,
        urdf: args.urdf.clone(),
        labs_folder: args.labs_folder.clone(),
    })?
    .robot;
    let start_q = match &args.start {
        None => robot.home().to_vec(),
        Some(text) => start(&robot, text)?,
    };
    let frame = match &args.frame {
        Some(frame) => frame.clone(),
        None if robot.frame("lab").is_some() => "lab".to_owned(),
        None => robot.links()[0].name.clone(),
    };
    let via = args.via.as_deref().map(points).transpose()?;
    let known: Vec<String> = robot
        .frames()
        .iter()
        .map(|frame| frame.name.clone())
        .collect();
    let name = robot.name().to_owned();
    let Some(mut arm) = ArmInScene::new(robot, start_q, &frame) else {
        return Err(Failure::usage(
            format!("robot `{name}` has no frame `{frame}`"),
            &suggest(&frame, "frames", known.iter().map(String::as_str)),
        )
        .coded(ErrorCode::UnknownName));
    };
    arm.via = via.unwrap_or_default();
    Ok(Some(arm))
}

/// The start as typed: one number per joint that moves or, for a robot with loops, per independent one.
fn start(robot: &Robot, text: &str) -> Result<Vec<f64>, Failure> {
    let names: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    let example = vec!["0"; robot.n().max(1)].join(",");
    let found = numbers(text, "--start", &example)?;
    if found.len() == robot.n() {
        let gap_m = loop_gap_m(robot, &found);
        if gap_m <= MOST_GAP_M {
            return Ok(found);
        }
        return Err(Failure::usage(
            format!("--start leaves the robot's loops open by {}", metres(gap_m)),
            "give the independent joints only, from which the others follow",
        ));
    }
    let independent = robot.independent();
    if found.len() == independent.len() {
        return closed_positions(robot, &found).map_err(|error| {
            Failure::usage(
                format!("--start does not close the robot's loops: {error}"),
                "give positions that the mechanism can reach",
            )
        });
    }
    let mut help = format!("give one number per joint that moves: {}", names.join(", "));
    if independent.len() < robot.n() {
        let free: Vec<&str> = independent.iter().map(|&entry| names[entry]).collect();
        help += &format!("; or one per independent joint: {}", free.join(", "));
    }
    Err(Failure::usage(
        format!(
            "--start has {} numbers, and robot `{}` has {} joints that move",
            found.len(),
            robot.name(),
            robot.n()
        ),
        &help,
    ))
}
