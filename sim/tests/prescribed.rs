//! Prescribed motion against golden numbers, closed forms and other runs; pushes against closed forms.

use std::num::NonZeroU32;
use std::sync::Arc;

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoSettings};
use kinemark_sim::dynamics::{energy, inverse_dynamics};
use kinemark_sim::joint_space::{JointAccelerations, JointPositions, JointVelocities};
use kinemark_sim::model::air::Drag;
use kinemark_sim::model::prescribed_motion::Motion;
use kinemark_sim::model::push::{Push, Pushed};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, Wind};
use kinemark_sim::run;
use kinemark_sim::run::{End, RunError, Setup};
use kinemark_sim::spatial::Twist;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::{Trace, TraceRecorder};
use kinemark_sim::trajectory::{JointLaw, Limits, Sine, SplineEnds};
use kinemark_sim::watch::event::EventKind;
use nalgebra::Vector3;

use crate::arms::{lab_robot, robot, rrbot};
use crate::contact_scenes::{GRAVITY, at, boxed, part, scene};
use crate::golden_rrbot::{golden, numbers};
use crate::loops::bars;

const STEP_S: f64 = 1e-3;

fn sine(amplitude: f64, angular_frequency_rad_s: f64, phase_rad: f64, offset: f64) -> JointLaw {
    JointLaw::sine(Sine {
        amplitude,
        angular_frequency_rad_s,
        phase_rad,
        offset,
    })
    .expect("a law")
}

fn setup<'a>(robot: &'a Robot, scene: Option<&'a Scene>, mode: Mode, ticks: u64) -> Setup<'a> {
    let gains = GainLists::none(robot.n());
    Setup {
        robot,
        scene,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods: Periods {
            step_s: STEP_S,
            ticks_per_servo: NonZeroU32::MIN,
            ticks_per_control: NonZeroU32::new(10).expect("ten"),
        },
        gravity_m_s2: GRAVITY,
        servo: ServoSettings::new(robot, mode, Derivative::Measurement, &gains, false)
            .expect("servos"),
        sensors: Vec::new(),
        start_q: robot.home().to_vec(),
        start_qd: vec![0.0; robot.n()],
        laws: None,
        pushes: Vec::new(),
        ticks,
    }
}

/// A run under laws, or with no effort where there are none.
fn recorded(setup: &Setup<'_>) -> Result<Trace, RunError> {
    let mut recorder = TraceRecorder::new(setup);
    let still = |_: &run::Observation<'_>, _: &mut [f64]| Ok::<(), ()>(());
    let end = run::run(setup, still, &mut recorder)?;
    assert_eq!(end, End::Finished);
    Ok(recorder.finish())
}

fn prescribed<'a>(
    robot: &'a Robot,
    scene: Option<&'a Scene>,
    laws: Vec<JointLaw>,
    ticks: u64,
) -> Setup<'a> {
    Setup {
        laws: Some(laws.into()),
        ..setup(robot, scene, Mode::Prescribed, ticks)
    }
}

fn uarm_laws() -> Vec<JointLaw> {
    [(150.0_f64, 0.25), (15.0, 1.0), (20.0, 1.0)]
        .map(|(amplitude, rate)| sine(amplitude.to_radians(), rate, 0.0, 0.0))
        .to_vec()
}

