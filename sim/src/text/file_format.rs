//! Which version of its tables a file is written in: the key `format`, which every file has that people write.
//!
//! It is read before all else, since a file for a newer version may have keys that are not known here. Once there is a second format, the
//! one place to branch is where [`format_of`] is called: an older file is read by its own tables and becomes what the newer ones give.

use std::borrow::Cow;
use std::ops::Range;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use toml::de::DeTable;

use super::Source;

/// The format that this version reads and writes.
pub const FORMAT: i64 = 1;

/// A file in a format that is not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FormatProblem {
    /// One that is to come.
    #[error("this file is written for a newer Kinemark: format {found}; this one reads {FORMAT}")]
    Newer {
        /// What the file says.
        found: i64,
    },
    /// One that never was.
    #[error("format {found} is not known; this version reads {FORMAT}")]
    Unknown {
        /// What the file says.
        found: i64,
    },
}

impl FormatProblem {
    /// What stands there.
    pub fn label(self) -> &'static str {
        match self {
            Self::Newer { .. } => "a newer format",
            Self::Unknown { .. } => "no such format",
        }
    }

    /// What to do.
    pub fn help(self) -> String {
        match self {
            Self::Newer { .. } => {
                "grade with the version of Kinemark that this file came with; `kinemark --version` prints which one this is".to_owned()
            }
            Self::Unknown { .. } => format!("write `format = {FORMAT}`"),
        }
    }
}

/// Whether a file of this format is read.
///
/// # Errors
/// A format that is not.
fn readable(found: i64) -> Result<i64, FormatProblem> {
    match found {
        FORMAT => Ok(found),
        _ if found > FORMAT => Err(FormatProblem::Newer { found }),
        _ => Err(FormatProblem::Unknown { found }),
    }
}

/// The format of a file in TOML. What says none, or is no TOML, has [`FORMAT`]: the reader of its tables says what is wrong.
///
/// # Errors
/// A format that is not read, and where it stands.
pub fn format_of(source: &Source) -> Result<i64, (FormatProblem, Range<usize>)> {
    let Ok(table) = DeTable::parse(source.text()) else {
        return Ok(FORMAT);
    };
    let Some(typed) = table.get_ref().get("format") else {
        return Ok(FORMAT);
    };
    let number = typed.get_ref().as_integer();
    let number = number.and_then(|n| i64::from_str_radix(n.as_str(), n.radix()).ok());
    readable(number.unwrap_or(FORMAT)).map_err(|problem| (problem, typed.span()))
}

/// The key `format` in a table, which [`format_of`] has looked at before.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(transparent)]
pub struct FileFormat(#[expect(dead_code, reason = "`format_of` reads it")] i64);

impl JsonSchema for FileFormat {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "FileFormat".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "const": FORMAT })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_newer_file_says_so_whatever_else_is_in_it() {
        let of = |text: &str| format_of(&Source::new("a.toml", text));
        for text in [
            "format = 1\n",
            "name = 'x'\n",
            "format = ",
            "format = 'one'\n",
        ] {
            assert_eq!(of(text), Ok(FORMAT), "{text}");
        }
        let (problem, at) = of("new_key = 1\nformat = 2\n").unwrap_err();
        assert_eq!(at, 21..22);
        assert_eq!(
            problem.to_string(),
            "this file is written for a newer Kinemark: format 2; this one reads 1"
        );
        for found in [0, -1] {
            let (problem, _) = of(&format!("format = {found}\n")).unwrap_err();
            assert_eq!(problem, FormatProblem::Unknown { found });
            assert_eq!(problem.help(), "write `format = 1`");
        }
    }
}
