//! How frames move, against independent numbers and against difference quotients of where they are.

use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::format::ReadOptions;
use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::kinematics::analytic::{Angles, analytic_jacobian};
use kinemark_sim::kinematics::centre_of_mass::{Counted, centre_of_mass};
use kinemark_sim::kinematics::chain::Chain;
use kinemark_sim::kinematics::derivative::jacobian_derivative;
use kinemark_sim::kinematics::{forward_kinematics, frame_twist, geometric_jacobian};
use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::spatial::Pose;
use kinemark_sim::text::Source;
use nalgebra::{DVector, Matrix3xX, Point3, Vector3};
use serde_json::Value;

use crate::arms::read_robot;
use crate::arms::{Numbers, random_tree, robot};
use crate::golden_rrbot::{golden, numbers};

/// Central differences: truncation O(h²) and round-off O(ε/h) meet near 1e-10 for numbers of the size of one.
const H: f64 = 1e-5;
const DIFFERENCE_TOLERANCE: f64 = 2e-9;

/// The robot of a golden file, every joint with an entry of its own.
pub(crate) fn model(name: &str) -> Robot {
    let path = format!(
        "{}/../tests/golden/models/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    let source = Source::new(
        name.to_owned(),
        std::fs::read_to_string(&path).expect(&path),
    );
    let options = ReadOptions {
        ignore_mimic: true,
        ..ReadOptions::default()
    };
    read_robot(source, &options, &mut |_| Err("none".to_owned())).expect("a robot")
}

/// Values of a golden file, which have its own order of joints, in the robot's order.
pub(crate) fn in_order(robot: &Robot, order: &Value, values: &[f64]) -> Vec<f64> {
    let order: Vec<&str> = order
        .as_array()
        .expect("joint order")
        .iter()
        .map(|v| v.as_str().expect("a name"))
        .collect();
    let place = |name: &str| order.iter().position(|o| *o == name).expect("the joint");
    robot
        .moving_joints()
        .map(|joint| values[place(&joint.name)])
        .collect()
}

/// Pose and Jacobian of a chain against the numbers of one state.
fn check_chain(
    robot: &Robot,
    frame: &str,
    q: &[f64],
    pose_rows: &Value,
    jacobian: Option<(&Value, &Value)>,
) {
    let mut chain = Chain::new(robot, robot.frame(frame).expect("the frame"));
    let pose: Pose = chain.update(q);
    for i in 0..3 {
        let row = numbers(&pose_rows[i]);
        let turned = pose.rotation.matrix().row(i);
        for (got, expected) in turned.iter().zip(&row) {
            assert!((got - expected).abs() <= 1e-10, "{frame}");
        }
        assert!(
            (pose.translation.vector[i] - row[3]).abs() <= 1e-10,
            "{frame}"
        );
    }
    let Some((rows, order)) = jacobian else {
        return;
    };
    let joints = chain.joints().to_vec();
    let columns = chain.jacobian();
    for i in 0..6 {
        let row = in_order(robot, order, &numbers(&rows[i]));
        for (joint, expected) in row.iter().enumerate() {
            let got = joints
                .iter()
                .position(|j| *j == joint)
                .map_or(0.0, |k| columns[k][i]);
            assert!(
                (got - expected).abs() <= 1e-10,
                "{frame}: {got} against {expected}"
            );
        }
    }
}

#[test]
fn poses_jacobians_and_centres_of_mass_agree_with_pinocchio() {
    for (name, file) in [("ur5", "H_ur5.json"), ("panda", "H_panda.json")] {
        let robot = model(name);
        let file = golden(file);
        let frame = file["frame"].as_str().expect("frame");
        let default: Value = robot
            .moving_joints()
            .map(|j| j.name.clone())
            .collect::<Vec<_>>()
            .into();
        let order = file["convention"].get("joint_order").unwrap_or(&default);
        let states = file["states"].as_array().expect("states");
        assert_eq!(states.len(), 21);
        for state in states {
            let q = in_order(&robot, order, &numbers(&state["q"]));
            check_chain(&robot, frame, &q, &state["T"], Some((&state["J"], order)));
            check_com(&robot, q, &state["com"]);
        }
    }
    let robot = model("humanoid25");
    let file = golden("F_humanoid25.json");
    let order = &file["conventions"]["joint_order"];
    let states = file["states"].as_array().expect("states");
    assert_eq!(states.len(), 21);
    for state in states {
        let q = in_order(&robot, order, &numbers(&state["q"]));
        for (frame, pose) in state["fk_3x4"].as_object().expect("frames") {
            let jacobian = state["jac_6xn"].get(frame);
            check_chain(&robot, frame, &q, pose, jacobian.map(|j| (j, order)));
        }
        check_com(&robot, q, &state["com"]);
    }
}

/// The golden files count what joints move only, also the one that says otherwise: its numbers fit no other reading.
fn check_com(robot: &Robot, q: Vec<f64>, expected: &Value) {
    let q = JointPositions::new(q);
    let moving = centre_of_mass(robot, &q, Counted::MovingLinks).expect("mass");
    assert!((moving - Vector3::from_vec(numbers(expected))).amax() <= 1e-10);
    // with what is fixed to the world, from the links themselves
    let whole = centre_of_mass(robot, &q, Counted::WholeRobot).expect("mass");
    let (mass_kg, moment) = fixed_to_world(robot);
    let sum = moving * (robot.mass_kg() - mass_kg) + moment;
    assert!((whole * robot.mass_kg() - sum).amax() <= 1e-13 * robot.mass_kg());
}

