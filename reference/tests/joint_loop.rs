//! The loops of one joint: their poles make their coefficients again, their responses are those of textbooks and of the motion itself.

use std::f64::consts::PI;

use kinemark_reference::joint_loop::{DerivativeOn, JointPlant, PidGains, PidLoop};
use proptest::prelude::*;

fn pid(inertia_kg_m2: f64, damping_n_m_s: f64, [kp, ki, kd]: [f64; 3]) -> PidLoop {
    PidLoop {
        plant: JointPlant {
            inertia_kg_m2,
            damping_n_m_s,
        },
        gains: PidGains { kp, ki, kd },
    }
}

fn near(what: &str, got: f64, expected: f64, tolerance: f64) {
    assert!(
        (got - expected).abs() <= tolerance,
        "{what}: got {got:.17}, expected {expected:.17}"
    );
}

#[test]
fn a_velocity_loop_without_integral_is_a_lag() {
    for (inertia, kp) in [(1e-4, 3.0), (1.0 / 6.0, 100.0), (40.0, 0.5)] {
        let closed = pid(inertia, 0.7, [kp, 0.0, 0.0]).velocity_closed_loop(DerivativeOn::Error);
        let (rate, gain) = ((0.7 + kp) / inertia, kp / (0.7 + kp));
        near("pole", closed.poles()[0].re, -rate, 1e-15 * rate);
        near("gain", closed.dc_gain().expect("it settles"), gain, 1e-15);
        let response = closed.step_response().expect("one pole");
        for turns in [0.0, 1e-3, 0.5, 7.0] {
            let expected = -gain * libm::expm1(-turns);
            near("response", response.at(turns / rate), expected, 1e-15);
        }
    }
}

#[test]
fn a_position_loop_without_integral_overshoots_as_the_textbook_says() {
    // overshoot e^{-πζ/√(1-ζ²)} at π/(ω√(1-ζ²)), where the response is flat
    for (zeta, omega) in [(1e-3, 40.0), (0.1, 1e-2), (0.5, 7.0), (0.9, 1e3)] {
        let gains = [omega * omega, 0.0, 2.0 * zeta * omega];
        let closed = pid(1.0, 0.0, gains).position_closed_loop(DerivativeOn::Measurement);
        let response = closed.step_response().expect("two poles");
        let root = libm::sqrt(1.0 - zeta * zeta);
        let peak_s = PI / (omega * root);
        near("start", response.at(0.0), 0.0, response.round_off());
        let peak = 1.0 + libm::exp(-PI * zeta / root);
        near("peak", response.at(peak_s), peak, response.round_off());
        for beside in [0.99, 1.01] {
            assert!(response.at(beside * peak_s) < peak);
        }
    }
}

#[test]
fn a_lasting_torque_leaves_an_error_of_its_share_of_the_gain_and_none_with_an_integral() {
    let left = |ki| {
        pid(0.5, 0.7, [8.0, ki, 1.3])
            .disturbance_to_position()
            .dc_gain()
    };
    assert_eq!((left(0.0), left(0.1)), (Some(0.125), Some(0.0)));
    // a joint that nothing holds runs away
    let free = pid(0.5, 0.7, [0.0, 0.0, 1.3]).disturbance_to_position();
    assert_eq!((free.dc_gain(), free.step_response()), (None, None));
}

#[test]
fn the_labs_velocity_loop_jumps_then_creeps_for_hours() {
    // errata 003-04 and 003-05: 98.36 % at once, 99.31 % within a second, the rest with a time constant of 1.007e4 s
    let lab = pid(1.0 / 6.0, 0.7, [100.0, 0.01, 10.0]);
    let response = lab
        .velocity_closed_loop(DerivativeOn::Error)
        .step_response()
        .expect("two poles");
    near(
        "at once",
        response.at(0.0),
        10.0 / (10.0 + 1.0 / 6.0),
        1e-15,
    );
    near("within a second", response.at(1.0), 100.0 / 100.7, 2e-6);
    near(
        "after hours",
        response.at(1.007e4),
        1.0 - 0.00695 * libm::exp(-1.0),
        1e-5,
    );
}

#[test]
fn two_equal_poles_have_no_single_fractions() {
    let critical = pid(1.0, 0.0, [4.0, 0.0, 4.0]).position_closed_loop(DerivativeOn::Measurement);
    assert!(
        critical
            .poles()
            .iter()
            .all(|pole| pole.re.to_bits() == (-2.0_f64).to_bits() && pole.im.abs() <= 0.0)
    );
    assert_eq!(critical.step_response(), None);
}

