//! Range finders: distances by hand, rays against bisection, and bodies that move.

use kinemark_sim::model::contact::Party;
use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::scene::BodyKind;
use kinemark_sim::spatial::{pose, rotation_from_rpy_deg};
use kinemark_sim::step::hybrid::HybridStep;
use nalgebra::Vector3;

use crate::arms::{Numbers, robot};
use crate::contact::mesh;
use crate::contact_scenes::{GRAVITY, at, boxed, part, scene};
use crate::sensor_rig::{DT, Rig, sensors, still};

/// A mast with a head that slides up it and looks forward, down and back, and a paddle that turns beside the mast.
const WATCHER: &str = "
format = 1
name = 'watcher'
[dimensions]
far = 2.0
[[links]]
name = 'mast'
shapes = [{ box = { size_m = [0.04, 0.04, 1.0] }, origin = { xyz_m = [-0.5, 0, 0.5] } }]
[[links]]
name = 'head'
shapes = [{ box = { size_m = [0.3, 0.3, 0.3] } }]
inertia = { mass_kg = 1.0 }
[[links]]
name = 'hat'
shapes = [{ box = { size_m = [0.6, 0.6, 0.01] }, origin = { xyz_m = [0, 0, -0.2] } }]
[[links]]
name = 'paddle'
shapes = [{ box = { size_m = [0.1, 1.0, 0.2] } }]
inertia = { mass_kg = 1.0 }
[[joints]]
name = 'lift'
type = 'prismatic'
parent = 'mast'
child = 'head'
axis = [0, 0, 1]
[[joints]]
name = 'brim'
type = 'fixed'
parent = 'head'
child = 'hat'
[[joints]]
name = 'swing'
type = 'continuous'
parent = 'mast'
child = 'paddle'
origin = { xyz_m = [-2, 0, 3] }
axis = [0, 0, 1]
[[frames]]
name = 'eye'
link = 'head'
origin = { xyz_m = [0.1, 0, 0] }
[[sensors]]
name = 'forward'
type = 'range-finder'
frame = 'eye'
range_m = 'far'
[[sensors]]
name = 'down'
type = 'range-finder'
frame = 'eye'
axis = [0, 0, -2]
range_m = 6
[[sensors]]
name = 'back'
type = 'range-finder'
frame = 'eye'
axis = [-1, 0, 0]
range_m = 'far + 1'
";

#[test]
fn a_ray_reads_the_distance_to_what_is_in_front() {
    let standing = |solid, z| part("thing", BodyKind::Fixed, solid, 1.0, at(1.0, 0.0, z));
    let sphere = Solid::Sphere { radius_m: 0.25 };
    let (radius_m, length_m) = (0.3, 0.4);
    let things = scene(vec![
        standing(boxed(0.2, 0.4, 0.4), 1.0),
        standing(sphere, 2.0),
        standing(Solid::Cylinder { radius_m, length_m }, 3.0),
        standing(Solid::Capsule { radius_m, length_m }, 4.0),
    ]);
    let robot = robot(WATCHER);
    for (z, swing, forward, down, back) in [
        // faces at 1 less half the box or a radius; the eye is at 0.1; the mast is at -0.48, up to 1 m
        (1.0, 0.0, 0.8, 1.0, 0.58),
        (0.9, 0.0, 0.8, 0.9, 0.58),
        (2.0, 0.0, 0.65, 2.0, 3.0),
        // the paddle's face at -1.95 is seen 2.05 m away, its edge when turned by 90 degrees at -1.5
        (3.0, 0.0, 0.6, 3.0, 2.05),
        (3.0, std::f64::consts::FRAC_PI_2, 0.6, 3.0, 1.6),
        (4.0, 0.0, 0.6, 4.0, 3.0),
        // nothing ahead, and the ground beyond the range
        (5.0, 0.0, 2.0, 5.0, 3.0),
        (7.0, 0.0, 2.0, 6.0, 3.0),
        // below the ground
        (-0.5, 0.0, 0.0, 0.0, 0.0),
    ] {
        let rig = Rig::new(robot.clone(), &things, &[z, swing], DT);
        let expected = [forward, down, back];
        for (read, expected) in rig.sensors.values().iter().zip(expected) {
            // cylinders are met by iteration, to 1e-8 m
            assert!(
                (read - expected).abs() < 1e-8,
                "z = {z}: {read}, {expected}"
            );
        }
    }
    // without a scene it sees the robot alone
    let mut alone = sensors(&robot);
    alone.sample(&still(&robot, &[3.0, 0.0], &[0.0; 2]), None);
    let values = alone.values();
    assert_eq!(values[..2], [2.0, 6.0]);
    assert!((values[2] - 2.05).abs() < 1e-14);
}

