//! Where labs are read from: a folder, or the copy inside the binary. The grader asks for files by path and opens none itself.

use kinemark_sim::text::Source;

use super::problem::LoadError;

/// Files by path, `/` between folders.
pub trait Files {
    /// What a person calls the place: a folder's name, or `built in`.
    fn name(&self) -> String;

    /// The bytes at `path`; `None` where there is no file.
    ///
    /// # Errors
    /// Why a file that is there cannot be read.
    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String>;

    /// The text at `path`; `None` where there is none.
    ///
    /// # Errors
    /// Why a file that is there cannot be read as UTF-8 text.
    fn read(&self, path: &str) -> Result<Option<String>, String> {
        self.bytes(path)?.map(text).transpose()
    }

    /// Names inside `folder` (`""` for the top), files and folders, sorted.
    fn list(&self, folder: &str) -> Vec<String>;
}

/// Files with the text of one of them replaced.
pub struct Replaced<'a> {
    /// The path of that one.
    pub path: String,
    /// Its text.
    pub text: &'a str,
    /// All others.
    pub rest: &'a dyn Files,
}

impl Files for Replaced<'_> {
    fn name(&self) -> String {
        self.rest.name()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        if path == self.path {
            return Ok(Some(self.text.as_bytes().to_vec()));
        }
        self.rest.bytes(path)
    }

    fn list(&self, folder: &str) -> Vec<String> {
        self.rest.list(folder)
    }
}

/// What to do about a file that cannot be read as text: it is too large, nobody may read it, or it is no text.
pub const UNREAD_HELP: &str =
    "check that it is the right file, that it is UTF-8 text, and that you may read it";

/// A file's bytes as text.
///
/// # Errors
/// The line and the column at which it stops being UTF-8, in words.
pub fn text(bytes: Vec<u8>) -> Result<String, String> {
    // of a text in UTF-16 with our letters, every second byte is 0
    let begins_with_zero = bytes.iter().take(2).filter(|byte| **byte == 0).count() == 1;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") || begins_with_zero {
        return Err("text in UTF-16: save it as UTF-8".to_owned());
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..at]);
        let line = before.matches('\n').count() + 1;
        let last = before.rsplit('\n').next().unwrap_or_default();
        let column = last.chars().count() + 1;
        format!("not text: what stands in line {line}, column {column}, is no UTF-8: was it saved as Windows-1252?")
    })
}

/// Reads a file as a [`Source`] whose name is its path; `None` where there is none.
pub(crate) fn read_source(files: &dyn Files, path: &str) -> Result<Option<Source>, LoadError> {
    match files.read(path) {
        Ok(text) => Ok(text.map(|text| Source::new(path, text))),
        Err(why) => Err(LoadError::Unreadable {
            path: format!("{}/{path}", files.name()),
            why,
        }),
    }
}
