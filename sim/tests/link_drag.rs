//! Drag on links: forces and speeds by hand, Jacobians, order and energy of the step, and the same gusts as the bodies feel.

use kinemark_sim::dynamics::link_forces::LinkForces;
use kinemark_sim::dynamics::{GRAVITY_M_S2, energy};
use kinemark_sim::format::RobotFile;
use kinemark_sim::joint_space::{JointPositions, JointVelocities};
use kinemark_sim::kinematics::geometric_jacobian;
use kinemark_sim::model::air::{AirNow, Drag};
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::gust::Gust;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{Scene, Wind};
use kinemark_sim::step::hybrid::{HybridStep, StateFrom};
use kinemark_sim::step::smooth::SmoothStep;
use kinemark_sim::text::{Problem as _, Source};
use nalgebra::Vector3;

use crate::arms::{Numbers, lab_robot, random_tree, robot, rrbot};
use crate::contact_scenes::scene;

/// ½ 1.2 0.8 0.5 = 0.24 N s²/m².
const SAIL: &str = "drag = { area_m2 = 0.5, coefficient = 0.8 }";

fn air(x: f64, y: f64, z: f64) -> AirNow {
    AirNow {
        density_kg_m3: 1.2,
        velocity_m_s: Vector3::new(x, y, z),
    }
}

/// A bob half a metre below a hinge along y; `drag` and `more` are lines of its link and its joint.
fn pendulum(drag: &str, more: &str) -> Robot {
    robot(&format!(
        r#"
        format = 1
        name = "pendulum"
        [[links]]
        name = "post"
        [[links]]
        name = "bob"
        inertia = {{ mass_kg = 2.0, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }}
        {drag}
        [[links]]
        name = "weight"
        inertia = {{ mass_kg = 3.0, com_m = [0, 0, 0.1], tensor_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }}
        [[joints]]
        name = "hinge"
        type = "revolute"
        parent = "post"
        child = "bob"
        axis = [0, 1, 0]
        {more}
        [[joints]]
        name = "bolt"
        type = "fixed"
        parent = "bob"
        child = "weight"
        "#
    ))
}

/// A block of 2 kg, 0.2 m high, that slides up and down, with its underside at `q`.
fn lift(drag: &str) -> Robot {
    robot(&format!(
        r#"
        format = 1
        name = "lift"
        [[links]]
        name = "rail"
        [[links]]
        name = "block"
        shapes = [{{ box = {{ size_m = [0.2, 0.2, 0.2] }}, origin = {{ xyz_m = [0, 0, 0.1] }} }}]
        inertia = {{ mass_kg = 2.0 }}
        {drag}
        [[joints]]
        name = "slide"
        type = "prismatic"
        parent = "rail"
        child = "block"
        axis = [0, 0, 1]
        "#
    ))
}

fn efforts(robot: &Robot, air: &AirNow, q: &[f64], qd: &[f64]) -> Vec<f64> {
    let mut effort = vec![0.0; robot.n()];
    let mut forces = LinkForces::new(robot);
    forces.set_air(Some(*air));
    forces.add_efforts(robot, q, qd, &mut effort);
    effort
}

