//! Slips in a feedback law, as classes hand them in, through lab 0: what is seen of each, and what the student is asked.

use kinemark_grader::record::grade::TaskGrade;

use crate::testbed::{grade, lab};

/// The grade of a task of lab 0 under a law: the effort of `control`, with `e` the error of both joints, `o` and `t` the observation
/// and its target.
fn task_under(task: &str, law: &str) -> TaskGrade {
    let source = format!(
        "fn init(robot, task) {{ this.robot = robot; this.sum = [0.0, 0.0]; }}
fn control(o) {{
    let t = o.target;
    let e = if o.task == \"speed\" {{ [0.0, t.elbow_rad_s] - o.qd }} else {{ [0.0, t.elbow_rad] - o.q }};
    this.sum += e * o.dt;
    {law}
}}"
    );
    let graded = grade(&lab("00-step-response"), None, "mine.rhai", &source).grade;
    let mut tasks = graded.tasks.into_iter();
    tasks.find(|known| known.name == task).expect("the task")
}

/// What a check says and asks, in one text.
fn said(task: &TaskGrade, check: &str) -> String {
    let mut checks = task.checks.iter();
    let check = checks.find(|known| known.name == check).expect("the check");
    let messages = check.evidence.iter().map(|fact| fact.message.as_str());
    let next_step = check.next_step.as_deref().unwrap_or_default();
    messages.chain([next_step]).collect::<Vec<_>>().join(" | ")
}

#[test]
fn the_cause_is_named_and_no_other() {
    for (task, law, check, seen, not) in [
        // the brake pushes
        (
            "pid",
            "t.kp * e + t.kd * o.qd",
            "arrives",
            "swings back and forth across its target and",
            "Come to rest sooner",
        ),
        // the error turned round
        (
            "pid",
            "-(t.kp * e) - t.kd * o.qd",
            "arrives",
            "moves away from its target at once",
            "to its target first",
        ),
        (
            "speed",
            "-(t.kp * e)",
            "turns",
            "moves away from its target at once",
            "stronger derivative",
        ),
        // two joints swapped
        (
            "pid",
            "t.kp * ([t.elbow_rad, 0.0] - o.q) - t.kd * o.qd",
            "arrives",
            "joint `shoulder` is at",
            "to its target first",
        ),
        // gravity with the wrong sign
        (
            "hold",
            "t.kp * e - t.kd * o.qd - this.robot.gravity(o.q)",
            "elbow",
            "as a proportional gain of",
            "far side of the target",
        ),
        // nothing brakes
        (
            "hold",
            "t.kp * e",
            "elbow",
            "it swings between",
            "removed too slowly",
        ),
    ] {
        let graded = task_under(task, law);
        let said = said(&graded, check);
        assert!(said.contains(seen), "{task}, {law}: {said}");
        assert!(!said.contains(not), "{task}, {law}: {said}");
    }
}
