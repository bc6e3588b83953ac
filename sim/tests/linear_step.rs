//! The linear step response against `tests/golden/B_linear_step.json`: partial fractions cross-checked there with python-control.

use kinemark_sim::control::linear_step::{Fed, LinearStep};

use crate::golden_rrbot::{golden, numbers};

/// The file's curves are rounded to ten digits, those that start at rest to about 1e-12.
const TOLERANCE: f64 = 2e-9;

#[test]
fn step_responses_are_those_of_partial_fractions() {
    let file = golden("B_linear_step.json");
    let mut compared = 0;
    for case in file["cases"].as_array().expect("cases") {
        let number = |key: &str| case[key].as_f64().expect("a number");
        for response in case["responses"].as_array().expect("responses") {
            let name = response["name"].as_str().expect("a name");
            let (fed, derivative_of_error, kd) = match name {
                "position_pid_D_on_error" => (Fed::Position, true, number("Kd")),
                "position_pid_D_on_measurement" => (Fed::Position, false, number("Kd")),
                "velocity_pid_D_on_error" => (Fed::Velocity, true, number("Kd")),
                "velocity_pid_D_on_measurement" => (Fed::Velocity, false, number("Kd")),
                "velocity_pi_Kd0" => (Fed::Velocity, true, 0.0),
                // functions of the document that are not closed loops from the reference
                _ => continue,
            };
            let of_joint = LinearStep {
                fed,
                inertia_kg_m2: number("J_kgm2"),
                damping_n_m_s: number("b"),
                kp: number("Kp"),
                ki: number("Ki"),
                kd,
                derivative_of_error,
            };
            assert!(of_joint.is_bounded(), "{name}");
            let curve = &response["curve"];
            let expected = numbers(&curve["y"]);
            let dt_s = curve["dt_s"].as_f64().expect("a number");
            let values = of_joint.response(dt_s, expected.len()).expect("finite");
            for (k, (value, expected)) in values.iter().zip(&expected).enumerate() {
                assert!(
                    (value - expected).abs() < TOLERANCE,
                    "{}, {name}, {k}: {value} against {expected}",
                    case["label"]
                );
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
}
