//! WebAssembly gives the same bytes: the grader built for `wasm32-unknown-unknown` and run by Node grades as the binary does.
//!
//! Where the target or Node is missing, the test says so on standard error, past the harness that would keep it to itself.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::determinism::{digests, good_submissions};
use crate::testbed::{TestBed, binary, cargo, root};

const TARGET: &str = "wasm32-unknown-unknown";

/// What the test needs and this machine has not, with the way to get it.
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
    let missing = missing();
    if !missing.is_empty() {
        let what = missing.join(" and ");
        let said = format!("\nNOT RUN: {TARGET} in Node is not compared, there is no {what}\n");
        let mut stderr = std::io::stderr();
        stderr.write_all(said.as_bytes()).expect("standard error");
        return;
    }
    let module = module();
    assert_eq!(
        node(&module, &["contact"]),
        kinemark_tests_wasm::CONTACT_DIGEST
    );
    let bed = TestBed::new();
    for (lab, submission) in good_submissions() {
        let native = Command::new(binary())
            .current_dir(root())
            .args(["grade", &lab])
            .arg(&submission)
            .args(["--in-process", "--json", "--out"])
            .arg(bed.path(&lab))
            .env_remove("KINEMARK_SALT")
            .output()
            .expect("the binary runs");
        assert_eq!(native.status.code(), Some(0), "{native:?}");
        let native = String::from_utf8(native.stdout).expect("UTF-8");
        let submission = submission.to_str().expect("UTF-8");
        let record = node(&module, &["grade", &lab, submission]);
        // the digests first: they tell in which task to look
        assert_eq!(digests(&record), digests(&native), "{lab}");
        assert_eq!(record, native, "{lab}");
    }
}
