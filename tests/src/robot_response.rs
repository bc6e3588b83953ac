//! `kinemark robot response`: the numbers of the exercise as a person sees them, the files it writes, and what it refuses.

use serde_json::Value;

use crate::testbed::{CommandResult, TestBed, root};

const EXERCISE: [&str; 11] = [
    "robot", "response", "rrbot", "--joint", "elbow", "--kp", "100", "--ki", "0.01", "--kd", "10",
];

fn exercise(bed: &TestBed, more: &[&str]) -> CommandResult {
    let args: Vec<&str> = EXERCISE.into_iter().chain(more.iter().copied()).collect();
    bed.run(&args)
}

/// The words of the first line that starts with `name`.
fn row<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let line = text.lines().find(|line| line.starts_with(name));
    line.expect("the row").split_whitespace().collect()
}

#[test]
fn the_table_has_the_numbers_of_the_exercise() {
    let bed = TestBed::new();
    let ran = exercise(&bed, &["--derivative", "error", "--effort-limit", "30"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // final, peak, rise, settling, overshoot, beyond
    let theory = row(&ran.stdout, "theory");
    assert_eq!(theory[3..6], ["29.89", "189.6", "5.265"], "{ran:?}");
    let ran = exercise(&bed, &[]);
    let theory = row(&ran.stdout, "theory");
    assert_eq!(theory[3..5], ["201.1", "365.8"], "{ran:?}");
    let run = row(&ran.stdout, "run");
    assert_eq!(run[1..4], ["1.02120", "1.02599", "231.7"], "{ran:?}");
    assert_eq!(run[5..8], ["0.4685", "+21.20", "100"], "{ran:?}");
    assert!(
        ran.stdout.contains("off its command by 0.1003 rad at most"),
        "{ran:?}"
    );
    let ran = exercise(
        &bed,
        &["--derivative", "velocity", "--servo-period-ms", "10"],
    );
    for words in ["grows by a factor of 1.95 a sample", "kd 6.6"] {
        assert!(ran.stdout.contains(words), "{ran:?}");
    }
}

#[test]
fn a_page_and_pictures_are_whole_and_the_same_every_time() {
    let bed = TestBed::new();
    let files = ["--html", "a.html", "--svg", "a.svg", "--png", "a.png"];
    let sweep = ["--sweep", "kd=2,5,10", "--json"];
    let ran = exercise(&bed, &[&files[..], &sweep[..]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let record: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let kds: Vec<f64> = (0..3)
        .filter_map(|i| record["responses"][i]["settings"]["kd"].as_f64())
        .collect();
    assert_eq!(kds, [2.0, 5.0, 10.0]);
    let read = |name: &str| std::fs::read(bed.path(name)).expect("a file");
    let page = String::from_utf8(read("a.html")).expect("text");
    assert_eq!(page.matches("role=\"img\"").count(), 3, "three pictures");
    for words in [
        "kd 5",
        "231.7",
        "dashed: linear theory",
        "Content-Security-Policy",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(read("a.svg").starts_with(b"<svg ") && read("a.png").starts_with(b"\x89PNG"));
    let before = ["a.html", "a.svg", "a.png"].map(read);
    let again = exercise(&bed, &[&files[..], &sweep[..]].concat());
    assert_eq!(again.stdout, ran.stdout);
    assert_eq!(["a.html", "a.svg", "a.png"].map(read), before);
}

#[test]
fn a_loop_that_diverges_is_a_result() {
    let bed = TestBed::new();
    let more = [
        "--of",
        "velocity",
        "--derivative",
        "error",
        "--effort-limit",
        "1e9",
    ];
    // the arm's own limits of speed and position hold whatever its servos do
    let held = exercise(&bed, &more);
    assert_eq!(held.code, Some(0), "{held:?}");
    assert!(!held.stdout.contains("diverges"), "{held:?}");
    assert!(
        held.stdout.contains("unstable at a servo period of 1 ms"),
        "{held:?}"
    );
    let text = std::fs::read_to_string(root().join("labs/robots/rrbot.toml")).expect("the robot");
    let lines = text.lines().filter(|line| !line.starts_with("limit"));
    bed.write("free.toml", lines.collect::<Vec<_>>().join("\n"));
    let free = EXERCISE.map(|word| if word == "rrbot" { "free.toml" } else { word });
    let ran = bed.run(&[&free[..], &more, &["--svg", "a.svg"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("diverges at 0.002 s"), "{ran:?}");
    let svg = std::fs::read_to_string(bed.path("a.svg")).expect("a picture");
    assert!(svg.contains("stopped here"));
}

#[test]
fn what_was_typed_wrongly_is_refused_with_help() {
    let bed = TestBed::new();
    let base = ["robot", "response", "rrbot"];
    for (more, words) in [
        (
            &["--joint", "elbw", "--kp", "1"][..],
            "did you mean `elbow`?",
        ),
        (&["--kp", "1"], "name one with --joint: shoulder, elbow"),
        (&["--joint", "elbow"], "--kp 100"),
        (
            &["--joint", "elbow", "--kp", "-1"],
            "`kp` must be zero or more",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--wind", "3"],
            "--drag 0.05,1.1",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--wind", "3,1"],
            "is no wind",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--drag", "3"],
            "is no drag",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--gravity", "venus"],
            "earth, moon, mars, zero",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--sweep", "kq=1"],
            "did you mean `kp`?",
        ),
        (
            &["--joint", "elbow", "--kp", "1", "--svg", "rrbot.toml"],
            "ends in .svg",
        ),
    ] {
        let ran = bed.run(&[&base[..], more].concat());
        assert_eq!(ran.code, Some(2), "{more:?} {ran:?}");
        // long messages are wrapped
        let said = ran.stderr.replace("\n  │ ", " ").replace("\n        ", " ");
        assert!(said.contains(words), "{more:?} {ran:?}");
    }
}
