//! Whole runs in a scene: their events, and their end at a divergence.

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::diagnosis::{Cause, likely_cause};
use kinemark_sim::model::air::Drag;
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, Wind};
use kinemark_sim::run;
use kinemark_sim::run::DivergenceKind;
use kinemark_sim::run::{End, Observation, Setup};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};
use kinemark_sim::watch::event::{Event, EventKind, SeenSide};

use crate::arms::{rrbot, rrbot_without_limits};
use crate::contact_scenes::{GRAVITY, at, part, reach, scene, shelf_and_can};

fn setup<'a>(robot: &'a Robot, scene: Option<&'a Scene>, gains: [f64; 2], ticks: u64) -> Setup<'a> {
    let [kp, kd] = gains;
    let gains = Gains {
        kp,
        ki: 0.0,
        kd,
        effort_limit: 100.0,
        integral_limit: f64::INFINITY,
    };
    Setup {
        robot,
        scene,
        tcp: robot.tcp(),
        seen_from: robot.frame("lab").expect("lab"),
        periods: Periods {
            step_s: 1e-3,
            ticks_per_servo: NonZeroU32::MIN,
            ticks_per_control: NonZeroU32::new(10).expect("ten"),
        },
        gravity_m_s2: GRAVITY,
        servo: ServoSettings {
            mode: Mode::Position,
            derivative: Derivative::Velocity,
            gains: vec![gains; 2],
            gravity_compensation: true,
        },
        sensors: Vec::new(),
        start_q: vec![0.0; 2],
        start_qd: vec![0.0; 2],
        laws: None,
        pushes: Vec::new(),
        ticks,
    }
}

/// Commands that lead the tip at 1.25 m above the ground from `from` to `to` metres out, at 0.5 m/s after half a second.
fn sweep(from: f64, to: f64) -> impl FnMut(&Observation<'_>, &mut [f64]) -> Result<(), ()> {
    move |seen, command| {
        let gone = (seen.time_s - 0.5).max(0.0) * 0.5;
        let out = if to > from {
            (from + gone).min(to)
        } else {
            (from - gone).max(to)
        };
        command.copy_from_slice(&reach(1.25, out));
        Ok(())
    }
}

fn swept(from: f64, to: f64) -> Trace {
    let (robot, scene) = (rrbot(), shelf_and_can());
    let mut setup = setup(&robot, Some(&scene), [1000.0, 30.0], 3000);
    setup.start_q = reach(1.25, from).to_vec();
    let mut recorder = TraceRecorder::new(&setup);
    let end = run::run(&setup, sweep(from, to), &mut recorder).expect("a run");
    assert_eq!(end, End::Finished);
    recorder.finish()
}

fn first(trace: &Trace, name: &str) -> Event {
    let mut events = trace.events.iter();
    let found = events.find(|event| event.kind.name() == name);
    found
        .cloned()
        .unwrap_or_else(|| panic!("no {name}: {:?}", trace.events))
}

const CAN: usize = 1;

#[test]
fn a_can_that_is_swept_off_is_reported_in_order_and_by_its_side() {
    for (from, to, side) in [(0.75, 1.4, SeenSide::Far), (1.25, 0.6, SeenSide::Near)] {
        let trace = swept(from, to);
        assert!(trace.events.is_sorted_by_key(|event| event.tick));
        let touched = trace
            .events
            .iter()
            .find(|event| matches!(event.kind, EventKind::Touched { parties } if parties == [Party::Link(2), Party::Body(CAN)]))
            .expect("the arm touches the can");
        let [moved, left, fell] =
            ["moved", "left-support", "body-fell"].map(|name| first(&trace, name));
        assert!(touched.tick <= moved.tick && moved.tick < left.tick && left.tick < fell.tick);
        let EventKind::BodyFell {
            body: CAN,
            side: Some(beyond),
        } = fell.kind
        else {
            panic!("{fell:?}")
        };
        assert_eq!(beyond.seen, side);
        // the shelf's sides look along x of the world
        let sign = if side == SeenSide::Far { 1.0 } else { -1.0 };
        assert!((beyond.outward.x - sign).abs() < 1e-12, "{beyond:?}");
        // its position at the event `body-fell`: below the top of the shelf, beyond that side
        let pose = trace
            .world_from_body(CAN, fell.tick as usize)
            .expect("the can moves");
        assert!(pose.translation.z < 1.15 && sign * (pose.translation.x - 1.0) > 0.1);
    }
}

