//! What comes of URDFs as they are published, held as tables: twelve small files in `tests/robots/peculiar/`, each with one peculiarity of
//! a published one and named after it, and with `KINEMARK_ROBOTS=FOLDER` all files of the PyPI package `example-robot-data` 6.0.0,
//! whose folder `robots` that is.
//!
//! `KINEMARK_BLESS=1` writes the tables anew.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use kinemark_sim::format::{MeshLocation, ReadOptions, RobotError, RobotFormat, detect};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::unphysical::OnUnphysical;
use kinemark_sim::text::Source;
use serde_json::{Value, json};

use crate::ask;

const TABLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/robots");

/// What every table says of its keys.
const KEYS: &str = "\
# file: its path. refused: why it does not load; all else is of files that do.
# q: how many joints have an entry in q. mimic: how many follow another.
# unphysical: links with mass properties that no body can have, for which dynamics refuses the robot; --balance makes it run.
# warnings: how many there are of each kind, without names and numbers.
# kinematics: what `fk` and `jacobian` of the last link say at q = 0, where that is no answer.
# run_1s: what `simulate` says to 1 s from rest at zero effort under gravity, in steps of 1 ms; with --balance where that is needed.
#
# Made by sim/toolbox/tests/published.rs; KINEMARK_BLESS=1 writes it anew.
";

/// Every file below `folder` with this ending, sorted by path.
fn files_below(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut ahead = vec![folder.to_owned()];
    while let Some(folder) = ahead.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                ahead.push(path);
            } else if path.to_string_lossy().ends_with(ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The bytes of a mesh: below the folder that holds the package, else beside the file.
fn mesh(format: &RobotFormat, file: &Path, name: &str) -> Result<Vec<u8>, String> {
    let folder = file.parent().expect("a folder");
    let candidates: Vec<PathBuf> = match (format.mesh_location)(name) {
        MeshLocation::Package { name, path } => folder
            .ancestors()
            .map(|above| above.join(name).join(path))
            .collect(),
        MeshLocation::Relative(path) => vec![folder.join(path)],
        _ => Vec::new(),
    };
    let there = candidates.iter().find(|path| path.is_file());
    let there = there.ok_or("there is none")?;
    std::fs::read(there).map_err(|error| error.to_string())
}

fn read(file: &Path, on_unphysical: OnUnphysical) -> Result<Robot, RobotError> {
    let text = std::fs::read_to_string(file).expect("text");
    let source = Source::new(&*file.to_string_lossy(), text);
    let format = detect(&source);
    let options = ReadOptions {
        on_unphysical,
        ..ReadOptions::default()
    };
    (format.read)(source, &options, &mut |name| mesh(format, file, name))
}

/// The first line of a sentence without the names and numbers in it.
fn kind_of(sentence: &str) -> String {
    let first = sentence.lines().next().unwrap_or_default();
    let mut unnamed = String::new();
    for (i, part) in first.split('`').enumerate() {
        unnamed.push_str(if i % 2 == 1 { "…" } else { part });
    }
    let mut words: Vec<&str> = unnamed
        .split(' ')
        .map(|word| {
            let bare = word.trim_matches(['(', ')', ';', ',', ':']);
            let is_number = bare.parse::<f64>().is_ok();
            if is_number { "…" } else { word }
        })
        .collect();
    // a list of names is a name
    words.dedup_by(|word, before| *word == "…" && *before == "…");
    let kind = words.join(" ");
    kind.trim_end_matches(" (line …").to_owned()
}

/// The code and the kind of a refusal; `answered` where there is an answer.
fn outcome(answer: &Value) -> String {
    let error = &answer["error"];
    match error["code"].as_str() {
        None => "answered".to_owned(),
        // when and how it diverges is for other tests
        Some("diverged") => "diverged".to_owned(),
        Some(code) => {
            let message = error["message"].as_str().unwrap_or_default();
            format!("{code}: {}", kind_of(message))
        }
    }
}

/// A second from rest under gravity.
fn run(robot: &Robot) -> String {
    let zeros = vec![0.0; robot.n()];
    outcome(&ask(
        robot,
        &json!({
            "op": "simulate", "q0": zeros, "qd0": zeros, "command": zeros, "duration_s": 1, "servo_period_s": 0.001,
            "sample_period_s": 1, "servo": { "mode": "effort" }
        }),
    ))
}

/// The row of one file.
fn row(folder: &Path, file: &Path) -> String {
    let shown = file.strip_prefix(folder).expect("below the folder");
    let shown = shown.to_string_lossy().replace('\\', "/");
    let mut row = format!("\n[[robots]]\nfile = {shown:?}\n");
    let robot = match read(file, OnUnphysical::Refuse) {
        Ok(robot) => robot,
        Err(error) => {
            let (line, _) = error.line_and_column();
            let _ = writeln!(row, "refused = {:?}", format!("{error} (line {line})"));
            return row;
        }
    };
    let followers = robot.joints().iter().filter(|joint| joint.mimic.is_some());
    let _ = writeln!(row, "q = {}\nmimic = {}", robot.n(), followers.count());
    let mut runs = run(&robot);
    if let Some(unphysical) = robot.unphysical() {
        assert!(runs.starts_with("unphysical: "), "{shown}: {runs}");
        let names: Vec<&str> = unphysical.links().iter().map(|l| l.name.as_str()).collect();
        let _ = writeln!(row, "unphysical = {names:?}");
        runs = run(&read(file, OnUnphysical::Balance).expect("it loads"));
    }
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for warning in robot.warnings() {
        *kinds.entry(kind_of(warning)).or_default() += 1;
    }
    if !kinds.is_empty() {
        row += "warnings = [\n";
        for (kind, count) in kinds {
            let _ = writeln!(row, "  {:?},", format!("{count} x {kind}"));
        }
        row += "]\n";
    }
    for op in ["fk", "jacobian"] {
        let answer = ask(&robot, &json!({ "op": op, "q": vec![0.0; robot.n()] }));
        let answer = outcome(&answer);
        if answer != "answered" {
            let _ = writeln!(row, "kinematics = {answer:?}");
        }
    }
    let _ = writeln!(row, "run_1s = {runs:?}");
    row
}

/// The rows of all `files`, on all processors.
fn rows(folder: &Path, files: &[PathBuf]) -> Vec<String> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let rows = Mutex::new(vec![String::new(); files.len()]);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(file) = files.get(i) else { break };
                    let row = row(folder, file);
                    rows.lock().expect("not poisoned")[i] = row;
                }
            });
        }
    });
    rows.into_inner().expect("not poisoned")
}

