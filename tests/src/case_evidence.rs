//! Evidence of function tasks: different mistakes come before more of the same one.

use crate::testbed::{grade, lab};

/// The messages of a check's evidence.
fn evidence(lab_name: &str, task: &str, check: &str, source: &str) -> Vec<String> {
    let graded = grade(&lab(lab_name), None, "mine.rhai", source).grade;
    let mut tasks = graded.tasks.iter();
    let task = tasks.find(|known| known.name == task).expect("the task");
    let mut checks = task.checks.iter();
    let check = checks.find(|known| known.name == check).expect("the check");
    let pieces = check.evidence.iter();
    pieces.map(|piece| piece.message.clone()).collect()
}

#[test]
fn each_wrong_entry_of_an_answer_is_named() {
    let wrong = "fn velocity_loop(given) { #{
        final_speed: given.kp / (given.damping + given.kp),
        time_constant: given.inertia / given.damping,
        largest_kp: 2 * given.inertia / given.period,
        largest_kd: 2 * given.inertia / given.period,
    } }";
    let found = evidence(
        "00-step-response",
        "velocity-loop",
        "speed-and-limits",
        wrong,
    );
    assert_eq!(found.len(), 3, "{found:#?}");
    // the worst of each entry, and one more of the one that is further off
    assert!(found[0].contains("largest_kd is"), "{found:#?}");
    assert!(found[1].contains("time_constant is"), "{found:#?}");
    assert!(found[2].contains("largest_kd is"), "{found:#?}");
}

#[test]
fn each_wrong_column_of_a_jacobian_is_named() {
    let wrong = |second: &str| {
        format!(
            "fn jacobian(robot, q) {{ let l = robot.link_lengths;
    let s12 = l[1] * sin(q[0] + q[1]); let c12 = l[1] * cos(q[0] + q[1]);
    [[l[0] * sin(q[0]), {second}], [l[0] * cos(q[0]), c12]] }}"
        )
    };
    let of = |source: &str| evidence("02-jacobian-velocity", "jacobian", "jacobian", source);
    let columns = |found: &[String]| -> Vec<bool> {
        let first = |message: &String| message.contains("column 1 (shoulder)");
        found.iter().map(first).collect()
    };
    let both = of(&wrong("s12"));
    assert_eq!(both.len(), 3, "{both:#?}");
    let seen = columns(&both);
    assert!(seen[0] != seen[1], "{both:#?}");
    // a right column is not named
    let one = of(&wrong("-s12"));
    assert_eq!(columns(&one), [true; 3], "{one:#?}");
}
