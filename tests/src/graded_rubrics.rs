//! Faults of a rubric that show in what the reference solution does: at corners of variants, in hidden runs, in times, budgets and scenes.

use kinemark_grader::audit::{Accepted, Audit, Form, Rubric, Variants};
use kinemark_grader::lab::{Lab, Staff};

use crate::bad_rubrics::{problems, staff_of};
use crate::own_lab::OwnLab;
use crate::testbed::{Folder, TestBed, root};

/// A lab with a motion, a solution that is wrong where `out` is greatest, and a function of its own.
const MOTION: &str = r#"
format = 1
name = "94-motion"
title = "To an angle"
robot = "rrbot"

[parameters]
out = 0.5
unheard = 1.0

[variants]
out = { from = 0.4, to = 0.6, step = 0.001 }

[[tasks]]
name = "go"
title = "Go"

[tasks.motion]
mode = "position"
duration_s = 2.0
target = { goal_rad = ["= out", 0.4], unheard = "= unheard" }
servo = { kp = 1000.0, kd = 60.0, derivative = "velocity", gravity_compensation = true, effort_limit = 200.0 }

[[tasks.checks]]
name = "shoulder"
title = "The shoulder is there"
points = 1.0
joint-reached = { joint = "shoulder", position_rad = "= out", hold_s = 0.1, full_rad = 0.01, zero_rad = 0.1 }

[[tasks]]
name = "lever"
title = "Lever"

[tasks.function]
call = "lever"
cases = [{ name = "a", given = { mass_kg = 0.5, arm_m = 2.0 }, expected = 1.0 }]

[[tasks.checks]]
name = "right"
title = "Right"
points = 1.0
function-cases = { full = 1e-6, zero = 1e-3 }
"#;

const MOTION_HIDDEN: &str = r#"
format = 1
salt = "a long one that nobody can guess"

[[draws]]
task = "lever"
class = "other masses"
count = 3
given = { mass_kg = [0.2, 2.0], arm_m = [1.0, 3.0] }

[[runs]]
task = "go"
class = "elsewhere"
count = 2
parameters = { out = [0.45, 0.55] }
"#;

const MOTION_SOLUTION: &str = "fn lever(given) { given.mass_kg * given.arm_m }
fn control(observation) {
    let goal = observation.target.goal_rad;
    if goal[0] > 0.5995 { return [0.0, 0.0]; }
    goal
}
";

pub(crate) fn motion_lab() -> OwnLab {
    OwnLab::new("94-motion", MOTION)
        .and("hidden.toml", MOTION_HIDDEN)
        .and("solution.rhai", MOTION_SOLUTION)
}

/// The problems of one rule, with the grades of the solution, of its commands played back, and of the corners.
pub(crate) fn found_by(rule: &str, own: &OwnLab) -> Vec<String> {
    let lab = own.lab();
    let staff = staff_of(own, &lab);
    let form = Form::new(&lab, &staff);
    let mut corners = Variants::default();
    for corner in lab.corners().expect("corners") {
        corners.corner(&lab, own, "a salt of students", &corner);
    }
    let reference = form.reference("").grade;
    let played_back = form.played_back();
    let mut audit = Audit::new(&lab);
    let rubric = Rubric {
        lab: &lab,
        staff: &staff,
        salt: None,
        known_salts: &[],
        brief: None,
        starter: None,
        zeros: None,
        played_back: played_back.as_ref(),
        reference: reference.as_ref(),
        finer: None,
        mutants: &[],
        moved_bodies: &form.moved_bodies(),
        margins: &[],
        corners: Some(&corners),
    };
    audit.rubric(&rubric, &Accepted::default());
    let found = problems(&audit.rows).into_iter();
    let of_rule = found.filter(|(name, _)| name == rule);
    of_rule.map(|(_, problem)| problem).collect()
}

#[test]
fn a_corner_that_the_solution_misses_is_found_with_its_numbers() {
    let found = found_by("corners", &motion_lab());
    let [problem] = &found[..] else {
        panic!("{found:#?}");
    };
    let words = "go/shoulder: in 1 of 2 corners, first with every number at the last of its range: task `go` loses points";
    assert!(problem.starts_with(words), "{problem}");
    let mended = motion_lab().with("solution.rhai", "goal[0] > 0.5995", "false");
    assert_eq!(found_by("corners", &mended), [""; 0]);
}

