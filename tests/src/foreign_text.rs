//! Errors quote what strangers wrote: a few words of an endless line, with whatever hides or steers written out.

use crate::testbed::{CommandResult, TestBed};

/// Override, escape and zero-width space as a message shows them.
const SHOWN: &str = "⟨U+202E⟩⟨U+001B⟩[31m⟨U+200B⟩";
const HIDDEN: &str = "\u{202e}\u{1b}[31m\u{200b}";

/// A message that fits on a screen and has no character that steers it.
fn reads_well(ran: &CommandResult) {
    for text in [&ran.stdout, &ran.stderr] {
        let is_plain =
            |c: char| c == '\n' || !(c.is_control() || HIDDEN.contains(c) && !"[31m".contains(c));
        assert!(text.chars().all(is_plain), "{text:?}");
        let longest = text.lines().map(|line| line.chars().count()).max();
        assert!(
            longest.unwrap_or_default() < 600,
            "{longest:?}: {text:.3000}"
        );
    }
    assert!(!ran.stderr.contains("panicked"), "{ran:?}");
}

/// The character of a source line that stands above the first sign below it.
fn above_the_caret(stderr: &str) -> Option<char> {
    let lines: Vec<Vec<char>> = stderr.lines().map(|line| line.chars().collect()).collect();
    let is_sign = |c: &char| matches!(c, '─' | '┬' | '▲');
    let below = lines.windows(2).find(|pair| pair[1].contains(&'·'))?;
    let at = below[1].iter().position(is_sign)?;
    below[0].get(at).copied()
}

#[test]
fn a_mistake_far_in_an_endless_line_is_shown_at_its_place() {
    let bed = TestBed::new();
    bed.write("submission.rhai", "fn control(o) { 0.0 }");
    let far = " ".repeat(70_000);
    let endless = " ".repeat(15 << 20);
    bed.write(
        "variant.toml",
        format!("format = 1\nlab = \"01-kinematics\"{far}zz = [\n"),
    );
    bed.write("far.toml", format!("format = 1\n{endless}zz = 1\n"));
    bed.write(
        "far.urdf",
        format!("<robot name=\"r\">{far}<zoint name=\"a\"/></robot>"),
    );
    for (args, code, found) in [
        (&["grade", "01-kinematics", "submission.rhai"][..], 2, 'z'),
        (&["scene", "check", "far.toml"], 3, 'z'),
        (&["robot", "show", "far.toml"], 3, 'z'),
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(code), "{args:?}: {ran:?}");
        reads_well(&ran);
        assert!(ran.stderr.contains(" …  "), "{args:?}: {ran:?}");
        assert_eq!(
            above_the_caret(&ran.stderr),
            Some(found),
            "{args:?}: {ran:?}"
        );
    }
    let ran = bed.run(&["robot", "show", "far.urdf"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    reads_well(&ran);
}

#[test]
fn a_key_and_a_name_without_end_are_cut() {
    let bed = TestBed::new();
    let name = "n".repeat(100_000);
    bed.write("scene.toml", format!("format = 1\n{name} = 1\n"));
    bed.write(
        "robot.toml",
        format!(
            "format = 1\nname = \"r\"\nlinks = [{{ name = \"{name}\" }}, {{ name = \"{name}\" }}]\n"
        ),
    );
    for args in [
        ["scene", "check", "scene.toml"],
        ["robot", "show", "robot.toml"],
    ] {
        let ran = bed.run(&args);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        assert!(
            ran.stderr.contains("nnn…nnn") || ran.stderr.contains("nnn…"),
            "{ran:?}"
        );
        reads_well(&ran);
    }
}

#[test]
fn what_is_too_large_is_not_called_no_text() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("submission.rhai", "fn control(o) { 0.0 }");
    bed.write("variant.toml", "#".repeat((1 << 20) + 1));
    let of_variant = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--variant",
        "variant.toml",
    ]);
    assert_eq!(of_variant.code, Some(2), "{of_variant:?}");
    bed.write("labs/01-kinematics/brief.md", "x".repeat((16 << 20) + 1));
    let of_brief = bed.run(&["new", "01-kinematics", "mine"]);
    assert_eq!(of_brief.code, Some(3), "{of_brief:?}");
    for ran in [of_variant, of_brief] {
        assert!(ran.stderr.contains("more than 1"), "{ran:?}");
        assert!(ran.stderr.contains("right file"), "{ran:?}");
        assert!(!ran.stderr.contains("save it as"), "{ran:?}");
    }
}

