//! Bands held against what the reference solution reaches, levels of a sweep that do nothing, and starts beside their path.

use crate::graded_rubrics::{found_by, motion_lab};
use crate::own_lab::OwnLab;

/// The lab with one more check of its motion, and with what is exchanged in it.
fn with_check(kind: &str, exchanged: &[(&str, &str)]) -> OwnLab {
    let check = format!(
        "[[tasks.checks]]\nname = \"more\"\ntitle = \"More\"\npoints = 1.0\n{kind}\n\n[[tasks]]\nname = \"lever\""
    );
    let own = motion_lab().with("lab.toml", "[[tasks]]\nname = \"lever\"", &check);
    exchanged
        .iter()
        .fold(own, |own, (from, to)| own.with("lab.toml", from, to))
}

/// Where the solution leads the TCP, as the one goal of the run.
const GOAL: (&str, &str) = (
    "duration_s = 2.0",
    "duration_s = 2.0\ngoals = [{ position_m = [1.26276, 0.05, 3.49919], dwell_s = 0.1 }]",
);

#[test]
fn bands_far_above_or_next_to_what_the_solution_reaches_are_doubted() {
    let fast = |full: &str| {
        with_check(
            &format!(
                "joint-speed = {{ joint = \"shoulder\", full_rad_s = {full}, zero_rad_s = 9000.0 }}"
            ),
            &[],
        )
    };
    assert_eq!(found_by("band", &fast("30.0")), [""; 0]);
    let found = found_by("band", &fast("5000.0"));
    let words = "go/more: all points up to 5000 rad/s, and the reference solution reaches ";
    assert!(
        found.len() == 1 && found[0].starts_with(words),
        "{found:#?}"
    );

    let pose = "pose-reached = { full_m = 0.01, zero_m = 0.1 }\n\n\
                [[tasks.checks]]\nname = \"time\"\ntitle = \"In time\"\npoints = 1.0\n";
    let timed = |zero: &str| {
        let kind = format!(
            "{pose}finish-time = {{ full_s = \"= reference + 0.01\", zero_s = \"= reference + {zero}\" }}"
        );
        with_check(&kind, &[GOAL])
    };
    assert_eq!(found_by("band", &timed("1.0")), [""; 0]);
    let found = found_by("band", &timed("0.02"));
    let words = "a submission that is hardly worse earns nothing";
    assert!(
        found.len() == 1 && found[0].starts_with("go/time: ") && found[0].contains(words),
        "{found:#?}"
    );

    let overshoot = |band: &str| {
        with_check(
            &format!("step-overshoot = {{ joint = \"shoulder\", {band} }}"),
            &[],
        )
    };
    let wide = "full = \"= reference + 0.05\", zero = \"= reference + 0.2\"";
    assert_eq!(found_by("band", &overshoot(wide)), [""; 0]);
    let narrow = "full = \"= reference + 0.002\", zero = \"= reference + 0.005\"";
    let found = found_by("band", &overshoot(narrow));
    assert!(found.len() == 1 && found[0].contains(words), "{found:#?}");
}

#[test]
fn a_band_that_follows_a_solution_far_from_what_is_judged_is_doubted() {
    let kind = "step-overshoot = { joint = \"shoulder\", full = \"= reference + 0.1\", zero = \"= reference + 0.4\" }";
    // hardly any damping
    let found = found_by("band", &with_check(kind, &[("kd = 60.0", "kd = 12.0")]));
    let words = "is what is judged what is asked for?";
    assert!(found.iter().any(|what| what.contains(words)), "{found:#?}");
    assert_eq!(found_by("band", &with_check(kind, &[])), [""; 0]);
}

