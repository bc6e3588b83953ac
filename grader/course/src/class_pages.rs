//! Where the pages of the class are: a folder a lab in the book's. It is of one moment, so it is replaced as a whole; what is in it can
//! be made anew at any time.

use std::io;
use std::path::{Path, PathBuf};

use crate::book::{Book, BookError};
use crate::durable;
use crate::private_files::{UNFINISHED, fill, fresh_folder, private_folder};

/// The folder of these pages, in the book's.
pub const PAGES: &str = "pages";
/// The page without names.
pub const CLASS_FILE: &str = "class.html";
/// The same page with names.
pub const STUDENTS_FILE: &str = "students.html";
/// What is worth a conversation.
pub const SIMILAR_FILE: &str = "similar.html";

/// The folder of a lab's pages, seen from the book's folder.
pub fn pages_path(lab: &str) -> String {
    format!("{PAGES}/{lab}")
}

impl Book {
    /// Replaces the pages of a lab by `files`, paths in their folder with their bytes, all of them or none. Gives the names, in that
    /// folder, of what was there before and is not any more.
    ///
    /// # Errors
    /// A full disk; what was there before then stays.
    pub fn put_class_pages(
        &self,
        lab: &str,
        files: &[(String, Vec<u8>)],
    ) -> Result<Vec<String>, BookError> {
        let path = self.root().join(pages_path(lab));
        let before = names(&path);
        let written = || -> io::Result<()> {
            let all = self.root().join(PAGES);
            private_folder(&all)?;
            let fresh = fresh_folder(&all, UNFINISHED)?;
            let (new, old) = (fresh.path().join("new"), fresh.path().join("old"));
            private_folder(&new)?;
            fill(&new, files)?;
            if path.is_dir() {
                std::fs::rename(&path, &old)?;
            }
            std::fs::rename(&new, &path).inspect_err(|_| {
                // put the earlier one back; the error is reported either way
                let _ = std::fs::rename(&old, &path);
            })?;
            durable::sync_folder(&all)
        };
        written().map_err(|error| failed(&path, &error))?;
        let now = names(&path);
        Ok(before
            .into_iter()
            .filter(|name| !now.contains(name))
            .collect())
    }

    /// Which pages a lab has, by the names of their files.
    pub fn class_pages(&self, lab: &str) -> Vec<&'static str> {
        let folder = self.root().join(pages_path(lab));
        [CLASS_FILE, STUDENTS_FILE, SIMILAR_FILE]
            .into_iter()
            .filter(|name| folder.join(name).is_file())
            .collect()
    }

    /// Removes the pages of all labs, since they have ids and points of everybody; gives how many labs had some.
    pub(crate) fn remove_class_pages(&self) -> Result<usize, BookError> {
        let path = self.root().join(PAGES);
        let labs = names(&path)
            .iter()
            .filter(|name| !name.starts_with('.'))
            .count();
        match std::fs::remove_dir_all(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(failed(&path, &error)),
            _ => Ok(labs),
        }
    }
}

/// What is in a folder, sorted; nothing in one that is not there.
fn names(folder: &Path) -> Vec<String> {
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = inside
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn failed(path: &Path, error: &io::Error) -> BookError {
    BookError {
        path: PathBuf::from(path),
        why: error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAB: &str = "01-kinematics";

    fn file(name: &str, text: &str) -> (String, Vec<u8>) {
        (name.to_owned(), text.as_bytes().to_vec())
    }

    #[test]
    fn the_pages_of_a_lab_are_of_one_moment() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        assert!(book.class_pages(LAB).is_empty());
        let all = [
            file(CLASS_FILE, "one"),
            file(STUDENTS_FILE, "s1"),
            file("jplag/base/a", "x"),
        ];
        assert!(book.put_class_pages(LAB, &all).unwrap().is_empty());
        assert_eq!(book.class_pages(LAB), [CLASS_FILE, STUDENTS_FILE]);
        let gone = book
            .put_class_pages(LAB, &[file(CLASS_FILE, "two")])
            .unwrap();
        assert_eq!(gone, ["jplag", STUDENTS_FILE]);
        let folder = bed.path().join(pages_path(LAB));
        assert_eq!(names(&folder), [CLASS_FILE]);
        assert_eq!(
            std::fs::read_to_string(folder.join(CLASS_FILE)).unwrap(),
            "two"
        );
        assert_eq!(names(&bed.path().join(PAGES)), [LAB], "nothing is left");
        assert_eq!(book.remove_class_pages().unwrap(), 1);
        assert_eq!(book.remove_class_pages().unwrap(), 0);
        assert!(!bed.path().join(PAGES).exists());
    }

    #[cfg(unix)]
    #[test]
    fn only_the_owner_can_read_them() {
        use std::os::unix::fs::PermissionsExt as _;
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        book.put_class_pages(LAB, &[file("jplag/a", "x")]).unwrap();
        for path in ["", "jplag", "jplag/a"] {
            let path = bed.path().join(pages_path(LAB)).join(path);
            let mode = path.metadata().unwrap().permissions().mode();
            assert_eq!(mode & 0o077, 0, "{}", path.display());
        }
    }
}