/// Coefficients of the monic denominator from its poles agree with the gains to `1e-13` of what they are sums of.
fn poles_give_the_denominator(inertia: f64, damping: f64, gains: [f64; 3]) -> Result<(), String> {
    let [kp, ki, kd] = gains;
    let closed = pid(inertia, damping, gains).position_closed_loop(DerivativeOn::Error);
    let [p, q, r] = closed.poles() else {
        return Err(format!("not three poles: {closed:?}"));
    };
    let expected = [(damping + kd) / inertia, kp / inertia, ki / inertia];
    let got = [-(p + q + r), p * q + q * r + r * p, -p * q * r];
    // each is a sum of products as large as these
    let [p, q, r] = [p, q, r].map(|pole| libm::hypot(pole.re, pole.im));
    let sizes = [p + q + r, p * q + q * r + r * p, p * q * r];
    for ((got, expected), size) in got.iter().zip(expected).zip(sizes) {
        if (got.re - expected).abs() > 1e-13 * size || got.im.abs() > 1e-13 * size {
            return Err(format!("{got}, not {expected}, of {size}: {closed:?}"));
        }
    }
    Ok(())
}

#[test]
fn two_slow_poles_beside_a_fast_one_keep_their_digits() {
    // 5000/s beside 0.012/s and 0.011/s; 7000/s beside two of 0.009/s
    for (inertia, damping, gains) in [
        (
            0.002_445_528_851_914_878_7,
            1.215_300_980_378_201_8,
            [
                0.286_830_124_727_700_8,
                0.001_625_265_370_765_212_7,
                11.361_846_250_708_263,
            ],
        ),
        (
            0.002_458_605_285_870_142,
            0.0,
            [
                0.310_877_399_950_444_1,
                0.001_389_865_264_810_744_6,
                17.542_471_491_391_7,
            ],
        ),
    ] {
        poles_give_the_denominator(inertia, damping, gains).unwrap_or_else(|e| panic!("{e}"));
    }
}

/// Of any size that a joint may have, spread evenly over its powers of ten.
fn size(least: f64, most: f64) -> impl Strategy<Value = f64> {
    (libm::log10(least)..libm::log10(most)).prop_map(libm::exp10)
}

proptest! {
    #[test]
    fn the_product_of_poles_is_the_denominator(
        inertia in size(1e-3, 1e2), damping in 0.0..2.0f64, kp in size(1e-1, 1e3), ki in size(1e-3, 1e3), kd in 0.0..20.0f64,
    ) {
        poles_give_the_denominator(inertia, damping, [kp, ki, kd]).map_err(TestCaseError::fail)?;
    }

    #[test]
    fn responses_are_the_motion_of_the_joint(
        inertia in 0.1..2.0f64, damping in 0.0..2.0f64, kp in 0.0..30.0f64, ki in 0.1..10.0f64, kd in 0.0..3.0f64,
        of_error: bool, of_velocity: bool,
    ) {
        let joint = pid(inertia, damping, [kp, ki, kd]);
        let derivative = if of_error { DerivativeOn::Error } else { DerivativeOn::Measurement };
        let closed = if of_velocity { joint.velocity_closed_loop(derivative) } else { joint.position_closed_loop(derivative) };
        let response = closed.step_response();
        prop_assume!(response.is_some());
        let response = response.expect("single poles");
        prop_assume!(response.round_off() < 1e-9);

        // classical Runge-Kutta on position, velocity and the error's integral, after the kick of the derivative
        let mass = if of_velocity { inertia + kd } else { inertia };
        let rates = |[q, w, sum]: [f64; 3]| {
            let error = 1.0 - if of_velocity { w } else { q };
            let brake = if of_velocity { 0.0 } else { kd * w };
            [w, (kp * error + ki * sum - brake - damping * w) / mass, error]
        };
        let moved = |x: [f64; 3], d: [f64; 3], h: f64| -> [f64; 3] { std::array::from_fn(|i| x[i] + h * d[i]) };
        let mut x = [0.0, if of_error { kd / mass } else { 0.0 }, 0.0];
        let h = 1e-4;
        for step in 0..10_000 {
            let at = if of_velocity { x[1] } else { x[0] };
            let t_s = f64::from(step) * h;
            // truncation: (h |p|)⁴ of the fastest motion, 320/s in a velocity loop, over a second
            prop_assert!((response.at(t_s) - at).abs() < 1e-6 * (1.0 + at.abs()), "at {t_s} s: {} {at}", response.at(t_s));
            let a = rates(x);
            let b = rates(moved(x, a, h / 2.0));
            let c = rates(moved(x, b, h / 2.0));
            let d = rates(moved(x, c, h));
            x = std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
    }
}
