//! What goes back: every form twice with the same bytes, nothing for who handed in nothing, no name and no salt in feedback.

use serde_json::Value;

use crate::course_class::{CLASS, LAB, accept_lab, class, grade, hand_in};
use crate::testbed::{CommandResult, TestBed, files_below};

/// The salt of the class.
const SALT: &str = "nobody can guess";
/// What the folder of a form has beside what goes back.
const LIST: &str = ".kinemark-files.json";

fn release(bed: &TestBed, form: &str, more: &[&str]) -> CommandResult {
    bed.run(&[&["course", "release", LAB, "--to", form], more].concat())
}

/// What a form wrote, by path, without the list.
fn released(bed: &TestBed, form: &str) -> Vec<(String, Vec<u8>)> {
    let mut files = files_below(&bed.path(&format!("release/{LAB}/{form}")));
    files.retain(|(path, _)| path != LIST);
    files
}

/// Ids of everybody on the roster.
fn everybody() -> Vec<&'static str> {
    let graded = CLASS.iter().map(|(id, ..)| *id);
    graded.chain(["s106", "s107"]).collect()
}

/// A grading worksheet of Moodle for a lab of so many points, and a gradebook of Canvas.
fn exports(bed: &TestBed, maximum: &str) {
    let mut worksheet = "Identifier,Full name,ID number,Grade,Maximum grade,Last modified (grade),Feedback comments\r\n".to_owned();
    let mut gradebook = format!(
        "Student,ID,SIS User ID,SIS Login ID,Section,Lab 1: {LAB} (77)\n    Points Possible,,,,,{maximum}\n"
    );
    for (i, id) in everybody().into_iter().enumerate() {
        worksheet += &format!("Participant {i},Somebody {i},{id},,{maximum},-,\r\n");
        gradebook += &format!("Somebody {i},{i},{id},,S,\n");
    }
    bed.write("worksheet.csv", worksheet);
    bed.write("gradebook.csv", gradebook);
}

fn export_of(form: &str) -> &'static [&'static str] {
    match form {
        "moodle" => &["--export", "worksheet.csv"],
        "canvas" => &["--export", "gradebook.csv"],
        _ => &[],
    }
}

const FORMS: [&str; 8] = [
    "moodle",
    "canvas",
    "gradescope",
    "csv",
    "feedback",
    "junit",
    "github",
    "jsonl",
];

#[test]
fn a_class_goes_back_in_every_form() {
    let bed = class();
    // an id whose letters make a folder's name of more than 255 bytes
    let long = "李".repeat(60);
    let roster = std::fs::read_to_string(bed.path("roster.csv")).expect("a roster");
    bed.write("roster.csv", format!("{roster}{long},\"Long Id\"\n"));
    hand_in(&bed, &format!("in/{long}.rhai"), "good");
    grade(&bed, &[]);
    exports(&bed, "24.00");
    for form in FORMS {
        let export = export_of(form);
        let ran = release(&bed, form, export);
        // s107 waits for a person
        assert_eq!(ran.code, Some(1), "{form}: {ran:?}");
        assert!(
            ran.stdout
                .contains("note: s107: no grade is written: needs you"),
            "{form}: {ran:?}"
        );
        let first = released(&bed, form);
        assert!(!first.is_empty(), "{form}");
        release(&bed, form, export);
        assert_eq!(released(&bed, form), first, "{form}");
        if let [option, _] = export {
            // a file that is filled already
            let (name, _) = first
                .iter()
                .find(|(path, _)| path.ends_with(".csv"))
                .expect("a table");
            let filled = bed.path(&format!("release/{LAB}/{form}/{name}"));
            let filled = filled.display().to_string();
            release(&bed, form, &[option, &filled]);
            assert_eq!(released(&bed, form), first, "{form}, filled again");
        }
        nothing_is_given_away(form, &first);
    }
    nobody_without_a_grade_has_a_number(&bed);
    trials_and_slips(&bed);
    what_is_not_true_any_more_goes(&bed);
    its_owner_alone_reads_it(&bed);
}

/// No name of the roster and no salt; and no file of who has no grade.
fn nothing_is_given_away(form: &str, files: &[(String, Vec<u8>)]) {
    for (path, bytes) in files {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains(SALT), "{form}/{path}");
        for (_, name, _) in CLASS.iter().filter(|(_, name, _)| name.len() > 4) {
            assert!(!text.contains(name), "{form}/{path} has {name}");
        }
        let of_nobody = path.starts_with("s106") || path.starts_with("s107");
        assert!(!of_nobody, "{form}/{path}");
        assert!(path.split('/').all(|name| name.len() <= 255), "{path}");
    }
}

