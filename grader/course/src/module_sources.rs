//! The sources beside a compiled module: kept so that a person can read what was graded, and never run. What counts, how much is kept,
//! and under which names.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use kinemark_grader::lab::variant::VARIANT_FILE;

use crate::device_name::is_device;
use crate::language::{CARGO_OUTPUT, CARGO_TARGET, MODULE_FILE};
use crate::plugin_project::is_ours;
use crate::student::folded;

/// The files that are kept at most.
pub const MOST_FILES: usize = 100;
/// The bytes that are kept at most.
pub const MOST_BYTES: u64 = 1 << 20;
/// A larger file is no source that anybody wrote \[bytes\].
pub const MOST_FILE_BYTES: u64 = 256 << 10;
/// Files that are looked into at most: among them may be many that are no text.
const MOST_LOOKS: usize = 400;
/// Folders inside each other that are looked into.
const MOST_LEVELS: usize = 8;
/// The characters of a name of a file or folder that are kept.
const MOST_CHARACTERS: usize = 80;
/// The bytes of a character that is written out, at most.
const LONGEST_SIGN: usize = 8;
/// Names that are listed where files are left out.
const MOST_LISTED: usize = 20;

/// The name of the list of what was not kept.
const NOT_KEPT: &str = "not-kept.txt";

/// Folders that hold what programs wrote.
const GENERATED: [&str; 7] = [
    CARGO_TARGET,
    "out",
    "node_modules",
    "zig-out",
    "zig-cache",
    "build",
    "__pycache__",
];

/// Files of a student's folder that are no sources, whatever is in them.
const NO_SOURCES: [&str; 6] = [
    "kinemark.toml",
    VARIANT_FILE,
    "brief.md",
    "brief.html",
    "Cargo.lock",
    "compile_flags.txt",
];

/// How names end of what is kept beside a program, and is none itself.
const NO_PROGRAMS: [&str; 10] = [
    "md", "txt", "toml", "json", "lock", "yml", "yaml", "csv", "html", "svg",
];

/// A source of a module, as it is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Its path below the folder of the module, in letters that every disk takes; `/` between names.
    pub path: String,
    /// Its text.
    pub bytes: Vec<u8>,
}

/// The folder of the project that the module at `path` belongs to, with a `/` at its end; empty at the top.
pub fn project_folder(path: &str) -> &str {
    let folder = match path.rfind('/') {
        Some(at) => &path[..=at],
        None => "",
    };
    // cargo leaves it further down
    let above = folder.strip_suffix(&format!("{CARGO_OUTPUT}/") as &str);
    match above {
        Some(above) if above.is_empty() || above.ends_with('/') => above,
        _ => folder,
    }
}

/// The sources among the files of a project, by their paths in its folder; `read` gives the bytes of a file, at most so many, and nothing
/// where it cannot be read. Without a program among them there are none.
pub fn sources<F>(
    files: impl IntoIterator<Item = (String, F)>,
    mut read: impl FnMut(&F, u64) -> Option<Vec<u8>>,
) -> Vec<SourceFile> {
    let files = files.into_iter();
    let mut files: Vec<(String, F)> = files.filter(|(path, _)| may_be_source(path)).collect();
    // what is near the top is what a person looks for first
    files.sort_by(|(one, _), (other, _)| {
        let order = |path: &str| (path.matches('/').count(), path.to_owned());
        order(one).cmp(&order(other))
    });
    let mut kept = Kept::default();
    for (looks, (path, file)) in files.iter().enumerate() {
        if looks >= MOST_LOOKS {
            kept.left_out.push(path);
            continue;
        }
        match read(file, MOST_FILE_BYTES) {
            Some(bytes) if !is_text(&bytes) || is_ours(path, &bytes) => {}
            Some(bytes) => kept.add(path, bytes),
            None => kept.left_out.push(path),
        }
    }
    kept.finished()
}

/// What is kept so far.
#[derive(Default)]
struct Kept<'p> {
    files: Vec<SourceFile>,
    names: BTreeSet<String>,
    bytes: u64,
    has_program: bool,
    left_out: Vec<&'p str>,
}

impl<'p> Kept<'p> {
    fn add(&mut self, path: &'p str, bytes: Vec<u8>) {
        let size = bytes.len() as u64;
        if self.files.len() >= MOST_FILES || self.bytes + size > MOST_BYTES {
            self.left_out.push(path);
            return;
        }
        self.bytes += size;
        self.has_program |= is_program(path);
        let path = self.unused(plain_path(path));
        self.files.push(SourceFile { path, bytes });
    }

