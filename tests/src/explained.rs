//! What the course staff see of hidden cases and runs is what was graded: counts and scores of the exposed draws make the grade.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock};

use kinemark_grader::judge::explain;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::explanation::{ExplainedAttempt, ExplainedTask, Explanation};
use kinemark_grader::record::grade::{HiddenClass, TaskGrade, TaskKind};
use kinemark_grader::record::quantity::whole_hundredths;
use kinemark_grader::submission::host::InProcess;
use kinemark_grader::task::entry::Entry;
use kinemark_report::explain_text::text;
use kinemark_report::html::{OVERVIEW_FILE, ViewerCode, explanation};
use kinemark_report::student_reply::paragraph;
use kinemark_sim::text::Source;
use kinemark_sim::text::number::trimmed;
use serde_json::Value as Json;

use crate::every_case::every_case;
use crate::exact::is_asked_for;
use crate::golden::are_current;
use crate::submissions::{all_submissions, forms, labs_with_staff, submission_in};
use crate::testbed::{lab as lab_of, root, staff};
use crate::variants::{SOLUTION, bed};

/// Every submission takes minutes; each of these fails in another way, in every lab.
const SAMPLE: [&str; 15] = [
    "00-step-response/printed-proportional",
    "00-step-response/time-in-milliseconds",
    "00-step-response/typed-in",
    "01-kinematics/crash-on-the-way",
    "01-kinematics/four-millimetres-off",
    "01-kinematics/nan-at-the-boundary",
    "01-kinematics/never-refuses",
    "01-kinematics/one-branch",
    "01-kinematics/syntax",
    "02-jacobian-velocity/as-printed",
    "02-jacobian-velocity/even-joints",
    "03-knock-with-position/typed-in",
    "04-knock-with-velocity/nan-at-the-corner",
    "04-knock-with-velocity/typed-in",
    // its hidden run is not accurate to the end
    "06-typed-robots/never-stops",
];

/// The sample, explained once for all tests that look at it.
fn sample() -> &'static BTreeMap<String, Explanation> {
    static SAMPLED: OnceLock<BTreeMap<String, Explanation>> = OnceLock::new();
    SAMPLED.get_or_init(|| {
        let labs = labs_with_staff();
        let mut cases = all_submissions(&labs);
        cases.retain(|(name, _)| SAMPLE.contains(&name.as_str()));
        assert_eq!(cases.len(), SAMPLE.len());
        let sampled = Mutex::new(BTreeMap::new());
        let cases: Vec<_> = cases
            .into_iter()
            .map(|(name, case)| (name.clone(), (name, case)))
            .collect();
        every_case(&cases, |(name, (lab, staff, folder))| {
            let (file, text) = submission_in(folder);
            let explained = explained(lab, staff, file, &text);
            let mut sampled = sampled.lock().expect("no test panics with it");
            sampled.insert(name.clone(), explained);
        });
        sampled.into_inner().expect("no test panics with it")
    })
}

#[test]
fn exposed_draws_make_the_grade() {
    let labs = labs_with_staff();
    let mut cases = all_submissions(&labs);
    if !is_asked_for("hidden cases and runs of every submission, exposed") {
        cases.retain(|(name, _)| SAMPLE.contains(&name.as_str()));
        assert_eq!(cases.len(), SAMPLE.len());
    }
    let cases: Vec<_> = cases
        .into_iter()
        .map(|(name, case)| (name.clone(), (name, case)))
        .collect();
    let forms = forms(&labs);
    every_case(&cases, |(name, (lab, staff, folder))| {
        let (file, text) = submission_in(folder);
        let made;
        let explained = match sample().get(name) {
            Some(explained) => explained,
            None => {
                made = explained(lab, staff, file, &text);
                &made
            }
        };
        // what is known of the course staff's submissions makes no difference
        let graded = forms[lab.name.as_str()].graded(&Source::new(file, text.as_str()).into());
        let graded = graded.expect("not interrupted");
        assert_eq!(explained.graded.grade, graded);
        for record in graded.tasks.iter().filter(|task| !task.hidden.is_empty()) {
            let mut tasks = explained.tasks.iter();
            let task = tasks.find(|task| task.name == record.name);
            makes_the_grade(task.expect("the task"), record);
        }
    });
}

