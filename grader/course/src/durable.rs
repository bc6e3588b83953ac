//! Writing that a loss of power does not undo: what a file holds is on the disk before the file gets its name, and the name is on the
//! disk before anything says that it is there.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;

use tempfile::NamedTempFile;

/// Who can read what is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Readers {
    /// Its owner alone.
    Owner,
    /// Everybody whom the owner's umask lets.
    Umask,
}

impl Readers {
    /// A temporary file for these readers.
    pub fn temporary_file<'a, 'b>(self) -> tempfile::Builder<'a, 'b> {
        #[cfg_attr(not(unix), expect(unused_mut, reason = "it has no modes there"))]
        let mut builder = tempfile::Builder::new();
        // temporary files are private unless something else is asked for
        #[cfg(unix)]
        if self == Self::Umask {
            use std::os::unix::fs::PermissionsExt as _;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        builder
    }
}

/// The folder that `path` is in.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Gives a temporary file, written, its place.
///
/// # Errors
/// What the system says.
pub fn put_in_place(file: NamedTempFile, path: &Path) -> io::Result<()> {
    reached(file.as_file().sync_all())?;
    file.persist(path).map_err(|error| error.error)?;
    sync_folder(parent(path))
}

/// Gives a temporary file, written, a place where nothing is.
///
/// # Errors
/// What the system says; [`ErrorKind::AlreadyExists`] where something is, which stays.
pub fn put_in_free_place(file: NamedTempFile, path: &Path) -> io::Result<()> {
    reached(file.as_file().sync_all())?;
    file.persist_noclobber(path).map_err(|error| error.error)?;
    sync_folder(parent(path))
}

/// Makes a folder with those above it. One that is there already stays as it is.
///
/// # Errors
/// What the system says.
pub fn make_folder(path: &Path, readers: Readers) -> io::Result<()> {
    if path.as_os_str().is_empty() || path.is_dir() {
        return Ok(());
    }
    make_folder(parent(path), readers)?;
    #[cfg_attr(not(unix), expect(unused_mut, reason = "it has no modes there"))]
    let mut builder = std::fs::DirBuilder::new();
    #[cfg(unix)]
    if readers == Readers::Owner {
        use std::os::unix::fs::DirBuilderExt as _;
        builder.mode(0o700);
    }
    match builder.create(path) {
        // another process was first
        Err(_) if path.is_dir() => Ok(()),
        Err(error) => Err(error),
        Ok(()) => sync_folder(parent(path)),
    }
}

/// Waits until everything in a folder is on the disk: its files, the folders in it, and itself.
///
/// # Errors
/// What the system says.
pub fn sync_tree(folder: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            sync_tree(&entry.path())?;
        } else {
            sync_file(&entry.path())?;
        }
    }
    sync_folder(folder)
}

/// Waits until what a file holds is on the disk.
///
/// # Errors
/// What the system says.
pub fn sync_file(path: &Path) -> io::Result<()> {
    // Windows waits only for what could have been written
    let file = File::options().read(true).write(cfg!(windows)).open(path)?;
    reached(file.sync_all())
}

/// Waits until the names in a folder are on the disk.
///
/// # Errors
/// What the system says.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(not(unix)) {
        // a folder is no file that could be waited for
        return Ok(());
    }
    match File::open(folder) {
        Ok(folder) => reached(folder.sync_all()),
        // it may be written to and not be listed
        Err(error) if error.kind() == ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}

/// Some file systems have nothing to wait for, and say so.
fn reached(synced: io::Result<()>) -> io::Result<()> {
    match synced {
        Err(error) if [ErrorKind::InvalidInput, ErrorKind::Unsupported].contains(&error.kind()) => {
            Ok(())
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    #[test]
    fn folders_are_made_with_those_above_and_files_get_their_place() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("a/b/c");
        make_folder(&folder, Readers::Owner).unwrap();
        make_folder(&folder, Readers::Umask).unwrap();
        for readers in [Readers::Owner, Readers::Umask] {
            let mut file = readers.temporary_file().tempfile_in(&folder).unwrap();
            file.write_all(b"whole").unwrap();
            put_in_place(file, &folder.join("file")).unwrap();
            assert_eq!(std::fs::read(folder.join("file")).unwrap(), b"whole");
        }
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
        sync_tree(bed.path()).unwrap();
        // a file stands in the way
        assert!(make_folder(&folder.join("file/d"), Readers::Owner).is_err());
        assert!(sync_tree(&folder.join("nothing")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn readers_are_those_that_were_asked_for() {
        use std::os::unix::fs::PermissionsExt as _;
        let bed = tempfile::tempdir().unwrap();
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
        for (readers, folder, file) in [
            (Readers::Owner, "owner", "private"),
            (Readers::Umask, "umask", "shared"),
        ] {
            let [folder, file] = [folder, file].map(|name| bed.path().join(name));
            make_folder(&folder, readers).unwrap();
            let written = readers.temporary_file().tempfile_in(bed.path()).unwrap();
            put_in_place(written, &file).unwrap();
            let expected = match readers {
                Readers::Owner => [0o700, 0o600],
                // as the system makes them by itself
                Readers::Umask => {
                    let [usual, plain] = ["usual", "plain"].map(|name| bed.path().join(name));
                    std::fs::create_dir(&usual).unwrap();
                    std::fs::write(&plain, "").unwrap();
                    [mode(&usual), mode(&plain)]
                }
            };
            assert_eq!([mode(&folder), mode(&file)], expected, "{readers:?}");
        }
    }
}
