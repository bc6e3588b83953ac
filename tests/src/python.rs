//! Submissions in Python through the binary: the reference solutions earn what those in Rhai earn, with the same bytes wherever they are
//! graded, and a folder that `new` makes can be graded as it is.

use std::path::PathBuf;

use crate::determinism::{Submissions, assert_same, digests, files_of, good_submissions};
use crate::exact::is_asked_for;
use crate::golden::are_current;
use crate::testbed::{TestBed, binary, build, root};

/// The reference solution in Python of every lab: one without it fails here.
fn solutions() -> Submissions {
    let labs = good_submissions().into_iter();
    let path = |lab: String| -> (String, PathBuf) {
        let path = root().join(format!("reference/{lab}/solution.py"));
        assert!(path.is_file(), "lab `{lab}` has no {}", path.display());
        (lab, path)
    };
    labs.map(|(lab, _)| path(lab)).collect()
}

/// That every one is graded with exit code 0 says that it earns all points.
#[test]
fn every_solution_earns_all_points_with_the_same_bytes_in_a_worker_and_in_process() {
    let solutions = solutions();
    let files = files_of(&solutions, binary(), &[]);
    // the others have many thousand calls in hidden runs
    let mut again = solutions.clone();
    if !is_asked_for("the comparison of all solutions in Python in a worker and in process") {
        let quick = ["01-kinematics", "04-knock-with-velocity"];
        again.retain(|(lab, _)| quick.contains(&lab.as_str()));
    }
    let mut compared = files.clone();
    compared.retain(|(name, _)| again.iter().any(|(lab, _)| name.starts_with(lab.as_str())));
    let in_process = files_of(&again, binary(), &["--in-process"]);
    assert_same(&compared, &in_process);
    let golden = solutions.into_iter().map(|(lab, _)| {
        let record = format!("{lab}/grade.json");
        let (_, record) = files
            .iter()
            .find(|(name, _)| *name == record)
            .expect("a record");
        let record = std::str::from_utf8(record).expect("UTF-8");
        let path = root().join(format!("tests/golden/digests-python-{lab}.txt"));
        (path, digests(record))
    });
    are_current(&golden.collect::<Vec<_>>());
}

#[test]
fn a_build_without_optimisation_writes_the_same_bytes_of_python() {
    if !is_asked_for("the comparison of Python with a build without optimisation") {
        return;
    }
    // the interpreter alone takes a hundred times as long without optimisation: one lab with functions and a motion, one with a scene
    let mut solutions = solutions();
    solutions
        .retain(|(lab, _)| ["01-kinematics", "04-knock-with-velocity"].contains(&lab.as_str()));
    assert_eq!(solutions.len(), 2);
    let tested = files_of(&solutions, binary(), &[]);
    // without optimisation every motion takes longer than a worker may
    let unoptimised = files_of(&solutions, &build("unoptimised"), &["--in-process"]);
    assert_same(&tested, &unoptimised);
}

#[test]
fn a_folder_in_python_is_graded_as_it_is_made() {
    for (lab, _) in good_submissions() {
        let bed = TestBed::new();
        let made = bed.run(&["new", &lab, "work", "--lang", "python"]);
        assert_eq!(made.code, Some(0), "{}", made.stderr);
        for file in [
            "submission.py",
            "kinemark.pyi",
            "__builtins__.pyi",
            "python.md",
            "brief.html",
            "kinemark.toml",
        ] {
            assert!(bed.path("work").join(file).is_file(), "{lab} has no {file}");
        }
        let graded = bed.run_in(&bed.path("work"), &["grade", "--json"]);
        assert_eq!(graded.code, Some(1), "{lab}: {}", graded.stderr);
        let record: serde_json::Value = serde_json::from_str(&graded.stdout).expect("a record");
        for task in record["tasks"].as_array().expect("tasks") {
            let verdict = task["verdict"].as_str().expect("a verdict");
            // an empty answer may have the wrong shape, and nothing else is wrong with it
            let is_run = !["did-not-build", "crashed", "over-budget", "missing"].contains(&verdict);
            assert!(is_run, "{lab}: {task:#}");
        }
    }
}

