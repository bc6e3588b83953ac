//! What ends a command early, with its exit code.

use std::process::ExitCode;

use kinemark_grader::task::problem::LoadError;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use textwrap::WordSplitter;

use crate::error_record::{ErrorCode, ErrorEnvelope, ErrorRecord};
use crate::shown_diagnostic::{ShownDiagnostic, lines, words};
use crate::{output, typed_words, wrapping};

/// Points lost, or a comparison that differs.
pub(crate) const LOST: u8 = 1;
/// The command line.
pub(crate) const USAGE: u8 = 2;
/// The lab, the robot, or the folder that was given.
pub(crate) const BROKEN: u8 = 3;
/// The grader or this machine.
pub(crate) const FAULT: u8 = 4;
/// Compared as far as that could be, and the same so far.
pub(crate) const PARTLY_COMPARED: u8 = 5;
/// As shells have it for Ctrl-C.
pub(crate) const INTERRUPTED: u8 = 130;

/// What ends a command early.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The exit code.
    code: u8,
    /// The cause as programs read it, where it is more than the exit code.
    cause: Option<ErrorCode>,
    diagnostic: Box<dyn Diagnostic + Send + Sync>,
}

/// A failure in words: what, and what to do.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("{message}")]
struct Words {
    message: String,
    #[help]
    help: Option<String>,
}

impl Failure {
    fn words(code: u8, message: String, help: Option<String>) -> Self {
        Self {
            code,
            cause: None,
            diagnostic: Box::new(Words { message, help }),
        }
    }

    /// The same failure with its cause, as programs read it.
    pub(crate) fn coded(mut self, cause: ErrorCode) -> Self {
        debug_assert_eq!(cause.exit(), self.code, "{cause:?}");
        self.cause = Some(cause);
        self
    }

    /// Something typed that cannot be.
    pub(crate) fn usage(message: String, help: &str) -> Self {
        Self::words(USAGE, message, Some(help.to_owned()))
    }

    /// A file or folder that was given and is not what it should be.
    pub(crate) fn broken(message: String, help: &str) -> Self {
        Self::words(BROKEN, message, Some(help.to_owned()))
    }

    /// This machine, or a fault of ours.
    pub(crate) fn fault(message: String, help: &str) -> Self {
        Self::words(FAULT, message, Some(help.to_owned()))
    }

    /// Ctrl-C.
    pub(crate) fn interrupted() -> Self {
        Self::words(
            INTERRUPTED,
            "interrupted; nothing was written".to_owned(),
            None,
        )
    }

    /// Ctrl-C, where what was done so far stands.
    pub(crate) fn paused() -> Self {
        Self::words(
            INTERRUPTED,
            "interrupted; what was graded so far stands".to_owned(),
            Some("the same command goes on from here".to_owned()),
        )
    }

    /// Ctrl-C while jobs of another machine work.
    pub(crate) fn left_alone(help: String) -> Self {
        let message = "interrupted; the jobs go on".to_owned();
        Self::words(INTERRUPTED, message, Some(help))
    }

    /// A diagnostic with a place in a file.
    pub(crate) fn diagnostic(
        code: u8,
        diagnostic: impl Diagnostic + Send + Sync + 'static,
    ) -> Self {
        Self {
            code,
            cause: None,
            diagnostic: Box::new(diagnostic),
        }
    }

    /// Prints the failure for a person, and for programs where they read what is printed, and gives the exit code.
    pub(crate) fn report(self) -> ExitCode {
        print_record(self.record());
        self.report_for_people()
    }

    /// Prints the failure for a person alone and gives the exit code.
    pub(crate) fn report_for_people(self) -> ExitCode {
        show(self.diagnostic.as_ref());
        ExitCode::from(self.code)
    }

    /// The failure as programs read it.
    pub(crate) fn record(&self) -> ErrorRecord {
        let of_exit = match self.code {
            USAGE => ErrorCode::Usage,
            BROKEN => ErrorCode::Broken,
            INTERRUPTED => ErrorCode::Interrupted,
            _ => ErrorCode::Fault,
        };
        ErrorRecord::of(self.diagnostic.as_ref(), self.cause.unwrap_or(of_exit))
    }
}

/// Prints what programs read of a failure, where JSON is asked for and none was printed: what is printed is one value.
pub(crate) fn print_record(record: ErrorRecord) {
    if typed_words::is_json() && !output::has_printed_json() {
        // an output that cannot be written is reported for people, as this failure is
        let _ = output::print_json(&ErrorEnvelope::of(record));
    }
}

/// Prints what ends nothing, but should be mended.
pub(crate) fn warn(what: &str, diagnostic: &dyn Diagnostic) {
    warn_alone(what);
    show(diagnostic);
}

/// Prints, in words, what ends nothing but should be looked at.
pub(crate) fn warn_in_words(message: &str, help: &str) {
    use std::io::Write as _;
    let text = format!("warning: {}\n  help: {}\n", words(message), words(help));
    // without standard error there is no one to warn
    let _ = anstream::stderr().write_all(text.as_bytes());
}

/// Prints, in words, what ends nothing and says by itself what to do. Lines after the first are indented, so that none can be taken
/// for something else.
pub(crate) fn warn_alone(message: &str) {
    use std::io::Write as _;
    let text = lines(message).replace('\n', "\n  ");
    // without standard error there is no one to warn
    let _ = anstream::stderr().write_all(format!("warning: {text}\n").as_bytes());
}

/// Prints, in words, what a person should know while nothing is wrong.
pub(crate) fn note_in_words(message: &str) {
    use std::io::Write as _;
    // without standard error there is no one to say it to
    let _ = anstream::stderr().write_all(format!("note: {}\n", words(message)).as_bytes());
}

fn show(diagnostic: &dyn Diagnostic) {
    use std::io::Write as _;
    // anstream strips the colours where they do not belong
    let _ = anstream::stderr().write_all(rendered(diagnostic).as_bytes());
}

/// Wider lines are hard to read.
const MOST_COLUMNS: usize = 100;
/// Narrower ones have no room for a place in a file.
const LEAST_COLUMNS: usize = 40;

/// A diagnostic in lines for a terminal, with colours.
pub(crate) fn rendered(diagnostic: &dyn Diagnostic) -> String {
    let mut text = String::new();
    let terminal = wrapping::columns(&std::io::stderr());
    let columns = terminal.map_or(MOST_COLUMNS, |columns| {
        columns.clamp(LEAST_COLUMNS, MOST_COLUMNS)
    });
    let theme = GraphicalTheme::unicode();
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(columns)
        // a name such as `04-knock` or a path stays whole
        .with_break_words(false)
        .with_word_separator(wrapping::separator())
        .with_word_splitter(WordSplitter::NoHyphenation);
    // the handler writes to a string, which cannot fail
    let _ = handler.render_report(&mut text, &ShownDiagnostic::of(diagnostic));
    text.trim_end().to_owned() + "\n"
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        let code = match error {
            LoadError::UnknownLab { .. } => USAGE,
            LoadError::Unreadable { .. }
            | LoadError::Lab(_)
            | LoadError::Robot(_)
            | LoadError::Scene(_) => BROKEN,
        };
        Self::diagnostic(code, error)
    }
}
