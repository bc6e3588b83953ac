//! The archive for Gradescope, in the layout that Gradescope documents: unpacked into `source`, set up, and run once an upload.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::process::{Command, Output};

use serde_json::{Value as Json, json};

use crate::testbed::{TestBed, binary, root};

const LAB: &str = "01-kinematics";

/// A bed with the autograder's folder, its image built.
fn autograder(options: &[&str], own_binary: bool) -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write(
        "roster.csv",
        "id,name,email\ns1000,One,one@example.org\ns1001,Two,two@example.org\n",
    );
    let mut args = vec!["lab", "pack", LAB, "--for", "gradescope", "--out", "a.zip"];
    args.extend(options);
    // a header of a program, in place of a hundred megabytes with debug information
    let mut header = b"\x7fELF\x02\x01".to_vec();
    header.resize(20, 0);
    header[18] = 62;
    bed.write("header", header);
    if !own_binary {
        args.extend(["--binary", "header"]);
    }
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // the labs of this repository are public, and whoever grades with them should know
    assert!(ran.stderr.contains("is public"), "{ran:?}");
    let file = std::fs::File::open(bed.path("a.zip")).expect("an archive");
    let mut archive = zip::ZipArchive::new(file).expect("a ZIP");
    archive
        .extract(bed.path("autograder/source"))
        .expect("unpacked");
    if !own_binary {
        std::fs::copy(binary(), bed.path("autograder/source/kinemark")).expect("copied");
    }
    std::fs::copy(
        bed.path("autograder/source/run_autograder"),
        bed.path("autograder/run_autograder"),
    )
    .expect("copied");
    for folder in ["labs", "reference"] {
        std::fs::remove_dir_all(bed.path(folder)).expect("removed");
    }
    let set_up = bash(&bed, "source/setup.sh");
    let said = String::from_utf8_lossy(&set_up.stdout).into_owned();
    assert!(set_up.status.success(), "{set_up:?}");
    assert!(said.ends_with("ready to grade 01-kinematics\n"), "{said}");
    bed
}

/// Runs a script of the autograder's folder.
fn bash(bed: &TestBed, script: &str) -> Output {
    let root = bed.path("autograder");
    let mut command = Command::new("bash");
    command.arg(root.join(script)).current_dir(&root);
    command
        .env("KINEMARK_AUTOGRADER", &root)
        .env_remove("KINEMARK_SALT");
    command.output().expect("bash runs")
}

/// Uploads files, by whoever has this address; the results.
fn upload(bed: &TestBed, files: &[(&str, &[u8])], email: &str) -> Json {
    let folder = bed.path("autograder/submission");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).expect("removed");
    }
    std::fs::create_dir_all(&folder).expect("folder");
    for (name, bytes) in files {
        bed.write(&format!("autograder/submission/{name}"), bytes);
    }
    let metadata = json!({
        "id": 1,
        "created_at": "2026-11-23T10:00:00.000000+01:00",
        "assignment": { "title": "Lab 1", "total_points": "24.0" },
        "submission_method": "upload",
        "users": [{ "email": email, "id": 7, "name": "Somebody" }],
        "previous_submissions": [],
    });
    bed.write("autograder/submission_metadata.json", metadata.to_string());
    let ran = bash(bed, "run_autograder");
    assert!(ran.status.success(), "{ran:?}");
    results(bed)
}

fn results(bed: &TestBed) -> Json {
    let path = bed.path("autograder/results/results.json");
    let text = std::fs::read_to_string(path).expect("results.json");
    serde_json::from_str(&text).expect("JSON")
}

fn submission(name: &str) -> Vec<u8> {
    let path = format!("tests/submissions/{LAB}/{name}/submission.rhai");
    std::fs::read(root().join(path)).expect("a submission")
}

/// That nothing is a score, and that the words are there.
fn has_no_score(results: &Json, words: &str) {
    assert!(results.get("score").is_none(), "{results}");
    assert!(results.get("tests").is_none(), "{results}");
    let output = results["output"].as_str().expect("output");
    assert!(output.contains(words), "{output}");
}

