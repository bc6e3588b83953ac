//! Checks of what a run did in a scene, and along a path: a right submission has full marks, wrong ones lose for the right reason, and
//! an impossible lab is refused with its position.

use crate::own_lab::{OwnLab, check, message};

const LAB: &str = r#"
format = 1
name = "90-knock"
title = "Knock"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "knock"
title = "Off the shelf"

[tasks.motion]
mode = "position"
scene = "shelf-and-can"
duration_s = 3.0
start_rad = [1.3444, 2.0236]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }
paths = { line = { points_m = [[1.25, 0.75, 0.05], [1.25, 1.3, 0.05]], trim_m = 0.05 } }

[[tasks.checks]]
name = "knocked"
title = "The can falls over the far side"
points = 4.0
body-falls = { body = "can", side = "far" }

[[tasks.checks]]
name = "shelf"
title = "The shelf is left alone"
points = 2.0
needs = ["knocked"]
contact-impulse = { between = ["arm", "shelf"], full_n_s = 0.0, zero_n_s = 0.5 }

[[tasks.checks]]
name = "gentle"
title = "No fling"
points = 2.0
tcp-speed = { at = "touch", body = "can", full_m_s = 0.8, zero_m_s = 3.0 }

[[tasks.checks]]
name = "calm"
title = "Never fast"
points = 1.0
needs = ["knocked"]
tcp-speed = { at = "run", full_m_s = 1.5, zero_m_s = 4.0 }

[[tasks.checks]]
name = "line"
title = "Along the line"
points = 2.0
path-deviation = { path = "line", full_m = 0.008, zero_m = 0.03 }

[[tasks.checks]]
name = "whole"
title = "All of the line"
points = 1.0
path-coverage = { path = "line", within_m = 0.03, full = 0.98, zero = 0.5 }

[[tasks.checks]]
name = "soon"
title = "In time"
points = 1.0
time-limit = { until = "fall", body = "can", full_s = 2.5, zero_s = 3.5 }
"#;

/// A submission whose tip is at `place`, `[up, out]` in the lab's frame, an expression of the time `t`.
fn tip(place: &str) -> String {
    format!(
        "fn init(robot, task) {{ this.height = robot.base_height; }}
fn control(observation) {{
    let t = observation.time;
    let place = {place};
    let u = place[0] - this.height;
    let out = place[1];
    let q2 = acos((u * u + out * out - 2.0) / 2.0);
    [atan2(out, u) - atan2(sin(q2), 1.0 + cos(q2)), q2]
}}
"
    )
}

fn own_lab() -> OwnLab {
    OwnLab::new("90-knock", LAB)
}

#[test]
fn a_steady_push_has_full_marks() {
    let task = own_lab().graded(&tip("[1.25, min(0.75 + 0.5 * max(t - 0.5, 0.0), 1.3)]"), 0);
    assert_eq!(task["verdict"], "passed", "{task}");
    assert_eq!(task["points"], 13.0, "{task}");
    let fell = check(&task, "soon")["measure"]["value"].as_f64();
    assert!((1.0..2.5).contains(&fell.expect("a time")), "{fell:?}");
    // the tip follows at half a metre a second, and the can is 0.18 m from where it starts
    let speed = check(&task, "gentle")["measure"]["value"].as_f64();
    assert!((speed.expect("a speed") - 0.5).abs() < 0.05, "{speed:?}");
}

#[test]
fn an_arm_that_stays_earns_nothing() {
    let task = own_lab().graded(&tip("[1.25, 0.75]"), 1);
    assert_eq!(task["points"], 0.0, "{task}");
    assert_eq!(
        message(check(&task, "knocked")),
        "`can` stayed where it was: the arm never touched it"
    );
    assert_eq!(
        message(check(&task, "gentle")),
        "the arm never touched `can`: the hand comes no nearer to its middle than 0.250 m, at 0 s, where it is at [1.25, 0.75, 0.05]; \
         at the end it is at [1.25, 0.75, 0.05]"
    );
    for name in ["shelf", "calm"] {
        assert_eq!(check(&task, name)["outcome"], "not-judged");
    }
    let words = message(check(&task, "line")).to_owned();
    assert!(words.contains("never covered"), "{words}");
    assert_eq!(check(&task, "whole")["measure"]["value"], 0.0);
    assert_eq!(
        message(check(&task, "soon")),
        "`can` never fell, so there is no time to judge"
    );
}

