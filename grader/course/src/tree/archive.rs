//! The files of a ZIP archive: listed from its directory, unpacked one at a time and never beyond a limit.

use std::io::{self, Read, Seek};
use std::sync::{Mutex, PoisonError};

use zip::read::{Config, OwnedZipFileEntry, ZipFileEntry};
use zip::result::ZipError;
// the stable reader drops all but one of the entries of one name, and reads them all at once
use zip::unstable::read::ZipIterable;
use zip::{CompressionMethod, ZipReadOptions};

use super::limits::Limits;
use super::listing::{BytesAt, Listing};
use super::problem::EntryProblem;

/// What an archive is read from.
pub(super) trait Bytes: Read + Seek + Send {}

impl<T: Read + Seek + Send> Bytes for T {}

/// An archive that was listed.
pub(super) struct Archive {
    bytes: Mutex<Box<dyn Bytes>>,
    files: Vec<OwnedZipFileEntry>,
}

/// Bits of a Unix mode that say what an entry is, and the two that are read.
const KIND_BITS: u32 = 0o170_000;
const REGULAR: u32 = 0o100_000;
const FOLDER: u32 = 0o040_000;

/// Lists an archive.
///
/// # Errors
/// A directory that cannot be read to its end, or too many entries.
pub(super) fn list(
    mut bytes: Box<dyn Bytes>,
    limits: &Limits,
) -> Result<(Archive, Listing), EntryProblem> {
    let mut listing = Listing::default();
    let mut files = Vec::new();
    let mut directory =
        ZipIterable::try_new(&mut bytes, Config::default()).map_err(|why| damaged(&why))?;
    // before any of them is read: a directory of millions costs memory
    if directory.len() > limits.entries {
        return Err(EntryProblem::TooManyEntries {
            found: directory.len(),
            most: limits.entries,
        });
    }
    for entry in directory.files().map_err(|why| damaged(&why))? {
        let entry = entry.map_err(|why| damaged(&why))?;
        listing.count(limits)?;
        let name = match entry.name() {
            Ok(name) => name.into_owned(),
            Err(why) => return Err(damaged(&why)),
        };
        if entry.is_dir() || name.ends_with('\\') {
            listing.folder(&name, limits);
            continue;
        }
        let (size, problem) = (entry.size(), problem_of(&entry));
        listing.file(&name, Some(size), problem, limits, || {
            files.push(entry.into());
            BytesAt::Archive(files.len() - 1)
        });
    }
    listing.finish();
    let bytes = Mutex::new(bytes);
    Ok((Archive { bytes, files }, listing))
}

/// What the directory already says against an entry.
fn problem_of(entry: &ZipFileEntry<'_>) -> Option<EntryProblem> {
    let kind = entry.unix_mode().unwrap_or_default() & KIND_BITS;
    if entry.is_symlink() {
        return Some(EntryProblem::Link);
    }
    if !matches!(kind, 0 | REGULAR | FOLDER) {
        return Some(EntryProblem::Special);
    }
    if entry.encrypted() {
        return Some(EntryProblem::Encrypted);
    }
    match entry.compression() {
        CompressionMethod::Stored | CompressionMethod::Deflated => None,
        other => Some(EntryProblem::Compression {
            method: other.to_string(),
        }),
    }
}

impl Archive {
    /// Unpacks at most `most` bytes of a file to the end of `bytes`. Its checksum is compared where its end is reached.
    ///
    /// # Errors
    /// Bytes that do not unpack, or to something else than the directory says; `bytes` has what came out before.
    pub(super) fn read(
        &self,
        file: usize,
        most: u64,
        bytes: &mut Vec<u8>,
    ) -> Result<(), EntryProblem> {
        // a reader that panicked left no state: each read seeks first
        let mut archive = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = self.files[file].as_ref();
        let file = entry
            .with_reader(&mut *archive, ZipReadOptions::new())
            .map_err(|why| damaged(&why))?;
        let read = file.take(most).read_to_end(bytes);
        read.map_err(|why| damaged(&ZipError::Io(why)))?;
        Ok(())
    }
}

/// The words for what the reader of archives refuses.
fn damaged(why: &ZipError) -> EntryProblem {
    let why = match why {
        ZipError::Io(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
            "its end is missing".to_owned()
        }
        ZipError::Io(error) => error.to_string(),
        ZipError::InvalidArchive(detail) if detail.contains("EOCD") => {
            "its end, with the list of its files, is missing".to_owned()
        }
        ZipError::InvalidArchive(detail) => detail.to_string(),
        other => other.to_string(),
    };
    EntryProblem::Damaged { why }
}
