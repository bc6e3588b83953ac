//! `kinemark lab new`: a folder with the files of a lab that somebody begins to write.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_grader::lab::new_lab::{
    NewLab, NewTask, NewTaskKind, SCHEMA_FOLDER, Unfit, schema_name,
};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::robot::{LabRobot, RobotOptions, robot_names, robot_path};
use kinemark_sim::text::suggest;
use serde::Serialize;

use crate::commands::lab_schema::SchemaKind;
use crate::disk::Folder;
use crate::error_record::ErrorCode;
use crate::failure::{Failure, note_in_words};
use crate::fresh_folder::FreshFolder;
use crate::lab_from::{Changes, FilesOfFolder, Origin, copied};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::output;

/// Start a new lab: files with numbers that fit its robot, and a TODO wherever you have to decide
#[derive(Debug, Clone, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab new first-lab --robot rrbot --task fk --task motion:turn\n  \
    kinemark lab new arm-lab --robot puma560 --task ik:where --task velocity --task function:gear-ratio\n  \
    kinemark lab new reach-lab --from 01-kinematics\n\n\
    Kinds of tasks: fk, ik (of places), fk-pose, ik-pose (with how the TCP is turned), jacobian, tcp-velocity, tcp-acceleration, gravity, \
    coriolis, torque, mass-matrix, function (of the lab's own), motion (by joint positions), goals (places of the TCP, by joint positions), \
    velocity (by joint velocities), effort (by joint efforts). A name follows after a colon.\n\
    --from copies a lab with the course staff's part: the copy has a name and a salt of its own, other numbers wherever the lab's \
    variants leave a choice, and the robot of --robot. Solutions of the labs that come with kinemark are public: change what is asked \
    for, too.\n\n\
    Writes labs/NAME for students and reference/NAME for course staff, and beside them schemas by which an editor completes keys. Without a folder `labs` here or above it makes one, with the \
    robot in it. Then `kinemark watch NAME reference/NAME/solution.rhai` follows what you write, and `kinemark lab check NAME` \
    lists what is missing.\n\
    Exit codes: 0 done, 2 usage, 3 the robot is broken, 4 a file cannot be written."
)]
pub(crate) struct Args {
    /// Name of the lab, which is that of its folder: lower-case letters, digits and `-`, such as 10-first
    pub(crate) name: String,
    /// The robot: a name in labs/robots, a URDF there with its ending, or a row of joints such as RzTxRy [default: rrbot, or that of the lab that is copied]
    #[arg(long)]
    pub(crate) robot: Option<String>,
    /// A task, in the order in which they are graded: KIND or KIND:NAME
    #[arg(
        long = "task",
        value_name = "KIND[:NAME]",
        required_unless_present = "from"
    )]
    pub(crate) tasks: Vec<String>,
    /// Begin with a copy of this lab
    #[arg(long, value_name = "LAB", conflicts_with = "tasks")]
    pub(crate) from: Option<String>,
    /// With --from: keep the numbers of the lab
    #[arg(long)]
    pub(crate) same_numbers: bool,
    /// The salt of hidden numbers, and of the copy's numbers [default: a random one]
    #[arg(long, value_name = "TEXT")]
    pub(crate) salt: Option<String>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the course staff's part [default: `reference` beside the labs folder] [env: KINEMARK_REFERENCE]
    #[arg(
        long,
        value_name = "DIR",
        default_value = crate::environment::reference(),
        hide_default_value = true
    )]
    pub(crate) reference: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

#[derive(Serialize)]
struct Written<'a> {
    lab: &'a str,
    written: Vec<PathBuf>,
}

