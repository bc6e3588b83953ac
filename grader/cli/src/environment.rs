//! Folders that the environment names where the command line does not: `KINEMARK_LABS` for `--labs`, `KINEMARK_REFERENCE` for
//! `--reference`. They are defaults, so that `--practice` leaves the second one out.

use std::ffi::{OsStr, OsString};
use std::sync::LazyLock;

use clap::builder;

static LABS: LazyLock<Option<OsString>> = LazyLock::new(|| folder("KINEMARK_LABS"));
static REFERENCE: LazyLock<Option<OsString>> = LazyLock::new(|| folder("KINEMARK_REFERENCE"));

/// The folder of labs.
pub(crate) fn labs() -> builder::Resettable<builder::OsStr> {
    default(LABS.as_deref())
}

/// The folder of the course staff's part.
pub(crate) fn reference() -> builder::Resettable<builder::OsStr> {
    default(REFERENCE.as_deref())
}

fn default(folder: Option<&'static OsStr>) -> builder::Resettable<builder::OsStr> {
    folder.map(builder::OsStr::from).into()
}

/// A variable that is empty is one that is not set.
fn folder(variable: &str) -> Option<OsString> {
    std::env::var_os(variable).filter(|folder| !folder.is_empty())
}
