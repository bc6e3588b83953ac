//! Drives and their limits in runs: speed limits at any gain, torque-speed lines against closed forms, stops and switches.

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene};
use kinemark_sim::run;
use kinemark_sim::run::{End, Observation, Setup};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};

use crate::arms::robot;
use crate::contact_scenes::{GRAVITY, at, boxed, part, scene};

/// A carriage of 3 kg that lifts an arm of 1 kg m² about the upright axis.
fn lifter(lift: &str, turn: &str) -> Robot {
    robot(&format!(
        "format = 1\nname = 'lifter'\n[[links]]\nname = 'column'\n\
         [[links]]\nname = 'carriage'\ninertia = {{ mass_kg = 2.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n\
         [[links]]\nname = 'arm'\ninertia = {{ mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }}\n\
         [[joints]]\nname = 'lift'\ntype = 'prismatic'\nparent = 'column'\nchild = 'carriage'\naxis = [0, 0, 1]\n{lift}\n\
         [[joints]]\nname = 'turn'\ntype = 'revolute'\nparent = 'carriage'\nchild = 'arm'\naxis = [0, 0, 1]\n{turn}\n"
    ))
}

/// One joint about the upright axis with a rotor of `inertia` kg m² and this drive.
fn motor(inertia: f64, rest: &str) -> Robot {
    robot(&format!(
        "format = 1\nname = 'motor'\n[[links]]\nname = 'base'\n[[links]]\nname = 'horn'\n\
         inertia = {{ mass_kg = 0.0, tensor_kg_m2 = [{inertia}, {inertia}, {inertia}, 0, 0, 0], accept_unphysical = true }}\n\
         [[joints]]\nname = 'servo'\ntype = 'revolute'\nparent = 'base'\nchild = 'horn'\naxis = [0, 0, 1]\n{rest}\n"
    ))
}

struct Loop {
    mode: Mode,
    kp: f64,
    kd: f64,
    effort_limit: f64,
    gravity_compensation: bool,
}

const EFFORT: Loop = Loop {
    mode: Mode::Effort,
    kp: 0.0,
    kd: 0.0,
    effort_limit: f64::INFINITY,
    gravity_compensation: false,
};

fn position(kp: f64) -> Loop {
    Loop {
        mode: Mode::Position,
        kp,
        kd: kp / 50.0,
        gravity_compensation: true,
        ..EFFORT
    }
}

/// Runs under one command from rest at `start_q`.
fn held(
    robot: &Robot,
    scene: Option<&Scene>,
    servo: &Loop,
    (start_q, start_qd): (&[f64], &[f64]),
    command: &[f64],
    ticks: u64,
) -> Trace {
    let gains = Gains {
        kp: servo.kp,
        ki: 0.0,
        kd: servo.kd,
        effort_limit: servo.effort_limit,
        integral_limit: f64::INFINITY,
    };
    let setup = Setup {
        robot,
        scene,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods: Periods {
            step_s: 1e-3,
            ticks_per_servo: NonZeroU32::MIN,
            ticks_per_control: NonZeroU32::MIN,
        },
        gravity_m_s2: GRAVITY,
        servo: ServoSettings {
            mode: servo.mode,
            derivative: Derivative::Velocity,
            gains: vec![gains; robot.n()],
            gravity_compensation: servo.gravity_compensation,
        },
        sensors: robot.sensors().to_vec(),
        start_q: start_q.to_vec(),
        start_qd: start_qd.to_vec(),
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let mut recorder = TraceRecorder::new(&setup);
    let control = |_: &Observation<'_>, slot: &mut [f64]| {
        slot.copy_from_slice(command);
        Ok::<(), ()>(())
    };
    assert_eq!(run::run(&setup, control, &mut recorder), Ok(End::Finished));
    recorder.finish()
}

fn fastest(trace: &Trace, joint: usize) -> f64 {
    trace.qd.component(joint).map(f64::abs).fold(0.0, f64::max)
}

const REST: [f64; 2] = [0.0, 0.0];

