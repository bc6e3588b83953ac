//! Files and folders that their owner alone can read, written whole or not at all, without a lock: not every file system has them.

use std::io::{self, Write as _};
use std::path::Path;
use std::time::{Duration, SystemTime};

use tempfile::NamedTempFile;

use crate::durable::{self, Readers};

/// How the name of a file or folder begins that is being written, or that a killed process has left; it counts for nothing.
pub(crate) const UNFINISHED: &str = ".new-";

/// What was not touched for so long has no writer any more: writing takes seconds, and clocks of several machines differ by less.
const ABANDONED: Duration = Duration::from_secs(24 * 3600);

/// Makes a folder, with those above it, that its owner alone can read. One that is there already stays as it is.
///
/// # Errors
/// What the system says.
pub fn private_folder(path: &Path) -> io::Result<()> {
    durable::make_folder(path, Readers::Owner)
}

/// The same, and nothing waits for the disk.
fn private_folder_at_once(path: &Path) -> io::Result<()> {
    let mut builder = std::fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::DirBuilderExt as _;
        builder.mode(0o700);
    }
    builder.create(path)
}

/// A fresh folder in `folder` that its owner alone can read; its name begins with `prefix`.
///
/// # Errors
/// What the system says.
pub fn fresh_folder(folder: &Path, prefix: &str) -> io::Result<tempfile::TempDir> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o700));
    }
    builder.tempdir_in(folder)
}

/// Writes a file that its owner alone can read, whole or not at all. One with these bytes stays as it is; one with others, which a
/// failing disk has damaged, is replaced. Nothing waits for the disk: whoever writes many files does so once, behind the last one. Gives
/// whether the file is another now.
pub(crate) fn put(path: &Path, bytes: &[u8]) -> io::Result<bool> {
    if std::fs::read(path).is_ok_and(|there| there == bytes) {
        return Ok(false);
    }
    private_folder_at_once(durable::parent(path))?;
    let file = unfinished(path, bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(true)
}

/// Writes a file that its owner alone can read, whole or not at all, whatever was there before.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    private_folder(durable::parent(path))?;
    durable::put_in_place(unfinished(path, bytes)?, path)
}

/// A file that is written, beside its place.
fn unfinished(path: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let mut file = Readers::Owner
        .temporary_file()
        .prefix(UNFINISHED)
        .tempfile_in(durable::parent(path))?;
    file.write_all(bytes)?;
    Ok(file)
}

/// Writes files, by their paths in it, to a folder that nobody sees yet.
pub(crate) fn fill(folder: &Path, files: &[(String, Vec<u8>)]) -> io::Result<()> {
    for (name, bytes) in files {
        let path = folder.join(name);
        private_folder_at_once(durable::parent(&path))?;
        let mut options = std::fs::File::options();
        options.write(true).create(true).truncate(true);
        #[cfg(unix)]
        {
            use std::os::unix::fs::OpenOptionsExt as _;
            options.mode(0o600);
        }
        options.open(path)?.write_all(bytes)?;
    }
    durable::sync_tree(folder)
}

/// Removes what killed processes left unfinished in `folder` and below; with `now`, only what nobody can be writing any more at that
/// time.
pub(crate) fn sweep(folder: &Path, now: Option<SystemTime>) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        let is_folder = entry.file_type()?.is_dir();
        if !entry.file_name().to_string_lossy().starts_with(UNFINISHED) {
            if is_folder {
                sweep(&path, now)?;
            }
            continue;
        }
        let is_abandoned = |now: SystemTime| {
            let written = entry.metadata().and_then(|there| there.modified());
            let age = written.ok().map(|written| now.duration_since(written));
            matches!(age, Some(Ok(age)) if age > ABANDONED)
        };
        if now.is_none_or(is_abandoned) {
            let removed = match is_folder {
                true => std::fs::remove_dir_all(path),
                false => std::fs::remove_file(path),
            };
            match removed {
                // its writer lives, and is done with it
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                other => other?,
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_damaged_is_replaced_and_a_whole_one_is_not_touched() {
        let bed = tempfile::tempdir().unwrap();
        let path = bed.path().join("a/b");
        assert!(put(&path, b"whole").unwrap());
        let written = path.metadata().unwrap().modified().unwrap();
        assert!(!put(&path, b"whole").unwrap());
        assert_eq!(path.metadata().unwrap().modified().unwrap(), written);
        for damage in ["", "who", "WHOLE"] {
            std::fs::write(&path, damage).unwrap();
            assert!(put(&path, b"whole").unwrap());
            assert_eq!(std::fs::read(&path).unwrap(), b"whole");
        }
        assert_eq!(std::fs::read_dir(bed.path().join("a")).unwrap().count(), 1);
    }

    /// A folder and a file that a killed process left, and a file that is no part of the book's.
    #[test]
    fn what_was_left_unfinished_goes_once_nobody_can_be_writing_it() {
        let bed = tempfile::tempdir().unwrap();
        let names = [".new-a", "x/.new-b", "x/.newer"];
        fill(
            bed.path(),
            &names.map(|name| (name.to_owned(), b"part".to_vec())),
        )
        .unwrap();
        fill(bed.path(), &[("y/.new-c/d".to_owned(), Vec::new())]).unwrap();
        let written = |name: &str| bed.path().join(name).metadata().unwrap().modified();
        let newest = written(".new-a").unwrap().max(written("y/.new-c").unwrap());
        let there = || {
            let is_there = |name: &&str| bed.path().join(name).exists();
            let all = [".new-a", "x/.new-b", "y/.new-c", "x/.newer"];
            all.into_iter().filter(is_there).collect::<Vec<_>>()
        };
        sweep(bed.path(), Some(newest)).unwrap();
        assert_eq!(there().len(), 4, "somebody may be writing them");
        // a clock that is behind
        sweep(bed.path(), Some(newest - ABANDONED)).unwrap();
        assert_eq!(there().len(), 4);
        let later = newest + ABANDONED + Duration::from_secs(1);
        sweep(bed.path(), Some(later)).unwrap();
        assert_eq!(there(), ["x/.newer"]);
    }
}
