//! Bounces against the laws of impact: faces, rims and balls, free, on the ground and on a link.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::step::hybrid::HybridStep;
use nalgebra::Vector3;

use crate::arms::robot;
use crate::contact_scenes::{at, boxed, part, scene};

const DT: f64 = 1e-3;

/// A block of 20 kg that slides along x.
fn ram(restitution: f64) -> Robot {
    robot(&format!(
        "format = 1\nname = 'ram'\n[[links]]\nname = 'rail'\n[[links]]\nname = 'ram'\nshapes = [{{ box = {{ size_m = [0.1, 0.1, 0.1] }} }}]\ninertia = {{ mass_kg = 20 }}\ncontact = {{ friction = 0.0, restitution = {restitution} }}\n[[joints]]\nname = 'x'\ntype = 'prismatic'\nparent = 'rail'\nchild = 'ram'\norigin = {{ xyz_m = [0, 0, 1.0] }}\naxis = [1, 0, 0]\n"
    ))
}

fn body(solid: Solid, mass_kg: f64, restitution: f64, x: f64) -> SceneBody {
    let mut body = part("body", BodyKind::Free, solid, mass_kg, at(x, 0.0, 1.0));
    body.contact.friction = 0.0;
    body.contact.restitution = restitution;
    body
}

fn weightless(bodies: Vec<SceneBody>) -> Scene {
    let mut scene = scene(bodies);
    scene.environment.gravity_m_s2 = Vector3::zeros();
    scene.environment.ground = None;
    scene
}

/// Speeds of ram and body, and the body's turning, after the ram came with 1 m/s.
fn rammed(solid: Solid, reach_m: f64, restitution: f64) -> (f64, f64, f64, f64) {
    let robot = ram(restitution);
    let scene = weightless(vec![body(solid, 0.4, restitution, 0.15 + reach_m)]);
    let mut step = HybridStep::new(&robot, &scene, Vector3::zeros(), DT).expect("a scene");
    let (mut q, mut qd) = ([0.0], [1.0]);
    let mut impulse = 0.0;
    for _ in 0..400 {
        let report = step
            .advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("a step");
        impulse += report
            .contacts
            .iter()
            .map(|fact| fact.impulse_n_s)
            .sum::<f64>();
    }
    let twist = step.body(0).twist;
    (qd[0], twist.linear.x, twist.angular.norm(), impulse)
}

#[test]
fn a_ram_that_hits_face_on_obeys_the_law_of_impact() {
    let solids = [
        (boxed(0.2, 0.2, 0.12), 0.1),
        (boxed(0.1, 0.06, 0.06), 0.05),
        (Solid::Sphere { radius_m: 0.05 }, 0.05),
        (
            Solid::Cylinder {
                radius_m: 0.05,
                length_m: 0.12,
            },
            0.05,
        ),
    ];
    for (solid, reach_m) in solids {
        for e in [0.3, 0.5, 0.8, 1.0] {
            let (ram, body, turning, impulse) = rammed(solid.clone(), reach_m, e);
            // momentum 20 kg m/s; the body leaves with e of the speed of approach
            let common = 20.0 / 20.4;
            let case = format!("{solid:?} {e}: {ram} {body} {turning}");
            assert!((body - ram - e).abs() < 2e-3, "{case}");
            assert!((20.0 * ram + 0.4 * body - 20.0).abs() < 1e-6, "{case}");
            assert!((body - common * (1.0 + e)).abs() < 2e-3, "{case}");
            assert!(turning < 0.05, "{case}");
            // the contact facts contain the impulse on the body
            assert!(
                (impulse / (0.4 * body) - 1.0).abs() < 1e-6,
                "{case} {impulse}"
            );
            let energy = 10.0 * ram * ram + 0.2 * body * body;
            assert!(energy <= 10.0 + 1e-6, "{case} {energy}");
        }
    }
}

#[test]
fn free_bodies_of_any_ratio_of_masses_bounce_alike() {
    for mass_kg in [0.1, 1.0, 10.0] {
        for e in [0.5, 1.0] {
            let mut first = body(boxed(0.1, 0.1, 0.1), mass_kg, e, 0.0);
            first.twist.linear.x = 1.0;
            let second = body(boxed(0.2, 0.2, 0.12), 1.0, 0.0, 0.3);
            let robot = ram(0.0);
            let scene = weightless(vec![first, second]);
            let mut step = HybridStep::new(&robot, &scene, Vector3::zeros(), DT).expect("a scene");
            let (mut q, mut qd) = ([-5.0], [0.0]);
            for _ in 0..600 {
                step.advance(&robot, &[0.0], &mut q, &mut qd)
                    .expect("a step");
            }
            let [a, b] = [0, 1].map(|i| step.body(i).twist);
            let case = format!("{mass_kg} {e}: {a:?} {b:?}");
            assert!((b.linear.x - a.linear.x - e).abs() < 2e-3, "{case}");
            assert!(
                (mass_kg * a.linear.x + b.linear.x - mass_kg).abs() < 1e-6,
                "{case}"
            );
            assert!(a.angular.norm() < 0.05 && b.angular.norm() < 0.05, "{case}");
        }
    }
}

#[test]
fn a_box_dropped_flat_comes_back_to_the_square_of_its_restitution() {
    for e in [0.3, 0.5, 0.8] {
        let mut dropped = body(boxed(0.2, 0.2, 0.2), 1.0, e, 3.0);
        dropped.world_from_body = at(3.0, 0.0, 1.1);
        dropped.contact.friction = 0.4;
        let robot = ram(0.0);
        let around = scene(vec![dropped]);
        let gravity = around.environment.gravity_m_s2;
        let mut step = HybridStep::new(&robot, &around, gravity, DT).expect("a scene");
        let (mut q, mut qd) = ([-5.0], [0.0]);
        let (mut peaks, mut before) = (Vec::new(), [0.0, 0.0]);
        for _ in 0..4000 {
            step.advance(&robot, &[0.0], &mut q, &mut qd)
                .expect("a step");
            let z = step.body(0).world_from_body.translation.z - 0.1;
            if before[0] < before[1] && before[1] >= z {
                peaks.push(before[1]);
            }
            before = [before[1], z];
        }
        // the height of the turning point has an error of one step: first order
        // the first is where it was let go
        for (bounce, peak) in peaks.iter().skip(1).take(3).enumerate() {
            let expected = (0..=bounce).fold(1.0, |height, _| height * e * e);
            assert!((peak - expected).abs() < 0.01, "{e}: {peaks:?}");
        }
        // in the end it lies still
        assert!(step.body(0).sleeps || e > 0.7, "{e}");
        assert!(step.body(0).twist.angular.norm() < 1e-2);
    }
}
