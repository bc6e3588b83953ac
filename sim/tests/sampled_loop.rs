//! The sampled-data limit of servos: by hand for one joint, against printed numbers for the course's arm, and against simulation.

use kinemark_sim::control::{
    Derivative, Gains, Mode, SampledLoop, Servo, ServoSettings, VariedGain, sampled_loop,
    stable_gain_factor,
};
use kinemark_sim::dynamics::{GRAVITY_M_S2, gravity_effort, mass_matrix};
use kinemark_sim::format::ReadOptions;
use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::kinematics::closure::closed_positions;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::step::smooth::SmoothStep;
use kinemark_sim::text::Source;
use nalgebra::Vector3;

use crate::arms::read_robot;
use crate::arms::{lab_robot, robot, rrbot};
use crate::golden_rrbot::{golden, numbers};

fn settings(mode: Mode, derivative: Derivative, gains: &[[f64; 3]]) -> ServoSettings {
    ServoSettings {
        mode,
        derivative,
        gains: gains
            .iter()
            .map(|&[kp, ki, kd]| Gains {
                kp,
                ki,
                kd,
                effort_limit: f64::INFINITY,
                integral_limit: f64::INFINITY,
            })
            .collect(),
        gravity_compensation: false,
    }
}

/// A slider of 2 kg that gravity does not pull.
fn slider(damping: f64) -> Robot {
    robot(&format!(
        "format = 1\nname = 'slider'\n[[links]]\nname = 'rail'\n[[links]]\nname = 'cart'\ninertia = {{ mass_kg = 1.5, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n[[joints]]\nname = 'slide'\ntype = 'prismatic'\nparent = 'rail'\nchild = 'cart'\naxis = [1, 0, 0]\ndamping = {damping}\narmature = 0.5\n"
    ))
}

fn one(
    robot: &Robot,
    mode: Mode,
    derivative: Derivative,
    gains: [f64; 3],
    servo_s: f64,
) -> SampledLoop {
    let settings = settings(mode, derivative, &[gains]);
    sampled_loop(robot, &settings, servo_s, &GRAVITY_M_S2, &[0.0]).expect("a loop")
}

fn near(found: Option<f64>, expected: f64) {
    let found = found.expect("a limit");
    // 16 halvings of a bracket of up to a third, and the margin of 1e-7 over a slope near one
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
}

/// The larger modulus of the roots of `z² - trace z + det`.
fn largest_root(trace: f64, det: f64) -> f64 {
    let square = trace * trace / 4.0 - det;
    if square < 0.0 {
        det.sqrt()
    } else {
        trace.abs() / 2.0 + square.sqrt()
    }
}

#[test]
fn an_inertia_under_position_and_rate_by_hand() {
    // q⁺ = (1 - a/2) q + (1 - b/2) v, v⁺ = -a q + (1 - b) v with a = kp T²/J, b = kd T/J; Jury: b < 2 and a < 2 b
    let robot = slider(0.0);
    let rate = |gains, servo_s| one(&robot, Mode::Position, Derivative::Velocity, gains, servo_s);
    for (kp, kd, servo_s) in [(50.0, 30.0, 0.01), (800.0, 10.0, 0.02), (50.0, 500.0, 0.01)] {
        let (a, b) = (kp * servo_s * servo_s / 2.0, kd * servo_s / 2.0);
        let expected = largest_root(2.0 - a / 2.0 - b, 1.0 - b + a / 2.0);
        let found = rate([kp, 0.0, kd], servo_s);
        // Gelfand's limit after 40 squarings
        assert!(
            (found.spectral_radius - expected).abs() < 1e-9,
            "{found:?} {expected}"
        );
        assert_eq!(found.worst_joint, 0);
        assert_eq!(found.is_stable(), expected < 1.0);
    }
    // b < 2: at most 2 J / T = 400
    let hard = rate([50.0, 0.0, 500.0], 0.01);
    near(hard.stable_share, 0.8);
    near(hard.stable_share_of_all, 0.8);
    near(hard.stable_period_s, 2.0 * 2.0 / 500.0);
    // stable, and up to which period
    let soft = rate([50.0, 0.0, 30.0], 0.01);
    assert_eq!(soft.stable_share, Some(1.0));
    near(soft.stable_period_s, 2.0 * 2.0 / 30.0);
    // a < 2 b, whatever the share: T < 2 kd / kp
    let springy = rate([5e5, 0.0, 500.0], 0.01);
    assert!(!springy.is_stable());
    assert_eq!(
        (springy.stable_share, springy.stable_share_of_all),
        (None, None)
    );
    near(springy.stable_period_s, 2.0 * 500.0 / 5e5);
    // position alone, undamped, grows by sqrt(1 + a/2) whatever the gain; only what takes hours to show counts as stable
    let bare = rate([5.0, 0.0, 0.0], 0.01);
    assert!(!bare.is_stable());
    let a = 5.0 * 1e-4 / 2.0;
    // Gelfand's limit is good to 1e-11 of the 1e-7 that is left
    assert!((bare.stable_share.expect("a share") * a / 4e-7 - 1.0).abs() < 1e-3);
}

