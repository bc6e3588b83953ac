//! `kinemark verify`: a report holds what its submission does, or the first difference is named.

use kinemark_grader::record::grade::{Grade, GradeMode, Outcome, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::output::{digest, json as written};
use serde_json::{Value as Json, json};

use crate::testbed::{CommandResult, TestBed, copy, root};

fn graded() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    let submission = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(submission, bed.path("mine.rhai")).expect("copied");
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    bed
}

/// The same in practice.
fn practised() -> TestBed {
    let bed = TestBed::a_little_off();
    practise(&bed, &[]);
    bed
}

/// Grades the submission that is a little off in practice.
fn practise(bed: &TestBed, args: &[&str]) {
    let grade = ["grade", "01-kinematics", "submission.rhai", "--practice"];
    let ran = bed.run(&[&grade[..], args].concat());
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
}

/// Verifies `out`, whose comparison ends with a code and is described in these words.
fn verified(bed: &TestBed, args: &[&str], code: i32, words: &str) -> CommandResult {
    let ran = bed.run(&[&["verify", "out"], args].concat());
    assert_eq!(ran.code, Some(code), "{args:?}: {ran:?}");
    assert!(
        ran.stdout.contains(words),
        "{args:?}: no {words:?} in {ran:?}"
    );
    ran
}

/// Changes the record of `out` by hand, and the list of files with it, as somebody would who knows both.
fn forge(bed: &TestBed, change: impl FnOnce(&mut Grade)) {
    let path = bed.path("out/grade.json");
    let before = std::fs::read(&path).expect("a record");
    let mut grade: Grade = serde_json::from_slice(&before).expect("a record");
    change(&mut grade);
    let after = written(&grade).expect("JSON");
    bed.edit(
        "out/report.json",
        &digest(&before),
        &digest(after.as_bytes()),
    );
    std::fs::write(path, after).expect("written");
}

#[test]
fn an_untouched_report_holds() {
    let bed = graded();
    let head = "graded report: 01-kinematics, mine.rhai, default variant: 24 of 24 points\n\
                compared with the labs in `labs` and the course staff's part in `reference`\n\
                same bits: 3 of 3 tasks, ";
    let ran = verified(&bed, &["--graded", "--labs", "labs"], 0, head);
    assert!(ran.stdout.starts_with(head), "{ran:?}");
    let ran = verified(&bed, &["--json"], 0, "\"result\": \"same\"");
    let comparison: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    for (key, value) in [
        ("/mode", json!("graded")),
        ("/points", json!(24.0)),
        ("/points_again", json!(24.0)),
        ("/compared/tasks", json!(3)),
        ("/compared_with/labs", json!("labs")),
        ("/not_compared", json!([])),
    ] {
        assert_eq!(comparison.pointer(key), Some(&value), "{key}");
    }
    // without the course staff's part what is visible can still be compared
    let with_practice = verified(&bed, &["--practice"], 5, "24 of 24 points as recorded\n");
    std::fs::rename(bed.path("reference"), bed.path("away")).expect("moved");
    let without = verified(&bed, &[], 5, "not compared: reference: ");
    for ran in [with_practice, without] {
        for words in [
            "compared with the labs in `labs`\n",
            "not compared: hidden cases of task `fk`: ",
            "not compared: hidden runs of task `move`: ",
            "not compared: checks that compare with the reference solution of task `move`: ",
            "the same as far as it could be compared: 0 of 3 tasks, 3 in part, ",
        ] {
            assert!(ran.stdout.contains(words), "no {words:?} in {ran:?}");
        }
    }
    let ran = verified(&bed, &["--json"], 5, "\"result\": \"partly-compared\"");
    let comparison: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(comparison["same"], false);
    assert_eq!(comparison["points_again"], Json::Null);
    assert_eq!(comparison["not_compared"][0]["what"], "reference");
}

#[test]
fn a_practice_report_says_so_and_passes_for_no_graded_one() {
    let bed = practised();
    let head = "practice report, visible cases only: 01-kinematics, submission.rhai";
    let ran = verified(&bed, &[], 0, "\nsame bits: 3 of 3 tasks");
    assert!(ran.stdout.starts_with(head), "{ran:?}");
    let why = "it is a practice report, in which hidden cases have no part";
    verified(&bed, &["--graded", "--labs", "labs"], 1, why);
    // relabelled, with and without a reference that was never there
    forge(&bed, |grade| grade.mode = GradeMode::Graded);
    verified(&bed, &[], 1, "differs: reference\n  recorded none\n");
    verified(&bed, &["--practice"], 1, "differs: record at `mode`");
    forge(&bed, |grade| grade.reference = Some(grade.lab.clone()));
    verified(
        &bed,
        &["--graded", "--labs", "labs"],
        1,
        "differs: reference",
    );
    // nobody can say without the course staff's part, which is no pass
    verified(&bed, &["--practice"], 5, "not compared: reference: ");
}

