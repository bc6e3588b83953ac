//! The folder of a course: found, read, and its labs loaded with the staff part.

use std::path::{Path, PathBuf};

use kinemark_course::book::{Book, BookError};
use kinemark_course::course_file::{COURSE_FILE, CourseFile, CourseLab};
use kinemark_course::course_text::{decoded, read};
use kinemark_course::fixes::{FIXES_FILE, Fixes};
use kinemark_course::grading::GradingError;
use kinemark_course::history::History;
use kinemark_course::index::{Index, IndexError};
use kinemark_course::intake::IntakeError;
use kinemark_course::journal::{Event, JournalError};
use kinemark_course::language::Language;
use kinemark_course::roster::Roster;
use kinemark_course::staffed_lab::StaffedLab;
use kinemark_course::standing::{Standing, standings};
use kinemark_course::student::StudentId;
use kinemark_course::working_folder::BRIEF_FILE;
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use kinemark_grader::task::problem::LoadError;
use kinemark_sim::text::{Source, suggest};

use crate::disk::Folder;
use crate::error_record::ErrorCode;
use crate::failure::{BROKEN, Failure, USAGE};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};

/// Which course.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct CourseArgs {
    /// The course's folder [default: the one with a course.toml, here or above]
    #[arg(long, value_name = "DIR")]
    pub(crate) course: Option<PathBuf>,
}

/// The folder that the program writes, in the course's.
pub(crate) const BOOK: &str = "book";

/// A course, read.
pub(crate) struct Course {
    root: PathBuf,
    pub(crate) file: CourseFile,
    pub(crate) roster: Roster,
    pub(crate) fixes: Fixes,
    /// Of the text of the fixes: with them it changes which hand-ins count.
    fixes_digest: String,
    pub(crate) book: Book,
    /// The course's salt, where it has one of its own.
    pub(crate) salt: Option<String>,
}

/// Files of a lab that wait for a person.
pub(crate) struct OpenFiles {
    /// Whose they are, where that is certain.
    pub(crate) students: Vec<StudentId>,
    /// Of each of the others, the students that come near.
    pub(crate) unclaimed: Vec<Vec<StudentId>>,
}

impl Course {
    /// Finds and reads the course; nothing of a lab is loaded.
    pub(crate) fn open(args: &CourseArgs) -> Result<Self, Failure> {
        let root = root(args)?;
        let file = CourseFile::parse(text(&root.join(COURSE_FILE))?)
            .map_err(|error| Failure::diagnostic(BROKEN, error))?;
        let roster = roster(&root.join(&file.roster))?;
        let fixes = root.join(FIXES_FILE);
        let (fixes, fixes_digest) = if fixes.exists() {
            let text = text(&fixes)?;
            let digest = blake3::hash(text.text().as_bytes()).to_hex();
            let fixes = Fixes::parse(&text).map_err(|error| Failure::diagnostic(BROKEN, error))?;
            (fixes, digest.to_string())
        } else {
            (Fixes::default(), String::new())
        };
        let salt = salt(&root, &file)?;
        let book = Book::new(&root.join(BOOK));
        let course = Self {
            root,
            file,
            roster,
            fixes,
            fixes_digest,
            book,
            salt,
        };
        course.check_fixes()?;
        Ok(course)
    }

