//! Labs with numbers of each student's own: written by staff, taken by students, graded, reported, verified; and hidden runs.

use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;
use kinemark_sim::source::Source;
use serde_json::Value as Json;

use crate::lab_audit::passes_variants;
use crate::testbed::{Folder, TestBed, files_below, grade};

const LAB: &str = r#"
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

const HIDDEN: &str = r#"
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

const SOLUTION: &str = r#"
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

const BRIEF: &str = "# Touch\n\nBe at y = 0.9<!-- = out --> m, with links of 1.00<!-- = lengths[0] | 2 --> m.\n\n<!-- grading: begin -->\n<!-- grading: end -->\n";

fn bed() -> TestBed {
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

fn places(bed: &TestBed) -> [Folder; 2] {
    ["labs", "reference"].map(|folder| Folder(bed.path(folder)))
}

fn base(bed: &TestBed) -> Lab {
    Lab::load(&places(bed)[0], "93-touch").unwrap_or_else(|error| panic!("{error:?}"))
}

fn graded(bed: &TestBed, submission: &str) -> Grade {
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

    let ran = of("s1234567", &["--practice"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("needs the course's salt"), "{ran:?}");
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
        brief.contains(&format!("Be at y = {out}<!-- = out --> m")),
        "{brief}"
    );
    assert!(
        brief.contains("| touch | The tip is there | 3 |"),
        "{brief}"
    );

    // what lies beside the submission is taken, and said so
    std::fs::copy(bed.path("solution.rhai"), bed.path("mine/submission.rhai")).expect("copied");
    let ran = bed.run(&["grade", "93-touch", "mine/submission.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout
            .starts_with("using the variant in mine/variant.toml\n"),
        "{ran:?}"
    );
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
    assert!(ran.stdout.starts_with("same bits: 2 of 2 tasks"), "{ran:?}");
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert!(
        ran.stdout
            .contains("not compared: task `touch`: its hidden runs"),
        "{ran:?}"
    );
    bed.edit(
        "out/lab/93-touch/variant.toml",
        &format!("out = {out}"),
        "out = 0.9123",
    );
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("differs: lab"), "{ran:?}");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("is not the variant of student `s7`"),
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
    // nobody's numbers are anybody's
    bed.write("easy.toml", easy.replace("student = \"s7\"\n", ""));
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("variant of nobody named: "), "{ran:?}");
    assert!(ran.stdout.contains("out = 0.5"), "{ran:?}");
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
        ("format = 1", "format = 2", (1, 10), "format 2 is not known"),
        (
            "format = 1",
            "format = 1\nstudent = \"\"",
            (2, 11),
            "\"\" is no student id",
        ),
    ] {
        let source = Source::new("variant.toml", good.replacen(from, to, 1));
        let loaded = Variant::parse(source)
            .map_err(Into::into)
            .and_then(|variant| Lab::load_variant(files, "93-touch", Some(&variant)));
        match loaded {
            Err(kinemark_grader::lab::LoadError::Lab(error)) => {
                assert!(error.to_string().contains(message), "{error}");
                assert_eq!(error.line_and_column(), at, "{error}");
            }
            other => panic!("{to}: {other:?}"),
        }
    }
}

#[test]
fn mistakes_in_a_lab_with_parameters_are_told_at_their_place() {
    for (from, to, code, message) in [
        (
            "\"= lengths[0]\"",
            "\"= length[0]\"",
            "lab::expression",
            "did you mean `lengths`?",
        ),
        (
            "link_lengths =",
            "link_length =",
            "lab::dimensions",
            "did you mean `link_lengths`?",
        ),
        (
            "link_lengths = [\"= lengths[0]\", ",
            "link_lengths = [",
            "lab::dimensions",
            "a list of 2",
        ),
        ("can_at =", "cat_at =", "lab::dimensions", "cat_at"),
        (
            "\"shelf-and-can\"",
            "\"shelf-and-cat\"",
            "lab::unknown_scene",
            "did you mean `shelf-and-can`?",
        ),
        (
            "step = 0.01 }\n",
            "step = 0.03 }\n",
            "lab::variants",
            "not a whole number of steps",
        ),
        (
            "out = { from",
            "lengths = { from",
            "lab::toml",
            "is there twice",
        ),
        (
            "[variants]\nout",
            "[variants]\nouf",
            "lab::variants",
            "did you mean `out`?",
        ),
        (
            "out = { from = 0.85",
            "out = { from = \"= out - 0.05\"",
            "lab::variants",
            "holds numbers, not expressions",
        ),
        (
            "goals = [{",
            "target = 1.0\ngoals = [{",
            "lab::target",
            "a task with goals has no target",
        ),
        (
            "lengths = [{ from = 0.95, to = 1.05, step = 0.01 }, ",
            "lengths = [",
            "lab::variants",
            "a list of 2",
        ),
        (
            "points = 3.0",
            "points = \"= out - 1\"",
            "lab::points",
            "got -0.09",
        ),
    ] {
        let bed = bed();
        assert!(LAB.contains(from), "{from}");
        bed.write("labs/93-touch/lab.toml", LAB.replacen(from, to, 1));
        let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains(code), "{to}: {shown}");
        assert!(shown.contains(message), "{to}: {shown}");
        assert!(shown.contains("93-touch/lab.toml:"), "{to}: {shown}");
    }
}