/// Whoever makes the lab easier for himself makes another lab, whatever else is right in the report.
#[test]
fn a_report_of_an_eased_lab_is_none_of_the_course() {
    let bed = graded();
    bed.write(
        "zero.rhai",
        "fn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\n",
    );
    copy(&bed.path("labs"), &bed.path("easy"));
    let lab = "easy/01-kinematics/lab.toml";
    bed.edit(
        lab,
        "fk-error = { full_m = 1e-4, zero_m = 5e-3 }",
        "fk-error = { full_m = 50.0, zero_m = 60.0 }",
    );
    for (args, mode) in [
        (&["--practice"][..], "practice"),
        (&["--reference", "reference"], "graded"),
    ] {
        let grade = ["grade", "01-kinematics", "zero.rhai", "--labs", "easy"];
        let ran = bed.run(&[&grade[..], args].concat());
        assert!(ran.stdout.contains("6 of "), "{ran:?}");
        for args in [&["--labs", "labs"][..], &["--practice"], &[]] {
            let ran = verified(&bed, args, 1, "the lab is not the course's (lab)\n");
            assert!(
                ran.stdout.contains("file `lab/01-kinematics/lab.toml`"),
                "{ran:?}"
            );
            assert!(ran.stdout.contains(mode), "{ran:?}");
        }
        // the lab that it is of
        verified(
            &bed,
            &["--labs", "easy", "--reference", "reference"],
            0,
            "same bits",
        );
    }
    // with the digest of the course's lab in the record, it is graded in the course's lab
    let true_lab = bed.run(&[
        "grade",
        "01-kinematics",
        "zero.rhai",
        "--out",
        "true",
        "--json",
    ]);
    let true_lab: Grade = serde_json::from_str(&true_lab.stdout).expect("a record");
    forge(&bed, |grade| grade.lab = true_lab.lab);
    verified(
        &bed,
        &["--reference", "reference"],
        1,
        "differs: record at `",
    );
    verified(&bed, &["--practice"], 1, "differs: record at `tasks[0].");

    // the course in whose folder one stands has its own folder of labs, and somebody else may be anywhere
    bed.write(
        "course.toml",
        "format = 1\ntitle = \"R\"\nlabs_folder = \"easy\"\nreference = \"reference\"\n[[labs]]\nname = \"01-kinematics\"\n",
    );
    std::fs::create_dir(bed.path("inbox")).expect("a folder");
    std::fs::rename(bed.path("zero.rhai"), bed.path("inbox/zero.rhai")).expect("moved");
    let ran = bed.run_in(
        &bed.path(""),
        &["grade", "01-kinematics", "inbox/zero.rhai"],
    );
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let ran = verified(&bed, &[], 0, "compared with the labs in `easy`");
    assert!(ran.stderr.contains("those of course.toml"), "{ran:?}");
    std::fs::remove_file(bed.path("course.toml")).expect("removed");
    std::fs::rename(bed.path("labs"), bed.path("away")).expect("moved");
    verified(
        &bed,
        &["--practice"],
        1,
        "the lab is not the course's (lab)\n",
    );
    verified(
        &bed,
        &["--practice"],
        1,
        "compared with the labs built in\n",
    );
}

#[test]
fn a_changed_robot_scene_or_path_is_named() {
    let bed = practised();
    copy(&bed.path("labs"), &bed.path("easy"));
    for (file, from, to, part) in [
        (
            "robots/rrbot.toml",
            "damping = 0.7",
            "damping = 0.8",
            "robot",
        ),
        (
            "01-kinematics/practice.json",
            "\"time\":",
            "\"time\":1",
            "lab",
        ),
        (
            "01-kinematics/lab.toml",
            "title = \"W",
            "title = \"V",
            "lab",
        ),
    ] {
        let text = std::fs::read_to_string(bed.path("easy").join(file)).expect("a file");
        bed.edit(&format!("easy/{file}"), from, to);
        practise(&bed, &["--labs", "easy"]);
        bed.write(&format!("easy/{file}"), text);
        let ran = verified(
            &bed,
            &[],
            1,
            &format!("the lab is not the course's ({part})\n"),
        );
        assert!(
            ran.stdout.contains(&format!("differs: file `lab/{file}`")),
            "{ran:?}"
        );
    }
    let submission = root().join("tests/submissions/03-knock-with-position/good/submission.rhai");
    std::fs::copy(submission, bed.path("knock.rhai")).expect("copied");
    bed.edit(
        "easy/scenes/shelf-and-can.toml",
        "friction = ",
        "friction = 1",
    );
    let grade = [
        "grade",
        "03-knock-with-position",
        "knock.rhai",
        "--practice",
    ];
    bed.run(&[&grade[..], &["--labs", "easy"]].concat());
    verified(
        &bed,
        &[],
        1,
        "the lab is not the course's (scene `shelf-and-can`)\n",
    );
}

