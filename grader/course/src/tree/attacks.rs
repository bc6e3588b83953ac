//! What people with bad intentions, and bad luck, put into archives and folders: one test each.

use std::io::{Cursor, Write as _};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::sample::{folder, zip};
use super::{Entry, EntryProblem, Limits, Tree};

const MOST: u64 = 1 << 20;

fn opened(bytes: Vec<u8>) -> Tree {
    Tree::of_zip(bytes, &Limits::default()).unwrap()
}

fn entry<'t>(tree: &'t Tree, path: &str) -> &'t Entry {
    let found = tree.entries().iter().find(|entry| entry.path == path);
    found.unwrap_or_else(|| panic!("no {path} in {:?}", tree.entries()))
}

/// `bytes` with `from` replaced by `to`, of the same length, wherever it is.
fn replaced(mut bytes: Vec<u8>, from: &[u8], to: &[u8]) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let mut found = 0;
    for at in 0..bytes.len().saturating_sub(from.len() - 1) {
        if bytes[at..].starts_with(from) {
            bytes[at..at + to.len()].copy_from_slice(to);
            found += 1;
        }
    }
    assert!(found > 0);
    bytes
}

/// Writes `value` at `offset` of the first header of the archive's directory.
fn patched(mut bytes: Vec<u8>, offset: usize, value: &[u8]) -> Vec<u8> {
    let header = b"PK\x01\x02";
    let at = bytes
        .windows(4)
        .position(|window| window == header)
        .unwrap();
    bytes[at + offset..at + offset + value.len()].copy_from_slice(value);
    bytes
}

/// Where a header of the directory has its fields.
const FLAGS: usize = 8;
const METHOD: usize = 10;
const SIZE: usize = 24;
const ATTRIBUTES: usize = 38;

fn problem(tree: &Tree, path: &str) -> EntryProblem {
    let entry = entry(tree, path);
    tree.bytes(entry, MOST).unwrap_err()
}

#[test]
fn a_bomb_ends_at_the_limit() {
    let bomb = zip(&[("bomb", vec![0; 64 << 20]), ("a.rhai", b"a".to_vec())]);
    assert!(bomb.len() < 1 << 20);
    let tree = opened(bomb);
    assert_eq!(
        problem(&tree, "bomb"),
        EntryProblem::TooLarge { most: MOST }
    );
    assert_eq!(tree.bytes(entry(&tree, "a.rhai"), MOST).unwrap(), b"a");
}

#[test]
fn a_bomb_that_lies_about_its_size_is_damaged() {
    let bomb = zip(&[("bomb", vec![0; 8 << 20])]);
    let tree = opened(patched(bomb.clone(), SIZE, &100_u32.to_le_bytes()));
    assert_eq!(entry(&tree, "bomb").declared_size, Some(100));
    let problem = problem(&tree, "bomb");
    assert!(matches!(problem, EntryProblem::Damaged { .. }), "{problem}");
}

#[test]
fn a_size_that_is_too_large_reserves_nothing() {
    let small = zip(&[("a.rhai", b"let a = 1;")]);
    let tree = opened(patched(small, SIZE, &0xfff0_0000_u32.to_le_bytes()));
    // whatever it is taken for, it takes no memory
    if let Ok(bytes) = tree.bytes(entry(&tree, "a.rhai"), MOST) {
        assert_eq!(bytes, b"let a = 1;");
    }
}

#[test]
fn the_whole_source_has_a_share_that_archives_inside_take_from() {
    let inner = zip(&[("x", vec![1; 600]), ("y", vec![2; 600])]);
    let share = inner.len() as u64 + 900;
    let outer = zip(&[("inner.zip", inner)]);
    let limits = Limits {
        total_bytes: share,
        ..Limits::default()
    };
    let tree = Tree::of_zip(outer, &limits).unwrap();
    let inner = tree.nested(&tree.entries()[0], 10).unwrap();
    let read = |path: &str| inner.bytes(entry(&inner, path), MOST);
    assert_eq!(read("x").unwrap().len(), 600);
    assert_eq!(read("y"), Err(EntryProblem::Budget { most: share }));
    assert!(tree.bytes(&tree.entries()[0], MOST).is_err());
}

#[test]
fn links_are_never_followed() {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    writer
        .add_symlink("submission.rhai", "/etc/passwd", options)
        .unwrap();
    // a link to a folder, and a file that would come to lie in it
    writer.add_symlink("s9", "/etc", options).unwrap();
    writer.start_file("s9/passwd", options).unwrap();
    writer.write_all(b"own").unwrap();
    let tree = opened(writer.finish().unwrap().into_inner());
    assert_eq!(problem(&tree, "submission.rhai"), EntryProblem::Link);
    assert_eq!(problem(&tree, "s9"), EntryProblem::Link);
    assert_eq!(tree.bytes(entry(&tree, "s9/passwd"), MOST).unwrap(), b"own");
}