/// Compares the table `name`, which says `about` at its head what it is of, with what comes of the files below `folder`.
#[track_caller]
fn held(name: &str, about: &str, folder: &Path) -> Vec<String> {
    let files = files_below(folder, ".urdf");
    let rows = rows(folder, &files);
    let fresh = format!("{about}{KEYS}{}", rows.concat());
    let table = Path::new(TABLES).join(name);
    let committed = std::fs::read_to_string(&table).unwrap_or_default();
    if fresh == committed {
        return rows;
    }
    let known: Vec<&str> = committed.split("\n[[robots]]\n").map(str::trim).collect();
    let differing = rows
        .iter()
        .filter(|row| !known.contains(&row.trim_start_matches("\n[[robots]]\n").trim()));
    let differing: String = differing.map(String::as_str).collect();
    let what = if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(&table, &fresh).expect("written");
        "written anew; run the tests again without KINEMARK_BLESS"
    } else {
        "not what the code gives"
    };
    panic!("{name}: {what}; rows that differ:\n{differing}");
}

#[test]
fn files_with_the_peculiarities_of_published_ones_come_out_as_the_table_says() {
    let about = "# What comes of the files in tests/robots/peculiar/, which are made for this table: each has one peculiarity of a\n\
                 # published URDF and is named after it.\n#\n";
    let folder = Path::new(TABLES).join("peculiar");
    let rows = held("peculiar.toml", about, &folder);
    let refused = rows.iter().filter(|row| row.contains("\nrefused = "));
    assert_eq!((rows.len(), refused.count()), (12, 1));
}

#[test]
fn published_robots_come_out_as_the_table_says() {
    let Some(folder) = std::env::var_os("KINEMARK_ROBOTS") else {
        // past the harness, which would keep it to itself
        let note = "\npublished robots: not run: set KINEMARK_ROBOTS to the folder `robots` of example-robot-data\n";
        let mut stderr = std::io::stderr();
        stderr.write_all(note.as_bytes()).expect("standard error");
        return;
    };
    let about = "# What comes of all URDFs of the PyPI package `example-robot-data` 6.0.0, of which nothing is in this tree. The step\n\
                 # `published` of .ci/full fetches it and compares this table with it.\n#\n";
    let rows = held("published.toml", about, Path::new(&folder));
    let refused: Vec<&String> = rows
        .iter()
        .filter(|row| row.contains("\nrefused = "))
        .collect();
    // ur3.urdf is an empty robot
    assert_eq!((rows.len(), refused.len()), (69, 1), "{refused:#?}");
    assert!(refused[0].contains("ur_description/urdf/ur3.urdf"));
}

#[test]
fn a_kind_of_warning_has_no_names_and_no_numbers() {
    for (sentence, kind) in [
        (
            "link `a`: mesh `b.dae` is COLLADA (line 12)",
            "link …: mesh … is COLLADA",
        ),
        (
            "limits from 0 to -1.5 say so (line 3)",
            "limits from … to … say so",
        ),
        ("links `a` 12, `b` 3 are heavy", "links … are heavy"),
        ("no body:\n  `a`", "no body:"),
    ] {
        assert_eq!(kind_of(sentence), kind);
    }
}