    /// The name, or one like it where a disk that does not distinguish case has it already.
    fn unused(&mut self, path: String) -> String {
        let mut name = path.clone();
        let mut number = 2;
        while !self.names.insert(folded(&name)) {
            name = format!("{path}-{number}");
            number += 1;
        }
        name
    }

    fn finished(mut self) -> Vec<SourceFile> {
        if !self.has_program {
            return Vec::new();
        }
        if !self.left_out.is_empty() {
            let mut text = format!(
                "{} more files were not kept: at most {MOST_FILES} files of {} KiB together and {} KiB each are.\n",
                self.left_out.len(),
                MOST_BYTES >> 10,
                MOST_FILE_BYTES >> 10
            );
            for path in self.left_out.iter().take(MOST_LISTED) {
                // into a string: nothing can fail
                let _ = writeln!(text, "{}", plain_path(path));
            }
            let path = self.unused(NOT_KEPT.to_owned());
            let bytes = text.into_bytes();
            self.files.push(SourceFile { path, bytes });
        }
        self.files
    }
}

/// Whether a path is one under which a source may be kept: what [`sources`] gives, and nothing that leads elsewhere.
pub fn is_kept_path(path: &str) -> bool {
    let is_plain = |name: &str| {
        let is_known = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '+' | '~' | '.');
        let longest = MOST_CHARACTERS * LONGEST_SIGN;
        !name.is_empty()
            && name.len() <= longest
            && name.chars().all(is_known)
            && !name.starts_with('.')
            && !name.ends_with('.')
            && !is_device(name.split('.').next().unwrap_or_default())
    };
    path.matches('/').count() <= MOST_LEVELS && path.split('/').all(is_plain)
}

/// Whether a file may be a part of a program, by its path: a source, or what says how it is built.
pub fn may_be_program(path: &str) -> bool {
    let ends_so = |ending: &str| path.ends_with(ending);
    may_be_source(path) && !["md", "txt", "html"].into_iter().any(ends_so)
}

/// Whether a file may be a source, by its path.
fn may_be_source(path: &str) -> bool {
    let mut parts: Vec<&str> = path.split('/').collect();
    let name = parts.pop().unwrap_or_default();
    let is_hidden = |name: &str| name.starts_with('.');
    let is_looked_into = |folder: &&str| {
        let is_generated = GENERATED.contains(folder);
        !is_generated && (!is_hidden(folder) || *folder == ".cargo")
    };
    parts.len() <= MOST_LEVELS
        && parts.iter().all(is_looked_into)
        && !is_hidden(name)
        && !NO_SOURCES.contains(&name)
        && name != MODULE_FILE
        && !name.ends_with(".svg")
        && !name.ends_with(".kinemark")
}

/// Whether a file may be a program: by its name it is nothing that only stands beside one.
fn is_program(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    let ending = name
        .rsplit_once('.')
        .map(|(_, ending)| ending.to_ascii_lowercase());
    ending.is_some_and(|ending| !NO_PROGRAMS.contains(&ending.as_str()))
}

fn is_text(bytes: &[u8]) -> bool {
    !bytes.is_empty() && !bytes.contains(&0) && std::str::from_utf8(bytes).is_ok()
}

/// A path in letters that every disk takes and no terminal obeys.
fn plain_path(path: &str) -> String {
    let names: Vec<String> = path.split('/').map(plain_name).collect();
    names.join("/")
}

