//! Robot files: what they may say, and that both ways of saying a thing agree.

use kinemark_sim::format::RobotFile;
use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::text::{Problem as _, Source};

use crate::arms::{robot, rrbot};

#[test]
fn the_course_arm_is_what_its_table_says() {
    let robot = rrbot();
    let names: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    assert_eq!(names, ["shoulder", "elbow"]);
    assert!((robot.mass_kg() - 2.0).abs() < 1e-15);
    let frames: Vec<&str> = robot
        .frames()
        .iter()
        .map(|frame| frame.name.as_str())
        .collect();
    assert_eq!(frames, ["base", "upper", "forearm", "tcp", "lab"]);
    // straight up, and exactly so
    let poses = forward_kinematics(&robot, &JointPositions::zeros(2));
    let tcp = poses.world_from(robot.tcp()).translation.vector;
    assert_eq!((tcp.x, tcp.y, tcp.z), (0.0, 0.05, 4.0));
}

#[test]
fn three_ways_to_say_a_rotation_agree() {
    let frame = |origin: &str| {
        let text = format!(
            "format = 1\nname = \"r\"\n[[links]]\nname = \"a\"\n[[frames]]\nname = \"f\"\nlink = \"a\"\norigin = {origin}\n"
        );
        let robot = robot(&text);
        let poses = forward_kinematics(&robot, &JointPositions::zeros(0));
        poses.world_from(robot.frame("f").expect("f"))
    };
    let rpy = frame("{ rpy_deg = [0, 0, 30] }");
    let axis = frame("{ axis = [0, 0, 2], angle_deg = 30 }");
    let (c, s) = (0.75_f64.sqrt(), 0.5);
    let axes = frame(&format!(
        "{{ x_axis = [{c}, {s}, 0], y_axis = [{}, {c}, 0] }}",
        -s
    ));
    for other in [axis, axes] {
        let error = (rpy.rotation.matrix() - other.rotation.matrix()).amax();
        assert!(error < 1e-15, "{error:.1e}");
    }
}

#[test]
fn a_rotation_that_is_half_there_or_there_twice_says_which() {
    let ways = "say a rotation in one way: `rpy_deg`, or `axis` with `angle_deg`, or `x_axis` with `y_axis`";
    for (origin, message, help) in [
        (
            "{ x_axis = [1, 0, 0] }",
            "`x_axis` without `y_axis`: a rotation needs both",
            ways,
        ),
        (
            "{ angle_deg = 3 }",
            "`angle_deg` without `axis`: a rotation needs both",
            ways,
        ),
        (
            "{ rpy_deg = [0, 0, 0], axis = [1, 0, 0] }",
            "two rotations: keep `rpy_deg`, or `axis` with `angle_deg`",
            ways,
        ),
        (
            "{ x_axis = [1, 0, 0], y_axis = [1, 1, 0] }",
            "`y_axis` is not perpendicular to `x_axis`",
            "choose y_axis so that its dot product with x_axis is 0",
        ),
    ] {
        let text = format!(
            "format = 1\nname = \"r\"\n[[links]]\nname = \"a\"\n[[frames]]\nname = \"f\"\nlink = \"a\"\norigin = {origin}\n"
        );
        let file = RobotFile::parse(Source::new("robot.toml", text));
        let error = file
            .and_then(|file| file.build(&[]).map(drop))
            .expect_err(origin);
        assert_eq!(error.to_string(), message, "{origin}");
        assert_eq!(error.problem.help().as_deref(), Some(help), "{origin}");
    }
}

/// A base and an arm with this inertia, on line 6.
fn with_inertia(inertia: &str) -> String {
    format!(
        "format = 1\nname = \"r\"\n[[links]]\nname = \"base\"\n[[links]]\ninertia = {inertia}\nname = \"arm\"\n[[joints]]\nname = \"j\"\n\
         type = \"continuous\"\nparent = \"base\"\nchild = \"arm\"\naxis = [0, 0, 1]\n"
    )
}

#[test]
fn a_tensor_that_no_body_can_have_is_for_kinematics_or_treated_as_the_file_says() {
    let tensor = "mass_kg = 1, tensor_kg_m2 = [0.001, 0.001, 0.01, 0, 0, 0]";
    let refused = robot(&with_inertia(&format!("{{ {tensor} }}")));
    let found = refused.check_inertias().expect_err("a triangle broken");
    let text = found.to_string();
    for part in [
        "`arm` (line 6)",
        "`accept_unphysical = true`",
        "`balance = true`",
    ] {
        assert!(text.contains(part), "{text}");
    }
    assert_eq!(refused.warnings().len(), 1);
    for (key, zz) in [("accept_unphysical", 0.01), ("balance", 0.004)] {
        let treated = robot(&with_inertia(&format!("{{ {tensor}, {key} = true }}")));
        assert_eq!(treated.check_inertias(), Ok(()));
        let found: f64 = treated.links()[1].inertia.about_com_kg_m2.zz;
        assert_eq!(found.to_bits(), f64::to_bits(zz), "{key}: {found}");
        // the file says so itself
        assert_eq!(treated.warnings(), [""; 0], "{key}");
    }
    let both = format!("{{ {tensor}, accept_unphysical = true, balance = true }}");
    let file = RobotFile::parse(Source::new("robot.toml", with_inertia(&both))).expect("tables");
    let error = file.build(&[]).expect_err("both");
    assert_eq!(error.problem.code(), "robot::inertia");
    // a mass below zero is no rounding of published numbers
    let negative = format!("{{ {}, balance = true }}", tensor.replace("= 1,", "= -1,"));
    let negative = robot(&with_inertia(&negative));
    assert!(negative.check_masses().is_err());
}

#[test]
fn all_mistakes_of_links_and_joints_are_reported_at_once() {
    let text = with_inertia("{ mass_kg = 1 }").replace("[0, 0, 1]", "[0, 0, 0]");
    let file = RobotFile::parse(Source::new("robot.toml", text)).expect("tables");
    let error = file.build(&[]).expect_err("two mistakes");
    let lines: Vec<usize> = std::iter::once(&error)
        .chain(error.others())
        .map(|one| one.line_and_column().0)
        .collect();
    assert_eq!(lines, [6, 13]);
}
