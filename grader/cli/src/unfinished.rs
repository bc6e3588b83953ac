//! What is being written, under a hidden name beside its place and locked as long as its writer lives; and what a writer that was killed
//! left there: the next one puts it right and removes it.

use std::ffi::OsStr;
use std::fs::File;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use kinemark_course::durable::{self, Readers};
use kinemark_course::private_files::fresh_folder;
use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;

use crate::disk;

/// How every such name begins; the machine's mark and a random part follow.
const PREFIX: &str = ".kinemark-";
/// Digits of a machine's mark.
const MARK_DIGITS: usize = 8;
/// The file in a folder whose lock its writer holds.
const LOCK: &str = "lock";
/// What a folder is written for, where a kill could lose something that was there before.
const PLACE: &str = "place.json";
/// The part of a folder that gets its place.
const NEW: &str = "new";
/// The part of a folder that was in that place.
const OLD: &str = "old";
/// The list of what is kept of a report is far smaller.
const MOST_PLACE_BYTES: u64 = 1 << 20;
/// Each time somebody else must clean up in the same moment.
const MOST_TRIES: usize = 100;

/// How the names of this machine begin. A lock may say nothing about other machines that share the file system: each cleans up its own.
fn prefix() -> String {
    #[cfg(unix)]
    let machine = rustix::system::uname().nodename().to_bytes().to_vec();
    #[cfg(not(unix))]
    let machine = Vec::new();
    let mark = blake3::hash(&machine).to_hex();
    format!("{PREFIX}{}-", &mark[..MARK_DIGITS])
}

/// A folder that nobody sees, in which something is written that then gets its place. It goes away with this value.
#[derive(Debug)]
pub(crate) struct UnfinishedFolder {
    path: PathBuf,
    lock: Option<File>,
}

/// Where a part of an unfinished folder goes, and what of the earlier one stays there.
#[derive(Debug, Serialize, Deserialize)]
struct Place {
    /// A name in the folder that the unfinished one is in.
    name: String,
    /// Paths inside, with `/` between names.
    kept: Vec<String>,
}

impl UnfinishedFolder {
    /// A fresh one in `parent`, in which what killed writers left is cleaned up.
    pub(crate) fn in_folder(parent: &Path) -> std::io::Result<Self> {
        clean(parent);
        for _ in 0..MOST_TRIES {
            let path = fresh_folder(parent, &prefix())?.keep();
            let lock = File::options()
                .write(true)
                .create_new(true)
                .open(path.join(LOCK));
            match lock {
                Ok(lock) if holds(&lock, &path.join(LOCK)) => {
                    let lock = Some(lock);
                    return Ok(Self { path, lock });
                }
                // somebody who cleans up came in between
                Ok(_) => {}
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => {
                    // nothing is in it
                    let _ = std::fs::remove_dir(&path);
                    return Err(error);
                }
            }
        }
        Err(too_busy())
    }

    /// The folder itself.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The part that gets its place.
    pub(crate) fn new_part(&self) -> PathBuf {
        self.path.join(NEW)
    }

    /// The part that was in that place before.
    pub(crate) fn old_part(&self) -> PathBuf {
        self.path.join(OLD)
    }

    /// Says what the folder is written for. From now on a kill loses nothing of what is `kept` of an earlier `out`, nor of `out` itself
    /// while it is moved aside: the next writer, or who looks for it, finds it.
    pub(crate) fn note_place(&self, out: &Path, kept: &[String]) -> std::io::Result<()> {
        // another system's name could not be written down: then it is as it was
        let Some(name) = out.file_name().and_then(OsStr::to_str) else {
            return Ok(());
        };
        let place = Place {
            name: name.to_owned(),
            kept: kept.to_vec(),
        };
        let text = serde_json::to_vec(&place).map_err(std::io::Error::other)?;
        std::fs::write(self.path.join(PLACE), text)?;
        durable::sync_file(&self.path.join(PLACE))?;
        durable::sync_folder(&self.path)
    }

    /// Leaves it where it is: something in it is somebody's own. The next writer tries again to put it back.
    pub(crate) fn leave(mut self) -> PathBuf {
        self.lock = None;
        std::mem::take(&mut self.path)
    }
}

impl Drop for UnfinishedFolder {
    fn drop(&mut self) {
        if let Some(lock) = self.lock.take() {
            // whoever writes there next tries again
            let _ = remove(&self.path, lock);
        }
    }
}

/// A file that nobody sees, in `folder`, in which what killed writers left is cleaned up.
pub(crate) fn unfinished_file(folder: &Path, readers: Readers) -> std::io::Result<NamedTempFile> {
    clean(folder);
    for _ in 0..MOST_TRIES {
        let file = readers
            .temporary_file()
            .prefix(&prefix())
            .tempfile_in(folder)?;
        if holds(file.as_file(), file.path()) {
            return Ok(file);
        }
    }
    Err(too_busy())
}

/// Looks for `folder` in what a killed writer has moved aside, if it is not there. Whether it is there afterwards.
pub(crate) fn is_there_or_restored(folder: &Path) -> bool {
    if !folder.is_dir() && folder.symlink_metadata().is_err() {
        clean(durable::parent(folder));
    }
    folder.is_dir()
}

