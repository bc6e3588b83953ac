//! What a person should know of a release before it is uploaded: whom it leaves out, and what it replaced.

use std::fmt;

use super::Row;
use super::decided::decided;
use super::number::points_text;
use crate::standing::Status;
use crate::student::StudentId;
use kinemark_report::visible::visible;

/// Something that is not in the files, or that they change.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
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
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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

/// What needs a person whatever the form.
pub(super) fn of_rows(rows: &[Row<'_>]) -> Vec<Note> {
    let mut notes = Vec::new();
    for row in rows {
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
        }
        for by_hand in standing.by_hand.iter().filter(|by_hand| by_hand.is_stale) {
            notes.push(Note::Stale {
                student: person.id.clone(),
                check: by_hand.check.clone(),
                why: by_hand.why.clone(),
            });
        }
    }
    notes
}