#[test]
fn an_inertia_under_velocity_by_hand() {
    let velocity = |robot: &Robot, derivative, gains, servo_s| {
        one(robot, Mode::Velocity, derivative, gains, servo_s)
    };
    let free = slider(0.0);
    // v⁺ = (1 - kp T/J) v
    for kp in [10.0, 380.0, 450.0] {
        let found = velocity(&free, Derivative::Velocity, [kp, 0.0, 0.0], 0.01);
        let expected = (1.0 - kp * 0.01 / 2.0_f64).abs();
        assert!(
            (found.spectral_radius - expected).abs() < 1e-12,
            "{found:?}"
        );
        near(found.stable_period_s, 2.0 * 2.0 / kp);
    }
    // with kp T/J = c, ki T²/J = d: trace 2 - c - d, determinant 1 - c; Jury: 2 c + d < 4
    let (kp, ki) = (500.0, 9000.0);
    let (c, d) = (kp * 0.01 / 2.0, ki * 1e-4 / 2.0);
    let found = velocity(&free, Derivative::Measurement, [kp, ki, 0.0], 0.01);
    let expected = largest_root(2.0 - c - d, 1.0 - c);
    assert!((found.spectral_radius - expected).abs() < 1e-9, "{found:?}");
    near(found.stable_share, 4.0 / (2.0 * c + d));
    // the rate of the velocity by differences: z² - (1 - a) z - a with a = kd/J, roots 1 and -a at any period
    for derivative in [Derivative::Error, Derivative::Measurement] {
        let found = velocity(&free, derivative, [0.0, 0.0, 3.0], 0.01);
        assert!((found.spectral_radius - 1.5).abs() < 1e-9, "{found:?}");
        near(found.stable_share, 1.0 / 1.5);
        assert_eq!(found.stable_period_s, None);
    }
    // damped: v⁺ = (E - kp (1 - E)/D) v with E = exp(-D T/J)
    let decay = libm::exp(-40.0 * 0.01 / 2.0);
    let found = velocity(&slider(40.0), Derivative::Error, [900.0, 0.0, 0.0], 0.01);
    let expected = (decay - 900.0 * (1.0 - decay) / 40.0).abs();
    assert!((found.spectral_radius - expected).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_pendulum_upright_with_and_without_compensation_by_hand() {
    // J = 2 kg m², m g l = 19.62 N m: q̈ = ω² q + u/J upright
    let pendulum = robot(
        "format = 1\nname = 'pendulum'\n[[links]]\nname = 'post'\n[[links]]\nname = 'bob'\ninertia = { mass_kg = 2.0, com_m = [0, 0, 1], tensor_kg_m2 = [0, 0, 0, 0, 0, 0] }\n[[joints]]\nname = 'hinge'\ntype = 'continuous'\nparent = 'post'\nchild = 'bob'\naxis = [0, 1, 0]\n",
    );
    let servo_s = 0.05;
    let omega = 9.81_f64.sqrt();
    let (c, s) = (libm::cosh(omega * servo_s), libm::sinh(omega * servo_s));
    let (by_effort, rate_by_effort) = ((c - 1.0) / 9.81 / 2.0, s / omega / 2.0);
    for (kp, kd, compensated) in [
        (100.0, 20.0, false),
        (100.0, 20.0, true),
        (10.0, 20.0, false),
        (10.0, 20.0, true),
        (0.0, 0.0, true),
    ] {
        let mut servo = settings(Mode::Position, Derivative::Velocity, &[[kp, 0.0, kd]]);
        servo.gravity_compensation = compensated;
        let found =
            sampled_loop(&pendulum, &servo, servo_s, &GRAVITY_M_S2, &[0.0]).expect("a loop");
        // holding the weight takes -19.62 q
        let p = if compensated { kp + 19.62 } else { kp };
        let (a, b) = (c - by_effort * p, s / omega - by_effort * kd);
        let (e, f) = (omega * s - rate_by_effort * p, c - rate_by_effort * kd);
        let expected = largest_root(a + f, a * f - b * e);
        // the slope of gravity is a difference quotient, good to 1e-10
        assert!(
            (found.spectral_radius - expected).abs() < 1e-8,
            "{found:?} {expected}"
        );
    }
    // too weak to stand: less of it does not help, nor does a faster servo
    let weak = settings(Mode::Position, Derivative::Velocity, &[[10.0, 0.0, 20.0]]);
    let found = sampled_loop(&pendulum, &weak, servo_s, &GRAVITY_M_S2, &[0.0]).expect("a loop");
    assert_eq!((found.stable_share, found.stable_period_s), (None, None));
    assert!(!found.is_stable() && found.spectral_radius < 1.2);
}

#[test]
fn the_limit_of_one_gain_is_that_of_a_calculation_by_hand() {
    // kd < 2 J / T = 400 on the rate alone; without kd any kp turns the undamped slider unstable, which no factor changes
    let slider = slider(0.0);
    let factor = |gains: [f64; 3], varied| {
        let settings = settings(Mode::Position, Derivative::Velocity, &[gains]);
        stable_gain_factor(&slider, &settings, 0.01, &GRAVITY_M_S2, &[0.0], varied)
    };
    for kd in [1.0, 100.0, 1000.0] {
        let found = factor([0.0, 0.0, kd], VariedGain::Kd).map(|factor| factor * kd);
        // beyond 256 times the gain nobody looks
        if kd < 2.0 {
            assert_eq!(found, Some(f64::INFINITY));
        } else {
            near(found, 400.0);
        }
    }
    assert_eq!(factor([100.0, 0.0, 0.0], VariedGain::Kp), None);
    // a gain of zero stays zero, whatever the factor
    let unchanged = factor([0.0, 0.0, 100.0], VariedGain::Ki);
    assert_eq!(unchanged, Some(f64::INFINITY));
}

#[test]
fn the_course_s_arm_has_the_known_radii() {
    let arm = rrbot();
    // the integral gain of 0.01 only adds a root of its own, at 1 - 1e-4 times the period
    let gains = settings(
        Mode::Position,
        Derivative::Velocity,
        &[[100.0, 0.0, 10.0]; 2],
    );
    for (servo_s, radius) in [(0.010, 1.95), (0.007, 1.10), (0.005, 0.98)] {
        let found = sampled_loop(&arm, &gains, servo_s, &GRAVITY_M_S2, &[0.0; 2]).expect("a loop");
        // printed with two decimals
        assert!(
            (found.spectral_radius - radius).abs() <= 0.0051,
            "{servo_s}: {found:?}"
        );
        assert_eq!(found.is_stable(), radius < 1.0);
        let period_s = found.stable_period_s.expect("a period");
        assert!((0.005..0.007).contains(&period_s), "{found:?}");
        if radius > 1.0 {
            // the elbow, whose arm is light, not the shoulder
            assert_eq!(found.worst_joint, 1);
            let share = found.stable_share.expect("a share");
            assert!(
                (share / (period_s / servo_s) - 1.0).abs() < 0.1,
                "{found:?}"
            );
        }
    }
}

#[test]
fn limits_of_the_undamped_arm_are_those_of_the_golden_table() {
    let text = rrbot().to_toml(&mut |path| path.to_owned());
    let kept = text.lines().filter(|line| !line.starts_with("damping"));
    let arm = robot(&kept.collect::<Vec<_>>().join("\n"));
    let golden = golden("B_nonlinear_position.json");
    let table = golden["sampled_data_stability"]["table"].as_array();
    let rows = table.expect("a table");
    assert_eq!(rows.len(), 6);
    for row in rows {
        let q = [0.3, row["q2_rad"].as_f64().expect("q2")];
        let share = |mode, gains, servo_s| {
            let settings = settings(mode, Derivative::Error, &[gains; 2]);
            let found = sampled_loop(&arm, &settings, servo_s, &Vector3::zeros(), &q);
            found.expect("a loop").stable_share_of_all
        };
        for (rate, servo_s) in [("1kHz", 0.001), ("100Hz", 0.01)] {
            let limit = |key: &str| row[key][rate].as_f64().expect(key);
            let kd = limit("max_Kd_position_loop_backward_difference");
            near(share(Mode::Position, [0.0, 0.0, 2.0 * kd], servo_s), 0.5);
            let kp = limit("max_Kp_velocity_loop");
            near(
                share(Mode::Velocity, [1.7 * kp, 0.0, 0.0], servo_s),
                1.0 / 1.7,
            );
        }
        let kd = row["max_Kd_velocity_loop_any_rate"].as_f64().expect("kd");
        near(
            share(Mode::Velocity, [0.0, 0.0, 3.0 * kd], 0.001),
            1.0 / 3.0,
        );
    }
}

#[test]
fn printed_velocity_gains_diverge_and_softer_ones_do_not() {
    let arm = rrbot();
    for scenario in golden("B_nonlinear_velocity.json")["scenarios"]
        .as_array()
        .expect("scenarios")
        .iter()
        .filter(|scenario| scenario["kind"] == "digital")
    {
        let gains = numbers(&scenario["gains"]);
        let settings = settings(
            Mode::Velocity,
            Derivative::Error,
            &[[gains[0], gains[1], gains[2]]; 2],
        );
        let servo_s = scenario["Ts"].as_f64().expect("Ts");
        let found =
            sampled_loop(&arm, &settings, servo_s, &GRAVITY_M_S2, &[0.0; 2]).expect("a loop");
        let diverges = scenario["valid_until_s"].as_f64().expect("valid") < 1.0;
        assert_eq!(
            found.is_stable(),
            !diverges,
            "{}: {found:?}",
            scenario["name"]
        );
        // the derivative of a measured velocity: no rate would help
        assert_eq!(
            found.stable_period_s.is_none(),
            gains[2] != 0.0,
            "{found:?}"
        );
    }
}

/// A robot without dry friction, which the linear statement leaves out.
fn smooth(robot: &Robot) -> Robot {
    let text = robot.to_toml(&mut |path| path.to_owned());
    let kept = text
        .lines()
        .filter(|line| !line.starts_with("dry_friction"));
    crate::arms::robot(&kept.collect::<Vec<_>>().join("\n"))
}

fn ur5() -> Robot {
    let path = format!(
        "{}/../tests/golden/models/ur5.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect(&path);
    let options = ReadOptions {
        ignore_mimic: true,
        ..ReadOptions::default()
    };
    let no_mesh = &mut |_: &str| Err("none".to_owned());
    read_robot(Source::new("ur5.urdf", text), &options, no_mesh).expect("a robot")
}

/// Two equal fingers on a slider, one after the other by a mimic joint.
fn gripper() -> Robot {
    robot(
        "format = 1\nname = 'gripper'\n[[links]]\nname = 'wrist'\n[[links]]\nname = 'left'\ninertia = { mass_kg = 0.3, com_m = [0, 0.1, 0.2], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }\n[[links]]\nname = 'right'\ninertia = { mass_kg = 0.3, com_m = [0, 0.3, 0.1], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }\n[[joints]]\nname = 'left'\ntype = 'revolute'\nparent = 'wrist'\nchild = 'left'\naxis = [1, 0, 0]\ndamping = 0.1\n[[joints]]\nname = 'right'\ntype = 'revolute'\nparent = 'wrist'\nchild = 'right'\naxis = [1, 0, 0]\ndamping = 0.2\nmimic = { joint = 'left', multiplier = -2, offset = 0.2 }\n",
    )
}

/// Runs robot and servo from near rest at `q`; whether a small push grows. Commands hold the robot at `q` by its gains.
fn grows(
    robot: &Robot,
    settings: &ServoSettings,
    servo_s: f64,
    gravity: Vector3<f64>,
    q: &[f64],
) -> bool {
    let n = robot.n();
    let hold = gravity_effort(robot, &gravity, &JointPositions::new(q.iter().copied()));
    let command: Vec<f64> = (0..n)
        .map(|i| match settings.mode {
            Mode::Position if !settings.gravity_compensation && settings.gains[i].kp > 0.0 => {
                q[i] + hold.as_slice()[i] / settings.gains[i].kp
            }
            Mode::Position => q[i],
            _ => 0.0,
        })
        .collect();
    let mut servo = Servo::new(robot, settings.clone(), servo_s, gravity).expect("fits");
    let substeps = 4;
    let mut step = SmoothStep::new(robot, gravity, servo_s / f64::from(substeps));
    let (mut at, mut qd) = (q.to_vec(), vec![0.0; n]);
    let mut effort = vec![0.0; n];
    let away = |at: &[f64], qd: &[f64]| {
        let most = |most: f64, x: f64| most.max(x.abs());
        if settings.mode == Mode::Velocity {
            qd.iter().map(|qd| qd * servo_s).fold(0.0, most)
        } else {
            at.iter().zip(q).map(|(at, q)| at - q).fold(0.0, most)
        }
    };
    // the first sample sees rest, so that differences do not kick; then a push
    servo.sample(robot, &command, &at, &qd, &mut effort);
    for (i, rate) in qd.iter_mut().enumerate() {
        *rate = 1e-7 * (1.0 + i as f64) / servo_s;
    }
    let mut after_push = 0.0;
    for sample in 0..20_000 {
        for _ in 0..substeps {
            step.advance(robot, &effort, &mut at, &mut qd)
                .expect("mass");
        }
        servo.sample(robot, &command, &at, &qd, &mut effort);
        let gone = away(&at, &qd);
        if sample < 20 {
            after_push = gone.max(after_push);
        } else if gone > 1e3 * after_push {
            return true;
        } else if gone < 1e-2 * after_push && sample > 2000 {
            return false;
        }
    }
    panic!(
        "neither grows nor decays: {settings:?}, {} of {after_push}",
        away(&at, &qd)
    );
}

/// Checks that the loop decays 5 % below each of its limits and grows 5 % above.
fn check_limits(
    robot: &Robot,
    settings: &ServoSettings,
    servo_s: f64,
    gravity: Vector3<f64>,
    q: &[f64],
) {
    let found = sampled_loop(robot, settings, servo_s, &gravity, q).expect("a loop");
    let (mode, derivative) = (settings.mode, settings.derivative);
    let label = format!("{} {mode:?} {derivative:?} {found:?}", robot.name());
    assert!(!found.is_stable() && found.spectral_radius > 1.0, "{label}");
    let share = found.stable_share_of_all.expect(&label);
    let all: Vec<usize> = (0..robot.n()).collect();
    let limits = [
        (Some(share), all),
        (found.stable_share, vec![found.worst_joint]),
    ];
    for (limit, joints) in limits {
        let Some(limit) = limit else { continue };
        for (factor, expected) in [(0.95, false), (1.05, true)] {
            let mut scaled = settings.clone();
            for &joint in &joints {
                let gains = &mut scaled.gains[joint];
                gains.kp *= factor * limit;
                gains.ki *= factor * limit;
                gains.kd *= factor * limit;
            }
            let grown = grows(robot, &scaled, servo_s, gravity, q);
            assert_eq!(
                grown, expected,
                "{factor} of {limit} on {joints:?}: {label}"
            );
        }
    }
}

#[test]
fn simulated_loops_of_the_arm_decay_below_the_limit_and_grow_above_it() {
    use Derivative::{Error, Measurement, Velocity};
    let arm = rrbot();
    let none = Vector3::zeros();
    let position = |derivative, gains| settings(Mode::Position, derivative, &[gains; 2]);
    let velocity = |derivative, gains| settings(Mode::Velocity, derivative, &[gains; 2]);
    let hard = [100.0, 0.0, 10.0];
    check_limits(&arm, &position(Error, hard), 0.01, GRAVITY_M_S2, &[0.0; 2]);
    check_limits(&arm, &position(Velocity, hard), 0.03, none, &[0.5, 1.0]);
    let integral = position(Measurement, [100.0, 20.0, 10.0]);
    check_limits(&arm, &integral, 0.02, none, &[0.0, 1.0]);
    let compensated = ServoSettings {
        gravity_compensation: true,
        ..position(Velocity, hard)
    };
    check_limits(&arm, &compensated, 0.03, GRAVITY_M_S2, &[0.5, 1.0]);
    let integral = velocity(Error, [100.0, 40.0, 0.0]);
    check_limits(&arm, &integral, 0.01, none, &[0.5, 1.0]);
    let slope = velocity(Measurement, [10.0, 0.0, 0.3]);
    check_limits(&arm, &slope, 0.01, none, &[0.5, 1.0]);
}

#[test]
fn simulated_loops_of_other_robots_do_so_too() {
    use Derivative::{Error, Measurement, Velocity};
    let none = Vector3::zeros();
    // gains by the inertia each joint moves: 15 rad/s, well damped
    let by_inertia = |robot: &Robot, derivative, q: &[f64]| {
        let mass = mass_matrix(robot, &JointPositions::new(q.iter().copied()));
        let gains: Vec<[f64; 3]> = (0..robot.n())
            .map(|i| [225.0 * mass[(i, i)], 0.0, 30.0 * mass[(i, i)]])
            .collect();
        settings(Mode::Position, derivative, &gains)
    };
    let (ur5, q) = (ur5(), [0.3, -1.2, 1.0, -0.5, 0.7, 0.2]);
    check_limits(&ur5, &by_inertia(&ur5, Velocity, &q), 0.1, none, &q);
    let compensated = ServoSettings {
        gravity_compensation: true,
        ..by_inertia(&ur5, Error, &q)
    };
    check_limits(&ur5, &compensated, 0.1, GRAVITY_M_S2, &q);
    let (puma, q) = (
        smooth(&lab_robot("puma560")),
        [0.1, 0.5, -0.4, 0.3, 0.6, 0.0],
    );
    check_limits(&puma, &by_inertia(&puma, Velocity, &q), 0.1, none, &q);
    // a loop, with a mimic joint in it
    let uarm = smooth(&lab_robot("uarm"));
    let q = closed_positions(&uarm, &vec![0.1; uarm.independent().len()]).expect("closed");
    check_limits(&uarm, &by_inertia(&uarm, Measurement, &q), 0.1, none, &q);
    let gripper = gripper();
    let compensated = ServoSettings {
        gravity_compensation: true,
        ..by_inertia(&gripper, Velocity, &[0.2])
    };
    check_limits(&gripper, &compensated, 0.1, GRAVITY_M_S2, &[0.2]);
}

#[test]
fn a_shorter_period_makes_the_same_gains_stable() {
    let arm = rrbot();
    let gains = settings(Mode::Position, Derivative::Error, &[[100.0, 0.0, 10.0]; 2]);
    let found = sampled_loop(&arm, &gains, 0.01, &GRAVITY_M_S2, &[0.0; 2]).expect("a loop");
    let period_s = found.stable_period_s.expect("a period");
    assert!(!grows(
        &arm,
        &gains,
        0.95 * period_s,
        GRAVITY_M_S2,
        &[0.0; 2]
    ));
    assert!(grows(
        &arm,
        &gains,
        1.05 * period_s,
        GRAVITY_M_S2,
        &[0.0; 2]
    ));
}

#[test]
fn a_joint_that_nothing_holds_is_on_the_edge_and_counts_as_stable() {
    for mode in [Mode::Position, Mode::Velocity] {
        let found = one(&slider(0.0), mode, Derivative::Velocity, [0.0; 3], 0.001);
        assert!((found.spectral_radius - 1.0).abs() < 1e-9, "{found:?}");
        assert!(found.is_stable());
        assert_eq!(found.stable_period_s, Some(f64::INFINITY));
    }
}

#[test]
fn what_is_no_loop_has_no_answer() {
    let arm = rrbot();
    let good = settings(Mode::Position, Derivative::Velocity, &[[10.0, 0.0, 1.0]; 2]);
    let none = |settings: &ServoSettings, servo_s: f64, q: [f64; 2]| {
        sampled_loop(&arm, settings, servo_s, &GRAVITY_M_S2, &q).is_none()
    };
    assert!(!none(&good, 0.001, [0.0; 2]));
    assert!(none(&good, 0.0, [0.0; 2]) && none(&good, f64::NAN, [0.0; 2]));
    assert!(none(&good, 0.001, [0.0, f64::NAN]));
    let with = |change: fn(&mut ServoSettings)| {
        let mut changed = good.clone();
        change(&mut changed);
        none(&changed, 0.001, [0.0; 2])
    };
    assert!(with(|s| s.mode = Mode::Effort));
    assert!(with(|s| s.mode = Mode::Velocity)); // the velocity of a velocity
    assert!(with(|s| s.gains.truncate(1)));
    assert!(with(|s| s.gains[0].kp = f64::NAN));
    assert!(with(|s| s.gains[0].kp = f64::INFINITY));
    // a joint that moves no inertia
    let empty = robot(
        "format = 1\nname = 'e'\n[[links]]\nname = 'a'\n[[links]]\nname = 'b'\n[[joints]]\nname = 'j'\ntype = 'continuous'\nparent = 'a'\nchild = 'b'\naxis = [0, 0, 1]\n",
    );
    let one = settings(Mode::Position, Derivative::Velocity, &[[10.0, 0.0, 1.0]]);
    assert!(sampled_loop(&empty, &one, 0.001, &GRAVITY_M_S2, &[0.0]).is_none());
}