#[test]
fn a_prediction_of_quite_another_loop_is_doubted() {
    // two links of 0.5 kg, one metre each, from the shoulder: about 1.5 kg m²
    let lab = |inertia: &str| {
        let prediction = format!(
            "prediction = {{ inertia = {inertia}, kp = 1000.0, kd = 60.0, derivative = \"velocity\" }}"
        );
        with_check(
            &format!(
                "rise-time = {{ joint = \"shoulder\", target_rad = 0.5, full_s = 0.5, zero_s = 1.0, {prediction} }}"
            ),
            &[],
        )
    };
    assert_eq!(found_by("band", &lab("1.5")), [""; 0]);
    let found = found_by("band", &lab("150.0"));
    assert!(
        found.len() == 1 && found[0].starts_with("go/more: the prediction is "),
        "{found:#?}"
    );
}

#[test]
fn a_way_that_nobody_asks_for_is_not_compared() {
    let lab = |over: &str| {
        with_check(
            &format!("trajectory-match = {{ over = \"{over}\", full_m = 0.005, zero_m = 0.05 }}"),
            &[GOAL],
        )
    };
    assert_eq!(found_by("band", &lab("dwells")), [""; 0]);
    let found = found_by("band", &lab("run"));
    let words = "go/more: it compares the whole way with the reference solution's";
    assert!(
        found.len() == 1 && found[0].starts_with(words),
        "{found:#?}"
    );
}

#[test]
fn a_level_that_disturbs_next_to_nothing_is_doubted() {
    let lab = |level: &str| {
        with_check(
            &format!(
                "robustness = {{ check = \"shoulder\", rungs = [{{ name = \"other\", {level} }}] }}"
            ),
            &[],
        )
    };
    for (level, words) in [
        (
            "payload_kg = 0.0004",
            Some("its payload is 0.0004 kg, and the robot has "),
        ),
        ("payload_kg = 0.4", None),
        (
            "noise = { q_rad = 1e-9 }",
            Some("its noise is next to nothing"),
        ),
        ("noise = { q_rad = 1e-4 }", None),
        (
            "start_offset_rad = [1e-8, 0.0]",
            Some("it shifts the start by next to nothing"),
        ),
        ("start_offset_rad = [0.1, 0.0]", None),
        ("damping = 1.01", Some("it multiplies the damping by 1.01")),
        ("damping = 1.01, delay_ms = 20", None),
    ] {
        let found = found_by("settings", &lab(level));
        match words {
            None => assert_eq!(found, [""; 0], "{level}"),
            Some(words) => assert!(
                found.len() == 1 && found[0].starts_with(&format!("go/more/other: {words}")),
                "{level}: {found:#?}"
            ),
        }
    }
}

/// The dimension of the arm varies, and the path does not follow it.
#[test]
fn a_start_that_leaves_its_path_where_the_arm_is_another_is_doubted() {
    let lab = |first: &str| {
        let paths = format!(
            "duration_s = 2.0\nstart_rad = [0.0, 0.0]\npaths = {{ line = {{ points_m = [[0.0, 0.05, {first}], [1.0, 0.05, 3.0]], trim_m = 0.05 }} }}"
        );
        let dimensions = "[variants]\nout = { from = 0.4, to = 0.6, step = 0.001 }";
        let longer = "[dimensions]\nlink_lengths = [1.0, \"= 0.5 + out\"]\n\n[variants]\nout = { from = 0.4, to = 0.6, step = 0.001 }";
        let exchanged = [(dimensions, longer), ("duration_s = 2.0", paths.as_str())];
        let kind = "path-deviation = { path = \"line\", full_m = 0.1, zero_m = 0.5 }";
        with_check(kind, &exchanged)
    };
    // the base is 2 m high
    assert_eq!(found_by("goals", &lab("\"= 3.5 + out\"")), [""; 0]);
    let found = found_by("goals", &lab("4.0"));
    let words = "go/start_rad: with the lab's own numbers the arm starts on path `line`, and in class \"elsewhere\" ";
    assert!(
        found.len() == 1 && found[0].starts_with(words),
        "{found:#?}"
    );
}
