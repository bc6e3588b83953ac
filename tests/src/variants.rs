//! Labs with numbers of each student's own: written by staff, taken by students, graded, reported, verified; and hidden runs.

use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::record::grade::Grade;
use kinemark_sim::text::Source;
use serde_json::Value as Json;

use crate::lab_audit::passes_variants;
use crate::testbed::{Folder, TestBed, grade};

pub(crate) const LAB: &str = r#"
format = 1
name = "93-touch"
title = "Touch a place of your own"
robot = "rrbot"
frame = "lab"

[parameters]
out = 0.9                        # y of the place [m]
lengths = [1.0, 1.0]             # [m]

[dimensions]
link_lengths = ["= lengths[0]", "= lengths[1]"]

[variants]
out = { from = 0.85, to = 0.95, step = 0.01 }
lengths = [{ from = 0.95, to = 1.05, step = 0.01 }, { from = 0.95, to = 1.05, step = 0.01 }]

[[tasks]]
name = "fk"
title = "Where is it?"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "bent", q_rad = [0.5, "= out"] }]
[[tasks.checks]]
name = "position"
title = "The position"
points = 2.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "touch"
title = "Be there"
[tasks.motion]
mode = "position"
scene = { name = "shelf-and-can", dimensions = { can_at = "= out + 0.1", shelf_at = "= out + 0.1" } }
duration_s = 3.0
goals = [{ position_m = [2.5, "= out", 0.05], dwell_s = 0.2 }]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }
[[tasks.checks]]
name = "there"
title = "The tip is there"
points = 3.0
pose-reached = { full_m = 0.02, zero_m = 0.1 }
"#;

pub(crate) const HIDDEN: &str = r#"
format = 1
salt = "sea"

[[draws]]
task = "fk"
class = "other bends"
count = 3
q_rad = [[-3.0, 3.0], [-3.0, 3.0]]

[[runs]]
task = "touch"
class = "nearer places"
count = 2
parameters = { out = [0.6, 0.75] }
"#;

pub(crate) const SOLUTION: &str = r#"
fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    let x = robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
    [x, l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]), 2.0 * robot.link_offset]
}

fn init(robot, task) {
    this.robot = robot;
}

fn control(observation) {
    let l = this.robot.link_lengths;
    let u = observation.target[0][0] - this.robot.base_height;
    let out = observation.target[0][1];
    let c = (u * u + out * out - l[0] * l[0] - l[1] * l[1]) / (2.0 * l[0] * l[1]);
    let q2 = acos(c);
    [atan2(out, u) - atan2(l[1] * sin(q2), l[0] + l[1] * cos(q2)), q2]
}
"#;

pub(crate) const BRIEF: &str = "# Touch\n\nBe at y = 0.9<!-- = out --> m, with links of 1.00<!-- = lengths[0] | 2 --> m.\n\n<!-- grading: begin -->\n<!-- grading: end -->\n";

pub(crate) fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    for (name, text) in [
        ("labs/93-touch/lab.toml", LAB),
        ("labs/93-touch/brief.md", BRIEF),
        (
            "labs/93-touch/starter.rhai",
            "fn control(observation) {\n    [0.0, 0.0]\n}\n",
        ),
        ("reference/93-touch/hidden.toml", HIDDEN),
        ("reference/93-touch/solution.rhai", SOLUTION),
        ("solution.rhai", SOLUTION),
    ] {
        bed.write(name, text);
    }
    bed
}

fn record(bed: &TestBed, folder: &str) -> Json {
    let text = std::fs::read_to_string(bed.path(folder).join("grade.json")).expect("record");
    serde_json::from_str(&text).expect("JSON")
}

pub(crate) fn places(bed: &TestBed) -> [Folder; 2] {
    ["labs", "reference"].map(|folder| Folder(bed.path(folder)))
}

pub(crate) fn base(bed: &TestBed) -> Lab {
    Lab::load(&places(bed)[0], "93-touch").unwrap_or_else(|error| panic!("{error:?}"))
}

pub(crate) fn graded(bed: &TestBed, submission: &str) -> Grade {
    let lab = base(bed);
    let staff = Staff::load(&places(bed)[1], &lab, None);
    let staff = staff.unwrap_or_else(|error| panic!("{error:?}"));
    grade(&lab, staff.as_ref(), "mine.rhai", submission).grade
}

