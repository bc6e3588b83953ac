//! A file by the path that somebody typed, of which a part may have been handed in: no link is followed there, for it may lead to a
//! secret, or to somebody else's work.
//!
//! That part begins where the command runs. Of an absolute path, what leads to that folder, to the home folder or to a folder right below
//! the root may hold links, because they are the system's or the person's own.

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use kinemark_sim::text::Source;

use crate::beneath::{self, Unread};
use crate::disk::{self, real};
use crate::failure::Failure;
use crate::output;

/// The folder from which on links count, and the path from there.
fn parts(path: &Path) -> (PathBuf, PathBuf) {
    let from = match path.is_absolute() {
        true => trusted(path),
        false => 0,
    };
    let mut folder: PathBuf = path.components().take(from).collect();
    let mut below = PathBuf::new();
    for part in path.components().skip(from) {
        match part {
            Component::Normal(name) => below.push(name),
            // by name, so that nothing is looked at on the way: a link would lead elsewhere and back
            Component::ParentDir if below.pop() => {}
            Component::CurDir => {}
            other => folder.push(other),
        }
    }
    (folder, below)
}

/// The path without the names that a `..` behind them takes back: where one of them is a link, the system would go elsewhere.
pub(crate) fn plain(path: &Path) -> PathBuf {
    let (folder, below) = parts(path);
    match folder.join(below) {
        path if path.as_os_str().is_empty() => PathBuf::from("."),
        path => path,
    }
}

/// How many components at the beginning of an absolute path lead to a folder that somebody chose to work in.
fn trusted(path: &Path) -> usize {
    let chosen = [std::env::current_dir().ok(), std::env::home_dir()];
    let chosen = chosen.into_iter().flatten().map(|folder| real(&folder));
    let leads_to = |to: PathBuf| {
        let mut way = PathBuf::new();
        let leads = |part: &Component<'_>| {
            way.push(part);
            way.canonicalize().is_ok_and(|way| to.starts_with(way))
        };
        path.components().take_while(leads).count()
    };
    let names = path
        .components()
        .filter(|part| matches!(part, Component::Normal(_)));
    let root = path.components().count() - names.count();
    // a folder right below the root, where there is more
    let below_root = (root + 1).min(path.components().count() - 1);
    chosen.map(leads_to).fold(below_root, usize::max)
}

/// The first link in the part of a path that may have been handed in: the path to it as typed.
pub(crate) fn link_in(path: &Path) -> Option<PathBuf> {
    let (mut way, below) = parts(path);
    below.components().find_map(|part| {
        way.push(part);
        let there = way.symlink_metadata();
        there
            .is_ok_and(|there| there.is_symlink())
            .then(|| way.clone())
    })
}

/// Refuses a path with a link in it, before what it leads to is opened by others.
///
/// # Errors
/// Exit code 2 with the way out.
pub(crate) fn refuse_links(path: &Path) -> Result<(), Failure> {
    link_in(path).map_or(Ok(()), |link| Err(refused(path, &link)))
}

/// Opens the file at `path`, whatever it is, without following a link and without waiting for a pipe.
///
/// # Errors
/// Exit code 2 for a link, for what is not there and what cannot be opened; `what` it should be is for the message.
pub(crate) fn open(path: &Path, what: &str) -> Result<File, Failure> {
    refuse_links(path)?;
    disk::refuse_unlike(&plain(path), what)?;
    let (folder, below) = parts(path);
    beneath::open(&folder, &below).map_err(|why| match why {
        // it was exchanged between one look and the next
        Unread::Link(_) => refused(path, path),
        Unread::Absent | Unread::Other(_) => unread(path, what, why.to_string()),
    })
}

/// Reads the file at `path`, which should be `what` and has at most `most` bytes, without following a link.
///
/// # Errors
/// As [`open()`].
pub(crate) fn bytes(path: &Path, what: &str, most: u64) -> Result<Vec<u8>, Failure> {
    let file = open(path, what)?;
    disk::read_of(path, what, most, disk::contents(file, most))
}