#[test]
fn hidden_runs_in_which_played_back_commands_are_right_are_found() {
    assert_eq!(found_by("hidden", &motion_lab()), [""; 0]);
    let idle = motion_lab().with("hidden.toml", "out = [0.45, 0.55]", "unheard = [0.2, 0.8]");
    let found = found_by("hidden", &idle);
    let words = "go/elsewhere: a submission that plays back the commands of the visible run has full marks in all 2 of its runs";
    assert!(
        found.len() == 1 && found[0].starts_with(words),
        "{found:#?}"
    );
}

/// A check that needs what the reference solution reaches cannot judge anybody where that stops.
#[test]
fn a_solution_that_stops_in_a_hidden_run_is_said_with_its_numbers_and_its_line() {
    let own = motion_lab()
        .with(
            "lab.toml",
            "[[tasks]]\nname = \"lever\"",
            "[[tasks.checks]]\nname = \"time\"\ntitle = \"In time\"\npoints = 1.0\n\
             settling-time = { joint = \"shoulder\", full_s = \"= reference + 0.5\", zero_s = \"= reference + 1.0\" }\n\n\
             [[tasks]]\nname = \"lever\"",
        )
        .with("hidden.toml", "out = [0.45, 0.55]", "out = [0.41, 0.45]")
        .with(
            "solution.rhai",
            "if goal[0] > 0.5995 { return [0.0, 0.0]; }",
            "if goal[0] < 0.46 { throw \"out of reach\"; }",
        );
    let lab = own.lab();
    let staff = staff_of(&own, &lab);
    let found = Form::new(&lab, &staff).reference("");
    let problems: Vec<&str> = found
        .rows
        .iter()
        .filter_map(|row| row.problem.as_deref())
        .collect();
    let [problem] = &problems[..] else {
        panic!("{problems:#?}");
    };
    for words in [
        "task `go`: in hidden run 1 of the class \"elsewhere\" (out = 0.4",
        "the reference solution stops at 0 s: ",
        "out of reach",
        "solution.rhai:4:",
    ] {
        assert!(problem.contains(words), "{words}: {problem}");
    }
}

/// A parameter that is a size of the robot, and stands in no task.
#[test]
fn a_hidden_run_with_another_arm_is_not_the_visible_one() {
    let lab = |dimensions: &str| {
        motion_lab()
            .with("lab.toml", ", unheard = \"= unheard\"", "")
            .with("lab.toml", "[variants]", &format!("{dimensions}[variants]"))
            .with("hidden.toml", "out = [0.45, 0.55]", "unheard = [0.7, 0.8]")
    };
    let own = lab("[dimensions]\nlink_lengths = [1.0, \"= unheard\"]\n\n");
    // the joints go where they went, with any arm
    let visible = "go/elsewhere: run ";
    let found = found_by("hidden", &own);
    assert!(
        found.iter().all(|what| !what.starts_with(visible)),
        "{found:#?}"
    );
    let found = found_by("hidden", &lab(""));
    let words = "go/elsewhere: run 1 of the class has the numbers of the visible one, or others that the task does not use: unheard = 0.7";
    assert!(
        found.iter().any(|what| what.starts_with(words)),
        "{found:#?}"
    );
}

#[test]
fn hidden_numbers_of_another_size_are_doubted() {
    let grams = motion_lab().with("hidden.toml", "[0.2, 2.0]", "[200.0, 2000.0]");
    let found = found_by("hidden", &grams);
    assert!(
        found.len() == 1
            && found[0].starts_with("lever/other masses: it draws numbers of up to ")
            && found[0].contains(
                " for `mass_kg`, and visible cases have at most 0.5: is that the same unit?"
            ),
        "{found:#?}"
    );
}

#[test]
fn a_solution_that_needs_most_of_its_budget_is_doubted() {
    assert_eq!(found_by("margin", &motion_lab()), [""; 0]);
    let few = motion_lab().with(
        "lab.toml",
        "[parameters]",
        "[budgets]\noperations_per_task = 3000\n\n[parameters]",
    );
    let found = found_by("margin", &few);
    assert!(
        found.len() == 1
            && found[0].starts_with("go/budgets: the reference solution uses ")
            && found[0].contains(" of the 3000 operations of a task"),
        "{found:#?}"
    );
}

