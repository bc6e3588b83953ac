//! `kinemark lab pack`: a lab as one archive, for students, for course staff or for Gradescope.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::course_text;
use kinemark_course::fixed_zip::{ArchiveFile, archive};
use kinemark_course::pack::secrets::Secrets;
use kinemark_course::pack::{self, Autograder, PackError, PackedLab};
use kinemark_course::public::public_part;
use kinemark_course::roster::Roster;
use kinemark_course::student::StudentId;
use kinemark_grader::judge::practice;
use kinemark_grader::lab::Practice;
use kinemark_grader::lab::copies::Copies;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::quantity::points;
use serde::Serialize;

use crate::disk::{self, Folder, plain};
use crate::error_record::ErrorCode;
use crate::failure::{self, BROKEN, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};
use crate::{chosen_variant, enclosing_course, output};

/// Pack a lab to hand out: for course staff
#[derive(Debug, Clone, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab pack 01-kinematics --for students\n  \
    kinemark lab pack 01-kinematics --for students --roster roster.csv\n  \
    kinemark lab pack 01-kinematics --for students --with-solution\n  \
    kinemark lab pack 01-kinematics --for staff --out colleagues.zip\n  \
    kinemark lab pack 01-kinematics --for gradescope --binary kinemark-linux\n\n\
    For students: a folder in which `kinemark grade` works at once, without anything of the course staff's part; it is searched for \
    the salt and for lines of the solution before it is written. For staff: the lab with all of the course staff's part. For \
    gradescope: the archive to upload as an autograder.\n\
    The same files give the same bytes. See docs/hand-out.md.\n\
    Exit codes: 0 written, 2 usage, 3 the lab is broken or students would get what they must not, 4 it cannot be written."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// Who gets it
    #[arg(long = "for", value_name = "WHO", value_enum)]
    pub(crate) audience: Audience,
    /// File to write [default: LAB-WHO.zip]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
    /// For students: a folder with this student's variant; may be given more than once
    #[arg(long, value_name = "ID")]
    pub(crate) student: Vec<String>,
    /// For students: a folder for everybody on the roster. For gradescope: grade each student with their own variant
    #[arg(long, value_name = "FILE", conflicts_with = "student")]
    pub(crate) roster: Option<PathBuf>,
    /// For students, after the due date: with the reference solution
    #[arg(long)]
    pub(crate) with_solution: bool,
    /// For students: pack although lines of the solution are in what they get
    #[arg(long)]
    pub(crate) allow_shared_lines: bool,
    /// For gradescope: show students the points of hidden cases at each upload
    #[arg(long)]
    pub(crate) hidden_at_upload: bool,
    /// For gradescope: the kinemark to pack, built for Linux on x86-64 [default: this one]
    #[arg(long, value_name = "FILE")]
    pub(crate) binary: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) staff: StaffPart,
}

/// Who gets a pack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Audience {
    /// Students: nothing of the course staff's part
    Students,
    /// Colleagues: all of it
    Staff,
    /// Gradescope: an autograder
    Gradescope,
}

impl Audience {
    fn name(self) -> &'static str {
        match self {
            Self::Students => "students",
            Self::Staff => "staff",
            Self::Gradescope => "gradescope",
        }
    }
}

/// A program larger than this is something else.
const MOST_BINARY_BYTES: u64 = 1 << 30;

/// What was written, for programs.
#[derive(Serialize)]
struct Written<'a> {
    written: &'a Path,
    lab: &'a str,
    r#for: &'static str,
    bytes: usize,
    files: Vec<&'a str>,
}