#[test]
fn the_torques_of_the_uarm_along_its_published_laws_are_the_golden_ones() {
    let robot = lab_robot("uarm");
    let trace = recorded(&prescribed(&robot, None, uarm_laws(), 20_000)).expect("a run");
    let file = golden("G_uarm.json");
    let rows = file["trajectory"]["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 401);
    let independent = robot.independent();
    for (row, tick) in rows.iter().map(numbers).zip((0..).step_by(50)) {
        for (k, &joint) in independent.iter().enumerate() {
            let off = trace.effort.at(tick)[joint] - row[7 + k];
            assert!(off.abs() <= 1e-11, "{off:.1e} N m at {} s", row[0]);
            let angle = trace.q.at(tick)[joint].to_degrees() - row[1 + k];
            assert!(angle.abs() <= 1e-8, "{angle:.1e} degrees at {} s", row[0]);
        }
        let tcp = trace.tcp_position(tick) * 1e3 - Vector3::new(row[4], row[5], row[6]);
        assert!(tcp.norm() <= 1e-8, "{:.1e} mm at {} s", tcp.norm(), row[0]);
    }
    // dependent joints have no drive
    for &joint in robot.dependent() {
        assert!(trace.effort.component(joint).all(|effort| effort == 0.0));
    }
}

#[test]
fn efforts_are_inverse_dynamics_at_the_laws_and_do_the_work() {
    let robot = rrbot();
    let limits = Limits {
        speed: 1.5,
        acceleration: 3.0,
    };
    let laws = vec![
        JointLaw::trapezoid(0.2, 1.4, &limits, 0.25).expect("a law"),
        JointLaw::table(&[0.0, 0.7, 1.6], &[0.0, -0.9, 0.4], SplineEnds::AT_REST).expect("a law"),
    ];
    let ticks = 2000;
    let trace = recorded(&prescribed(&robot, None, laws.clone(), ticks)).expect("a run");
    let at = |list: &[f64]| JointPositions::new(list.iter().copied());
    let mut work_j = 0.0;
    let energy_at = |tick: usize| {
        let (q, qd) = (at(trace.q.at(tick)), trace.qd.at(tick).iter().copied());
        let energy = energy(&robot, &GRAVITY, &q, &JointVelocities::new(qd));
        energy.kinetic_j + energy.potential_j
    };
    let power = |tick: usize| -> f64 {
        let damped: Vec<f64> = robot.moving_joints().map(|joint| joint.damping).collect();
        let (effort, qd) = (trace.effort.at(tick), trace.qd.at(tick));
        (0..2)
            .map(|i| (effort[i] - damped[i] * qd[i]) * qd[i])
            .sum()
    };
    for tick in 0..=ticks as usize {
        let samples: Vec<_> = laws
            .iter()
            .map(|law| law.at(tick as f64 * STEP_S))
            .collect();
        let efforts = inverse_dynamics(
            &robot,
            &GRAVITY,
            &JointPositions::new(samples.iter().map(|sample| sample.position)),
            &JointVelocities::new(samples.iter().map(|sample| sample.velocity)),
            &JointAccelerations::new(samples.iter().map(|sample| sample.acceleration)),
        );
        for (taken, effort) in trace.effort.at(tick).iter().zip(efforts.as_slice()) {
            assert!((taken - effort).abs() < 1e-13, "tick {tick}");
        }
        if tick > 0 {
            work_j += 0.5 * STEP_S * (power(tick - 1) + power(tick));
        }
    }
    // a trapezoid rule over jumps of acceleration
    let gained = energy_at(ticks as usize) - energy_at(0);
    assert!(
        (work_j - gained).abs() < 2e-3 * gained.abs(),
        "{work_j} for {gained} J"
    );
}

#[test]
fn a_motor_that_gives_these_efforts_repeats_the_motion() {
    let robot = rrbot();
    let laws = vec![sine(0.4, 2.0, 0.0, 0.0), sine(-0.6, 3.0, 0.0, 0.0)];
    let taken = recorded(&prescribed(&robot, None, laws, 500)).expect("a run");
    let mut driven = setup(&robot, None, Mode::Effort, 500);
    driven.start_qd = taken.qd.at(0).to_vec();
    driven.periods.ticks_per_control = NonZeroU32::MIN;
    let mut recorder = TraceRecorder::new(&driven);
    let control = |seen: &run::Observation<'_>, command: &mut [f64]| {
        // held over the step: the mean of both of its ends
        let tick = seen.tick as usize;
        let [from, to] = [tick, tick + 1].map(|tick| taken.effort.at(tick));
        for (command, (from, to)) in command.iter_mut().zip(from.iter().zip(to)) {
            *command = 0.5 * (from + to);
        }
        Ok::<(), ()>(())
    };
    run::run(&driven, control, &mut recorder).expect("a run");
    let driven = recorder.finish();
    for joint in 0..2 {
        let off = driven.q.at(500)[joint] - taken.q.at(500)[joint];
        assert!(off.abs() < 1e-5, "joint {joint} {off:.1e} rad");
    }
}

/// A carriage of 2 kg along x, with a face of 0.1 m, at 0.5 m behind a box of 3 kg on the ground.
fn pusher() -> Robot {
    robot(
        "format = 1\nname = 'pusher'\n[[links]]\nname = 'base'\n[[links]]\nname = 'ram'\n\
         shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]\ncontact = { friction = 0.0 }\n\
         inertia = { mass_kg = 2.0 }\n[[joints]]\nname = 'x'\ntype = 'prismatic'\nparent = 'base'\nchild = 'ram'\naxis = [1, 0, 0]\n\
         origin = { xyz_m = [0, 0, 0.1] }\ndry_friction = 1.5\n",
    )
}

