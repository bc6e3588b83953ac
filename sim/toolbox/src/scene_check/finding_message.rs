//! What a finding says, in a sentence without its end.

use std::f64::consts::PI;

use kinemark_sim::engine::Overlap;
use kinemark_sim::model::contact::Party;
use kinemark_sim::scene_check::{Finding, Kind, LineStop, LineStopCause, Unchecked};
use kinemark_sim::text::number::{metres, seconds, trimmed};

use super::checked_scene::SceneToCheck;

/// What a finding says.
pub(super) fn message(scene: &SceneToCheck, finding: &Finding) -> String {
    let body = |index: usize| format!("`{}`", scene.body_name(index));
    match &finding.kind {
        Kind::Overlap(overlap) => {
            let what = overlapping(scene, overlap);
            if overlap.pushes {
                what
            } else {
                format!("{what}; neither gives way, so they do not push each other")
            }
        }
        Kind::StartBeyondLimit {
            joint,
            position,
            limit,
        } => {
            let (name, unit) = joint_of(scene, *joint);
            let (at, limit) = (trimmed(*position, 4), trimmed(*limit, 4));
            format!("joint `{name}` starts at {at} {unit}, beyond its limit of {limit} {unit}")
        }
        Kind::CannotMove { joint } => cannot_move(scene, joint),
        Kind::FallsThrough {
            body: index,
            through,
            time_s,
        } => {
            let (who, what) = (body(*index), party(scene, *through));
            format!("{who} goes into or through {what} at {}", seconds(*time_s))
        }
        Kind::FallsOff {
            body: index,
            support,
            below_m,
        } => {
            let (who, what, far) = (body(*index), party(scene, *support), metres(*below_m));
            format!("{who} falls off {what} by itself, and ends {far} below")
        }
        Kind::FallsForever { body: index } => falls_forever(scene, &body(*index)),
        Kind::FliesApart {
            body: index,
            time_s,
        } => {
            let who = index.map_or_else(|| "something".to_owned(), body);
            let at = seconds(*time_s);
            format!("{who} flies apart at {at}: its motion is no longer finite")
        }
        Kind::Moves {
            body: index,
            distance_m,
            tilt_rad,
        } => moves(&body(*index), *distance_m, *tilt_rad),
        Kind::NeverRests {
            body: index,
            speed_m_s,
            turning_rad_s,
        } => {
            let (who, speed) = (body(*index), trimmed(*speed_m_s, 4));
            let turning = trimmed(*turning_rad_s, 4);
            format!("{who} still moves after 10 s, at {speed} m/s and {turning} rad/s")
        }
        Kind::ViaUnreachable { .. } | Kind::ViaCollides { .. } | Kind::ViaTouches { .. } => {
            about_via_point(scene, &finding.kind)
        }
        Kind::LineBlocked { .. } | Kind::LineTouches { .. } => about_line(scene, &finding.kind),
        Kind::NotChecked(what) => not_checked(scene, *what),
    }
}

/// Why no simulation of the robot can start, and what helps.
fn cannot_move(scene: &SceneToCheck, joint: &str) -> String {
    let robot = scene.arm.as_ref().map_or("?", |arm| arm.robot.name());
    format!(
        "robot `{robot}` cannot move: joint `{joint}` moves no inertia; give the link that it moves an `inertia`, or the joint an \
         `armature`"
    )
}

/// What was left out, why, and what helps.
fn not_checked(scene: &SceneToCheck, what: Unchecked) -> String {
    let via = scene.arm.as_ref().map_or("position", |arm| arm.via_name);
    let what = match what {
        Unchecked::Stay => {
            return "not checked: whether bodies stay where they are put; too many of them overlap"
                .to_owned();
        }
        Unchecked::Overlaps => "some overlaps at the start".to_owned(),
        Unchecked::StayFrom(from_s) => {
            let from = seconds(from_s);
            format!("whether bodies stay where they are put, from {from} of 10 s on")
        }
        Unchecked::ViaFrom(point) => {
            format!("{via} {} and what comes after it", point + 1)
        }
        Unchecked::LinesFrom(from) => {
            let (from, to) = (from + 1, from + 2);
            format!("the straight line from {via} {from} to {to} and what comes after it")
        }
    };
    format!("not checked: {what}; that is too much work with so many shapes, so use fewer")
}

fn falls_forever(scene: &SceneToCheck, who: &str) -> String {
    let help = match scene.scene.environment.ground {
        None => "; the scene has no `ground`",
        Some(_) => "",
    };
    format!("{who} falls and falls: nothing is beneath it{help}")
}

