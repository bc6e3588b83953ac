//! Contact: forces by hand, rest that is rest, and the course's arm among shelf, can and wall.

use kinemark_sim::kinematics::closure::{closed_positions, loop_gap_m};
use kinemark_sim::model::air::Drag;
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::gust::Gust;
use kinemark_sim::model::inertia::{MeshSolid, Solid};
use kinemark_sim::model::mesh::Mesh;
use kinemark_sim::model::prescribed_motion::Motion;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, Wind};
use kinemark_sim::spatial::Twist;
use kinemark_sim::step::hybrid::{HybridStep, StateFrom};
use kinemark_sim::step::smooth::SmoothStep;
use nalgebra::Vector3;

use crate::arms::{robot, rrbot};
use crate::contact_run::{self, DT, pull, weight};
use crate::contact_scenes::{
    GRAVITY, STILL, at, boxed, can, part, reach, scene, shelf, shelf_and_can,
};

const SHELF: Party = Party::Body(0);
const CAN: Party = Party::Body(1);
const FOREARM: Party = Party::Link(2);

/// Height and distance of the tip.
fn tip(q: &[f64]) -> Vector3<f64> {
    let (q1, q12) = (q[0], q[0] + q[1]);
    let out = libm::sin(q1) + libm::sin(q12);
    Vector3::new(out, 0.0, 2.0 + libm::cos(q1) + libm::cos(q12))
}

fn step(robot: &Robot, scene: &Scene) -> HybridStep {
    HybridStep::new(robot, scene, GRAVITY, DT).expect("a scene")
}

/// A robot that has no shape and stays where it is.
fn bystander() -> Robot {
    robot(
        "format = 1\nname = 'post'\n[[links]]\nname = 'base'\n[[links]]\nname = 'knob'\ninertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[joints]]\nname = 'turn'\ntype = 'continuous'\nparent = 'base'\nchild = 'knob'\naxis = [0, 0, 1]\n",
    )
}

/// Steps a scene by itself.
fn alone(scene: &Scene, steps: usize, mut each: impl FnMut(usize, &HybridStep)) -> HybridStep {
    let robot = bystander();
    let mut hybrid = step(&robot, scene);
    let (mut q, mut qd) = ([0.0], [0.0]);
    for i in 0..steps {
        hybrid
            .advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("a step");
        each(i, &hybrid);
    }
    hybrid
}

#[test]
fn a_body_at_rest_presses_with_its_weight_and_stays() {
    let start = can(1.0, 1.2).world_from_body.translation.vector;
    let mut moved = 0.0_f64;
    let mut stepped = 0;
    let hybrid = alone(&shelf_and_can(), 10_000, |_, hybrid| {
        let now = hybrid.body(1).world_from_body.translation.vector;
        moved = moved.max((now - start).norm());
        stepped += usize::from(hybrid.report().engine_stepped);
    });
    assert!(moved < 1e-4, "moved {moved:.1e} m");
    // at rest it is not even stepped, and goes on pressing
    assert!(hybrid.body(1).sleeps && stepped < 1000, "{stepped} steps");
    let [fact] = hybrid.report().contacts[..] else {
        panic!("{:?}", hybrid.report().contacts)
    };
    assert_eq!(fact.parties, [SHELF, CAN]);
    // 0.39 kg; the contact is soft enough for a part in a thousand
    assert!(
        (fact.force_n / (0.39 * 9.81) - 1.0).abs() < 1e-3,
        "{fact:?}"
    );
    assert!(
        fact.normal_impulse_n_s.z > 0.0,
        "the shelf pushes the can up"
    );
    assert!((fact.p_centre_in_world - Vector3::new(1.0, 0.05, 1.2)).norm() < 1e-3);
}

