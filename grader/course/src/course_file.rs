//! `course.toml`: the labs of a course with their digests, and the rules by which hand-ins become grades.

use std::path::PathBuf;

use jiff::Timestamp;
use kinemark_grader::task::problem::problems;
use kinemark_sim::text::schema::schema_of;
use kinemark_sim::text::{FileFormat, Source, Spanned};
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use crate::course_text::{TextError, refuse, tables};

/// Its name in the course's folder.
pub const COURSE_FILE: &str = "course.toml";

problems! {
    /// What is wrong with `course.toml`.
    enum CourseProblem {
        NoLabs:
            "course::no_labs", "a course needs at least one lab", "no [[labs]]", "add a [[labs]] table with a name and a digest";
        LabTwice { name: String }:
            "course::duplicate", "lab `{name}` is there twice", "the second one", "keep one of the two";
        BadLab { name: String }:
            "course::lab_name", "{name:?} is no name of a lab", "this name", "use the name of its folder, such as 01-kinematics";
        Weight { weight: f64 }:
            "course::weight", "a weight is a finite number of at least 0, got {weight}", "out of range",
            "leave it out to count a lab by its points";
        NoZone { typed: String }:
            "course::time", "`{typed}` has no time zone", "a time without an offset",
            "write the offset from UTC, such as 2026-11-30T23:59:00+01:00";
        Time { typed: String }:
            "course::time", "`{typed}` is not a point in time", "this time", "write it such as 2026-11-30T23:59:00+01:00";
        EmptyTitle:
            "course::title", "the title is empty", "no words", "it heads the page of the class";
    }
}

/// Which of a student's attempts counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Attempts {
    /// The latest.
    #[default]
    Last,
    /// The one with the most points; the latest among equals.
    Best,
    /// The earliest.
    First,
}

/// A lab of the course.
#[derive(Debug, Clone, PartialEq)]
pub struct CourseLab {
    /// The name of its folder.
    pub name: String,
    /// The digest of its files that students were given; none until `course check` has shown it.
    pub digest: Option<String>,
    /// Which attempt counts.
    pub attempts: Attempts,
    /// How much it counts in the course: its share of points is multiplied by this. Its points where it is not given.
    pub weight: Option<f64>,
    /// Later hand-ins are marked as late; points are never reduced for it.
    pub due: Option<Timestamp>,
    /// Whether each student has a variant of their own, where the lab has variants.
    pub variants: bool,
}

/// The course.
#[derive(Debug, Clone, PartialEq)]
pub struct CourseFile {
    /// Its title.
    pub title: String,
    /// The engine that grades, as `kinemark --version` prints it; whichever runs where it is not given.
    pub engine: Option<String>,
    /// The roster, seen from the course's folder.
    pub roster: PathBuf,
    /// The file that holds the salt, seen from the course's folder; the salts of the labs' `hidden.toml` where it is not given.
    pub salt_file: Option<PathBuf>,
    /// The folder of labs, seen from the course's folder.
    pub labs_folder: Option<PathBuf>,
    /// The course staff's folder, seen from the course's folder.
    pub reference: Option<PathBuf>,
    /// Whether labs whose solutions are public may be graded: those of Kinemark's repository.
    pub public_solutions: bool,
    /// The labs, in order.
    pub labs: Vec<CourseLab>,
    /// Its text.
    pub source: Source,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CourseTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// Its title, which heads the page of the class.
    title: Spanned<String>,
    /// The engine that grades, as `kinemark --version` prints it; whichever runs where it is left out.
    engine: Option<String>,
    /// The roster, seen from the course's folder; `roster.csv` where it is left out.
    #[serde(default = "default_roster")]
    roster: PathBuf,
    /// The file that holds the salt, seen from the course's folder; the salts of the labs' `hidden.toml` where it is left out.
    salt_file: Option<PathBuf>,
    /// The folder of labs, seen from the course's folder.
    labs_folder: Option<PathBuf>,
    /// The course staff's folder, seen from the course's folder.
    reference: Option<PathBuf>,
    /// Whether labs whose solutions are public may be graded: those of Kinemark's repository; false where it is left out.
    #[serde(default)]
    public_solutions: bool,
    /// The labs, in order.
    #[serde(default)]
    labs: Vec<LabTable>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LabTable {
    /// The name of its folder.
    name: Spanned<String>,
    /// The digest of its files that students were given, as `course check` prints it.
    digest: Option<String>,
    /// Which attempt counts; the last where it is left out.
    #[serde(default)]
    attempts: Attempts,
    /// How much it counts in the course: its share of points is multiplied by this; its points where it is left out.
    weight: Option<Spanned<f64>>,
    /// Later hand-ins are marked as late: a time with its offset from UTC.
    #[schemars(with = "Option<String>")]
    due: Option<Spanned<toml::value::Datetime>>,
    /// Whether each student has a variant of their own, where the lab has variants; true where it is left out.
    variants: Option<bool>,
}

fn default_roster() -> PathBuf {
    PathBuf::from("roster.csv")
}

impl CourseFile {
    /// The JSON schema of a `course.toml`.
    pub fn schema() -> Schema {
        schema_of::<CourseTable>("A course of Kinemark")
    }