fn nobody_without_a_grade_has_a_number(bed: &TestBed) {
    let table = |form: &str, name: &str| {
        let path = bed.path(&format!("release/{LAB}/{form}/{name}"));
        std::fs::read_to_string(path).expect("a table")
    };
    let worksheet = table("moodle", "worksheet.csv");
    assert!(worksheet.contains("Participant 6,Somebody 6,s106,,24.00,-,\r\n"));
    assert!(worksheet.contains("Participant 7,Somebody 7,s107,,24.00,-,\r\n"));
    assert!(worksheet.contains("Participant 0,Somebody 0,s100,24,24.00,-,"));
    let gradebook = table("canvas", "gradebook.csv");
    assert!(gradebook.ends_with("Somebody 6,6,s106,,S,\nSomebody 7,7,s107,,S,\n"));
    let grades = table("csv", "grades.csv");
    assert!(grades.contains("\r\ns106,,24,missing,,,"), "{grades}");
    assert!(grades.contains("\r\ns107,,24,needs-person,,,"), "{grades}");
}

/// A trial is not in the journal, nor is what was released before; options without effect are refused.
fn trials_and_slips(bed: &TestBed) {
    let releases = || {
        let journal = files_below(&bed.path("book/journal"));
        let lines = journal
            .iter()
            .map(|(_, bytes)| String::from_utf8_lossy(bytes));
        let count = |text: &str| text.matches("\"released\"").count();
        lines.map(|text| count(&text)).sum::<usize>()
    };
    assert_eq!(releases(), FORMS.len());
    let ran = release(bed, "csv", &["--out", "trial", "--json"]);
    let json: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(json["is_in_journal"], false);
    assert_eq!(json["files"][0], "grades.csv");
    assert_eq!(json["notes"][0]["note"], "not-decided");
    assert_eq!(json["notes"][0]["student"], "s107");
    assert_eq!(releases(), FORMS.len());
    let ran = release(bed, "junit", &["--column", "Points"]);
    assert!(
        ran.code == Some(2) && ran.stderr.contains("no use for --column"),
        "{ran:?}"
    );
    // a file of somebody else's is not replaced
    bed.write("mine/grades.csv", "mine");
    let ran = release(bed, "csv", &["--out", "mine"]);
    assert!(
        ran.code == Some(2) && ran.stderr.contains("is not of an earlier run"),
        "{ran:?}"
    );
}

/// Who is excused since the last release has no feedback any more.
fn what_is_not_true_any_more_goes(bed: &TestBed) {
    let of_s103 = || {
        let files = released(bed, "feedback");
        files
            .iter()
            .filter(|(path, _)| path.starts_with("s103/"))
            .count()
    };
    assert_eq!(of_s103(), 3);
    bed.write(
        "fixes.toml",
        format!("format = 1\n[[excused]]\nstudent = \"s103\"\nlab = \"{LAB}\"\nwhy = \"ill\"\nby = \"anna\"\n"),
    );
    release(bed, "feedback", &[]);
    assert_eq!(of_s103(), 0);
}

#[cfg(unix)]
fn its_owner_alone_reads_it(bed: &TestBed) {
    use std::os::unix::fs::PermissionsExt as _;
    for (path, _) in files_below(&bed.path("release")) {
        let file = bed.path("release").join(&path);
        let mode = |path: &std::path::Path| path.metadata().expect("it").permissions().mode();
        assert_eq!(mode(&file) & 0o777, 0o600, "{path}");
        let folder = file.parent().expect("a folder");
        assert_eq!(mode(folder) & 0o777, 0o700, "{path}");
    }
}

#[cfg(not(unix))]
fn its_owner_alone_reads_it(_: &TestBed) {}

#[test]
fn a_grade_of_an_earlier_lab_does_not_go_out_under_another_maximum() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    // forward kinematics counts for more since
    bed.edit(&format!("labs/{LAB}/lab.toml"), "points = 5", "points = 11");
    accept_lab(&bed);
    let ran = bed.run(&["course", "regrade", LAB]);
    assert!(ran.stdout.contains("24/24 -> 30/30"), "{ran:?}");
    exports(&bed, "30");
    let ran = release(&bed, "moodle", export_of("moodle"));
    for words in [
        "6 grades are of an earlier lab or engine (s100, s101, s102, s103, s104, s105)",
        "s100: 24 of 24 points are not written, because the LMS counts to 30",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }
    let (_, worksheet) = released(&bed, "moodle")
        .into_iter()
        .find(|(path, _)| path == "worksheet.csv")
        .expect("a worksheet");
    let before = std::fs::read(bed.path("worksheet.csv")).expect("a worksheet");
    assert_eq!(worksheet, before);
    bed.run(&["course", "regrade", LAB, "--apply", "--why", "as announced"]);
    let ran = release(&bed, "moodle", export_of("moodle"));
    assert!(!ran.stdout.contains("s100:"), "{ran:?}");
}
