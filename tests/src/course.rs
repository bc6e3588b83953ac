//! A class of eight through `kinemark course`: read, graded, decided on, regraded, forgotten; the same grades however it is done.

use serde_json::Value;

use crate::course_class::{CLASS, LAB, accept_lab, class, grade, hand_in, records, standings};
use crate::testbed::{TestBed, files_below};

#[test]
fn a_class_is_read_graded_and_decided_on() {
    let bed = class();
    let ran = grade(&bed, &[]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("6 graded, 1 missing, 1 needs you"),
        "{ran:?}"
    );
    let before = standings(&bed);
    let of = |id: &str| {
        before
            .iter()
            .find(|row| row.0 == id)
            .expect("a row")
            .clone()
    };
    assert_eq!(of("s100").2, 24.0);
    assert_eq!(of("s102").2, 0.0);
    assert_eq!(
        (of("s106").1.as_str(), of("s106").2),
        ("missing", Value::Null)
    );
    assert_eq!(of("s107").1, "needs-person");
    // a name is in no file of the book
    for (path, bytes) in files_below(&bed.path("book")) {
        let text = String::from_utf8_lossy(&bytes);
        for (_, name, _) in CLASS.iter().filter(|(_, name, _)| name.len() > 4) {
            assert!(!text.contains(name), "{path} has {name}");
        }
    }
    let status = bed.run(&["course", "status", LAB]).stdout;
    assert!(status.contains("path = \"s107/b.rhai\""), "{status}");
    bed.write(
        "fixes.toml",
        format!(
            "format = 1\n[[files]]\nlab = \"{LAB}\"\npath = \"s107/b.rhai\"\nstudent = \"s107\"\nwhy = \"asked\"\nby = \"anna\"\n\
             [[points]]\nstudent = \"s106\"\nlab = \"{LAB}\"\npoints = 12.5\nwhy = \"shown in person\"\nby = \"anna\"\n"
        ),
    );
    let ran = bed.run(&["course", "grade", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let after = standings(&bed);
    let of = |id: &str| after.iter().find(|row| row.0 == id).expect("a row").clone();
    assert_eq!(of("s106").2, 12.5);
    assert_eq!(
        (of("s107").1.as_str(), &of("s107").2),
        ("graded", &of("s101").2)
    );
    assert!(files_below(&bed.path("book/questions")).is_empty());
}

/// Jobs, shards in books of their own, and a process killed at many moments: the same records, byte for byte.
#[test]
fn grades_are_the_same_however_they_are_made() {
    let one = class();
    grade(&one, &["--jobs", "1"]);
    let expected = (standings(&one), records(&one));
    assert_eq!(expected.1.len(), 6);

    let shards: Vec<TestBed> = (1..=2)
        .map(|part| {
            let bed = class();
            let ran = grade(&bed, &["--shard", &format!("{part}/2"), "--no-reports"]);
            assert_eq!(ran.code, Some(0), "{ran:?}");
            assert!(
                !bed.path("book/course.sqlite").exists(),
                "a shard opened the index"
            );
            assert!(records(&bed).len() < 6);
            bed
        })
        .collect();
    let [joined, other] = shards.as_slice() else {
        panic!("two shards");
    };
    for (path, bytes) in files_below(&other.path("book")) {
        if !joined.path("book").join(&path).exists() {
            joined.write(&format!("book/{path}"), bytes);
        }
    }
    assert_eq!((standings(joined), records(joined)), expected);

    // what a killed process may leave: any number of lines, the last one torn, and any of the records
    let journal = files_below(&one.path("book/journal"));
    let (name, whole) = journal.first().expect("a journal");
    for cut in (0..20).map(|moment| whole.len() * moment / 20) {
        let bed = TestBed::new();
        for (path, bytes) in files_below(&one.path("")) {
            bed.write(&path, bytes);
        }
        for (path, _) in journal.iter().skip(1) {
            std::fs::remove_file(bed.path("book/journal").join(path)).expect("removed");
        }
        bed.write(&format!("book/journal/{name}"), &whole[..cut]);
        let kept = cut % 7;
        for (path, _) in records(&bed).iter().skip(kept) {
            std::fs::remove_file(bed.path("book/records").join(path)).expect("removed");
        }
        grade(&bed, &["--no-reports"]);
        assert_eq!((standings(&bed), records(&bed)), expected, "cut at {cut}");
    }
}

#[test]
fn a_changed_lab_is_refused_until_it_is_accepted_and_nobody_falls_unasked() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    let before = standings(&bed);
    bed.edit(
        &format!("labs/{LAB}/lab.toml"),
        "fk-error = { full_m = 1e-4",
        "fk-error = { full_m = 1e-5",
    );
    bed.edit(
        &format!("labs/{LAB}/lab.toml"),
        "pose-reached = { full_m = 2e-3, zero_m = 2e-2",
        "pose-reached = { full_m = 1e-3, zero_m = 5e-3",
    );
    let ran = bed.run(&["course", "grade", LAB]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(
        ran.stderr.contains("not those that course.toml names"),
        "{ran:?}"
    );
    accept_lab(&bed);
    let ran = bed.run(&["course", "regrade", LAB]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("1 would fall") && ran.stdout.contains("move/pose"),
        "{ran:?}"
    );
    let points = |rows: &[(String, String, Value, Value)]| -> Vec<Value> {
        rows.iter().map(|row| row.2.clone()).collect()
    };
    assert_eq!(standings(&bed), before, "a table changes nothing");
    let ran = bed.run(&["course", "regrade", LAB, "--apply"]);
    assert_eq!(ran.code, Some(2), "without a reason: {ran:?}");
    let apply = [
        "course",
        "regrade",
        LAB,
        "--apply",
        "--why",
        "a band was too wide",
    ];
    bed.run(&apply);
    assert_eq!(points(&standings(&bed)), points(&before));
    let ran = bed.run(&[&apply[..], &["--allow-lower"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_ne!(points(&standings(&bed)), points(&before));
    let ran = bed.run(&["course", "regrade", LAB]);
    assert!(
        ran.stdout
            .contains("every grade is of today's lab and engine"),
        "{ran:?}"
    );
}

#[test]
fn a_person_is_forgotten_and_a_typo_is_answered() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    let ran = bed.run(&["course", "forget", "s103"]);
    assert_eq!(ran.code, Some(2), "still on the roster: {ran:?}");
    bed.edit("roster.csv", "s103,\"Ann Lee\"\n", "");
    let ran = bed.run(&["course", "forget", "s103"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for (path, bytes) in files_below(&bed.path("book")) {
        assert!(!String::from_utf8_lossy(&bytes).contains("s103"), "{path}");
    }
    bed.write("fixes.toml", format!("format = 1\n[[excused]]\nstudent = \"s10\"\nlab = \"{LAB}\"\nwhy = \"ill\"\nby = \"a\"\n"));
    let ran = bed.run(&["course", "status"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("did you mean `s100`?"), "{ran:?}");
    std::fs::remove_file(bed.path("fixes.toml")).expect("removed");
    let ran = bed.run(&["course", "grade", "in", "01-kinematic"]);
    assert!(
        ran.code == Some(2) && ran.stderr.contains("did you mean `01-kinematics`?"),
        "{ran:?}"
    );
    let ran = bed.run(&["course", "grade", "nowhere.zip", LAB]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}

#[test]
fn hand_in_files_say_what_they_are() {
    let bed = class();
    let labs = bed.path("labs").display().to_string();
    let written = |folder: &str, submission: &str, student: &str| {
        hand_in(&bed, &format!("{folder}/submission.rhai"), submission);
        let file = bed.path(folder).join("submission.rhai");
        let out = bed.path(&format!("handed/{folder}.kinemark"));
        let ran = bed.run(&[
            "submit",
            LAB,
            &file.display().to_string(),
            "--student",
            student,
            "--labs",
            &labs,
            "--out",
            &out.display().to_string(),
        ]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
    };
    std::fs::create_dir_all(bed.path("handed")).expect("a folder");
    // the name of the file says nothing, the file itself does
    written("upload", "good", "s100");
    // a file that says one thing under a name that says another
    written("s101", "degrees", "s103");
    // a lab that has changed since
    let lab = format!("labs/{LAB}/lab.toml");
    let text = std::fs::read_to_string(bed.path(&lab)).expect("a lab");
    bed.write(&lab, format!("{text}\n# older\n"));
    written("s104", "good", "s104");
    bed.write(&lab, text);

    let ran = bed.run(&["course", "grade", "handed", LAB]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout
            .contains("1 practised with another lab than the course's: s104"),
        "{ran:?}"
    );
    let rows = standings(&bed);
    let of = |id: &str| rows.iter().find(|row| row.0 == id).expect("a row");
    assert_eq!(of("s100").2, 24.0);
    assert_eq!(of("s104").2, 24.0);
    assert_eq!(of("s101").1, "needs-person");
    let status = bed.run(&["course", "status", LAB]).stdout;
    assert!(
        status.contains("the hand-in file says that it is of `s103`, who is somebody else"),
        "{status}"
    );
    // the submission in it can be chosen all the same
    bed.write(
        "fixes.toml",
        format!(
            "format = 1\n[[files]]\nlab = \"{LAB}\"\npath = \"s101.kinemark\"\nstudent = \"s101\"\nwhy = \"typed it wrong\"\nby = \"anna\"\n"
        ),
    );
    let ran = bed.run(&["course", "grade", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let rows = standings(&bed);
    let row = rows.iter().find(|row| row.0 == "s101").expect("a row");
    assert_eq!(row.1, "graded");
}

/// A table of `fixes.toml` that says whose a file is, or that it is nobody's.
fn file_fix(path: &str, whose: &str) -> String {
    format!(
        "[[files]]\nlab = \"{LAB}\"\npath = \"{path}\"\n{whose}\nwhy = \"asked\"\nby = \"anna\"\n"
    )
}

#[test]
fn a_decision_can_be_corrected() {
    let bed = class();
    grade(&bed, &[]);
    let decide = |tables: &str| {
        bed.write("fixes.toml", format!("format = 1\n{tables}"));
        bed.run(&["course", "grade", LAB])
    };
    let points = |id: &str| {
        let rows = standings(&bed);
        let row = rows.into_iter().find(|row| row.0 == id).expect("a row");
        (row.1, row.2)
    };
    let graded = |points: f64| ("graded".to_owned(), Value::from(points));
    let missing = ("missing".to_owned(), Value::Null);
    // a file given to the wrong person, then to the right one
    decide(&file_fix("s107/a.rhai", "student = \"s106\""));
    assert_eq!(points("s106"), graded(24.0));
    decide(&file_fix("s107/a.rhai", "student = \"s107\""));
    assert_eq!(points("s106"), missing);
    assert_eq!(points("s107"), graded(24.0));
    // a file that was read and graded, and is nobody's after all
    let ran = decide(&file_fix("s100.rhai", "ignore = true"));
    assert!(!ran.stdout.contains("nothing was read"), "{ran:?}");
    assert_eq!(points("s100"), missing);
    assert_eq!(points("s107"), missing, "its decision is gone, too");
    decide("");
    assert_eq!(points("s100"), graded(24.0));
    // a path that nothing was read of
    let ran = decide(&file_fix("s1O0.rhai", "student = \"s106\""));
    assert!(
        ran.stdout
            .contains("fixes.toml: nothing was read of `s1O0.rhai`"),
        "{ran:?}"
    );
}

#[test]
fn a_file_that_comes_back_is_the_latest_again() {
    let bed = class();
    for (folder, submission, points) in [
        ("first", "good", 24.0),
        ("second", "degrees", 9.0),
        ("third", "good", 24.0),
    ] {
        hand_in(&bed, &format!("{folder}/s100.rhai"), submission);
        let ran = bed.run(&["course", "grade", folder, LAB]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert_eq!(
            ran.stdout.contains("the latest again: s100"),
            folder == "third",
            "{ran:?}"
        );
        let rows = standings(&bed);
        let row = rows.iter().find(|row| row.0 == "s100").expect("a row");
        assert_eq!(row.2 == 24.0, points == 24.0, "{folder}: {row:?}");
    }
    // again, it changes nothing
    let ran = bed.run(&["course", "grade", "third", LAB]);
    assert!(!ran.stdout.contains("latest again"), "{ran:?}");
}

#[test]
fn a_lost_record_is_made_again_only_if_it_is_the_same() {
    let bed = class();
    grade(&bed, &[]);
    let before = records(&bed);
    let rows = standings(&bed);
    let key = |id: &str| {
        let row = rows.iter().find(|row| row.0 == id).expect("a row");
        row.3.as_str().expect("a key").to_owned()
    };
    let file = |key: &str| bed.path(&format!("book/records/{}/{key}.json", &key[..2]));
    std::fs::remove_file(file(&key("s100"))).expect("a record");
    let text = std::fs::read(file(&key("s103"))).expect("a record");
    std::fs::write(file(&key("s103")), &text[..text.len() / 2]).expect("half a record");
    bed.run(&["course", "grade", LAB]);
    assert!(records(&bed) == before, "the same bytes again");
    // with another lab it would be another grade
    std::fs::remove_file(file(&key("s100"))).expect("a record");
    let lab = format!("labs/{LAB}/lab.toml");
    let text = std::fs::read_to_string(bed.path(&lab)).expect("a lab");
    bed.write(&lab, format!("{text}\n# another\n"));
    accept_lab(&bed);
    let ran = bed.run(&["course", "grade", LAB]);
    assert!(ran.stdout.contains("the record is lost of s100"), "{ran:?}");
    assert!(!file(&key("s100")).exists());
}

#[test]
fn points_by_hand_that_cannot_be_meant_are_refused() {
    let bed = class();
    let fix = |check: &str, points: f64| {
        bed.write(
            "fixes.toml",
            format!(
                "format = 1\n[[points]]\nstudent = \"s100\"\nlab = \"{LAB}\"\ncheck = \"{check}\"\npoints = {points}\nwhy = \"w\"\nby = \"b\"\n"
            ),
        );
        let ran = bed.run(&["course", "check"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        ran.stdout
    };
    let said = fix("fk/position", 50.0);
    assert!(said.contains("50 points are more than the"), "{said}");
    let ran = grade(&bed, &[]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let said = fix("fk/positon", 1.0);
    assert!(said.contains("did you mean `fk/position`?"), "{said}");
}

#[test]
fn an_extension_that_ends_before_the_lab_is_due_is_noticed() {
    let bed = class();
    let name = format!("name = \"{LAB}\"\n");
    let due = format!("{name}due = 2026-11-27T23:59:00Z\n");
    bed.edit("course.toml", &name, &due);
    for (year, code) in [(2025, 1), (2026, 0)] {
        bed.write(
            "fixes.toml",
            format!(
                "format = 1\n[[extensions]]\nstudent = \"s100\"\nlab = \"{LAB}\"\n\
                 due = {year}-12-04T23:59:00Z\nwhy = \"ill\"\nby = \"b\"\n"
            ),
        );
        let ran = bed.run(&["course", "check"]);
        assert_eq!(ran.code, Some(code), "{year}: {ran:?}");
        let is_noticed = ran.stdout.contains("before the lab is due for everybody");
        assert_eq!(is_noticed, code == 1, "{year}: {ran:?}");
    }
}

#[test]
fn in_the_folder_of_a_course_its_salt_draws_the_variants() {
    let bed = class();
    let ran = bed.run(&["lab", "variant", LAB, "--student", "s100"]);
    let salted = bed.run(&[
        "lab",
        "variant",
        LAB,
        "--student",
        "s100",
        "--salt",
        "a line that nobody can guess",
    ]);
    assert_eq!(ran.stdout, salted.stdout);
    assert!(
        ran.stderr
            .contains("the labs, staff part, salt are those of course.toml"),
        "{ran:?}"
    );
}

#[test]
fn a_record_is_held_beside_the_one_of_the_mended_lab() {
    let bed = class();
    grade(&bed, &[]);
    let lab = format!("labs/{LAB}/lab.toml");
    let text = std::fs::read_to_string(bed.path(&lab)).expect("a lab");
    let (before, after) = text.split_once("points = 5").expect("a check for 5 points");
    bed.write(&lab, format!("{before}points = 6{after}"));
    accept_lab(&bed);
    let ran = bed.run(&["course", "regrade", LAB]);
    let line = ran
        .stdout
        .lines()
        .find_map(|line| line.strip_prefix("side by side: kinemark "));
    let words: Vec<&str> = line.expect("a command").split(' ').collect();
    let ran = bed.run(&words);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("/5"), "{ran:?}");
    assert!(ran.stdout.contains("/6"), "{ran:?}");
    let comparison = bed.path("kinemark-compare/compare.json");
    let text = std::fs::read_to_string(comparison).expect("the comparison");
    let comparison: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(comparison["b"]["max_points"], 25.0);
    let ran = bed.run(&["compare", "course.toml", "course.toml"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}

#[test]
fn a_clear_file_answers_what_was_asked_of_its_student() {
    let bed = class();
    let ran = grade(&bed, &[]);
    assert!(ran.stdout.contains("1 needs you"), "{ran:?}");
    // the file of another student answers nothing
    hand_in(&bed, "other/s106.rhai", "good");
    let ran = bed.run(&["course", "grade", "other", LAB]);
    assert!(ran.stdout.contains("1 needs you"), "{ran:?}");
    hand_in(&bed, "again/s107.rhai", "good");
    let ran = bed.run(&["course", "grade", "again", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(!ran.stdout.contains("needs you"), "{ran:?}");
    let rows = standings(&bed);
    let row = rows.iter().find(|row| row.0 == "s107").expect("a row");
    assert_eq!(row.2, 24.0);
}
