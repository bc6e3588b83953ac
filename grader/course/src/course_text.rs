//! The files that people write for a course: TOML read with the place of every mistake, tables in the encodings of spreadsheets.

use std::borrow::Cow;
use std::path::Path;

use kinemark_grader::task::problem::LabError;
use kinemark_grader::task::problem::problems;
use kinemark_sim::text::{FormatProblem, Located, Problem, Source, TomlRefusal, format_of};
use serde::de::DeserializeOwned;

/// A mistake in a file of the course, with its place.
pub type TextError = LabError;

/// Files of a course are written by people; above this a file is something else.
pub const MOST_BYTES: u64 = 16 << 20;

/// What the TOML reader refused.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Refused {
    message: String,
    help: Option<String>,
}

impl Problem for Refused {
    fn code(&self) -> &'static str {
        "course::toml"
    }

    fn label(&self) -> String {
        "here".to_owned()
    }

    fn help(&self) -> Option<String> {
        self.help.clone()
    }
}

problems! {
    /// What is wrong with a file before its tables are looked at.
    enum UnreadProblem {
        Unread { problem: FormatProblem }:
            "course::unknown_format", "{problem}", problem.label(), problem.help();
    }
}

/// Refuses what is at the bytes `at` of a text.
///
/// # Errors
/// Always: `problem`, with its place.
pub fn refuse<T>(
    source: &Source,
    at: std::ops::Range<usize>,
    problem: impl Problem,
) -> Result<T, TextError> {
    Err(Located::new(Box::new(problem), source, at))
}

/// Reads TOML into its tables.
///
/// # Errors
/// What is no TOML, or no such tables, and a format that is not read.
pub fn tables<T: DeserializeOwned>(source: &Source) -> Result<T, TextError> {
    format_of(source)
        .or_else(|(problem, at)| refuse(source, at, UnreadProblem::Unread { problem }))?;
    toml::from_str(source.text()).map_err(|error| {
        let TomlRefusal { message, help, at } = TomlRefusal::from_error(&error, source.text());
        let problem: Box<dyn Problem> = Box::new(Refused { message, help });
        Located::new(problem, source, at)
    })
}

/// A file as people have it from a spreadsheet: UTF-8 with or without a mark, UTF-16 with one, else Windows-1252, which every byte is.
pub fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    if let Some((encoding, mark)) = encoding_rs::Encoding::for_bom(bytes) {
        return encoding.decode_without_bom_handling(&bytes[mark..]).0;
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => {
            encoding_rs::WINDOWS_1252
                .decode_without_bom_handling(bytes)
                .0
        }
    }
}

/// Reads a file that has to be there.
///
/// # Errors
/// Why it cannot be read, in words.
pub fn read(path: &Path) -> Result<Vec<u8>, String> {
    let plain = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string(),
    };
    let there = path.metadata().map_err(plain)?;
    if !there.is_file() {
        return Err("it is not a file".to_owned());
    }
    if there.len() > MOST_BYTES {
        return Err(format!("it has more than {MOST_BYTES} bytes"));
    }
    std::fs::read(path).map_err(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_spreadsheets_are_read_in_their_encodings() {
        for bytes in [
            "id;Grüße".as_bytes().to_vec(),
            "\u{feff}id;Grüße".as_bytes().to_vec(),
            b"id;Gr\xfc\xdfe".to_vec(),
            [0xff, 0xfe]
                .into_iter()
                .chain("id;Grüße".encode_utf16().flat_map(u16::to_le_bytes))
                .collect(),
        ] {
            assert_eq!(decoded(&bytes), "id;Grüße");
        }
    }
}
