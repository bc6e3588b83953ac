//! URDF files: what each kind of joint, link and mesh becomes.

use std::cell::RefCell;

use crate::arms::read_robot;
use kinemark_sim::format::ReadOptions;
use kinemark_sim::format::{RobotError, RobotFile};
use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::model::robot::{JointKind, Robot};
use kinemark_sim::model::unphysical::OnUnphysical;
use kinemark_sim::spatial::{Pose, rotation_about_axis_deg};
use kinemark_sim::text::Source;
use nalgebra::Vector3;

pub(crate) fn read(text: &str) -> Result<Robot, RobotError> {
    let no_mesh = &mut |_: &str| Err("no meshes in this test".to_owned());
    read_robot(
        Source::new("robot.urdf", text),
        &ReadOptions::default(),
        no_mesh,
    )
}

pub(crate) fn good(text: &str) -> Robot {
    read(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Two links; the joint between them starts on line 4, its children on lines 5 to 7, `joint` on line 8.
pub(crate) fn arm(kind: &str, joint: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"base\"/>\n<link name=\"arm\"/>\n<joint name=\"j\" type=\"{kind}\">\n\
         <origin xyz=\"1 2 3\"/>\n<parent link=\"base\"/>\n<child link=\"arm\"/>\n{joint}\n</joint>\n</robot>\n"
    )
}

/// One link; `inside` starts on line 3.
pub(crate) fn link(inside: &str) -> String {
    format!("<robot name=\"r\">\n<link name=\"base\">\n{inside}\n</link>\n</robot>\n")
}

#[test]
fn extensions_and_furniture_pass_in_silence() {
    let text = "<robot name=\"r\" xmlns:drake=\"d\" xmlns:xacro=\"http://ros.org/wiki/xacro\">
        <material name=\"red\"><color rgba=\"1 0 0 1\"/></material>
        <link name=\"a\"><inertial><mass value=\"0\"/></inertial>
          <visual><geometry><sphere radius=\"1\"/></geometry><material name=\"red\"/></visual></link>
        <link name=\"b\"><inertial><mass value=\"1\"/><inertia ixx=\"0\" iyy=\"0\" izz=\"0\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>
        <joint name=\"j\" type=\"continuous\" drake:x=\"1\"><parent link=\"a\"/><child link=\"b\"/>
          <calibration rising=\"0\"/><safety_controller k_velocity=\"1\"/><drake:y/></joint>
        <transmission name=\"t\"/><gazebo reference=\"a\"><plugin path=\"$(find x)\"/></gazebo><ros2_control/>
        </robot>";
    assert_eq!(good(text).warnings(), [""; 0]);
    // a default namespace changes nothing
    let robot = good(&text.replace("xmlns:drake", "xmlns=\"n\" xmlns:drake"));
    assert_eq!((robot.n(), robot.links().len()), (1, 2));
}

#[test]
fn numbers_arrive_where_they_belong() {
    let text = arm(
        "prismatic",
        "<axis xyz=\"0 3 4\"/><limit lower=\"-1\" upper=\"2\" effort=\"30\" velocity=\"4\"/><dynamics damping=\"0.5\" friction=\"0.25\"/>",
    )
    .replace("<origin xyz=\"1 2 3\"/>", "<origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/>");
    let robot = good(&text);
    let joint = &robot.joints()[0];
    assert_eq!(joint.kind, JointKind::Prismatic);
    assert!((joint.axis - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
    assert_eq!(joint.limits.lower, Some(-1.0));
    assert_eq!(joint.limits.upper, Some(2.0));
    assert_eq!(joint.limits.effort, Some(30.0));
    assert_eq!(joint.limits.speed, Some(4.0));
    assert_eq!(
        (joint.damping, joint.dry_friction.negative, joint.armature),
        (0.5, 0.25, 0.0)
    );
    // 5 m along (0, 0.6, 0.8), turned by a quarter about z: y becomes -x
    let tip = at(&robot, &[5.0], "arm").translation.vector;
    assert!(
        (tip - Vector3::new(1.0 - 3.0, 2.0, 3.0 + 4.0)).norm() < 1e-14,
        "{tip}"
    );
    // the default axis is x, and an absent origin the identity
    let robot = good(&arm("revolute", "").replace("<origin xyz=\"1 2 3\"/>", ""));
    assert_eq!(robot.joints()[0].axis, Vector3::x());
    assert_eq!(robot.joints()[0].parent_from_child, Pose::identity());
}

#[test]
fn a_turned_inertial_frame_turns_its_tensor() {
    // half a turn about x - y: x becomes -y, y becomes -x, z becomes -z
    let rpy = format!(
        "0 {0} {1}",
        std::f64::consts::PI,
        std::f64::consts::FRAC_PI_2
    );
    let robot = good(&link(&format!(
        "<inertial><origin xyz=\"0.1 0.2 0.3\" rpy=\"{rpy}\"/><mass value=\"2\"/>\
         <inertia ixx=\"1\" iyy=\"2\" izz=\"2.5\" ixy=\"0.1\" ixz=\"0.2\" iyz=\"0.3\"/></inertial>"
    )));
    let inertia = robot.links()[0].inertia;
    assert_eq!(
        (inertia.mass_kg, inertia.com_m),
        (2.0, Vector3::new(0.1, 0.2, 0.3))
    );
    let got = inertia.about_com_kg_m2;
    let expected = [2.0, 1.0, 2.5, 0.1, 0.3, 0.2];
    for (got, expected) in [got.xx, got.yy, got.zz, got.xy, got.xz, got.yz]
        .iter()
        .zip(expected)
    {
        assert!((got - expected).abs() < 1e-15, "{got} against {expected}");
    }
}

fn at(robot: &Robot, q: &[f64], frame: &str) -> Pose {
    let poses = forward_kinematics(robot, &JointPositions::new(q.iter().copied()));
    poses.world_from(robot.frame(frame).expect(frame))
}

fn names(robot: &Robot) -> (Vec<&str>, Vec<&str>) {
    (
        robot.links().iter().map(|l| l.name.as_str()).collect(),
        robot.joints().iter().map(|j| j.name.as_str()).collect(),
    )
}

#[test]
fn a_floating_base_is_six_joints() {
    let robot = good(&arm("floating", ""));
    let (links, joints) = names(&robot);
    assert_eq!(joints, ["j_x", "j_y", "j_z", "j_yaw", "j_pitch", "j_roll"]);
    assert_eq!(
        links,
        [
            "base",
            "j_x_link",
            "j_y_link",
            "j_z_link",
            "j_yaw_link",
            "j_pitch_link",
            "arm"
        ]
    );
    let (roll, pitch, yaw) = (0.3, -0.4, 2.0);
    let pose = at(&robot, &[0.1, 0.2, 0.3, yaw, pitch, roll], "arm");
    assert!((pose.translation.vector - Vector3::new(1.1, 2.2, 3.3)).norm() < 1e-15);
    let rpy = kinemark_sim::spatial::rotation_from_rpy([roll, pitch, yaw]);
    assert!((pose.rotation.matrix() - rpy).amax() < 1e-15);
}

#[test]
fn a_planar_joint_moves_in_the_plane_normal_to_its_axis() {
    for axis in [Vector3::z(), Vector3::new(0.36, -0.48, 0.8)] {
        let robot = good(&arm(
            "planar",
            &format!("<axis xyz=\"{} {} {}\"/>", axis.x, axis.y, axis.z),
        ));
        let (links, joints) = names(&robot);
        assert_eq!(joints, ["j_x", "j_y", "j_yaw"]);
        assert_eq!(links, ["base", "j_x_link", "j_y_link", "arm"]);
        let pose = at(&robot, &[3.0, 4.0, 0.5], "arm");
        let moved = pose.translation.vector - Vector3::new(1.0, 2.0, 3.0);
        assert!(moved.dot(&axis).abs() < 1e-14, "stays in the plane");
        assert!(
            (moved.norm() - 5.0).abs() < 1e-14,
            "along perpendicular axes"
        );
        let turned = rotation_about_axis_deg(axis, 0.5_f64.to_degrees());
        assert!((pose.rotation.matrix() - turned).amax() < 1e-14);
        if axis == Vector3::z() {
            assert_eq!(moved, Vector3::new(3.0, 4.0, 0.0));
        }
    }
}

/// Two sliders; the second follows the first.
pub(crate) fn gripper() -> String {
    let inertial = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
    let finger = |name: &str, mimic: &str| {
        format!(
            "<link name=\"{name}\">{inertial}</link><joint name=\"j_{name}\" type=\"prismatic\">{mimic}<parent link=\"hand\"/><child link=\"{name}\"/></joint>"
        )
    };
    let mimic = "<mimic joint=\"j_left\" multiplier=\"-2\" offset=\"0.5\"/>";
    format!(
        "<robot name=\"g\">{}{}<link name=\"hand\"/></robot>",
        finger("right", mimic),
        finger("left", "")
    )
}

#[test]
fn a_mimic_joint_follows_or_stands_alone() {
    let robot_of = |ignore_mimic| {
        let source = Source::new("g.urdf", gripper());
        read_robot(
            source,
            &ReadOptions {
                ignore_mimic,
                ..ReadOptions::default()
            },
            &mut |_: &str| Err(String::new()),
        )
        .expect("a gripper")
    };
    let following = robot_of(false);
    let moving: Vec<&str> = following.moving_joints().map(|j| j.name.as_str()).collect();
    assert_eq!(moving, ["j_left"]);
    let right = at(&following, &[0.1], "right").translation.x;
    assert!((right - (-2.0 * 0.1 + 0.5)).abs() < 1e-15, "{right}");
    let alone = robot_of(true);
    let moving: Vec<&str> = alone.moving_joints().map(|j| j.name.as_str()).collect();
    assert_eq!(moving, ["j_right", "j_left"]);
    let right = at(&alone, &[0.3, 0.1], "right").translation.x;
    assert!((right - 0.3).abs() < 1e-15, "{right}");
    // the root comes first, the others keep their order
    assert_eq!(names(&alone).0, ["hand", "right", "left"]);
}

#[test]
fn a_mesh_that_is_there_is_a_shape_at_each_of_its_scales() {
    let mesh = |scale: &str| {
        format!("<visual><geometry><mesh filename=\"t.obj\"{scale}/></geometry></visual>")
    };
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let scales: String = (1..=10)
        .map(|i| mesh(&format!(" scale=\"{i} 1 -1\"")))
        .collect();
    let robot = read_robot(
        Source::new("r.urdf", link(&(mesh("") + &scales))),
        &ReadOptions::default(),
        &mut |_: &str| Ok(tetrahedron.as_bytes().to_vec()),
    )
    .expect("a robot");
    let volumes: Vec<f64> = robot.links()[0]
        .shapes
        .iter()
        .map(|shape| shape.solid.volume_m3().expect("closed"))
        .collect();
    // a sixth of a cube, then one and more of them; copies beyond the eighth are left out
    let expected = [1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0].map(|times| times / 6.0);
    assert_eq!(volumes.len(), expected.len());
    for (got, expected) in volumes.iter().zip(expected) {
        assert!((got - expected).abs() < 1e-12, "{got} against {expected}");
    }
    assert_eq!(
        robot.warnings(),
        ["link `base`: mesh `t.obj` is used at more than 8 scales (line 3)"]
    );
}

#[test]
fn missing_meshes_are_named_and_asked_for_once() {
    let mesh = |file: &str| {
        format!("<collision><geometry><mesh filename=\"{file}\"/></geometry></collision>")
    };
    let all = [
        "package://arm/a.stl",
        "package://arm/a.stl",
        "b.STL",
        "c.dae",
    ];
    let inside: String = all.iter().map(|file| mesh(file)).collect();
    let ball = "<collision><geometry><sphere radius=\"1\"/></geometry></collision>";
    let visual = "<visual><geometry><mesh filename=\"unused.stl\"/></geometry></visual>";
    let asked = RefCell::new(Vec::new());
    let robot = read_robot(
        Source::new("r.urdf", link(&(inside + ball + visual))),
        &ReadOptions::default(),
        &mut |file: &str| {
            asked.borrow_mut().push(file.to_owned());
            match file {
                "b.STL" => Ok(b"no mesh at all".to_vec()),
                _ => Err("package `arm` is not known".to_owned()),
            }
        },
    )
    .expect("a robot");
    assert_eq!(*asked.borrow(), ["package://arm/a.stl", "b.STL"]);
    assert_eq!(robot.links()[0].shapes.len(), 1, "the ball is left");
    let warnings = robot.warnings();
    assert_eq!(warnings.len(), 3, "{warnings:#?}");
    assert_eq!(
        warnings[0],
        "link `base`: mesh `package://arm/a.stl` not found: package `arm` is not known (line 3)"
    );
    assert!(
        warnings[1].starts_with("link `base`: mesh `b.STL` cannot be used: "),
        "{}",
        warnings[1]
    );
    assert_eq!(
        warnings[2],
        "link `base`: mesh `c.dae` is COLLADA, which is not supported: convert it to STL or OBJ (line 3)"
    );
}

/// A base and an arm; `base` and `arm` are the children of `<inertial>` of each, on lines 3 and 6.
fn two_bodies(base: &str, arm: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"base\"><inertial>\n{base}\n</inertial></link>\n<link name=\"arm\"><inertial>\n{arm}\n\
         </inertial></link>\n<joint name=\"j\" type=\"continuous\"><parent link=\"base\"/><child link=\"arm\"/>\
         <axis xyz=\"0 0 1\"/></joint>\n</robot>\n"
    )
}

fn body(mass: f64, diagonal: [f64; 3], off_diagonal: f64) -> String {
    let [x, y, z] = diagonal;
    let o = off_diagonal;
    format!(
        "<mass value=\"{mass:e}\"/><inertia ixx=\"{x:e}\" iyy=\"{y:e}\" izz=\"{z:e}\" ixy=\"{o:e}\" ixz=\"{o:e}\" iyz=\"{o:e}\"/>"
    )
}

fn read_with(text: &str, on_unphysical: OnUnphysical) -> Robot {
    let options = ReadOptions {
        on_unphysical,
        ..ReadOptions::default()
    };
    let no_mesh = &mut |_: &str| Err("no meshes in this test".to_owned());
    read_robot(Source::new("robot.urdf", text), &options, no_mesh).expect("readable")
}

#[test]
fn the_tensor_of_a_root_moves_nothing_and_is_no_reason_to_refuse() {
    // as exporters write it: all six numbers alike, with the principal moments -2e-22, 0 and 3e-6
    let dummy = body(1e-6, [1e-6; 3], 1e-6);
    let text = two_bodies(&dummy, &body(1.0, [0.1; 3], 0.0));
    let robot = good(&text);
    assert_eq!(robot.check_inertias(), Ok(()));
    assert_eq!(robot.warnings(), [""; 0]);
    // what is fixed to the root moves no more than it
    let with_mount = text.replace(
        "</robot>",
        &format!(
            "<link name=\"mount\"><inertial>{dummy}</inertial></link><joint name=\"k\" type=\"fixed\">\
             <parent link=\"base\"/><child link=\"mount\"/></joint></robot>"
        ),
    );
    assert_eq!(good(&with_mount).check_inertias(), Ok(()));
    // on the arm it moves
    let on_arm = with_mount.replace(
        "<parent link=\"base\"/><child link=\"mount\"/>",
        "<parent link=\"arm\"/><child link=\"mount\"/>",
    );
    let robot = good(&on_arm);
    let found = robot.unphysical().expect("a triangle broken").links();
    assert_eq!((found.len(), found[0].name.as_str()), (1, "mount"));
}

#[test]
fn the_rounding_of_a_point_mass_is_none_of_its_inertia() {
    let point = body(1.3, [-2.4e-35, 0.0, 2.4e-35], 0.0);
    assert_eq!(
        good(&two_bodies("<mass value=\"0\"/>", &point)).check_inertias(),
        Ok(())
    );
}

#[test]
fn a_tensor_that_no_body_can_have_leaves_a_robot_for_kinematics() {
    let text = two_bodies(
        &body(-1.0, [0.1; 3], 0.0),
        &body(1.0, [0.001, 0.001, 0.01], 0.0),
    );
    let robot = good(&text);
    let found = robot.check_inertias().expect_err("two links");
    assert_eq!(
        found.to_string(),
        "the robot is for kinematics only: no body can have the mass properties of 2 links
  `base` (line 3): the mass is negative (-1.0 kg)
  `arm` (line 6): principal moments 1.000000e-3, 1.000000e-3, 1.000000e-2 kg m² break the triangle inequality: the largest exceeds the sum of the others
--accept-unphysical takes these tensors as they are, --balance makes all three principal moments of each their mean (in lab.toml, the same words in [robot_options])
a negative mass has to be mended in the file"
    );
    // one warning has all of it
    assert_eq!(robot.warnings().len(), 1);
    assert!(
        robot.warnings()[0].contains("`base` (line 3)")
            && robot.warnings()[0].contains("`arm` (line 6)")
    );
    assert_eq!(robot.check_masses(), Err(found));
    let q = JointPositions::new([0.5]);
    assert!(
        forward_kinematics(&robot, &q)
            .world_from(robot.tcp())
            .rotation
            .angle()
            > 0.4
    );
    // no flag makes a mass of less than nothing
    for on_unphysical in [OnUnphysical::Accept, OnUnphysical::Balance] {
        let robot = read_with(&text, on_unphysical);
        let found = robot.unphysical().expect("the mass").links();
        assert_eq!((found.len(), found[0].name.as_str()), (1, "base"));
    }
}

#[test]
fn a_flag_takes_a_tensor_as_it_is_or_balances_it() {
    let text = two_bodies("<mass value=\"0\"/>", &body(1.0, [0.001, 0.001, 0.01], 0.0));
    let refused = good(&text);
    let found = refused.check_inertias().expect_err("a triangle broken");
    // kinematics and the centre of mass do not need it
    assert_eq!(refused.check_masses(), Ok(()));
    assert!(found.to_string().contains("--accept-unphysical"), "{found}");
    let moments = |robot: &Robot| {
        let tensor = robot.links()[1].inertia.about_com_kg_m2;
        [tensor.xx, tensor.yy, tensor.zz].map(f64::to_bits)
    };
    let accepted = read_with(&text, OnUnphysical::Accept);
    assert_eq!(accepted.check_inertias(), Ok(()));
    assert_eq!(moments(&accepted), [0.001, 0.001, 0.01].map(f64::to_bits));
    let balanced = read_with(&text, OnUnphysical::Balance);
    assert_eq!(balanced.check_inertias(), Ok(()));
    // (0.001 + 0.001 + 0.01) / 3, as MuJoCo's balanceinertia has it
    assert_eq!(moments(&balanced), [0.004; 3].map(f64::to_bits));
    for (robot, word) in [
        (&accepted, "taken as they are"),
        (&balanced, "are balanced"),
    ] {
        let [warning] = robot.warnings() else {
            panic!("{:?}", robot.warnings());
        };
        assert!(
            warning.contains(word) && warning.contains("`arm` (line 6)"),
            "{warning}"
        );
    }
}

#[test]
fn a_robot_is_written_with_the_tensors_that_it_was_read_with() {
    let text = two_bodies(
        &body(1e-6, [1e-6; 3], 1e-6),
        &body(1.0, [0.001, 0.001, 0.01], 0.0),
    );
    for on_unphysical in [
        OnUnphysical::Refuse,
        OnUnphysical::Accept,
        OnUnphysical::Balance,
    ] {
        let robot = read_with(&text, on_unphysical);
        let written = robot.to_toml(&mut str::to_owned);
        let again = RobotFile::parse(Source::new("robot.toml", written.as_str()))
            .and_then(|file| file.build(&[]))
            .unwrap_or_else(|error| panic!("{error}\n{written}"));
        assert_eq!(again.links(), robot.links(), "{written}");
        let is_accepted = written.contains("accept_unphysical = true");
        assert_eq!(
            is_accepted,
            on_unphysical == OnUnphysical::Accept,
            "{written}"
        );
        let names = |robot: &Robot| -> Vec<String> {
            let found = robot.unphysical().map_or(&[][..], |found| found.links());
            found.iter().map(|link| link.name.clone()).collect()
        };
        assert_eq!(names(&again), names(&robot), "{written}");
    }
}

#[test]
fn heavy_meshes_are_a_warning_with_the_heaviest_links() {
    let mesh = |rows: usize| {
        let mut text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned();
        text += &"f 1 2 3\n".repeat(rows);
        text.into_bytes()
    };
    let links: String = [("light", 0), ("heavy", 12_000), ("heavier", 15_000)]
        .iter()
        .map(|(name, rows)| {
            format!("<link name=\"{name}\"><collision><geometry><mesh filename=\"{rows}.obj\"/></geometry></collision></link>")
        })
        .collect();
    let text = format!(
        "<robot name=\"r\"><link name=\"base\"/>{links}<joint name=\"a\" type=\"fixed\"><parent link=\"base\"/><child link=\"light\"/></joint>\
         <joint name=\"b\" type=\"fixed\"><parent link=\"base\"/><child link=\"heavy\"/></joint>\
         <joint name=\"c\" type=\"fixed\"><parent link=\"base\"/><child link=\"heavier\"/></joint></robot>"
    );
    let warnings = |most: usize| {
        let read = &mut |name: &str| {
            let rows: usize = name.trim_end_matches(".obj").parse().expect("a count");
            Ok(mesh(rows.clamp(1, most)))
        };
        let source = Source::new("robot.urdf", text.as_str());
        let robot = read_robot(source, &ReadOptions::default(), read).expect("readable");
        robot.warnings().to_vec()
    };
    assert_eq!(warnings(9_999), [""; 0]);
    let all = warnings(usize::MAX);
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(
        all[0].starts_with("the meshes have 27001 triangles, more than 20000: ")
            && all[0].contains("heaviest links are `heavier` 15000, `heavy` 12000, `light` 1;"),
        "{all:?}"
    );
}