fn explained(lab: &Lab, staff: &Staff, file: &str, text: &str) -> Explanation {
    let submission = Source::new(file, text);
    explain(lab, staff, &submission.into(), &mut InProcess).expect("not interrupted")
}

/// The exposed draws give the counts of the classes, and with the visible run the points of every check.
fn makes_the_grade(task: &ExplainedTask, record: &TaskGrade) {
    let name = &task.name;
    assert!(task.counts, "{name}");
    assert_eq!(classes(task), record.hidden, "{name}");
    for (i, check) in record.checks.iter().enumerate() {
        let points = match task.kind {
            // all cases are judged together, in the exposed lab as in the grade
            TaskKind::Function => {
                let [attempt] = task.attempts.as_slice() else {
                    panic!("{} attempts", task.attempts.len());
                };
                attempt.graded.grade.tasks[0].checks[i].points
            }
            TaskKind::Motion => {
                let draws = task.attempts.iter().flat_map(|attempt| &attempt.draws);
                let counted = draws.map(|draw| draw.checks[i].counted.expect("counted"));
                let sum = task.scores[i] + counted.sum::<f64>();
                let score = sum / (task.attempts.len() + 1) as f64;
                whole_hundredths(check.max_points * score, check.max_points)
            }
        };
        assert_eq!(points, check.points, "{name}/{}", check.name);
    }
}

/// Draws counted by class, in the order of the first of each.
fn classes(task: &ExplainedTask) -> Vec<HiddenClass> {
    let unresolved = |class: &str| {
        let mut attempts: Vec<&ExplainedAttempt> = task.attempts.iter().collect();
        attempts.retain(|attempt| attempt.draws.iter().any(|draw| draw.draw.class == class));
        let records = attempts
            .iter()
            .map(|attempt| &attempt.graded.grade.tasks[0]);
        records
            .filter(|record| record.first_unresolved().is_some())
            .count() as u32
    };
    let classes = task.classes().into_iter();
    let count = classes.map(|(class, draws)| HiddenClass {
        class: class.to_owned(),
        good: draws.iter().filter(|draw| draw.good).count() as u32,
        total: draws.len() as u32,
        under_resolved: unresolved(class),
    });
    count.collect()
}

/// A text without its colours.
fn plain(text: &str) -> String {
    let mut parts = text.split("\u{1b}[");
    let first = parts.next().unwrap_or_default().to_owned();
    let rest = parts.filter_map(|part| part.split_once('m'));
    rest.fold(first, |plain, (_, text)| plain + text)
}

fn explained_submission(lab: &Lab, staff: &Staff, name: &str) -> Explanation {
    let path = root().join("tests/submissions").join(&lab.name).join(name);
    let (file, text) = submission_in(&path);
    explained(lab, staff, file, &text)
}

#[test]
fn an_explanation_reads_like_this() {
    let texts = [
        ("01-kinematics", "two-mistakes"),
        ("04-knock-with-velocity", "typed-in"),
    ];
    let texts = texts.map(|(name, submission)| {
        let lab = lab_of(name);
        let staff = staff(&lab, None);
        let explained = explained_submission(&lab, &staff, submission);
        let file = format!("tests/golden/text/explained-{name}.txt");
        let reply = paragraph(&explained);
        (
            root().join(file),
            format!("{}\n{reply}\n", plain(&text(&explained))),
        )
    });
    are_current(&texts);
}

