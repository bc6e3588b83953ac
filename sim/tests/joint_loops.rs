//! One joint under PID control against its closed forms: the ideal loop by partial fractions, a sampled run by the exact motion under
//! a held effort.

use std::num::NonZeroU32;

use kinemark_reference::joint_loop::{DerivativeOn, JointPlant, PidGains, PidLoop};
use kinemark_reference::sampled_joint::{ControlledQuantity, Rate, SampledJoint};
use kinemark_sim::control::linear_step::{Fed, LinearStep};
use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::run::{End, Setup, run};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::arms::robot;

/// Joint and gains of one loop.
fn loops() -> impl Strategy<Value = PidLoop> {
    let plant = (0.05..5.0f64, 0.0..2.0f64);
    // some of the terms are often left out
    let gain = |most: f64| prop_oneof![1 => Just(0.0), 3 => 0.0..most];
    let gains = (0.1..200.0f64, gain(50.0), gain(20.0));
    (plant, gains).prop_map(|((inertia_kg_m2, damping_n_m_s), (kp, ki, kd))| PidLoop {
        plant: JointPlant {
            inertia_kg_m2,
            damping_n_m_s,
        },
        gains: PidGains { kp, ki, kd },
    })
}

proptest! {
    #[test]
    fn ideal_loops_respond_as_their_partial_fractions(joint in loops(), of_error: bool, velocity: bool) {
        let derivative = if of_error { DerivativeOn::Error } else { DerivativeOn::Measurement };
        let (fed, closed) = if velocity {
            (Fed::Velocity, joint.velocity_closed_loop(derivative))
        } else {
            (Fed::Position, joint.position_closed_loop(derivative))
        };
        let PidLoop { plant, gains } = joint;
        let ours = LinearStep {
            fed,
            inertia_kg_m2: plant.inertia_kg_m2,
            damping_n_m_s: plant.damping_n_m_s,
            kp: gains.kp,
            ki: gains.ki,
            kd: gains.kd,
            derivative_of_error: of_error,
        };
        let growth = closed.poles().iter().map(|pole| pole.re).fold(f64::NEG_INFINITY, f64::max);
        // on the edge of growing, rounding decides
        if growth.abs() > 1e-9 {
            prop_assert_eq!(ours.is_bounded(), growth < 0.0, "{:?}", closed);
        }
        let response = closed.step_response();
        prop_assume!(response.is_some());
        let response = response.expect("single poles");
        prop_assume!(response.round_off() < 1e-9);
        let dt_s = 0.01;
        let values = ours.response(dt_s, 301).expect("finite");
        for (k, value) in values.iter().enumerate() {
            let expected = response.at(k as f64 * dt_s);
            // rounding of three hundred steps, and what a growing response makes of it
            let tolerance = (1e-12 + response.round_off()) * (1.0 + libm::exp(growth * k as f64 * dt_s));
            prop_assert!((value - expected).abs() <= tolerance, "{k}: {value} {expected} {closed:?}");
        }
    }
}

/// A wheel on an upright axle, which gravity does not pull, in a run whose command is `reference` throughout.
fn turned(
    joint: &SampledJoint,
    servo: ServoSettings,
    reference: f64,
    samples: u32,
    step_s: f64,
) -> Trace {
    let JointPlant {
        inertia_kg_m2,
        damping_n_m_s,
    } = joint.plant;
    // half of the inertia is the motor's
    let robot = robot(&format!(
        "format = 1\nname = 'wheel'\n[[links]]\nname = 'post'\n[[links]]\nname = 'rim'\ninertia = {{ mass_kg = 3, tensor_kg_m2 = [1, 1, {0}, 0, 0, 0] }}\n\
         [[joints]]\nname = 'axle'\ntype = 'continuous'\nparent = 'post'\nchild = 'rim'\naxis = [0, 0, 1]\ndamping = {damping_n_m_s}\narmature = {0}\n\
         [[frames]]\nname = 'tcp'\nlink = 'rim'\norigin = {{ xyz_m = [0.2, 0, 0] }}\n",
        inertia_kg_m2 / 2.0
    ));
    let ticks = (f64::from(samples) * joint.period_s / step_s).round() as u64;
    let setup = Setup {
        robot: &robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot.tcp(),
        periods: Periods {
            ticks_per_control: NonZeroU32::new(ticks as u32).expect("not zero"),
            ..Periods::new(step_s, joint.period_s, joint.period_s).expect("periods")
        },
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.81),
        servo,
        sensors: Vec::new(),
        start_q: vec![0.0],
        start_qd: vec![0.0],
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let mut recorder = TraceRecorder::new(&setup);
    let end = run(
        &setup,
        |_, command| -> Result<(), ()> {
            command[0] = reference;
            Ok(())
        },
        &mut recorder,
    );
    assert_eq!(end, Ok(End::Finished));
    recorder.finish()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn sampled_runs_move_as_a_held_effort_moves_the_joint(
        inertia_kg_m2 in 0.2..2.0f64, damping_n_m_s in prop_oneof![Just(0.0), 0.05..2.0f64],
        kp in 0.0..20.0f64, ki in 0.0..10.0f64, kd in 0.0..0.15f64,
        reference in -2.0..2.0f64, way in 0usize..5,
    ) {
        let (controlled, rate, mode, derivative) = [
            (ControlledQuantity::Position, Rate::OfError, Mode::Position, Derivative::Error),
            (ControlledQuantity::Position, Rate::OfMeasurement, Mode::Position, Derivative::Measurement),
            (ControlledQuantity::Position, Rate::Velocity, Mode::Position, Derivative::Velocity),
            (ControlledQuantity::Velocity, Rate::OfError, Mode::Velocity, Derivative::Error),
            (ControlledQuantity::Velocity, Rate::OfMeasurement, Mode::Velocity, Derivative::Measurement),
        ][way];
        let (step_s, substeps, samples) = (1e-3, 4, 200);
        let joint = SampledJoint {
            plant: JointPlant { inertia_kg_m2, damping_n_m_s },
            gains: PidGains { kp, ki, kd },
            period_s: step_s * f64::from(substeps),
            controlled,
            rate,
        };
        let gains = Gains { kp, ki, kd, effort_limit: f64::INFINITY, integral_limit: f64::INFINITY };
        let servo = ServoSettings { mode, derivative, gains: vec![gains], gravity_compensation: false };
        let trace = turned(&joint, servo, reference, samples, step_s);
        let expected = joint.step_response(reference, samples as usize);
        let most = |most: f64, x: f64| most.max(x.abs());
        let size = 1.0 + expected.iter().map(|motion| motion.qd_rad_s).fold(0.0, most);
        for (sample, motion) in expected.iter().enumerate() {
            let tick = sample * substeps as usize;
            let off = (trace.q.at(tick)[0] - motion.q_rad).abs().max((trace.qd.at(tick)[0] - motion.qd_rad_s).abs());
            // truncation of RK4, (b h/J)⁵/120 a step, over 800 steps; gains make it no more than ten times as large
            prop_assert!(off < 1e-9 * size, "{controlled:?} {rate:?}, sample {sample}: off by {off:.2e}");
        }
    }
}
