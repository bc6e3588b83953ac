//! Files and folders that their owner alone can read, written whole or not at all.

use std::io::{self, Write as _};
use std::path::Path;

/// How the name of a file begins that is being written, or that a killed process has left; it counts for nothing.
pub(crate) const UNFINISHED: &str = ".new-";

/// Makes a folder, with those above it, that its owner alone can read. One that is there already stays as it is.
///
/// # Errors
/// What the system says.
pub fn private_folder(path: &Path) -> io::Result<()> {
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
pub(crate) fn fresh_folder(folder: &Path, prefix: &str) -> io::Result<tempfile::TempDir> {
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
/// failing disk has damaged, is replaced.
pub(crate) fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if std::fs::read(path).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    private_folder(folder)?;
    let mut file = tempfile::Builder::new()
        .prefix(UNFINISHED)
        .tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_damaged_file_is_replaced_and_a_whole_one_is_not_touched() {
        let bed = tempfile::tempdir().unwrap();
        let path = bed.path().join("a/b");
        put(&path, b"whole").unwrap();
        let written = path.metadata().unwrap().modified().unwrap();
        put(&path, b"whole").unwrap();
        assert_eq!(path.metadata().unwrap().modified().unwrap(), written);
        for damage in ["", "who", "WHOLE"] {
            std::fs::write(&path, damage).unwrap();
            put(&path, b"whole").unwrap();
            assert_eq!(std::fs::read(&path).unwrap(), b"whole");
        }
        assert_eq!(std::fs::read_dir(bed.path().join("a")).unwrap().count(), 1);
    }
}
