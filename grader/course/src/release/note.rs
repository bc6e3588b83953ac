//! What a person should know of a release before it is uploaded: whom it leaves out, and what it replaced.

use std::fmt;

use super::decided::decided;
use super::number::points_text;
use super::{Material, Row};
use crate::standing::Status;
use crate::student::StudentId;
use kinemark_report::visible::visible;
use serde::Serialize;

/// Something that is not in the files, or that they change.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "note", rename_all = "kebab-case")]
pub enum Note {
    /// Files wait for a person, and it is not certain whose they are.
    OpenFiles {
        /// How many.
        files: usize,
        /// The students who come near.
        near: Vec<StudentId>,
    },
    /// There is a grade, and another file of the student waits for a person.
    FileWaits {
        /// Whose.
        student: StudentId,
    },
    /// The grades were made with another lab, staff part or engine than those of today.
    EarlierLab {
        /// The lab.
        lab: String,
        /// Whose.
        students: Vec<StudentId>,
    },
    /// There is a hand-in, and no grade that could be written.
    NotDecided {
        /// Whose.
        student: StudentId,
        /// Where the grade is.
        status: Status,
    },
    /// Points by hand were decided on another record than the one that counts.
    Stale {
        /// Whose.
        student: StudentId,
        /// `TASK/CHECK`, or none for the total.
        check: Option<String>,
        /// Why they were given.
        why: String,
    },
    /// There is something to write, and the LMS's file has no row that is certainly theirs.
    NotInExport {
        /// Who.
        student: StudentId,
    },
    /// A row of the LMS's file is nobody's of the roster for certain; it is left as it is.
    NotInRoster {
        /// The line, from one.
        line: usize,
        /// Its first cell that says who it is.
        who: String,
        /// Why nobody was chosen.
        why: String,
    },
    /// The LMS had other points.
    Replaced {
        /// Whose.
        student: StudentId,
        /// What was there.
        was: String,
        /// What is there now.
        now: String,
    },
    /// A comment was there that this program did not write; it is kept.
    KeptComment {
        /// Whose.
        student: StudentId,
    },
    /// More points than the LMS takes; they are not written.
    AboveMaximum {
        /// Whose.
        student: StudentId,
        /// The points.
        points: f64,
        /// The most that the LMS takes.
        maximum: f64,
    },
    /// The grade counts to another maximum than the LMS does; no points are written.
    OtherMaximum {
        /// Whose.
        student: StudentId,
        /// The points.
        points: f64,
        /// The maximum of the grade.
        maximum: f64,
        /// The maximum in the LMS.
        theirs: f64,
    },
    /// The LMS's file says that the assignment is not theirs; the cell is kept.
    NotAssigned {
        /// Whose.
        student: StudentId,
    },
    /// The LMS's file says that the assignment does not count for them; the cell is kept.
    ExcusedThere {
        /// Whose.
        student: StudentId,
    },
    /// The encoding of the LMS's file lacks characters of a comment; a question mark stands for each.
    Unencodable {
        /// Whose.
        student: StudentId,
    },
}

