//! Small exports of each layout, written by hand, and what is read from them.

use super::{Arrangement, Hint, PersonFiles, arrange, arrange_as};
use crate::tree::sample::tree;
use crate::tree::{Limits, Tree};

fn arranged(files: &[(&str, &str)]) -> Arrangement {
    arrange(&tree(files))
}

/// The files of a person, by their own paths.
fn paths(person: &PersonFiles) -> Vec<&str> {
    person.files.iter().map(|file| file.path.as_str()).collect()
}

fn labels(arrangement: &Arrangement) -> Vec<&str> {
    let people = arrangement.people.iter();
    people.map(|person| person.label.as_str()).collect()
}

#[test]
fn moodle_with_folders() {
    let class = arranged(&[
        (
            "Ana Lima_11_assignsubmission_file_/lab1/submission.rhai",
            "a",
        ),
        (
            "Ana Lima_11_assignsubmission_onlinetext_/onlinetext.html",
            "t",
        ),
        ("Öz Ünal_12_assignsubmission_file/submission.rhai", "b"),
        ("Group 3_77_assignsubmission_file_/submission.rhai", "c"),
        ("Default group_assignsubmission_file_/submission.rhai", "d"),
        ("stray.rhai", "e"),
        ("grades.csv", "f"),
    ]);
    assert_eq!(class.layout.name, "moodle");
    assert_eq!(class.reason, "5 of 7 names with `_assignsubmission_`");
    assert_eq!(
        labels(&class),
        [
            "Ana Lima_11_assignsubmission_file_",
            "Default group_assignsubmission_file_",
            "Group 3_77_assignsubmission_file_",
            "stray.rhai",
            "Öz Ünal_12_assignsubmission_file",
        ]
    );
    let ana = &class.people[0];
    assert_eq!(
        paths(ana),
        ["lab1/submission.rhai", "onlinetext/onlinetext.html"]
    );
    assert_eq!(ana.hints[0], Hint::Name("Ana Lima".to_owned()));
    assert_eq!(ana.lms_number.as_deref(), Some("11"));
    assert_eq!(class.people[1].lms_number, None);
}

#[test]
fn moodle_in_one_folder_below_another() {
    let class = arranged(&[
        ("lab1/Ana Lima_11_assignsubmission_file_my_work.rhai", "a"),
        (
            "lab1/Ana Lima_11_assignsubmission_onlinetext_onlinetext.html",
            "t",
        ),
        ("lab1/Ben Li_12_assignsubmission_file_x.zip", "b"),
    ]);
    assert_eq!(class.layout.name, "moodle");
    assert_eq!(
        labels(&class),
        [
            "lab1/Ana Lima_11_assignsubmission_file_",
            "lab1/Ben Li_12_assignsubmission_file_"
        ]
    );
    assert_eq!(
        paths(&class.people[0]),
        ["my_work.rhai", "onlinetext/onlinetext.html"]
    );
}

#[test]
fn a_blind_assignment_of_moodle_names_nobody() {
    let one = arranged(&[("Participant_11_assignsubmission_file_/a.rhai", "a")]);
    // the word is the site's language's, but everybody has the same
    let german: Vec<(String, &str)> = (1..4)
        .map(|i| {
            (
                format!("Teilnehmerin_{i}_assignsubmission_file_/a.rhai"),
                "a",
            )
        })
        .collect();
    let german = arrange(&tree(&german));
    for person in one.people.iter().chain(&german.people) {
        assert!(person.hints.is_empty());
        let number = person.lms_number.as_deref().unwrap();
        let what = format!("the export hides names: participant {number}");
        assert_eq!(person.problems[0].what, what);
    }
}

#[test]
fn canvas_takes_the_latest_upload_of_a_name() {
    let class = arranged(&[
        ("limaana_LATE_41_990_submission.rhai", "old"),
        ("limaana_LATE_41_993_submission-2.rhai", "newest"),
        ("limaana_LATE_41_992_submission-1.rhai", "newer"),
        ("limaana_LATE_41_991_notes.pdf", "n"),
        ("liben_42_994_work.zip", "z"),
        ("oz_43_text.html", "t"),
    ]);
    assert_eq!(class.layout.name, "canvas");
    assert_eq!(labels(&class), ["liben_42", "limaana_LATE_41", "oz_43"]);
    let ana = &class.people[1];
    assert_eq!(paths(ana), ["notes.pdf", "submission-2.rhai"]);
    assert_eq!(ana.marked_late, Some(true));
    assert_eq!(ana.hints[0], Hint::LmsId("41".to_owned()));
    assert_eq!(ana.hints[1], Hint::Slug("limaana".to_owned()));
    assert_eq!(class.people[0].marked_late, Some(false));
}

