//! Robots of URDF files against `tests/golden/{H_*,F_*}.json`: numbers of Pinocchio 4.1.0 (FK, Jacobians, RNEA, CRBA, ABA, centre of
//! mass), which MuJoCo repeats to 1.2e-13. Arrays there follow each file's own `joint_order`, so all is matched by joint name.

use kinemark_sim::dynamics::{
    GRAVITY_M_S2, bias_effort, energy, forward_dynamics, gravity_effort, inverse_dynamics,
    mass_matrix,
};
use kinemark_sim::format::ReadOptions;
use kinemark_sim::joint_space::{JointEfforts, JointPositions};
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::{Link, Robot};
use kinemark_sim::spatial::Pose;
use kinemark_sim::text::Source;
use nalgebra::{Matrix6xX, Vector3};
use serde_json::Value;

use crate::arms::read_robot;
use crate::golden_rrbot::{golden, numbers};

/// Poses and Jacobians, as stated for the files: their numbers are rounded to 12 digits.
const POSE: f64 = 1e-10;
/// Efforts and mass matrices, as stated for the `H` files, \[N m\] and \[kg m²\] up to a few hundred.
const EFFORT: f64 = 1e-9;
/// Accelerations, relative to the largest, as stated for the `H` files: light wrists make them ill conditioned.
const ACCELERATION: f64 = 1e-8;

fn read(text: String, ignore_mimic: bool) -> Robot {
    let no_mesh = &mut |_: &str| Err("none".to_owned());
    read_robot(
        Source::new("golden.urdf", text),
        &ReadOptions {
            ignore_mimic,
            ..ReadOptions::default()
        },
        no_mesh,
    )
    .unwrap_or_else(|error| panic!("{:?}: {error}", error.line_and_column()))
}

fn model(name: &str, ignore_mimic: bool) -> Robot {
    let path = format!(
        "{}/../tests/golden/models/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    read(std::fs::read_to_string(&path).expect(&path), ignore_mimic)
}

fn close(got: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (got - expected).abs() <= tolerance,
        "{what}: {got} against {expected}"
    );
}

/// For each entry of `q`, where the golden arrays have it.
fn places(robot: &Robot, order: &Value) -> Vec<usize> {
    let order = order.as_array().expect("joint_order");
    let places: Vec<usize> = robot
        .moving_joints()
        .map(|joint| {
            let place = order.iter().position(|name| *name == joint.name.as_str());
            place.unwrap_or_else(|| panic!("no joint `{}` in joint_order", joint.name))
        })
        .collect();
    assert_eq!(places.len(), order.len());
    places
}

struct Golden<'a> {
    robot: &'a Robot,
    places: Vec<usize>,
}