#[test]
fn a_body_falls_slides_and_bounces_as_by_hand() {
    // falls: 0.5 s from rest; semi-implicit Euler in substeps of dt/4 leads by g t dt/8
    let ball = Solid::Sphere { radius_m: 0.05 };
    let high = part("ball", BodyKind::Free, ball.clone(), 0.2, at(0.0, 0.0, 5.0));
    let fallen = alone(&scene(vec![high]), 500, |_, _| {}).body(0);
    let fall = 5.0 - fallen.world_from_body.translation.vector.z;
    assert!(
        (fall - 0.5 * 9.81 * 0.25).abs() < 9.81 * 0.5 * DT / 8.0 * 1.1,
        "{fall}"
    );
    assert!((fallen.twist.linear.z + 9.81 * 0.5).abs() < 1e-9);

    // slides: 1 m/s against friction 0.4 stops after v²/2μg, and stays
    let mut sled = part(
        "sled",
        BodyKind::Free,
        boxed(0.2, 0.2, 0.02),
        1.0,
        at(0.0, 0.0, 0.01),
    );
    sled.twist.linear.x = 1.0;
    let stopped = alone(&scene(vec![sled]), 1000, |_, _| {}).body(0);
    let slid = stopped.world_from_body.translation.vector.x;
    // first order in the step: half of v dt
    assert!((slid - 1.0 / (2.0 * 0.4 * 9.81)).abs() < 1.0 * DT, "{slid}");
    assert!(stopped.sleeps);

    // bounces: of two surfaces the bouncier counts, e² of the height comes back
    let mut bouncy = part("ball", BodyKind::Free, ball, 0.2, at(0.0, 0.0, 1.05));
    bouncy.contact.restitution = 0.8;
    let (mut low, mut top) = (false, 0.0_f64);
    alone(&scene(vec![bouncy]), 900, |_, hybrid| {
        let z = hybrid.body(0).world_from_body.translation.vector.z - 0.05;
        low |= z < 0.01;
        if low {
            top = top.max(z);
        }
    });
    // the step in which it lands is not resolved: v dt of height, times e
    assert!((top - 0.64).abs() < 0.01, "{top}");
}

#[test]
fn a_body_on_a_slope_sticks_below_the_angle_of_friction_and_slides_above() {
    for (degrees, slides) in [(20.0, false), (24.0, true)] {
        // friction 0.4 holds up to 21.8 degrees
        let turn = kinemark_sim::spatial::rotation_about_axis_deg(Vector3::y(), degrees);
        let tilted = |distance: f64| {
            let normal = turn * Vector3::z();
            kinemark_sim::spatial::pose(turn, Vector3::new(0.0, 0.0, 2.0) + normal * distance)
        };
        let ramp = part(
            "ramp",
            BodyKind::Fixed,
            boxed(2.0, 1.0, 0.1),
            1.0,
            tilted(0.0),
        );
        let brick = part(
            "brick",
            BodyKind::Free,
            boxed(0.2, 0.1, 0.05),
            1.0,
            tilted(0.075),
        );
        let hybrid = alone(&scene(vec![ramp, brick]), 500, |_, _| {});
        let moved = (hybrid.body(1).world_from_body.translation.vector
            - tilted(0.075).translation.vector)
            .norm();
        assert_eq!(moved > 1e-3, slides, "{degrees}: {moved}");
        if slides {
            let a = 9.81 * (libm::sin(24_f64.to_radians()) - 0.4 * libm::cos(24_f64.to_radians()));
            assert!((moved - 0.5 * a * 0.25).abs() < 0.03 * moved, "{moved}");
        }
    }
}

#[test]
fn a_can_on_its_side_stays_where_it_is_and_rolls_on_as_fast_as_it_is_rolled() {
    let lying = kinemark_sim::spatial::rotation_about_axis_deg(Vector3::y(), 90.0);
    let on = |z: f64| kinemark_sim::spatial::pose(lying, Vector3::new(1.0, 0.0, z + 0.033));
    // on a box and on the ground
    for (support, top) in [(vec![shelf()], 1.2), (vec![], 0.0)] {
        for speed in [0.0, 0.02, -0.3] {
            let mut rolled = can(1.0, 1.2);
            rolled.world_from_body = on(top);
            rolled.twist.linear.y = speed;
            rolled.twist.angular.x = -speed / 0.033;
            let mut bodies = vec![rolled];
            bodies.extend(support.clone());
            let body = alone(&scene(bodies), 1000, |_, _| {}).body(0);
            assert_eq!(body.sleeps, speed == 0.0);
            // the engine adds no rolling friction, and must not add its opposite
            let off = (body.twist.linear - Vector3::y() * speed).norm();
            assert!(off < 1e-4, "{top} m up, {speed} m/s: {}", body.twist.linear);
            let gone = body.world_from_body.translation.vector - on(top).translation.vector;
            let off = (gone - Vector3::y() * speed).norm();
            assert!(off < 1e-4, "{top} m up, {speed} m/s: {gone}");
        }
    }
}

