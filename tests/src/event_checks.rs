//! Checks of where a body ends, of what must never happen, of what must happen in order, and of what sensors read.

use crate::own_lab::{OwnLab, check, message};

const LAB: &str = r#"
format = 1
name = "92-put"
title = "Push it along"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "push"
title = "Along the shelf"

[tasks.motion]
mode = "position"
scene = "shelf-and-can"
duration_s = 3.0
start_rad = [1.3444, 2.0236]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[[tasks.motion.sensors]]
name = "elbow_encoder"
type = "joint-position"
joint = "elbow"

[[tasks.motion.sensors]]
name = "stretched"
type = "limit-switch"
joint = "elbow"
at = 1.7
side = "lower"
opens_motor = false

[[tasks.motion.sensors]]
name = "wrist"
type = "wrench"
joint = "elbow"

[[tasks.checks]]
name = "place"
title = "The can stands 5 cm further out"
points = 4.0
body-reached = { body = "can", position_m = [1.25, 1.05, 0.05], hold_s = 0.5, upright_deg = 20.0, released = true, full_m = 0.005, zero_m = 0.025 }

[[tasks.checks]]
name = "safe"
title = "The can stays on the shelf"
points = 2.0
never = { event = "body-fell", body = "can" }

[[tasks.checks]]
name = "shelf"
title = "The shelf is touched once at most"
points = 1.0
never = { touch = ["arm", "shelf"], at_most = 1 }

[[tasks.checks]]
name = "unstretched"
title = "The arm is never stretched"
points = 1.0
never = { sensor = "stretched", becomes = true }

[[tasks.checks]]
name = "steps"
title = "It is touched, it moves, and the elbow passes 1.79 rad, in this order"
points = 3.0
order = { events = [{ touch = ["arm", "can"] }, { event = "moved", body = "can" }, { sensor = "elbow_encoder", becomes = { below = 1.79 } }] }

[[tasks.checks]]
name = "pressed"
title = "The switch is not pressed at the end"
points = 1.0
sensor-reads = { sensor = "stretched", value = false }

[[tasks.checks]]
name = "elbow"
title = "The elbow ends at 2 rad"
points = 2.0
sensor-reads = { sensor = "elbow_encoder", value = 2.0236, full = 0.05, zero = 0.25 }

[[tasks.checks]]
name = "loaded"
title = "The elbow carries the forearm"
points = 1.0
sensor-reads = { sensor = "wrist", part = "fx", of = "max", from_s = 0.5, to_s = 1.0, at_least = true, full = 0.1, zero = 0.0 }

[[tasks.checks]]
name = "pushed"
title = "The can was pushed"
points = 1.0
contact-impulse = { between = ["arm", "can"], at_least = true, full_n_s = 0.02, zero_n_s = 0.0 }
"#;

/// A submission whose tip is `out` from the post, an expression of the time `t`, at the height of the can.
fn tip(out: &str) -> String {
    format!(
        "fn init(robot, task) {{ this.height = robot.base_height; }}
fn control(observation) {{
    let t = observation.time;
    let u = 1.25 - this.height;
    let out = {out};
    let q2 = acos((u * u + out * out - 2.0) / 2.0);
    [atan2(out, u) - atan2(sin(q2), 1.0 + cos(q2)), q2]
}}
"
    )
}

fn own_lab() -> OwnLab {
    OwnLab::new("92-put", LAB)
}

/// The tip touches the can at 0.958, takes it along, lets it slide on for some millimetres, and goes back.
const GOOD: &str =
    "if t < 1.3 { 0.75 + 0.25 * max(t - 0.3, 0.0) } else { max(1.0 - 0.3 * (t - 1.3), 0.75) }";

#[test]
fn the_same_thing_twice_has_to_happen_twice() {
    let twice = "{ event = \"moved\", body = \"can\" }, { event = \"moved\", body = \"can\" }, ";
    let lab = own_lab().with("lab.toml", "{ event = \"moved\", body = \"can\" }, ", twice);
    let task = lab.graded(&tip(GOOD), 1);
    // it is touched and moves once, and the second time is missing
    let steps = check(&task, "steps");
    assert_eq!(steps["measure"]["value"], 0.5, "{steps}");
}

#[test]
fn an_arm_that_stays_earns_what_needs_no_motion() {
    let task = own_lab().graded(&tip("0.75"), 1);
    assert_eq!(
        message(check(&task, "place")),
        "`can` is where it began at the end, at [1.25, 1, 0.05]: it was to be at [1.25, 1.05, 0.05]"
    );
    for name in ["safe", "shelf", "unstretched", "pressed", "elbow"] {
        assert_eq!(check(&task, name)["outcome"], "full", "{name}: {task}");
    }
    assert_eq!(check(&task, "steps")["points"], 0.0);
    assert_eq!(
        message(check(&task, "steps")),
        "this is to happen first, and never did: the arm touches `can`"
    );
    assert_eq!(
        message(check(&task, "pushed")),
        "the arm and `can` never pressed on each other"
    );
}

