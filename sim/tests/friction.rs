//! Friction against closed forms and independent integration: links with other masses in other directions, patches that slide and turn,
//! rolling.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::spatial::{Pose, pose, rotation_about_axis_deg};
use kinemark_sim::step::hybrid::HybridStep;
use nalgebra::{Vector2, Vector3};

use crate::arms::robot;
use crate::contact_scenes::{GRAVITY, at, boxed, part, scene};

const DT_S: f64 = 1e-3;

/// A foot of 1 kg that is pressed on the ground, on carriages that add mass along x and y.
fn gantry(added_kg: [f64; 2]) -> String {
    let [x, y] = added_kg;
    format!(
        "format = 1\nname = 'gantry'\n[[links]]\nname = 'base'\n\
         [[links]]\nname = 'a'\ninertia = {{ mass_kg = {x}, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n\
         [[links]]\nname = 'b'\ninertia = {{ mass_kg = {y}, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n\
         [[links]]\nname = 'foot'\nshapes = [{{ box = {{ size_m = [0.1, 0.1, 0.1] }} }}]\n\
         contact = {{ friction = 0.5 }}\ninertia = {{ mass_kg = 1.0 }}\n\
         [[joints]]\nname = 'x'\ntype = 'prismatic'\nparent = 'base'\nchild = 'a'\naxis = [1, 0, 0]\n\
         [[joints]]\nname = 'y'\ntype = 'prismatic'\nparent = 'a'\nchild = 'b'\naxis = [0, 1, 0]\n\
         [[joints]]\nname = 'z'\ntype = 'prismatic'\nparent = 'b'\nchild = 'foot'\naxis = [0, 0, 1]\n"
    )
}

/// Where a body of masses `m` along x and y stops that starts with `v` under the friction `f`, which opposes its velocity.
fn stops_at(m: Vector2<f64>, v: Vector2<f64>, friction_n: f64) -> Vector2<f64> {
    let (mut p, mut v) = (Vector2::zeros(), v);
    let h = 1e-5;
    while v.norm() > 1e-4 {
        let slows = |v: &Vector2<f64>| (v * (-friction_n / v.norm())).component_div(&m);
        let middle = v + slows(&v) * (0.5 * h);
        p += middle * h;
        v += slows(&middle) * h;
    }
    p
}

#[test]
fn a_foot_stops_where_friction_against_its_velocity_takes_it() {
    for (added_kg, direction_deg, expected) in [
        ([9.0, 0.1], 60.0_f64, Some([0.1438, 0.0622])),
        ([1.3, 0.1], 30.0, None),
        ([0.1, 9.0], 45.0, None),
        ([0.1, 3.0], 15.0, None),
    ] {
        let robot = robot(&gantry(added_kg));
        let mut ground = scene(Vec::new());
        if let Some(surface) = &mut ground.environment.ground {
            surface.friction = 0.5;
        }
        let mut step = HybridStep::new(&robot, &ground, GRAVITY, DT_S).expect("a scene");
        let v = Vector2::new(
            libm::cos(direction_deg.to_radians()),
            libm::sin(direction_deg.to_radians()),
        );
        let (mut q, mut qd) = ([0.0, 0.0, 0.05], [v.x, v.y, 0.0]);
        for _ in 0..4000 {
            step.advance(&robot, &[0.0, 0.0, -10.0], &mut q, &mut qd)
                .expect("a step");
        }
        let masses = Vector2::new(1.0 + added_kg[0] + added_kg[1], 1.0 + added_kg[1]);
        let stops = stops_at(masses, v, 0.5 * (10.0 + 9.81));
        if let Some([x, y]) = expected {
            // the closed form of the measurement
            assert!((stops - Vector2::new(x, y)).norm() < 2e-4, "{stops}");
        }
        let off = (Vector2::new(q[0], q[1]) - stops).norm();
        assert!(
            off < 2e-3 * stops.norm(),
            "{added_kg:?}: {q:?}, not {stops}"
        );
        assert!(qd.iter().all(|qd| qd.abs() < 1e-9), "{qd:?}");
    }
}

/// Runs the bodies of a scene alone.
fn alone(scene: &Scene, steps: usize) -> HybridStep {
    let still = robot(
        "format = 1\nname = 'post'\n[[links]]\nname = 'base'\n[[links]]\nname = 'knob'\ninertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[joints]]\nname = 'turn'\ntype = 'continuous'\nparent = 'base'\nchild = 'knob'\naxis = [0, 0, 1]\n",
    );
    let mut step = HybridStep::new(&still, scene, GRAVITY, DT_S).expect("a scene");
    let (mut q, mut qd) = ([0.0], [0.0]);
    for _ in 0..steps {
        step.advance(&still, &[0.0], &mut q, &mut qd)
            .expect("a step");
    }
    step
}

