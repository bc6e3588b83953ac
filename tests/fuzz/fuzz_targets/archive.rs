//! Bytes of what is handed in for a class. What begins as a ZIP archive is one. Anything else is text from which one is made: a line
//! `@NAME` begins a file, and the lines up to the next are what it holds.
#![no_main]

use std::sync::OnceLock;

use kinemark_course::fixed_zip::{ArchiveFile, archive};
use kinemark_course::hand_in_file::{HandInFile, is_hand_in};
use kinemark_course::layout::{LAYOUTS, arrange, arrange_as};
use kinemark_course::matching::Matcher;
use kinemark_course::module_sources::sources;
use kinemark_course::roster::Roster;
use kinemark_course::submission_file::submission_of;
use kinemark_course::tree::{Limits, Tree};
use libfuzzer_sys::fuzz_target;

/// A class in which ids, names and logins resemble each other.
const ROSTER: &str = "id,name,email,lms_id,username,group,repository\n\
    s1,Ada Lovelace,ada@example.org,11,ada,team 1,lab-ada\n\
    s10,Ren\u{e9}e Ng,ng@example.org,12,rng,team 1,lab-rng\n\
    2042,\"Lee, Sam\",sam@example.org,13,sam.lee,,lab-sam\n";

/// Small ones, so that what grows beyond them ends.
const LIMITS: Limits = Limits {
    entries: 1_000,
    name_bytes: 1_000,
    total_bytes: 16 << 20,
    person_bytes: 8 << 20,
    nested_bytes: 4 << 20,
    nesting: 2,
};

fuzz_target!(|bytes: &[u8]| {
    if bytes.starts_with(b"PK") {
        hand_in(bytes);
        return read(bytes.to_vec());
    }
    if let Some(made) = made(bytes) {
        hand_in(&made);
        read(made);
    }
});

/// The archive that a text describes; none where it has a name twice.
fn made(text: &[u8]) -> Option<Vec<u8>> {
    let text = std::str::from_utf8(text).ok()?;
    let files = text.split("\n@").map(|file| {
        let (name, content) = file.split_once('\n').unwrap_or((file, ""));
        ArchiveFile::new(name.trim_start_matches('@'), content)
    });
    archive(&files.collect::<Vec<_>>()).ok()
}

/// A hand-in file that is read is written as itself, however it was packed.
fn hand_in(bytes: &[u8]) {
    is_hand_in(bytes);
    if let Ok(file) = HandInFile::read(bytes) {
        file.practice();
        file.made_with();
        let written = file.write().expect("what was read is written");
        assert_eq!(HandInFile::read(&written), Ok(file));
    }
}

/// As a course reads it: by its own layout and by each of them.
fn read(bytes: Vec<u8>) {
    let Ok(tree) = Tree::of_zip(bytes, &LIMITS) else {
        return;
    };
    for entry in tree.entries() {
        tree.kind(entry);
        let _problem = tree.bytes(entry, 1 << 20);
        let _other = tree.nested(entry, 100);
    }
    let files = tree.entries().iter();
    let files = files.map(|entry| (entry.path.clone(), entry));
    sources(files, |entry, most| tree.bytes(entry, most).ok());

    static PARSED: OnceLock<Roster> = OnceLock::new();
    let roster = PARSED.get_or_init(|| {
        Roster::parse("roster.csv", ROSTER.as_bytes()).expect("a roster that can be read")
    });
    let matcher = Matcher::new(roster);
    let of_name = LAYOUTS.iter().map(|layout| arrange_as(&tree, layout.name));
    for arrangement in of_name.flatten().chain([arrange(&tree)]) {
        let matches = matcher.students_of_all(&arrangement.people);
        assert_eq!(matches.len(), arrangement.people.len());
        for person in &arrangement.people {
            for file in &person.files {
                assert!(file.entry < tree.entries().len());
            }
            let _unclear = submission_of(&tree, person, "01-kinematics");
        }
    }
}
