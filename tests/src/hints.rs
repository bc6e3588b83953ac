//! Hints in steps: a grade asks, `kinemark hint` unfolds, and what goes back from the course staff has all of it.

use kinemark_grader::record::hints::{CheckHints, Hints};
use serde_json::Value as Json;

use crate::course_class;
use crate::testbed::{CommandResult, TestBed, files_below, lab, root};

const LAB: &str = "95-hints";
/// A lab with a check of three hints, one of two, one without any, and a motion task.
const LAB_FILE: &str = r#"
format = 1
name = "95-hints"
title = "Hints"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "fk"
title = "Forward kinematics"
function = { call = "forward_kinematics", cases = [{ name = "up", q_rad = [0.0, 0.0] }] }

[[tasks.checks]]
name = "near"
title = "About right"
points = 1.0
hints = ["Which way is up?", "Draw the arm with all angles zero.", "Return the lab's x axis first."]
fk-error = { full_m = 1e-2, zero_m = 1e-1 }

[[tasks.checks]]
name = "exact"
title = "Right"
points = 1.0
hints = ["What is left over?", "Add `robot.base_height`."]
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "turn"
title = "Turn one joint"
motion = { mode = "position", duration_s = 1.0, control_period_ms = 10.0, servo = { kp = 100.0, kd = 10.0 } }

[[tasks.checks]]
name = "shoulder"
title = "The shoulder stands at 0.5 rad"
points = 1.0
hints = ["Which angle is commanded?", "Return `[0.5, 0.0]` from `control`."]
joint-reached = { joint = "shoulder", position_rad = 0.5, hold_s = 0.2, full_rad = 0.01, zero_rad = 0.1 }

[[tasks.checks]]
name = "calm"
title = "Without a swing"
points = 1.0
joint-speed = { full_rad_s = 10.0, zero_rad_s = 20.0 }
"#;
/// What no file of a report may have.
const BEHIND_QUESTIONS: [&str; 4] = [
    "Draw the arm with all angles",
    "the lab's x axis first",
    "robot.base_height",
    "0.5, 0.0]` from",
];
const WRONG: &str =
    "fn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\nfn control(observation) { [0.0, 0.0] }\n";

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write(&format!("labs/{LAB}/lab.toml"), LAB_FILE);
    bed.write("submission.rhai", WRONG);
    bed
}

