//! Files of an earlier year, read from whatever they are kept in: a folder, what the LMS exported then, or the submissions of a book.

use std::path::Path;

use crate::hand_in_file::HandInFile;
use crate::submission_name::NameKind;
use crate::tree::{Entry, Limits, Tree, TreeError};

/// A script beyond this is none.
const MOST_BYTES: u64 = 4 << 20;
/// Files in an archive of one person.
const MOST_INSIDE: usize = 10_000;

/// Every script, module and hand-in file in a folder or an archive, by path, each file once; archives inside are looked into. What
/// cannot be read is left out.
///
/// # Errors
/// A source that is not there, or is neither folder nor archive.
pub fn earlier_files(source: &Path) -> Result<Vec<(String, Vec<u8>)>, TreeError> {
    let tree = Tree::open(source, &Limits::default())?;
    let mut found = Vec::new();
    read(&tree, &source.display().to_string(), &mut found);
    // the same file of many people is one
    found.sort_by(|a, b| a.1.cmp(&b.1).then_with(|| a.0.cmp(&b.0)));
    found.dedup_by(|a, b| a.1 == b.1);
    found.sort();
    Ok(found)
}

fn read(tree: &Tree, above: &str, found: &mut Vec<(String, Vec<u8>)>) {
    for entry in tree.entries() {
        let path = format!("{above}/{}", entry.path);
        match kind(entry) {
            NameKind::Archive => {
                if let Ok(inside) = tree.nested(entry, MOST_INSIDE) {
                    read(&inside, &path, found);
                }
            }
            NameKind::HandIn => {
                let bytes = tree.bytes(entry, MOST_BYTES).ok();
                let read = bytes.and_then(|bytes| HandInFile::read(&bytes).ok());
                found.extend(read.map(|file| (path, file.submission)));
            }
            NameKind::Submission | NameKind::SubmissionText | NameKind::Script => {
                let bytes = tree.bytes(entry, MOST_BYTES).ok();
                found.extend(bytes.map(|bytes| (path, bytes)));
            }
            NameKind::Starter | NameKind::Other => {}
        }
    }
}

/// What a file is by its name; in a book submissions are named by their digests.
fn kind(entry: &Entry) -> NameKind {
    let name = entry.path.rsplit('/').next().unwrap_or(&entry.path);
    let is_digest = name.len() == 64 && name.bytes().all(|byte| byte.is_ascii_hexdigit());
    if is_digest {
        NameKind::Submission
    } else {
        NameKind::of(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed_zip::ArchiveFile;

    #[test]
    fn scripts_are_found_wherever_they_are_kept() {
        let bed = tempfile::tempdir().unwrap();
        let digest = "a1".repeat(32);
        for (path, text) in [
            ("smith/submission.rhai", "let a = 1;"),
            ("jones/my lab.rhai", "let b = 2;"),
            ("copy/submission.rhai", "let a = 1;"),
            ("jones/starter.rhai", "let s = 0;"),
            ("jones/notes.md", "# notes"),
            ("notes.md", "# notes"),
        ] {
            let path = bed.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        let shelf = bed.path().join("submissions/a1");
        std::fs::create_dir_all(&shelf).unwrap();
        std::fs::write(shelf.join(&digest), "let c = 3;").unwrap();
        let zip = crate::fixed_zip::archive(&[ArchiveFile::new("x/d.rhai", "let d = 4;")]).unwrap();
        std::fs::write(bed.path().join("lee.zip"), zip).unwrap();
        let found = earlier_files(bed.path()).unwrap();
        let shown: Vec<(&str, &str)> = found
            .iter()
            .map(|(path, bytes)| {
                let path = path.strip_prefix(&bed.path().display().to_string());
                (path.unwrap(), std::str::from_utf8(bytes).unwrap())
            })
            .collect();
        let kept = format!("/submissions/a1/{digest}");
        assert_eq!(
            shown,
            [
                ("/copy/submission.rhai", "let a = 1;"),
                ("/jones/my lab.rhai", "let b = 2;"),
                ("/lee.zip/x/d.rhai", "let d = 4;"),
                (kept.as_str(), "let c = 3;"),
            ]
        );
        assert!(earlier_files(&bed.path().join("nowhere")).is_err());
    }
}