fn box_ahead() -> Scene {
    let mut ahead = part(
        "box",
        BodyKind::Free,
        boxed(0.2, 0.2, 0.2),
        3.0,
        at(0.25, 0.0, 0.1),
    );
    ahead.contact.friction = 0.4;
    scene(vec![ahead])
}

#[test]
fn a_prescribed_link_pushes_a_box_as_a_kinematic_body_does_and_feels_it() {
    let (robot, ahead) = (pusher(), box_ahead());
    let law = JointLaw::polynomial(&[0.0, 0.2]).expect("a law");
    let trace = recorded(&prescribed(&robot, Some(&ahead), vec![law], 1500)).expect("a run");
    // beside it a kinematic body of the same motion
    let twist = Twist {
        linear: Vector3::new(0.2, 0.0, 0.0),
        angular: Vector3::zeros(),
    };
    let motion = Motion::steady(at(0.0, 0.0, 0.1), twist);
    let mut ram = part(
        "ram",
        BodyKind::Kinematic(motion),
        boxed(0.1, 0.1, 0.1),
        1.0,
        at(0.0, 0.0, 0.1),
    );
    ram.contact.friction = 0.0;
    let mut bodies = box_ahead().bodies;
    bodies.push(ram);
    let other = scene(bodies);
    let empty = robot_without_shapes();
    let beside = recorded(&setup(&empty, Some(&other), Mode::Effort, 1500)).expect("a run");
    let [x, x_beside] = [&trace, &beside].map(|trace| trace.bodies.at(1500)[0]);
    assert!((x - x_beside).abs() < 1e-6, "{x} and {x_beside}");
    // its face is at 0.35 m then
    assert!((x - 0.45).abs() < 1e-6, "{x}");
    // steadily: the box's friction on the ground, 0.4 3 g, and the joint's
    let expected = 0.4 * 3.0 * 9.81 + 1.5;
    for tick in 1300..1500 {
        let effort = trace.effort.at(tick)[0];
        assert!(
            (effort - expected).abs() < 2e-3 * expected,
            "{effort} N at {tick}"
        );
    }
    // before it touches: the joint's friction alone
    assert!((trace.effort.at(100)[0] - 1.5).abs() < 1e-15);
    let touched = |kind: &EventKind| matches!(kind, EventKind::Touched { .. });
    assert!(trace.events.iter().any(|event| touched(&event.kind)));
}

/// How the run of the pusher ends, with the greatest speed that the box had from one tick to the next \[m/s\].
fn pushed_on(law: &[f64], restitution: f64, wall: bool) -> (End<()>, f64) {
    let (robot, mut ahead) = (pusher(), box_ahead());
    ahead.bodies[0].contact.restitution = restitution;
    if wall {
        let fixed = BodyKind::Fixed;
        let wall = part("wall", fixed, boxed(0.1, 1.0, 1.0), 1.0, at(0.6, 0.0, 0.5));
        ahead.bodies.push(wall);
    }
    let law = JointLaw::polynomial(law).expect("a law");
    let setup = prescribed(&robot, Some(&ahead), vec![law], 2000);
    let mut recorder = TraceRecorder::new(&setup);
    let still = |_: &run::Observation<'_>, _: &mut [f64]| Ok::<(), ()>(());
    let end = run::run(&setup, still, &mut recorder).expect("a run");
    let trace = recorder.finish();
    let place = |tick: usize| Vector3::from_column_slice(&trace.bodies.at(tick)[..3]);
    let speeds = (1..trace.len()).map(|tick| (place(tick) - place(tick - 1)).norm() / STEP_S);
    (end, speeds.fold(0.0, f64::max))
}

#[test]
fn a_body_that_a_prescribed_link_makes_too_fast_ends_the_run() {
    // 0.03 m before the box, with less speed than a robot may have; the box leaves with twice as much
    let (end, fastest_m_s) = pushed_on(&[0.07, 700.0], 1.0, false);
    let End::Diverged { tick, what } = end else {
        panic!("{end:?}");
    };
    let run::DivergenceKind::BodyRunaway { body, speed_m_s } = what else {
        panic!("{what:?}");
    };
    assert_eq!((tick, body), (1, 0));
    assert!((speed_m_s - 1400.0).abs() < 10.0, "{speed_m_s}");
    assert!(fastest_m_s < 1e-9, "{fastest_m_s}");
}

