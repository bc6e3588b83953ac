//! Findings for people: one line each, the worst first as they come, and how many there are.

use std::f64::consts::PI;
use std::fmt::Write as _;

use kinemark_grader::record::quantity::{metres, seconds, trimmed};
use kinemark_sim::engine::{Overlap, Party};
use kinemark_sim::scene_check::{Finding, Kind, LineStopCause, Severity};
use owo_colors::OwoColorize as _;

use super::subject::Subject;

/// Nobody reads more lines than this.
const MOST_LINES: usize = 100;

/// All findings of a subject as text.
pub(super) fn text(subject: &Subject, findings: &[Finding]) -> String {
    let mut out = String::new();
    if let Some(task) = &subject.task {
        let _ = write!(out, "task {}: ", task.bold());
    }
    let _ = write!(out, "scene {}", subject.scene.name.bold());
    if let Some(arm) = &subject.arm {
        let _ = write!(out, " with robot {}", arm.robot.name().bold());
    }
    out += "\n\n";
    for finding in findings.iter().take(MOST_LINES) {
        let word = format!("{:<9}", finding.severity.name());
        let word = match finding.severity {
            Severity::Error => word.red().bold().to_string(),
            Severity::Warning => word.yellow().to_string(),
            Severity::Note => word.cyan().to_string(),
        };
        let place = match line(subject, finding) {
            Some(line) => format!("  ({}:{line})", subject.file.source().name()),
            None => String::new(),
        };
        let _ = writeln!(out, "{word}{}{}", message(subject, finding), place.dimmed());
    }
    if findings.len() > MOST_LINES {
        let more = findings.len() - MOST_LINES;
        let _ = writeln!(out, "and {more} more, which --json lists");
    }
    if !findings.is_empty() {
        out.push('\n');
    }
    let _ = writeln!(out, "{}", counts(findings));
    out
}

fn counts(findings: &[Finding]) -> String {
    let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
    let counts: Vec<String> = [Severity::Error, Severity::Warning, Severity::Note]
        .into_iter()
        .filter(|severity| count(*severity) > 0)
        .map(|severity| plural(count(severity), severity.name()))
        .collect();
    if counts.is_empty() {
        "nothing found".to_owned()
    } else {
        counts.join(", ")
    }
}

fn plural(n: usize, one: &str) -> String {
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}

/// The body of the scene that a finding is about first.
fn body_of(finding: &Finding) -> Option<usize> {
    match &finding.kind {
        Kind::Overlap(overlap) => overlap.parties.iter().rev().find_map(|party| match party {
            Party::Body(index) => Some(*index),
            Party::Ground | Party::Link(_) => None,
        }),
        Kind::FallsThrough { body, .. }
        | Kind::FallsOff { body, .. }
        | Kind::FallsForever { body }
        | Kind::Moves { body, .. }
        | Kind::NeverRests { body, .. } => Some(*body),
        Kind::FliesApart { body, .. } => *body,
        _ => None,
    }
}

/// The line of the scene file where that body is named, from one.
pub(super) fn line(subject: &Subject, finding: &Finding) -> Option<usize> {
    let at = subject.file.place_of_body(body_of(finding)?)?;
    Some(subject.file.source().line_and_column(at.start).0)
}

/// What a finding says, in a sentence without its end.
pub(super) fn message(subject: &Subject, finding: &Finding) -> String {
    let body = |index: usize| format!("`{}`", subject.scene.bodies[index].name);
    match &finding.kind {
        Kind::Overlap(overlap) if overlap.pushes => overlapping(subject, overlap),
        Kind::Overlap(overlap) => {
            let text = overlapping(subject, overlap);
            format!("{text}; neither gives way, so they do not push each other")
        }
        Kind::StartBeyondLimit {
            joint,
            position,
            limit,
        } => {
            let (name, unit) = joint_of(subject, *joint);
            let (at, limit) = (trimmed(*position, 4), trimmed(*limit, 4));
            format!("joint `{name}` starts at {at} {unit}, beyond its limit of {limit} {unit}")
        }
        Kind::FallsThrough {
            body: index,
            through,
            time_s,
        } => {
            let (who, what) = (body(*index), party(subject, *through));
            format!("{who} goes into or through {what} at {}", seconds(*time_s))
        }
        Kind::FallsOff {
            body: index,
            support,
            below_m,
        } => {
            let (who, what) = (body(*index), party(subject, *support));
            format!(
                "{who} falls off {what} by itself, and ends {} below",
                metres(*below_m)
            )
        }
        Kind::FallsForever { body: index } => {
            let help = if subject.scene.environment.ground.is_none() {
                "; the scene has no `ground`"
            } else {
                ""
            };
            format!(
                "{} falls and falls: nothing is beneath it{help}",
                body(*index)
            )
        }
        Kind::FliesApart {
            body: index,
            time_s,
        } => {
            let who = index.map_or_else(|| "something".to_owned(), body);
            format!(
                "{who} flies apart at {}: its motion is no longer finite",
                seconds(*time_s)
            )
        }
        Kind::Moves {
            body: index,
            distance_m,
            tilt_rad,
        } => {
            let (far, tilt_deg) = (metres(*distance_m), tilt_rad * 180.0 / PI);
            let tilt = if tilt_deg >= 0.1 {
                format!(", tilted by {} degrees", trimmed(tilt_deg, 1))
            } else {
                String::new()
            };
            format!(
                "{} does not stay where it is put: it ends {far} away{tilt}",
                body(*index)
            )
        }
        Kind::NeverRests {
            body: index,
            speed_m_s,
            turning_rad_s,
        } => format!(
            "{} still moves after 10 s, at {} m/s and {} rad/s",
            body(*index),
            trimmed(*speed_m_s, 4),
            trimmed(*turning_rad_s, 4)
        ),
        _ => about_places(subject, finding),
    }
}