#[test]
fn a_speed_limit_holds_within_a_percent_at_any_gain() {
    let turn_limit = 18.0_f64.to_radians();
    let arm = lifter(
        "limit = { lower = 0, upper = 0.31, speed = 0.02 }",
        &format!("limit = {{ lower = -2, upper = 2, speed = {turn_limit} }}"),
    );
    let nothing = scene(Vec::new());
    for scene in [None, Some(&nothing)] {
        for kp in [200.0, 2000.0, 20_000.0] {
            let trace = held(
                &arm,
                scene,
                &position(kp),
                (&REST, &REST),
                &[0.2, 1.0],
                6000,
            );
            for (joint, limit) in [(0, 0.02), (1, turn_limit)] {
                let most = fastest(&trace, joint) / limit;
                assert!(
                    (0.99..=1.01).contains(&most),
                    "{kp}: joint {joint} at {most}"
                );
                // and it cruises there, until it is near its goal
                let cruise = trace.qd.at(1500)[joint] / limit;
                assert!(
                    (cruise - 1.0).abs() < 0.01,
                    "{kp}: joint {joint} at {cruise}"
                );
            }
            // no chatter: the effort of the lift is its weight from the second step to the end of the cruise
            let efforts: Vec<f64> = (10..1500).map(|t| trace.effort.at(t)[0]).collect();
            let weight = 3.0 * 9.81;
            assert!(efforts.iter().all(|e| (e - weight).abs() < 1e-6), "{kp}");
        }
    }
}

#[test]
fn a_speed_limit_holds_where_a_servo_throws_the_arm_from_end_to_end() {
    // gains far beyond what a kilohertz allows, without a limit of effort: both joints turn round in every step
    let robot = crate::arms::rrbot();
    let servo = Loop {
        mode: Mode::Velocity,
        kp: 10_000.0,
        kd: 0.0,
        ..EFFORT
    };
    let trace = held(&robot, None, &servo, (&REST, &REST), &[0.0, 1.0], 3000);
    for joint in [0, 1] {
        let most = fastest(&trace, joint) / 20.0;
        assert!((0.99..=1.01).contains(&most), "joint {joint} at {most}");
    }
}

#[test]
fn a_load_that_drives_a_joint_beyond_its_limit_is_braked_with_what_the_drive_has() {
    let arm = lifter("limit = { speed = 0.5 }", "");
    let falls = |effort_limit: f64| {
        let servo = Loop {
            effort_limit,
            ..EFFORT
        };
        // pushed down with a newton
        held(&arm, None, &servo, (&REST, &REST), &[-1.0, 0.0], 1000)
    };
    // strong enough for 29.43 N
    let trace = falls(40.0);
    assert!((fastest(&trace, 0) / 0.5 - 1.0).abs() < 1e-9);
    // too weak: from 0.5 m/s on it falls with g - 20 N / 3 kg
    let trace = falls(20.0);
    let after_s = 1.0 - 0.5 / (9.81 + 1.0 / 3.0);
    let expected = 0.5 + (9.81 - 20.0 / 3.0) * after_s;
    assert!(
        (fastest(&trace, 0) - expected).abs() < 5e-3,
        "{} {expected}",
        fastest(&trace, 0)
    );
}

#[test]
fn a_motor_that_is_asked_for_nothing_is_off() {
    let arm = lifter("limit = { speed = 0.5 }", "");
    let trace = held(&arm, None, &EFFORT, (&REST, &REST), &REST, 1000);
    assert!((fastest(&trace, 0) - 9.81).abs() < 1e-9);
    // the torque-speed line is the motor itself: beyond its free speed it brakes, whatever is asked
    let arm = lifter("drive = { stall = 30, free_speed = 0.5 }", "");
    let trace = held(&arm, None, &EFFORT, (&REST, &REST), &REST, 3000);
    let expected = 0.5 * (1.0 + 3.0 * 9.81 / 30.0);
    assert!((fastest(&trace, 0) - expected).abs() < 1e-9 * expected);
}

