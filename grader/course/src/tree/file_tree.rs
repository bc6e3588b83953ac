//! The tree of files that layouts, and the search for a submission, read.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Cursor, Read as _, Seek as _};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::archive::{self, Archive, Bytes};
use super::file_kind::{ENOUGH_BYTES, file_kind, is_zip};
use super::folder;
use super::limits::Limits;
use super::listing::{BytesAt, Entry, Listing, MisnamedEntry};
use super::problem::{EntryProblem, TreeError};

/// A folder or a ZIP archive as a tree of files. Bytes are read when somebody wants them.
pub struct Tree {
    listing: Listing,
    archive: Option<Archive>,
    limits: Limits,
    /// What may still be read of the whole source; archives inside share it [bytes].
    left: Arc<AtomicU64>,
    /// How many archives this one is inside of.
    nesting: u32,
}

impl Tree {
    /// Opens a folder or a ZIP archive; which of the two it is, its bytes say and not its name.
    ///
    /// # Errors
    /// What is neither, what cannot be read, more entries than the limit.
    pub fn open(path: &Path, limits: &Limits) -> Result<Self, TreeError> {
        // a link that a person typed is followed: the links inside are not theirs
        let there = path.metadata();
        let there = there.map_err(|why| refuse(path, &unreadable(&why)))?;
        if there.is_dir() {
            let listing = folder::list(path, limits);
            return listing
                .map(|listing| Self::new(listing, None, limits))
                .map_err(|problem| refuse(path, &problem));
        }
        // a pipe would have to be waited for
        if !there.is_file() {
            return Err(refuse(path, &EntryProblem::Special));
        }
        let file = File::open(path);
        let file = file.map_err(|why| refuse(path, &unreadable(&why)))?;
        Self::of_file(file, path, limits)
    }

    /// The tree of a ZIP archive that is open; `path` is for people.
    ///
    /// # Errors
    /// As [`Tree::open`].
    pub fn of_file(mut file: File, path: &Path, limits: &Limits) -> Result<Self, TreeError> {
        let mut start = Vec::new();
        let read = (&mut file)
            .take(ENOUGH_BYTES as u64)
            .read_to_end(&mut start);
        let read = read.and_then(|_| file.rewind());
        let read = read.map_err(|error| unreadable(&error));
        read.and_then(|()| {
            zip_or_problem(&start)?;
            Self::of_archive(Box::new(BufReader::new(file)), limits)
        })
        .map_err(|problem| refuse(path, &problem))
    }

    /// The tree of a ZIP archive in memory.
    ///
    /// # Errors
    /// What is no ZIP archive, or a damaged one.
    pub fn of_zip(bytes: Vec<u8>, limits: &Limits) -> Result<Self, EntryProblem> {
        zip_or_problem(&bytes[..bytes.len().min(ENOUGH_BYTES)])?;
        Self::of_archive(Box::new(Cursor::new(bytes)), limits)
    }

    fn of_archive(bytes: Box<dyn Bytes>, limits: &Limits) -> Result<Self, EntryProblem> {
        let (archive, listing) = archive::list(bytes, limits)?;
        let is_document = listing
            .entries
            .iter()
            .any(|entry| entry.path == "[Content_Types].xml");
        if is_document {
            return Err(EntryProblem::OtherKind {
                found: "an Office document (docx, xlsx or pptx)",
                expected: ARCHIVE,
            });
        }
        Ok(Self::new(listing, Some(archive), limits))
    }

    fn new(listing: Listing, archive: Option<Archive>, limits: &Limits) -> Self {
        Self {
            listing,
            archive,
            limits: *limits,
            left: Arc::new(AtomicU64::new(limits.total_bytes)),
            nesting: 0,
        }
    }

    /// Its files, by path. What systems leave behind (`__MACOSX`, `.git` and the like) is not among them.
    pub fn entries(&self) -> &[Entry] {
        &self.listing.entries
    }

    /// Files that have no place in it, because their names lead elsewhere or cannot be shown.
    pub fn misnamed(&self) -> &[MisnamedEntry] {
        &self.listing.misnamed
    }

    /// The paths of its folders, with those that hold nothing anybody looks into.
    pub fn folders(&self) -> &BTreeSet<String> {
        &self.listing.folders
    }

