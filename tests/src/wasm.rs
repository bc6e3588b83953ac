//! WebAssembly gives the same bytes: the grader built for `wasm32-unknown-unknown` and run by Node grades as the binary does.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::compiled_solutions::{compiled, missing_target};
use crate::determinism::{digests, files_of, good_submissions, tested_record};
use crate::every_case::every_case;
use crate::exact::{cannot_run, is_asked_for};
use crate::testbed::{binary, cargo, root};

const TARGET: &str = "wasm32-unknown-unknown";

/// A tool that the test needs and this machine lacks, with how to get it.
fn missing() -> Vec<String> {
    let mut missing = missing_target();
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
    let compiled = compiled(what).expect("its target is there");
    let native_modules = files_of(&compiled.modules, binary(), &[]);
    let record = |lab: &str| {
        let name = format!("{lab}/grade.json");
        let found = native_modules.iter().find(|(path, _)| *path == name);
        String::from_utf8(found.expect("a record").1.clone()).expect("UTF-8")
    };
    let scripts = good_submissions().into_iter();
    let scripts = scripts.map(|(lab, path)| {
        let native = tested_record(&lab).to_owned();
        (format!("{lab} as a script"), (lab, path, native))
    });
    let modules = compiled.modules.iter().cloned();
    // a machine of WebAssembly inside another one
    let modules = modules.map(|(lab, path)| {
        let native = record(&lab);
        (format!("{lab} as a module"), (lab, path, native))
    });
    let cases: Vec<_> = scripts.chain(modules).collect();
    every_case(&cases, |(lab, submission, native)| {
        let submission = submission.to_str().expect("UTF-8");
        let record = node(&module, &["grade", lab, submission]);
        // the digests first: they show which task differs
        assert_eq!(digests(&record), digests(native));
        assert_eq!(record, *native);
    });
}
