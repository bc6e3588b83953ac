//! `kinemark course forget`: removes a person from the book.

use std::process::ExitCode;

use kinemark_course::student::StudentId;

use crate::course_folder::{Course, CourseArgs, book_failure};
use crate::failure::Failure;
use crate::output;

/// Remove a student from the book: hand-ins, grades, reports
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  kinemark course forget s1001036\n\n\
    Take the line out of roster.csv and fixes.toml first. What the student shares with others, such as the same file, stays for them. \
    Copies of the book elsewhere are not changed; joining them does not bring the student back.\n\
    Exit codes: 0 done, 2 usage, 3 a file of the course cannot be read, 4 the book cannot be written.")]
pub(crate) struct Args {
    /// The student's id
    pub(crate) student: String,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Print what was removed as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Removes and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let course = Course::open(&args.course)?;
    let student = StudentId::new(&args.student)
        .map_err(|why| Failure::usage(why, "write the id as roster.csv had it"))?;
    if course.roster.get(&student).is_some() {
        return Err(Failure::usage(
            format!("`{student}` is in the roster"),
            "take the line out of roster.csv, so that the next hand-in does not bring them back",
        ));
    }
    let gone = course.book.forget(&student).map_err(book_failure)?;
    let history = course.history()?;
    let mut index = course.index(&history)?;
    course.put_standings(&history, &mut index)?;
    if args.json {
        output::print_json(&gone)?;
    } else {
        output::print(&format!(
            "{student}: {} lines of the journal, {} records, {} submissions and {} questions removed\n",
            gone.lines, gone.records, gone.submissions, gone.questions
        ))?;
        if gone.pages > 0 {
            output::print(
                "the pages of the class are removed, too: `kinemark course page LAB` writes them anew\n",
            )?;
        }
        if gone.left > 0 {
            output::print(&format!(
                "{} hand-ins of others in the group were graded with this student's variant and still name it\n",
                gone.left
            ))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
