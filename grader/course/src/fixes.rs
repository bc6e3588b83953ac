//! `fixes.toml`: what people decided, with why and by whom. The program reads it and never writes it.

use jiff::Timestamp;
use kinemark_grader::task::problem::problems;
use kinemark_sim::text::{FileFormat, Source, Spanned};
use serde::Deserialize;

use crate::course_text::{TextError, refuse, tables};
use crate::student::StudentId;

/// Its name in the course's folder.
pub const FIXES_FILE: &str = "fixes.toml";

problems! {
    /// What is wrong with `fixes.toml`.
    enum FixProblem {
        Student { why: String }:
            "fixes::student", "{why}", "this id", "write the id as roster.csv has it";
        NoWhy:
            "fixes::why", "a fix says why", "no words", "write a sentence that explains it a year from now";
        NoBy:
            "fixes::by", "a fix says by whom", "nobody", "write your name or your login";
        PointsAndAdd:
            "fixes::points", "points are either set or added", "this fix", "keep `points` or `add`";
        NoPoints:
            "fixes::points", "points by hand need a number", "this fix", "add `points = 3.0`, or `add = 0.5`";
        Number { value: f64 }:
            "fixes::points", "points are a finite number, got {value}", "out of range";
        Below { value: f64 }:
            "fixes::points", "points are not below 0, got {value}", "out of range", "use `add` to take points away";
        Twice { what: String }:
            "fixes::duplicate", "{what} is decided twice", "the second one", "keep one of the two";
        Group:
            "fixes::student", "a file belongs to somebody, or to nobody", "this fix",
            "add `student = \"ID\"`, or `ignore = true`";
        Both:
            "fixes::student", "a file that is ignored belongs to nobody", "this fix", "keep `student` or `ignore`";
    }
}

/// The digest by which a file of a source is known later: its path may have a name in it, and names stand in the roster alone.
pub fn place(lab: &str, path: &str) -> String {
    let mut hasher = blake3::Hasher::new_derive_key("kinemark 2026 path in a source v1");
    hasher.update(&(lab.len() as u64).to_le_bytes());
    hasher.update(lab.as_bytes());
    hasher.update(path.as_bytes());
    hasher.finalize().to_hex()[..32].to_owned()
}

/// A decision about a file of a hand-in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileFix {
    /// The lab.
    pub lab: String,
    /// The file or folder, as `course status` shows it.
    pub path: String,
    /// Whose it is; `None` where it is ignored.
    pub student: Option<StudentId>,
}

impl FileFix {
    /// The digest of its path ([`place`]).
    pub fn place(&self) -> String {
        place(&self.lab, &self.path)
    }
}

/// Points given by hand.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsFix {
    /// Whose.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// `TASK/CHECK`, or `None` for the lab's total.
    pub check: Option<String>,
    /// What is done to the points.
    pub change: PointsChange,
    /// The key of the record that it was decided on; where another record counts, the fix is marked as stale.
    pub record: Option<String>,
    /// Why.
    pub why: String,
    /// By whom.
    pub by: String,
}

/// What is done to points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PointsChange {
    /// They are set.
    Set(f64),
    /// They are added to.
    Add(f64),
}

/// A lab that does not count for a student.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excuse {
    /// Who.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// Why.
    pub why: String,
    /// By whom.
    pub by: String,
}

/// Another due time for a student.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extension {
    /// Who.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// Hand-ins up to then are not late.
    pub due: Timestamp,
}