/// What is put in the place of a file after it was listed.
#[cfg(unix)]
#[test]
fn a_link_or_a_pipe_that_takes_the_place_of_a_file_is_not_read() {
    let bed = folder(&[("a.rhai", "a"), ("b.rhai", "b")]);
    let secret = folder(&[("secret", "c")]);
    let tree = Tree::open(bed.path(), &Limits::default()).unwrap();
    let place = |name: &str| bed.path().join(name);
    for name in ["a.rhai", "b.rhai"] {
        std::fs::remove_file(place(name)).unwrap();
    }
    std::os::unix::fs::symlink(secret.path().join("secret"), place("a.rhai")).unwrap();
    let made = std::process::Command::new("mkfifo")
        .arg(place("b.rhai"))
        .status();
    assert!(made.unwrap().success());
    for name in ["a.rhai", "b.rhai"] {
        let read = tree.bytes(entry(&tree, name), MOST);
        assert!(
            matches!(read, Err(EntryProblem::Unreadable { .. })),
            "{name}: {read:?}"
        );
    }
    assert!(Tree::open(&place("b.rhai"), &Limits::default()).is_err());
}

#[cfg(unix)]
#[test]
fn links_and_sockets_of_a_disk_are_not_read() {
    let bed = folder(&[("s1/submission.rhai", "a")]);
    let secret = folder(&[("secret.rhai", "b")]);
    let link = |to: &std::path::Path, name: &str| {
        std::os::unix::fs::symlink(to, bed.path().join(name)).unwrap();
    };
    link(&secret.path().join("secret.rhai"), "file.rhai");
    link(secret.path(), "folder");
    link(bed.path(), "s1/loop");
    link(std::path::Path::new("nowhere"), "broken");
    let _socket = std::os::unix::net::UnixListener::bind(bed.path().join("socket")).unwrap();
    let tree = Tree::open(bed.path(), &Limits::default()).unwrap();
    for path in ["file.rhai", "folder", "s1/loop", "broken"] {
        assert_eq!(problem(&tree, path), EntryProblem::Link, "{path}");
    }
    assert_eq!(problem(&tree, "socket"), EntryProblem::Special);
    let own = entry(&tree, "s1/submission.rhai");
    assert_eq!(tree.bytes(own, MOST).unwrap(), b"a");
    assert_eq!(tree.entries().len(), 6);
}

#[test]
fn a_pipe_in_an_archive_is_no_file() {
    let unix = patched(zip(&[("a.rhai", "a")]), 5, &[3]);
    let tree = opened(patched(
        unix,
        ATTRIBUTES,
        &(0o010_644_u32 << 16).to_le_bytes(),
    ));
    assert_eq!(problem(&tree, "a.rhai"), EntryProblem::Special);
}

#[test]
fn names_that_lead_out_have_no_place() {
    let names = ["../../x", "/etc/xx", "C:\\x\\yy", "a/../xx", "..\\..\\x"];
    for name in names {
        let placeholder = &"abcdefgh"[..name.len()];
        let bytes = zip(&[(placeholder, "a"), ("ok.rhai", "b")]);
        let tree = opened(replaced(bytes, placeholder.as_bytes(), name.as_bytes()));
        assert_eq!(tree.misnamed().len(), 1, "{name}");
        assert_eq!(tree.misnamed()[0].original, name);
        assert!(matches!(
            tree.misnamed()[0].problem,
            EntryProblem::Outside | EntryProblem::Absolute
        ));
        let paths: Vec<&str> = tree.entries().iter().map(|e| e.path.as_str()).collect();
        assert_eq!(paths, ["ok.rhai"], "{name}");
    }
}

#[test]
fn names_that_cannot_be_shown_have_no_place() {
    let long = "n".repeat(1_001);
    let bytes = zip(&[("a#b.rhai", "a"), (&long, "b")]);
    let tree = opened(replaced(bytes, b"a#b.rhai", b"a\x07b.rhai"));
    let problems: Vec<&EntryProblem> = tree.misnamed().iter().map(|m| &m.problem).collect();
    assert!(matches!(
        problems.as_slice(),
        [
            EntryProblem::ControlCharacter { number: 7 },
            EntryProblem::LongName { .. }
        ]
    ));
}