#[test]
fn a_lab_that_the_course_does_not_have_is_not_compared() {
    let bed = practised();
    bed.copy_labs();
    std::fs::rename(bed.path("labs/01-kinematics"), bed.path("away")).expect("moved");
    let ran = verified(
        &bed,
        &[],
        5,
        "not compared: lab: there is no lab `01-kinematics` in labs",
    );
    assert!(ran.stdout.contains("3 of 3 tasks"), "{ran:?}");
    bed.edit(
        "out/lab/01-kinematics/lab.toml",
        "points = 6.0",
        "points = 7.0",
    );
    verified(&bed, &[], 1, "differs: lab");
    // compared with itself every report is right
    for args in [&["--labs", "out/lab"][..], &["--reference", "out"]] {
        let ran = bed.run(&[&["verify", "out"], args].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains("lies in the report"), "{ran:?}");
    }
    copy(&bed.path("out/lab"), &bed.path("out/labs"));
    let ran = bed.run_in(&bed.path("out"), &["verify", "."]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}

/// Points raised with all that follows from them: the record agrees with itself, and not with the runs that anybody can repeat.
#[test]
fn points_raised_by_hand_are_found_without_the_staffs_part() {
    let bed = TestBed::a_little_off();
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let record = std::fs::read(bed.path("out/grade.json")).expect("a record");
    let list = std::fs::read(bed.path("out/report.json")).expect("a list");
    verified(&bed, &["--practice"], 5, "not compared: ");
    // sums and outcomes, and nothing else
    let raise = |task: &mut TaskGrade| {
        for check in &mut task.checks {
            check.points = check.max_points;
            check.outcome = Outcome::Full;
        }
        task.points = task.max_points;
        task.verdict = Verdict::Passed;
    };
    let sum = |grade: &mut Grade| {
        grade.points = grade.tasks.iter().map(|task| task.points).sum();
        grade.verdict = Verdict::Passed;
    };
    type Change<'c> = &'c dyn Fn(&mut Grade);
    let forged: [(Change<'_>, &str); 4] = [
        (
            &|grade| {
                grade.tasks.iter_mut().for_each(raise);
                sum(grade);
            },
            "record at `tasks[2].",
        ),
        // the reasons with them
        (
            &|grade| {
                grade.tasks.iter_mut().for_each(raise);
                for check in grade.tasks.iter_mut().flat_map(|task| &mut task.checks) {
                    check.evidence.clear();
                    (check.next_step, check.first_lost) = (None, None);
                }
                grade.tasks[2]
                    .hidden
                    .iter_mut()
                    .for_each(|class| class.good = class.total);
                sum(grade);
            },
            "record at `tasks[2].checks[0].first_lost`",
        ),
        (
            &|grade| grade.tasks[0].cases[0].good = false,
            "record at `tasks[0].cases[0].good`",
        ),
        (
            &|grade| grade.tasks[2].operations += 1,
            "record at `tasks[2].operations`",
        ),
    ];
    for (change, place) in forged {
        std::fs::write(bed.path("out/grade.json"), &record).expect("written");
        std::fs::write(bed.path("out/report.json"), &list).expect("written");
        forge(&bed, change);
        verified(&bed, &["--practice"], 1, place);
        verified(&bed, &[], 1, "this report does not match");
    }
}

#[test]
fn what_a_record_says_steers_no_terminal() {
    let bed = practised();
    forge(&bed, |grade| {
        grade.engine = "\u{1b}[2J\u{1b}[Hsame bits\u{202e}\u{9b}2J".to_owned();
        grade.submission.name = "\u{1b}]0;x\u{7}.rhai".to_owned();
        grade.tasks[0].name = "fk\u{1b}[8m".to_owned();
    });
    for args in [&[][..], &["--json"], &["--practice"]] {
        let ran = verified(&bed, args, 1, "\u{27e8}U+001B\u{27e9}[2J");
        for text in [&ran.stdout, &ran.stderr] {
            let steers = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
            assert!(!text.contains(steers), "{args:?}: {text:?}");
        }
    }
}

#[test]
fn a_changed_submission_is_found_with_second_and_signal() {
    let bed = graded();
    bed.edit("out/submission.rhai", "time < 2.5", "time < 2.6");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let verdict = "this report does not match: the submission was changed after grading\n";
    assert!(ran.stdout.starts_with(verdict), "{ran:?}");
    assert!(ran.stdout.contains("\ndiffers: submission\n"), "{ran:?}");
    // the second move starts at 2.6 s instead of 2.5 s: the command differs in second 2 (as do q and qd), and q is reported first
    assert!(
        ran.stdout
            .contains("trace of task `move`, first in second 2, signal `q`"),
        "{ran:?}"
    );
    let ran = bed.run(&["verify", "out", "--json"]);
    let comparison: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(comparison["same"], false);
}

#[test]
fn a_forged_grade_is_found() {
    let bed = graded();
    bed.edit("out/grade.json", "\"points\": 24.0", "\"points\": 25.0");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout
            .contains("differs: record at `points`\n  recorded 25.0\n  now      24.0\n"),
        "{ran:?}"
    );
}

#[test]
fn a_grade_that_contradicts_itself_is_found_without_the_staffs_part() {
    for (from, to, differs) in [
        (
            "\"points\": 24.0",
            "\"points\": 25.0",
            "`points`\n  recorded 25\n  now      24",
        ),
        (
            "\"max_points\": 24.0",
            "\"max_points\": 30.0",
            "`max_points`",
        ),
        (
            "\"outcome\": \"full\",\n          \"points\": 5.0",
            "\"outcome\": \"none\",\n          \"points\": 5.0",
            "`tasks[1].checks[0].outcome`",
        ),
        (
            "\"points\": 10.0,\n      \"max_points\": 10.0",
            "\"points\": 9.0,\n      \"max_points\": 10.0",
            "`tasks[2].points`\n  recorded 9\n  now      10",
        ),
        (
            "\"verdict\": \"passed\",\n  \"points\"",
            "\"verdict\": \"missed\",\n  \"points\"",
            "`verdict`\n  recorded missed",
        ),
    ] {
        let bed = graded();
        bed.edit("out/grade.json", from, to);
        let ran = bed.run(&["verify", "out", "--practice"]);
        assert_eq!(ran.code, Some(1), "{to}: {ran:?}");
        assert!(ran.stdout.contains(differs), "{to}: {ran:?}");
    }
}

#[test]
fn a_changed_page_or_plot_is_found() {
    let bed = graded();
    bed.edit("out/report.html", "</body>", "<p>25 points</p></body>");
    std::fs::remove_file(bed.path("out/plots/move-path.svg")).expect("removed");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("differs: file `report.html`"),
        "{ran:?}"
    );
    assert!(
        ran.stdout
            .contains("differs: file `plots/move-path.svg`\n  in the folder: missing"),
        "{ran:?}"
    );
}

