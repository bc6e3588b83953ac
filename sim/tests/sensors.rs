//! Sensors of joints, limit switches, and what devices do to values.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::sensor::Seen;
use kinemark_sim::sensing::{SensorError, Sensors};

use crate::arms::robot;
use crate::contact_scenes::scene;
use crate::sensor_rig::{DT, Rig, sensors, still};

/// A slide along x, and a finger that goes back twice as fast.
pub(crate) const FINGERS: &str = "
format = 1
name = 'fingers'
[[links]]
name = 'base'
[[links]]
name = 'left'
inertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
[[links]]
name = 'right'
inertia = { mass_kg = 1.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }
[[joints]]
name = 'slide'
type = 'prismatic'
parent = 'base'
child = 'left'
axis = [1, 0, 0]
limit = { lower = -0.5, upper = 0.5 }
[[joints]]
name = 'follow'
type = 'prismatic'
parent = 'base'
child = 'right'
axis = [1, 0, 0]
mimic = { joint = 'slide', multiplier = -2, offset = 0.1 }
";

fn fingers(sensors: &str) -> Robot {
    robot(&format!("{FINGERS}{sensors}"))
}

fn switch(name: &str, joint: &str, rest: &str) -> String {
    format!("[[sensors]]\nname = '{name}'\ntype = 'limit-switch'\njoint = '{joint}'\n{rest}\n")
}

#[test]
fn joint_sensors_read_their_own_joint_also_one_that_mimics() {
    let one = |name: &str, kind: &str, joint: &str| {
        format!("[[sensors]]\nname = '{name}'\ntype = '{kind}'\njoint = '{joint}'\n")
    };
    let robot = fingers(
        &[
            one("a", "joint-position", "slide"),
            one("b", "joint-velocity", "slide"),
            one("c", "joint-effort", "slide"),
            one("d", "joint-position", "follow"),
            one("e", "joint-velocity", "follow"),
        ]
        .concat(),
    );
    let mut sensors = sensors(&robot);
    assert_eq!((sensors.width(), sensors.is_empty()), (5, false));
    sensors.sample(
        &Seen {
            qd: &[0.5],
            effort: &[4.0],
            ..still(&robot, &[0.25], &[0.0])
        },
        None,
    );
    // the second finger: -2 * 0.25 + 0.1, and -2 * 0.5
    assert_eq!(sensors.values(), [0.25, 0.5, 4.0, -0.4, -1.0]);
    assert_eq!(sensors.reading(3), [-0.4]);
}

#[test]
fn a_switch_opens_the_motor_to_its_side_and_leaves_the_other() {
    let opened = |table: &str, q: f64, effort: f64| {
        let robot = fingers(table);
        let mut sensors = sensors(&robot);
        sensors.sample(&still(&robot, &[q], &[0.0]), None);
        let mut effort = [effort];
        sensors.open_motors(&mut effort);
        (sensors.reading(0)[0], effort[0])
    };
    let upper = switch("s", "slide", "side = 'upper'\nat = 0.25");
    assert_eq!(opened(&upper, 0.25, 3.0), (1.0, 0.0));
    assert_eq!(opened(&upper, 0.25, -3.0), (1.0, -3.0));
    assert_eq!(opened(&upper, 0.24, 3.0), (0.0, 3.0));
    let lower = switch("s", "slide", "side = 'lower'\nat = 0.25");
    assert_eq!(opened(&lower, 0.2, -3.0), (1.0, 0.0));
    assert_eq!(opened(&lower, 0.2, 3.0), (1.0, 3.0));
    assert_eq!(opened(&lower, 0.3, -3.0), (0.0, -3.0));
    // at the joint's own limit if no position is given
    let at_limit = switch("s", "slide", "side = 'upper'");
    assert_eq!(opened(&at_limit, 0.5, 3.0), (1.0, 0.0));
    assert_eq!(opened(&at_limit, 0.49, 3.0), (0.0, 3.0));
    // one that only reports
    let reports = format!("{upper}opens_motor = false\n");
    assert_eq!(opened(&reports, 0.3, 3.0), (1.0, 3.0));
    // the second finger goes up while the motor goes down
    let geared = switch("s", "follow", "side = 'upper'\nat = 0.0");
    assert_eq!(opened(&geared, -0.1, -3.0), (1.0, 0.0));
    assert_eq!(opened(&geared, -0.1, 3.0), (1.0, 3.0));
}