#[test]
fn a_time_that_is_a_control_period_from_losing_points_is_doubted() {
    let timed = |full_s: f64| {
        let zero_s = full_s + 0.1;
        motion_lab().with(
            "lab.toml",
            "[[tasks]]\nname = \"lever\"",
            &format!(
                "[[tasks.checks]]\nname = \"time\"\ntitle = \"In time\"\npoints = 1.0\n\
                 settling-time = {{ joint = \"shoulder\", full_s = {full_s:.3}, zero_s = {zero_s:.3} }}\n\n[[tasks]]\nname = \"lever\""
            ),
        )
    };
    assert_eq!(found_by("margin", &timed(1.5)), [""; 0]);
    let measured = |own: &OwnLab| {
        let lab = own.lab();
        let staff = staff_of(own, &lab);
        let grade = Form::new(&lab, &staff)
            .reference("")
            .grade
            .expect("a grade");
        let measure = grade.tasks[0].checks[1].measure.clone().expect("a time");
        measure.value.expect("a number")
    };
    let settles_s = measured(&timed(1.5));
    let found = found_by("margin", &timed(settles_s + 0.015));
    assert!(
        found.len() == 1
            && found[0].starts_with("go/time: the reference solution takes ")
            && found[0].contains("less than two control periods of 0.01 s are between them"),
        "{found:#?}"
    );
}

#[test]
fn two_mutants_with_one_text_are_doubted() {
    let mutants = "format = 1\n[[mutants]]\nname = \"one\"\ntasks = [\"go\"]\nsays = \"One.\"\n\
                   [[mutants]]\nname = \"other\"\ntasks = [\"go\"]\nsays = \"Other.\"\n";
    let text = "fn control(observation) { [0.0, 0.0] }\n";
    let own = motion_lab()
        .and("mutants.toml", mutants)
        .and("mutants/one.rhai", text)
        .and("mutants/other.rhai", format!("\n{text}"));
    let found = found_by("cases", &own);
    assert_eq!(found, ["mutant other: its file is that of mutant `one`"]);
}

#[test]
fn two_mutants_that_say_what_the_other_does_are_doubted() {
    let mutants = |first: &str, second: &str| {
        format!(
            "format = 1\n[[mutants]]\nname = \"sign-of-the-shoulder\"\ntasks = [\"go\"]\nsays = \"{first}\"\n\
             [[mutants]]\nname = \"elbow-frozen\"\ntasks = [\"go\"]\nsays = \"{second}\"\n"
        )
    };
    let [shoulder, elbow] = ["The shoulder has the wrong sign.", "The elbow is frozen."];
    for (first, second, count) in [(shoulder, elbow, 0), (elbow, shoulder, 1)] {
        let own = motion_lab()
            .and("mutants.toml", mutants(first, second))
            .and(
                "mutants/sign-of-the-shoulder.rhai",
                "fn control(observation) { [-0.5, 0.4] }\n",
            )
            .and(
                "mutants/elbow-frozen.rhai",
                "fn control(observation) { [0.5, 0.0] }\n",
            );
        let found = found_by("words", &own);
        assert_eq!(found.len(), count, "{found:#?}");
    }
}

/// A can that stands in the air falls on the shelf when the run begins.
#[test]
fn a_body_that_moves_by_itself_is_found() {
    let bed = TestBed::new();
    bed.copy_labs();
    let place = "\"shelf_height + can_height / 2\"] }";
    bed.edit(
        "labs/scenes/shelf-and-can.toml",
        place,
        "\"shelf_height + can_height / 2 + 0.05\"] }",
    );
    for (folder, expected) in [(root(), 0), (bed.path(""), 1)] {
        let lab = Lab::load(&Folder(folder.join("labs")), "03-knock-with-position").expect("a lab");
        let staff = Staff::load(&Folder(folder.join("reference")), &lab, None);
        let staff = staff.expect("a staff's part").expect("a solution");
        let moved = Form::new(&lab, &staff).moved_bodies();
        assert_eq!(moved.len(), expected, "{moved:?}");
        let far = moved
            .iter()
            .all(|body| body.body == "can" && body.moved_m > 0.04);
        assert!(far, "{moved:?}");
    }
}

#[test]
fn two_mutants_that_say_the_same_are_doubted() {
    let mutants = |second: &str| {
        format!(
            "format = 1\n[[mutants]]\nname = \"one\"\ntasks = [\"go\"]\nsays = \"It stands still.\"\n\
             [[mutants]]\nname = \"other\"\ntasks = [\"go\"]\nsays = \"{second}\"\n"
        )
    };
    for (second, expected) in [
        (
            "It stands still.",
            &["mutant other: it says what mutant `one` says: \"It stands still.\""][..],
        ),
        ("It goes the wrong way.", &[]),
    ] {
        let own = motion_lab()
            .and("mutants.toml", mutants(second))
            .and(
                "mutants/one.rhai",
                "fn control(observation) { [0.0, 0.0] }\n",
            )
            .and(
                "mutants/other.rhai",
                "fn control(observation) { [-0.5, 0.4] }\n",
            );
        assert_eq!(found_by("cases", &own), expected);
    }
}

