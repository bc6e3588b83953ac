//! A folder that is written under another name beside its place and then put there, so that it is whole or not there; what was there
//! before goes with it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

use kinemark_course::durable::{self, Readers};
use kinemark_report::visible::visible;

use crate::disk::{self, plain};
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::unfinished::{UnfinishedFolder, move_kept};

/// Each time somebody else must have put a folder there, or taken it away, in the same moment.
const MOST_TRIES: usize = 100;

/// A folder being written.
#[derive(Debug)]
pub(crate) struct FreshFolder {
    /// Removed when dropped, whatever happens.
    unfinished: UnfinishedFolder,
    out: PathBuf,
}

impl FreshFolder {
    /// Starts a folder that is to be `out`; where that is a link to a folder, the folder that it leads to.
    pub(crate) fn beside(out: &Path) -> std::io::Result<Self> {
        let out = disk::real(out);
        let parent = durable::parent(&out);
        durable::make_folder(parent, Readers::Umask)?;
        let unfinished = UnfinishedFolder::in_folder(parent)?;
        let fresh = Self { unfinished, out };
        std::fs::create_dir(fresh.path())?;
        Ok(fresh)
    }

    /// Where to write.
    pub(crate) fn path(&self) -> PathBuf {
        self.unfinished.new_part()
    }

    /// Writes a file inside, with the folders above it. Nobody sees it before it is put in place.
    pub(crate) fn write(&self, path: &str, bytes: &[u8]) -> std::io::Result<()> {
        let path = self.path().join(path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        std::fs::write(path, bytes)
    }

    /// Puts it in its place, once all of it is on the disk. Of what was there before, the entries at `kept`, paths inside the folder,
    /// stay where they were.
    pub(crate) fn put_in_place(self, kept: &[String]) -> std::io::Result<()> {
        durable::sync_tree(&self.path())?;
        let old = self.swap(kept)?;
        durable::sync_folder(durable::parent(&self.out))?;
        let Some(old) = old else {
            return Ok(());
        };
        move_kept(&old, &self.out, kept).inspect_err(|_| {
            // somebody's own: better an old folder too many than a lost file
            self.unfinished.leave();
        })
    }

    /// Puts it in its place and says where the earlier folder is, if there was one.
    fn swap(&self, kept: &[String]) -> std::io::Result<Option<PathBuf>> {
        let new = self.path();
        if !kept.is_empty() {
            self.unfinished.note_place(&self.out, kept)?;
        }
        for _ in 0..MOST_TRIES {
            if exchange(&new, &self.out) {
                return Ok(Some(new));
            }
            if self.out.symlink_metadata().is_ok() {
                return self.move_aside(kept).map(Some);
            }
            match rename(&new, &self.out) {
                // another process has put its own there
                Err(_) if self.out.symlink_metadata().is_ok() => {}
                other => return other.map(|()| None),
            }
        }
        Err(std::io::Error::other(
            "it is put there and taken away by somebody else all the time",
        ))
    }

    /// Puts it in its place where folders cannot be exchanged: for a moment there is none.
    fn move_aside(&self, kept: &[String]) -> std::io::Result<PathBuf> {
        self.unfinished.note_place(&self.out, kept)?;
        let old = self.unfinished.old_part();
        rename(&self.out, &old)?;
        rename(&self.path(), &self.out).inspect_err(|_| {
            // put the earlier one back; the error is reported either way
            let _ = rename(&old, &self.out);
        })?;
        Ok(old)
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
        return Err(
            Failure::usage(format!("`{shown}` exists and is not a directory"), help)
                .coded(ErrorCode::Exists),
        );
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
    let others = others(&real, ours).map_err(|why| Failure::usage(why, help))?;
    if let Some((path, _)) = others.iter().find(|(_, entry)| *entry != Entry::Kept) {
        return Err(Failure::usage(
            format!(
                "`{shown}` contains `{}`, which is not part of {whole}",
                visible(path)
            ),
            help,
        )
        .coded(ErrorCode::Exists));
    }
    Ok(others.into_iter().map(|(path, _)| path).collect())
}

/// What is in a folder and is not `ours`, by path: what is kept, and what is foreign, which all is that should be a file or a folder and
/// is none. No link is followed below the folder.
///
/// # Errors
/// Which folder cannot be listed, in words.
pub(crate) fn others(
    real: &Path,
    ours: impl Fn(&str) -> Entry,
) -> Result<Vec<(String, Entry)>, String> {
    let mut others = Vec::new();
    let mut open = vec![String::new()];
    while let Some(folder) = open.pop() {
        let unread = |error: std::io::Error| {
            let path = real.join(&folder);
            format!("`{}` cannot be listed: {}", path.display(), plain(&error))
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
                Entry::Kept if kind.is_dir() => others.push((path, Entry::Kept)),
                Entry::Ours | Entry::Inside | Entry::Kept | Entry::Foreign => {
                    others.push((path, Entry::Foreign));
                }
            }
        }
    }
    Ok(others)
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

    /// What is in a folder, sorted.
    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    #[test]
    fn an_earlier_folder_goes_and_what_is_kept_of_it_stays() {
        let kept = ["move/run-csv".to_owned(), "never/there".to_owned()];
        for can_exchange in [true, false] {
            let bed = tempfile::tempdir().unwrap();
            let out = bed.path().join("a/out");
            for text in ["1", "2"] {
                let fresh = FreshFolder::beside(&out).unwrap();
                fresh.write("move/report.html", text.as_bytes()).unwrap();
                if text == "1" {
                    fresh.write("old", b"").unwrap();
                    fresh.write("move/run-csv/a.csv", b"mine").unwrap();
                }
                if can_exchange || text == "1" {
                    fresh.put_in_place(&kept).unwrap();
                } else {
                    let old = fresh.move_aside(&kept).unwrap();
                    move_kept(&old, &out, &kept).unwrap();
                }
                let report = out.join("move/report.html");
                assert_eq!(std::fs::read_to_string(report).unwrap(), text);
            }
            assert_eq!(names(&out), ["move"]);
            assert_eq!(names(&out.join("move")), ["report.html", "run-csv"]);
            assert_eq!(names(&bed.path().join("a")), ["out"], "nothing is left");
        }
    }

    /// None of them finds its own folder removed, or sees half of another's.
    #[test]
    fn eight_write_to_one_place_at_once() {
        let bed = tempfile::tempdir().unwrap();
        let out = bed.path().join("out");
        std::thread::scope(|threads| {
            for writer in 0..8 {
                let out = &out;
                threads.spawn(move || {
                    for _ in 0..20 {
                        let fresh = FreshFolder::beside(out).unwrap();
                        for name in ["a", "b/c"] {
                            fresh.write(name, &[writer]).unwrap();
                        }
                        fresh.put_in_place(&["t".to_owned()]).unwrap();
                    }
                });
            }
        });
        let [a, c] = ["a", "b/c"].map(|name| std::fs::read(out.join(name)).unwrap());
        assert_eq!(a, c);
        assert_eq!(names(bed.path()), ["out"]);
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