#[test]
fn a_paragraph_for_a_student_has_no_hidden_number() {
    let cases: Vec<_> = sample()
        .iter()
        .map(|(name, it)| (name.clone(), it))
        .collect();
    every_case(&cases, |explained| {
        let reply = paragraph(explained);
        let draws = explained.draws();
        let numbers = draws.flat_map(|explained| {
            let numbers = explained.draw.numbers.iter();
            numbers.flat_map(|(_, value)| Entry::from(value.clone()).numbers())
        });
        let numbers: Vec<f64> = numbers.collect();
        assert!(!numbers.is_empty());
        for number in numbers {
            // fewer digits are those of points and counts
            for decimals in 3..7 {
                let written = trimmed(number, decimals);
                let found = written.len() > 4 && reply.contains(&written);
                assert!(!found, "{written} in {reply}");
            }
        }
        let is_no_program = reply.contains("Nothing of it could be run");
        let has_losses = is_no_program || reply.contains("In ") && reply.contains("hidden");
        let lost = explained.tasks.iter().any(|task| {
            let mut draws = task.attempts.iter().flat_map(|attempt| &attempt.draws);
            task.counts && draws.any(|draw| !draw.good)
        });
        assert!(has_losses || !lost, "{reply}");
    });
}

#[test]
fn the_pages_of_an_explanation_say_whom_they_are_for() {
    let lab = lab_of("01-kinematics");
    let staff = staff(&lab, None);
    let explained = explained_submission(&lab, &staff, "two-mistakes");
    let pages = explanation(&explained, ViewerCode::Inside);
    let names: Vec<&str> = pages.iter().map(|page| page.file_name.as_str()).collect();
    let expected = ["hidden-fk.html", "hidden-ik.html", "hidden-move-1.html"];
    assert_eq!(names[0], OVERVIEW_FILE);
    assert_eq!(names[1..], expected);
    for page in &pages {
        assert!(
            page.html.contains("For course staff only"),
            "{}",
            page.file_name
        );
    }
    for name in expected {
        assert!(
            pages[0].html.contains(&format!("href=\"{name}\"")),
            "{name}"
        );
    }
    // the run has its replay, with the reference solution beside it
    let run = &pages[3].html;
    assert!(run.contains("data-task=\"move\""));
    assert!(
        explained.tasks[2].attempts[0].graded.runs[0]
            .reference_overlay
            .is_some()
    );
    assert_eq!(explanation(&explained, ViewerCode::Inside), pages);
}

