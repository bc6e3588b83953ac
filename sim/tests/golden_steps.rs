//! Sampled step responses of the course's arm against `tests/golden/B_nonlinear_*.json` (DOP853, rtol 1e-12).

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::run::{End, Setup, run};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};
use serde_json::Value;

use crate::arms::rrbot_without_limits;
use crate::golden_rrbot::{golden, numbers};

fn simulate(scenario: &Value, mode: Mode, step_s: f64, duration_s: f64) -> Trace {
    let robot = rrbot_without_limits();
    let servo_s = scenario["Ts"].as_f64().expect("Ts");
    let gains = numbers(&scenario["gains"]);
    let gains = Gains {
        kp: gains[0],
        ki: gains[1],
        kd: gains[2],
        effort_limit: scenario["torque_limit_Nm"]
            .as_f64()
            .unwrap_or(f64::INFINITY),
        integral_limit: f64::INFINITY,
    };
    let derivative = match scenario["derivative"].as_str() {
        Some("error") => Derivative::Error,
        _ => Derivative::Measurement,
    };
    let ticks = (duration_s / step_s).round() as u64;
    let setup = Setup {
        robot: &robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot.frame("lab").expect("lab"),
        periods: Periods {
            ticks_per_control: NonZeroU32::new(ticks as u32).expect("not zero"),
            ..Periods::new(step_s, servo_s, servo_s).expect("periods")
        },
        gravity_m_s2: GRAVITY_M_S2,
        servo: ServoSettings {
            mode,
            derivative,
            gains: vec![gains; 2],
            gravity_compensation: false,
        },
        sensors: Vec::new(),
        start_q: vec![0.0; 2],
        start_qd: vec![0.0; 2],
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let reference = numbers(&scenario["ref"]);
    let mut recorder = TraceRecorder::new(&setup);
    let end = run(
        &setup,
        |_, command| -> Result<(), ()> {
            command.copy_from_slice(&reference);
            Ok(())
        },
        &mut recorder,
    );
    assert_eq!(end, Ok(End::Finished));
    recorder.finish()
}

/// Greatest difference in joint position \[rad\] over the part of the curve that can be trusted.
fn difference(scenario: &Value, mode: Mode, step_s: f64) -> f64 {
    let curve = &scenario["curve"];
    let sample_s = curve["dt_s"].as_f64().expect("dt_s");
    let valid_s = scenario["valid_until_s"].as_f64().expect("valid_until_s");
    let samples = (valid_s / sample_s + 1e-9).floor() as usize;
    // a curve trusted for less than a sample is compared at its start alone, over one servo period
    let servo_s = scenario["Ts"].as_f64().expect("Ts");
    let trace = simulate(
        scenario,
        mode,
        step_s,
        (samples as f64 * sample_s).max(servo_s),
    );
    let stride = (sample_s / step_s).round() as usize;
    let mut worst = 0.0_f64;
    for (joint, name) in ["tau1", "tau2"].into_iter().enumerate() {
        let kick = numbers(&curve[name])[0];
        assert!(
            (trace.effort.at(0)[joint] - kick).abs() <= 1e-9 * kick.abs(),
            "{name}"
        );
    }
    for (joint, name) in ["q1", "q2"].into_iter().enumerate() {
        let expected = numbers(&curve[name]);
        for (sample, expected) in expected.iter().enumerate().take(samples + 1) {
            worst = worst.max((trace.q.at(sample * stride)[joint] - expected).abs());
        }
    }
    worst
}

fn digital(file: &str) -> Vec<Value> {
    let scenarios = golden(file);
    let scenarios = scenarios["scenarios"]
        .as_array()
        .expect("scenarios")
        .clone();
    let digital: Vec<Value> = scenarios
        .into_iter()
        .filter(|scenario| scenario["kind"] == "digital")
        .collect();
    assert!(digital.len() >= 4, "{file}");
    digital
}

fn check(file: &str, mode: Mode) {
    for scenario in digital(file) {
        let name = scenario["name"].as_str().expect("name");
        let servo_s = scenario["Ts"].as_f64().expect("Ts");
        let fine = difference(&scenario, mode, 1e-4);
        assert!(fine < 1e-6, "{name} at 0.1 ms: {fine:.2e} rad");
        let coarse = difference(&scenario, mode, 1e-3);
        let on_error = scenario["derivative"] == "error";
        let allowed = match (servo_s < 5e-3, on_error) {
            // a kick of kd / Ts turns the arm by a quarter within one step
            (true, true) => 5e-3,
            (true, false) => 1e-6,
            (false, _) => 1e-4,
        };
        assert!(coarse < allowed, "{name} at 1 ms: {coarse:.2e} rad");
    }
}

#[test]
fn position_loops_follow_the_exact_solution() {
    check("B_nonlinear_position.json", Mode::Position);
}

#[test]
fn velocity_loops_follow_the_exact_solution() {
    check("B_nonlinear_velocity.json", Mode::Velocity);
}
