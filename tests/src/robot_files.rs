//! `kinemark robot show` and `convert`: robots of every kind, shown as written here, converted without a change to what they do; and
//! what is refused.

use serde_json::{Value, json};

use crate::eval::{close, eval_with};
use crate::eval_golden::model;
use crate::golden::reads;
use crate::testbed::TestBed;

const ROW: [&str; 5] = ["RzRyRz", "--base", "2", "--links", "0,0,4; 3,0,0; 1,0,0"];

fn run(bed: &TestBed, command: &str, robot: &[&str]) -> crate::testbed::CommandResult {
    bed.run(&[&["robot", command], robot].concat())
}

/// What a command prints for a good robot.
fn printed(command: &str, robot: &[&str]) -> String {
    let ran = run(&TestBed::new(), command, robot);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{ran:?}");
    ran.stdout
}

#[test]
fn robots_are_shown_like_this() {
    for (name, robot) in [
        ("rrbot", &["rrbot"][..]),
        ("uarm", &["uarm"]),
        ("row", &ROW),
        ("panda", &[&model("panda.urdf")]),
        ("humanoid", &[&model("humanoid25.urdf")]),
    ] {
        let shown = printed("show", robot);
        reads(&format!("show_{name}"), &shown);
        let widest = shown.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{name}: {widest:?}");
    }
}

#[test]
fn robots_are_converted_like_this() {
    for (name, robot) in [
        ("rrbot", &["rrbot"][..]),
        ("uarm", &["uarm"]),
        ("row", &ROW),
    ] {
        reads(&format!("convert_{name}"), &printed("convert", robot));
    }
}

#[test]
fn machines_read_all_of_it() {
    let shown: Value = serde_json::from_str(&printed("show", &["uarm", "--json"])).expect("JSON");
    assert_eq!(shown["independent"], json!(["turn", "crank", "lower_arm"]));
    assert_eq!(shown["dependent"], json!(["rod", "forearm"]));
    assert_eq!(shown["loops"][0]["links"], json!(["rod", "forearm"]));
    assert_eq!(shown["joints"][5]["mimic"]["joint"], "crank");
    assert_eq!(shown["tcp"], "tcp");
    let shown: Value = serde_json::from_str(&printed("show", &["rrbot", "--json"])).expect("JSON");
    // 1 kg at 1 m, 0.5 kg at 2.5 m and 3.5 m; each link a step of 25 mm aside
    close(
        &shown["com_at_home_m"],
        &json!([0.0, 0.01875, 2.0]),
        1e-15,
        "com",
    );
    assert_eq!(shown["warnings"], json!([]));
}

#[test]
fn a_converted_robot_answers_as_the_original_does() {
    let models = ["panda.urdf", "humanoid25.urdf", "randtree.urdf", "ur5.urdf"].map(model);
    let mut robots: Vec<Vec<&str>> =
        vec![vec!["rrbot"], vec!["uarm"], vec!["rppr"], vec!["puma560"]];
    robots.extend(models.iter().map(|model| vec![model.as_str()]));
    robots.push(ROW.to_vec());
    for robot in robots {
        let bed = TestBed::new();
        let ran = run(
            &bed,
            "convert",
            &[&robot[..], &["--out", "new.toml"]].concat(),
        );
        assert_eq!(
            (ran.code, ran.stdout.as_str()),
            (Some(0), ""),
            "{robot:?} {ran:?}"
        );
        let info = |robot: &[&str]| {
            let (answers, _) = eval_with(&bed, robot, &[json!({ "op": "info" }).to_string()]);
            answers[0].clone()
        };
        let (old, new) = (info(&robot), info(&["new.toml"]));
        // sums of masses and numbers written shortest: nothing changes
        for key in [
            "name",
            "joints",
            "frames",
            "mass_kg",
            "independent",
            "mimics",
            "loops",
        ] {
            assert_eq!(old[key], new[key], "{robot:?} {key}");
        }
        let k = old["independent"].as_array().expect("independent").len();
        let wave = |scale: f64, step: f64| -> Vec<f64> {
            (0..k)
                .map(|i| scale * ((i as f64) * step % 1.0 - 0.4))
                .collect()
        };
        let (q, qd, qdd) = (wave(0.5, 0.37), wave(1.0, 0.61), wave(2.0, 0.23));
        let frames = old["frames"].as_array().expect("frames");
        let mut requests: Vec<String> = frames
            .iter()
            .map(|frame| json!({ "op": "fk", "q": q, "frame": frame }).to_string())
            .collect();
        requests
            .push(json!({ "op": "inverse_dynamics", "q": q, "qd": qd, "qdd": qdd }).to_string());
        let (old, code) = eval_with(&bed, &robot, &requests);
        assert_eq!(code, Some(0), "{robot:?} {old:?}");
        let (new, _) = eval_with(&bed, &["new.toml"], &requests);
        for (old, new) in old.iter().zip(&new) {
            // roundings of rotations in the file, through up to a dozen joints
            for key in ["position_m", "rotation", "effort"] {
                if !old[key].is_null() {
                    close(&new[key], &old[key], 1e-12, &format!("{robot:?} {key}"));
                }
            }
        }
    }
}

