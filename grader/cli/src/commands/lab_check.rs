//! `kinemark lab check`: what is wrong with the grader of a lab, before a student meets it.

use std::fmt::Write as _;
use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::ScopedJoinHandle;

use indicatif::ProgressBar;
use kinemark_course::language::Language;
use kinemark_grader::audit::{
    Accepted, Audit, PracticeError, Row, Rubric, Tried, Variants, depends_on_salt, grade_of_zeros,
    practice_forms,
};
use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::practice::{PRACTICE_SALT, practice_student};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::quantity::{points, with_unit};
use kinemark_grader::submission::rhai::STACK_BYTES;
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use kinemark_grader::task::problem::LoadError;
use kinemark_report::formula::formula_problems;
use kinemark_sim::text::Source;
use owo_colors::OwoColorize as _;

use crate::disk::Folder;
use crate::failure::{self, Failure, LOST};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};
use crate::{interrupt, output};

/// Check a lab: its starter loses points, its reference solution gets full marks, and every mutant loses points and is named
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab check 01-kinematics\n  kinemark lab check 01-kinematics --salts 40 --json\n  \
    kinemark lab check 02-jacobian-velocity --variants 200\n\n\
    A starter may earn a tenth of the points. A lab needs at least 6 mutants, each of which gives wrong answers in at least 30 % of \
    a function task's cases. Everything runs in this process: only check labs of people you trust. See docs/lab-format.md.\n\
    Exit codes: 0 nothing is wrong, 1 something is, 2 usage, 3 the lab is broken."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// Number of extra random salts to test the reference solution with
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub(crate) salts: u32,
    /// Number of student variants to test the reference solution with, each with its own hidden cases and runs
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub(crate) variants: u32,
    /// Print what was tried as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the course staff's part [default: `reference` beside the labs folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) reference: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// Audits the lab and prints what was tried.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    for warning in lab.robot.warnings() {
        failure::warn_alone(&format!("robot `{}`: {warning}", lab.robot.name()));
    }
    let from = StaffPart {
        reference: args.reference.clone(),
        salt: None,
    };
    let help = "give the course staff's folder";
    let reference = staff_folder::part(&from, labs_folder.as_deref(), help)?.ok_or_else(|| {
        Failure::usage(
            "there is no folder `reference` beside the labs".to_owned(),
            "a lab is checked with the course staff's part: give its folder with --reference DIR",
        )
    })?;
    let staff = |salt: Option<&str>| {
        staff_folder::staff(&reference, &lab, salt)?.ok_or_else(|| {
            Failure::usage(
                staff_folder::no_solution(&reference, &lab),
                "write it, or give another folder with --reference DIR",
            )
        })
    };
    let own = staff(None)?;
    let starter = labs_folder::text(files.as_ref(), &lab.name, "starter.rhai")?;
    let starter = Source::new("starter.rhai", starter);
    let path = format!("{}/brief.md", lab.name);
    let brief = files
        .read(&path)
        .map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))?;

    let mut audit = Audit::new(&lab);
    let formulas = brief.as_deref().map(formula_problems).unwrap_or_default();
    let formula = formulas.first().map(ToString::to_string);
    audit.brief(&lab, brief.as_deref(), formula.as_deref());
    let starter_grade = audit.starter(&lab, &own, &starter);
    audit_compiled_starters(&mut audit, files.as_ref(), &lab)?;
    let reference_run = audit.reference(&lab, &own, "own hidden cases");
    audit_practice(&mut audit, files.as_ref(), &lab, &own)?;
    let draws = if depends_on_salt(&lab) { args.salts } else { 0 };
    for draw in 1..=draws {
        let staff = staff(Some(&format!("lab check {draw}")))?;
        audit.reference(&lab, &staff, &format!("hidden cases of draw {draw}"));
    }
    if !lab.variants.is_empty() && args.variants > 0 {
        let salt = Staff::salt(&reference, &lab.name, None)?.unwrap_or_default();
        audit.variants(variants(&lab, &reference, &salt, args.variants)?);
    }
    let mutants = audit.mutants(&lab, &own);
    let graded = Graded {
        starter: starter_grade,
        reference: reference_run.map(|run| run.grade),
        mutants,
    };
    audit_rubric(
        &mut audit,
        &reference,
        (&lab, &own),
        brief.as_deref(),
        &graded,
    )?;

    if args.json {
        output::print_json(&audit)?;
    } else {
        output::print(&text(&audit))?;
    }
    let bad = audit.problems().next().is_some();
    Ok(ExitCode::from(if bad { LOST } else { 0 }))
}

