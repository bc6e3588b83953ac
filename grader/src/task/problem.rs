//! Everything that can be wrong with a lab.

use kinemark_sim::format::RobotError;
use kinemark_sim::format::SceneError;
use kinemark_sim::text::{Located, Problem, suggest};
use miette::Diagnostic;

/// A problem in a lab's files, with its place. What it is about is a type of whoever found it.
pub type LabError = Located<Box<dyn Problem>>;

/// Why a lab cannot be loaded.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum LoadError {
    /// There is no such lab.
    #[error("no lab is called `{name}`")]
    #[diagnostic(code(lab::unknown_lab))]
    UnknownLab {
        /// The name asked for.
        name: String,
        /// The labs there are, or the nearest.
        #[help]
        help: String,
    },
    /// A file that is there cannot be read.
    #[error("{path}: {why}")]
    #[diagnostic(code(lab::unreadable))]
    Unreadable {
        /// The path, as a person knows it.
        path: String,
        /// Why.
        why: String,
    },
    /// The lab, or the staff's part of it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Lab(#[from] LabError),
    /// Its robot.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Robot(#[from] RobotError),
    /// A scene of it.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Scene(#[from] SceneError),
}

/// The nearest of `known` to what was typed, in words.
pub(crate) fn near<'n>(
    typed: &str,
    what: &str,
    known: impl IntoIterator<Item = &'n (impl AsRef<str> + ?Sized + 'n)>,
) -> String {
    suggest(typed, what, known.into_iter().map(AsRef::as_ref))
}

/// An enum of problems, each a line of a table: its data, then its code, its message, what stands under the caret, and something to
/// do where there is something to say beyond that. The message is a format string over the data; the others are expressions over it.
#[macro_export]
macro_rules! problems {
    (
        $(#[$of_all:meta])*
        $vis:vis enum $name:ident {
            $(
                $variant:ident $({ $($field:ident: $type:ty),+ })?:
                    $code:literal, $message:literal, $label:expr $(, $help:expr)?;
            )+
        }
    ) => {
        $(#[$of_all])*
        #[derive(Debug)]
        $vis enum $name {
            $($variant $({ $($field: $type),+ })?,)+
        }

        impl $name {
            /// The message, the label and the help.
            fn words(&self) -> (String, String, Option<String>) {
                match self {
                    $(Self::$variant { $($($field),+)? } => (
                        std::fmt::format(format_args!($message)),
                        String::from($label),
                        None$(.or(Some(String::from($help))))?,
                    ),)+
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(&self.words().0)
            }
        }

        impl kinemark_sim::text::Problem for $name {
            fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $code,)+
                }
            }

            fn label(&self) -> String {
                self.words().1
            }

            fn help(&self) -> Option<String> {
                self.words().2
            }
        }
    };
}
pub use problems;