#[test]
fn a_pendulum_in_the_wind_feels_force_times_lever() {
    use std::f64::consts::FRAC_PI_2;
    let robot = pendulum(SAIL, "");
    // |v| = 5: F = 0.24 * 5 * (3, 0, 4) = (3.6, 0, 4.8) N, at the bob's own centre of mass and not that of bob and weight
    let wind = air(3.0, 0.0, 4.0);
    // below the hinge: (r × F)_y = z F_x = -0.5 * 3.6
    assert!((efforts(&robot, &wind, &[0.0], &[0.0])[0] + 1.8).abs() < 1e-14);
    // at -x from it: -x F_z = 0.5 * 4.8
    assert!((efforts(&robot, &wind, &[FRAC_PI_2], &[0.0])[0] - 2.4).abs() < 1e-14);
    // it goes with the wind: below the hinge the bob moves at -0.5 qd along x
    let still = efforts(&robot, &air(3.0, 0.0, 0.0), &[0.0], &[-6.0]);
    assert!(still[0].abs() < 1e-14, "{still:?}");
    // a link without mass has its origin for a centre of mass: on the axis, nothing turns it
    let text = "format = 1\nname = 'vane'\n[[links]]\nname = 'post'\n[[links]]\nname = 'vane'\ninertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[links]]\nname = 'sail'\ndrag = { area_m2 = 0.5, coefficient = 0.8 }\n[[joints]]\nname = 'turn'\ntype = 'continuous'\nparent = 'post'\nchild = 'vane'\naxis = [0, 0, 1]\n[[joints]]\nname = 'mast'\ntype = 'fixed'\nparent = 'vane'\nchild = 'sail'\norigin = { xyz_m = [2, 0, 0] }\n";
    let vane = crate::arms::robot(text);
    // F = 0.24 * 25 = 6 N along y, 2 m out
    let turned = efforts(&vane, &air(0.0, 5.0, 0.0), &[0.0], &[0.0]);
    assert!((turned[0] - 12.0).abs() < 1e-13, "{turned:?}");
}

#[test]
fn a_block_sinks_at_its_terminal_speed() {
    let robot = lift(SAIL);
    // 2 kg * 9.81 = 0.24 v²; from rest v = v_t tanh(g t / v_t)
    let terminal = (2.0_f64 * 9.81 / 0.24).sqrt();
    let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-3);
    step.set_air(Some(air(0.0, 0.0, 0.0)));
    let (mut q, mut qd) = ([0.0], [0.0]);
    for tick in 1..=20_000 {
        step.advance(&robot, &[0.0], &mut q, &mut qd).expect("mass");
        if tick == 500 {
            let expected = -terminal * libm::tanh(9.81 * 0.5 / terminal);
            // fourth order at 1 ms: far below rounding of the sum of 500 steps
            assert!((qd[0] - expected).abs() < 1e-12, "{qd:?} {expected}");
        }
    }
    // exp(-2 g t / v_t) of the speed is missing, which is 1e-19 after 20 s
    assert!((qd[0] + terminal).abs() < 1e-6, "{qd:?} {terminal}");
    // in a wind up the shaft at that speed it hangs still
    step.set_air(Some(air(0.0, 0.0, terminal)));
    let (mut q, mut qd) = ([0.0], [0.0]);
    step.advance(&robot, &[0.0], &mut q, &mut qd).expect("mass");
    assert!(qd[0].abs() < 1e-15 && q[0].abs() < 1e-15);
}

/// A robot like another, with drag on every link.
fn with_drag(robot: &Robot) -> Robot {
    let text = robot.to_toml(&mut |path| path.to_owned());
    let lines = text.lines().scan(false, |in_link, line| {
        if line.starts_with("[[") {
            *in_link = line == "[[links]]";
        }
        let sail = *in_link && line.starts_with("name = ");
        Some(if sail {
            format!("{line}\n{SAIL}\n")
        } else {
            format!("{line}\n")
        })
    });
    crate::arms::robot(&lines.collect::<String>())
}

fn finger_pair() -> Robot {
    robot(
        "format = 1\nname = 'gripper'\n[[links]]\nname = 'wrist'\n[[links]]\nname = 'palm'\ninertia = { mass_kg = 1.0, com_m = [0.1, 0.2, 0], tensor_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }\n[[links]]\nname = 'left'\ninertia = { mass_kg = 0.3, com_m = [0, 0.1, 0.2], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }\n[[links]]\nname = 'right'\ninertia = { mass_kg = 0.3, com_m = [0, 0.3, 0.1], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }\n[[joints]]\nname = 'turn'\ntype = 'continuous'\nparent = 'wrist'\nchild = 'palm'\naxis = [0, 0, 1]\n[[joints]]\nname = 'left'\ntype = 'revolute'\nparent = 'palm'\nchild = 'left'\naxis = [1, 0, 0]\norigin = { xyz_m = [0, 0.05, 0] }\n[[joints]]\nname = 'right'\ntype = 'revolute'\nparent = 'palm'\nchild = 'right'\naxis = [1, 0, 0]\norigin = { xyz_m = [0, -0.05, 0] }\nmimic = { joint = 'left', multiplier = -1.5, offset = 0.2 }\n",
    )
}

