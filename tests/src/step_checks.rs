//! Checks of step responses, efforts and smoothness: the linear prediction is what the simulator does where nothing but the loop acts,
//! gravity and gains that are too high are explained, and an impossible lab is refused with its position.

use crate::own_lab::{OwnLab, check, message, value};

/// The elbow of the course's arm, held upright; the forearm's inertia about the joint is m l² / 3 and a little.
const LAB: &str = r#"
format = 1
name = "91-step"
title = "Step"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "step"
title = "Half a radian"

[tasks.motion]
mode = "position"
duration_s = 2.0
target = [0.0, 0.5]
servo = { kp = [1000.0, 100.0], kd = [100.0, 10.0], derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[[tasks.checks]]
name = "rise"
title = "It rises"
points = 2.0
rise-time = { joint = "elbow", target_rad = 0.5, full_s = 0.3, zero_s = 1.0, prediction = { inertia = 0.1669, damping = 0.7, kp = 100.0, kd = 10.0, derivative = "measurement" } }

[[tasks.checks]]
name = "settle"
title = "It settles"
points = 2.0
settling-time = { joint = "elbow", target_rad = 0.5, full_s = 0.6, zero_s = 1.5, prediction = { inertia = 0.1669, damping = 0.7, kp = 100.0, kd = 10.0, derivative = "measurement" } }

[[tasks.checks]]
name = "past"
title = "Not past it"
points = 1.0
step-overshoot = { joint = "elbow", target_rad = 0.5, full = 0.05, zero = 0.3 }

[[tasks.checks]]
name = "exact"
title = "It gets there"
points = 2.0
steady-error = { joint = "elbow", target_rad = 0.5, full_rad = 0.002, zero_rad = 0.1 }

[[tasks.checks]]
name = "peak"
title = "No great effort"
points = 1.0
needs = ["rise"]
effort-peak = { joint = "elbow", full_n_m = 60.0, zero_n_m = 90.0 }

[[tasks.checks]]
name = "rms"
title = "Little effort"
points = 1.0
needs = ["rise"]
effort-rms = { joint = "elbow", full_n_m = 10.0, zero_n_m = 50.0 }

[[tasks.checks]]
name = "work"
title = "Little work"
points = 1.0
needs = ["rise"]
energy = { full_j = 20.0, zero_j = 80.0 }

[[tasks.checks]]
name = "smooth"
title = "Smooth"
points = 1.0
needs = ["rise"]
jerk = { full_m_s3 = 1e4, zero_m_s3 = 1e5 }

[[tasks.checks]]
name = "calm"
title = "No chatter"
points = 1.0
needs = ["rise"]
chatter = { joint = "elbow", full_hz = 10.0, zero_hz = 50.0 }
"#;

const STEP: &str = "fn control(observation) { [0.0, 0.5] }\n";

fn own_lab() -> OwnLab {
    OwnLab::new("91-step", LAB)
}

/// The lab in effort mode, without its servo; chatter is judged whatever the joint did.
fn effort_lab() -> OwnLab {
    let lab = own_lab();
    lab.edit("mode = \"position\"", "mode = \"effort\"");
    lab.edit("servo = { kp = [1000.0, 100.0], kd = [100.0, 10.0], derivative = \"velocity\", gravity_compensation = true,",
        "servo = {",
    );
    lab.edit("needs = [\"rise\"]\nchatter", "chatter");
    lab
}

#[test]
fn a_step_has_full_marks_and_its_prediction_beside_it() {
    let lab = own_lab();
    let task = lab.graded(STEP, 0);
    assert_eq!(task["points"], 12.0, "{task}");
    // real poles at 11.4 and 52.8 1/s: about the rise of the slow one, ln 9 / 11.4 s; the shoulder gives way a little
    let rise_s = value(&task, "rise");
    assert!((0.17..0.22).contains(&rise_s), "{rise_s}");
    assert!(value(&task, "past") < 0.03);
    // kp times the step at once
    assert!((value(&task, "peak") - 50.0).abs() < 0.1);
    for (name, words) in [
        ("rise", ["linear prediction", "10 % of the step"]),
        (
            "settle",
            ["linear prediction", "within 2 % of the final value"],
        ),
    ] {
        let svg = lab.written(&format!("plots/step-check-{name}.svg"));
        for word in words {
            assert!(svg.contains(word), "{name}: no {word:?}");
        }
    }
}

#[test]
fn an_arm_that_stays_earns_nothing() {
    let task = own_lab().graded("fn control(observation) { [0.0, 0.0] }\n", 1);
    assert_eq!(task["points"], 0.0, "{task}");
    let evidence = &check(&task, "rise")["evidence"];
    assert_eq!(
        [&evidence[0]["message"], &evidence[1]["message"]],
        [
            "`control` returns [0, 0] at every call, which is the angles at which the arm starts",
            "joint `elbow` ends where it began, at 0 rad; 0.5 rad was asked for",
        ]
    );
    for name in ["peak", "rms", "work", "smooth", "calm"] {
        assert_eq!(check(&task, name)["outcome"], "not-judged");
    }
}

#[test]
fn gravity_is_what_a_proportional_gain_leaves() {
    let lab = own_lab();
    lab.edit("gravity_compensation = true, ", "");
    let task = lab.graded(STEP, 1);
    let exact = check(&task, "exact");
    let words = message(exact);
    // 0.5 kg at half a metre, half a radian from upright: -1.18 N m, and the error that gives it
    assert!(
        words.contains(": gravity takes 1.2")
            && words.contains("and kp = 100 needs 0.012 rad of error"),
        "{words}"
    );
    let off = value(&task, "exact");
    assert!((off - 0.012).abs() < 5e-4, "{off}");
}

#[test]
fn a_feedback_too_strong_for_its_period_is_explained() {
    // a velocity gain that turns the motion round within a control period: kd T / J = 2.4 > 2
    let task = effort_lab().graded(
        "fn control(observation) {
    let e = 0.5 - observation.q[1];
    [-400.0 * observation.q[0] - 40.0 * observation.qd[0], 100.0 * e - 40.0 * observation.qd[1]]
}
",
        1,
    );
    let words = message(check(&task, "calm"));
    assert!(
        words.contains("turns round at every control period of 10 ms: the gains are too high"),
        "{words}"
    );
}

