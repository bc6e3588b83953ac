//! Hand-in files that are whole, damaged, and made by somebody who means harm.

use kinemark_grader::record::grade::VariantRecord;
use kinemark_grader::record::sample;
use proptest::prelude::*;

use super::*;

const TEXT: &[u8] = b"fn control(observation) {\n    [0.0, 0.0]\n}\n";

fn made_with() -> MadeWith {
    MadeWith {
        engine: "kinemark 0.1.0 (engine 00ff)".to_owned(),
        lab: "a".repeat(64),
    }
}

fn hand_in() -> HandInFile {
    let practice = sample::graded().grade;
    let handed_in = HandedIn {
        made_with: made_with(),
        student: None,
        file: "work/mine.rhai",
        submission: TEXT,
        sources: &[],
        practice: &practice,
    };
    HandInFile::new(handed_in).unwrap()
}

/// An archive of such entries; the statement is that of [`hand_in`] after `edit`.
fn edited(edit: impl Fn(&mut serde_json::Value), entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut statement = serde_json::to_value(hand_in().statement).unwrap();
    edit(&mut statement);
    let statement = statement.to_string();
    let mut files = vec![ArchiveFile::new(STATEMENT, statement.as_bytes())];
    files.extend(
        entries
            .iter()
            .map(|(name, bytes)| ArchiveFile::new(*name, *bytes)),
    );
    archive(&files).unwrap()
}

const WHOLE: &[(&str, &[u8])] = &[(SCRIPT, TEXT), (PRACTICE, b"{}")];

#[test]
fn what_is_written_is_read_and_the_same_content_has_the_same_bytes() {
    let written = hand_in();
    let bytes = written.write().unwrap();
    assert_eq!(hand_in().write().unwrap(), bytes);
    assert!(is_hand_in(&bytes));
    let read = HandInFile::read(&bytes).unwrap();
    assert_eq!(read, written);
    assert_eq!(read.statement.file, "mine.rhai");
    assert_eq!(read.practice(), Some(sample::graded().grade));
    assert_eq!(read.made_with(), made_with());
}

#[test]
fn a_variant_and_whoever_hands_in_are_named() {
    let mut practice = sample::graded().grade;
    practice.variant = Some(VariantRecord {
        student: Some("Rene\u{301}e".to_owned()),
        parameters: std::collections::BTreeMap::new(),
    });
    let student = StudentId::new("s1").unwrap();
    let handed_in = HandedIn {
        made_with: made_with(),
        student: Some(student.clone()),
        file: "mine.WASM",
        submission: b"\0asm",
        sources: &[],
        practice: &practice,
    };
    let bytes = HandInFile::new(handed_in).unwrap().write().unwrap();
    let read = HandInFile::read(&bytes).unwrap();
    let variant_of = read.statement.variant_of.unwrap();
    assert_eq!(variant_of.as_str(), "Ren\u{e9}e");
    assert_eq!(read.statement.student, Some(student));
    assert_eq!(read.submission, b"\0asm");
    assert_eq!(
        file_name("01-kinematics", Some(&variant_of)),
        "01-kinematics-Ren~e9~e.kinemark"
    );
    assert_eq!(file_name("01-kinematics", None), "01-kinematics.kinemark");
}

#[test]
fn a_file_that_was_cut_short_is_recognised_and_refused() {
    let bytes = hand_in().write().unwrap();
    for length in [60, bytes.len() / 2, bytes.len() - 1] {
        assert!(is_hand_in(&bytes[..length]), "{length}");
        let error = HandInFile::read(&bytes[..length]).unwrap_err();
        assert!(
            matches!(
                error,
                HandInFileError::Damaged { .. } | HandInFileError::Entries { .. }
            ),
            "{length}: {error}"
        );
    }
}

#[test]
fn other_files_are_no_hand_ins() {
    let zip = archive(&[ArchiveFile::new("submission.rhai", TEXT)]).unwrap();
    for bytes in [&b""[..], b"PK", b"PK\x03\x04", TEXT, &zip] {
        assert!(!is_hand_in(bytes));
        assert!(HandInFile::read(bytes).is_err());
    }
    // one that another program packed again
    let turned = archive(&[
        ArchiveFile::new(SCRIPT, TEXT),
        ArchiveFile::new(STATEMENT, "{}"),
    ]);
    assert!(is_hand_in(&turned.unwrap()));
}

