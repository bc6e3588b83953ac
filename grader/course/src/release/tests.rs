//! What every form owes: nothing for who has no grade, the same bytes twice, names that are unique and lead nowhere.

use super::sample::{Class, change, material};
use super::*;
use crate::standing::Status;

/// A worksheet or gradebook that fits no form but its own is left out: those forms have tests of their own.
fn forms_without_a_file() -> impl Iterator<Item = &'static Form> {
    FORMS
        .iter()
        .filter(|form| !matches!(form.export, ExportUse::Required(_)))
}

#[test]
fn names_of_forms_are_unique_and_found() {
    let mut names: Vec<&str> = FORMS.iter().map(|form| form.name).collect();
    for name in &names {
        assert_eq!(Form::named(name).unwrap().name, *name);
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), FORMS.len());
    assert!(Form::named("blackboard").is_none());
}

#[test]
fn a_form_that_fills_a_file_says_which_one() {
    let class = Class::hostile();
    let rows = class.rows();
    let error = Form::named("moodle")
        .unwrap()
        .release(&material(&rows, None))
        .unwrap_err();
    let help = miette::Diagnostic::help(&error).unwrap().to_string();
    assert!(help.contains("grading worksheet"), "{help}");
}

#[test]
fn the_same_material_gives_the_same_bytes() {
    let class = Class::hostile();
    let rows = class.rows();
    for form in forms_without_a_file() {
        let made = form.release(&material(&rows, None)).unwrap();
        assert!(!made.files.is_empty(), "{}", form.name);
        assert_eq!(form.release(&material(&rows, None)).unwrap(), made);
        let mut paths: Vec<&str> = made.files.iter().map(|file| file.path.as_str()).collect();
        for path in &paths {
            let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.~/".contains(c);
            assert!(path.chars().all(is_plain), "{path}");
            assert!(!path.contains("..") && !path.starts_with('/'), "{path}");
        }
        paths.sort_unstable();
        paths.dedup();
        assert_eq!(paths.len(), made.files.len());
    }
}

#[test]
fn who_has_no_grade_has_no_number_and_no_file_of_their_own() {
    let class = Class::hostile();
    let rows = class.rows();
    for form in forms_without_a_file() {
        let made = form.release(&material(&rows, None)).unwrap();
        for file in &made.files {
            for id in ["m", "e", "h", "g", "p", "n"] {
                let own = [format!("{id}/"), format!("{id}.")];
                let is_own = own.iter().any(|own| file.path.starts_with(own));
                assert!(!is_own, "{} {}", form.name, file.path);
            }
        }
        let open: Vec<&Note> = made
            .notes
            .iter()
            .filter(|note| matches!(note, Note::NotDecided { .. }))
            .collect();
        assert_eq!(open.len(), 4, "{}", form.name);
    }
}

#[test]
fn a_record_that_decides_nothing_is_no_number_whatever_the_standing_says() {
    let mut class = Class::hostile();
    class.of("s01").verdict = Some(kinemark_grader::record::verdict::Verdict::HostLimit);
    let rows = class.rows();
    let made = Form::named("csv").unwrap().release(&material(&rows, None));
    let text = String::from_utf8(made.unwrap().files.remove(0).bytes).unwrap();
    assert!(text.contains("\r\ns01,,24,graded,,,"), "{text}");
    assert!(decided::decided(&rows[0]).is_none());
}

#[test]
fn stale_points_by_hand_are_noted() {
    let mut class = Class::hostile();
    class.of("s02").by_hand = vec![
        change(Some("fk/mean-error"), 1.0, "typo in the brief", true),
        change(None, 0.5, "bonus", false),
    ];
    let rows = class.rows();
    let made = Form::named("jsonl")
        .unwrap()
        .release(&material(&rows, None));
    let notes = made.unwrap().notes;
    let stale: Vec<String> = notes
        .iter()
        .filter(|note| matches!(note, Note::Stale { .. }))
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        stale,
        [
            "s02: points by hand for fk/mean-error were decided on another record than the one that counts (typo in the brief): look at them again in fixes.toml"
        ]
    );
}

