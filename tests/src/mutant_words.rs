//! What a mutant says: the same in every task, or in the words that it has for each.

use crate::own_lab::OwnLab;
use crate::testbed::grade;

const LAB: &str = r#"
format = 1
name = "96-words"
title = "Words"
robot = "RzTx"

[[tasks]]
name = "fk"
title = "Where it is"
function = { call = "forward_kinematics", cases = [{ name = "a", q_rad = [0.3, 0.2] }, { name = "b", q_rad = [1.3, 0.4] }, { name = "c", q_rad = [2.3, 0.1] }] }
checks = [{ name = "c", title = "C", points = 1.0, fk-error = { full_m = 0.01, zero_m = 0.02 } }]

[[tasks]]
name = "rates"
title = "How it moves"
function = { call = "velocity", rows = ["x", "y"], cases = [{ name = "a", q_rad = [0.3, 0.2], qd_rad_s = [1, 1] }, { name = "b", q_rad = [1.3, 0.4], qd_rad_s = [1, 2] }, { name = "c", q_rad = [2.3, 0.1], qd_rad_s = [2, 1] }] }
checks = [{ name = "c", title = "C", points = 1.0, function-cases = { full = 0.01, zero = 0.02 } }]
"#;

const SOLUTION: &str = "fn forward_kinematics(robot, q) { [q[1] * cos(q[0]), q[1] * sin(q[0]), 2] }\n\
    fn velocity(robot, q, qd) { let c = cos(q[0]); let s = sin(q[0]); [qd[1] * c - q[1] * s * qd[0], qd[1] * s + q[1] * c * qd[0]] }\n";

const MUTANTS: &str = r#"
format = 1
[[mutants]]
name = "degrees"
tasks = ["fk", "rates"]
says = { fk = "The angle is in radians.", rates = "The rate is in radians per second." }
"#;

const HIDDEN: &str = "format = 1\nsalt = \"a salt of seventeen letters\"\n\
    [[draws]]\ntask = \"fk\"\nclass = \"others\"\ncount = 2\nq_rad = [[0.3, 3.0], [0.1, 0.4]]\n\
    [[draws]]\ntask = \"rates\"\nclass = \"others\"\ncount = 2\nq_rad = [[0.3, 3.0], [0.1, 0.4]]\nqd_rad_s = [[1, 2], [1, 2]]\n";

fn own_lab(mutants: &str) -> OwnLab {
    OwnLab::new("96-words", LAB)
        .and("hidden.toml", HIDDEN)
        .and("solution.rhai", SOLUTION)
        .and("mutants.toml", mutants)
        .and(
            "mutants/degrees.rhai",
            SOLUTION.replace("(q[0])", "(rad(q[0]))"),
        )
}

#[test]
fn a_mistake_is_said_in_the_words_of_each_task() {
    let own = own_lab(MUTANTS);
    let lab = own.lab();
    let staff = own.staff(&lab);
    let mine = SOLUTION.replace("(q[0])", "(rad(q[0]))");
    let graded = grade(&lab, staff.as_ref(), "mine.rhai", &mine).grade;
    let said: Vec<&str> = graded
        .tasks
        .iter()
        .flat_map(|task| task.diagnoses.iter().map(|found| found.says.as_str()))
        .collect();
    assert_eq!(
        said,
        [
            "The angle is in radians.",
            "The rate is in radians per second."
        ]
    );
}

#[test]
fn words_are_for_the_tasks_of_the_mutant() {
    for (from, to, expected) in [
        (
            ", rates = \"The rate is in radians per second.\"",
            "",
            "says nothing in task `rates`",
        ),
        (
            "rates = \"The",
            "rate = \"The",
            "says nothing in task `rates`",
        ),
        (
            "tasks = [\"fk\", \"rates\"]",
            "tasks = [\"fk\"]",
            "words for task `rates`, which is none of its tasks",
        ),
        ("\"The angle is in radians.\"", "\" \"", "says nothing"),
        ("says = {", "says = 3 #", "`says` is a text, or a table"),
    ] {
        let own = own_lab(&MUTANTS.replace(from, to));
        let lab = own.lab();
        let error = kinemark_grader::lab::Staff::load(&own, &lab, None).expect_err(to);
        assert!(error.to_string().contains(expected), "{to}: {error}");
    }
}
