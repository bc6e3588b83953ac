//! Contact and wrench sensors: forces by hand, and joints against the efforts that move them.

use kinemark_sim::model::contact::Party;
use kinemark_sim::model::scene::Wind;
use kinemark_sim::model::sensor::Seen;
use kinemark_sim::sensing::Sensors;
use nalgebra::Vector3;

use crate::arms::{Numbers, random_tree, robot};
use crate::contact_scenes::{scene, shelf};
use crate::sensor_rig::{DT, Rig, equipped, sensors, still};

/// A cart along x that carries a foot along z; the foot's joint is 0.4 m above its sole.
const FOOT: &str = "
format = 1
name = 'foot'
[[links]]
name = 'base'
[[links]]
name = 'cart'
inertia = { mass_kg = 3.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
[[links]]
name = 'foot'
shapes = [{ box = { size_m = [0.1, 0.1, 0.1] }, origin = { xyz_m = [0, 0, -0.35] } }]
inertia = { mass_kg = 1.0 }
[[joints]]
name = 'drive'
type = 'prismatic'
parent = 'base'
child = 'cart'
axis = [1, 0, 0]
damping = 5.0
[[joints]]
name = 'press'
type = 'prismatic'
parent = 'cart'
child = 'foot'
axis = [0, 0, 1]
[[sensors]]
name = 'sole'
type = 'contact'
link = 'foot'
[[sensors]]
name = 'ankle'
type = 'wrench'
joint = 'press'
[[sensors]]
name = 'hip'
type = 'wrench'
joint = 'drive'
";

#[test]
fn a_foot_that_is_pressed_and_dragged_feels_the_ground() {
    let mut rig = Rig::new(robot(FOOT), &scene(Vec::new()), &[0.0, 0.401], DT);
    for _ in 0..500 {
        rig.advance(&[0.0, -5.0]);
    }
    // 5 N and the weight of 1 kg, to a part in a thousand: contact is a little soft
    let normal = 5.0 + 9.81;
    let sole = rig.reading("sole")[0];
    assert!((sole / normal - 1.0).abs() < 1e-3, "{sole}");
    // the cart pushes the foot down with 5 N, whatever the foot weighs, and nothing else passes
    let ankle = rig.reading("ankle");
    let expected = [0.0, 0.0, -5.0, 0.0, 0.0, 0.0];
    for (read, expected) in ankle.iter().zip(expected) {
        assert!((read - expected).abs() < 1e-3 * normal, "{ankle:?}");
    }
    // the base carries the cart, less what the ground takes
    let hip = rig.reading("hip");
    assert!(
        (hip[2] - (3.0 * 9.81 - 5.0)).abs() < 1e-3 * normal,
        "{hip:?}"
    );

    // dragged at a steady 0.2 m/s, the ground holds the foot back with 0.4 of the normal force
    for _ in 0..1000 {
        let drag = 400.0 * (0.2 - rig.qd[0]);
        rig.advance(&[drag, -5.0]);
    }
    let (ankle, hip) = (rig.reading("ankle"), rig.reading("hip"));
    let friction = 0.4 * normal;
    assert!(
        (ankle[0] / friction - 1.0).abs() < 5e-3,
        "{ankle:?} {friction}"
    );
    // what the motor gives, less damping, passes through the drive
    let driven = rig.effort[0] - 5.0 * rig.qd[0];
    assert!((hip[0] / driven - 1.0).abs() < 5e-3, "{hip:?} {driven}");
    // friction at the sole, 0.4 m below, and pressure that has moved forward; the moment is theirs about the joint
    let [fact] = rig.contacts[..] else {
        panic!("{:?}", rig.contacts)
    };
    let back = -(fact.friction_impulse_n_s / DT);
    assert_eq!(fact.parties, [Party::Link(2), Party::Ground]);
    assert!((back.x / -friction - 1.0).abs() < 5e-3, "{back}");
}

#[test]
fn a_wrench_at_rest_is_weight_and_moment() {
    let robot = equipped(
        "rrbot",
        "[[sensors]]\nname = 'e'\ntype = 'wrench'\njoint = 'elbow'\n[[sensors]]\nname = 's'\ntype = 'wrench'\njoint = 'shoulder'\n",
    );
    let mut sensors = sensors(&robot);
    // stretched out forwards: x of both links points down, z forwards
    sensors.sample(
        &still(&robot, &[std::f64::consts::FRAC_PI_2, 0.0], &[0.0; 2]),
        None,
    );
    let half = 0.5 * 9.81;
    // y: the forearm's centre is 0.025 m beside the elbow's parent joint
    let by_hand = [
        [-half, 0.0, 0.0, 0.0, -0.5 * half, 0.0],
        [
            -2.0 * half,
            0.0,
            0.0,
            0.0,
            -0.5 * half - 1.5 * half,
            0.025 * half,
        ],
    ];
    for (i, expected) in by_hand.iter().enumerate() {
        let read = sensors.reading(i);
        for (read, expected) in read.iter().zip(expected) {
            // a few roundings of ten newtons
            assert!((read - expected).abs() < 1e-14, "{i}: {read} {expected}");
        }
    }
}

const TURNTABLE: &str = "
format = 1
name = 'turntable'
[[links]]
name = 'base'
[[links]]
name = 'table'
inertia = { mass_kg = 5.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
[[links]]
name = 'tool'
inertia = { mass_kg = 2.0, com_m = [0, 0.2, 0], tensor_kg_m2 = [0.1, 0.2, 0.15, 0, 0, 0] }
[[joints]]
name = 'turn'
type = 'continuous'
parent = 'base'
child = 'table'
axis = [0, 0, 1]
[[joints]]
name = 'wrist'
type = 'fixed'
parent = 'table'
child = 'tool'
origin = { xyz_m = [0.5, 0, 0], rpy_deg = [0, 0, 90] }
[[sensors]]
name = 'w'
type = 'wrench'
joint = 'wrist'
";

#[test]
fn a_fixed_joint_feels_weight_and_centrifugal_force() {
    let robot = robot(TURNTABLE);
    let mut sensors = sensors(&robot);
    let check = |sensors: &Sensors, expected: [f64; 6]| {
        for (read, expected) in sensors.reading(0).iter().zip(expected) {
            // roundings of twenty newtons
            assert!((read - expected).abs() < 1e-13, "{read} {expected}");
        }
    };
    // r x F = (0, 0.2, 0) x (0, 0, m g)
    sensors.sample(&still(&robot, &[0.7], &[0.0]), None);
    let weight = 2.0 * 9.81;
    check(&sensors, [0.0, 0.0, weight, 0.2 * weight, 0.0, 0.0]);
    // the centre is at (0.5 - 0.2, 0) of the table: y of the tool points inwards, and so does the force m w² r
    let spinning = Seen {
        qd: &[3.0],
        ..still(&robot, &[0.7], &[0.0])
    };
    sensors.sample(&spinning, None);
    let inwards = 2.0 * 9.0 * 0.3;
    check(&sensors, [0.0, inwards, weight, 0.2 * weight, 0.0, 0.0]);
}

#[test]
fn in_smooth_motion_a_wrench_along_the_axis_is_the_effort_less_damping() {
    // the greatest error of any joint of any step, on trees of all kinds of joints
    let worst = |dt_s: f64| {
        let mut worst = 0.0_f64;
        for seed in 1..=6 {
            let tree = random_tree(seed, 7);
            let moving: Vec<usize> = (0..tree.joints().len())
                .filter(|joint| tree.joints()[*joint].axis != Vector3::zeros())
                .collect();
            let gauges: String = moving
                .iter()
                .map(|joint| {
                    let name = &tree.joints()[*joint].name;
                    format!("[[sensors]]\nname = '{name}'\ntype = 'wrench'\njoint = '{name}'\n")
                })
                .collect();
            let tree = robot(&(tree.to_toml(&mut str::to_owned) + "\n" + &gauges));
            let mut empty = scene(Vec::new());
            empty.environment.ground = None;
            let start = Numbers::new(seed).vector(tree.n(), 1.0);
            let mut rig = Rig::new(tree, &empty, &start, dt_s);
            let steps = (0.2 / dt_s).round() as usize;
            for _ in 0..steps {
                let effort: Vec<f64> = rig.q.iter().map(|q| 2.0 - 3.0 * q).collect();
                rig.advance(&effort);
                for (i, joint) in moving.iter().enumerate() {
                    let joint = &rig.robot.joints()[*joint];
                    let wrench = rig.sensors.reading(i);
                    let along = if joint.kind.turns() {
                        &wrench[3..]
                    } else {
                        &wrench[..3]
                    };
                    let through: f64 = along.iter().zip(&joint.axis).map(|(w, a)| w * a).sum();
                    let qd_middle = rig.qd[i] - 0.5 * dt_s * rig.qdd[i];
                    let given = effort[i] - joint.damping * qd_middle - joint.armature * rig.qdd[i];
                    worst = worst.max((through - given).abs());
                }
            }
        }
        worst
    };
    let (coarse, fine) = (worst(1e-3), worst(5e-4));
    // efforts of some newton metres; second order in the step
    assert!(coarse < 1e-3, "{coarse:e}");
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

#[test]
fn an_arm_that_pushes_a_shelf_feels_the_reaction_in_its_joints() {
    let robot = equipped(
        "rrbot",
        "[[sensors]]\nname = 's'\ntype = 'wrench'\njoint = 'shoulder'\n[[sensors]]\nname = 'e'\ntype = 'wrench'\njoint = 'elbow'\n[[sensors]]\nname = 'c'\ntype = 'contact'\nlink = 'forearm'\n",
    );
    // elbow outwards, the forearm beside the shelf's edge; pulled to where the shelf is, up and down along the edge
    let mut rig = Rig::new(robot, &scene(vec![shelf()]), &[1.69, 1.646], DT);
    let (mut pressed, mut worst) = (0, 0.0_f64);
    for i in 0..2000 {
        let forearm = -0.25 * 9.81 * libm::sin(rig.q[0] + rig.q[1]);
        let held = [forearm - 0.75 * 9.81 * libm::sin(rig.q[0]), forearm];
        let goal = [1.69 + 0.05 * libm::sin(f64::from(i) * 4e-3), 1.3];
        let effort = [0, 1].map(|joint: usize| {
            let pull = 100.0 * (goal[joint] - rig.q[joint]) - 10.0 * rig.qd[joint];
            held[joint] + pull
        });
        rig.advance(&effort);
        let force = rig.reading("c")[0];
        if force > 0.0 {
            pressed += 1;
        }
        for (joint, name) in ["s", "e"].into_iter().enumerate() {
            let qd_middle = rig.qd[joint] - 0.5 * DT * rig.qdd[joint];
            let given = rig.effort[joint] - 0.7 * qd_middle;
            let error = (rig.reading(name)[4] - given).abs();
            if i > 500 {
                worst = worst.max(error);
            }
        }
    }
    assert!(pressed > 1000, "{pressed} {:?}", rig.q);
    // moments of ten newton metres; in contact the error is of first order in the step
    assert!(
        worst < 1e-3,
        "{worst} {pressed} {:?} {:?}",
        rig.contacts,
        rig.effort
    );
}

/// A lift that carries a mast, on which the wind presses.
const MAST: &str = "
format = 1
name = 'mast'
[[links]]
name = 'base'
[[links]]
name = 'lift'
inertia = { mass_kg = 2.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
[[links]]
name = 'sail'
inertia = { mass_kg = 1.0, com_m = [0, 0, 0.3], tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
drag = { area_m2 = 0.5, coefficient = 0.8 }
[[joints]]
name = 'up'
type = 'prismatic'
parent = 'base'
child = 'lift'
axis = [0, 0, 1]
[[joints]]
name = 'foot'
type = 'fixed'
parent = 'lift'
child = 'sail'
origin = { xyz_m = [0, 0, 1] }
[[sensors]]
name = 'foot'
type = 'wrench'
joint = 'foot'
";

#[test]
fn a_mast_in_the_wind_leans_on_its_foot() {
    let mut windy = scene(Vec::new());
    windy.environment.wind = Some(Wind {
        velocity_m_s: Vector3::new(5.0, 0.0, 0.0),
        air_density_kg_m3: 1.2,
        gust: None,
    });
    let mut rig = Rig::new(robot(MAST), &windy, &[0.0], DT);
    for _ in 0..10 {
        rig.advance(&[3.0 * 9.81]);
    }
    // 0.5 1.2 0.8 0.5 5² = 6 N, 0.3 m above the foot
    let expected = [-6.0, 0.0, 9.81, 0.0, -1.8, 0.0];
    for (read, expected) in rig.reading("foot").iter().zip(expected) {
        assert!((read - expected).abs() < 1e-9, "{:?}", rig.reading("foot"));
    }
}
