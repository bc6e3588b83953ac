//! The names of a source collected: each file once, those that look alike marked, folders and repositories known.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use super::entry_name::{Place, place};
use super::limits::Limits;
use super::problem::EntryProblem;
use crate::student::folded;

/// A file of a source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Its path inside the source: `/` between names, in Unicode's normal form C.
    pub path: String,
    /// Its name as the archive or the disk has it.
    pub original: String,
    /// Its size as the source declares it \[bytes\]; what is read is counted anyway.
    pub declared_size: Option<u64>,
    /// What keeps it from being used.
    pub problem: Option<EntryProblem>,
    /// Where its bytes are.
    pub(super) bytes: BytesAt,
}

impl Entry {
    /// Its name without the folders.
    pub fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }
}

/// Where the bytes of a file are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum BytesAt {
    /// A file of a disk.
    Disk(PathBuf),
    /// The file of an archive with this number.
    Archive(usize),
}

/// A file that has no place in the tree, because of its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MisnamedEntry {
    /// Its name as the archive or the disk has it.
    pub original: String,
    /// What is wrong with it.
    pub problem: EntryProblem,
}

impl MisnamedEntry {
    /// The last part of its name.
    pub fn name(&self) -> &str {
        let parts = self.original.rsplit(['/', '\\']);
        let mut named = parts.filter(|part| !part.is_empty());
        named.next().unwrap_or_default()
    }
}

/// All names of a source.
#[derive(Debug, Default)]
pub(super) struct Listing {
    pub(super) entries: Vec<Entry>,
    pub(super) misnamed: Vec<MisnamedEntry>,
    pub(super) folders: BTreeSet<String>,
    pub(super) repositories: BTreeSet<String>,
    count: usize,
}

impl Listing {
    /// Counts an entry.
    ///
    /// # Errors
    /// One more than there may be.
    pub(super) fn count(&mut self, limits: &Limits) -> Result<(), EntryProblem> {
        self.count += 1;
        if self.count > limits.entries {
            return Err(EntryProblem::TooManyEntries {
                found: self.count,
                most: limits.entries,
            });
        }
        Ok(())
    }

    /// Takes a folder; whether to look into it.
    pub(super) fn folder(&mut self, original: &str, limits: &Limits) -> bool {
        match place(original, limits.name_bytes) {
            Ok(Place::Path(path)) => {
                self.folders_to(&path);
                true
            }
            Ok(Place::Litter { folder, git }) => {
                self.litter(folder, git);
                false
            }
            // `./` is how some archives name their top
            Err(EntryProblem::NoName) => false,
            Err(problem) => {
                self.misnamed(original, problem);
                false
            }
        }
    }

    /// Takes a file; `bytes` is where its bytes are, for one that anybody might look into.
    pub(super) fn file(
        &mut self,
        original: &str,
        declared_size: Option<u64>,
        problem: Option<EntryProblem>,
        limits: &Limits,
        bytes: impl FnOnce() -> BytesAt,
    ) {
        match place(original, limits.name_bytes) {
            Ok(Place::Path(path)) => {
                if let Some((folder, _)) = path.rsplit_once('/') {
                    self.folders_to(folder);
                }
                self.entries.push(Entry {
                    path,
                    original: original.to_owned(),
                    declared_size,
                    problem,
                    bytes: bytes(),
                });
            }
            Ok(Place::Litter { folder, git }) => self.litter(folder, git),
            Err(problem) => self.misnamed(original, problem),
        }
    }

    fn misnamed(&mut self, original: &str, problem: EntryProblem) {
        self.misnamed.push(MisnamedEntry {
            original: original.to_owned(),
            problem,
        });
    }

    fn litter(&mut self, folder: String, git: bool) {
        if !folder.is_empty() {
            self.folders_to(&folder);
        }
        if git {
            self.repositories.insert(folder);
        }
    }

    /// Notes a folder and those above it.
    fn folders_to(&mut self, path: &str) {
        let mut path = path;
        while !self.folders.contains(path) {
            self.folders.insert(path.to_owned());
            match path.rsplit_once('/') {
                Some((above, _)) => path = above,
                None => break,
            }
        }
    }

    /// Sorts the files by path and marks those whose names are not their own.
    pub(super) fn finish(&mut self) {
        self.entries
            .sort_by(|one, other| (&one.path, &one.original).cmp(&(&other.path, &other.original)));
        let mut same: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (i, entry) in self.entries.iter().enumerate() {
            same.entry(folded(&entry.path)).or_default().push(i);
        }
        for (_, alike) in same.into_iter().filter(|(_, alike)| alike.len() > 1) {
            for &i in &alike {
                let path = &self.entries[i].path;
                let mut others = alike.iter().filter(|&&other| other != i);
                let different = others.find(|&&other| self.entries[other].path != *path);
                let problem = match different {
                    Some(&other) => EntryProblem::Alike {
                        other: self.entries[other].path.clone(),
                    },
                    None => EntryProblem::Duplicate,
                };
                // what was wrong before stays said: a link with a double name is still a link
                self.entries[i].problem.get_or_insert(problem);
            }
        }
        for entry in &mut self.entries {
            if self.folders.contains(&entry.path) {
                entry.problem.get_or_insert(EntryProblem::Duplicate);
            }
        }
    }
}