#[test]
fn a_push_to_the_place_and_back_is_right() {
    let task = own_lab().graded(&tip(GOOD), 1);
    let place = check(&task, "place");
    let away_m = place["measure"]["value"].as_f64().expect("a distance");
    // the can goes on a little when the tip stops
    assert!(away_m < 0.025, "{place}");
    for name in ["safe", "shelf", "pushed"] {
        assert_eq!(check(&task, name)["outcome"], "full", "{name}: {task}");
    }
    let steps = check(&task, "steps");
    assert!(steps["points"].as_f64() >= Some(2.0), "{steps}");
}

#[test]
fn a_can_that_falls_a_hand_that_stays_and_a_wrong_reading_lose_with_words() {
    let over = own_lab().graded(&tip("min(0.75 + 0.5 * max(t - 0.5, 0.0), 1.3)"), 1);
    let place = message(check(&over, "place"));
    assert!(place.starts_with("`can` is tilted by "), "{place}");
    let safe = check(&over, "safe");
    assert!(message(safe).starts_with("`can` falls at "), "{safe}");
    assert_eq!(safe["points"], 0.0);
    assert_eq!(check(&over, "steps")["outcome"], "full", "{over}");
    let stretched = message(check(&over, "unstretched"));
    assert!(
        stretched.starts_with("`stretched` becomes true at 1."),
        "{stretched}"
    );
    let pressed = message(check(&over, "pressed"));
    assert_eq!(
        pressed,
        "the last reading of `stretched`, at 3 s, is true; it was to be false"
    );
    let elbow = message(check(&over, "elbow"));
    assert!(
        elbow.starts_with("the last reading of `elbow_encoder`, at 3 s, is 1.")
            && elbow.ends_with(" rad; it was to be 2.0236 rad"),
        "{elbow}"
    );

    // not let go
    let held = own_lab().graded(&tip("0.75 + 0.25 * min(max(t - 0.3, 0.0), 1.0)"), 1);
    let place = message(check(&held, "place"));
    assert!(
        place.starts_with("the arm touches `can` at ") || place.starts_with("`can` is at "),
        "{place}"
    );
}

#[test]
fn what_cannot_happen_is_refused_at_its_place() {
    let cases = [
        (
            "event = \"body-fell\", body = \"can\"",
            "event = \"body-fel\", body = \"can\"",
            "lab::occurrence",
            "did you mean `body-fell`?",
        ),
        (
            "event = \"body-fell\", body = \"can\"",
            "event = \"body-fell\", body = \"shelf\"",
            "lab::body_falls",
            "not dynamic",
        ),
        (
            "event = \"body-fell\", body = \"can\"",
            "event = \"body-fell\", joint = \"elbow\"",
            "lab::occurrence",
            "`joint` has no meaning",
        ),
        (
            "event = \"body-fell\", body = \"can\"",
            "event = \"near-singular\", joint = \"elbow\"",
            "lab::occurrence",
            "`joint` has no meaning",
        ),
        (
            "event = \"body-fell\", body = \"can\"",
            "body = \"can\"",
            "lab::occurrence",
            "one of `event`, `touch`, `sensor`",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "sensor = \"streched\", becomes = true",
            "lab::unknown_sensor",
            "did you mean `stretched`?",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "sensor = \"stretched\", becomes = { above = 1.0 }",
            "lab::occurrence",
            "true or false",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "sensor = \"wrist\", part = \"fz\", becomes = true",
            "lab::occurrence",
            "reads numbers",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "sensor = \"wrist\", part = \"gz\", becomes = { above = 1.0 }",
            "lab::unknown_sensor",
            "fx",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "sensor = \"stretched\"",
            "lab::occurrence",
            "`becomes` is missing",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "joint = \"elbow\", becomes = true",
            "lab::occurrence",
            "neither true nor false",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "joint = \"elbow\"",
            "lab::occurrence",
            "what its position `becomes`",
        ),
        (
            "sensor = \"stretched\", becomes = true",
            "joint = \"elbow\", body = \"can\", becomes = { below = 1.0 }",
            "lab::occurrence",
            "`body` has no meaning",
        ),
        (
            "{ event = \"moved\", body = \"can\" }, ",
            "{ event = \"moved\", touch = [\"arm\", \"can\"] }, ",
            "lab::occurrence",
            "one of",
        ),
        (
            "value = false }",
            "value = false, full = 0.5, zero = 1.0 }",
            "lab::sensor_reads",
            "right or wrong",
        ),
        (
            "value = 2.0236, full = 0.05, zero = 0.25",
            "value = true, full = 0.05, zero = 0.25",
            "lab::sensor_reads",
            "reads numbers",
        ),
        (
            "from_s = 0.5, to_s = 1.0",
            "from_s = 1.5, to_s = 1.0",
            "lab::sensor_reads",
            "before it begins",
        ),
        (
            "full = 0.1, zero = 0.0",
            "full = 0.0, zero = 0.1",
            "lab::band",
            "more is better",
        ),
        (
            "at_least = true, full_n_s = 0.02",
            "full_n_s = 0.02",
            "lab::band",
            "at_least = true",
        ),
        (
            "upright_deg = 20.0",
            "upright_deg = 0.0",
            "lab::body_reached",
            "above 0",
        ),
        (
            "upright_deg = 20.0",
            "turned_deg = 90.0",
            "lab::body_reached",
            "given together",
        ),
        (
            "upright_deg = 20.0",
            "turned_deg = 90.0, turned_within_deg = 45.0, turned_every_deg = 90.0",
            "lab::body_reached",
            "below 45",
        ),
        (
            "upright_deg = 20.0",
            "turned_deg = 400.0, turned_within_deg = 5.0",
            "lab::body_reached",
            "got 400",
        ),
        (
            "upright_deg = 20.0",
            "turned_deg = 90.0, turned_within_deg = 5.0, turned_every_deg = 0.0",
            "lab::body_reached",
            "got 0",
        ),
        (
            "sensor-reads = { sensor = \"stretched\", value = false }",
            "joint-speed = { from_s = 2.0, to_s = 1.0, full_rad_s = 1.0, zero_rad_s = 2.0 }",
            "lab::joint_speed",
            "before it begins",
        ),
    ];
    own_lab().is_refused(&tip("0.75"), &cases);
}