#[test]
fn of_two_files_with_one_name_neither_is_taken() {
    let bytes = zip(&[("aa.rhai", "good"), ("ab.rhai", "bad"), ("c", "c")]);
    let tree = opened(replaced(bytes, b"ab.rhai", b"aa.rhai"));
    assert_eq!(tree.entries().len(), 3);
    for entry in &tree.entries()[..2] {
        assert_eq!(entry.path, "aa.rhai");
        assert_eq!(entry.problem, Some(EntryProblem::Duplicate));
    }
    assert_eq!(tree.entries()[2].problem, None);
    // a name as a file and as a folder
    let tree = opened(zip(&[("a", "x"), ("a/b", "y")]));
    assert_eq!(problem(&tree, "a"), EntryProblem::Duplicate);
}

#[test]
fn of_two_names_that_look_alike_neither_is_taken() {
    for (one, other) in [
        ("submission.rhai", "Submission.rhai"),
        ("ﬁle.rhai", "file.rhai"),
        ("s\u{ff11}.rhai", "s1.rhai"),
    ] {
        let tree = opened(zip(&[(one, "a"), (other, "b")]));
        for entry in tree.entries() {
            assert!(
                matches!(entry.problem, Some(EntryProblem::Alike { .. })),
                "{one} {other}: {entry:?}"
            );
        }
    }
    // the same name composed in two ways is the same name
    let tree = opened(zip(&[("Ren\u{e9}e", "a"), ("Rene\u{301}e", "b")]));
    assert_eq!(tree.entries()[0].problem, Some(EntryProblem::Duplicate));
}

#[test]
fn encrypted_and_oddly_compressed_files_spoil_themselves_alone() {
    let bytes = zip(&[("a.rhai", "a"), ("b.rhai", "b")]);
    let tree = opened(patched(bytes.clone(), FLAGS, &[1, 0]));
    assert_eq!(problem(&tree, "a.rhai"), EntryProblem::Encrypted);
    assert_eq!(tree.bytes(entry(&tree, "b.rhai"), MOST).unwrap(), b"b");
    let tree = opened(patched(bytes, METHOD, &12_u16.to_le_bytes()));
    let problem = problem(&tree, "a.rhai");
    assert!(
        matches!(problem, EntryProblem::Compression { .. }),
        "{problem}"
    );
    assert!(
        problem.to_string().to_lowercase().contains("bzip2"),
        "{problem}"
    );
}

#[test]
fn a_damaged_file_spoils_itself_alone() {
    let text: Vec<u8> = (0..4_000_u32).flat_map(|i| (i * i).to_le_bytes()).collect();
    let mut bytes = zip(&[("a.rhai", text), ("b.rhai", b"b".to_vec())]);
    for byte in &mut bytes[200..220] {
        *byte ^= 0x55;
    }
    let tree = opened(bytes);
    let problem = problem(&tree, "a.rhai");
    assert!(matches!(problem, EntryProblem::Damaged { .. }), "{problem}");
    assert_eq!(tree.bytes(entry(&tree, "b.rhai"), MOST).unwrap(), b"b");
}

#[test]
fn an_archive_without_its_end_is_refused() {
    let bytes = zip(&[("a.rhai", "a"), ("b.rhai", "b")]);
    for cut in [bytes.len() - 1, bytes.len() / 2, 30, 5] {
        let problem = Tree::of_zip(bytes[..cut].to_vec(), &Limits::default()).err();
        assert!(
            matches!(problem, Some(EntryProblem::Damaged { .. })),
            "{cut}: {problem:?}"
        );
    }
}

#[test]
fn archives_in_archives_end_at_the_second() {
    let third = zip(&[("a.rhai", "a")]);
    let second = zip(&[("third.zip", third)]);
    let first = zip(&[("second.zip", second)]);
    let source = opened(zip(&[("first.zip", first)]));
    let first = source.nested(&source.entries()[0], 10).unwrap();
    let second = first.nested(&first.entries()[0], 10).unwrap();
    let third = second.nested(&second.entries()[0], 10);
    assert_eq!(third.err(), Some(EntryProblem::TooDeep { most: 2 }));
}

#[test]
fn too_many_entries_are_not_listed() {
    let limits = Limits {
        entries: 3,
        ..Limits::default()
    };
    let files: Vec<(String, &str)> = (0..4).map(|i| (format!("{i}"), "")).collect();
    let problem = Tree::of_zip(zip(&files), &limits).err();
    let expected = EntryProblem::TooManyEntries { found: 4, most: 3 };
    assert_eq!(problem, Some(expected));
    let error = Tree::open(folder(&files).path(), &limits).err().unwrap();
    assert!(
        error.to_string().contains("4 entries (at most 3)"),
        "{error}"
    );
    // an archive that says it has more than fit into it
    let mut lying = zip(&[("a", "")]);
    let end = lying.len() - 22;
    lying[end + 8..end + 12].copy_from_slice(&[0xf0, 0xff, 0xf0, 0xff]);
    assert!(Tree::of_zip(lying, &Limits::default()).is_err());
}

