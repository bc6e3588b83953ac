//! What may have been handed in with a submission says nothing about how it is graded: labs, staff part, course, and links.

use std::path::Path;

use crate::testbed::{CommandResult, TestBed, copy, root};

const LAB: &str = "01-kinematics";

/// A course with labs and the course staff's part, and in `hand-ins/s1` a hand-in that has all of them, too.
fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    let solution = root().join("reference/01-kinematics/solution.rhai");
    for folder in ["hand-ins/s1", "hand-ins/s1/src", "hand-ins/s2"] {
        std::fs::create_dir_all(bed.path(folder)).expect("folder");
        std::fs::copy(&solution, bed.path(folder).join("submission.rhai")).expect("copied");
    }
    for folder in ["labs", "reference"] {
        copy(&root().join(folder), &bed.path("hand-ins/s1").join(folder));
    }
    bed
}

fn grade(bed: &TestBed, folder: &str, args: &[&str]) -> CommandResult {
    bed.run_in(&bed.path(folder), &[&["grade", LAB], args].concat())
}

fn is_refused(ran: &CommandResult, words: &str) {
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let stderr = ran.stderr.replace("\n  │ ", " ");
    assert!(
        stderr.contains("may be part of what was handed in"),
        "{ran:?}"
    );
    assert!(stderr.contains(words), "{words}: {ran:?}");
    assert!(
        stderr.contains("help: run the command in the course's own folder"),
        "{ran:?}"
    );
    assert_eq!(ran.stdout, "", "{ran:?}");
}

