//! A lab whose robot is a URDF in a package of ROS: graded, packed and verified with its meshes, and refused where it cannot be right.

use crate::robot_files::CUBE;
use crate::testbed::{TestBed, files_below};

const ROBOT: &str = "labs/robots/arm_description/urdf/arm.urdf";
const MESH: &str = "labs/robots/arm_description/meshes/cube.obj";

/// A hinge at 1 m with a link of 1 m in x, whose tensor breaks the triangle inequality by far, and a follower.
const URDF: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial><origin xyz="0.5 0 0"/><mass value="1"/><inertia ixx="0.001" iyy="0.001" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><mesh filename="package://arm_description/meshes/cube.obj"/></geometry></collision>
  </link>
  <link name="tcp"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/><dynamics damping="0.1"/>
  </joint>
  <joint name="tip" type="fixed"><parent link="upper"/><child link="tcp"/><origin xyz="1 0 0"/><mimic joint="turn"/></joint>
</robot>
"#;

const LAB: &str = r#"format = 1
name = "10-urdf"
title = "A URDF"
robot = "arm_description/urdf/arm.urdf"

[robot_options]
balance = true

[[tasks]]
name = "fk"
title = "Forward kinematics"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "bent", q_rad = [0.7] }]
[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 2.0
fk-error = { full_m = 1e-9, zero_m = 5e-3 }

[[tasks]]
name = "turn"
title = "Turn"
[tasks.motion]
mode = "position"
duration_s = 3.0
target = [0.5]
grants = ["gravity", "mass_matrix"]
servo = { kp = 100.0, kd = 20.0, derivative = "velocity" }
[[tasks.checks]]
name = "arrives"
title = "It stops at 0.5 rad"
points = 2.0
joint-reached = { joint = "turn", position_rad = 0.5, hold_s = 0.5, full_rad = 0.01, zero_rad = 0.1 }
"#;

/// The mass matrix is that of the balanced tensor: (0.001 + 0.001 + 0.1) / 3 about the centre of mass, and 1 kg at 0.5 m.
const SUBMISSION: &str = "fn forward_kinematics(robot, q) { [cos(q[0]), sin(q[0]), 1.0] }\n\
    fn init(robot, task) { this.robot = robot; }\n\
    fn control(observation) {\n    let off = this.robot.mass_matrix(observation.q)[0][0] - 0.284;\n\
    if off > 1e-12 || off < -1e-12 { throw \"another mass matrix\" }\n    observation.target\n}\n";

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write(ROBOT, URDF);
    bed.write(MESH, CUBE);
    bed.write("labs/10-urdf/lab.toml", LAB);
    bed.write("mine.rhai", SUBMISSION);
    bed
}

const GRADE: [&str; 5] = ["grade", "10-urdf", "mine.rhai", "--practice", "--json"];

#[test]
fn a_lab_with_a_urdf_is_graded_and_takes_its_meshes_along() {
    let bed = bed();
    for more in [&[][..], &["--in-process"]] {
        let ran = bed.run(&[&GRADE, more].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let names: Vec<String> = files_below(&bed.path("out"))
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    for file in [
        "lab/robots/arm_description/urdf/arm.urdf",
        "lab/robots/arm_description/meshes/cube.obj",
    ] {
        assert!(names.iter().any(|name| name == file), "{names:?}");
    }
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // another mesh is another robot
    bed.edit(MESH, "v 0.1 0 0\n", "v 0.10 0 0\n");
    let ran = bed.run(&["verify", "out", "--practice"]);
    let why = "the lab is not the course's (robot)\n";
    assert!(ran.stdout.contains(why), "{ran:?}");
    // what students get has them, too
    bed.write("labs/10-urdf/starter.rhai", SUBMISSION);
    bed.write("labs/10-urdf/brief.md", "# A URDF\n");
    let ran = bed.run(&["lab", "pack", "10-urdf", "--for", "students"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let file = std::fs::File::open(bed.path("10-urdf-students.zip")).expect("an archive");
    let archive = zip::ZipArchive::new(file).expect("a ZIP");
    let packed: Vec<String> = archive
        .file_names()
        .map(|name| name.expect("a name").into_owned())
        .collect();
    for file in [ROBOT, MESH] {
        assert!(packed.iter().any(|name| name.ends_with(file)), "{packed:?}");
    }
}

#[test]
fn what_cannot_be_right_with_a_urdf_in_a_lab_is_refused_with_what_to_do() {
    let lab = "labs/10-urdf/lab.toml";
    for (file, from, to, code, words) in [
        (
            lab,
            "[robot_options]\nbalance = true\n",
            "",
            "lab::unphysical",
            "the same words in [robot_options]",
        ),
        (
            lab,
            "balance = true",
            "balance = true\naccept_unphysical = true",
            "lab::robot_options",
            "exclude each other",
        ),
        (
            lab,
            "balance = true",
            "blance = true",
            "lab::toml",
            "did you mean `balance`?",
        ),
        (
            lab,
            "balance = true",
            "balance = true\npackages = { arm_description = \"vendor\" }",
            "lab::robot_mesh",
            "`robots/vendor/meshes/cube.obj`",
        ),
        (
            lab,
            "arm_description/urdf/arm.urdf",
            "rrbot",
            "lab::robot_options",
            "is for URDFs",
        ),
        (
            lab,
            "arm_description/urdf/arm.urdf",
            "arm_description/urdf/amr.urdf",
            "lab::unknown_robot",
            "robots/arm_description/urdf/amr.urdf",
        ),
        (
            lab,
            "arm_description/urdf/arm.urdf",
            "../arm.urdf",
            "lab::unknown_robot",
            "robots/../arm.urdf",
        ),
        (
            lab,
            "[[tasks]]\nname = \"fk\"",
            "[dimensions]\nl = 2.0\n\n[[tasks]]\nname = \"fk\"",
            "lab::dimensions",
            "no dimension `l`",
        ),
        (
            ROBOT,
            "package://arm_description/meshes/cube.obj",
            "package://arm_description/../../../outside.obj",
            "lab::robot_mesh",
            "does not lead out of it",
        ),
        (
            ROBOT,
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 0\"/>",
            "robot::axis",
            "arm.urdf:9:",
        ),
    ] {
        let bed = bed();
        bed.edit(file, from, to);
        let ran = bed.run(&GRADE);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        let said = ran
            .stderr
            .split_whitespace()
            .collect::<Vec<&str>>()
            .join(" ");
        assert!(
            said.contains(code) && said.contains(words),
            "{to}: {}",
            ran.stderr
        );
    }
}