fn graded() -> TestBed {
    let bed = bed();
    let ran = bed.run(&["grade", LAB, "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    bed
}

/// `kinemark hint` in the folder of the lab's submission.
fn hint(bed: &TestBed, args: &[&str]) -> CommandResult {
    bed.run(&[&["hint"], args].concat())
}

/// What `kinemark hint` prints, which ends well.
fn shown(bed: &TestBed, args: &[&str]) -> String {
    let ran = hint(bed, args);
    assert_eq!(ran.code, Some(0), "{args:?}: {ran:?}");
    ran.stdout
}

/// What is behind the questions of a lab's checks, by parts that no format writes otherwise and that say enough to be a remedy.
fn remedies(hints: &Hints) -> Vec<String> {
    let steps = hints.checks().iter().flat_map(|check| &check.hints[1..]);
    let parts = steps.filter_map(|step| {
        let plain = |c: char| c.is_alphanumeric() || " ,.:".contains(c);
        let parts = step.split(|c| !plain(c)).map(str::trim);
        let longest = parts.max_by_key(|part| part.len());
        longest.filter(|part| part.len() > 20).map(str::to_owned)
    });
    parts.collect()
}

fn no_file_has(bed: &TestBed, folder: &str, parts: &[String]) {
    let files = files_below(&bed.path(folder));
    assert!(files.iter().any(|(path, _)| path.ends_with("lab.toml")));
    for (path, bytes) in files {
        let text = String::from_utf8_lossy(&bytes);
        for part in parts {
            assert!(!text.contains(part), "{path} has {part}");
        }
    }
}

#[test]
fn a_grade_asks_and_names_the_command_that_goes_on() {
    let bed = graded();
    let grade = bed.run(&["grade", LAB, "submission.rhai", "-v"]).stdout;
    for line in [
        "next: Which way is up?  (kinemark hint fk/near)\n",
        "next: What is left over?  (kinemark hint fk/exact)\n",
        "next: Which angle is commanded?  (kinemark hint turn/shoulder)\n",
    ] {
        assert!(grade.contains(line), "{line}{grade}");
    }
    let record = std::fs::read_to_string(bed.path("out/grade.json")).expect("a record");
    let record: Json = serde_json::from_str(&record).expect("JSON");
    let has_hints = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(task, check)| {
        let check = &record["tasks"][task]["checks"][check];
        check["has_hints"].as_bool()
    });
    assert_eq!(has_hints, [Some(true), Some(true), Some(true), None]);
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
    assert!(page.contains("<code>kinemark hint fk/near</code>"));
    let parts = BEHIND_QUESTIONS.map(str::to_owned);
    no_file_has(&bed, "out", &parts);
    // the lab of the report has the questions alone, and is the same lab
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // unfolding changes nothing of it
    shown(&bed, &["fk/near", "--all"]);
    let again = bed.run(&["grade", LAB, "submission.rhai", "-v"]).stdout;
    assert_eq!(again, grade);
    no_file_has(&bed, "out", &parts);
}

#[test]
fn no_file_of_a_graded_report_has_a_remedy() {
    let bed = TestBed::new();
    bed.copy_labs();
    std::fs::copy(
        bed.path("labs/01-kinematics/starter.rhai"),
        bed.path("submission.rhai"),
    )
    .expect("a starter");
    let parts = remedies(&lab("01-kinematics").hints());
    assert!(parts.len() > 1, "{parts:?}");
    for more in [&["--practice"][..], &[], &["--storyboard"]] {
        let args = [&["grade", "01-kinematics", "submission.rhai"], more].concat();
        let ran = bed.run(&args);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(
            ran.stdout.contains("(kinemark hint fk/position)"),
            "{ran:?}"
        );
        for part in &parts {
            assert!(!ran.stdout.contains(part), "{part}");
        }
        no_file_has(&bed, "out", &parts);
    }
}

#[test]
fn each_call_unfolds_one_step_and_says_which_is_the_last() {
    let bed = graded();
    let name = format!("submission of {LAB}");
    let first = shown(&bed, &[]);
    assert!(
        first.starts_with("About right (fk/near), which lost points in the last report\n"),
        "{name}: {first}"
    );
    assert!(first.contains("Hint 1 of 3 for fk/near: Which way is up?\n"));
    assert!(first.contains("the next one: kinemark hint fk/near\n"));
    let second = shown(&bed, &["fk/near"]);
    assert!(second.contains("Hint 2 of 3 for fk/near: Draw the arm"));
    assert!(!second.contains("Which way") && !second.contains("x axis"));
    let third = shown(&bed, &["fk"]);
    assert!(third.contains("Hint 3 of 3 for fk/near: Return the lab's"));
    assert!(third.contains("That was the last one.\n"), "{third}");
    assert!(third.contains("another check: kinemark hint fk/exact\n"));
    let again = shown(&bed, &["fk/near"]);
    assert!(again.contains("Hint 3 of 3 for fk/near: Return the lab's"));
    assert!(again.contains("all of them: kinemark hint fk/near --all\n"));
    // each check has its own count
    assert!(shown(&bed, &["turn"]).contains("Hint 1 of 2 for turn/shoulder"));
    assert!(shown(&bed, &["fk/near", "--restart"]).contains("Hint 1 of 3"));
    assert!(shown(&bed, &["fk/near"]).contains("Hint 2 of 3"));
    let all = shown(&bed, &["fk/exact", "--all"]);
    assert!(all.contains("Hint 1 of 2 for") && all.contains("Hint 2 of 2 for"));
    let json = shown(&bed, &["fk/near", "--json"]);
    let json: Json = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["hints"].as_array().map(Vec::len), Some(3));
    assert_eq!(
        (&json["task"], &json["check"], &json["unfolded"]),
        (&"fk".into(), &"near".into(), &3.into())
    );
    assert_eq!((&json["of"], &json["is_last"]), (&3.into(), &true.into()));
}