#[test]
fn entries_of_others_are_refused() {
    for entries in [
        &[(SCRIPT, TEXT)][..],
        &[
            (SCRIPT, TEXT),
            (PRACTICE, b"{}"),
            ("../../etc/passwd", b"x"),
        ],
        &[(SCRIPT, TEXT), (PRACTICE, b"{}"), (PLUGIN, b"x")],
        &[(SCRIPT, TEXT), (PRACTICE, b"{}"), ("__MACOSX/._a", b"x")],
        &[("../submission.rhai", TEXT), (PRACTICE, b"{}")],
    ] {
        let error = HandInFile::read(&edited(|_| {}, entries)).unwrap_err();
        assert!(
            matches!(error, HandInFileError::Entries { .. }),
            "{error:?}"
        );
    }
    assert!(HandInFile::read(&edited(|_| {}, WHOLE)).is_ok());
    // bytes behind the end of the directory
    let mut longer = edited(|_| {}, WHOLE);
    longer.push(0);
    assert!(HandInFile::read(&longer).is_err());
}

fn source(path: &str, text: &str) -> SourceFile {
    SourceFile {
        path: path.to_owned(),
        bytes: text.as_bytes().to_vec(),
    }
}

/// A hand-in of a module with these sources.
fn of_module(sources: &[SourceFile]) -> HandInFile {
    let practice = sample::graded().grade;
    let handed_in = HandedIn {
        made_with: made_with(),
        student: None,
        file: "submission.wasm",
        submission: b"\0asm",
        sources,
        practice: &practice,
    };
    HandInFile::new(handed_in).unwrap()
}

#[test]
fn the_sources_of_a_module_come_back() {
    let sources = [
        source("Cargo.toml", "[package]"),
        source("src/lib.rs", "mod arm;"),
    ];
    let written = of_module(&sources);
    let read = HandInFile::read(&written.write().unwrap()).unwrap();
    assert_eq!(read.sources, sources);
    assert_eq!(read, written);
    assert!(of_module(&[]).statement.sources.is_empty());
}

/// The bytes of a hand-in whose archive has these sources, whatever its statement says.
fn with_sources(stated: &[SourceFile], there: &[(&str, &[u8])]) -> Vec<u8> {
    let statement = serde_json::to_vec(&of_module(stated).statement).unwrap();
    let mut files = vec![
        ArchiveFile::new(STATEMENT, statement),
        ArchiveFile::new(PLUGIN, &b"\0asm"[..]),
        ArchiveFile::new(PRACTICE, &b"{}"[..]),
    ];
    let there = there.iter();
    files.extend(there.map(|(name, bytes)| ArchiveFile::new(*name, *bytes)));
    archive(&files).unwrap()
}

#[test]
fn other_sources_than_those_that_are_named_are_refused() {
    let stated = [source("a.c", "1")];
    assert!(HandInFile::read(&with_sources(&stated, &[("sources/a.c", b"1")])).is_ok());
    for there in [
        &[][..],
        &[("sources/a.c", &b"2"[..])],
        &[("sources/b.c", b"1")],
        &[("sources/a.c", b"1"), ("sources/b.c", b"1")],
    ] {
        let error = HandInFile::read(&with_sources(&stated, there)).unwrap_err();
        assert_eq!(error, HandInFileError::OtherSubmission);
    }
    // names that lead elsewhere, or that no disk takes
    for name in [
        "sources/../a.c",
        "sources//a.c",
        "sources/",
        "sources/.env",
        "sources/a\\b.c",
        "sources/con.c",
        "sources/a\u{202e}.c",
    ] {
        let error = HandInFile::read(&with_sources(&[], &[(name, b"1")])).unwrap_err();
        assert!(
            matches!(error, HandInFileError::Entries { .. }),
            "{name}: {error:?}"
        );
    }
    // sources of a script
    let error = edited(
        |_| {},
        &[(SCRIPT, TEXT), (PRACTICE, b"{}"), ("sources/a.c", b"1")],
    );
    assert!(HandInFile::read(&error).is_err());
}

#[test]
fn sources_that_unpack_to_more_than_is_kept_are_refused() {
    let large = vec![b' '; MOST_FILE_BYTES as usize + 1];
    let bomb = with_sources(&[], &[("sources/a.c", &large)]);
    assert!(bomb.len() < 1 << 16);
    let error = HandInFile::read(&bomb).unwrap_err();
    assert!(
        matches!(error, HandInFileError::TooLarge { .. }),
        "{error:?}"
    );
    let whole = vec![b' '; MOST_FILE_BYTES as usize];
    let names: Vec<String> = (0..6).map(|i| format!("sources/{i}.c")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|n| (n.as_str(), &whole[..])).collect();
    assert!(HandInFile::read(&with_sources(&[], &files)).is_err());
    let names: Vec<String> = (0..MOST_FILES + 2)
        .map(|i| format!("sources/{i}.c"))
        .collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|n| (n.as_str(), &b"x"[..])).collect();
    assert!(HandInFile::read(&with_sources(&[], &files)).is_err());
}