/// The can that is pushed along does not turn: a lab that asks for a quarter turn gives nothing for the place.
#[test]
fn a_body_may_have_to_be_turned() {
    let place = |keys: &str| {
        let lab = own_lab().with("lab.toml", "upright_deg = 20.0, ", keys);
        check(&lab.graded(&tip(GOOD), 1), "place").clone()
    };
    let any_way = place("")["points"].clone();
    let unturned = place("turned_deg = 0.0, turned_within_deg = 10.0, ");
    assert_eq!(unturned["points"], any_way, "{unturned}");
    assert!(any_way.as_f64() > Some(0.0), "{any_way}");
    let quarter = place("turned_deg = 90.0, turned_within_deg = 10.0, ");
    assert_eq!(quarter["points"], 0.0, "{quarter}");
    let words = message(&quarter);
    assert!(
        words.starts_with("`can` is turned by ")
            && words.ends_with(" it was to be turned by 90, to 10 degrees"),
        "{words}"
    );
    // after a quarter turn this can looks as before
    let same = place("turned_deg = 90.0, turned_within_deg = 10.0, turned_every_deg = 90.0, ");
    assert_eq!(same["points"], any_way, "{same}");
}

#[test]
fn a_joint_that_passes_a_position_happens_as_its_encoder_says() {
    let encoder = own_lab();
    let joint = own_lab().with(
        "lab.toml",
        "{ sensor = \"elbow_encoder\", becomes",
        "{ joint = \"elbow\", becomes",
    );
    for out in [GOOD, "0.75", "min(0.75 + 0.5 * max(t - 0.5, 0.0), 1.3)"] {
        let [read, passed] = [&encoder, &joint].map(|lab| {
            let task = lab.graded(&tip(out), 1);
            check(&task, "steps")["points"].clone()
        });
        assert_eq!(read, passed, "{out}");
    }
    let passed = own_lab().with(
        "lab.toml",
        "sensor = \"stretched\", becomes = true }",
        "joint = \"elbow\", becomes = { below = 1.9 } }",
    );
    let task = passed.graded(&tip(GOOD), 1);
    let words = message(check(&task, "unstretched"));
    assert!(
        words.starts_with("joint `elbow` falls below 1.9 rad at "),
        "{words}"
    );
}

#[test]
fn the_speed_at_which_a_switch_is_reached_may_count() {
    let lab = own_lab().with(
        "lab.toml",
        "sensor-reads = { sensor = \"stretched\", value = false }",
        "joint-speed = { joint = \"elbow\", at = { sensor = \"stretched\", becomes = true }, full_rad_s = 0.1, zero_rad_s = 10.0 }",
    );
    let over = lab.graded(&tip("min(0.75 + 0.5 * max(t - 0.5, 0.0), 1.3)"), 1);
    let pressed = check(&over, "pressed");
    let words = message(pressed);
    assert!(
        words.starts_with("joint `elbow` turns at ")
            && words.ends_with(" s, just before `stretched` becomes true"),
        "{words}"
    );
    // the elbow stretches while the hand goes out at 0.5 m/s
    let speed = pressed["measure"]["value"].as_f64().expect("a speed");
    assert!(speed > 0.3 && speed < 3.0, "{pressed}");

    let idle = lab.graded(&tip("0.75"), 1);
    let pressed = check(&idle, "pressed");
    assert_eq!(pressed["points"], 0.0, "{pressed}");
    assert_eq!(
        message(pressed),
        "the speed counts when `stretched` becomes true, and that never happens"
    );
}

#[test]
fn an_order_may_count_only_as_a_whole() {
    let whole = "order = { whole = true, events = [{ event = \"moved\", body = \"can\" }, ";
    let lab = own_lab().with("lab.toml", "order = { events = [", whole);
    let steps = check(&lab.graded(&tip(GOOD), 1), "steps").clone();
    assert_eq!(
        (&steps["measure"]["value"], &steps["points"]),
        (&0.0.into(), &0.0.into()),
        "{steps}"
    );
}