#[test]
fn efforts_are_those_of_the_jacobians_at_the_centres_of_mass() {
    let robots = (0..12).map(|seed| random_tree(seed, 9)).chain([
        finger_pair(),
        lab_robot("uarm"),
        lab_robot("puma560"),
    ]);
    for (seed, plain) in robots.enumerate() {
        let blown = with_drag(&plain);
        // the same robot with a frame at each centre of mass
        let mut text = blown.to_toml(&mut |path| path.to_owned());
        for link in blown.links() {
            let com = link.inertia.com_m;
            text += &format!(
                "\n[[frames]]\nname = \"com of {}\"\nlink = \"{}\"\norigin = {{ xyz_m = [{:?}, {:?}, {:?}] }}\n",
                link.name, link.name, com.x, com.y, com.z
            );
        }
        let framed = robot(&text);
        let n = blown.n();
        let mut numbers = Numbers::new(seed as u64);
        let (q, qd) = (numbers.vector(n, 1.0), numbers.vector(n, 2.0));
        let wind = air(3.0, -2.0, 1.0);
        let found = efforts(&blown, &wind, &q, &qd);
        let (jq, jqd) = (
            JointPositions::new(q.iter().copied()),
            JointVelocities::new(qd.iter().copied()),
        );
        let mut expected = vec![0.0; n];
        for link in framed.links() {
            let frame = framed
                .frame(&format!("com of {}", link.name))
                .expect("a frame");
            let jacobian = geometric_jacobian(&framed, &jq, frame);
            let linear = jacobian.rows(0, 3);
            let velocity = linear * jqd.vector();
            let drag = link.drag.expect("drag");
            let past = wind.velocity_m_s - Vector3::new(velocity[0], velocity[1], velocity[2]);
            let force = drag.force_n(1.2, &past);
            for (expected, column) in expected.iter_mut().zip(linear.column_iter()) {
                *expected += column.dot(&force);
            }
        }
        for (found, expected) in found.iter().zip(&expected) {
            // a few hundred products of numbers near 10
            assert!(
                (found - expected).abs() < 1e-11,
                "{seed}: {found} {expected}"
            );
        }
    }
}

#[test]
fn halving_the_step_divides_the_error_by_sixteen() {
    let robot = with_drag(&rrbot());
    let end = |dt_s: f64| {
        let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, dt_s);
        step.set_air(Some(air(2.0, 0.5, -1.0)));
        let (mut q, mut qd) = ([0.3, -0.4], [1.0, -2.0]);
        for _ in 0..(0.4 / dt_s).round() as usize {
            step.advance(&robot, &[1.0, -0.5], &mut q, &mut qd)
                .expect("mass");
        }
        [q[0], q[1], qd[0], qd[1]]
    };
    let exact = end(1e-4);
    let error = |dt_s| {
        let errors = end(dt_s).into_iter().zip(exact);
        errors.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let ratio = error(4e-3) / error(2e-3);
    // sixteen in the limit; the next order shows at these steps
    assert!((14.0..18.5).contains(&ratio), "{ratio} {:e}", error(4e-3));
}