impl Golden<'_> {
    /// An array of the file in the robot's order.
    fn array(&self, value: &Value) -> Vec<f64> {
        let theirs = numbers(value);
        self.places.iter().map(|&p| theirs[p]).collect()
    }

    fn positions(&self, state: &Value) -> JointPositions {
        self.robot.positions(&self.array(&state["q"])).expect("q")
    }

    fn pose(&self, pose: &Pose, rows: &Value) {
        let m = pose.to_homogeneous();
        for row in 0..3 {
            for (column, expected) in numbers(&rows[row]).into_iter().enumerate() {
                close(m[(row, column)], expected, POSE, "pose");
            }
        }
    }

    fn jacobian(&self, jacobian: &Matrix6xX<f64>, rows: &Value) {
        for row in 0..6 {
            for (column, expected) in self.array(&rows[row]).into_iter().enumerate() {
                close(jacobian[(row, column)], expected, POSE, "jacobian");
            }
        }
    }

    fn efforts(&self, got: &JointEfforts, expected: &Value, tolerance: f64, what: &str) {
        for (got, expected) in got.as_slice().iter().zip(self.array(expected)) {
            close(*got, expected, tolerance, what);
        }
    }

    fn frame(&self, q: &JointPositions, name: &str, pose: &Value, jacobian: Option<&Value>) {
        let frame = self.robot.frame(name).expect(name);
        self.pose(&forward_kinematics(self.robot, q).world_from(frame), pose);
        if let Some(rows) = jacobian {
            self.jacobian(&geometric_jacobian(self.robot, q, frame), rows);
        }
    }

    /// What every file of robots has in every state.
    fn dynamics(&self, state: &Value, tolerance: f64) {
        let (robot, g) = (self.robot, GRAVITY_M_S2);
        let q = self.positions(state);
        let qd = robot.velocities(&self.array(&state["v"])).expect("v");
        let qdd = robot.accelerations(&self.array(&state["a"])).expect("a");
        let tau = inverse_dynamics(robot, &g, &q, &qd, &qdd);
        self.efforts(&tau, &state["rnea"], tolerance, "rnea");
        let gravity = gravity_effort(robot, &g, &q);
        self.efforts(&gravity, &state["gravity"], tolerance, "gravity");
        // the files promise the whole robot, but Pinocchio leaves out what is fixed to the world
        let com = centre_of_mass(robot, &q, |link| link.attachment.body.is_some());
        for (got, expected) in com.iter().zip(numbers(&state["com"])) {
            close(*got, expected, POSE, "centre of mass");
        }
    }

    /// What the `H` files have besides.
    fn mass_and_acceleration(&self, state: &Value) {
        let (robot, g) = (self.robot, GRAVITY_M_S2);
        let q = self.positions(state);
        let qd = robot.velocities(&self.array(&state["v"])).expect("v");
        let coriolis = bias_effort(robot, &Vector3::zeros(), &q, &qd);
        self.efforts(
            &coriolis,
            &state["coriolis_torque"],
            EFFORT,
            "velocity terms",
        );
        let m = mass_matrix(robot, &q);
        for (row, &place) in self.places.iter().enumerate() {
            let expected = self.array(&state["mass_matrix"][place]);
            for (column, expected) in expected.into_iter().enumerate() {
                close(m[(row, column)], expected, EFFORT, "mass matrix");
            }
        }
        let tau = robot.efforts(&self.array(&state["tau_in"])).expect("tau");
        let qdd = forward_dynamics(robot, &g, &q, &qd, &tau).expect("mass everywhere");
        let expected = self.array(&state["aba_ddq"]);
        let largest = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (got, expected) in qdd.as_slice().iter().zip(expected) {
            close(*got, expected, ACCELERATION * largest, "aba");
        }
    }
}

/// The sum over links that `counts`.
fn centre_of_mass(
    robot: &Robot,
    q: &JointPositions,
    counts: impl Fn(&Link) -> bool,
) -> Vector3<f64> {
    let poses = forward_kinematics(robot, q);
    let (mut moment, mut mass) = (Vector3::zeros(), 0.0);
    for link in robot.links().iter().filter(|link| counts(link)) {
        let frame = robot.frame(&link.name).expect("every link is a frame");
        let pose = poses.world_from(frame);
        let com = pose.rotation * link.inertia.com_m + pose.translation.vector;
        moment += com * link.inertia.mass_kg;
        mass += link.inertia.mass_kg;
    }
    moment / mass
}

fn states(file: &Value) -> &[Value] {
    let states = file["states"].as_array().expect("states");
    assert_eq!(states.len(), 21);
    states
}

fn industrial(json: &str, model_name: &str) {
    let file = golden(json);
    let robot = model(model_name, true);
    let golden = Golden {
        robot: &robot,
        places: places(&robot, &file["convention"]["joint_order"]),
    };
    if let Some(mass) = file["total_mass"].as_f64() {
        close(robot.mass_kg(), mass, 1e-11, "mass"); // given to 12 digits
    }
    for state in states(&file) {
        let q = golden.positions(state);
        match file["frame"].as_str() {
            Some(name) => golden.frame(&q, name, &state["T"], Some(&state["J"])),
            None => {
                for name in ["l11", "l06"] {
                    golden.frame(&q, name, &state["T"][name], Some(&state["J"][name]));
                }
            }
        }
        golden.dynamics(state, EFFORT);
        golden.mass_and_acceleration(state);
    }
}

#[test]
fn the_ur5_agrees() {
    industrial("H_ur5.json", "ur5");
    let robot = model("ur5", false);
    // its root is last in the file and first in the robot
    assert_eq!(robot.links()[0].name, "world");
    assert_eq!(robot.links()[1].name, "base_link");
    assert_eq!(robot.warnings(), [""; 0]);
}