/// Findings about via points and the lines between them.
fn about_places(subject: &Subject, finding: &Finding) -> String {
    let place = |point: usize| {
        let Some(arm) = &subject.arm else {
            return String::new();
        };
        let (what, at) = (arm.place_name, triple(arm.via[point]));
        format!("{what} {} {at}", point + 1)
    };
    let line = |from: usize| {
        let what = subject.arm.as_ref().map_or("place", |arm| arm.place_name);
        format!("straight line from {what} {} to {}", from + 1, from + 2)
    };
    let names = |bodies: &[usize]| {
        let names = bodies
            .iter()
            .map(|&i| format!("`{}`", subject.scene.bodies[i].name));
        names.collect::<Vec<String>>().join(", ")
    };
    match &finding.kind {
        Kind::ViaUnreachable { point, residual_m } => {
            format!(
                "{} is out of reach by {}",
                place(*point),
                metres(*residual_m)
            )
        }
        Kind::ViaCollides {
            point,
            branches,
            colliding,
            overlap,
        } => {
            let what = overlapping(subject, overlap);
            format!(
                "{}: {what}, {}",
                place(*point),
                of_ways(*colliding, *branches)
            )
        }
        Kind::ViaTouches {
            point,
            branches,
            touching,
            bodies,
        } => {
            let ways = of_ways(*touching, *branches);
            format!(
                "{}: the robot touches {}, {ways}",
                place(*point),
                names(bodies)
            )
        }
        Kind::LineBlocked {
            from,
            branches,
            blocked,
            stop,
        } => {
            let at = subject
                .arm
                .as_ref()
                .map(|arm| triple(arm.seen(&stop.p_in_world)));
            let why = match stop.cause {
                LineStopCause::OutOfReach { residual_m } => {
                    format!("out of reach by {}", metres(residual_m))
                }
                LineStopCause::Jumps { joint, by } => {
                    let (name, unit) = joint_of(subject, joint);
                    let by = trimmed(by, 2);
                    format!("joint `{name}` would have to jump by {by} {unit}, into another branch")
                }
                LineStopCause::Collides(overlap) => overlapping(subject, &overlap),
            };
            format!(
                "{} is blocked after {}, at {}: {why}, {}",
                line(*from),
                metres(stop.along_m),
                at.unwrap_or_default(),
                of_ways(*blocked, *branches)
            )
        }
        Kind::LineTouches {
            from,
            branches,
            touching,
            bodies,
        } => {
            let ways = of_ways(*touching, *branches);
            format!(
                "{}: the robot touches {}, {ways}",
                line(*from),
                names(bodies)
            )
        }
        _ => finding.kind.name().to_owned(),
    }
}

fn of_ways(some: usize, all: usize) -> String {
    match (some, all) {
        (1, 1) => "in the only branch".to_owned(),
        (2, 2) => "in both branches".to_owned(),
        (some, all) if some == all => format!("in all {all} branches"),
        (some, all) => format!("in {some} of {all} branches"),
    }
}

fn overlapping(subject: &Subject, overlap: &Overlap) -> String {
    let [first, second] = overlap.parties.map(|one| party(subject, one));
    format!(
        "{first} and {second} overlap by {}",
        metres(overlap.depth_m)
    )
}

fn party(subject: &Subject, one: Party) -> String {
    match one {
        Party::Link(index) => {
            let name = subject
                .arm
                .as_ref()
                .map(|arm| &arm.robot.links()[index].name);
            format!("link `{}`", name.map_or("?", |name| name))
        }
        Party::Body(index) => format!("`{}`", subject.scene.bodies[index].name),
        Party::Ground => "the ground".to_owned(),
    }
}

/// The name and the unit of the joint that has this entry of `q`.
fn joint_of(subject: &Subject, entry: usize) -> (&str, &'static str) {
    let arm = subject.arm.as_ref();
    let joint = arm.and_then(|arm| arm.robot.moving_joints().nth(entry));
    joint.map_or(("?", ""), |joint| {
        let unit = if joint.kind.turns() { "rad" } else { "m" };
        (joint.name.as_str(), unit)
    })
}

fn triple(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(|x| trimmed(x, 4));
    format!("({x}, {y}, {z})")
}
