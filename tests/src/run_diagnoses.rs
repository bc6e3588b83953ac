//! Whole runs compared with mutants and the reference solution: the same mistake is named, a similar one is not, and the first difference
//! is reported at its tick. The lab is made for these tests, with six mutants, and `lab check` finds no problem in it.

use kinemark_grader::audit::Audit;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::{Grade, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;
use kinemark_sim::text::Source;

use crate::every_case::every_case;
use crate::testbed::{Folder, TestBed, grade};

const LAB: &str = r#"
format = 1
name = "90-sweep"
title = "Sweep"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "sweep"
title = "Two straight lines"

[tasks.motion]
mode = "velocity"
duration_s = 4.0
start_rad = [0.775397496610753, 1.5907976603682872]
servo = { kp = 20.0, ki = 50.0, gravity_compensation = true, effort_limit = [30.0, 15.0] }

[tasks.motion.paths]
lines = { points_m = [[2, 1.4, 0.05], [1.6, 1.4, 0.05], [1.6, 1.0, 0.05]], trim_m = 0.05 }

[[tasks.checks]]
name = "line"
title = "Along the lines"
points = 2.0
path-deviation = { path = "lines", full_m = 0.02, zero_m = 0.06 }

[[tasks.checks]]
name = "whole"
title = "All of them"
points = 1.0
path-coverage = { path = "lines", within_m = 0.03, full = 0.98, zero = 0.5 }

[[tasks.checks]]
name = "calm"
title = "Never fast"
points = 1.0
needs = ["line"]
tcp-speed = { at = "run", full_m_s = 0.6, zero_m_s = 1.0 }
"#;

/// Lines by way of three points, tracked with the Jacobian.
const SWEEP: &str = r#"
const VIA = [[2.0, 1.4], [1.6, 1.4], [1.6, 1.0]];
const SPEED = 0.25;

fn init(robot, task) {
    this.robot = robot;
    this.segment = 0;
    this.since = 0.0;
}

fn jacobian(robot, q) {
    let l = robot.link_lengths;
    let q12 = q[0] + q[1];
    matrix([[-l[0] * sin(q[0]) - l[1] * sin(q12), -l[1] * sin(q12)], [l[0] * cos(q[0]) + l[1] * cos(q12), l[1] * cos(q12)]])
}

fn control(observation) {
    let from = vector(VIA[this.segment]);
    let to = vector(VIA[this.segment + 1]);
    let length = norm(to - from);
    let along = (to - from) / length;
    let gone = SPEED * (observation.time - this.since);
    if gone >= length && this.segment == 0 {
        this.segment = 1;
        this.since = observation.time;
    }
    let p = vector([observation.tcp[0], observation.tcp[1]]);
    let wanted = from + along * min(gone, length);
    let v = (wanted - p) * 4.0;
    if gone < length {
        v = v + along * SPEED;
    }
    jacobian(this.robot, observation.q).solve(v)
}
"#;

const STARTER: &str = "fn control(observation) { [0.0, 0.0] }\n";

/// The text to change, and what a mutant has there.
const MUTANTS: [(&str, &str, &str); 6] = [
    ("half-speed", "const SPEED = 0.25;", "const SPEED = 0.125;"),
    (
        "absolute-elbow",
        "let q12 = q[0] + q[1];",
        "let q12 = q[1];",
    ),
    (
        "first-line-only",
        "if gone >= length && this.segment == 0 {",
        "if false {",
    ),
    (
        "corner-forgotten",
        "[[2.0, 1.4], [1.6, 1.4], [1.6, 1.0]]",
        "[[2.0, 1.4], [1.6, 1.0], [1.6, 1.0001]]",
    ),
    (
        "transposed",
        "jacobian(this.robot, observation.q).solve(v)",
        "jacobian(this.robot, observation.q).transpose() * v",
    ),
    (
        "sides-swapped",
        "const VIA = [[2.0, 1.4], [1.6, 1.4], [1.6, 1.0]];",
        "const VIA = [[2.0, 1.4], [2.0, 1.0], [1.6, 1.0]];",
    ),
];

fn changed(text: &str, changes: &[(&str, &str)]) -> String {
    let mut text = text.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

fn mutant(name: &str) -> (&'static str, &'static str) {
    let found = MUTANTS.iter().find(|mutant| mutant.0 == name);
    let (_, from, to) = found.expect("a mutant");
    (from, to)
}

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/90-sweep/lab.toml", LAB);
    bed.write("labs/90-sweep/starter.rhai", STARTER);
    bed.write(
        "labs/90-sweep/brief.md",
        "# Sweep\n\nWrite `control`.\n\n<!-- grading: begin -->\n<!-- grading: end -->\n",
    );
    bed.write(
        "reference/90-sweep/accepted.toml",
        "format = 1\n[[accepted]]\nrule = \"dead\"\nof = \"sweep/calm\"\nbecause = \"no mutant here saturates\"\n",
    );
    bed.write("reference/90-sweep/solution.rhai", SWEEP);
    let mut table = "format = 1\n".to_owned();
    for (name, from, to) in MUTANTS {
        let path = format!("reference/90-sweep/mutants/{name}.rhai");
        bed.write(&path, changed(SWEEP, &[(from, to)]));
        table += &format!(
            "[[mutants]]\nname = \"{name}\"\ntasks = [\"sweep\"]\nsays = \"This is {name}.\"\n"
        );
    }
    bed.write("reference/90-sweep/mutants.toml", table);
    bed
}

fn loaded(bed: &TestBed) -> (Lab, Staff) {
    let lab = Lab::load(&Folder(bed.path("labs")), "90-sweep").expect("a lab");
    let staff = Staff::load(&Folder(bed.path("reference")), &lab, None);
    (lab, staff.expect("sound").expect("there"))
}

fn sweep(lab: &Lab, staff: Option<&Staff>, text: &str) -> (TaskGrade, Grade) {
    let run = grade(lab, staff, "mine.rhai", text);
    assert_eq!(run.runs[0].divergence, run.grade.tasks[0].divergence);
    (run.grade.tasks[0].clone(), run.grade)
}

fn mistakes(task: &TaskGrade) -> Vec<&str> {
    task.diagnoses.iter().map(|d| d.mistake.as_str()).collect()
}

#[test]
fn the_same_mistake_in_other_words_is_named() {
    let (lab, staff) = loaded(&bed());
    // other gains, and 50 ms later, change a run by less than its mistake does
    let other_words = [
        [("* 4.0", "* 4.5"), ("this.since = 0.0", "this.since = 0")],
        [
            (
                "observation.time - this.since",
                "max(observation.time - this.since - 0.05, 0.0)",
            ),
            ("fn control(", "fn never() { }\nfn control("),
        ],
    ];
    let named = ["half-speed", "first-line-only", "corner-forgotten"];
    let each = named
        .iter()
        .flat_map(|name| other_words.map(|words| (*name, words)));
    let cases = each.map(|(name, words)| (format!("{name}, {words:?}"), (name, words)));
    every_case(&cases.collect::<Vec<_>>(), |(name, words)| {
        let text = changed(SWEEP, &[&words[..], &[mutant(name)]].concat());
        let (task, all) = sweep(&lab, Some(&staff), &text);
        assert_eq!(mistakes(&task), [*name], "{}", self::text(&all));
        let diagnosis = &task.diagnoses[0];
        assert!(
            diagnosis.telling >= 50 && 100 * diagnosis.agreeing >= 95 * diagnosis.telling,
            "{diagnosis:?}"
        );
        assert!(self::text(&all).contains("moments in which this mistake shows)"));
        // the diagnosis takes the place of the checks' own hints
        assert!(
            task.checks
                .iter()
                .all(|check| { check.next_step.is_none() || check.measure.is_none() })
        );
    });
}

#[test]
fn what_is_nearly_a_known_mistake_is_not_named() {
    let (lab, staff) = loaded(&bed());
    let slow = |speed| ("const SPEED = 0.25;", speed);
    let cases: [(&str, Vec<(&str, &str)>); 8] = [
        ("another speed", vec![slow("const SPEED = 0.14;")]),
        (
            "a little faster than half",
            vec![slow("const SPEED = 0.13;")],
        ),
        (
            "another path",
            vec![("[[2.0, 1.4], [1.6, 1.4],", "[[2.0, 1.4], [1.75, 1.25],")],
        ),
        (
            "a corner that is nearly forgotten",
            vec![("[[2.0, 1.4], [1.6, 1.4],", "[[2.0, 1.4], [1.79, 1.21],")],
        ),
        (
            "two mistakes: speed and line",
            vec![slow("const SPEED = 0.125;"), mutant("first-line-only")],
        ),
        (
            "two mistakes: elbow and speed",
            vec![slow("const SPEED = 0.3;"), mutant("absolute-elbow")],
        ),
        (
            "no mistake, and too late by more than anything explains",
            vec![(
                "observation.time - this.since",
                "max(observation.time - this.since - 0.8, 0.0)",
            )],
        ),
        (
            "nothing done",
            vec![(
                "fn control(observation) {",
                "fn control(observation) { return [0.0, 0.0];",
            )],
        ),
    ];
    let cases = cases.map(|(what, changes)| (what.to_owned(), changes));
    every_case(&cases, |changes| {
        let (task, all) = sweep(&lab, Some(&staff), &changed(SWEEP, changes));
        assert_eq!(task.verdict, Verdict::Missed, "{}", text(&all));
        assert_eq!(mistakes(&task), [""; 0], "{}", text(&all));
        assert!(task.divergence.is_some());
    });
}

#[test]
fn of_two_mutants_that_do_the_same_neither_is_named() {
    let bed = bed();
    bed.write(
        "reference/90-sweep/mutants/absolute-elbow.rhai",
        changed(SWEEP, &[mutant("half-speed")]),
    );
    let (lab, staff) = loaded(&bed);
    let (task, _) = sweep(&lab, Some(&staff), &changed(SWEEP, &[mutant("half-speed")]));
    assert_eq!(mistakes(&task), [""; 0]);
    let mut audit = Audit::new(&lab);
    audit.mutants(&lab, &staff);
    let bad: Vec<&str> = audit.problems().map(|row| row.name.as_str()).collect();
    assert_eq!(bad, ["half-speed", "absolute-elbow"]);
}

#[test]
fn the_first_difference_is_reported_where_points_are_lost() {
    let bed = bed();
    let (lab, staff) = loaded(&bed);
    let (task, _) = sweep(&lab, Some(&staff), SWEEP);
    assert_eq!((task.verdict, &task.divergence), (Verdict::Passed, &None));

    // the first line takes 0.4 m / 0.25 m/s = 1.6 s; a tip that stays there is 10 mm behind one that goes on some 0.04 s later
    let text_of = changed(SWEEP, &[mutant("first-line-only")]);
    let (task, all) = sweep(&lab, Some(&staff), &text_of);
    let differs = task.divergence.clone().expect("it differs");
    assert!((1600..1800).contains(&differs.tick), "{differs:?}");
    assert_eq!(differs.tick % 10, 0, "a control tick");
    assert_eq!(differs.time_s, differs.tick as f64 / 1000.0);
    assert!(differs.distance > differs.tolerance, "{differs:?}");
    assert_eq!(differs.signal, "tcp");
    let shown = text(&all);
    let line = format!("differs at {} s: the TCP is at", differs.time_s);
    assert!(anstream_free(&shown).contains(&line), "{shown}");

    // students have no solution, and without its path nothing is reported
    let (task, _) = sweep(&lab, None, &text_of);
    assert_eq!(task.divergence, None);
}

/// The text without its colours.
fn anstream_free(text: &str) -> String {
    let mut plain = String::new();
    let mut skips = false;
    for c in text.chars() {
        match (skips, c) {
            (false, '\u{1b}') => skips = true,
            (true, 'm') => skips = false,
            (true, _) => {}
            (false, c) => plain.push(c),
        }
    }
    plain
}

#[test]
fn students_see_where_their_path_differs() {
    let bed = bed();
    bed.write(
        "mine.rhai",
        "fn control(observation) { [0.3, 0.3] }\nfn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\nfn inverse_kinematics(robot, p) { [] }\n",
    );
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let record = std::fs::read_to_string(bed.path("out/grade.json")).expect("record");
    let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
    let tasks = record["tasks"].as_array().expect("tasks");
    let moving = tasks.iter().find(|task| task["name"] == "move");
    let differs = &moving.expect("a task")["divergence"];
    assert_eq!(differs["signal"], "tcp", "{record}");
    let report = std::fs::read_to_string(bed.path("out/report.html")).expect("report");
    assert!(report.contains("Compared with the reference solution"));
    assert!(report.contains("differs first from the reference"));
    let verified = bed.run(&["verify", "out"]);
    assert_eq!(verified.code, Some(0), "{verified:?}");
}

#[test]
fn a_crash_is_not_compared() {
    let (lab, staff) = loaded(&bed());
    let crash = changed(
        SWEEP,
        &[(
            "fn control(observation) {",
            "fn control(observation) { if observation.time > 2.0 { throw \"no\" }",
        )],
    );
    let half = changed(&crash, &[mutant("half-speed")]);
    let (task, _) = sweep(&lab, Some(&staff), &half);
    assert_eq!(task.verdict, Verdict::Crashed);
    assert_eq!((mistakes(&task), task.divergence.clone()), (vec![], None));
}

#[test]
fn lab_check_finds_nothing_wrong_or_says_what_is() {
    let bed = bed();
    let ran = bed.run(&["lab", "check", "90-sweep"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("nothing is wrong"), "{ran:?}");
    let ran = bed.run(&["lab", "check", "90-sweep", "--json"]);
    let record: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let rows = record["rows"].as_array().expect("rows");
    let of = |tried: &str| rows.iter().filter(|row| row["tried"] == tried).count();
    assert_eq!(
        (of("starter"), of("reference"), of("mutants"), of("mutant")),
        (1, 1, 1, 6)
    );

    // a mutant that is right, one that does not run, a solution that is wrong, a starter that is right
    bed.write("reference/90-sweep/mutants/half-speed.rhai", SWEEP);
    bed.write(
        "reference/90-sweep/mutants/transposed.rhai",
        "fn control(o) { o.x }\n",
    );
    bed.write("labs/90-sweep/starter.rhai", SWEEP);
    bed.edit(
        "reference/90-sweep/solution.rhai",
        "SPEED = 0.25",
        "SPEED = 0.1",
    );
    let ran = bed.run(&["lab", "check", "90-sweep"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for words in [
        "4 points for nothing done, and at most 0.4 may be",
        "task `sweep` loses points: Along the lines (",
        "loses no point",
        "crashed: ",
        " problems",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }

    for (args, code) in [
        (&["lab", "check", "90-sweeep"][..], 2),
        (&["lab", "check", "90-sweep", "--reference", "labs"], 2),
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(code), "{ran:?}");
    }
    bed.edit(
        "labs/90-sweep/lab.toml",
        "robot = \"rrbot\"",
        "robot = \"rr\"",
    );
    let ran = bed.run(&["lab", "check", "90-sweep"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
}

#[test]
fn a_lab_without_enough_mutants_is_reported() {
    let bed = bed();
    let (lab, staff) = loaded(&bed);
    let mut few = staff.clone();
    few.mutants.truncate(1);
    let mut audit = Audit::new(&lab);
    audit.mutants(&lab, &few);
    assert_eq!(audit.problems().count(), 1);
    audit.starter(&lab, &staff, &Source::new("starter.rhai", STARTER));
    assert_eq!(audit.problems().count(), 1);
}
