//! A path that is named once: how near, how fast and by when it is followed, and how well that goes under disturbances; through the whole
//! grader.

use serde_json::Value as Json;

use crate::own_lab::{OwnLab, check, message, value};

const LAB: &str = r#"
format = 1
name = "91-line"
title = "Line"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "line"
title = "Along the lines"

[tasks.motion]
mode = "position"
duration_s = 4.5
start_rad = [1.3444, 2.0236]
servo = { kp = 1000.0, kd = 60.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[tasks.motion.paths]
ell = { points_m = [[1.25, 0.75, 0.05], [1.25, 1.25, 0.05], [1.75, 1.25, 0.05]], trim_m = 0.06 }
spare = { points_m = [[1.75, 1.25, 0.05], [1.75, 0.75, 0.05]], trim_m = 0.05 }

[[tasks.checks]]
name = "near"
title = "On the lines"
points = 2.0
path-deviation = { path = "ell", full_m = 0.008, zero_m = 0.03 }

[[tasks.checks]]
name = "first"
title = "On the first line"
points = 1.0
path-deviation = { path = "ell", segment = 1, full_m = 0.008, zero_m = 0.03 }

[[tasks.checks]]
name = "pace"
title = "At 0.4 m/s"
points = 2.0
path-speed = { path = "ell", speed_m_s = 0.4, full = 0.15, zero = 0.6 }

[[tasks.checks]]
name = "pace-2"
title = "At 0.4 m/s on the second line"
points = 1.0
path-speed = { path = "ell", segment = 2, speed_m_s = 0.4, full = 0.15, zero = 0.6 }

[[tasks.checks]]
name = "soon"
title = "In time"
points = 1.0
time-limit = { until = "path", path = "ell", full_s = 3.2, zero_s = 4.2 }

[[tasks.checks]]
name = "sturdy"
title = "Also when disturbed"
points = 4.0
robustness = { check = "near", rungs = [
    { name = "noise", noise = { q_rad = 1e-4, qd_rad_s = 1e-2 } },
    { name = "late", delay_ms = 50 },
    { name = "stiff", friction_n_m = 0.3, damping = 1.3 },
    { name = "loaded", payload_kg = 0.1, share = 2 },
] }
"#;

/// A submission whose tip goes along both lines by `s` metres in all, an expression of the time `t`.
fn along(s: &str) -> String {
    format!(
        "fn init(robot, task) {{ this.height = robot.base_height; }}
fn control(observation) {{
    let t = observation.time;
    let s = {s};
    let u = 1.25 + min(max(s - 0.5, 0.0), 0.5) - this.height;
    let out = 0.75 + min(max(s, 0.0), 0.5);
    let q2 = acos((u * u + out * out - 2.0) / 2.0);
    [atan2(out, u) - atan2(sin(q2), 1.0 + cos(q2)), q2]
}}
"
    )
}

/// Along both lines at the speed asked for, with a rest at the corner.
const RIGHT: &str =
    "if t < 1.95 { min(0.4 * max(t - 0.2, 0.0), 0.5) } else { min(0.5 + 0.4 * (t - 1.95), 1.0) }";

fn own_lab() -> OwnLab {
    OwnLab::new("91-line", LAB)
}

#[test]
fn who_follows_the_path_as_asked_has_full_marks() {
    let lab = own_lab();
    let task = lab.graded(&along(RIGHT), 0);
    assert_eq!(task["verdict"], "passed", "{task}");
    assert_eq!(task["points"], 11.0, "{task}");
    // from 1.95 s on 0.44 m of the second line at 0.4 m/s, and a servo that lags by kd / kp = 0.06 s
    assert!((value(&task, "soon") - 3.11).abs() < 0.02, "{task}");
    // the runs of the levels are not in the report, but in the digests
    let rungs = task["digests"]["rungs"].as_array().expect("rungs");
    let names: Vec<&str> = rungs
        .iter()
        .filter_map(|rung| rung["rung"].as_str())
        .collect();
    assert_eq!(names, ["noise", "late", "stiff", "loaded"]);
    // the same noise for another submission that moves alike
    let other = lab.graded(&format!("// another\n{}", along(RIGHT)), 0);
    assert_eq!(other["digests"], task["digests"]);
    let plot = lab.written("plots/line-path.svg");
    for words in ["path asked for", "\nell\n", "\nspare\n", "full points"] {
        assert!(plot.contains(words), "no {words:?}");
    }
    let page = lab.written("report.html");
    assert!(page.contains("earned under disturbances, mean of 4 runs"));
}

#[test]
fn who_hurries_rests_or_stops_loses_for_that() {
    let lab = own_lab();
    // twice the speed on the second line
    let hasty = RIGHT.replace("0.5 + 0.4 * (t - 1.95)", "0.5 + 0.8 * (t - 1.95)");
    let task = lab.graded(&along(&hasty), 1);
    assert_eq!(check(&task, "near")["outcome"], "full", "{task}");
    // hand: an error of 1 where the speed has settled
    assert!((0.8..1.1).contains(&value(&task, "pace")), "{task}");
    let words = message(check(&task, "pace"));
    assert!(
        words.starts_with(
            "segment 2 of the path `ell`, from [1.25, 1.25, 0.05] to [1.75, 1.25, 0.05]"
        ),
        "{words}"
    );
    // a rest of 0.5 s in the middle of the first line: 0.2 m of 0.38 m and 0.2 m
    let resting = "if t < 0.825 { 0.4 * max(t - 0.2, 0.0) } else { min(0.25 + 0.4 * max(t - 1.325, 0.0), 1.0) }";
    let task = lab.graded(&along(resting), 1);
    let expected = (0.2_f64 / 0.58).sqrt();
    assert!((value(&task, "pace") - expected).abs() < 0.05, "{task}");
    assert_eq!(check(&task, "pace-2")["outcome"], "full", "{task}");
    // the second line is never driven
    let task = lab.graded(&along("min(0.4 * max(t - 0.2, 0.0), 0.5)"), 1);
    assert_eq!(check(&task, "first")["outcome"], "full", "{task}");
    assert_eq!(check(&task, "near")["outcome"], "none", "{task}");
    assert_eq!(value(&task, "pace-2"), 1.0);
    assert!(
        message(check(&task, "pace")).contains("0.380 m are never covered"),
        "{task}"
    );
    let words = message(check(&task, "soon"));
    assert!(
        words.starts_with("point 3 of the path `ell`, at [1.75, 1.25, 0.05], was missed by 0.")
            && words.ends_with("the path was never finished"),
        "{words}"
    );
    // nothing is tried again where nothing was earned
    assert_eq!(check(&task, "sturdy")["outcome"], "not-judged");
    assert_eq!(task["digests"].get("rungs"), None);
}

#[test]
fn a_rung_that_is_too_high_costs_its_share() {
    let lab = own_lab();
    lab.edit("payload_kg = 0.1", "payload_kg = 8.0");
    let task = lab.graded(&along(RIGHT), 1);
    let sturdy = check(&task, "sturdy");
    // three levels of five shares are kept
    assert_eq!(sturdy["measure"]["value"], 0.6, "{sturdy}");
    assert_eq!(
        sturdy["points"].as_f64().map(|p| (p * 1e9).round()),
        Some(2.4e9)
    );
    let words = message(sturdy);
    assert!(
        words.starts_with("in the run `loaded` (8 kg more at the TCP): \"On the lines\" earns 0 % of its points; segment "),
        "{words}"
    );
    // the moment is one of another run than the report shows, so that there is nothing to lead to
    let evidence = &sturdy["evidence"][0];
    assert_eq!(evidence["run"], "loaded");
    assert_eq!(evidence["tick"], Json::Null);
    assert_eq!(evidence["time_s"], Json::Null);
    assert_eq!(sturdy["first_lost"], Json::Null);
    // a loss on a level is not a stop of the visible run
    assert_eq!(check(&task, "near")["outcome"], "full");
    assert_eq!(task["stopped"], Json::Null);
}

#[test]
fn a_submission_that_fails_on_a_rung_loses_the_rung_only() {
    // it does not believe in noise
    let wary = along(RIGHT).replace(
        "    let s =",
        "    if t == 0.0 && observation.qd[0] != 0.0 { throw \"shaking\"; }\n    let s =",
    );
    let lab = own_lab();
    let task = lab.graded(&wary, 1);
    let sturdy = check(&task, "sturdy");
    assert_eq!(sturdy["measure"]["value"], 0.8, "{sturdy}");
    let words = message(sturdy);
    assert!(
        words.starts_with("in the run `noise` (noise of 0.0001 rad on q and 0.01 rad/s on qd): \"On the lines\" earns 0 % of its points; at 0 s: the submission was stopped:")
            && words.contains("shaking"),
        "{words}"
    );
    assert_eq!(task["verdict"], "missed");
}

#[test]
fn a_path_or_a_ladder_that_cannot_be_is_refused_at_its_place() {
    let cases = [
        (
            "path = \"ell\", full_m",
            "path = \"el\", full_m",
            "lab::unknown_path",
            "did you mean `ell`?",
        ),
        ("segment = 2", "segment = 3", "lab::path", "segments 1 to 2"),
        ("segment = 2", "segment = 0", "lab::path", "got 0"),
        (
            "speed_m_s = 0.4",
            "speed_m_s = 0",
            "lab::out_of_range",
            "speed_m_s",
        ),
        (
            "trim_m = 0.06",
            "trim_m = 0.25",
            "lab::path",
            "segment 1 of path `ell`",
        ),
        ("spare = {", "Spare = {", "lab::bad_name", "path name"),
        (
            "path = \"ell\", full_s",
            "full_s",
            "lab::time_limit",
            "needs `path`",
        ),
        (
            "path = \"ell\", full_s",
            "path = \"ell\", body = \"can\", full_s",
            "lab::time_limit",
            "nothing else",
        ),
        (
            "robustness = { check = \"near\"",
            "robustness = { check = \"neer\"",
            "lab::unknown_check",
            "did you mean `near`?",
        ),
        (
            "delay_ms = 50",
            "delay_ms = 45",
            "lab::periods",
            "nearest delay that fits is",
        ),
        (
            "name = \"late\", delay_ms = 50",
            "name = \"late\"",
            "lab::robustness",
            "changes nothing",
        ),
        (
            "name = \"late\"",
            "name = \"noise\"",
            "lab::duplicate",
            "level `noise`",
        ),
        (
            "q_rad = 1e-4, qd_rad_s = 1e-2",
            "q_rad = -1e-4",
            "lab::out_of_range",
            "noise",
        ),
        (
            "payload_kg = 0.1",
            "payload_kg = 1e9",
            "lab::out_of_range",
            "at most 1e6",
        ),
        ("share = 2", "share = 0", "lab::out_of_range", "share"),
        ("delay_ms = 50", "delay_s = 0.05", "lab::toml", "delay_ms"),
    ];
    own_lab().is_refused(&along(RIGHT), &cases);
}