/// Looks into the starters of compiled languages, where there are any.
fn audit_compiled_starters(audit: &mut Audit, files: &dyn Files, lab: &Lab) -> Result<(), Failure> {
    for language in [Language::Rust, Language::C] {
        let path = format!("{}/{}", lab.name, language.starter());
        let text = files.read(&path);
        let text = text.map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))?;
        if let Some(text) = text {
            let defines = |name: &str| language.defines(&text, name);
            audit.compiled_starter(lab, language.starter(), &defines);
        }
    }
    Ok(())
}

/// What was graded on the way, as far as it came to a grade.
struct Graded {
    starter: Option<Grade>,
    reference: Option<Grade>,
    mutants: Vec<Grade>,
}

/// Looks at the rubric itself.
fn audit_rubric(
    audit: &mut Audit,
    reference: &Folder,
    (lab, staff): (&Lab, &Staff),
    brief: Option<&str>,
    graded: &Graded,
) -> Result<(), Failure> {
    let salt = Staff::salt(reference, &lab.name, None)?;
    let margins = audit.rooms.clone();
    let (known_salts, zeros) = (known_salts(reference, lab), grade_of_zeros(lab, staff));
    let rubric = Rubric {
        lab,
        staff,
        salt: salt.as_deref(),
        known_salts: &known_salts,
        brief,
        starter: graded.starter.as_ref(),
        zeros: zeros.as_ref(),
        reference: graded.reference.as_ref(),
        mutants: &graded.mutants,
        margins: &margins,
    };
    audit.rubric(&rubric, &Accepted::load(reference, lab)?);
    Ok(())
}

/// Salts that others know: that of the documentation, those of the labs that everybody has, and those of the other labs beside this one.
fn known_salts(reference: &Folder, lab: &Lab) -> Vec<(String, String)> {
    let example = "change this every year, and make it long";
    let mut known = vec![(example.to_owned(), "the documentation".to_owned())];
    for name in lab_names(&labs_folder::built_in()) {
        known.push((
            format!("kinemark-{name}"),
            format!("the shipped lab `{name}`"),
        ));
    }
    for name in reference.list("") {
        // a broken file of another lab is no problem of this one
        let salt = Staff::salt(reference, &name, None);
        if let (Ok(Some(salt)), true) = (salt, name != lab.name) {
            known.push((salt, format!("lab `{name}`")));
        }
    }
    known
}

/// Compares `practice.json` with what the reference solution gives now.
fn audit_practice(
    audit: &mut Audit,
    files: &dyn Files,
    lab: &Lab,
    staff: &Staff,
) -> Result<(), Failure> {
    let forms = match practice_forms(files, lab, staff, &|| {}) {
        Ok(forms) => forms,
        // the rows of the reference and of the variants say what is wrong with them
        Err(PracticeError::Load(_) | PracticeError::Solution { .. }) => return Ok(()),
    };
    let mut current = vec![lab.practice.clone()];
    for number in 1..forms.len() as u32 {
        let student = practice_student(number);
        let variant = lab.variant_of(PRACTICE_SALT, &student);
        let variant = variant.map_err(LoadError::from)?;
        current.push(Lab::load_variant(files, &lab.name, Some(&variant))?.practice);
    }
    audit.practice(&forms, &current);
    Ok(())
}

/// Tries the variants of so many students, on all cores: no variant knows of another.
fn variants(lab: &Lab, reference: &Folder, salt: &str, students: u32) -> Result<Variants, Failure> {
    let progress = ProgressBar::new(students.into());
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let of_thread = |first: usize| {
        let mut tried = Variants::default();
        for student in (first..students as usize).step_by(threads) {
            if interrupt::asked() {
                break;
            }
            tried.student(lab, reference, salt, &format!("student {}", student + 1));
            progress.inc(1);
        }
        tried
    };
    let all: Vec<Variants> = std::thread::scope(|scope| {
        let start = |first| {
            std::thread::Builder::new()
                .stack_size(STACK_BYTES)
                .spawn_scoped(scope, move || of_thread(first))
        };
        let started: Vec<_> = (0..threads).map(start).collect();
        // a thread that cannot be had is made up for by this one, whose stack is as large
        started
            .into_iter()
            .enumerate()
            .map(|(first, thread)| match thread.map(ScopedJoinHandle::join) {
                Ok(Ok(tried)) => tried,
                _ => of_thread(first),
            })
            .collect()
    });
    progress.finish_and_clear();
    if interrupt::asked() {
        return Err(Failure::interrupted());
    }
    let mut joined = Variants::default();
    for tried in all {
        joined.join(tried);
    }
    Ok(joined)
}

