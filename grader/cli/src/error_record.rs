//! A failure as programs read it: with `--json` a command that fails prints this to standard output, if it has printed nothing else.

use clap::error::ErrorKind;
use miette::{Diagnostic, LabeledSpan, SourceCode};
use serde::Serialize;

use crate::failure::{BROKEN, FAULT, INTERRUPTED, USAGE};
use crate::output::JSON_FORMAT;
use crate::shown_diagnostic::lines;

/// What kind of failure it is, where the file that is wrong has no code of its own. docs/terminal.md lists them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ErrorCode {
    /// What was typed cannot be done.
    Usage,
    /// There is no such option.
    UnknownOption,
    /// There is no such command.
    UnknownCommand,
    /// An option or an argument has a value that it cannot have.
    Value,
    /// Something must be given and is not.
    Missing,
    /// Two options exclude each other.
    Conflict,
    /// There is no file or folder where one was named.
    NoFile,
    /// Nothing has the name that was given.
    UnknownName,
    /// Something is already where something is to be written.
    Exists,
    /// Two reports are of two labs.
    OtherLab,
    /// A lab may be part of what was handed in.
    HandedIn,
    /// This machine cannot seal a worker as was asked for.
    Sandbox,
    /// A port cannot be used.
    Port,
    /// A file or a folder is not what it should be.
    Broken,
    /// A folder is no report, or not a whole one.
    NoReport,
    /// A course has no book yet.
    NoBook,
    /// This machine, or the grader, failed.
    Fault,
    /// A compiler is missing.
    NoCompiler,
    /// Something cannot be written.
    Unwritten,
    /// This machine could not finish a run.
    Undecided,
    /// Ctrl-C.
    Interrupted,
}

impl ErrorCode {
    /// All of them.
    #[cfg(test)]
    const ALL: [Self; 21] = [
        Self::Usage,
        Self::UnknownOption,
        Self::UnknownCommand,
        Self::Value,
        Self::Missing,
        Self::Conflict,
        Self::NoFile,
        Self::UnknownName,
        Self::Exists,
        Self::OtherLab,
        Self::HandedIn,
        Self::Sandbox,
        Self::Port,
        Self::Broken,
        Self::NoReport,
        Self::NoBook,
        Self::Fault,
        Self::NoCompiler,
        Self::Unwritten,
        Self::Undecided,
        Self::Interrupted,
    ];

    /// Its name, as programs read it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Usage => "cli::usage",
            Self::UnknownOption => "cli::unknown_option",
            Self::UnknownCommand => "cli::unknown_command",
            Self::Value => "cli::value",
            Self::Missing => "cli::missing",
            Self::Conflict => "cli::conflict",
            Self::NoFile => "cli::no_file",
            Self::UnknownName => "cli::unknown_name",
            Self::Exists => "cli::exists",
            Self::OtherLab => "cli::other_lab",
            Self::HandedIn => "cli::handed_in",
            Self::Sandbox => "cli::sandbox",
            Self::Port => "cli::port",
            Self::Broken => "cli::broken",
            Self::NoReport => "cli::no_report",
            Self::NoBook => "cli::no_book",
            Self::Fault => "cli::fault",
            Self::NoCompiler => "cli::no_compiler",
            Self::Unwritten => "cli::unwritten",
            Self::Undecided => "cli::undecided",
            Self::Interrupted => "cli::interrupted",
        }
    }

    /// The exit code that a command ends with.
    pub(crate) fn exit(self) -> u8 {
        match self {
            Self::Usage
            | Self::UnknownOption
            | Self::UnknownCommand
            | Self::Value
            | Self::Missing
            | Self::Conflict
            | Self::NoFile
            | Self::UnknownName
            | Self::Exists
            | Self::OtherLab
            | Self::HandedIn
            | Self::Sandbox
            | Self::Port => USAGE,
            Self::Broken | Self::NoReport | Self::NoBook => BROKEN,
            Self::Fault | Self::NoCompiler | Self::Unwritten | Self::Undecided => FAULT,
            Self::Interrupted => INTERRUPTED,
        }
    }

    fn of_typed(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::UnknownArgument => Self::UnknownOption,
            ErrorKind::InvalidSubcommand => Self::UnknownCommand,
            ErrorKind::InvalidValue | ErrorKind::ValueValidation | ErrorKind::InvalidUtf8 => {
                Self::Value
            }
            ErrorKind::MissingRequiredArgument
            | ErrorKind::MissingSubcommand
            | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => Self::Missing,
            ErrorKind::ArgumentConflict => Self::Conflict,
            _ => Self::Usage,
        }
    }
}