#[test]
fn names_and_lines_of_strangers_are_written_out() {
    let bed = TestBed::new();
    bed.write("submission.rhai", "fn control(o) { 0.0 }");
    bed.write(
        "variant.toml",
        format!("format = 1\nlab = \"01-kinematics\"\n\"{SHOWN}\" = '{HIDDEN}\n"),
    );
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    reads_well(&ran);
    assert!(ran.stderr.contains(SHOWN), "{ran:?}");
    // a key by an escape of TOML: the quoted line has none, and the message would
    bed.write(
        "scene.toml",
        "format = 1\n\"\\u202e\\u001b[31m\\u200b\" = 1\n",
    );
    let ran = bed.run(&["scene", "check", "scene.toml"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    reads_well(&ran);
    assert!(ran.stderr.contains(SHOWN), "{ran:?}");
    // what is not there, what is no file, what cannot be a word here: names as a shell types them
    let name = format!("n{HIDDEN}");
    for args in [
        &["grade", "01-kinematics", &name][..],
        &["grade", &name, "submission.rhai"],
        &["grade", "01-kinematics", "submission.rhai", "--labs", &name],
        &[
            "grade",
            "01-kinematics",
            "submission.rhai",
            "--reference",
            &name,
        ],
        &["grade", "01-kinematics", "submission.rhai", &name],
        &["robot", "show", &name],
        &["scene", "check", &name],
        &["verify", &name],
        &["compare", &name, &name],
        &["course", "check", "--course", &name],
        &["log", "export", &name, "--csv"],
        &["lab", "pack", &name, "--for", "students"],
        &[&name],
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{args:?}: {ran:?}");
        reads_well(&ran);
        let stderr = ran.stderr.replace("\n  │ ", "");
        assert!(stderr.contains(SHOWN), "{args:?}: {ran:?}");
    }
}

/// Folders and files of students, which need not be Unicode.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_is_not_unicode_is_graded_and_named_plainly() {
    use std::os::unix::ffi::OsStrExt as _;
    let bed = TestBed::new();
    let folder = std::ffi::OsStr::from_bytes(b"m\xfcller\x1b[2J");
    std::fs::create_dir(bed.path("").join(folder)).expect("folder");
    let file = std::path::Path::new(folder).join("submission.rhai");
    std::fs::write(bed.path("").join(&file), "fn control(o) { 0.0 }").expect("file");
    let mut command = bed.command(&["grade", "01-kinematics"]);
    let ran: CommandResult = command.arg(&file).output().expect("runs").into();
    assert_eq!(ran.code, Some(1), "{ran:?}");
    reads_well(&ran);
    let mut command = bed.command(&["grade", "01-kinematics"]);
    command.arg(std::path::Path::new(folder).join("none.rhai"));
    let ran: CommandResult = command.output().expect("runs").into();
    assert_eq!(ran.code, Some(2), "{ran:?}");
    reads_well(&ran);
    assert!(ran.stderr.contains("⟨U+001B⟩[2J"), "{ran:?}");
}

#[test]
fn a_line_without_end_of_a_submission_is_quoted_around_its_mistake() {
    let bed = TestBed::new();
    let line = format!(
        "fn control(o) {{ {}let 日本 = nosuch(1); {} }}",
        "let a = 1; ".repeat(2_000),
        "let b = 2; ".repeat(2_000)
    );
    bed.write("submission.rhai", line);
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    reads_well(&ran);
    let lines: Vec<&str> = ran.stdout.lines().collect();
    let at = lines.iter().position(|line| line.starts_with("    1 | …"));
    let at = at.unwrap_or_else(|| panic!("{ran:?}"));
    let caret = lines[at + 1]
        .chars()
        .position(|c| c == '^')
        .expect("a caret");
    assert_eq!(lines[at].chars().nth(caret), Some('日'), "{ran:?}");
    let record = std::fs::read_to_string(bed.path("out/grade.json")).expect("record");
    let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
    let stopped = &record["tasks"][0]["stopped"];
    assert_eq!(stopped["column"], 22_021, "{stopped}");
    let column = stopped["source_column"].as_u64().expect("a column");
    let text = stopped["source_line"].as_str().expect("a line");
    assert_eq!(
        text.chars().nth(column as usize - 1),
        Some('日'),
        "{stopped}"
    );
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("page");
    assert!(page.contains("<code>…") && !page.contains(&"let a = 1; ".repeat(40)));
}
