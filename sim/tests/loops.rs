//! Closed loops and mimic joints: against projections of the open tree, against each other, and against energy.

use kinemark_sim::control::servo::Servo;
use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::dynamics::{
    GRAVITY_M_S2, bias_effort, driven_efforts, energy, forward_dynamics, inverse_dynamics,
    mass_matrix,
};
use kinemark_sim::format::RobotFile;
use kinemark_sim::joint_space::{
    JointAccelerations, JointEfforts, JointPositions, JointVelocities,
};
use kinemark_sim::kinematics::closure::{LoopError, closed_positions, loop_gap_m};
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::step::smooth::SmoothStep;
use kinemark_sim::text::{Problem as _, Source};
use nalgebra::{DMatrix, Vector3};
use proptest::prelude::*;

use crate::arms::{Numbers, lab_robot, random_tree, robot};

/// A crank-rocker in the x-z plane: ground 1 m, crank 0.4, coupler 1.0, rocker 0.8; at crank 0 the 3-4-5 triangle stands on its
/// side, so that the coupler is at 53.13 degrees and the rocker upright.
fn four_bar(marks: &str, loops: &str) -> String {
    bars([0.4, 1.0, 1.0, 0.8], [0.0, 0.9, 1.6], marks, loops)
}

/// Crank, coupler, ground and rocker of these lengths \[m\]; crank, coupler and rocker looked for at `guess` \[rad\].
pub(crate) fn bars(lengths: [f64; 4], guess: [f64; 3], marks: &str, loops: &str) -> String {
    let [crank, coupler, ground, rocker] = lengths;
    let mut text = String::from("format = 1\nname = \"four-bar\"\n[[links]]\nname = \"ground\"\n");
    for (name, length) in [("crank", crank), ("coupler", coupler), ("rocker", rocker)] {
        text += &format!(
            "[[links]]\nname = \"{name}\"\nshapes = [{{ box = {{ size_m = [{length}, 0.02, 0.02] }}, origin = {{ xyz_m = [{}, 0, 0] }} }}]\ninertia = {{ mass_kg = {length} }}\n",
            length / 2.0
        );
    }
    for (i, (name, parent, x)) in [
        ("crank", "ground", 0.0),
        ("coupler", "crank", crank),
        ("rocker", "ground", ground),
    ]
    .into_iter()
    .enumerate()
    {
        let mark = if name == "crank" { "" } else { marks };
        text += &format!(
            "[[joints]]\nname = \"{name}\"\ntype = \"continuous\"\nparent = \"{parent}\"\nchild = \"{name}\"\norigin = {{ xyz_m = [{x}, 0, 0] }}\naxis = [0, -1, 0]\nguess = {:?}\n{mark}",
            guess[i]
        );
    }
    text + loops
}

const HINGE: &str = "[[loops]]\ntype = \"revolute\"\nlinks = [\"coupler\", \"rocker\"]\naxis = [0, 1, 0]\nframe_on_first = { xyz_m = [1.0, 0, 0] }\nframe_on_second = { xyz_m = [0.8, 0, 0] }\n";
const POINT: &str = "[[loops]]\ntype = \"point\"\nlinks = [\"coupler\", \"rocker\"]\nframe_on_first = { xyz_m = [1.0, 0, 0] }\nframe_on_second = { xyz_m = [0.8, 0, 0] }\n";

