//! WebAssembly gives the same bytes: the grader built for `wasm32-unknown-unknown` and run by Node grades as the binary does.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::determinism::{digests, good_submissions, tested_record};
use crate::every_case::every_case;
use crate::exact::{cannot_run, is_asked_for};
use crate::testbed::{cargo, root};

const TARGET: &str = "wasm32-unknown-unknown";

/// A tool that the test needs and this machine lacks, with how to get it.
fn missing() -> Vec<String> {
    let mut missing = Vec::new();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let library = Command::new(rustc)
        .current_dir(root())
        .args(["--print", "target-libdir", "--target", TARGET])
        .output();
    let has_target = library.is_ok_and(|library| {
        let folder = String::from_utf8_lossy(&library.stdout).trim().to_owned();
        library.status.success() && Path::new(&folder).is_dir()
    });
    if !has_target {
        missing.push(format!("the Rust target (`rustup target add {TARGET}`)"));
    }
    let node = Command::new("node").arg("--version").output();
    if !node.is_ok_and(|node| node.status.success()) {
        missing.push("Node (`apt-get install nodejs`)".to_owned());
    }
    missing
}

/// Builds the module.
fn module() -> PathBuf {
    let (mut cargo, target) = cargo();
    // unoptimised: the quickest to build, and the farthest from the build it is compared with
    cargo.args(["rustc", "--quiet", "--locked", "--profile", "unoptimised"]);
    cargo.args(["--package", "kinemark-tests-wasm", "--lib"]);
    cargo.args(["--crate-type", "cdylib", "--target", TARGET]);
    cargo.arg("--target-dir").arg(&target);
    assert!(
        cargo.status().expect("cargo runs").success(),
        "the module builds"
    );
    let folder = target.join(TARGET).join("unoptimised");
    folder.join("kinemark_tests_wasm.wasm")
}

/// What Node prints when it runs `module` with `arguments`.
fn node(module: &Path, arguments: &[&str]) -> String {
    let output = Command::new("node")
        .arg(root().join("tests/wasm/run.mjs"))
        .arg(module)
        .arg(root())
        .args(arguments)
        .output()
        .expect("node runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn webassembly_gives_the_same_grades_and_the_same_contact() {
    let what = "the comparison with WebAssembly";
    if !is_asked_for(what) {
        return;
    }
    let missing = missing();
    if !missing.is_empty() {
        return cannot_run(what, "wasm", &missing);
    }
    let module = module();
    let contact = node(&module, &["contact"]);
    assert_eq!(contact, kinemark_tests_wasm::CONTACT_DIGEST);
    let good = good_submissions().into_iter();
    let cases: Vec<_> = good.map(|(lab, path)| (lab.clone(), (lab, path))).collect();
    every_case(&cases, |(lab, submission)| {
        let submission = submission.to_str().expect("UTF-8");
        let record = node(&module, &["grade", lab, submission]);
        let native = tested_record(lab);
        // the digests first: they show which task differs
        assert_eq!(digests(&record), digests(native));
        assert_eq!(record, native);
    });
}