#[test]
fn the_motor_is_open_while_the_switch_is_pressed_however_late_it_is_reported() {
    let lift = "format = 1\nname = 'lift'\n[[links]]\nname = 'base'\n[[links]]\nname = 'car'\n\
        inertia = { mass_kg = 2.0, tensor_kg_m2 = [1, 1, 1, 0, 0, 0] }\n[[joints]]\nname = 'lift'\ntype = 'prismatic'\n\
        parent = 'base'\nchild = 'car'\naxis = [0, 0, 1]\n[[sensors]]\nname = 'motor'\ntype = 'joint-effort'\njoint = 'lift'\n";
    let top = switch("top", "lift", "side = 'upper'\nat = 0.29\ndelay_s = 0.05");
    let empty = scene(Vec::new());
    let mut rig = Rig::new(robot(&format!("{lift}{top}")), &empty, &[0.25], DT);
    let (mut pressed, mut reported_after) = (0, None);
    // until it falls back on the switch
    for _ in 0..400 {
        let was_pressed = rig.q[0] >= 0.29;
        // 25 N up, more than the weight of 19.62 N
        rig.advance(&[25.0]);
        let expected = if was_pressed { 0.0 } else { 25.0 };
        assert_eq!(rig.reading("motor"), [expected]);
        pressed += usize::from(was_pressed);
        if rig.reading("top") == [1.0] && reported_after.is_none() {
            reported_after = Some(pressed);
        }
        // it flies on without the motor, by v²/2g with v² = 2 a s from 0.04 m of a = 2.69 m/s²
        assert!(rig.q[0] < 0.29 + 0.04 * 2.69 / 9.81 + 1e-3, "{}", rig.q[0]);
    }
    assert!(pressed > 50, "{pressed}");
    // of the 50 steps of delay, those in which it was pressed
    assert!(
        reported_after.is_some_and(|after| after <= 50),
        "{reported_after:?}"
    );
}

#[test]
fn a_copy_goes_on_with_the_same_bits() {
    let table = "[[sensors]]\nname = 'a'\ntype = 'joint-position'\njoint = 'slide'\nnoise = 0.01\nquantisation = 0.001\ndelay_s = 0.013\nrate_hz = 250\n\
        [[sensors]]\nname = 'b'\ntype = 'wrench'\njoint = 'slide'\nnoise = 0.1\ndelay_s = 0.002\n";
    let robot = fingers(table);
    let seen = |tick: u64, q: &[f64; 1], sensors: &mut Sensors| {
        sensors.sample(
            &Seen {
                tick,
                ..still(&robot, q, &[0.0])
            },
            None,
        );
        sensors
            .values()
            .iter()
            .map(|v| v.to_bits())
            .collect::<Vec<_>>()
    };
    let q = |tick: u64| [tick as f64 * 1e-3];
    let (mut first, mut second) = (sensors(&robot), sensors(&robot));
    for tick in 0..150 {
        let one = seen(tick, &q(tick), &mut first);
        assert_eq!(one, seen(tick, &q(tick), &mut second), "{tick}");
    }
}

#[test]
fn the_noise_of_a_sensor_is_its_own() {
    let table = |rate: &str| {
        format!(
            "[[sensors]]\nname = 'a'\ntype = 'joint-position'\njoint = 'slide'\nnoise = 1\n\
             [[sensors]]\nname = 'b'\ntype = 'joint-position'\njoint = 'slide'\nnoise = 1\n{rate}\n"
        )
    };
    let drawn = |rate: &str| {
        let robot = fingers(&table(rate));
        let mut sensors = sensors(&robot);
        (0..40)
            .map(|tick| {
                sensors.sample(
                    &Seen {
                        tick,
                        ..still(&robot, &[0.0], &[0.0])
                    },
                    None,
                );
                (sensors.reading(0)[0], sensors.reading(1)[0])
            })
            .unzip::<f64, f64, Vec<f64>, Vec<f64>>()
    };
    let (a, b) = drawn("");
    let (same, slow) = drawn("rate_hz = 100");
    assert_eq!(a, same);
    // one draw for each value taken
    assert_eq!(slow, (0..40).map(|tick| b[tick / 10]).collect::<Vec<_>>());
    let (_, seeded) = drawn("seed = 3");
    assert_ne!(b, seeded);
}

#[test]
fn times_that_do_not_fit_the_step_are_refused() {
    let robot = fingers(&switch("s", "slide", "side = 'upper'\ndelay_s = 0.0005"));
    let error = |dt_s| Sensors::new(&robot, robot.sensors().to_vec(), dt_s).err();
    assert!(matches!(error(1e-3), Some(SensorError::Delay { .. })));
    assert_eq!(error(5e-4), None);
    // with the file's step of no length nothing fits
    assert!(matches!(error(0.0), Some(SensorError::Delay { .. })));
}