/// A line for everything tried, with what is wrong below it.
fn text(audit: &Audit) -> String {
    let mut out = format!(
        "{}  {} points\n\n",
        audit.lab.bold(),
        points(audit.max_points)
    );
    for (i, row) in audit.rows.iter().enumerate() {
        let is_same = |known: &&Row| known.tried == row.tried && known.problem == row.problem;
        let is_known = row.problem.is_some() && audit.rows[..i].iter().any(|known| is_same(&known));
        push(&mut out, row, is_known);
    }
    if !audit.rooms.is_empty() {
        let _ = writeln!(
            out,
            "\nmargins of the reference in its bands over the variants (0 %: at the edge of full marks, \
             100 %: a band's width inside)"
        );
    }
    for room in &audit.rooms {
        let name = format!("{}: {}", room.task, room.check);
        let (least, greatest) = (100.0 * room.least, 100.0 * room.greatest);
        let _ = writeln!(out, "  {name:<42} {least:>7.1} % to {greatest:.1} %");
    }
    push_relative(&mut out, audit);
    let problems = audit.problems().count();
    let conclusion = match problems {
        0 => "nothing is wrong".green().to_string(),
        1 => "1 problem".red().to_string(),
        _ => format!("{problems} problems").red().to_string(),
    };
    let _ = writeln!(out, "\n{} tried, {conclusion}", audit.rows.len());
    out
}

/// The bands that depend on the reference, as the numbers that they are in the variants.
fn push_relative(out: &mut String, audit: &Audit) {
    let relative = audit.rooms.iter();
    let mut relative = relative
        .filter_map(|room| Some((room, room.relative.as_ref()?)))
        .peekable();
    if relative.peek().is_none() {
        return;
    }
    let _ = writeln!(
        out,
        "\nbands that depend on the reference, over the variants (what it reaches; all points up to; none from)"
    );
    for (room, band) in relative {
        let name = format!("{}: {}", room.task, room.check);
        let range = |[low, high]: [f64; 2]| {
            let [low, high] = [low, high].map(|end| with_unit(end, &band.unit));
            if low == high {
                low
            } else {
                format!("{low} to {high}")
            }
        };
        let _ = writeln!(
            out,
            "  {name:<32} {:<22} {:<22} {}",
            range(band.reference),
            range(band.full),
            range(band.zero)
        );
    }
}

/// `is_known`: a row before has the same problem, which is not said again.
fn push(out: &mut String, row: &Row, is_known: bool) {
    let mark = if row.problem.is_some() {
        "-".red().to_string()
    } else {
        "+".green().to_string()
    };
    let earned = match (row.points, row.max_points) {
        (Some(earned), Some(of)) => format!("{}/{}", points(earned), points(of)),
        _ => String::new(),
    };
    let task = row.task.as_deref().unwrap_or_default();
    let right = match row.tried {
        Tried::Brief => "can be handed out",
        Tried::Starter if row.name.is_empty() => "misses",
        Tried::Starter => "defines what its tasks call",
        Tried::Reference => "full marks",
        Tried::Practice => "is what the reference solution gives",
        Tried::Mutants => "enough of them",
        Tried::Mutant => "loses and is named",
        Tried::Rubric => Audit::rule_in_words(&row.name),
    };
    let comment = match row.problem {
        None => right,
        Some(_) if is_known => "as above",
        Some(_) => "",
    };
    let line = format!(
        "{mark} {:<14} {:<26} {task:<12} {earned:>9}  {comment}",
        row.tried.name(),
        row.name
    );
    let _ = writeln!(out, "{}", line.trim_end());
    if is_known {
        return;
    }
    if let Some(problem) = &row.problem {
        let _ = writeln!(out, "    {problem}");
    }
    if let Some(help) = &row.help {
        let _ = writeln!(out, "    {} {help}", "next:".cyan());
    }
}
