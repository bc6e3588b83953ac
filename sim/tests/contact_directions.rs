//! The direction of a contact's greatest force, worked out by hand: bodies that lie on each other under gravity.

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoSettings};
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::run::{self, End, Setup};
use kinemark_sim::spatial::Pose;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::TraceRecorder;
use kinemark_sim::watch::ContactSpan;
use nalgebra::Vector3;

use crate::arms::lab_robot;
use crate::contact_scenes::{GRAVITY, at, boxed, part, scene};

const STEP_S: f64 = 1e-3;
/// The mass of what lies on something [kg].
const MASS_KG: f64 = 2.0;

/// The contacts of a tenth of a second far from the arm.
fn contacts(bodies: Vec<SceneBody>) -> Vec<ContactSpan> {
    let robot = lab_robot("rrbot");
    let scene: Scene = scene(bodies);
    let setup = Setup {
        robot: &robot,
        scene: Some(&scene),
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods: Periods {
            step_s: STEP_S,
            ticks_per_servo: NonZeroU32::MIN,
            ticks_per_control: NonZeroU32::new(10).expect("ten"),
        },
        gravity_m_s2: GRAVITY,
        servo: ServoSettings::new(
            &robot,
            Mode::Effort,
            Derivative::Measurement,
            &GainLists::none(robot.n()),
            false,
        )
        .expect("servos"),
        sensors: Vec::new(),
        start_q: robot.home().to_vec(),
        start_qd: vec![0.0; robot.n()],
        laws: None,
        pushes: Vec::new(),
        ticks: 100,
    };
    let mut recorder = TraceRecorder::new(&setup);
    let still = |_: &run::Observation<'_>, effort: &mut [f64]| {
        effort.fill(0.0);
        Ok::<(), ()>(())
    };
    let end = run::run(&setup, still, &mut recorder).expect("a run");
    assert_eq!(end, End::Finished);
    recorder.finish().contacts
}

fn brick(name: &str, kind: BodyKind, start: Pose) -> SceneBody {
    part(name, kind, boxed(0.2, 0.2, 0.1), MASS_KG, start)
}

/// That one contact presses as hard as a weight does, in a direction on the second of its parties.
fn presses(found: &[ContactSpan], parties: [Party; 2], direction: Vector3<f64>) {
    let [span] = found else {
        panic!("one contact: {found:?}")
    };
    assert_eq!(span.parties, parties);
    let off = (span.peak_normal_in_world - direction).norm();
    assert!(off < 1e-6, "{span:?}");
    let weight_n = MASS_KG * 9.81;
    assert!(span.peak_force_n >= 0.99 * weight_n, "{span:?}");
}

#[test]
fn a_body_presses_the_ground_down() {
    let lying = brick("lying", BodyKind::Free, at(10.0, 0.0, 0.05));
    let found = contacts(vec![lying]);
    presses(&found, [Party::Body(0), Party::Ground], -Vector3::z());
}

#[test]
fn what_a_body_lies_on_holds_it_up() {
    let table = || brick("table", BodyKind::Fixed, at(10.0, 0.0, 0.5));
    let lying = || brick("lying", BodyKind::Free, at(10.0, 0.0, 0.6));
    let both = [Party::Body(0), Party::Body(1)];
    // the force is that on the second: the body is held up, the table pressed down
    presses(&contacts(vec![table(), lying()]), both, Vector3::z());
    presses(&contacts(vec![lying(), table()]), both, -Vector3::z());
}

#[test]
fn a_body_that_flies_against_a_wall_is_thrown_back() {
    let wall = part(
        "wall",
        BodyKind::Fixed,
        boxed(0.1, 2.0, 2.0),
        1.0,
        at(10.2, 0.0, 5.0),
    );
    // 10 mm before the wall, at 2 m/s towards larger x, high above the ground
    let mut flying = brick("flying", BodyKind::Free, at(10.04, 0.0, 5.0));
    flying.twist.linear = Vector3::new(2.0, 0.0, 0.0);
    let found = contacts(vec![flying, wall]);
    let hit = found.first().expect("a hit");
    assert_eq!(hit.parties, [Party::Body(0), Party::Body(1)]);
    // on the wall it is along the flight
    assert!(hit.peak_normal_in_world.x > 0.99, "{hit:?}");
    // all of the momentum, 2 kg at 2 m/s, and no more than its double
    assert!((3.99..8.1).contains(&hit.impulse_n_s), "{hit:?}");
}
