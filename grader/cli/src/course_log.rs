//! The lines that a command writes into the journal of the course's book.

use jiff::Timestamp;
use kinemark_course::journal::{Event, Writer};

use crate::course_folder::{Course, book_failure};
use crate::disk::plain;
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::operator::operator;
use crate::output;

/// The journal of one command, begun with its first line.
pub(crate) struct CourseLog<'c> {
    course: &'c Course,
    writer: Option<Writer>,
}

impl<'c> CourseLog<'c> {
    /// Nothing is written yet.
    pub(crate) fn new(course: &'c Course) -> Self {
        Self {
            course,
            writer: None,
        }
    }

    /// Appends what happened now.
    pub(crate) fn append(&mut self, event: Event) -> Result<(), Failure> {
        let at = Timestamp::now();
        let writer = match &mut self.writer {
            Some(writer) => writer,
            None => {
                let begun = self.course.book.begin(at, &operator());
                let begun = begun.map_err(|error| self.failed(&error))?;
                self.writer.insert(begun)
            }
        };
        let appended = writer.append(at, event);
        appended.map_err(|error| self.failed(&error))
    }

    /// Ends it: everything is on the disk, and what the lines are about before them.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        self.course.book.sync().map_err(book_failure)?;
        let finished = self.writer.take().map(Writer::finish);
        finished
            .unwrap_or(Ok(()))
            .map_err(|error| self.failed(&error))
    }

    fn failed(&self, error: &std::io::Error) -> Failure {
        Failure::fault(
            format!(
                "the journal in `{}` cannot be written: {}",
                output::path(self.course.book.root()),
                plain(error)
            ),
            "free some space; what was graded so far stands, and the same command goes on from there",
        ).coded(ErrorCode::Unwritten)
    }
}
