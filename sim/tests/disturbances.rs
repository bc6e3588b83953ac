//! Runs under disturbances: a zero disturbance changes no bit, delayed commands act late, noise affects only measurements, and servos do
//! not know of a payload.

use std::num::NonZeroU32;

use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run::{Disturbance, Observation, Run, Setup};
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};

use crate::arms::rrbot;
use crate::contact_scenes::GRAVITY;

fn setup(robot: &Robot, mode: Mode, kp: f64) -> Setup<'_> {
    let gains = Gains {
        kp,
        ki: 0.0,
        kd: kp * 0.1,
        effort_limit: f64::INFINITY,
        integral_limit: f64::INFINITY,
    };
    Setup {
        robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot.frame("lab").expect("lab"),
        periods: Periods {
            step_s: 1e-3,
            ticks_per_servo: NonZeroU32::new(2).expect("two"),
            ticks_per_control: NonZeroU32::new(10).expect("ten"),
        },
        gravity_m_s2: GRAVITY,
        servo: ServoSettings {
            mode,
            derivative: Derivative::Velocity,
            gains: vec![gains; 2],
            gravity_compensation: true,
        },
        sensors: Vec::new(),
        start_q: vec![0.3, 0.9],
        start_qd: vec![0.0; 2],
        laws: None,
        pushes: Vec::new(),
        ticks: 3000,
    }
}

/// The trace of a run whose command is `lead` of the tick, and what its controller saw of `q[0]`.
fn ran(mut run: Run<'_>, lead: impl Fn(u64) -> [f64; 2]) -> (Trace, Vec<f64>) {
    let mut recorder = TraceRecorder::new(run.setup());
    let mut seen = Vec::new();
    let mut control = |observation: &Observation<'_>, command: &mut [f64]| {
        seen.push(observation.q[0]);
        command.copy_from_slice(&lead(observation.tick));
        Ok::<(), ()>(())
    };
    while run
        .advance(&mut control, &mut recorder)
        .expect("it moves")
        .is_none()
    {}
    (recorder.finish(), seen)
}

fn swing(tick: u64) -> [f64; 2] {
    let s = 0.2 * libm::sin(0.003 * tick as f64);
    [0.3 + s, 0.9 - s]
}

#[test]
fn no_disturbance_changes_no_bit() {
    let robot = rrbot();
    let setup = setup(&robot, Mode::Position, 200.0);
    let plain = Run::new(setup.clone()).expect("a run");
    let calm = Run::disturbed(setup, &Disturbance::default()).expect("a run");
    let (plain, calm) = (ran(plain, swing).0, ran(calm, swing).0);
    assert_eq!(plain.digest(), calm.digest());
}

#[test]
fn a_late_command_is_an_early_one_given_later() {
    let robot = rrbot();
    let setup = setup(&robot, Mode::Position, 200.0);
    let late = Disturbance {
        delay_periods: 3,
        ..Disturbance::default()
    };
    let late = Run::disturbed(setup.clone(), &late).expect("a run");
    let (late, _) = ran(late, swing);
    let (by_hand, _) = ran(Run::new(setup).expect("a run"), |tick| {
        swing(tick.saturating_sub(30))
    });
    assert_eq!(late.digest(), by_hand.digest());
}

#[test]
fn noise_is_seen_and_is_the_same_whatever_is_commanded() {
    let robot = rrbot();
    // without gains nothing moves an arm whose weight is held but what is commanded
    let setup = setup(&robot, Mode::Effort, 0.0);
    let noise = Disturbance {
        q_noise: 1e-3,
        qd_noise: 1e-2,
        seed: 11,
        ..Disturbance::default()
    };
    let seen = |lead: fn(u64) -> [f64; 2]| {
        let run = Run::disturbed(setup.clone(), &noise).expect("a run");
        let (trace, seen) = ran(run, lead);
        let noise = seen.iter().enumerate();
        let noise = noise.map(|(k, q)| q - trace.q.at(10 * k)[0]);
        (noise.collect::<Vec<f64>>(), trace)
    };
    let (still, _) = seen(|_| [0.0, 0.0]);
    let (pushed, _) = seen(|tick| [0.1, 0.001 * tick as f64]);
    for (a, b) in still.iter().zip(&pushed) {
        // two differences from numbers below 10
        assert!((a - b).abs() < 1e-14, "{a} {b}");
    }
    let square = still.iter().map(|x| x * x).sum::<f64>() / still.len() as f64;
    // 300 numbers: five standard errors are 5 sqrt(2 / 300)
    assert!((square / 1e-6 - 1.0).abs() < 0.41, "{square}");
}

#[test]
fn servos_do_not_know_of_a_payload() {
    let robot = rrbot();
    let heavy = rrbot().with_payload(2.0);
    let unknown = Disturbance {
        known: Some(&robot),
        ..Disturbance::default()
    };
    let last = |run: Run<'_>| {
        let (trace, _) = ran(run, |_| [0.3, 0.9]);
        trace.q.at(3000).to_vec()
    };
    let setup = setup(&heavy, Mode::Position, 500.0);
    // known, it is carried
    let carried = last(Run::new(setup.clone()).expect("a run"));
    assert!((carried[1] - 0.9).abs() < 1e-9, "{carried:?}");
    // unknown, the elbow gives way until kp times the error carries 2 kg at the end of the forearm
    let sagged = last(Run::disturbed(setup, &unknown).expect("a run"));
    let lever = {
        let mut poses = kinemark_sim::kinematics::FramePoses::new(&robot);
        poses.update(&robot, &sagged);
        let tcp = poses.world_from(robot.tcp()).translation.vector;
        let mut elbow = robot.joints().iter().filter(|joint| joint.kind.turns());
        let elbow = elbow.next_back().expect("an elbow").child;
        let elbow = poses.world_from(&robot.frames()[elbow]).translation.vector;
        // both joints turn about y, so a weight's lever lies along x
        (tcp - elbow).x.abs()
    };
    let error = (sagged[1] - 0.9).abs();
    assert!(error > 0.02, "{sagged:?}");
    let (servo, weight) = (500.0 * error, 2.0 * 9.81 * lever);
    // at rest after 3 s: the slowest part of the motion falls by about 1/e in 0.1 s
    assert!((servo - weight).abs() < 1e-3 * weight, "{servo} {weight}");
}
