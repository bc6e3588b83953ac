//! Hostile submissions: each ends with its verdict within its budgets, and the points of other tasks are kept.

use crate::every_case::every_case;
use crate::testbed::TestBed;

/// The body of `forward_kinematics`, and the budget that must stop it.
const HOSTILE: [(&str, &str, &str); 8] = [
    ("a loop without end", "loop {}", "operations in one call"),
    (
        "a list without end",
        "let a = []; loop { a.push(1.0); }",
        "",
    ),
    ("a list of lists", "let a = [1.0]; loop { a = [a, a]; }", ""),
    (
        "a string without end",
        "let s = \"x\"; loop { s += s; }",
        "a string of more than 4000 characters",
    ),
    (
        "recursion without end",
        "position_loop(given)",
        "nested function calls",
    ),
    (
        "printing without end",
        "loop { print(\"x\"); }",
        "operations in one call",
    ),
    ("plotting without end", "loop { plot(\"x\", 1.0); }", ""),
    (
        "a map without end",
        "let m = #{}; let i = 0; loop { m[i.to_string()] = i; i += 1; }",
        "",
    ),
];

#[test]
fn a_hostile_function_costs_its_own_task_alone() {
    let cases = HOSTILE.map(|(name, body, budget)| (name.to_owned(), (body, budget)));
    every_case(&cases, |(body, budget)| {
        let bed = TestBed::new();
        let submission = format!(
            "fn position_loop(given) {{ {body} }}\nfn control(observation) {{ [0.5, 0.0] }}\n"
        );
        bed.write("submission.rhai", submission);
        let ran = bed.run(&["grade", "00-step-response", "submission.rhai", "--json"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        let record: serde_json::Value = serde_json::from_str(&ran.stdout).expect("a record");
        let task = |name: &str| {
            let tasks = record["tasks"].as_array().expect("tasks");
            tasks
                .iter()
                .find(|task| task["name"] == name)
                .expect("task")
                .clone()
        };
        assert_eq!(task("warm-up")["points"], 1.0);
        let stopped = task("position-loop");
        assert_eq!(stopped["verdict"], "over-budget", "{stopped:#}");
        let message = stopped["stopped"]["message"].as_str().expect("message");
        assert!(message.contains(budget), "{message}");
        assert_eq!(stopped["stopped"]["line"], 1, "{stopped:#}");
    });
}

#[test]
fn a_crash_in_one_task_leaves_the_others_their_points() {
    let bed = TestBed::new();
    bed.write(
        "submission.rhai",
        "fn control(observation) {
    if observation.task == \"pid\" && observation.time > 1.0 {
        throw \"lost\";
    }
    [0.5, 0.0]
}
",
    );
    let ran = bed.run(&["grade", "00-step-response", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("1/1  passed"), "{ran:?}");
    assert!(ran.stdout.contains("(at 1.001 s, tick 1001)"), "{ran:?}");
    assert!(
        ran.stdout.contains("3 |         throw \"lost\";"),
        "{ran:?}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_writes_nothing_and_leaves_nothing() {
    use std::io::Read as _;
    let bed = TestBed::new();
    // every call as long as the budget allows: seconds in all
    bed.write(
        "submission.rhai",
        "fn control(observation) { for i in 0..8000 { let x = sin(i) * cos(i); } [0.5, 0.0] }",
    );
    let mut command = bed.command(&["grade", "01-kinematics", "submission.rhai"]);
    command
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped());
    let mut child = command.spawn().expect("runs");
    // its worker is there, started by one of its threads: the grade has begun
    let has_worker = |id: u32| {
        let tasks = std::fs::read_dir(format!("/proc/{id}/task"))
            .into_iter()
            .flatten();
        tasks.flatten().any(|task| {
            let children = std::fs::read_to_string(task.path().join("children"));
            children.is_ok_and(|list| !list.trim().is_empty())
        })
    };
    while !has_worker(child.id()) {
        assert_eq!(
            child.try_wait().expect("a child"),
            None,
            "it ended before it could be interrupted"
        );
        std::thread::yield_now();
    }
    let killed = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.expect("kill").success());
    let status = child.wait().expect("ends");
    let mut stderr = String::new();
    child
        .stderr
        .take()
        .expect("stderr")
        .read_to_string(&mut stderr)
        .expect("text");
    assert_eq!(status.code(), Some(130), "{stderr}");
    assert!(stderr.contains("interrupted"), "{stderr}");
    let left: Vec<_> = std::fs::read_dir(bed.path("")).expect("folder").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn hidden_cases_are_not_counted_out_by_operations() {
    let lab = crate::testbed::lab("01-kinematics");
    let staff = crate::testbed::staff(&lab, None);
    let submission = "fn forward_kinematics(robot, q) {
    let i = 0;
    while i < robot.base_height * 100 { i += 1; }
    [0.0, 0.0, 0.0]
}
";
    let fk = |staff| {
        let graded = crate::testbed::grade(&lab, staff, "submission.rhai", submission);
        graded
            .grade
            .tasks
            .into_iter()
            .find(|task| task.name == "fk")
            .expect("fk")
    };
    let (practice, graded) = (fk(None), fk(Some(&staff)));
    assert!(!graded.hidden.is_empty() && graded.operations > 1000);
    assert_eq!(practice.operations, graded.operations);
}