    /// Reads a `course.toml`.
    ///
    /// # Errors
    /// What is wrong in it, with its place.
    pub fn parse(source: Source) -> Result<Self, TextError> {
        let table: CourseTable = tables(&source)?;
        if table.title.get_ref().trim().is_empty() {
            return refuse(&source, table.title.span(), CourseProblem::EmptyTitle);
        }
        if table.labs.is_empty() {
            return refuse(&source, 0..0, CourseProblem::NoLabs);
        }
        let mut labs: Vec<CourseLab> = Vec::new();
        for lab in table.labs {
            let lab = checked(&source, &labs, lab)?;
            labs.push(lab);
        }
        Ok(Self {
            title: table.title.into_inner(),
            engine: table.engine,
            roster: table.roster,
            salt_file: table.salt_file,
            labs_folder: table.labs_folder,
            reference: table.reference,
            public_solutions: table.public_solutions,
            labs,
            source,
        })
    }

    /// The lab called `name`.
    pub fn lab(&self, name: &str) -> Option<&CourseLab> {
        self.labs.iter().find(|lab| lab.name == name)
    }
}

fn checked(source: &Source, known: &[CourseLab], lab: LabTable) -> Result<CourseLab, TextError> {
    let name = lab.name.get_ref();
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if name.is_empty() || !name.chars().all(plain) {
        let name = name.clone();
        return refuse(source, lab.name.span(), CourseProblem::BadLab { name });
    }
    if known.iter().any(|known| known.name == *name) {
        let name = name.clone();
        return refuse(source, lab.name.span(), CourseProblem::LabTwice { name });
    }
    if let Some(typed) = &lab.weight {
        let weight = *typed.get_ref();
        if !(weight.is_finite() && weight >= 0.0) {
            return refuse(source, typed.span(), CourseProblem::Weight { weight });
        }
    }
    let due = lab.due.map(|typed| instant(source, &typed)).transpose()?;
    Ok(CourseLab {
        name: lab.name.into_inner(),
        digest: lab.digest,
        attempts: lab.attempts,
        weight: lab.weight.map(Spanned::into_inner),
        due,
        variants: lab.variants.unwrap_or(true),
    })
}

pub(crate) fn instant(
    source: &Source,
    typed: &Spanned<toml::value::Datetime>,
) -> Result<Timestamp, TextError> {
    let text = typed.get_ref().to_string();
    if typed.get_ref().offset.is_none() {
        return refuse(source, typed.span(), CourseProblem::NoZone { typed: text });
    }
    match text.parse() {
        Ok(instant) => Ok(instant),
        Err(_) => refuse(source, typed.span(), CourseProblem::Time { typed: text }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<CourseFile, TextError> {
        CourseFile::parse(Source::new(COURSE_FILE, text))
    }

    const SHORT: &str = "format = 1\ntitle = \"Robots\"\n\n[[labs]]\nname = \"01-kinematics\"\n";

    #[test]
    fn a_short_course_has_the_defaults() {
        let course = parse(SHORT).unwrap();
        assert_eq!(course.roster, PathBuf::from("roster.csv"));
        let lab = course.lab("01-kinematics").unwrap();
        assert_eq!(
            (lab.attempts, lab.weight, lab.due),
            (Attempts::Last, None, None)
        );
        assert!(lab.variants && !course.public_solutions);
    }

    #[test]
    fn a_due_time_is_a_point_in_time() {
        let course = parse(&format!("{SHORT}due = 2026-11-30T23:59:00+01:00\n")).unwrap();
        let due = course.labs[0].due.unwrap();
        assert_eq!(due, "2026-11-30T22:59:00Z".parse().unwrap());
    }

    #[test]
    fn mistakes_are_refused_at_their_place() {
        for (more, line, part) in [
            ("due = 2026-11-30T23:59:00\n", 6, "has no time zone"),
            ("due = 2026-11-30\n", 6, "has no time zone"),
            ("weight = -1.0\n", 6, "a weight is"),
            ("atempts = \"last\"\n", 6, "unknown key `atempts`"),
            ("attempts = \"worst\"\n", 6, "unknown value `worst`"),
            ("[[labs]]\nname = \"01-kinematics\"\n", 7, "is there twice"),
            ("[[labs]]\nname = \"../x\"\n", 7, "no name of a lab"),
        ] {
            let error = parse(&format!("{SHORT}{more}")).unwrap_err();
            assert!(error.to_string().contains(part), "{more}: {error}");
            assert_eq!(error.line_and_column().0, line, "{more}");
        }
        assert!(
            parse("format = 1\ntitle = \"R\"\n")
                .unwrap_err()
                .to_string()
                .contains("at least one lab")
        );
    }
}