#[test]
fn staff_write_the_numbers_of_a_student() {
    let bed = bed();
    let of = |student: &str, more: &[&str]| {
        let args = ["lab", "variant", "93-touch", "--student", student];
        bed.run(&[&args, more].concat())
    };
    let printed = of("s1234567", &[]);
    assert_eq!(printed.code, Some(0), "{printed:?}");
    // on every machine and in every later version: students hold files of these numbers
    assert_eq!(
        printed.stdout,
        "format = 1\nlab = \"93-touch\"\nstudent = \"s1234567\"\n\n[parameters]\nlengths = [0.95, 0.97]\nout = 0.87\n"
    );
    let numbers = |stdout: &str| stdout.split_once("[parameters]").map(|(_, n)| n.to_owned());
    let other = of("s1234568", &[]).stdout;
    assert_ne!(numbers(&other), numbers(&printed.stdout));
    assert_ne!(
        printed.stdout,
        of("s1234567", &["--salt", "another"]).stdout
    );
    let ran = of("s1234567", &["--out", "variant.toml"]);
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(0), ""), "{ran:?}");
    let written = std::fs::read_to_string(bed.path("variant.toml")).expect("written");
    assert_eq!(written, printed.stdout);
    let again = of("s1234567", &["--out", "variant.toml"]);
    assert_eq!(again.code, Some(2), "{again:?}");
    assert!(again.stderr.contains("already exists"), "{again:?}");
    let json: Json = serde_json::from_str(&of("s1234567", &["--json"]).stdout).expect("JSON");
    assert_eq!(json["student"], "s1234567");
    assert!(json["parameters"]["lengths"][1].is_number());

    for (args, words) in [
        (&["--reference", "labs"][..], "needs the course's salt"),
        (&["--reference", "nowhere"], "holds LAB/hidden.toml"),
        // without the course staff's part there is no salt
        (&["--practice"], "unexpected argument"),
    ] {
        let ran = of("s1234567", args);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains(words), "{ran:?}");
    }
    let ran = of("", &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let (head, rest) = LAB.split_once("[variants]").expect("variants");
    let (_, tail) = rest.split_once("[[tasks]]").expect("tasks");
    bed.write("labs/93-touch/lab.toml", format!("{head}[[tasks]]{tail}"));
    let ran = of("s1", &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("has no variants"), "{ran:?}");
}

