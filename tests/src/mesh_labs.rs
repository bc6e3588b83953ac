//! A lab whose robot has a mesh: graded, copied with its report, verified, run again from the copy, and distinguished when the mesh changes.

use crate::logged::messages;
use crate::robot_files::CUBE;
use crate::testbed::{TestBed, files_below, root};

const MESH: &str = "labs/robots/meshes/cube.obj";

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write(MESH, CUBE);
    bed.edit(
        "labs/robots/rrbot.toml",
        "shapes = [{ box = { size_m = [\"link_width\", \"link_width\", \"base_height\"] }, origin = { xyz_m = [0.0, 0.0, \"base_height / 2\"] } }]",
        "shapes = [{ mesh = { file = \"meshes/cube.obj\" } }]",
    );
    let submission = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(submission, bed.path("mine.rhai")).expect("copied");
    bed
}

const GRADE: [&str; 4] = ["grade", "01-kinematics", "mine.rhai", "--practice"];

fn robot_digest(bed: &TestBed) -> String {
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(bed.path("out/grade.json")).expect("record");
    let record: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    record["robot"]["digest"]
        .as_str()
        .expect("digest")
        .to_owned()
}

#[test]
fn a_report_takes_the_meshes_along() {
    let bed = bed();
    let before = robot_digest(&bed);
    let files = files_below(&bed.path("out"));
    let copy = files
        .iter()
        .find(|(path, _)| path == "lab/robots/meshes/cube.obj");
    assert_eq!(
        copy.map(|(_, bytes)| bytes.as_slice()),
        Some(CUBE.as_bytes())
    );
    // the log shows its triangles
    let (_, log) = files
        .iter()
        .find(|(path, _)| path == "move/run.mcap")
        .expect("a log");
    let triangles = messages(log).into_iter().any(|(topic, scene)| {
        let entities = scene["entities"].as_array().into_iter().flatten();
        let mut entities = entities.map(|entity| entity["triangles"].as_array());
        topic == "/scene" && entities.any(|triangles| triangles.is_some_and(|t| !t.is_empty()))
    });
    assert!(triangles, "no triangles in the log");
    let verify = || bed.run(&["verify", "out", "--practice"]);
    assert_eq!(verify().code, Some(0), "{:?}", verify());
    // another mesh of the course is another robot
    let lab_file = "lab/robots/meshes/cube.obj";
    bed.edit(MESH, "v 0.1 0 0\n", "v 0.10 0 0\n");
    let ran = verify();
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let why = "the lab is not the course's (robot)\n";
    assert!(ran.stdout.contains(why), "{ran:?}");
    let named = format!("differs: file `{lab_file}`");
    assert!(ran.stdout.contains(&named), "{ran:?}");
    bed.write(MESH, CUBE);
    // a mesh that changed in the copy is found, and changes nothing else
    bed.edit(&format!("out/{lab_file}"), "v 0.1 0 0\n", "v 0.10 0 0\n");
    let ran = verify();
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains(&named), "{ran:?}");
    assert_eq!(ran.stdout.matches("differs: ").count(), 1, "{ran:?}");
    bed.write(&format!("out/{lab_file}"), CUBE);
    // without the labs it came from, those built in are the course's; runs are made again from the copies
    std::fs::remove_dir_all(bed.path("labs")).expect("removed");
    let ran = verify();
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains(why), "{ran:?}");
    assert!(
        ran.stdout.contains("compared with the labs built in\n"),
        "{ran:?}"
    );
    assert_eq!(bed.run(&["compare", "out", "out"]).code, Some(0));
    // and a lab with another mesh has another robot
    bed.copy_labs();
    let plain = robot_digest(&bed);
    assert_ne!(plain, before);
}

#[test]
fn a_mesh_outside_the_labs_is_refused() {
    let bed = bed();
    bed.write("outside.obj", CUBE);
    for path in [
        "../../outside.obj",
        "/outside.obj",
        "meshes/../../../outside.obj",
        "meshes/cub.obj",
    ] {
        let bed_file = "labs/robots/rrbot.toml";
        bed.edit(bed_file, "meshes/cube.obj", path);
        let ran = bed.run(&GRADE);
        assert_eq!(ran.code, Some(3), "{path} {ran:?}");
        assert!(
            ran.stderr.contains("robot::mesh") && ran.stderr.contains("rrbot.toml:"),
            "{ran:?}"
        );
        bed.edit(bed_file, path, "meshes/cube.obj");
    }
}
