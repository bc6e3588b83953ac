//! The level of a tree on which each folder or file is a person's: the top, or below folders that hold nothing but one folder.

use std::collections::BTreeMap;

use super::person_files::PersonFile;
use crate::tree::{Entry, Tree};

/// Folders that hold one folder are stepped into at most so often.
const MOST_LEVELS: usize = 4;

/// A folder of a level.
#[derive(Debug)]
pub(super) struct LevelFolder {
    /// Its name.
    pub(super) name: String,
    /// Its path in the tree.
    pub(super) path: String,
    /// The numbers of the entries below it, by path.
    pub(super) entries: Vec<usize>,
}

impl LevelFolder {
    /// Its files, with paths that begin inside it.
    pub(super) fn files(&self, tree: &Tree) -> Vec<PersonFile> {
        let inside = |&entry: &usize| PersonFile {
            path: tree.entries()[entry].path[self.path.len() + 1..].to_owned(),
            entry,
        };
        self.entries.iter().map(inside).collect()
    }
}

/// What one folder of a tree holds.
#[derive(Debug)]
pub(super) struct Level {
    /// The path of the folder; empty at the top.
    pub(super) path: String,
    /// Its folders, by name.
    pub(super) folders: Vec<LevelFolder>,
    /// The numbers of the entries that are its files, by path.
    pub(super) files: Vec<usize>,
}

impl Level {
    /// What the folder `path` holds.
    fn at(tree: &Tree, path: &str) -> Self {
        let below = |child: &str| -> Option<String> {
            match path {
                "" => Some(child.to_owned()),
                path => Some(child.strip_prefix(path)?.strip_prefix('/')?.to_owned()),
            }
        };
        let mut folders: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        let mut files = Vec::new();
        // a folder that holds nothing anybody looks into is still somebody's
        for folder in tree.folders().iter().filter_map(|folder| below(folder)) {
            let name = folder.split('/').next().unwrap_or_default();
            folders.entry(name.to_owned()).or_default();
        }
        for (i, entry) in tree.entries().iter().enumerate() {
            let Some(rest) = below(&entry.path) else {
                continue;
            };
            match rest.split_once('/') {
                Some((name, _)) => folders.entry(name.to_owned()).or_default().push(i),
                None => files.push(i),
            }
        }
        let folder = |(name, entries): (String, Vec<usize>)| LevelFolder {
            path: match path {
                "" => name.clone(),
                path => format!("{path}/{name}"),
            },
            name,
            entries,
        };
        Self {
            path: path.to_owned(),
            folders: folders.into_iter().map(folder).collect(),
            files,
        }
    }

    /// Its files.
    pub(super) fn entries<'t>(&self, tree: &'t Tree) -> impl Iterator<Item = (usize, &'t Entry)> {
        self.files.iter().map(|&i| (i, &tree.entries()[i]))
    }
}

/// The levels on which people may begin, from the top down.
pub(super) fn levels(tree: &Tree) -> Vec<Level> {
    let mut levels = vec![Level::at(tree, "")];
    while levels.len() < MOST_LEVELS {
        let Some(last) = levels.last() else { break };
        let next = match (last.folders.as_slice(), last.files.as_slice()) {
            // a repository is somebody's work, and not a folder around the work of others
            ([only], []) if !tree.repositories().contains(&only.path) => only.path.clone(),
            _ => break,
        };
        levels.push(Level::at(tree, &next));
    }
    levels
}
