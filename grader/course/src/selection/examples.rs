//! What people hand in, and which file of it is the submission.

use super::{Found, Unselected, select};
use crate::layout::PersonFiles;
use crate::tree::sample::{tree, zip};
use crate::tree::{EntryProblem, Limits, Tree};

type Files<'f> = &'f [(&'f str, &'f [u8])];

fn selected_in(tree: &Tree) -> Result<Found, Unselected> {
    let person = PersonFiles::of_all(tree);
    select(tree, &person, &|bytes| bytes.starts_with(b"KINEMARK"))
}

fn selected(files: Files<'_>) -> Result<Found, Unselected> {
    selected_in(&tree(files))
}

fn path(files: Files<'_>) -> String {
    selected(files).unwrap().path
}

#[test]
fn the_nearest_to_the_top_is_taken() {
    assert_eq!(
        path(&[("a/b/submission.rhai", b"b"), ("a/submission.rhai", b"a")]),
        "a/submission.rhai"
    );
    assert_eq!(
        path(&[("x/submission.rhai", b"b"), ("main.rhai", b"a")]),
        "main.rhai"
    );
    assert_eq!(
        path(&[("lab1.rhai.txt", b"a"), ("notes.txt", b"n")]),
        "lab1.rhai.txt"
    );
    assert_eq!(
        path(&[("submission.wasm", b"\0asm\x01")]),
        "submission.wasm"
    );
    assert_eq!(path(&[("submission.txt", b"a")]), "submission.txt");
}

#[test]
fn a_file_called_submission_goes_before_other_scripts() {
    assert_eq!(
        path(&[
            ("a.rhai", b"a"),
            ("submission.rhai", b"b"),
            ("starter.rhai", b"c")
        ]),
        "submission.rhai"
    );
    assert_eq!(
        path(&[("a.rhai", b"a"), ("submission (1).rhai", b"b")]),
        "submission (1).rhai"
    );
    // notes called so do not go before the script
    assert_eq!(
        path(&[("submission.txt", b"n"), ("submission.rhai", b"b")]),
        "submission.rhai"
    );
}

#[test]
fn a_hand_in_file_goes_before_all_on_its_level() {
    let hand_in = selected(&[("s1.kinemark", b"KINEMARK 1"), ("submission.rhai", b"b")]).unwrap();
    assert_eq!(
        (hand_in.path.as_str(), hand_in.is_hand_in),
        ("s1.kinemark", true)
    );
    // of another lab, or another file of that name
    let other = selected(&[("s1.kinemark", b"?"), ("submission.rhai", b"b")]).unwrap();
    assert_eq!(
        (other.path.as_str(), other.is_hand_in),
        ("submission.rhai", false)
    );
    assert_eq!(
        path(&[
            ("old/s1.kinemark", b"KINEMARK 1"),
            ("submission.rhai", b"b")
        ]),
        "submission.rhai"
    );
}

#[test]
fn a_zipped_working_folder_is_looked_into_without_its_reports() {
    let work = zip(&[
        ("01-kinematics/submission.rhai", "mine"),
        ("01-kinematics/brief.md", "b"),
        ("01-kinematics/out/submission.rhai", "old"),
        ("01-kinematics/out/grade.json", "{}"),
        ("01-kinematics/out/report.json", "{}"),
        ("01-kinematics/out/lab/01-kinematics/starter.rhai", "s"),
        ("01-kinematics/last week/grade.json", "{}"),
        ("01-kinematics/last week/report.json", "{}"),
        ("01-kinematics/last week/submission.rhai", "older"),
        ("__MACOSX/01-kinematics/._submission.rhai", "x"),
    ]);
    let found = selected(&[("work.zip", &work)]).unwrap();
    assert_eq!(found.path, "work.zip/01-kinematics/submission.rhai");
    assert_eq!(
        (found.name.as_str(), found.bytes.as_slice()),
        ("submission.rhai", b"mine".as_slice())
    );
    let twice = zip(&[("work.zip", work)]);
    assert_eq!(
        path(&[("again.zip", &twice)]),
        "again.zip/work.zip/01-kinematics/submission.rhai"
    );
}

#[test]
fn a_file_beside_an_archive_is_nearer_than_what_is_in_it() {
    let inner = zip(&[("submission.rhai", "b")]);
    assert_eq!(
        path(&[("backup.zip", &inner), ("submission.rhai", b"a")]),
        "submission.rhai"
    );
}

#[test]
fn two_on_one_level_are_for_a_person() {
    let inner = zip(&[("submission.rhai", "b")]);
    let cases: [Files<'_>; 5] = [
        &[("a.rhai", b"a"), ("b.rhai", b"b")],
        &[("x/submission.rhai", b"a"), ("y/submission.rhai", b"b")],
        &[("submission.rhai", b"a"), ("submission (1).rhai", b"b")],
        &[("submission.rhai", b"a"), ("submission.wasm", b"\0asm")],
        &[("x/submission.rhai", b"a"), ("y.zip", &inner)],
    ];
    for files in cases {
        match selected(files) {
            Err(Unselected::Ambiguous(found)) => assert_eq!(found.len(), 2),
            other => panic!("{files:?}: {other:?}"),
        }
    }
    let unselected = selected(cases[0]).unwrap_err();
    assert_eq!(
        unselected.what(),
        "2 files may be the submission: `a.rhai`, `b.rhai`"
    );
    // the same bytes twice are one submission
    assert_eq!(
        path(&[("x/submission.rhai", b"a"), ("y/submission.rhai", b"a")]),
        "x/submission.rhai"
    );
}