#[test]
fn in_still_air_energy_never_grows() {
    let undamped = |robot: Robot| {
        let text = robot.to_toml(&mut |path| path.to_owned());
        let kept = text.lines().filter(|line| !line.starts_with("damping"));
        with_drag(&crate::arms::robot(&kept.collect::<Vec<_>>().join("\n")))
    };
    let total = |robot: &Robot, q: &[f64], qd: &[f64]| {
        let q = JointPositions::new(q.iter().copied());
        let qd = JointVelocities::new(qd.iter().copied());
        let energy = energy(robot, &GRAVITY_M_S2, &q, &qd);
        energy.kinetic_j + energy.potential_j
    };
    for plain in [rrbot(), finger_pair(), lab_robot("uarm")] {
        let robot = undamped(plain);
        let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-4);
        step.set_air(Some(air(0.0, 0.0, 0.0)));
        assert!(step.feels_forces());
        let n = robot.n();
        // the loop at home, the others out of their rest
        let mut q = robot.home().to_vec();
        if robot.loops().is_empty() {
            q.fill(0.5);
        }
        let mut qd = vec![0.0; n];
        let start = total(&robot, &q, &qd);
        let mut before = start;
        for tick in 0..8000 {
            step.advance(&robot, &vec![0.0; n], &mut q, &mut qd)
                .expect("mass");
            let now = total(&robot, &q, &qd);
            // the error of a step of fourth order, far below what the air takes while anything moves
            assert!(
                now <= before + 1e-9,
                "{}, {tick}: {}",
                robot.name(),
                now - before
            );
            before = now;
        }
        assert!(
            before < start - 1e-3,
            "{}: {}",
            robot.name(),
            start - before
        );
    }
}

#[test]
fn what_the_air_takes_is_force_times_speed_in_a_loop_too() {
    let text = lab_robot("uarm").to_toml(&mut |path| path.to_owned());
    let kept: Vec<&str> = text
        .lines()
        .filter(|line| !line.starts_with("damping") && !line.starts_with("dry_friction"))
        .collect();
    let robot = with_drag(&crate::arms::robot(&kept.join("\n")));
    let n = robot.n();
    let mut step = SmoothStep::new(&robot, Vector3::zeros(), 1e-4);
    let calm = air(0.0, 0.0, 0.0);
    step.set_air(Some(calm));
    let mut q = robot.home().to_vec();
    let mut qd = vec![0.0; n];
    // set in motion by its drives
    let mut push = vec![0.0; n];
    for &i in robot.independent() {
        push[i] = 0.2;
    }
    for _ in 0..200 {
        step.advance(&robot, &push, &mut q, &mut qd).expect("mass");
    }
    let kinetic = |q: &[f64], qd: &[f64]| {
        let q = JointPositions::new(q.iter().copied());
        let qd = JointVelocities::new(qd.iter().copied());
        energy(&robot, &Vector3::zeros(), &q, &qd).kinetic_j
    };
    let power = |q: &[f64], qd: &[f64]| -> f64 {
        let drag = efforts(&robot, &calm, q, qd);
        drag.iter()
            .zip(qd)
            .map(|(effort, rate)| effort * rate)
            .sum()
    };
    let (mut work, start) = (0.0, kinetic(&q, &qd));
    for _ in 0..1000 {
        let before = power(&q, &qd);
        step.advance(&robot, &vec![0.0; n], &mut q, &mut qd)
            .expect("mass");
        work += 0.5e-4 * (before + power(&q, &qd));
    }
    let change = kinetic(&q, &qd) - start;
    assert!(change < -1e-6 * start.max(1e-12), "{change}");
    // the trapezoidal rule at 0.1 ms
    assert!(
        (change - work).abs() < 1e-5 * change.abs(),
        "{change} {work}"
    );
}

fn windy(velocity_m_s: Vector3<f64>, gust: Option<Gust>) -> Scene {
    let mut scene = scene(Vec::new());
    scene.environment.wind = Some(Wind {
        velocity_m_s,
        air_density_kg_m3: 1.2,
        gust,
    });
    scene
}

const GUST: Gust = Gust {
    speed_m_s: 2.0,
    correlation_s: 0.1,
    seed: 5,
};

