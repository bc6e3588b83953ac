//! Briefs that say something else than what is graded: `lab check` finds the words, and says what is so.

use kinemark_grader::audit::Accepted;

use crate::bad_rubrics::{BRIEF, own_lab, problems, rows};
use crate::graded_rubrics::motion_lab;

#[test]
fn words_of_the_brief_are_held_to_what_is_graded() {
    for (said, words) in [
        (
            "# 1. fk: forward kinematics (5 points, 30 minutes)",
            Some("fk: the brief's heading says 5 points, the checks of the task have 4"),
        ),
        ("# 1. fk: forward kinematics (4 points, 30 minutes)", None),
        (
            "`target.effort_n_m` = 3.0 is the effort.",
            Some("target.effort_n_m: the brief says 3, lab.toml 2"),
        ),
        ("`target.effort_n_m` = 2 is the effort.", None),
        (
            "Push with `effort_n_m`, 3 N m.",
            Some("target.effort_n_m: the brief says 3 N m, lab.toml 2"),
        ),
        ("Push with `effort_n_m`, 2 N m.", None),
        (
            "A call may use 1000 operations.",
            Some("budgets: the brief says 1000 operations, a call has 25000"),
        ),
        (
            "A call may use 1000 operations on average, at most 25,000 operations.",
            None,
        ),
        (
            "The other place is at 1.25 m.",
            Some("out: the brief says 1.25, which differs from student to student, without a mark"),
        ),
        ("The other place is at 1.25<!-- = out --> m.", None),
        (
            "The other place is at 1<!-- out --> m.",
            Some("line 2: `<!-- out -->` stands behind a number in the brief, and is no mark"),
        ),
        (
            "The run takes 8 s.",
            Some("brief: it says a time of 8 s, and in lab.toml runs take 3 s and 1 s"),
        ),
        (
            "At the place, stay for 0.2 s.",
            Some("brief: it says a time of 0.2 s"),
        ),
        ("At the place, stay for 0.5 s.", None),
        (
            "| `control(observation)` | every 10 ms | setpoints in degrees |",
            Some("control: the brief says that `control` returns something in degrees"),
        ),
        (
            "| the shoulder above the ground | `robot.base_height` | 1.5 m |",
            Some("robot.base_height: the brief says 1.5 m, and the robot has 2 m"),
        ),
        (
            "| the arm | `robot.link_lengths[0]`, `robot.link_lengths[1]` | 1 m, 100 cm |",
            None,
        ),
        ("The run takes 3 s.", None),
        (
            "| the shoulder above the ground | `robot.base_height` | 1.5 N s/m |",
            Some("robot.base_height: the brief says 1.5, and the robot has 2"),
        ),
        (
            "| `control(observation)` | every 20 ms | positions |",
            Some("brief: it says a call every 0.02 s, and in lab.toml calls are every 0.01 s"),
        ),
        (
            "The motors give at most 80 N m at the shoulder.",
            Some("effort_limit of shoulder: the brief says 80 N m, and the servo has 100 N m"),
        ),
        ("The motors give at most 100 N m at the shoulder.", None),
        ("Gravity takes 80 N m at the shoulder.", None),
        (
            "It carries 3.7 kg.",
            Some("3.7 kg: the brief says so, and neither a link, nor a body, nor lab.toml"),
        ),
        ("Each link has a mass of 0.5 kg.", None),
        (
            "The first and last 80 mm do not count.",
            Some("trim_m: the brief says that the first and last 80.0 mm do not count"),
        ),
        ("The first and last 5 cm do not count.", None),
        (
            "Go to all three places.",
            Some("goals: the brief says \"three places\", and tasks have 1"),
        ),
        (
            "`control` is called every 7 ms.",
            Some("brief: it says a call every 0.007 s, and in lab.toml calls are every 0.01 s"),
        ),
        ("`control` is called 100 times a second.", None),
    ] {
        let own = own_lab().with(
            "lab.toml",
            "[parameters]\nout = 1.2",
            "[parameters]\nout = 1.25",
        );
        let found = problems(&rows(
            &own,
            &format!("{BRIEF}{said}\n"),
            &Accepted::default(),
        ));
        let of_words: Vec<&str> = found
            .iter()
            .filter(|(rule, _)| rule == "words")
            .map(|(_, problem)| problem.as_str())
            .collect();
        match words {
            None => assert_eq!(of_words, [""; 0], "{said}"),
            Some(words) => assert!(
                of_words.len() == 1 && of_words[0].starts_with(words),
                "{said}: {of_words:?}"
            ),
        }
    }
}