#[test]
fn free_motion_in_a_scene_is_the_smooth_step_to_the_last_bit() {
    let robot = rrbot();
    let mut hybrid = step(&robot, &shelf_and_can());
    let mut smooth = SmoothStep::new(&robot, GRAVITY, DT);
    let (mut q, mut qd) = ([0.0; 2], [0.0; 2]);
    let (mut free_q, mut free_qd) = ([0.0; 2], [0.0; 2]);
    let mut stepped = 0;
    for _ in 0..2000 {
        let effort = pull(&q, &qd, [0.0, 1.0], [100.0, 10.0], 100.0);
        let report = hybrid
            .advance(&robot, &effort, &mut q, &mut qd)
            .expect("a step");
        stepped += usize::from(report.engine_stepped);
        smooth
            .advance(&robot, &effort, &mut free_q, &mut free_qd)
            .expect("a step");
        assert_eq!((q, qd), (free_q, free_qd));
    }
    // only until the can has come to rest
    assert!((1..1000).contains(&stepped), "{stepped}");
}

#[test]
fn an_arm_that_pushes_a_shelf_sinks_in_by_hundredths_of_a_millimetre_and_is_still() {
    for limit_n_m in [20.0, 100.0] {
        let robot = rrbot();
        let mut hybrid = step(&robot, &scene(vec![shelf()]));
        let mut q = reach(1.0, 0.8);
        let mut qd = [0.0; 2];
        let goal = reach(1.0, 1.0);
        let (mut depth_m, mut jitter_m, mut pressed) = (0.0_f64, 0.0_f64, 0);
        let mut rest = Vector3::zeros();
        for i in 0..3000 {
            let effort = pull(&q, &qd, goal, [3000.0, 60.0], limit_n_m);
            let report = hybrid
                .advance(&robot, &effort, &mut q, &mut qd)
                .expect("a step");
            for fact in &report.contacts {
                depth_m = depth_m.max(fact.depth_m);
                assert_eq!(fact.parties, [FOREARM, SHELF]);
            }
            if i == 2000 {
                rest = tip(&q);
            } else if i > 2000 {
                jitter_m = jitter_m.max((tip(&q) - rest).norm());
                pressed += usize::from(report.state_from == StateFrom::Contact);
            }
        }
        assert_eq!(pressed, 999);
        assert!(depth_m < 1e-4, "{limit_n_m} N m: {depth_m:.1e} m deep");
        assert!(
            jitter_m < 1e-6,
            "{limit_n_m} N m: {jitter_m:.1e} m of jitter"
        );
    }
}

#[test]
fn a_can_squeezed_between_arm_and_wall_stays() {
    let robot = rrbot();
    // the forearm hangs upright at 1 m; its face, a can in the air, a wall
    let wall = part(
        "wall",
        BodyKind::Fixed,
        boxed(0.1, 0.5, 1.0),
        1.0,
        at(1.025 + 0.066 + 0.05, 0.05, 1.3),
    );
    let squeezed = can(1.025 + 0.033, 1.05);
    let mut hybrid = step(&robot, &scene(vec![wall, squeezed]));
    let quarter = std::f64::consts::FRAC_PI_2;
    let (mut q, mut qd) = ([quarter; 2], [0.0; 2]);
    let mut start = None;
    let mut slip_m = 0.0_f64;
    for i in 0..3000 {
        // the shoulder holds its place; the elbow pushes with 20 N m
        let mut effort = pull(&q, &qd, [quarter; 2], [3000.0, 60.0], 300.0);
        effort[1] = weight(&q)[1] - 20.0;
        hybrid
            .advance(&robot, &effort, &mut q, &mut qd)
            .expect("a step");
        let now = hybrid.body(1).world_from_body.translation.vector;
        if i == 500 {
            start = Some(now);
        }
        slip_m = start.map_or(0.0, |start: Vector3<f64>| slip_m.max((now - start).norm()));
    }
    // 20 N m over 0.9 m press with 22 N: friction 0.4 on both sides carries 18 N, the can weighs 3.8 N
    assert!(slip_m < 1e-3, "slips {slip_m:.1e} m");
    let held = hybrid.body(1).world_from_body.translation.vector.z;
    // it sinks by millimetres while the grip closes, and no farther
    assert!((held - 1.1).abs() < 1e-2, "held at {held} m");
    assert_eq!(hybrid.report().contacts.len(), 2);
}

