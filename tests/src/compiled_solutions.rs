//! The reference solutions in Rust, compiled: the same module gives the same bytes wherever it is graded.

use std::path::PathBuf;

use crate::determinism::{Submissions, assert_same, files_of, good_submissions};
use crate::exact::{cannot_run, is_asked_for};
use crate::testbed::{TestBed, binary, build, cargo, root};

const TARGET: &str = "wasm32-unknown-unknown";

/// Every lab with the module of its reference solution, called as `new` calls modules, in folders of a bed.
pub(crate) struct Compiled {
    pub(crate) modules: Submissions,
    _bed: TestBed,
}

/// Builds them; none where this machine cannot, which is a failure where it should.
pub(crate) fn compiled(what: &str) -> Option<Compiled> {
    let missing = missing_target();
    if !missing.is_empty() {
        cannot_run(what, "wasm", &missing);
        return None;
    }
    let (mut cargo, target) = cargo();
    let target = target.join("compiled-solutions");
    cargo.args(["build", "--quiet", "--release", "--locked", "--lib"]);
    cargo.args(["--target", TARGET]);
    cargo.args(["--manifest-path", "reference/rust/Cargo.toml"]);
    cargo.arg("--target-dir").arg(&target);
    assert!(cargo.status().expect("cargo runs").success(), "they build");
    let bed = TestBed::new();
    let modules = good_submissions().into_iter().map(|(lab, _)| {
        let name = format!("solution_{}.wasm", lab.replace('-', "_"));
        let built = target.join(TARGET).join("release").join(name);
        let module = format!("{lab}/submission.wasm");
        bed.write(&module, std::fs::read(built).expect("a module"));
        (lab, bed.path(&module))
    });
    Some(Compiled {
        modules: modules.collect(),
        _bed: bed,
    })
}

/// What this machine lacks to compile for WebAssembly, with how to get it.
pub(crate) fn missing_target() -> Vec<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let library = std::process::Command::new(rustc)
        .current_dir(root())
        .args(["--print", "target-libdir", "--target", TARGET])
        .output();
    let has_target = library.is_ok_and(|library| {
        let folder = String::from_utf8_lossy(&library.stdout).trim().to_owned();
        library.status.success() && PathBuf::from(folder).is_dir()
    });
    match has_target {
        true => Vec::new(),
        false => vec![format!("the Rust target (`rustup target add {TARGET}`)")],
    }
}

#[test]
fn a_module_gives_the_same_bytes_in_a_worker_in_process_and_without_optimisation() {
    let what = "the comparison of modules between builds";
    if !is_asked_for(what) {
        return;
    }
    let Some(Compiled { modules, _bed }) = compiled(what) else {
        return;
    };
    let tested = files_of(&modules, binary(), &[]);
    assert_same(&tested, &files_of(&modules, binary(), &["--in-process"]));
    assert_same(&tested, &files_of(&modules, &build("unoptimised"), &[]));
}
