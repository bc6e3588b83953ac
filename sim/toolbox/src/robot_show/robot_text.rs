//! A robot as text: its links and joints as a table, and what the table does not say as a list of facts.

use kinemark_sim::dynamics::{SingularMassMatrix, immovable_joint};
use kinemark_sim::kinematics::centre_of_mass::{Counted, centre_of_mass};
use kinemark_sim::model::drive::Drive;
use kinemark_sim::model::robot::Mimic;
use kinemark_sim::model::robot::{JointKind, Robot};
use kinemark_sim::text::number::short;

use super::link_table::{WIDEST, table, triple};
use crate::joint_names::joint_names;
use crate::styled_text::{Emphasis, StyledText};

/// Width of the labels before the facts.
const LABEL_WIDTH: usize = 9;

/// A robot as text for people.
pub fn robot_text(robot: &Robot) -> StyledText {
    let mut text = StyledText::default();
    text.push(Emphasis::Strong, robot.name());
    text.plain("\n\n");
    text.append(table(robot));
    text.plain("\n");
    let mut facts = Facts(text);
    facts.totals(robot);
    facts.drives(robot);
    facts.mimics(robot);
    facts.loops(robot);
    facts.frames_and_sensors(robot);
    facts.warnings(robot);
    facts.0
}

/// Where the whole robot's mass is at home, in the world \[m\]; none without mass.
pub(super) fn com_at_home_m(robot: &Robot) -> Option<[f64; 3]> {
    let home = robot.positions(robot.home()).ok()?;
    centre_of_mass(robot, &home, Counted::WholeRobot).map(Into::into)
}

fn count(n: usize, one: &str) -> String {
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}

/// The list of facts as far as it is written, a line each.
struct Facts(StyledText);

impl Facts {
    fn line(&mut self, label: &str, fact: &str) {
        self.styled_line(Emphasis::Faint, label, fact);
    }

    fn styled_line(&mut self, emphasis: Emphasis, label: &str, fact: &str) {
        self.0.push(emphasis, format!("{label:<LABEL_WIDTH$}"));
        self.0.plain(format!(" {fact}\n"));
    }

    fn totals(&mut self, robot: &Robot) {
        let joints = robot.joints().iter();
        let fixed = joints
            .clone()
            .filter(|joint| joint.kind == JointKind::Fixed);
        let mimics = joints.filter(|joint| joint.mimic.is_some());
        let mut joints = count(robot.joints().len(), "joint");
        for (n, what) in [(fixed.count(), "fixed"), (mimics.count(), "mimicking")] {
            if n > 0 {
                joints += &format!(", {n} {what}");
            }
        }
        let (links, numbers) = (
            count(robot.links().len(), "link"),
            count(robot.n(), "number"),
        );
        self.line("total", &format!("{links}; {joints}; q has {numbers}"));
        // a nanometre is rounding
        let com_m = com_at_home_m(robot).map(|com| com.map(|x| (x * 1e9).round() / 1e9));
        let mass = match com_m {
            Some(com_m) => {
                let mass = short(robot.mass_kg());
                format!("{mass} kg, centred at ({}) m at home", triple(&com_m))
            }
            None => "none".to_owned(),
        };
        self.line("mass", &mass);
        if let Some(SingularMassMatrix { joint }) = immovable_joint(robot) {
            let fact =
                format!("cannot move: joint {joint} moves no inertia, so there is no simulation");
            self.wrapped_line(Emphasis::Warning, "warning", &fact);
        }
    }

    fn drives(&mut self, robot: &Robot) {
        for joint in robot.joints() {
            if let Some(drive) = &joint.drive {
                let rule = drive_rule(drive, joint.kind.turns());
                let fact = format!("{}: {rule}", joint.name);
                self.wrapped_line(Emphasis::Faint, "drive", &fact);
            }
        }
    }