#[test]
fn rays_meet_turned_solids_where_bisection_finds_their_surface() {
    let robot = robot("format = 1\nname = 'post'\n[[links]]\nname = 'base'\n");
    let mut r = Numbers::new(3);
    let (radius_m, length_m) = (0.3, 0.8);
    for (solid, most) in [
        // rounding of the engine's closed forms
        (Solid::Sphere { radius_m }, 1e-13),
        (Solid::Capsule { radius_m, length_m }, 1e-13),
        (boxed(0.3, 0.5, 0.9), 1e-13),
        (mesh([0.3, 0.5, 0.9], false), 1e-13),
        // the engine iterates until 1e-8
        (Solid::Cylinder { radius_m, length_m }, 2e-8),
        (mesh([0.3, 0.5, 0.9], true), 2e-8),
    ] {
        let inside = |p: Vector3<f64>| match &solid {
            Solid::Sphere { radius_m } => p.norm() < *radius_m,
            Solid::Cylinder { radius_m, length_m } => {
                p.x * p.x + p.y * p.y < radius_m * radius_m && p.z.abs() < 0.5 * length_m
            }
            Solid::Capsule { radius_m, length_m } => {
                let axis = p.z.clamp(-0.5 * length_m, 0.5 * length_m);
                (p - Vector3::z() * axis).norm() < *radius_m
            }
            Solid::Box { size_m } => (0..3).all(|i| p[i].abs() < 0.5 * size_m[i]),
            // the cube of edge 1, scaled
            Solid::Mesh(solid) => (0..3).all(|i| p[i].abs() < 0.5 * solid.scale[i]),
        };
        for _ in 0..500 {
            let v = r.vector(3, 180.0);
            let turn = rotation_from_rpy_deg([v[0], v[1], v[2]]);
            let origin = Vector3::from_vec(r.vector(3, 2.0)) + Vector3::z() * 5.0;
            let start = pose(turn, origin);
            let body = part("body", BodyKind::Fixed, solid.clone(), 1.0, start);
            let step = HybridStep::new(&robot, &scene(vec![body]), GRAVITY, DT).expect("a scene");
            // through a point that is inside, from outside
            let target = turn * Vector3::from_vec(r.vector(3, 0.1)) + origin;
            let direction = Vector3::from_vec(r.vector(3, 1.0)).normalize();
            let from = target - direction * 1.5;
            let (mut outside, mut within) = (0.0, 1.5);
            for _ in 0..60 {
                let middle = 0.5 * (outside + within);
                if inside(turn.transpose() * (from + direction * middle - origin)) {
                    within = middle;
                } else {
                    outside = middle;
                }
            }
            let (party, distance_m) = step.cast_ray(&from, &direction, 2.0).expect("a hit");
            assert_eq!(party, Party::Body(0));
            assert!((distance_m - within).abs() < most, "{distance_m} {within}");
            assert_eq!(step.cast_ray(&from, &direction, 0.9 * within), None);
            assert_eq!(step.cast_ray(&(from * f64::NAN), &direction, 2.0), None);
        }
    }
}

#[test]
fn a_ray_follows_a_body_that_falls_and_rests() {
    let ball = Solid::Sphere { radius_m: 0.1 };
    let fall = part("ball", BodyKind::Free, ball, 1.0, at(0.1, 0.0, 1.0));
    let mut rig = Rig::new(robot(WATCHER), &scene(vec![fall]), &[3.0, 0.0], DT);
    let lift = 9.81;
    for _ in 0..2000 {
        rig.advance(&[lift, 0.0]);
        let ball = rig.step.body(0).world_from_body.translation.vector;
        let expected = rig.q[0] - (ball.z + 0.1);
        // it may roll away by its own rounding only
        assert!(
            (rig.reading("down")[0] - expected).abs() < 1e-9,
            "{expected}"
        );
    }
    assert!(rig.step.body(0).sleeps && !rig.step.report().engine_stepped);
    // of two things at the same distance, bodies come before the ground
    let (party, _) = rig
        .step
        .cast_ray(&Vector3::new(0.1, 0.0, -1.0), &Vector3::z(), 5.0)
        .expect("below the ground");
    assert_eq!(party, Party::Ground);
}

#[test]
fn noise_never_leaves_the_range_and_no_echo_has_none() {
    let noisy = WATCHER.replace("range_m = 'far'", "range_m = 'far'\nnoise = 1.5");
    let robot = robot(&noisy);
    let wall = part(
        "wall",
        BodyKind::Fixed,
        boxed(0.2, 4.0, 2.0),
        1.0,
        at(1.0, 0.0, 1.0),
    );
    let mut near = Rig::new(robot.clone(), &scene(vec![wall]), &[1.0, 0.0], DT);
    let mut values = Vec::new();
    for _ in 0..200 {
        near.advance(&[9.81, 0.0]);
        values.push(near.reading("forward")[0]);
    }
    assert!(values.iter().all(|v| (0.0..=2.0).contains(v)));
    assert!(values.contains(&0.0) && values.contains(&2.0));
    let mut far = Rig::new(robot, &scene(Vec::new()), &[1.0, 0.0], DT);
    for _ in 0..200 {
        far.advance(&[9.81, 0.0]);
        assert_eq!(far.reading("forward"), [2.0]);
    }
}