    /// Its folder.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Refuses decisions on people and labs that are not of the course: a slip would be without effect.
    fn check_fixes(&self) -> Result<(), Failure> {
        let fixes = &self.fixes;
        let of_files = fixes.files.iter();
        let of_files = of_files.map(|fix| (fix.student.as_ref(), &fix.lab));
        let of_points = fixes
            .points
            .iter()
            .map(|fix| (Some(&fix.student), &fix.lab));
        let of_excuses = fixes
            .excuses
            .iter()
            .map(|fix| (Some(&fix.student), &fix.lab));
        let more = fixes.extensions.iter();
        let more = more.map(|fix| (Some(&fix.student), &fix.lab));
        for (student, lab) in of_files.chain(of_points).chain(of_excuses).chain(more) {
            if let Some(student) = student {
                self.person(student.as_str()).map_err(|_| {
                    let known = self.roster.people().iter().map(|person| person.id.as_str());
                    let near = suggest(student.as_str(), "ids", known.take(20));
                    Failure::broken(
                        format!(
                            "{FIXES_FILE} names the student `{student}`, who is not in the roster"
                        ),
                        &format!("{FIXES_FILE} or the roster has it wrong; {near}"),
                    )
                })?;
            }
            if self.file.lab(lab).is_none() {
                let known = self.file.labs.iter().map(|lab| lab.name.as_str());
                let near = suggest(lab, "labs", known);
                return Err(Failure::broken(
                    format!("{FIXES_FILE} names the lab `{lab}`, which is not one of the course"),
                    &format!("{FIXES_FILE} or {COURSE_FILE} has it wrong; {near}"),
                ));
            }
        }
        Ok(())
    }

    /// The student of an id as typed.
    pub(crate) fn person(&self, typed: &str) -> Result<StudentId, Failure> {
        let id = StudentId::new(typed)
            .map_err(|why| Failure::usage(why, "write the id as roster.csv has it"))?;
        if self.roster.get(&id).is_some() {
            return Ok(id);
        }
        let known = self.roster.people().iter().map(|person| person.id.as_str());
        Err(Failure::usage(
            format!("no student `{id}` is in the roster"),
            &suggest(id.as_str(), "ids", known.take(2000)),
        )
        .coded(ErrorCode::UnknownName))
    }

    /// The rules of a lab of the course.
    pub(crate) fn rules(&self, lab: &str) -> Result<&CourseLab, Failure> {
        self.file.lab(lab).ok_or_else(|| {
            let known = self.file.labs.iter().map(|lab| lab.name.as_str());
            Failure::usage(
                format!("lab `{lab}` is not one of the course"),
                &suggest(lab, "labs", known),
            )
            .coded(ErrorCode::UnknownName)
        })
    }

    /// The labs of today and the course staff's part. What was graded is in the book, so it can be explained without them.
    fn labs(&self) -> Result<(Box<dyn Files>, Option<Folder>), Failure> {
        let folder = self.file.labs_folder.as_ref();
        let from = LabsFolderArgs {
            labs: folder.map(|labs| self.root.join(labs)),
        };
        if let Some(labs) = from.labs.as_ref().filter(|labs| !labs.is_dir()) {
            return Err(Failure::broken(
                format!("the labs `{}` are not a directory", labs.display()),
                "write `labs_folder = \"FOLDER\"` into course.toml, or leave it out for the labs inside kinemark",
            ));
        }
        let (labs, labs_folder) = labs_folder::open_from(&from, &self.root)?;
        let reference = self.file.reference.as_ref();
        let part = StaffPart::in_folder(reference.map(|folder| self.root.join(folder)));
        let help = "write `reference = \"FOLDER\"` of the course staff's part into course.toml";
        let reference = staff_folder::part(&part, labs_folder.as_deref(), help)?;
        Ok((labs, reference))
    }

    /// A lab with its staff part.
    pub(crate) fn lab(&self, rules: &CourseLab) -> Result<StaffedLab, Failure> {
        let (labs, reference) = self.labs()?;
        let reference = reference.as_ref().map(|folder| folder as &dyn Files);
        let salt = self.salt.as_deref();
        let loaded = StaffedLab::load(labs.as_ref(), reference, &rules.name, salt, rules.variants);
        let lab = loaded.map_err(|error| match error {
            LoadError::UnknownLab { name, help } => Failure::broken(
                format!("{COURSE_FILE} names lab `{name}`, and there is none"),
                &help,
            ),
            error => error.into(),
        })?;
        if !lab.has_staff() {
            return Err(Failure::broken(
                format!(
                    "lab `{}` has no reference solution, so nothing hidden can be graded",
                    rules.name
                ),
                "write `reference = \"FOLDER\"` of the course staff's part into course.toml",
            ));
        }
        Ok(lab)
    }

