//! A name as an archive or a disk has it, made a path inside the source; or what is wrong with it.

use unicode_normalization::UnicodeNormalization as _;

use super::problem::EntryProblem;

/// Folders and files that systems leave behind: they hold nothing of a student's, and nobody looks into them.
const LITTER: [&str; 5] = [
    "__macosx",
    ".ds_store",
    "thumbs.db",
    "desktop.ini",
    GIT_FOLDER,
];

/// What makes a folder a repository.
pub(super) const GIT_FOLDER: &str = ".git";

/// Where an entry is.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Its path inside the source: `/` between names, no empty name, no `.` and no `..`, Unicode's normal form C.
    Path(String),
    /// Inside something that is never looked into, in this folder.
    Litter {
        /// The folder that has it; empty at the top.
        folder: String,
        /// Whether it is a repository's own folder.
        git: bool,
    },
}

/// Whether nobody looks into what has this name.
pub(super) fn is_litter(name: &str) -> bool {
    name.starts_with("._") || LITTER.contains(&name.to_ascii_lowercase().as_str())
}

/// The place that `raw` names. A backslash separates names as `/` does: archives made on Windows are written so.
///
/// # Errors
/// A name that leads elsewhere or cannot be shown.
pub(super) fn place(raw: &str, most_bytes: usize) -> Result<Place, EntryProblem> {
    if raw.len() > most_bytes {
        return Err(EntryProblem::LongName {
            bytes: raw.len(),
            most: most_bytes,
        });
    }
    if let Some(sign) = raw.chars().find(|sign| sign.is_control()) {
        return Err(EntryProblem::ControlCharacter {
            number: u32::from(sign),
        });
    }
    let is_separator = |sign: char| matches!(sign, '/' | '\\');
    if raw.starts_with(is_separator) || has_drive(raw) {
        return Err(EntryProblem::Absolute);
    }
    let mut path = String::with_capacity(raw.len());
    for name in raw.split(is_separator) {
        match name {
            "" | "." => continue,
            ".." => return Err(EntryProblem::Outside),
            _ if is_litter(name) => {
                let git = name.eq_ignore_ascii_case(GIT_FOLDER);
                return Ok(Place::Litter { folder: path, git });
            }
            _ => {}
        }
        if !path.is_empty() {
            path.push('/');
        }
        path.extend(name.nfc());
    }
    if path.is_empty() {
        return Err(EntryProblem::NoName);
    }
    Ok(Place::Path(path))
}

/// Whether a name begins with a drive of Windows, such as `C:`.
fn has_drive(raw: &str) -> bool {
    let bytes = raw.as_bytes();
    bytes.len() > 1 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(raw: &str) -> String {
        match place(raw, 1_000) {
            Ok(Place::Path(path)) => path,
            other => panic!("{raw}: {other:?}"),
        }
    }

    #[test]
    fn a_name_has_one_spelling() {
        assert_eq!(path("a/b.rhai"), "a/b.rhai");
        assert_eq!(path("./a//b.rhai"), "a/b.rhai");
        assert_eq!(path("work\\out\\x"), "work/out/x");
        assert_eq!(path("Rene\u{301}e"), "Ren\u{e9}e");
        assert_eq!(path("a..b/...c"), "a..b/...c");
    }

    #[test]
    fn a_name_that_leads_elsewhere_is_refused() {
        for raw in ["/etc/passwd", "\\\\server\\x", "C:\\x", "c:x"] {
            assert_eq!(place(raw, 1_000), Err(EntryProblem::Absolute), "{raw}");
        }
        for raw in ["../x", "a/../b", "a\\..\\..\\x", ".."] {
            assert_eq!(place(raw, 1_000), Err(EntryProblem::Outside), "{raw}");
        }
        for raw in ["", ".", "./"] {
            assert_eq!(place(raw, 1_000), Err(EntryProblem::NoName), "{raw}");
        }
        let bell = EntryProblem::ControlCharacter { number: 7 };
        assert_eq!(place("a\u{7}b", 1_000), Err(bell));
        assert!(matches!(
            place(&"x".repeat(1_001), 1_000),
            Err(EntryProblem::LongName {
                bytes: 1_001,
                most: 1_000
            })
        ));
    }

    #[test]
    fn what_systems_leave_behind_is_not_looked_into() {
        for raw in [
            "__MACOSX/a/._x",
            "a/.DS_Store",
            "a/._submission.rhai",
            "Thumbs.db",
        ] {
            assert!(
                matches!(place(raw, 1_000), Ok(Place::Litter { git: false, .. })),
                "{raw}"
            );
        }
        let git = Place::Litter {
            folder: "lab1-ana".to_owned(),
            git: true,
        };
        assert_eq!(place("lab1-ana/.git/HEAD", 1_000), Ok(git));
        assert_eq!(path(".gitignore"), ".gitignore");
    }
}
