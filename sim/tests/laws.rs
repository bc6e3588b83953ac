//! Laws of motion that any run must keep.

use kinemark_sim::dynamics::{GRAVITY_M_S2, energy};
use kinemark_sim::joint_space::{JointPositions, JointVelocities};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::step::smooth::SmoothStep;
use nalgebra::Vector3;

use crate::arms::{robot, rrbot};

fn pendulum(extra: &str) -> Robot {
    robot(&format!(
        r#"
        format = 1
        name = "pendulum"
        [[links]]
        name = "post"
        [[links]]
        name = "bob"
        inertia = {{ mass_kg = 2.0, com_m = [0, 0, -0.5], tensor_kg_m2 = [0, 0, 0, 0, 0, 0] }}
        [[joints]]
        name = "hinge"
        type = "revolute"
        parent = "post"
        child = "bob"
        axis = [0, 1, 0]
        {extra}
        "#
    ))
}

fn advance(robot: &Robot, dt_s: f64, steps: usize, q: &mut [f64], qd: &mut [f64], effort: &[f64]) {
    let mut step = SmoothStep::new(robot, GRAVITY_M_S2, dt_s);
    for _ in 0..steps {
        step.advance(robot, effort, q, qd)
            .expect("inertia everywhere");
    }
}

#[test]
fn a_small_pendulum_swings_with_its_period() {
    // 2π √(l/g), less than 1e-6 longer at an amplitude of 0.002 rad
    let robot = pendulum("");
    let period_s = 2.0 * std::f64::consts::PI * (0.5_f64 / 9.81).sqrt();
    let (mut q, mut qd) = ([0.002], [0.0]);
    advance(&robot, period_s / 1000.0, 1000, &mut q, &mut qd, &[0.0]);
    assert!((q[0] - 0.002).abs() < 1e-11, "{q:?}");
    assert!(qd[0].abs() < 1e-7, "{qd:?}");
}

#[test]
fn halving_the_step_divides_the_energy_error_by_sixteen_or_more() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../labs/robots/rrbot.toml"
    ));
    let robot = robot(
        &text
            .expect("rrbot")
            .replace("damping = 0.7", "damping = 0.0"),
    );
    let drift = |steps: usize| {
        let (mut q, mut qd) = ([2.0, 1.0], [0.0, 0.0]);
        let total = |q: &[f64], qd: &[f64]| {
            let e = energy(
                &robot,
                &GRAVITY_M_S2,
                &JointPositions::new(q.iter().copied()),
                &JointVelocities::new(qd.iter().copied()),
            );
            e.kinetic_j + e.potential_j
        };
        let before = total(&q, &qd);
        advance(
            &robot,
            2.0 / steps as f64,
            steps,
            &mut q,
            &mut qd,
            &[0.0; 2],
        );
        (total(&q, &qd) - before).abs()
    };
    let (coarse, fine) = (drift(400), drift(800));
    assert!(coarse / fine > 14.0, "{coarse:.2e} then {fine:.2e}");
    assert!(drift(4000) < 1e-9);
}

#[test]
fn dry_friction_holds_a_joint_exactly_until_it_breaks_loose() {
    // weight at 30 degrees: 2 kg * 9.81 * 0.5 m * sin 30° = 4.905 N m
    let q0 = std::f64::consts::FRAC_PI_6;
    let (mut q, mut qd) = ([q0], [0.0]);
    advance(
        &pendulum("dry_friction = 4.95"),
        1e-3,
        2000,
        &mut q,
        &mut qd,
        &[0.0],
    );
    assert!(
        (q[0] - q0).abs() < 1e-12 && qd[0].abs() < 1e-12,
        "{q:?} {qd:?}"
    );
    advance(
        &pendulum("dry_friction = 4.85"),
        1e-3,
        2000,
        &mut q,
        &mut qd,
        &[0.0],
    );
    assert!(q0 - q[0] > 0.01, "{q:?}");
}

#[test]
fn dry_friction_takes_its_work_from_the_motion() {
    // without gravity: qd falls by dry / inertia * t = 0.2 / 0.5 * 1, then the joint stays
    let robot = pendulum("dry_friction = 0.2");
    let mut step = SmoothStep::new(&robot, Vector3::zeros(), 1e-3);
    let (mut q, mut qd) = ([0.0], [1.0]);
    for _ in 0..1000 {
        step.advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("inertia");
    }
    assert!((qd[0] - 0.6).abs() < 1e-12, "{qd:?}");
    for _ in 0..2000 {
        step.advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("inertia");
    }
    // v² / (2 a) with a = 0.4
    assert!(
        qd[0].abs() < 1e-12 && (q[0] - 1.25).abs() < 1e-3,
        "{q:?} {qd:?}"
    );
}

#[test]
fn a_joint_without_inertia_is_named() {
    let text = "format = 1\nname = \"r\"\n[[links]]\nname = \"a\"\n[[links]]\nname = \"b\"\n[[joints]]\nname = \"loose\"\ntype = \"revolute\"\nparent = \"a\"\nchild = \"b\"\naxis = [0, 0, 1]\n";
    let robot = robot(text);
    let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-3);
    let refused = step.advance(&robot, &[0.0], &mut [0.0], &mut [0.0]);
    assert_eq!(refused.expect_err("singular").joint, "loose");
}

#[test]
fn a_run_forgets_nothing_between_steps() {
    // the workspace holds no state of its own: two steps of one integrator are one step of each of two
    let robot = rrbot();
    let (mut q, mut qd) = ([0.4, -0.9], [0.1, 0.3]);
    let (mut p, mut pd) = (q, qd);
    advance(&robot, 1e-3, 2, &mut q, &mut qd, &[1.0, -2.0]);
    for _ in 0..2 {
        advance(&robot, 1e-3, 1, &mut p, &mut pd, &[1.0, -2.0]);
    }
    assert_eq!((q, qd), (p, pd));
}