#[test]
fn a_name_twice_is_refused() {
    let bytes = edited(
        |_| {},
        &[(SCRIPT, TEXT), (PRACTICE, b"{}"), ("submission.rhaj", b"x")],
    );
    // the writer takes no name twice, so the bytes of one are changed, wherever they stand
    let mut twice = bytes;
    while let Some(at) = twice
        .windows(15)
        .position(|window| window == b"submission.rhaj")
    {
        twice[at + 14] = b'i';
    }
    let error = HandInFile::read(&twice).unwrap_err();
    assert!(
        matches!(error, HandInFileError::Entries { .. }),
        "{error:?}"
    );
}

#[test]
fn what_unpacks_to_more_than_it_may_is_refused() {
    let large = vec![b' '; MOST_PRACTICE_BYTES as usize + 1];
    let bomb = edited(|_| {}, &[(SCRIPT, TEXT), (PRACTICE, &large)]);
    assert!(bomb.len() < 1 << 20);
    let error = HandInFile::read(&bomb).unwrap_err();
    assert!(
        matches!(error, HandInFileError::TooLarge { .. }),
        "{error:?}"
    );
    let large = vec![b' '; MOST_SUBMISSION_BYTES as usize + 1];
    let digest = blake3::hash(&large).to_hex().to_string();
    let bomb = edited(
        |statement| statement["submission"] = digest.clone().into(),
        &[(SCRIPT, &large), (PRACTICE, b"{}")],
    );
    assert!(HandInFile::read(&bomb).is_err());
    assert!(HandInFile::read(&vec![0; MOST_HAND_IN_BYTES as usize + 1]).is_err());
}

#[test]
fn statements_that_cannot_be_are_refused() {
    let text = |text: &str| serde_json::Value::from(text);
    for (key, value) in [
        ("lab", text("../labs")),
        ("lab", text("..")),
        ("lab", text("")),
        ("lab", text("a\u{1b}[31m")),
        ("lab_digest", text("ABC")),
        ("submission", text("")),
        ("file", text("../x.rhai")),
        ("file", text("a\\b.rhai")),
        ("file", text("..")),
        ("file", text("a\nb.rhai")),
        ("file", text(&"a".repeat(256))),
        ("engine", text("kine\nmark")),
        ("student", text(" ")),
        ("variant_of", text("a\u{7}")),
        ("points", serde_json::json!(30.0)),
        ("points", serde_json::json!(-1.0)),
        ("points", text("24")),
        ("max_points", serde_json::Value::Null),
    ] {
        let bytes = edited(
            |statement| {
                statement["max_points"] = 24.0.into();
                statement["points"] = 1.0.into();
                statement[key] = value.clone();
            },
            WHOLE,
        );
        let error = HandInFile::read(&bytes).unwrap_err();
        assert!(
            matches!(error, HandInFileError::Statement { .. }),
            "{key} = {value}: {error:?}"
        );
    }
}

#[test]
fn another_version_is_named() {
    let of = |format: &str| {
        let bytes = edited(|statement| statement["format"] = format.into(), WHOLE);
        assert!(is_hand_in(&bytes));
        HandInFile::read(&bytes).unwrap_err().to_string()
    };
    assert!(of("kinemark-hand-in/2").contains("`kinemark-hand-in/2`"));
    assert!(of("a\u{1b}[2J").contains("`no hand-in format`"));
}

#[test]
fn another_submission_than_the_one_named_is_refused() {
    let bytes = edited(|_| {}, &[(SCRIPT, b"other"), (PRACTICE, b"{}")]);
    let error = HandInFile::read(&bytes).unwrap_err();
    assert_eq!(error, HandInFileError::OtherSubmission);
    // a plugin under the name of a script
    let bytes = edited(|_| {}, &[(PLUGIN, TEXT), (PRACTICE, b"{}")]);
    let error = HandInFile::read(&bytes).unwrap_err();
    assert_eq!(error, HandInFileError::OtherSubmission);
}

#[test]
fn a_record_of_another_version_is_no_reason_to_refuse() {
    let read = HandInFile::read(&edited(|_| {}, WHOLE)).unwrap();
    assert_eq!(read.practice(), None);
    assert_eq!(read.submission, TEXT);
}

#[test]
fn a_changed_byte_changes_nothing_that_is_read() {
    let whole = hand_in();
    let bytes = whole.write().unwrap();
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 0x21;
        if let Ok(read) = HandInFile::read(&changed) {
            assert_eq!(read, whole, "byte {at}");
        }
    }
}

proptest! {
    #[test]
    fn no_bytes_are_too_much(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let mut archive = b"PK\x03\x04".to_vec();
        archive.extend(&bytes);
        archive.extend(b"PK\x05\x06\0\0\0\0\x03\0\x03\0\x20\0\0\0\0\0\0\0\0\0");
        is_hand_in(&archive);
        prop_assert!(HandInFile::read(&archive).is_err());
        prop_assert!(HandInFile::read(&bytes).is_err());
    }
}
