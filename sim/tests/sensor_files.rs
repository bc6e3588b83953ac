//! The tables of sensors: what they may say, mistakes at their positions, and that they survive being written.

use kinemark_sim::format::RobotFile;
use kinemark_sim::text::{Problem as _, Source};

use crate::arms::{lab_robot, robot, rrbot};
use crate::sensor_rig::{equipped, text};
use crate::sensors::FINGERS;

#[test]
fn each_mistake_is_named_at_its_place() {
    let lines = FINGERS.lines().count();
    let sensor =
        |kind: &str, rest: &str| format!("[[sensors]]\nname = 's'\ntype = '{kind}'\n{rest}\n");
    let position = sensor("joint-position", "joint = 'slide'");
    // line 1 is that of [[sensors]]
    for (table, code, line, message) in [
        (
            sensor("joint-positon", "joint = 'slide'"),
            "robot::toml",
            3,
            "unknown value `joint-positon`",
        ),
        (
            sensor("joint-position", ""),
            "robot::sensor",
            3,
            "sensor `s` has no `joint`",
        ),
        (
            sensor("joint-position", "joint = 'slid'"),
            "robot::unknown_joint",
            4,
            "no joint is called `slid`",
        ),
        (
            sensor("joint-effort", "joint = 'follow'"),
            "robot::sensor",
            4,
            "joint `follow` mimics `slide` and has no motor of its own",
        ),
        (
            sensor("joint-position", "joint = 'slide'\nrange_m = 2"),
            "robot::sensor",
            5,
            "a sensor of type `joint-position` has no `range_m`",
        ),
        (
            sensor("limit-switch", "joint = 'slide'"),
            "robot::sensor",
            3,
            "sensor `s` has no `side`",
        ),
        (
            sensor(
                "limit-switch",
                "joint = 'slide'\nside = 'upper'\nnoise = 0.1",
            ),
            "robot::sensor",
            6,
            "a sensor of type `limit-switch` has no `noise`",
        ),
        (
            sensor("limit-switch", "joint = 'follow'\nside = 'upper'"),
            "robot::sensor",
            4,
            "joint `follow` has no upper limit to put a switch at",
        ),
        (
            sensor("range-finder", "frame = 'lft'\nrange_m = 2"),
            "robot::unknown_frame",
            4,
            "no frame is called `lft`",
        ),
        (
            sensor("range-finder", "frame = 'left'"),
            "robot::sensor",
            3,
            "sensor `s` has no `range_m`",
        ),
        (
            sensor("range-finder", "frame = 'left'\nrange_m = 0"),
            "robot::out_of_range",
            5,
            "range_m must be positive, got 0",
        ),
        (
            sensor("range-finder", "frame = 'left'\nrange_m = 1e7"),
            "robot::out_of_range",
            5,
            "range_m must be at most 1e6, got 10000000.0",
        ),
        (
            sensor(
                "range-finder",
                "frame = 'left'\nrange_m = 2\naxis = [0, 0, 0]",
            ),
            "robot::axis",
            6,
            "axis of a range finder is zero",
        ),
        (
            sensor("contact", "link = 'middle'"),
            "robot::unknown_link",
            4,
            "no link is called `middle`",
        ),
        (
            format!("{position}noise = -0.1\n"),
            "robot::out_of_range",
            5,
            "noise must be zero or more, got -0.1",
        ),
        (
            format!("{position}noise = 'grain'\n"),
            "robot::expression",
            5,
            "no dimension `grain` in this robot",
        ),
        (
            format!("{position}rate_hz = 0\n"),
            "robot::out_of_range",
            5,
            "rate_hz must be positive, got 0",
        ),
        (format!("{position}seed = -1\n"), "robot::toml", 5, ""),
        (
            format!("{position}{position}"),
            "robot::duplicate",
            6,
            "sensor `s` is defined twice",
        ),
        (
            position.replace("'s'", "' '"),
            "robot::bad_name",
            2,
            "sensor name \" \" cannot be used",
        ),
    ] {
        let source = Source::new("robot.toml", format!("{FINGERS}{table}"));
        let error = RobotFile::parse(source).and_then(|file| file.build(&[]));
        let error = error.expect_err(&table);
        assert_eq!(error.problem.code(), code, "{error}\n{table}");
        assert_eq!(error.line_and_column().0, lines + line, "{error}\n{table}");
        if !message.is_empty() && code != "robot::expression" {
            assert_eq!(error.to_string(), message);
        }
        assert!(
            error.problem.help().is_some()
                || code == "robot::out_of_range"
                || code == "robot::toml"
        );
    }
    // more than can be
    let many: String = (0..201)
        .map(|i| position.replace("'s'", &format!("'s{i}'")))
        .collect();
    let source = Source::new("robot.toml", format!("{FINGERS}{many}"));
    let error = RobotFile::parse(source).and_then(|file| file.build(&[]));
    assert_eq!(
        error.expect_err("too many").problem.code(),
        "robot::too_large"
    );
}

