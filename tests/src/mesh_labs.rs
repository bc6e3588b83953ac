//! A lab whose robot has a mesh: graded, copied with its report, verified from the copy, and distinguished when the mesh changes.

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
    let triangles = mcap::MessageStream::new(log).expect("MCAP").any(|message| {
        let message = message.expect("message");
        let text = String::from_utf8_lossy(&message.data);
        message
            .channel
            .schema
            .as_ref()
            .is_some_and(|s| s.name == "foxglove.SceneUpdate")
            && text.contains("\"triangles\":[{")
    });
    assert!(triangles, "no triangles in the log");
    // without the labs it came from
    std::fs::remove_dir_all(bed.path("labs")).expect("removed");
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // a mesh that changed in the copy is found
    bed.edit(
        "out/lab/robots/meshes/cube.obj",
        "v 0.1 0 0\n",
        "v 0.10 0 0\n",
    );
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("robot"), "{ran:?}");
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