fn sliding(solid: Solid, mass_kg: f64, z: f64, v: [f64; 2], turning: f64) -> SceneBody {
    let mut body = part("box", BodyKind::Free, solid, mass_kg, at(0.0, 0.0, z));
    body.twist.linear = Vector3::new(v[0], v[1], 0.0);
    body.twist.angular.z = turning;
    body
}

/// The way and the angle of a box of square base `2 a` and height `2 h`, whose corners carry its weight and the moment of their friction,
/// by small steps.
fn slides_and_turns(
    (a, h): (f64, f64),
    friction: f64,
    v: Vector2<f64>,
    turning: f64,
) -> (Vector2<f64>, f64) {
    let (mut p, mut angle, mut v, mut w) = (Vector2::zeros(), 0.0, v, turning);
    // per unit of mass
    let inertia = 2.0 * a * a / 3.0;
    let dt = 2e-5;
    while v.norm() + w.abs() * a > 1e-3 {
        let corners = [(a, a), (-a, a), (-a, -a), (a, -a)].map(|(x, y)| {
            let (s, c) = (libm::sin(angle), libm::cos(angle));
            Vector2::new(c * x - s * y, s * x + c * y)
        });
        let directions = corners.map(|r| {
            let slides = v + Vector2::new(-r.y, r.x) * w;
            -slides / slides.norm().max(1e-12)
        });
        // the loads of least squares that balance weight and moment: they depend on friction, and it on them
        let mut force = Vector2::zeros();
        for _ in 0..20 {
            let loads = corners.map(|r| 9.81 / 4.0 - h * force.dot(&r) / (4.0 * a * a));
            force = directions
                .iter()
                .zip(loads)
                .map(|(d, n)| d * (friction * n))
                .sum();
        }
        let loads = corners.map(|r| 9.81 / 4.0 - h * force.dot(&r) / (4.0 * a * a));
        let mut moment = 0.0;
        for ((r, d), n) in corners.iter().zip(&directions).zip(loads) {
            moment += friction * n * (r.x * d.y - r.y * d.x);
        }
        v += force * dt;
        w += moment / inertia * dt;
        p += v * dt;
        angle += w * dt;
    }
    (p, angle)
}

#[test]
fn a_box_that_slides_and_turns_follows_coulombs_law_at_its_corners() {
    for (v, turning, height) in [
        ([1.0, 0.0], 10.0, 0.2),
        ([0.6, 0.8], -4.0, 0.2),
        ([0.3, 0.0], 15.0, 0.05),
        ([1.5, 0.0], 1.0, 0.1),
    ] {
        let solid = boxed(0.2, 0.2, height);
        let body = sliding(solid, 1.0, 0.5 * height, v, turning);
        let step = alone(&scene(vec![body]), 1500);
        let end = step.body(0).world_from_body;
        let (p, angle) = slides_and_turns((0.1, 0.5 * height), 0.4, v.into(), turning);
        let way = end.translation.vector.xy();
        let turned = libm::atan2(end.rotation[(1, 0)], end.rotation[(0, 0)]);
        let case = format!("{v:?} {turning}: {way} {turned}, not {p} {angle}");
        assert!((way - p).norm() < 0.01 * p.norm(), "{case}");
        let off = libm::remainder(turned - angle, std::f64::consts::TAU);
        assert!(off.abs() < 0.01 * angle.abs(), "{case}");
        assert!(step.body(0).sleeps);
    }
}

fn lying(radius_m: f64, along: Vector3<f64>) -> Pose {
    // the axis of a cylinder is its z
    let turn = rotation_about_axis_deg(along.cross(&Vector3::z()), 90.0);
    pose(turn, Vector3::new(0.0, 0.0, radius_m))
}

