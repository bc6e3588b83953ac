//! The files of a folder on a disk: listed without following a link, read one at a time.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use super::entry_name::is_litter;
use super::limits::Limits;
use super::listing::{BytesAt, Listing};
use super::problem::EntryProblem;

/// Lists all files below `root`.
///
/// # Errors
/// A root that cannot be listed, or too many entries.
pub(super) fn list(root: &Path, limits: &Limits) -> Result<Listing, EntryProblem> {
    let mut listing = Listing::default();
    let mut open = vec![(root.to_owned(), String::new())];
    while let Some((folder, original)) = open.pop() {
        let children = match children(&folder) {
            Ok(children) => children,
            Err(error) if original.is_empty() => return Err(unreadable(&error)),
            Err(error) => {
                let at = || BytesAt::Disk(folder);
                listing.file(&original, None, Some(unreadable(&error)), limits, at);
                continue;
            }
        };
        for (path, name) in children {
            listing.count(limits)?;
            let original = match original.as_str() {
                "" => name,
                above => format!("{above}/{name}"),
            };
            if let Some(below) = child(path, original, limits, &mut listing) {
                open.push(below);
            }
        }
    }
    listing.finish();
    Ok(listing)
}

/// Takes a child of a folder; itself where it is a folder to look into.
fn child(
    path: PathBuf,
    original: String,
    limits: &Limits,
    listing: &mut Listing,
) -> Option<(PathBuf, String)> {
    let (size, problem) = match path.symlink_metadata() {
        Ok(there) if there.is_symlink() => (None, Some(EntryProblem::Link)),
        Ok(there) if there.is_dir() => {
            return listing
                .folder(&original, limits)
                .then_some((path, original));
        }
        Ok(there) if there.is_file() => (Some(there.len()), None),
        Ok(_) => (None, Some(EntryProblem::Special)),
        Err(error) => (None, Some(unreadable(&error))),
    };
    listing.file(&original, size, problem, limits, || BytesAt::Disk(path));
    None
}

/// The paths and names in a folder. Of what is never looked into only the name is needed.
fn children(folder: &Path) -> io::Result<Vec<(PathBuf, String)>> {
    let mut children = Vec::new();
    for child in std::fs::read_dir(folder)? {
        let child = child?;
        // a name that is not Unicode keeps its readable parts: nobody's id has others
        let name = child.file_name().to_string_lossy().into_owned();
        children.push((child.path(), name));
    }
    // the same order on every disk, so that a limit is met at the same file
    children.sort_by(|(_, one), (_, other)| (is_litter(one), one).cmp(&(is_litter(other), other)));
    Ok(children)
}

/// Reads at most `most` bytes of a file to the end of `bytes`.
///
/// # Errors
/// A file that is no longer there or may not be read.
pub(super) fn read(path: &Path, most: u64, bytes: &mut Vec<u8>) -> Result<(), EntryProblem> {
    let read = open(path).and_then(|file| {
        // asked of what was opened: what lies at the path may be another by now
        if !file.metadata()?.is_file() {
            return Err(io::Error::other("it is no longer a file"));
        }
        file.take(most).read_to_end(bytes)
    });
    read.map(drop).map_err(|error| unreadable(&error))
}

/// Opens a file that was listed. A link that was put in its place is not followed, and a pipe not waited for.
#[cfg(unix)]
fn open(path: &Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
    Ok(File::from(rustix::fs::open(path, flags, Mode::empty())?))
}

#[cfg(not(unix))]
fn open(path: &Path) -> io::Result<File> {
    if path.symlink_metadata()?.is_symlink() {
        return Err(io::Error::other("it is no longer a file"));
    }
    File::open(path)
}

fn unreadable(error: &io::Error) -> EntryProblem {
    EntryProblem::Unreadable {
        why: error.to_string(),
    }
}
