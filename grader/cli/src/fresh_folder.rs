//! A folder that is written under another name beside its place and then put there, so that it is whole or not there; what was there
//! before goes with it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

use kinemark_report::visible::visible;
use tempfile::TempDir;

use crate::disk::{self, plain};
use crate::failure::Failure;

/// A folder being written.
#[derive(Debug)]
pub(crate) struct FreshFolder {
    /// Removed when dropped, whatever happens.
    temporary: TempDir,
    out: PathBuf,
}

impl FreshFolder {
    /// Starts a folder that is to be `out`; where that is a link to a folder, the folder that it leads to.
    pub(crate) fn beside(out: &Path) -> std::io::Result<Self> {
        let out = disk::real(out);
        let parent = match out.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        std::fs::create_dir_all(parent)?;
        let temporary = tempfile::Builder::new()
            .prefix(".kinemark-")
            .tempdir_in(parent)?;
        let fresh = Self { temporary, out };
        std::fs::create_dir(fresh.path())?;
        Ok(fresh)
    }

    /// Where to write.
    pub(crate) fn path(&self) -> PathBuf {
        self.temporary.path().join("new")
    }

    /// Writes a file inside, with the folders above it. Nobody sees it before it is put in place.
    pub(crate) fn write(&self, path: &str, bytes: &[u8]) -> std::io::Result<()> {
        let path = self.path().join(path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        std::fs::write(path, bytes)
    }

    /// Puts it in its place. Of what was there before, the entries at `kept`, paths inside the folder, stay where they were.
    pub(crate) fn put_in_place(self, kept: &[String]) -> std::io::Result<()> {
        let Some(old) = self.swap()? else {
            return Ok(());
        };
        for path in kept {
            let to = self.out.join(path);
            let moved = match to.parent() {
                Some(folder) => std::fs::create_dir_all(folder),
                None => Ok(()),
            };
            if let Err(error) = moved.and_then(|()| rename(&old.join(path), &to)) {
                // somebody's own: better an old folder too many than a lost file
                let left = self.temporary.keep();
                return Err(std::io::Error::other(format!(
                    "`{path}` is left in `{}`: {}",
                    left.display(),
                    plain(&error)
                )));
            }
        }
        Ok(())
    }

    /// Puts it in its place and says where the earlier folder is, if there was one.
    fn swap(&self) -> std::io::Result<Option<PathBuf>> {
        if !self.out.exists() {
            rename(&self.path(), &self.out)?;
            return Ok(None);
        }
        if exchange(&self.path(), &self.out) {
            return Ok(Some(self.path()));
        }
        let old = self.temporary.path().join("old");
        rename(&self.out, &old)?;
        rename(&self.path(), &self.out).inspect_err(|_| {
            // put the earlier one back; the error is reported either way
            let _ = rename(&old, &self.out);
        })?;
        Ok(Some(old))
    }
}

/// Renames a folder. On Windows that fails while any file in it is open, and a scanner for viruses opens each file that was just written:
/// there it is tried for a second.
fn rename(from: &Path, to: &Path) -> std::io::Result<()> {
    if cfg!(windows) {
        patiently(|| std::fs::rename(from, to), std::thread::sleep)
    } else {
        std::fs::rename(from, to)
    }
}

/// Tries again while access is denied, after 10, 20, 40 ... 640 ms.
fn patiently(
    mut attempt: impl FnMut() -> std::io::Result<()>,
    mut sleep: impl FnMut(Duration),
) -> std::io::Result<()> {
    for doublings in 0..7 {
        match attempt() {
            Err(error) if error.kind() == ErrorKind::PermissionDenied => {
                sleep(Duration::from_millis(10 << doublings));
            }
            done => return done,
        }
    }
    attempt()
}

/// Exchanges two folders in one step, so that there is one at each place at any time; whether that worked.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(one: &Path, other: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    // some file systems cannot
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).is_ok()
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> bool {
    false
}

