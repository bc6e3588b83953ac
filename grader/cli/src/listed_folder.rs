//! A private folder whose files a command lists in it, so that the next run replaces these and touches nothing else.

use std::collections::BTreeSet;
use std::path::{Component, Path};

use kinemark_course::private_files::private_folder;
use serde::{Deserialize, Serialize};

use crate::disk::{self, plain};
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::output;

/// The list.
const LIST_FILE: &str = ".kinemark-files.json";
/// Its format.
const FORMAT: &str = "kinemark-files/1";
/// A list of a hundred thousand files is smaller.
const MOST_BYTES: u64 = 64 << 20;
/// What helps where something cannot be written.
const HELP: &str = "free some space, or choose another folder with --out";

#[derive(Serialize, Deserialize)]
struct List {
    format: String,
    files: BTreeSet<String>,
}

/// Writes `files`, by path with `/` between folders, into `folder`, and removes what an earlier run wrote and this one does not. Its
/// owner alone can read them.
///
/// # Errors
/// A file of somebody else's in the place of one of them, and a full disk.
pub(crate) fn write(folder: &Path, files: &[(&str, &[u8])]) -> Result<(), Failure> {
    let earlier = earlier(folder);
    for (path, _) in files {
        let place = folder.join(path);
        if !earlier.contains(*path) && place.symlink_metadata().is_ok() {
            return Err(Failure::usage(
                format!(
                    "`{}` exists and is not of an earlier run of this command",
                    output::path(&place)
                ),
                "move it away, or choose another folder with --out",
            )
            .coded(ErrorCode::Exists));
        }
    }
    let now: BTreeSet<String> = files.iter().map(|(path, _)| (*path).to_owned()).collect();
    make(folder)?;
    // first, so that a run that is killed leaves nothing without a line
    put_list(folder, earlier.union(&now).cloned().collect())?;
    for (path, bytes) in files {
        let place = folder.join(path);
        if let Some(parent) = place.parent() {
            make(parent)?;
        }
        output::write_private_file(&place, bytes, HELP)?;
    }
    for stale in earlier.difference(&now) {
        remove(folder, stale)?;
    }
    put_list(folder, now)
}

fn make(folder: &Path) -> Result<(), Failure> {
    private_folder(folder).map_err(|error| output::unwritten(folder, &error, HELP))
}

/// What an earlier run listed; nothing where there is no list of this version.
fn earlier(folder: &Path) -> BTreeSet<String> {
    let bytes = disk::bytes_of(&folder.join(LIST_FILE), MOST_BYTES).ok();
    let list = bytes.and_then(|bytes| serde_json::from_slice::<List>(&bytes).ok());
    let is_inside = |path: &String| {
        let mut parts = Path::new(path).components();
        parts.all(|part| matches!(part, Component::Normal(_)))
    };
    let list = list.filter(|list| list.format == FORMAT);
    list.map_or_else(BTreeSet::new, |list| {
        list.files.into_iter().filter(is_inside).collect()
    })
}

fn put_list(folder: &Path, files: BTreeSet<String>) -> Result<(), Failure> {
    let format = FORMAT.to_owned();
    let list = output::json(&List { format, files })?;
    output::write_private_file(&folder.join(LIST_FILE), list.as_bytes(), HELP)
}

/// Removes a file, and the folders around it that are empty then.
fn remove(folder: &Path, path: &str) -> Result<(), Failure> {
    let place = folder.join(path);
    match std::fs::remove_file(&place) {
        Ok(()) => {}
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
        Err(error) => {
            return Err(Failure::fault(
                format!(
                    "`{}` is of an earlier run and cannot be removed: {}",
                    output::path(&place),
                    plain(&error)
                ),
                "delete it, so that nobody uploads it",
            ));
        }
    }
    let mut around = Path::new(path).parent();
    while let Some(inside) = around.filter(|inside| !inside.as_os_str().is_empty()) {
        // one that is not empty stays
        if std::fs::remove_dir(folder.join(inside)).is_err() {
            break;
        }
        around = inside.parent();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for entry in std::fs::read_dir(folder).unwrap() {
            names.push(entry.unwrap().file_name().into_string().unwrap());
        }
        names.sort();
        names
    }

    #[test]
    fn what_an_earlier_run_wrote_goes_and_everything_else_stays() {
        let bed = tempfile::tempdir().unwrap();
        let out = bed.path().join("a/out");
        write(
            &out,
            &[("s1/x.txt", b"1"), ("s2/x.txt", b"2"), ("g.csv", b"3")],
        )
        .unwrap();
        std::fs::write(out.join("s2/mine.txt"), "mine").unwrap();
        write(&out, &[("g.csv", b"4")]).unwrap();
        assert_eq!(names(&out), [LIST_FILE, "g.csv", "s2"]);
        assert_eq!(names(&out.join("s2")), ["mine.txt"]);
        assert_eq!(std::fs::read(out.join("g.csv")).unwrap(), b"4");
        // what is not ours is not replaced, and then nothing is
        std::fs::write(out.join("h.csv"), "mine").unwrap();
        assert!(write(&out, &[("g.csv", b"5"), ("h.csv", b"5")]).is_err());
        assert_eq!(std::fs::read(out.join("g.csv")).unwrap(), b"4");
    }

    #[test]
    fn a_list_leads_nowhere_else() {
        let bed = tempfile::tempdir().unwrap();
        let out = bed.path().join("out");
        write(&out, &[("g.csv", b"1")]).unwrap();
        std::fs::write(bed.path().join("mine.txt"), "mine").unwrap();
        let files = ["../mine.txt".to_owned()].into();
        put_list(&out, files).unwrap();
        write(&out, &[]).unwrap();
        assert!(bed.path().join("mine.txt").is_file());
    }

    #[cfg(unix)]
    #[test]
    fn its_owner_alone_can_read_it() {
        use std::os::unix::fs::PermissionsExt as _;
        let bed = tempfile::tempdir().unwrap();
        let out = bed.path().join("release/lab");
        write(&out, &[("s1/x.txt", b"1")]).unwrap();
        for (path, mode) in [
            ("release", 0o700),
            ("release/lab", 0o700),
            ("release/lab/s1", 0o700),
            ("release/lab/s1/x.txt", 0o600),
            ("release/lab/.kinemark-files.json", 0o600),
        ] {
            let found = bed.path().join(path).metadata().unwrap().permissions();
            assert_eq!(found.mode() & 0o777, mode, "{path}");
        }
    }
}