/// What is printed.
#[derive(Debug, Serialize)]
pub(crate) struct ErrorEnvelope {
    format: u32,
    error: ErrorRecord,
}

/// One failure.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct ErrorRecord {
    code: String,
    message: String,
    help: Option<String>,
    span: Option<SpanRecord>,
    /// What else is wrong in the same file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    others: Vec<ErrorRecord>,
}

/// A position in a file. Line and column count from 1, columns and the length in characters.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct SpanRecord {
    file: Option<String>,
    line: usize,
    column: usize,
    length: usize,
}

impl ErrorEnvelope {
    /// The envelope of `error`.
    pub(crate) fn of(error: ErrorRecord) -> Self {
        Self {
            format: JSON_FORMAT,
            error,
        }
    }
}

impl ErrorRecord {
    /// The record of `diagnostic`, whose code is `code` where it has none of its own.
    pub(crate) fn of(diagnostic: &dyn Diagnostic, code: ErrorCode) -> Self {
        Self::inside(diagnostic, None, code.name())
    }

    fn inside(diagnostic: &dyn Diagnostic, source: Option<&dyn SourceCode>, code: &str) -> Self {
        let source = diagnostic.source_code().or(source);
        let own = diagnostic.code().map(|own| own.to_string());
        let code = own.unwrap_or_else(|| code.to_owned());
        let labels: Vec<LabeledSpan> = diagnostic.labels().into_iter().flatten().collect();
        let primary = labels.iter().find(|label| label.primary());
        let label = primary.or_else(|| labels.first());
        let span = source
            .zip(label)
            .and_then(|(source, label)| SpanRecord::of(source, label));
        let others = diagnostic.related().into_iter().flatten();
        let others = others.map(|other| Self::inside(other, source, &code));
        Self {
            message: lines(&diagnostic.to_string()),
            help: diagnostic.help().map(|help| lines(&help.to_string())),
            span,
            others: others.collect(),
            code,
        }
    }

    /// The record of words that are no command.
    pub(crate) fn of_typed(error: &clap::Error) -> Self {
        let text = error.to_string();
        let mut parts = text.split("\n\n").map(str::trim);
        let message = parts.next().unwrap_or_default();
        let mut rest: Vec<&str> = parts.filter(|part| !part.starts_with("Usage:")).collect();
        // with something better to do, where to read more is left out
        if rest.len() > 1 {
            rest.retain(|part| !part.starts_with("For more information"));
        }
        Self {
            code: ErrorCode::of_typed(error.kind()).name().to_owned(),
            message: message.trim_start_matches("error: ").to_owned(),
            help: (!rest.is_empty()).then(|| rest.join("\n")),
            span: None,
            others: Vec::new(),
        }
    }
}