#[test]
fn labs_that_were_handed_in_grade_nothing() {
    let bed = bed();
    let beside = "the labs folder `labs` may be part of what was handed in: it lies in the folder of the submission";
    is_refused(&grade(&bed, "hand-ins/s1", &["submission.rhai"]), beside);
    is_refused(&grade(&bed, "hand-ins/s1", &["."]), beside);
    // deeper in the hand-in nothing sets it apart from a course, but for the course above it
    let above = "above it there is `../../labs`";
    is_refused(&grade(&bed, "hand-ins/s1", &["src/submission.rhai"]), above);
    let above = "above it there is `../../../labs`";
    is_refused(&grade(&bed, "hand-ins/s1/src", &["submission.rhai"]), above);
    assert!(!bed.path("hand-ins/s1/out").exists());
    // with the labs of another course or of the program, and no staff part beside, nothing is graded that could be forged
    std::fs::remove_dir_all(bed.path("hand-ins/s1/reference")).expect("removed");
    let ran = grade(&bed, "hand-ins/s1", &["submission.rhai", "--out", "o"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("practice: visible cases only"),
        "{ran:?}"
    );
    assert!(
        ran.stderr.contains("note: using the labs in `labs`\n"),
        "{ran:?}"
    );
    let staff = ["submission.rhai", "--reference", "../../reference"];
    is_refused(&grade(&bed, "hand-ins/s1", &staff), beside);
}

#[test]
fn labs_that_are_named_and_those_of_a_course_grade_what_lies_below_them() {
    let bed = bed();
    let graded = |folder: &str, args: &[&str], note: &str| {
        let ran = grade(&bed, folder, &[args, &["--out", "o", "--json"]].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(ran.stdout.contains("\"mode\": \"graded\""), "{ran:?}");
        assert!(ran.stderr.contains(note), "{ran:?}");
    };
    let own = "note: using the labs in `labs` and the course staff's part in `reference`\n";
    graded("", &["hand-ins/s1/submission.rhai"], own);
    graded("", &["hand-ins/s1/src"], own);
    graded("", &["reference/01-kinematics/solution.rhai"], own);
    let above =
        "note: using the labs in `../../labs` and the course staff's part in `../../reference`\n";
    graded("hand-ins/s2", &["submission.rhai"], above);
    // from a folder of the labs themselves
    let of_parent =
        "note: using the labs in `..` and the course staff's part in `../../reference`\n";
    graded(
        "labs/01-kinematics",
        &["../../hand-ins/s2/submission.rhai"],
        of_parent,
    );
    // named, whatever lies there
    let named = "note: using the labs in `labs` and the course staff's part in `reference`\n";
    graded("hand-ins/s1", &["submission.rhai", "--labs", "labs"], named);
    let outside = ["hand-ins/s1/submission.rhai", "--reference", "reference"];
    graded("", &outside, own);
}

#[test]
fn a_course_that_was_handed_in_says_nothing() {
    let bed = bed();
    let course = |folder: &str| {
        let text = format!(
            "format = 1\ntitle = \"T\"\nroster = \"roster.csv\"\nsalt_file = \"salt\"\nlabs_folder = \"labs\"\n\
             reference = \"reference\"\n\n[[labs]]\nname = \"{LAB}\"\ndigest = \"\"\n"
        );
        bed.write(&format!("{folder}course.toml"), text);
        bed.write(&format!("{folder}salt"), "a salt of their own\n");
    };
    course("hand-ins/s1/");
    let beside = "the course `course.toml`";
    is_refused(&grade(&bed, "hand-ins/s1", &["submission.rhai"]), beside);
    // its salt alone would draw hidden cases that are known
    let named = [
        "submission.rhai",
        "--labs",
        "../../labs",
        "--reference",
        "../../reference",
    ];
    is_refused(&grade(&bed, "hand-ins/s1", &named), beside);
    is_refused(
        &grade(&bed, "hand-ins/s1", &["src/submission.rhai"]),
        "above it there is",
    );
    // that of the course is used, and its labs wherever the command runs
    course("");
    let ran = grade(&bed, "", &["hand-ins/s2/submission.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stderr
            .contains("note: the labs, staff part, salt are those of course.toml\n"),
        "{ran:?}"
    );
    is_refused(
        &grade(&bed, "hand-ins/s1", &["src/submission.rhai"]),
        "above it there is",
    );
}

/// A course without a folder of its own for the labs finds them from its own folder, and not from a hand-in in which somebody stands.
#[test]
fn a_course_has_its_own_labs_wherever_a_command_runs() {
    let bed = bed();
    let text = format!(
        "format = 1\ntitle = \"T\"\nroster = \"roster.csv\"\nreference = \"reference\"\npublic_solutions = true\n\n[[labs]]\nname = \"{LAB}\"\n"
    );
    bed.write("course.toml", text);
    bed.write("roster.csv", "id\ns1\n");
    let check = |folder: &str| {
        let ran = bed.run_in(&bed.path(folder), &["course", "check"]);
        let digest = ran.stdout.lines().find(|line| line.contains("digest = "));
        digest.unwrap_or_else(|| panic!("{ran:?}")).to_owned()
    };
    bed.edit(
        "hand-ins/s1/labs/01-kinematics/lab.toml",
        "zero_m = 5e-3",
        "zero_m = 5e-1",
    );
    assert_eq!(check("hand-ins/s1"), check(""));
}

#[cfg(unix)]
#[test]
fn no_link_in_the_path_of_a_submission_is_followed() {
    use std::os::unix::fs::symlink;
    let bed = bed();
    let link = |from: &Path, to: &str| symlink(from, bed.path(to)).expect("link");
    link(Path::new("../reference/01-kinematics"), "hand-ins/s9");
    link(&bed.path("reference"), "hand-ins/s2/up");
    for (path, words) in [
        (
            "hand-ins/s9/solution.rhai",
            "`hand-ins/s9`, in the path `hand-ins/s9/solution.rhai`, is a link to another folder",
        ),
        ("hand-ins/s9", "`hand-ins/s9` is a link to another folder"),
        (
            "hand-ins/s2/up/01-kinematics/solution.rhai",
            "`hand-ins/s2/up`, in the path",
        ),
        (
            "./hand-ins/s2/../s9/solution.rhai",
            "`hand-ins/s9`, in the path",
        ),
    ] {
        let ran = bed.run(&["grade", LAB, path]);
        assert_eq!(ran.code, Some(2), "{path}: {ran:?}");
        let stderr = ran.stderr.replace("\n  │ ", " ");
        assert!(stderr.contains(words), "{path}: {ran:?}");
        let absolute = bed.path(path).display().to_string();
        let ran = bed.run(&["grade", LAB, &absolute]);
        assert_eq!(ran.code, Some(2), "{absolute}: {ran:?}");
    }
    let ran = bed.run(&["submit", LAB, "hand-ins/s9/solution.rhai"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(!bed.path("out").exists());
    // a folder that was chosen may be reached by a link
    link(Path::new("."), "course");
    let ran = bed.run_in(
        &bed.path("course"),
        &["grade", LAB, "hand-ins/s2/submission.rhai"],
    );
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let above = "../../hand-ins/s2/submission.rhai";
    let ran = bed.run_in(&bed.path("labs/robots"), &["grade", LAB, above]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}
