//! Impacts and flight against the laws of mechanics: faces that land flat, energy, momentum, free bodies.

use kinemark_sim::model::inertia::{Inertia, Solid};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::spatial::{Symmetric3, Twist, pose, rotation_exp};
use kinemark_sim::step::hybrid::HybridStep;
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

use crate::arms::robot;
use crate::contact_scenes::{at, boxed, part, scene};

const DT_S: f64 = 1e-3;

fn post() -> Robot {
    robot(
        "format = 1\nname = 'post'\n[[links]]\nname = 'base'\n[[links]]\nname = 'knob'\ninertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[joints]]\nname = 'turn'\ntype = 'continuous'\nparent = 'base'\nchild = 'knob'\naxis = [0, 0, 1]\n",
    )
}

/// Runs the bodies of a scene alone.
fn run(scene: &Scene, steps: usize, mut each: impl FnMut(&HybridStep)) {
    let post = post();
    let gravity = scene.environment.gravity_m_s2;
    let mut step = HybridStep::new(&post, scene, gravity, DT_S).expect("a scene");
    let (mut q, mut qd) = ([0.0], [0.0]);
    for _ in 0..steps {
        step.advance(&post, &[0.0], &mut q, &mut qd)
            .expect("a step");
        each(&step);
    }
}

fn weightless(bodies: Vec<SceneBody>) -> Scene {
    let mut scene = scene(bodies);
    scene.environment.gravity_m_s2 = Vector3::zeros();
    scene.environment.ground = None;
    scene
}

fn can() -> Solid {
    Solid::Cylinder {
        radius_m: 0.033,
        length_m: 0.1,
    }
}

#[test]
fn what_is_dropped_flat_stays_flat_and_in_its_place() {
    for (solid, half) in [
        (can(), 0.05),
        (boxed(0.2, 0.2, 0.2), 0.1),
        (boxed(0.1, 0.3, 0.05), 0.025),
    ] {
        for (friction, restitution) in [(0.4, 0.0), (0.4, 0.3), (1.0, 0.8), (0.0, 0.0)] {
            let mut body = part(
                "b",
                BodyKind::Free,
                solid.clone(),
                0.39,
                at(1.0, 0.0, 1.0 + half),
            );
            body.contact.friction = friction;
            body.contact.restitution = restitution;
            let (mut tilt, mut aside, mut rebound) = (0.0_f64, 0.0_f64, 0.0_f64);
            let mut landed = false;
            run(&scene(vec![body]), 1500, |step| {
                let state = step.body(0);
                let pose = state.world_from_body;
                tilt = tilt.max((pose.rotation[(2, 2)]).min(1.0).acos_deg());
                aside = aside.max(
                    (pose.translation.vector - Vector3::new(1.0, 0.0, 0.0))
                        .xy()
                        .norm(),
                );
                landed |= !step.report().contacts.is_empty();
                if landed {
                    rebound = rebound.max(state.twist.linear.z);
                }
            });
            let case =
                format!("{solid:?} {friction} {restitution}: {tilt} deg, {aside} m, {rebound} m/s");
            let came = (2.0_f64 * 9.81).sqrt();
            assert!(landed && tilt < 0.01 && aside < 1e-6, "{case}");
            assert!(
                (rebound - restitution * came).abs() < 0.002 * came,
                "{case}"
            );
        }
    }
}

trait Degrees {
    fn acos_deg(self) -> f64;
}

impl Degrees for f64 {
    fn acos_deg(self) -> f64 {
        libm::acos(self).to_degrees()
    }
}

