//! A class of eight through `kinemark course`: read, graded, decided on, regraded, forgotten; the same grades however it is done.

use serde_json::Value;

use crate::course_class::{CLASS, LAB, accept_lab, class, grade, records, standings};
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