#[test]
fn without_a_report_the_checks_are_listed() {
    let bed = bed();
    let in_lab = ["--lab", LAB];
    let list = shown(&bed, &in_lab);
    for line in [
        "  fk/near        0 of 3  About right\n",
        "  turn/shoulder  0 of 2  The shoulder stands at 0.5 rad\n",
        "Show one with `kinemark hint fk/near --lab 95-hints`.\n",
    ] {
        assert!(list.contains(line), "{line}{list}");
    }
    assert!(!list.contains("turn/calm"), "{list}");
    // a list unfolds nothing; a task with one check is that check
    assert!(!bed.path(".kinemark-hints.json").exists());
    let of_task = shown(&bed, &[&["fk"], &in_lab[..]].concat());
    assert!(of_task.contains("fk/exact") && !of_task.contains("turn/"));
    let only = shown(&bed, &[&["turn"], &in_lab[..]].concat());
    assert!(only.contains("Hint 1 of 2 for turn/shoulder: Which angle"));
    assert!(only.contains("the next one: kinemark hint turn/shoulder --lab 95-hints\n"));
    let json = shown(&bed, &[&["--json"], &in_lab[..]].concat());
    let json: Json = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["checks"].as_array().map(Vec::len), Some(3));
    assert_eq!(json["checks"][2]["unfolded"], 1);
    shown(&bed, &[&["--restart"], &in_lab[..]].concat());
    assert!(shown(&bed, &in_lab).contains("turn/shoulder  0 of 2"));
}

#[test]
fn slips_of_the_keyboard_are_answered() {
    let bed = graded();
    for (args, message, help) in [
        (&["fk/neer"][..], "no check `neer`", "did you mean `near`?"),
        (&["fg"], "no task `fg`", "did you mean `fk`?"),
        (&["near"], "no task `near`", "the check `fk/near`"),
        (&["turn/calm"], "`turn/calm` has no hints", "shoulder"),
        (
            &["--lab", "95-hinds"],
            "no lab is",
            "did you mean `95-hints`?",
        ),
    ] {
        let ran = hint(&bed, args);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains(message), "{ran:?}");
        assert!(ran.stderr.contains(help), "{ran:?}");
    }
    let ran = bed.run(&["hint", "--all", "--lab", "01-kinematics"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("--all needs a check"), "{ran:?}");
    std::fs::remove_dir_all(bed.path("out")).expect("removed");
    let ran = hint(&bed, &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("which lab this is"), "{ran:?}");
    bed.edit(&format!("labs/{LAB}/lab.toml"), "Which way is up?", "Up.");
    let ran = hint(&bed, &["--lab", LAB]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("must end with `?`"), "{ran:?}");
}

