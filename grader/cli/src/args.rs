//! What can be typed.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand};

/// Grades robotics coursework: the same bits everywhere, every lost point explained.
#[derive(Debug, Parser)]
#[command(
    name = "kinemark",
    version,
    arg_required_else_help = true,
    max_term_width = 100
)]
#[command(
    after_help = "Start with `kinemark labs`, then `kinemark new 01-kinematics`.\n\
    Exit codes: 0 full marks or done, 1 points lost or answers with errors, 2 usage, 3 the lab, robot or scene is broken, \
    4 the grader or this machine failed."
)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Where labs and the staff's part come from.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct PlaceArgs {
    /// Folder of the labs [default: a `labs` folder here or above, else the labs built in]
    #[arg(long, value_name = "DIR", global = true)]
    pub(crate) labs: Option<PathBuf>,
}

/// Where the staff's part comes from.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct StaffArgs {
    /// Folder of the staff's reference [default: `reference` beside the labs folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) reference: Option<PathBuf>,
    /// Grade on visible cases only, as students do
    #[arg(long, conflicts_with = "reference")]
    pub(crate) practice: bool,
    /// Salt that hidden cases are drawn with, in place of the one in hidden.toml [env: KINEMARK_SALT]
    #[arg(
        long,
        value_name = "TEXT",
        env = SALT,
        hide_env = true,
        value_parser = salt
    )]
    pub(crate) salt: Option<String>,
}

/// The variable that holds a salt.
const SALT: &str = "KINEMARK_SALT";

/// Refuses a salt that everyone knows: that of a secret that is not set.
fn salt(text: &str) -> Result<String, String> {
    if text.trim().is_empty() {
        let is_of_environment = std::env::var(SALT).is_ok_and(|salt| salt == text);
        return Err(if is_of_environment {
            format!("the salt is empty: unset {SALT} in the environment to use hidden.toml's")
        } else {
            "the salt is empty: leave --salt out to use hidden.toml's".to_owned()
        });
    }
    Ok(text.to_owned())
}

/// Which variant of the lab: the numbers of one student.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct VariantArgs {
    /// The numbers of one student: a file that `kinemark variant` wrote
    #[arg(long, value_name = "FILE", conflicts_with = "student")]
    pub(crate) variant: Option<PathBuf>,
    /// The numbers of this student, computed from the course's salt: for staff
    #[arg(long, value_name = "ID", conflicts_with = "practice")]
    pub(crate) student: Option<String>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Grade(GradeArgs),
    Verify(VerifyArgs),
    View(ViewArgs),
    Watch(WatchArgs),
    Compare(CompareArgs),
    Export(ExportArgs),
    Labs(LabsArgs),
    New(NewArgs),
    Variant(VariantCommandArgs),
    /// Show, convert or ask a robot: kinematics, dynamics, simulation
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Check a scene
    #[command(subcommand)]
    Scene(SceneCommand),
    /// Check a lab
    #[command(subcommand)]
    Lab(LabCommand),
    Completions(CompletionsArgs),
    /// Runs a submission for another process; not for people
    #[command(hide = true)]
    Worker,
}

/// Grade a submission
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark grade 01-kinematics submission.rhai\n  \
    kinemark grade 01-kinematics submission.rhai --out feedback --json\n  \
    kinemark grade 01-kinematics submission.rhai --png --storyboard\n\n\
    A file variant.toml beside the submission is taken where neither --variant nor --student is given.\n\
    Neither it nor the submission may be a symbolic link.\n\
    Writes grade.json, report.html, plots, a log per motion task and a copy of the submission and the lab to the output folder.\n\
    Exit codes: 0 every check full, 1 points lost, 2 usage, 3 the lab is broken, 4 the grader or this machine failed."
)]
pub(crate) struct GradeArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// The submission
    pub(crate) submission: PathBuf,
    /// Folder to write to; an earlier report there is replaced
    #[arg(long, short, value_name = "DIR", default_value = "out")]
    pub(crate) out: PathBuf,
    /// Print the grade record as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Write each plot as PNG, too, beside the SVG
    #[arg(long)]
    pub(crate) png: bool,
    /// Write a storyboard of each motion task: six moments of the run in one picture, TASK/storyboard.png and .svg
    #[arg(long)]
    pub(crate) storyboard: bool,
    /// Run the submission in this process: for profiling trusted code
    #[arg(long)]
    pub(crate) in_process: bool,
    /// Show the reference solution's motion beside the run, in the report and its logs: for staff. Its joint motion is the answer;
    /// do not hand such a report to students
    #[arg(long, conflicts_with = "practice")]
    pub(crate) ghost: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) variant: VariantArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// Grade a report's submission again and compare every digest
