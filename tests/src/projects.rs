//! A submission in Rust or C: the project that `new` writes, and what commands do in it.

use crate::testbed::{TestBed, files_below, root};

fn shipped(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).expect("a file of the checkout")
}

fn names(bed: &TestBed, folder: &str) -> Vec<String> {
    let files = files_below(&bed.path(folder));
    files.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn a_project_has_all_that_it_needs_to_build() {
    let bed = TestBed::named("Übung 1");
    for (lang, source, starter, build) in [
        ("c", "submission.c", "starter.c", "clang --target=wasm32 "),
        ("rust", "src/lib.rs", "starter.rs", "cargo build --release "),
    ] {
        let ran = bed.run(&["new", "01-kinematics", lang, "--lang", lang]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(
            ran.stdout.contains(&format!("then edit {lang}/{source}")),
            "{ran:?}"
        );
        assert!(ran.stdout.contains(build), "{ran:?}");
        let text = |name: &str| std::fs::read_to_string(bed.path(lang).join(name)).expect(name);
        assert_eq!(
            text(source),
            shipped(&format!("labs/01-kinematics/{starter}"))
        );
        assert!(text("README.md").contains(build) && text("README.md").contains("kinemark grade"));
        assert!(text("kinemark.toml").contains("01-kinematics"));
        assert!(text(".gitignore").contains("/out/"));
        assert!(text(".vscode/tasks.json").contains("--build"));
        let names = names(&bed, lang);
        assert!(
            !names.iter().any(|name| name.ends_with(".rhai")),
            "{names:?}"
        );
        // nothing of a student's work is overwritten
        let again = bed.run(&["new", "01-kinematics", lang, "--lang", lang]);
        assert_eq!(again.code, Some(2), "{again:?}");
    }
    assert_eq!(
        std::fs::read_to_string(bed.path("c/kinemark.h")).expect("the header"),
        shipped("grader/plugin/c/kinemark.h")
    );
    let of_crate: Vec<String> = names(&bed, "rust")
        .into_iter()
        .filter(|name| name.starts_with("kinemark-plugin/src/"))
        .collect();
    assert_eq!(
        of_crate.len(),
        files_below(&root().join("grader/plugin/rust/src")).len()
    );
    // nothing names another script's language, and the default is a script
    let ran = bed.run(&["new", "01-kinematics", "plain"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(bed.path("plain/submission.rhai").is_file());
    let ran = bed.run(&["new", "01-kinematics", "other", "--lang", "cobol"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("rhai, rust, c"), "{ran:?}");
}

#[test]
fn a_project_has_the_variant_of_its_student() {
    let bed = TestBed::new();
    bed.copy_labs();
    let args = [
        "new",
        "02-jacobian-velocity",
        "s7",
        "--lang",
        "c",
        "--student",
        "s7",
    ];
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let variant = std::fs::read_to_string(bed.path("s7/variant.toml")).expect("a variant");
    assert!(variant.contains("\"s7\""), "{variant}");
}

/// An instructor's new lab has a starter in Rhai alone.
#[test]
fn a_lab_without_such_a_starter_gets_the_functions_of_its_tasks() {
    let bed = TestBed::new();
    bed.copy_labs();
    for (lab, starter) in [
        ("01-kinematics", "starter.c"),
        ("02-jacobian-velocity", "starter.rs"),
    ] {
        std::fs::remove_file(bed.path("labs").join(lab).join(starter)).expect("removed");
    }
    let ran = bed.run(&["new", "01", "c", "--lang", "c"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(bed.path("c/submission.c")).expect("a starter");
    for function in [
        "km_forward_kinematics(",
        "km_inverse_kinematics(",
        "km_control(",
    ] {
        assert_eq!(text.matches(function).count(), 1, "{text}");
    }
    let ran = bed.run(&["new", "02", "r", "--lang", "rust"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(bed.path("r/src/lib.rs")).expect("a starter");
    assert!(text.contains("export!(Work: jacobian, control);"), "{text}");
    assert!(
        text.contains("Tasks \"line\", \"through-the-shoulder\""),
        "{text}"
    );
}

#[test]
fn labs_are_checked_and_packed_with_these_starters() {
    let bed = TestBed::new();
    bed.copy_labs();
    let check = [
        "lab",
        "check",
        "00-step-response",
        "--variants",
        "0",
        "--salts",
        "0",
    ];
    let ran = bed.run(&check);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for starter in ["starter.rs", "starter.c"] {
        assert!(ran.stdout.contains(starter), "{ran:?}");
    }
    bed.edit(
        "labs/00-step-response/starter.c",
        "void km_control",
        "void control",
    );
    let ran = bed.run(&check);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("starter.c does not define `control`"),
        "{ran:?}"
    );
    let pack = [
        "lab",
        "pack",
        "01-kinematics",
        "--for",
        "students",
        "--out",
        "p.zip",
    ];
    let ran = bed.run(&pack);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let archive = std::fs::File::open(bed.path("p.zip")).expect("a pack");
    let archive = zip::ZipArchive::new(archive).expect("an archive");
    let names = archive
        .file_names()
        .map(|name| name.expect("a name").into_owned());
    let names: Vec<String> = names.collect();
    for starter in ["starter.rhai", "starter.rs", "starter.c"] {
        let path = format!("01-kinematics/labs/01-kinematics/{starter}");
        assert!(names.contains(&path), "{names:?}");
    }
    // what students must not have is searched for in every language
    let solution = shipped("reference/01-kinematics/rust/src/lib.rs");
    let secret = solution
        .lines()
        .find(|line| line.trim().len() > 60 && line.contains("let "));
    let starter = bed.path("labs/01-kinematics/starter.rs");
    let text = std::fs::read_to_string(&starter).expect("a starter");
    std::fs::write(
        &starter,
        format!("{text}{}\n", secret.expect("a long line")),
    )
    .expect("written");
    let ran = bed.run(&[
        "lab",
        "pack",
        "01-kinematics",
        "--for",
        "students",
        "--out",
        "q.zip",
    ]);
    assert_ne!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stderr.contains("starter.rs"), "{ran:?}");
}