/// Begins again, and says so.
#[test]
fn a_broken_count_is_a_fresh_start() {
    let bed = graded();
    shown(&bed, &[]);
    for broken in [
        &b"{"[..],
        b"\xff",
        b"{\"format\":\"kinemark-hints/9\",\"unfolded\":{}}",
        b"{\"format\":\"kinemark-hints/1\",\"unfolded\":{\"95-hints\":{\"fk/near\":-1}}}",
    ] {
        bed.write(".kinemark-hints.json", broken);
        let ran = hint(&bed, &[]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(ran.stdout.contains("Hint 1 of 3"), "{ran:?}");
        assert!(
            ran.stderr
                .contains("`.kinemark-hints.json` cannot be read, so the hints begin again"),
            "{ran:?}"
        );
        assert!(shown(&bed, &[]).contains("Hint 2 of 3"));
    }
    // more than there are
    let many = "{\"format\":\"kinemark-hints/1\",\"unfolded\":{\"95-hints\":{\"fk/near\":99}}}";
    bed.write(".kinemark-hints.json", many);
    assert!(shown(&bed, &[]).contains("Hint 3 of 3"));
}

/// The folder that `kinemark new` writes, and the file that is uploaded from it.
#[test]
fn hints_are_beside_the_submission_and_not_handed_in() {
    let bed = TestBed::new();
    let lab_name = "01-kinematics";
    assert_eq!(bed.run(&["new", lab_name]).code, Some(0));
    let student = |args: &[&str]| -> CommandResult {
        let mut command = bed.command(args);
        command.current_dir(bed.path(lab_name));
        command.output().expect("the binary runs").into()
    };
    let ran = student(&["hint", "fk/position", "--all"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(bed.path(lab_name).join(".kinemark-hints.json").is_file());
    // from above the same folder is meant
    let ran = bed.run(&["hint", "--lab", lab_name]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let all = lab(lab_name).hints().of("fk", "position").len();
    let unfolded = format!("{all} of {all}");
    let line = ran.stdout.lines().find(|line| line.contains("fk/position"));
    assert!(line.expect("a line").contains(&unfolded), "{ran:?}");
    let submit = |bed: &TestBed| {
        assert_eq!(student(&["submit"]).code, Some(0));
        std::fs::read(bed.path(lab_name).join("01-kinematics.kinemark")).expect("a hand-in")
    };
    let after = submit(&bed);
    std::fs::remove_file(bed.path(lab_name).join(".kinemark-hints.json")).expect("removed");
    assert_eq!(submit(&bed), after);
}

/// A lab of the course with the old key is refused, and the message says what to write.
#[test]
fn the_earlier_key_is_refused_at_its_place() {
    let bed = bed();
    let file = format!("labs/{LAB}/lab.toml");
    bed.edit(
        &file,
        "hints = [\"What is left over?\", \"Add `robot.base_height`.\"]",
        "hint = \"Add `robot.base_height`.\"",
    );
    let ran = bed.run(&["grade", LAB, "submission.rhai"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    for words in ["`hint` is now `hints`, a list", "95-hints/lab.toml:24:8"] {
        assert!(ran.stderr.contains(words), "{words}: {ran:?}");
    }
}

#[test]
fn released_feedback_has_all_hints_of_what_lost_points() {
    let bed = course_class::class();
    course_class::grade(&bed, &[]);
    let name = course_class::LAB;
    // s101 takes degrees for radians
    let ran = bed.run(&["course", "explain", "s101", name, "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let explained: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let hints = lab(name).hints();
    let lost: Vec<&CheckHints> = hints
        .checks()
        .iter()
        .filter(|check| {
            let mut listed = explained["hints"].as_array().expect("hints").iter();
            listed.any(|of| of["task"] == check.task[..] && of["check"] == check.check[..])
        })
        .collect();
    assert!(!lost.is_empty() && lost.len() < hints.checks().len());
    let text = bed.run(&["course", "explain", "s101", name, "--out", "pages"]);
    let page = std::fs::read_to_string(bed.path("pages/explained.html")).expect("a page");
    let ran = bed.run(&["course", "release", name, "--to", "feedback"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let released = |file: &str| {
        let path = format!("release/{name}/feedback/s101/{file}");
        std::fs::read_to_string(bed.path(&path)).expect("feedback")
    };
    let ran = bed.run(&["course", "release", name, "--to", "jsonl"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let lines = bed.path(&format!("release/{name}/jsonl/grades.jsonl"));
    let lines = std::fs::read_to_string(lines).expect("lines");
    let feedback = released("feedback.html");
    let one = |check: &&CheckHints| [(*check).clone()].into_iter().collect::<Hints>();
    let parts: Vec<String> = lost
        .iter()
        .flat_map(|check| remedies(&one(check)))
        .collect();
    assert!(!parts.is_empty());
    for part in &parts {
        for (what, text) in [
            ("explain", &text.stdout),
            ("explained.html", &page),
            ("feedback.html", &feedback),
            ("grades.jsonl", &lines),
        ] {
            assert!(text.contains(part), "{what} has no {part}");
        }
    }
    // the report itself is that of every grade
    let report = released("report.html");
    for part in remedies(&hints) {
        assert!(!report.contains(&part), "{part}");
    }
    let full = hints.checks().iter().find(|check| !lost.contains(check));
    for part in remedies(&one(&full.expect("a check"))) {
        assert!(!feedback.contains(&part), "{part}");
    }
}

/// Every lab of the course asks before it says what to do.
#[test]
fn the_labs_of_the_course_have_a_remedy_behind_each_question() {
    for name in std::fs::read_dir(root().join("labs")).expect("labs") {
        let name = name.expect("an entry").file_name();
        let name = name.to_str().expect("UTF-8");
        if !root().join(format!("labs/{name}/lab.toml")).is_file() {
            continue;
        }
        for check in lab(name).hints().checks() {
            assert!(check.hints.len() > 1, "{name}: {}", check.name());
        }
    }
}
