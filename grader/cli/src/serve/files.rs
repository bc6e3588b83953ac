//! Which file of the folder a path of the address names, and what kind it is.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use kinemark_course::reports::SOURCES_ENDING;
use kinemark_report::output::SOURCES_FOLDER;

use crate::beneath;

/// A page.
pub(super) const HTML: &str = "text/html; charset=utf-8";
/// What nothing makes more of than letters.
const TEXT: &str = "text/plain; charset=utf-8";
/// A picture of lines.
pub(super) const SVG: &str = "image/svg+xml";

/// What is read as a whole: a page that is another when it is served. With the meshes of its robots it is far smaller.
const MOST_PAGE_BYTES: u64 = 64 << 20;

/// Why a file is not served.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Unread {
    Absent,
    TooLarge,
}

/// A plain file, opened.
#[derive(Debug)]
pub(super) struct OpenFile {
    pub(super) file: File,
    /// How long it is.
    pub(super) bytes: u64,
}

/// Opens the file at `path` below `folder`. Neither it nor a folder on the way is a link.
pub(super) fn open(folder: &Path, path: &str) -> Result<OpenFile, Unread> {
    // the folder is looked up each time: a report that is written again is another folder of the same name
    let file = is_served(path).then(|| beneath::open(folder, path).ok());
    let file = file.flatten().ok_or(Unread::Absent)?;
    // asked of what was opened: what lies at the path may be another by now
    match file.metadata() {
        Ok(there) if there.is_file() => Ok(OpenFile {
            bytes: there.len(),
            file,
        }),
        _ => Err(Unread::Absent),
    }
}

/// What the page at `path` below `folder` holds.
pub(super) fn read(folder: &Path, path: &str) -> Result<Vec<u8>, Unread> {
    let OpenFile { file, bytes } = open(folder, path)?;
    if bytes > MOST_PAGE_BYTES {
        return Err(Unread::TooLarge);
    }
    let mut page = Vec::new();
    let read = file.take(MOST_PAGE_BYTES).read_to_end(&mut page);
    read.map(|_| page).map_err(|_| Unread::Absent)
}

/// Whether there is a plain file at `path` below `folder` that is served.
pub(super) fn is_there(folder: &Path, path: &str) -> bool {
    is_served(path) && beneath::is_file(folder, path)
}

/// Whether no part of a path is hidden, or more than a name.
fn is_served(path: &str) -> bool {
    let is_plain = |part: &str| {
        let strange = |c: char| c.is_control() || matches!(c, '\\' | ':');
        !part.is_empty() && !part.starts_with('.') && !part.contains(strange)
    };
    path.split('/').all(is_plain)
}

/// Whether a folder holds sources of a module, in a report or beside the pages of a book.
fn is_of_sources(folder: &str) -> bool {
    folder == SOURCES_FOLDER || folder.ends_with(SOURCES_ENDING)
}

/// The media type of a file by its name. What could run and is no page of ours is text, and so is every source of a module.
pub(super) fn media_type(path: &str) -> &'static str {
    if path.split('/').any(is_of_sources) {
        return TEXT;
    }
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    match ending.to_ascii_lowercase().as_str() {
        "html" => HTML,
        "svg" => SVG,
        "png" => "image/png",
        "webp" => "image/webp",
        "json" => "application/json",
        "csv" => "text/csv; charset=utf-8",
        "rhai" | "toml" | "md" | "txt" | "urdf" | "js" | "css" => TEXT,
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_plain_files_of_the_folder_are_found() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("out");
        std::fs::create_dir_all(folder.join("plots")).unwrap();
        std::fs::create_dir_all(folder.join(".git")).unwrap();
        for name in [
            "out/report.html",
            "out/plots/a.svg",
            "out/.env",
            "out/.git/config",
            "secret",
        ] {
            std::fs::write(bed.path().join(name), name).unwrap();
        }
        assert_eq!(read(&folder, "report.html").unwrap(), b"out/report.html");
        assert_eq!(read(&folder, "plots/a.svg").unwrap(), b"out/plots/a.svg");
        for other in [
            "",
            ".",
            "..",
            "plots",
            "plots/",
            "plots/..",
            "../secret",
            "plots/../../secret",
            "/report.html",
            "plots//a.svg",
            "..\\secret",
            ".env",
            ".git/config",
            "report.html\0",
            "C:report.html",
            "nothing",
        ] {
            assert_eq!(read(&folder, other), Err(Unread::Absent), "{other}");
        }
        assert_eq!(
            read(&folder, &bed.path().join("secret").display().to_string()),
            Err(Unread::Absent)
        );
    }

    #[cfg(unix)]
    #[test]
    fn no_link_is_followed() {
        use std::os::unix::fs::symlink;
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("out");
        std::fs::create_dir_all(&folder).unwrap();
        for name in ["secret", "out/.env", "out/report.html"] {
            std::fs::write(bed.path().join(name), name).unwrap();
        }
        symlink("../secret", folder.join("file")).unwrap();
        symlink("..", folder.join("up")).unwrap();
        symlink(".env", folder.join("env")).unwrap();
        symlink("report.html", folder.join("same.html")).unwrap();
        for other in ["file", "up/secret", "env", "same.html"] {
            assert_eq!(read(&folder, other), Err(Unread::Absent), "{other}");
        }
        // the folder that was named may be reached by one
        symlink("out", bed.path().join("chosen")).unwrap();
        let chosen = bed.path().join("chosen");
        assert_eq!(read(&chosen, "report.html").unwrap(), b"out/report.html");
    }
}
