//! How exact motion in contact is: against a closed form and against steps 16 times finer.

use kinemark_sim::control::{Derivative, Gains, Mode, Servo, ServoSettings};
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::step::hybrid::{HybridStep, StateFrom};

use crate::arms::{robot, rrbot};
use crate::contact_scenes::{GRAVITY, at, boxed, part, reach, scene};

/// A block of 2 kg that slides along x and z, damped along x.
const SLED: &str = "format = 1\nname = 'sled'\n[[links]]\nname = 'base'\n[[links]]\nname = 'mast'\n\
    inertia = { mass_kg = 0.5, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[links]]\nname = 'block'\n\
    shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ninertia = { mass_kg = 1.5 }\n\
    contact = { friction = 0.3, restitution = 0.0 }\n\
    [[joints]]\nname = 'along'\ntype = 'prismatic'\nparent = 'base'\nchild = 'mast'\naxis = [1, 0, 0]\ndamping = 4.0\n\
    [[joints]]\nname = 'down'\ntype = 'prismatic'\nparent = 'mast'\nchild = 'block'\naxis = [0, 0, -1]\norigin = { xyz_m = [0, 0, 0.05] }\n";

/// Greatest error of position and speed over one second of sliding under constant forces, against the closed form.
fn sled_errors(dt_s: f64) -> (f64, f64) {
    let robot = robot(SLED);
    let mut scene = scene(Vec::new());
    if let Some(ground) = &mut scene.environment.ground {
        ground.friction = 0.3;
    }
    let mut hybrid = HybridStep::new(&robot, &scene, GRAVITY, dt_s).expect("a scene");
    let (mut q, mut qd) = ([0.0; 2], [0.0; 2]);
    // pressed with 10 N besides the weight of the block, pulled with 20 N: m v' = F - f - c v from rest
    let (pull_n, press_n) = (20.0, 10.0);
    let friction_n = 0.3 * (press_n + 1.5 * 9.81);
    let (mass_kg, damping) = (2.0, 4.0);
    let (rate, end) = (damping / mass_kg, (pull_n - friction_n) / damping);
    let mut worst = (0.0_f64, 0.0_f64);
    for i in 1..=(1.0 / dt_s).round() as usize {
        let report = hybrid
            .advance(&robot, &[pull_n, press_n], &mut q, &mut qd)
            .expect("a step");
        assert_eq!(report.state_from, StateFrom::Contact);
        let t = i as f64 * dt_s;
        let gone = 1.0 - libm::exp(-rate * t);
        worst.0 = worst.0.max((q[0] - end * (t - gone / rate)).abs());
        worst.1 = worst.1.max((qd[0] - end * gone).abs());
    }
    worst
}

#[test]
fn a_block_pressed_on_the_ground_slides_as_by_hand() {
    let (p_m, v_m_s) = sled_errors(1e-3);
    let (half_p_m, half_v_m_s) = sled_errors(5e-4);
    // the bounds that docs/physics.md states
    assert!(p_m < 2e-6 && v_m_s < 2e-6, "{p_m:.2e} m, {v_m_s:.2e} m/s");
    // half the step, a quarter of the error
    for ratio in [p_m / half_p_m, v_m_s / half_v_m_s] {
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
    }
}

/// What the arm does on the shelf.
#[derive(Clone, Copy)]
enum Line {
    /// Follows a line of 0.3 m within a second.
    Followed,
    /// Is sent to its end at once.
    Jumped,
}

/// The tip of the course's arm presses on a broad shelf and slides 0.3 m over it, under a PID at 1 kHz; its joints every millisecond.
fn drawn(line: Line, substeps: usize) -> Vec<[f64; 2]> {
    let robot = rrbot();
    let shelf = part(
        "shelf",
        BodyKind::Fixed,
        boxed(0.6, 0.9, 1.2),
        1.0,
        at(1.0, 0.05, 0.6),
    );
    let dt_s = 1e-3 / substeps as f64;
    let mut hybrid = HybridStep::new(&robot, &scene(vec![shelf]), GRAVITY, dt_s).expect("a scene");
    let gains = Gains {
        kp: 100.0,
        ki: 0.01,
        kd: 10.0,
        effort_limit: f64::INFINITY,
        integral_limit: f64::INFINITY,
    };
    let settings = ServoSettings {
        mode: Mode::Position,
        derivative: Derivative::Measurement,
        gains: vec![gains; 2],
        gravity_compensation: true,
    };
    let mut servo = Servo::new(&robot, settings, 1e-3, GRAVITY).expect("settings");
    // the lower edge of its end face touches
    let mut top = 1.2;
    for _ in 0..20 {
        let q = reach(top, 1.15);
        top = 1.2 + 0.025 * libm::sin(q[0] + q[1]).abs();
    }
    let (mut q, mut qd, mut effort) = (reach(top, 1.15), [0.0; 2], [0.0; 2]);
    let smooth = |s: f64| s * s * (3.0 - 2.0 * s);
    let at_ms = |i: u32| {
        // it presses first
        let down = smooth((f64::from(i) / 300.0).min(1.0));
        let along = match line {
            Line::Followed => smooth((f64::from(i) / 1000.0 - 0.3).clamp(0.0, 1.0)),
            Line::Jumped => f64::from(i > 300),
        };
        servo.sample(
            &robot,
            &reach(top - 0.05 * down, 1.15 - 0.3 * along),
            &q,
            &qd,
            &mut effort,
        );
        for _ in 0..substeps {
            hybrid
                .advance(&robot, &effort, &mut q, &mut qd)
                .expect("a step");
        }
        q
    };
    (0..1500).map(at_ms).collect()
}

#[test]
fn an_arm_that_slides_over_a_shelf_errs_by_hundredths_of_a_milliradian() {
    // the bounds that docs/physics.md states
    for (line, bound_rad) in [(Line::Followed, 8e-6), (Line::Jumped, 4e-5)] {
        let truth = drawn(line, 64);
        let error_rad = |substeps| {
            let apart =
                |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            let found = drawn(line, substeps);
            found.iter().zip(&truth).map(apart).fold(0.0, f64::max)
        };
        let errors = [1, 2, 4, 8].map(error_rad);
        assert!(errors[0] < bound_rad, "{errors:?} rad");
        match line {
            // when it slips first is known to a step, which makes the error uneven
            Line::Followed => assert!(errors[3] < 0.5 * errors[0], "{errors:?}"),
            // first order
            Line::Jumped => {
                for pair in errors.windows(2) {
                    assert!((1.6..2.6).contains(&(pair[0] / pair[1])), "{errors:?}");
                }
            }
        }
    }
}