#[test]
fn links_feel_the_gusts_of_the_scene_step_by_step() {
    let robot = with_drag(&rrbot());
    let mean = Vector3::new(3.0, 0.0, -1.0);
    let by_scene = |seed| {
        let scene = windy(mean, Some(Gust { seed, ..GUST }));
        let mut hybrid = HybridStep::new(&robot, &scene, GRAVITY_M_S2, 1e-3).expect("a scene");
        let (mut q, mut qd) = ([0.1, 0.2], [0.0; 2]);
        for _ in 0..600 {
            hybrid
                .advance(&robot, &[0.5, 0.0], &mut q, &mut qd)
                .expect("a step");
            assert_eq!(hybrid.report().state_from, StateFrom::Smooth);
        }
        (q, qd)
    };
    let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-3);
    let (mut q, mut qd) = ([0.1, 0.2], [0.0; 2]);
    let along = mean / mean.norm();
    for gust_m_s in GUST.sequence(1e-3).take(600) {
        let v = mean + along * gust_m_s;
        step.set_air(Some(air(v.x, v.y, v.z)));
        step.advance(&robot, &[0.5, 0.0], &mut q, &mut qd)
            .expect("mass");
    }
    let found = by_scene(GUST.seed);
    for (a, b) in q.iter().chain(&qd).zip(found.0.iter().chain(&found.1)) {
        // directions normalised twice differ by a rounding
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
    assert_eq!(found, by_scene(GUST.seed));
    assert_ne!(found, by_scene(GUST.seed + 1));
}

#[test]
fn without_air_or_drag_that_moves_not_a_bit_changes() {
    let run = |robot: &Robot, scene: &Scene| {
        let mut hybrid = HybridStep::new(robot, scene, GRAVITY_M_S2, 1e-3).expect("a scene");
        let (mut q, mut qd) = ([0.1, 0.2], [0.0; 2]);
        for _ in 0..300 {
            hybrid
                .advance(robot, &[0.5, 0.0], &mut q, &mut qd)
                .expect("a step");
        }
        [q[0], q[1], qd[0], qd[1]].map(f64::to_bits)
    };
    let (plain, blown) = (rrbot(), with_drag(&rrbot()));
    let (calm, wind) = (
        scene(Vec::new()),
        windy(Vector3::new(4.0, 0.0, 0.0), Some(GUST)),
    );
    let expected = run(&plain, &calm);
    assert_eq!(run(&blown, &calm), expected);
    assert_eq!(run(&plain, &wind), expected);
    assert_ne!(run(&blown, &wind), expected);
    // drag on what is fixed to the world
    let text = std::fs::read_to_string(format!(
        "{}/../labs/robots/rrbot.toml",
        env!("CARGO_MANIFEST_DIR")
    ))
    .expect("rrbot");
    let post = robot(&text.replacen("name = \"base\"", &format!("name = \"base\"\n{SAIL}"), 1));
    assert!(post.links()[0].drag.is_some() && !LinkForces::new(&post).have_drag());
    assert_eq!(run(&post, &wind), expected);
}

#[test]
fn a_block_on_the_ground_presses_with_what_the_wind_does_not_carry() {
    // 0.24 * 6² = 8.64 N upwards
    let robot = lift(SAIL);
    let scene = windy(Vector3::new(0.0, 0.0, 6.0), None);
    let mut hybrid = HybridStep::new(&robot, &scene, GRAVITY_M_S2, 1e-3).expect("a scene");
    let (mut q, mut qd) = ([0.0], [0.0]);
    for _ in 0..1000 {
        hybrid
            .advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("a step");
    }
    let report = hybrid.report();
    assert_eq!(report.state_from, StateFrom::Contact);
    let fact = report
        .contacts
        .iter()
        .find(|fact| fact.parties == [Party::Link(1), Party::Ground])
        .expect("it stands on the ground");
    let expected = 2.0 * 9.81 - 8.64;
    // a block at rest in the engine's contact: its own tolerance
    assert!(
        (fact.force_n - expected).abs() < 1e-3 * expected,
        "{}",
        fact.force_n
    );
    assert!(q[0].abs() < 1e-4 && qd[0].abs() < 1e-6, "{q:?} {qd:?}");
}