#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:\n  kinemark verify out\n\n\
    Uses the copies of lab, robot and submission inside the folder.\n\
    Exit codes: 0 same bits, 1 something differs, 2 usage, 3 the folder is no report, 4 the grader or this machine failed.")]
pub(crate) struct VerifyArgs {
    /// The output folder of `kinemark grade`
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    /// Print the comparison as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// Where a report is served.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct ServeArgs {
    /// Port of this machine to serve it on [default: a free one]
    #[arg(long, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) port: Option<u16>,
    /// Print the address, and open no browser
    #[arg(long)]
    pub(crate) no_open: bool,
}

/// Open a report in the browser
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark view\n  kinemark view feedback --no-open --port 8000\n\n\
    Serves the folder to this machine alone, read only, until Ctrl-C. A folder of several reports is listed with what each earned.\n\
    Exit codes: 0 ended by Ctrl-C, 2 usage, 3 the folder holds no report, 4 the address cannot be served."
)]
pub(crate) struct ViewArgs {
    /// The output folder of `kinemark grade` or `kinemark compare`, or a folder of several
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) serve: ServeArgs,
    /// Print folder and address as a line of JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Grade on every save, and keep the report open
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  kinemark watch 01-kinematics submission.rhai\n\n\
    Grades at once, and again when the submission is saved, or the lab where it comes from a folder. The report opens in the browser \
    and loads itself anew, at the moment and the place that are looked at. With --json each grade is one line.\n\
    See docs/watch-and-compare.md.\n\
    Exit codes: 0 ended by Ctrl-C, 2 usage, 3 the lab is broken at the start, 4 the grader or this machine failed."
)]
pub(crate) struct WatchArgs {
    #[command(flatten)]
    pub(crate) grade: GradeArgs,
    #[command(flatten)]
    pub(crate) serve: ServeArgs,
}

/// Hold two reports of a lab beside each other
#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:\n  kinemark compare before after\n\n\
    Tells the points of both per check and where the motions first differ, and writes compare.html with both arms in one replay. \
    The runs are made again from the copies in the folders.\n\
    See docs/watch-and-compare.md.\n\
    Exit codes: 0 compared, 2 usage or two labs, 3 a folder is no report, 4 the grader or this machine failed.")]