#[test]
fn an_anonymous_assignment_of_canvas_names_nobody() {
    let class = arranged(&[
        ("anon_Xy1Z2_990_submission.rhai", "a"),
        ("LATE_anon_aB3cD_991_submission.rhai", "b"),
    ]);
    assert_eq!(class.layout.name, "canvas");
    assert_eq!(labels(&class), ["LATE_anon_aB3cD", "anon_Xy1Z2"]);
    for person in &class.people {
        assert!(person.hints.is_empty());
        assert!(
            person.problems[0]
                .what
                .starts_with("the export hides names")
        );
    }
}

/// What Gradescope's export says, with the objects, anchors and tags that Ruby writes.
const METADATA: &str = "---
submission_1:
  :submitters:
  - :name: Ana Lima
    :sid: '0041'
    :email: &1 ana@example.org
  :created_at: 2026-11-30 18:41:12.345678000 Z
  :score: 3.0
  :status: processed
  :results: !ruby/hash:ActiveSupport::HashWithIndifferentAccess
    tests:
    - name: a
      output: |
        :not: a key
  :history:
  - :id: 7
    :created_at: !ruby/object:ActiveSupport::TimeWithZone
      utc: 2026-11-29 10:00:00.000000000 Z
      zone: !ruby/object:ActiveSupport::TimeZone
        name: America/Los_Angeles
      time: 2026-11-29 02:00:00.000000000 Z
    :score: 1.0
  - :id: 9
    :created_at: 2026-12-01 10:00:00.000000000 Z
    :score:
submission_2:
  :submitters:
  - :name: Ben Li
    :sid: 42
    :email: *1
  - :name: Öz
    :sid:
    :email: oz@example.org
  :created_at:
submission_3:
  :submitters:
  :created_at: 2026-11-30 18:41:12 -08:00
submission_4:
  :submitters:
  - :name: Gone
    :sid: '44'
";

#[test]
fn gradescope_says_whose_and_when() {
    let class = arranged(&[
        ("assignment_9_export/submission_metadata.yml", METADATA),
        ("assignment_9_export/submission_1/submission.rhai", "a"),
        ("assignment_9_export/submission_2/src/submission.rhai", "b"),
        ("assignment_9_export/submission_3/submission.rhai", "c"),
        ("assignment_9_export/submission_5/submission.rhai", "d"),
    ]);
    assert_eq!(class.layout.name, "gradescope");
    let name = |i: usize| {
        class.people[i]
            .label
            .trim_start_matches("assignment_9_export/")
    };
    assert_eq!(
        (0..class.people.len()).map(name).collect::<Vec<_>>(),
        [
            "submission_1",
            "submission_2 (1)",
            "submission_2 (2)",
            "submission_3",
            "submission_5",
            "submission_4",
        ]
    );
    let ana = &class.people[0];
    assert_eq!(
        ana.submitted_at.unwrap().to_string(),
        "2026-11-30T18:41:12.345678Z"
    );
    // of two others in the history one is earlier
    assert_eq!(ana.attempt, Some(2));
    assert_eq!(
        ana.hints,
        [
            Hint::Id("0041".to_owned()),
            Hint::Email("ana@example.org".to_owned()),
            Hint::Name("Ana Lima".to_owned())
        ]
    );
    let (ben, oz) = (&class.people[1], &class.people[2]);
    assert_eq!(ben.files, oz.files);
    assert_eq!(ben.hints[0], Hint::Id("42".to_owned()));
    assert_eq!(ben.hints[1], Hint::Email("ana@example.org".to_owned()));
    assert_eq!(oz.hints[0], Hint::Email("oz@example.org".to_owned()));
    assert_eq!((ben.submitted_at, ben.attempt), (None, None));
    let what = |i: usize| class.people[i].problems[0].what.as_str();
    assert_eq!(what(3), "submission_metadata.yml names no submitter of it");
    assert_eq!(what(4), "submission_metadata.yml does not name it");
    assert_eq!(
        what(5),
        "submission_metadata.yml names it, and its files are not in the export"
    );
}

