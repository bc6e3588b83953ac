//! A task of a function that the lab names itself: what earns its points, what its evidence says, and which labs are refused.

use kinemark_grader::record::grade::{Grade, Outcome, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::OwnLab;
use crate::testbed::grade;

const LAB: &str = r#"
format = 1
name = "95-loop"
title = "A loop and its response"
robot = "rrbot"

[[tasks]]
name = "second-order"
title = "Frequency and damping"

[tasks.function]
call = "second_order"
cases = [
    { name = "stiff", given = { inertia = 0.25, kp = 100, damping = [0.7, 1.3] }, expected = { natural_frequency = 20, damping_ratio = 0.2 } },
    { name = "without damping", given = { inertia = 1, kp = 4, damping = [0, 0] }, expected = { natural_frequency = 2, damping_ratio = 0 } },
]

[[tasks.checks]]
name = "all"
title = "Both are right"
points = 4.0
function-cases = { full = 0.01, zero = 0.1 }

[[tasks.checks]]
name = "ratio"
title = "The damping ratio is right"
points = 1.0
function-cases = { full = 0.01, zero = 0.1, entry = "damping_ratio" }

[[tasks]]
name = "stiffness"
title = "A gain"

[tasks.function]
call = "stiffness"
cases = [
    { name = "two", given = { inertia = 1, frequency = 2 }, expected = 4 },
]

[[tasks.checks]]
name = "gain"
title = "The gain is right"
points = 1.0
function-cases = { full = 1e-6, zero = 1e-3 }
"#;

const HIDDEN: &str = r#"
format = 1
salt = "salt"

[[draws]]
task = "second-order"
class = "light links"
count = 8
given = { inertia = [0.05, 0.3], kp = [50, 200], damping = [[0.1, 1], [0.1, 1]] }

[[draws]]
task = "stiffness"
class = "others"
count = 3
given = { inertia = [0.05, 0.3], frequency = [1, 9] }
"#;

const MUTANTS: &str = r#"
format = 1

[[mutants]]
name = "hertz"
tasks = ["second-order"]
says = "The frequency is in hertz."
"#;

const SOLUTION: &str = "fn second_order(given) {
    let w = sqrt(given.kp / given.inertia);
    #{ natural_frequency: w, damping_ratio: sum(given.damping) / (2 * given.inertia * w), unasked: 1 }
}
fn stiffness(given) { given.inertia * given.frequency ** 2 }";

fn own_lab() -> OwnLab {
    let hertz = SOLUTION.replace("natural_frequency: w", "natural_frequency: w / (2 * pi)");
    OwnLab::new("95-loop", LAB)
        .and("hidden.toml", HIDDEN)
        .and("mutants.toml", MUTANTS)
        .and("solution.rhai", SOLUTION)
        .and("mutants/hertz.rhai", hertz)
}

fn graded(submission: &str) -> Grade {
    let own = own_lab();
    let lab = own.lab();
    let staff = own.staff(&lab);
    grade(&lab, staff.as_ref(), "mine.rhai", submission).grade
}

fn evidence(task: &TaskGrade) -> Vec<&str> {
    let evidence = task.checks[0].evidence.iter();
    evidence.map(|piece| piece.message.as_str()).collect()
}

#[test]
fn a_right_answer_earns_everything() {
    let grade = graded(SOLUTION);
    assert_eq!(grade.verdict, Verdict::Passed, "{}", text(&grade));
    assert_eq!(grade.points, 6.0);
    let task = &grade.tasks[0];
    assert_eq!(
        task.cases[0].given,
        "damping = [0.7, 1.3], inertia = 0.25, kp = 100"
    );
    let expected = "damping_ratio = 0.2, natural_frequency = 20";
    assert_eq!(task.cases[0].expected.as_deref(), Some(expected));
    assert_eq!(task.cases[0].answer, expected);
    assert_eq!((task.hidden[0].good, task.hidden[0].total), (8, 8));
    assert_eq!(grade.tasks[1].cases[0].answer, "4");
    assert_eq!(grade.tasks[1].hidden[0].good, 3);
}

#[test]
fn a_wrong_entry_is_reported_and_a_mutant_named() {
    let hertz = SOLUTION.replace("natural_frequency: w", "natural_frequency: w / 2 / pi");
    let grade = graded(&hertz);
    let task = &grade.tasks[0];
    assert_eq!(task.verdict, Verdict::Missed, "{}", text(&grade));
    // one of two entries in every case, and the other alone
    assert!((task.points - 3.0).abs() <= 1e-12, "{}", task.points);
    let mistakes: Vec<&str> = task.diagnoses.iter().map(|d| d.mistake.as_str()).collect();
    assert_eq!(mistakes, ["hertz"]);
    let evidence = evidence(task);
    assert_eq!(
        evidence,
        [
            "stiff: natural_frequency is 3.1831, should be 20 (84.1 % off)",
            "without damping: natural_frequency is 0.3183, should be 2 (84.1 % off)",
            "8 of 8 hidden cases of the class \"light links\" are off",
        ]
    );
    assert_eq!(task.checks[1].outcome, Outcome::Full);
}

#[test]
fn an_error_within_the_band_earns_a_part() {
    let off = SOLUTION.replace("natural_frequency: w", "natural_frequency: 1.055 * w");
    let grade = graded(&off);
    let check = &grade.tasks[0].checks[0];
    assert_eq!(check.outcome, Outcome::Partial, "{}", text(&grade));
    assert!(
        (check.points - 4.0 * 0.75).abs() <= 1e-9,
        "{}",
        check.points
    );
}