    /// What happened so far.
    pub(crate) fn history(&self) -> Result<History, Failure> {
        let entries = self.book.journal().entries().map_err(journal_failure)?;
        // a book that was joined may still have somebody who was removed from this one
        let is_gone = |event: &Event| match event {
            Event::HandIn(hand_in) => {
                self.roster.get(&hand_in.student).is_none()
                    && self.book.has_forgotten(&hand_in.student)
            }
            _ => false,
        };
        let entries = entries.into_iter().filter(|entry| !is_gone(&entry.event));
        Ok(History::of(entries).decided(&self.fixes))
    }

    /// The book as tables, with everything that is in it now.
    pub(crate) fn index(&self, history: &History) -> Result<Index, Failure> {
        let state = self.book.journal().state().map_err(|error| {
            book_failure(BookError {
                path: self.book.root().join("journal"),
                why: error.to_string(),
            })
        })?;
        let state = format!("{state} {}", self.fixes_digest);
        Index::refresh(&self.book, history, &state).map_err(index_failure)
    }

    /// What waits for a person in a lab.
    pub(crate) fn open_files(&self, rules: &CourseLab) -> Result<OpenFiles, Failure> {
        let questions = self.book.questions().map_err(book_failure)?;
        let of_lab = questions
            .iter()
            .filter(|question| question.lab == rules.name);
        let of_lab: Vec<_> = of_lab.collect();
        let students = of_lab
            .iter()
            .filter_map(|question| question.student.clone());
        let unclaimed = of_lab.iter().filter(|question| question.student.is_none());
        Ok(OpenFiles {
            students: students.collect(),
            unclaimed: unclaimed.map(|question| question.near.clone()).collect(),
        })
    }

    /// How everybody stands in a lab; `open` are students of whom a file waits for a person.
    pub(crate) fn standings(
        &self,
        rules: &CourseLab,
        history: &History,
        index: &Index,
        open: &[StudentId],
    ) -> Result<Vec<Standing>, Failure> {
        let summaries = index.summaries(&rules.name).map_err(index_failure)?;
        let known = |key: &str| summaries.get(key).cloned();
        Ok(standings(
            rules,
            &self.roster,
            &self.fixes,
            history,
            open,
            known,
        ))
    }
}

impl Course {
    /// How everybody stands in every lab, lab by lab; the index is given it too, for whoever looks into the book.
    pub(crate) fn put_standings(
        &self,
        history: &History,
        index: &mut Index,
    ) -> Result<Vec<Standing>, Failure> {
        let questions = self.book.questions().map_err(book_failure)?;
        let mut all = Vec::new();
        for rules in &self.file.labs {
            let of_lab = questions
                .iter()
                .filter(|question| question.lab == rules.name);
            let open: Vec<StudentId> = of_lab
                .filter_map(|question| question.student.clone())
                .collect();
            all.extend(self.standings(rules, history, index, &open)?);
        }
        index.put_standings(&all).map_err(index_failure)?;
        Ok(all)
    }

    /// What students were given besides the files that the lab is read from: brief and starters, where there are any.
    pub(crate) fn handed_out(&self, rules: &CourseLab) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        let (labs, _) = self.labs()?;
        let mut files = Vec::new();
        let starters = Language::ALL.map(Language::starter);
        for name in [BRIEF_FILE].into_iter().chain(starters) {
            let path = format!("{}/{name}", rules.name);
            let bytes = labs.bytes(&path).map_err(|why| {
                let shown = format!("{}/{path}", labs.name());
                Failure::broken(format!("`{shown}` cannot be read: {why}"), "check the file")
            })?;
            files.extend(bytes.map(|bytes| (path, bytes)));
        }
        Ok(files)
    }
}

