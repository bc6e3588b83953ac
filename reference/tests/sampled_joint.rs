//! The sampled joint: one period by hand, and the continuous loop where samples are dense.

use kinemark_reference::joint_loop::{DerivativeOn, JointPlant, PidGains, PidLoop};
use kinemark_reference::sampled_joint::{ControlledQuantity, JointMotion, Rate, SampledJoint};

fn joint(damping_n_m_s: f64, [kp, ki, kd]: [f64; 3], period_s: f64) -> SampledJoint {
    SampledJoint {
        plant: JointPlant {
            inertia_kg_m2: 0.5,
            damping_n_m_s,
        },
        gains: PidGains { kp, ki, kd },
        period_s,
        controlled: ControlledQuantity::Position,
        rate: Rate::OfError,
    }
}

#[test]
fn the_first_samples_of_an_undamped_joint_by_hand() {
    // a step of 2 with every term: 2 (1 + 10·0.5 + 4/0.5) = 28 N m on 0.5 kg m² for half a second
    let motions = joint(0.0, [1.0, 10.0, 4.0], 0.5).step_response(2.0, 3);
    let at = |q_rad, qd_rad_s| JointMotion { q_rad, qd_rad_s };
    assert_eq!(motions[..2], [at(0.0, 0.0), at(7.0, 28.0)]);
    // error -5, sum 1 - 2.5, rate -14: -5 - 15 - 56 = -76 N m
    assert_eq!(motions[2], at(7.0 + 14.0 - 19.0, 28.0 - 76.0));
}

#[test]
fn little_damping_is_nearly_none() {
    let free = joint(0.0, [3.0, 1.0, 0.2], 0.02).step_response(1.0, 100);
    let damped = joint(1e-9, [3.0, 1.0, 0.2], 0.02).step_response(1.0, 100);
    for (free, damped) in free.iter().zip(&damped) {
        // digits lost in T - (1 - E) J/b: those of b T/J
        assert!(
            (free.q_rad - damped.q_rad).abs() < 1e-4,
            "{free:?} {damped:?}"
        );
    }
}

#[test]
fn twice_as_many_samples_are_twice_as_near_to_the_continuous_loop() {
    let gains = [12.0, 3.0, 2.0];
    let cases = [
        (
            ControlledQuantity::Position,
            Rate::OfError,
            DerivativeOn::Error,
            gains,
        ),
        (
            ControlledQuantity::Position,
            Rate::OfMeasurement,
            DerivativeOn::Measurement,
            gains,
        ),
        (
            ControlledQuantity::Position,
            Rate::Velocity,
            DerivativeOn::Measurement,
            gains,
        ),
        (
            ControlledQuantity::Velocity,
            Rate::OfError,
            DerivativeOn::Error,
            [12.0, 3.0, 0.0],
        ),
        // the derivative of a velocity is the inertia's own torque: with less gain than inertia it converges
        (
            ControlledQuantity::Velocity,
            Rate::OfMeasurement,
            DerivativeOn::Measurement,
            [12.0, 3.0, 0.2],
        ),
    ];
    for (controlled, rate, derivative, gains) in cases {
        let off = |period_s: f64| -> f64 {
            let sampled = SampledJoint {
                controlled,
                rate,
                ..joint(0.4, gains, period_s)
            };
            let continuous = PidLoop {
                plant: sampled.plant,
                gains: sampled.gains,
            };
            let closed = match controlled {
                ControlledQuantity::Position => continuous.position_closed_loop(derivative),
                ControlledQuantity::Velocity => continuous.velocity_closed_loop(derivative),
            };
            let response = closed.step_response().expect("single poles");
            let count = (2.0 / period_s).round() as usize;
            let motions = sampled.step_response(1.0, count);
            // from a tenth of a second on: a kick takes one period
            let first = count / 20;
            let errors = motions.iter().enumerate().skip(first).map(|(k, motion)| {
                let value = match controlled {
                    ControlledQuantity::Position => motion.q_rad,
                    ControlledQuantity::Velocity => motion.qd_rad_s,
                };
                (value - response.at(k as f64 * period_s)).abs()
            });
            errors.fold(0.0, f64::max)
        };
        let ratio = off(2e-4) / off(1e-4);
        assert!(
            (1.9..2.1).contains(&ratio),
            "{controlled:?} {rate:?}: {ratio}"
        );
        assert!(off(1e-4) < 2e-3, "{controlled:?} {rate:?}");
    }
}
