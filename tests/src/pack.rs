//! `kinemark lab pack`: what students get works and gives nothing away; what course staff get is all of it.

use std::path::Path;

use kinemark_grader::lab::load::lab_names;

use crate::testbed::{CommandResult, Folder, TestBed, files_below, root};

/// Unpacks an archive of the bed into a folder of it.
fn unpack(bed: &TestBed, archive: &str, folder: &str) {
    let file = std::fs::File::open(bed.path(archive)).expect("an archive");
    let mut archive = zip::ZipArchive::new(file).expect("a ZIP");
    archive.extract(bed.path(folder)).expect("unpacked");
}

fn run_in(bed: &TestBed, folder: &str, args: &[&str]) -> CommandResult {
    let mut command = bed.command(args);
    command.current_dir(bed.path(folder));
    command.output().expect("the binary runs").into()
}

/// Lines of a program that are no one's but its author's: long, and neither a comment nor the first line of a function.
fn own_lines(program: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(program).expect("a program");
    let code = |line: &str| {
        line.split("//")
            .next()
            .unwrap_or_default()
            .trim()
            .to_owned()
    };
    let mut lines: Vec<String> = text.lines().map(code).collect();
    lines.retain(|line| line.chars().count() >= 40 && !line.starts_with("fn "));
    lines
}

