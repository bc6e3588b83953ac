//! The book of a course as it is served: the list of everybody, and the pages in it. What else the book has (the salt, hidden cases,
//! submissions, the journal) is not served.

use std::path::{Path, PathBuf};

use kinemark_course::book::Book;
use kinemark_course::class_pages::{CLASS_FILE, PAGES, SIMILAR_FILE, STUDENTS_FILE, pages_path};
use kinemark_course::course_file::{COURSE_FILE, CourseFile};
use kinemark_course::course_text;
use kinemark_course::index::Index;
use kinemark_course::page::{BookList, LabPages, book_page, named_students};
use kinemark_course::reports::{REPORTS, page_path, with_viewer};
use kinemark_course::roster::Roster;
use kinemark_course::staffed_lab::engine_id;
use kinemark_course::standing_rows::{StandingRow, standing_rows};
use kinemark_grader::task::files::text;
use kinemark_sim::text::Source;

use super::files::{self, Unread};
use crate::course_folder::BOOK;

/// A book to be served.
#[derive(Debug)]
pub(crate) struct ServedBook {
    root: PathBuf,
    /// The folder in which its course may be.
    course: Option<PathBuf>,
}

/// What is known of a course: its title, its labs in order, its roster.
#[derive(Default)]
struct Course {
    title: String,
    labs: Vec<String>,
    roster: Roster,
}

impl ServedBook {
    /// The book that `folder` is, or that of the course in `folder`.
    pub(crate) fn find(folder: &Path) -> Option<Self> {
        let is_book = |folder: &Path| {
            ["journal", "records"]
                .iter()
                .all(|name| folder.join(name).is_dir())
        };
        if is_book(folder) {
            let real = folder.canonicalize().ok()?;
            return Some(Self {
                root: folder.to_owned(),
                course: real.parent().map(Path::to_owned),
            });
        }
        let root = folder.join(BOOK);
        (folder.join(COURSE_FILE).is_file() && is_book(&root)).then(|| Self {
            root,
            course: Some(folder.to_owned()),
        })
    }

    /// Its folder.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// The list of everybody as a page, as the book is now.
    pub(super) fn list(&self) -> String {
        let mut notes = Vec::new();
        let course = self.course().unwrap_or_else(|why| {
            notes.push(format!("There are no names and no sections here: {why}."));
            Course::default()
        });
        let rows = self.rows().unwrap_or_else(|why| {
            notes.push(why);
            Vec::new()
        });
        let mut labs = course.labs;
        for row in &rows {
            if !labs.contains(&row.lab) {
                labs.push(row.lab.clone());
            }
        }
        let book = Book::new(&self.root);
        let report = |row: &StandingRow| {
            let key = row.record.as_deref()?;
            let has_page = book.has_page(&row.lab, key);
            // seen from the list
            has_page.then(|| page_path(&row.lab, key))
        };
        let pages = |lab: &str| {
            let named = book.class_pages(lab).into_iter().map(|name| {
                let address = format!("{}/{name}", pages_path(lab));
                (page_words(name), address)
            });
            named.collect()
        };
        book_page(&BookList {
            course: course.title,
            engine: engine_id(),
            students: named_students(rows, &course.roster, report),
            labs: labs
                .iter()
                .map(|lab| LabPages {
                    lab: lab.clone(),
                    pages: pages(lab),
                })
                .collect(),
            notes,
        })
    }

    /// How everybody stands.
    fn rows(&self) -> Result<Vec<StandingRow>, String> {
        let no_index = "The book has no index: `kinemark course status` makes one.";
        let index = Index::of(&self.root).ok_or_else(|| no_index.to_owned())?;
        standing_rows(&index).map_err(|error| format!("The index of the book: {error}."))
    }

