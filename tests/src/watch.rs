//! `kinemark watch`: a grade per save, and a page that follows. Nothing here waits for a time: lines and answers are waited for.

use crate::testbed::{Serving, TestBed, root};

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    let good = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(good, bed.path("mine.rhai")).expect("copied");
    bed
}

/// Waits for a report after the one seen, and returns its number: a save that a busy machine spreads out may be graded twice.
pub(crate) fn newer(serving: &Serving, seen: u64) -> u64 {
    let answer = serving.get(&format!("/kinemark/changes?seen={seen}"));
    let status: serde_json::Value = serde_json::from_str(&answer.body).expect("JSON");
    let version = status["version"].as_u64().expect("a number");
    assert!(version > seen, "{answer:?}");
    version
}

#[test]
fn every_save_is_graded_and_open_pages_are_notified() {
    let bed = bed();
    let (serving, before) = Serving::start(
        &bed,
        &[
            "watch",
            "01-kinematics",
            "mine.rhai",
            "--no-open",
            "--practice",
        ],
    );
    let (notes, before): (Vec<_>, Vec<_>) = before
        .into_iter()
        .partition(|line| line.starts_with("note: "));
    assert_eq!(before, ["24 of 24 points, passed"]);
    // from standard error, where another line may come first
    let is_known = |note: &String| note == "note: using the labs in `labs`";
    assert!(notes.iter().all(is_known), "{notes:?}");
    // the page has the script and its rights; the file on the disk has not
    let page = serving.get("/report.html");
    assert!(page.body.contains("<script data-seen=\"1\">"), "no script");
    assert!(page.body.contains("connect-src 'self'"), "no right to ask");
    assert!(!page.head.contains("sandbox"), "it may ask and remember");
    // another page in the folder may neither
    bed.write("out/other.html", "<p>");
    assert!(serving.get("/other.html").head.contains("sandbox"));
    std::fs::remove_file(bed.path("out/other.html")).expect("removed");
    let on_disk = std::fs::read_to_string(bed.path("out/report.html")).expect("a report");
    assert!(!on_disk.contains("data-seen") && !on_disk.contains("connect-src"));
    assert_eq!(newer(&serving, 0), 1);
    assert_eq!(serving.get("/kinemark/changes?seen=x").code, 400);

    // a submission that does not compile is reported with its line, and the watch goes on
    let good = std::fs::read_to_string(bed.path("mine.rhai")).expect("a submission");
    bed.write("mine.rhai", good.clone() + "\nfn (");
    serving.line_with("did-not-build; ");
    let seen = newer(&serving, 1);
    let page = serving.get("/report.html").body;
    assert!(page.contains("data-seen=\"") && !page.contains("data-seen=\"1\""));

    // gone, then put in place by renaming, as editors do
    std::fs::remove_file(bed.path("mine.rhai")).expect("removed");
    serving.line_with("mine.rhai is gone; it is graded again when it is back");
    bed.write("mine.rhai.new", good.replace("time < 2.5", "time < 2.6"));
    std::fs::rename(bed.path("mine.rhai.new"), bed.path("mine.rhai")).expect("renamed");
    serving.line_with(" of 24 points, ");
    let seen = newer(&serving, seen);

    // a lab that is invalid for a moment is reported, then repaired
    let lab = std::fs::read_to_string(bed.path("labs/01-kinematics/lab.toml")).expect("a lab");
    bed.write("labs/01-kinematics/lab.toml", "format = ");
    serving.line_with("lab.toml");
    bed.write("labs/01-kinematics/lab.toml", lab);
    serving.line_with(" points, ");
    newer(&serving, seen);
    #[cfg(unix)]
    assert_eq!(serving.stop(), Some(0));
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn each_grade_is_a_line_of_json() {
    let bed = bed();
    let args = [
        "watch",
        "01-kinematics",
        "mine.rhai",
        "--no-open",
        "--practice",
        "--json",
    ];
    let (serving, before) = Serving::start(&bed, &args);
    let read = |line: &str| -> serde_json::Value { serde_json::from_str(line).expect("JSON") };
    // the address is beside it, on standard error, and may come first
    let first = match before.iter().find(|line| line.starts_with('{')) {
        Some(line) => line.clone(),
        None => serving.line_with("{"),
    };
    assert_eq!(read(&first)["points"], 24.0);
    bed.write("mine.rhai", "fn control(time, q, qd, target, memory) { q }");
    let again = read(&serving.line_with("{"));
    assert_eq!(again["format"], "kinemark-grade/1");
    assert_ne!(again["points"], 24.0);
}

#[test]
fn what_cannot_be_watched_is_reported_at_once() {
    let bed = TestBed::new();
    let ran = bed.run(&["watch", "01-kinematics", "nowhere.rhai", "--no-open"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("there is no file `nowhere.rhai`"),
        "{ran:?}"
    );
    bed.write("mine.rhai", "");
    let ran = bed.run(&["watch", "77-nothing", "mine.rhai", "--no-open"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(!bed.path("out").exists());
}