#[test]
fn hidden_cases_and_runs_are_listed_with_their_numbers() {
    let bed = bed();
    let ran = bed.run(&["lab", "draws", "93-touch"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for words in [
        "hidden cases of the class \"other bends\"",
        "q = [",
        "expected [",
        "hidden runs of the class \"nearer places\"",
        "out = 0.",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }
    let draws = |args: &[&str]| {
        let ran = bed.run(&[&["lab", "draws", "93-touch", "--json"], args].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
        let json: Json = serde_json::from_str(&ran.stdout).expect("JSON");
        json["draws"].as_array().expect("draws").clone()
    };
    let own = draws(&[]);
    assert_eq!(own.len(), 5);
    assert_eq!(own[4]["class"], "nearer places");
    assert_eq!(own[4]["number"], 2);
    let out = own[4]["numbers"]["out"].as_f64().expect("a number");
    assert!((0.6..=0.75).contains(&out), "{out}");
    assert_eq!(draws(&["--task", "touch"]), own[3..]);
    // they are those of the salt, and of a student's variant
    assert_ne!(draws(&["--salt", "lake"]), own);
    let of_student = draws(&["--student", "s1"]);
    assert_eq!(of_student[0]["numbers"], own[0]["numbers"]);
    assert_ne!(of_student[0]["expected"], own[0]["expected"]);
    for (args, message) in [
        (&["--task", "tuch"][..], "no task `tuch`"),
        (&["--student", " s1"], "begins or ends with a space"),
        (&["--reference", "nowhere"], "`nowhere` is not a directory"),
    ] {
        let ran = bed.run(&[&["lab", "draws", "93-touch"], args].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains(message), "{ran:?}");
    }
}

#[test]
fn lab_check_names_the_draw_in_which_points_are_lost() {
    let bed = bed();
    let typed_in = SOLUTION.replace("let out = observation.target[0][1];", "let out = 0.9;");
    bed.write("reference/93-touch/solution.rhai", &typed_in);
    let ran = bed.run(&[
        "lab",
        "check",
        "93-touch",
        "--variants",
        "3",
        "--salts",
        "0",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for words in [
        "task `touch` loses points: The tip is there\n      in run 1 of the class \"nearer places\", out = 0.",
        "(all points up to 20.0 mm, none from 0.100 m)",
        "in run 2 of the class \"nearer places\", out = 0.",
        "such as that of `student ",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {}", ran.stdout);
    }
    let ran = bed.run(&[
        "lab",
        "check",
        "93-touch",
        "--variants",
        "0",
        "--salts",
        "0",
        "--json",
    ]);
    let json: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let mut rows = json["rows"].as_array().expect("rows").iter();
    let row = rows.find(|row| row["tried"] == "reference").expect("a row");
    let hidden = row["hidden"].as_array().expect("hidden");
    assert_eq!(hidden.len(), 2);
    assert_eq!(hidden[1]["number"], 2);
    assert_eq!(hidden[1]["check"], "there");
    assert!(hidden[1]["measure"]["value"].as_f64() > Some(0.1), "{row}");

    // a stop in a hidden run has its line
    let crashes = SOLUTION.replace(
        "let out = observation.target[0][1];",
        "let out = observation.target[0][1]; if out < 0.8 { throw \"too near\"; }",
    );
    bed.write("reference/93-touch/solution.rhai", &crashes);
    let ran = bed.run(&[
        "lab",
        "check",
        "93-touch",
        "--variants",
        "0",
        "--salts",
        "0",
    ]);
    for words in ["in run 1 of the class", "too near", "solution.rhai:15:"] {
        assert!(ran.stdout.contains(words), "{words}: {}", ran.stdout);
    }
}

/// What stops a submission is what staff and student read, and never that an answer is off.
#[test]
fn a_stop_is_explained_as_what_it_is() {
    let lab = lab_of("01-kinematics");
    let staff = staff(&lab, None);
    let of = |text: &str| {
        let explained = explained(&lab, &staff, "submission.rhai", text);
        (plain(&self::text(&explained)), paragraph(&explained))
    };
    let (for_staff, reply) = of("fn forward_kinematics(r, q) { [1, 2 }");
    assert!(reply.contains("Nothing of it could be run: a `]` or a `,` is missing before this (line 1: \"fn forward_kinematics"), "{reply}");
    assert_eq!(
        for_staff.matches("is missing before this").count(),
        1,
        "{for_staff}"
    );
    let (for_staff, reply) =
        of("fn control(o) { [0.0, 0.0] }\nfn forward_kinematics(robot, q) { throw \"too late\" }");
    for words in [
        "In the task \"Forward kinematics\", your code fails in the case \"straight up\": the script threw: too late (line 2: \"fn forward_kinematics(robot, q) { throw \"too late\" }\").",
        "hidden cases of the class \"a longer forearm\" and 10 of 10 hidden cases of the class \"a longer upper arm, another post\", your function gives no answer that can be compared.",
        "The task \"Inverse kinematics\" earns no point, because the submission has no function `inverse_kinematics(robot, position)`.",
        "write fn inverse_kinematics(robot, position) { ... }.",
    ] {
        assert!(reply.contains(words), "{words}\n{reply}");
    }
    assert!(!reply.contains("off by more"), "{reply}");
    assert!(
        !reply.contains("out of reach"),
        "no case was called: {reply}"
    );
    for words in [
        "  stopped: the script threw: too late (case \"straight up\")\n  line 2: fn forward_kinematics",
        "  stopped: the submission has no function `inverse_kinematics(robot, position)`",
    ] {
        assert!(for_staff.contains(words), "{words}\n{for_staff}");
    }
    let without_cases = for_staff
        .split("\nik ")
        .nth(1)
        .and_then(|rest| rest.split("\nmove ").next());
    assert!(
        !without_cases.expect("the task").contains("case 1"),
        "{for_staff}"
    );
    // a next step without a full stop gets one
    let nan = explained_submission(&lab, &staff, "nan-at-the-boundary");
    let reply = paragraph(&nan);
    assert!(
        reply.contains("infinity from a division by zero. The name of a class"),
        "{reply}"
    );
}