#[test]
fn what_is_no_such_map_is_reported_and_entries_count_for_themselves() {
    for (body, message, points) in [
        (
            "3",
            "second_order returned 3, expected entries named damping_ratio, natural_frequency",
            0.0,
        ),
        (
            "#{ natural_frequency: sqrt(given.kp / given.inertia) }",
            "second_order returned entries named natural_frequency, without `damping_ratio`",
            2.0,
        ),
        (
            "#{ natural_frequency: sqrt(given.kp / given.inertia), damping_ratio: 0 / 0 }",
            "second_order returned NaN as `damping_ratio`, expected finite numbers",
            2.0,
        ),
    ] {
        let grade = graded(&format!("fn second_order(given) {{ {body} }}"));
        let task = &grade.tasks[0];
        assert_eq!(task.verdict, Verdict::InvalidOutput, "{}", text(&grade));
        assert_eq!(task.stopped.as_ref().expect("why").message, message);
        assert_eq!(task.points, points, "{body}");
    }
    let grade = graded("fn second_ordre(given) { 1 }\nfn stiffness(g) { g.frequncy }");
    let stopped = |task: usize| grade.tasks[task].stopped.as_ref().expect("why");
    assert_eq!(
        stopped(0).help.as_deref(),
        Some("rename `second_ordre` to `second_order`")
    );
    assert_eq!(
        stopped(1).message,
        "`g` has no `frequncy`: did you mean `frequency`?"
    );
}

#[test]
fn a_worker_gives_the_same_grade_as_this_process() {
    let submission = SOLUTION.replace("natural_frequency: w", "natural_frequency: 1.055 * w");
    let theirs = own_lab().record(&submission, 1);
    let theirs: Grade = serde_json::from_value(theirs).expect("a grade");
    assert_eq!(theirs, graded(&submission));
}

#[test]
fn labs_that_ask_for_no_such_function_are_refused() {
    for (from, to, message) in [
        (
            r#"call = "second_order""#,
            r#"call = "secondOrder""#,
            "`secondOrder` cannot be the name of a function: it is not in lower snake case",
        ),
        (
            r#"call = "second_order""#,
            r#"call = "norm""#,
            "`norm` cannot be the name of a function: the language has something of this name",
        ),
        (
            r#"call = "second_order""#,
            r#"call = "control""#,
            "`control` cannot be the name of a function: it is called in motion tasks",
        ),
        (
            r#"call = "second_order""#,
            r#"call = "while""#,
            "`while` cannot be the name of a function: it is a word of the language",
        ),
        (
            r#"call = "second_order""#,
            "call = \"second_order\"\nrows = [\"x\"]",
            "`second_order` has no `rows`",
        ),
        (
            r#"call = "second_order""#,
            "call = \"second_order\"\ngrants = [\"fk\"]",
            "`second_order` is given no robot to ask",
        ),
        (
            ", expected = 4",
            ", q_rad = [0, 0]",
            "case `two` of `stiffness` is given by `given` and `expected`",
        ),
        (
            "inertia = 1, kp = 4,",
            "inertia = 1,",
            "case `without damping` does not give `kp`, the first case does",
        ),
        (
            "inertia = 1, kp = 4,",
            "mass = 1, kp = 4,",
            "case `without damping` gives `mass`, the first case gives `inertia`",
        ),
        (
            "natural_frequency = 2, damping_ratio = 0 }",
            "natural_frequency = 2, damping_ratio = 0, poles = 1 }",
            "case `without damping` expects `poles`, the first case does not",
        ),
        (
            "{ name = \"without damping\"",
            "{ name = \"stiff\"",
            "case `stiff` is defined twice",
        ),
        (
            r#"entry = "damping_ratio""#,
            r#"entry = "ratio""#,
            "no case expects an entry `ratio`",
        ),
        (
            "function-cases = { full = 1e-6, zero = 1e-3 }",
            "jacobian-match = { full = 1e-6, zero = 1e-3 }",
            "check `gain` of kind `jacobian-match` needs a function task of `jacobian`",
        ),
    ] {
        match own_lab().with("lab.toml", from, to).load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => assert_eq!(error.to_string(), message),
        }
    }
}

#[test]
fn draws_that_give_something_else_or_that_the_solution_cannot_answer_are_refused() {
    let hidden = "hidden.toml";
    for (path, from, to, message) in [
        (
            hidden,
            "frequency = [1, 9]",
            "speed = [1, 9]",
            "this draw gives inertia, speed, the visible cases give frequency, inertia",
        ),
        (
            hidden,
            "given = { inertia = [0.05, 0.3], frequency = [1, 9] }",
            "q_rad = [[0, 1], [0, 1]]",
            "a draw for `stiffness` is of `given`",
        ),
        (
            "solution.rhai",
            "given.frequency ** 2",
            "sqrt(-given.frequency)",
            "`stiffness` of the solution returned NaN, expected finite numbers",
        ),
    ] {
        let course = own_lab().with(path, from, to);
        let lab = course.lab();
        let loaded = kinemark_grader::lab::Staff::load(&course, &lab, None);
        let tried = loaded.and_then(|staff| {
            kinemark_grader::audit::staff_code(&lab, &staff.expect("a staff's part"))
        });
        match tried {
            Ok(()) => panic!("{to} is accepted"),
            Err(error) => assert_eq!(error.to_string(), message),
        }
    }
}