#[test]
fn mistakes_in_hidden_runs_are_told_at_their_place() {
    for (from, to, message) in [
        (
            "parameters = { out",
            "parameters = { ouf",
            "did you mean `out`?",
        ),
        ("count = 2", "count = 0", "1 to 20 hidden runs"),
        ("task = \"touch\"", "task = \"fk\"", "is no motion task"),
        ("[0.6, 0.75]", "[[0.6, 0.75]]", "do not fit its shape"),
        (
            "out = [0.6, 0.75]",
            "lengths = [[-1, -1], [1, 1]]",
            "must be positive",
        ),
        ("[0.6, 0.75]", "[0.75, 0.6]", "write [0.6, 0.75]"),
        (
            "out = [0.6, 0.75]",
            "lengths = [[0.9, 1.0], [1.0, 0.9]]",
            "`lengths` goes from 1 down to 0.9",
        ),
        ("{ out = [0.6, 0.75] }", "{}", "is the visible run again"),
        ("\"nearer places\"", "\" \"", "the class is empty"),
        ("\"other bends\"", "\"\"", "the class is empty"),
        (
            "q_rad = [[-3.0, 3.0]",
            "q_rad = [[3.0, -3.0]",
            "`q_rad` goes from 3 down to -3",
        ),
        (
            "[[runs]]",
            "dimensions = { link_lengths = [[1.0, 0.9], [1, 1]] }\n[[runs]]",
            "`link_lengths` goes from 1 down to 0.9",
        ),
        ("\"sea\"", "\"\"", "staff::salt"),
    ] {
        let bed = bed();
        assert!(HIDDEN.contains(from), "{from}");
        bed.write(
            "reference/93-touch/hidden.toml",
            HIDDEN.replacen(from, to, 1),
        );
        let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains(message), "{to}: {shown}");
        assert!(shown.contains("93-touch/hidden.toml:"), "{to}: {shown}");
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
fn numbers_written_down_are_lost_in_hidden_runs_and_no_number_is_told() {
    let bed = bed();
    let full = graded(&bed, SOLUTION);
    assert_eq!(full.verdict, Verdict::Passed, "{}", text(&full));
    assert_eq!(full.tasks[1].hidden[0].good, 2);

    let fixed = SOLUTION.replace("let out = observation.target[0][1];", "let out = 0.9;");
    let fixed = graded(&bed, &fixed);
    let touch = &fixed.tasks[1];
    // one of three runs is right; in the others the place is 150 mm and more from the one written down
    assert_eq!(touch.points, 1.0, "{}", text(&fixed));
    assert_eq!(touch.verdict, Verdict::Missed);
    let told = text(&fixed);
    assert!(
        told.contains("in 2 of 2 hidden runs of the class \"nearer places\" points are lost"),
        "{told}"
    );
    assert!(told.contains("hidden runs: nearer places 0/2"), "{told}");
    assert!(told.contains("run with other numbers, too"), "{told}");
    assert_ne!(touch.digests.all, full.tasks[1].digests.all);
    assert_eq!(
        touch.digests.seconds.len(),
        full.tasks[1].digests.seconds.len()
    );
    // without the staff's part there are none
    let practice = grade(&base(&bed), None, "mine.rhai", SOLUTION).grade;
    assert_eq!(practice.tasks[1].hidden, []);

    // what it says and throws there is kept for itself
    let leaks = SOLUTION.replace(
        "let out = observation.target[0][1];",
        "let out = observation.target[0][1]; if out < 0.8 { print(`secret ${out}`); throw `secret ${out}`; }",
    );
    let leaks = graded(&bed, &leaks);
    let touch = &leaks.tasks[1];
    assert_eq!(touch.verdict, Verdict::Crashed);
    assert_eq!(touch.points, 1.0);
    let stopped = touch.stopped.as_ref().expect("stopped");
    assert_eq!(stopped.message, "the submission failed in a hidden run");
    assert_eq!(stopped.case.as_deref(), Some("nearer places"));
    assert_eq!(stopped.tick, None);
    let json = serde_json::to_string(&leaks).expect("JSON");
    assert!(!json.contains("secret 0"), "{json}");
    // in a report neither
    bed.write("leaks.rhai", SOLUTION);
    assert_eq!(bed.run(&["grade", "93-touch", "leaks.rhai"]).code, Some(0));
    let lab = base(&bed);
    let staff = Staff::load(&places(&bed)[1], &lab, None)
        .expect("loads")
        .expect("staff");
    for run in staff.runs("touch") {
        let Some(kinemark_sim::robot::Dimension::Number(out)) = run.lab.parameters.get("out")
        else {
            panic!("no number");
        };
        let number = out.to_string();
        for (name, bytes) in files_below(&bed.path("out")) {
            let found = bytes
                .windows(number.len())
                .any(|window| window == number.as_bytes());
            assert!(!found, "{name} holds {number}");
        }
    }
}

#[test]
fn digests_of_hidden_parts_tell_nothing_without_the_salt() {
    let bed = bed();
    let lab = base(&bed);
    let practice = grade(&lab, None, "mine.rhai", SOLUTION).grade;
    // answers that depend on no number, so that only the key can make a difference
    let blind = "fn forward_kinematics(robot, q) { [1.0, 0.0, 0.0] }\nfn control(o) { [0.0, 0.0] }";
    let of = |salt: &str| {
        let staff = Staff::load(&places(&bed)[1], &lab, Some(salt)).expect("loads");
        grade(&lab, staff.as_ref(), "blind.rhai", blind).grade
    };
    let (sea, lake) = (of("sea"), of("lake"));
    for (task, (sea, lake)) in sea.tasks.iter().zip(&lake.tasks).enumerate() {
        assert_ne!(sea.digests.all, lake.digests.all, "task {task}");
        assert_eq!(sea.digests.seconds, lake.digests.seconds, "task {task}");
    }
    assert_eq!(of("sea"), sea);

    // a task with nothing hidden keeps its digest: anybody may hold it against their own
    let hidden = bed.path("reference/93-touch/hidden.toml");
    std::fs::write(hidden, HIDDEN.split("[[runs]]").next().expect("draws")).expect("written");
    let open = graded(&bed, SOLUTION);
    assert_ne!(open.tasks[0].digests, practice.tasks[0].digests);
    assert_eq!(open.tasks[1].digests, practice.tasks[1].digests);
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
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        let words = format!("`{name}` is a link to another file");
        assert!(ran.stderr.contains(&words), "{ran:?}");
        assert!(ran.stderr.contains("copy the file itself"), "{ran:?}");
        assert!(!ran.stderr.contains("salt"), "{ran:?}");
        assert!(!bed.path("out").exists(), "{ran:?}");
    };
    refused(&["grade", "93-touch", "alice/link.rhai"], "alice/link.rhai");
    bed.write("alice/mine.rhai", SOLUTION);
    let mine = ["grade", "93-touch", "alice/mine.rhai"];
    let beside = bed.path("alice/variant.toml");
    for target in [secret, bed.path("nowhere")] {
        symlink(target, &beside).expect("link");
        refused(&mine, "alice/variant.toml");
        std::fs::remove_file(&beside).expect("removed");
    }
    std::fs::create_dir(&beside).expect("folder");
    let ran = bed.run(&mine);
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
    bed.write("variant.toml", "format = 1\nlab = \"93-touch\"\n");
    let ran = bed.run(&[&args[..], &["--student", "s7"]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout
            .starts_with("using the variant of student s7; variant.toml is not used\n"),
        "{ran:?}"
    );
}

#[test]
fn a_motion_task_of_a_robot_without_masses_is_the_labs_mistake() {
    let bed = bed();
    let lab = LAB.replace("robot = \"rrbot\"\nframe = \"lab\"", "robot = \"rppr\"");
    let lab = lab.replace("link_lengths = [\"= lengths[0]\", \"= lengths[1]\"]\n", "");
    bed.write(
        "labs/93-touch/lab.toml",
        lab.replace("[0.5, \"= out\"]", "[0, 0, 0, 0]"),
    );
    let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains("lab::no_inertia"), "{shown}");
    assert!(shown.contains("joint `gripper_turn`"), "{shown}");
    assert!(shown.contains("robot `rppr`"), "{shown}");
    assert!(shown.contains("lab.toml:5:9"), "{shown}");
}