#[test]
fn the_whole_report_is_beside_the_feedback() {
    let class = Class::hostile();
    let rows = class.rows();
    let made = Form::named("feedback")
        .unwrap()
        .release(&material(&rows, None))
        .unwrap();
    let of_first: Vec<&str> = made
        .files
        .iter()
        .map(|file| file.path.as_str())
        .filter(|path| path.starts_with("s01/"))
        .collect();
    assert_eq!(
        of_first,
        ["s01/feedback.txt", "s01/feedback.html", "s01/report.html"]
    );
    assert_eq!(rows[8].standing.status, Status::Missing);
}

#[test]
fn files_that_wait_for_a_person_are_noted() {
    let class = Class::hostile();
    let rows = class.rows();
    let id = |id: &str| StudentId::new(id).unwrap();
    // of somebody with a grade, and of somebody without one
    let students = [id("s01"), id("n")];
    let unclaimed = [vec![id("m"), id("e")], vec![id("e")], Vec::new()];
    let material = Material {
        open: OpenFiles {
            students: &students,
            unclaimed: &unclaimed,
        },
        ..material(&rows, None)
    };
    let made = Form::named("csv").unwrap().release(&material).unwrap();
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        notes[0],
        "3 files wait for a person, because it is not certain whose: e, m may be missing because of it; `kinemark course status` shows what decides it"
    );
    assert_eq!(
        notes[1],
        "s01: another file of theirs waits for a person: the grade may change once it is decided"
    );
    let of_n = made
        .notes
        .iter()
        .filter(|note| note.is_left_out() == Some(&students[1]));
    assert_eq!(of_n.count(), 1);
}

#[test]
fn grades_of_an_earlier_lab_are_noted_once_with_everybody() {
    let class = Class::hostile();
    let mut rows = class.rows();
    for row in &mut rows[..3] {
        row.is_of_earlier_lab = true;
    }
    // a grade that is not decided goes out with no file
    rows[8].is_of_earlier_lab = true;
    let made = Form::named("feedback")
        .unwrap()
        .release(&material(&rows, None));
    assert_eq!(
        made.unwrap().notes[0].to_string(),
        "3 grades are of an earlier lab or engine (s01, s02, s03): `kinemark course regrade 01-kinematics` shows what would change"
    );
}

#[test]
fn what_a_form_has_no_use_for_is_refused_with_the_forms_that_use_it() {
    let class = Class::hostile();
    let rows = class.rows();
    let refused = |form: &str, material: &Material<'_>| {
        let error = Form::named(form).unwrap().release(material).unwrap_err();
        let help = miette::Diagnostic::help(&error).unwrap().to_string();
        format!("{error} / {help}")
    };
    let named = |columns| Material {
        columns,
        ..material(&rows, None)
    };
    let points = Columns {
        points: Some("Points"),
        ..Columns::default()
    };
    let comment = Columns {
        comment: Some("Comment"),
        ..Columns::default()
    };
    assert_eq!(
        refused("junit", &material(&rows, Some(b"id,points\n"))),
        "the form `junit` has no use for --export / leave it out, or choose a form that uses it: moodle, canvas, csv"
    );
    assert_eq!(
        refused("feedback", &named(points)),
        "the form `feedback` has no use for --column / leave it out, or choose a form that uses it: moodle, canvas, csv"
    );
    let with_file = Material {
        columns: comment,
        ..material(&rows, Some(b"Student,ID\n"))
    };
    assert_eq!(
        refused("canvas", &with_file),
        "the form `canvas` has no use for --comment-column / leave it out, or choose a form that uses it: moodle, csv"
    );
    assert!(refused("csv", &named(points)).starts_with(
        "--column names a column of a file, and no file was given / name the file with --export"
    ));
}
