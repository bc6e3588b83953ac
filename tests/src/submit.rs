//! `kinemark submit`: the file to upload, what it says, and each warning alone.

use kinemark_course::hand_in_file::HandInFile;
use serde_json::Value as Json;

use crate::testbed::{CommandResult, TestBed, root};

const LAB: &str = "01-kinematics";

/// A folder as `kinemark new` writes it, with a submission that loses points in the move.
fn bed() -> TestBed {
    let bed = TestBed::new();
    let ran = bed.run(&["new", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    put(&bed, "four-millimetres-off");
    bed
}

/// Puts a submission of the tests into the folder.
fn put(bed: &TestBed, name: &str) {
    let path = format!("tests/submissions/{LAB}/{name}/submission.rhai");
    let bytes = std::fs::read(root().join(path)).expect("a submission");
    bed.write(&format!("{LAB}/submission.rhai"), bytes);
}

/// Runs in the student's folder.
fn student(bed: &TestBed, args: &[&str]) -> CommandResult {
    bed.run_in(&bed.path(LAB), args)
}

fn hand_in(bed: &TestBed, name: &str) -> HandInFile {
    let bytes = std::fs::read(bed.path(LAB).join(name)).expect("a hand-in file");
    HandInFile::read(&bytes).expect("a whole hand-in file")
}

/// The kinds of the warnings, after `kinemark submit --json` with these arguments.
fn kinds(bed: &TestBed, args: &[&str]) -> Vec<String> {
    let ran = student(bed, &[&["submit", "--json"], args].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let printed: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let warnings = printed["warnings"].as_array().expect("warnings");
    let kinds = warnings.iter().map(|warning| {
        assert!(!warning["help"].as_str().expect("help").is_empty());
        warning["kind"].as_str().expect("a kind").to_owned()
    });
    kinds.collect()
}

/// The variant of a student, as course staff make it.
fn variant(bed: &TestBed, id: &str) {
    let reference = root().join("reference");
    let reference = reference.to_str().expect("UTF-8");
    let out = format!("{LAB}/variant.toml");
    let ran = bed.run(&[
        "lab",
        "variant",
        LAB,
        "--student",
        id,
        "--out",
        &out,
        "--force",
        "--reference",
        reference,
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn one_command_in_the_folder_of_a_lab_writes_the_file_to_upload() {
    let bed = bed();
    let ran = student(&bed, &["submit"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.starts_with("wrote 01-kinematics.kinemark\n"),
        "{ran:?}"
    );
    for words in [" of 24 points: visible cases only", "Upload this one file"] {
        assert!(ran.stdout.contains(words), "{ran:?}");
    }
    let first = std::fs::read(bed.path("01-kinematics/01-kinematics.kinemark")).expect("file");
    let read = hand_in(&bed, "01-kinematics.kinemark");
    let submission = std::fs::read(bed.path("01-kinematics/submission.rhai")).expect("file");
    assert_eq!(read.submission, submission);
    assert_eq!(read.statement.lab, LAB);
    assert_eq!(read.statement.variant_of, None);
    assert!(read.statement.points < read.statement.max_points);
    let practice = read.practice().expect("a record");
    assert_eq!(practice.points, read.statement.points);
    assert!(ran.stdout.contains(&read.statement.lab_digest[..12]));
    assert!(ran.stdout.contains(&read.statement.engine));
    // again, over the file of before: the same bytes
    let ran = student(&bed, &["submit", LAB, "submission.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let again = std::fs::read(bed.path("01-kinematics/01-kinematics.kinemark")).expect("file");
    assert_eq!(first, again);
}

#[test]
fn the_lab_is_that_of_the_variant_and_its_student_is_in_the_name() {
    let bed = bed();
    variant(&bed, "s1000");
    bed.write(
        "elsewhere/mine.rhai",
        "fn control(observation) { [0.0, 0.0] }\n",
    );
    std::fs::rename(
        bed.path("01-kinematics/variant.toml"),
        bed.path("elsewhere/variant.toml"),
    )
    .expect("moved");
    let ran = bed.run(&["submit", "elsewhere/mine.rhai", "--out", "elsewhere"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let written = bed.path("elsewhere/01-kinematics-s1000.kinemark");
    let read = HandInFile::read(&std::fs::read(written).expect("file")).expect("a hand-in file");
    assert_eq!(
        read.statement.variant_of.expect("a variant").as_str(),
        "s1000"
    );
    assert_eq!(read.statement.file, "mine.rhai");
}

#[test]
fn each_slip_has_its_warning_and_nothing_is_refused() {
    let bed = bed();
    assert_eq!(kinds(&bed, &[]), ["no-variant"]);
    variant(&bed, "s1000");
    assert!(kinds(&bed, &[]).is_empty());
    assert!(kinds(&bed, &["--student", "s1000"]).is_empty());
    assert_eq!(kinds(&bed, &["--student", "s1001"]), ["other-variant"]);

    let graded = student(&bed, &["grade", LAB, "submission.rhai"]);
    assert_eq!(graded.code, Some(1), "{graded:?}");
    assert!(kinds(&bed, &[]).is_empty());
    put(&bed, "good");
    assert_eq!(kinds(&bed, &[]), ["not-graded-last"]);
    put(&bed, "syntax");
    assert_eq!(kinds(&bed, &[]), ["did-not-build", "not-graded-last"]);
    std::fs::remove_dir_all(bed.path("01-kinematics/out")).expect("removed");

    let starter = root().join("labs/01-kinematics/starter.rhai");
    let starter = std::fs::read_to_string(starter).expect("starter");
    bed.write(
        "01-kinematics/submission.rhai",
        starter.replace('\n', "\r\n"),
    );
    assert_eq!(kinds(&bed, &[]), ["starter"]);

    // not even text: it is handed in as it is
    bed.write("01-kinematics/submission.rhai", b"// Stra\xdfe\n");
    assert_eq!(kinds(&bed, &[]), ["did-not-build"]);
    let read = hand_in(&bed, "01-kinematics-s1000.kinemark");
    assert_eq!(read.submission, b"// Stra\xdfe\n");
    assert_eq!(read.statement.points, 0.0);
}

#[test]
fn another_lab_than_the_one_built_in_is_reported() {
    let bed = bed();
    variant(&bed, "s1000");
    bed.copy_labs();
    assert!(kinds(&bed, &[]).is_empty());
    bed.edit("labs/01-kinematics/lab.toml", "points = ", "points = 1");
    assert_eq!(kinds(&bed, &[]), ["other-lab"]);
}

#[test]
fn a_lab_that_changed_since_it_was_graded_is_reported() {
    let bed = bed();
    variant(&bed, "s1000");
    bed.copy_labs();
    let ran = student(&bed, &["grade", LAB, "submission.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    bed.edit("labs/01-kinematics/lab.toml", "points = ", "points = 1");
    assert_eq!(kinds(&bed, &[]), ["other-lab", "lab-since-graded"]);
}

#[test]
fn warnings_are_words_for_people_and_stand_apart_from_the_result() {
    let bed = bed();
    put(&bed, "syntax");
    let ran = student(&bed, &["submit"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stderr
            .starts_with("warning: the submission does not build in line "),
        "{ran:?}"
    );
    assert_eq!(ran.stderr.matches("  help: ").count(), 2, "{ran:?}");
    assert!(!ran.stdout.contains("warning"), "{ran:?}");
}

#[test]
fn what_is_no_submission_or_somebody_elses_file_is_refused() {
    let bed = bed();
    assert_eq!(student(&bed, &["submit"]).code, Some(0));
    bed.write("01-kinematics/notes.txt", "mine");
    for (args, words) in [
        (
            &["submit", LAB, "01-kinematics.kinemark"][..],
            "is a hand-in file already",
        ),
        (
            &["submit", "--out", "notes.txt"],
            "`notes.txt` exists and is not a hand-in file",
        ),
        (
            &["submit", LAB, "--out", "submission.rhai"],
            "is not a hand-in file",
        ),
        (&["submit", "99-nothing"], "no lab is called `99-nothing`"),
        (
            &["submit", LAB, "mine.rhai"],
            "there is no file `mine.rhai`",
        ),
        (&["submit", "--student", " "], "the student id is empty"),
    ] {
        let ran = student(&bed, args);
        assert_eq!(ran.code, Some(2), "{args:?}: {ran:?}");
        assert!(ran.stderr.contains(words), "{args:?}: {ran:?}");
    }
    let notes = std::fs::read_to_string(bed.path("01-kinematics/notes.txt")).expect("file");
    assert_eq!(notes, "mine");
    bed.write(
        "somewhere/submission.rhai",
        "fn control(o) { [0.0, 0.0] }\n",
    );
    let ran = bed.run(&["submit", "somewhere/submission.rhai"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("it is not clear which lab this is"),
        "{ran:?}"
    );
}
