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
fn a_robot_that_cannot_move_says_so_alone_and_in_a_scene() {
    let bare = robot_of(
        "format = 1\nname = 'bare'\n[dh]\nconvention = 'modified'\n[[dh.rows]]\njoint = 'a'\ntype = 'revolute'\n",
    );
    let text = robot_text(&bare).to_string();
    let says = "warning   cannot move: joint a moves no inertia, so there is no simulation\n";
    assert!(text.contains(says), "{text}");
    assert_eq!(robot_record(&bare)["immovable_joint"], "a");
    assert!(robot_record(&rrbot())["immovable_joint"].is_null());
    let file = SceneFile::parse(Source::new("none.toml", "format = 1\nname = \"none\"\n"))
        .unwrap_or_else(|error| panic!("{error}"));
    let scene = file.build(&[]).unwrap_or_else(|error| panic!("{error}"));
    let to_check = SceneToCheck {
        task: None,
        file,
        scene,
        arm: ArmInScene::new(bare, vec![0.0], "base"),
    };
    let checked = to_check
        .check(&mut |_| {})
        .unwrap_or_else(|error| panic!("{error}"));
    let text = scene_text(&checked).to_string();
    assert!(
        text.contains("robot `bare` cannot move: joint `a` moves no inertia"),
        "{text}"
    );
    assert_eq!(scene_record(&checked)["findings"][0]["joint"], "a");
    assert!(!checked.has_errors());
}

#[test]
fn a_drive_is_shown_with_what_the_joint_feels() {
    let lift = robot_of(
        "format = 1\nname = 'lift'\n[dh]\nconvention = 'modified'\n[[dh.rows]]\njoint = 'up'\ntype = 'prismatic'\n\
         dry_friction = { positive = 3, negative = 2 }\n\
         drive = { stall = 200, free_speed = 0.025, ratio = 1000, rotor_inertia = 2e-5, efficiency = 0.9 }\n",
    );
    let text = robot_text(&lift).to_string();
    let unwrapped = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let says = "drive up: stall 200 N, free speed 0.025 m/s, ratio 1000 rad/m, rotor 2e-5 kg m², felt as 20 kg, efficiency 0.9";
    assert!(unwrapped.contains(says), "{text}");
    let record = robot_record(&lift);
    assert_eq!(record["joints"][0]["dry_friction"]["negative"], 2.0);
    assert_eq!(record["joints"][0]["drive"]["stall"], 200.0);
    let write = |robot: &Robot, mesh: &mut NameMesh<'_>| robot.to_toml(mesh);
    let converted = converted(&lift, write, |_| None);
    assert_eq!(robot_record(&robot_of(&converted.text)), record);
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