#[test]
fn a_box_that_a_prescribed_link_crushes_against_a_wall_slips_out_and_does_not_fly() {
    // no mass gives way to laws: the link goes through the wall, and the box has to go somewhere
    let (end, fastest_m_s) = pushed_on(&[0.0, 0.2], 0.0, true);
    assert_eq!(end, End::Finished);
    assert!(fastest_m_s < 1.0, "{fastest_m_s}");
}

fn robot_without_shapes() -> Robot {
    robot(
        "format = 1\nname = 'far'\n[[links]]\nname = 'base'\n[[links]]\nname = 'bob'\ninertia = { mass_kg = 1.0, com_m = [0, 0, -0.1], \
         tensor_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }\n[[joints]]\nname = 'hinge'\ntype = 'revolute'\nparent = 'base'\nchild = 'bob'\n\
         axis = [0, 1, 0]\norigin = { xyz_m = [0, 5, 5] }\n",
    )
}

#[test]
fn a_prescribed_link_passes_through_what_is_fixed() {
    let robot = pusher();
    let wall = part(
        "wall",
        BodyKind::Fixed,
        boxed(0.1, 0.2, 0.2),
        1.0,
        at(0.2, 0.0, 0.1),
    );
    let walled = scene(vec![wall]);
    let law = JointLaw::polynomial(&[0.0, 0.4]).expect("a law");
    let trace = recorded(&prescribed(&robot, Some(&walled), vec![law], 1000)).expect("a run");
    assert!((trace.q.at(1000)[0] - 0.4).abs() < 1e-15);
    assert!(trace.contacts.is_empty());
}

#[test]
fn wind_on_a_prescribed_link_takes_effort() {
    let robot = pusher().with_drag(Drag {
        area_m2: 0.5,
        coefficient: 0.8,
    });
    let wind = Wind {
        velocity_m_s: Vector3::new(-3.0, 0.0, 0.0),
        air_density_kg_m3: 1.2,
        gust: None,
    };
    let air = Scene::of_air(GRAVITY, wind);
    let law = JointLaw::polynomial(&[0.0, 1.0]).expect("a law");
    let trace = recorded(&prescribed(&robot, Some(&air), vec![law], 100)).expect("a run");
    // ½ 1.2 0.8 0.5 4² = 3.84 N against it, and the joint's friction
    for tick in 0..=100 {
        assert!((trace.effort.at(tick)[0] - (3.84 + 1.5)).abs() < 1e-12);
    }
}

#[test]
fn laws_that_a_loop_cannot_follow_end_the_run_with_their_time() {
    let hinge = "[[loops]]\ntype = \"revolute\"\nlinks = [\"coupler\", \"rocker\"]\naxis = [0, 1, 0]\n\
        frame_on_first = { xyz_m = [0.4, 0, 0] }\nframe_on_second = { xyz_m = [0.8, 0, 0] }\n";
    let rocks = bars(
        [1.0, 0.4, 1.0, 0.8],
        [1.047, -1.236, 1.71],
        "passive = true\n",
        hinge,
    );
    let robot = robot(&rocks);
    let start = robot.home()[0];
    let law = JointLaw::polynomial(&[start, 1.0]).expect("a law");
    let Err(RunError::Loops { time_s, .. }) = recorded(&prescribed(&robot, None, vec![law], 3000))
    else {
        panic!("a run");
    };
    // coupler and rocker lie in one line then: 2 sin(θ/2) = 1.2
    let stretched = 2.0 * libm::asin(0.6) - start;
    assert!(
        (time_s - stretched).abs() < 2e-3,
        "{time_s} for {stretched} s"
    );
}

fn push(on: Pushed, force_n: [f64; 3], ticks: [u64; 2]) -> Push {
    Push {
        on,
        p_m: Vector3::zeros(),
        force_n: force_n.into(),
        moment_n_m: Vector3::zeros(),
        from_tick: ticks[0],
        end_tick: ticks[1],
    }
}