#[test]
fn a_stop_holds_against_the_wind() {
    // upright in the stop at zero, weights aside; the wind from the front pushes with 0.24 * 16 * 0.5 = 1.92 N m
    let robot = pendulum(SAIL, "limit = { lower = 0.0, upper = 1.0 }");
    let scene = windy(Vector3::new(4.0, 0.0, 0.0), None);
    let mut hybrid = HybridStep::new(&robot, &scene, GRAVITY_M_S2, 1e-3).expect("a scene");
    let (mut q, mut qd) = ([0.0], [0.0]);
    for _ in 0..100 {
        hybrid
            .advance(&robot, &[0.0], &mut q, &mut qd)
            .expect("a step");
        let report = hybrid.report();
        assert_eq!(report.at_limit, [0]);
        let (joint, impulse) = report.stops[0];
        assert_eq!(joint, 0);
        assert!((impulse - 1.92e-3).abs() < 1e-12, "{impulse}");
    }
    assert!(q[0].abs() < 1e-15 && qd[0].abs() < 1e-12, "{q:?} {qd:?}");
}

#[test]
fn dry_friction_sticks_against_a_light_wind_and_slips_in_a_strong_one() {
    let robot = pendulum(SAIL, "dry_friction = 1.0");
    let moved = |speed: f64| {
        let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, 1e-3);
        step.set_air(Some(air(speed, 0.0, 0.0)));
        let (mut q, mut qd) = ([0.0], [0.0]);
        for _ in 0..200 {
            step.advance(&robot, &[0.0], &mut q, &mut qd).expect("mass");
        }
        q[0].abs()
    };
    // 0.24 * 2.5² * 0.5 = 0.75 N m, and 0.24 * 4² * 0.5 = 1.92 N m
    assert!(moved(2.5) < 1e-12, "{}", moved(2.5));
    assert!(moved(4.0) > 1e-3, "{}", moved(4.0));
}

#[test]
fn a_robot_file_states_drag_and_is_written_with_it() {
    let text = |drag: &str| {
        format!(
            "format = 1\nname = 'r'\n[dimensions]\nwidth = 0.2\n[[links]]\nname = 'base'\n[[links]]\nname = 'arm'\ndrag = {drag}\n[[joints]]\nname = 'j'\ntype = 'revolute'\nparent = 'base'\nchild = 'arm'\naxis = [0, 0, 1]\n"
        )
    };
    let read = |drag: &str| RobotFile::parse(Source::new("r.toml", text(drag)))?.build(&[]);
    let stated = read("{ area_m2 = 'width * 0.5', coefficient = 1.1 }").expect("a robot");
    let drag = Drag {
        area_m2: 0.1,
        coefficient: 1.1,
    };
    assert_eq!(stated.links()[1].drag, Some(drag));
    assert_eq!(stated.links()[0].drag, None);
    let written = stated.to_toml(&mut |path| path.to_owned());
    assert_eq!(robot(&written).links()[1].drag, Some(drag));
    for (drag, code) in [
        ("{ area_m2 = -1, coefficient = 1 }", "robot::out_of_range"),
        ("{ area_m2 = 1, coefficient = -1 }", "robot::out_of_range"),
        ("{ area_m2 = 1 }", "robot::toml"),
        ("{ area_m2 = 1, coefficient = 1, width = 3 }", "robot::toml"),
        (
            "{ area_m2 = 'height', coefficient = 1 }",
            "robot::expression",
        ),
    ] {
        let error = read(drag).expect_err(drag);
        assert_eq!(error.problem.code(), code, "{error}");
        assert_eq!(error.line_and_column().0, 9, "{error}");
    }
}