/// Writes the folders.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let name = plain_name("lab", &args.name)?;
    let (files, found) = labs_folder::open(&args.labs_folder)?;
    let labs = found.clone().unwrap_or_else(|| PathBuf::from("labs"));
    let beside = labs.parent().unwrap_or(Path::new("")).join("reference");
    let reference = args.reference.clone().unwrap_or(beside);
    let Content {
        halves: [public, staff],
        needs,
    } = match &args.from {
        Some(origin) => copied_lab(args, files.as_ref(), &reference, origin)?,
        None if args.same_numbers => {
            return Err(Failure::usage(
                "--same-numbers keeps the numbers of a lab that is copied".to_owned(),
                "leave it out, or name the lab with --from",
            ));
        }
        None => new_lab(args, files.as_ref())?,
    };
    let folders = [(labs.join(name), public), (reference.join(name), staff)];
    for (folder, _) in &folders {
        if folder.symlink_metadata().is_ok() {
            return Err(Failure::usage(
                format!("`{}` already exists", folder.display()),
                "choose another name: a lab that was begun is never replaced",
            )
            .coded(ErrorCode::Exists));
        }
    }
    let mut written = Vec::new();
    for path in &needs {
        written.extend(copy_built_in(path, &labs)?);
    }
    if found.is_none() {
        note_in_words(
            "there is no folder `labs` here or above: it is made, with all that this lab needs in it",
        );
    }
    for (folder, files) in &folders {
        let whole = || -> std::io::Result<()> {
            let fresh = FreshFolder::beside(folder)?;
            for (name, text) in files {
                fresh.write(name, text)?;
            }
            fresh.put_in_place(&[])
        };
        whole().map_err(|error| {
            output::unwritten(
                folder,
                &error,
                "choose another folder with --labs and --reference",
            )
        })?;
        written.extend(files.iter().map(|(name, _)| folder.join(name)));
    }
    for (folder, kinds) in [(&labs, OF_LABS), (&reference, OF_REFERENCE)] {
        written.extend(write_schemas(&folder.join(SCHEMA_FOLDER), kinds)?);
    }
    if args.json {
        let lab = name;
        output::print_formatted(&Written { lab, written })?;
    } else {
        let lines: String = written
            .iter()
            .map(|path| format!("wrote {}\n", output::path(path)))
            .collect();
        let solution = reference.join(name).join("solution.rhai");
        let watch = format!("kinemark watch {name} {}", output::path(&solution));
        let next = match args.from {
            None => format!("write the solution, and follow it with\n  {watch}"),
            Some(_) => format!(
                "change what is asked for, follow it with\n  {watch}\nand write what follows from the solution with\n  kinemark lab fill {name}"
            ),
        };
        output::print(&format!(
            "{lines}\nnext: {next}\nthen see what is missing with\n  kinemark lab check {name}\n",
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What is written.
struct Content {
    /// What students get, and what course staff keep.
    halves: [FilesOfFolder; 2],
    /// Files of the labs folder that the lab needs beside its own: its robot, scenes and meshes.
    needs: Vec<String>,
}

/// A lab of these tasks.
fn new_lab(args: &Args, files: &dyn Files) -> Result<Content, Failure> {
    let tasks = tasks(&args.tasks)?;
    let typed = args.robot.as_deref().unwrap_or("rrbot");
    let robot_name = typed.strip_suffix(".toml").unwrap_or(typed);
    let robot = robot(files, robot_name)?;
    let new = NewLab {
        name: &args.name,
        robot_name,
        robot: &robot,
        tasks: &tasks,
        salt: &salt(args)?,
    };
    let content = new.files().map_err(|error| {
        let help = match error {
            Unfit::CannotMove { .. } => {
                "give its links an `inertia`, or choose another robot, such as --robot rrbot"
            }
            Unfit::Pose { .. } => {
                "ask for places with --task ik, or choose a robot with more joints, such as --robot puma560"
            }
            Unfit::Loops { .. } => {
                "choose another robot, or begin with --task function and add the rest by docs/lab-format.md"
            }
        };
        Failure::usage(error.to_string(), help)
    })?;
    let bytes = |texts: Vec<(&'static str, String)>| {
        let texts = texts.into_iter();
        texts
            .map(|(path, text)| (path.to_owned(), text.into_bytes()))
            .collect()
    };
    Ok(Content {
        halves: [bytes(content.lab), bytes(content.reference)],
        needs: vec![robot_path(robot_name)],
    })
}

/// A copy of the lab called `origin`.
fn copied_lab(
    args: &Args,
    files: &dyn Files,
    reference: &Path,
    origin: &str,
) -> Result<Content, Failure> {
    let origin = labs_folder::full_name(files, origin)?;
    let staff = Folder::new(reference.to_owned());
    let has_solution = !matches!(staff.read(&format!("{origin}/solution.rhai")), Ok(None));
    if !has_solution {
        return Err(Failure::usage(
            format!(
                "the course staff's part of `{origin}` is not in `{}`",
                reference.display()
            ),
            "a copy begins with the solution: run this where `labs` and `reference` are, such as a checkout of Kinemark, or give --labs and --reference",
        ));
    }
    if let Some(robot) = &args.robot {
        self::robot(files, robot)?;
    }
    let changes = Changes {
        name: &args.name,
        robot: args.robot.as_deref(),
        new_numbers: !args.same_numbers,
        salt: &salt(args)?,
    };
    let origin = Origin {
        labs: files,
        reference: &staff,
        lab: &origin,
    };
    Ok(Content {
        halves: copied(&origin, &changes)?,
        // it is copied inside one folder of labs
        needs: Vec::new(),
    })
}

/// A name that files and links can have.
fn plain_name<'n>(what: &str, name: &'n str) -> Result<&'n str, Failure> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 60 && !name.starts_with('-') && name.chars().all(plain) {
        return Ok(name);
    }
    Err(Failure::usage(
        format!("`{name}` cannot be the name of a {what}"),
        "use lower-case letters, digits and `-`, 60 at most, such as 10-first",
    ))
}

/// Names of functions that tasks of other kinds call, or that every submission may have.
const RESERVED: [&str; 11] = [
    "control",
    "init",
    "forward_kinematics",
    "inverse_kinematics",
    "jacobian",
    "velocity",
    "acceleration",
    "torque",
    "gravity",
    "coriolis",
    "mass_matrix",
];