impl fmt::Display for Note {
    // long: a sentence for each note
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenFiles { files, near } => {
                let files = match files {
                    1 => "1 file waits".to_owned(),
                    files => format!("{files} files wait"),
                };
                write!(f, "{files} for a person, because it is not certain whose:")?;
                if !near.is_empty() {
                    write!(f, " {} may be missing because of it;", listed(near))?;
                }
                write!(f, " `kinemark course status` shows what decides it")
            }
            Self::FileWaits { student } => write!(
                f,
                "{student}: another file of theirs waits for a person: the grade may change once it is decided"
            ),
            Self::EarlierLab { lab, students } => {
                let grades = match students.len() {
                    1 => "1 grade is".to_owned(),
                    count => format!("{count} grades are"),
                };
                write!(
                    f,
                    "{grades} of an earlier lab or engine ({}): `kinemark course regrade {lab}` shows what would change",
                    listed(students)
                )
            }
            Self::NotDecided { student, status } => {
                write!(f, "{student}: no grade is written: {}", status.words())
            }
            Self::Stale {
                student,
                check,
                why,
            } => write!(
                f,
                "{student}: points by hand for {} were decided on another record than the one that counts ({}): look at them again in fixes.toml",
                check.as_deref().unwrap_or("the total"),
                visible(why)
            ),
            Self::NotInExport { student } => write!(
                f,
                "{student}: not in the LMS's file, or not for certain: write the id, e-mail address or name of the LMS into roster.csv"
            ),
            Self::NotInRoster { line, who, why } => {
                write!(f, "line {line} ({}): left as it is: {why}", visible(who))
            }
            Self::Replaced { student, was, now } => {
                write!(f, "{student}: {now} replaces {}", visible(was))
            }
            Self::KeptComment { student } => {
                write!(f, "{student}: the comment that is there is kept")
            }
            Self::AboveMaximum {
                student,
                points,
                maximum,
            } => write!(
                f,
                "{student}: {} points are not written, because the LMS takes no more than {}: enter them there by hand",
                points_text(*points),
                points_text(*maximum)
            ),
            Self::OtherMaximum {
                student,
                points,
                maximum,
                theirs,
            } => write!(
                f,
                "{student}: {} of {} points are not written, because the LMS counts to {}: regrade the lab, or enter them there by hand",
                points_text(*points),
                points_text(*maximum),
                points_text(*theirs)
            ),
            Self::NotAssigned { student } => write!(
                f,
                "{student}: no points are written, because the assignment is not assigned to them in the LMS"
            ),
            Self::ExcusedThere { student } => write!(
                f,
                "{student}: no points are written, because they are excused in the LMS: excuse them in fixes.toml too, or remove it there"
            ),
            Self::Unencodable { student } => write!(
                f,
                "{student}: the file's encoding lacks characters of the comment, which are written as `?`: save the file as UTF-8 and release again"
            ),
        }
    }
}

impl Note {
    /// Whose grade does not go out with this file.
    pub fn is_left_out(&self) -> Option<&StudentId> {
        match self {
            Self::NotDecided { student, .. }
            | Self::NotInExport { student }
            | Self::AboveMaximum { student, .. }
            | Self::OtherMaximum { student, .. }
            | Self::NotAssigned { student }
            | Self::ExcusedThere { student } => Some(student),
            Self::OpenFiles { .. }
            | Self::FileWaits { .. }
            | Self::EarlierLab { .. }
            | Self::Stale { .. }
            | Self::NotInRoster { .. }
            | Self::Replaced { .. }
            | Self::KeptComment { .. }
            | Self::Unencodable { .. } => None,
        }
    }
}

/// Ids in a line.
fn listed(students: &[StudentId]) -> String {
    let ids: Vec<&str> = students.iter().map(StudentId::as_str).collect();
    ids.join(", ")
}

/// What needs a person whatever the form.
pub(super) fn of_every_form(material: &Material<'_>) -> Vec<Note> {
    let mut notes = Vec::new();
    let unclaimed = material.open.unclaimed;
    if !unclaimed.is_empty() {
        let mut near: Vec<StudentId> = unclaimed.iter().flatten().cloned().collect();
        near.sort();
        near.dedup();
        notes.push(Note::OpenFiles {
            files: unclaimed.len(),
            near,
        });
    }
    let earlier = material.rows.iter();
    let earlier = earlier.filter(|row| row.is_of_earlier_lab && decided(row).is_some());
    let students: Vec<StudentId> = earlier.map(|row| row.person.id.clone()).collect();
    if !students.is_empty() {
        notes.push(Note::EarlierLab {
            lab: material.lab.to_owned(),
            students,
        });
    }
    for row in material.rows {
        notes.extend(of_row(material, row));
    }
    notes
}

/// What needs a person in a row.
fn of_row(material: &Material<'_>, row: &Row<'_>) -> Vec<Note> {
    let mut notes = Vec::new();
    let Row {
        person, standing, ..
    } = row;
    let is_open = match standing.status {
        Status::Pending | Status::HostLimit | Status::GraderFault | Status::NeedsPerson => true,
        Status::Graded => decided(row).is_none(),
        Status::Missing | Status::Excused => false,
    };
    if is_open {
        notes.push(Note::NotDecided {
            student: person.id.clone(),
            status: standing.status,
        });
    } else if standing.status == Status::Graded && material.open.students.contains(&person.id) {
        notes.push(Note::FileWaits {
            student: person.id.clone(),
        });
    }
    for by_hand in standing.by_hand.iter().filter(|by_hand| by_hand.is_stale) {
        notes.push(Note::Stale {
            student: person.id.clone(),
            check: by_hand.check.clone(),
            why: by_hand.why.clone(),
        });
    }
    notes
}