/// Whether a writer has the lock of what it has just made. Where there are no locks it has none, and nobody cleans up.
fn holds(lock: &File, path: &Path) -> bool {
    match lock.try_lock() {
        // whoever had the lock before has removed it
        Ok(()) => path.symlink_metadata().is_ok(),
        Err(std::fs::TryLockError::WouldBlock) => false,
        Err(std::fs::TryLockError::Error(_)) => true,
    }
}

fn too_busy() -> std::io::Error {
    std::io::Error::other("whatever is written there is removed at once by somebody else")
}

/// Cleans up in `folder`: what a killed writer of this machine left is put right and removed. What cannot be is in nobody's way.
fn clean(folder: &Path) {
    let prefix = prefix();
    let is_left = |name: &OsStr| {
        let rest = name.to_str().and_then(|name| name.strip_prefix(&prefix));
        rest.is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_alphanumeric()))
    };
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if !is_left(&entry.file_name()) {
            continue;
        }
        let path = entry.path();
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => clean_folder(&path),
            Ok(kind) if kind.is_file() => {
                let lock = disk::open(&path);
                if lock.is_ok_and(|lock| lock.try_lock().is_ok()) {
                    let _ = std::fs::remove_file(&path);
                }
            }
            // a link, or what is of no writer of ours
            _ => {}
        }
    }
}

fn clean_folder(path: &Path) {
    let lock = path.join(LOCK);
    match lock.symlink_metadata() {
        Ok(there) if there.is_file() => {}
        Err(error) if error.kind() == ErrorKind::NotFound => {
            // killed before it wrote anything; anything else in it keeps it
            let _ = std::fs::remove_dir(path);
            return;
        }
        _ => return,
    }
    let Ok(lock) = disk::open(&lock) else { return };
    if lock.try_lock().is_ok() && restore(path).is_ok() {
        let _ = remove(path, lock);
    }
}

/// Removes an unfinished folder whose lock is held. The lock goes last: what is interrupted here goes on another time.
fn remove(folder: &Path, lock: File) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() == LOCK {
            continue;
        }
        if entry.file_type()?.is_dir() {
            std::fs::remove_dir_all(entry.path())?;
        } else {
            std::fs::remove_file(entry.path())?;
        }
    }
    std::fs::remove_file(folder.join(LOCK))?;
    drop(lock);
    std::fs::remove_dir(folder)
}

/// Puts back what a killed writer had moved aside: the earlier folder where there is none now, else what is kept of it.
fn restore(folder: &Path) -> std::io::Result<()> {
    let read = disk::bytes_of(&folder.join(PLACE), MOST_PLACE_BYTES);
    // nothing was moved aside
    let Ok(place) = read.map(|bytes| serde_json::from_slice::<Place>(&bytes)) else {
        return Ok(());
    };
    let place = place.map_err(std::io::Error::other)?;
    let parent = durable::parent(folder);
    if !is_inside(&place.name) || place.name.contains('/') {
        return Ok(());
    }
    let out = parent.join(&place.name);
    let old = folder.join(OLD);
    if out.symlink_metadata().is_err() && is_folder(&old) {
        std::fs::rename(&old, &out)?;
        return durable::sync_folder(parent);
    }
    // the part of the new one became that of the old one where the two were exchanged
    for earlier in [old, folder.join(NEW)] {
        move_kept(&earlier, &out, &place.kept)?;
    }
    Ok(())
}

/// Moves the entries at `kept` from one folder to the same places in another, where nothing is at these.
pub(crate) fn move_kept(from: &Path, to: &Path, kept: &[String]) -> std::io::Result<()> {
    for path in kept.iter().filter(|path| is_inside(path)) {
        let (there, place) = (from.join(path), to.join(path));
        // whoever made these folders: through a link nothing is moved
        let is_ours = has_folders(from, path) && is_folder(to);
        if !is_ours || there.symlink_metadata().is_err() || place.symlink_metadata().is_ok() {
            continue;
        }
        let failed = |error: std::io::Error| {
            std::io::Error::other(format!(
                "`{path}` is left in `{}`: {}",
                from.display(),
                disk::plain(&error)
            ))
        };
        durable::make_folder(durable::parent(&place), Readers::Umask).map_err(failed)?;
        if !has_folders(to, path) {
            continue;
        }
        std::fs::rename(&there, &place).map_err(failed)?;
        durable::sync_folder(durable::parent(&place))?;
    }
    Ok(())
}