#[test]
fn a_passive_joint_has_no_drive_that_could_brake_it() {
    let arm = lifter("limit = { speed = 0.5 }\npassive = true", "");
    let trace = held(&arm, None, &EFFORT, (&REST, &REST), &REST, 500);
    assert!((fastest(&trace, 0) - 0.5 * 9.81).abs() < 1e-9);
}

#[test]
fn hobby_servos_follow_their_torque_speed_line() {
    // stall torque and free speed at 6 V: MG996R, DS3225, MG90S
    for (stall, free_speed) in [(1.1768, 8.055), (2.4, 8.055), (0.2157, 13.09)] {
        for inertia in [1e-6, 2e-4, 5e-3] {
            let horn = motor(
                inertia,
                &format!("drive = {{ stall = {stall}, free_speed = {free_speed} }}"),
            );
            let trace = held(&horn, None, &EFFORT, (&[0.0], &[0.0]), &[100.0], 300);
            // v = free (1 - exp(-t / T)) with T = inertia free / stall
            let time_constant_s = inertia * free_speed / stall;
            for tick in [1, 5, 20, 100, 300] {
                let exact = -free_speed * libm::expm1(-(f64::from(tick) * 1e-3) / time_constant_s);
                let rate = trace.qd.at(tick as usize)[0];
                assert!(
                    (rate - exact).abs() < 1e-9 * free_speed,
                    "{inertia} {tick}: {rate} {exact}"
                );
            }
        }
        // under half its stall torque it turns at half its free speed, up and down
        let weight = motor(
            2e-4,
            &format!(
                "dry_friction = {}\ndrive = {{ stall = {stall}, free_speed = {free_speed} }}",
                stall / 2.0
            ),
        );
        let trace = held(&weight, None, &EFFORT, (&[0.0], &[0.0]), &[-100.0], 1000);
        let rate = trace.qd.at(1000)[0];
        assert!(
            (rate + free_speed / 2.0).abs() < 1e-9 * free_speed,
            "{rate}"
        );
    }
}

#[test]
fn a_geared_motor_lifts_and_lowers_by_its_line_and_feels_its_rotor() {
    // 3 kg on a screw: stall 60 N, free speed 0.05 m/s, half the weight of the stall effort
    let weight = 3.0 * 9.81;
    let stall = 2.0 * weight;
    let lift = format!(
        "drive = {{ stall = {stall}, free_speed = 0.05, ratio = 1256.6, rotor_inertia = 1e-6 }}"
    );
    let arm = lifter(&lift, "");
    let full = |command: f64| {
        let trace = held(&arm, None, &EFFORT, (&REST, &REST), &[command, 0.0], 2000);
        trace.qd.at(2000)[0]
    };
    assert!((full(1e3) - 0.025).abs() < 1e-9, "{}", full(1e3));
    // the load helps: beyond the free speed, braked
    assert!((full(-1e3) + 0.075).abs() < 1e-9, "{}", full(-1e3));
    // with the motor at the weight it stands
    assert!(full(weight).abs() < 1e-9);
    // 3 kg and 1256.6² * 1e-6 kg = 1.579 kg: the acceleration under 10 N more than the weight
    let free = lifter("drive = { ratio = 1256.6, rotor_inertia = 1e-6 }", "");
    let trace = held(
        &free,
        None,
        &EFFORT,
        (&REST, &REST),
        &[weight + 10.0, 0.0],
        100,
    );
    let expected = 10.0 / (3.0 + 1256.6 * 1256.6 * 1e-6) * 0.1;
    assert!((trace.qd.at(100)[0] - expected).abs() < 1e-12);
}