#[test]
fn a_wrench_inside_a_loop_is_refused_because_the_loop_shares_it() {
    let uarm = lab_robot("uarm");
    let mut refused = 0;
    for joint in uarm.joints() {
        let table = format!(
            "[[sensors]]\nname = 'w'\ntype = 'wrench'\njoint = '{}'\n",
            joint.name
        );
        let source = Source::new("robot.toml", text("uarm") + "\n" + &table);
        if let Err(error) = RobotFile::parse(source).and_then(|file| file.build(&[])) {
            assert_eq!(error.problem.code(), "robot::sensor", "{error}");
            assert!(
                error
                    .to_string()
                    .contains("shares its wrench with the loop")
            );
            refused += 1;
        }
    }
    // the base's turn carries all loops whole
    assert!(0 < refused && refused < uarm.joints().len(), "{refused}");
}

#[test]
fn sensors_survive_being_written_and_read_again() {
    let tables = "\n[[sensors]]\nname = 'p'\ntype = 'joint-position'\njoint = 'elbow'\nnoise = 0.001\nquantisation = 0.0015\ndelay_s = 0.004\nrate_hz = 100\nseed = 7\n\
        [[sensors]]\nname = 'v'\ntype = 'joint-velocity'\njoint = 'elbow'\n\
        [[sensors]]\nname = 'e'\ntype = 'joint-effort'\njoint = 'elbow'\n\
        [[sensors]]\nname = 'l'\ntype = 'limit-switch'\njoint = 'shoulder'\nside = 'lower'\nopens_motor = false\n\
        [[sensors]]\nname = 'r'\ntype = 'range-finder'\nframe = 'tcp'\naxis = [1, 1, 0]\nrange_m = 'base_height'\n\
        [[sensors]]\nname = 'c \"quoted\"'\ntype = 'contact'\nlink = 'forearm'\n\
        [[sensors]]\nname = 'w'\ntype = 'wrench'\njoint = 'elbow'\n";
    let first = equipped("rrbot", tables);
    assert_eq!(first.sensors().len(), 7);
    let again = robot(&first.to_toml(&mut str::to_owned));
    assert_eq!(first.sensors(), again.sensors());
    assert!(rrbot().sensors().is_empty());
}

#[test]
fn the_rppr_has_a_switch_at_either_end_of_each_axis_and_an_encoder() {
    let rppr = lab_robot("rppr");
    let names: Vec<&str> = rppr.sensors().iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names.len(), 12);
    assert_eq!(names[..3], ["turn_lower", "turn_upper", "lift_lower"]);
    assert_eq!(names[8], "turn_encoder");
    // with the gripper that moves, the ten switches and four encoders of its document
    let with_gripper = lab_robot("rppr_gripper");
    assert_eq!(with_gripper.sensors().len(), 14);
}