/// Whether a path leads nowhere else.
fn is_inside(path: &str) -> bool {
    let mut parts = Path::new(path).components();
    !path.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// Whether `root` and every folder on the way to `path` in it is a folder and no link to one.
fn has_folders(root: &Path, path: &str) -> bool {
    let above = Path::new(path).parent().unwrap_or(Path::new(""));
    let mut at = root.to_owned();
    is_folder(&at)
        && above.components().all(|part| {
            at.push(part);
            is_folder(&at)
        })
}

fn is_folder(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|there| there.is_dir())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a killed writer leaves: a folder with these files, whose lock nobody holds.
    fn left(bed: &Path, files: &[(&str, &str)]) -> PathBuf {
        let folder = UnfinishedFolder::in_folder(bed).unwrap().leave();
        for (name, text) in files {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn what_a_killed_writer_left_goes_and_what_a_living_one_writes_stays() {
        let bed = tempfile::tempdir().unwrap();
        let living = UnfinishedFolder::in_folder(bed.path()).unwrap();
        std::fs::create_dir(living.new_part()).unwrap();
        let file = unfinished_file(bed.path(), Readers::Owner).unwrap();
        let folder = left(bed.path(), &[("new/report.html", "half"), ("new/a/b", "")]);
        // killed before the lock was there, and a file that was being written
        let random = |rest: &str| bed.path().join(prefix() + rest);
        std::fs::create_dir(random("abcdef")).unwrap();
        std::fs::write(random("ghijkl"), "half").unwrap();
        // another machine's, and what only looks alike
        for name in [
            ".kinemark-files.json",
            ".kinemark-00000000-abcdef",
            ".kinemark-abcdef",
        ] {
            std::fs::write(bed.path().join(name), "mine").unwrap();
        }
        std::fs::create_dir_all(random("mnopqr").join("mine")).unwrap();
        clean(bed.path());
        assert!(!folder.exists());
        let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
        let mut expected = vec![
            name(living.path()),
            name(file.path()),
            name(&random("mnopqr")),
            ".kinemark-files.json".to_owned(),
            ".kinemark-00000000-abcdef".to_owned(),
            ".kinemark-abcdef".to_owned(),
        ];
        expected.sort();
        assert_eq!(names(bed.path()), expected);
        assert!(living.new_part().is_dir());
        drop((living, file));
        assert_eq!(names(bed.path()).len(), 4);
    }

    #[test]
    fn a_report_that_was_moved_aside_is_put_back() {
        let bed = tempfile::tempdir().unwrap();
        let out = bed.path().join("out");
        let place = r#"{ "name": "out", "kept": ["move/run-csv"] }"#;
        let files = [
            ("old/report.html", "old"),
            ("new/report.html", "new"),
            (PLACE, place),
        ];
        left(bed.path(), &files);
        assert!(is_there_or_restored(&out));
        assert_eq!(std::fs::read(out.join("report.html")).unwrap(), b"old");
        assert_eq!(names(bed.path()), ["out"]);
        // one that is there is not replaced
        left(bed.path(), &files);
        clean(bed.path());
        assert_eq!(std::fs::read(out.join("report.html")).unwrap(), b"old");
        assert_eq!(names(bed.path()), ["out"]);
    }

    /// Killed behind the exchange, so that the part of the new report is the earlier one; or behind two renames.
    #[test]
    fn tables_that_are_kept_are_put_back() {
        for earlier in ["new", "old"] {
            let bed = tempfile::tempdir().unwrap();
            let out = bed.path().join("out");
            std::fs::create_dir_all(out.join("move")).unwrap();
            let place = r#"{ "name": "out", "kept": ["move/run-csv", "gone/run-csv", "../out"] }"#;
            let table = |task: &str| format!("{earlier}/{task}/run-csv/a.csv");
            left(
                bed.path(),
                &[(PLACE, place), (&table("move"), "1"), (&table("gone"), "2")],
            );
            clean(bed.path());
            assert_eq!(names(bed.path()), ["out"]);
            for (task, text) in [("move", "1"), ("gone", "2")] {
                let table = out.join(task).join("run-csv/a.csv");
                assert_eq!(std::fs::read_to_string(table).unwrap(), text);
            }
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_that_somebody_planted_move_and_remove_nothing() {
        use std::os::unix::fs::symlink;
        let bed = tempfile::tempdir().unwrap();
        let (here, there) = (bed.path().join("here"), bed.path().join("there"));
        std::fs::create_dir_all(there.join("run-csv")).unwrap();
        std::fs::write(there.join("run-csv/a.csv"), "mine").unwrap();
        std::fs::write(there.join(LOCK), "").unwrap();
        std::fs::create_dir_all(here.join("out/task")).unwrap();
        let place = r#"{ "name": "out", "kept": ["move/run-csv", "task/run-csv"] }"#;
        let folder = left(&here, &[(PLACE, place), ("new/file", "")]);
        symlink(&there, folder.join("new/move")).unwrap();
        symlink(&there, folder.join(OLD)).unwrap();
        symlink(&there, here.join(prefix() + "abcdef")).unwrap();
        clean(&here);
        assert_eq!(names(&here).len(), 2, "the report, and the link beside it");
        assert_eq!(names(&here.join("out")), ["task"]);
        assert_eq!(names(&there), [LOCK, "run-csv"]);
        assert_eq!(names(&there.join("run-csv")), ["a.csv"]);
        // a name that leads elsewhere
        let folder = left(
            &here,
            &[(PLACE, r#"{ "name": "../x", "kept": [] }"#), ("old/a", "")],
        );
        clean(&here);
        assert!(!folder.exists() && !bed.path().join("x").exists());
    }
}
