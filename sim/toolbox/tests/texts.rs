//! Robots and scenes as text and as JSON.

use kinemark_sim::format::{NameMesh, SceneFile};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Source;
use kinemark_toolbox::robot_convert::converted;
use kinemark_toolbox::robot_show::{robot_record, robot_text};
use kinemark_toolbox::scene_check::{ArmInScene, SceneToCheck, scene_record, scene_text};
use kinemark_toolbox::styled_text::Emphasis;

use crate::{close, robot_of, rrbot, uarm};

#[test]
fn a_robot_is_a_table_and_facts() {
    let text = robot_text(&uarm());
    let plain = text.to_string();
    assert!(plain.starts_with("uarm\n\nlink"), "{plain}");
    assert!(plain.contains("\nhome      q = 0, 0, 0, 0, 0\n"), "{plain}");
    let strong: Vec<&str> = text
        .parts()
        .filter(|(emphasis, _)| *emphasis == Emphasis::Strong)
        .map(|(_, part)| part)
        .collect();
    assert_eq!(strong, ["uarm"]);
    let record = robot_record(&rrbot());
    // 1 kg in the middle, 0.5 kg at 0.025 m and at 0.05 m beside it
    close(&record["com_at_home_m"], &[0.0, 0.018_75, 2.0], 1e-15);
}

#[test]
fn a_robot_file_reads_back_as_the_same_robot() {
    let write = |robot: &Robot, mesh: &mut NameMesh<'_>| robot.to_toml(mesh);
    let converted = converted(&uarm(), write, |_| None);
    assert_eq!(converted.warnings, Vec::<String>::new());
    assert_eq!(
        robot_record(&robot_of(&converted.text)),
        robot_record(&uarm())
    );
}

/// A box that begins in the ground.
const SUNK: &str = r#"
format = 1
name = "sunk"
[environment]
ground = { friction = 0.5 }
[[bodies]]
name = "crate"
type = "free"
shapes = [{ box = { size_m = [0.2, 0.2, 0.2] } }]
inertia = { mass_kg = 1.0 }
origin = { xyz_m = [3.0, 0.0, 0.05] }
contact = { friction = 0.5 }
"#;

#[test]
fn a_scene_reports_what_overlaps_and_where_it_stands() {
    let file =
        SceneFile::parse(Source::new("sunk.toml", SUNK)).unwrap_or_else(|error| panic!("{error}"));
    let scene = file.build(&[]).unwrap_or_else(|error| panic!("{error}"));
    let arm = ArmInScene::new(rrbot(), vec![0.0, 0.0], "lab");
    assert!(ArmInScene::new(rrbot(), vec![0.0, 0.0], "hand").is_none());
    let scene = SceneToCheck {
        task: None,
        file,
        scene,
        arm,
    };
    let checked = scene
        .check(&mut |_| {})
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.has_errors());
    let text = scene_text(&checked).to_string();
    assert!(text.starts_with("scene sunk with robot rrbot\n\nerror    `crate` and the ground overlap by 50.0 mm  (sunk.toml:7)\n"), "{text}");
    let record = scene_record(&checked);
    assert_eq!(record["findings"][0]["kind"], "overlap");
    assert_eq!(record["findings"][0]["line"], 7);
}