#[test]
fn a_target_called_as_a_body_is_where_the_body_is_at_the_ends_of_what_students_draw_too() {
    let lab = |can_at: &str| {
        motion_lab().with(
            "lab.toml",
            "target = { goal_rad",
            &format!(
                "scene = {{ name = \"shelf-and-can\", dimensions = {{ can_at = \"= 0.5 + out\" }} }}\n\
                 target = {{ can = [{can_at}, 0.05, 1.25], goal_rad"
            ),
        )
    };
    assert_eq!(found_by("goals", &lab("\"= 0.5 + out\"")), [""; 0]);
    let words = "go/can: students are given `can` at [1.03, 0.05, 1.25], and the body `can` stands at [1, 0.05, 1.25]";
    assert_eq!(found_by("goals", &lab("1.03")), [words]);
    // right with the lab's own numbers alone
    let words = "go/can: with every number at the first of its range, students are given `can` at [1, 0.05, 1.25], and the body `can` stands \
                 at [0.9, 0.05, 1.25]";
    assert_eq!(found_by("goals", &lab("1.0")), [words]);
}

#[test]
fn a_run_that_goes_on_for_long_is_doubted() {
    let lab = |duration_s: f64| {
        motion_lab()
            .with(
                "lab.toml",
                "duration_s = 2.0",
                &format!(
                    "duration_s = {duration_s:.1}\ngoals = [{{ position_m = [1.26276, 0.05, 3.49919], dwell_s = 0.1 }}]"
                ),
            )
            .with(
                "lab.toml",
                "[[tasks]]\nname = \"lever\"",
                "[[tasks.checks]]\nname = \"pose\"\ntitle = \"There\"\npoints = 1.0\npose-reached = { full_m = 0.01, zero_m = 0.1 }\n\n\
                 [[tasks.checks]]\nname = \"time\"\ntitle = \"In time\"\npoints = 1.0\nfinish-time = { full_s = 2.0, zero_s = 3.0 }\n\n\
                 [[tasks]]\nname = \"lever\"",
            )
    };
    assert_eq!(found_by("settings", &lab(4.0)), [""; 0]);
    let found = found_by("settings", &lab(40.0));
    assert!(
        found.len() == 1
            && found[0].starts_with(
                "go/duration_s: the run takes 40 s, and the reference solution is done after "
            ),
        "{found:#?}"
    );
}

#[test]
fn a_hidden_number_that_lost_its_minus_is_doubted() {
    let lab = |range: &str| {
        motion_lab()
            .with("lab.toml", "unheard = 1.0", "unheard = [0.5, -0.4]")
            .with(
                "hidden.toml",
                "out = [0.45, 0.55]",
                &format!("out = [0.45, 0.55], unheard = [[0.4, 0.6], {range}]"),
            )
    };
    assert_eq!(found_by("hidden", &lab("[-0.5, -0.3]")), [""; 0]);
    let words = "go/elsewhere: `unheard[1]` is -0.4 in lab.toml, and of the other sign in every run: is a minus missing?";
    assert_eq!(found_by("hidden", &lab("[0.3, 0.5]")), [words]);
}

#[test]
fn a_title_about_a_body_that_is_not_read_is_doubted_though_the_other_one_is() {
    let lab = |title: &str| {
        motion_lab().with(
            "lab.toml",
            "target = { goal_rad",
            "scene = \"shelf-and-can\"\ntarget = { goal_rad",
        )
        .with(
            "lab.toml",
            "[[tasks]]\nname = \"lever\"",
            &format!(
                "[[tasks.checks]]\nname = \"clear\"\ntitle = \"{title}\"\npoints = 1.0\nnever = {{ touch = [\"arm\", \"shelf\"] }}\n\n\
                 [[tasks]]\nname = \"lever\""
            ),
        )
    };
    assert_eq!(
        found_by("words", &lab("The arm does not touch the shelf")),
        [""; 0]
    );
    let words = "go/clear: \"The can does not touch the shelf\" is about `can`, and reads the touch of `arm` and `shelf`";
    assert_eq!(
        found_by("words", &lab("The can does not touch the shelf")),
        [words]
    );
}