#[test]
fn a_random_tree_with_turned_inertial_frames_agrees() {
    industrial("H_randtree.json", "randtree");
}

#[test]
fn the_panda_agrees_with_both_fingers_free() {
    industrial("H_panda.json", "panda");
    assert_eq!(model("panda", true).n(), 9);
}

#[test]
fn the_panda_agrees_with_one_finger_following_the_other() {
    let file = golden("H_panda.json");
    let robot = model("panda", false);
    assert_eq!(robot.n(), 8);
    let names: Vec<&str> = robot.moving_joints().map(|j| j.name.as_str()).collect();
    assert_eq!(names.last(), Some(&"panda_finger_joint1"));
    let (left, right) = (
        robot.frame("panda_leftfinger").expect("left"),
        robot.frame("panda_rightfinger").expect("right"),
    );
    // with q = S p for the eight p, gravity is Sᵀ g and the mass matrix Sᵀ M S of the nine
    for state in states(&file) {
        let nine = numbers(&state["q"]);
        let free = model("panda", true);
        let mut coupled = nine.clone();
        coupled[8] = coupled[7];
        let q9 = free.positions(&coupled).expect("nine");
        let q8 = robot.positions(&coupled[..8]).expect("eight");
        let fold = |values: &[f64]| {
            let mut folded = values[..8].to_vec();
            folded[7] += values[8];
            folded
        };
        let g9 = gravity_effort(&free, &GRAVITY_M_S2, &q9);
        let g8 = gravity_effort(&robot, &GRAVITY_M_S2, &q8);
        for (got, expected) in g8.as_slice().iter().zip(fold(g9.as_slice())) {
            close(*got, expected, 1e-12, "gravity"); // sums in another order
        }
        let (m9, m8) = (mass_matrix(&free, &q9), mass_matrix(&robot, &q8));
        let rows: Vec<Vec<f64>> = (0..9)
            .map(|row| fold(&(0..9).map(|c| m9[(row, c)]).collect::<Vec<_>>()))
            .collect();
        for column in 0..8 {
            let of_column: Vec<f64> = rows.iter().map(|row| row[column]).collect();
            for (row, expected) in fold(&of_column).into_iter().enumerate() {
                close(m8[(row, column)], expected, 1e-12, "mass matrix");
            }
        }
        let poses = forward_kinematics(&robot, &q8);
        let between =
            poses.world_from(left).translation.vector - poses.world_from(right).translation.vector;
        close(between.norm(), 2.0 * coupled[7], 1e-15, "opening");
        // the arm does not see the difference: the file's pose holds for both
        let golden = Golden {
            robot: &robot,
            places: (0..8).collect(),
        };
        golden.frame(&q8, "panda_hand_tcp", &state["T"], None);
    }
}

#[test]
fn the_humanoid_agrees() {
    let file = golden("F_humanoid25.json");
    let robot = model("humanoid25", false);
    assert_eq!(robot.n(), 25);
    let golden = Golden {
        robot: &robot,
        places: places(&robot, &file["conventions"]["joint_order"]),
    };
    close(
        robot.mass_kg(),
        file["total_mass_kg"].as_f64().expect("mass"),
        1e-12,
        "mass",
    );
    for state in states(&file) {
        let q = golden.positions(state);
        let qd = robot.velocities(&golden.array(&state["v"])).expect("v");
        for (name, pose) in state["fk_3x4"].as_object().expect("frames") {
            golden.frame(&q, name, pose, state["jac_6xn"].get(name));
        }
        golden.dynamics(state, POSE); // stated for this file: 1e-10
        let bias = bias_effort(&robot, &GRAVITY_M_S2, &q, &qd);
        golden.efforts(&bias, &state["nonlinear_effects"], POSE, "bias");
        let trace = mass_matrix(&robot, &q).trace();
        close(
            trace,
            state["trace_M"].as_f64().expect("trace"),
            POSE,
            "trace",
        );
        let kinetic = energy(&robot, &GRAVITY_M_S2, &q, &qd).kinetic_j;
        let expected = state["kinetic_energy"].as_f64().expect("energy");
        close(kinetic, expected, POSE, "kinetic energy");
    }
}