/// Reads the text at `path` in the same way.
///
/// # Errors
/// As [`open()`], and for what is no text.
pub(crate) fn read(path: &Path, what: &str, most: u64) -> Result<Source, Failure> {
    disk::source(path, what, bytes(path, what, most)?)
}

fn unread(path: &Path, what: &str, why: String) -> Failure {
    // without a limit, so that no reason is one of size
    let read = disk::read_of(path, what, u64::MAX, Err(why));
    read.err().unwrap_or_else(|| refused(path, path))
}

/// Why a path is refused in which `link` is one.
fn refused(path: &Path, link: &Path) -> Failure {
    let (shown, of) = (output::path(link), output::path(path));
    let kind = if link.is_dir() { "folder" } else { "file" };
    let inside = match link.components().count() < path.components().count() {
        true => format!(", in the path `{of}`,"),
        false => String::new(),
    };
    Failure::usage(
        format!("`{shown}`{inside} is a link to another {kind}"),
        &format!(
            "copy the {kind} itself, or name what it leads to; what is handed in may hold links to others' files"
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(path: &str) -> (String, String) {
        let (folder, below) = parts(Path::new(path));
        (folder.display().to_string(), below.display().to_string())
    }

    #[test]
    fn links_count_from_the_folder_on_in_which_the_command_runs() {
        for (path, folder, below) in [
            ("a/b.rhai", "", "a/b.rhai"),
            ("./a.rhai", "", "a.rhai"),
            ("../s1/a.rhai", "..", "s1/a.rhai"),
            ("../../a", "../..", "a"),
            ("s9/../s8/a.rhai", "", "s8/a.rhai"),
            ("s9/../../a.rhai", "..", "a.rhai"),
            ("..", "..", ""),
        ] {
            assert_eq!(split(path), (folder.to_owned(), below.to_owned()), "{path}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn an_absolute_path_may_have_links_where_the_system_has_them() {
        let absolute = |path: &str| split(path);
        let of = |folder: &str, below: &str| (folder.to_owned(), below.to_owned());
        assert_eq!(absolute("/no-such/s1/a.rhai"), of("/no-such", "s1/a.rhai"));
        assert_eq!(absolute("/a.rhai"), of("/", "a.rhai"));
        let here = std::env::current_dir().unwrap().canonicalize().unwrap();
        let below = here.join("s1/a.rhai").display().to_string();
        assert_eq!(
            absolute(&below),
            of(&here.display().to_string(), "s1/a.rhai")
        );
        // a way to this folder that leads through a link
        let bed = tempfile::tempdir().unwrap();
        let link = bed.path().join("link");
        std::os::unix::fs::symlink(&here, &link).unwrap();
        assert_eq!(link_in(&link.join("Cargo.toml")), Some(link));
    }

    #[cfg(unix)]
    #[test]
    fn no_link_below_is_followed_whatever_it_leads_to() {
        use std::os::unix::fs::symlink;
        let bed = tempfile::tempdir().unwrap();
        let root = bed.path().canonicalize().unwrap();
        for folder in ["in/s1", "secret"] {
            std::fs::create_dir_all(root.join(folder)).unwrap();
        }
        std::fs::write(root.join("in/s1/a.rhai"), "mine").unwrap();
        std::fs::write(root.join("secret/a.rhai"), "secret").unwrap();
        symlink("../secret", root.join("in/s9")).unwrap();
        symlink("../../secret/a.rhai", root.join("in/s1/b.rhai")).unwrap();
        let of = |path: &str| bytes(&root.join(path), "a submission", 99);
        assert_eq!(of("in/s1/a.rhai").unwrap(), b"mine");
        assert_eq!(of("in/s9/../s1/a.rhai").unwrap(), b"mine");
        for path in ["in/s9/a.rhai", "in/s1/b.rhai", "in/s9", "in/none", "in/s1"] {
            assert!(of(path).is_err(), "{path}");
        }
        // where opened and looked at differ, what is opened counts
        let (folder, below) = parts(&root.join("in/s9/a.rhai"));
        assert_eq!(plain(Path::new("./a/../")), Path::new("."));
        assert!(matches!(
            beneath::open(&folder, below),
            Err(Unread::Link(_))
        ));
    }
}