#[test]
fn what_the_brief_calls_by_another_name_or_number_is_doubted() {
    let goals_alone = own_lab().with("lab.toml", "target = { effort_n_m = 2.0 }\n", "");
    let texts = [
        (
            own_lab(),
            format!("{BRIEF}It is called as `inverse_kinematics(position, robot)`.\n"),
            "names",
            "brief: it says `inverse_kinematics(position, robot)`, and the function is called as `inverse_kinematics(robot, position)`",
        ),
        (
            own_lab(),
            format!("{BRIEF}Read `observation.torque`.\n"),
            "names",
            "brief: it mentions `observation.torque`, which there is not",
        ),
        (
            goals_alone,
            BRIEF.replace("effort_n_m", "right"),
            "names",
            "brief: it mentions `observation.target.right`, and the target is the list of goals",
        ),
        (
            own_lab(),
            format!("{BRIEF}The servo has kp = 500 and kd = 30.\n"),
            "brief",
            "touch/kp: the servo has kp = 1000, and the brief, which speaks of such gains, has no such number",
        ),
        (
            own_lab(),
            format!("{BRIEF}Each servo is a spring of 500 N m/rad.\n"),
            "brief",
            "touch/kp: the servo has kp = 1000",
        ),
        (
            own_lab(),
            format!("# Lab 7: gardening\n\n{BRIEF}"),
            "words",
            "title: the lab is called \"A rubric without faults\", and the brief begins with \"Lab 7: gardening\"",
        ),
    ];
    for (own, brief, rule, words) in texts {
        let found = problems(&rows(&own, &brief, &Accepted::default()));
        let hit = |(name, problem): &(String, String)| name == rule && problem.starts_with(words);
        assert!(found.iter().any(hit), "{words}: {found:#?}");
    }
    let right = format!(
        "# Rubric\n\n{BRIEF}The servo has kp = 1000 and kd = 30. `observation.tcp_rotation` and `observation.target[0]`.\n"
    );
    let found = problems(&rows(&own_lab(), &right, &Accepted::default()));
    assert_eq!(found, []);
}

#[test]
fn a_brief_without_its_functions_is_doubted_once_each() {
    let found = problems(&rows(&own_lab(), "Good luck.", &Accepted::default()));
    let of: Vec<&str> = found
        .iter()
        .filter_map(|(_, problem)| problem.split_once(": "))
        .map(|(of, _)| of)
        .collect();
    assert_eq!(
        of,
        [
            "forward_kinematics",
            "inverse_kinematics",
            "control",
            "effort_n_m",
            "gravity"
        ]
    );
}

#[test]
fn a_brief_without_what_a_function_is_given_and_answers_is_doubted() {
    let own = motion_lab()
        .with("lab.toml", "expected = 1.0", "expected = { moment = 1.0 }")
        .with(
            "solution.rhai",
            "given.mass_kg * given.arm_m",
            "#{ moment: given.mass_kg * given.arm_m }",
        );
    let brief = "Write `control(observation)` for `goal_rad` and `unheard`, and `lever(given)`.";
    let of_brief = |brief: &str| -> Vec<String> {
        let found = problems(&rows(&own, brief, &Accepted::default()));
        let found = found.into_iter().filter(|(rule, _)| rule == "brief");
        found.map(|(_, problem)| problem).collect()
    };
    assert_eq!(
        of_brief(brief),
        [
            "arm_m: the brief does not mention `arm_m`, which `given` holds in task \"Lever\"",
            "mass_kg: the brief does not mention `mass_kg`, which `given` holds in task \"Lever\"",
            "moment: the brief does not mention `moment`, an entry of the answer in task \"Lever\"",
        ]
    );
    let whole = format!("{brief} `given.mass_kg`, `given.arm_m`: answer with `moment`.");
    assert_eq!(of_brief(&whole), [""; 0]);
}

/// The limit of a check that is a student's number by chance.
#[test]
fn a_limit_of_a_check_needs_no_mark() {
    for (limit, count) in [("2.0", 1), ("1.25", 0)] {
        let own = own_lab()
            .with(
                "lab.toml",
                "[parameters]\nout = 1.2",
                "[parameters]\nout = 1.25",
            )
            .with("lab.toml", "full_s = 2.0", &format!("full_s = {limit}"));
        let brief = format!("{BRIEF}Be quick: 1.25 of a second is enough.\n");
        let found = problems(&rows(&own, &brief, &Accepted::default()));
        let words = "out: the brief says 1.25, which differs from student to student";
        let hits = found.iter().filter(|(_, what)| what.starts_with(words));
        assert_eq!(hits.count(), count, "{limit}: {found:#?}");
    }
}

/// A round number stands in every text; with the unit of the parameter it is the parameter's.
#[test]
fn a_round_number_needs_a_mark_where_its_unit_is_the_parameters() {
    for (said, count) in [("0.5 s", 1), ("0.5 m/s", 0), ("0.5<!-- = stay --> s", 0)] {
        let own = own_lab()
            .with("lab.toml", "[parameters]", "[parameters]\nstay = 0.5")
            .with(
                "lab.toml",
                "[variants]",
                "[variants]\nstay = { from = 0.4, to = 0.6, step = 0.1 }",
            )
            .with("lab.toml", "dwell_s = 0.5", "dwell_s = \"= stay\"");
        let brief = format!("{BRIEF}Be there for {said}.\n");
        let found = problems(&rows(&own, &brief, &Accepted::default()));
        let words = "stay: the brief says 0.5, which differs from student to student";
        let hits = found.iter().filter(|(_, what)| what.starts_with(words));
        assert_eq!(hits.count(), count, "{said}: {found:#?}");
    }
}
