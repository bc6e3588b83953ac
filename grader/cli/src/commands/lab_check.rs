//! `kinemark lab check`: what is wrong with the grader of a lab, before a student meets it.

use std::path::PathBuf;
use std::process::ExitCode;

use crate::bands_page::BandsPage;
use kinemark_course::language::Language;
use kinemark_grader::audit::{Accepted, Audit, Form, PracticeError, Rubric, Variants};
use kinemark_grader::judge::engine;
use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::practice::{PRACTICE_SALT, PracticeForm, practice_student};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use kinemark_grader::task::problem::LoadError;
use kinemark_report::formula::formula_problems;
use kinemark_sim::text::Source;

use super::lab_mutate::{self, MutateArgs};
use crate::disk::Folder;
use crate::failure::{self, Failure, LOST};
use crate::lab_check_text::text;
use crate::lab_tries::{Extent, Tries, left_out, staff_of};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};
use crate::{output, pool};

/// Check a lab: its starter loses points, its reference solution gets full marks, and every mutant loses points and is named
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab check 01-kinematics\n  kinemark lab check 01-kinematics --salts 40 --json\n  \
    kinemark lab check 02-jacobian-velocity --variants 200 --page bands.html\n  kinemark lab check 01-kinematics --quick\n  \
     kinemark lab check 01-kinematics --mutate\n  kinemark lab check 01-kinematics --mutate --keep 17 --as sine-for-cosine\n\n\
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
    /// Look at less: 3 variants and 2 of their corners, 1 other salt, and neither `practice.json` nor the accuracy of the simulation
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) mutate: MutateArgs,
    /// Number of things done at once [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
    /// Write a page with a plot of every band, and what the reference solution and the mutants reach in it
    #[arg(long, value_name = "FILE.html")]
    pub(crate) page: Option<PathBuf>,
    /// Print what was tried as JSON
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
    let from = StaffPart::in_folder(args.reference.clone());
    let help = "give the course staff's folder";
    let reference = staff_folder::part(&from, labs_folder.as_deref(), help)?.ok_or_else(|| {
        Failure::usage(
            "there is no folder `reference` beside the labs".to_owned(),
            "a lab is checked with the course staff's part: give its folder with --reference DIR",
        )
    })?;
    let own = staff_of(&reference, &lab, None)?;
    // another option that conflicts with --mutate would hide that these need it
    if !args.mutate.mutate && args.mutate.is_given() {
        return Err(Failure::usage(
            "--draw, --keep and --as are about the changes of the solution".to_owned(),
            "add --mutate, which tries nothing else: leave --quick, --salts, --variants and --page out",
        ));
    }
    if args.mutate.mutate {
        let output = (args.json, args.jobs.map(usize::from));
        return lab_mutate::run(&args.mutate, output, (&lab, &own), &reference);
    }
    let audit = audited(args, files.as_ref(), (&lab, &own), &reference)?;
    show(args, &audit)?;
    let bad = audit.problems().next().is_some();
    Ok(ExitCode::from(if bad { LOST } else { 0 }))
}