pub(crate) struct CompareArgs {
    /// An output folder of `kinemark grade`
    pub(crate) a: PathBuf,
    /// Another, of the same lab
    pub(crate) b: PathBuf,
    /// Folder to write to; an earlier comparison there is replaced
    #[arg(long, short, value_name = "DIR", default_value = "kinemark-compare")]
    pub(crate) out: PathBuf,
    /// Print the comparison as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Write a log as tables
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark export out/move/run.mcap --csv\n  \
    kinemark export out/move/run.mcap --csv --topic /signals > signals.csv\n\n\
    Writes a CSV file per topic to the folder run-csv beside the log, with export.json, which lists them; an earlier export there is \
    replaced.\n\
    Reads every MCAP log with JSON messages. See docs/watch-and-compare.md.\n\
    Exit codes: 0 written, 2 usage, 3 the log is broken, 4 the tables cannot be written."
)]
pub(crate) struct ExportArgs {
    /// The log, such as out/move/run.mcap
    pub(crate) log: PathBuf,
    /// Write comma-separated values, which every spreadsheet reads
    #[arg(long, required = true)]
    pub(crate) csv: bool,
    /// Only this topic; without --out it is printed
    #[arg(long, value_name = "TOPIC")]
    pub(crate) topic: Option<String>,
    /// Folder to write to; an earlier export there is replaced [default: the log's name with -csv, beside it]
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// List the labs
#[derive(Debug, ClapArgs)]
pub(crate) struct LabsArgs {
    /// Print the list as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

/// Start a lab: writes its starter and its brief into a folder
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  kinemark new 01-kinematics\n  cd 01-kinematics\n  kinemark grade 01-kinematics submission.rhai"
)]
pub(crate) struct NewArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// Folder to write to [default: the lab's name]
    pub(crate) dir: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) variant: VariantArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// Write the numbers of one student: for staff
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark variant 04-knock-with-velocity --student s1234567\n  \
    kinemark variant 04-knock-with-velocity --student s1234567 --out s1234567/variant.toml\n\n\
    Needs the course's salt: the staff's hidden.toml, or --salt. The same salt, lab and student give the same numbers everywhere.\n\
    Exit codes: 0 done, 2 usage, 3 the lab is broken, 4 the file cannot be written."
)]
pub(crate) struct VariantCommandArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// The student's id, letter by letter as the course writes it
    #[arg(long, value_name = "ID")]
    pub(crate) student: String,
    /// File to write [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
    /// Print the numbers as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotCommand {
    Show(ShowArgs),
    Convert(ConvertArgs),
    Eval(EvalArgs),
}

/// Which robot, and how it is read.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct RobotArgs {
    /// A robot file (.toml or .urdf), a robot of the labs by its name, or its joints in a row such as RzRyRz
    pub(crate) robot: OsString,
    /// Height of the first joint of joints in a row, in metres [default: 0]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub(crate) base: Option<f64>,
    /// Links of joints in a row: one lx,ly,lz per joint, in metres, with semicolons between
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub(crate) links: Option<String>,
    /// Folder of a ROS package that a URDF names its meshes by; may be given several times
    #[arg(long = "package", value_name = "NAME=DIR", value_parser = package)]
    pub(crate) packages: Vec<(String, PathBuf)>,
    /// Give the mimic joints of a URDF entries of their own
    #[arg(long)]
    pub(crate) ignore_mimic: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

/// Reads `NAME=DIR`.
fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => {
            Ok((name.to_owned(), PathBuf::from(folder)))
        }
        _ => Err(
            "write the package's name, `=` and its folder, such as ur_description=../ur".to_owned(),
        ),
    }
}