#[test]
fn a_push_on_a_carriage_follows_newton_and_coulomb() {
    let robot = pusher();
    let mut setup = setup(&robot, None, Mode::Effort, 1000);
    setup.pushes = vec![
        push(Pushed::Link(1), [11.5, 7.0, -3.0], [100, 300]),
        // too weak to overcome the joint's friction
        push(Pushed::Link(1), [1.4, 0.0, 0.0], [0, 100]),
    ];
    let trace = recorded(&setup).expect("a run");
    assert!(trace.q.at(100)[0].abs() < 1e-15);
    // (11.5 - 1.5) / 2 = 5 m/s² for 0.2 s, then 0.75 m/s² against it
    let v = trace.qd.at(300)[0];
    assert!((v - 1.0).abs() < 1e-12, "{v}");
    assert!((trace.q.at(300)[0] - 0.1).abs() < 1e-12);
    let (v, q) = (trace.qd.at(900)[0], trace.q.at(900)[0]);
    assert!((v - (1.0 - 0.75 * 0.6)).abs() < 1e-12, "{v}");
    assert!((q - (0.1 + 0.6 - 0.375 * 0.36)).abs() < 1e-12, "{q}");
    // what a motor delivers is recorded, and a push is none
    assert!(trace.effort.component(0).all(|effort| effort == 0.0));
}

#[test]
fn a_push_on_a_turning_link_keeps_its_direction_and_its_work() {
    let bob = robot_without_shapes();
    let mut setup = setup(&bob, None, Mode::Effort, 800);
    setup.start_qd = vec![0.7];
    let (p, force) = (Vector3::new(0.05, 0.0, -0.3), Vector3::new(4.0, 9.0, 2.0));
    setup.pushes = vec![Push {
        p_m: p,
        moment_n_m: Vector3::new(3.0, 0.2, -1.0),
        ..push(Pushed::Link(1), force.into(), [0, 800])
    }];
    let trace = recorded(&setup).expect("a run");
    let of = |tick: usize| {
        let (q, qd) = (trace.q.at(tick)[0], trace.qd.at(tick)[0]);
        let at = kinemark_sim::spatial::rotation_about_axis_deg(Vector3::y(), q.to_degrees()) * p;
        let energy = energy(
            &bob,
            &GRAVITY,
            &JointPositions::new([q]),
            &JointVelocities::new([qd]),
        );
        // both the force and the moment about the axis have a potential
        energy.kinetic_j + energy.potential_j - force.dot(&at) - 0.2 * q
    };
    assert!(trace.q.at(800)[0].abs() > 0.5);
    for tick in [200, 500, 800] {
        let change = of(tick) - of(0);
        assert!(change.abs() < 1e-9, "{change:.1e} J");
    }
}

#[test]
fn a_push_wakes_a_box_and_slides_it_as_coulomb_says() {
    let (far, ahead) = (robot_without_shapes(), box_ahead());
    let mut setup = setup(&far, Some(&ahead), Mode::Effort, 4000);
    // 20 N for half a second against 0.4 3 g, when it has slept for long
    setup.pushes = vec![push(Pushed::Body(0), [20.0, 0.0, 0.0], [3000, 3500])];
    let trace = recorded(&setup).expect("a run");
    let x = |tick: usize| trace.bodies.at(tick)[0] - 0.25;
    assert!(x(3000).abs() < 1e-6, "{}", x(3000));
    let rubs = 0.4 * 9.81;
    let gains = 20.0 / 3.0 - rubs;
    let expected = 0.5 * gains * 0.25;
    assert!(
        (x(3500) - expected).abs() < 1e-3 * expected,
        "{} for {expected}",
        x(3500)
    );
    let v = gains * 0.5;
    let stops = expected + 0.5 * v * v / rubs;
    assert!(
        (x(4000) - stops).abs() < 2e-3 * stops,
        "{} for {stops}",
        x(4000)
    );
}

#[test]
fn a_run_under_laws_ignores_commands_and_repeats_to_the_bit() {
    let robot = rrbot();
    let laws: Arc<[JointLaw]> = vec![sine(0.4, 2.0, 0.3, 0.1), sine(-0.6, 3.0, 0.0, 0.0)].into();
    let mut setup = setup(&robot, None, Mode::Prescribed, 300);
    setup.laws = Some(laws);
    let of = |sign: f64| {
        let mut recorder = TraceRecorder::new(&setup);
        let control = |seen: &run::Observation<'_>, command: &mut [f64]| {
            command.fill(sign * seen.time_s);
            Ok::<(), ()>(())
        };
        run::run(&setup, control, &mut recorder).expect("a run");
        recorder.finish()
    };
    let (one, other) = (of(1.0), of(-1.0));
    assert_eq!((&one.q, &one.effort), (&other.q, &other.effort));
    assert_ne!(one.command, other.command);
    assert!((one.command.at(15)[0] - 0.01).abs() < 1e-15);
    assert!((one.q.at(0)[0] - (0.1 + 0.4 * libm::sin(0.3))).abs() < 1e-15);
}
