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
        said.contains("since the last grade: 0 to 24 of 24 points (+24); fk/position +6;"),
        "{said}"
    );
    // what can still be better is worth no points: the same run, and one that waits longer
    assert!(said.contains("\nfull marks. "), "{said}");
    assert!(said.contains("\n  move: at rest after "), "{said}");
    assert!(!said.contains("your best"), "{said}");
    let slower = submission("good").replace("time < 2.5", "time < 3.1");
    bed.write("01-kinematics/submission.rhai", slower);
    let said = grade();
    assert!(
        said.contains("at rest after ") && said.contains(" (your best: "),
        "{said}"
    );
    bed.write("01-kinematics/submission.rhai", submission("millimetres"));
    let said = grade();
    assert!(!said.contains("full marks"), "{said}");
    assert!(said.contains("; fk/position -6"), "{said}");
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
        "fn control(observation) {\n    let a = [];\n    a[1]\n}\nfn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\nfn inverse_kinematics(robot, p) { [] }\n",
    );
    let said = short();
    assert!(
        said.contains("submission.rhai:3:7: error: move: index 1 is past the end"),
        "{said}"
    );
    assert!(
        said.contains("\nsubmission.rhai:1:1: warning: move/pose-reached: 0 of 5 points: "),
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
    // and what else is wrong in it, each in its line
    bed.write(
        "01-kinematics/submission.rhai",
        "fn control(o) {\n    let = 1;\n    let x = 2^3;\n    n = 1;\n}\n",
    );
    let said = short();
    let places: Vec<&str> = said
        .lines()
        .map(|line| line.split(": ").next().unwrap_or_default())
        .collect();
    assert_eq!(
        places[..3],
        [
            "submission.rhai:2:9",
            "submission.rhai:3:1",
            "submission.rhai:4:1"
        ],
        "{said}"
    );
}

/// What VS Code lists under Problems: file, line, column, severity and message, as the task in `.vscode/tasks.json` reads them.
fn problems(bed: &TestBed) -> Vec<[String; 5]> {
    let folder = bed.path("01-kinematics");
    let tasks = std::fs::read(folder.join(".vscode/tasks.json")).expect("tasks");
    let tasks: serde_json::Value = serde_json::from_slice(&tasks).expect("JSON");
    let task = &tasks["tasks"][0];
    assert_eq!(task["command"], "kinemark");
    let options = task["args"].as_array().expect("options").iter();
    let options: Vec<&str> = options.filter_map(serde_json::Value::as_str).collect();
    let pattern = &task["problemMatcher"]["pattern"];
    let line = regex::Regex::new(pattern["regexp"].as_str().expect("a pattern")).expect("a regexp");
    let group = |name: &str| usize::try_from(pattern[name].as_u64().expect(name)).expect("small");
    let groups = ["file", "line", "column", "severity", "message"].map(group);
    let said = bed.run_in(&folder, &options).stdout;
    let found = said.lines().filter_map(|text| line.captures(text));
    found
        .map(|parts| groups.map(|group| parts[group].to_owned()))
        .collect()
}

#[test]
fn the_task_of_an_editor_reads_what_a_grade_prints() {
    let bed = begun();
    bed.write(
        "01-kinematics/submission.rhai",
        "fn control(observation) {\n    let a = [];\n    a[1]\n}\nfn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\nfn inverse_kinematics(robot, p) { [] }\n",
    );
    let found = problems(&bed);
    let first = found.iter().find(|problem| problem[3] == "error");
    let first = first.expect("an error");
    assert_eq!(
        first[..4],
        ["submission.rhai", "3", "7", "error"].map(str::to_owned),
        "{first:?}"
    );
    assert!(first[4].contains("index 1 is past the end"), "{first:?}");
    assert!(found.iter().any(|problem| problem[3] == "warning"));
    bed.write("01-kinematics/submission.rhai", submission("good"));
    assert_eq!(problems(&bed), Vec::<[String; 5]>::new());
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
    assert!(ran.stderr.contains("unknown key `lap`"), "{ran:?}");
    assert!(ran.stderr.contains("did you mean `lab`?"), "{ran:?}");
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
