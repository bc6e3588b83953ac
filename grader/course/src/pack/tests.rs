//! Packs of a lab that is made in memory.

use kinemark_grader::lab::copies::Copies;

use super::*;
use crate::roster::Roster;

const ROBOT: &str = include_str!("../../../../labs/robots/rrbot.toml");
const LAB: &str = r#"
format = 1
name = "10-own"
title = "Where is it?"
robot = "rrbot"
frame = "lab"

[parameters]
bend = 0.5

[variants]
bend = { from = 0.4, to = 0.6, step = 0.1 }

[[tasks]]
name = "fk"
title = "Where is it?"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "bent", q_rad = [0.5, "= bend"] }]
[[tasks.checks]]
name = "position"
title = "The position"
points = 2.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }
"#;

fn labs() -> Copies {
    Copies::from_texts([
        ("robots/rrbot.toml", ROBOT),
        ("robots/other.toml", "next month's"),
        ("11-next/lab.toml", "next month's"),
        ("10-own/lab.toml", LAB),
        ("10-own/brief.md", "# Own\n\nBend 0.5<!-- = bend -->.\n"),
        ("10-own/starter.rhai", "// begin here\n"),
        ("10-own/frame.svg", "<svg/>"),
        ("10-own/.frame.svg.swp", "junk"),
        ("10-own/notes.txt", "for colleagues"),
    ])
}

fn reference() -> Copies {
    Copies::from_texts([
        ("10-own/solution.rhai", "// solved\n"),
        (
            "10-own/hidden.toml",
            "format = 1\nsalt = \"a salt of ours\"\n",
        ),
        ("10-own/mutants/one.rhai", "// wrong\n"),
        ("10-own/notes~", "junk"),
        ("11-next/solution.rhai", "next month's"),
    ])
}

fn paths(files: &[ArchiveFile]) -> Vec<&str> {
    files.iter().map(|file| file.path.as_str()).collect()
}

fn text<'f>(files: &'f [ArchiveFile], path: &str) -> &'f str {
    let file = files.iter().find(|file| file.path == path);
    let file = file.unwrap_or_else(|| panic!("no {path} in {:?}", paths(files)));
    std::str::from_utf8(&file.bytes).unwrap()
}

#[test]
fn students_get_the_lab_ready_to_work_in_and_nothing_else() {
    let files = labs();
    let lab = Lab::load(&files, "10-own").unwrap();
    let packed = PackedLab {
        files: &files,
        lab: &lab,
    };
    let pack = for_students(packed, &[], &[]).unwrap();
    assert_eq!(
        paths(&pack),
        [
            "10-own/README.md",
            "10-own/submission.rhai",
            "10-own/brief.html",
            "10-own/brief.md",
            "10-own/kinemark.toml",
            "10-own/frame.svg",
            "10-own/.vscode/extensions.json",
            "10-own/.vscode/tasks.json",
            "10-own/editor/kinemark.d.rhai",
            "10-own/script-language.md",
            "10-own/labs/10-own/brief.md",
            "10-own/labs/10-own/frame.svg",
            "10-own/labs/10-own/handed-out.json",
            "10-own/labs/10-own/lab.toml",
            "10-own/labs/10-own/starter.rhai",
            "10-own/labs/robots/rrbot.toml",
        ]
    );
    let readme = text(&pack, "10-own/README.md");
    assert!(readme.contains("\nkinemark grade 10-own submission.rhai\n"));
    let note = text(&pack, "10-own/labs/10-own/handed-out.json");
    let note = HandedOut::parse(note.as_bytes()).unwrap();
    assert_eq!(note.lab_digest, lab_version(&lab));
}

#[test]
fn each_student_gets_a_folder_with_their_numbers() {
    let files = labs();
    let lab = Lab::load(&files, "10-own").unwrap();
    let variants = ["s1", "../s2"].map(|student| {
        let variant = lab.variant_of("a salt of ours", student).unwrap();
        Lab::load_variant(&files, "10-own", Some(&variant)).unwrap()
    });
    let packed = PackedLab {
        files: &files,
        lab: &lab,
    };
    let pack = for_students(packed, &variants, &[]).unwrap();
    let inside = |path: &str| path.starts_with("s1/") || path.starts_with("~2e~.~2f~s2/");
    assert!(
        pack.iter().all(|file| inside(&file.path)),
        "{:?}",
        paths(&pack)
    );
    assert!(text(&pack, "s1/variant.toml").contains("student = \"s1\""));
    let shared = |folder: &str| text(&pack, &format!("{folder}/labs/10-own/lab.toml")) == LAB;
    assert!(shared("s1") && shared("~2e~.~2f~s2"));
    assert!(text(&pack, "s1/README.md").contains("the numbers of `s1`"));
}

#[test]
fn course_staff_get_all_of_this_lab_and_nothing_of_another() {
    let (files, reference) = (labs(), reference());
    let lab = Lab::load(&files, "10-own").unwrap();
    let packed = PackedLab {
        files: &files,
        lab: &lab,
    };
    let pack = for_staff(packed, &reference, Some("our own salt")).unwrap();
    let paths = paths(&pack);
    for path in [
        "labs/10-own/notes.txt",
        "reference/10-own/solution.rhai",
        "reference/10-own/hidden.toml",
        "reference/10-own/mutants/one.rhai",
        "salt",
    ] {
        assert!(
            paths.contains(&format!("10-own-staff/{path}").as_str()),
            "{path}"
        );
    }
    for part in ["11-next", "other.toml", "swp", "notes~"] {
        assert!(!paths.iter().any(|path| path.contains(part)), "{part}");
    }
    let error = for_staff(packed, &Copies::default(), None).unwrap_err();
    assert!(matches!(error, PackError::NoReference { .. }), "{error}");
}

#[test]
fn an_autograder_has_its_scripts_at_the_top_and_no_names() {
    let (files, reference) = (labs(), reference());
    let lab = Lab::load(&files, "10-own").unwrap();
    let packed = PackedLab {
        files: &files,
        lab: &lab,
    };
    let roster = b"id,name,email\ns1,Somebody,s1@example.org\n";
    let roster = Roster::parse("roster.csv", roster).unwrap();
    let elf = |machine: u8| {
        let mut header = b"\x7fELF\x02\x01".to_vec();
        header.resize(64, 0);
        header[18] = machine;
        header
    };
    let (arm, intel) = (elf(183), elf(62));
    let mut with = Autograder {
        reference: &reference,
        salt: None,
        roster: Some(&roster),
        hidden_at_upload: false,
        binary: ("kinemark", &arm),
    };
    let error = autograder(packed, with).unwrap_err();
    assert!(matches!(error, PackError::NotLinux { .. }), "{error}");
    with.binary = ("kinemark", &intel);
    let pack = autograder(packed, with).unwrap();
    let executable = pack.iter().filter(|file| file.is_executable);
    let executable: Vec<&str> = executable.map(|file| file.path.as_str()).collect();
    assert_eq!(executable, ["setup.sh", "run_autograder", "kinemark"]);
    let run = text(&pack, "run_autograder");
    assert!(run.starts_with("#!/usr/bin/env bash\n"));
    assert!(run.contains(" autograder 10-own --source "));
    assert!(!run.contains('@') && !text(&pack, "setup.sh").contains('@'));
    assert_eq!(
        text(&pack, "roster.csv"),
        "id,email,username,lms_id\ns1,s1@example.org,,\n"
    );
    with.hidden_at_upload = true;
    let pack = autograder(packed, with).unwrap();
    assert!(text(&pack, "run_autograder").contains(" 10-own --hidden-at-upload --source "));
}