#[test]
fn what_is_there_instead_is_said() {
    let cases: [(Files<'_>, &str); 6] = [
        (&[], "there is no file"),
        (
            &[("report.pdf", b"%PDF-1.7"), ("solution.m", b"x = 1")],
            "there is `report.pdf` (a PDF) and `solution.m` (a MATLAB script)",
        ),
        (
            &[("work.rar", b"Rar!\x1a\x07\x00")],
            "there is `work.rar` (a RAR archive)",
        ),
        (
            &[("out/grade.json", b"{}"), ("out/report.json", b"{}")],
            "there is 2 files of a report, which has a grade and not the work",
        ),
        (
            &[("starter.rhai", b"s")],
            "there is `starter.rhai` (a starter)",
        ),
        (
            &[
                ("1", b""),
                ("2", b""),
                ("3", b""),
                ("4", b""),
                ("5", b""),
                ("6", b""),
            ],
            "there is `1`, `2`, `3`, `4` and 2 more files",
        ),
    ];
    for (files, expected) in cases {
        let unselected = selected(files).unwrap_err();
        let what = unselected.what();
        assert!(what.ends_with(expected), "{what}");
    }
}

#[test]
fn a_starter_and_the_copy_in_a_report_can_be_chosen_by_a_person() {
    let unselected = selected(&[
        ("starter.rhai", b"edited"),
        ("out/submission.rhai", b"copy"),
        ("out/grade.json", b"{}"),
    ]);
    let unselected = unselected.unwrap_err();
    let paths: Vec<&str> = unselected
        .candidates()
        .iter()
        .map(|file| file.path.as_str())
        .collect();
    assert_eq!(paths, ["out/submission.rhai", "starter.rhai"]);
}

#[test]
fn a_candidate_that_cannot_be_read_is_not_passed_over() {
    let large = vec![b' '; (1 << 20) + 1];
    let cases: [(Files<'_>, &str); 5] = [
        (
            &[
                ("submission.rhai", b"%PDF-1.7"),
                ("a/submission.rhai", b"a"),
            ],
            "`submission.rhai`: it is a PDF, not a script",
        ),
        (
            &[("submission.rhai", b"PK\x03\x04...")],
            "`submission.rhai`: it is a ZIP archive, not a script",
        ),
        (
            &[
                ("work.zip", b"Rar!\x1a\x07\x00"),
                ("a/b/submission.rhai", b"a"),
            ],
            "`work.zip`: it is a RAR archive, not a ZIP archive",
        ),
        (
            &[("submission.rhai", &large)],
            "`submission.rhai`: it has more than 1048576 bytes",
        ),
        (
            &[("submission.rhai", b"a"), ("Submission.rhai", b"b")],
            "`Submission.rhai`: its name differs from `submission.rhai` only in case or in characters that look alike",
        ),
    ];
    for (files, expected) in cases {
        assert_eq!(selected(files).unwrap_err().what(), expected);
    }
}

#[test]
fn names_that_lead_out_of_an_archive_are_for_a_person() {
    let inner = zip(&[("../submission.rhai", "a"), ("lab1/submission.rhai", "b")]);
    let unselected = selected(&[("work.zip", &inner)]).unwrap_err();
    assert_eq!(
        unselected.what(),
        "`work.zip/../submission.rhai`: its name leads out of its folder (`..`)"
    );
    // of something that nobody looks for it does not matter
    let inner = zip(&[("../notes.txt", "a"), ("lab1/submission.rhai", "b")]);
    assert_eq!(
        path(&[("work.zip", &inner)]),
        "work.zip/lab1/submission.rhai"
    );
}

#[test]
fn one_person_s_bombs_end_at_their_share() {
    let bomb = zip(&[("x/bomb", vec![0; 1 << 20])]);
    let files: Vec<(String, Vec<u8>)> = (0..8)
        .map(|i| (format!("{i}.zip"), zip(&[("inner.zip", &bomb)])))
        .collect();
    let limits = Limits {
        person_bytes: 3_000,
        entries: 12,
        ..Limits::default()
    };
    let tree = Tree::of_zip(zip(&files), &limits).unwrap();
    match selected_in(&tree).unwrap_err() {
        Unselected::Unusable { problem, .. } => assert!(matches!(
            problem,
            EntryProblem::TooLarge { .. } | EntryProblem::TooManyEntries { .. }
        )),
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_archive_too_deep_is_for_a_person() {
    let mut bytes = zip(&[("submission.rhai", "a")]);
    for _ in 0..3 {
        bytes = zip(&[("inner.zip", bytes)]);
    }
    let unselected = selected(&[("work.zip", &bytes)]).unwrap_err();
    assert_eq!(
        unselected.what(),
        "`work.zip/inner.zip/inner.zip`: it is an archive inside 2 archives"
    );
}
