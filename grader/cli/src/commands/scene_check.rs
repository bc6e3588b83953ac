//! `kinemark scene check`: what is wrong with a scene, before anything runs in it; for people, and as JSON for machines.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use indicatif::{ProgressBar, ProgressStyle};
use kinemark_sim::scene_check::{Progress, SceneCheckError, Stage};
use kinemark_toolbox::scene_check::{CheckedScene, scene_record, scene_text};
use kinemark_toolbox::styled_text::StyledText;
use serde_json::{Value, json};

use crate::failure::{Failure, LOST};
use crate::labs_folder::LabsFolderArgs;
use crate::output;
use crate::robot_source::UrdfArgs;
use crate::scenes_to_check::scenes_to_check;

/// Check a scene: overlaps at the start, bodies that do not rest, waypoints that are unreachable or in collision
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  kinemark scene check shelf-and-can\n  \
    kinemark scene check my-scene.toml --robot rrbot --start 1.57,0\n  \
    kinemark scene check shelf-and-can --robot rrbot --via \"1.5,0.8,0.05; 1.4,1.3,0.05\"\n  \
    kinemark scene check labs/03-knock-with-position/lab.toml\n\n\
    With --via, the robot must reach each point with no link in a fixed or kinematic body or in the ground, and follow the \
    straight lines between them. A lab has its own robot, starts and goals. See docs/scenes.md.\n\
    Exit codes: 0 no errors (warnings and notes may be), 1 errors, 2 usage, 3 the scene, robot or lab is broken.")]
pub(crate) struct Args {
    /// A scene file, the name of a scene of the labs, or a lab: its name, its folder or its lab.toml
    pub(crate) scene: PathBuf,
    /// The robot in the scene: a robot file (.toml or .urdf), or the name of a robot of the labs
    #[arg(long, value_name = "ROBOT")]
    pub(crate) robot: Option<OsString>,
    #[command(flatten)]
    pub(crate) urdf: UrdfArgs,
    /// Joint positions at the start, in rad or m, separated by commas [default: the robot's home]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, requires = "robot")]
    pub(crate) start: Option<String>,
    /// Waypoints of the TCP in their order: x,y,z in metres, separated by semicolons
    #[arg(
        long,
        value_name = "POINTS",
        allow_hyphen_values = true,
        requires = "robot"
    )]
    pub(crate) via: Option<String>,
    /// The robot's frame in which waypoints are given [default: `lab` if the robot has it, else its first link]
    #[arg(long, value_name = "FRAME", requires = "robot")]
    pub(crate) frame: Option<String>,
    /// Print all findings as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// Checks the scene, or each scene of the lab.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let named = scenes_to_check(args)?;
    let bar = ProgressBar::new(1);
    if let Ok(style) = ProgressStyle::with_template("{msg} {bar:30} {percent} %") {
        bar.set_style(style);
    }
    let mut watch = |progress: Progress| {
        bar.set_message(match progress.stage {
            Stage::Overlaps => "overlaps",
            Stage::Settling => "do bodies stay?",
            Stage::Via => "via points",
        });
        bar.set_length(progress.of);
        bar.set_position(progress.done);
    };
    let scenes = named.scenes.iter();
    let checked: Result<Vec<CheckedScene<'_>>, SceneCheckError> =
        scenes.map(|scene| scene.check(&mut watch)).collect();
    bar.finish_and_clear();
    let checked = checked.map_err(failure)?;
    if args.json {
        let mut records: Vec<Value> = checked.iter().map(scene_record).collect();
        match (&named.lab, records.pop()) {
            (None, Some(record)) => output::print_formatted(&record)?,
            (lab, last) => {
                records.extend(last);
                output::print_formatted(&json!({ "lab": lab, "scenes": records }))?;
            }
        }
    } else {
        let mut text = StyledText::default();
        for (i, checked) in checked.iter().enumerate() {
            text.plain(if i > 0 { "\n" } else { "" });
            text.append(scene_text(checked));
        }
        output::print_styled(&text)?;
    }
    let has_errors = checked.iter().any(CheckedScene::has_errors);
    Ok(ExitCode::from(if has_errors { LOST } else { 0 }))
}

fn failure(error: SceneCheckError) -> Failure {
    match error {
        SceneCheckError::Engine(error) => Failure::broken(
            error.to_string(),
            "change the shape or the mass it names: contact with it cannot be computed",
        ),
        SceneCheckError::Inverse(error) => Failure::usage(
            error.to_string(),
            "give positions that the robot can reach; `kinemark robot show` lists its joints",
        ),
    }
}