/// The folder with a `course.toml`: the one named, else here or above.
fn root(args: &CourseArgs) -> Result<PathBuf, Failure> {
    let help = "a course is a folder with a course.toml and a roster.csv: see docs/ta-guide.md";
    if let Some(given) = &args.course {
        if given.join(COURSE_FILE).is_file() {
            return Ok(given.clone());
        }
        return Err(Failure::usage(
            format!("`{}` has no {COURSE_FILE}", given.display()),
            help,
        ));
    }
    if let Some(root) = enclosing_root() {
        return Ok(root);
    }
    Err(Failure::usage(
        format!("there is no {COURSE_FILE} here or above"),
        help,
    ))
}

/// The nearest folder with a `course.toml`: this one, or one above.
pub(crate) fn enclosing_root() -> Option<PathBuf> {
    let here = Path::new(".");
    let mut above = PathBuf::new();
    let depth = here
        .canonicalize()
        .map_or(0, |here| here.ancestors().count());
    for _ in 0..depth {
        if above.join(COURSE_FILE).is_file() {
            let is_here = above.as_os_str().is_empty();
            return Some(if is_here { here.to_owned() } else { above });
        }
        above.push("..");
    }
    None
}

/// A text file of the course.
pub(crate) fn text(path: &Path) -> Result<Source, Failure> {
    let shown = path.display().to_string();
    let bytes = read(path).and_then(kinemark_grader::task::files::text);
    match bytes {
        Ok(text) => Ok(Source::new(shown, text)),
        Err(why) => Err(Failure::broken(
            format!("`{shown}` cannot be read: {why}"),
            UNREAD_HELP,
        )),
    }
}

fn roster(path: &Path) -> Result<Roster, Failure> {
    let shown = path.display().to_string();
    let bytes = read(path).map_err(|why| {
        Failure::broken(
            format!("the roster `{shown}` cannot be read: {why}"),
            "write it as CSV with the columns id,name,email,section, or name it in course.toml: roster = \"FILE\"",
        )
    })?;
    Roster::parse(&shown, &bytes).map_err(|error| Failure::diagnostic(BROKEN, error))
}

/// The salt of the course's file, without the line end.
pub(crate) fn salt(root: &Path, file: &CourseFile) -> Result<Option<String>, Failure> {
    let Some(name) = &file.salt_file else {
        return Ok(None);
    };
    let path = root.join(name);
    let help = "write a line that nobody can guess into it, and keep it from students";
    let broken = |why: &str| Failure::broken(format!("the salt `{}`: {why}", path.display()), help);
    let bytes = read(&path).map_err(|why| broken(&why))?;
    let text = decoded(&bytes).trim().to_owned();
    if text.is_empty() {
        return Err(broken("the file is empty"));
    }
    if text.lines().count() > 1 {
        return Err(broken("the file has several lines, and a salt is one"));
    }
    Ok(Some(text))
}

/// What keeps a hand-in from being graded at all, for people.
pub(crate) fn grading_failure(error: GradingError) -> Failure {
    match error {
        GradingError::Interrupted(_) => Failure::paused(),
        GradingError::Lab(error) => Failure::from(*error),
        GradingError::Book(error) => book_failure(error),
    }
}

/// A failure of the book, for people.
pub(crate) fn book_failure(error: BookError) -> Failure {
    Failure::fault(
        format!("the book: {error}"),
        "check that the folder can be written to and that the disk has space",
    )
}

/// A failure of the index, for people.
pub(crate) fn index_failure(error: IndexError) -> Failure {
    Failure::fault(
        format!("the index of the book: {error}"),
        "check that the disk has space; the index can be deleted at any time, and the next command makes it anew",
    )
}

/// A failure of the journal, for people.
pub(crate) fn journal_failure(error: JournalError) -> Failure {
    Failure::broken(
        format!("the journal of the book: {error}"),
        "restore the file from a copy of the book",
    )
}

/// A source that cannot be read, for people.
pub(crate) fn intake_failure(error: IntakeError) -> Failure {
    match error {
        IntakeError::Tree(error) => Failure::diagnostic(USAGE, error),
        IntakeError::Book(error) => book_failure(error),
    }
}
