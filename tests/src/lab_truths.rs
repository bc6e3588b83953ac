//! Expected answers of functions are compared with an independent computation: `expected` in lab.toml is typed by hand, and for hidden
//! cases the reference solution computes it.

use kinemark_grader::judge::with_expected;
use kinemark_grader::lab::TaskWork;
use kinemark_grader::task::entry::Entry;
use kinemark_grader::task::model::Given;
use kinemark_reference::joint_loop::{DerivativeOn, JointPlant, PidGains, PidLoop};

use crate::testbed::{lab, staff};

/// Numbers of a case by name.
struct Numbers<'c>(&'c [(String, Entry)]);

impl Numbers<'_> {
    fn of(&self, name: &str) -> f64 {
        match self.0.iter().find(|(known, _)| known == name) {
            Some((_, Entry::Number(number))) => *number,
            other => panic!("{name}: {other:?}"),
        }
    }
}

/// Every case of a free function, visible and hidden: what is given and what is expected.
fn each_case(lab_name: &str, task: &str, mut check: impl FnMut(&Numbers<'_>, &Numbers<'_>)) {
    let lab = lab(lab_name);
    let staff = staff(&lab, Some("another way"));
    let found = lab.tasks.iter().find(|known| known.name == task);
    let TaskWork::Function(function, _) = &found.expect(task).work else {
        panic!("{task} is not a function task");
    };
    let hidden = staff.draws_of(task).flat_map(|draw| {
        with_expected(&lab, found.expect(task), &draw.cases, &staff.solution).expect("answers")
    });
    let cases = function.cases.iter().cloned().chain(hidden);
    let mut seen = 0;
    for case in cases {
        let Given::Values { given, expected } = &case.given else {
            panic!("{}", case.name);
        };
        check(&Numbers(given), &Numbers(expected));
        seen += 1;
    }
    assert!(seen > function.cases.len(), "no hidden cases");
}

#[track_caller]
fn agrees(what: &str, a: f64, b: f64) {
    // visible numbers are typed with six digits
    assert!((a - b).abs() <= 2e-5 * b.abs() + 1e-12, "{what}: {a} {b}");
}

/// The moment of inertia of a box about one of its ends, by the midpoint rule over its section in the plane of the motion.
fn inertia_kg_m2(given: &Numbers<'_>) -> f64 {
    let (length, width) = (given.of("length"), given.of("width"));
    let n = 1000; // the rule is off by 1/(2 n²) of the parts along each side: 5e-7
    let along = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
    let mean_square = |from: f64, size: f64| -> f64 {
        let square = |share: f64| (from + share * size) * (from + share * size);
        along.clone().map(square).sum::<f64>() / f64::from(n)
    };
    given.of("mass") * (mean_square(0.0, length) + mean_square(-0.5 * width, width))
}

#[test]
fn the_position_loop_of_lab_0_is_that_of_its_poles() {
    each_case("00-step-response", "position-loop", |given, expected| {
        let inertia = inertia_kg_m2(given);
        agrees("inertia", expected.of("inertia"), inertia);
        let with = |ki| PidLoop {
            plant: JointPlant {
                inertia_kg_m2: inertia,
                damping_n_m_s: given.of("damping"),
            },
            gains: PidGains {
                kp: given.of("kp"),
                ki,
                kd: given.of("kd"),
            },
        };
        let without = with(0.0).position_closed_loop(DerivativeOn::Measurement);
        let [a, b] = without.poles() else {
            panic!("{without:?}");
        };
        let frequency = (a * b).re.sqrt();
        agrees("ω", expected.of("natural_frequency"), frequency);
        let ratio = -(a + b).re / (2.0 * frequency);
        agrees("ζ", expected.of("damping_ratio"), ratio);
        let load = with(given.of("ki")).disturbance_to_position();
        let left = load.dc_gain().expect("it settles") * given.of("load_torque");
        agrees("error", expected.of("steady_state_error"), left);
    });
}

#[test]
fn the_velocity_loop_of_lab_0_is_that_of_its_pole_and_its_limits_are_where_errors_grow() {
    each_case("00-step-response", "velocity-loop", |given, expected| {
        let (inertia, damping) = (given.of("inertia"), given.of("damping"));
        let (kp, period) = (given.of("kp"), given.of("period"));
        let closed = PidLoop {
            plant: JointPlant {
                inertia_kg_m2: inertia,
                damping_n_m_s: damping,
            },
            gains: PidGains {
                kp,
                ki: 0.0,
                kd: 0.0,
            },
        };
        let closed = closed.velocity_closed_loop(DerivativeOn::Error);
        agrees(
            "final speed",
            expected.of("final_speed"),
            closed.dc_gain().expect("it settles"),
        );
        agrees(
            "time constant",
            expected.of("time_constant"),
            -1.0 / closed.poles()[0].re,
        );
        // without damping, a held effort for a period at a time: the error after many of them
        let proportional = |kp: f64| {
            let mut speed = 1.0_f64;
            for _ in 0..4000 {
                speed -= kp * speed * period / inertia;
            }
            speed.abs()
        };
        let derivative = |kd: f64| {
            let (mut before, mut speed) = (0.0_f64, 1.0_f64);
            for _ in 0..4000 {
                let next = speed - kd * (speed - before) / period * period / inertia;
                (before, speed) = (speed, next);
            }
            (speed - before).abs()
        };
        let (kp, kd) = (expected.of("largest_kp"), expected.of("largest_kd"));
        assert!(proportional(0.99 * kp) < 1e-3 && proportional(1.01 * kp) > 1e3);
        assert!(derivative(0.99 * kd) < 1e-3 && derivative(1.01 * kd) > 1e3);
    });
}
