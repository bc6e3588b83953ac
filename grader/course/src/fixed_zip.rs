//! ZIP archives whose bytes follow from their files alone: no clock, no system, no order but the one given.

use std::io::{self, Cursor, Write as _};

use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

/// A file of an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ArchiveFile {
    /// Its path inside, with `/` between folders.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Whether it can be run once it is unpacked.
    pub is_executable: bool,
}

impl ArchiveFile {
    /// A file that is read only.
    pub fn new(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self {
            path: path.into(),
            bytes: bytes.into(),
            is_executable: false,
        }
    }

    /// A file that is run.
    pub fn executable(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self {
            is_executable: true,
            ..Self::new(path, bytes)
        }
    }
}

/// The archive of `files`, in their order.
///
/// # Errors
/// A path twice, or more bytes than a ZIP can hold.
pub fn archive(files: &[ArchiveFile]) -> io::Result<Vec<u8>> {
    // every field that would differ between two machines or two minutes is given
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::DEFAULT)
        .system(System::Unix);
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for file in files {
        let mode = if file.is_executable { 0o755 } else { 0o644 };
        writer
            .start_file(file.path.as_str(), options.unix_permissions(mode))
            .map_err(plain)?;
        writer.write_all(&file.bytes)?;
    }
    Ok(writer.finish().map_err(plain)?.into_inner())
}

fn plain(error: ZipError) -> io::Error {
    io::Error::other(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Vec<ArchiveFile> {
        vec![
            ArchiveFile::new("README.md", "read me"),
            ArchiveFile::executable("run", "#!/bin/sh\n"),
        ]
    }

    #[test]
    fn the_same_files_give_the_same_bytes() {
        assert_eq!(archive(&files()).unwrap(), archive(&files()).unwrap());
        let mut turned = files();
        turned.reverse();
        assert_ne!(archive(&turned).unwrap(), archive(&files()).unwrap());
    }

    #[test]
    fn a_program_stays_one_and_times_are_fixed() {
        let bytes = archive(&files()).unwrap();
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        for (name, mode) in [("README.md", 0o644), ("run", 0o755)] {
            let file = archive.by_name(name).unwrap();
            assert_eq!(file.unix_mode().unwrap() & 0o777, mode, "{name}");
            assert_eq!(file.last_modified(), Some(DateTime::DEFAULT));
        }
    }

    #[test]
    fn a_path_twice_is_refused() {
        let twice = [files(), files()].concat();
        assert!(archive(&twice).is_err());
    }
}