#[test]
fn an_upload_is_graded_and_students_see_visible_cases_alone() {
    let bed = autograder(&[], true);
    let good = submission("good");
    let results = upload(&bed, &[("submission.rhai", &good)], "x@example.org");
    assert_eq!(results["score"], 24.0);
    let tests = results["tests"].as_array().expect("tests");
    let of = |visibility: &str| {
        let of = tests.iter().filter(|test| test["visibility"] == visibility);
        of.collect::<Vec<_>>()
    };
    let (seen, hidden) = (of("visible"), of("after_published"));
    assert_eq!(seen.len(), hidden.len());
    assert!(seen.iter().all(|test| test.get("score").is_none()));
    let sum = |key: &str| {
        hidden
            .iter()
            .filter_map(|test| test[key].as_f64())
            .sum::<f64>()
    };
    assert_eq!((sum("score"), sum("max_score")), (24.0, 24.0));

    // typed in for the visible cases: full marks there, and no number of the hidden ones is in sight
    let typed = submission("first-goal-only");
    let results = upload(&bed, &[("lab1/mine.rhai", &typed)], "x@example.org");
    assert!(results["score"].as_f64().expect("a score") < 24.0);
    assert!(
        results["output"]
            .as_str()
            .expect("text")
            .contains("in the visible cases")
    );

    // a student's own mistake is a grade
    let broken = submission("syntax");
    let results = upload(&bed, &[("submission.rhai", &broken)], "x@example.org");
    assert_eq!(results["score"], 0.0);
    assert!(
        results["output"]
            .as_str()
            .expect("text")
            .contains("stopped: ")
    );
}

#[test]
fn what_is_not_graded_has_no_score_at_all() {
    let bed = autograder(&[], false);
    let good = submission("good");
    let email = "x@example.org";
    has_no_score(&upload(&bed, &[], email), "there is no file");
    let report = upload(&bed, &[("report.pdf", b"%PDF")], email);
    has_no_score(&report, "no submission is in it; there is `report.pdf`");
    let other = submission("degrees");
    let two = [
        ("a/submission.rhai", good.as_slice()),
        ("b/submission.rhai", &other),
    ];
    has_no_score(&upload(&bed, &two, email), "2 files may be the submission");
    let damaged = [("x.kinemark", &b"PK\x03\x04"[..])];
    has_no_score(
        &upload(&bed, &damaged, email),
        "it is no whole hand-in file",
    );

    // a fault of course staff, and one of the machine
    let solution = "autograder/source/reference/01-kinematics/solution.rhai";
    let text = std::fs::read(bed.path(solution)).expect("solution");
    bed.write(solution, "this is no program");
    let one = [("submission.rhai", good.as_slice())];
    has_no_score(&upload(&bed, &one, email), "This is not zero points");
    bed.write(solution, text);
    assert_eq!(upload(&bed, &one, email)["score"], 24.0);
    bed.write("autograder/source/kinemark", "no program");
    has_no_score(&upload(&bed, &one, email), "This is not zero points");
}

#[test]
fn a_hand_in_file_is_graded_with_the_variant_of_whoever_uploads_it() {
    let bed = autograder(&["--roster", "roster.csv", "--hidden-at-upload"], false);
    bed.write("work/submission.rhai", submission("good"));
    let ran = bed.run(&["submit", LAB, "work/submission.rhai", "--out", "work"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let hand_in = std::fs::read(bed.path("work/01-kinematics.kinemark")).expect("file");
    let files = [("01-kinematics.kinemark", hand_in.as_slice())];
    let results = upload(&bed, &files, "ONE@example.org");
    assert_eq!(results["score"], 24.0, "{results}");
    let tests = results["tests"].as_array().expect("tests");
    assert!(tests.iter().all(|test| test["visibility"] == "visible"));
    let output = |results: &Json| results["output"].as_str().expect("output").to_owned();
    assert!(output(&results).contains("variant of s1000: "));
    assert!(output(&results).starts_with("01-kinematics: 24 of 24 points for submission.rhai."));
    let other = upload(&bed, &files, "two@example.org");
    assert!(output(&other).contains("variant of s1001: "));
    has_no_score(
        &upload(&bed, &files, "who@example.org"),
        "you are not on your course's list",
    );
    // a file made with the variant of the other
    let ran = bed.run(&[
        "lab",
        "variant",
        LAB,
        "--student",
        "s1001",
        "--reference",
        "autograder/source/reference",
        "--out",
        "work/variant.toml",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&[
        "submit",
        LAB,
        "work/submission.rhai",
        "--out",
        "two.kinemark",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let hand_in = std::fs::read(bed.path("two.kinemark")).expect("file");
    let files = [("two.kinemark", hand_in.as_slice())];
    has_no_score(
        &upload(&bed, &files, "one@example.org"),
        "the variant of somebody else",
    );
    assert_eq!(upload(&bed, &files, "two@example.org")["score"], 24.0);

    // of another lab
    bed.write(
        "other/submission.rhai",
        "fn control(observation) { [0.0, 0.0] }\n",
    );
    let ran = bed.run(&[
        "submit",
        "00-step-response",
        "other/submission.rhai",
        "--out",
        "x.kinemark",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let hand_in = std::fs::read(bed.path("x.kinemark")).expect("file");
    let wrong = upload(
        &bed,
        &[("x.kinemark", hand_in.as_slice())],
        "one@example.org",
    );
    has_no_score(&wrong, "of another lab: `00-step-response`");
}