/// Sweeps the tip over the shelf at 1 m/s, from outside in, and says where the can ends, when it has left the shelf.
fn sweep(start_error_rad: f64) -> Option<Vector3<f64>> {
    let robot = rrbot();
    let mut hybrid = step(&robot, &shelf_and_can());
    let mut q = reach(1.25, 1.4);
    q[0] += start_error_rad;
    let mut qd = [0.0; 2];
    for i in 0..1600 {
        let out = 1.4 - f64::from(i).min(800.0) * DT;
        let effort = pull(&q, &qd, reach(1.25, out), [3000.0, 60.0], 100.0);
        hybrid
            .advance(&robot, &effort, &mut q, &mut qd)
            .expect("a step");
        let place = hybrid.body(1).world_from_body.translation.vector;
        if place.z < 1.0 {
            return Some(place);
        }
    }
    None
}

#[test]
fn a_can_that_is_swept_falls_on_the_far_side_whatever_the_last_bits_say() {
    for k in -4..4 {
        let place = sweep(f64::from(k) * 1e-7).expect("it falls");
        assert!(place.x < 0.9, "it falls inwards: {place}");
    }
}

#[test]
fn joints_stop_at_their_limits() {
    let text = "format = 1\nname = 'pendulum'\n[[links]]\nname = 'base'\n[[links]]\nname = 'rod'\nshapes = [{ box = { size_m = [1.0, 0.02, 0.02] }, origin = { xyz_m = [0.5, 0, 0] } }]\ninertia = { mass_kg = 1.0 }\n[[joints]]\nname = 'swing'\ntype = 'revolute'\nparent = 'base'\nchild = 'rod'\naxis = [0, 1, 0]\norigin = { xyz_m = [0, 0, 3] }\nlimit = { lower = -0.5, upper = 0.5 }\n";
    let robot = robot(text);
    let mut hybrid = step(&robot, &scene(Vec::new()));
    // level at 0, it falls onto the upper stop (turning about y lowers x)
    let (mut q, mut qd) = ([0.0], [0.0]);
    let mut hits = Vec::new();
    for i in 0..1000 {
        let report = hybrid
            .advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("a step");
        if let [(0, impulse)] = report.stops[..] {
            hits.push((i, impulse));
        }
        assert!((-0.5..=0.5).contains(&q[0]));
    }
    assert_eq!((q[0], qd[0]), (0.5, 0.0));
    assert_eq!(hybrid.report().at_limit, [0]);
    // the impact takes the momentum of the fall: I w with w² = 2 m g (l/2) sin(0.5) / I; the step it falls in is not resolved
    let inertia = (1.0 + 0.02 * 0.02) / 12.0 + 0.25;
    let momentum = (2.0 * 9.81 * 0.5 * libm::sin(0.5) * inertia).sqrt();
    assert!(
        (hits[0].1 / -momentum - 1.0).abs() < 0.01,
        "{:?} {momentum}",
        hits[0]
    );
    // then it rests on it: its weight, a step at a time
    let rest = -9.81 * 0.5 * libm::cos(0.5) * DT;
    assert!(
        (hits[10].1 / rest - 1.0).abs() < 1e-6,
        "{:?} {rest}",
        hits[10]
    );
    // and leaves it as soon as it is pulled off
    hybrid
        .advance(&robot, &[-10.0], &mut q, &mut qd)
        .expect("a step");
    assert!(q[0] < 0.5 && hybrid.report().stops.is_empty());
}