/// Show a robot: its links and joints as a tree, totals, loops, frames and warnings
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark robot show rrbot\n  kinemark robot show panda.urdf --package franka_description=../franka\n  \
    kinemark robot show RzRyRz --base 2 --links \"0,0,4; 3,0,0; 1,0,0\"\n\n\
    Exit codes: 0 shown, 2 usage, 3 the robot is broken."
)]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// Print all of it as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Write any robot as a robot file (TOML)
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark robot convert panda.urdf --out panda.toml\n  \
    kinemark robot convert RzRyRz --base 2 --links \"0,0,4; 3,0,0; 1,0,0\"\n\n\
    Meshes are not copied: the file names them where they lie, seen from its own folder. Warnings go to standard error.\n\
    Exit codes: 0 written, 2 usage, 3 the robot is broken, 4 the file cannot be written."
)]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// File to write [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// Answer requests about a robot: one JSON object per line in, one per line out
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  echo '{\"id\": 1, \"op\": \"fk\", \"q\": [0.3, -1.2]}' | kinemark robot eval labs/robots/rrbot.toml\n\n\
    Operations: info, fk, jacobian, jacobian_derivative, manipulability, workspace, ik, com, rnea, bias, gravity, coriolis,\n\
    inverse_dynamics, crba, aba, energy, trajectory, simulate.\n\
    See docs/robot-eval.md.\n\
    Exit codes: 0 every request answered, 1 some answered with an error, 2 usage, 3 the robot is broken."
)]
pub(crate) struct EvalArgs {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// What is around the robot in `simulate`: a scene file, or a scene of the labs by its name
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SceneCommand {
    Check(SceneCheckArgs),
}

/// Check a scene: overlaps at the start, bodies that do not stay, places a robot cannot get to
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark scene check shelf-and-can\n  kinemark scene check my-scene.toml --robot rrbot --start 1.57,0\n  \
    kinemark scene check shelf-and-can --robot rrbot --via \"1.5,0.8,0.05; 1.4,1.3,0.05\"\n  kinemark scene check labs/03-knock-with-position/lab.toml\n\n\
    With --via, each point must be reached without a link in a fixed or driven body or in the ground, and so must the straight \
    lines between them. A lab brings its own robot, starts and goals. See docs/scenes.md.\n\
    Exit codes: 0 no errors (warnings and notes may be), 1 errors, 2 usage, 3 the scene, robot or lab is broken."
)]
pub(crate) struct SceneCheckArgs {
    /// A scene file, a scene of the labs by its name, or a lab: its name, its folder or its lab.toml
    pub(crate) scene: PathBuf,
    /// The robot in it: a robot file (.toml or .urdf), or a robot of the labs by its name
    #[arg(long, value_name = "ROBOT")]
    pub(crate) robot: Option<OsString>,
    /// Folder of a ROS package that a URDF names its meshes by; may be given several times
    #[arg(long = "package", value_name = "NAME=DIR", value_parser = package, requires = "robot")]
    pub(crate) packages: Vec<(String, PathBuf)>,
    /// Joint positions at the start, in rad or m, with commas between [default: where loops are closed, else zeros]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, requires = "robot")]
    pub(crate) start: Option<String>,
    /// Places of the TCP, in their order: x,y,z in metres, with semicolons between
    #[arg(
        long,
        value_name = "POINTS",
        allow_hyphen_values = true,
        requires = "robot"
    )]
    pub(crate) via: Option<String>,
    /// The robot's frame that places are told in [default: `lab` if the robot has it, else its first link]
    #[arg(long, value_name = "FRAME", requires = "robot")]
    pub(crate) frame: Option<String>,
    /// Print all findings as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum LabCommand {
    Check(LabCheckArgs),
}

/// Check a lab's grader with the staff's part: the starter misses, the reference solution has full marks, every known mistake
/// loses points and is named
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark lab check 01-kinematics\n  kinemark lab check 01-kinematics --salts 40 --json\n  kinemark lab check 02-jacobian-velocity --variants 200\n\n\
    A starter may earn a tenth of the points; a lab has at least 6 known mistakes, each of which shows in 30 % of a function \
    task's cases. Everything runs in this process: check labs of people you trust. See docs/lab-format.md.\n\
    Exit codes: 0 nothing is wrong, 1 something is, 2 usage, 3 the lab is broken."
)]
pub(crate) struct LabCheckArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// Draws of hidden cases that the reference solution is tried on, besides the lab's own
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub(crate) salts: u32,
    /// Students in whose variants the reference solution is tried, each with hidden cases and runs of their own
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub(crate) variants: u32,
    /// Print what was tried as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the staff's reference [default: `reference` beside the labs folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) reference: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

/// Print shell completions
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  kinemark completions bash > ~/.local/share/bash-completion/completions/kinemark"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_consistent() {
        use clap::CommandFactory as _;
        Args::command().debug_assert();
    }

    /// The reference of the command line is that of the code; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_published_reference_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/cli.md");
        let options = clap_markdown::MarkdownOptions::new()
            .title("The command line".to_owned())
            .show_footer(false);
        let text = clap_markdown::help_markdown_custom::<Args>(&options);
        let text = text.trim_end().to_owned() + "\n";
        let published = std::fs::read_to_string(path).unwrap_or_default();
        if published != text && std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        assert!(
            published == text,
            "docs/cli.md was not that of the code: KINEMARK_BLESS=1 cargo test writes it (docs/tests.md)"
        );
    }
}
