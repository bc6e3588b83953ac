//! `kinemark course forget`: removes a person from the book.

use std::collections::BTreeSet;
use std::process::ExitCode;

use kinemark_course::student::StudentId;
use kinemark_sim::text::suggest;

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

/// Refuses an id that the book knows nothing of: most often it is typed wrong.
fn refuse_unknown(course: &Course, student: &StudentId) -> Result<(), Failure> {
    let history = course.history()?;
    let mut known: BTreeSet<StudentId> = history
        .all()
        .map(|(_, student, _)| student.clone())
        .collect();
    known.extend(history.withdrawn.iter().map(|gone| gone.student.clone()));
    let questions = course.book.questions().map_err(book_failure)?;
    known.extend(
        questions
            .into_iter()
            .filter_map(|question| question.student),
    );
    if known.contains(student) || course.book.has_forgotten(student) {
        return Ok(());
    }
    let gone = known
        .iter()
        .filter(|known| course.roster.get(known).is_none())
        .map(StudentId::as_str);
    Err(Failure::usage(
        format!("the book has nothing of `{student}`"),
        &suggest(student.as_str(), "ids that are no more in the roster", gone),
    ))
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
    refuse_unknown(&course, &student)?;
    let gone = course.book.forget(&student).map_err(book_failure)?;
    let history = course.history()?;
    let mut index = course.index(&history)?;
    course.put_standings(&history, &mut index)?;
    if args.json {
        output::print_formatted(&gone)?;
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