/// A crank-rocker like that of the loop tests, its rocker's tip 0.1 m beyond the hinge.
fn four_bar() -> Robot {
    let mut text = String::from("format = 1\nname = 'four-bar'\n[[links]]\nname = 'ground'\n");
    for (name, length) in [("crank", 0.4), ("coupler", 1.0), ("rocker", 0.8)] {
        text += &format!(
            "[[links]]\nname = '{name}'\nshapes = [{{ box = {{ size_m = [{length}, 0.02, 0.02] }}, origin = {{ xyz_m = [{}, 0, 0] }} }}]\ninertia = {{ mass_kg = {length} }}\n",
            length / 2.0
        );
    }
    for (name, parent, x, extra) in [
        ("crank", "ground", 0.0, ""),
        ("coupler", "crank", 0.4, "guess = 0.9\npassive = true\n"),
        ("rocker", "ground", 1.0, "guess = 1.6\npassive = true\n"),
    ] {
        text += &format!(
            "[[joints]]\nname = '{name}'\ntype = 'continuous'\nparent = '{parent}'\nchild = '{name}'\norigin = {{ xyz_m = [{x}, 0, {}] }}\naxis = [0, -1, 0]\n{extra}",
            if parent == "ground" { 2.0 } else { 0.0 }
        );
    }
    robot(
        &(text
            + "[[loops]]\ntype = 'revolute'\nlinks = ['coupler', 'rocker']\naxis = [0, 1, 0]\nframe_on_first = { xyz_m = [1.0, 0, 0] }\nframe_on_second = { xyz_m = [0.8, 0, 0] }\n"),
    )
}

#[test]
fn a_four_bar_stays_closed_while_it_pushes() {
    let robot = four_bar();
    // a wall in the rocker's way
    let wall = part(
        "wall",
        BodyKind::Fixed,
        boxed(0.1, 0.5, 1.0),
        1.0,
        at(1.15, 0.0, 2.8),
    );
    let mut hybrid = step(&robot, &scene(vec![wall]));
    let mut q = closed_positions(&robot, &[0.0]).expect("closed");
    let mut qd = vec![0.0; 3];
    let (mut gap_free, mut gap, mut pressed) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..2000 {
        let report = hybrid
            .advance(&robot, &[15.0, 0.0, 0.0], &mut q, &mut qd)
            .expect("a step");
        if report.state_from == StateFrom::Contact {
            pressed += 1;
            gap = gap.max(loop_gap_m(&robot, &q));
        } else {
            gap_free = gap_free.max(loop_gap_m(&robot, &q));
        }
    }
    assert!(pressed > 1000, "{pressed}");
    assert!(gap_free < 1e-9, "free: {gap_free:.1e} m");
    assert!(gap < 1e-9, "in contact: {gap:.1e} m");
}

/// A mast that slides up and down, and two fingers on it, the second a mimic of the first.
fn gripper() -> Robot {
    let finger = "shapes = [{ box = { size_m = [0.04, 0.02, 0.08] } }]\ninertia = { mass_kg = 0.1 }\ncontact = { friction = 0.8, restitution = 0.0 }\n";
    robot(&format!(
        "format = 1\nname = 'gripper'\n[[links]]\nname = 'base'\n[[links]]\nname = 'mast'\ninertia = {{ mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n[[links]]\nname = 'left'\n{finger}[[links]]\nname = 'right'\n{finger}\
        [[joints]]\nname = 'lift'\ntype = 'prismatic'\nparent = 'base'\nchild = 'mast'\naxis = [0, 0, 1]\norigin = {{ xyz_m = [1, 0.05, 1.25] }}\n\
        [[joints]]\nname = 'close'\ntype = 'prismatic'\nparent = 'mast'\nchild = 'left'\naxis = [0, 1, 0]\norigin = {{ xyz_m = [0, -0.06, 0] }}\nlimit = {{ lower = 0.0, upper = 0.05 }}\n\
        [[joints]]\nname = 'follow'\ntype = 'prismatic'\nparent = 'mast'\nchild = 'right'\naxis = [0, -1, 0]\norigin = {{ xyz_m = [0, 0.06, 0] }}\nmimic = {{ joint = 'close' }}\n"
    ))
}