#[test]
fn a_pack_for_students_gives_nothing_away_and_grades_as_at_home() {
    for lab in lab_names(&Folder(root().join("labs"))) {
        let bed = TestBed::new();
        bed.copy_labs();
        let ran = bed.run(&["lab", "pack", &lab, "--for", "students"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert_eq!(ran.stderr, "");
        let archive = format!("{lab}-students.zip");
        unpack(&bed, &archive, "home");

        let reference = root().join("reference").join(&lab);
        let hidden = std::fs::read_to_string(reference.join("hidden.toml")).expect("hidden.toml");
        let hidden: toml::Table = hidden.parse().expect("TOML");
        let mut secrets = own_lines(&reference.join("solution.rhai"));
        assert!(secrets.len() > 2, "{lab}");
        secrets.push(hidden["salt"].as_str().expect("a salt").to_owned());
        let files = files_below(&bed.path("home"));
        for (name, bytes) in &files {
            assert!(name.starts_with(&format!("{lab}/")), "{name}");
            for part in ["hidden", "solution", "mutant", "reference/"] {
                assert!(!name.contains(part), "{name}");
            }
            let text = String::from_utf8_lossy(bytes);
            for secret in &secrets {
                assert!(!text.contains(secret.as_str()), "{name} has {secret:?}");
            }
        }
        let others = lab_names(&Folder(bed.path(&format!("home/{lab}/labs"))));
        assert_eq!(others, [lab.as_str()]);

        // outside of the checkout's copy, where nothing else is found
        let away = TestBed::new();
        std::fs::copy(bed.path(&archive), away.path("lab.zip")).expect("copied");
        unpack(&away, "lab.zip", ".");
        let good = root().join(format!("tests/submissions/{lab}/good/submission.rhai"));
        std::fs::copy(good, away.path(&format!("{lab}/submission.rhai"))).expect("copied");
        let ran = run_in(&away, &lab, &["grade", &lab, "submission.rhai", "--json"]);
        let at_home = run_in(
            &bed,
            ".",
            &[
                "grade",
                &lab,
                &format!("{}/{lab}/submission.rhai", away.path(".").display()),
                "--json",
                "--practice",
            ],
        );
        assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
        assert_eq!(ran.stdout, at_home.stdout, "{lab}");
        assert!(ran.stdout.contains("\"mode\": \"practice\""));
    }
}

/// No robot has a file there: nothing but the lab says that the folder is one of labs.
#[test]
fn a_lab_of_a_row_of_joints_alone_is_found_and_handed_out() {
    let bed = TestBed::new();
    let new = ["lab", "new", "12-row", "--robot", "RzTxRy", "--task", "fk"];
    let ran = bed.run(&new);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&["lab", "check", "12-row", "--quick"]);
    assert_eq!(ran.code, Some(1), "its TODOs alone: {ran:?}");
    let ran = bed.run(&["lab", "pack", "12-row", "--for", "students"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let away = TestBed::new();
    let archive = "12-row-students.zip";
    std::fs::copy(bed.path(archive), away.path(archive)).expect("copied");
    unpack(&away, archive, ".");
    let ran = run_in(&away, "12-row", &["grade", "12-row", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "the starter is graded: {ran:?}");
}

#[test]
fn an_unpacked_pack_serves_every_command_of_a_student() {
    let bed = TestBed::new();
    bed.copy_labs();
    // a lab of the course's own, which no binary has
    for folder in ["labs", "reference"] {
        let from = bed.path(&format!("{folder}/01-kinematics"));
        std::fs::rename(from, bed.path(&format!("{folder}/10-own"))).expect("renamed");
    }
    bed.edit("labs/10-own/lab.toml", "01-kinematics", "10-own");
    let pack = |out: &str| {
        let ran = bed.run(&["lab", "pack", "10-own", "--for", "students", "--out", out]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(ran.stdout.contains("kinemark grade 10-own submission.rhai"));
        std::fs::read(bed.path(out)).expect("an archive")
    };
    assert_eq!(
        pack("one.zip"),
        pack("two.zip"),
        "the same files, the same bytes"
    );
    let away = TestBed::new();
    away.write("lab.zip", pack("three.zip"));
    unpack(&away, "lab.zip", ".");
    let ran = run_in(&away, "10-own", &["grade", "10-own", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("practice: visible cases only"),
        "{ran:?}"
    );
    let ran = run_in(&away, "10-own", &["new", "10-own", "again"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = run_in(
        &away,
        "10-own/again",
        &["grade", "10-own", "submission.rhai"],
    );
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let ran = run_in(&away, "10-own", &["submit", "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(!ran.stdout.contains("lab-changed"), "{ran:?}");

    away.edit("10-own/labs/10-own/lab.toml", "points = ", "points = 1");
    let ran = run_in(&away, "10-own", &["submit", "--json"]);
    assert!(ran.stdout.contains("\"lab-changed\""), "{ran:?}");
    away.edit(
        "10-own/labs/10-own/handed-out.json",
        "kinemark 0",
        "kinemark 9",
    );
    let ran = run_in(&away, "10-own", &["submit", "--json"]);
    assert!(ran.stdout.contains("\"other-engine\""), "{ran:?}");
}

#[test]
fn what_students_must_not_get_is_found_with_its_place() {
    let bed = TestBed::new();
    bed.copy_labs();
    let pack = |more: &[&str]| {
        let args = [
            "lab",
            "pack",
            "01-kinematics",
            "--for",
            "students",
            "--force",
        ];
        bed.run(&[&args, more].concat())
    };
    let line = own_lines(&root().join("reference/01-kinematics/solution.rhai"))[0].clone();
    let starter = "labs/01-kinematics/starter.rhai";
    let text = std::fs::read_to_string(bed.path(starter)).expect("starter");
    bed.write(starter, format!("{}\n{text}", line.replace(' ', "  ")));
    let ran = pack(&[]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let place = "01-kinematics/submission.rhai:1 is 01-kinematics/solution.rhai:";
    assert!(ran.stderr.contains(place), "{ran:?}");
    assert!(!bed.path("01-kinematics-students.zip").exists());
    let ran = pack(&["--allow-shared-lines"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stderr.contains("lines of the solution"), "{ran:?}");

    bed.write(starter, format!("{text}\n// kinemark-01-kinematics\n"));
    let ran = pack(&["--allow-shared-lines"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(
        ran.stderr
            .contains("the salt is in `01-kinematics/submission.rhai`, line"),
        "{ran:?}"
    );
    // the course's own salt counts, too
    bed.write(starter, format!("{text}\n// a salt of our own\n"));
    let ran = pack(&["--salt", "a salt of our own"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
}

#[test]
fn each_student_gets_a_folder_with_a_variant() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("roster.csv", "id,name\ns1000,One\ns1001,Two\n");
    let pack = |more: &[&str], out: &str| {
        let args = [
            "lab",
            "pack",
            "01-kinematics",
            "--for",
            "students",
            "--out",
            out,
        ];
        let ran = bed.run(&[&args, more].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
        std::fs::read(bed.path(out)).expect("an archive")
    };
    let of_roster = pack(&["--roster", "roster.csv"], "one.zip");
    let of_ids = pack(&["--student", "s1000", "--student", "s1001"], "two.zip");
    assert_eq!(of_roster, of_ids);
    let away = TestBed::new();
    away.write("labs.zip", of_roster);
    unpack(&away, "labs.zip", ".");
    for id in ["s1000", "s1001"] {
        let ran = run_in(
            &away,
            id,
            &["grade", "01-kinematics", "submission.rhai", "--json"],
        );
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(
            ran.stdout.contains(&format!("\"student\": \"{id}\"")),
            "{ran:?}"
        );
        // the numbers are those that course staff grade with
        let path = away.path(id).join("variant.toml");
        let path = path.to_str().expect("UTF-8");
        let ran = bed.run(&["lab", "variant", "01-kinematics", "--student", id]);
        assert_eq!(ran.stdout, std::fs::read_to_string(path).expect("variant"));
    }
}

#[test]
fn after_the_due_date_students_get_the_solution_and_nothing_else() {
    let bed = TestBed::new();
    bed.copy_labs();
    let lab = "01-kinematics";
    let pack = |out: &str, more: &[&str]| {
        let args = ["lab", "pack", lab, "--for", "students", "--out", out];
        let ran = bed.run(&[&args[..], more].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
        unpack(&bed, out, &format!("{out}-unpacked"));
        let files = files_below(&bed.path(&format!("{out}-unpacked")));
        (ran, files)
    };
    let (_, before) = pack("before.zip", &[]);
    let (ran, after) = pack("after.zip", &["--with-solution"]);
    assert!(ran.stderr.contains("after the due date"), "{ran:?}");
    let more = after.iter().filter(|file| !before.contains(file));
    let more: Vec<&str> = more.map(|(path, _)| path.as_str()).collect();
    let [readme, solutions @ ..] = &more[..] else {
        panic!("{more:?}");
    };
    assert_eq!(*readme, "01-kinematics/README.md");
    let folder = "01-kinematics/solution/";
    let names: Vec<_> = solutions
        .iter()
        .map(|path| path.strip_prefix(folder))
        .collect();
    let expected = ["solution.c", "solution.py", "solution.rhai"];
    assert_eq!(names, expected.map(Some));
    let home = "after.zip-unpacked/01-kinematics";
    let ran = run_in(&bed, home, &["grade", lab, "solution/solution.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");

    // the salt stays out, and it is for students alone
    bed.edit(
        "reference/01-kinematics/solution.rhai",
        "fn ",
        "// kinemark-01-kinematics\nfn ",
    );
    let ran = bed.run(&["lab", "pack", lab, "--for", "students", "--with-solution"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let ran = bed.run(&["lab", "pack", lab, "--for", "staff", "--with-solution"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}

#[test]
fn course_staff_get_a_folder_in_which_hidden_cases_are_graded() {
    let bed = TestBed::new();
    bed.copy_labs();
    let ran = bed.run(&["lab", "pack", "01-kinematics", "--for", "staff"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("do not give it to students"), "{ran:?}");
    let away = TestBed::new();
    std::fs::copy(bed.path("01-kinematics-staff.zip"), away.path("lab.zip")).expect("copied");
    unpack(&away, "lab.zip", ".");
    let folder = "01-kinematics-staff";
    let readme = std::fs::read_to_string(away.path(folder).join("README.md")).expect("README");
    let command = "kinemark grade 01-kinematics reference/01-kinematics/solution.rhai";
    assert!(readme.contains(command), "{readme}");
    let args: Vec<&str> = command.split(' ').skip(1).collect();
    let ran = run_in(&away, folder, &args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("graded on visible and hidden cases"),
        "{ran:?}"
    );
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        let file = bed.path("01-kinematics-staff.zip");
        let mode = file.metadata().expect("file").permissions().mode();
        assert_eq!(mode & 0o077, 0, "only its owner reads it");
    }
}

#[test]
fn options_of_other_packs_and_files_that_are_there_are_refused() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("01-kinematics-staff.zip", "mine");
    for (args, words) in [
        (&["--for", "staff"][..], "already exists"),
        (
            &["--for", "staff", "--out", "x", "--student", "s1"],
            "--student means nothing with --for staff",
        ),
        (
            &["--for", "students", "--binary", "x"],
            "--binary means nothing with --for students",
        ),
        (
            &["--for", "staff", "--out", "x", "--hidden-at-upload"],
            "use --for gradescope",
        ),
        (
            &["--for", "students", "--student", "a", "--student", "A"],
            "named twice",
        ),
        (
            &["--for", "students", "--roster", "none.csv"],
            "there is no such file",
        ),
        (
            &["--for", "gradescope", "--binary", "none"],
            "there is no file `none`",
        ),
    ] {
        let ran = bed.run(&[&["lab", "pack", "01-kinematics"], args].concat());
        assert_eq!(ran.code, Some(2), "{args:?}: {ran:?}");
        assert!(ran.stderr.contains(words), "{args:?}: {ran:?}");
    }
    std::fs::remove_dir_all(bed.path("reference")).expect("removed");
    let ran = bed.run(&["lab", "pack", "01-kinematics", "--for", "gradescope"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("course staff's part was not found"),
        "{ran:?}"
    );
}