/// Mass \[kg\] and first moment in the world \[kg m\] of the links that no joint moves.
fn fixed_to_world(robot: &Robot) -> (f64, Vector3<f64>) {
    let mut sum = (0.0, Vector3::zeros());
    for link in robot.links() {
        if link.attachment.body.is_none() {
            let here = link.attachment.body_from_here * Point3::from(link.inertia.com_m);
            sum.0 += link.inertia.mass_kg;
            sum.1 += here.coords * link.inertia.mass_kg;
        }
    }
    sum
}

fn moved(q: &[f64], qd: &[f64], h: f64) -> JointPositions {
    JointPositions::new(q.iter().zip(qd).map(|(q, qd)| q + h * qd))
}

#[test]
fn the_derivative_of_the_jacobian_is_its_difference_quotient() {
    for seed in 0..10 {
        let robot = random_tree(seed, 9);
        let frame = robot.tcp();
        let mut numbers = Numbers::new(seed + 100);
        let (q, qd) = (
            numbers.vector(robot.n(), 2.0),
            numbers.vector(robot.n(), 1.0),
        );
        let rates = robot.velocities(&qd).expect("qd");
        let derivative = jacobian_derivative(&robot, &moved(&q, &qd, 0.0), &rates, frame);
        let [before, after] =
            [-H, H].map(|h| geometric_jacobian(&robot, &moved(&q, &qd, h), frame));
        let quotient = (after - before) / (2.0 * H);
        assert!(
            (&derivative - quotient).amax() <= 10.0 * DIFFERENCE_TOLERANCE,
            "seed {seed}"
        );
        // J' qd is what the frame accelerates by while no joint does
        let [before, after] =
            [-H, H].map(|h| frame_twist(&robot, &moved(&q, &qd, h), &rates, frame).to_vector());
        let bias = (after - before) / (2.0 * H);
        assert!((derivative * rates.vector() - bias).amax() <= 10.0 * DIFFERENCE_TOLERANCE);
    }
}

#[test]
fn the_analytic_jacobian_moves_position_and_angles() {
    let robot = model("panda");
    let frame = robot.frame("panda_hand_tcp").expect("tcp");
    let mut numbers = Numbers::new(3);
    for angles in [Angles::RollPitchYaw, Angles::Zyz] {
        for _ in 0..20 {
            let (q, qd) = (
                numbers.vector(robot.n(), 1.5),
                numbers.vector(robot.n(), 1.0),
            );
            let jacobian = analytic_jacobian(&robot, &moved(&q, &qd, 0.0), frame, angles)
                .expect("not singular");
            let rates = jacobian * DVector::from_column_slice(&qd);
            let at = |h: f64| {
                let pose = forward_kinematics(&robot, &moved(&q, &qd, h)).world_from(frame);
                (pose.translation.vector, angles.of(pose.rotation.matrix()))
            };
            let ((p0, a0), (p1, a1)) = (at(-H), at(H));
            let scale = 1.0 + rates.amax();
            for i in 0..3 {
                assert!(
                    (rates[i] - (p1[i] - p0[i]) / (2.0 * H)).abs() <= scale * DIFFERENCE_TOLERANCE
                );
                let turned = within_half_a_turn(a1[i] - a0[i]) / (2.0 * H);
                // near a singular angle the rates are large and change fast
                assert!(
                    (rates[3 + i] - turned).abs() <= scale * scale * scale * DIFFERENCE_TOLERANCE,
                    "{angles:?}"
                );
            }
        }
    }
}

/// The same angle between -pi and pi.
fn within_half_a_turn(angle: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    angle - turn * (angle / turn).round()
}

#[test]
fn gravity_feels_how_the_centre_of_mass_moves() {
    for seed in 0..10 {
        let robot = random_tree(seed, 8);
        let mut numbers = Numbers::new(seed);
        let (q, qd) = (
            numbers.vector(robot.n(), 2.0),
            numbers.vector(robot.n(), 1.0),
        );
        let [before, after] = [-H, H].map(|h| {
            centre_of_mass(&robot, &moved(&q, &qd, h), Counted::WholeRobot).expect("mass")
        });
        // its Jacobian, from those of frames at the links' own centres of mass, weighted by mass
        let here = moved(&q, &qd, 0.0);
        let mut moments = Matrix3xX::zeros(robot.n());
        for (i, link) in robot.links().iter().enumerate() {
            let mut attachment = link.attachment.clone();
            let p_com = attachment
                .body_from_here
                .transform_point(&link.inertia.com_m.into());
            attachment.body_from_here.translation.vector = p_com.coords;
            let at_com = Frame {
                name: link.name.clone(),
                link: i,
                attachment,
            };
            let of_link = geometric_jacobian(&robot, &here, &at_com);
            moments += of_link.fixed_rows::<3>(0) * link.inertia.mass_kg;
        }
        let velocity = &moments * DVector::from_column_slice(&qd) / robot.mass_kg();
        assert!((velocity - (after - before) / (2.0 * H)).amax() <= DIFFERENCE_TOLERANCE);
        // the effort that holds the robot still is the weight seen through this Jacobian
        let held = kinemark_sim::dynamics::gravity_effort(&robot, &GRAVITY_M_S2, &here);
        for (column, effort) in moments.column_iter().zip(held.as_slice()) {
            let weight = -column.dot(&GRAVITY_M_S2);
            assert!((weight - effort).abs() <= 1e-11, "seed {seed}");
        }
    }
    let massless = robot("format = 1\nname = \"m\"\nlinks = [{ name = \"a\" }]");
    assert_eq!(
        centre_of_mass(&massless, &JointPositions::zeros(0), Counted::WholeRobot),
        None
    );
}