fn plain_name(name: &str) -> String {
    let last = name.chars().count().saturating_sub(1);
    let mut plain = String::new();
    for (at, c) in name.chars().enumerate().take(MOST_CHARACTERS) {
        let is_dot_inside = c == '.' && at > 0 && at < last;
        if c.is_alphanumeric() || matches!(c, '-' | '_' | '+') || is_dot_inside {
            plain.push(c);
        } else {
            // into a string: nothing can fail
            let _ = write!(plain, "~{:x}~", u32::from(c));
        }
    }
    let stem = plain.split('.').next().unwrap_or_default();
    if is_device(stem) {
        plain.insert(0, '~');
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(files: &[(&str, &[u8])]) -> Vec<String> {
        let files = files
            .iter()
            .map(|(path, bytes)| ((*path).to_owned(), *bytes));
        let kept = sources(files, |bytes, most| {
            (bytes.len() as u64 <= most).then(|| bytes.to_vec())
        });
        kept.into_iter().map(|file| file.path).collect()
    }

    #[test]
    fn what_a_person_wrote_is_kept_and_what_programs_wrote_is_not() {
        let files: &[(&str, &[u8])] = &[
            ("src/arm/ik.rs", b"fn ik() {}"),
            ("src/lib.rs", b"mod arm;"),
            ("Cargo.toml", b"[package]"),
            (".cargo/config.toml", b"[build]"),
            (".env", b"SECRET=1"),
            (".vscode/tasks.json", b"{}"),
            ("submission.wasm", b"\0asm"),
            ("target/debug/x.rs", b"generated"),
            ("out/lab/01/starter.rs", b"ours"),
            ("picture.png", b"\x89PNG\0"),
            ("latin.c", b"\xff"),
            ("brief.html", b"<html>"),
            ("Makefile", b"all:"),
        ];
        assert_eq!(
            kept(files),
            [
                "Cargo.toml",
                "Makefile",
                "~2e~cargo/config.toml",
                "src/lib.rs",
                "src/arm/ik.rs"
            ]
        );
    }

    #[test]
    fn notes_alone_are_no_sources() {
        assert!(kept(&[("README.md", b"my arm"), ("Cargo.toml", b"[package]")]).is_empty());
        assert_eq!(
            kept(&[("README.md", b"my arm"), ("a.zig", b"x")]),
            ["README.md", "a.zig"]
        );
        let header = include_bytes!("../../plugin/c/kinemark.h");
        assert!(kept(&[("kinemark.h", header)]).is_empty());
    }

    #[test]
    fn names_are_such_that_every_disk_takes_them() {
        let files: &[(&str, &[u8])] = &[
            ("a\u{202e}b.c", b"1"),
            ("A.c", b"2"),
            ("a.c", b"3"),
            ("con.c", b"4"),
            ("Übung 1/x?.c", b"5"),
            ("x/..", b"6"),
        ];
        assert_eq!(
            kept(files),
            ["A.c", "a.c-2", "a~202e~b.c", "~con.c", "Übung~20~1/x~3f~.c"]
        );
    }

    #[test]
    fn a_path_that_leads_elsewhere_is_none_of_a_source() {
        for path in [
            "a.c",
            "src/lib.rs",
            "~2e~cargo/config.toml",
            "a~202e~b.c-2",
            "Übung~20~1/x.c",
        ] {
            assert!(is_kept_path(path), "{path}");
        }
        for path in [
            "",
            "/a",
            "a//b",
            "../a",
            "a/..",
            ".env",
            "a\\b",
            "a:b",
            "con.c",
            "a\u{202e}",
            "a b",
            "1/2/3/4/5/6/7/8/9/a.c",
        ] {
            assert!(!is_kept_path(path), "{path}");
        }
    }

    #[test]
    fn so_much_is_kept_and_the_rest_is_named() {
        let large = vec![b'x'; MOST_FILE_BYTES as usize + 1];
        let names: Vec<String> = (0..MOST_FILES + 2).map(|i| format!("d/{i:03}.c")).collect();
        let mut files: Vec<(&str, &[u8])> = names
            .iter()
            .map(|name| (name.as_str(), &b"x"[..]))
            .collect();
        files.push(("large.c", &large));
        let kept = kept(&files);
        assert_eq!(kept.len(), MOST_FILES + 1);
        assert_eq!(kept.last().map(String::as_str), Some(NOT_KEPT));
        let parts = [b'y'; MOST_FILE_BYTES as usize];
        let names = ["1.c", "2.c", "3.c", "4.c", "5.c"];
        let files: Vec<(&str, &[u8])> = names.iter().map(|name| (*name, &parts[..])).collect();
        assert_eq!(
            super::tests::kept(&files),
            ["1.c", "2.c", "3.c", "4.c", NOT_KEPT]
        );
    }

    #[test]
    fn a_module_of_cargo_belongs_to_the_project_above() {
        for (path, folder) in [
            ("submission.wasm", ""),
            ("a/b/submission.wasm", "a/b/"),
            ("target/wasm32-unknown-unknown/release/x.wasm", ""),
            (
                "a.zip/r/target/wasm32-unknown-unknown/release/x.wasm",
                "a.zip/r/",
            ),
            (
                "mytarget/wasm32-unknown-unknown/release/x.wasm",
                "mytarget/wasm32-unknown-unknown/release/",
            ),
        ] {
            assert_eq!(project_folder(path), folder, "{path}");
        }
    }
}
