//! A class as five systems export it, in archives and in folders: everybody is found, with the same submission.

mod exports;
mod people;

use std::collections::BTreeMap;

use proptest::prelude::*;

use self::exports::{Files, MoodleWay, decomposed};
use self::people::{HAND_IN_MARK, Student};
use crate::layout::arrange;
use crate::matching::Matcher;
use crate::roster::Roster;
use crate::selection::select;
use crate::tree::sample::{folder, zip};
use crate::tree::{Limits, Tree};

/// A name on a disk has at most so many bytes.
const LONGEST_ON_DISK: usize = 255;

/// What was found: whose submission is which, and how many rows are for a person.
#[derive(Debug, PartialEq, Eq)]
struct Outcome {
    layout: &'static str,
    submissions: BTreeMap<String, Vec<u8>>,
    open: usize,
}

fn read(tree: &Tree, roster: &Roster) -> Outcome {
    let arrangement = arrange(tree);
    let students = Matcher::new(roster).students_of_all(&arrangement.people);
    let mut submissions = BTreeMap::new();
    let mut open = 0;
    for (person, student) in arrangement.people.iter().zip(students) {
        let found = select(tree, person, &|bytes| bytes.starts_with(HAND_IN_MARK))
            .unwrap_or_else(|why| panic!("{}: {why:?}", person.label));
        match student {
            Ok(matched) => {
                let [id] = matched.students.as_slice() else {
                    panic!("{}: {matched:?}", person.label);
                };
                let twice = submissions.insert(id.to_string(), found.bytes);
                assert!(twice.is_none(), "{id} twice");
            }
            Err(_) => open += 1,
        }
    }
    Outcome {
        layout: arrangement.layout.name,
        submissions,
        open,
    }
}

/// Reads an export as an archive and, where a disk can hold its names, as a folder; both come to the same.
fn read_both(files: &Files, roster: &Roster) -> Outcome {
    let archive = Tree::of_zip(zip(files), &Limits::default()).unwrap();
    let outcome = read(&archive, roster);
    let longest = files.iter().flat_map(|(path, _)| path.split('/'));
    if longest.map(str::len).max() <= Some(LONGEST_ON_DISK) {
        let bed = folder(files);
        let tree = Tree::open(bed.path(), &Limits::default()).unwrap();
        assert_eq!(read(&tree, roster), outcome);
    }
    outcome
}

fn expected<'s>(class: impl Iterator<Item = &'s Student>) -> BTreeMap<String, Vec<u8>> {
    let submission = |student: &Student| (student.id.clone(), student.expected());
    class.map(submission).collect()
}

/// Each writes and reads the class ten times.
const CASES: u32 = 24;

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, ..ProptestConfig::default() })]

    #[test]
    fn everybody_is_found_where_the_source_has_ids(class in people::class()) {
        let roster = Roster::parse("roster.csv", &people::roster(&class)).unwrap();
        for (layout, files) in [
            ("canvas", exports::canvas(&class)),
            ("gradescope", exports::gradescope(&class)),
            ("repositories", exports::repositories(&class)),
            ("flat", exports::flat(&class)),
        ] {
            let outcome = read_both(&files, &roster);
            prop_assert_eq!(outcome.layout, layout);
            prop_assert_eq!(outcome.open, 0);
            prop_assert_eq!(outcome.submissions, expected(class.iter()), "{}", layout);
        }
    }

    #[test]
    fn everybody_with_a_name_of_their_own_is_found_in_moodle(
        class in people::class(),
        folders in any::<bool>(),
        old in any::<bool>(),
        decompose in any::<bool>(),
    ) {
        let roster = Roster::parse("roster.csv", &people::roster(&class)).unwrap();
        let mut files = exports::moodle(&class, MoodleWay { folders, old });
        if decompose {
            files = decomposed(files);
        }
        let outcome = read_both(&files, &roster);
        prop_assert_eq!(outcome.layout, "moodle");
        let own = class.iter().filter(|student| has_own_name(student, &class));
        let own = expected(own);
        prop_assert_eq!(outcome.open, class.len() - own.len());
        prop_assert_eq!(outcome.submissions, own);
    }
}

/// Whether nobody else has the name of a student, and Moodle left something of it.
fn has_own_name(student: &Student, class: &[Student]) -> bool {
    let plain = |student: &Student| {
        let name = crate::student::folded(&exports::moodle_name(&student.name));
        let spaced = name.replace('_', " ");
        let words: Vec<&str> = spaced.split_whitespace().collect();
        words.join(" ")
    };
    let name = plain(student);
    !name.is_empty() && class.iter().filter(|other| plain(other) == name).count() == 1
}
