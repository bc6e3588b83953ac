//! Committed files that are made by the code: tests compare with them, and `KINEMARK_BLESS=1` writes those that differ.
//!
//! A test that wrote a file fails and says which, so that a run with `KINEMARK_BLESS` set never passes for a check.

use std::path::{Path, PathBuf};

use crate::testbed::root;

/// Whether files that differ are written.
pub(crate) fn is_blessing() -> bool {
    std::env::var_os("KINEMARK_BLESS").is_some()
}

/// Every file has the text beside it.
#[track_caller]
pub(crate) fn are_current(files: &[(PathBuf, String)]) {
    let mut differing = Vec::new();
    for (path, fresh) in files {
        let there = std::fs::read_to_string(path).unwrap_or_default();
        if there != *fresh {
            if is_blessing() {
                std::fs::write(path, fresh).expect("written");
            }
            differing.push(format!(
                "{}{}",
                path.display(),
                first_difference(&there, fresh)
            ));
        }
    }
    let what = if is_blessing() {
        "written anew; run the tests again without KINEMARK_BLESS"
    } else {
        "not what the code gives; if the code is right, KINEMARK_BLESS=1 cargo test writes them"
    };
    assert!(differing.is_empty(), "{what}:\n{}", differing.join("\n"));
}

/// A file of the checkout has this text.
#[track_caller]
pub(crate) fn is_current(path: impl AsRef<Path>, fresh: impl Into<String>) {
    are_current(&[(root().join(path), fresh.into())]);
}

/// A text for people reads as it was read last, in `tests/golden/text/NAME.txt`.
#[track_caller]
pub(crate) fn reads(name: &str, fresh: &str) {
    is_current(format!("tests/golden/text/{name}.txt"), fresh);
}

/// The first line that differs, committed and fresh, shortened: files may be one long line.
fn first_difference(there: &str, fresh: &str) -> String {
    let mut number = 0;
    let (mut old, mut new) = (there.lines(), fresh.lines());
    loop {
        number += 1;
        match (old.next(), new.next()) {
            (None, None) => return " (line ends)".to_owned(),
            (old, new) if old == new => {}
            (old, new) => {
                let shown = |line: Option<&str>| {
                    line.map_or("nothing".to_owned(), |line| {
                        line.chars().take(200).collect()
                    })
                };
                return format!(
                    ":{number}\n  committed: {}\n  now:       {}",
                    shown(old),
                    shown(new)
                );
            }
        }
    }
}