#[test]
fn a_lossy_gear_holds_more_than_it_lifts() {
    let weight = 3.0 * 9.81;
    let arm = lifter("drive = { efficiency = 0.8 }", "");
    let ends = |effort: f64| {
        let trace = held(&arm, None, &EFFORT, (&REST, &REST), &[effort, 0.0], 500);
        (trace.qd.at(500)[0], trace.effort.at(400)[0])
    };
    // driving, what is asked for arrives
    let (rate, _) = ends(weight + 3.0);
    assert!((rate - 0.5).abs() < 1e-9, "{rate}");
    // between 0.64 of the weight and all of it, it stands
    let (rate, effort) = ends(0.7 * weight);
    assert!(
        rate.abs() < 1e-12 && (effort - weight).abs() < 1e-9,
        "{rate} {effort}"
    );
    // below, it is driven back against 1 / 0.64 of the effort
    let (rate, effort) = ends(0.5 * weight);
    let expected = (0.5 / 0.64 - 1.0) * 9.81 * 0.5;
    assert!((rate - expected).abs() < 1e-9, "{rate} {expected}");
    assert!((effort - 0.5 / 0.64 * weight).abs() < 1e-9, "{effort}");
}

#[test]
fn joints_stop_at_their_limits_without_a_scene_as_in_one() {
    let arm = lifter("limit = { lower = 0, upper = 0.31 }", "");
    let nothing = scene(Vec::new());
    let (free, within) = (
        held(
            &arm,
            None,
            &position(5000.0),
            (&REST, &REST),
            &[0.5, 0.0],
            1000,
        ),
        held(
            &arm,
            Some(&nothing),
            &position(5000.0),
            (&REST, &REST),
            &[0.5, 0.0],
            1000,
        ),
    );
    let highest = free.q.component(0).fold(0.0, f64::max);
    assert!(highest <= 0.31, "{highest}");
    assert!((free.q.at(1000)[0] - 0.31).abs() < 1e-12 && free.qd.at(1000)[0].abs() < 1e-12);
    for tick in 0..=1000 {
        assert_eq!(free.q.at(tick), within.q.at(tick), "{tick}");
    }
    assert_eq!(free.events, within.events);
}

#[test]
fn a_slow_drive_presses_with_its_whole_effort_on_what_stops_it() {
    // a block that stands on the carriage's way; the carriage is a box under it
    let arm = robot(
        "format = 1\nname = 'press'\n[[links]]\nname = 'base'\n[[links]]\nname = 'ram'\n\
         shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ninertia = { mass_kg = 3.0 }\n\
         [[joints]]\nname = 'press'\ntype = 'prismatic'\nparent = 'base'\nchild = 'ram'\naxis = [1, 0, 0]\n\
         limit = { speed = 0.02 }\n",
    );
    let wall = scene(vec![part(
        "wall",
        BodyKind::Fixed,
        boxed(0.1, 0.5, 0.5),
        1.0,
        at(0.11, 0.0, 0.0),
    )]);
    // the wall begins 10 mm ahead
    let servo = Loop {
        effort_limit: 400.0,
        ..EFFORT
    };
    let trace = held(&arm, Some(&wall), &servo, (&[0.0], &[0.0]), &[400.0], 1500);
    assert!(
        (fastest(&trace, 0) / 0.02 - 1.0).abs() < 0.01,
        "{}",
        fastest(&trace, 0)
    );
    assert!(trace.q.at(1500)[0] < 0.0102, "{}", trace.q.at(1500)[0]);
    // 60 N are what a step at 0.02 m/s takes; all of 400 N press within 20 ms
    let pressed = trace.effort.at(560)[0];
    assert!((pressed - 400.0).abs() < 1e-6, "{pressed}");
    let steady = (600..1500).all(|t| (trace.effort.at(t)[0] - 400.0).abs() < 1e-6);
    assert!(steady);
}

/// How often a reading goes from 0 to 1, and how often the effort of joint 0 changes between nothing and something.
fn edges(trace: &Trace) -> (usize, usize) {
    let last = trace.len() - 1;
    let pressed = |t: usize| trace.sensors.at(t)[0] > 0.5;
    let driven = |t: usize| trace.effort.at(t)[0].abs() > 0.0;
    let count = |changes: &dyn Fn(usize) -> bool| (1..=last).filter(|t| changes(*t)).count();
    (
        count(&|t| pressed(t) && !pressed(t - 1)),
        count(&|t| driven(t) != driven(t - 1)),
    )
}