/// Makes the archive, writes it, prints what it is for.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let mut args = args.clone();
    let filled = enclosing_course::fill(&args.lab, &mut args.labs_folder, &mut args.staff)?;
    if let Some(filled) = filled {
        failure::note_in_words(&filled.note);
    }
    let args = &args;
    refuse_others_options(args)?;
    let name = format!("{}-{}.zip", args.lab, args.audience.name());
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from(name));
    if out.exists() && !args.force {
        return Err(Failure::usage(
            format!("`{}` already exists", out.display()),
            "name another file with --out, or replace it with --force",
        )
        .coded(ErrorCode::Exists));
    }
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    let help = "give the folder that holds LAB/solution.rhai";
    let reference = staff_folder::part(&args.staff, labs_folder.as_deref(), help)?;
    let packed = PackedLab {
        files: files.as_ref(),
        lab: &lab,
    };
    let content = match args.audience {
        Audience::Students => for_students(args, packed, reference.as_ref())?,
        Audience::Staff => {
            let reference = required(reference.as_ref())?;
            pack::for_staff(packed, reference, args.staff.salt()).map_err(failed)?
        }
        Audience::Gradescope => for_gradescope(args, packed, required(reference.as_ref())?)?,
    };
    let help = "free some space, or name another place with --out";
    let bytes = archive(&content).map_err(|error| output::unwritten(&out, &error, help))?;
    match args.audience {
        Audience::Students => output::write_file(&out, &bytes, help)?,
        // it holds the solution and the salt
        Audience::Staff | Audience::Gradescope => output::write_private_file(&out, &bytes, help)?,
    }
    if args.json {
        output::print_formatted(&Written {
            written: &out,
            lab: &lab.name,
            r#for: args.audience.name(),
            bytes: bytes.len(),
            files: content.iter().map(|file| file.path.as_str()).collect(),
        })?;
    } else {
        output::print(&text(args, &out, &lab, content.len(), bytes.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses options that mean nothing for whoever gets the pack.
fn refuse_others_options(args: &Args) -> Result<(), Failure> {
    use Audience::{Gradescope, Students};
    let given: [(bool, &str, &[Audience]); 6] = [
        (!args.student.is_empty(), "--student", &[Students]),
        (args.roster.is_some(), "--roster", &[Students, Gradescope]),
        (args.with_solution, "--with-solution", &[Students]),
        (args.allow_shared_lines, "--allow-shared-lines", &[Students]),
        (args.hidden_at_upload, "--hidden-at-upload", &[Gradescope]),
        (args.binary.is_some(), "--binary", &[Gradescope]),
    ];
    for (is_given, option, audiences) in given {
        if is_given && !audiences.contains(&args.audience) {
            let known: Vec<&str> = audiences.iter().map(|audience| audience.name()).collect();
            return Err(Failure::usage(
                format!("{option} means nothing with --for {}", args.audience.name()),
                &format!("leave it out, or use --for {}", known.join(" or --for ")),
            ));
        }
    }
    Ok(())
}

fn required(reference: Option<&Folder>) -> Result<&Folder, Failure> {
    reference.ok_or_else(|| {
        Failure::usage(
            "the course staff's part was not found: there is no folder `reference` beside the labs"
                .to_owned(),
            "give its folder with --reference DIR",
        )
    })
}

fn for_students(
    args: &Args,
    packed: PackedLab<'_>,
    reference: Option<&Folder>,
) -> Result<Vec<ArchiveFile>, Failure> {
    let lab = packed.lab;
    let mut variants = Vec::new();
    for student in students(args)? {
        let variant = chosen_variant::of_student(lab, reference, &args.staff, student.as_str())?;
        let mut variant = Lab::load_variant(packed.files, &lab.name, Some(&variant))?;
        if let Some(reference) = reference {
            variant.practice = own_practice(&variant, reference, args.staff.salt())?;
        }
        variants.push(variant);
    }
    let solution = match args.with_solution {
        true => pack::solution(required(reference)?, &lab.name).map_err(failed)?,
        false => Vec::new(),
    };
    let content = pack::for_students(packed, &variants, &solution).map_err(failed)?;
    let mut salts: Vec<String> = args.staff.salt().map(str::to_owned).into_iter().collect();
    let secrets = match reference {
        Some(reference) => {
            salts.extend(Staff::salt(reference, &lab.name, None)?);
            Secrets::of(reference, &lab.name, salts)
        }
        None => {
            failure::warn_in_words(
                "the course staff's part was not found, so the archive was not searched for lines of the solution",
                "give its folder with --reference DIR",
            );
            Secrets::of(&Copies::default(), &lab.name, salts)
        }
    };
    let secrets = secrets.map_err(failed)?;
    if reference.is_some() && !secrets.has_solution() {
        failure::warn_in_words(
            &format!(
                "the course staff's part has no solution of lab `{}`, so the archive was not searched for its lines",
                lab.name
            ),
            "check the folder that --reference names",
        );
    }
    secrets.refuse_salts(&content).map_err(failed)?;
    if args.with_solution {
        failure::note_in_words(
            "students get the reference solution: hand this out after the due date",
        );
        return Ok(content);
    }
    let lines = secrets.shared_lines(&content);
    match (lines.is_empty(), args.allow_shared_lines) {
        (true, _) => {}
        (false, false) => return Err(failed(PackError::Solution { lines })),
        (false, true) => failure::warn_in_words(
            &format!("students get {} lines of the solution", lines.len()),
            &format!("the first: {}", lines[0]),
        ),
    }
    Ok(content)
}

/// What a student gets of the reference solution in their own variant; nothing where there is no solution.
fn own_practice(lab: &Lab, reference: &Folder, salt: Option<&str>) -> Result<Practice, Failure> {
    match Staff::load_for_student(reference, lab, salt)? {
        Some(staff) => practice(lab, &staff)
            .map_err(|why| Failure::broken(why.to_string(), "correct `solution.rhai`")),
        None => Ok(lab.practice.clone()),
    }
}

/// The students whose variants are packed; none where everybody gets the same.
fn students(args: &Args) -> Result<Vec<StudentId>, Failure> {
    if let Some(path) = &args.roster {
        let roster = roster(path)?;
        return Ok(roster
            .people()
            .iter()
            .map(|person| person.id.clone())
            .collect());
    }
    let mut students: Vec<StudentId> = Vec::new();
    for typed in &args.student {
        let id = StudentId::new(typed)
            .map_err(|why| Failure::usage(why, "write the id as the course writes it"))?;
        if students.iter().any(|known| known.folded() == id.folded()) {
            return Err(Failure::usage(
                format!("student `{id}` is named twice"),
                "name each student once",
            ));
        }
        students.push(id);
    }
    Ok(students)
}

fn roster(path: &Path) -> Result<Roster, Failure> {
    let shown = path.display().to_string();
    let bytes = course_text::read(path).map_err(|why| {
        Failure::usage(
            format!("`{shown}`: {why}"),
            "name the file with the students, a line each",
        )
    })?;
    Roster::parse(&shown, &bytes).map_err(|error| Failure::diagnostic(BROKEN, error))
}

fn for_gradescope(
    args: &Args,
    packed: PackedLab<'_>,
    reference: &Folder,
) -> Result<Vec<ArchiveFile>, Failure> {
    let lab = packed.lab;
    let salt = args.staff.salt();
    // a broken part is reported now, and not by every upload
    let Some(staff) = staff_folder::staff(reference, lab, salt)? else {
        return Err(Failure::usage(
            staff_folder::no_solution(reference, lab),
            "give the course staff's folder with --reference DIR",
        ));
    };
    let own = Staff::salt(reference, &lab.name, salt)?;
    if let Some(what) = public_part(staff.solution.text().as_bytes(), own.as_deref()) {
        failure::warn_in_words(
            &format!(
                "the {what} of lab `{}` is public, so its hidden cases are not hidden",
                lab.name
            ),
            "choose a salt of your own with --salt, and change the lab before you grade with it",
        );
    }
    let roster = args.roster.as_deref().map(roster).transpose()?;
    if roster.is_some() && lab.variants.is_empty() {
        return Err(Failure::usage(
            format!(
                "lab `{}` has no variants: all students have the same parameters",
                lab.name
            ),
            "leave --roster out",
        ));
    }
    let path = match &args.binary {
        Some(path) => path.clone(),
        None => std::env::current_exe().map_err(|error| {
            Failure::fault(
                format!("this program's own file cannot be found: {}", plain(&error)),
                "name it with --binary FILE",
            )
        })?,
    };
    let binary = disk::read_bytes(&path, "a program", MOST_BINARY_BYTES)?;
    let with = Autograder {
        reference,
        salt,
        roster: roster.as_ref(),
        hidden_at_upload: args.hidden_at_upload,
        binary: (&path.display().to_string(), &binary),
    };
    pack::autograder(packed, with).map_err(failed)
}

fn failed(error: PackError) -> Failure {
    Failure::diagnostic(BROKEN, error)
}

fn text(args: &Args, out: &Path, lab: &Lab, files: usize, bytes: usize) -> String {
    let next = match args.audience {
        Audience::Students if args.student.is_empty() && args.roster.is_none() => format!(
            "Give it to students. They unpack it and, in the folder `{}`, run `kinemark grade {} submission.rhai`.",
            lab.name, lab.name
        ),
        Audience::Students => {
            "It has a folder for each student, called by the id. Give each student theirs."
                .to_owned()
        }
        Audience::Staff => {
            "It holds the solution, the hidden cases and the salt: do not give it to students."
                .to_owned()
        }
        Audience::Gradescope => format!(
            "Upload it under Configure Autograder, with {} points for the assignment. It holds the solution and the salt: do not \
             give it to students.",
            points(lab.tasks.iter().map(|task| task.max_points()).sum())
        ),
    };
    format!(
        "wrote {}: {files} files, {} kB\n{next}\n",
        output::path(out),
        bytes.div_ceil(1000)
    )
}
