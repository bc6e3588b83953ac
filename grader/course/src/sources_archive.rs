//! The sources of a module as one file of the book, which keeps them under their digest as it keeps submissions.

use std::io::{self, Cursor, Read as _};

use zip::ZipArchive;

use crate::fixed_zip::{ArchiveFile, archive};
use crate::module_sources::{MOST_BYTES, MOST_FILES, SourceFile, is_kept_path};

/// The archive of sources.
///
/// # Errors
/// A path twice.
pub(crate) fn packed(sources: &[SourceFile]) -> io::Result<Vec<u8>> {
    let files = sources.iter();
    let files: Vec<ArchiveFile> = files
        .map(|file| ArchiveFile::new(file.path.as_str(), file.bytes.as_slice()))
        .collect();
    archive(&files)
}

/// The sources in such an archive.
///
/// # Errors
/// Another file, or more than [`packed`] has made.
pub(crate) fn unpacked(bytes: &[u8]) -> io::Result<Vec<SourceFile>> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(io::Error::other)?;
    // the list of what was not kept is one more
    if archive.len() > MOST_FILES + 1 {
        return Err(io::Error::other("it has more files than sources are kept"));
    }
    let mut sources = Vec::new();
    for at in 0..archive.len() {
        let file = archive.by_index(at).map_err(io::Error::other)?;
        let path = file.name().map_err(io::Error::other)?.into_owned();
        if !is_kept_path(&path) {
            return Err(io::Error::other("it has a name that no source has"));
        }
        let mut bytes = Vec::new();
        file.take(MOST_BYTES).read_to_end(&mut bytes)?;
        sources.push(SourceFile { path, bytes });
    }
    Ok(sources)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_come_back_as_they_were() {
        let file = |path: &str, text: &str| SourceFile {
            path: path.to_owned(),
            bytes: text.as_bytes().to_vec(),
        };
        let sources = vec![file("Cargo.toml", "[package]"), file("src/lib.rs", "")];
        let bytes = packed(&sources).unwrap();
        assert_eq!(packed(&sources).unwrap(), bytes);
        assert_eq!(unpacked(&bytes).unwrap(), sources);
        assert!(unpacked(b"PK").is_err());
        let outside = packed(&[file("../x", "")]).unwrap();
        assert!(unpacked(&outside).is_err());
    }
}