#[test]
fn a_report_of_python_is_verified_compared_and_handed_in() {
    let bed = TestBed::new();
    let solution = root().join("reference/01-kinematics/solution.py");
    std::fs::copy(solution, bed.path("submission.py")).expect("a copy");
    let graded = bed.run(&["grade", "01-kinematics", "--practice"]);
    assert_eq!(graded.code, Some(0), "{}{}", graded.stdout, graded.stderr);
    assert!(bed.path("out/submission.py").is_file());
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
    assert!(
        page.contains("def forward_kinematics"),
        "the page shows no source"
    );
    let verified = bed.run(&["verify", "out"]);
    assert_eq!(
        verified.code,
        Some(0),
        "{}{}",
        verified.stdout,
        verified.stderr
    );
    let compared = bed.run(&["compare", "out", "out"]);
    assert_eq!(
        compared.code,
        Some(0),
        "{}{}",
        compared.stdout,
        compared.stderr
    );
    let submitted = bed.run(&[
        "submit",
        "01-kinematics",
        "submission.py",
        "--student",
        "s1",
    ]);
    assert_eq!(
        submitted.code,
        Some(0),
        "{}{}",
        submitted.stdout,
        submitted.stderr
    );
    let handed_in = bed.run(&[
        "grade",
        "01-kinematics",
        "01-kinematics.kinemark",
        "--practice",
        "--out",
        "again",
    ]);
    assert_eq!(
        handed_in.code,
        Some(0),
        "{}{}",
        handed_in.stdout,
        handed_in.stderr
    );
}

#[test]
fn python_is_known_by_its_text_where_a_name_says_nothing() {
    let bed = TestBed::new();
    let solution = root().join("reference/01-kinematics/solution.py");
    std::fs::copy(&solution, bed.path("answer.txt")).expect("a copy");
    for name in ["-", "answer.txt"] {
        let input = std::fs::File::open(&solution).expect("the solution");
        let arguments = ["grade", "01-kinematics", name, "--practice", "--json"];
        let graded = bed.command(&arguments).stdin(input).output();
        let graded = graded.expect("the program runs");
        assert_eq!(graded.status.code(), Some(0), "{name}: {graded:?}");
    }
}

#[test]
fn what_a_file_prints_before_its_own_statement_fails_is_in_the_grade() {
    let bed = TestBed::new();
    bed.write("submission.py", "print('here')\nx = 1 / 0\n");
    for host in [&[][..], &["--in-process"]] {
        let arguments = ["grade", "01-kinematics", "--practice", "--json"];
        let graded = bed.run(&[&arguments, host].concat());
        assert_eq!(graded.code, Some(1), "{}", graded.stderr);
        let record: serde_json::Value = serde_json::from_str(&graded.stdout).expect("a record");
        for task in record["tasks"].as_array().expect("tasks") {
            assert_eq!(task["log"][0]["text"], "here", "{host:?}: {task:#}");
        }
    }
}

#[test]
fn two_submissions_of_two_languages_are_an_error() {
    let bed = TestBed::new();
    bed.write("submission.py", "");
    bed.write("submission.rhai", "");
    let ran = bed.run(&["grade", "01-kinematics"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("only one of them can be graded"),
        "{}",
        ran.stderr
    );
}

/// The module that is committed is the one of the sources: `grader/python/build` writes both.
#[test]
fn the_runtime_is_the_one_of_its_sources() {
    use sha2::{Digest as _, Sha256};
    let folder = root().join("grader/python");
    let listed = std::fs::read_to_string(folder.join("runtime.sha256")).expect("a list");
    let mut files = Vec::new();
    for line in listed.lines() {
        let (digest, file) = line.split_once("  ").expect("a digest and a file");
        let bytes =
            std::fs::read(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        let found: String = Sha256::digest(&bytes)
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect();
        assert_eq!(digest, found, "{file} was changed: run grader/python/build");
        files.push(file.to_owned());
    }
    let mut there = sources_below(&folder, "");
    there.sort();
    files.sort();
    assert_eq!(there, files, "another file: run grader/python/build");
}

/// What the runtime is made of, as the command that builds it lists it.
fn sources_below(folder: &std::path::Path, prefix: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let name = entry.file_name().into_string().expect("UTF-8");
        let path = format!("{prefix}{name}");
        if entry.path().is_dir() {
            if !["target", "tests"].contains(&name.as_str()) {
                found.extend(sources_below(&entry.path(), &format!("{path}/")));
            }
        } else if [".rs", ".py", ".toml", ".patch", ".zst"]
            .iter()
            .any(|end| name.ends_with(end))
            || ["Cargo.lock", "build"].contains(&name.as_str())
        {
            found.push(path);
        }
    }
    found
}