#[test]
fn contacts_record_whom_from_when_to_when_and_how_hard() {
    let trace = swept(0.75, 1.4);
    let of = |parties: [Party; 2]| {
        let mut contacts = trace.contacts.iter();
        contacts
            .find(|contact| contact.parties == parties)
            .expect("a contact")
            .clone()
    };
    // the can stands on the shelf from the first step until it leaves it
    let support = of([Party::Body(0), Party::Body(CAN)]);
    let left = first(&trace, "left-support").tick;
    assert!(
        support.first_tick <= 1 && support.last_tick.abs_diff(left) <= 40,
        "{support:?} {left}"
    );
    // until the arm comes, its weight times the time is the impulse
    let pushed = of([Party::Link(2), Party::Body(CAN)]);
    assert!(pushed.first_tick > 400 && pushed.peak_force_n > 0.4 * 0.39 * 9.81);
    let weight_n_s = 0.39 * 9.81 * 1e-3 * support.last_tick as f64;
    assert!(
        (support.impulse_n_s / weight_n_s - 1.0).abs() < 0.05,
        "{support:?} {weight_n_s}"
    );
    assert!((support.p_first_in_world.z - 1.2).abs() < 1e-3);
    // what the trace has of the can at the start is where the scene puts it
    let start = trace.world_from_body(CAN, 0).expect("the can moves");
    assert!((start.translation.vector - nalgebra::Vector3::new(1.0, 0.05, 1.25)).norm() < 1e-15);
    assert_eq!(trace.moving_bodies, [CAN]);
}

#[test]
fn without_contact_a_run_in_a_scene_is_smooth_motion_to_the_last_bit() {
    let robot = rrbot();
    let (around, nothing) = (shelf_and_can(), scene(Vec::new()));
    let wave = |seen: &Observation<'_>, command: &mut [f64]| {
        command.copy_from_slice(&[0.3 * libm::sin(seen.time_s), 0.4]);
        Ok::<(), ()>(())
    };
    let mut bits = Vec::new();
    for scene in [None, Some(&around), Some(&nothing)] {
        let setup = setup(&robot, scene, [100.0, 10.0], 2000);
        let mut recorder = TraceRecorder::new(&setup);
        assert_eq!(run::run(&setup, wave, &mut recorder), Ok(End::Finished));
        let digest = recorder.finish().digest();
        bits.push(
            digest
                .seconds
                .iter()
                .map(|second| second.signals[..5].to_vec())
                .collect::<Vec<_>>(),
        );
    }
    assert!(bits[0] == bits[1] && bits[1] == bits[2]);
}

#[test]
fn a_servo_beyond_its_limit_ends_the_run_while_its_numbers_are_finite() {
    let (robot, around) = (rrbot_without_limits(), shelf_and_can());
    for scene in [None, Some(&around)] {
        let mut setup = setup(&robot, scene, [100.0, 2000.0], 5000);
        for gains in &mut setup.servo.gains {
            gains.effort_limit = f64::INFINITY;
        }
        let mut recorder = TraceRecorder::new(&setup);
        let command = |_: &Observation<'_>, command: &mut [f64]| {
            command.copy_from_slice(&[0.1, 0.1]);
            Ok::<(), ()>(())
        };
        let end = run::run(&setup, command, &mut recorder).expect("a run");
        let End::Diverged { tick, what } = end else {
            panic!("{end:?}")
        };
        let DivergenceKind::Runaway {
            kinetic_j, bound_j, ..
        } = what
        else {
            panic!("{what:?}")
        };
        // a kilogram at 1000 m/s
        assert!((bound_j - 5e5).abs() < 1e-6 && kinetic_j > bound_j);
        let trace = recorder.finish();
        assert_eq!(trace.len() as u64, tick);
        assert!(trace.len() < 1000);
        for tick in 0..trace.len() {
            assert!(trace.q.at(tick).iter().all(|q| q.abs() < 1e6));
        }
    }
}

#[test]
fn a_straight_arm_is_near_a_singular_position_and_says_so_once() {
    let robot = rrbot();
    let setup = setup(&robot, None, [100.0, 10.0], 6000);
    let mut recorder = TraceRecorder::new(&setup);
    // straight up at the start, bent, and straight again at 4 s
    let command = |seen: &Observation<'_>, command: &mut [f64]| {
        let elbow = if (1.0..4.0).contains(&seen.time_s) {
            1.0
        } else {
            0.0
        };
        command.copy_from_slice(&[0.3, elbow]);
        Ok::<(), ()>(())
    };
    assert_eq!(run::run(&setup, command, &mut recorder), Ok(End::Finished));
    let trace = recorder.finish();
    let near = trace
        .events
        .iter()
        .filter(|event| event.kind == EventKind::NearSingular);
    let near: Vec<u64> = near.map(|event| event.tick).collect();
    assert_eq!((near.len(), near[0]), (2, 0), "{near:?}");
    // condition number 50 at an elbow of about a tenth of a radian: |sin q2| = s1 s2, s1² + s2² = 3 + 2 cos q2
    let elbow = trace.q.at(near[1] as usize)[1];
    assert!(
        near[1].is_multiple_of(10) && (0.0..=0.1).contains(&elbow.abs()),
        "{near:?} {elbow}"
    );
}

