//! A finding: who shares what, where it stands in each file, and how many of the class share it.

use serde::Serialize;

use crate::student::StudentId;

/// What is shared. The order is that of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The whole file.
    SameFile,
    /// The numbers of another student's variant.
    ForeignNumbers,
    /// The whole file, with one of an earlier year or a public one.
    EarlierFile,
    /// Passages, with a file of an earlier year or a public one.
    EarlierPassage,
    /// Long passages that few share.
    Passage,
    /// Passages with comments that many share: from a slide, a book, a forum, or from each other.
    CommonPassage,
}

impl Kind {
    /// In words, for people.
    pub fn words(self) -> &'static str {
        match self {
            Self::SameFile => "the same file",
            Self::ForeignNumbers => "numbers of another student's variant",
            Self::EarlierFile => "the same file as an earlier or public one",
            Self::EarlierPassage => "passages of an earlier or public file",
            Self::Passage => "long equal passages",
            Self::CommonPassage => "passages with comments that many share",
        }
    }
}

/// Whose file it is.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Whose {
    /// A student's of the class.
    Student(StudentId),
    /// One of an earlier year, or a public one: its path.
    Earlier(String),
}

/// Where something was found in a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Found {
    /// Whose file.
    pub whose: Whose,
    /// The name of the file.
    pub file: String,
    /// Its lines, from one: first and last of each place.
    pub lines: Vec<(usize, usize)>,
}

/// Something that is worth a conversation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// What is shared.
    pub kind: Kind,
    /// Whose files, and where in them.
    pub files: Vec<Found>,
    /// What exactly, in words.
    pub says: String,
    /// A piece of it, from the first file; empty where there is nothing to show.
    pub excerpt: String,
    /// How many tokens, or numbers, are shared: more is rarer.
    pub size: usize,
    /// The base rate: how many students of the class share it ...
    pub shared_by: usize,
    /// ... of how many whose files were compared.
    pub of: usize,
}

impl Finding {
    /// The students in it.
    pub fn students(&self) -> impl Iterator<Item = &StudentId> {
        self.files.iter().filter_map(|found| match &found.whose {
            Whose::Student(student) => Some(student),
            Whose::Earlier(_) => None,
        })
    }

    /// The base rate in words, such as `3 of 120`.
    pub fn base_rate(&self) -> String {
        format!("{} of {}", self.shared_by, self.of)
    }
}
