//! Files beneath a folder, reached without following a link: what somebody handed in could lead to a secret of whoever reads it. How the
//! folder itself is reached is the choice of the person who named it.

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use kinemark_grader::task::files::{Files, text};
use kinemark_report::output;

use crate::disk;

/// Why a file beneath a folder is not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum Unread {
    /// There is none.
    #[error("there is no such file")]
    Absent,
    /// A part of its path is a link.
    #[error("`{0}` is a link, and links are not followed here")]
    Link(String),
    /// Another reason, in words.
    #[error("{0}")]
    Other(String),
}

/// Opens the file at `path` beneath `folder`, whatever it is; a pipe is not waited for. Neither the file nor a folder on the way to it
/// is a link: each part is opened in the folder that was opened before it, so nobody can exchange one in between.
///
/// # Errors
/// [`Unread`]; a path that leads out of the folder names no file in it.
pub(crate) fn open(folder: &Path, path: impl AsRef<Path>) -> Result<File, Unread> {
    let parts: Vec<Component<'_>> = path.as_ref().components().collect();
    let is_plain = |part: &Component<'_>| matches!(part, Component::Normal(_));
    if parts.is_empty() || !parts.iter().all(is_plain) {
        return Err(Unread::Absent);
    }
    let folder = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let parts: Vec<&Path> = parts.iter().map(AsRef::as_ref).collect();
    opened(folder, &parts)
}

/// What the plain file at `path` beneath `folder` holds, of at most `most` bytes.
///
/// # Errors
/// As [`open()`], and for what is no plain file or is larger.
pub(crate) fn bytes(folder: &Path, path: &str, most: u64) -> Result<Vec<u8>, Unread> {
    disk::contents(open(folder, path)?, most).map_err(Unread::Other)
}

/// The digest of that file, piece by piece.
///
/// # Errors
/// As [`bytes`].
pub(crate) fn digest(folder: &Path, path: &str, most: u64) -> Result<String, Unread> {
    let file = disk::plain_file(open(folder, path)?, most).map_err(Unread::Other)?;
    output::digest_of(file).map_err(|error| Unread::Other(disk::plain(&error)))
}

/// Whether there is a plain file at `path` beneath `folder`.
pub(crate) fn is_file(folder: &Path, path: &str) -> bool {
    let there = open(folder, path)
        .ok()
        .and_then(|file| file.metadata().ok());
    there.is_some_and(|there| there.is_file())
}

#[cfg(unix)]
fn opened(folder: &Path, parts: &[&Path]) -> Result<File, Unread> {
    use rustix::fs::{AtFlags, CWD, FileType, Mode, OFlags, openat, statat};
    let plain = |errno: rustix::io::Errno| Unread::Other(disk::plain(&errno.into()));
    // a folder is only passed through, for which it need not be readable
    #[cfg(any(target_os = "linux", target_os = "android"))]
    let passed = OFlags::PATH | OFlags::DIRECTORY | OFlags::CLOEXEC;
    #[cfg(not(any(target_os = "linux", target_os = "android")))]
    let passed = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let read = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let mut at = openat(CWD, folder, passed, Mode::empty()).map_err(|errno| match errno {
        rustix::io::Errno::NOENT => Unread::Absent,
        other => plain(other),
    })?;
    for (i, part) in parts.iter().enumerate() {
        let flags = if i + 1 == parts.len() { read } else { passed };
        let found = openat(&at, *part, flags | OFlags::NOFOLLOW, Mode::empty());
        at = found.map_err(|errno| {
            // systems differ in what they call a link that is not followed
            let there = statat(&at, *part, AtFlags::SYMLINK_NOFOLLOW);
            let kind = there.map(|there| FileType::from_raw_mode(there.st_mode));
            match (kind, errno) {
                (Ok(FileType::Symlink), _) => Unread::Link(shown(part)),
                (_, rustix::io::Errno::NOENT | rustix::io::Errno::NOTDIR) => Unread::Absent,
                (_, other) => plain(other),
            }
        })?;
    }
    Ok(File::from(at))
}

#[cfg(not(unix))]
fn opened(folder: &Path, parts: &[&Path]) -> Result<File, Unread> {
    let mut path = folder.to_owned();
    let unread = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound | std::io::ErrorKind::NotADirectory => Unread::Absent,
        _ => Unread::Other(disk::plain(&error)),
    };
    for part in parts {
        path.push(part);
        // a junction of Windows is a link, too
        if path.symlink_metadata().map_err(unread)?.is_symlink() {
            return Err(Unread::Link(shown(part)));
        }
    }
    File::open(path).map_err(unread)
}

/// A part of a path for people.
fn shown(part: &Path) -> String {
    kinemark_report::visible::visible(&part.to_string_lossy()).into_owned()
}

/// A folder beneath another one as [`Files`], none of which is reached by a link.
#[derive(Debug, Clone)]
pub(crate) struct FolderBeneath {
    folder: PathBuf,
    path: String,
}

impl FolderBeneath {
    /// The folder at `path` beneath `folder`.
    pub(crate) fn new(folder: PathBuf, path: &str) -> Self {
        let path = path.to_owned();
        Self { folder, path }
    }