#[test]
fn a_motor_drives_its_joint_no_faster_than_its_limit() {
    let (robot, nothing) = (rrbot(), scene(Vec::new()));
    for scene in [None, Some(&nothing)] {
        let mut setup = setup(&robot, scene, [0.0, 0.0], 500);
        setup.servo.mode = Mode::Effort;
        setup.gravity_m_s2 = nalgebra::Vector3::zeros();
        let mut recorder = TraceRecorder::new(&setup);
        let command = |_: &Observation<'_>, command: &mut [f64]| {
            command.copy_from_slice(&[-100.0, 0.0]);
            Ok::<(), ()>(())
        };
        assert_eq!(run::run(&setup, command, &mut recorder), Ok(End::Finished));
        let trace = recorder.finish();
        // 20 rad/s
        let rates = trace.qd.component(0).map(f64::abs);
        let fastest = rates.fold(0.0, f64::max);
        assert!((fastest / 20.0 - 1.0).abs() < 2e-4, "{fastest}");
        let shoulder = EventKind::SpeedLimitHit { joint: 0 };
        let event = trace.events.iter().find(|event| event.kind == shoulder);
        let tick = event.expect("an event").tick as usize;
        assert!(trace.qd.at(tick)[0] <= -19.98);
        // what it takes to go on as fast: damping of 0.7 N m s/rad, and what the forearm does
        assert!(trace.effort.at(tick)[0].abs() < 100.0);
    }
}

#[test]
fn a_joint_that_is_pressed_on_its_limit_is_reported_once() {
    let (robot, nothing) = (rrbot(), scene(Vec::new()));
    let setup = setup(&robot, Some(&nothing), [100.0, 10.0], 4000);
    let mut recorder = TraceRecorder::new(&setup);
    // beyond the stop at 6.3 rad
    let command = |_: &Observation<'_>, command: &mut [f64]| {
        command.copy_from_slice(&[6.5, 1.0]);
        Ok::<(), ()>(())
    };
    assert_eq!(run::run(&setup, command, &mut recorder), Ok(End::Finished));
    let trace = recorder.finish();
    let count = |name: &str| {
        trace
            .events
            .iter()
            .filter(|event| event.kind.name() == name)
            .count()
    };
    assert!((1..=4).contains(&count("limit-hit")), "{:?}", trace.events);
    assert!(count("saturated") <= 4, "{:?}", trace.events);
}

/// The trace of a box of 1 kg on a plate that moves down 0.4 m in a second, tilted by `slope_deg`.
fn lowered(slope_deg: f64) -> Trace {
    let (s, c) = libm::sincos(slope_deg.to_radians());
    let (x, z) = (3.0 + 0.1 * s, 1.0 + 0.1 * c);
    let text = format!(
        "format = 1\nname = 'lift'\n[[bodies]]\nname = 'plate'\ntype = 'kinematic'\nshapes = [{{ box = {{ size_m = [2.0, 1.0, 0.1] }} }}]\ncontact = {{ friction = 0.2 }}\nmotion = {{ waypoints = [{{ t_s = 0.5, xyz_m = [3, 0, 1], rpy_deg = [0, {slope_deg}, 0] }}, {{ t_s = 1.5, xyz_m = [3, 0, 0.6], rpy_deg = [0, {slope_deg}, 0] }}] }}\n[[bodies]]\nname = 'box'\ntype = 'free'\norigin = {{ xyz_m = [{x}, 0, {z}], rpy_deg = [0, {slope_deg}, 0] }}\nshapes = [{{ box = {{ size_m = [0.1, 0.1, 0.1] }} }}]\ninertia = {{ mass_kg = 1.0 }}\ncontact = {{ friction = 0.2 }}\n"
    );
    let file =
        kinemark_sim::format::SceneFile::parse(kinemark_sim::text::Source::new("lift.toml", text));
    let around = file.and_then(|file| file.build(&[])).expect("a scene");
    let robot = rrbot();
    let setup = setup(&robot, Some(&around), [100.0, 10.0], 2000);
    let mut recorder = TraceRecorder::new(&setup);
    let still = |_: &Observation<'_>, command: &mut [f64]| {
        command.fill(0.0);
        Ok::<(), ()>(())
    };
    assert_eq!(run::run(&setup, still, &mut recorder), Ok(End::Finished));
    recorder.finish()
}

#[test]
fn what_rides_down_does_not_fall() {
    let trace = lowered(0.0);
    let last = trace.world_from_body(1, 2000).expect("the box");
    assert!((last.translation.z - 0.7).abs() < 1e-3);
    let events: Vec<&str> = trace.events.iter().map(|event| event.kind.name()).collect();
    // the plate is faster than gravity at first
    assert!(
        events.contains(&"left-support") && !events.contains(&"body-fell"),
        "{events:?}"
    );
    // down a ramp that slides under it, and still on it
    let trace = lowered(12.0);
    let events: Vec<&str> = trace.events.iter().map(|event| event.kind.name()).collect();
    assert!(
        events.contains(&"moved") && !events.contains(&"body-fell"),
        "{events:?}"
    );
}

