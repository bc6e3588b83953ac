//! Mistakes of authors of labs with parameters, variants and hidden runs: each is reported at its position.

use crate::variants::{BRIEF, HIDDEN, LAB, bed};

#[test]
fn mistakes_in_a_lab_with_parameters_are_reported_at_their_position() {
    for (from, to, code, message) in [
        (
            "\"= lengths[0]\"",
            "\"= length[0]\"",
            "lab::expression",
            "did you mean `lengths`?",
        ),
        (
            "link_lengths =",
            "link_length =",
            "lab::dimensions",
            "did you mean `link_lengths`?",
        ),
        (
            "link_lengths = [\"= lengths[0]\", ",
            "link_lengths = [",
            "lab::dimensions",
            "a list of 2",
        ),
        ("can_at =", "cat_at =", "lab::dimensions", "cat_at"),
        (
            "\"shelf-and-can\"",
            "\"shelf-and-cat\"",
            "lab::unknown_scene",
            "did you mean `shelf-and-can`?",
        ),
        (
            "step = 0.01 }\n",
            "step = 0.03 }\n",
            "lab::variants",
            "steps of 0.03",
        ),
        (
            "out = { from = 0.85",
            "out = { from = 2.9",
            "lab::variants",
            "`from` 2.9 is above `to`",
        ),
        (
            "out = { from",
            "lengths = { from",
            "lab::toml",
            "is defined twice",
        ),
        (
            "[variants]\nout",
            "[variants]\nouf",
            "lab::variants",
            "did you mean `out`?",
        ),
        (
            "out = { from = 0.85",
            "out = { from = \"= out - 0.05\"",
            "lab::variants",
            "holds numbers, not expressions",
        ),
        (
            "lengths = [{ from = 0.95, to = 1.05, step = 0.01 }, ",
            "lengths = [",
            "lab::variants",
            "a list of 2",
        ),
        (
            "points = 3.0",
            "points = \"= out - 1\"",
            "lab::points",
            "got -0.09",
        ),
    ] {
        let bed = bed();
        assert!(LAB.contains(from), "{from}");
        bed.write("labs/93-touch/lab.toml", LAB.replacen(from, to, 1));
        let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains(code), "{to}: {shown}");
        assert!(shown.contains(message), "{to}: {shown}");
        assert!(shown.contains("93-touch/lab.toml:"), "{to}: {shown}");
    }
}

#[test]
fn mistakes_in_hidden_runs_are_reported_at_their_position() {
    for (from, to, message) in [
        (
            "parameters = { out",
            "parameters = { ouf",
            "did you mean `out`?",
        ),
        ("count = 2", "count = 0", "1 to 20 hidden runs"),
        ("task = \"touch\"", "task = \"fk\"", "is not a motion task"),
        ("[0.6, 0.75]", "[[0.6, 0.75]]", "do not fit its shape"),
        (
            "out = [0.6, 0.75]",
            "lengths = [[-1, -1], [1, 1]]",
            "must be positive",
        ),
        ("[0.6, 0.75]", "[0.75, 0.6]", "write [0.6, 0.75]"),
        (
            "out = [0.6, 0.75]",
            "lengths = [[0.9, 1.0], [1.0, 0.9]]",
            "`lengths` goes from 1 down to 0.9",
        ),
        ("{ out = [0.6, 0.75] }", "{}", "is the visible run again"),
        ("\"nearer places\"", "\" \"", "the class is empty"),
        ("\"other bends\"", "\"\"", "the class is empty"),
        (
            "q_rad = [[-3.0, 3.0]",
            "q_rad = [[3.0, -3.0]",
            "`q_rad` goes from 3 down to -3",
        ),
        (
            "[[runs]]",
            "dimensions = { link_lengths = [[1.0, 0.9], [1, 1]] }\n[[runs]]",
            "`link_lengths` goes from 1 down to 0.9",
        ),
        ("\"sea\"", "\"\"", "staff::salt"),
    ] {
        let bed = bed();
        assert!(HIDDEN.contains(from), "{from}");
        bed.write(
            "reference/93-touch/hidden.toml",
            HIDDEN.replacen(from, to, 1),
        );
        let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains(message), "{to}: {shown}");
        assert!(shown.contains("93-touch/hidden.toml:"), "{to}: {shown}");
    }
}

#[test]
fn a_motion_task_of_a_robot_without_masses_is_the_labs_mistake() {
    let bed = bed();
    let lab = LAB.replace("robot = \"rrbot\"\nframe = \"lab\"", "robot = \"bare\"");
    let lab = lab.replace("link_lengths = [\"= lengths[0]\", \"= lengths[1]\"]\n", "");
    bed.write("labs/93-touch/lab.toml", lab);
    bed.write(
        "labs/robots/bare.toml",
        "format = 1\nname = \"bare\"\n[dh]\nconvention = \"modified\"\n[[dh.rows]]\njoint = \"shoulder\"\ntype = \"revolute\"\n\
         [[dh.rows]]\njoint = \"elbow\"\ntype = \"revolute\"\na_m = 1\n",
    );
    let ran = bed.run(&["grade", "93-touch", "solution.rhai"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains("lab::no_inertia"), "{shown}");
    assert!(shown.contains("joint `elbow`"), "{shown}");
    assert!(shown.contains("robot `bare`"), "{shown}");
    assert!(shown.contains("lab.toml:5:9"), "{shown}");
}

#[test]
fn lab_check_looks_at_the_brief_and_names_the_student_whose_lab_is_none() {
    let bed = bed();
    let check = |students: &str| {
        let ran = bed.run(&[
            "lab",
            "check",
            "93-touch",
            "--salts",
            "0",
            "--variants",
            students,
        ]);
        // this lab has no mutants, which is another problem
        assert_eq!(ran.code, Some(1), "{ran:?}");
        ran.stdout
    };
    let output = check("0");
    assert!(output.contains("can be handed out"), "{output}");
    for (brief, problem) in [
        (
            BRIEF.replace("= out -->", "= ouf -->"),
            "line 3: no parameter is called `ouf`",
        ),
        (
            BRIEF.replace("<!-- grading: end -->", ""),
            "has no place for the table of points",
        ),
        (
            BRIEF.replace("# Touch\n", "# Touch\n\nWith $J$ and $\\frac{1}{2$.\n"),
            "line 3: the formula `$\\frac{1}{2$` cannot be read: its braces or its dollar signs",
        ),
        (
            BRIEF.replace("0.9<!-- = out -->", "$y = 0.9<!-- = out -->$"),
            "line 3: the formula `$y = 0.9<!-- = out -->$` cannot be read: a mark or a comment",
        ),
    ] {
        bed.write("labs/93-touch/brief.md", brief);
        let output = check("0");
        assert!(output.contains(problem), "{output}");
    }
    std::fs::remove_file(bed.path("labs/93-touch/brief.md")).expect("removed");
    let output = check("0");
    assert!(output.contains("there is no brief.md"), "{output}");

    bed.edit(
        "labs/93-touch/lab.toml",
        "out = { from = 0.85, to = 0.95, step = 0.01 }",
        "out = { from = -0.5, to = 0.5, step = 1.0 }",
    );
    bed.edit(
        "labs/93-touch/lab.toml",
        "points = 3.0",
        "points = \"= out\"",
    );
    let output = check("6");
    assert!(output.contains("such as that of `student "), "{output}");
    assert!(
        output.contains("it cannot be loaded (lengths = ["),
        "{output}"
    );
    assert!(output.contains("out = -0.5): "), "{output}");
}
