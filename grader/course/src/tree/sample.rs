//! Archives and folders for tests, from pairs of a path and its bytes.

use std::io::{Cursor, Write as _};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{Limits, Tree};

/// A ZIP archive; a path that ends in `/` is a folder.
pub(crate) fn zip<P: AsRef<str>, B: AsRef<[u8]>>(files: &[(P, B)]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        let path = path.as_ref();
        if path.ends_with('/') {
            writer
                .add_directory(path, SimpleFileOptions::default())
                .unwrap();
            continue;
        }
        writer
            .start_file(path, SimpleFileOptions::default())
            .unwrap();
        writer.write_all(bytes.as_ref()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// The tree of an archive of these files.
pub(crate) fn tree<P: AsRef<str>, B: AsRef<[u8]>>(files: &[(P, B)]) -> Tree {
    Tree::of_zip(zip(files), &Limits::default()).unwrap()
}

/// A folder of these files on the disk.
pub(crate) fn folder<P: AsRef<str>, B: AsRef<[u8]>>(files: &[(P, B)]) -> tempfile::TempDir {
    let bed = tempfile::tempdir().unwrap();
    for (path, bytes) in files {
        let path = bed.path().join(path.as_ref());
        if path.to_string_lossy().ends_with('/') {
            std::fs::create_dir_all(&path).unwrap();
            continue;
        }
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes.as_ref()).unwrap();
    }
    bed
}