#[test]
fn lab_check_looks_at_the_brief_and_names_the_student_whose_lab_is_none() {
    let bed = bed();
    let check = |students: &str| {
        let ran = bed.run(&[
            "lab",
            "check",
            "93-touch",
            "--salts",
            "0",
            "--variants",
            students,
        ]);
        // this lab has no known mistakes, which is a problem of its own
        assert_eq!(ran.code, Some(1), "{ran:?}");
        ran.stdout
    };
    let told = check("0");
    assert!(told.contains("can be handed out"), "{told}");
    for (brief, problem) in [
        (
            BRIEF.replace("= out -->", "= ouf -->"),
            "line 3: no parameter is called `ouf`",
        ),
        (
            BRIEF.replace("<!-- grading: end -->", ""),
            "has no place for the table of points",
        ),
    ] {
        bed.write("labs/93-touch/brief.md", brief);
        let told = check("0");
        assert!(told.contains(problem), "{told}");
    }
    std::fs::remove_file(bed.path("labs/93-touch/brief.md")).expect("removed");
    let told = check("0");
    assert!(told.contains("there is no brief.md"), "{told}");

    bed.edit(
        "labs/93-touch/lab.toml",
        "out = { from = 0.85, to = 0.95, step = 0.01 }",
        "out = { from = -0.5, to = 0.5, step = 1.0 }",
    );
    bed.edit(
        "labs/93-touch/lab.toml",
        "points = 3.0",
        "points = \"= out\"",
    );
    let told = check("6");
    assert!(told.contains("such as that of `student "), "{told}");
    assert!(told.contains("it cannot be loaded (lengths = ["), "{told}");
    assert!(told.contains("out = -0.5): "), "{told}");
}
