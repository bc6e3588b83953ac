//! What can be wrong with a source as a whole, and with one file of it, in words and with what to do.

/// Why a source cannot be read at all.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("{path}: {what}")]
pub struct TreeError {
    /// The source, as a person knows it.
    pub path: String,
    /// What is wrong, in words.
    pub what: String,
    /// What to do.
    #[help]
    pub help: String,
}

/// Why one file of a source cannot be used. The others can.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EntryProblem {
    /// A symbolic link.
    #[error("it is a symbolic link, and links are never followed")]
    Link,
    /// A device, a pipe, a socket.
    #[error("it is not a regular file")]
    Special,
    /// A path from the root of a disk.
    #[error("its name is an absolute path")]
    Absolute,
    /// A path with `..`.
    #[error("its name leads out of its folder (`..`)")]
    Outside,
    /// A control character in the name.
    #[error("its name has an invisible character (U+{number:04X})")]
    ControlCharacter {
        /// Its number in Unicode.
        number: u32,
    },
    /// A name that is too long.
    #[error("its name has {bytes} bytes (at most {most})")]
    LongName {
        /// How long it is.
        bytes: usize,
        /// How long it may be.
        most: usize,
    },
    /// No name, or only dots and separators.
    #[error("it has no name")]
    NoName,
    /// The same name twice.
    #[error("two files have its name")]
    Duplicate,
    /// A name that a reader or another file system would take for this one.
    #[error("its name differs from `{other}` only in case or in characters that look alike")]
    Alike {
        /// The other name.
        other: String,
    },
    /// A password is needed.
    #[error("it is encrypted")]
    Encrypted,
    /// A compression that is not read.
    #[error("its compression ({method}) is not supported")]
    Compression {
        /// The method, as the archive calls it.
        method: String,
    },
    /// Bytes that do not fit together.
    #[error("it is damaged ({why})")]
    Damaged {
        /// What does not fit.
        why: String,
    },
    /// More bytes than expected of such a file.
    #[error("it has more than {most} bytes")]
    TooLarge {
        /// How many are read.
        most: u64,
    },
    /// The share of this person, or of the whole source, is used up.
    #[error("more than {most} bytes came out of what was handed in, so it was not read")]
    Budget {
        /// How many are unpacked.
        most: u64,
    },
    /// More entries than a hand-in has.
    #[error("it lists {found} entries (at most {most})")]
    TooManyEntries {
        /// How many it lists.
        found: usize,
        /// How many it may.
        most: usize,
    },
    /// Archives inside archives.
    #[error("it is an archive inside {most} archives")]
    TooDeep {
        /// How many are opened.
        most: u32,
    },
    /// Another kind of file than its name says.
    #[error("it is {found}, not {expected}")]
    OtherKind {
        /// What it is, such as "a RAR archive".
        found: &'static str,
        /// What it should be.
        expected: &'static str,
    },
    /// What the system says.
    #[error("it cannot be read: {why}")]
    Unreadable {
        /// In the system's words.
        why: String,
    },
}

impl EntryProblem {
    /// What to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Link | Self::Special => "ask for the file itself",
            Self::Absolute
            | Self::Outside
            | Self::ControlCharacter { .. }
            | Self::LongName { .. }
            | Self::NoName => "ask for it under a plain name, such as submission.rhai",
            Self::Duplicate | Self::Alike { .. } => "ask which of the two is meant",
            Self::Encrypted => "ask for it without a password",
            Self::Compression { .. } | Self::OtherKind { .. } | Self::TooDeep { .. } => {
                "ask for submission.rhai itself, or for an ordinary ZIP archive"
            }
            Self::Damaged { .. } => "download it again; if that does not help, ask for it again",
            Self::TooLarge { .. } | Self::Budget { .. } | Self::TooManyEntries { .. } => {
                "ask for submission.rhai alone"
            }
            Self::Unreadable { .. } => "see who may read it, and run the command again",
        }
    }
}