fn moves(who: &str, distance_m: f64, tilt_rad: f64) -> String {
    let (far, tilt_deg) = (metres(distance_m), tilt_rad * 180.0 / PI);
    let tilt = if tilt_deg >= 0.1 {
        format!(", tilted by {} degrees", trimmed(tilt_deg, 1))
    } else {
        String::new()
    };
    format!("{who} does not stay where it is put: it ends {far} away{tilt}")
}

/// A finding with the TCP at a via point.
fn about_via_point(scene: &SceneToCheck, kind: &Kind) -> String {
    let position = |point: usize| {
        scene.arm.as_ref().map_or_else(String::new, |arm| {
            let at = triple(arm.via[point]);
            format!("{} {} {at}", arm.via_name, point + 1)
        })
    };
    match kind {
        Kind::ViaUnreachable { point, residual_m } => {
            let (where_to, far) = (position(*point), metres(*residual_m));
            format!("{where_to} is out of reach by {far}")
        }
        Kind::ViaCollides {
            point,
            branches,
            colliding,
            overlap,
        } => {
            let what = overlapping(scene, overlap);
            let ways = in_branches(*colliding, *branches);
            format!("{}: {what}, {ways}", position(*point))
        }
        Kind::ViaTouches {
            point,
            branches,
            touching,
            bodies,
        } => {
            let ways = in_branches(*touching, *branches);
            let bodies = body_names(scene, bodies);
            format!("{}: the robot touches {bodies}, {ways}", position(*point))
        }
        other => other.name().to_owned(),
    }
}

/// A finding about the straight line from one via point to the next.
fn about_line(scene: &SceneToCheck, kind: &Kind) -> String {
    let line = |from: usize| {
        let what = scene.arm.as_ref().map_or("position", |arm| arm.via_name);
        format!("straight line from {what} {} to {}", from + 1, from + 2)
    };
    match kind {
        Kind::LineBlocked {
            from,
            branches,
            blocked,
            stop,
        } => {
            let arm = scene.arm.as_ref();
            let at = arm.map(|arm| triple(arm.in_frame(&stop.p_in_world)));
            format!(
                "{} is blocked after {}, at {}: {}, {}",
                line(*from),
                metres(stop.along_m),
                at.unwrap_or_default(),
                stop_cause(scene, stop),
                in_branches(*blocked, *branches)
            )
        }
        Kind::LineTouches {
            from,
            branches,
            touching,
            bodies,
        } => {
            let ways = in_branches(*touching, *branches);
            let bodies = body_names(scene, bodies);
            format!("{}: the robot touches {bodies}, {ways}", line(*from))
        }
        other => other.name().to_owned(),
    }
}

fn stop_cause(scene: &SceneToCheck, stop: &LineStop) -> String {
    match stop.cause {
        LineStopCause::OutOfReach { residual_m } => {
            format!("out of reach by {}", metres(residual_m))
        }
        LineStopCause::Jumps { joint, by } => {
            let (name, unit) = joint_of(scene, joint);
            let by = trimmed(by, 2);
            format!("joint `{name}` would have to jump by {by} {unit}, into another branch")
        }
        LineStopCause::Collides(overlap) => overlapping(scene, &overlap),
    }
}

fn in_branches(some: usize, all: usize) -> String {
    match (some, all) {
        (1, 1) => "in the only branch".to_owned(),
        (2, 2) => "in both branches".to_owned(),
        (some, all) if some == all => format!("in all {all} branches"),
        (some, all) => format!("in {some} of {all} branches"),
    }
}

fn overlapping(scene: &SceneToCheck, overlap: &Overlap) -> String {
    let [first, second] = overlap.parties.map(|one| party(scene, one));
    let depth = metres(overlap.depth_m);
    format!("{first} and {second} overlap by {depth}")
}

fn party(scene: &SceneToCheck, one: Party) -> String {
    match one {
        Party::Link(index) => format!("link `{}`", scene.link_name(index)),
        Party::Body(index) => format!("`{}`", scene.body_name(index)),
        Party::Ground => "the ground".to_owned(),
    }
}

fn body_names(scene: &SceneToCheck, bodies: &[usize]) -> String {
    let names = bodies.iter().map(|&i| format!("`{}`", scene.body_name(i)));
    names.collect::<Vec<String>>().join(", ")
}

/// The name and the unit of the joint that has this entry of `q`.
fn joint_of(scene: &SceneToCheck, entry: usize) -> (&str, &'static str) {
    scene.joint(entry).map_or(("?", ""), |joint| {
        let unit = if joint.kind.turns() { "rad" } else { "m" };
        (joint.name.as_str(), unit)
    })
}

fn triple(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(|x| trimmed(x, 4));
    format!("({x}, {y}, {z})")
}