/// All decisions, in the order of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Fixes {
    /// Whose files are.
    pub files: Vec<FileFix>,
    /// Points by hand.
    pub points: Vec<PointsFix>,
    /// Labs that do not count.
    pub excuses: Vec<Excuse>,
    /// Other due times.
    pub extensions: Vec<Extension>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FixesTable {
    #[serde(rename = "format")]
    _format: FileFormat,
    #[serde(default)]
    files: Vec<Spanned<FileTable>>,
    #[serde(default)]
    points: Vec<Spanned<PointsTable>>,
    #[serde(default)]
    excused: Vec<Spanned<ExcuseTable>>,
    #[serde(default)]
    extensions: Vec<Spanned<ExtensionTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileTable {
    lab: String,
    path: String,
    student: Option<Spanned<String>>,
    #[serde(default)]
    ignore: bool,
    why: Spanned<String>,
    by: Spanned<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointsTable {
    student: Spanned<String>,
    lab: String,
    check: Option<String>,
    points: Option<Spanned<f64>>,
    add: Option<Spanned<f64>>,
    record: Option<String>,
    why: Spanned<String>,
    by: Spanned<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ExcuseTable {
    student: Spanned<String>,
    lab: String,
    why: Spanned<String>,
    by: Spanned<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ExtensionTable {
    student: Spanned<String>,
    lab: String,
    due: Spanned<toml::value::Datetime>,
    why: Spanned<String>,
    by: Spanned<String>,
}

impl Fixes {
    /// Reads a `fixes.toml`.
    ///
    /// # Errors
    /// What is wrong in it, with its place.
    pub fn parse(source: &Source) -> Result<Self, TextError> {
        let table: FixesTable = tables(source)?;
        let reading = Reading { source };
        let mut fixes = Self::default();
        for at in &table.files {
            let fix = reading.file(at)?;
            let same = |known: &FileFix| known.lab == fix.lab && known.path == fix.path;
            if fixes.files.iter().any(same) {
                return reading.twice(at, format!("`{}`", fix.path));
            }
            fixes.files.push(fix);
        }
        for at in &table.points {
            let fix = reading.points(at)?;
            let same = |known: &PointsFix| {
                (&known.student, &known.lab, &known.check) == (&fix.student, &fix.lab, &fix.check)
            };
            if fixes.points.iter().any(same) {
                let of = fix.check.as_deref().unwrap_or(&fix.lab);
                return reading.twice(at, format!("`{of}` of `{}`", fix.student));
            }
            fixes.points.push(fix);
        }
        for at in &table.excused {
            let ExcuseTable {
                student,
                lab,
                why,
                by,
            } = at.get_ref();
            let (why, by) = reading.reason(why, by)?;
            let student = reading.student(student)?;
            let same = |known: &Excuse| (&known.student, &known.lab) == (&student, lab);
            if fixes.excuses.iter().any(same) {
                return reading.twice(at, format!("the excuse of `{student}` for `{lab}`"));
            }
            fixes.excuses.push(Excuse {
                student,
                lab: lab.clone(),
                why,
                by,
            });
        }
        for at in &table.extensions {
            let ExtensionTable {
                student,
                lab,
                due,
                why,
                by,
            } = at.get_ref();
            reading.reason(why, by)?;
            let student = reading.student(student)?;
            let same = |known: &Extension| (&known.student, &known.lab) == (&student, lab);
            if fixes.extensions.iter().any(same) {
                return reading.twice(at, format!("the due time of `{student}` for `{lab}`"));
            }
            fixes.extensions.push(Extension {
                student,
                lab: lab.clone(),
                due: crate::course_file::instant(source, due)?,
            });
        }
        Ok(fixes)
    }
}

struct Reading<'s> {
    source: &'s Source,
}

impl Reading<'_> {
    fn student(&self, typed: &Spanned<String>) -> Result<StudentId, TextError> {
        StudentId::new(typed.get_ref())
            .or_else(|why| refuse(self.source, typed.span(), FixProblem::Student { why }))
    }

    fn reason(
        &self,
        why: &Spanned<String>,
        by: &Spanned<String>,
    ) -> Result<(String, String), TextError> {
        if why.get_ref().trim().is_empty() {
            return refuse(self.source, why.span(), FixProblem::NoWhy);
        }
        if by.get_ref().trim().is_empty() {
            return refuse(self.source, by.span(), FixProblem::NoBy);
        }
        Ok((why.get_ref().clone(), by.get_ref().clone()))
    }

    fn twice<T, V>(&self, at: &Spanned<V>, what: String) -> Result<T, TextError> {
        refuse(self.source, at.span(), FixProblem::Twice { what })
    }

    fn file(&self, at: &Spanned<FileTable>) -> Result<FileFix, TextError> {
        let table = at.get_ref();
        self.reason(&table.why, &table.by)?;
        let student = match (&table.student, table.ignore) {
            (Some(student), false) => Some(self.student(student)?),
            (None, true) => None,
            (None, false) => return refuse(self.source, at.span(), FixProblem::Group),
            (Some(_), true) => return refuse(self.source, at.span(), FixProblem::Both),
        };
        Ok(FileFix {
            lab: table.lab.clone(),
            path: table.path.clone(),
            student,
        })
    }

    fn points(&self, at: &Spanned<PointsTable>) -> Result<PointsFix, TextError> {
        let table = at.get_ref();
        let (why, by) = self.reason(&table.why, &table.by)?;
        let number = |typed: &Spanned<f64>| match *typed.get_ref() {
            value if value.is_finite() => Ok(value),
            value => refuse(self.source, typed.span(), FixProblem::Number { value }),
        };
        let change = match (&table.points, &table.add) {
            (Some(_), Some(_)) => {
                return refuse(self.source, at.span(), FixProblem::PointsAndAdd);
            }
            (None, None) => return refuse(self.source, at.span(), FixProblem::NoPoints),
            (Some(typed), None) => match number(typed)? {
                value if value < 0.0 => {
                    return refuse(self.source, typed.span(), FixProblem::Below { value });
                }
                value => PointsChange::Set(value),
            },
            (None, Some(typed)) => PointsChange::Add(number(typed)?),
        };
        Ok(PointsFix {
            student: self.student(&table.student)?,
            lab: table.lab.clone(),
            check: table.check.clone(),
            change,
            record: table.record.clone(),
            why,
            by,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Fixes, TextError> {
        Fixes::parse(&Source::new(FIXES_FILE, format!("format = 1\n{text}")))
    }

    #[test]
    fn each_kind_of_fix_is_read() {
        let fixes = parse(
            "[[files]]\nlab = \"l\"\npath = \"x.rhai\"\nstudent = \"s1\"\nwhy = \"w\"\nby = \"b\"\n\
             [[files]]\nlab = \"l\"\npath = \"y\"\nignore = true\nwhy = \"w\"\nby = \"b\"\n\
             [[points]]\nstudent = \"s1\"\nlab = \"l\"\ncheck = \"fk/position\"\nadd = 0.5\nwhy = \"w\"\nby = \"b\"\n\
             [[excused]]\nstudent = \"s2\"\nlab = \"l\"\nwhy = \"w\"\nby = \"b\"\n\
             [[extensions]]\nstudent = \"s2\"\nlab = \"l\"\ndue = 2026-12-01T00:00:00Z\nwhy = \"w\"\nby = \"b\"\n",
        )
        .unwrap();
        assert_eq!(fixes.files[0].student.as_ref().unwrap().as_str(), "s1");
        assert_eq!(fixes.files[1].student, None);
        assert_eq!(fixes.points[0].change, PointsChange::Add(0.5));
        assert_eq!((fixes.excuses.len(), fixes.extensions.len()), (1, 1));
    }

    #[test]
    fn a_fix_without_a_reason_or_with_two_meanings_is_refused() {
        let points = "[[points]]\nstudent = \"s1\"\nlab = \"l\"\n";
        for (text, part) in [
            (
                format!("{points}points = 1.0\nwhy = \" \"\nby = \"b\"\n"),
                "says why",
            ),
            (
                format!("{points}points = 1.0\nwhy = \"w\"\nby = \"\"\n"),
                "by whom",
            ),
            (
                format!("{points}why = \"w\"\nby = \"b\"\n"),
                "need a number",
            ),
            (
                format!("{points}points = 1.0\nadd = 1.0\nwhy = \"w\"\nby = \"b\"\n"),
                "either set or added",
            ),
            (
                format!("{points}points = -1.0\nwhy = \"w\"\nby = \"b\"\n"),
                "not below 0",
            ),
            (
                format!("{points}points = nan\nwhy = \"w\"\nby = \"b\"\n"),
                "finite",
            ),
            (
                "[[files]]\nlab = \"l\"\npath = \"x\"\nwhy = \"w\"\nby = \"b\"\n".to_owned(),
                "belongs to somebody",
            ),
        ] {
            let error = parse(&text).unwrap_err();
            assert!(error.to_string().contains(part), "{text}: {error}");
        }
        let twice = format!("{points}points = 1.0\nwhy = \"w\"\nby = \"b\"\n").repeat(2);
        assert!(
            parse(&twice)
                .unwrap_err()
                .to_string()
                .contains("decided twice")
        );
    }
}
