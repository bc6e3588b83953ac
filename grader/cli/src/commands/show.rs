//! `kinemark robot show`: a robot for people, as a tree with totals, and for machines, as JSON.

mod table;
mod tree;

use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_sim::kinematics::centre_of_mass::{Counted, centre_of_mass};
use kinemark_sim::robot::{JointKind, Robot};
use owo_colors::OwoColorize as _;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::output;
use crate::robot_source::{self, RobotArgs};
use table::{number, triple};

/// Show a robot: its links and joints as a tree, totals, loops, frames and warnings
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark robot show rrbot\n  kinemark robot show panda.urdf --package franka_description=../franka\n  \
    kinemark robot show RzRyRz --base 2 --links \"0,0,4; 3,0,0; 1,0,0\"\n\n\
    Exit codes: 0 shown, 2 usage, 3 the robot is broken."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// Print all of it as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Shows the robot.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let loaded = robot_source::load(&args.robot)?;
    if args.json {
        output::print_json(&record(&loaded.robot))?;
    } else {
        output::print(&text(&loaded.robot))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Where the whole robot's mass is at home, in the world \[m\]; none without mass.
fn com_at_home_m(robot: &Robot) -> Option<[f64; 3]> {
    let home = robot.positions(robot.home()).ok()?;
    centre_of_mass(robot, &home, Counted::WholeRobot).map(Into::into)
}

/// Names of the joints at these places of `q`.
fn names(robot: &Robot, places: &[usize]) -> Vec<String> {
    let all: Vec<&str> = robot
        .moving_joints()
        .map(|joint| joint.name.as_str())
        .collect();
    places.iter().map(|&i| all[i].to_owned()).collect()
}

fn count(n: usize, one: &str) -> String {
    if n == 1 {
        format!("{n} {one}")
    } else {
        format!("{n} {one}s")
    }
}

fn text(robot: &Robot) -> String {
    let mut out = format!("{}\n\n{}\n", robot.name().bold(), table::table(robot));
    let mut fact = |name: &str, what: &str| {
        let _ = writeln!(out, "{} {what}", format!("{name:<9}").dimmed());
    };
    let fixed = robot
        .joints()
        .iter()
        .filter(|joint| joint.kind == JointKind::Fixed)
        .count();
    let mimics = robot
        .joints()
        .iter()
        .filter(|joint| joint.mimic.is_some())
        .count();
    let mut joints = count(robot.joints().len(), "joint");
    for (n, what) in [(fixed, "fixed"), (mimics, "mimicking")] {
        if n > 0 {
            let _ = write!(joints, ", {n} {what}");
        }
    }
    fact(
        "total",
        &format!(
            "{}; {joints}; q has {}",
            count(robot.links().len(), "link"),
            count(robot.n(), "number")
        ),
    );
    // a nanometre is rounding
    let com_m = com_at_home_m(robot).map(|com| com.map(|x| (x * 1e9).round() / 1e9));
    match com_m {
        Some(com_m) => fact(
            "mass",
            &format!(
                "{} kg, centred at ({}) m at home",
                number(robot.mass_kg()),
                triple(&com_m)
            ),
        ),
        None => fact("mass", "none"),
    }
    for joint in robot.joints() {
        if let Some(mimic) = &joint.mimic {
            let master = &robot.joints()[mimic.joint].name;
            let times = match number(mimic.multiplier).as_str() {
                "1" => String::new(),
                "-1" => "-".to_owned(),
                other => format!("{other} "),
            };
            let offset = match mimic.offset {
                x if x > 0.0 => format!(" + {}", number(x)),
                x if x < 0.0 => format!(" - {}", number(-x)),
                _ => String::new(),
            };
            fact(
                "mimic",
                &format!("{} = {times}{master}{offset}", joint.name),
            );
        }
    }
    for closing in robot.loops() {
        let [first, second] = closing.links.map(|i| robot.links()[i].name.as_str());
        fact(
            "loop",
            &format!("{} between {first} and {second}", closing.kind.name()),
        );
    }
    if !robot.loops().is_empty() {
        fact(
            "",
            &format!(
                "{} follow from {}",
                names(robot, robot.dependent()).join(", "),
                names(robot, robot.independent()).join(", ")
            ),
        );
        let home: Vec<String> = robot.home().iter().map(|q| number(*q)).collect();
        fact("home", &format!("q = {}", home.join(", ")));
    }
    for frame in &robot.frames()[robot.links().len()..] {
        fact(
            "frame",
            &format!("{} on {}", frame.name, robot.links()[frame.link].name),
        );
    }
    if robot.frame("tcp").is_none() {
        fact(
            "frame",
            &format!(
                "no tcp; the last link, {}, stands in for it",
                robot.tcp().name
            ),
        );
    }
    for sensor in robot.sensors() {
        fact(
            "sensor",
            &format!("{} ({})", sensor.name, sensor.kind.name()),
        );
    }
    for warning in robot.warnings() {
        let indent = " ".repeat(10);
        let options = textwrap::Options::new(table::WIDEST)
            .initial_indent(&indent)
            .subsequent_indent(&indent)
            .break_words(false);
        let wrapped = textwrap::fill(warning, options);
        let _ = writeln!(
            out,
            "{} {}",
            format!("{:<9}", "warning").yellow(),
            wrapped.trim_start()
        );
    }
    out
}

fn record(robot: &Robot) -> Value {
    let links = robot.links().iter().map(|link| {
        let inertia = &link.inertia;
        let t = &inertia.about_com_kg_m2;
        json!({
            "name": link.name,
            "mass_kg": inertia.mass_kg,
            "com_m": inertia.com_m.as_slice(),
            "tensor_kg_m2": [t.xx, t.yy, t.zz, t.xy, t.xz, t.yz],
            "shapes": link.shapes.len(),
        })
    });
    let place = |name: &str| robot.moving_joints().position(|joint| joint.name == name);
    let joints = robot.joints().iter().map(|joint| {
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
            "q_index": place(&joint.name),
            "axis": (!fixed).then(|| joint.axis.as_slice()),
            "lower": joint.limits.lower,
            "upper": joint.limits.upper,
            "speed": joint.limits.speed,
            "effort": joint.limits.effort,
            "damping": joint.damping,
            "dry_friction": joint.dry_friction,
            "armature": joint.armature,
            "passive": joint.passive,
            "mimic": mimic,
        })
    });
    let loops = robot.loops().iter().map(|closing| {
        let links = closing.links.map(|i| robot.links()[i].name.as_str());
        json!({ "type": closing.kind.name(), "links": links })
    });
    let frames = robot.frames()[robot.links().len()..].iter();
    let frames =
        frames.map(|frame| json!({ "name": frame.name, "link": robot.links()[frame.link].name }));
    json!({
        "name": robot.name(),
        "links": links.collect::<Vec<Value>>(),
        "joints": joints.collect::<Vec<Value>>(),
        "frames": frames.collect::<Vec<Value>>(),
        "tcp": robot.tcp().name,
        "loops": loops.collect::<Vec<Value>>(),
        "q": robot.moving_joints().map(|joint| joint.name.as_str()).collect::<Vec<&str>>(),
        "independent": names(robot, robot.independent()),
        "dependent": names(robot, robot.dependent()),
        "sensors": robot.sensors().iter().map(|sensor| json!({ "name": sensor.name, "type": sensor.kind.name() })).collect::<Vec<Value>>(),
        "home": robot.home(),
        "mass_kg": robot.mass_kg(),
        "com_at_home_m": com_at_home_m(robot),
        "warnings": robot.warnings(),
    })
}