#[test]
fn a_urdf_written_as_a_robot_file_is_the_same_robot() {
    for name in ["ur5", "panda", "randtree", "humanoid25"] {
        let robot = model(name, false);
        let text = robot.to_toml(&mut str::to_owned);
        let again = crate::arms::robot(&text);
        assert_eq!(robot.n(), again.n(), "{name}");
        let q = JointPositions::new((0..robot.n()).map(|i| 0.1 * i as f64 - 0.5));
        let (poses, again_poses) = (
            forward_kinematics(&robot, &q),
            forward_kinematics(&again, &q),
        );
        for frame in robot.frames() {
            let other = again.frame(&frame.name).expect(&frame.name);
            let (here, there) = (poses.world_from(frame), again_poses.world_from(other));
            let error = (here.to_homogeneous() - there.to_homogeneous()).amax();
            assert!(error <= 1e-14, "{name}, {}: {error:.1e}", frame.name); // numbers of size 1
        }
        let error = (mass_matrix(&robot, &q) - mass_matrix(&again, &q)).amax();
        assert!(error <= 1e-12, "{name}: {error:.1e}"); // up to 20 kg
    }
}

#[test]
fn the_pairs_printed_in_the_thesis_agree() {
    let file = golden("F_thesis_snippets.json");
    let pairs = file["pairs"].as_array().expect("pairs");
    assert_eq!(pairs.len(), 2);
    for pair in pairs {
        let words = |value: &Value| -> String {
            let words: Vec<String> = numbers(value).iter().map(f64::to_string).collect();
            words.join(" ")
        };
        let link = |link: &Value| {
            let inertia: String = link["inertia"]
                .as_object()
                .expect("inertia")
                .iter()
                .map(|(name, value)| format!(" {name}=\"{value}\""))
                .collect();
            format!(
                "<link name={}><inertial><origin xyz=\"{}\"/><mass value=\"{}\"/><inertia{inertia}/></inertial></link>",
                link["link"],
                words(&link["com"]),
                link["mass"]
            )
        };
        let joint = &pair["joint"];
        let text = format!(
            "<robot name=\"pair\">{}{}<joint name={} type=\"revolute\"><origin xyz=\"{}\" rpy=\"{}\"/><parent link={}/>\
             <child link={}/><axis xyz=\"{}\"/><limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/></joint></robot>",
            link(&pair["parent"]),
            link(&pair["child"]),
            joint["name"],
            words(&joint["xyz"]),
            words(&joint["rpy"]),
            pair["parent"]["link"],
            pair["child"]["link"],
            words(&joint["axis"]),
            joint["lower"],
            joint["upper"],
            joint["effort"],
            joint["velocity"]
        );
        let robot = read(text, false);
        let golden = Golden {
            robot: &robot,
            places: vec![0],
        };
        let mass = pair["pair_mass_kg"].as_f64().expect("mass");
        close(robot.mass_kg(), mass, 1e-15, "mass");
        let child = pair["child"]["link"].as_str().expect("child");
        let samples = pair["samples"].as_array().expect("samples");
        assert_eq!(samples.len(), 21);
        for sample in samples {
            let q = golden.positions(sample);
            let qd = robot.velocities(&numbers(&sample["v"])).expect("v");
            let qdd = robot.accelerations(&numbers(&sample["a"])).expect("a");
            golden.frame(&q, child, &sample["T_child"], None);
            for (got, expected) in centre_of_mass(&robot, &q, |_| true)
                .iter()
                .zip(numbers(&sample["com_pair"]))
            {
                close(*got, expected, POSE, "centre of mass");
            }
            for (gravity, expected) in [
                (-Vector3::z(), &sample["rnea_gravity_minus_z"]),
                (-Vector3::y(), &sample["rnea_gravity_minus_y"]),
            ] {
                let tau = inverse_dynamics(&robot, &(gravity * 9.81), &q, &qd, &qdd);
                golden.efforts(&tau, expected, POSE, "rnea");
            }
        }
    }
}
