//! A robot as JSON.

use kinemark_sim::dynamics::immovable_joint;
use kinemark_sim::model::drive::Drive;
use kinemark_sim::model::joint_friction::JointFriction;
use kinemark_sim::model::robot::{Joint, JointKind, Link, Robot};
use serde_json::{Value, json};

use super::robot_text::com_at_home_m;
use crate::joint_names::joint_names;

/// All of a robot as JSON.
pub fn robot_record(robot: &Robot) -> Value {
    let links = robot.links().iter().map(link_record);
    let joints = robot
        .joints()
        .iter()
        .map(|joint| joint_record(robot, joint));
    let loops = robot.loops().iter().map(|closing| {
        let links = closing.links.map(|i| robot.links()[i].name.as_str());
        json!({ "type": closing.kind.name(), "links": links })
    });
    let frames = robot.frames()[robot.links().len()..].iter();
    let frames =
        frames.map(|frame| json!({ "name": frame.name, "link": robot.links()[frame.link].name }));
    let sensors = robot.sensors().iter();
    let sensors = sensors.map(|sensor| json!({ "name": sensor.name, "type": sensor.type_name }));
    let moving = robot.moving_joints().map(|joint| joint.name.as_str());
    json!({
        "name": robot.name(),
        "links": links.collect::<Vec<Value>>(),
        "joints": joints.collect::<Vec<Value>>(),
        "frames": frames.collect::<Vec<Value>>(),
        "tcp": robot.tcp().name,
        "loops": loops.collect::<Vec<Value>>(),
        "q": moving.collect::<Vec<&str>>(),
        "independent": joint_names(robot, robot.independent()),
        "dependent": joint_names(robot, robot.dependent()),
        "sensors": sensors.collect::<Vec<Value>>(),
        "home": robot.home(),
        "mass_kg": robot.mass_kg(),
        "com_at_home_m": com_at_home_m(robot),
        "unphysical": unphysical_links(robot),
        "immovable_joint": immovable_joint(robot).map(|singular| singular.joint),
        "warnings": robot.warnings(),
    })
}

/// The links for which dynamics refuses the robot.
fn unphysical_links(robot: &Robot) -> Vec<Value> {
    let links = robot.unphysical().map_or(&[][..], |found| found.links());
    let links = links
        .iter()
        .map(|link| json!({ "link": link.name, "line": link.line, "why": link.why.to_string() }));
    links.collect()
}

fn link_record(link: &Link) -> Value {
    let inertia = &link.inertia;
    let t = &inertia.about_com_kg_m2;
    json!({
        "name": link.name,
        "mass_kg": inertia.mass_kg,
        "com_m": inertia.com_m.as_slice(),
        "tensor_kg_m2": [t.xx, t.yy, t.zz, t.xy, t.xz, t.yz],
        "shapes": link.shapes.len(),
    })
}

fn joint_record(robot: &Robot, joint: &Joint) -> Value {
    let entry = robot
        .moving_joints()
        .position(|moving| moving.name == joint.name);
    let mimic = joint.mimic.as_ref().map(|mimic| {
        json!({
            "joint": robot.joints()[mimic.joint].name,
            "multiplier": mimic.multiplier,
            "offset": mimic.offset,
        })
    });
    let fixed = joint.kind == JointKind::Fixed;
    json!({
        "name": joint.name,
        "type": joint.kind.name(),
        "parent": robot.links()[joint.parent].name,
        "child": robot.links()[joint.child].name,
        "q_index": entry,
        "axis": (!fixed).then(|| joint.axis.as_slice()),
        "lower": joint.limits.lower,
        "upper": joint.limits.upper,
        "speed": joint.limits.speed,
        "effort": joint.limits.effort,
        "damping": joint.damping,
        "dry_friction": friction_record(&joint.dry_friction),
        "armature": joint.armature,
        "drive": joint.drive.as_ref().map(drive_record),
        "passive": joint.passive,
        "mimic": mimic,
    })
}

/// A number where both directions have the same friction, as in a robot file.
fn friction_record(friction: &JointFriction) -> Value {
    match friction.is_symmetric() {
        true => json!(friction.positive),
        false => json!({ "positive": friction.positive, "negative": friction.negative }),
    }
}

fn drive_record(drive: &Drive) -> Value {
    json!({
        "stall": drive.line.map(|line| line.stall),
        "free_speed": drive.line.map(|line| line.free_speed),
        "ratio": drive.ratio,
        "rotor_inertia": drive.rotor_inertia_kg_m2,
        "efficiency": drive.efficiency,
        "felt_inertia": drive.felt_inertia(),
    })
}