/// A ball that starts with `speed_m_s` along x, in air that drags on `area_m2` of it and blows with 10 m/s.
fn flying(speed_m_s: f64, mass_kg: f64, area_m2: f64) -> Scene {
    let solid = kinemark_sim::model::inertia::Solid::Sphere { radius_m: 0.05 };
    let mut ball = part("ball", BodyKind::Free, solid, mass_kg, at(5.0, 0.0, 5.0));
    ball.twist.linear.x = speed_m_s;
    ball.drag = Some(Drag {
        area_m2,
        coefficient: 1.0,
    });
    let mut around = scene(vec![ball]);
    around.environment.gravity_m_s2 = nalgebra::Vector3::zeros();
    around.environment.wind = Some(Wind {
        velocity_m_s: nalgebra::Vector3::new(10.0, 0.0, 0.0),
        air_density_kg_m3: 1.2,
        gust: None,
    });
    around
}

#[test]
fn bodies_are_as_fast_as_they_are_until_they_fly_off() {
    let robot = rrbot();
    let still = |_: &Observation<'_>, command: &mut [f64]| {
        command.fill(0.0);
        Ok::<(), ()>(())
    };
    let ended = |around: &Scene| {
        let setup = setup(&robot, Some(around), [100.0, 10.0], 500);
        let mut recorder = TraceRecorder::new(&setup);
        let end = run::run(&setup, still, &mut recorder).expect("a run");
        (end, recorder.finish())
    };
    let (end, trace) = ended(&flying(900.0, 1.0, 0.0));
    assert_eq!(end, End::Finished);
    let x = trace
        .world_from_body(0, 500)
        .expect("the ball")
        .translation
        .x;
    assert!((x - 455.0).abs() < 1e-6, "{x}");
    let (end, _) = ended(&flying(1100.0, 1.0, 0.0));
    assert!(matches!(
        end,
        End::Diverged {
            tick: 1,
            what: DivergenceKind::BodyRunaway { body: 0, .. }
        }
    ));
    // a feather of a gram with a square metre goes with the wind at once
    let (end, trace) = ended(&flying(0.0, 1e-3, 1.0));
    assert_eq!(end, End::Finished);
    let x = |tick| {
        trace
            .world_from_body(0, tick)
            .expect("the ball")
            .translation
            .x
    };
    assert!((x(500) - x(400) - 1.0).abs() < 0.05, "{}", x(500) - x(400));
}

#[test]
fn an_integral_gain_beyond_its_limit_is_blamed() {
    let robot = rrbot_without_limits();
    let mut setup = setup(&robot, None, [100.0, 10.0], 60_000);
    for gains in &mut setup.servo.gains {
        gains.ki = 20_000.0;
        gains.effort_limit = f64::INFINITY;
    }
    let mut recorder = TraceRecorder::new(&setup);
    let command = |_: &Observation<'_>, command: &mut [f64]| {
        command.fill(0.1);
        Ok::<(), ()>(())
    };
    let end = run::run(&setup, command, &mut recorder).expect("a run");
    let End::Diverged { what, .. } = end else {
        panic!("{end:?}")
    };
    let cause = likely_cause(&setup, &what, &recorder.finish());
    assert!(matches!(cause, Some(Cause::ServoIntegral(_))), "{cause:?}");
}

#[test]
fn a_feedback_of_the_wrong_sign_is_blamed_and_not_the_step_it_ends_at() {
    let robot = rrbot_without_limits();
    for gain in [30.0, 60.0, 600.0] {
        let mut setup = setup(&robot, None, [0.0, 0.0], 60_000);
        setup.servo.mode = Mode::Effort;
        for gains in &mut setup.servo.gains {
            gains.effort_limit = f64::INFINITY;
        }
        let mut recorder = TraceRecorder::new(&setup);
        // measured minus wanted
        let command = |seen: &Observation<'_>, command: &mut [f64]| {
            for (command, (q, qd)) in command.iter_mut().zip(seen.q.iter().zip(seen.qd)) {
                *command = gain * (q - 0.3) + 0.1 * gain * qd;
            }
            Ok::<(), ()>(())
        };
        let end = run::run(&setup, command, &mut recorder).expect("a run");
        let End::Diverged { what, .. } = end else {
            panic!("{gain}: {end:?}")
        };
        let cause = likely_cause(&setup, &what, &recorder.finish());
        assert!(
            matches!(cause, Some(Cause::DrivesOn { .. })),
            "{gain}: {cause:?}"
        );
    }
}
