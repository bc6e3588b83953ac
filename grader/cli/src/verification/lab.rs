//! The lab of a report and the course's: the same files, and the variant of the student whose it says it is.

use kinemark_grader::judge::{self, Parts, parts};
use kinemark_grader::lab::practice::PRACTICE_FILE;
use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::record::grade::{Grade, GradeMode, Part};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use kinemark_sim::text::Dimension;

use super::course::Course;
use super::files;
use super::findings::{Difference, Findings, Subject};
use crate::chosen_variant;
use crate::failure::Failure;
use crate::report_folder::{self, Report};

/// What is left out of a comparison without the course's lab, and without the course staff's part.
const LAB: &str = "lab";
pub(super) const REFERENCE: &str = "reference";

/// The lab in which a report can be graded again.
pub(super) struct ComparedLab {
    pub(super) lab: Lab,
    /// The course staff's part, for a graded report.
    pub(super) staff: Option<Staff>,
}

/// The course's lab in the variant of the report; none where the report is of another lab.
///
/// # Errors
/// A lab or a staff part of the course that is broken; copies that cannot be read where the course has no such lab.
pub(super) fn compared(
    report: &Report,
    course: &Course,
    student: Option<&str>,
    findings: &mut Findings,
) -> Result<Option<ComparedLab>, Failure> {
    let name = &report.grade.lab.name;
    let default = match Lab::load(course.labs.as_ref(), name) {
        Ok(lab) => lab,
        Err(LoadError::UnknownLab { .. }) => {
            let why = format!(
                "there is no lab `{name}` in {}; give --labs DIR",
                course.labs.name()
            );
            findings.leave_out(LAB, &why);
            return Ok(Some(of_the_report(report, findings)?));
        }
        Err(error) => return Err(error.into()),
    };
    let variant = report_folder::variant(&report.copies(), name)?;
    let lab = match &variant {
        None => default.clone(),
        Some(own) => match Lab::load_variant(course.labs.as_ref(), name, Some(own)) {
            Ok(lab) => lab,
            // the lab itself is all right
            Err(error) => {
                let now = error.to_string();
                let recorded = "that of the report";
                findings.differ(Difference::of(Subject::Variant, "variant", recorded, &now));
                return Ok(None);
            }
        },
    };
    let is_graded = report.grade.mode == GradeMode::Graded;
    if !is_variant_of_course(&default, &lab, course, (student, is_graded), findings)? {
        return Ok(None);
    }
    let Some(lab) = with_practice_of_report(lab, report, course, findings)? else {
        return Ok(None);
    };
    let now = parts(&lab, None, &report.submission.submission);
    let before = findings.differences.len();
    compare_parts(&report.grade, &now, findings);
    if findings.differences.len() > before {
        files::compare_copies(report, &lab, findings);
        return Ok(None);
    }
    let staff = match report.grade.mode {
        GradeMode::Practice => None,
        GradeMode::Graded => {
            let staff = course.staff_of(&lab)?;
            let left_out = staff.map_err(|why| findings.leave_out(REFERENCE, &why));
            left_out.ok()
        }
    };
    Ok(Some(ComparedLab { lab, staff }))
}

/// The lab of the copies in the report. Of the course staff's part nothing takes part with it: what fits no lab of theirs would be quoted.
fn of_the_report(report: &Report, findings: &mut Findings) -> Result<ComparedLab, Failure> {
    let lab = report_folder::lab_of(report)?;
    let now = parts(&lab, None, &report.submission.submission);
    compare_parts(&report.grade, &now, findings);
    if report.grade.mode == GradeMode::Graded {
        findings.leave_out(REFERENCE, "it is one of the course's lab");
    }
    Ok(ComparedLab { lab, staff: None })
}

/// Compares what the record says it was graded with.
fn compare_parts(recorded: &Grade, now: &Parts, findings: &mut Findings) {
    let mut compare = |kind: Subject, what: &str, recorded: &Part, now: &Part| {
        findings.compare(kind, what, &recorded.name, &now.name);
        findings.compare(kind, what, &recorded.digest, &now.digest);
    };
    compare(Subject::Lab, "lab", &recorded.lab, &now.lab);
    compare(Subject::Robot, "robot", &recorded.robot, &now.robot);
    for (i, scene) in recorded.scenes.iter().enumerate() {
        if let Some(now) = now.scenes.get(i) {
            let what = format!("scene `{}`", scene.name);
            compare(Subject::Scene, &what, scene, now);
        }
    }
    let counts = [&recorded.scenes, &now.scenes].map(|scenes| scenes.len().to_string());
    findings.compare(Subject::Scene, "number of scenes", &counts[0], &counts[1]);
}