    /// The paths of folders that are repositories: they have a `.git`. The empty path is the source itself.
    pub fn repositories(&self) -> &BTreeSet<String> {
        &self.listing.repositories
    }

    /// The limits it was opened with.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// The entry's own problem, more than `most` bytes, bytes that do not unpack.
    pub fn bytes(&self, entry: &Entry, most: u64) -> Result<Vec<u8>, EntryProblem> {
        let bytes = self.read(entry, most.saturating_add(1))?;
        if bytes.len() as u64 > most {
            return Err(EntryProblem::TooLarge { most });
        }
        Ok(bytes)
    }

    /// What a file is by its first bytes, where that is known.
    pub fn kind(&self, entry: &Entry) -> Option<&'static str> {
        file_kind(&self.read(entry, ENOUGH_BYTES as u64).ok()?)
    }

    /// The archive that a file of this tree is, with at most `most_entries` entries.
    ///
    /// # Errors
    /// What is no ZIP archive, a damaged one, one inside too many others, one of more entries.
    pub fn nested(&self, entry: &Entry, most_entries: usize) -> Result<Self, EntryProblem> {
        if self.nesting >= self.limits.nesting {
            return Err(EntryProblem::TooDeep {
                most: self.limits.nesting,
            });
        }
        let bytes = self.bytes(entry, self.limits.nested_bytes)?;
        let limits = Limits {
            entries: self.limits.entries.min(most_entries),
            ..self.limits
        };
        let mut tree = Self::of_zip(bytes, &limits)?;
        tree.left = Arc::clone(&self.left);
        tree.nesting = self.nesting + 1;
        Ok(tree)
    }

    /// Reads the first bytes of a file, and counts them.
    fn read(&self, entry: &Entry, most: u64) -> Result<Vec<u8>, EntryProblem> {
        if let Some(problem) = &entry.problem {
            return Err(problem.clone());
        }
        let left = self.left.load(Ordering::Relaxed);
        let spent = EntryProblem::Budget {
            most: self.limits.total_bytes,
        };
        if left == 0 {
            return Err(spent);
        }
        let mut bytes = Vec::new();
        let read = match (&entry.bytes, &self.archive) {
            (BytesAt::Disk(path), _) => folder::read(path, most.min(left), &mut bytes),
            (BytesAt::Archive(file), Some(archive)) => {
                archive.read(*file, most.min(left), &mut bytes)
            }
            (BytesAt::Archive(_), None) => Err(EntryProblem::Unreadable {
                why: "it is of another source".to_owned(),
            }),
        };
        // what came out before an error counts, too
        let count = bytes.len() as u64;
        self.left
            .store(left.saturating_sub(count), Ordering::Relaxed);
        read?;
        // it was cut short by what was left, not by its own end
        if most > left && count >= left {
            return Err(spent);
        }
        Ok(bytes)
    }
}

/// Why a source is no tree.
fn refuse(path: &Path, problem: &EntryProblem) -> TreeError {
    TreeError {
        path: path.display().to_string(),
        what: problem.to_string(),
        help: match problem {
            EntryProblem::Unreadable { .. } => {
                "give the ZIP archive that the LMS exported, or the folder it was unpacked to"
            }
            EntryProblem::Damaged { .. } => "download it again",
            EntryProblem::TooManyEntries { .. } => "give one assignment at a time",
            _ => "export a ZIP archive, or unpack it and give the folder",
        }
        .to_owned(),
    }
}

fn unreadable(error: &std::io::Error) -> EntryProblem {
    EntryProblem::Unreadable {
        why: match error.kind() {
            std::io::ErrorKind::NotFound => "it does not exist".to_owned(),
            _ => error.to_string(),
        },
    }
}

/// What an archive should be.
const ARCHIVE: &str = "a ZIP archive";

/// Refuses what does not begin as a ZIP archive.
fn zip_or_problem(start: &[u8]) -> Result<(), EntryProblem> {
    if is_zip(start) {
        return Ok(());
    }
    Err(EntryProblem::OtherKind {
        found: match start {
            [] => "an empty file",
            start => file_kind(start).unwrap_or("another kind of file"),
        },
        expected: ARCHIVE,
    })
}