#[test]
fn hidden_cases_cannot_be_read_out_of_a_report() {
    let bed = TestBed::new();
    bed.copy_labs();
    // base_height is drawn anew in hidden cases: 2 and 1.6 in visible ones
    bed.write(
        "submission.rhai",
        "fn forward_kinematics(robot, q) {
    if robot.base_height == 1.6 {
        return [q[0], q[1], 0.0];
    }
    print(\"height\", robot.base_height);
    if robot.base_height != 2 {
        throw \"secret \" + robot.base_height;
    }
    [q[0], q[1], 0.0]
}
fn inverse_kinematics(robot, position) {
    if robot.base_height == 1.6 {
        return [0.0, 0.0];
    }
    print(\"height\", robot.base_height);
    if robot.base_height != 2 { [robot.base_height] } else { [0.0, 0.0] }
}
",
    );
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for (name, bytes) in crate::testbed::files_below(&bed.path("out")) {
        let text = String::from_utf8_lossy(&bytes);
        if name == "submission.rhai" {
            continue;
        }
        assert!(
            !text.contains("secret 1.") && !text.contains("secret 2."),
            "{name}"
        );
        for line in text.lines().filter(|line| line.contains("height ")) {
            assert!(
                !line.contains("height 1.") && !line.contains("height 2."),
                "{name}: {line}"
            );
        }
    }
}

/// Two courses that differ in their salt, and so in every number of their hidden cases.
fn two_courses(submission: &str) -> [serde_json::Value; 2] {
    let lab = crate::testbed::lab("01-kinematics");
    ["one", "another"].map(|salt| {
        let staff = crate::testbed::staff(&lab, Some(salt));
        let graded = crate::testbed::grade(&lab, Some(&staff), "submission.rhai", submission);
        let mut record = serde_json::to_value(&graded.grade).expect("a record");
        // these are keyed by the salt
        record["reference"] = serde_json::Value::Null;
        for task in record["tasks"].as_array_mut().expect("tasks") {
            task["digests"] = serde_json::Value::Null;
        }
        record
    })
}

#[test]
fn a_hidden_number_is_not_carried_out_in_the_last_digits() {
    // the arms of visible cases have posts of 2 and 1.6; every answer in a hidden case is a little off, by a hidden number, and still good
    let submission = "fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    let e = if robot.base_height == 2 || robot.base_height == 1.6 { 0 } else { 1e-5 * q[0] };
    [
        robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]) + e,
        l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]),
        2 * robot.link_offset
    ]
}
";
    let [one, other] = two_courses(submission);
    let task = &one["tasks"][0];
    assert_eq!(task["verdict"], "passed", "{task:#}");
    let value = task["checks"][0]["measure"]["value"].as_f64();
    assert!(value.is_some_and(|value| value < 1e-12), "{task:#}");
    assert_eq!(one, other);
}

#[test]
fn the_mean_of_scores_is_shown_for_visible_cases_alone() {
    // the answers in hidden cases are off by a hidden number, and earn a part of their points
    let submission = "fn inverse_kinematics(robot, position) {
    let l = robot.link_lengths;
    let u = position[0] - robot.base_height;
    let y = position[1];
    let c = (u * u + y * y - l[0] * l[0] - l[1] * l[1]) / (2 * l[0] * l[1]);
    if abs(c) > 1 + 1e-9 { return []; }
    let is_visible = robot.base_height == 2 || robot.base_height == 1.6;
    let e = if is_visible { 0 } else { 5e-3 + 1e-6 * y };
    let bend = acos(clamp(c, -1, 1)) + e;
    [branch(u, y, l, bend), branch(u, y, l, -bend)]
}
fn branch(u, y, l, bend) {
    [atan2(y, u) - atan2(l[1] * sin(bend), l[0] + l[1] * cos(bend)), bend]
}
";
    let [one, other] = two_courses(submission);
    let check = &one["tasks"][1]["checks"][0];
    let measure = &check["measure"];
    assert_eq!(measure["quantity"], "targets reached, visible cases");
    assert_eq!(measure["value"], 1.0, "{check:#}");
    assert_eq!(check["outcome"], "partial", "{check:#}");
    // all that another salt changes is points, in whole hundredths
    for record in [&one, &other] {
        let points = record["tasks"][1]["checks"][0]["points"].as_f64();
        let hundredths = points.expect("points") * 100.0;
        assert!(
            (hundredths - hundredths.round()).abs() < 1e-9,
            "{hundredths}"
        );
    }
    let differences = differences("", &one, &other);
    assert!(!differences.is_empty());
    for difference in &differences {
        assert!(difference.contains("/points: "), "{differences:#?}");
    }
}