#[test]
fn a_switch_with_hysteresis_trips_once_for_each_approach_and_a_latch_once_for_all() {
    let lift = |keys: &str, friction: f64| {
        let joint = format!(
            "dry_friction = {friction}\nlimit = {{ lower = 0, upper = 0.31, speed = 0.2 }}"
        );
        let text = format!(
            "[[sensors]]\nname = 'top'\ntype = 'limit-switch'\njoint = 'lift'\nside = 'upper'\n{keys}\n"
        );
        lifter(&joint, &format!("\n{text}"))
    };
    let rises = |arm: &Robot| {
        let servo = Loop {
            gravity_compensation: false,
            ..position(2000.0)
        };
        edges(&held(
            arm,
            None,
            &servo,
            (&[0.3, 0.0], &REST),
            &[0.35, 0.0],
            2000,
        ))
    };
    // without either, it is pressed and released in turn, every few milliseconds
    let (pressed, switched) = rises(&lift("", 0.0));
    assert!(pressed > 100 && switched > 200, "{pressed} {switched}");
    // 5 mm back before it is released: a fall of 32 ms and a rise
    let (pressed, switched) = rises(&lift("hysteresis = 0.005", 0.0));
    assert!(
        (5..60).contains(&pressed) && switched <= 2 * pressed,
        "{pressed} {switched}"
    );
    // a latch waits for the motor to drive away
    assert_eq!(rises(&lift("latch = true", 0.0)), (1, 1));
    assert_eq!(
        rises(&lift("hysteresis = 0.001\nlatch = true", 0.0)),
        (1, 1)
    );
    // friction that holds the weight leaves the joint where the switch stopped it
    assert_eq!(rises(&lift("hysteresis = 0.001", 40.0)), (1, 1));
}

#[test]
fn a_latched_switch_is_reset_by_driving_away() {
    let text = "[[sensors]]\nname = 'top'\ntype = 'limit-switch'\njoint = 'lift'\nside = 'upper'\nat = 0.02\nlatch = true\nhysteresis = 0.002\n";
    let joint = "dry_friction = 40\nlimit = { lower = 0, upper = 0.31 }";
    let arm = lifter(joint, &format!("\n{text}"));
    let gains = position(2000.0);
    // up onto the switch, back below it, and up again: two approaches
    let goals = [0.05, 0.0, 0.05];
    let mut state = ([0.0, 0.0], [0.0, 0.0]);
    let mut trips = 0;
    for goal in goals {
        let trace = held(&arm, None, &gains, (&state.0, &state.1), &[goal, 0.0], 1000);
        trips += edges(&trace).0;
        let (q, qd) = (trace.q.at(1000), trace.qd.at(1000));
        state = ([q[0], q[1]], [qd[0], qd[1]]);
    }
    assert_eq!(trips, 2);
}

#[test]
fn friction_of_two_directions_holds_and_opposes_each_with_its_own() {
    let horn = motor(0.5, "dry_friction = { positive = 3.0, negative = 1.0 }");
    let rate = |effort: f64| {
        let trace = held(&horn, None, &EFFORT, (&[0.0], &[0.0]), &[effort], 500);
        trace.qd.at(500)[0]
    };
    assert!(rate(2.9).abs() < 1e-12, "{}", rate(2.9));
    assert!(rate(-0.9).abs() < 1e-12, "{}", rate(-0.9));
    assert!((rate(4.0) - 1.0).abs() < 1e-12, "{}", rate(4.0));
    assert!((rate(-4.0) + 3.0).abs() < 1e-12, "{}", rate(-4.0));
    // it comes to rest: 2 rad/s against 3 N m on 0.5 kg m² take 1/3 s
    let trace = held(&horn, None, &EFFORT, (&[0.0], &[2.0]), &[0.0], 500);
    assert!(
        (trace.q.at(500)[0] - 2.0 / 6.0).abs() < 1e-6,
        "{}",
        trace.q.at(500)[0]
    );
}
