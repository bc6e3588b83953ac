//! Names the commit and the target of a build, for `kinemark version`. Neither is part of a grade, which names the digest of the
//! engine's sources.

use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if let Ok(target) = std::env::var("TARGET") {
        println!("cargo::rustc-env=KINEMARK_TARGET={target}");
    }
    if let Some(commit) = commit() {
        println!("cargo::rustc-env=KINEMARK_COMMIT={commit}");
    }
}

/// The commit of this checkout; none outside of one, without git, and in another project's.
fn commit() -> Option<String> {
    let here = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR")?);
    let house = here.parent()?.parent()?.canonicalize().ok()?;
    let root = PathBuf::from(git(&house, &["rev-parse", "--show-toplevel"])?);
    if root.canonicalize().ok()? != house {
        return None;
    }
    // both change with what is checked out, and the second with each commit
    for name in ["HEAD", "logs/HEAD"] {
        let path = house.join(git(&house, &["rev-parse", "--git-path", name])?);
        // a file that is not there would be a change in every build
        if path.is_file() {
            println!("cargo::rerun-if-changed={}", path.display());
        }
    }
    git(&house, &["rev-parse", "--short=12", "HEAD"])
}

fn git(folder: &Path, args: &[&str]) -> Option<String> {
    let ran = Command::new("git").current_dir(folder).args(args).output();
    let ran = ran.ok().filter(|ran| ran.status.success())?;
    let text = String::from_utf8(ran.stdout).ok()?;
    let line = text.trim().to_owned();
    (!line.is_empty()).then_some(line)
}