#[test]
fn a_check_of_what_cannot_be_is_refused_at_its_place() {
    let cases = [
        (
            "rise-time = { joint = \"elbow\"",
            "rise-time = { joint = \"elbo\"",
            "lab::unknown_joint",
            "did you mean `elbow`?",
        ),
        (
            "rise-time = { joint = \"elbow\"",
            "rise-time = { joint = \"elbow\", from = 0.9, to = 0.1",
            "lab::step",
            "must be below `to`",
        ),
        (
            "settling-time = { joint = \"elbow\"",
            "settling-time = { joint = \"elbow\", within = 2.0",
            "lab::step",
            "share of the step",
        ),
        (
            "rise-time = { joint = \"elbow\", target_rad = 0.5",
            "rise-time = { joint = \"elbow\"",
            "lab::step",
            "needs to know the step",
        ),
        (
            "rise-time = { joint = \"elbow\", target_rad = 0.5",
            "rise-time = { joint = \"elbow\", target_rad_s = 0.5",
            "lab::step",
            "write `target_rad`",
        ),
        (
            "steady-error = { joint = \"elbow\"",
            "steady-error = { joint = \"elbow\", last_s = 2.0",
            "lab::periods",
            "not shorter than the run",
        ),
        (
            "full_rad = 0.002",
            "full_rad_s = 0.002",
            "lab::step",
            "write `full_rad`",
        ),
        (
            "inertia = 0.1669",
            "inertia = 0.0",
            "lab::prediction",
            "must be positive",
        ),
        (
            "damping = 0.7, kp = 100.0, kd = 10.0",
            "damping = 0.7, kp = 1.0, ki = 1000.0",
            "lab::prediction",
            "unstable",
        ),
        ("full_j = 20.0", "full_j = 90.0", "lab::band", "at or below"),
    ];
    own_lab().is_refused(STEP, &cases);
}