/// What an entry of a folder is to whoever wrote the folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Entry {
    /// A file of ours.
    Ours,
    /// A folder of ours: what is in it has to be looked at.
    Inside,
    /// Not ours, and kept where it is.
    Kept,
    /// Not ours.
    Foreign,
}

/// Checks that `out` is free, empty, or holds nothing but what is `ours`, `whole` in words: replacing it would lose the rest. Gives the
/// paths of what is to be kept. Paths are relative to `out`, with `/` between names; links are never ours.
pub(crate) fn refuse_foreign(
    out: &Path,
    whole: &str,
    ours: impl Fn(&str) -> Entry,
) -> Result<Vec<String>, Failure> {
    let help = "choose another folder with --out";
    let shown = out.display();
    // a file, a device, a pipe, a link to nowhere: whatever is there and no folder stays as it is
    if out.symlink_metadata().is_err() {
        return Ok(Vec::new());
    }
    if !out.is_dir() {
        return Err(Failure::usage(
            format!("`{shown}` exists and is not a directory"),
            help,
        ));
    }
    let real = disk::real(out);
    let is_around_us =
        std::env::current_dir().is_ok_and(|here| disk::real(&here).starts_with(&real));
    if is_around_us {
        return Err(Failure::usage(
            format!(
                "`{shown}` is the current directory or one of its parents, which cannot be replaced"
            ),
            help,
        ));
    }
    let mut kept = Vec::new();
    let mut open = vec![String::new()];
    while let Some(folder) = open.pop() {
        let unread = |error: std::io::Error| {
            let path = real.join(&folder);
            Failure::usage(
                format!("`{}` cannot be listed: {}", path.display(), plain(&error)),
                help,
            )
        };
        let mut names = Vec::new();
        for entry in std::fs::read_dir(real.join(&folder)).map_err(unread)? {
            let entry = entry.map_err(unread)?;
            let kind = entry.file_type().map_err(unread)?;
            names.push((entry.file_name().to_string_lossy().into_owned(), kind));
        }
        names.sort_by(|(one, _), (other, _)| one.cmp(other));
        for (name, kind) in names {
            let path = if folder.is_empty() {
                name
            } else {
                format!("{folder}/{name}")
            };
            match ours(&path) {
                Entry::Ours if kind.is_file() => {}
                Entry::Inside if kind.is_dir() => open.push(path),
                Entry::Kept if kind.is_dir() => kept.push(path),
                Entry::Ours | Entry::Inside | Entry::Kept | Entry::Foreign => {
                    return Err(Failure::usage(
                        format!(
                            "`{shown}` contains `{}`, which is not part of {whole}",
                            visible(&path)
                        ),
                        help,
                    ));
                }
            }
        }
    }
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How often it is tried, how long it waits in all, and how it ends.
    fn tried(denied: u32, then: ErrorKind) -> (u32, Duration, Option<ErrorKind>) {
        let (mut attempts, mut waited) = (0, Duration::ZERO);
        let ended = patiently(
            || {
                attempts += 1;
                match attempts {
                    now if now <= denied => Err(ErrorKind::PermissionDenied.into()),
                    _ if then == ErrorKind::Other => Ok(()),
                    _ => Err(then.into()),
                }
            },
            |pause| waited += pause,
        );
        (attempts, waited, ended.err().map(|error| error.kind()))
    }

    #[test]
    fn a_folder_that_is_open_elsewhere_is_waited_for_and_nothing_else_is() {
        assert_eq!(tried(0, ErrorKind::Other), (1, Duration::ZERO, None));
        let ended = tried(3, ErrorKind::Other);
        assert_eq!(ended, (4, Duration::from_millis(70), None));
        let ended = tried(0, ErrorKind::NotFound);
        assert_eq!(ended, (1, Duration::ZERO, Some(ErrorKind::NotFound)));
        // a second, and then it is said
        let denied = Some(ErrorKind::PermissionDenied);
        let ended = tried(u32::MAX, ErrorKind::Other);
        assert_eq!(ended, (8, Duration::from_millis(1270), denied));
    }
}
