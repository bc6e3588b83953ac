//! What a person can name as a submission, through the binary: scripts, folders and archives with one in them, and what is none.

use std::io::Write as _;

use crate::testbed::{TestBed, lab, staff};

fn record(bed: &TestBed) -> serde_json::Value {
    let text = std::fs::read_to_string(bed.path("out/grade.json")).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

fn solution() -> String {
    let lab = lab("01-kinematics");
    staff(&lab, None).solution.text().to_owned()
}

#[test]
fn what_is_no_script_is_graded_as_not_built_and_replaces_an_older_report() {
    let bed = TestBed::new();
    bed.write("right.rhai", solution());
    bed.write("latin1.rhai", b"// fine\nlet a = 1; // Stra\xdfe\n");
    bed.write("utf16.rhai", b"\xff\xfel\0e\0t\0");
    bed.write("archive.rhai", b"PK\x03\x04rest");
    bed.write("empty/notes.txt", "nothing here");
    let mut zip = zip_of(&[("notes.txt", b"nothing here".as_slice())]);
    bed.write("empty.zip", &zip);
    #[cfg(unix)]
    std::os::unix::fs::symlink(bed.path("right.rhai"), bed.path("link.rhai")).expect("a link");
    for (name, words, line) in [
        ("latin1.rhai", "not UTF-8 text: byte 0xdf", Some(2)),
        ("utf16.rhai", "text in UTF-16", None),
        ("archive.rhai", "a ZIP archive", None),
        ("empty", "no submission is in it", None),
        ("empty.zip", "no submission is in it", None),
        #[cfg(unix)]
        ("link.rhai", "is a link to another file", None),
    ] {
        // an older report that is full
        let ran = bed.run(&["grade", "01-kinematics", "right.rhai"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        let ran = bed.run(&["grade", "01-kinematics", name]);
        assert_eq!(ran.code, Some(1), "{name}: {ran:?}");
        assert!(ran.stdout.contains(words), "{name}: {}", ran.stdout);
        assert!(ran.stdout.contains("next: "), "{name}: {}", ran.stdout);
        let record = record(&bed);
        assert_eq!(record["verdict"], "did-not-build", "{name}");
        assert_eq!(record["points"], 0.0, "{name}");
        let stopped = &record["tasks"][0]["stopped"];
        assert_eq!(stopped["line"].as_u64(), line, "{name}");
        // the same again, from the report alone
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(0), "{name}: {ran:?}");
    }
    // with a submission in it, a folder and an archive are graded
    bed.write("mine/submission.rhai", solution());
    zip = zip_of(&[("mine/submission.rhai", solution().as_bytes())]);
    bed.write("mine.zip", &zip);
    for name in ["mine", "mine.zip"] {
        let ran = bed.run(&["grade", "01-kinematics", name]);
        assert_eq!(ran.code, Some(0), "{name}: {ran:?}");
        assert_eq!(record(&bed)["submission"]["name"], "submission.rhai");
    }
}

/// A ZIP archive of these files, stored.
pub(crate) fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let stored =
        zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in files {
        archive.start_file(*name, stored).expect("an entry");
        archive.write_all(bytes).expect("bytes");
    }
    archive.finish().expect("an archive").into_inner()
}

#[test]
fn other_variants_show_a_number_that_is_typed_in() {
    let bed = TestBed::new();
    let solution = solution();
    bed.write("right.rhai", &solution);
    let ran = bed.run(&["grade", "01-kinematics", "right.rhai", "--variants", "2"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let words = "your variant 24 of 24; of 2 other variants 2 have full marks";
    assert!(ran.stdout.contains(words), "{}", ran.stdout);

    // the two goals as they are in lab.toml
    let typed = solution.replacen(
        "fn control(observation) {",
        "fn control(observation) {\n    let observation = #{ task: observation.task, tick: observation.tick, time: observation.time, dt: observation.dt, q: observation.q, \
         qd: observation.qd, tcp: observation.tcp, target: if observation.task == \"move\" { [[2.0, 1.4, 0.05], [2.0, -1.4, 0.05]] } else { observation.target } };",
        1,
    );
    assert_ne!(typed, solution);
    bed.write("typed.rhai", &typed);
    let ran = bed.run(&["grade", "01-kinematics", "typed.rhai", "--variants", "3"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("of 3 other variants 0 have full marks"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains(
            "has 1.4, which is `left[1]` and `right[1]` of your variant: is it typed in?"
        ),
        "{}",
        ran.stdout
    );
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "typed.rhai",
        "--variants",
        "1",
        "--json",
    ]);
    let json: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(json["grade"]["points"], 24.0);
    assert!(json["variants"][0]["points"].as_f64().expect("points") < 20.0);
    assert_eq!(json["typed_in"][0]["number"], "1.4");

    let ran = bed.run(&["grade", "01-kinematics", "typed.rhai", "--variants", "21"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}