#[test]
fn a_changed_list_of_files_is_found() {
    let bed = graded();
    let ran = |what: &str| {
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.stdout.contains(what), "{ran:?}");
    };
    bed.edit("out/report.json", "\"png\": false", "\"png\": true");
    ran("file `plots/move-path.png`\n  in the folder: missing\n  now      a picture\n");
    bed.edit("out/report.json", "\"png\": true", "\"png\": false");
    bed.edit(
        "out/report.json",
        "submission.rhai\": \"",
        "submission.rhai\": \"0",
    );
    ran("digest of `submission.rhai` in `report.json`");
    bed.edit(
        "out/report.json",
        "submission.rhai\": \"0",
        "submission.rhai\": \"",
    );
    bed.edit(
        "out/report.json",
        "\"files\": {",
        "\"files\": { \"notes.txt\": \"\",",
    );
    ran("list of files in `report.json`: `notes.txt`");
    bed.edit("out/report.json", "kinemark-report/1", "kinemark-report/7");
    let other = bed.run(&["verify", "out"]);
    assert_eq!(other.code, Some(3), "{other:?}");
    assert!(other.stderr.contains("kinemark-report/7"), "{other:?}");
}

#[test]
fn what_is_no_report_is_said_so() {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["verify", "nowhere"]).code, Some(2));
    bed.write("folder/file", "");
    assert_eq!(bed.run(&["verify", "folder"]).code, Some(3));
    bed.write("folder/grade.json", "{}");
    let ran = bed.run(&["verify", "folder"]);
    assert_eq!(ran.code, Some(3));
    assert!(ran.stderr.contains("not a grade record"), "{ran:?}");
}