#[test]
fn a_coupled_gripper_lifts_a_can_and_holds_it() {
    let robot = gripper();
    let mut hybrid = step(&robot, &shelf_and_can());
    let (mut q, mut qd) = ([0.0; 2], [0.0; 2]);
    let mut grip: Option<Vector3<f64>> = None;
    let mut slip_m = 0.0_f64;
    for i in 0..3000 {
        // closes, then goes 0.2 m up within a second
        let goal = 0.2 * (f64::from(i - 500) * DT).clamp(0.0, 1.0);
        let effort = [4000.0 * (goal - q[0]) - 200.0 * qd[0] + 1.2 * 9.81, 20.0];
        hybrid
            .advance(&robot, &effort, &mut q, &mut qd)
            .expect("a step");
        let on_mast = hybrid.body(1).world_from_body.translation.vector - Vector3::z() * q[0];
        if i == 499 {
            grip = Some(on_mast);
        }
        slip_m = grip.map_or(0.0, |grip| slip_m.max((on_mast - grip).norm()));
    }
    assert!(hybrid.body(1).world_from_body.translation.vector.z > 1.4);
    let pressed: Vec<_> = hybrid
        .report()
        .contacts
        .iter()
        .map(|fact| fact.parties)
        .collect();
    assert_eq!(pressed, [[Party::Link(2), CAN], [Party::Link(3), CAN]]);
    // the fingers together close with 20 N: 10 N on each side of the can
    for fact in &hybrid.report().contacts {
        assert!((fact.force_n - 10.0).abs() < 0.1, "{fact:?}");
    }
    assert!(slip_m < 1e-3, "slips {slip_m:.1e} m");
}

/// A cube of edge 1 m as a mesh, centred, scaled along its axes.
pub(crate) fn mesh(scale: [f64; 3], convex: bool) -> Solid {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: i32| if i & bit == 0 { -0.5 } else { 0.5 };
        text += &format!("v {} {} {}\n", side(1), side(2), side(4));
    }
    for face in [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ] {
        text += &format!("f {face}\n");
    }
    let mesh = Mesh::parse("cube.obj", text.as_bytes()).expect("a mesh");
    Solid::Mesh(MeshSolid {
        file: "cube.obj".into(),
        scale,
        mesh: mesh.scaled(scale).into(),
        convex,
    })
}

#[test]
fn a_mesh_rests_on_a_mesh_and_one_without_extent_is_refused() {
    let table = part(
        "table",
        BodyKind::Fixed,
        mesh([2.0, 2.0, 0.5], false),
        1.0,
        at(0.0, 0.0, 1.0),
    );
    let brick = part(
        "brick",
        BodyKind::Free,
        mesh([0.2, 0.1, 0.1], true),
        2.0,
        at(0.0, 0.0, 1.3),
    );
    let hybrid = alone(&scene(vec![table.clone(), brick.clone()]), 500, |_, _| {});
    let moved = hybrid.body(1).world_from_body.translation.vector - Vector3::z() * 1.3;
    assert!(hybrid.body(1).sleeps && moved.norm() < 1e-4, "{moved}");
    let force: f64 = hybrid
        .report()
        .contacts
        .iter()
        .map(|fact| fact.force_n)
        .sum();
    assert!((force / (2.0 * 9.81) - 1.0).abs() < 1e-3, "{force} N");

    let mut needle = brick;
    needle.shapes[0].solid = mesh([0.2, 0.0, 0.0], true);
    let error = HybridStep::new(&bystander(), &scene(vec![table, needle]), GRAVITY, DT).err();
    let message = error.expect("refused").to_string();
    assert!(message.contains("`cube.obj` of `brick`"), "{message}");
}

#[test]
fn bodies_the_engine_cannot_use_are_named() {
    let mut ghost = part(
        "ghost",
        BodyKind::Free,
        boxed(0.1, 0.1, 0.1),
        1.0,
        at(0.0, 0.0, 1.0),
    );
    ghost.inertia.mass_kg = 0.0;
    let error = HybridStep::new(&bystander(), &scene(vec![ghost]), GRAVITY, DT).err();
    let message = error.expect("refused").to_string();
    assert!(
        message.contains("`ghost`") && message.contains("0 kg"),
        "{message}"
    );
}

