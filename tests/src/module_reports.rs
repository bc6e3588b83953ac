//! The report of a compiled submission: its copy is a module by name, too, and every command that reads a report reads it.

use serde_json::Value as Json;

use crate::testbed::{CommandResult, TestBed};

/// A module for lab 01 that answers nothing and stands still; `more` is a part of it.
pub(crate) fn module(more: &str) -> Vec<u8> {
    let text = format!(
        r#"(module
            (memory (export "memory") 2)
            (func (export "km_version") (result i32) i32.const 1)
            (func (export "km_buffer") (param i32) (result i32) i32.const 1024)
            (func (export "km_forward_kinematics") (param i32 i32 i32))
            (func (export "km_inverse_kinematics") (param i32 i32 i32 i32) (result i32) i32.const 0)
            (func (export "km_control") (param i32 i32))
            {more})"#
    );
    wat::parse_str(text).expect("a module")
}

/// A bed with the report of a module in `out`.
fn graded(args: &[&str]) -> TestBed {
    let bed = TestBed::a_little_off();
    bed.write("arm.wasm", module(""));
    let ran = bed.run(&[&["grade", "01-kinematics", "arm.wasm"], args].concat());
    assert_eq!(ran.code, Some(1), "{ran:?}");
    bed
}

fn verified(bed: &TestBed, args: &[&str], code: i32, words: &str) -> CommandResult {
    let ran = bed.run(&[&["verify", "out"], args].concat());
    assert_eq!(ran.code, Some(code), "{args:?}: {ran:?}");
    assert!(ran.stdout.contains(words), "no {words:?} in {ran:?}");
    ran
}

#[test]
fn the_report_of_a_module_has_a_module_and_holds() {
    let bed = graded(&[]);
    assert!(!bed.path("out/submission.rhai").exists());
    let copy = std::fs::read(bed.path("out/submission.wasm")).expect("a copy");
    assert!(copy == module(""), "byte for byte");
    verified(
        &bed,
        &["--graded", "--labs", "labs"],
        0,
        "graded report: 01-kinematics, arm.wasm",
    );
    verified(
        &bed,
        &["--practice"],
        5,
        "the same as far as it could be compared",
    );
    // a script is graded again over it, and the module goes
    let before = bed.run(&["compare", "out", "out"]);
    assert_eq!(before.code, Some(0), "{before:?}");
    let export = bed.run(&["log", "export", "out/move/run.mcap", "--csv"]);
    assert_eq!(export.code, Some(0), "{export:?}");
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(!bed.path("out/submission.wasm").exists());
    assert!(bed.path("out/submission.rhai").is_file());
}

#[test]
fn a_report_of_a_module_that_was_changed_is_found() {
    let bed = graded(&["--practice"]);
    verified(&bed, &[], 0, "same bits: 3 of 3 tasks");
    bed.write("out/submission.wasm", module("(func)"));
    verified(&bed, &[], 1, "the submission was changed after grading");
    // in its place a script
    bed.write("out/submission.wasm", "fn control(o) { [0.0, 0.0] }\n");
    verified(&bed, &[], 1, "the submission was changed after grading");
    // and a script beside it that people would read
    bed.write("out/submission.wasm", module(""));
    bed.write("out/submission.rhai", "// this is what I wrote\n");
    verified(&bed, &[], 1, "differs: `submission.rhai`\n");
    std::fs::remove_file(bed.path("out/submission.rhai")).expect("removed");
    std::fs::remove_file(bed.path("out/submission.wasm")).expect("removed");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("no submission.wasm"), "{ran:?}");
}

/// Reports of before named every copy as that of a script.
#[test]
fn an_earlier_report_of_a_module_holds_under_the_name_of_a_script() {
    let bed = graded(&["--practice"]);
    let [new, old] = ["out/submission.wasm", "out/submission.rhai"].map(|name| bed.path(name));
    std::fs::rename(new, old).expect("renamed");
    // the list is sorted, and the name of the script comes where that of the module was
    bed.edit(
        "out/report.json",
        "\"submission.wasm\"",
        "\"submission.rhai\"",
    );
    verified(&bed, &[], 0, "same bits: 3 of 3 tasks");
    let ran = bed.run(&["compare", "out", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&["grade", "01-kinematics", "arm.wasm", "--practice", "--json"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(bed.path("out/submission.wasm").is_file());
    // a script has no copy that is named as a module
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let [new, old] = ["out/submission.wasm", "out/submission.rhai"].map(|name| bed.path(name));
    std::fs::rename(old, new).expect("renamed");
    bed.edit(
        "out/report.json",
        "\"submission.rhai\"",
        "\"submission.wasm\"",
    );
    verified(
        &bed,
        &[],
        1,
        "file `submission.rhai`\n  in the folder: missing",
    );
}

#[test]
fn a_module_is_named_in_the_list_of_files() {
    let bed = graded(&["--practice"]);
    let list = std::fs::read(bed.path("out/report.json")).expect("a list");
    let list: Json = serde_json::from_slice(&list).expect("JSON");
    assert!(list["files"]["submission.wasm"].is_string(), "{list}");
    assert!(list["files"]["submission.rhai"].is_null(), "{list}");
}
