//! Hidden runs of a lab with variants: hard-coded numbers lose points there, and no output reveals the hidden numbers.

use kinemark_grader::lab::Staff;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::testbed::{files_below, grade};
use crate::variants::{HIDDEN, SOLUTION, base, bed, graded, places};

#[test]
fn numbers_written_down_are_lost_in_hidden_runs_and_no_number_is_shown() {
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
    let output = text(&fixed);
    assert!(
        output.contains("in 2 of 2 hidden runs of the class \"nearer places\" points are lost"),
        "{output}"
    );
    assert!(
        output.contains("hidden runs: nearer places 0/2"),
        "{output}"
    );
    assert!(output.contains("run with other numbers, too"), "{output}");
    assert_ne!(touch.digests.all, full.tasks[1].digests.all);
    assert_eq!(
        touch.digests.seconds.len(),
        full.tasks[1].digests.seconds.len()
    );
    // without the course staff's part there are none
    let practice = grade(&base(&bed), None, "mine.rhai", SOLUTION).grade;
    assert_eq!(practice.tasks[1].hidden, []);

    // its output and errors in hidden runs are not reported
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
        let Some(kinemark_sim::text::Dimension::Number(out)) = run.lab.parameters.get("out") else {
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
fn digests_of_hidden_parts_reveal_nothing_without_the_salt() {
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
fn of_a_range_staff_try_the_ends_and_a_student_gets_the_numbers_drawn() {
    let bed = bed();
    let lab = base(&bed);
    let hidden = |from: &str, to: &str| {
        let text = HIDDEN.replace(from, to);
        assert_ne!(text, HIDDEN);
        std::fs::write(bed.path("reference/93-touch/hidden.toml"), text).expect("written");
        let reference = &places(&bed)[1];
        [
            Staff::load(reference, &lab, None),
            Staff::load_for_student(reference, &lab, None),
        ]
        .map(|loaded| loaded.map(|staff| staff.expect("staff").digest))
    };
    // a link of no length at the low end of the range, which is never drawn
    for (from, to) in [
        (
            "parameters = { out = [0.6, 0.75] }",
            "parameters = { lengths = [[-1e-9, 1.0], [0.9, 1.0]] }",
        ),
        (
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]\ndimensions = { link_lengths = [[-1e-9, 1.0], [0.9, 1.0]] }",
        ),
    ] {
        let [staff, student] = hidden(from, to);
        let refused = staff.expect_err("a link of no length").to_string();
        assert!(refused.contains("must be positive"), "{refused}");
        student.expect("numbers between the ends");
    }
    // numbers that make no robot are refused to a student as well
    for (from, to) in [
        (
            "parameters = { out = [0.6, 0.75] }",
            "parameters = { lengths = [[-1.0, -0.5], [0.9, 1.0]] }",
        ),
        (
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]\ndimensions = { link_lengths = [[-1.0, -0.5], [0.9, 1.0]] }",
        ),
    ] {
        let [staff, student] = hidden(from, to);
        for refused in [staff, student] {
            let refused = refused.expect_err("no robot").to_string();
            assert!(refused.contains("must be positive"), "{refused}");
        }
    }
}