#[test]
fn a_state_that_is_no_number_stays_the_callers_to_see() {
    let robot = rrbot();
    let mut hybrid = step(&robot, &shelf_and_can());
    let (mut q, mut qd) = ([0.0; 2], [0.0; 2]);
    for effort in [[0.0; 2], [f64::NAN, 0.0], [0.0; 2]] {
        hybrid
            .advance(&robot, &effort, &mut q, &mut qd)
            .expect("a step");
    }
    assert!(q[0].is_nan());
    // the can never saw it
    assert!(hybrid.body(1).world_from_body.translation.vector.z > 1.2);
}

#[test]
fn wind_moves_what_has_drag_and_carries_nothing_else() {
    let blown = |drag: Option<Drag>, gust: Option<Gust>| {
        let mut feather = part(
            "feather",
            BodyKind::Free,
            Solid::Sphere { radius_m: 0.05 },
            0.02,
            at(0.0, 0.0, 50.0),
        );
        feather.drag = drag;
        let mut windy = scene(vec![feather]);
        windy.environment.wind = Some(Wind {
            velocity_m_s: Vector3::new(3.0, 0.0, 0.0),
            air_density_kg_m3: 1.2,
            gust,
        });
        alone(&windy, 3000, |_, _| {}).body(0).twist.linear
    };
    assert!(blown(None, None).x.abs() < 1e-15);
    let drag = Drag {
        area_m2: 0.05,
        coefficient: 1.0,
    };
    // after many times m/(ρ c A v) it drifts with the wind and sinks at sqrt(2 m g / (ρ c A))
    let drift = blown(Some(drag), None);
    let sinks = (2.0_f64 * 0.02 * 9.81 / (1.2 * 0.05)).sqrt();
    assert!(
        (drift - Vector3::new(3.0, 0.0, -sinks)).norm() < 1e-2,
        "{drift}"
    );
    let gust = |seed| {
        Some(Gust {
            speed_m_s: 1.0,
            correlation_s: 0.5,
            seed,
        })
    };
    assert_eq!(blown(Some(drag), gust(1)), blown(Some(drag), gust(1)));
    assert_ne!(blown(Some(drag), gust(1)), blown(Some(drag), gust(2)));
}

#[test]
fn a_driven_body_goes_its_way_and_takes_others_along() {
    let motion = Motion::steady(
        at(0.0, 0.0, 0.5),
        Twist {
            linear: Vector3::new(0.1, 0.0, 0.0),
            ..STILL
        },
    );
    let belt = part(
        "belt",
        BodyKind::Kinematic(motion),
        boxed(2.0, 1.0, 0.1),
        1.0,
        at(0.0, 0.0, 0.5),
    );
    let brick = part(
        "brick",
        BodyKind::Free,
        boxed(0.1, 0.1, 0.1),
        1.0,
        at(0.0, 0.0, 0.6),
    );
    let hybrid = alone(&scene(vec![belt, brick]), 1000, |_, _| {});
    let x = |index| hybrid.body(index).world_from_body.translation.vector.x;
    assert!((x(0) - 0.1).abs() < 1e-12);
    // the brick slips until it has the belt's speed: v²/2μg
    assert!(
        (x(1) - (0.1 - 0.01 / (2.0 * 0.4 * 9.81))).abs() < 1e-4,
        "{}",
        x(1)
    );
}

#[test]
fn a_run_in_contact_has_the_same_bits_everywhere() {
    let (mut pressed, mut fell) = (0, false);
    let digest = contact_run::digest(&rrbot(), |hybrid| {
        pressed += usize::from(hybrid.report().state_from == StateFrom::Contact);
        fell |= hybrid.body(1).world_from_body.translation.vector.z < 1.0;
    });
    assert!(pressed > 50 && fell, "{pressed} {fell}");
    assert_eq!(digest, contact_run::DIGEST);
}
