//! `kinemark lab draws`: the hidden cases and runs of a lab with their numbers, for the course staff.

use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_grader::judge::expose;
use kinemark_grader::lab::{Lab, Staff, Task};
use kinemark_grader::record::explanation::HiddenDraw;
use kinemark_grader::record::grade::TaskKind;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::error_record::ErrorCode;
use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};
use crate::{chosen_variant, enclosing_course, output};

/// List the hidden cases and runs of a lab with their numbers: for course staff
#[derive(Debug, Clone, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab draws 01-kinematics\n  kinemark lab draws 01-kinematics --task ik --json\n  \
    kinemark lab draws 04-knock-with-velocity --student s1234567\n\n\
    The numbers follow from the course's salt, the lab and the student's variant, as in a grade. Expected answers are those of \
    the simulator or the reference solution, which runs in this process. Do not give this list to students.\n\
    Exit codes: 0 done, 2 usage, 3 the lab is broken."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// The student whose variant is meant, exactly as the course writes the id
    #[arg(long, value_name = "ID")]
    pub(crate) student: Option<String>,
    /// Only this task
    #[arg(long, value_name = "TASK")]
    pub(crate) task: Option<String>,
    /// Print the list as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) staff: StaffPart,
}

#[derive(Serialize)]
struct Printed<'a> {
    lab: &'a str,
    student: Option<&'a str>,
    draws: &'a [HiddenDraw],
}

/// Draws and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let mut args = args.clone();
    let filled = enclosing_course::fill(&args.lab, &mut args.labs_folder, &mut args.staff)?;
    if let Some(filled) = filled {
        failure::note_in_words(&filled.note);
    }
    let args = &args;
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let mut lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    let help = "give the course staff's folder";
    let reference = staff_folder::part(&args.staff, labs_folder.as_deref(), help)?;
    let reference = reference.ok_or_else(|| {
        Failure::usage(
            "there is no folder `reference` beside the labs".to_owned(),
            "what is hidden is in the course staff's part: give its folder with --reference DIR",
        )
    })?;
    if let Some(student) = &args.student {
        let variant = chosen_variant::of_student(&lab, Some(&reference), &args.staff, student)?;
        lab = Lab::load_variant(files.as_ref(), &args.lab, Some(&variant))?;
    }
    let staff = staff_folder::staff(&reference, &lab, args.staff.salt())?;
    let staff = staff.ok_or_else(|| {
        Failure::usage(
            staff_folder::no_solution(&reference, &lab),
            "write it, or give another folder with --reference DIR",
        )
    })?;
    let tasks = tasks(&lab, args.task.as_deref())?;
    let draws = draws(&lab, &staff, &tasks)?;
    if args.json {
        output::print_formatted(&Printed {
            lab: &lab.name,
            student: args.student.as_deref(),
            draws: &draws,
        })?;
    } else {
        output::print_lines(&text(&lab, &tasks, &draws))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// All tasks, or the one of this name.
fn tasks<'l>(lab: &'l Lab, name: Option<&str>) -> Result<Vec<&'l Task>, Failure> {
    let wanted = |task: &&Task| name.is_none_or(|name| task.name == name);
    let found: Vec<&Task> = lab.tasks.iter().filter(wanted).collect();
    match name {
        Some(name) if found.is_empty() => {
            let known: Vec<&str> = lab.tasks.iter().map(|task| task.name.as_str()).collect();
            Err(Failure::usage(
                format!("lab `{}` has no task `{name}`", lab.name),
                &format!("its tasks: {}", known.join(", ")),
            )
            .coded(ErrorCode::UnknownName))
        }
        _ => Ok(found),
    }
}

fn draws(lab: &Lab, staff: &Staff, tasks: &[&Task]) -> Result<Vec<HiddenDraw>, Failure> {
    let mut draws = Vec::new();
    for task in tasks {
        let exposed = expose(lab, staff, task).map_err(|no_answer| {
            Failure::broken(no_answer.to_string(), "correct `solution.rhai`")
        })?;
        draws.extend(exposed.into_iter().flat_map(|exposed| exposed.draws));
    }
    Ok(draws)
}

/// The draws by task and class.
fn text(lab: &Lab, tasks: &[&Task], draws: &[HiddenDraw]) -> String {
    let mut out = format!(
        "{}  {}\n",
        lab.name.bold(),
        "for course staff only".yellow().bold()
    );
    let variant = lab.variant.as_ref().and_then(|variant| variant.student());
    if let Some(student) = variant {
        let _ = writeln!(out, "variant of {student}");
    }
    for task in tasks {
        let of_task = draws.iter().filter(|draw| draw.task == task.name);
        let of_task: Vec<&HiddenDraw> = of_task.collect();
        let _ = writeln!(out, "\n{}  {}", task.name.bold(), task.title);
        if of_task.is_empty() {
            out.push_str("  nothing is hidden\n");
        }
        let mut class = None;
        for draw in of_task {
            if class != Some(&draw.class) {
                class = Some(&draw.class);
                let what = match draw.kind {
                    TaskKind::Function => "cases",
                    TaskKind::Motion => "runs",
                };
                let _ = writeln!(out, "  hidden {what} of the class \"{}\"", draw.class);
            }
            push(&mut out, draw);
        }
    }
    out
}

fn push(out: &mut String, draw: &HiddenDraw) {
    let _ = writeln!(out, "    {:<3} {}", draw.number, draw.words);
    if let Some(expected) = &draw.expected {
        let _ = writeln!(out, "        {}", format!("expected {expected}").dimmed());
    }
}