/// Everything that is tried, and what it shows, one row after the other.
fn audited(
    args: &Args,
    files: &dyn Files,
    (lab, own): (&Lab, &Staff),
    reference: &Folder,
) -> Result<Audit, Failure> {
    let starter = labs_folder::text(files, &lab.name, "starter.rhai")?;
    let starter = Source::new("starter.rhai", starter);
    let path = format!("{}/brief.md", lab.name);
    let brief = files
        .read(&path)
        .map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))?;

    let form = Form::new(lab, own);
    let tried = Tries {
        lab,
        form: &form,
        reference,
        salt: Staff::salt(reference, &lab.name, None)?.unwrap_or_default(),
        starter: &starter,
        jobs: args.jobs.map_or_else(pool::default_jobs, usize::from),
    };
    let extent = Extent::of(lab, own, (args.salts, args.variants), args.quick)?;
    let all = tried.all(&extent)?;

    let mut audit = Audit::new(lab);
    let formulas = brief.as_deref().map(formula_problems).unwrap_or_default();
    let formula = formulas.first().map(ToString::to_string);
    audit.brief(
        lab,
        brief.as_deref(),
        formula.as_deref(),
        &files.list(&lab.name),
    );
    let starter_grade = audit.take(all.starter);
    audit_other_starters(&mut audit, files, reference, lab)?;
    let reference_grade = audit.take(all.reference);
    if let Some(grade) = &reference_grade {
        audit.measure_reference(grade);
    }
    audit_practice(&mut audit, files, lab, all.practice)?;
    audit.draws(all.draws);
    if let Some(variants) = all.variants {
        audit.variants(variants);
    }
    audit.count_mutants(own);
    let mut mutants = Vec::new();
    for (mutant, found) in own.mutants.iter().zip(all.mutants) {
        if let Some(grade) = audit.take(found) {
            audit.measure_mutant(&mutant.name, &grade);
            mutants.push(grade);
        }
    }
    let graded = Graded {
        starter: starter_grade,
        zeros: all.zeros,
        played_back: all.played_back,
        reference: reference_grade,
        finer: all.finer,
        mutants,
        corners: all.corners,
    };
    audit_rubric(&mut audit, reference, (lab, own), brief.as_deref(), &graded)?;
    if args.quick {
        audit.left_out = left_out();
    }
    Ok(audit)
}

/// Writes the page of the bands, where one is asked for, and prints the audit.
fn show(args: &Args, audit: &Audit) -> Result<(), Failure> {
    if let Some(file) = &args.page {
        let page = BandsPage {
            engine: &engine(),
            audit,
        };
        let help = "give another file with --page FILE.html";
        output::write_file(file, page.html().as_bytes(), help)?;
    }
    if args.json {
        output::print_formatted(audit)
    } else {
        output::print_lines(&text(audit))
    }
}

/// Looks into the starters of other languages, where there are any.
fn audit_other_starters(
    audit: &mut Audit,
    files: &dyn Files,
    reference: &Folder,
    lab: &Lab,
) -> Result<(), Failure> {
    for language in [Language::Python, Language::Rust, Language::C] {
        let path = format!("{}/{}", lab.name, language.starter());
        let text = files.read(&path);
        let text = text.map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))?;
        if let Some(text) = text {
            let defines = |name: &str| language.defines(&text, name);
            audit.compiled_starter(lab, language.starter(), &defines);
            let solution = match language {
                Language::Rust => "rust/src/lib.rs".to_owned(),
                other => other.starter().replace("starter", "solution"),
            };
            let solution = reference.read(&format!("{}/{solution}", lab.name));
            if let Ok(Some(solution)) = solution {
                audit.starter_beside_solution(language.starter(), &text, &solution);
            }
        }
    }
    Ok(())
}

/// What was graded on the way, as far as it came to a grade.
struct Graded {
    starter: Option<Grade>,
    zeros: Option<Grade>,
    played_back: Option<Grade>,
    reference: Option<Grade>,
    finer: Option<Grade>,
    mutants: Vec<Grade>,
    corners: Option<Variants>,
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
    let moved_bodies = Form::new(lab, staff).moved_bodies();
    let known_salts = known_salts(reference, lab);
    let rubric = Rubric {
        lab,
        staff,
        salt: salt.as_deref(),
        known_salts: &known_salts,
        brief,
        starter: graded.starter.as_ref(),
        zeros: graded.zeros.as_ref(),
        played_back: graded.played_back.as_ref(),
        reference: graded.reference.as_ref(),
        finer: graded.finer.as_ref(),
        mutants: &graded.mutants,
        moved_bodies: &moved_bodies,
        margins: &margins,
        corners: graded.corners.as_ref(),
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
    found: Vec<Result<PracticeForm, PracticeError>>,
) -> Result<(), Failure> {
    let mut forms = Vec::new();
    for form in found {
        // the rows of the reference and of the variants say what is wrong with them
        let Ok(form) = form else { return Ok(()) };
        let is_nothing = form.tasks.is_empty();
        forms.push(form);
        if is_nothing && forms.len() == 1 {
            break;
        }
    }
    if forms.is_empty() {
        return Ok(());
    }
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
