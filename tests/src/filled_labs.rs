//! `kinemark lab fill`: the labs of this tree hold what it writes, pictures included; and what it writes into a lab that waits for it.
//!
//! Where a lab is out of date, `kinemark lab fill LAB` mends it.

use kinemark_grader::lab::brief::BEGIN;
use kinemark_grader::lab::load::lab_names;
use serde_json::Value as Json;

use crate::every_case::every_case;
use crate::own_lab::OwnLab;
use crate::testbed::{Folder, TestBed, root};

/// The pictures that `brief` links to.
fn linked(brief: &str) -> Vec<&str> {
    let targets = brief.split("](").skip(1).filter_map(|rest| {
        let (target, _) = rest.split_once(')')?;
        target.ends_with(".svg").then_some(target)
    });
    targets.collect()
}

#[test]
fn the_labs_hold_what_fill_writes() {
    let bed = TestBed::new();
    bed.copy_labs();
    let labs = lab_names(&Folder(root().join("labs")));
    let cases: Vec<_> = labs.into_iter().map(|lab| (lab.clone(), lab)).collect();
    every_case(&cases, |name| {
        let ran = bed.run(&["lab", "fill", name, "--json"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        let filled: Json = serde_json::from_str(&ran.stdout).expect("JSON");
        for changed in ["written", "removed"] {
            let none = Json::Array(Vec::new());
            assert_eq!(filled[changed], none, "run `kinemark lab fill {name}`");
        }
    });
}

#[test]
fn every_brief_has_a_table_and_shows_every_picture_of_its_lab() {
    for name in lab_names(&Folder(root().join("labs"))) {
        let folder = root().join("labs").join(&name);
        let brief = std::fs::read_to_string(folder.join("brief.md")).expect("brief.md");
        assert!(brief.contains(BEGIN), "{name} has no grading table");
        let pictures = linked(&brief);
        assert!(!pictures.is_empty(), "{name}: a brief without a picture");
        for picture in &pictures {
            assert!(folder.join(picture).is_file(), "{name}: no {picture}");
        }
        for entry in std::fs::read_dir(&folder).expect("the lab's folder") {
            let file = entry.expect("entry").file_name();
            let file = file.to_string_lossy();
            let is_shown = !file.ends_with(".svg") || pictures.contains(&file.as_ref());
            assert!(is_shown, "{name}: the brief does not show {file}");
        }
    }
}

/// A lab with a function of its own whose cases wait, and a motion whose plot the brief shows.
const LAB: &str = r#"# the lab of a test
format = 1
name = "96-fill"
title = "Fill"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "roots"
title = "Roots"
[tasks.function]
call = "roots"
cases = [
    { name = "one and two", given = { b = -3.0, c = 2.0 } },  # x^2 - 3 x + 2
    { name = "three twice", given = { b = -6.0, c = 9.0 }, expected = { low = 3.0, high = 3.0 } },
]
[[tasks.checks]]
name = "roots"
title = "Both"
points = 1
function-cases = { full = 1e-9, zero = 1 }

[[tasks]]
name = "stay"
title = "Stay"
[tasks.motion]
mode = "position"
duration_s = 0.5
goals = [{ position_m = [4, 0, 0.05], dwell_s = 0.1 }]
servo = { kp = 100, kd = 10 }
[[tasks.checks]]
name = "stay"
title = "Stay"
points = 1
pose-reached = { full_m = 0.01, zero_m = 0.1 }
"#;

const SOLUTION: &str = "
fn roots(given) {
    let d = sqrt(given.b * given.b / 4 - given.c);
    #{ high: -given.b / 2 + d, low: -given.b / 2 - d }
}
fn control(observation) { [0.0, 0.0] }
";

fn waiting() -> OwnLab {
    let lab = OwnLab::new("96-fill", LAB);
    lab.write("labs/96-fill/brief.md", "# Fill\n\n![The path](plot-stay-path.svg)\n\n<!-- grading: begin --><!-- grading: end -->\n");
    lab.write(
        "labs/96-fill/starter.rhai",
        "fn control(observation) { observation.q }\n",
    );
    lab.write("reference/96-fill/solution.rhai", SOLUTION);
    lab.write(
        "reference/96-fill/hidden.toml",
        "format = 1\nsalt = \"of a test, long enough\"\n",
    );
    lab
}

#[test]
fn a_case_that_waits_gets_the_answer_of_the_solution_and_the_brief_its_plot() {
    let lab = waiting();
    let bed = lab.bed();
    let checked = bed.run(&["lab", "check", "96-fill"]);
    assert_eq!(checked.code, Some(3), "{checked:?}");
    assert!(checked.stderr.contains("kinemark lab fill"), "{checked:?}");

    let ran = bed.run(&["lab", "fill", "96-fill"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for file in [
        "lab.toml",
        "practice.json",
        "brief.md",
        "plot-stay-path.svg",
    ] {
        let path = bed.path(&format!("labs/96-fill/{file}"));
        assert!(
            path.is_file() && ran.stdout.contains(file),
            "{file}: {ran:?}"
        );
    }
    let text = std::fs::read_to_string(bed.path("labs/96-fill/lab.toml")).expect("lab.toml");
    let filled = LAB.replace(
        "c = 2.0 } },  #",
        "c = 2.0 }, expected = { high = 2.0, low = 1.0 } },  #",
    );
    assert_eq!(text, filled);
    let again = bed.run(&["lab", "fill", "96-fill"]);
    assert!(!again.stdout.contains("wrote"), "{again:?}");

    // one that is there stays, unless all are asked for
    lab.edit("high = 3.0", "high = 3.5");
    let ran = bed.run(&["lab", "fill", "96-fill"]);
    assert!(!ran.stdout.contains("wrote"), "{ran:?}");
    let ran = bed.run(&["lab", "fill", "96-fill", "--expected"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(bed.path("labs/96-fill/lab.toml")).expect("lab.toml");
    let order = filled.replace("{ low = 3.0, high = 3.0 }", "{ high = 3.0, low = 3.0 }");
    assert_eq!(text, order);
}

/// A check of one entry is read before there is an answer with that entry.
#[test]
fn answers_are_filled_in_where_a_check_reads_one_entry_of_them() {
    let lab = waiting();
    lab.edit(", expected = { low = 3.0, high = 3.0 }", "");
    lab.edit(
        "zero = 1 }\n\n[[tasks]]",
        "zero = 1, entry = \"low\" }\n\n[[tasks]]",
    );
    let ran = lab.bed().run(&["lab", "fill", "96-fill"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(lab.bed().path("labs/96-fill/lab.toml")).expect("lab.toml");
    assert_eq!(text.matches("expected = { high = ").count(), 2, "{text}");
    // a name that no answer has is a slip still
    lab.edit("entry = \"low\"", "entry = \"lov\"");
    let ran = lab.bed().run(&["lab", "check", "96-fill", "--quick"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(
        ran.stderr.contains("no case expects an entry `lov`"),
        "{ran:?}"
    );
}

#[test]
fn what_cannot_be_filled_is_said_and_nothing_is_written() {
    for (from, to, words) in [
        ("low: -given.b / 2 - d", "low: \"two\"", "the text \"two\""),
        ("low: -given.b / 2 - d", "low: 1 / 0.0", "inf"),
        ("let d =", "throw \"not yet\"; let d =", "not yet"),
    ] {
        let lab = waiting();
        let bed = lab.bed();
        bed.edit("reference/96-fill/solution.rhai", from, to);
        let ran = bed.run(&["lab", "fill", "96-fill"]);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        assert!(ran.stderr.contains(words), "{ran:?}");
        let text = std::fs::read_to_string(bed.path("labs/96-fill/lab.toml")).expect("lab.toml");
        assert_eq!(text, LAB);
    }
    for (plot, words) in [
        ("plot-stay-pth.svg", "no plot is called `stay-pth`"),
        (
            "plot-stay-path-by-nobody.svg",
            "no mutant is called `nobody`",
        ),
    ] {
        let lab = waiting();
        lab.bed()
            .edit("labs/96-fill/brief.md", "plot-stay-path.svg", plot);
        let ran = lab.bed().run(&["lab", "fill", "96-fill"]);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        let plain = ran.stderr.replace("\n  │", "").replace('\n', " ");
        assert!(plain.contains(words), "{ran:?}");
    }
}