    fn contents(&self, path: &str, most: u64) -> Result<Option<Vec<u8>>, String> {
        // beneath the inner folder, too: a name in it leads to nothing beside it
        match bytes(&self.folder, &format!("{}/{path}", self.path), most) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(Unread::Absent) => Ok(None),
            Err(why) => Err(why.to_string()),
        }
    }
}

impl Files for FolderBeneath {
    fn name(&self) -> String {
        self.folder.join(&self.path).display().to_string()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        self.contents(path, disk::MOST_MESH_BYTES)
    }

    fn read(&self, path: &str) -> Result<Option<String>, String> {
        let bytes = self.contents(path, disk::MOST_BYTES)?;
        bytes.map(text).transpose()
    }

    fn list(&self, folder: &str) -> Vec<String> {
        let mut path = self.folder.join(&self.path);
        let inside = Path::new(folder).components();
        let mut ways = vec![path.clone()];
        for part in inside {
            path.push(part);
            ways.push(path.clone());
        }
        let is_link = |path: &PathBuf| {
            let there = path.symlink_metadata();
            there.is_ok_and(|there| there.is_symlink())
        };
        // names alone, which are for suggestions
        let entries = (!ways.iter().any(is_link)).then(|| std::fs::read_dir(path));
        let entries = entries.into_iter().flatten().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort();
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_beneath_a_folder_and_not_beside_it() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("out");
        std::fs::create_dir_all(folder.join("plots")).unwrap();
        for name in ["out/report.html", "out/plots/a.svg", "secret"] {
            std::fs::write(bed.path().join(name), name).unwrap();
        }
        let of = |path: &str| bytes(&folder, path, 99);
        assert_eq!(of("report.html").unwrap(), b"out/report.html");
        assert_eq!(of("plots/a.svg").unwrap(), b"out/plots/a.svg");
        assert!(is_file(&folder, "plots/a.svg") && !is_file(&folder, "plots"));
        let secret = bed.path().join("secret").display().to_string();
        for path in [
            "",
            ".",
            "..",
            "../secret",
            "plots/../report.html",
            "nothing",
            "report.html/a",
            &secret,
        ] {
            assert_eq!(of(path), Err(Unread::Absent), "{path}");
        }
        let too_large = Err(Unread::Other("more than 3 bytes".to_owned()));
        assert_eq!(bytes(&folder, "report.html", 3), too_large);
        assert!(matches!(of("plots"), Err(Unread::Other(_))));
        assert_eq!(bytes(&bed.path().join("none"), "a", 9), Err(Unread::Absent));
        let files = FolderBeneath::new(bed.path().to_owned(), "out");
        assert_eq!(
            files.read("report.html").unwrap().unwrap(),
            "out/report.html"
        );
        assert_eq!(files.read("../secret"), Ok(None));
        assert_eq!(files.list("plots"), ["a.svg"]);
    }

    #[cfg(unix)]
    #[test]
    fn no_link_is_followed_but_the_one_to_the_folder_itself() {
        use std::os::unix::fs::symlink;
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("out");
        std::fs::create_dir_all(folder.join("lab/one")).unwrap();
        for name in ["secret", "out/report.html", "out/lab/one/lab.toml"] {
            std::fs::write(bed.path().join(name), name).unwrap();
        }
        symlink("../secret", folder.join("file")).unwrap();
        symlink("..", folder.join("up")).unwrap();
        symlink("report.html", folder.join("same.html")).unwrap();
        symlink("nowhere", folder.join("dangling")).unwrap();
        symlink("one", folder.join("lab/two")).unwrap();
        for (path, link) in [
            ("file", "file"),
            ("up/secret", "up"),
            ("same.html", "same.html"),
            ("dangling", "dangling"),
            ("lab/two/lab.toml", "two"),
        ] {
            let refused = Err(Unread::Link(link.to_owned()));
            assert_eq!(bytes(&folder, path, 99), refused, "{path}");
            assert!(!is_file(&folder, path), "{path}");
        }
        let files = FolderBeneath::new(folder.clone(), "lab");
        assert_eq!(
            files.read("two/lab.toml").unwrap_err(),
            "`two` is a link, and links are not followed here"
        );
        assert!(files.list("two").is_empty());
        assert_eq!(files.list("one"), ["lab.toml"]);
        symlink(&folder, bed.path().join("chosen")).unwrap();
        let chosen = bed.path().join("chosen");
        assert_eq!(
            bytes(&chosen, "report.html", 99).unwrap(),
            b"out/report.html"
        );
    }

    /// A pipe that nobody writes to, and a folder that can be passed through and not listed.
    #[cfg(unix)]
    #[test]
    fn what_is_no_plain_file_is_refused_at_once() {
        let bed = tempfile::tempdir().unwrap();
        let made = std::process::Command::new("mkfifo")
            .arg(bed.path().join("pipe"))
            .status();
        assert!(made.unwrap().success());
        let refused = Err(Unread::Other("it is no plain file".to_owned()));
        assert_eq!(bytes(bed.path(), "pipe", 9), refused);
    }
}