/// A body of `forward_kinematics` that is right in visible cases, and the way by which it would carry out a number of a hidden one.
const LEAKS: [(&str, &str); 9] = [
    ("a message", "throw \"\" + q[0];"),
    (
        "a line that fails",
        "if q[0] > 0 {\nthrow 1\n}\nif q[1] > 0 {\nthrow 1\n}\nthrow 1;",
    ),
    (
        "output",
        "print(q[0]); plot(\"q\", q[0]); plot(\"x\" + q[0], 1); return [0, 0, 0];",
    ),
    (
        "operations",
        "let i = 0; while i < q[0] * 100 { i += 1; } return [0, 0, 0];",
    ),
    ("an answer", "return [q[0], q[1], 0];"),
    (
        "an answer of another shape",
        "let a = []; while len(a) < 10 + q[0] * 3 { a.push(q[0]); } return a;",
    ),
    ("an answer that is no list", "return \"\" + q[0];"),
    (
        "an answer that is no number",
        "return [q[0], 0.0 / 0.0, 0];",
    ),
    (
        "a mistake of the engine",
        "let m = #{}; m[\"k\" + q[0]] = 1; m.nosuch + [1][to_int(q[0] * 100)]",
    ),
];

/// What differs between two records, each with the path to it.
fn differences(path: &str, one: &serde_json::Value, other: &serde_json::Value) -> Vec<String> {
    use serde_json::Value::{Array, Object};
    match (one, other) {
        (Object(a), Object(b)) if a.keys().eq(b.keys()) => {
            let of = |(key, value)| differences(&format!("{path}/{key}"), value, &b[key]);
            a.iter().flat_map(of).collect()
        }
        (Array(a), Array(b)) if a.len() == b.len() => {
            let pairs = a.iter().zip(b).enumerate();
            let of = |(i, (a, b))| differences(&format!("{path}/{i}"), a, b);
            pairs.flat_map(of).collect()
        }
        _ if one == other => Vec::new(),
        _ => vec![format!("{path}: {one} is {other}")],
    }
}

#[test]
fn a_hidden_number_does_not_leave_by_any_way() {
    let cases = LEAKS.map(|(name, leak)| (name.to_owned(), leak));
    every_case(&cases, |leak| {
        let submission = format!(
            "fn forward_kinematics(robot, q) {{
    if robot.base_height != 2 && robot.base_height != 1.6 {{ {leak} }}
    let l = robot.link_lengths;
    this.n = (this.get(\"n\", 0)) + q[0];
    [
        robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]),
        l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]),
        2 * robot.link_offset * (if this.n == q[0] {{ 1 }} else {{ 0 }})
    ]
}}
"
        );
        let [one, other] = two_courses(&submission);
        let value = one["tasks"][0]["checks"][0]["measure"]["value"].as_f64();
        assert!(value.is_some_and(|value| value < 1e-12), "{one:#}");
        let differences = differences("", &one, &other);
        assert!(differences.is_empty(), "{differences:#?}");
    });
}

/// Work that the engine does in one operation, as much of it as a script can have, in functions of lab 1 and with what stands around them.
fn uncounted() -> Vec<(String, String)> {
    let many = format!(
        "[{},{}]",
        vec!["#{a:1}"; 250].join(","),
        vec!["[1]"; 370].join(",")
    );
    let letters = |other: &str| format!("a{other}").repeat(15_000);
    let lets: String = (0..3_600).map(|i| format!("let a{i}=this.a;")).collect();
    let of = |name: &str, source: String| (name.to_owned(), source);
    vec![
        of(
            "copies of all that is kept",
            format!(
                "fn init(robot, task) {{ this.a = {many}; }} fn control(o) {{ for i in 0..7900 {{ this; }} [0.5, 0.0] }}"
            ),
        ),
        of(
            "copies that are held in memory",
            format!(
                "fn init(robot, task) {{ this.a = {many}; }} fn control(o) {{ {lets} [0.5, 0.0] }}"
            ),
        ),
        of(
            "an unknown name beside a long known one",
            format!(
                "fn inverse_kinematics(robot, position) {{ let {} = 1; {} }}",
                letters("b"),
                letters("c")
            ),
        ),
        of(
            "an unknown function beside a long known one",
            format!(
                "fn {}() {{ }} fn forward_kinematics(robot, q) {{ {}() }}",
                letters("b"),
                letters("c")
            ),
        ),
    ]
}

#[test]
fn work_that_the_engine_does_not_count_ends_at_a_budget_and_not_at_a_limit_of_the_machine() {
    every_case(&uncounted(), |source| {
        let bed = TestBed::new();
        bed.write("submission.rhai", source);
        let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--json"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        let record: serde_json::Value = serde_json::from_str(&ran.stdout).expect("a record");
        let is_long_name = source.contains("abab");
        let expected = if is_long_name {
            "did-not-build"
        } else {
            "over-budget"
        };
        let tasks = record["tasks"].as_array().expect("tasks");
        let ended = tasks
            .iter()
            .filter(|task| task["verdict"] == expected)
            .count();
        assert!(ended > 0, "{record:#}");
    });
}
