//! What leaves the command: standard output, and files that are whole or not there.

use std::collections::BTreeMap;
use std::io::{ErrorKind, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use kinemark_course::durable::{self, Readers};
use kinemark_report::visible::{visible, visible_json};
use kinemark_toolbox::styled_text::{Emphasis, StyledText};
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::disk::plain;
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::unfinished::unfinished_file;
use crate::wrapping;

/// A path in a line of output: folders may be called by what students chose, so characters that steer a terminal are written out.
pub(crate) fn path(path: &Path) -> String {
    visible(&path.display().to_string()).into_owned()
}

/// Prints text; colours are stripped where they do not belong, and a reader that has gone away is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = anstream::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::fault(
            format!("standard output cannot be written: {}", plain(&error)),
            "free some space, or send it elsewhere",
        )
        .coded(ErrorCode::Unwritten)),
        _ => Ok(()),
    }
}

/// Prints lines to read: a terminal gets them as wide as it is, with what does not fit below where the line began.
pub(crate) fn print_lines(text: &str) -> Result<(), Failure> {
    match wrapping::columns(&std::io::stdout()) {
        Some(columns) => print(&wrapping::wrapped(text, columns)),
        None => print(text),
    }
}

/// Prints text with emphasis, in colours where they belong.
pub(crate) fn print_styled(text: &StyledText) -> Result<(), Failure> {
    let styled = text.parts().map(|(emphasis, part)| match emphasis {
        Emphasis::Plain => part.to_owned(),
        Emphasis::Strong => part.bold().to_string(),
        Emphasis::Faint => part.dimmed().to_string(),
        Emphasis::Error => part.red().bold().to_string(),
        Emphasis::Warning => part.yellow().to_string(),
        Emphasis::Note => part.cyan().to_string(),
    });
    print(&styled.collect::<String>())
}

/// The format of what `--json` prints, where it has no name of its own: it changes when something is renamed or left out.
pub(crate) const JSON_FORMAT: u32 = 1;

/// Whether a value was printed as JSON.
static HAS_PRINTED_JSON: AtomicBool = AtomicBool::new(false);

/// Whether a value was printed as JSON.
pub(crate) fn has_printed_json() -> bool {
    HAS_PRINTED_JSON.load(Ordering::Relaxed)
}

/// Prints a value as JSON, in lines a person can read.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = json(value)?;
    HAS_PRINTED_JSON.store(true, Ordering::Relaxed);
    print(&text)
}

/// A value with the number of its format before it.
#[derive(Serialize)]
pub(crate) struct Formatted<T> {
    format: u32,
    #[serde(flatten)]
    value: T,
}

impl<T> Formatted<T> {
    /// The value as programs get it today.
    pub(crate) fn new(value: T) -> Self {
        Self {
            format: JSON_FORMAT,
            value,
        }
    }
}

/// Prints a value with named fields as JSON, the number of its format first.
pub(crate) fn print_formatted(value: &impl Serialize) -> Result<(), Failure> {
    print_json(&Formatted::new(value))
}

/// Prints a list as JSON, under its name, the number of its format first.
pub(crate) fn print_list<T: Serialize>(name: &str, list: &[T]) -> Result<(), Failure> {
    print_formatted(&BTreeMap::from([(name, list)]))
}

/// A value as JSON, in lines a person can read, with a line end.
pub(crate) fn json(value: &impl Serialize) -> Result<String, Failure> {
    match serde_json::to_string_pretty(value) {
        Ok(text) => Ok(visible_json(text) + "\n"),
        Err(error) => Err(Failure::fault(
            format!("a value could not be written as JSON: {error}"),
            "please report this",
        )),
    }
}

/// Writes a file whole, or says why not and what helps.
pub(crate) fn write_file(path: &Path, bytes: &[u8], help: &str) -> Result<(), Failure> {
    put(Readers::Umask, path, bytes).map_err(|error| unwritten(path, &error, help))
}

/// Writes a file that is not there yet, whole, in a folder that is made where it is missing; one that is there stays as it is.
pub(crate) fn write_new_file(path: &Path, bytes: &[u8], help: &str) -> Result<(), Failure> {
    let put = || {
        let folder = durable::parent(path);
        durable::make_folder(folder, Readers::Umask)?;
        let mut file = unfinished_file(folder, Readers::Umask)?;
        file.write_all(bytes)?;
        durable::put_in_free_place(file, path)
    };
    match put() {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            let message = format!("`{}` is there already, and stays as it is", path.display());
            Err(Failure::usage(message, help).coded(ErrorCode::Exists))
        }
        result => result.map_err(|error| {
            unwritten(path, &error, "free some space, or make the folder writable")
        }),
    }
}

/// Writes a file that its owner alone can read, whole, or says why not and what helps.
pub(crate) fn write_private_file(path: &Path, bytes: &[u8], help: &str) -> Result<(), Failure> {
    put(Readers::Owner, path, bytes).map_err(|error| unwritten(path, &error, help))
}

/// Why there is no file or folder at `path`.
pub(crate) fn unwritten(path: &Path, error: &std::io::Error, help: &str) -> Failure {
    let message = format!("`{}` cannot be written: {}", path.display(), plain(error));
    Failure::fault(message, help).coded(ErrorCode::Unwritten)
}

/// Writes to a temporary file beside `path`, then renames it.
fn put(readers: Readers, path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = unfinished_file(durable::parent(path), readers)?;
    file.write_all(bytes)?;
    durable::put_in_place(file, path)
}
