//! What a worker says it gave up, it cannot do.

use crate::testbed::TestBed;

/// What the filter of system calls refuses, whatever else is on.
const NEEDS_SYSTEM_CALLS: [&str; 6] = [
    "read a file",
    "list a folder",
    "write a file",
    "open a connection",
    "start a process",
    "signal the grader",
];

#[test]
fn a_worker_cannot_do_what_it_gave_up() {
    let bed = TestBed::new();
    let result = bed.run(&["doctor", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&result.stdout).expect("a report as JSON");
    let rows = |list: &str| {
        let rows = report[list].as_array().expect("a list");
        rows.clone()
    };
    let is_on = |name: &str| {
        rows("layers").iter().any(|layer| {
            layer["name"].as_str().expect("a name").contains(name) && layer["on"] == true
        })
    };
    let all = rows("layers").iter().all(|layer| layer["on"] == true);
    assert_eq!(report["sealed"], all);
    assert_eq!(result.code, Some(i32::from(!all)));
    let refused = |what: &str| {
        let tried = rows("tried");
        let row = tried.iter().find(|row| row["what"] == what);
        row.unwrap_or_else(|| panic!("{what} was not tried"))["refused"] == true
    };
    for what in NEEDS_SYSTEM_CALLS {
        assert!(refused(what) || !is_on("seccomp"), "a worker can {what}");
    }
    for what in ["read a file", "list a folder", "write a file"] {
        assert!(
            refused(what) || !is_on("file system"),
            "a worker can {what}"
        );
    }
    if is_on("limits on memory") {
        assert!(refused("take a gigabyte of memory"));
    }
}
