//! Step responses and their metrics against golden numbers, against textbook formulas, and by property.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot read its golden file fails"
)]
#![expect(
    clippy::float_cmp,
    reason = "what is compared with == is exact by construction"
)]

use std::f64::consts::PI;

use kinemark_reference::linear_response::{
    DerivativeOn, JointPlant, PidGains, PidLoop, StepMetrics, StepMetricsError, TransferFunction,
};
use proptest::prelude::*;
use serde_json::Value;

/// The curves of the golden file are written with ten digits.
const CURVE_TOLERANCE: f64 = 1e-9;
/// The file gives 15 digits of the gains and of the metrics.
const METRIC_TOLERANCE: f64 = 1e-8;

fn golden(file: &str) -> Value {
    let path = format!(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/{}"),
        file
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("not a number: {value}"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn function(numerator: &[f64], denominator: &[f64]) -> TransferFunction {
    TransferFunction::new(numerator, denominator).unwrap()
}

fn metrics(numerator: &[f64], denominator: &[f64]) -> StepMetrics {
    function(numerator, denominator).step_metrics().unwrap()
}

fn assert_near(what: &str, got: f64, expected: f64, tolerance: f64) {
    assert!(
        (got - expected).abs() <= tolerance,
        "{what}: got {got:.17}, expected {expected:.17}"
    );
}

/// The loop's function of that name, with the gains of the case.
fn loop_function(case: &Value, name: &str) -> TransferFunction {
    let pid = PidLoop {
        plant: JointPlant {
            inertia_kg_m2: number(&case["J_kgm2"]),
            damping_n_m_s: number(&case["b"]),
        },
        gains: PidGains {
            kp: number(&case["Kp"]),
            ki: number(&case["Ki"]),
            kd: number(&case["Kd"]),
        },
    };
    let without_kd = PidLoop {
        gains: PidGains {
            kd: 0.0,
            ..pid.gains
        },
        ..pid
    };
    match name {
        "position_pid_D_on_error" => pid.position_closed_loop(DerivativeOn::Error),
        "position_pid_D_on_measurement" => pid.position_closed_loop(DerivativeOn::Measurement),
        "eq6_as_printed" => pid.equation_6_as_printed(),
        "velocity_pid_D_on_error" => pid.velocity_closed_loop(DerivativeOn::Error),
        "velocity_pid_D_on_measurement" => pid.velocity_closed_loop(DerivativeOn::Measurement),
        "velocity_pi_Kd0" => without_kd.velocity_closed_loop(DerivativeOn::Error),
        "eq7_as_printed" => pid.equation_7_as_printed(),
        "disturbance_torque_to_position" => pid.disturbance_to_position(),
        other => panic!("no loop called {other}"),
    }
    .unwrap()
}

/// Each golden response with its label and the function made from the gains.
fn for_each_response(mut check: impl FnMut(&str, &Value, &TransferFunction)) {
    let golden = golden("B_linear_step.json");
    let mut count = 0;
    for case in golden["cases"].as_array().unwrap() {
        for response in case["responses"].as_array().unwrap() {
            let name = response["name"].as_str().unwrap();
            let label = format!("{}, {name}", case["label"].as_str().unwrap());
            check(&label, response, &loop_function(case, name));
            count += 1;
        }
    }
    assert_eq!(count, 32);
}

#[test]
fn golden_coefficients_poles_and_zeros() {
    for_each_response(|label, response, function| {
        // given with 15 digits
        for (got, key) in [
            (function.numerator(), "numerator"),
            (function.denominator(), "denominator"),
        ] {
            let expected = numbers(&response[key]);
            assert_eq!(got.len(), expected.len(), "{label}, {key}");
            for (got, expected) in got.iter().zip(expected) {
                assert_near(label, *got, expected, 1e-14 * expected.abs());
            }
        }
        for (got, re, im) in [
            (function.poles(), "poles_re", "poles_im"),
            (function.zeros(), "zeros_re", "zeros_im"),
        ] {
            let expected: Vec<_> = numbers(&response[re])
                .into_iter()
                .zip(numbers(&response[im]))
                .collect();
            assert_eq!(got.len(), expected.len(), "{label}, {re}");
            for (got, (re, im)) in got.iter().zip(expected) {
                // The file's own small roots are rounded against its large ones.
                assert_near(label, got.re, re, 1e-12 * (1.0 + re.abs()));
                assert_near(label, got.im, im, 1e-12 * (1.0 + im.abs()));
            }
        }
        assert_near(
            label,
            function.dc_gain().unwrap(),
            number(&response["dcgain"]),
            1e-14,
        );
        assert_near(
            label,
            function.value_at_0plus(),
            number(&response["value_at_0plus"]),
            1e-14,
        );
    });
}

#[test]
fn golden_curves() {
    for_each_response(|label, response, function| {
        let step = function.step_response();
        let (t0_s, dt_s) = (
            number(&response["curve"]["t0_s"]),
            number(&response["curve"]["dt_s"]),
        );
        let y = numbers(&response["curve"]["y"]);
        assert_eq!(y.len(), 601, "{label}");
        for (k, expected) in y.into_iter().enumerate() {
            let t_s = t0_s + k as f64 * dt_s;
            assert_near(
                &format!("{label} at {t_s} s"),
                step.value(t_s),
                expected,
                CURVE_TOLERANCE,
            );
        }
    });
}

#[test]
fn golden_exact_metrics() {
    let mut judged = 0;
    for_each_response(|label, response, function| {
        let expected = &response["stepinfo_exact"];
        if expected.get("note").is_some() {
            assert_eq!(
                function.step_metrics(),
                Err(StepMetricsError::SteadyStateIsZero),
                "{label}"
            );
            return;
        }
        let got = function.step_metrics().unwrap();
        for (key, got) in [
            ("rise_time_10_90_s", got.rise_time_10_90_s),
            ("t10_s", got.t10_s),
            ("t90_s", got.t90_s),
            ("settling_time_2pct_s", got.settling_time_2pct_s),
            ("settling_time_5pct_s", got.settling_time_5pct_s),
            ("overshoot_pct", got.overshoot_pct),
            ("undershoot_pct", got.undershoot_pct),
            ("peak", got.peak),
            ("steady_state_value", got.steady_state),
            ("value_at_0plus", got.value_at_0plus),
        ] {
            assert_near(
                &format!("{label}, {key}"),
                got,
                number(&expected[key]),
                METRIC_TOLERANCE,
            );
        }
        let peak_time = expected["peak_time_s"].as_f64();
        assert_eq!(
            got.peak_time_s.is_some(),
            peak_time.is_some(),
            "{label}: {got:?}"
        );
        if let (Some(own), Some(expected)) = (got.peak_time_s, peak_time) {
            // The file's peak times are where the curve is highest in doubles, up to 9e-5 s from where its slope is zero
            // (step_metrics_mpmath.json has that). Both times must be as high, to a few last places of a double.
            let height = function.step_response().value(expected);
            assert_near(
                &format!("{label}, height at peak_time_s"),
                height,
                got.peak,
                4.0 * f64::EPSILON,
            );
            assert_near(&format!("{label}, peak_time_s"), own, expected, 1e-4);
        }
        judged += 1;
    });
    assert_eq!(judged, 20);
}

#[test]
fn exact_metrics_of_other_gains_and_inertias() {
    let golden = golden("step_metrics_mpmath.json");
    let relative = number(&golden["rel_tolerance"]);
    let mut judged = 0;
    for case in golden["cases"].as_array().unwrap() {
        for response in case["responses"].as_array().unwrap() {
            let name = response["name"].as_str().unwrap();
            let got = loop_function(case, name).step_metrics().unwrap();
            let label = format!(
                "{name} of {} {} {} {} {}",
                case["J_kgm2"], case["b"], case["Kp"], case["Ki"], case["Kd"]
            );
            for (key, got) in [
                ("t10_s", got.t10_s),
                ("t90_s", got.t90_s),
                ("settling_time_2pct_s", got.settling_time_2pct_s),
                ("settling_time_5pct_s", got.settling_time_5pct_s),
            ] {
                let expected = number(&response[key]);
                assert_near(
                    &format!("{label}, {key}"),
                    got,
                    expected,
                    relative * expected,
                );
            }
            // relative to the steady state, which is 1
            for (key, got) in [
                ("value_at_0plus", got.value_at_0plus),
                ("overshoot_pct", got.overshoot_pct / 100.0),
                ("undershoot_pct", got.undershoot_pct / 100.0),
            ] {
                let expected =
                    number(&response[key]) / if key.ends_with("pct") { 100.0 } else { 1.0 };
                assert_near(&format!("{label}, {key}"), got, expected, 1e-14);
            }
            let peak_time = response["peak_time_s"].as_f64();
            assert_eq!(
                got.peak_time_s.is_some(),
                peak_time.is_some(),
                "{label}: {got:?}"
            );
            if let (Some(got), Some(expected)) = (got.peak_time_s, peak_time) {
                assert_near(
                    &format!("{label}, peak_time_s"),
                    got,
                    expected,
                    relative * expected,
                );
            }
            judged += 1;
        }
    }
    assert_eq!(judged, 96);
}

#[test]
fn printed_equations_6_and_7_are_one_minus_the_closed_loop() {
    let pid = PidLoop {
        plant: JointPlant {
            inertia_kg_m2: 1.0 / 6.0,
            damping_n_m_s: 0.7,
        },
        gains: PidGains {
            kp: 100.0,
            ki: 0.01,
            kd: 10.0,
        },
    };
    for (printed, closed) in [
        (
            pid.equation_6_as_printed(),
            pid.position_closed_loop(DerivativeOn::Error),
        ),
        (
            pid.equation_7_as_printed(),
            pid.velocity_closed_loop(DerivativeOn::Error),
        ),
    ] {
        let (printed, closed) = (
            printed.unwrap().step_response(),
            closed.unwrap().step_response(),
        );
        assert_eq!(printed.steady_state(), Some(0.0));
        for t_s in [0.0, 1e-3, 0.1, 2.0, 1e3, 1e5] {
            assert_near("T + S", printed.value(t_s) + closed.value(t_s), 1.0, 1e-13);
        }
    }
}

#[test]
fn the_labs_velocity_loop_jumps_then_creeps_for_hours() {
    // errata 003-04 and 003-05: 98.36 % at once, 99.31 % within a second, the rest with a time constant of 1.007e4 s
    let pid = PidLoop {
        plant: JointPlant {
            inertia_kg_m2: 1.0 / 6.0,
            damping_n_m_s: 0.7,
        },
        gains: PidGains {
            kp: 100.0,
            ki: 0.01,
            kd: 10.0,
        },
    };
    let loop_ = pid.velocity_closed_loop(DerivativeOn::Error).unwrap();
    let step = loop_.step_response();
    assert_near("at once", step.value(0.0), 10.0 / (10.0 + 1.0 / 6.0), 1e-15);
    assert_near("within a second", step.value(1.0), 100.0 / 100.7, 2e-6);
    assert_near(
        "after hours",
        step.value(1.007e4),
        1.0 - 0.00695 * libm::exp(-1.0),
        1e-5,
    );
    assert_eq!(loop_.step_metrics().unwrap().settling_time_2pct_s, 0.0);
}

#[test]
fn without_an_integral_gain_the_loop_is_one_order_lower() {
    let pid = PidLoop {
        plant: JointPlant {
            inertia_kg_m2: 0.5,
            damping_n_m_s: 0.7,
        },
        gains: PidGains {
            kp: 8.0,
            ki: 0.0,
            kd: 1.3,
        },
    };
    let position = pid.position_closed_loop(DerivativeOn::Measurement).unwrap();
    assert_eq!(position.denominator(), [0.5, 2.0, 8.0]);
    assert_eq!(position.step_response().steady_state(), Some(1.0));
    // A torque then leaves an offset of 1/Kp.
    let disturbance = pid.disturbance_to_position().unwrap().step_response();
    assert_eq!(disturbance.steady_state(), Some(0.125));
    // 8/(s+…) against damping: P control of velocity falls short of its reference.
    let velocity = pid.velocity_closed_loop(DerivativeOn::Measurement).unwrap();
    assert_near(
        "velocity",
        velocity.step_response().steady_state().unwrap(),
        8.0 / 8.7,
        1e-15,
    );
    assert_eq!(
        pid.disturbance_to_velocity().unwrap().denominator(),
        [1.8, 8.7]
    );
}

#[test]
fn a_first_order_lag_of_any_time_constant() {
    for tau_s in [1e-6, 0.1, 1.0, 1e4, 1e9] {
        let got = metrics(&[3.0], &[tau_s, 1.0]);
        let relative = 1e-13 * tau_s;
        assert_near("t10", got.t10_s, -tau_s * libm::log(0.9), relative);
        assert_near(
            "rise",
            got.rise_time_10_90_s,
            tau_s * libm::log(9.0),
            relative,
        );
        assert_near(
            "2 %",
            got.settling_time_2pct_s,
            tau_s * libm::log(50.0),
            relative,
        );
        assert_near(
            "5 %",
            got.settling_time_5pct_s,
            tau_s * libm::log(20.0),
            relative,
        );
        assert_eq!(
            (got.overshoot_pct, got.undershoot_pct, got.peak),
            (0.0, 0.0, 3.0)
        );
        assert_eq!(got.peak_time_s, None);
    }
}

#[test]
fn a_second_order_system_of_any_damping() {
    // Textbook: overshoot e^{-πζ/√(1-ζ²)} at π/(ω√(1-ζ²)).
    for (zeta, omega) in [
        (1e-6, 1.0),
        (1e-3, 40.0),
        (0.1, 1e-4),
        (0.5, 7.0),
        (0.9, 1e3),
    ] {
        let got = metrics(&[omega * omega], &[1.0, 2.0 * zeta * omega, omega * omega]);
        let root = libm::sqrt(1.0 - zeta * zeta);
        let overshoot_pct = 100.0 * libm::exp(-PI * zeta / root);
        assert_near("overshoot", got.overshoot_pct, overshoot_pct, 1e-10);
        let peak_time_s = PI / (omega * root);
        assert_near(
            "peak time",
            got.peak_time_s.unwrap(),
            peak_time_s,
            1e-9 * peak_time_s,
        );
        // Between the last two extrema outside the band, the envelope crosses it.
        let envelope_s = libm::log(50.0 / root) / (zeta * omega);
        assert!(
            got.settling_time_2pct_s <= envelope_s * (1.0 + 1e-12),
            "ζ={zeta}: {got:?}"
        );
        assert!(
            got.settling_time_2pct_s >= envelope_s - PI / (omega * root),
            "ζ={zeta}: {got:?}"
        );
    }
}

#[test]
fn critical_damping_has_no_overshoot() {
    // y = 1 - (1 + x) e^{-x}, x = ωt; the levels from (1 + x) e^{-x} = 0.9, 0.1, 0.02 by an independent bisection
    let level = |remaining: f64| {
        let (mut low, mut high) = (0.0, 50.0);
        for _ in 0..200 {
            let x = 0.5 * (low + high);
            if (1.0 + x) * libm::exp(-x) > remaining {
                low = x
            } else {
                high = x
            }
        }
        low
    };
    for omega in [1e-4, 10.0, 3e3] {
        let got = metrics(&[omega * omega], &[1.0, 2.0 * omega, omega * omega]);
        assert_eq!(
            (got.overshoot_pct, got.peak_time_s),
            (0.0, None),
            "ω={omega}"
        );
        assert_near("t10", got.t10_s * omega, level(0.9), 1e-12);
        assert_near("t90", got.t90_s * omega, level(0.1), 1e-12);
        assert_near("2 %", got.settling_time_2pct_s * omega, level(0.02), 1e-12);
    }
}

#[test]
fn a_slow_tail_from_above_settles_after_hours() {
    // y = 1 - 1.1 e^{-10t} + 0.1 e^{-t/10⁴}: peak at e^{(10 - 1e-4)t} = 11/1e-5, then a creep back over 10⁴ s
    let (fast, slow) = (10.0, 1e-4);
    let numerator = [1.1 * fast - 0.1 * slow, fast * slow];
    let got = metrics(&numerator, &[1.0, fast + slow, fast * slow]);
    let peak_time_s = libm::log(1.1 * fast / (0.1 * slow)) / (fast - slow);
    assert_near("peak time", got.peak_time_s.unwrap(), peak_time_s, 1e-9);
    let excess = 0.1 * libm::exp(-slow * peak_time_s) - 1.1 * libm::exp(-fast * peak_time_s);
    assert_near("overshoot", got.overshoot_pct, 100.0 * excess, 1e-9);
    assert_near("2 %", got.settling_time_2pct_s, 1e4 * libm::log(5.0), 1e-6);
    assert_near("5 %", got.settling_time_5pct_s, 1e4 * libm::log(2.0), 1e-6);
}

#[test]
fn a_narrow_spike_is_not_missed() {
    // A fast pair of 10⁶ rad/s rings for microseconds on top of a response of seconds.
    let omega = 1e6;
    let (slow, zeta) = (1.0, 0.1);
    // 1/(s + 1) + 0.3 ω s/(s² + 2ζωs + ω²), over one denominator
    let numerator = [
        1.0 + 0.3 * omega,
        2.0 * zeta * omega + 0.3 * omega * slow,
        omega * omega,
    ];
    let pair = [1.0, 2.0 * zeta * omega, omega * omega];
    let denominator = [
        pair[0],
        pair[1] + slow,
        pair[2] + pair[1] * slow,
        pair[2] * slow,
    ];
    let got = metrics(&numerator, &denominator);
    let damped = omega * libm::sqrt(1.0 - zeta * zeta);
    let spike =
        |t: f64| 0.3 * omega / damped * libm::exp(-zeta * omega * t) * libm::sin(damped * t);
    // First 10 % is in the spike's first rise, within its first quarter turn.
    assert!(got.t10_s < PI / 2.0 / damped, "{got:?}");
    assert_near(
        "t10",
        spike(got.t10_s) + 1.0 - libm::exp(-got.t10_s),
        0.1,
        1e-9,
    );
    assert!(got.t90_s > 2.0 && got.t90_s < 2.4, "{got:?}");
    // and its swing below zero is the undershoot
    let trough_s = (PI + libm::acos(zeta)) / damped;
    assert_near(
        "undershoot",
        got.undershoot_pct,
        -100.0 * (spike(trough_s) + trough_s),
        1e-3,
    );
}

#[test]
fn direct_feedthrough_starts_above_zero() {
    // (2s + 1)/(s + 1): 1 + e^{-t}, whose peak is at the step itself
    let got = metrics(&[2.0, 1.0], &[1.0, 1.0]);
    assert_eq!(
        (got.t10_s, got.t90_s, got.rise_time_10_90_s),
        (0.0, 0.0, 0.0)
    );
    assert_eq!((got.value_at_0plus, got.peak_time_s), (2.0, Some(0.0)));
    assert_near("overshoot", got.overshoot_pct, 100.0, 1e-12);
    assert_near("2 %", got.settling_time_2pct_s, libm::log(50.0), 1e-13);
}

#[test]
fn a_zero_on_the_right_undershoots() {
    // (1 - s)/(s + 1)²: y = 1 - e^{-t}(1 + 2t), lowest at t = 1/2 with 1 - 2 e^{-1/2}
    let got = metrics(&[-1.0, 1.0], &[1.0, 2.0, 1.0]);
    assert_near(
        "undershoot",
        got.undershoot_pct,
        100.0 * (2.0 * libm::exp(-0.5) - 1.0),
        1e-12,
    );
    assert_eq!((got.overshoot_pct, got.peak_time_s), (0.0, None));
    // the all-pass (1 - s)/(1 + s) starts at -1
    let all_pass = metrics(&[-1.0, 1.0], &[1.0, 1.0]);
    assert_near("undershoot", all_pass.undershoot_pct, 100.0, 1e-12);
    assert_eq!(all_pass.value_at_0plus, -1.0);
}

#[test]
fn a_negative_gain_is_the_mirror_image() {
    let (up, down) = (
        metrics(&[5.0], &[1.0, 1.0, 5.0]),
        metrics(&[-5.0], &[1.0, 1.0, 5.0]),
    );
    assert_eq!((down.peak, down.steady_state), (-up.peak, -1.0));
    assert_eq!(
        StepMetrics {
            peak: up.peak,
            steady_state: 1.0,
            value_at_0plus: 0.0,
            ..down
        },
        up
    );
}

#[test]
fn a_gain_alone_is_settled_at_once() {
    let got = metrics(&[3.0], &[2.0]);
    assert_eq!(
        (
            got.t90_s,
            got.settling_time_2pct_s,
            got.peak,
            got.peak_time_s
        ),
        (0.0, 0.0, 1.5, None)
    );
}

#[test]
fn no_metrics_without_a_steady_state() {
    for denominator in [
        vec![1.0, 0.0],
        vec![1.0, 0.0, 4.0],
        vec![1.0, -1.0],
        vec![1.0, -0.1, 4.0],
    ] {
        let error = function(&[1.0], &denominator).step_metrics().unwrap_err();
        assert!(
            matches!(error, StepMetricsError::NotStable { pole } if pole.re >= 0.0),
            "{error}"
        );
    }
}

/// Stable real or paired poles between 10⁻⁴ and 10³ per second, often close together or equal.
fn poles() -> impl Strategy<Value = Vec<f64>> {
    let size = (-4.0..3.0f64).prop_map(libm::exp10);
    let ratio = prop_oneof![
        Just(1.0),
        0.9..1.1f64,
        (-9.0..-2.0f64).prop_map(|d| 1.0 + libm::exp10(d)),
        0.01..100.0f64
    ];
    let factor = prop_oneof![
        // (s + p)(s + r p)
        (size.clone(), ratio).prop_map(|(p, r)| vec![1.0, p + r * p, r * p * p]),
        // a pair of damping ratio ζ
        (size.clone(), 0.01..1.0f64).prop_map(|(w, zeta)| vec![1.0, 2.0 * zeta * w, w * w]),
        size.prop_map(|p| vec![1.0, p]),
    ];
    prop::collection::vec(factor, 1..3).prop_map(|factors| {
        factors
            .into_iter()
            .fold(vec![1.0], |product, factor| times(&product, &factor))
    })
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_response_solves_its_differential_equation(
        denominator in poles(), zero in -3.0..3.0f64, t in 0.01..3.0f64,
    ) {
        // classical Runge-Kutta on the controllable form, in units of the fastest coefficient's time
        let n = denominator.len() - 1;
        let dc = denominator[n];
        let numerator = if n > 1 { vec![zero * dc / libm::pow(dc, 1.0 / n as f64), dc] } else { vec![dc] };
        let step = function(&numerator, &denominator).step_response();
        let fastest = function(&numerator, &denominator).poles().iter().map(|p| libm::hypot(p.re, p.im)).fold(0.0, f64::max);
        let (end, steps) = (t / fastest, 300);
        let h = end / steps as f64;
        let rate = |x: &[f64]| -> Vec<f64> {
            let mut dx: Vec<f64> = x[1..].to_vec();
            dx.push(1.0 - (0..n).map(|k| denominator[n - k] * x[k]).sum::<f64>());
            dx
        };
        let moved = |x: &[f64], dx: &[f64], dt: f64| -> Vec<f64> { x.iter().zip(dx).map(|(a, b)| a + dt * b).collect() };
        let mut x = vec![0.0; n];
        for _ in 0..steps {
            let k1 = rate(&x);
            let k2 = rate(&moved(&x, &k1, h / 2.0));
            let k3 = rate(&moved(&x, &k2, h / 2.0));
            let k4 = rate(&moved(&x, &k3, h));
            for i in 0..n {
                x[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
        let expected: f64 = numerator.iter().rev().zip(&x).map(|(b, x)| b * x).sum();
        // truncation of the integration, (0.01)⁴ of the fastest motion
        let size = 1.0 + zero.abs();
        prop_assert!((step.value(end) - expected).abs() < 1e-8 * size, "{} {expected}", step.value(end));
    }

    #[test]
    fn metrics_agree_with_a_fine_grid(denominator in poles(), zero in -3.0..3.0f64) {
        let n = denominator.len() - 1;
        let dc = denominator[n];
        let numerator = if n > 1 { vec![zero * dc / libm::pow(dc, 1.0 / n as f64), dc] } else { vec![dc] };
        let function = function(&numerator, &denominator);
        let (step, got) = (function.step_response(), function.step_metrics().unwrap());

        // each metric is what it says, at the time it says
        let at = |t: f64| step.value(t);
        prop_assert!(got.t10_s <= got.t90_s);
        prop_assert!((at(got.t10_s) - 0.1).abs() < 1e-11, "{got:?}");
        prop_assert!((at(got.t90_s) - 0.9).abs() < 1e-11, "{got:?}");
        prop_assert!(((at(got.settling_time_2pct_s) - 1.0).abs() - 0.02).abs() < 1e-11, "{got:?}");
        prop_assert!(((at(got.settling_time_5pct_s) - 1.0).abs() - 0.05).abs() < 1e-11, "{got:?}");
        if let Some(peak_time_s) = got.peak_time_s {
            prop_assert!((at(peak_time_s) - got.peak).abs() < 1e-11, "{got:?}");
        }

        // and no point of a grid, dense where the curve is fast, contradicts it
        let slowest = function.poles().iter().map(|p| -p.re).fold(f64::INFINITY, f64::min);
        let fastest = function.poles().iter().map(|p| libm::hypot(p.re, p.im)).fold(0.0, f64::max);
        let growth = libm::pow(40.0 * fastest / slowest * 1e3, 1.0 / 3000.0);
        let mut t = 1e-3 / fastest;
        for _ in 0..3000 {
            let y = at(t);
            prop_assert!(y <= got.peak + 1e-12, "{t} {y} {got:?}");
            prop_assert!(y >= -got.undershoot_pct / 100.0 - 1e-12, "{t} {y} {got:?}");
            prop_assert!(t >= got.t10_s * (1.0 - 1e-9) || y < 0.1 + 1e-12, "{t} {y} {got:?}");
            prop_assert!(t >= got.t90_s * (1.0 - 1e-9) || y < 0.9 + 1e-12, "{t} {y} {got:?}");
            prop_assert!(t <= got.settling_time_2pct_s * (1.0 + 1e-9) || (y - 1.0).abs() < 0.02 + 1e-12, "{t} {y} {got:?}");
            prop_assert!(t <= got.settling_time_5pct_s * (1.0 + 1e-9) || (y - 1.0).abs() < 0.05 + 1e-12, "{t} {y} {got:?}");
            t *= growth;
        }
    }

    #[test]
    fn slope_is_the_derivative(denominator in poles(), at in 0.1..5.0f64) {
        let dc = denominator[denominator.len() - 1];
        let function = function(&[dc], &denominator);
        let step = function.step_response();
        let fastest = function.poles().iter().map(|p| libm::hypot(p.re, p.im)).fold(0.0, f64::max);
        // truncation (1e-4)² / 6, round-off 1e-14 / 1e-4
        let (t, h) = (at / fastest, 1e-4 / fastest);
        let quotient = (step.value(t + h) - step.value(t - h)) / (2.0 * h);
        prop_assert!((step.slope(t) - quotient).abs() < 1e-8 * fastest, "{} {quotient}", step.slope(t));
    }
}