#[test]
fn gradescope_without_its_metadata_names_nobody() {
    for files in [
        vec![("submission_1/submission.rhai", "a")],
        vec![
            ("submission_1/submission.rhai", "a"),
            ("submission_metadata.yml", "submission_1: [a"),
        ],
    ] {
        let class = arranged(&files);
        assert_eq!(class.layout.name, "gradescope");
        assert_eq!(labels(&class), ["submission_1"]);
        assert!(class.people[0].hints.is_empty());
        let what = &class.people[0].problems[0].what;
        assert!(what.starts_with("submission_metadata.yml"), "{what}");
    }
}

#[test]
fn repositories_are_known_by_their_git() {
    let class = arranged(&[
        ("lab1-submissions/lab1-ana/.git/HEAD", "x"),
        ("lab1-submissions/lab1-ana/submission.rhai", "a"),
        ("lab1-submissions/lab1-ben/.git/HEAD", "x"),
        ("lab1-submissions/notes/todo.txt", "n"),
    ]);
    assert_eq!(class.layout.name, "repositories");
    assert_eq!(class.reason, "2 of 3 folders with a .git inside");
    // a repository with nothing in it is somebody's, too
    assert_eq!(
        labels(&class),
        ["lab1-submissions/lab1-ana", "lab1-submissions/lab1-ben"]
    );
    assert_eq!(
        class.people[0].hints[0],
        Hint::Repository("lab1-ana".to_owned())
    );
    assert_eq!(paths(&class.people[0]), ["submission.rhai"]);
    assert!(class.people[1].files.is_empty());
}

#[test]
fn anything_else_is_flat() {
    let class = arranged(&[
        ("lab1/s1.rhai", "a"),
        ("lab1/s1.pdf", "p"),
        ("lab1/s2_2.rhai", "b"),
        ("lab1/s3/main.rhai", "c"),
        ("lab1/s4.zip", "d"),
        ("lab1/roster.csv", "id"),
        ("lab1/README.md", "r"),
    ]);
    assert_eq!(class.layout.name, "flat");
    assert_eq!(
        labels(&class),
        ["lab1/s1.pdf", "lab1/s2_2.rhai", "lab1/s3", "lab1/s4.zip"]
    );
    assert_eq!(paths(&class.people[0]), ["s1.pdf", "s1.rhai"]);
    assert_eq!(class.people[1].attempt, Some(2));
    assert_eq!(class.people[0].attempt, None);
    assert_eq!(class.people[1].hints[0], Hint::PathName("s2_2".to_owned()));
}

#[test]
fn a_class_of_one_is_known_by_any_name_on_the_way() {
    for files in [
        [("s1/submission.rhai", "a"), ("s1/brief.md", "b")],
        [("lab1/s1/submission.rhai", "a"), ("lab1/s1/brief.md", "b")],
        [("s1/lab1/submission.rhai", "a"), ("s1/lab1/brief.md", "b")],
        [("lab1/s1.rhai", "a"), ("lab1/s1.pdf", "b")],
    ] {
        let class = arranged(&files);
        assert_eq!(class.people.len(), 1, "{files:?}");
        let hint = Hint::PathName("s1".to_owned());
        assert!(class.people[0].hints.contains(&hint), "{files:?}");
        assert_eq!(class.people[0].files.len(), 2);
    }
}

#[test]
fn a_layout_can_be_given() {
    let source = tree(&[("s1.rhai", "a")]);
    assert_eq!(arrange_as(&source, "flat").unwrap().people.len(), 1);
    assert!(arrange_as(&source, "moodle").unwrap().people.is_empty());
    assert!(arrange_as(&source, "sakai").is_none());
}

#[test]
fn an_empty_source_has_nobody() {
    let empty = tree::<&str, &str>(&[]);
    let class = arrange(&empty);
    assert_eq!((class.layout.name, class.people.len()), ("flat", 0));
    let bed = tempfile::tempdir().unwrap();
    let empty = Tree::open(bed.path(), &Limits::default()).unwrap();
    assert!(arrange(&empty).people.is_empty());
}

#[test]
fn a_name_that_leads_elsewhere_is_a_row() {
    let class = arranged(&[("../s1.rhai", "a"), ("s2.rhai", "b")]);
    assert_eq!(labels(&class), ["../s1.rhai", "s2.rhai"]);
    assert!(class.people[0].files.is_empty());
    assert!(class.people[0].problems[0].what.contains("leads out"));
}
