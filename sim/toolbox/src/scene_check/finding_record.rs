//! Findings as JSON: the numbers behind each sentence, in SI units.

use kinemark_sim::engine::Overlap;
use kinemark_sim::model::contact::Party;
use kinemark_sim::scene_check::{Finding, Kind, LineStopCause, Unchecked};
use serde_json::{Map, Value, json};

use super::checked_scene::{CheckedScene, SceneToCheck};
use super::finding_message::message;

/// All findings about a scene as JSON.
pub fn scene_record(checked: &CheckedScene<'_>) -> Value {
    let (scene, findings) = (checked.scene, &checked.findings);
    let mut record = Map::new();
    if let Some(task) = &scene.task {
        record.insert("task".to_owned(), json!(task));
    }
    record.insert("scene".to_owned(), json!(scene.scene.name));
    if let Some(arm) = &scene.arm {
        record.insert("robot".to_owned(), json!(arm.robot.name()));
        record.insert("frame".to_owned(), json!(arm.frame));
    }
    let findings = findings.iter().map(|finding| of_finding(scene, finding));
    record.insert("findings".to_owned(), findings.collect());
    Value::Object(record)
}

fn of_finding(scene: &SceneToCheck, finding: &Finding) -> Value {
    let mut record = Map::new();
    let mut put = |key: &str, value: Value| {
        record.insert(key.to_owned(), value);
    };
    put("severity", json!(finding.severity.name()));
    put("kind", json!(finding.kind.name()));
    put("message", json!(message(scene, finding)));
    if let Some(line) = scene.line_of(finding) {
        put("line", json!(line));
    }
    let numbers = numbers(scene, &finding.kind);
    if let Value::Object(numbers) = numbers {
        record.extend(numbers);
    }
    Value::Object(record)
}

fn numbers(scene: &SceneToCheck, kind: &Kind) -> Value {
    let body = |index: &usize| scene.body_name(*index);
    match kind {
        Kind::Overlap(overlap) => of_overlap(scene, overlap),
        Kind::StartBeyondLimit {
            joint,
            position,
            limit,
        } => json!({ "joint": joint_name(scene, *joint), "position": position, "limit": limit }),
        Kind::CannotMove { joint } => json!({ "joint": joint }),
        Kind::FallsThrough {
            body: index,
            through,
            time_s,
        } => json!({ "body": body(index), "through": party(scene, *through), "time_s": time_s }),
        Kind::FallsOff {
            body: index,
            support,
            below_m,
        } => {
            json!({ "body": body(index), "support": party(scene, *support), "below_m": below_m })
        }
        Kind::FallsForever { body: index } => json!({ "body": body(index) }),
        Kind::FliesApart {
            body: index,
            time_s,
        } => json!({ "body": index.as_ref().map(body), "time_s": time_s }),
        Kind::Moves {
            body: index,
            distance_m,
            tilt_rad,
        } => json!({ "body": body(index), "distance_m": distance_m, "tilt_rad": tilt_rad }),
        Kind::NeverRests {
            body: index,
            speed_m_s,
            turning_rad_s,
        } => json!({ "body": body(index), "speed_m_s": speed_m_s, "turning_rad_s": turning_rad_s }),
        Kind::ViaUnreachable { .. }
        | Kind::ViaCollides { .. }
        | Kind::ViaTouches { .. }
        | Kind::LineBlocked { .. }
        | Kind::LineTouches { .. } => numbers_of_motion(scene, kind),
        Kind::NotChecked(what) => match what {
            Unchecked::Overlaps => json!({ "stage": "overlaps" }),
            Unchecked::Stay => json!({ "stage": "settling" }),
            Unchecked::StayFrom(from_s) => json!({ "stage": "settling", "from_s": from_s }),
            Unchecked::ViaFrom(point) => json!({ "stage": "via", "point": point + 1 }),
            Unchecked::LinesFrom(from) => {
                json!({ "stage": "via", "points": [from + 1, from + 2] })
            }
        },
    }
}

/// The numbers of a finding about via points and the lines between them.
fn numbers_of_motion(scene: &SceneToCheck, kind: &Kind) -> Value {
    let body = |index: &usize| scene.body_name(*index);
    let bodies = |indices: &[usize]| indices.iter().map(body).collect::<Vec<&str>>();
    match kind {
        Kind::ViaUnreachable { point, residual_m } => {
            json!({ "point": point + 1, "residual_m": residual_m })
        }
        Kind::ViaCollides {
            point,
            branches,
            colliding,
            overlap,
        } => {
            let ways = json!({ "point": point + 1, "branches": branches, "colliding": colliding });
            joined(ways, of_overlap(scene, overlap))
        }
        Kind::ViaTouches {
            point,
            branches,
            touching,
            bodies: touched,
        } => {
            json!({ "point": point + 1, "branches": branches, "touching": touching, "bodies": bodies(touched) })
        }
        Kind::LineBlocked {
            from,
            branches,
            blocked,
            stop,
        } => {
            let position = scene.arm.as_ref().map(|arm| arm.in_frame(&stop.p_in_world));
            let line = json!({
                "points": [from + 1, from + 2],
                "branches": branches,
                "blocked": blocked,
                "along_m": stop.along_m,
                "position_m": position,
            });
            let cause = match stop.cause {
                LineStopCause::OutOfReach { residual_m } => {
                    json!({ "cause": "out-of-reach", "residual_m": residual_m })
                }
                LineStopCause::Jumps { joint, by } => {
                    json!({ "cause": "jumps", "joint": joint_name(scene, joint), "by": by })
                }
                LineStopCause::Collides(overlap) => {
                    joined(json!({ "cause": "collides" }), of_overlap(scene, &overlap))
                }
            };
            joined(line, cause)
        }
        Kind::LineTouches {
            from,
            branches,
            touching,
            bodies: touched,
        } => json!({
            "points": [from + 1, from + 2],
            "branches": branches,
            "touching": touching,
            "bodies": bodies(touched),
        }),
        _ => json!({}),
    }
}

fn of_overlap(scene: &SceneToCheck, overlap: &Overlap) -> Value {
    json!({
        "parties": overlap.parties.map(|one| party(scene, one)),
        "depth_m": overlap.depth_m,
        "p_in_world_m": overlap.p_in_world.as_slice(),
    })
}

fn joined(mut first: Value, second: Value) -> Value {
    if let (Value::Object(first), Value::Object(second)) = (&mut first, second) {
        first.extend(second);
    }
    first
}

fn party(scene: &SceneToCheck, one: Party) -> &str {
    match one {
        Party::Link(index) => scene.link_name(index),
        Party::Body(index) => scene.body_name(index),
        Party::Ground => "ground",
    }
}

fn joint_name(scene: &SceneToCheck, entry: usize) -> &str {
    scene.joint(entry).map_or("?", |joint| joint.name.as_str())
}
