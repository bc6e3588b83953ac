//! What checks say of a joint that slides: m, m/s and N.

use super::Finding;
use super::by_hand::{HandRow, judged_sliding};

const EFFORT: &str = "mode = \"effort\"\nduration_s = 2.0";

/// The elbow slides 0.4 m in a second and stays; its motor gives -3 N.
fn out(t_s: f64) -> HandRow {
    let moves = if t_s < 1.0 { 0.4 } else { 0.0 };
    HandRow {
        q: [0.0, 0.4 * t_s.min(1.0)],
        qd: [0.0, moves],
        effort: [0.0, -3.0],
        ..HandRow::default()
    }
}

fn units(finding: &Finding) -> [&str; 2] {
    [
        finding.measure.as_ref().expect("a measure").unit.as_str(),
        finding.evidence[0].unit.as_str(),
    ]
}

#[test]
fn positions_are_in_metres() {
    let kind = "joint-reached = { joint = \"elbow\", position_rad = 0.5, hold_s = 0.5, full_rad = 0.0, zero_rad = 1.0 }";
    let finding = judged_sliding(EFFORT, kind, out);
    assert_eq!(
        finding.evidence[0].message,
        "joint `elbow` is 0.1 m from 0.5 m at 2 s, within the last 0.5 s that count"
    );
    assert_eq!(units(&finding), ["m", "m"]);
    let kind = "joint-limits = { full_rad = 0.0, zero_rad = 1.0 }";
    let far = |t_s: f64| HandRow {
        q: [0.0, 6.3 + 0.1 * t_s],
        ..HandRow::default()
    };
    let finding = judged_sliding(EFFORT, kind, far);
    let message = &finding.evidence[0].message;
    assert!(message.contains("is 0.2 m beyond"), "{message}");
    assert_eq!(units(&finding), ["m", "m"]);
    assert_eq!(finding.next_step, "Take positions between the limits.");
}

#[test]
fn speeds_are_in_metres_per_second() {
    let kind = "joint-speed = { full_rad_s = 0.1, zero_rad_s = 1.0 }";
    let finding = judged_sliding(EFFORT, kind, out);
    assert_eq!(
        finding.evidence[0].message,
        "joint `elbow` slides at 0.4 m/s at 0 s; 0.1 m/s are first passed at 0 s"
    );
    assert_eq!(units(&finding), ["m/s", "m/s"]);
    // the curve is that of whichever joint is fastest
    assert_eq!(finding.curve.expect("a curve").unit, "rad/s or m/s");
}

#[test]
fn efforts_are_in_newtons() {
    for (kind, words) in [
        (
            "effort-peak = { full_n_m = 1.0, zero_n_m = 9.0 }",
            "is -3 N at 0 s",
        ),
        (
            "effort-rms = { full_n_m = 1.0, zero_n_m = 9.0 }",
            "of 3 N over the run",
        ),
    ] {
        let finding = judged_sliding(EFFORT, kind, out);
        let message = &finding.evidence[0].message;
        assert!(message.contains(words), "{message}");
        assert_eq!(units(&finding), ["N", "N"]);
        assert_eq!(finding.curve.expect("a curve").unit, "N");
    }
}

#[test]
fn a_step_is_in_metres_and_its_error_has_a_force_for_reason() {
    let kind = "rise-time = { joint = \"elbow\", target_rad = 0.4, full_s = 0.1, zero_s = 1.0 }";
    let quantity = judged_sliding(EFFORT, kind, out)
        .measure
        .expect("a measure");
    assert!(
        quantity.quantity.ends_with("its step of 0.4 m"),
        "{quantity:?}"
    );
    // 0.5 kg straight up takes 4.905 N, as long as the forearm stands on the upper arm
    let kind =
        "steady-error = { joint = \"elbow\", target_rad = 0.5, full_rad = 0.0, zero_rad = 1.0 }";
    let held = |t_s: f64| HandRow {
        effort: [0.0, 4.905],
        ..out(t_s)
    };
    let finding = judged_sliding(EFFORT, kind, held);
    assert_eq!(
        finding.evidence[0].message,
        "joint `elbow` settles at 0.4 m, 0.1 m from 0.5 m: gravity takes 4.905 N there; \
         the motor gives 4.905 N with 0.1 m of error: as a proportional gain of 49.05 would"
    );
    assert_eq!(units(&finding), ["m", "m"]);
}
