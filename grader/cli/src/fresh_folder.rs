//! A folder that is written under another name beside its place and then renamed, so that it is whole or not there; what was there
//! before goes with it.

use std::path::{Path, PathBuf};

use kinemark_grader::report::visible::visible;
use tempfile::TempDir;

use crate::failure::Failure;

/// A folder being written.
#[derive(Debug)]
pub(crate) struct FreshFolder {
    /// Removed when dropped, whatever happens.
    temporary: TempDir,
    out: PathBuf,
}

impl FreshFolder {
    /// Starts a folder that is to be `out`.
    pub(crate) fn beside(out: &Path) -> std::io::Result<Self> {
        let parent = match out.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        std::fs::create_dir_all(parent)?;
        let temporary = tempfile::Builder::new()
            .prefix(".kinemark-")
            .tempdir_in(parent)?;
        let fresh = Self {
            temporary,
            out: out.to_owned(),
        };
        std::fs::create_dir(fresh.path())?;
        Ok(fresh)
    }

    /// Where to write.
    pub(crate) fn path(&self) -> PathBuf {
        self.temporary.path().join("new")
    }

    /// Puts it in its place.
    pub(crate) fn put_in_place(self) -> std::io::Result<()> {
        let old = self.temporary.path().join("old");
        if self.out.exists() {
            std::fs::rename(&self.out, &old)?;
        }
        std::fs::rename(self.path(), &self.out).inspect_err(|_| {
            // put the earlier one back; what went wrong is told either way
            let _ = std::fs::rename(&old, &self.out);
        })
    }
}

/// Checks that `out` is free, empty, or holds nothing but what is `ours`, `whole` in words: replacing it would lose the rest.
pub(crate) fn refuse_foreign(
    out: &Path,
    whole: &str,
    ours: impl Fn(&str) -> bool,
) -> Result<(), Failure> {
    let help = "choose another folder with --out";
    // a file, a device, a pipe, a link to nowhere: whatever is there and no folder stays as it is
    if out.symlink_metadata().is_ok() && !out.is_dir() {
        return Err(Failure::usage(
            format!("`{}` is there and is not a folder", out.display()),
            help,
        ));
    }
    let entries = std::fs::read_dir(out).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    match names.into_iter().find(|name| !ours(name)) {
        None => Ok(()),
        Some(name) => Err(Failure::usage(
            format!(
                "`{}` holds `{}`, which is no part of {whole}",
                out.display(),
                visible(&name)
            ),
            help,
        )),
    }
}
