//! Files and folders named for their people: `ID.rhai`, `ID_2.rhai` (the second attempt), `ID/...`, `ID.zip`. Any source can be read
//! so.
//!
//! Files that differ in their endings alone are one person's: `s1.rhai` and `s1.pdf`.

use std::collections::BTreeMap;

use super::level::{Level, LevelFolder, levels};
use super::{Confidence, Hint, Layout, PersonFile, PersonFiles};
use crate::student::folded;
use crate::submission_name::{NameKind, stem};
use crate::tree::Tree;

pub(super) const LAYOUT: Layout = Layout {
    name: "flat",
    recognise,
    people,
};

/// Endings of tables that course staff keep beside hand-ins.
const TABLES: [&str; 5] = [".csv", ".tsv", ".xlsx", ".ods", ".toml"];

/// Folders and files of a level.
#[derive(Debug, Default)]
pub(super) struct Items<'l> {
    /// The folders.
    pub(super) folders: Vec<&'l LevelFolder>,
    /// The numbers of the entries that are files.
    pub(super) files: Vec<usize>,
}

fn recognise(tree: &Tree) -> Confidence {
    let level = level(tree);
    Confidence::Anything(format!(
        "no names of an LMS in it: folders: {}, files: {}",
        level.folders.len(),
        level.files.len()
    ))
}

/// The level on which people begin: the top, or the folder around folders and files that are people's.
fn level(tree: &Tree) -> Level {
    let mut levels = levels(tree);
    let first = levels.iter().position(|level| is_class(tree, level));
    levels.swap_remove(first.unwrap_or(0))
}

/// Whether a level is a class's: one folder of files alone may be one person's as well, unless several files have names of their own.
fn is_class(tree: &Tree, level: &Level) -> bool {
    let mut named = level
        .entries(tree)
        .filter(|(_, entry)| is_named(entry.name()));
    level.folders.len() > 1 && !has_submission(tree, level) || named.nth(1).is_some()
}

/// Whether a file may be handed in and has a name of its own, which may say whose it is.
fn is_named(name: &str) -> bool {
    let kinds = [NameKind::Script, NameKind::Archive, NameKind::HandIn];
    kinds.contains(&NameKind::of(name))
}

/// Whether a file of a level is called as one person's submission.
fn has_submission(tree: &Tree, level: &Level) -> bool {
    let kinds = [NameKind::Submission, NameKind::SubmissionText];
    level
        .entries(tree)
        .any(|(_, entry)| kinds.contains(&NameKind::of(entry.name())))
}

fn people(tree: &Tree) -> Vec<PersonFiles> {
    let level = level(tree);
    let is_table = |name: &str| {
        let name = name.to_lowercase();
        name.starts_with("readme") || TABLES.iter().any(|table| name.ends_with(table))
    };
    let files = level.entries(tree);
    let files = files.filter(|(_, entry)| !is_table(entry.name()));
    let items = Items {
        folders: level.folders.iter().collect(),
        files: files.map(|(i, _)| i).collect(),
    };
    let mut people = rows(tree, &items);
    if let [only] = people.as_mut_slice() {
        only.hints.extend(hints_below(tree));
        only.hints.dedup();
    }
    people
}

/// What the names below the top say where the top is one folder: it may be one person's, or a folder around it.
fn hints_below(tree: &Tree) -> Vec<Hint> {
    let mut names = Vec::new();
    for level in levels(tree).iter().skip(1) {
        if let ([only], []) = (level.folders.as_slice(), level.files.as_slice()) {
            names.push(only.name.clone());
        }
        let files = level.entries(tree).map(|(_, entry)| entry.name());
        let named: Vec<&str> = files.filter(|name| is_named(name)).collect();
        if let [only] = named.as_slice() {
            names.push(stem(only).to_owned());
        }
    }
    names.iter().flat_map(|name| hints(name)).collect()
}

/// The people among what another layout does not know: only where there is something that may have been handed in.
pub(super) fn people_among(tree: &Tree, items: &Items<'_>) -> Vec<PersonFiles> {
    let may_be = |&entry: &usize| {
        let name = tree.entries()[entry].name();
        NameKind::of(name).may_be_handed_in()
    };
    let folders = items.folders.iter().copied();
    let items = Items {
        folders: folders
            .filter(|folder| folder.entries.iter().any(may_be))
            .collect(),
        files: items.files.iter().copied().filter(may_be).collect(),
    };
    rows(tree, &items)
}

fn rows(tree: &Tree, items: &Items<'_>) -> Vec<PersonFiles> {
    let mut people = Vec::new();
    for folder in &items.folders {
        let (_, attempt) = attempt(&folder.name);
        people.push(PersonFiles {
            label: folder.path.clone(),
            hints: hints(&folder.name),
            files: folder.files(tree),
            attempt,
            ..PersonFiles::default()
        });
    }
    let mut files: BTreeMap<String, PersonFiles> = BTreeMap::new();
    for &entry in &items.files {
        let file = &tree.entries()[entry];
        let stem = stem(file.name());
        let (_, attempt) = attempt(stem);
        let person = files.entry(folded(stem)).or_insert_with(|| PersonFiles {
            label: file.path.clone(),
            hints: hints(stem),
            attempt,
            ..PersonFiles::default()
        });
        person.files.push(PersonFile {
            path: file.name().to_owned(),
            entry,
        });
    }
    people.extend(files.into_values());
    people
}

/// A name without the number of the attempt, and that number: `s1_2` is the second of `s1`.
fn attempt(name: &str) -> (&str, Option<u32>) {
    match name.rsplit_once('_') {
        Some((before, count))
            if !before.is_empty() && (1..=2).contains(&count.len()) && !count.starts_with('0') =>
        {
            match count.parse() {
                Ok(attempt) => (before, Some(attempt)),
                Err(_) => (name, None),
            }
        }
        _ => (name, None),
    }
}

/// What a name may say: an id, a login, a full name, an address, a group, a repository.
fn hints(name: &str) -> Vec<Hint> {
    let mut hints = vec![Hint::PathName(name.to_owned())];
    let (bare, attempt) = attempt(name);
    let names = match attempt {
        Some(_) => vec![name, bare],
        None => vec![name],
    };
    for name in names {
        hints.push(Hint::Username(name.to_owned()));
        hints.push(Hint::Name(name.to_owned()));
        hints.push(Hint::Group(name.to_owned()));
        hints.push(Hint::Repository(name.to_owned()));
        if name.contains('@') {
            hints.push(Hint::Email(name.to_owned()));
        }
    }
    hints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_an_attempt_follows_the_id() {
        assert_eq!(attempt("s1_2"), ("s1", Some(2)));
        assert_eq!(attempt("s1_20"), ("s1", Some(20)));
        for name in ["s1", "_2", "s1_x", "s1_02", "s1_2026", "s_"] {
            assert_eq!(attempt(name), (name, None), "{name}");
        }
    }
}