    /// The course, where it is found; why not, in words.
    fn course(&self) -> Result<Course, String> {
        let folder = self.course.as_deref().unwrap_or(Path::new("."));
        let path = folder.join(COURSE_FILE);
        if !path.is_file() {
            return Err(format!("no {COURSE_FILE} lies beside the book"));
        }
        let unread =
            |what: &str, why: &dyn std::fmt::Display| format!("{what} cannot be read: {why}");
        let bytes = course_text::read(&path).and_then(text);
        let bytes = bytes.map_err(|why| unread(COURSE_FILE, &why))?;
        let file = CourseFile::parse(Source::new(COURSE_FILE, bytes))
            .map_err(|error| unread(COURSE_FILE, &error))?;
        let shown = file.roster.display().to_string();
        let bytes = course_text::read(&folder.join(&file.roster));
        let bytes = bytes.map_err(|why| unread(&shown, &why))?;
        let roster = Roster::parse(&shown, &bytes).map_err(|error| unread(&shown, &error))?;
        Ok(Course {
            title: file.title,
            labs: file.labs.into_iter().map(|lab| lab.name).collect(),
            roster,
        })
    }

    /// The page at `path`: one of the class or of a record. That of a record has the viewer's code in it.
    pub(super) fn page(&self, path: &str) -> Result<Vec<u8>, Unread> {
        let (folder, _) = path.split_once('/').ok_or(Unread::Absent)?;
        if !path.ends_with(".html") || ![PAGES, REPORTS].contains(&folder) {
            return Err(Unread::Absent);
        }
        let bytes = files::read(&self.root, path)?;
        if folder != REPORTS {
            return Ok(bytes);
        }
        Ok(match String::from_utf8(bytes) {
            Ok(page) => with_viewer(&page).into_bytes(),
            // no page of ours
            Err(error) => error.into_bytes(),
        })
    }
}

/// What a page of the class is, in words.
fn page_words(name: &str) -> &'static str {
    match name {
        CLASS_FILE => "the class, without names",
        STUDENTS_FILE => "with names",
        SIMILAR_FILE => "worth a conversation",
        _ => "another page",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn book(bed: &Path) -> ServedBook {
        for path in [
            "journal",
            "records",
            "reports/lab",
            "pages/lab",
            "staff/v/lab",
        ] {
            std::fs::create_dir_all(bed.join("book").join(path)).unwrap();
        }
        for path in [
            "reports/lab/ab.html",
            "reports/viewer-ab.js",
            "pages/lab/class.html",
            "pages/lab/jplag.txt",
            "staff/v/lab/salt",
            "staff/v/lab/salt.html",
            "journal/a.jsonl",
            "course.sqlite",
            "index.html",
        ] {
            std::fs::write(bed.join("book").join(path), path).unwrap();
        }
        ServedBook::find(&bed.join("book")).unwrap()
    }

    #[test]
    fn only_pages_of_the_book_are_served() {
        let bed = tempfile::tempdir().unwrap();
        let served = book(bed.path());
        for path in ["reports/lab/ab.html", "pages/lab/class.html"] {
            assert_eq!(served.page(path).unwrap(), path.as_bytes());
        }
        for path in [
            "reports/viewer-ab.js",
            "pages/lab/jplag.txt",
            "staff/v/lab/salt",
            "staff/v/lab/salt.html",
            "pages/../staff/v/lab/salt.html",
            "journal/a.jsonl",
            "course.sqlite",
            "index.html",
            "pages/lab/nothing.html",
        ] {
            assert_eq!(served.page(path), Err(Unread::Absent), "{path}");
        }
    }

    #[test]
    fn a_book_without_its_course_has_a_list_without_names() {
        let bed = tempfile::tempdir().unwrap();
        let served = book(bed.path());
        let list = served.list();
        assert!(
            list.contains("no course.toml lies beside the book"),
            "{list}"
        );
        assert!(list.contains("The book has no index"), "{list}");
        // the folder of a course leads to its book; one without a book is none
        assert!(ServedBook::find(bed.path()).is_none());
        std::fs::write(bed.path().join(COURSE_FILE), "format = 1\n").unwrap();
        let served = ServedBook::find(bed.path()).unwrap();
        assert_eq!(served.root(), bed.path().join("book"));
        assert!(served.list().contains("course.toml cannot be read"));
    }
}
