//! Trajectories that `kinemark robot eval` plans, against numbers worked by hand.

use serde_json::{Value, json};

use crate::eval::close;
use crate::eval_operations::mixed;

#[test]
fn trajectories_are_planned_to_the_numbers_of_hand() {
    let plan = |kind: &str, more: Value| {
        let mut request = json!({ "op": "trajectory", "kind": kind });
        for (key, value) in more.as_object().expect("fields") {
            request[key] = value.clone();
        }
        request
    };
    let pose = |x: f64, y: f64| json!({ "position_m": [x, y, 0.0] });
    let answers = mixed(&[
        plan(
            "quintic",
            json!({ "from": [0, 1], "to": [1, 0], "duration_s": 2, "at_s": [0, 1, 2, 3] }),
        ),
        plan(
            "cubic",
            json!({ "from": 0, "to": 1, "duration_s": 1, "at_s": [0.5] }),
        ),
        plan(
            "trapezoid",
            json!({ "from": 0, "to": 1, "speed": 1, "acceleration": 4, "at_s": [0.125] }),
        ),
        // seven phases, none of constant acceleration or speed: 4 (D / 2j)^(1/3)
        plan(
            "jerk-limited",
            json!({ "from": 0, "to": 2, "speed": 9, "acceleration": 9, "jerk": 1 }),
        ),
        plan(
            "spline",
            json!({ "points": [[0], [1], [0]], "times_s": [0, 1, 2], "at_s": [0.5, 1.0] }),
        ),
        plan(
            "line",
            json!({ "from": pose(0.0, 0.0), "to": pose(3.0, 4.0), "duration_s": 1, "at_s": [0.5] }),
        ),
        plan(
            "arc",
            json!({ "from": pose(1.0, 0.0), "via_m": [0, 1, 0], "to": pose(-1.0, 0.0), "law": "trapezoid", "speed": 1, "acceleration": 1, "at_s": [2.0] }),
        ),
        plan(
            "arc",
            json!({ "from": pose(1.0, 0.0), "via_m": [0, 0, 0], "to": pose(-1.0, 0.0), "duration_s": 1 }),
        ),
        plan("spline", json!({ "points": [[0], [1]], "times_s": [0, 0] })),
        plan("loop", json!({ "from": 0, "to": 1 })),
    ]);
    close(&answers[0]["q"][1], &json!([0.5, 0.5]), 1e-15, "half way");
    close(
        &answers[0]["qd"][1],
        &json!([0.9375, -0.9375]),
        1e-15,
        "15/8 D/T",
    );
    close(
        &answers[0]["q"][3],
        &json!([1.0, 0.0]),
        0.0,
        "after the end",
    );
    close(&answers[0]["qd"][3], &json!([0.0, 0.0]), 0.0, "at rest");
    close(&answers[1]["qd"][0], &json!([1.5]), 1e-15, "3/2 D/T");
    assert_eq!(answers[2]["duration_s"], 1.25);
    close(&answers[2]["q"][0], &json!([0.03125]), 1e-15, "a t² / 2");
    assert_eq!(answers[3]["duration_s"], 4.0);
    // at rest at both ends through a peak: 3 u² - 2 u³
    close(&answers[4]["q"][0], &json!([0.5]), 1e-15, "spline");
    close(&answers[4]["qd"][1], &json!([0.0]), 1e-15, "peak");
    assert_eq!(answers[5]["length_m"], 5.0);
    close(
        &answers[5]["position_m"][0],
        &json!([1.5, 2.0, 0.0]),
        1e-15,
        "line",
    );
    // half a circle at 1 m/s from rest: at 2 s the arc length is 1.5 m, towards the centre 1 m/s²
    let turned = 1.5_f64;
    let radial = [-libm_cos(turned), -libm_sin(turned), 0.0];
    close(
        &answers[6]["acceleration_m_s2"][0],
        &json!(radial),
        1e-12,
        "arc",
    );
    for refused in [&answers[7], &answers[8]] {
        assert_eq!(refused["error"]["code"], "cannot-plan");
    }
    assert_eq!(answers[9]["error"]["code"], "out-of-range");
}

/// Cosine and sine by their series: the tests link no `libm`.
fn libm_cos(x: f64) -> f64 {
    libm_sin(std::f64::consts::FRAC_PI_2 - x)
}

fn libm_sin(x: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    for k in 1..20 {
        let k = f64::from(2 * k);
        term *= -x * x / (k * (k + 1.0));
        sum += term;
    }
    sum
}