#[test]
fn a_source_that_is_something_else_is_named() {
    let bed = folder(&[
        ("lab1.zip", b"Rar!\x1a\x07\x01\x00 and more".as_slice()),
        ("report.zip", b"%PDF-1.7"),
        ("empty.zip", b""),
        ("class", &zip(&[("s1.rhai", "a")])),
    ]);
    let message = |name: &str| {
        let error = Tree::open(&bed.path().join(name), &Limits::default()).err();
        error.unwrap().to_string()
    };
    assert!(message("lab1.zip").ends_with("it is a RAR archive, not a ZIP archive"));
    assert!(message("report.zip").ends_with("it is a PDF, not a ZIP archive"));
    assert!(message("empty.zip").ends_with("it is an empty file, not a ZIP archive"));
    assert!(message("nowhere.zip").ends_with("it does not exist"));
    // the bytes say that it is an archive, whatever the name is
    let tree = Tree::open(&bed.path().join("class"), &Limits::default()).unwrap();
    assert_eq!(tree.entries()[0].path, "s1.rhai");
    let document = zip(&[("[Content_Types].xml", ""), ("word/document.xml", "")]);
    let problem = Tree::of_zip(document, &Limits::default()).err().unwrap();
    assert!(
        problem.to_string().contains("an Office document"),
        "{problem}"
    );
}

#[test]
fn names_of_old_archives_are_read_in_their_encoding() {
    let bytes = zip(&[("Ren_e/a.rhai", "a"), ("x", "b")]);
    // é in code page 437
    let tree = opened(replaced(bytes, b"Ren_e", b"Ren\x82e"));
    assert_eq!(tree.entries()[0].path, "Ren\u{e9}e/a.rhai");
    // backslashes of old Windows tools are separators
    let bytes = zip(&[("work_out_x.txt", "a")]);
    let tree = opened(replaced(bytes, b"work_out_x.txt", b"work\\out\\x.txt"));
    assert_eq!(tree.entries()[0].path, "work/out/x.txt");
}

#[test]
fn what_systems_leave_behind_is_not_listed() {
    let files = [
        ("lab1-ana/.git/config", ""),
        ("lab1-ana/submission.rhai", "a"),
        ("lab1-ben/.git/HEAD", ""),
        ("__MACOSX/lab1-ana/._submission.rhai", ""),
        ("lab1-ana/.DS_Store", ""),
        ("lab1-ana/._submission.rhai", ""),
        ("Thumbs.db", ""),
        ("desktop.ini", ""),
    ];
    let bed = folder(&files);
    for tree in [
        opened(zip(&files)),
        Tree::open(bed.path(), &Limits::default()).unwrap(),
    ] {
        assert_eq!(tree.entries().len(), 1);
        assert_eq!(tree.entries()[0].path, "lab1-ana/submission.rhai");
        let folders: Vec<&String> = tree.folders().iter().collect();
        assert_eq!(folders, ["lab1-ana", "lab1-ben"]);
        let repositories: Vec<&String> = tree.repositories().iter().collect();
        assert_eq!(repositories, ["lab1-ana", "lab1-ben"]);
    }
}

mod any_bytes {
    use proptest::prelude::*;

    use super::*;

    /// Reads everything that can be read.
    fn read_all(tree: &Tree, depth: u32) {
        for entry in tree.entries() {
            let _ = tree.kind(entry);
            if let Ok(bytes) = tree.bytes(entry, MOST) {
                assert!(bytes.len() as u64 <= MOST);
            }
            if depth < 3
                && let Ok(inner) = tree.nested(entry, 100)
            {
                read_all(&inner, depth + 1);
            }
        }
    }

    proptest! {
        #[test]
        fn are_refused_or_read_and_never_more(
            flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
            cut in any::<prop::sample::Index>(),
            cuts in any::<bool>(),
        ) {
            let inner = zip(&[("submission.rhai", "let a = 1;"), ("out/x", "y")]);
            let mut bytes = zip(&[
                ("Ana_1_assignsubmission_file_/work.zip", inner),
                ("Ana_1_assignsubmission_file_/a.rhai", vec![b'a'; 300]),
                ("b/", Vec::new()),
            ]);
            for (at, value) in flips {
                let at = at.index(bytes.len());
                bytes[at] = value;
            }
            if cuts {
                bytes.truncate(cut.index(bytes.len()));
            }
            let mut file = tempfile::NamedTempFile::new().unwrap();
            file.write_all(&bytes).unwrap();
            if let Ok(tree) = Tree::of_zip(bytes, &Limits::default()) {
                read_all(&tree, 0);
            }
            if let Ok(tree) = Tree::open(file.path(), &Limits::default()) {
                read_all(&tree, 0);
            }
        }
    }
}