/// The tasks as typed.
fn tasks(typed: &[String]) -> Result<Vec<NewTask>, Failure> {
    let mut tasks: Vec<NewTask> = Vec::new();
    for text in typed {
        let (word, name) = match text.split_once(':') {
            Some((word, name)) => (word, Some(name)),
            None => (text.as_str(), None),
        };
        let found = NewTaskKind::ALL.iter().find(|(known, _)| *known == word);
        let Some((known, kind)) = found else {
            let words = NewTaskKind::ALL.iter().map(|(known, _)| *known);
            return Err(Failure::usage(
                format!("no kind of task is called `{word}`"),
                &suggest(word, "kinds", words),
            ));
        };
        let name = plain_name("task", name.unwrap_or(known))?.to_owned();
        if *kind == NewTaskKind::Function && !name.starts_with(|c: char| c.is_ascii_lowercase()) {
            return Err(Failure::usage(
                format!("a function cannot be called `{name}`"),
                "begin its name with a letter, such as --task function:gear-ratio",
            ));
        }
        let function = name.replace('-', "_");
        if *kind == NewTaskKind::Function && RESERVED.contains(&function.as_str()) {
            return Err(Failure::usage(
                format!(
                    "a function of the lab's own cannot be called `{function}`: that is the name of another one"
                ),
                "choose another name, such as --task function:gear-ratio, or the kind of task that calls it: --task fk, ik, jacobian or motion",
            ));
        }
        if tasks.iter().any(|task| task.name == name) {
            return Err(Failure::usage(
                format!("two tasks are called `{name}`"),
                &format!("name each, such as --task {word}:{name}-2"),
            ));
        }
        tasks.push(NewTask { kind: *kind, name });
    }
    Ok(tasks)
}

/// The robot of this name in the labs folder, else the one that is built in.
fn robot(files: &dyn Files, name: &str) -> Result<kinemark_sim::model::robot::Robot, Failure> {
    let built_in = labs_folder::built_in();
    let load = |files: &dyn Files| LabRobot::named(files, name, &RobotOptions::default());
    let found = match load(files)? {
        None => load(&built_in)?,
        found => found,
    };
    let Some(found) = found else {
        let mut known = robot_names(files);
        known.extend(robot_names(&built_in));
        known.sort();
        known.dedup();
        return Err(Failure::usage(
            format!(
                "there is no robot file `labs/{}`, and no robot called `{name}` is built in",
                robot_path(name)
            ),
            &suggest(name, "robots", known.iter().map(String::as_str)),
        )
        .coded(ErrorCode::UnknownName));
    };
    found
        .file
        .build(&[])
        .map_err(|error| Failure::broken(error.to_string(), "correct the robot"))
}

/// Copies a file of the labs that are built in into the folder `labs`, so that the new lab has it; nothing where it is there, and where
/// there is none, as for a row of joints.
fn copy_built_in(path: &str, labs: &Path) -> Result<Option<PathBuf>, Failure> {
    let out = labs.join(path);
    let built_in = labs_folder::built_in().bytes(path);
    let (Ok(Some(bytes)), false) = (built_in, out.exists()) else {
        return Ok(None);
    };
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).map_err(|error| {
            output::unwritten(folder, &error, "go to a folder that you may write to")
        })?;
    }
    output::write_file(&out, &bytes, "go to a folder that you may write to")?;
    Ok(Some(out))
}

/// The schemas of what lies in `labs`, by the names of their kinds.
const OF_LABS: &[SchemaKind] = &[SchemaKind::Lab, SchemaKind::Robot, SchemaKind::Scene];
/// Those of what lies in `reference`.
const OF_REFERENCE: &[SchemaKind] = &[
    SchemaKind::Hidden,
    SchemaKind::Mutants,
    SchemaKind::Accepted,
];

/// Writes schemas for editors, each where it is missing or that of another version; returns which.
fn write_schemas(folder: &Path, kinds: &[SchemaKind]) -> Result<Vec<PathBuf>, Failure> {
    let help = "choose another folder with --labs and --reference";
    std::fs::create_dir_all(folder).map_err(|error| output::unwritten(folder, &error, help))?;
    let mut written = Vec::new();
    for kind in kinds {
        let path = folder.join(schema_name(&kind.name()));
        let text = kind.text();
        if std::fs::read(&path).is_ok_and(|there| there == text.as_bytes()) {
            continue;
        }
        output::write_file(&path, text.as_bytes(), help)?;
        written.push(path);
    }
    Ok(written)
}

/// The salt that was given, or one that nobody can guess.
fn salt(args: &Args) -> Result<String, Failure> {
    if let Some(given) = &args.salt {
        return Ok(given.clone());
    }
    let mut bytes = [0_u8; 16];
    getrandom::fill(&mut bytes)
        .map_err(|error| Failure::fault(format!("no random numbers: {error}"), "try again"))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
