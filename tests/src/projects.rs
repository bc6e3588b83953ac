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
    assert!(ran.stderr.contains("rhai, python, rust, c"), "{ran:?}");
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

/// A module of lab 1 with these functions, as text.
fn module(more: &str) -> Vec<u8> {
    let text = format!(
        "(module (memory (export \"memory\") 2)
         (func (export \"km_version\") (result i32) i32.const 1)
         (func (export \"km_buffer\") (param i32) (result i32) i32.const 1024)
         (func (export \"km_inverse_kinematics\") (param i32 i32 i32 i32) (result i32) i32.const 0)
         (func (export \"km_forward_kinematics\") (param i32 i32 i32) {more})
         (func (export \"km_control\") (param $o i32) (param i32)
           (f64.store (local.get 1) (f64.const 0)) (f64.store offset=8 (local.get 1) (f64.const 0))))"
    );
    wat::parse_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// One that places the hand at x = `x`.
fn at(x: f64) -> Vec<u8> {
    module(&format!(
        "(f64.store (local.get 2) (f64.const {x})) (f64.store offset=8 (local.get 2) (f64.const 0))
         (f64.store offset=16 (local.get 2) (f64.const 0))"
    ))
}

/// The digest of the submission in the last report of a folder.
fn graded(bed: &TestBed, folder: &str) -> String {
    let record = std::fs::read(bed.path(folder).join("out/grade.json")).expect("a record");
    let record: serde_json::Value = serde_json::from_slice(&record).expect("JSON");
    record["submission"]["digest"]
        .as_str()
        .expect("a digest")
        .to_owned()
}

fn digest(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

const CARGO_MODULE: &str = "target/wasm32-unknown-unknown/release/submission.wasm";

#[test]
fn the_module_of_a_project_is_found_and_a_choice_is_never_silent() {
    let bed = TestBed::named("Übung 1");
    bed.run(&["new", "01-kinematics", "r", "--lang", "rust"]);
    let folder = bed.path("r");
    // not built yet: graded as such, with the line that builds it
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("there is no module yet in `.`"),
        "{ran:?}"
    );
    assert!(ran.stdout.contains("cargo build --release"), "{ran:?}");
    // where cargo leaves it
    let (one, other) = (at(1.0), at(2.0));
    bed.write(&format!("r/{CARGO_MODULE}"), &one);
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("0/4") || ran.stdout.contains("of 24 points"),
        "{ran:?}"
    );
    assert!(!ran.stdout.contains("did-not-build"), "{ran:?}");
    assert_eq!(graded(&bed, "r"), digest(&one));
    // from outside, by its folder: the report stays with it
    for words in [
        vec!["grade", "01-kinematics", "r"],
        vec!["grade", "01", "r"],
    ] {
        let ran = bed.run(&words);
        assert!(ran.stdout.contains("report: r/out/report.html"), "{ran:?}");
    }
    // another module beside the sources: nobody can say which one counts, unless it is named
    bed.write("r/submission.wasm", &other);
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("2 different modules"), "{ran:?}");
    let ran = bed.run_in(&folder, &["grade", "01", "submission.wasm"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!(graded(&bed, "r"), digest(&other));
    let ran = bed.run_in(&folder, &["grade", "01", CARGO_MODULE, "--out", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!(graded(&bed, "r"), digest(&one));
    // a copy is one module with it
    bed.write("r/submission.wasm", &one);
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    // and so is a script beside a module for a person to decide
    bed.write("r/submission.rhai", "");
    let ran = bed.run_in(&folder, &["grade"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("both `submission.rhai` and a module"),
        "{ran:?}"
    );
    let ran = bed.run(&["grade", "01-kinematics", "r"]);
    assert!(
        ran.stdout.contains("2 files may be the submission"),
        "{ran:?}"
    );
}

#[test]
fn sources_newer_than_the_module_are_a_note_and_change_no_grade() {
    let bed = TestBed::new();
    bed.run(&["new", "01-kinematics", "c", "--lang", "c"]);
    let set = |name: &str, seconds: u64| {
        let file = std::fs::File::options()
            .append(true)
            .open(bed.path(name))
            .expect("a file");
        let time = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(seconds);
        file.set_modified(time).expect("a time");
    };
    bed.write("c/submission.wasm", at(1.0));
    for name in ["c/kinemark.h", "c/submission.c"] {
        set(name, 1_000_000);
    }
    set("c/submission.wasm", 2_000_000);
    let ran = bed.run_in(&bed.path("c"), &["grade"]);
    assert!(!ran.stderr.contains("newer than the module"), "{ran:?}");
    let before = std::fs::read(bed.path("c/out/grade.json")).expect("a record");
    set("c/submission.c", 3_000_000);
    let ran = bed.run_in(&bed.path("c"), &["grade"]);
    assert!(
        ran.stderr.contains("the sources are newer than the module"),
        "{ran:?}"
    );
    assert!(ran.stderr.contains("clang --target=wasm32"), "{ran:?}");
    assert_eq!(
        std::fs::read(bed.path("c/out/grade.json")).expect("a record"),
        before
    );
}

#[test]
fn a_build_is_refused_where_it_could_read_the_course_staffs_files() {
    let bed = TestBed::new();
    bed.run(&["new", "01-kinematics", "c", "--lang", "c"]);
    bed.copy_labs();
    let ran = bed.run(&["grade", "01-kinematics", "c", "--build"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("could read the course staff's"),
        "{ran:?}"
    );
    let bed = TestBed::new();
    bed.run(&["new", "01-kinematics", "c", "--lang", "c"]);
    bed.write("course.toml", "");
    let ran = bed.run(&["grade", "01-kinematics", "c", "--build", "--practice"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    // a script is not built
    let bed = TestBed::new();
    bed.run(&["new", "01-kinematics"]);
    let ran = bed.run(&["grade", "01-kinematics", "--build"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("is no project that can be built"),
        "{ran:?}"
    );
}

#[cfg(unix)]
mod built {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;
    use crate::testbed::{CommandResult, Serving};
    use crate::watch::newer;

    /// In place of compilers: a source names in its first line the module that it makes, or what is wrong with it.
    const COMPILER: &str = "#!/bin/sh\nset -e\ntools=$(dirname \"$0\")\n\
        case \"$0\" in *cargo) source=src/lib.rs; made=target/wasm32-unknown-unknown/release/submission.wasm;; \
        *) source=submission.c; made=submission.wasm;; esac\n\
        echo \"$@\" >> \"$tools/arguments\"\nread -r first < $source\n\
        if [ ! -f \"$tools/$first\" ]; then echo \"$source:1:1: error: no $first\" >&2; exit 1; fi\n\
        mkdir -p \"$(dirname \"$made\")\"\ncp \"$tools/$first\" \"$made\"\n";

    /// A project whose compiler is a script.
    fn bed(lang: &str) -> TestBed {
        let bed = TestBed::named("Übung 1");
        let ran = bed.run(&["new", "01-kinematics", "p", "--lang", lang]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        for tool in ["clang", "cargo"] {
            bed.write(&format!("tools/{tool}"), COMPILER);
            let path = bed.path("tools").join(tool);
            std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o755)).expect("runs");
        }
        bed.write("tools/one", at(1.0));
        bed.write("tools/two", at(2.0));
        bed
    }

    fn tools(bed: &TestBed) -> String {
        format!("{}:/usr/bin:/bin", bed.path("tools").display())
    }

    fn run(bed: &TestBed, path: &str, args: &[&str]) -> CommandResult {
        let mut command = bed.command(args);
        let ran = command
            .current_dir(bed.path("p"))
            .env("PATH", path)
            .output();
        ran.expect("the binary runs").into()
    }

    #[test]
    fn a_build_that_is_asked_for_comes_before_the_grade() {
        for (lang, source) in [("c", "submission.c"), ("rust", "src/lib.rs")] {
            let bed = bed(lang);
            let path = tools(&bed);
            bed.write(&format!("p/{source}"), "one\n");
            let ran = run(&bed, &path, &["grade", "--build", "--json"]);
            assert_eq!(ran.code, Some(1), "{ran:?}");
            assert_eq!(graded(&bed, "p"), digest(&at(1.0)));
            let _: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON alone");
            let words = std::fs::read_to_string(bed.path("tools/arguments")).expect("it ran");
            assert!(words.contains("wasm32"), "{words}");
            // without being asked nothing is run
            bed.write(&format!("p/{source}"), "two\n");
            run(&bed, &path, &["grade"]);
            assert_eq!(graded(&bed, "p"), digest(&at(1.0)));
            run(&bed, &path, &["grade", "--build"]);
            assert_eq!(graded(&bed, "p"), digest(&at(2.0)));
            // what does not build is graded as such, though an earlier module is there
            bed.write(&format!("p/{source}"), "three\n");
            let ran = run(&bed, &path, &["grade", "--build"]);
            assert_eq!(ran.code, Some(1), "{ran:?}");
            assert!(
                ran.stderr
                    .contains(&format!("{source}:1:1: error: no three\n")),
                "{ran:?}"
            );
            assert!(ran.stdout.contains("the build fails: `"), "{ran:?}");
            assert!(ran.stdout.contains("error: no three"), "{ran:?}");
            let page = std::fs::read_to_string(bed.path("p/out/report.html")).expect("a page");
            assert!(page.contains("error: no three"));
        }
    }

    #[test]
    fn a_missing_compiler_is_a_fault_of_this_machine() {
        for (lang, install) in [
            ("c", "apt install clang lld"),
            ("rust", "rustup target add wasm32-unknown-unknown"),
        ] {
            let bed = bed(lang);
            let ran = run(&bed, "/nowhere", &["grade", "--build"]);
            assert_eq!(ran.code, Some(4), "{ran:?}");
            assert!(
                ran.stderr.replace("\n        ", " ").contains(install),
                "{ran:?}"
            );
            assert!(!bed.path("p/out").exists(), "nothing was graded");
        }
        let bed = bed("c");
        bed.write("tools/clang", "#!/bin/sh\necho 'clang: error: unable to execute command: Executable \"wasm-ld\" doesn'\\''t exist!' >&2; exit 1\n");
        let ran = run(&bed, &tools(&bed), &["grade", "--build"]);
        assert_eq!(ran.code, Some(4), "{ran:?}");
        assert!(ran.stderr.contains("no linker for WebAssembly"), "{ran:?}");
    }

    #[test]
    fn a_watched_project_is_built_at_every_save_of_a_source() {
        let bed = bed("c");
        bed.write("p/submission.c", "one\n");
        let path = tools(&bed);
        let (serving, before) = Serving::start_with(
            &bed,
            &["watch", "01-kinematics", "p", "--no-open"],
            &[("PATH", &path)],
        );
        assert!(
            before.iter().any(|line| line.contains("of 24 points")),
            "{before:?}"
        );
        assert_eq!(graded(&bed, "p"), digest(&at(1.0)));
        let mut seen = newer(&serving, 0);
        let mut watched_after = |name: &str, text: &str| {
            // whole at once: half a save would be built, too
            bed.write("tools/saved", text);
            std::fs::rename(bed.path("tools/saved"), bed.path(name)).expect("saved");
            seen = newer(&serving, seen);
        };
        watched_after("p/submission.c", "two\n");
        assert_eq!(graded(&bed, "p"), digest(&at(2.0)));
        watched_after("p/submission.c", "nothing\n");
        serving.lines_with(&["error: no nothing", "did-not-build"]);
        let page = serving.get("/report.html").body;
        assert!(page.contains("error: no nothing"), "not in the page");
        watched_after("p/submission.c", "two\n");
        // a header of one's own counts, too
        bed.write("tools/two", at(3.0));
        watched_after("p/gains.h", "\n");
        assert_eq!(graded(&bed, "p"), digest(&at(3.0)));
    }
}