#[test]
fn a_cylinder_and_a_ball_slide_until_they_roll() {
    let (radius_m, v, friction) = (0.05, 1.0, 0.4);
    let cylinder = Solid::Cylinder {
        radius_m,
        length_m: 0.1,
    };
    let ball = Solid::Sphere { radius_m };
    for (solid, start, share) in [
        (cylinder, lying(radius_m, Vector3::y()), 0.5),
        (ball, at(0.0, 0.0, radius_m), 0.4),
    ] {
        let mut body = part("body", BodyKind::Free, solid, 0.7, start);
        body.twist.linear.x = v;
        let after = alone(&scene(vec![body]), 1000).body(0);
        // it rolls with v / (1 + share) after sliding for v share / ((1 + share) mu g)
        let rolls = v / (1.0 + share);
        let slides_s = v * share / ((1.0 + share) * friction * 9.81);
        let way = 0.5 * (v + rolls) * slides_s + rolls * (1.0 - slides_s);
        assert!((after.twist.linear.x - rolls).abs() < 1e-4, "{after:?}");
        assert!((after.twist.angular.y - rolls / radius_m).abs() < 2e-3);
        assert!((after.world_from_body.translation.x - way).abs() < 1e-4);
    }
}

#[test]
fn a_cylinder_that_slides_along_its_axis_while_it_rolls_brakes_along_its_velocity() {
    // at a contact that slides with (u, s), friction decelerates u by 3 mu g u/c (rolling inertia) and s by mu g s/c
    let (radius_m, friction) = (0.05, 0.4);
    // so long that the moment of friction about its middle hardly moves the load from one end to the other
    let solid = Solid::Cylinder {
        radius_m,
        length_m: 10.0,
    };
    let mut body = part(
        "body",
        BodyKind::Free,
        solid,
        0.7,
        lying(radius_m, Vector3::y()),
    );
    // rolls along x with slip 0.5 m/s, slides along y with 1 m/s
    body.twist.linear = Vector3::new(0.5, 1.0, 0.0);
    let after = alone(&scene(vec![body]), 1000).body(0);
    let (mut x, mut y) = (0.0, 0.0);
    let (mut v, mut spin, mut s) = (0.5, 0.0, 1.0);
    let h = 1e-5;
    for _ in 0..100_000 {
        let slip: Vector2<f64> = Vector2::new(v - spin * radius_m, s);
        if slip.norm() > 1e-4 {
            let brakes = slip * (-friction * 9.81 / slip.norm() * h);
            v += brakes.x;
            spin -= 2.0 * brakes.x / radius_m;
            s += brakes.y;
        }
        x += v * h;
        y += s * h;
    }
    let end = after.world_from_body.translation.vector;
    assert!((end.x - x).abs() < 2e-3 * x, "{end} {x} {y}");
    assert!((end.y - y).abs() < 2e-3 * y, "{end} {x} {y}");
}

#[test]
fn rolling_resistance_brings_a_can_to_rest_where_its_energy_is_spent() {
    let (radius_m, rolling_m) = (0.033, 0.0005);
    let solid = Solid::Cylinder {
        radius_m,
        length_m: 0.1,
    };
    let ball = Solid::Sphere { radius_m };
    for (solid, start, share) in [
        (solid, lying(radius_m, Vector3::y()), 0.5),
        (ball, at(0.0, 0.0, radius_m), 0.4),
    ] {
        let mut can = part("can", BodyKind::Free, solid, 0.39, start);
        can.contact.rolling_m = rolling_m;
        can.twist.linear.x = 0.3;
        can.twist.angular.y = 0.3 / radius_m;
        let after = alone(&scene(vec![can]), 4000).body(0);
        // the resistance takes m g b / r a metre
        let way = 0.5 * (1.0 + share) * 0.09 / (9.81 * rolling_m / radius_m);
        let end = after.world_from_body.translation.x;
        assert!((end - way).abs() < 2e-3 * way, "{end}, not {way}");
        assert!(after.sleeps);
    }
    // on a slope of less than b / r it stays, on a steeper one it rolls
    for (slope, stays) in [(0.8, true), (1.2, false)] {
        let angle = libm::atan(slope * rolling_m / radius_m).to_degrees();
        let turn = rotation_about_axis_deg(Vector3::y(), angle);
        let tilted = |up: f64| pose(turn, turn * Vector3::new(0.0, 0.0, up));
        let ramp = part(
            "ramp",
            BodyKind::Fixed,
            boxed(2.0, 1.0, 0.2),
            1.0,
            tilted(-0.1),
        );
        let mut can = part(
            "can",
            BodyKind::Free,
            Solid::Sphere { radius_m },
            0.39,
            tilted(radius_m),
        );
        can.contact.rolling_m = rolling_m;
        let mut on_ramp = scene(vec![ramp, can]);
        on_ramp.environment.ground = None;
        let after = alone(&on_ramp, 1000).body(1);
        let moved =
            (after.world_from_body.translation.vector - tilted(radius_m).translation.vector).norm();
        assert_eq!(moved < 1e-6, stays, "{slope}: {moved}");
    }
}