    fn mimics(&mut self, robot: &Robot) {
        for joint in robot.joints() {
            if let Some(mimic) = &joint.mimic {
                let rule = mimic_rule(mimic, &robot.joints()[mimic.joint].name);
                self.line("mimic", &format!("{} = {rule}", joint.name));
            }
        }
    }

    fn loops(&mut self, robot: &Robot) {
        for closing in robot.loops() {
            let [first, second] = closing.links.map(|i| robot.links()[i].name.as_str());
            let kind = closing.kind.name();
            self.line("loop", &format!("{kind} between {first} and {second}"));
        }
        if robot.loops().is_empty() {
            return;
        }
        let dependent = joint_names(robot, robot.dependent()).join(", ");
        let independent = joint_names(robot, robot.independent()).join(", ");
        self.line("", &format!("{dependent} follow from {independent}"));
        let home: Vec<String> = robot.home().iter().map(|q| short(*q)).collect();
        self.line("home", &format!("q = {}", home.join(", ")));
    }

    fn frames_and_sensors(&mut self, robot: &Robot) {
        for frame in &robot.frames()[robot.links().len()..] {
            let link = &robot.links()[frame.link].name;
            self.line("frame", &format!("{} on {link}", frame.name));
        }
        if robot.frame("tcp").is_none() {
            let last = &robot.tcp().name;
            self.line(
                "frame",
                &format!("no tcp; the last link, {last}, is used as the TCP"),
            );
        }
        for sensor in robot.sensors() {
            let (name, kind) = (&sensor.name, sensor.type_name);
            self.line("sensor", &format!("{name} ({kind})"));
        }
    }

    fn warnings(&mut self, robot: &Robot) {
        for warning in robot.warnings() {
            self.wrapped_line(Emphasis::Warning, "warning", warning);
        }
    }

    /// A fact of as many lines as a page needs for it.
    fn wrapped_line(&mut self, emphasis: Emphasis, label: &str, fact: &str) {
        let indent = " ".repeat(LABEL_WIDTH + 1);
        let options = textwrap::Options::new(WIDEST)
            .initial_indent(&indent)
            .subsequent_indent(&indent)
            .break_words(false);
        let wrapped = textwrap::fill(fact, options);
        self.styled_line(emphasis, label, wrapped.trim_start());
    }
}

/// What a drive is: `stall 200 N, free speed 0.025 m/s, ratio 1257 rad/m, ...`.
fn drive_rule(drive: &Drive, turns: bool) -> String {
    let (effort, speed, ratio, inertia) = match turns {
        true => ("N m", "rad/s", "", "kg m²"),
        false => ("N", "m/s", " rad/m", "kg"),
    };
    let mut parts = Vec::new();
    if let Some(line) = &drive.line {
        parts.push(format!("stall {} {effort}", short(line.stall)));
        parts.push(format!("free speed {} {speed}", short(line.free_speed)));
    }
    parts.push(format!("ratio {}{ratio}", short(drive.ratio)));
    if drive.rotor_inertia_kg_m2 > 0.0 {
        let felt = short(drive.felt_inertia());
        let rotor = short(drive.rotor_inertia_kg_m2);
        parts.push(format!("rotor {rotor} kg m², felt as {felt} {inertia}"));
    }
    if drive.efficiency < 1.0 {
        parts.push(format!("efficiency {}", short(drive.efficiency)));
    }
    parts.join(", ")
}

/// What a mimic joint is: `2 master + 0.1`.
fn mimic_rule(mimic: &Mimic, master: &str) -> String {
    let times = match short(mimic.multiplier).as_str() {
        "1" => String::new(),
        "-1" => "-".to_owned(),
        other => format!("{other} "),
    };
    let offset = match mimic.offset {
        x if x > 0.0 => format!(" + {}", short(x)),
        x if x < 0.0 => format!(" - {}", short(-x)),
        _ => String::new(),
    };
    format!("{times}{master}{offset}")
}