#[test]
fn half_a_push_earns_its_share() {
    let task = own_lab().graded(&tip("[1.25, min(0.75 + 0.5 * max(t - 0.5, 0.0), 1.0)]"), 1);
    let knocked = check(&task, "knocked");
    let words = message(knocked);
    assert!(
        words.starts_with("`can` moved at 0.9") && words.ends_with("but did not fall"),
        "{words}"
    );
    let share = if words.contains("toppled") { 0.6 } else { 0.3 };
    assert_eq!(knocked["points"], 4.0 * share);
    // half of the line is driven, and driven well
    let covered = check(&task, "whole")["measure"]["value"].as_f64();
    let covered = covered.expect("a share");
    assert!((0.35..0.55).contains(&covered), "{covered}");
    assert_eq!(check(&task, "line")["outcome"], "none");
}

#[test]
fn a_fling_that_ends_on_the_shelf_loses_for_both() {
    let task = own_lab().graded(
        &tip("if t < 1.5 { [1.25, min(0.75 + 4.0 * max(t - 0.5, 0.0), 1.3)] } else { [1.1, 1.0] }"),
        1,
    );
    let shelf = check(&task, "shelf");
    let words = message(shelf);
    assert!(
        words.starts_with("`forearm` first touched `shelf` at 1.")
            && words.contains(" N at its peak"),
        "{words}"
    );
    assert_eq!(shelf["outcome"], "none");
    assert_eq!(shelf["evidence"][0]["signal"], "contacts");
    let tick = shelf["evidence"][0]["tick"].as_u64();
    assert!((1500..1800).contains(&tick.expect("a tick")), "{tick:?}");
    let gentle = check(&task, "gentle");
    assert!(
        message(gentle).ends_with("when the arm first touches `can`"),
        "{gentle}"
    );
    assert!(gentle["measure"]["value"].as_f64() > Some(1.0), "{gentle}");
}

#[test]
fn a_check_of_what_cannot_be_is_refused_at_its_place() {
    let cases = [
        (
            "body = \"can\", side",
            "body = \"cam\", side",
            "lab::unknown_body",
            "did you mean `can`?",
        ),
        (
            "body = \"can\", side",
            "body = \"shelf\", side",
            "lab::body_falls",
            "is not dynamic",
        ),
        ("side = \"far\"", "side = \"top\"", "lab::toml", "far"),
        (
            "side = \"far\"",
            "moved = 0.7",
            "lab::body_falls",
            "0.7 and 0.6",
        ),
        (
            "[\"arm\", \"shelf\"]",
            "[\"forarm\", \"shelf\"]",
            "lab::unknown_party",
            "did you mean `forearm`?",
        ),
        (
            "[\"arm\", \"shelf\"]",
            "[\"arm\", \"upper\"]",
            "lab::contact_impulse",
            "links of one robot",
        ),
        (
            "[\"arm\", \"shelf\"]",
            "[\"ground\", \"shelf\"]",
            "lab::contact_impulse",
            "neither of them",
        ),
        (
            "at = \"run\"",
            "at = \"run\", body = \"can\"",
            "lab::tcp_speed",
            "no meaning",
        ),
        (
            "at = \"touch\", body = \"can\"",
            "at = \"touch\"",
            "lab::tcp_speed",
            "`body` is missing",
        ),
        (
            "trim_m = 0.05 }",
            "trim_m = 0.3 }",
            "lab::path",
            "segment 1",
        ),
        (
            "full = 0.98, zero = 0.5",
            "full = 0.5, zero = 0.98",
            "lab::band",
            "coverage",
        ),
        (
            "until = \"fall\", body = \"can\"",
            "until = \"fall\", body = \"shelf\"",
            "lab::body_falls",
            "is not dynamic",
        ),
        (
            "until = \"fall\", body = \"can\"",
            "until = \"fall\", path = \"line\"",
            "lab::time_limit",
            "needs `body`",
        ),
        (
            "scene = \"shelf-and-can\"",
            "",
            "lab::check_kind",
            "needs `scene`",
        ),
    ];
    own_lab().is_refused(&tip("[1.25, 0.75]"), &cases);
}
