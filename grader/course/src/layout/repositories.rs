//! Clones, one repository a person: folders with a `.git` inside, called `assignment-username` as code hosts for classes call them.

use super::level::{Level, levels};
use super::{Confidence, Hint, Layout, PersonFiles, count_of, flat};
use crate::tree::Tree;

pub(super) const LAYOUT: Layout = Layout {
    name: "repositories",
    recognise,
    people,
};

fn recognise(tree: &Tree) -> Confidence {
    let Some((level, found)) = level(tree) else {
        return Confidence::No;
    };
    let count = count_of(found, level.folders.len(), "folder");
    Confidence::Certain(format!("{count} with a .git inside"))
}

/// The first level on which most folders are repositories, and how many are. One alone may be what a student handed in.
fn level(tree: &Tree) -> Option<(Level, usize)> {
    levels(tree).into_iter().find_map(|level| {
        let folders = level.folders.iter();
        let found = folders.filter(|folder| tree.repositories().contains(&folder.path));
        let found = found.count();
        (found * 2 > level.folders.len()).then_some((level, found))
    })
}

fn people(tree: &Tree) -> Vec<PersonFiles> {
    let Some((level, _)) = level(tree) else {
        return Vec::new();
    };
    let mut people = Vec::new();
    let mut other = flat::Items {
        files: level.files.clone(),
        ..flat::Items::default()
    };
    for folder in &level.folders {
        if !tree.repositories().contains(&folder.path) {
            other.folders.push(folder);
            continue;
        }
        let name = || folder.name.clone();
        people.push(PersonFiles {
            label: folder.path.clone(),
            hints: vec![
                Hint::Repository(name()),
                Hint::Username(name()),
                Hint::PathName(name()),
            ],
            files: folder.files(tree),
            ..PersonFiles::default()
        });
    }
    people.extend(flat::people_among(tree, &other));
    people
}