impl SpanRecord {
    fn of(source: &dyn SourceCode, label: &LabeledSpan) -> Option<Self> {
        // with the line before it, what is read begins where a line begins
        let contents = source.read_span(label.inner(), 1, 0).ok()?;
        let start = label.offset().checked_sub(contents.span().offset())?;
        let data = contents.data();
        let before = data.get(..start)?;
        let meant = data.get(start..(start + label.len()).min(data.len()))?;
        let characters = |bytes: &[u8]| String::from_utf8_lossy(bytes).chars().count();
        let newlines = before.iter().filter(|byte| **byte == b'\n').count();
        let line_start = before.iter().rposition(|byte| *byte == b'\n');
        let line_start = line_start.map_or(0, |newline| newline + 1);
        Some(Self {
            file: contents.name().map(str::to_owned),
            line: contents.line() + newlines + 1,
            column: characters(&before[line_start..]) + 1,
            length: characters(meant),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use miette::NamedSource;

    #[derive(Debug, thiserror::Error, Diagnostic)]
    #[error("no joint `elbö`")]
    #[diagnostic(code(lab::unknown_joint), help("joints: elbow"))]
    struct Wrong {
        #[source_code]
        text: NamedSource<String>,
        #[label("here")]
        at: miette::SourceSpan,
    }

    #[test]
    fn a_position_counts_characters_from_one() {
        let text = "first = 1\nü = \"elbö\"\n".to_owned();
        let at = text.find("\"elb").expect("a joint");
        let wrong = Wrong {
            at: (at, "\"elbö\"".len()).into(),
            text: NamedSource::new("lab.toml", text),
        };
        let record = ErrorRecord::of(&wrong, ErrorCode::Broken);
        assert_eq!(record.code, "lab::unknown_joint");
        assert_eq!(record.help.as_deref(), Some("joints: elbow"));
        let expected = SpanRecord {
            file: Some("lab.toml".to_owned()),
            line: 2,
            column: 5,
            length: 6,
        };
        assert_eq!(record.span, Some(expected));
    }

    #[test]
    fn words_that_are_no_command_have_a_code_a_message_and_a_help() {
        use crate::command_line::CommandLine;
        use clap::Parser as _;
        let codes = [
            ("grade --no-such", ErrorCode::UnknownOption),
            ("graed", ErrorCode::UnknownCommand),
            ("grade --variants x", ErrorCode::Value),
            ("compare a", ErrorCode::Missing),
            ("grade --json --format short", ErrorCode::Conflict),
        ];
        for (words, code) in codes {
            let typed = std::iter::once("kinemark").chain(words.split(' '));
            let error = CommandLine::try_parse_from(typed).expect_err(words);
            let record = ErrorRecord::of_typed(&error);
            assert_eq!(record.code, code.name(), "{words}");
            assert!(!record.message.starts_with("error"), "{record:?}");
            assert!(!record.message.contains("Usage"), "{record:?}");
            assert!(record.help.is_some(), "{record:?}");
        }
    }

    #[test]
    fn every_code_is_in_the_documentation() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/terminal.md");
        let page = std::fs::read_to_string(page).expect("page");
        for code in ErrorCode::ALL {
            let row = format!("| `{}` | {} |", code.name(), code.exit());
            assert!(page.contains(&row), "{code:?}");
        }
        let rows = page.lines().filter(|line| line.starts_with("| `cli::"));
        assert_eq!(rows.count(), ErrorCode::ALL.len());
    }

    /// Codes of a crate's own, as its sources have them: `code(hand_in::damaged)` and `"course::time"`.
    fn codes_below(folder: &std::path::Path, codes: &mut std::collections::BTreeSet<String>) {
        for entry in std::fs::read_dir(folder).expect("folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                codes_below(&path, codes);
                continue;
            }
            let text = std::fs::read_to_string(&path).expect("text");
            let is_part = |letter: char| letter.is_ascii_lowercase() || matches!(letter, '_' | ':');
            for begin in ["code(", "\""] {
                let found = text.match_indices(begin).map(|(at, _)| {
                    let rest = &text[at + begin.len()..];
                    let end = rest.find(|letter| !is_part(letter)).unwrap_or(rest.len());
                    (&rest[..end], &rest[end..])
                });
                let closed = found.filter(|(_, rest)| rest.starts_with([')', '"']));
                codes.extend(closed.map(|(code, _)| code.to_owned()));
            }
        }
    }

    #[test]
    fn every_code_of_a_course_is_in_the_documentation() {
        let house = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let page = std::fs::read_to_string(house.join("docs/terminal.md")).expect("page");
        let mut codes = std::collections::BTreeSet::new();
        codes_below(&house.join("grader/course/src"), &mut codes);
        codes_below(&house.join("grader/cli/src"), &mut codes);
        let families = [
            "cli::",
            "hand_in::",
            "pack::",
            "release::",
            "course::",
            "fixes::",
        ];
        let is_listed = |code: &&String| families.iter().any(|family| code.starts_with(family));
        let own: Vec<&String> = codes.iter().filter(is_listed).collect();
        assert!(own.len() > 30, "{own:?}");
        for code in own.into_iter().filter(|code| !code.ends_with(':')) {
            assert!(page.contains(&format!("`{code}`")), "{code}");
        }
    }
}