/// Whether the parameters of the report are those that the course gives to the student whose they should be; what nobody can say is left
/// out of the comparison.
fn is_variant_of_course(
    default: &Lab,
    lab: &Lab,
    course: &Course,
    (wanted, is_graded): (Option<&str>, bool),
    findings: &mut Findings,
) -> Result<bool, Failure> {
    let named = lab.variant.as_ref().and_then(Variant::student);
    let Some(student) = wanted.or(named) else {
        // course staff grade nobody with numbers that no variant has
        let own = lab.variant.as_ref().filter(|_| is_graded);
        if let Some(Err(error)) = own.map(|own| own.check_drawn(default)) {
            let now = error.to_string();
            let recorded = "parameters of no student";
            findings.differ(Difference::of(Subject::Variant, "variant", recorded, &now));
            return Ok(false);
        }
        if lab.parameters != default.parameters {
            let why = "its variant.toml names no student, so nothing says which parameters it should have";
            findings.leave_out("variant", why);
        }
        return Ok(true);
    };
    let own = if wanted.is_some() {
        // what was asked for has to be possible
        let part = &course.staff.part;
        chosen_variant::of_student(default, course.reference.as_ref(), part, student)?
    } else {
        let Some(salt) = course.salt(&lab.name)? else {
            let why = format!(
                "whether its parameters are those of student `{student}` follows from the course's salt; give --reference DIR or --salt TEXT"
            );
            findings.leave_out("variant", &why);
            return Ok(true);
        };
        default
            .variant_of(&salt, student)
            .map_err(LoadError::from)?
    };
    let own_lab = Lab::load_variant(course.labs.as_ref(), &lab.name, Some(&own))?;
    // the same letters may be written in two ways, of which a variant has one
    let is_named = |named: &str| {
        let drawn = default.variant_of("", named);
        drawn.is_ok_and(|drawn| drawn.student() == own.student())
    };
    if own_lab.parameters == lab.parameters && named.is_some_and(is_named) {
        return Ok(true);
    }
    let words = |lab: &Lab, student: Option<&str>| {
        let parameters = lab.parameters.iter();
        let parameters = parameters.map(|(name, value)| match value {
            Dimension::Number(number) => format!("{name} = {number}"),
            Dimension::List(numbers) => format!("{name} = {numbers:?}"),
            Dimension::Text(text) => format!("{name} = {text}"),
        });
        let whose = student.map_or_else(
            || "no student".to_owned(),
            |student| format!("student `{student}`"),
        );
        let parameters: Vec<String> = parameters.collect();
        format!("of {whose}: {}", parameters.join(", "))
    };
    findings.differ(Difference::of(
        Subject::Variant,
        "variant",
        &words(lab, named),
        &words(&own_lab, own.student()),
    ));
    Ok(false)
}

/// The lab with what the report's copy says of the reference solution in its variant, where the course's lab says nothing of it: a lab
/// that was handed out with a student's variant says that, too. None where the reference solution reaches something else.
fn with_practice_of_report(
    lab: Lab,
    report: &Report,
    course: &Course,
    findings: &mut Findings,
) -> Result<Option<Lab>, Failure> {
    let path = format!("{}/{PRACTICE_FILE}", lab.name);
    // what is a link, or no text, is found among the files
    let text = report.copies().read(&path).ok().flatten();
    let (Some(variant), Some(text)) = (&lab.variant, text) else {
        return Ok(Some(lab));
    };
    if !lab.practice.is_empty() {
        return Ok(Some(lab));
    }
    let labs = course.labs.as_ref();
    let handed_out = HandedOut { labs, path, text };
    let given = Lab::load_variant(&handed_out, &lab.name, Some(variant))?;
    if given.practice.is_empty() {
        return Ok(Some(lab));
    }
    match course.staff_of(&lab)? {
        Ok(staff) => {
            let reached = judge::practice(&lab, &staff);
            if reached.is_ok_and(|reached| reached == given.practice) {
                return Ok(Some(given));
            }
            findings.differ(Difference::of(
                Subject::Lab,
                &format!("what {PRACTICE_FILE} says of the reference solution"),
                "other values or paths",
                "what the reference solution reaches in this variant",
            ));
            Ok(None)
        }
        Err(why) => {
            let what =
                format!("what {PRACTICE_FILE} says of the reference solution in this variant");
            findings.leave_out(&what, &why);
            Ok(Some(given))
        }
    }
}

/// The course's labs with one file of the report's in the place of theirs.
struct HandedOut<'l> {
    labs: &'l dyn Files,
    path: String,
    text: String,
}

impl Files for HandedOut<'_> {
    fn name(&self) -> String {
        self.labs.name()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        if path == self.path {
            return Ok(Some(self.text.as_bytes().to_owned()));
        }
        self.labs.bytes(path)
    }

    fn list(&self, folder: &str) -> Vec<String> {
        self.labs.list(folder)
    }
}
