//! A student's folder as `kinemark new` makes it: commands need no names there, each lab has its own report, and what a change brought is
//! said.

use crate::testbed::{TestBed, root};

fn begun() -> TestBed {
    let bed = TestBed::new();
    let ran = bed.run(&["new", "01"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("cd 01-kinematics"), "{ran:?}");
    bed
}

fn submission(case: &str) -> String {
    let path = root().join("tests/submissions/01-kinematics").join(case);
    std::fs::read_to_string(path.join("submission.rhai")).expect("a submission")
}

#[test]
fn commands_need_no_names_there() {
    let bed = begun();
    let folder = bed.path("01-kinematics");
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("report: out/report.html"), "{ran:?}");
    assert!(folder.join("out/grade.json").is_file());
    let ran = bed.run_in(&folder, &["hint"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run_in(&folder, &["submit"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // from the folder above, too; the report stays with its lab
    let ran = bed.run(&["grade", "01-kinematics/submission.rhai"]);
    assert!(
        ran.stdout.contains("report: 01-kinematics/out/report.html"),
        "{ran:?}"
    );
    assert!(!bed.path("out").exists());
}

#[test]
fn what_a_change_brought_is_said_and_the_best_is_kept() {
    let bed = begun();
    let folder = bed.path("01-kinematics");
    let grade = || bed.run_in(&folder, &["grade"]).stdout;
    assert!(!grade().contains("since the last grade"));
    // the same submission again
    assert!(!grade().contains("since the last grade"));
    bed.write("01-kinematics/submission.rhai", submission("good"));
    let said = grade();
    assert!(
        said.contains("since the last grade: 1 to 24 of 24 points (+23); fk/position +5;"),
        "{said}"
    );
    bed.write("01-kinematics/submission.rhai", submission("millimetres"));
    let said = grade();
    assert!(said.contains("; fk/position -5"), "{said}");
    assert!(said.contains("your best so far: 24\n"), "{said}");
    // the record and the report do not depend on it
    let record = std::fs::read(folder.join("out/grade.json")).expect("a record");
    std::fs::remove_file(folder.join(".kinemark-history.json")).expect("removed");
    let said = grade();
    assert!(!said.contains("since the last grade"), "{said}");
    assert_eq!(
        std::fs::read(folder.join("out/grade.json")).expect("a record"),
        record
    );
    // what is no history begins again, and says so
    bed.write("01-kinematics/.kinemark-history.json", "{");
    let ran = bed.run_in(&folder, &["grade"]);
    assert!(ran.stderr.contains("so it begins again"), "{ran:?}");
    assert_eq!(ran.code, Some(1), "{ran:?}");
}

#[test]
fn what_staff_grade_leaves_no_trace_in_a_students_folder() {
    let bed = begun();
    bed.copy_labs();
    let ran = bed.run(&["grade", "01-kinematics/submission.rhai"]);
    assert!(ran.stdout.contains("report: out/report.html"), "{ran:?}");
    assert!(
        ran.stdout.contains("graded on visible and hidden cases"),
        "{ran:?}"
    );
    let folder = bed.path("01-kinematics");
    assert!(!folder.join("out").exists());
    assert!(!folder.join(".kinemark-history.json").exists());
}

#[test]
fn an_editor_reads_a_line_for_each_thing_that_went_wrong() {
    let bed = begun();
    let folder = bed.path("01-kinematics");
    let short = || bed.run_in(&folder, &["grade", "--format", "short"]).stdout;
    bed.write(
        "01-kinematics/submission.rhai",
        "fn control(observation) {\n    let a = [];\n    a[1]\n}\n",
    );
    let said = short();
    assert!(
        said.starts_with("submission.rhai:3:7: error: warm-up: index 1 is past the end"),
        "{said}"
    );
    assert!(
        said.contains("\nsubmission.rhai:1:1: warning: warm-up/shoulder-turned: 0 of 1 points: joint `shoulder` did not move"),
        "{said}"
    );
    assert!(said.ends_with(" of 24 points, crashed\n"), "{said}");
    // a mistake of the whole file is said once
    bed.write(
        "01-kinematics/submission.rhai",
        "fn control(o) {\n    let = 1;\n}\n",
    );
    let said = short();
    assert!(said.starts_with("submission.rhai:2:"), "{said}");
    assert_eq!(said.lines().count(), 2, "{said}");
}

#[test]
fn the_list_of_labs_shows_how_far_each_is_and_what_is_next() {
    let bed = TestBed::new();
    let said = || bed.run(&[]).stdout;
    assert!(said().contains("Start with `kinemark new 00-step-response`."));
    let bed = begun();
    let said = || bed.run(&[]).stdout;
    assert!(said().contains("begun in 01-kinematics"), "{}", said());
    bed.write("01-kinematics/submission.rhai", submission("good"));
    let ran = bed.run_in(&bed.path("01-kinematics"), &["grade"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        said().contains("done in 01-kinematics: all points"),
        "{}",
        said()
    );
    assert!(
        said().contains("Next: `kinemark new 00-step-response`."),
        "{}",
        said()
    );
}

#[test]
fn a_slip_in_a_name_or_in_its_file_is_answered() {
    let bed = begun();
    let ran = bed.run(&["grade", "0", "01-kinematics/submission.rhai"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("`0` may be `00-step-response` or"),
        "{ran:?}"
    );
    let folder = bed.path("01-kinematics");
    bed.write("01-kinematics/kinemark.toml", "lap = \"01-kinematics\"\n");
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("unknown field `lap`"), "{ran:?}");
    bed.write(
        "01-kinematics/kinemark.toml",
        "lab = \"01-kinematics\"\nvariant = \"ada\"\n",
    );
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("there is no variant.toml"), "{ran:?}");
    // who names the lab needs no such file
    let ran = bed.run_in(&folder, &["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
}
