//! The files of one person as a source has them, with everything in it that says who the person is.

use jiff::Timestamp;

use crate::tree::Tree;

/// Something in a source that may say whose files these are. None is believed before the roster has been asked.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hint {
    /// The id of a student, given as such.
    Id(String),
    /// The id by which the LMS knows a person, such as Canvas's user id.
    LmsId(String),
    /// A login.
    Username(String),
    /// A full name.
    Name(String),
    /// A sortable name without anything but letters and digits, as Canvas writes it.
    Slug(String),
    /// An address.
    Email(String),
    /// The name of a repository.
    Repository(String),
    /// The name of a group that hands in together.
    Group(String),
    /// The name of a folder or a file, which may hold an id.
    PathName(String),
}

impl Hint {
    /// What it says.
    pub fn text(&self) -> &str {
        match self {
            Self::Id(text)
            | Self::LmsId(text)
            | Self::Username(text)
            | Self::Name(text)
            | Self::Slug(text)
            | Self::Email(text)
            | Self::Repository(text)
            | Self::Group(text)
            | Self::PathName(text) => text,
        }
    }
}

/// One file of a person.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PersonFile {
    /// Its path inside the person's files, as the person named it.
    pub path: String,
    /// Its number among [`crate::tree::Tree::entries`].
    pub entry: usize,
}

/// What is wrong with the files of a person as a whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PersonProblem {
    /// What, in words.
    pub what: String,
    /// What to do.
    pub help: String,
}

/// The files of one person, or of one group.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PersonFiles {
    /// The folder or file, as people see it in the source. No two of a source have the same.
    pub label: String,
    /// Who it may be.
    pub hints: Vec<Hint>,
    /// Their files, by path.
    pub files: Vec<PersonFile>,
    /// When they handed in, where the source says it.
    pub submitted_at: Option<Timestamp>,
    /// Whether the LMS marked it as late, where it marks.
    pub marked_late: Option<bool>,
    /// The number of the attempt, where there is one.
    pub attempt: Option<u32>,
    /// The number by which the LMS knows the person or the group in its files.
    pub lms_number: Option<String>,
    /// What keeps the files from being used.
    pub problems: Vec<PersonProblem>,
}

impl PersonFiles {
    /// All files of a source as those of one person, such as one upload.
    pub fn of_all(tree: &Tree) -> Self {
        let entries = tree.entries().iter().enumerate();
        let files = entries.map(|(entry, file)| PersonFile {
            path: file.path.clone(),
            entry,
        });
        Self {
            files: files.collect(),
            ..Self::default()
        }
    }
}