#[test]
fn a_variant_is_given_out_graded_reported_and_verified() {
    let bed = bed();
    let ran = bed.run(&["new", "93-touch", "mine", "--student", "s7"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let variant = std::fs::read_to_string(bed.path("mine/variant.toml")).expect("variant");
    assert_eq!(
        variant,
        bed.run(&["lab", "variant", "93-touch", "--student", "s7"])
            .stdout
    );
    let out = variant
        .lines()
        .find_map(|line| line.strip_prefix("out = "))
        .expect("out");
    let brief = std::fs::read_to_string(bed.path("mine/brief.md")).expect("brief");
    assert!(
        brief.contains(&format!("Be at y = {out} m, with links of ")),
        "{brief}"
    );
    // the marks are for whoever writes the lab
    assert!(!brief.contains("<!-- ="), "{brief}");
    assert!(
        brief.contains("| touch | The tip is there | 3 |"),
        "{brief}"
    );

    // what lies beside the submission is taken in practice, and said so
    std::fs::copy(bed.path("solution.rhai"), bed.path("mine/submission.rhai")).expect("copied");
    let mine = ["grade", "93-touch", "mine/submission.rhai"];
    let ran = bed.run(&[&mine[..], &["--practice", "--out", "practice"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout
            .starts_with("using the variant in mine/variant.toml\n"),
        "{ran:?}"
    );
    let ran = bed.run(&[&mine[..], &["--variant", "mine/variant.toml"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("\nvariant of s7: lengths = ["),
        "{ran:?}"
    );
    let own = record(&bed, "out");
    assert_eq!(own["variant"]["student"], "s7");
    assert_eq!(own["variant"]["parameters"]["out"].to_string(), out);
    assert!(bed.path("out/lab/93-touch/variant.toml").is_file());
    let report = std::fs::read_to_string(bed.path("out/report.html")).expect("report");
    assert!(report.contains("variant of s7: lengths = ["));
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.starts_with(
            "graded report: 93-touch, submission.rhai, variant of `s7`: 5 of 5 points\n"
        ),
        "{ran:?}"
    );
    assert!(
        ran.stdout.contains("\nsame bits: 2 of 2 tasks, "),
        "{ran:?}"
    );

    // the same by the student's id; the lab as everyone has it is another
    let by_id = [
        "grade",
        "93-touch",
        "solution.rhai",
        "--student",
        "s7",
        "--out",
        "id",
    ];
    assert_eq!(bed.run(&by_id).code, Some(0));
    assert_eq!(record(&bed, "id")["lab"], own["lab"]);
    let ran = bed.run(&[
        "grade",
        "93-touch",
        "solution.rhai",
        "--out",
        "base",
        "--json",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let everyone = record(&bed, "base");
    assert_eq!(everyone.get("variant"), None);
    assert_ne!(everyone["lab"], own["lab"]);
    assert_ne!(everyone["tasks"][1]["digests"], own["tasks"][1]["digests"]);
}

/// What `verify` says of the report in `out`.
fn verified(bed: &TestBed, args: &[&str], code: i32, words: &str) {
    let ran = bed.run(&[&["verify", "out"], args].concat());
    assert_eq!(ran.code, Some(code), "{args:?}: {ran:?}");
    assert!(
        ran.stdout.contains(words),
        "{args:?}: no {words:?} in {ran:?}"
    );
}

#[test]
fn a_variant_of_somebody_else_is_found_in_a_report() {
    let bed = bed();
    let grade = |args: &[&str]| {
        let ran = bed.run(&[&["grade", "93-touch", "solution.rhai"], args].concat());
        assert_eq!(ran.code, Some(0), "{args:?}: {ran:?}");
    };
    let not_the_variant = "its variant is not the one that the course gives";
    grade(&["--student", "s7"]);
    verified(
        &bed,
        &["--graded", "--labs", "labs", "--student", "s7"],
        0,
        "same bits",
    );
    verified(&bed, &["--student", "s8"], 1, not_the_variant);
    // without the salt nobody can say
    verified(&bed, &["--practice"], 5, "not compared: variant: ");
    verified(
        &bed,
        &["--practice"],
        5,
        "not compared: hidden runs of task `touch`",
    );
    // the copy was changed after grading
    let variant = std::fs::read_to_string(bed.path("out/lab/93-touch/variant.toml"));
    let variant = variant.expect("a variant");
    bed.write(
        "out/lab/93-touch/variant.toml",
        variant.replace("out = 0.", "out = 0.7"),
    );
    verified(&bed, &[], 1, not_the_variant);
    verified(&bed, &["--practice"], 1, "differs: lab\n");

    // numbers that the lab does not have
    bed.write(
        "out/lab/93-touch/variant.toml",
        variant.replace("out = ", "ouf = "),
    );
    verified(&bed, &[], 1, "lab `93-touch` has no parameter `ouf`");

    // graded by a student with easier numbers, under the own name and under none
    let easy = "format = 1\nlab = \"93-touch\"\nstudent = \"s7\"\n[parameters]\nout = 0.5\n";
    bed.write("easy.toml", easy);
    grade(&["--variant", "easy.toml", "--practice"]);
    verified(&bed, &[], 1, not_the_variant);
    verified(&bed, &["--practice"], 5, "not compared: variant: ");
    let nobodys = easy
        .replace("student = \"s7\"\n", "")
        .replace("0.5", "0.86");
    bed.write("easy.toml", &nobodys);
    grade(&["--variant", "easy.toml"]);
    verified(
        &bed,
        &[],
        5,
        "not compared: variant: its variant.toml names no student",
    );
    verified(&bed, &["--student", "s7"], 1, not_the_variant);
    // course staff grade with no numbers that no student has
    bed.write(
        "out/lab/93-touch/variant.toml",
        nobodys.replace("0.86", "0.5"),
    );
    verified(
        &bed,
        &[],
        1,
        "no student's variant of lab `93-touch` has out = 0.5",
    );

    // the numbers of everybody are nobody's variant
    grade(&[]);
    verified(&bed, &[], 0, "default variant");
    verified(&bed, &["--student", "s7"], 1, not_the_variant);
}

/// Staff verify a report that was made with the lab as it was handed out, which says what the reference solution reaches in a variant.
#[test]
fn what_a_handed_out_lab_says_of_the_reference_is_compared() {
    let bed = TestBed::a_little_off();
    bed.write("roster.csv", "id\ns7\n");
    let pack = ["lab", "pack", "01-kinematics", "--for", "students"];
    let ran = bed.run(&[&pack[..], &["--roster", "roster.csv", "--out", "pack.zip"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let file = std::fs::File::open(bed.path("pack.zip")).expect("a pack");
    let mut pack = zip::ZipArchive::new(file).expect("a pack");
    pack.extract(bed.path("home")).expect("unpacked");
    let home = bed.path("home/s7");
    std::fs::copy(bed.path("submission.rhai"), home.join("submission.rhai")).expect("copied");
    let grade = || {
        let ran = bed.run_in(&home, &["grade", "--out", "../../out"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
    };
    grade();
    let own = std::fs::read_to_string(bed.path("out/lab/01-kinematics/practice.json"));
    let own = own.expect("values of the reference solution");
    verified(&bed, &[], 0, "practice report, visible cases only: ");
    verified(
        &bed,
        &["--practice"],
        5,
        "not compared: what practice.json says",
    );
    // a reference solution that takes its time
    let value = own.split("\"time\":").nth(1);
    let value = value.and_then(|rest| rest.split([',', '}']).next());
    let value = value.expect("a value");
    let eased = own.replace(&format!("\"time\":{value}"), "\"time\":100.0");
    std::fs::write(home.join("labs/01-kinematics/practice.json"), eased).expect("written");
    grade();
    verified(
        &bed,
        &[],
        1,
        "the lab is not the course's (what practice.json says",
    );
}

#[test]
fn numbers_of_somebody_else_are_refused_by_staff_alone() {
    let bed = bed();
    let args = [
        "grade",
        "93-touch",
        "solution.rhai",
        "--variant",
        "easy.toml",
    ];
    let easy = "format = 1\nlab = \"93-touch\"\nstudent = \"s7\"\n[parameters]\nout = 0.5\n";
    bed.write("easy.toml", easy);
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("is not the variant of student `s7`"),
        "{ran:?}"
    );
    assert!(ran.stderr.contains("grade with `--student s7`"), "{ran:?}");
    let ran = bed.run(&[&args[..], &["--practice"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // nobody's numbers are anybody's, if anybody can have them
    let nobodys = easy.replace("student = \"s7\"\n", "");
    bed.write("easy.toml", &nobodys);
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("easy.toml:4:7"), "{ran:?}");
    let words = "no student's variant of lab `93-touch` has out = 0.5";
    assert!(ran.stderr.contains(words), "{ran:?}");
    assert!(
        ran.stderr.contains("`out` 0.85 to 0.95 in steps of 0.01"),
        "{ran:?}"
    );
    bed.write("easy.toml", nobodys.replace("0.5", "0.86"));
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("variant without a student's name: "),
        "{ran:?}"
    );
    assert!(ran.stdout.contains("out = 0.86"), "{ran:?}");
}

#[test]
fn numbers_that_nobody_can_have_are_the_fault_of_their_file() {
    let bed = bed();
    bed.edit(
        "labs/93-touch/lab.toml",
        "lengths = [1.0, 1.0] ",
        "wait = 0.2\nlengths = [1.0, 1.0] ",
    );
    bed.edit(
        "labs/93-touch/lab.toml",
        "dwell_s = 0.2",
        "dwell_s = \"= wait\"",
    );
    bed.edit(
        "labs/93-touch/lab.toml",
        "[variants]\n",
        "[variants]\nwait = { from = 0.2, to = 0.3, step = 0.1 }\n",
    );
    let args = ["grade", "93-touch", "solution.rhai", "--variant", "v.toml"];
    let graded = |numbers: &str, more: &[&str]| {
        let text = format!("format = 1\nlab = \"93-touch\"\n[parameters]\n{numbers}\n");
        bed.write("v.toml", text);
        bed.run(&[&args[..], more].concat())
    };
    for numbers in ["wait = 0.3", "lengths = [0.95, 1.05]", "out = 0.9"] {
        let ran = graded(numbers, &[]);
        assert!(matches!(ran.code, Some(0 | 1)), "{numbers}: {ran:?}");
    }
    for (numbers, at, words) in [
        ("wait = 0.25", "v.toml:4:8", "has wait = 0.25"),
        (
            "lengths = [1.0, 1.06]",
            "v.toml:4:11",
            "has lengths = [1.0, 1.06]",
        ),
        (
            "out = 0.9\nlengths = [1.0]",
            "v.toml:5:11",
            "is a list of 2, got a list of 1",
        ),
        ("wiat = 0.2", "v.toml:4:1", "has no parameter `wiat`"),
    ] {
        let ran = graded(numbers, &[]);
        assert_eq!(ran.code, Some(2), "{numbers}: {ran:?}");
        assert!(
            ran.stderr.contains(at) && ran.stderr.contains(words),
            "{numbers}: {ran:?}"
        );
    }
    // a parameter that is the same for everybody
    bed.edit(
        "labs/93-touch/lab.toml",
        "wait = { from = 0.2, to = 0.3, step = 0.1 }\n",
        "",
    );
    let ran = graded("wait = 0.2", &[]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = graded("wait = 0.3", &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let words = "parameter `wait` of lab `93-touch` is 0.2 for everybody";
    assert!(ran.stderr.contains(words), "{ran:?}");
    // in practice any numbers will do that make a lab; where they make none, the file is to blame and not the lab
    assert_eq!(graded("wait = 0.3", &["--practice"]).code, Some(0));
    let ran = graded("wait = -1.0", &["--practice"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("v.toml:4:8") && ran.stderr.contains("lab `93-touch` is invalid"),
        "{ran:?}"
    );
}

#[test]
fn a_variant_file_that_does_not_fit_is_refused_at_its_place() {
    let bed = bed();
    let files = &places(&bed)[0];
    let good = "format = 1\nlab = \"93-touch\"\n[parameters]\nout = 0.86\nlengths = [1, 1.01]\n";
    for (from, to, at, message) in [
        (
            "out",
            "ouf",
            (4, 1),
            "lab `93-touch` has no parameter `ouf`",
        ),
        (
            "0.86",
            "[0.86]",
            (4, 7),
            "parameter `out` is one number, got a list of 1",
        ),
        (
            "[1, 1.01]",
            "[1]",
            (5, 11),
            "parameter `lengths` is a list of 2, got a list of 1",
        ),
        (
            "93-touch",
            "94-touch",
            (2, 7),
            "this is a variant of lab `94-touch`, not of `93-touch`",
        ),
        ("0.86", "nan", (4, 7), "a lab's numbers are finite"),
        (
            "format = 1",
            "format = 2",
            (1, 10),
            "this file is written for a newer Kinemark: format 2; this one reads 1",
        ),
        ("format = 1", "format = 0", (1, 10), "format 0 is not known"),
        (
            "format = 1",
            "format = 1\nstudent = \"\"",
            (2, 11),
            "the student id is empty",
        ),
        (
            "format = 1",
            "format = 1\nstudent = \" s7\"",
            (2, 11),
            "the student id begins or ends with a space",
        ),
        (
            "format = 1",
            "format = 1\nstudent = \"s\\u00077\"",
            (2, 11),
            "the student id has an invisible character (U+0007)",
        ),
    ] {
        let source = Source::new("variant.toml", good.replacen(from, to, 1));
        let loaded = Variant::parse(source)
            .map_err(Into::into)
            .and_then(|variant| Lab::load_variant(files, "93-touch", Some(&variant)));
        match loaded {
            Err(kinemark_grader::task::problem::LoadError::Lab(error)) => {
                assert!(error.to_string().contains(message), "{error}");
                assert_eq!(error.line_and_column(), at, "{error}");
            }
            other => panic!("{to}: {other:?}"),
        }
    }
}

#[test]
fn the_reference_has_full_marks_in_every_variant() {
    let bed = bed();
    let [labs, reference] = places(&bed);
    passes_variants(&labs, &reference, &base(&bed), 12);
}

#[test]
fn every_variant_is_another_lab() {
    let bed = bed();
    let lab = base(&bed);
    let mut digests: Vec<String> = (0..8)
        .map(|student| {
            let variant = lab
                .variant_of("sea", &format!("s{student}"))
                .expect("a variant");
            let lab = Lab::load_variant(&places(&bed)[0], "93-touch", Some(&variant));
            let lab = lab.unwrap_or_else(|error| panic!("{error:?}"));
            grade(&lab, None, "mine.rhai", "").grade.lab.digest
        })
        .collect();
    digests.push(grade(&lab, None, "mine.rhai", "").grade.lab.digest);
    let all = digests.len();
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), all);
}

#[test]
fn an_empty_salt_is_no_salt() {
    let bed = bed();
    let args = ["lab", "variant", "93-touch", "--student", "s7"];
    for salt in ["", " "] {
        let by_option = bed.run(&[&args[..], &["--salt", salt]].concat());
        let mut by_environment = bed.command(&args);
        let by_environment = by_environment.env("KINEMARK_SALT", salt).output();
        for ran in [by_option, by_environment.expect("runs").into()] {
            assert_eq!(ran.code, Some(2), "{ran:?}");
            assert!(ran.stderr.contains("the salt is empty"), "{ran:?}");
            assert!(ran.stderr.contains("hidden.toml"), "{ran:?}");
        }
    }
}

#[cfg(unix)]
#[test]
fn links_of_students_are_not_followed() {
    use std::os::unix::fs::symlink;
    let bed = bed();
    let secret = bed.path("reference/93-touch/hidden.toml");
    std::fs::create_dir(bed.path("alice")).expect("folder");
    symlink(&secret, bed.path("alice/link.rhai")).expect("link");
    let refused = |args: &[&str], name: &str| {
        let ran = bed.run(&[args, &["--practice"]].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
        let words = format!("`{name}` is a link to another file");
        assert!(ran.stderr.contains(&words), "{ran:?}");
        assert!(ran.stderr.contains("copy the file itself"), "{ran:?}");
        assert!(!ran.stderr.contains("salt"), "{ran:?}");
        assert!(!bed.path("out").exists(), "{ran:?}");
    };
    // a submission is graded as what it is, and nothing is read through the link
    let ran = bed.run(&["grade", "93-touch", "alice/link.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("`link.rhai` is a link to another file"),
        "{ran:?}"
    );
    let record = std::fs::read_to_string(bed.path("out/grade.json")).expect("a record");
    assert!(
        record.contains("did-not-build") && !record.contains("salt"),
        "{record}"
    );
    std::fs::remove_dir_all(bed.path("out")).expect("removed");
    bed.write("alice/mine.rhai", SOLUTION);
    let mine = ["grade", "93-touch", "alice/mine.rhai"];
    let beside = bed.path("alice/variant.toml");
    for target in [secret, bed.path("nowhere")] {
        symlink(target, &beside).expect("link");
        refused(&mine, "alice/variant.toml");
        std::fs::remove_file(&beside).expect("removed");
    }
    std::fs::create_dir(&beside).expect("folder");
    let ran = bed.run(&[&mine[..], &["--practice"]].concat());
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("is a folder, not a variant"), "{ran:?}");
    std::fs::remove_dir(&beside).expect("removed");

    // what a person names may be one
    let args = [
        "lab",
        "variant",
        "93-touch",
        "--student",
        "s7",
        "--out",
        "s7.toml",
    ];
    assert_eq!(bed.run(&args).code, Some(0));
    symlink(bed.path("s7.toml"), bed.path("link.toml")).expect("link");
    let ran = bed.run(&[&mine[..], &["--variant", "link.toml"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("variant of s7: "), "{ran:?}");
}

#[test]
fn a_grade_of_everybodys_numbers_says_so() {
    let bed = bed();
    let args = ["grade", "93-touch", "solution.rhai"];
    let says = "no variant given: using the default parameters of lab.toml\n";
    let ran = bed.run(&args);
    assert!(ran.stdout.starts_with(says), "{ran:?}");
    let ran = bed.run(&[&args[..], &["--json"]].concat());
    assert!(ran.stdout.starts_with('{'), "{ran:?}");
    let ran = bed.run(&[&args[..], &["--practice"]].concat());
    assert!(!ran.stdout.contains(says), "{ran:?}");
    // a file of somebody else beside it is not taken, and not passed over in silence
    bed.write(
        "variant.toml",
        "format = 1\nlab = \"93-touch\"\n[parameters]\nout = 0.5\n",
    );
    let unused = "using the default parameters of lab.toml; variant.toml is not used, because it may be the student's own";
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.starts_with(unused), "{ran:?}");
    assert_eq!(record(&bed, "out").get("variant"), None);
    let ran = bed.run(&[&args[..], &["--json"]].concat());
    assert!(
        ran.stdout.starts_with('{') && ran.stderr.contains(&format!("note: {unused}")),
        "{ran:?}"
    );
    let ran = bed.run(&[&args[..], &["--student", "s7"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout
            .starts_with("using the variant of student s7; variant.toml is not used\n"),
        "{ran:?}"
    );
}