#[test]
fn nothing_is_overwritten_unasked() {
    let bed = TestBed::new();
    bed.write("mine.toml", "precious");
    let ran = bed.run(&["robot", "convert", "rrbot", "--out", "mine.toml"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("--force"), "{ran:?}");
    assert_eq!(
        std::fs::read_to_string(bed.path("mine.toml")).expect("file"),
        "precious"
    );
    let ran = bed.run(&["robot", "convert", "rrbot", "--out", "mine.toml", "--force"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // not even with --force is a robot lost under what is made of it
    let before = std::fs::read_to_string(bed.path("mine.toml")).expect("there");
    let ran = bed.run(&[
        "robot",
        "convert",
        "mine.toml",
        "--out",
        "./mine.toml",
        "--force",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("is the robot's own file"), "{ran:?}");
    assert_eq!(
        std::fs::read_to_string(bed.path("mine.toml")).expect("there"),
        before
    );
    assert_eq!(bed.run(&["robot", "show", "mine.toml"]).code, Some(0));
    // nor a file whose name says another format than it would have
    let ran = bed.run(&["robot", "convert", "rrbot", "--out", "new.urdf"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("robots cannot be written as a URDF"),
        "{ran:?}"
    );
    assert!(!bed.path("new.urdf").exists());
    // a broken robot leaves no file
    bed.write("broken.urdf", "<robot");
    assert_eq!(
        bed.run(&["robot", "convert", "broken.urdf", "--out", "new.toml"])
            .code,
        Some(3)
    );
    assert!(!bed.path("new.toml").exists());
}

/// Arguments after `robot show`, the exit code, and what the message must say.
#[test]
fn what_cannot_be_shown_says_why() {
    let bed = TestBed::new();
    bed.write(
        "arm.toml",
        "format = 1\nname = \"arm\"\n[[links]]\nname = \"base\"\n",
    );
    bed.write(
        "arm.urdf",
        "<robot name=\"arm\"><link name=\"base\"/></robot>",
    );
    bed.write("arm.urdf.xacro", "<robot/>");
    bed.write(
        "two-roots.urdf",
        "<robot name=\"arm\">\n  <link name=\"base\"/>\n  <link name=\"tip\"/>\n</robot>\n",
    );
    let links = "0,0,1; 0,0,1; 0,0,1";
    let cases: [(&[&str], i32, &str); 20] = [
        (&["RzRyRz"], 2, "--links \"0,0,1; 0,0,1; 0,0,1\""),
        // the letter comes first: links of a wrong count would not help
        (&["RzRxq"], 2, "[joint string:1:5]"),
        (
            &["RzRyRz", "--base", "1"],
            2,
            "--links \"0,0,1; 0,0,1; 0,0,1\"",
        ),
        (&["RzRyRw", "--links", links], 2, "`w` is no axis"),
        (&["RzRyRz", "--links", "0,0,1"], 2, "1 link for 3 joints"),
        (
            &["RzRyRz", "--links", links, "--ignore-mimic"],
            2,
            "--ignore-mimic is for URDFs",
        ),
        (&["arm.toml", "--links", links], 2, "`arm.toml` is a file"),
        (
            &["arm.urdf", "--base", "1"],
            2,
            "--base is for joint strings",
        ),
        (&["arm.toml", "--ignore-mimic"], 2, "remove `mimic`"),
        (
            &["arm.toml", "--balance"],
            2,
            "write `balance = true` in the link's `inertia`",
        ),
        (
            &["rrbot", "--accept-unphysical"],
            2,
            "write `accept_unphysical = true` in the link's `inertia`",
        ),
        (
            &["arm.urdf", "--accept-unphysical", "--balance"],
            2,
            "cannot be used with",
        ),
        (
            &["arm.toml", "--package", "a=."],
            2,
            "--package is for URDFs",
        ),
        (
            &["rrbot", "--base", "2"],
            2,
            "`rrbot` is a robot of the labs",
        ),
        (
            &["arm.urdf", "--package", "a=nowhere"],
            2,
            "`nowhere` of package `a` does not exist",
        ),
        (&["arm.urdf", "--package", "a"], 2, "NAME=DIR"),
        (&["arm.urdf.xacro"], 2, "xacro arm.urdf.xacro > arm.urdf"),
        (&["rrbto"], 2, "did you mean `rrbot`?"),
        (&["amr.urdf"], 2, "did you mean `./arm.urdf`?"),
        (&["two-roots.urdf"], 3, "two-roots.urdf:3:"),
    ];
    for (args, code, words) in cases {
        for command in ["show", "convert", "eval"] {
            let ran = run(&bed, command, args);
            assert_eq!(ran.code, Some(code), "{command} {args:?} {ran:?}");
            // long lines are wrapped
            let said = ran
                .stderr
                .split_whitespace()
                .collect::<Vec<&str>>()
                .join(" ");
            assert!(said.contains(words), "{command} {args:?} {ran:?}");
        }
    }
    // the same file, said well
    assert_eq!(
        run(&bed, "show", &["arm.urdf", "--package", "a=."]).code,
        Some(0)
    );
}

/// Each mistake with its line, and a word of the message.
#[test]
fn a_broken_urdf_is_shown_at_its_line() {
    let joint = |inside: &str| {
        format!(
            "<robot name=\"arm\">\n<link name=\"base\"/>\n<link name=\"tip\"/>\n\
             <joint name=\"turn\" type=\"revolute\">\n<parent link=\"base\"/>\n<child link=\"tip\"/>\n{inside}\n</joint>\n</robot>\n"
        )
    };
    let link = |inside: &str| {
        joint("").replace(
            "<link name=\"tip\"/>",
            &format!("<link name=\"tip\">{inside}</link>"),
        )
    };
    let tensor = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"9\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
    let cases = [
        (joint("<axis xyz=\"0 0 0\"/>"), 7, "axis"),
        (
            joint("").replace("child link=\"tip\"", "child link=\"tpi\""),
            6,
            "did you mean `tip`?",
        ),
        (joint("<origin xyz=\"0 0\"/>"), 7, "xyz"),
        (joint("").replace("revolute", "revolut"), 4, "revolute"),
        (joint("</axis>"), 7, ""),
    ];
    let bed = TestBed::new();
    for (text, line, words) in cases {
        bed.write("broken.urdf", &text);
        let ran = bed.run(&["robot", "show", "broken.urdf"]);
        assert_eq!(ran.code, Some(3), "{text}{ran:?}");
        assert!(
            ran.stderr.contains(&format!("broken.urdf:{line}:")),
            "{text}{ran:?}"
        );
        assert!(ran.stderr.contains(words), "{text}{ran:?}");
    }
    // a tensor that no body can have keeps a robot from moving, not from being read
    bed.write("broken.urdf", link(tensor));
    let ran = bed.run(&["robot", "show", "broken.urdf"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for words in ["`tip` (line 3)", "triangle", "--balance"] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }
}

/// A cube of 0.1 m as OBJ, eight corners and six faces.
pub(crate) const CUBE: &str = "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nv 0 0 0.1\nv 0.1 0 0.1\nv 0.1 0.1 0.1\nv 0 0.1 0.1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn urdf_with_mesh(filename: &str) -> String {
    format!(
        "<robot name=\"arm\"><link name=\"base\"><visual><geometry><mesh filename=\"{filename}\" scale=\"1 1 2\"/></geometry></visual></link></robot>"
    )
}

#[test]
fn a_missing_mesh_is_named() {
    let bed = TestBed::new();
    for (filename, words) in [
        (
            "package://arm_description/meshes/hand.stl",
            "--package arm_description=DIR",
        ),
        ("meshes/hand.stl", "meshes/hand.stl"),
        ("hand.dae", "hand.dae"),
    ] {
        bed.write("arm.urdf", urdf_with_mesh(filename));
        let ran = bed.run(&["robot", "show", "arm.urdf"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(
            ran.stdout.contains("warning") && ran.stdout.contains(words),
            "{ran:?}"
        );
        assert!(ran.stdout.contains("base"), "{ran:?}");
        let ran = bed.run(&["robot", "convert", "arm.urdf"]);
        assert!(
            ran.stderr.starts_with("warning: ") && ran.stderr.contains(words),
            "{ran:?}"
        );
        assert!(!ran.stdout.contains("warning"), "{ran:?}");
    }
}

#[test]
fn meshes_are_found_and_named_from_the_new_file() {
    let bed = TestBed::new();
    bed.write("ros/arm_description/meshes/cube.obj", CUBE);
    bed.write(
        "ros/arm_description/urdf/arm.urdf",
        urdf_with_mesh("package://arm_description/meshes/cube.obj"),
    );
    bed.write(
        "arm.urdf",
        urdf_with_mesh("package://arm_description/meshes/cube.obj"),
    );
    bed.write("out/keep", "");
    let inside = "ros/arm_description/urdf/arm.urdf";
    let option = "arm_description=ros/arm_description";
    for robot in [&[inside][..], &["arm.urdf", "--package", option]] {
        let ran = run(
            &bed,
            "convert",
            &[robot, &["--out", "out/arm.toml", "--force"]].concat(),
        );
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{ran:?}");
        let text = std::fs::read_to_string(bed.path("out/arm.toml")).expect("written");
        let path = "file = \"../ros/arm_description/meshes/cube.obj\", scale = [1.0, 1.0, 2.0]";
        assert!(text.contains(path), "{text}");
        // and from there it is found again
        let ran = bed.run(&["robot", "show", "out/arm.toml"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let ran = bed.run(&["robot", "convert", inside]);
    assert!(
        ran.stdout
            .contains("file = \"ros/arm_description/meshes/cube.obj\""),
        "{ran:?}"
    );
    // a robot file needs its mesh: with the place in the file
    bed.edit("out/arm.toml", "cube.obj", "cub.obj");
    let ran = bed.run(&["robot", "show", "out/arm.toml"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(
        ran.stderr.contains("robot::mesh") && ran.stderr.contains("cub.obj"),
        "{ran:?}"
    );
}
