//! What a search for a submission ends in: a file, or what a person has to decide.

use crate::module_sources::SourceFile;
use crate::tree::EntryProblem;

/// The largest submission that is read \[bytes\].
pub const MOST_SUBMISSION_BYTES: u64 = 1 << 20;

/// The largest hand-in file that is read \[bytes\]: it has a submission and a record in it.
pub const MOST_HAND_IN_BYTES: u64 = 8 << 20;

/// A file that is a person's submission, or may be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Its path in the source; `/` leads into archives, too.
    pub path: String,
    /// Its name without folders.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Whether it is a hand-in file and no submission itself.
    pub is_hand_in: bool,
    /// The `variant.toml` in its folder, where there is one that can be read.
    pub variant: Option<Vec<u8>>,
    /// The sources beside it, where it is a module.
    pub sources: Vec<SourceFile>,
}

/// Why nobody but a person can say which file it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unselected {
    /// Several files, equally near to the top.
    Ambiguous(Vec<Found>),
    /// None.
    NothingFound {
        /// What is there, in words.
        instead: String,
        /// Files that are no submission by their names and may be one all the same, such as an edited starter.
        possible: Vec<Found>,
    },
    /// One that cannot be read.
    Unusable {
        /// Its path in the source.
        path: String,
        /// What is wrong with it.
        problem: EntryProblem,
    },
}

impl Unselected {
    /// What is not clear, in words.
    pub fn what(&self) -> String {
        match self {
            Self::Ambiguous(files) => {
                let paths: Vec<String> = files.iter().map(|file| shown(&file.path)).collect();
                format!(
                    "{} files may be the submission: {}",
                    files.len(),
                    paths.join(", ")
                )
            }
            Self::NothingFound { instead, .. } => {
                format!("no submission is in it; there is {instead}")
            }
            Self::Unusable { path, problem } => format!("{}: {problem}", shown(path)),
        }
    }

    /// What to do.
    pub fn help(&self) -> String {
        match self {
            Self::Ambiguous(_) => "ask which one counts, and name it in fixes.toml".to_owned(),
            Self::NothingFound { possible, .. } if possible.is_empty() => {
                "ask for submission.rhai, or for the file that `kinemark submit` writes".to_owned()
            }
            Self::NothingFound { .. } => {
                "if one of these is the work, name it in fixes.toml; else ask for submission.rhai"
                    .to_owned()
            }
            Self::Unusable { problem, .. } => problem.help().to_owned(),
        }
    }

    /// The files that a person can choose from.
    pub fn candidates(&self) -> &[Found] {
        match self {
            Self::Ambiguous(files) => files,
            Self::NothingFound { possible, .. } => possible,
            Self::Unusable { .. } => &[],
        }
    }
}

/// A path in a message.
pub(super) fn shown(path: &str) -> String {
    format!("`{}`", kinemark_report::visible::visible(path))
}
