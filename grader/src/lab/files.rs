//! Where labs are read from: a folder, or the copy inside the binary. The grader asks for texts by path and opens no file itself.

/// Texts by path, `/` between folders.
pub trait Files {
    /// What a person calls the place: a folder's name, or `built in`.
    fn name(&self) -> String;

    /// The text at `path`; `None` where there is none.
    ///
    /// # Errors
    /// Why a file that is there cannot be read as UTF-8 text.
    fn read(&self, path: &str) -> Result<Option<String>, String>;

    /// Names inside `folder` (`""` for the top), files and folders, sorted.
    fn list(&self, folder: &str) -> Vec<String>;
}