/// Kinetic energy, momentum, and angular momentum about the origin.
fn motion(bodies: &[SceneBody], step: &HybridStep) -> (f64, Vector3<f64>, Vector3<f64>) {
    let (mut energy, mut linear, mut angular) = (0.0, Vector3::zeros(), Vector3::zeros());
    for (index, body) in bodies.iter().enumerate() {
        let state = step.body(index);
        let pose = state.world_from_body;
        let turn = *pose.rotation.matrix();
        let com = turn * body.inertia.com_m;
        let w = state.twist.angular;
        let v = state.twist.linear + w.cross(&com);
        let tensor: Matrix3<f64> =
            turn * body.inertia.about_com_kg_m2.to_matrix() * turn.transpose();
        let m = body.inertia.mass_kg;
        energy += 0.5 * m * v.norm_squared() + 0.5 * w.dot(&(tensor * w));
        linear += v * m;
        angular += (pose.translation.vector + com).cross(&(v * m)) + tensor * w;
    }
    (energy, linear, angular)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn bodies_that_collide_gain_no_energy_and_keep_their_momentum(
        turn in prop::array::uniform3(-1.5..1.5f64),
        spin in prop::array::uniform3(-8.0..8.0f64),
        aim in prop::array::uniform2(-0.08..0.08f64),
        speed in 0.3..4.0f64,
        mass_kg in 0.1..10.0f64,
        friction in 0.0..1.0f64,
        restitution in prop::sample::select(vec![0.0, 0.3, 0.7, 1.0]),
    ) {
        let mut first = part("first", BodyKind::Free, boxed(0.1, 0.15, 0.2), mass_kg, at(-0.4, aim[0], aim[1]));
        first.world_from_body = pose(rotation_exp(&Vector3::from(turn)), Vector3::new(-0.4, aim[0], aim[1]));
        first.twist = Twist { linear: Vector3::new(speed, 0.0, 0.0), angular: Vector3::from(spin) };
        let second = part("second", BodyKind::Free, can(), 1.0, at(0.0, 0.0, 0.0));
        let mut bodies = vec![first, second];
        for body in &mut bodies {
            body.contact.friction = friction;
            body.contact.restitution = restitution;
        }
        let scene = weightless(bodies.clone());
        let mut known: Option<(f64, Vector3<f64>, Vector3<f64>)> = None;
        let mut failure = None;
        run(&scene, 1200, |step| {
            let now = motion(&bodies, step);
            if let Some(before) = known {
                let scale = (2.0 * before.0 * (mass_kg + 1.0)).sqrt();
                if now.0 > before.0 * (1.0 + 1e-9) {
                    failure = Some(format!("energy {} -> {}", before.0, now.0));
                }
                if (now.1 - before.1).norm() > 1e-12 * scale {
                    failure = Some(format!("momentum {} -> {}", before.1, now.1));
                }
                if (now.2 - before.2).norm() > 1e-3 * scale {
                    failure = Some(format!("angular momentum {} -> {}", before.2, now.2));
                }
            }
            known = Some(now);
        });
        prop_assert!(failure.is_none(), "{failure:?}");
    }
}

#[test]
fn a_body_flies_as_its_centre_of_mass_does() {
    // given by numbers, far from the middle of its shape
    let mut body = part(
        "b",
        BodyKind::Free,
        Solid::Sphere { radius_m: 0.05 },
        2.0,
        at(0.0, 0.0, 0.0),
    );
    let com = Vector3::new(0.3, 0.1, -0.2);
    body.inertia = Inertia {
        mass_kg: 2.0,
        com_m: com,
        about_com_kg_m2: Symmetric3 {
            xx: 0.02,
            yy: 0.05,
            zz: 0.04,
            xy: 0.003,
            xz: -0.002,
            yz: 0.004,
        },
    };
    let (v, w) = (Vector3::new(0.5, 0.2, 3.0), Vector3::new(1.0, -2.0, 3.0));
    body.twist = Twist {
        linear: v,
        angular: w,
    };
    let start = v + w.cross(&com);
    let mut in_gravity = scene(vec![body.clone()]);
    in_gravity.environment.ground = None;
    for (scene, g) in [(weightless(vec![body.clone()]), 0.0), (in_gravity, 9.81)] {
        let (mut end, mut before) = (Vector3::zeros(), None);
        run(&scene, 1000, |step| {
            let pose = step.body(0).world_from_body;
            end = pose.translation.vector + pose.rotation * com;
            let now = motion(std::slice::from_ref(&body), step);
            if g == 0.0 {
                let (energy, linear, angular) = *before.get_or_insert(now);
                assert!((now.0 / energy - 1.0).abs() < 1e-10);
                assert!((now.1 - linear).norm() < 1e-13);
                assert!((now.2 - angular).norm() < 1e-9 * angular.norm());
            }
        });
        let expected = com + start - Vector3::z() * (0.5 * g);
        assert!((end - expected).norm() < 1e-12, "{end} {expected}");
    }
}
