//! Evidence of function tasks: different mistakes come before more of the same one, and an answer that is no number hides no other.

use kinemark_grader::record::grade::TaskGrade;

use crate::testbed::{grade, lab};

/// The grade of a task.
fn task_of(lab_name: &str, task: &str, source: &str) -> TaskGrade {
    let graded = grade(&lab(lab_name), None, "mine.rhai", source).grade;
    let mut tasks = graded.tasks.into_iter();
    tasks.find(|known| known.name == task).expect("the task")
}

/// The messages of a check's evidence.
fn evidence(lab_name: &str, task: &str, check: &str, source: &str) -> Vec<String> {
    let task = task_of(lab_name, task, source);
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

#[test]
fn an_answer_that_is_no_number_says_where_it_began_and_hides_no_other_advice() {
    let ik = |answer: &str| {
        let source = format!(
            "fn inverse_kinematics(robot, position) {{
    let l = robot.link_lengths;
    let u = position[0] - robot.base_height; let y = position[1];
    let c = (u * u + y * y - l[0] * l[0] - l[1] * l[1]) / (2 * l[0] * l[1]);
    let q2 = acos(c);
    let a = atan2(l[1] * sin(q2), l[0] + l[1] * cos(q2));
    {answer}
}}"
        );
        let task = task_of("01-kinematics", "ik", &source);
        let stopped = task
            .stopped
            .expect("no number where the target is out of reach");
        let origin = "line 5: `acos` takes a number from -1 to 1, got";
        assert!(stopped.message.contains(origin), "{}", stopped.message);
        let advised = task.checks.iter().map(|check| check.next_step.is_some());
        advised.collect::<Vec<bool>>()
    };
    // half the elbow's angle is right for links of one length only, and the other branch is missing
    assert_eq!(ik("[[atan2(y, u) - q2 / 2, q2]]"), [true; 3]);
    // where nothing else is wrong, the stop explains it
    let right = "[[atan2(y, u) - a, q2], [atan2(y, u) + a, -q2]]";
    assert_eq!(ik(right), [false; 3]);
}