#[test]
fn a_four_bar_closes_where_its_triangles_say() {
    for (marks, closing) in [("passive = true\n", HINGE), ("", HINGE), ("", POINT)] {
        let robot = robot(&four_bar(marks, closing));
        assert_eq!(robot.independent(), [0], "{marks}{closing}");
        // at crank 0: B = (0.4, 0), C = (1.0, 0.8)
        let q = closed_positions(&robot, &[0.0]).expect("closed");
        assert!((q[1] - libm::atan2(0.8, 0.6)).abs() < 1e-12, "{q:?}");
        assert!((q[2] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        // all the way round, by the law of cosines on its branch
        for k in 0..=24 {
            let crank = f64::from(k) * std::f64::consts::PI / 12.0;
            let q = closed_positions(&robot, &[crank]).expect("a crank turns round");
            let (bx, bz) = (0.4 * libm::cos(crank), 0.4 * libm::sin(crank));
            let (dx, dz) = (bx - 1.0, bz);
            let d = (dx * dx + dz * dz).sqrt();
            let inner = libm::acos((d * d + 0.64 - 1.0) / (2.0 * d * 0.8));
            let rocker = libm::atan2(dz, dx) - inner;
            let off = (q[2] - rocker) / std::f64::consts::TAU;
            assert!((off - off.round()).abs() < 1e-12, "crank {crank}: {q:?}");
            assert!(loop_gap_m(&robot, &q) < 1e-14);
        }
    }
}

#[test]
fn a_four_bar_that_falls_keeps_its_energy_and_its_loop_for_20_s() {
    let robot = robot(&four_bar("passive = true\n", HINGE));
    let mut q = closed_positions(&robot, &[0.5]).expect("closed");
    let mut qd = vec![0.0; 3];
    let total = |q: &[f64], qd: &[f64]| {
        let e = energy(
            &robot,
            &GRAVITY_M_S2,
            &JointPositions::new(q.iter().copied()),
            &JointVelocities::new(qd.iter().copied()),
        );
        e.kinetic_j + e.potential_j
    };
    let start = total(&q, &qd);
    let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-3);
    let (mut gap, mut drift, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..20_000 {
        step.advance(&robot, &[0.0; 3], &mut q, &mut qd)
            .expect("regular");
        gap = gap.max(loop_gap_m(&robot, &q));
        drift = drift.max((total(&q, &qd) - start).abs());
        fastest = fastest.max(qd[0].abs());
    }
    assert!(fastest > 1.0, "it swings: {fastest} rad/s");
    assert!(gap < 1e-12, "gap {gap:.1e} m");
    // energies of several J; RK4 at 1 ms drifts by its order
    assert!(drift < 1e-7, "energy drifts by {drift:.1e} J");
    // still on its branch: the rocker has not turned over
    assert!((0.0..std::f64::consts::PI).contains(&q[2]), "{q:?}");
}

/// No drive acts on a passive joint, whatever it is commanded; one that is not marked has its own.
#[test]
fn servos_drive_no_passive_joint() {
    for (marks, driven) in [
        ("passive = true\n", [true, false, false]),
        ("", [true, true, true]),
    ] {
        let robot = robot(&four_bar(marks, HINGE));
        for mode in [Mode::Position, Mode::Velocity, Mode::Effort] {
            let gains = Gains {
                kp: 3.0,
                ki: 0.0,
                kd: 0.0,
                effort_limit: 1e3,
                integral_limit: 0.0,
            };
            let settings = ServoSettings {
                mode,
                derivative: Derivative::Measurement,
                gains: vec![gains; 3],
                gravity_compensation: false,
            };
            let mut servo =
                Servo::new(&robot, settings, 0.001, GRAVITY_M_S2).expect("it fits the robot");
            let mut effort = [f64::NAN; 3];
            servo.sample(&robot, &[9.0; 3], &[0.5; 3], &[0.0; 3], &mut effort);
            assert_eq!(effort.map(|tau| tau != 0.0), driven, "{mode:?}: {effort:?}");
        }
    }
}

#[test]
fn a_loop_holds_what_a_wrong_one_would_let_go() {
    // without its loop the same linkage falls apart
    let open = robot(&four_bar("", ""));
    assert_eq!(open.independent().len(), 3);
    let closed = robot(&four_bar("passive = true\n", HINGE));
    let q = closed_positions(&closed, &[0.5]).expect("closed");
    let at = |robot: &Robot| {
        let q = robot.positions(&q).expect("q");
        let rest = robot.velocities(&[0.0; 3]).expect("qd");
        let none = robot.efforts(&[0.0; 3]).expect("tau");
        forward_dynamics(robot, &GRAVITY_M_S2, &q, &rest, &none).expect("regular")
    };
    let difference = (at(&open).vector() - at(&closed).vector()).amax();
    assert!(difference > 0.1, "{difference}");
}

#[test]
fn forward_dynamics_of_a_loop_undoes_its_inverse_dynamics() {
    let bars = robot(&four_bar("passive = true\n", HINGE));
    let uarm = lab_robot("uarm");
    let mut r = Numbers::new(7);
    for (robot, reach) in [(&bars, 3.0), (&uarm, 0.4)] {
        for _ in 0..40 {
            let k = robot.independent().len();
            let (q, qd, qdd) = (r.vector(k, reach), r.vector(k, 2.0), r.vector(k, 5.0));
            let motion = driven_efforts(robot, &GRAVITY_M_S2, &q, &qd, &qdd).expect("driven");
            let mut effort = JointEfforts::zeros(robot.n());
            for (&i, driven) in robot.independent().iter().zip(&motion.effort) {
                effort.as_mut_slice()[i] = *driven;
            }
            let back = forward_dynamics(robot, &GRAVITY_M_S2, &motion.q, &motion.qd, &effort)
                .expect("regular");
            let error = (back.vector() - motion.qdd.vector()).amax();
            let size = 1.0 + motion.qdd.vector().amax();
            assert!(error < 1e-9 * size, "{}: {error:.1e}", robot.name());
        }
    }
}

#[test]
fn rates_along_a_loop_are_those_of_its_positions() {
    let robot = lab_robot("uarm");
    let (q0, qd0, qdd0) = ([0.3, 0.2, -0.1], [0.5, -0.7, 0.9], [1.0, 2.0, -3.0]);
    let motion = driven_efforts(&robot, &GRAVITY_M_S2, &q0, &qd0, &qdd0).expect("driven");
    let h = 1e-4; // truncation h² and round-off ε/h² meet near 1e-8
    let at = |t: f64| {
        let q: Vec<f64> = (0..3)
            .map(|i| q0[i] + t * qd0[i] + 0.5 * t * t * qdd0[i])
            .collect();
        closed_positions(&robot, &q).expect("closed")
    };
    let (plus, here, minus) = (at(h), at(0.0), at(-h));
    for i in 0..robot.n() {
        let rate = (plus[i] - minus[i]) / (2.0 * h);
        let acceleration = (plus[i] - 2.0 * here[i] + minus[i]) / (h * h);
        assert!((rate - motion.qd.as_slice()[i]).abs() < 1e-7);
        assert!((acceleration - motion.qdd.as_slice()[i]).abs() < 1e-6);
    }
}

/// A linkage whose crank cannot go round: 0.3 + 0.5 exceeds 0.2 + 0.25.
fn rocking() -> Robot {
    let hinge = HINGE.replace("[1.0,", "[0.2,").replace("[0.8,", "[0.25,");
    robot(&bars(
        [0.3, 0.2, 0.5, 0.25],
        [0.4, 1.0, 2.0],
        "passive = true\n",
        &hinge,
    ))
}

#[test]
fn a_position_out_of_reach_is_an_answer_with_the_gap_that_is_left() {
    let robot = rocking();
    let (mut reached, mut open) = (0, 0);
    for k in -125..=125 {
        let crank = f64::from(k) * 0.05;
        match closed_positions(&robot, &[crank]) {
            Ok(q) => {
                reached += 1;
                assert!(loop_gap_m(&robot, &q) < 1e-12);
            }
            Err(LoopError::Open { gap_m, .. }) => {
                open += 1;
                // between the crank's tip and the rocker's foot the other two bars reach from 0.05 to 0.45
                let (x, z) = (0.3 * libm::cos(crank) - 0.5, 0.3 * libm::sin(crank));
                let wanted = libm::hypot(x, z) - 0.45;
                assert!(wanted > 0.0, "{crank}: closed is possible there");
                // the least there is, up to the last steps of a search that creeps there
                assert!(
                    gap_m >= wanted - 1e-9 && gap_m <= 1.05 * wanted + 1e-6,
                    "{crank}: {gap_m} {wanted}"
                );
            }
            Err(LoopError::Apart) => {}
            Err(other) => panic!("{crank}: {other}"),
        }
    }
    assert!(reached > 20 && open > 100, "{reached} {open}");
    assert!(matches!(
        closed_positions(&robot, &[1e300]),
        Err(LoopError::TooFar { .. })
    ));
}

#[test]
fn near_a_flat_position_inverse_dynamics_is_right_or_an_error() {
    // a parallelogram: all bars turn at the same rate, so the coupler only translates
    let hinge = HINGE.replace("[0.8,", "[0.4,");
    let robot = robot(&bars(
        [0.4, 1.0, 1.0, 0.4],
        [1.0, -1.0, 1.0],
        "passive = true\n",
        &hinge,
    ));
    for e in [0.1_f64, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let q = [std::f64::consts::PI - e];
        match driven_efforts(&robot, &GRAVITY_M_S2, &q, &[1.0], &[0.0]) {
            Ok(motion) => {
                // potential of crank, coupler and rocker: (0.4 0.2 + 1.0 0.4 + 0.4 0.2) g sin q
                let expected = 9.81 * 0.56 * libm::cos(q[0]);
                assert!(
                    (motion.effort[0] - expected).abs() < 1e-4,
                    "{e}: {motion:?}"
                );
            }
            Err(error) => {
                assert_eq!(error, LoopError::Singular, "{e}");
                assert!(e <= 1e-5);
            }
        }
    }
}

#[test]
fn loops_that_cannot_be_are_refused_with_a_reason() {
    let refuse = |text: &str| {
        let error = RobotFile::parse(Source::new("robot.toml", text))
            .and_then(|file| file.build(&[]))
            .expect_err(text);
        (
            error.problem.code(),
            error.to_string(),
            error.line_and_column().0,
        )
    };
    let far = HINGE.replace("[1.0, 0, 0]", "[0.1, 0, 0]");
    let (code, message, _) = refuse(&four_bar("passive = true\n", &far));
    assert_eq!(code, "robot::loop");
    assert!(message.contains("cannot be closed: a gap of"), "{message}");
    let one = four_bar("passive = true\n", HINGE).replacen("passive = true\n", "", 1);
    let (code, message, _) = refuse(&one);
    assert_eq!(code, "robot::loop");
    assert!(
        message.contains("1 joints are passive, but the loops determine 2"),
        "{message}"
    );
    let (code, message, _) = refuse(&four_bar("", &HINGE.replace("\"rocker\"", "\"rocket\"")));
    assert_eq!(code, "robot::unknown_link", "{message}");
    let (code, message, _) = refuse(&four_bar("", &HINGE.replace("\"coupler\"", "\"rocker\"")));
    assert_eq!(code, "robot::loop", "{message}");
    let (code, _, _) = refuse(&four_bar(
        "",
        &POINT.replace("links", "axis = [0, 0, 1]\nlinks"),
    ));
    assert_eq!(code, "robot::axis");
}

/// The tree of `seed` with its last moving joint driven by its first, and the same tree with that joint free.
fn mimicked(seed: u64) -> Option<(Robot, Robot, usize, f64, f64)> {
    let free = random_tree(seed, 7);
    let (gear, offset) = (-1.7, 0.4);
    let n = free.n();
    if n < 2 {
        return None;
    }
    let names: Vec<String> = free.moving_joints().map(|j| j.name.clone()).collect();
    let text = free.to_toml(&mut |path| path.to_owned());
    let place = text.find(&format!("[[joints]]\nname = \"{}\"", names[n - 1]))?;
    let axis = place + text[place..].find("\naxis = ")? + 1;
    let with = format!(
        "{}mimic = {{ joint = \"{}\", multiplier = {gear}, offset = {offset} }}\n{}",
        &text[..axis],
        names[0],
        &text[axis..]
    );
    Some((free, robot(&with), n, gear, offset))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn a_mimic_joint_is_a_projection_of_the_free_one(seed in any::<u64>()) {
        let Some((free, coupled, n, gear, offset)) = mimicked(seed) else { return Ok(()) };
        prop_assert_eq!(coupled.n(), n - 1);
        let mut r = Numbers::new(seed ^ 11);
        let (q, qd, qdd) = (r.vector(n - 1, 2.0), r.vector(n - 1, 2.0), r.vector(n - 1, 4.0));
        let whole = |v: &[f64], offset: f64| -> Vec<f64> {
            v.iter().copied().chain([gear * v[0] + offset]).collect()
        };
        let full_q = JointPositions::new(whole(&q, offset));
        let full_qd = JointVelocities::new(whole(&qd, 0.0));
        let full_qdd = JointAccelerations::new(whole(&qdd, 0.0));
        let (q, qd, qdd) = (JointPositions::new(q), JointVelocities::new(qd), JointAccelerations::new(qdd));
        // B leads from the entries of q to all joints
        let b = DMatrix::from_fn(n, n - 1, |i, j| if i == j { 1.0 } else if i == n - 1 && j == 0 { gear } else { 0.0 });
        let reduce = |v: &[f64]| b.tr_mul(&nalgebra::DVector::from_column_slice(v));
        let tcp = forward_kinematics(&coupled, &q).world_from(coupled.tcp());
        let expected = forward_kinematics(&free, &full_q).world_from(free.tcp());
        prop_assert!((tcp.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-12);
        let jacobian = geometric_jacobian(&coupled, &q, coupled.tcp());
        let full = geometric_jacobian(&free, &full_q, free.tcp());
        for row in 0..6 {
            let row_of: Vec<f64> = full.row(row).iter().copied().collect();
            let error = (jacobian.row(row).transpose() - reduce(&row_of)).amax();
            prop_assert!(error < 1e-11, "row {row}: {error:.1e}");
        }
        let tau = inverse_dynamics(&coupled, &GRAVITY_M_S2, &q, &qd, &qdd);
        let full_tau = inverse_dynamics(&free, &GRAVITY_M_S2, &full_q, &full_qd, &full_qdd);
        prop_assert!((tau.vector() - reduce(full_tau.as_slice())).amax() < 1e-9);
        let bias = bias_effort(&coupled, &GRAVITY_M_S2, &q, &qd);
        let full_bias = bias_effort(&free, &GRAVITY_M_S2, &full_q, &full_qd);
        prop_assert!((bias.vector() - reduce(full_bias.as_slice())).amax() < 1e-9);
        let (m, full_m) = (mass_matrix(&coupled, &q), mass_matrix(&free, &full_q));
        for j in 0..n - 1 {
            let column = &full_m * b.column(j);
            prop_assert!((m.column(j) - reduce(column.as_slice())).amax() < 1e-10);
        }
        let back = forward_dynamics(&coupled, &GRAVITY_M_S2, &q, &qd, &tau).expect("regular");
        prop_assert!((back.vector() - qdd.vector()).amax() < 1e-7);
    }

    #[test]
    fn a_robot_written_as_a_file_is_the_same_robot(seed in any::<u64>(), joints in 1usize..10) {
        let first = random_tree(seed, joints);
        let again = robot(&first.to_toml(&mut |path| path.to_owned()));
        let n = first.n();
        prop_assert_eq!(n, again.n());
        let mut r = Numbers::new(seed ^ 12);
        let q = JointPositions::new(r.vector(n, 3.0));
        let (qd, qdd) = (JointVelocities::new(r.vector(n, 2.0)), JointAccelerations::new(r.vector(n, 2.0)));
        for (a, b) in first.frames().iter().zip(again.frames()) {
            let (a, b) = (forward_kinematics(&first, &q).world_from(a), forward_kinematics(&again, &q).world_from(b));
            prop_assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-13);
        }
        let g = Vector3::new(1.0, -2.0, -9.0);
        let tau = inverse_dynamics(&first, &g, &q, &qd, &qdd);
        let same = inverse_dynamics(&again, &g, &q, &qd, &qdd);
        prop_assert!((tau.vector() - same.vector()).amax() < 1e-10);
    }
}

#[test]
fn robots_of_the_labs_survive_being_written() {
    for name in ["rrbot", "puma560", "rppr", "uarm"] {
        let first = lab_robot(name);
        let text = first.to_toml(&mut |path| path.to_owned());
        let again = robot(&text);
        assert_eq!(first.independent(), again.independent(), "{name}");
        let names = |r: &Robot| {
            r.frames()
                .iter()
                .map(|f| f.name.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(names(&first), names(&again));
        assert!((first.mass_kg() - again.mass_kg()).abs() < 1e-12);
        for (a, b) in first.home().iter().zip(again.home()) {
            assert!(
                (a - b).abs() < 1e-9,
                "{name}: {:?} {:?}",
                first.home(),
                again.home()
            );
        }
    }
}
